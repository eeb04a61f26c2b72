//! The church beside the cloister: a nave with round-arched windows and a corbel table, and its bell tower. In meters.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec3, dvec2, dvec3};

use crate::cloister::{BAY, Builder, DEEP, Finish, bays};
use crate::cloister_masonry::{Opening, cover, frame, pierced, points, surround, united};
use crate::curve::{half_circle, turned_plain};
use crate::glb::Node;
use crate::outline::{arc, circle};
use crate::plate::{Hole, Plate, Rim};
use crate::solid::{Axis, Solid};
use crate::temple_masonry::{SUNK, Span, block};

/// Half the nave's length inside its gables.
const LENGTH: f64 = 15.25;
/// Half its width.
const WIDTH: f64 = 4.2;
/// Its middle.
const AXIS: f64 = -19.06;
/// The side walls' upper side.
const TOP: f64 = 10.7;
/// Meters of height per meter of the roof.
const SLOPE: f64 = 0.62;
/// Where the roof's upper sides meet.
const RIDGE: f64 = TOP + 0.25 + SLOPE * WIDTH;

/// A window of the nave.
fn window(middle: f64) -> Opening {
    Opening { middle, half: 0.45, foot: 7.95, spring: 9.1 }
}

/// Walls, gables and roof of the nave, about its own axis.
pub(crate) fn church(builder: &mut Builder) -> Node {
    let windows = bays().map(window);
    let side =
        pierced([-LENGTH - 0.1, LENGTH + 0.1], [-0.6 * DEEP, TOP], [WIDTH - 0.7, WIDTH], &[], &windows);
    let side = builder.mesh("side", Finish::Stone, side);
    let frames = builder.mesh(
        "windows",
        Finish::Pale,
        united(windows.iter().flat_map(|w| {
            [
                surround(w.grown(-0.07), w.foot - SUNK, 0.18, [WIDTH - 0.74, WIDTH + 0.06]),
                block(
                    [w.middle - 0.68, w.middle + 0.68],
                    [w.foot - 0.14, w.foot + 0.04],
                    [WIDTH - 0.78, WIDTH + 0.09],
                ),
            ]
        })),
    );
    let table = builder.mesh("corbel table", Finish::Pale, corbel_table());
    let gable = builder.mesh("gable", Finish::Stone, gable());
    let tiles = builder.mesh("tiles", Finish::Tiles, tiles());
    let half = |name: &str, number: usize, mesh: usize| {
        let turn = DQuat::from_rotation_y(if number == 1 { 0.0 } else { PI });
        Node::new(format!("{name}.{number}"), Some(mesh)).turned(turn)
    };
    let mut parts = Vec::new();
    for (name, mesh) in
        [("side", side), ("windows", frames), ("corbel_table", table), ("gable", gable), ("tiles", tiles)]
    {
        parts.extend([half(name, 1, mesh), half(name, 2, mesh)]);
    }
    parts.push(builder.part("roof", Finish::Tiles, roof()));
    parts.push(builder.part("ridge", Finish::Tiles, ridge()));
    Builder::placed(Node::new("church", None).with(parts), 0.0, 0.0, AXIS)
}

/// A frieze of little round arches under the eaves.
fn corbel_table() -> Solid {
    let (n, pitch) = (21, BAY / 4.0);
    let (foot, top, end) = (TOP - 0.74, TOP - 0.1, LENGTH + 0.08);
    let middles = || (-n..n).map(|i| (f64::from(i) + 0.5) * pitch);
    let mut outline = points(&[(-end, foot)]);
    for middle in middles() {
        outline.push(dvec2(middle - 0.25, foot));
        outline.extend(arc(dvec2(middle, foot + 0.14), 0.25, PI, 0.0, 8));
        outline.push(dvec2(middle + 0.25, foot));
    }
    outline.extend(points(&[(end, foot), (end, top)]));
    // The cornice hides that the upper side is not quite straight: it would be filled with needles.
    let above = middles().enumerate().map(|(i, middle)| dvec2(-middle, top - 0.005 * (i % 2) as f64));
    outline.extend(above);
    outline.push(dvec2(-end, top));
    let frieze = Plate { outline, rim: vec![(0.0, WIDTH - 0.1), (0.0, WIDTH + 0.1)], ..Plate::default() };
    let cornice = points(&[
        (-WIDTH + 0.15, TOP - 0.12),
        (-WIDTH + 0.15, TOP + 0.03),
        (-WIDTH - 0.3, TOP + 0.03),
        (-WIDTH - 0.3, TOP - 0.03),
        (-WIDTH - 0.2, TOP - 0.12),
    ]);
    let cornice = Plate { outline: cornice, rim: lengths(end - 0.02), ..Plate::default() };
    united([frieze.solid(), cornice.solid().along(Axis::X)])
}

