//! The arcades around the court: parapets, twin columns, arches and the wall that they carry, stronger piers at the
//! court's corners. In meters, as parts of the south walk, which lies towards +Z.

use std::f64::consts::FRAC_PI_2;

use glam::dvec2;

use crate::cloister::{
    ARCADE, ARCH, BAY, Builder, COURT, DEEP, EAVES, FLOOR, Finish, IMPOST, PARAPET, WALK, bays, bounds,
};
use crate::cloister_column::Pair;
use crate::cloister_masonry::{
    CHORDS, Opening, angle, arch, frame, pierced, pilaster, plan, points, united, upright,
};
use crate::glb::Node;
use crate::plate::Plate;
use crate::solid::{Axis, Solid};
use crate::temple_masonry::{SUNK, Span};

/// Where the end arches meet the piers.
const JAMB: f64 = 3.0 * BAY + ARCH;
/// The parapet at the left of the entrance, from within the pier to a little beyond the last columns.
const PARAPETS: Span = [-JAMB - 0.1, 0.3 - 0.5 * BAY];

/// What the arcades of all four sides share.
pub(crate) struct Arcade {
    columns: Pair,
    wall: usize,
    archivolt: usize,
    parapet: usize,
    corbels: usize,
}

impl Arcade {
    /// Cuts the stones.
    pub(crate) fn new(builder: &mut Builder) -> Self {
        Self {
            columns: Pair::new(builder),
            wall: builder.mesh("spandrels", Finish::Stone, spandrels()),
            archivolt: builder.mesh("arch", Finish::Pale, archivolt()),
            parapet: builder.mesh("parapet", Finish::Stone, parapet()),
            corbels: builder.mesh("corbels", Finish::Pale, corbels()),
        }
    }

    /// One side's arcade.
    pub(crate) fn node(&self) -> Node {
        let mut parts = vec![
            Node::new("wall", Some(self.wall)),
            Node::new("corbels", Some(self.corbels)),
            Node::new("parapet.1", Some(self.parapet)),
            Builder::placed(Node::new("parapet.2", Some(self.parapet)), -PARAPETS[0] - PARAPETS[1], 0.0, 0.0),
        ];
        parts.extend(bays().into_iter().enumerate().map(|(i, x)| {
            let arch = Node::new(format!("arch.{}", i + 1), Some(self.archivolt));
            Builder::placed(arch, x, IMPOST, ARCADE)
        }));
        parts.extend(bounds().into_iter().enumerate().map(|(i, x)| self.columns.pair(i + 1, x)));
        Node::new("arcade", None).with(parts)
    }

    /// A column by itself.
    pub(crate) fn column(&self, name: &str, x: f64, z: f64) -> Node {
        self.columns.column(name, x, z)
    }
}

/// The wall above the arches; its ends stand in the corner piers.
fn spandrels() -> Solid {
    let foot = IMPOST - 0.3 * SUNK;
    // Wider than the arches, which line it.
    let doors = bays().map(|middle| Opening { middle, half: ARCH + 0.1, foot, spring: foot });
    pierced([-3.5 * BAY - 0.1, 3.5 * BAY + 0.1], [foot, EAVES + 0.03], [COURT, WALK], &doors, &[])
}

/// An arch of two orders: the voussoirs and a thin hood around them.
fn archivolt() -> Solid {
    let thick = (WALK - COURT) / 2.0;
    let section = [
        (0.0, -thick - 0.04),
        (0.17, -thick - 0.04),
        (0.17, -thick - 0.08),
        (0.235, -thick - 0.08),
        (0.235, thick + 0.08),
        (0.17, thick + 0.08),
        (0.17, thick + 0.04),
        (0.0, thick + 0.04),
    ];
    arch(ARCH, ARCH, CHORDS, &points(&section)).moved(0.0, -1.5 * SUNK, 0.0)
}

/// The low wall under the columns.
fn parapet() -> Solid {
    let rim = [
        (0.0, FLOOR - 0.4 * DEEP),
        (0.0, FLOOR + 0.12),
        (0.05, FLOOR + 0.16),
        (0.05, PARAPET - 0.15),
        (0.0, PARAPET - 0.1),
        (-0.02, PARAPET - 0.1),
        (-0.02, PARAPET),
    ];
    let half = 0.31;
    upright(&plan(PARAPETS, [ARCADE - half, ARCADE + half]), &rim)
}

/// The little corbels under the cornice.
fn corbels() -> Solid {
    const PER_BAY: usize = 4;
    let n = 7 * PER_BAY;
    let one = |i: usize| {
        let x = (i as f64 + 0.5 - n as f64 / 2.0) * BAY / PER_BAY as f64;
        corbel([x - 0.085, x + 0.085])
    };
    united((0..n).map(one))
}

/// A block with a round nose.
fn corbel(x: Span) -> Solid {
    let (back, top) = (COURT + SUNK, EAVES - 0.22 + SUNK);
    let mut outline = points(&[(-back, top), (-back, top - 0.24)]);
    outline.extend((0..=4).map(|i| {
        let (sin, cos) = (i as f64 / 4.0 * FRAC_PI_2).sin_cos();
        dvec2(-COURT + 0.04 + 0.16 * sin, top - 0.06 - 0.16 * cos)
    }));
    outline.push(dvec2(-COURT + 0.2, top));
    Plate { outline, rim: vec![(0.0, x[0]), (0.0, x[1])], ..Plate::default() }.solid().along(Axis::X)
}

/// The pier at a corner of the court, an angle in plan, and the strips that continue it up to the roof.
pub(crate) fn pier(builder: &mut Builder) -> Vec<(&'static str, usize)> {
    let low = upright(&angle(JAMB + 0.04, COURT - 0.09, WALK + 0.09), &pilaster(FLOOR, IMPOST));
    let high = upright(
        &angle(JAMB + 0.3, COURT - 0.05, WALK + 0.05),
        &[(0.0, IMPOST - 0.5 * SUNK), (0.0, EAVES + 0.05)],
    );
    vec![
        ("pier", builder.mesh("pier", Finish::Stone, low)),
        ("strip", builder.mesh("strip", Finish::Stone, high)),
    ]
}

/// The molding below the corbels and the cornice above them, around the court.
pub(crate) fn cornices(builder: &mut Builder) -> Vec<Node> {
    let string = points(&[
        (COURT - 0.06, 4.34),
        (COURT - 0.03, 4.3),
        (COURT + 0.1, 4.3),
        (COURT + 0.1, 4.41),
        (COURT - 0.1, 4.41),
        (COURT - 0.1, 4.37),
    ]);
    let low = EAVES - 0.22;
    let cornice = points(&[
        (COURT + 0.1, low),
        (COURT + 0.1, EAVES + 0.06),
        (COURT - 0.38, EAVES + 0.02),
        (COURT - 0.38, EAVES - 0.05),
        (COURT - 0.35, EAVES - 0.07),
        (COURT - 0.29, EAVES - 0.09),
        (COURT - 0.24, EAVES - 0.13),
        (COURT - 0.23, low + 0.05),
        (COURT - 0.23, low),
    ]);
    vec![
        builder.part("string_course", Finish::Pale, frame(&string)),
        builder.part("cornice", Finish::Pale, frame(&cornice)),
    ]
}
