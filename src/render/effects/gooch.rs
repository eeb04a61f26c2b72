//! Gooch shading: what the surface pass needs for it.

use encase::ShaderType;
use glam::{DMat4, DVec3, Vec3};

use super::technique::{Styled, SurfaceTechnique};
use crate::geometry::FormAxis;
use crate::gpu::{ArrayBuffer, Gpu, Inputs};
use crate::render::base::error::RenderError;
use crate::style::Technique;
use crate::style::gooch::{Gooch, MetalAxis};

/// Twin of `GoochStyle` in `shaders/effects/gooch.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuGoochStyle {
    cool: Vec3,
    alpha: f32,
    warm: Vec3,
    beta: f32,
    across: Vec3,
    highlight: f32,
    around: Vec3,
    shininess: f32,
    metal: f32,
    stripes: f32,
    is_of_view: u32,
    is_of_form: u32,
    side_light: f32,
    object_hue: f32,
    first_form: u32,
    forms: u32,
}

impl GpuGoochStyle {
    /// Of an object that lies at `world_from_local`.
    fn new(gooch: &Gooch, world_from_local: &DMat4) -> Self {
        let [across, around] = directions(gooch.metal_axis, world_from_local);
        Self {
            cool: gooch.cool.to_linear(),
            alpha: gooch.alpha,
            warm: gooch.warm.to_linear(),
            beta: gooch.beta,
            across,
            highlight: gooch.highlight,
            around,
            shininess: gooch.shininess,
            metal: gooch.metal,
            stripes: gooch.stripes as f32,
            is_of_view: u32::from(gooch.metal_axis == MetalAxis::View),
            is_of_form: u32::from(gooch.metal_axis == MetalAxis::Form),
            side_light: gooch.side_light,
            object_hue: gooch.object_hue,
            first_form: 0,
            forms: 0,
        }
    }

    /// The style of a form around an axis of a mesh that lies at `world_from_local`.
    fn of_form(self, form: &FormAxis, world_from_local: &DMat4) -> Self {
        // One sense and one beginning for all forms around parallel axes, so that their stripes meet.
        let sense = if form.direction.dot(DVec3::new(0.9, 1.0, 1.1)) < 0.0 { -1.0 } else { 1.0 };
        let side = if form.direction.y.abs() < 0.7 { DVec3::Y } else { DVec3::Z };
        let [axis, side] = [form.direction * sense, side].map(|v| world_from_local.transform_vector3(v));
        let [across, around] = directions_about(axis, side, DVec3::Z);
        Self { across, around, metal: self.metal * form.strength as f32, ..self }
    }
}

/// All visible objects that are drawn so.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GoochStyles {
    /// By object id; empty when there are none.
    objects: Vec<GpuGoochStyle>,
    /// Those of the forms of objects with stripes around them.
    forms: Vec<GpuGoochStyle>,
}

/// Gooch shading on the device.
pub struct GoochShading {
    styles: ArrayBuffer,
}

impl SurfaceTechnique for GoochShading {
    const TECHNIQUE: Technique = Technique::Gooch;

    type Styles = GoochStyles;
    type Shared = ();

    fn shared(_gpu: &Gpu) {}

    fn new(gpu: &Gpu) -> Self {
        Self { styles: ArrayBuffer::new(gpu, "gooch styles") }
    }

    fn add(styles: &mut Self::Styles, object: &Styled<'_>) {
        if object.style.technique == Technique::Gooch
            && let Some(node) = object.scene.scene.nodes.get(object.node)
            && let Some(entry) = object.entry(&mut styles.objects)
        {
            let gooch = &object.style.gooch;
            *entry = GpuGoochStyle::new(gooch, &node.world_from_local);
            if gooch.metal > 0.0 && gooch.metal_axis == MetalAxis::Form {
                let axes = object.scene.form_axes(object.node);
                entry.first_form = (object.count + styles.forms.len()) as u32;
                entry.forms = axes.len() as u32;
                let own = *entry;
                styles.forms.extend(axes.iter().map(|axis| own.of_form(axis, &node.world_from_local)));
            }
        }
    }

    fn switches(styles: &Self::Styles) -> Vec<(&'static str, bool)> {
        let has_metal = styles.objects.iter().any(|style| style.metal > 0.0);
        vec![("WITH_GOOCH", !styles.objects.is_empty()), ("WITH_METAL", has_metal)]
    }

    fn upload(&mut self, (): &mut (), gpu: &Gpu, styles: &Self::Styles) -> Result<(), RenderError> {
        if !styles.objects.is_empty() {
            self.styles.write(gpu, &[styles.objects.as_slice(), &styles.forms].concat());
        }
        Ok(())
    }

    fn bind<'a>(&'a self, (): &'a (), inputs: &mut Inputs<'a>) {
        inputs.set("gooch_styles", &self.styles);
    }
}

/// Unit vectors across an axis and across each other: in world space, for the view's axis in view space.
fn directions(axis: MetalAxis, world_from_local: &DMat4) -> [Vec3; 2] {
    let m = world_from_local;
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(|column| column.truncate());
    let (axis, side, default) = match axis {
        MetalAxis::X => (x, y, DVec3::X),
        MetalAxis::Y => (y, z, DVec3::Y),
        MetalAxis::Z | MetalAxis::Form => (z, x, DVec3::Z),
        MetalAxis::View => (DVec3::Y, DVec3::Z, DVec3::Y),
    };
    directions_about(axis, side, default)
}

/// The same for an axis; the first one on the side of `side`.
fn directions_about(axis: DVec3, side: DVec3, default: DVec3) -> [Vec3; 2] {
    let axis = axis.normalize_or(default);
    let across = side.reject_from_normalized(axis).normalize_or(axis.any_orthonormal_vector());
    [across, axis.cross(across)].map(|v| v.as_vec3())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stripes_turn_with_their_object_and_not_with_its_shape() {
        let quarter = DMat4::from_rotation_z(std::f64::consts::FRAC_PI_2);
        let [across, around] = directions(MetalAxis::X, &quarter);
        assert!(across.abs_diff_eq(Vec3::NEG_X, 1e-6) && around.abs_diff_eq(Vec3::Z, 1e-6));
        let skewed = DMat4::from_cols(
            DVec3::new(3.0, 0.0, 0.0).extend(0.0),
            DVec3::new(5.0, 0.5, 0.0).extend(0.0),
            DVec3::ZERO.extend(0.0),
            glam::DVec4::W,
        );
        for axis in [MetalAxis::X, MetalAxis::Y, MetalAxis::Z, MetalAxis::Form, MetalAxis::View] {
            let [a, b] = directions(axis, &skewed);
            assert!(
                (a.length() - 1.0).abs() < 1e-6 && (b.length() - 1.0).abs() < 1e-6 && a.dot(b).abs() < 1e-6
            );
        }
    }
}
