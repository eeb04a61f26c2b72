//! Materials and their images on the device.

use encase::ShaderType;
use glam::{Mat3, Vec3, Vec4};

use super::{Gpu, GpuError};
use crate::scene::mip_chain::{Level, mip_chain};
use crate::scene::{AlphaMode, Material, Scene, TextureRef, Wrap};

/// A material as the shader reads it; twin of `Material` in `shaders/common/material.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType)]
pub struct MaterialUniform {
    base_color: Vec4,
    base_uv: Mat3,
    normal_uv: Mat3,
    normal_scale: f32,
    /// Pixels with less alpha are holes; negative: none are.
    alpha_cutoff: f32,
    has_normal_texture: u32,
    /// 1: alpha is opacity.
    blends: u32,
}

/// Less alpha than this is none in a picture of 8 bits.
const MIN_ALPHA: f32 = 0.5 / 255.0;

impl MaterialUniform {
    /// The same for shadows, which have no shades: what blends throws one where it is more opaque than not.
    #[must_use]
    pub fn throwing_shadows(self) -> Self {
        Self { alpha_cutoff: if self.blends == 1 { 0.5 } else { self.alpha_cutoff }, ..self }
    }
}

impl From<&Material> for MaterialUniform {
    fn from(m: &Material) -> Self {
        let uv = |t: &Option<TextureRef>| t.as_ref().map_or(Mat3::IDENTITY, |t| t.transform.0);
        Self {
            base_color: m.base_color.clamp(Vec4::ZERO, Vec4::ONE),
            base_uv: uv(&m.base_color_texture),
            normal_uv: uv(&m.normal_texture),
            normal_scale: m.normal_scale,
            alpha_cutoff: match m.alpha {
                AlphaMode::Opaque => -1.0,
                AlphaMode::Mask(cutoff) => cutoff,
                AlphaMode::Blend => MIN_ALPHA,
            },
            has_normal_texture: u32::from(m.normal_texture.is_some()),
            blends: u32::from(m.alpha == AlphaMode::Blend),
        }
    }
}

impl MaterialUniform {
    /// Its base color, linear, and its opacity.
    pub fn base_color(&self) -> Vec4 {
        self.base_color.truncate().extend(if self.blends == 1 { self.base_color.w } else { 1.0 })
    }

    /// The same in another color, linear.
    #[must_use]
    pub fn with_color(self, color: Vec3) -> Self {
        Self { base_color: color.extend(1.0), ..self }
    }
}

/// All materials of a scene: their numbers, and their images in one bind group (group 2) each.
#[derive(Clone)]
pub struct MaterialBindings {
    uniforms: Vec<MaterialUniform>,
    groups: Vec<wgpu::BindGroup>,
    group_of_material: Vec<usize>,
    /// Uniform and group of a part that names no existing material.
    default: (MaterialUniform, usize),
}

