//! The final image.

use glam::Vec4;

use crate::gpu::{ArrayBuffer, Gpu, Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::scale_bar::ScaleBar;
use crate::render::base::stage::{Output, Stage};

/// What the window, PNG files and tests see: sRGB with straight alpha.
pub const FINAL: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The final image across frames.
pub struct Resolve {
    scale_bar: ArrayBuffer,
    stage: Stage<Key, Target>,
}

/// What it depends on.
#[derive(PartialEq)]
struct Key {
    shaders: u64,
    color: u64,
    background: Vec4,
    scale_bar: Option<ScaleBar>,
}

impl Resolve {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { scale_bar: ArrayBuffer::new(gpu, "scale bar"), stage: Stage::default() }
    }

    /// How often it ran.
    pub fn runs(&self) -> u64 {
        self.stage.runs()
    }

    /// Lets go of the last one.
    pub fn forget(&mut self) {
        self.stage.clear();
    }

    /// Lays the drawing over the paper (`background`, which bind group 0 holds), a scale bar over both, and applies the sRGB
    /// curve.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        color: &Output<Target>,
        background: Vec4,
        scale_bar: Option<&ScaleBar>,
    ) -> Result<Output<Target>, RenderError> {
        let shaders = rec.pipelines.generation();
        let key = Key { shaders, color: color.revision, background, scale_bar: scale_bar.cloned() };
        let Self { scale_bar, stage } = self;
        stage.run(key, |key| {
            let bar = key.scale_bar.as_ref().and_then(ScaleBar::uniform);
            if let Some(bar) = &bar {
                scale_bar.write(rec.gpu, bar);
            }
            let image = rec.target("final image", FINAL)?;
            let program = Program {
                file: "passes/resolve.wgsl",
                entry_point: "fs_main",
                switches: vec![("WITH_SCALE_BAR", bar.is_some())],
            };
            let inputs = inputs! {
                color_tex: &color.value,
                scale_bar: bar.is_some().then_some(&*scale_bar),
            };
            rec.fullscreen("resolve", program, &inputs, &[&image], None)?;
            Ok(image)
        })
    }
}
