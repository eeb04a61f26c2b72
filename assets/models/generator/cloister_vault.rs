//! Groin vaults over the walks, with transverse arches between the bays, ribs along the groins and bosses. In meters, as
//! parts of the south walk; a bay's own origin is in its middle, at the height where the vault springs.

use glam::{DQuat, DVec2, DVec3, dvec2, dvec3};

use crate::cloister::{BAY, Builder, FLOOR, Finish, IMPOST, OUTER, WALK, bays, bounds};
use crate::cloister_masonry::{CHORDS, arch, pilaster, plan, points, soffit, upright};
use crate::curve::turned_plain;
use crate::delaunay;
use crate::glb::Node;
use crate::plate::Plate;
use crate::solid::{Axis, Solid};
use crate::temple_masonry::SUNK;

/// From the springing to the crown.
const RISE: f64 = 1.72;
/// From the springing to the masonry's level top.
const TOP: f64 = 2.0;
/// Half the walk's width.
const HALF: f64 = (OUTER - WALK) / 2.0;
/// The middle of the walk.
const AXIS: f64 = (OUTER + WALK) / 2.0;
/// Half the width of a transverse arch.
const BAND: f64 = 0.17;
/// How far transverse arches stand out below the vault.
const DROP: f64 = 0.13;
/// The broad arch before a corner, along the walk.
const BROAD: [f64; 2] = [3.5 * BAY - BAND, WALK - 0.04];

/// What the vaults of all walks share.
pub(crate) struct Vaults {
    bay: Bay,
    corner: Bay,
    band: usize,
    broad: usize,
    pilaster: usize,
    broad_pilaster: usize,
}

/// A vault's meshes.
struct Bay {
    web: usize,
    rib: usize,
    boss: usize,
    /// Between a rib and the walk.
    angle: f64,
}

impl Bay {
    /// A bay between arches: half its width along the walk, and how far its masonry goes on in the arches and walls.
    fn new(builder: &mut Builder, half: f64, beyond: [f64; 2]) -> Self {
        let rib = points(&[(-0.11, -0.05), (0.08, -0.08), (0.08, 0.08), (-0.11, 0.05)]);
        Self {
            web: builder.creased("vault", Finish::Plaster, groined([half, HALF], beyond), 12.0),
            rib: builder.mesh(
                "rib",
                Finish::Pale,
                arch(half.hypot(HALF), RISE, CHORDS, &rib).moved(0.0, -1.2 * SUNK, 0.0),
            ),
            boss: builder.mesh("boss", Finish::Pale, boss()),
            angle: HALF.atan2(half),
        }
    }

    /// A bay.
    fn node(&self, name: impl Into<String>, x: f64, z: f64) -> Node {
        let rib = |name, angle| Node::new(name, Some(self.rib)).turned(DQuat::from_rotation_y(angle));
        let parts = vec![
            Node::new("web", Some(self.web)),
            rib("rib.1", self.angle),
            rib("rib.2", -self.angle),
            Node::new("boss", Some(self.boss)),
        ];
        // The web's level margins lie in the arches, a little above the stones that these stand on.
        Builder::placed(Node::new(name, None).with(parts), x, IMPOST + 0.5 * SUNK, z)
    }
}

impl Vaults {
    /// Builds the vaults.
    pub(crate) fn new(builder: &mut Builder) -> Self {
        let half = |[from, to]: [f64; 2]| (to - from) / 2.0;
        let depth = [OUTER - 0.13, OUTER + 0.12];
        let mut support = |name, half: f64| {
            let plan = plan([-half, half], depth);
            builder.mesh(name, Finish::Stone, upright(&plan, &pilaster(FLOOR, IMPOST)))
        };
        let pilaster = support("pilaster", BAND + 0.02);
        let broad_pilaster = support("pilaster", half(BROAD) + 0.02);
        Self {
            bay: Bay::new(builder, BAY / 2.0 - BAND, [BAND - 0.05, SUNK]),
            corner: Bay::new(builder, HALF, [0.06; 2]),
            band: builder.mesh("transverse arch", Finish::Pale, transverse(BAND)),
            broad: builder.mesh("transverse arch", Finish::Pale, transverse(half(BROAD))),
            pilaster,
            broad_pilaster,
        }
    }

