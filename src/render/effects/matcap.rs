//! Matcap: what the surface pass needs for it (Sloan et al. 2001, "The Lit Sphere: A Model for Capturing NPR Shading from Art").

use std::path::Path;
use std::sync::{Arc, OnceLock};

use encase::ShaderType;

use super::technique::{Styled, SurfaceTechnique};
use crate::gpu::{ArrayBuffer, Gpu, ImageArray, Inputs};
use crate::render::base::error::RenderError;
use crate::render::base::style_images::StyleImages;
use crate::scene::Texture;
use crate::style::Technique;
use crate::style::color::rgba_from_linear;
use crate::style::matcap::Sphere;

/// Texels per side of a sphere.
const SIDE: u32 = 512;

const SPHERES: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// Twin of `MatcapStyle` in `shaders/effects/matcap.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuMatcapStyle {
    #[shader(align(16))]
    object_color: f32,
    shadow: f32,
    sphere: u32,
}

/// A picture of a sphere: sRGB with alpha, rows from the top.
#[derive(Debug, PartialEq)]
struct SpherePicture(Vec<u8>);

/// All visible objects that are matcaps.
#[derive(Clone, Default)]
pub struct Matcaps {
    /// By object id; empty when there are none.
    styles: Vec<GpuMatcapStyle>,
    /// Their spheres, by number.
    spheres: Vec<Arc<SpherePicture>>,
}

impl PartialEq for Matcaps {
    fn eq(&self, other: &Self) -> bool {
        // Each sphere has one picture.
        let same = |(a, b): (&Arc<_>, &Arc<_>)| Arc::ptr_eq(a, b);
        self.styles == other.styles
            && self.spheres.len() == other.spheres.len()
            && self.spheres.iter().zip(&other.spheres).all(same)
    }
}

/// The spheres on the device: those that the visible objects use.
pub struct Spheres {
    uploaded: Vec<Arc<SpherePicture>>,
    images: ImageArray,
    sampler: wgpu::Sampler,
}

/// Matcaps on the device.
pub struct MatcapShading {
    styles: ArrayBuffer,
}

impl SurfaceTechnique for MatcapShading {
    const TECHNIQUE: Technique = Technique::Matcap;

    type Styles = Matcaps;
    type Shared = Spheres;

    fn shared(gpu: &Gpu) -> Spheres {
        Spheres {
            uploaded: Vec::new(),
            images: ImageArray::none(gpu, SPHERES),
            sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("spheres"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
        }
    }

    fn new(gpu: &Gpu) -> Self {
        Self { styles: ArrayBuffer::new(gpu, "matcap styles") }
    }

    fn add(matcaps: &mut Matcaps, object: &Styled<'_>) {
        if object.style.technique != Technique::Matcap {
            return;
        }
        let style = &object.style.matcap;
        let own = style.sphere_image().and_then(|path| object.images.made(path, sphere_of));
        let sphere = own.unwrap_or_else(|| built_in(style.sphere));
        let known = matcaps.spheres.iter().position(|known| Arc::ptr_eq(known, &sphere));
        let number = known.unwrap_or_else(|| {
            matcaps.spheres.push(sphere);
            matcaps.spheres.len() - 1
        });
        if let Some(entry) = object.entry(&mut matcaps.styles) {
            *entry = GpuMatcapStyle {
                object_color: style.object_color,
                shadow: style.shadow,
                sphere: number as u32,
            };
        }
    }

    fn prepare_image(images: &StyleImages, key: &str, path: &Path) {
        if key == "matcap.image" {
            images.made(path, sphere_of);
        }
    }

    fn switches(matcaps: &Matcaps) -> Vec<(&'static str, bool)> {
        vec![("WITH_MATCAP", !matcaps.styles.is_empty())]
    }

    fn upload(&mut self, shared: &mut Spheres, gpu: &Gpu, matcaps: &Matcaps) -> Result<(), RenderError> {
        if matcaps.styles.is_empty() {
            return Ok(());
        }
        self.styles.write(gpu, &matcaps.styles);
        let same = |(a, b): (&Arc<_>, &Arc<_>)| Arc::ptr_eq(a, b);
        let is_there = shared.uploaded.len() == matcaps.spheres.len()
            && shared.uploaded.iter().zip(&matcaps.spheres).all(same);
        if !is_there {
            gpu.check_texture_size("a sphere", [SIDE; 2])?;
            let count = matcaps.spheres.len() as u32;
            shared.images = ImageArray::new(gpu, "spheres", SPHERES, SIDE, count, 1);
            for (number, sphere) in (0..).zip(&matcaps.spheres) {
                shared.images.write(gpu, number, 0, &sphere.0);
            }
            shared.uploaded.clone_from(&matcaps.spheres);
        }
        Ok(())
    }

    fn bind<'a>(&'a self, shared: &'a Spheres, inputs: &mut Inputs<'a>) {
        inputs.set("matcap_styles", &self.styles);
        inputs.set("spheres", shared.images.view());
        inputs.set("sphere_sampler", &shared.sampler);
    }
}

/// An image as a sphere.
fn sphere_of(image: &Texture) -> SpherePicture {
    let (columns, rows) = (SIDE.min(image.width), SIDE.min(image.height));
    let linear = image.averaged([columns, rows]);
    // A small image is enlarged by its nearest texels; the sampler smooths what is left.
    let texel = |i: u32| {
        let (x, y) = (i % SIDE * columns / SIDE, i / SIDE * rows / SIDE);
        let color = linear.get((y * columns + x) as usize).copied().unwrap_or_default();
        rgba_from_linear(color.with_w(1.0))
    };
    SpherePicture((0..SIDE * SIDE).flat_map(texel).collect())
}

/// A built-in sphere, read when first asked for; clay, where an image is missing. They are made by `assets/textures`.
fn built_in(sphere: Sphere) -> Arc<SpherePicture> {
    static SPHERES: [OnceLock<Arc<SpherePicture>>; 4] = [const { OnceLock::new() }; 4];
    macro_rules! picture {
        ($name:literal) => {
            include_bytes!(concat!("../../../assets/matcaps/", $name, ".png")).as_slice()
        };
    }
    let (number, png) = match sphere {
        Sphere::Clay | Sphere::Image => (0, picture!("clay")),
        Sphere::Porcelain => (1, picture!("porcelain")),
        Sphere::Metal => (2, picture!("metal")),
        Sphere::Jade => (3, picture!("jade")),
    };
    let read = || {
        // A test reads them all.
        let image = image::load_from_memory(png).map(image::DynamicImage::into_rgba8).unwrap_or_default();
        let is_whole = image.dimensions() == (SIDE, SIDE);
        let gray = || vec![128; (4 * SIDE * SIDE) as usize];
        Arc::new(SpherePicture(if is_whole { image.into_raw() } else { gray() }))
    };
    Arc::clone(SPHERES[number].get_or_init(read))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_built_in_spheres_are_whole_and_differ() {
        let all = [Sphere::Clay, Sphere::Porcelain, Sphere::Metal, Sphere::Jade].map(built_in);
        for (i, sphere) in all.iter().enumerate() {
            assert_eq!(sphere.0.len(), (4 * SIDE * SIDE) as usize);
            assert!(all[..i].iter().all(|other| other != sphere), "{i} is another one, or could not be read");
        }
    }
}
