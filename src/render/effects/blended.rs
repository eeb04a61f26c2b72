//! Materials that blend, in the surface techniques: their parts are split into depth layers, and each is shaded as surfaces are and
//! placed with its lines, so that the order of objects does not matter.

use super::layered::{LayerRequest, Layered, LayeredGroup, LineRequest, Visit};
use super::surface::{Look, Shading};
use super::technique::Shaded;
use super::techniques::SharedTechniques;
use crate::gpu::{Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::scene_view::SceneView;
use crate::render::passes::composition::Composition;
use crate::render::passes::place::{LayerShader, Pending, Place};
use crate::render::passes::shadows::{ShadowMap, ShadowMask};
use crate::render::passes::traversal::GBufferPass;

/// Most layers that are composited: beneath so many nothing can be told apart.
const MAX_BLENDED: u32 = 16;

/// What blended layers are shaded with, which surfaces are shaded with too.
pub struct BlendedShading<'a> {
    /// How objects look.
    pub look: &'a Look,
    /// Shades layers.
    pub shading: &'a mut Shading,
    /// What all drawings share.
    pub shared: &'a mut SharedTechniques,
    /// Finds the shadows on layers.
    pub shadow_mask: &'a mut ShadowMask,
    /// The maps of the lights that throw shadows.
    pub shadow_maps: &'a [ShadowMap],
}

/// Places the layers of what blends; returns the geometry of the first one.
///
/// # Errors
/// [`RenderError`].
pub fn place_blended(
    rec: &mut Recorder<'_>,
    gbuffer_pass: &mut GBufferPass,
    layered: &mut Layered,
    key: &LayeredGroup,
    scene_view: &SceneView<'_>,
    composition: &Composition,
    with: &mut BlendedShading<'_>,
    place: &mut Place<'_>,
) -> Result<Option<Target>, RenderError> {
    let request = LayerRequest {
        max_layers: MAX_BLENDED,
        min_pixels: 1,
        uncover: None,
        by: None,
        with_color: true,
        with_normals: true,
        with_depth: true,
        line_styles: &[&key.group.edge_styles],
        nearer: None,
    };
    let mut front = None;
    layered.walk(rec, gbuffer_pass, scene_view, key, &request, |rec, mut visit: Visit<'_>| {
        let drawn = visit.drawn;
        let gbuffer = &drawn.layer.gbuffer;
        front.get_or_insert_with(|| gbuffer.geometry.clone());
        let mask = with.shadow_mask.of_layer(rec, gbuffer, scene_view, with.shadow_maps)?;
        let layer = Shaded {
            gbuffer,
            revision: None,
            shadow_mask: mask.as_ref().map(|mask| (mask, 0)),
            spines: None,
            scene_view: *scene_view,
            uniform: &key.uniform,
            instance_buffer: drawn.instance_buffer,
            instances: &key.instances,
            calls: &key.calls,
        };
        let shaded = with.shading.shade(rec, with.shared, with.look, &layer, true)?;
        let mut tested = composition.tested().and(&inputs! { shaded_tex: &shaded });
        let switches = composition.switches();
        let mut pending = Pending::default();
        if key.group.have_lines()
            && let Some(edges) = visit.edges(rec, LineRequest::default())?
            && let Some(lines) = visit.lines(&edges, 0)
        {
            let switches = [&[("AMONG_OTHERS", true)][..], &switches].concat();
            let inputs = tested.clone().and(&inputs! { nearer_lines_tex: edges.nearer.as_ref() });
            let shader = LayerShader { file: "effects/blended.wgsl", inputs: &inputs, switches: &switches };
            place.lines(rec, &mut pending, &lines, shader)?;
        }
        tested.set("geometry_tex", &gbuffer.geometry);
        let shader = LayerShader { file: "effects/blended.wgsl", inputs: &tested, switches: &switches };
        place.fill(rec, &mut pending, drawn.layer, shader)?;
        place.end(rec, &pending)
    })?;
    Ok(front)
}
