//! Debug views: looks at the buffers that a picture is made from, of any depth layer (blueprints paper, Fig. 4).

use glam::Vec2;

use super::base::error::RenderError;
use super::base::stage::{Output, Stage};
use super::drawing::{Drawing, DrawingInputs, DrawnSurfaces, Shared};
use super::effects::layered::{LayerRequest, Layered, LayeredGroup, LineRequest, Visit};
use super::passes::front::Front;
use super::passes::gbuffer::GBuffer;
use super::passes::operators::operators;
use super::passes::show::{Shown, show};
use crate::document::{LayersBy, Show};
use crate::gpu::{Gpu, GpuError, Recorder, Target};

/// Which buffer is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DebugView {
    /// The buffer.
    pub show: Show,
    /// The depth layer that it is of, from 1; 1: the nearest.
    pub layer: u32,
}

/// A look at a buffer.
pub struct Viewed {
    /// The image.
    pub image: Output<Target>,
    /// What is in front, and what changes when it does.
    pub front: (Front, Vec<u64>),
}

/// What of the views lives across frames.
pub struct DebugViews {
    layered: Layered,
    layer: Stage<(LayeredGroup, u32), (GBuffer, Target)>,
    operators: Stage<(u64, u32, Vec2), Target>,
    image: Stage<ImageKey, Target>,
}

/// What the image depends on.
#[derive(PartialEq)]
struct ImageKey {
    shaders: u64,
    view: DebugView,
    gbuffer: u64,
    edges: u64,
    operators: Option<u64>,
}

impl DebugViews {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            layered: Layered::new(gpu),
            layer: Stage::default(),
            operators: Stage::default(),
            image: Stage::default(),
        }
    }

    /// How often an image was drawn.
    pub fn runs(&self) -> u64 {
        self.image.runs()
    }

    /// Lets go of the last one.
    pub fn forget(&mut self) {
        self.layer.clear();
        self.operators.clear();
        self.image.clear();
    }

    /// Draws one buffer as an image.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn draw(
        &mut self,
        rec: &mut Recorder<'_>,
        drawing: &mut Drawing,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        view: DebugView,
    ) -> Result<Viewed, RenderError> {
        drawing.forget_picture();
        let drawn = drawing.draw_surfaces(rec, shared, inputs)?;
        let edges = drawing.find_edges(rec, inputs, &drawn)?;
        rec.note("edge map", Some(&edges.value.edges));
        let visible = &drawn.surfaces.gbuffer;
        let deeper = if view.layer > 1 {
            Some(self.layer(rec, shared, inputs, &drawn, view.layer)?)
        } else {
            self.layer.clear();
            None
        };
        let (gbuffer, edge_map, revision) = match &deeper {
            Some(Output { value: (gbuffer, edge_map), revision }) => (gbuffer, edge_map, *revision),
            None => (&visible.value, &edges.value.edges, visible.revision),
        };
        let operators = match view.show {
            Show::NormalOperator | Show::DepthOperator | Show::C1Operator => {
                let key = (revision, view.layer, drawn.uniform.depth_range());
                Some(self.operators.run(key, |_| operators(rec, gbuffer, drawing.edge_styles()))?)
            }
            _ => {
                self.operators.clear();
                None
            }
        };
        rec.note("operators", operators.as_ref().map(|operators| &operators.value));
        let key = ImageKey {
            shaders: rec.pipelines.generation(),
            view,
            gbuffer: revision,
            edges: edges.revision,
            operators: operators.as_ref().map(|operators| operators.revision),
        };
        let image = self.image.run(key, |_| {
            let operators = operators.as_ref().map(|operators| &operators.value);
            show(rec, view.show, Shown { gbuffer, edge_map, operators })
        })?;
        let front = Front { surfaces: visible.value.geometry.clone(), layers: Vec::new() };
        Ok(Viewed { image, front: (front, vec![visible.revision]) })
    }

    /// The layer of that number and its edge map; both empty behind the last one.
    fn layer(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        drawn: &DrawnSurfaces,
        number: u32,
    ) -> Result<Output<(GBuffer, Target)>, RenderError> {
        let mut group = inputs.objects.surfaces.clone();
        group.is_unculled = true;
        let key = LayeredGroup::new(rec, &inputs.scene_view, &drawn.uniform, group);
        let Self { layered, layer, .. } = self;
        layer.run((key, number), |(key, _)| {
            let request = LayerRequest {
                max_layers: number,
                min_pixels: 1,
                uncover: None,
                // It cannot run out of room, which nobody would hear of.
                by: Some(LayersBy::Peeling),
                with_color: true,
                with_normals: true,
                with_depth: true,
                line_styles: &[&key.group.edge_styles],
                nearer: None,
            };
            let mut found = None;
            // A layer that has ended is empty, and nobody waits for the report about it.
            layered.walk(
                rec,
                &mut shared.gbuffer,
                &inputs.scene_view,
                key,
                &request,
                |rec, mut visit: Visit<'_>| {
                    if visit.drawn.number + 1 < number {
                        return Ok(());
                    }
                    let request = LineRequest { repeated: true, ..LineRequest::default() };
                    let edges = visit.edges(rec, request)?;
                    let gbuffer = visit.drawn.layer.gbuffer.clone();
                    found = edges.map(|edges| (gbuffer, edges.edge_map.edges));
                    Ok(())
                },
            )?;
            found.ok_or_else(|| GpuError::Lost("no layer".to_owned()).into())
        })
    }
}
