//! Materials and the images that they use.

use std::collections::BTreeMap;
use std::sync::Arc;

use ::gltf::json::extensions::texture::TextureTransform;
use ::gltf::json::material::{AlphaMode as DeclaredAlpha, Material as Declared};
use ::gltf::json::texture::{MagFilter, MinFilter, Sampler, WrappingMode};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Root, Value};
use glam::{Mat3, Vec2, Vec4};

use super::buffers::{GltfDocument, label};
use super::fault::Result;
use crate::import::Progress;
use crate::import::image::{EncodedImage, decode_all};
use crate::import::source::Folder;
use crate::scene::{AlphaMode, Material, Texture, TextureRef, UvTransform, Wrap};

/// How a material uses a texture.
#[derive(Debug, Clone)]
struct Use {
    texture: usize,
    uv_set: u32,
    transform: UvTransform,
}

/// What the meshes need to know of a material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct SurfaceNeeds {
    /// The set of texture coordinates that its images use; `None` when it uses no image.
    pub(super) uv_set: Option<u32>,
    /// Whether it has a normal map.
    pub(super) tangents: bool,
}

/// What the material number `index` needs of a mesh.
pub(super) fn needs(root: &Root, index: usize) -> SurfaceNeeds {
    let Some(material) = root.materials.get(index) else {
        return SurfaceNeeds { uv_set: None, tangents: false };
    };
    let base = base_use(material);
    let normal = normal_use(material);
    SurfaceNeeds {
        uv_set: base.as_ref().or(normal.as_ref()).map(|u| u.uv_set),
        tangents: normal.is_some_and(|n| base.is_none_or(|b| b.uv_set == n.uv_set)),
    }
}

/// Converts all materials; only images of materials for which `used` holds are decoded. One material more follows
/// the file's own: the one of primitives without any.
///
/// # Errors
/// Only when the person stopped it; an image that cannot be had is a warning.
pub(super) fn convert(
    document: &GltfDocument<'_>,
    folder: &Folder,
    used: &[bool],
    progress: &Progress,
    warnings: &mut Vec<(String, String)>,
) -> Result<(Vec<Material>, Vec<Arc<Texture>>)> {
    let root = &document.root;
    let is_used = |i: usize| used.get(i) == Some(&true);
    let mut images = BTreeMap::new();
    for material in (0..root.materials.len()).filter(|&i| is_used(i)) {
        let Some(material) = root.materials.get(material) else {
            continue;
        };
        for image in [base_use(material), normal_use(material)]
            .into_iter()
            .flatten()
            .filter_map(|u| image_of(root, u.texture))
        {
            images.insert(image, None);
        }
    }
    let mut encoded = Vec::new();
    let mut wanted = Vec::new();
    for &image in images.keys() {
        match encoded_image(document, folder, image) {
            Ok(bytes) => {
                encoded.push(bytes);
                wanted.push(image);
            }
            Err(message) => warnings.push((image_label(root, image), message)),
        }
    }
    let mut textures = Vec::new();
    let decoded = decode_all(&encoded, document.budget.left(), progress)?;
    for (image, result) in wanted.into_iter().zip(decoded) {
        match result {
            Ok(texture) => {
                images.insert(image, Some(textures.len()));
                textures.push(Arc::new(texture));
            }
            Err(message) => {
                warnings.push((image_label(root, image), format!("the image cannot be used: {message}")));
            }
        }
    }
    let mut materials = Vec::with_capacity(root.materials.len() + 1);
    for (index, declared) in root.materials.iter().enumerate() {
        let place = || label("material", index, declared.name.as_ref());
        let mut notes = Vec::new();
        let texture = |u: Use, notes: &mut Vec<String>| {
            let source = image_of(root, u.texture);
            if source.is_none() {
                notes.push(format!(
                    "texture {} has no PNG or JPEG image; the material is drawn without it",
                    u.texture
                ));
            }
            let texture = images.get(&source?).copied().flatten()?;
            let sampler = root.textures.get(u.texture).and_then(|t| t.sampler);
            let sampler = sampler.and_then(|s| root.samplers.get(s.value()));
            Some(TextureRef {
                texture,
                transform: u.transform,
                wrap: wraps(sampler),
                nearest: is_nearest(sampler),
            })
        };
        materials.push(convert_one(declared, texture, &mut notes));
        if is_used(index) {
            warnings.extend(notes.into_iter().map(|n| (place(), n)));
        }
    }
    materials.push(Material::default());
    Ok((materials, textures))
}

