//! Hidden lines: the surfaces are cut into depth layers, and the lines of those behind the visible one are drawn over what
//! hides them, but not where a nearer line runs at the same place.
//!
//! ```text
//! surfaces ─► layers ─► edge map of each but the first ─► lines ─► beneath those of nearer layers ─► picture
//!                            ▲
//! visible edge map ──────────┘ no line twice
//! ```

use crate::document::LayersBy;
use crate::gpu::recorder::Onto;
use crate::gpu::{Gpu, Recorder, Target, inputs};
use crate::render::RenderError;
use crate::render::drawing::DrawingInputs;
use crate::render::frame_uniform::FrameUniform;
use crate::render::layers::{LayerInputs, LayerLines, LayerLinesInputs, Layers, Reported};
use crate::render::passes::edge_map::EdgeMap;
use crate::render::passes::edge_style::EdgeUniform;
use crate::render::passes::gbuffer::GBufferPass;
use crate::render::passes::instances::{DrawCall, Instance};
use crate::render::passes::lines::{Pen, lines};
use crate::render::passes::peel::{MOST_LAYERS, PeelCount};
use crate::render::passes::repeated::seen_lines;
use crate::render::passes::segments::Segments;
use crate::render::segments::segments;
use crate::render::stage::{Output, Stage};
use crate::style;

/// Which surfaces have hidden lines: nothing as long as none has.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Hidden {
    /// By object id, how its hidden lines look.
    styles: Vec<EdgeUniform>,
    /// By object id, how many layers behind the visible one have lines of it.
    depths: Vec<u32>,
    /// The least share of the picture, percent, that any of them asks for.
    least: f32,
}

/// Consecutive layers in which the same objects have lines.
struct Band {
    /// The last layer, from 1 on; 0 is the visible one.
    last: u32,
    /// By object id.
    styles: Vec<EdgeUniform>,
}

impl Hidden {
    /// Adds the hidden lines of an object, if it has any, in a scene with `count` object ids.
    pub fn add(&mut self, (count, id): (usize, usize), style: EdgeUniform, hidden: &style::Hidden) {
        if !style.is_exact() && !style.is_paper() {
            return;
        }
        let least = hidden.least.clamp(0.0, 100.0);
        self.least = if self.styles.is_empty() { least } else { self.least.min(least) };
        self.styles.resize(count, EdgeUniform::default());
        self.depths.resize(count, 0);
        self.styles[id] = style;
        self.depths[id] = hidden.depth();
    }

    /// Whether no object has any.
    pub fn is_empty(&self) -> bool {
        self.styles.is_empty()
    }

    /// Greatest distance from its spine at which a line has ink, px.
    pub fn greatest_radius(&self) -> f32 {
        self.styles.iter().map(EdgeUniform::greatest_radius).fold(0.0, f32::max)
    }

    fn bands(&self) -> Vec<Band> {
        let mut lasts: Vec<u32> = self.depths.iter().copied().filter(|depth| *depth > 0).collect();
        lasts.sort_unstable();
        lasts.dedup();
        let of = |last: u32| {
            let has_lines = self.styles.iter().zip(&self.depths);
            let styles =
                has_lines.map(|(style, depth)| if *depth >= last { *style } else { EdgeUniform::default() });
            Band { last, styles: styles.collect() }
        };
        lasts.into_iter().map(of).collect()
    }

    /// A layer of fewer pixels ends them: an empty one at the latest.
    fn least(&self, [width, height]: [u32; 2]) -> u32 {
        let share = f64::from(self.least) / 100.0;
        ((share * f64::from(width) * f64::from(height)).ceil() as u32).max(1)
    }
}

/// What the picture of hidden lines depends on.
#[derive(PartialEq)]
struct Inputs {
    shaders: u64,
    scene_revision: u64,
    hidden: Hidden,
    visible: Option<u64>,
    draws: Vec<Instance>,
    calls: Vec<DrawCall>,
    uniform: FrameUniform,
    part: Option<[u32; 4]>,
    crease_angle: f32,
    layers_by: LayersBy,
}

/// What of the drawing of hidden lines lives across frames.
pub struct HiddenLines {
    layers: Layers,
    /// By band.
    lines: Vec<LayerLines>,
    segments: Segments,
    stage: Stage<Inputs, Target>,
}

