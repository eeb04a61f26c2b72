//! What the ogre's parts are unrolled from.

use glam::{DVec3, dvec3};

use crate::ogre_body::{
    FIST, GRIP, LEFT_ARM, LEFT_WRIST, OPEN, RIGHT_ARM, STEPS, TOES, fist_axes, foot_axes, open_axes,
    world_from_head,
};
use crate::unwrap::Chart;
use crate::{ogre_gear, ogre_head};

/// What the skin is unrolled from.
pub(crate) fn skin_charts() -> Vec<Chart> {
    let mut charts = vec![
        Chart::new(dvec3(0.0, 0.68, 0.03), dvec3(0.0, 1.15, 0.0), 0.4),
        Chart::new(world_from_head(dvec3(0.0, -0.1, 0.02)), world_from_head(dvec3(0.0, 0.06, -0.01)), 0.27),
    ];
    for side in [-1.0, 1.0] {
        let ear = |reach: f64| world_from_head(ogre_head::ear_point(side, reach));
        charts.push(Chart::new(ear(0.1), ear(0.3), 0.06));
    }
    for [shoulder, elbow, wrist] in [LEFT_ARM, RIGHT_ARM] {
        charts.push(Chart::new(shoulder.0, elbow.0, 0.15));
        charts.push(Chart::new(elbow.0, wrist.0, 0.12));
    }
    let (up, _, _) = open_axes();
    charts.push(Chart::new(LEFT_WRIST + up * 0.08, LEFT_WRIST + up * 0.16, 0.09));
    let (up, out, _) = fist_axes();
    let heel = GRIP + out * 0.1;
    charts.push(Chart::new(heel - up * 0.05, heel + up * 0.05, 0.085).seam(-out));
    for (balls, _) in OPEN.iter().chain(&*FIST) {
        charts.push(Chart::new(balls[0].0, balls[1].0, 0.048));
        charts.push(Chart::new(balls[1].0, balls[2].0, 0.045));
    }
    for (side, step) in [(1.0, STEPS[0]), (-1.0, STEPS[1])] {
        let knee = dvec3(side * 0.28, 0.42, 0.04 + step);
        let ankle = dvec3(side * 0.3, 0.17, step);
        charts.push(Chart::new(knee, ankle, 0.16));
        let (way, _) = foot_axes(side);
        let heel = ankle - DVec3::Y * 0.09;
        charts.push(Chart::new(heel, heel + way * 0.17, 0.1).seam(DVec3::NEG_Y));
    }
    for (balls, _) in &*TOES {
        charts.push(Chart::new(balls[0].0, balls[2].0, 0.06).seam(DVec3::NEG_Y));
    }
    charts
}

/// What the nails are unrolled from.
pub(crate) fn nail_charts() -> Vec<Chart> {
    let digits = OPEN.iter().chain(&*FIST).chain(&*TOES);
    digits
        .map(|([_, middle, (tip, r)], out)| {
            let along = (*tip - middle.0).normalize();
            let from = *tip + *out * *r * 0.6;
            Chart::new(from, from + along * *r * 1.4, *r * 0.4).seam(-*out)
        })
        .collect()
}

/// What the bracers are unrolled from.
pub(crate) fn bracer_charts() -> Vec<Chart> {
    [LEFT_ARM, RIGHT_ARM].map(|[_, elbow, wrist]| Chart::new(elbow.0, wrist.0, 0.14)).to_vec()
}

/// A point of the head's space in the world.
pub(crate) fn on_head(x: f64, y: f64, z: f64) -> DVec3 {
    world_from_head(dvec3(x, y, z))
}

/// What the tusks and the small teeth are unrolled from.
pub(crate) fn tusk_charts() -> Vec<Chart> {
    [-1.0, 1.0]
        .into_iter()
        .flat_map(|side| {
            [
                Chart::new(on_head(side * 0.105, -0.24, 0.225), on_head(side * 0.13, -0.09, 0.265), 0.03),
                Chart::new(on_head(side * 0.04, -0.23, 0.262), on_head(side * 0.042, -0.17, 0.285), 0.018),
            ]
        })
        .collect()
}

/// What the strands of hair are unrolled from.
pub(crate) fn strand_charts() -> Vec<Chart> {
    let root = dvec3(0.0, 0.29, -0.075);
    let mut charts = vec![Chart::new(world_from_head(root - DVec3::Y * 0.07), world_from_head(root), 0.05)];
    charts.extend(ogre_head::STRANDS.map(|tip| {
        let from = world_from_head(root + tip * 0.35);
        Chart::new(from, world_from_head(root + tip), 0.035)
    }));
    charts
}

/// What the tie of the hair is unrolled from.
pub(crate) fn tie_chart() -> [Chart; 1] {
    let middle = dvec3(0.0, 0.315, -0.079);
    let up = DVec3::Y * 0.01;
    [Chart::new(world_from_head(middle - up), world_from_head(middle + up), 0.04)]
}

/// What the earring is unrolled from.
pub(crate) fn ring_chart() -> [Chart; 1] {
    let middle = ogre_head::EARRING;
    let along = dvec3(1.0, 0.0, -1.0) * 0.005;
    let chart = Chart::new(world_from_head(middle - along), world_from_head(middle + along), 0.045);
    [chart.seam(DVec3::Y)]
}

/// What the buckle is unrolled from.
pub(crate) fn buckle_chart() -> [Chart; 1] {
    let middle = *ogre_gear::BUCKLE;
    let along = DVec3::Z * 0.01;
    [Chart::new(middle - along, middle + along, 0.09).seam(DVec3::NEG_Y)]
}
