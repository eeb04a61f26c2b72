//! The edge map: for each pixel the edge that runs through it, its class and whose it is, before lines get their width.
//!
//! Exact mode is a hybrid. Silhouettes, borders, creases and material boundaries come from topology, as segments that
//! are tested against the G-buffer; what topology does not know (intersections, outlines of holes) is found where
//! neighboring pixels show different surfaces; details are found within surfaces. Image-space mode is the papers' operators. See `common/edge_map.wgsl`.

use super::gbuffer::GBuffer;
use super::operators::operator_edges;
use super::repeated::{NearerLines, SPINES, add_ink};
use super::segments::{MARKS, SegmentInputs, Segments};
use crate::geometry::EdgeClass;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{DepthRule, Inputs, Program, Recorder, Target, inputs};
use crate::render::base::edge_style::GpuEdgeStyle;
use crate::render::base::edge_styles::EdgeStylesBuffer;
use crate::render::base::error::RenderError;

pub(super) const EDGE_MAP: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The edge map, and of its lines what [`super::line_distance`] reads.
#[derive(Debug, Clone)]
pub struct EdgeMap {
    /// See `common/edge_map.wgsl`.
    pub edges: Target,
    /// Where spines of exact lines run and how wide they are; `None` without any.
    pub spines: Option<Target>,
    /// Whether ink of the papers' operators may be in it.
    pub has_operators: bool,
}

impl EdgeMap {
    /// Its lines, as those behind them see them.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn all_lines(&self, rec: &mut Recorder<'_>) -> Result<Target, RenderError> {
        let nearer = NearerLines::behind(rec, self.spines.clone())?;
        if self.has_operators {
            add_ink(rec, &self.edges, &nearer.before, &nearer.now)?;
        }
        Ok(nearer.now)
    }
}

/// What the edge map is made of.
#[derive(Clone, Copy)]
pub struct EdgeInputs<'a> {
    /// Per-pixel geometry.
    pub gbuffer: &'a GBuffer,
    /// The edge styles of its objects.
    pub styles: &'a [GpuEdgeStyle],
    /// The same on the device.
    pub edge_styles: &'a EdgeStylesBuffer,
    /// What topology knows, for the view of the G-buffer.
    pub segments: &'a Segments,
    /// Whether any material of an object with lines has holes.
    pub has_holes: bool,
    /// Whether what lies behind a mirror's plane is left out.
    pub is_clipped: bool,
    /// Of a depth layer the surface ids of the last one before it and of that before that: what goes on there has no outline
    /// where it leaves the layer. `None`: it has.
    pub before: Option<[&'a Target; 2]>,
    /// Which lights reach each pixel; `None` when no light throws shadows.
    pub shadow_mask: Option<&'a Target>,
    /// The lines of nearer layers, which are left out, and to which these are added; `None`: all are drawn.
    pub nearer: Option<&'a NearerLines>,
    /// The depth of the G-buffer only tells where it has anything, and has been marked so often; `None`: it is asked for.
    pub marked: Option<u32>,
}

/// Makes the edge map: exact edges first, then those of the papers' operators.
///
/// # Errors
/// [`RenderError`].
pub fn edge_map(rec: &mut Recorder<'_>, inputs: &EdgeInputs<'_>) -> Result<EdgeMap, RenderError> {
    let edge_map = rec.target("edge map", EDGE_MAP)?;
    let mut spines = None;
    let mut onto = Onto::Clear;
    if inputs.styles.iter().any(GpuEdgeStyle::is_exact) {
        spines = Some(exact_edges(rec, inputs, &edge_map)?);
        onto = Onto::Load;
    }
    let has_operators = inputs.styles.iter().any(GpuEdgeStyle::is_image_space);
    // Without exact edges it is this that clears the map.
    if onto == Onto::Clear || has_operators {
        operator_edges(rec, inputs.gbuffer, inputs.styles, inputs.edge_styles, &edge_map, onto)?;
        if let Some(NearerLines { before, now }) = inputs.nearer.filter(|_| has_operators) {
            // Where it had been seen before that stays so.
            add_ink(rec, &edge_map, spines.as_ref().unwrap_or(before), now)?;
        }
    }
    Ok(EdgeMap { edges: edge_map, spines, has_operators })
}