fn convert_one(
    declared: &Declared,
    mut texture: impl FnMut(Use, &mut Vec<String>) -> Option<TextureRef>,
    notes: &mut Vec<String>,
) -> Material {
    let extensions = declared.extensions.as_ref();
    let legacy = extensions.and_then(|e| e.pbr_specular_glossiness.as_ref());
    let factor = match legacy {
        Some(legacy) => legacy.diffuse_factor.0,
        None => declared.pbr_metallic_roughness.base_color_factor.0,
    };
    let base = base_use(declared);
    let normal = normal_use(declared);
    let uv_sets = (base.as_ref().map(|u| u.uv_set), normal.as_ref().map(|u| u.uv_set));
    let normal = match uv_sets {
        (Some(base), Some(normal)) if base != normal => {
            notes.push(
                "its normal map uses other texture coordinates than its color image; it is drawn without the normal \
                 map"
                    .into(),
            );
            None
        }
        _ => normal,
    };
    let cutoff = declared.alpha_cutoff.map_or(0.5, |c| c.0);
    let alpha = match declared.alpha_mode {
        Checked::Valid(DeclaredAlpha::Mask) => AlphaMode::Mask(cutoff),
        Checked::Valid(DeclaredAlpha::Blend) => AlphaMode::Blend,
        Checked::Valid(DeclaredAlpha::Opaque) | Checked::Invalid => AlphaMode::Opaque,
    };
    Material {
        name: declared.name.clone().unwrap_or_default(),
        base_color: Vec4::from_array(factor.map(|c| if c.is_finite() { c.clamp(0.0, 1.0) } else { 1.0 })),
        base_color_texture: base.and_then(|u| texture(u, notes)),
        normal_scale: declared
            .normal_texture
            .as_ref()
            .map_or(1.0, |n| if n.scale.is_finite() { n.scale } else { 1.0 }),
        normal_texture: normal.and_then(|u| texture(u, notes)),
        alpha,
        double_sided: declared.double_sided,
        unlit: extensions.is_some_and(|e| e.unlit.is_some()),
    }
}

fn base_use(material: &Declared) -> Option<Use> {
    let legacy = material.extensions.as_ref().and_then(|e| e.pbr_specular_glossiness.as_ref());
    let info = match legacy {
        Some(legacy) => legacy.diffuse_texture.as_ref()?,
        None => material.pbr_metallic_roughness.base_color_texture.as_ref()?,
    };
    let transform = info.extensions.as_ref().and_then(|e| e.texture_transform.as_ref());
    Some(texture_use(info.index.value(), info.tex_coord, transform))
}

fn normal_use(material: &Declared) -> Option<Use> {
    let info = material.normal_texture.as_ref()?;
    let transform: Option<TextureTransform> = info
        .extensions
        .as_ref()
        .and_then(|e| e.others.get("KHR_texture_transform"))
        .and_then(|value: &Value| ::gltf::json::deserialize::from_value(value.clone()).ok());
    Some(texture_use(info.index.value(), info.tex_coord, transform.as_ref()))
}

fn texture_use(texture: usize, uv_set: u32, transform: Option<&TextureTransform>) -> Use {
    let Some(t) = transform else {
        return Use { texture, uv_set, transform: UvTransform::default() };
    };
    // uv' = T · R · S · uv, with the extension's R, which turns counter-clockwise as the image is seen.
    let (sin, cos) = t.rotation.0.sin_cos();
    let rotation = Mat3::from_cols_array(&[cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0]);
    let matrix = Mat3::from_translation(Vec2::from_array(t.offset.0))
        * rotation
        * Mat3::from_scale(Vec2::from_array(t.scale.0));
    Use {
        texture,
        uv_set: t.tex_coord.unwrap_or(uv_set),
        transform: if matrix.is_finite() { UvTransform(matrix) } else { UvTransform::default() },
    }
}

fn image_of(root: &Root, texture: usize) -> Option<usize> {
    let image = root.textures.get(texture)?.source.value();
    (image < root.images.len()).then_some(image)
}

fn image_label(root: &Root, index: usize) -> String {
    let image = root.images.get(index);
    let name = image.and_then(|i| i.name.as_ref().or(i.uri.as_ref()));
    label("image", index, name.filter(|n| !n.starts_with("data:")))
}

fn encoded_image(
    document: &GltfDocument<'_>,
    folder: &Folder,
    index: usize,
) -> std::result::Result<EncodedImage, String> {
    let name = image_label(&document.root, index);
    let Some(image) = document.root.images.get(index) else {
        return Err("there is no such image".into());
    };
    match (&image.uri, image.buffer_view) {
        (Some(uri), _) => folder
            .fetch(uri)
            .map(|bytes| EncodedImage { name, bytes })
            .map_err(|e| format!("the image cannot be used: {e}")),
        (None, Some(view)) => document
            .view(view)
            .map(|view| EncodedImage { name, bytes: Arc::new(view.bytes.to_vec()) })
            .map_err(|f| format!("the image cannot be used: {}", f.of_file("the model".as_ref()))),
        (None, None) => Err("the image has neither a URI nor a buffer view".into()),
    }
}

fn wraps(sampler: Option<&Sampler>) -> [Wrap; 2] {
    let wrap = |mode: Checked<WrappingMode>| match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    };
    sampler.map_or([Wrap::Repeat; 2], |s| [wrap(s.wrap_s), wrap(s.wrap_t)])
}

fn is_nearest(sampler: Option<&Sampler>) -> bool {
    let Some(sampler) = sampler else {
        return false;
    };
    match (sampler.mag_filter, sampler.min_filter) {
        (Some(Checked::Valid(mag)), _) => mag == MagFilter::Nearest,
        (_, Some(Checked::Valid(min))) => matches!(
            min,
            MinFilter::Nearest | MinFilter::NearestMipmapNearest | MinFilter::NearestMipmapLinear
        ),
        _ => false,
    }
}
