//! Hidden lines: the surfaces are split into depth layers, and the lines of those behind the visible one are drawn over what
//! hides them, but not where a nearer line runs at the same place.
//!
//! ```text
//! surfaces ─► layers ─► edge map of each but the first ─► lines ─► with those of nearer layers ─► picture
//!                            ▲
//! visible edge map ──────────┘ no line twice
//! ```

use super::layered::{LayerRequest, Layered, LayeredGroup, LineRequest, Visit, min_pixels};
use crate::gpu::recorder::Onto;
use crate::gpu::{Gpu, Recorder, Target, inputs};
use crate::render::base::edge_style::GpuEdgeStyle;
use crate::render::base::edge_styles::EdgeStyles;
use crate::render::base::error::RenderError;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::base::group::Group;
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::render::passes::edge_map::EdgeMap;
use crate::render::passes::layers::Reported;
use crate::render::passes::lines::{LineShader, lines};
use crate::render::passes::traversal::GBufferPass;
use crate::style;

/// Which surfaces have hidden lines: nothing as long as none has.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Hidden {
    /// How hidden lines look.
    styles: EdgeStyles,
    /// By object id, how many layers behind the visible one have lines of it.
    depths: Vec<u32>,
    /// The least share of the picture, percent, that any of them asks for.
    least: f32,
}

/// Consecutive layers in which the same objects have lines.
struct Band {
    /// The last layer, from 1 on; 0 is the visible one.
    last: u32,
    /// Of the objects that have lines there.
    styles: EdgeStyles,
}

impl Hidden {
    /// Adds the hidden lines of an object, if it has any, in a scene with `count` object ids.
    pub fn add(&mut self, count: usize, id: u32, style: &GpuEdgeStyle, hidden: &style::Hidden) {
        if !style.is_exact() && !style.is_image_space() {
            return;
        }
        let least = hidden.min_coverage;
        self.least = if self.is_empty() { least } else { self.least.min(least) };
        if self.is_empty() {
            (self.styles, self.depths) = (EdgeStyles::new(count), vec![0; count]);
        }
        self.styles.set(id, style);
        self.depths[id as usize] = hidden.depth();
    }

    /// Whether no object has any.
    pub fn is_empty(&self) -> bool {
        self.depths.is_empty()
    }

    /// Greatest distance from its spine at which a line has ink, px.
    pub fn greatest_radius(&self) -> f32 {
        self.styles.greatest_radius()
    }

    fn bands(&self) -> Vec<Band> {
        let mut lasts: Vec<u32> = self.depths.iter().copied().filter(|depth| *depth > 0).collect();
        lasts.sort_unstable();
        lasts.dedup();
        let of =
            |last| Band { last, styles: self.styles.only(|object| self.depths[object as usize] >= last) };
        lasts.into_iter().map(of).collect()
    }
}

/// What the picture of hidden lines depends on.
#[derive(PartialEq)]
struct Key {
    layered: LayeredGroup,
    hidden: Hidden,
    visible: Option<u64>,
}

/// What of the drawing of hidden lines lives across frames.
pub struct HiddenLines {
    layered: Layered,
    stage: Stage<Key, Target>,
}

impl HiddenLines {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { layered: Layered::new(gpu), stage: Stage::default() }
    }

    /// What became of the last pictures; one that was incomplete is drawn again when it is asked for.
    pub fn take_reports(&mut self) -> Reported {
        let reported = self.layered.take_reports();
        if reported == Reported::Incomplete {
            self.stage.clear();
        }
        reported
    }

    /// How often they were drawn.
    pub fn runs(&self) -> u64 {
        self.stage.runs()
    }

    /// The hidden lines of all surfaces: linear color times opacity, and opacity. `visible`: the edges that are in sight.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer_pass: &mut GBufferPass,
        scene_view: &SceneView<'_>,
        uniform: &FrameUniform,
        surfaces: &Group,
        hidden: &Hidden,
        visible: Option<&Output<EdgeMap>>,
    ) -> Result<Output<Target>, RenderError> {
        let group = surfaces.unculled_with_lines(&hidden.styles);
        let asked = Key {
            layered: LayeredGroup::new(rec, scene_view, uniform, group),
            hidden: hidden.clone(),
            visible: visible.map(|edges| edges.revision),
        };
        let Self { layered, stage } = self;
        stage.run(asked, |asked| {
            let bands = hidden.bands();
            let color = rec.target("hidden lines", wgpu::TextureFormat::Rgba16Float)?;
            rec.clear("hidden lines", &[&color]);
            let visible = match visible {
                Some(edges) => Some(edges.value.all_lines(rec)?),
                None => None,
            };
            let any = |has: fn(&GpuEdgeStyle) -> bool| {
                bands.iter().any(|band| band.styles.styles().iter().any(has))
            };
            let line_styles: Vec<_> = bands.iter().map(|band| &band.styles).collect();
            let request = LayerRequest {
                max_layers: bands.last().map_or(0, |band| band.last) + 1,
                min_pixels: min_pixels(hidden.least, rec.size()),
                uncover: None,
                by: None,
                with_color: any(GpuEdgeStyle::reads_color),
                with_normals: any(GpuEdgeStyle::reads_normals),
                with_depth: false,
                line_styles: &line_styles,
                nearer: visible.as_ref(),
            };
            let mut before: Option<[Target; 2]> = None;
            layered.walk(
                rec,
                gbuffer_pass,
                scene_view,
                &asked.layered,
                &request,
                |rec, mut visit: Visit<'_>| {
                    let number = visit.drawn.number;
                    let surface_id = &visit.drawn.layer.gbuffer.surface_id;
                    let surface_ids = before.take();
                    let last = surface_ids.as_ref().map_or(surface_id, |[last, _]| last);
                    before = Some([surface_id.clone(), last.clone()]);
                    // The nearest layer is in sight.
                    let band = bands.iter().position(|band| band.last >= number).filter(|_| number > 0);
                    let Some(style) = band else { return Ok(()) };
                    let before = surface_ids.as_ref().map(|[last, before_that]| [last, before_that]);
                    let request = LineRequest { style, before, ..LineRequest::default() };
                    let Some(edges) = visit.edges(rec, request)? else { return Ok(()) };
                    let Some(drawn) = visit.lines(&edges, style) else { return Ok(()) };
                    let shader = LineShader {
                        file: "effects/hidden.wgsl",
                        entry_point: "fs_lines",
                        inputs: &inputs! { nearer_lines_tex: edges.nearer.as_ref() },
                        switches: &[],
                        // Lines of several layers that run over each other are one ink.
                        onto: Onto::Max,
                    };
                    lines(rec, &drawn, &shader, &color)
                },
            )?;
            Ok(color)
        })
    }
}