/// What lies within surfaces: borders of textures, of relief and of shadows.
fn find_details(
    rec: &mut Recorder<'_>,
    inputs: &EdgeInputs<'_>,
    mut switches: Vec<(&'static str, bool)>,
    found: &Inputs<'_>,
    outputs: &[&Target],
) -> Result<(), RenderError> {
    let EdgeInputs { gbuffer, styles, shadow_mask, .. } = *inputs;
    let [texture, relief, shadow] = [EdgeClass::Texture, EdgeClass::Relief, EdgeClass::Shadow]
        .map(|class| styles.iter().any(|s| s.is_exact() && s.draws(class)));
    let shadow = shadow && shadow_mask.is_some();
    if !texture && !relief && !shadow {
        return Ok(());
    }
    switches.extend([("WITH_TEXTURE", texture), ("WITH_RELIEF", relief), ("WITH_SHADOW", shadow)]);
    rec.draw(Draw {
        label: "details",
        program: Program { file: "passes/details.wgsl", entry_point: "fs_main", switches },
        inputs: &inputs! { base_color_tex: &gbuffer.base_color, shadow_mask_tex: shadow_mask }.and(found),
        outputs,
        onto: Onto::Load,
        depth: Some((&gbuffer.depth, DepthRule::Covered)),
    })?;
    Ok(())
}

fn exact_edges(
    rec: &mut Recorder<'_>,
    inputs: &EdgeInputs<'_>,
    edge_map: &Target,
) -> Result<Target, RenderError> {
    let EdgeInputs {
        gbuffer,
        styles,
        edge_styles,
        segments,
        has_holes,
        is_clipped,
        before,
        nearer,
        marked,
        ..
    } = *inputs;
    let any = |has: fn(&GpuEdgeStyle) -> bool| styles.iter().any(|s| s.is_exact() && has(s));
    let variation =
        [("WITH_VARIATION", any(GpuEdgeStyle::varies)), ("WITH_PRESSURE", any(|s| s.pressure > 0.0))];
    let with_angles = any(|s| s.by_angle > 0.0);
    let spines = rec.target("spines", SPINES)?;
    let marks = rec.target("marks of segments", MARKS)?;
    rec.clear("no lines", &[edge_map, &spines, &marks]);
    let switches: Vec<_> =
        [("WITH_HOLES", has_holes), ("WITH_ANGLES", with_angles)].into_iter().chain(variation).collect();
    let tested = SegmentInputs { gbuffer, edge_styles, switches: &switches };
    segments.put(rec, &tested, [edge_map, &spines, &marks], nearer)?;
    let outputs: Vec<_> = [edge_map, &spines].into_iter().chain(nearer.map(|nearer| &nearer.now)).collect();
    let without_repeated = ("WITHOUT_REPEATED", nearer.is_some());
    let found = inputs! {
        geometry_tex: &gbuffer.geometry,
        surface_id_tex: &gbuffer.surface_id,
        mark_tex: &marks,
        nearer_lines_tex: nearer.map(|nearer| &nearer.before),
    }
    .and(&edge_styles.inputs());
    let switches =
        [("WITH_CLIP_PLANE", is_clipped), ("WITH_LAYERS_BEFORE", before.is_some()), without_repeated]
            .into_iter()
            .chain(variation)
            .collect::<Vec<_>>();
    let details = variation.into_iter().chain([without_repeated]);
    find_details(rec, inputs, details.collect(), &found, &outputs)?;
    let (borders, rounds) = match marked {
        Some(rounds) => (gbuffer.depth.clone(), rounds),
        None => {
            let borders = rec.target("surface borders", DEPTH)?;
            rec.copy(&gbuffer.depth, &borders);
            (borders, 0)
        }
    };
    rec.draw(Draw {
        label: "discontinuities",
        program: Program { file: "passes/discontinuities.wgsl", entry_point: "fs_main", switches },
        inputs: &inputs! {
            before_tex: before.map(|[before, _]| before),
            before_that_tex: before.map(|[_, before_that]| before_that),
        }
        .and(&found),
        outputs: &outputs,
        onto: Onto::Load,
        depth: Some((&borders, DepthRule::CoveredWhere("fs_borders", rounds))),
    })?;
    Ok(spines)
}
