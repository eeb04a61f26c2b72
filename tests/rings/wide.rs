//! What a picture must be where one ring has lines so wide that they reach far beyond its outline.

use glam::DVec4;
use hachure::export::Session;
use hachure::scene::NodeId;

use super::alone::{Shot, Step};
use super::picture::over;
use super::rays::{disk, near, pixels};
use super::truth::{Expected, composed};

/// Half of the width of the lines, px.
pub const RADIUS: i32 = 6;

/// How far the depth of a line may be from that of the surface that is seen beside it, scene units.
const SLACK: f64 = 0.12;

/// Where in depth the lines around a pixel are: that of all that is seen of the ring as far as they reach.
fn depths(shot: &Shot<'_>, node: NodeId, px: usize) -> Option<[f64; 2]> {
    let hits = &shot.cast(node).hits;
    let reach = RADIUS + 2;
    let seen = disk(px, reach, reach * reach).filter_map(|q| hits[q].first());
    let range = seen.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], hit| {
        [least.min(hit.depth), most.max(hit.depth)]
    });
    (range[0] <= range[1]).then_some([range[0] - SLACK, range[1] + SLACK])
}

/// The truth where a ring with wide lines, `inked`, is among others: its picture alone lies between what is nearer and what
/// is farther than all of its lines around.
pub fn truth(
    session: &mut Session,
    shot: &mut Shot<'_>,
    inked: NodeId,
    others: &[NodeId],
    alone: &[DVec4],
) -> Vec<Expected> {
    let steps = shot.steps(session, others);
    (0..pixels()).map(|px| expected(shot, inked, &steps, px, alone)).collect()
}

fn expected(shot: &Shot<'_>, inked: NodeId, steps: &[Vec<Step>], px: usize, alone: &[DVec4]) -> Expected {
    let Some([nearest, farthest]) = depths(shot, inked, px).filter(|_| alone[px].w > 0.0) else {
        return Expected::Unknown;
    };
    let before = |q: usize| steps[q].iter().take_while(move |step| step.depth < nearest);
    let front: Vec<Step> = before(px).copied().collect();
    let is_apart = |q: usize| steps[q].iter().all(|step| !(nearest..=farthest).contains(&step.depth));
    let has_edges = |steps: &[Step]| steps.iter().any(|step| !shot.cast(step.node).is_steady[px]);
    let differs = |q: usize| !before(q).map(|step| step.node).eq(front.iter().map(|step| step.node));
    if !near(px).all(is_apart) || has_edges(&front) || near(px).any(differs) {
        return Expected::Unknown;
    }
    if front.last().is_some_and(|step| step.hides) {
        return Expected::Exactly(composed(&front));
    }
    // A line whose edge is hidden is not drawn, not even beside what hides it.
    let reach = RADIUS + 2;
    let hides = |step: &Step| step.hides && step.depth < farthest;
    if disk(px, reach, reach * reach).any(|q| steps[q].iter().any(hides)) {
        return Expected::Unknown;
    }
    // The rim of a line is as soft as what makes it says.
    let is_inked = disk(px, 1, 2).all(|q| alone[q].w > 0.999);
    match front.len() {
        _ if is_inked => Expected::Exactly(over(composed(&front), alone[px])),
        0 => Expected::Unknown,
        _ => Expected::Above(composed(&front)),
    }
}
