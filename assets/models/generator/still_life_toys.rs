//! The checkered ball and the cube.

use glam::{DQuat, dvec2};

use crate::curve::{half_circle, turned};
use crate::glb::{Image, Node};
use crate::outline::Outline;
use crate::picture::{Canvas, encoded, paint, rgb};
use crate::plate::Plate;
use crate::solid::Axis;
use crate::still_life::{Finish, Studio};

/// Fields of the ball around its equator; half as many lie between its poles.
const FIELDS: f64 = 16.0;
/// The radius of the ball.
const BALL: f64 = 46.0;
/// Half an edge of the cube.
const CUBE: f64 = 27.0;

/// The ball, standing on the origin, its axis tilted.
pub(crate) fn ball(studio: &mut Studio) -> Node {
    let pieces = 32;
    let solid = turned(&half_circle(BALL, pieces), 64, 1.0, |i| 1.0 - i as f64 / pieces as f64);
    let tilt = DQuat::from_rotation_y(0.5) * DQuat::from_rotation_x(0.62);
    let checker = studio.node("checker", Finish::Checker, solid).at(0.0, BALL, 0.0).turned(tilt);
    Node::new("ball", None).with(vec![checker])
}

/// The cube, standing on the origin.
pub(crate) fn cube(studio: &mut Studio) -> Node {
    let outline: Outline =
        vec![dvec2(-CUBE, -CUBE), dvec2(CUBE, -CUBE), dvec2(CUBE, CUBE), dvec2(-CUBE, CUBE)];
    let solid = Plate { outline, rim: vec![(0.0, 0.0), (0.0, 2.0 * CUBE)], ..Plate::default() }.solid();
    studio.node("cube", Finish::Clay, solid.along(Axis::Y))
}

/// The fields, their borders on borders of texels.
pub(crate) fn checker() -> Image {
    let canvas = Canvas { texels: [1024, 512], size: dvec2(FIELDS, FIELDS * 0.5) };
    let colors = [paint(0xf0_e9d8), paint(0x34_4e6b)];
    let picture = canvas.paint(|p| rgb(colors[(p.x as usize + p.y as usize) % 2]));
    encoded("checker", &picture)
}
