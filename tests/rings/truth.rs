//! What a picture must be, composed from what rays meet, and whether it is.

use glam::DVec4;
use hachure::export::Session;
use hachure::scene::NodeId;

use super::alone::{Shot, Step};
use super::picture::{Picture, encoded, encoded_share, over};
use super::rays::{near, pixels};

/// How far colors may be from what they must be, 255ths: those of rings alone are rounded.
const TOLERANCE: f64 = 2.0;

/// What is known of a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Expected {
    /// There may be lines.
    Unknown,
    /// That there is nothing.
    Nothing,
    /// Everything.
    Exactly(DVec4),
    /// What lies in front, and that anything may lie beneath it.
    Above(DVec4),
}

/// How many pixels were compared, and how many of them are wrong.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tally {
    pub compared: usize,
    pub wrong: usize,
}

/// The picture that steps make.
pub fn composed(steps: &[Step]) -> DVec4 {
    steps.iter().fold(DVec4::ZERO, |front, step| over(front, step.color))
}

fn is_same((a, b): &(&Step, &Step)) -> bool {
    a.node == b.node
}

/// How many of the first steps of a pixel all others near it have too, and whether none of them has more.
pub fn common(steps: &[Vec<Step>], px: usize) -> (usize, bool) {
    let own = &steps[px];
    let (mut count, mut is_all) = (own.len(), true);
    for q in near(px) {
        let same = own.iter().zip(&steps[q]).take_while(is_same).count();
        count = count.min(same);
        is_all &= same == own.len() && same == steps[q].len();
    }
    (count, is_all)
}

/// What the picture of some rings must be.
pub fn truth(session: &mut Session, shot: &mut Shot<'_>, company: &[NodeId]) -> Vec<Expected> {
    let steps = shot.steps(session, company);
    (0..pixels())
        .map(|px| {
            let own = &steps[px];
            let (count, is_all) = common(&steps, px);
            // Where a ring's own edges are near, it is not known which of its surfaces are.
            let known = own[..count].iter().take_while(|step| shot.cast(step.node).is_steady[px]).count();
            match known {
                _ if is_all && own.is_empty() => Expected::Nothing,
                _ if is_all && known == own.len() => Expected::Exactly(composed(own)),
                0 => Expected::Unknown,
                _ => Expected::Above(composed(&own[..known])),
            }
        })
        .collect()
}

impl Expected {
    /// Whether a pixel is what it must be; `None` where nothing is known or nothing must be.
    pub fn is_met(self, picture: &Picture, px: usize) -> Option<bool> {
        let drawn = picture.colors[px];
        match self {
            Self::Unknown => None,
            Self::Exactly(color) | Self::Above(color) if color.is_nan() => None,
            Self::Nothing => (drawn.w > 0.0).then_some(false),
            // A color that is not there is none.
            Self::Exactly(color) if color.w == 0.0 => Some(drawn.w == 0.0),
            Self::Exactly(color) => {
                let apart = (encoded(drawn) - encoded(color)).abs().max_element();
                Some(apart <= TOLERANCE)
            }
            Self::Above(color) => {
                let most = color + DVec4::splat(1.0 - color.w);
                let is_within = (encoded_share(drawn) - encoded_share(color)).min_element() >= -TOLERANCE
                    && (encoded_share(most) - encoded_share(drawn)).min_element() >= -TOLERANCE;
                Some(is_within)
            }
        }
    }
}

/// How many pixels are what they must be: those of which everything is known, and the others.
pub fn tallies(expected: &[Expected], picture: &Picture) -> [Tally; 2] {
    let mut tallies = [Tally::default(); 2];
    for (px, expected) in expected.iter().enumerate() {
        if let Some(is_met) = expected.is_met(picture, px) {
            let tally = &mut tallies[usize::from(matches!(expected, Expected::Above(_)))];
            tally.compared += 1;
            tally.wrong += usize::from(!is_met);
        }
    }
    tallies
}