impl MaterialBindings {
    /// The layout of bind group 2: base color texture and sampler, normal texture and sampler.
    pub fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
        let texture = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("material"),
            entries: &[entry(0, texture), entry(1, sampler), entry(2, texture), entry(3, sampler)],
        })
    }

    /// Uploads the materials of a scene; images that are larger than the device allows are left out.
    ///
    /// # Errors
    /// [`GpuError`].
    pub fn new(gpu: &Gpu, layout: &wgpu::BindGroupLayout, scene: &Scene) -> Result<Self, GpuError> {
        let uniforms = scene.materials.iter().map(MaterialUniform::from).collect();
        let white = upload(gpu, &[(1, 1, vec![255; 4])], true);
        let mut views = ImageViews { gpu, scene, made: Vec::new() };
        let mut groups = Vec::new();
        let mut keys: Vec<(Option<&TextureRef>, Option<&TextureRef>)> = Vec::new();
        let mut group_of_material = Vec::new();
        let default_material = Material::default();
        for material in scene.materials.iter().chain([&default_material]) {
            let key = (material.base_color_texture.as_ref(), material.normal_texture.as_ref());
            if let Some(known) = keys.iter().position(|k| *k == key) {
                group_of_material.push(known);
                continue;
            }
            let base = key.0.and_then(|t| views.get(t.texture, true)).unwrap_or_else(|| white.clone());
            let normal = key.1.and_then(|t| views.get(t.texture, false)).unwrap_or_else(|| white.clone());
            let (base_sampler, normal_sampler) = (sampler(gpu, key.0), sampler(gpu, key.1));
            let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
            groups.push(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(&material.name),
                layout,
                entries: &[
                    entry(0, wgpu::BindingResource::TextureView(&base)),
                    entry(1, wgpu::BindingResource::Sampler(&base_sampler)),
                    entry(2, wgpu::BindingResource::TextureView(&normal)),
                    entry(3, wgpu::BindingResource::Sampler(&normal_sampler)),
                ],
            }));
            keys.push(key);
            group_of_material.push(keys.len() - 1);
        }
        let group = group_of_material.pop().unwrap_or(0);
        let default = (MaterialUniform::from(&default_material), group);
        Ok(Self { uniforms, groups, group_of_material, default })
    }

    /// The same without the materials from the `kept`th on, followed by others, whose images are not shown.
    #[must_use]
    pub fn with_others(&self, kept: usize, others: &[Material]) -> Self {
        let mut bindings = self.clone();
        bindings.uniforms.truncate(kept);
        bindings.group_of_material.truncate(kept);
        bindings.uniforms.extend(others.iter().map(MaterialUniform::from));
        bindings.group_of_material.resize(bindings.uniforms.len(), self.default.1);
        bindings
    }

    /// The numbers of a material; the default's if there is none of that index.
    pub fn uniform(&self, material: usize) -> MaterialUniform {
        self.uniforms.get(material).copied().unwrap_or(self.default.0)
    }

    /// Number of the bind group of a material.
    pub fn group_index(&self, material: usize) -> usize {
        self.group_of_material.get(material).copied().unwrap_or(self.default.1)
    }

    /// A bind group by its number.
    pub fn group(&self, index: usize) -> Option<&wgpu::BindGroup> {
        self.groups.get(index)
    }
}

/// Image views that were made already, by texture and encoding.
struct ImageViews<'a> {
    gpu: &'a Gpu,
    scene: &'a Scene,
    made: Vec<((usize, bool), wgpu::TextureView)>,
}

impl ImageViews<'_> {
    fn get(&mut self, texture: usize, srgb: bool) -> Option<wgpu::TextureView> {
        if let Some((_, view)) = self.made.iter().find(|(key, _)| *key == (texture, srgb)) {
            return Some(view.clone());
        }
        let image = self.scene.textures.get(texture)?;
        if let Err(error) = self.gpu.check_texture_size(&image.name, [image.width, image.height]) {
            log::warn!("{error}; it is not shown");
            return None;
        }
        let view = upload(self.gpu, &mip_chain(image, srgb), srgb);
        self.made.push(((texture, srgb), view.clone()));
        Some(view)
    }
}

fn sampler(gpu: &Gpu, texture: Option<&TextureRef>) -> wgpu::Sampler {
    let address = |wrap| match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
    };
    let [u, v] = texture.map_or([Wrap::Repeat; 2], |t| t.wrap);
    let nearest = texture.is_some_and(|t| t.nearest);
    let filter = if nearest { wgpu::FilterMode::Nearest } else { wgpu::FilterMode::Linear };
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("material"),
        address_mode_u: address(u),
        address_mode_v: address(v),
        mag_filter: filter,
        min_filter: filter,
        mipmap_filter: if nearest { wgpu::MipmapFilterMode::Nearest } else { wgpu::MipmapFilterMode::Linear },
        ..Default::default()
    })
}

fn upload(gpu: &Gpu, levels: &[Level], srgb: bool) -> wgpu::TextureView {
    let (width, height, _) = levels[0];
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("material image"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: if srgb { wgpu::TextureFormat::Rgba8UnormSrgb } else { wgpu::TextureFormat::Rgba8Unorm },
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (level, (width, height, texels)) in levels.iter().enumerate() {
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: &texture,
                mip_level: level as u32,
                origin: wgpu::Origin3d::ZERO,
                aspect: wgpu::TextureAspect::All,
            },
            texels,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(width * 4),
                rows_per_image: Some(*height),
            },
            wgpu::Extent3d { width: *width, height: *height, depth_or_array_layers: 1 },
        );
    }
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
