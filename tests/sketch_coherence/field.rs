//! How much offsets at places on lines change from picture to picture, beside other fields of the same waves.

use glam::{DVec2, DVec3, Mat4, Vec2, Vec3};
use hachure::export::Session;
use hachure::render::passes::offset_field::{FieldUniform, GpuFieldObject, NoisePlace};
use rayon::prelude::*;

use super::model::{Anchor, Eye, Model, SIDE, Spot};
use super::paths::{Length, Path, runs};

/// Fields that are compared.
pub(crate) const KINDS: usize = 4;
/// What moves with the surface: the renderer's own.
pub(crate) const SURFACE: usize = 0;
/// What stays on the paper.
pub(crate) const SCREEN: usize = 1;
/// What the surface had in the first picture.
pub(crate) const LOCKED: usize = 2;
/// What a texture on the surface would be.
pub(crate) const MAP: usize = 3;

/// Mean change of a field from picture to picture, and its mean square, by kind.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sums {
    change: [f64; KINDS],
    square: [f64; KINDS],
    count: [f64; KINDS],
}

impl Sums {
    /// 1: does not change, 0: as much as what stays on the paper.
    pub(crate) fn coherence(&self, kind: usize) -> Option<f64> {
        let mean = |kind: usize| self.change[kind] / self.count[kind];
        (self.count[kind] > 0.0).then(|| 1.0 - mean(kind) / mean(SCREEN))
    }

    /// Root of the mean square of each component.
    pub(crate) fn rms(&self, kind: usize) -> f64 {
        (0.5 * self.square[kind] / self.count[kind]).sqrt()
    }

    pub(crate) fn add(&mut self, kind: usize, before: Vec2, after: Vec2) {
        self.change[kind] += f64::from(before.distance(after));
        self.square[kind] += f64::from(after.length_squared());
        self.count[kind] += 1.0;
    }

    pub(crate) fn plus(mut self, other: &Self) -> Self {
        for kind in 0..KINDS {
            self.change[kind] += other.change[kind];
            self.square[kind] += other.square[kind];
            self.count[kind] += other.count[kind];
        }
        self
    }
}

/// What was found on a path.
pub(crate) struct Walked {
    /// By recipe, all seeds together.
    pub(crate) sums: Vec<Sums>,
    /// By recipe, and by step: all seeds together.
    pub(crate) steps: Vec<Vec<Sums>>,
    /// How much larger a texture gets on the way.
    pub(crate) map_growth: Option<f64>,
}

/// Walks a path with several recipes, each of several seeds, at places on lines so many pixels apart.
pub(crate) fn walk(
    session: &mut Session,
    model: &Model,
    (path, target, length): (Path, DVec3, Length),
    recipes: &[Vec<FieldUniform>],
    apart: f64,
) -> Walked {
    let runs: Vec<Vec<Eye>> = runs(model, path, target, length)
        .into_iter()
        .map(|run| run.into_iter().map(|camera| Eye::new(session, camera, SIDE)).collect())
        .collect();
    let count = model.opened.scene.nodes.len() as u32;
    let scales =
        |eye: &Eye| -> Vec<Option<f64>> { (1..=count).map(|object| model.map_scale(eye, object)).collect() };
    let first = scales(&runs[0][0]);
    let last = scales(runs.last().unwrap().last().unwrap());
    let mut growth: Vec<f64> =
        first.iter().zip(&last).filter_map(|(a, b)| Some(b.as_ref()? / a.as_ref()?)).collect();
    growth.sort_by(f64::total_cmp);
    let mut steps = vec![Vec::new(); recipes.len()];
    for run in &runs {
        let anchors = model.anchors(&run[0], apart);
        let spots: Vec<Vec<Option<Spot>>> =
            run.iter().map(|eye| anchors.iter().map(|a| eye.spot(a.world, a.along)).collect()).collect();
        for (recipe, steps) in recipes.iter().zip(&mut steps) {
            for i in 1..run.len() {
                let pair = Pair { eyes: [&run[0], &run[i - 1], &run[i]] };
                let sums = anchors.par_iter().enumerate().map(|(number, anchor)| {
                    let spots = [0, i - 1, i].map(|at| spots[at][number]);
                    let mut sums = Sums::default();
                    if let [Some(a), Some(b), Some(c)] = spots {
                        let scale = first[anchor.object as usize - 1];
                        for field in recipe {
                            pair.compare(field, anchor, [a, b, c], scale, &mut sums);
                        }
                    }
                    sums
                });
                steps.push(sums.reduce(Sums::default, |a, b| a.plus(&b)));
            }
        }
    }
    let sums =
        steps.iter().map(|steps| steps.iter().fold(Sums::default(), |all, step| all.plus(step))).collect();
    Walked { sums, steps, map_growth: growth.get(growth.len() / 2).copied() }
}

/// Two pictures after the first one of a run.
struct Pair<'a> {
    /// The first one, and these.
    eyes: [&'a Eye; 3],
}

impl Pair<'_> {
    fn compare(
        &self,
        field: &FieldUniform,
        anchor: &Anchor,
        [first, before, after]: [Spot; 3],
        map_scale: Option<f64>,
        sums: &mut Sums,
    ) {
        let object = |eye: &Eye| *eye.object(anchor.object);
        let [_, eye_before, eye_after] = self.eyes.map(object);
        let surface = |object: &GpuFieldObject, spot: &Spot| field.line_noise(object, &spot.place, 0);
        sums.add(SURFACE, surface(&eye_before, &before), surface(&eye_after, &after));
        // The place as it is found now, the wave as it was.
        let locked = |object: &GpuFieldObject, spot: &Spot| {
            let place = NoisePlace {
                pixel: first.place.pixel,
                foreshortening: first.place.foreshortening,
                ..spot.place
            };
            field.line_noise(object, &place, 0)
        };
        sums.add(LOCKED, locked(&eye_before, &before), locked(&eye_after, &after));
        let paper = |at| on_paper(field, anchor.object, at);
        sums.add(SCREEN, paper(before.pixel), paper(after.pixel));
        if let Some((uv, scale)) = anchor.on_map.zip(map_scale) {
            let here = paper(uv * scale);
            sums.add(MAP, here, here);
        }
    }
}

/// The same waves at a place in the picture.
pub(crate) fn on_paper(field: &FieldUniform, object: u32, at: DVec2) -> Vec2 {
    let at = at.as_vec2();
    // A slice through the same noise.
    let place = NoisePlace { at: Vec3::new(at.x, at.y, 333.3), pixel: 1.0, foreshortening: 1.0 };
    field.line_noise(&GpuFieldObject { from_view: Mat4::IDENTITY, seed: object }, &place, 0)
}