    /// The vaults of one walk.
    pub(crate) fn walk(&self) -> Node {
        let ends = (BROAD[0] + BROAD[1]) / 2.0;
        let places = [[-ends].as_slice(), &bounds(), &[ends]].concat();
        let mut parts: Vec<Node> = bays()
            .into_iter()
            .enumerate()
            .map(|(i, x)| self.bay.node(format!("vault.{}", i + 1), x, AXIS))
            .collect();
        for (i, &x) in places.iter().enumerate() {
            let (band, pilaster) =
                if x.abs() == ends { (self.broad, self.broad_pilaster) } else { (self.band, self.pilaster) };
            let band = Node::new(format!("transverse_arch.{}", i + 1), Some(band));
            let pilaster = Node::new(format!("pilaster.{}", i + 1), Some(pilaster));
            parts.push(Builder::placed(band, x, IMPOST, AXIS));
            parts.push(Builder::placed(pilaster, x, 0.0, 0.0));
        }
        Node::new("vaults", None).with(parts)
    }

    /// The vault between two walks.
    pub(crate) fn corner(&self) -> Node {
        self.corner.node("vault", AXIS, AXIS)
    }
}

/// An arch across the walk that carries its wall up to the vault's level top.
fn transverse(half: f64) -> Solid {
    let (end, foot) = (HALF + 0.03, -SUNK);
    let mut outline = vec![dvec2(-end, foot)];
    outline.extend(soffit(0.0, foot, HALF - DROP, RISE - DROP + SUNK));
    outline.extend([dvec2(end, foot), dvec2(end, TOP + 0.03), dvec2(-end, TOP + 0.03)]);
    let rim = vec![(0.03, -half), (0.0, 0.03 - half), (0.0, half - 0.03), (0.03, half)];
    Plate { outline, rim, ..Plate::default() }.solid().along(Axis::X)
}

/// A block hollowed out by two crossing barrels of half widths `half` along x and z, which goes on by `beyond`.
fn groined(half: [f64; 2], beyond: [f64; 2]) -> Solid {
    let mut solid = Solid::default();
    // Across a barrel: from −1 to 1, and the height.
    let across: Vec<(f64, f64)> = soffit(0.0, 0.0, 1.0, RISE).iter().map(|p| (p.x, p.y)).collect();
    // Seen along the barrel from the middle, to each of the four sides.
    for quarter in 0..4 {
        let along = quarter % 2;
        let (near, far) = (half[along], half[along] + beyond[along]);
        let (side, edge) = (half[1 - along], half[1 - along] + beyond[1 - along]);
        let place = |u: f64, v: f64, y: f64| match quarter {
            0 => dvec3(u, y, v),
            1 => dvec3(-v, y, u),
            2 => dvec3(-u, y, -v),
            _ => dvec3(v, y, -u),
        };
        // Above each chord: from the groin to the arch, then on into the wall.
        for pair in across.windows(2) {
            let [(v0, y0), (v1, y1)] = [pair[0], pair[1]];
            let row = |v: f64, y: f64| [v.abs() * near, near, far].map(|u| place(u, v * side, y));
            let ([a, b, c], [d, e, f]) = (row(v0, y0), row(v1, y1));
            solid.quad(a, b, e, d);
            solid.quad(b, c, f, e);
        }
        // The level corner between this side and the next, and the block's upright face.
        solid.quad(
            place(near, side, 0.0),
            place(far, side, 0.0),
            place(far, edge, 0.0),
            place(near, edge, 0.0),
        );
        let mut face = vec![dvec2(-edge, TOP), dvec2(-edge, 0.0)];
        face.extend(across.iter().map(|&(v, y)| dvec2(v * side, y)));
        face.extend([dvec2(edge, 0.0), dvec2(edge, TOP)]);
        for triangle in delaunay::fill(&face, &[]) {
            let [a, b, c] = triangle.map(|p: DVec2| place(far, p.x, p.y));
            solid.triangle(a, c, b);
        }
    }
    let [x, z] = [0, 1].map(|i| half[i] + beyond[i]);
    let corner = |x: f64, z: f64| DVec3::new(x, TOP, z);
    solid.quad(corner(-x, z), corner(x, z), corner(x, -z), corner(-x, -z));
    debug_assert_eq!(across.len(), CHORDS + 1);
    solid
}

/// The keystone where the ribs cross.
fn boss() -> Solid {
    let profile = [
        (0.0, RISE - 0.21),
        (0.1, RISE - 0.18),
        (0.11, RISE - 0.15),
        (0.17, RISE - 0.13),
        (0.17, RISE + 0.02),
        (0.0, RISE + 0.02),
    ];
    turned_plain(&points(&profile), 16)
}
