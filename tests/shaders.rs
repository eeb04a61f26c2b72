//! Uniform twins: each Rust struct that goes to the device has the layout of the shader's own struct.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use encase::ShaderType;
use encase::internal::SizeValue;
use hachure::gpu::Shaders;
use hachure::gpu::buffer::EMPTY_ARRAY;
use hachure::gpu::material::MaterialUniform;
use hachure::render::base::edge_style::{EdgeUniform, LineUniform};
use hachure::render::base::frame_uniform::{FrameUniform, LightUniform};
use hachure::render::base::scale_bar::ScaleBarUniform;
use hachure::render::effects::blueprint::BlueprintUniform;
use hachure::render::effects::gooch::GoochUniform;
use hachure::render::effects::halftone::HalftoneUniform;
use hachure::render::effects::hatching::{HatchingUniform, IndicationUniform, StrokeUniform};
use hachure::render::effects::matcap::MatcapUniform;
use hachure::render::effects::mirror::MirrorUniform;
use hachure::render::effects::section::CapUniform;
use hachure::render::effects::surface::SurfaceUniform;
use hachure::render::effects::toon::ToonUniform;
use hachure::render::passes::designated::Masked;
use hachure::render::passes::layer_lists::BandUniform;
use hachure::render::passes::peel::CountedUniform;
use hachure::render::passes::shadow::{LightViewUniform, ShadowLightUniform};
use hachure::render::passes::shadow_map::ShadowDraw;
use hachure::style::Technique;
use strum::VariantNames as _;
use wgpu::naga::{Expression, Literal, TypeInner};

/// Byte offsets of a WGSL struct's members and its size.
fn layout(file: &str, name: &str) -> (Vec<u64>, u64) {
    let module = Shaders::default().validate(file).unwrap();
    let (_, found) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).unwrap();
    let TypeInner::Struct { members, span } = &found.inner else { panic!("{name} is no struct") };
    (members.iter().map(|m| u64::from(m.offset)).collect(), u64::from(*span))
}

macro_rules! same_layout {
    ($rust:ty, $fields:literal, $file:literal, $wgsl:literal) => {
        let offsets: Vec<u64> = (0..$fields).map(|i| <$rust as ShaderType>::METADATA.offset(i)).collect();
        let SizeValue(size) = <$rust as ShaderType>::METADATA.min_size();
        assert_eq!((offsets, size.get()), layout($file, $wgsl), "{} and {}", stringify!($rust), $wgsl);
        assert!(size.get() <= EMPTY_ARRAY, "an empty array of {} is too small", $wgsl);
    };
}

#[test]
fn rust_and_wgsl_agree_on_every_uniform() {
    same_layout!(FrameUniform, 17, "passes/resolve.wgsl", "Frame");
    same_layout!(ScaleBarUniform, 3, "passes/resolve.wgsl", "ScaleBar");
    same_layout!(LightUniform, 3, "passes/resolve.wgsl", "Light");
    same_layout!(BlueprintUniform, 6, "effects/blueprint.wgsl", "Blueprint");
    same_layout!(CountedUniform, 12, "passes/count.wgsl", "Counted");
    let (whole, beginning) =
        (layout("passes/count.wgsl", "Counted").0, layout("effects/blueprint.wgsl", "Peeled").0);
    assert!(whole.starts_with(&beginning), "a blueprint reads the beginning of it");
    same_layout!(Masked, 3, "effects/blueprint.wgsl", "Masked");
    same_layout!(Masked, 3, "passes/depth_mask.wgsl", "Counted");
    same_layout!(MaterialUniform, 7, "passes/gbuffer.wgsl", "Material");
    same_layout!(LineUniform, 5, "passes/lines.wgsl", "LineStyle");
    same_layout!(EdgeUniform, 27, "passes/lines.wgsl", "EdgeStyle");
    same_layout!(SurfaceUniform, 3, "effects/surface.wgsl", "SurfaceStyle");
    same_layout!(BandUniform, 3, "passes/layer_lists.wgsl", "Band");
    same_layout!(GoochUniform, 14, "effects/surface.wgsl", "GoochStyle");
    same_layout!(CapUniform, 8, "effects/section.wgsl", "Cap");
    same_layout!(MirrorUniform, 4, "effects/mirror.wgsl", "Mirror");
    same_layout!(ShadowDraw, 3, "passes/shadow_map.wgsl", "ShadowDraw");
    same_layout!(ShadowLightUniform, 3, "passes/shadow.wgsl", "ShadowLight");
    same_layout!(LightViewUniform, 8, "passes/shadow.wgsl", "LightView");
    same_layout!(ToonUniform, 11, "effects/toon.wgsl", "ToonStyle");
    same_layout!(MatcapUniform, 3, "effects/matcap.wgsl", "MatcapStyle");
    same_layout!(HalftoneUniform, 15, "effects/halftone.wgsl", "HalftoneStyle");
    same_layout!(HatchingUniform, 28, "effects/hatching.wgsl", "HatchingStyle");
    same_layout!(StrokeUniform, 12, "effects/hatching.wgsl", "Stroke");
    same_layout!(IndicationUniform, 18, "effects/hatching.wgsl", "Indication");
}

#[test]
fn shaders_number_techniques_as_styles_do() {
    let module = Shaders::default().validate("effects/surface.wgsl").unwrap();
    for name in Technique::VARIANTS {
        let number = name.parse::<Technique>().unwrap() as u32;
        let upper = name.to_uppercase();
        let (_, found) = module.constants.iter().find(|(_, c)| c.name.as_deref() == Some(&upper)).unwrap();
        let value = &module.global_expressions[found.init];
        assert!(matches!(value, Expression::Literal(Literal::U32(n)) if *n == number), "{upper}: {value:?}");
    }
}
