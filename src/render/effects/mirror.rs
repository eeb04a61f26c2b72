//! Mirrors: the scene is drawn once more from the eye's mirror image, with edges of its own, and laid over the mirror's
//! surface (edge-enhancement paper, section 5, Fig. 8). The paper's stencil is the G-buffer's object id.

use encase::ShaderType;
use glam::{DVec3, Vec3};

use crate::geometry::{Bounds, Plane};
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{Program, Recorder, Target, UniformBuffer, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::view::View;
use crate::style;
use crate::style::mirror::Side;

/// A flat object with the role mirror.
#[derive(Debug, Clone, PartialEq)]
pub struct MirrorObject {
    /// Its object id.
    pub object: u32,
    /// Where it lies, world space.
    plane: Plane,
    /// The corners of a box around it, world space, in the order of [`Bounds::corners`].
    corners: [DVec3; 8],
    sides: Side,
    uniform: MirrorUniform,
}

/// Twin of `Mirror` in `shaders/effects/mirror.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct MirrorUniform {
    tint: Vec3,
    reflectivity: f32,
    fresnel: f32,
    object: u32,
}

impl MirrorObject {
    /// A mirror in the plane of an object with this box around it.
    pub fn new(object: u32, plane: Plane, corners: [DVec3; 8], style: &style::Mirror) -> Self {
        let uniform = MirrorUniform {
            tint: style.tint.to_linear(),
            reflectivity: style.reflectivity,
            fresnel: style.fresnel,
            object,
        };
        Self { object, plane, corners, sides: style.side, uniform }
    }

    /// How it blends, as the shader reads it.
    pub fn uniform(&self) -> MirrorUniform {
        self.uniform
    }

    /// What is seen in it; `None` if that is nothing: it is beyond the picture, turned away, wholly cut off, or reflects
    /// nothing. `margin`: how far the lines in it may reach, in pixels; `visible`: the box around everything visible.
    pub fn seen_from(&self, view: &View, visible: &Bounds, margin: f32) -> Option<View> {
        if self.uniform.reflectivity <= 0.0 && self.uniform.fresnel <= 0.0
            || view.clips_away(&self.corners.map(|corner| view.view_from_world.transform_point3(corner)))
        {
            return None;
        }
        let world_from_view = view.view_from_world.inverse();
        let towards_eye = if view.orthographic {
            world_from_view.transform_vector3(DVec3::Z)
        } else {
            world_from_view.transform_point3(DVec3::ZERO) - self.plane.point
        };
        let lead = self.plane.normal.dot(towards_eye);
        // Seen exactly from the side, a mirror is a line.
        let is_seen = match self.sides {
            Side::Front => lead > 0.0,
            Side::Back => lead < 0.0,
            Side::Both => lead != 0.0,
        };
        let part = view.rect_of(&self.corners, margin)?;
        let facing = Plane { normal: self.plane.normal * lead.signum(), ..self.plane };
        is_seen.then(|| view.mirrored(&facing, visible, part))
    }
}

/// Lays what is seen in a mirror over its surface, where that is in front of the opaque `surfaces` (see
/// `shaders/common/gbuffer.wgsl`). `uniform`: the mirror.
///
/// # Errors
/// [`RenderError`].
pub fn mirror(
    rec: &mut Recorder<'_>,
    surfaces: &Target,
    reflection: &Target,
    uniform: &UniformBuffer<MirrorUniform>,
    color: &Target,
) -> Result<(), RenderError> {
    rec.draw(Draw {
        label: "mirror",
        program: Program::new("effects/mirror.wgsl", "fs_main"),
        inputs: &inputs! { geometry_tex: surfaces, reflection_tex: reflection, mirror: uniform },
        outputs: &[color],
        onto: Onto::Over,
        depth: None,
    })?;
    Ok(())
}