/// The rim of a long molding, cut several times, so that its narrow bands are not needles.
fn lengths(half: f64) -> Rim {
    const PIECES: i32 = 6;
    (0..=PIECES).map(|i| (0.0, half * f64::from(2 * i - PIECES) / f64::from(PIECES))).collect()
}

/// A gable wall, higher than the roof, with a round window; at +X.
fn gable() -> Solid {
    let (half, rise) = (WIDTH + 0.16, 0.42);
    let outline = points(&[
        (-half, -0.8 * DEEP),
        (half, -0.8 * DEEP),
        (half, TOP + rise),
        (0.0, TOP + rise + SLOPE * half),
        (-half, TOP + rise),
    ]);
    let rose = circle(dvec2(0.0, 9.2), 1.1, 48);
    let wall = Plate {
        outline,
        rim: vec![(0.0, LENGTH), (0.0, LENGTH + 0.8)],
        holes: vec![Hole { outline: rose, chamfer: 0.12 }],
        ..Plate::default()
    };
    let (eaves, foot) = (half + 0.16, TOP + rise - SUNK);
    let (low, high) = (foot - SLOPE * 0.16, foot + SLOPE * half);
    let coping = points(&[
        (eaves, low),
        (eaves, low + 0.2),
        (0.0, high + 0.2),
        (-eaves, low + 0.2),
        (-eaves, low),
        (0.0, high),
    ]);
    let rim = vec![(0.0, LENGTH - 0.1), (0.0, LENGTH + 0.9)];
    let coping = Plate { outline: coping, rim, ..Plate::default() };
    united([wall.solid(), coping.solid()]).along(Axis::X)
}

/// Both slopes of the roof.
fn roof() -> Solid {
    let eaves = WIDTH + 0.4;
    let low = RIDGE - SLOPE * eaves;
    let outline = points(&[
        (eaves, low - 0.18),
        (eaves, low),
        (0.0, RIDGE),
        (-eaves, low),
        (-eaves, low - 0.18),
        (0.0, RIDGE - 0.26),
    ]);
    Plate { outline, rim: vec![(0.0, -LENGTH - 0.1), (0.0, LENGTH + 0.1)], ..Plate::default() }
        .solid()
        .along(Axis::X)
}

/// The ridges of tiles on the slope towards +Z.
fn tiles() -> Solid {
    let (n, pitch) = (21, BAY / 4.0);
    let eaves = WIDTH + 0.44;
    let ridge = |i: i32| {
        let x = f64::from(i) * pitch;
        cover(x, dvec2(eaves, RIDGE - SLOPE * eaves), dvec2(0.06, RIDGE - SLOPE * 0.06), 0.15, [0.14, 0.2])
    };
    united((-n..=n).map(ridge))
}

/// The large tiles along the ridge.
fn ridge() -> Solid {
    cover(0.0, dvec2(-LENGTH - 0.05, RIDGE), dvec2(LENGTH + 0.05, RIDGE + 0.03), 0.22, [0.2; 2])
        .bent(|p| dvec3(p.z, p.y, -p.x))
}

/// Where the tower stands, and half its width.
const TOWER: ([f64; 2], f64) = ([-12.37, AXIS - 0.6], 2.4);
/// The belfry.
const BELFRY: Span = [14.2, 17.4];

/// The bell tower: a shaft with string courses, an open belfry with a bell, a low pyramid of tiles with a cross.
pub(crate) fn tower(builder: &mut Builder) -> Node {
    let ([x, z], half) = TOWER;
    let shaft = block([-half, half], [-0.7 * DEEP, BELFRY[0]], [-half, half]);
    let course = |y: f64, out: f64| {
        let section = points(&[
            (half - 0.2, y),
            (half + 0.3 * out, y),
            (half + 0.4 * out, y + 0.05),
            (half + out, y + 0.14),
            (half + out, y + 0.24),
            (half - 0.2, y + 0.27),
        ]);
        frame(&section)
    };
    let mut parts = vec![builder.part("shaft", Finish::Stone, shaft)];
    for (name, y, out) in
        [("course.1", 11.6, 0.1), ("course.2", BELFRY[0] - 0.2, 0.12), ("cornice", BELFRY[1] - 0.04, 0.26)]
    {
        parts.push(builder.part(name, Finish::Pale, course(y, out)));
    }
    parts.extend(belfry(builder));
    parts.push(builder.part("roof", Finish::Tiles, pyramid()));
    parts.push(builder.part("cross", Finish::Iron, cross()));
    Builder::placed(Node::new("tower", None).with(parts), x, 0.0, z)
}

