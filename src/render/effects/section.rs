//! Caps of a section: flat color and hatching over the shaded surfaces, and in the layers of blueprints.

use encase::ShaderType;
use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::document::section::Fill;
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{ArrayBuffer, DepthRule, Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::gpu_scene::GpuScene;
use crate::render::base::ids::{object_id, surface_id};
use crate::render::base::section::Section;
use crate::render::base::view::View;
use crate::render::passes::gbuffer::GBuffer;

/// How objects that touch each other are told apart: degrees by which the lines are turned, and how many times as far
/// apart they are.
const PATTERNS: [(f64, f32); 6] = [(0.0, 1.0), (90.0, 1.0), (0.0, 0.6), (90.0, 0.6), (0.0, 1.5), (90.0, 1.5)];

/// Twin of `Cap` in `shaders/common/cap.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuCap {
    fill: Vec3,
    surface_id: u32,
    ink: Vec3,
    lit: u32,
    across: Vec2,
    spacing: f32,
    offset: f32,
    width: f32,
}

/// The caps of a scene by object id, for a view with this many pixels per reference pixel; empty when there are none.
pub fn caps(scene: &GpuScene, view: &View, scale: f32) -> Vec<GpuCap> {
    let Some(section) = scene.section.as_ref().filter(|section| section.has_caps()) else {
        return Vec::new();
    };
    let nodes = 0..scene.scene.nodes.len();
    let patterns = PATTERNS.map(|(turn, spacing)| cap_pattern(section, view, scale, turn, spacing));
    let cap = |node| {
        let Some(cap) = section.sectioned(node).and_then(|sectioned| sectioned.cap) else {
            return GpuCap::default();
        };
        let surface_id = surface_id(object_id(node), cap.surface);
        GpuCap { surface_id, ..patterns[cap.pattern as usize % PATTERNS.len()] }
    };
    // Entry 0 is the background.
    std::iter::once(GpuCap::default()).chain(nodes.map(cap)).collect()
}

/// One kind of hatching as a view sees it: lines that run in the plane, at the same distance everywhere in the picture.
fn cap_pattern(section: &Section, view: &View, scale: f32, turn: f64, wider: f32) -> GpuCap {
    let style = &section.style;
    let hatch = &style.hatch;
    let (plane, right) = section.place();
    let (sin, cos) = (f64::from(hatch.angle) + turn).to_radians().sin_cos();
    let along = view.view_from_world.transform_vector3(right * cos + plane.normal.cross(right) * sin);
    let anchor = view.view_from_world.transform_point3(plane.point);
    let across = across(view, anchor, along);
    let spacing = hatch.spacing * scale * wider;
    let is_seen = view.orthographic || -anchor.z > view.clip_range[0];
    let at = if is_seen { view.projector().pixel(anchor).dot(across) } else { 0.0 };
    GpuCap {
        fill: style.color.to_linear(),
        surface_id: 0,
        ink: hatch.color.to_linear(),
        lit: u32::from(style.lit),
        across: across.as_vec2(),
        spacing,
        offset: at.rem_euclid(f64::from(spacing)) as f32,
        width: if style.cap == Fill::Hatched { hatch.width * scale } else { 0.0 },
    }
}

/// Across a direction in the picture, where y runs down, at a point; both in view space.
fn across(view: &View, at: DVec3, along: DVec3) -> DVec2 {
    let depth = -at.z;
    let seen = if view.orthographic || depth <= 0.0 {
        along.truncate()
    } else {
        along.truncate() * depth + at.truncate() * along.z
    };
    DVec2::new(seen.y, seen.x).normalize_or(DVec2::X)
}

/// Draws the caps over the surfaces. `caps`: [`GpuCap`]s by object id.
///
/// # Errors
/// [`RenderError`].
pub fn draw_caps(
    rec: &mut Recorder<'_>,
    gbuffer: &GBuffer,
    caps: &ArrayBuffer,
    color: &Target,
) -> Result<(), RenderError> {
    rec.draw(Draw {
        label: "section",
        program: Program::new("effects/section.wgsl", "fs_main"),
        inputs: &inputs! { geometry_tex: &gbuffer.geometry, surface_id_tex: &gbuffer.surface_id, caps: caps },
        outputs: &[color],
        onto: Onto::Over,
        depth: Some((&gbuffer.depth, DepthRule::Covered)),
    })?;
    Ok(())
}
