//! A pear and an apple, in one color each.

use glam::{DVec3, dvec3};

use crate::curve::{profile, through, turned_plain, wire};
use crate::glb::Node;
use crate::solid::Solid;
use crate::still_life::{Finish, Studio};

/// The pear, standing on the origin.
pub(crate) fn pear(studio: &mut Studio) -> Node {
    let skin = profile(
        &[
            (0.0, 4.5),
            (7.0, 2.0),
            (13.0, 0.0),
            (24.0, 5.0),
            (33.0, 20.0),
            (34.0, 37.0),
            (26.5, 55.0),
            (17.5, 70.0),
            (14.0, 82.0),
            (10.0, 90.5),
            (4.5, 92.5),
            (0.0, 90.5),
        ],
        4,
    );
    // It grew a little crooked.
    let body = turned_plain(&skin, 48).bent(|p| p + dvec3(10.0 * (p.y / 92.0).max(0.0).powi(2), 0.0, 0.0));
    let stalk = stalk(&[
        dvec3(9.5, 86.0, 0.0),
        dvec3(10.5, 96.0, 0.0),
        dvec3(15.0, 106.0, 1.0),
        dvec3(22.0, 112.0, 2.0),
    ]);
    Node::new("pear", None)
        .with(vec![studio.node("body", Finish::Pear, body), studio.node("stalk", Finish::Bark, stalk)])
}

/// The apple, standing on the origin.
pub(crate) fn apple(studio: &mut Studio) -> Node {
    let skin = profile(
        &[
            (0.0, 7.5),
            (5.0, 5.0),
            (12.0, 0.0),
            (22.0, 4.0),
            (32.5, 18.0),
            (37.0, 37.0),
            (33.0, 55.0),
            (22.0, 65.0),
            (12.0, 65.5),
            (5.0, 59.0),
            (0.0, 55.0),
        ],
        4,
    );
    let stalk = stalk(&[
        dvec3(0.0, 50.0, 0.0),
        dvec3(0.5, 62.0, 0.0),
        dvec3(3.5, 74.0, -1.0),
        dvec3(9.0, 82.0, -2.0),
    ]);
    Node::new("apple", None).with(vec![
        studio.node("body", Finish::Apple, turned_plain(&skin, 48)),
        studio.node("stalk", Finish::Bark, stalk),
    ])
}

/// A stalk that gets thicker towards its end.
fn stalk(points: &[DVec3]) -> Solid {
    wire(&through(points, 5), |t| 1.5 + 0.9 * t * t)
}
