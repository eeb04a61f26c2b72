//! The mean of all samples of a picture.

use crate::document::Document;
use crate::gpu::{Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::sample::Sample;
use crate::render::base::stage::Output;
use crate::scene::Camera;

/// Wide enough for a thousand samples.
const MEAN: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// All that the samples of one picture have in common. Where any of it differs, a new picture begins.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// Changes when shaders do.
    pub shaders: u64,
    /// Changes when the scene does.
    pub scene_revision: u64,
    /// Styles, lights and view.
    pub document: Document,
    /// The camera.
    pub camera: Camera,
    /// Size of the picture in pixels.
    pub size: [u32; 2],
    /// Whether it has one sample only: strokes of hatching are crisp then.
    pub is_single: bool,
    /// How often a sample turned out to be incomplete: none of those has a part in it.
    pub incomplete: u64,
}

/// The samples that have been drawn of one subject. Only colors are averaged: ids, depths and strengths of edges are
/// those of one sample.
#[derive(Debug, Clone, Default)]
pub struct Accumulation {
    subject: Option<Subject>,
    /// How many there are, and their mean.
    mean: Option<(u32, Output<Target>)>,
}

impl Accumulation {
    /// The sample to draw next, or again if the picture is complete: the first one, unless it goes on with the last
    /// subject.
    pub fn next(&mut self, subject: Subject, of: u32) -> Sample {
        let drawn = self.mean.as_ref().map_or(0, |(count, _)| *count);
        if drawn > of || self.subject.as_ref() != Some(&subject) {
            *self = Self { subject: Some(subject), mean: None };
            return Sample { index: 0, of };
        }
        Sample { index: drawn.min(of.saturating_sub(1)), of }
    }

    /// Adds the color (linear, times opacity) of a sample that [`Self::next`] gave; returns the mean of all.
    ///
    /// # Errors
    /// [`RenderError`]; nothing is then added.
    pub fn add(
        &mut self,
        rec: &mut Recorder<'_>,
        sample: Sample,
        color: Output<Target>,
    ) -> Result<Output<Target>, RenderError> {
        let mean = match &self.mean {
            Some((count, mean)) if sample.index < *count => return Ok(mean.clone()),
            Some((_, mean)) => Output { value: averaged(rec, &mean.value, &color.value)?, ..color },
            None => color,
        };
        self.mean = Some((sample.index + 1, mean.clone()));
        Ok(mean)
    }
}

fn averaged(rec: &mut Recorder<'_>, mean: &Target, color: &Target) -> Result<Target, RenderError> {
    let out = rec.target("mean", MEAN)?;
    rec.fullscreen(
        "accumulate",
        Program::new("passes/accumulate.wgsl", "fs_main"),
        &inputs! { mean_tex: mean, color_tex: color },
        &[&out],
        None,
    )?;
    Ok(out)
}