impl HiddenLines {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            layers: Layers::new(gpu),
            lines: Vec::new(),
            segments: Segments::new(gpu),
            stage: Stage::default(),
        }
    }

    /// What became of the last pictures; one that was incomplete is drawn again when it is asked for.
    pub fn take_reports(&mut self) -> Reported {
        let reported = self.layers.take_reports();
        if reported == Reported::Incomplete {
            self.stage.clear();
        }
        reported
    }

    /// How often they were drawn.
    pub fn runs(&self) -> u64 {
        self.stage.runs()
    }

    /// How far peeling came in the last picture; the visible layer counts.
    pub fn count(&self) -> &PeelCount {
        self.layers.count()
    }

    /// The hidden lines of all surfaces: linear colour times opacity, and opacity. `visible`: the edges that are in sight.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        inputs: &DrawingInputs<'_>,
        uniform: &FrameUniform,
        visible: Option<&Output<EdgeMap>>,
    ) -> Result<Output<Target>, RenderError> {
        let hidden = &inputs.objects.hidden;
        let group = inputs.objects.surfaces.with_hidden_lines(&hidden.styles);
        let (draws, calls) = group.draws(inputs.scene, inputs.view);
        let asked = Inputs {
            shaders: rec.pipelines.generation(),
            scene_revision: inputs.scene_revision,
            hidden: hidden.clone(),
            visible: visible.map(|edges| edges.revision),
            draws,
            calls,
            uniform: uniform.without_background(),
            part: inputs.view.part,
            crease_angle: inputs.crease_angle,
            layers_by: inputs.layers_by,
        };
        let Self { layers, lines: band_lines, segments: placed, stage } = self;
        stage.run(asked, |asked| {
            let bands = hidden.bands();
            band_lines.resize_with(bands.len(), || LayerLines::new(rec.gpu));
            for (lines, band) in band_lines.iter_mut().zip(&bands) {
                lines.begin(rec.gpu, &band.styles);
            }
            let view = inputs.view.moved(glam::Vec2::ZERO);
            placed.write(rec, &segments(inputs.scene, &group, &view, inputs.crease_angle), true)?;
            let color = rec.target("hidden lines", wgpu::TextureFormat::Rgba16Float)?;
            rec.clear("hidden lines", &[&color]);
            let mut seen = match visible {
                Some(edges) => Some(seen_lines(rec, &edges.value)?),
                None => None,
            };
            let any = |has: fn(&EdgeUniform) -> bool| bands.iter().any(|band| band.styles.iter().any(has));
            let cut = LayerInputs {
                scene: inputs.scene,
                draws: &asked.draws,
                calls: &asked.calls,
                is_cut: inputs.view.has_cuts(),
                most: bands.last().map_or(0, |band| band.last) + 1,
                least: hidden.least(rec.size()),
                mask: None,
                fraction: 1.0,
                by: inputs.layers_by,
                with_color: any(EdgeUniform::reads_color),
                with_normals: any(EdgeUniform::reads_normals),
                with_depth: false,
                whole: if any(EdgeUniform::compares_geometry) { MOST_LAYERS } else { 0 },
            };
            let mut before: Option<[Target; 2]> = None;
            layers.each(rec, gbuffer_pass, &cut, |rec, number, layer, _| {
                let regions = before.take();
                let last = regions.as_ref().map_or(&layer.gbuffer.region, |[last, _]| last);
                before = Some([layer.gbuffer.region.clone(), last.clone()]);
                let band = bands.iter().zip(band_lines.iter_mut()).find(|(band, _)| band.last >= number);
                // The nearest layer is in sight.
                let Some((band, band_lines)) = band.filter(|_| number > 0) else { return Ok(()) };
                let edges = LayerLinesInputs {
                    styles: &band.styles,
                    is_whole: false,
                    segments: placed,
                    has_holes: group.has_holes,
                    is_cut: inputs.view.cut.is_some(),
                    before: regions.as_ref().map(|[last, before_that]| [last, before_that]),
                    repeated: false,
                };
                let found = band_lines.edges(rec, &edges, layer, &mut seen)?;
                let pen = Pen {
                    file: "effects/hidden.wgsl",
                    entry_point: "fs_lines",
                    inputs: &inputs! { seen_tex: found.nearer.as_ref() },
                    switches: &[],
                    onto: Onto::Beneath,
                };
                lines(rec, &found.lines(layer, band_lines, edges.styles), &pen, &color)
            })?;
            Ok(color)
        })
    }
}