/// Four walls with twin openings between corner posts, and the bell.
fn belfry(builder: &mut Builder) -> Vec<Node> {
    let ([_, _], half) = TOWER;
    let [low, high] = BELFRY;
    let opening = |middle| Opening { middle, half: 0.52, foot: low + 0.35, spring: low + 1.88 };
    let openings = [-0.72, 0.72].map(opening);
    let face = half - 0.1;
    let wall = pierced([0.6 - half, half - 0.6], [low - SUNK, high], [face - 0.45, face], &[], &openings);
    let arches = openings.map(|o| surround(o.grown(-0.06), o.foot - 0.1, 0.15, [face - 0.5, face + 0.05]));
    let wall = builder.mesh("wall", Finish::Stone, wall);
    let arches = builder.mesh("arches", Finish::Pale, united(arches));
    let inner = half - 0.7;
    let post = block([inner, half - 0.02], [low - 0.5 * SUNK, high - 0.5 * SUNK], [inner, half - 0.02]);
    let post = builder.mesh("post", Finish::Stone, post);
    let mut parts = Vec::new();
    for i in 0..4 {
        let turn = DQuat::from_rotation_y(f64::from(i) * FRAC_PI_2);
        for (name, mesh) in [("belfry", wall), ("arches", arches), ("post", post)] {
            parts.push(Node::new(format!("{name}.{}", i + 1), Some(mesh)).turned(turn));
        }
    }
    let bell = points(&[
        (0.0, 1.04),
        (0.5, 0.93),
        (0.56, 0.9),
        (0.58, 0.94),
        (0.46, 1.2),
        (0.38, 1.5),
        (0.34, 1.72),
        (0.22, 1.86),
        (0.08, 1.9),
        (0.06, 2.1),
        (0.0, 2.1),
    ]);
    let beam = block([-half + 0.3, half - 0.3], [low + 2.05, low + 2.3], [-0.12, 0.12]);
    parts.push(builder.part("bell", Finish::Bronze, turned_plain(&bell, 32).moved(0.0, low, 0.0)));
    parts.push(builder.part("bell_beam", Finish::Wood, beam));
    parts
}

/// The tower's roof.
fn pyramid() -> Solid {
    let half = TOWER.1 + 0.42;
    let (low, high) = (BELFRY[1] + 0.18, BELFRY[1] + 3.1);
    let ring = |half: f64, y: f64| -> Vec<DVec3> {
        [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)]
            .map(|(x, z)| dvec3(x * half, y, z * half))
            .to_vec()
    };
    const PIECES: usize = 6;
    let mut rings = vec![ring(half, low)];
    for i in 0..=PIECES {
        // Steeper towards the tip.
        let part = i as f64 / PIECES as f64;
        let rise = 0.08 + (high - low) * (0.78 * part + 0.22 * part.powi(2));
        rings.push(ring(half * (1.0 - part) + 0.05 * part, low + rise));
    }
    let mut solid = Solid::default();
    for pair in rings.windows(2) {
        solid.band(&pair[0], &pair[1]);
    }
    let (foot, tip) = (&rings[0], &rings[rings.len() - 1]);
    solid.quad(foot[3], foot[2], foot[1], foot[0]);
    solid.quad(tip[0], tip[1], tip[2], tip[3]);
    solid
}

/// A ball and a cross on the tip.
fn cross() -> Solid {
    let foot = BELFRY[1] + 3.2;
    let ball = turned_plain(&half_circle(0.17, 10), 24).moved(0.0, foot + 0.08, 0.0);
    united([
        ball,
        block([-0.035, 0.035], [foot, foot + 1.1], [-0.035, 0.035]),
        block([-0.28, 0.28], [foot + 0.72, foot + 0.79], [-0.03, 0.03]),
    ])
}
