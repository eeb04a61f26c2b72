//! Material files and images become materials of the scene.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use super::mtl::{self, Map, Mtl};
use super::scrub::Scrubbed;
use crate::import::assemble::Assembly;
use crate::import::image::{EncodedImage, decode_all};
use crate::import::source::Folder;
use crate::import::{ImportError, Progress};
use crate::scene::{AlphaMode, Material, Texture, TextureRef};

/// Bytes that the decoded images of one model may take.
const IMAGE_BUDGET: u64 = 2 << 30;

/// Fills the scene's materials and textures. Returns the material for each name that the file uses, and behind them
/// one for faces without a name. Whatever is missing becomes a warning.
///
/// # Errors
/// Only `Canceled`.
pub(super) fn load(
    path: &Path,
    text: &Scrubbed<'_>,
    assembly: &mut Assembly<'_>,
    progress: &Progress,
) -> Result<Vec<usize>, ImportError> {
    let folder = Folder::of(path);
    let library = read_libraries(&folder, text, assembly);
    let used: Vec<&Mtl> = text.materials.iter().filter_map(|name| library.get(name)).collect();
    let images = read_images(&folder, &used, assembly, progress)?;

    let mut places = Vec::with_capacity(text.materials.len() + 1);
    for name in &text.materials {
        places.push(assembly.scene.materials.len());
        let material = match library.get(name) {
            Some(mtl) => convert(mtl, &images, assembly),
            None => {
                if !library.is_empty() {
                    assembly.warn("", format!("the material `{name}` is in none of its files"));
                }
                Material { name: name.clone(), double_sided: true, ..Material::default() }
            }
        };
        assembly.scene.materials.push(material);
    }
    places.push(assembly.scene.materials.len());
    assembly.scene.materials.push(Material { double_sided: true, ..Material::default() });
    Ok(places)
}

/// The materials of all files by name; of two with one name, the first.
fn read_libraries(folder: &Folder, text: &Scrubbed<'_>, assembly: &mut Assembly<'_>) -> HashMap<String, Mtl> {
    let mut library = HashMap::new();
    let mut add = |bytes: &[u8]| {
        for material in mtl::read(bytes) {
            library.entry(material.name.clone()).or_insert(material);
        }
    };
    for line in &text.libraries {
        // One name with spaces, or several names.
        let whole = match folder.read_file(line) {
            Ok(bytes) => {
                add(&bytes);
                continue;
            }
            Err(error) => error,
        };
        let names: Vec<&str> = line.split_whitespace().collect();
        if names.len() < 2 {
            assembly.warn("", format!("no materials: {whole}"));
            continue;
        }
        for name in names {
            match folder.read_file(name) {
                Ok(bytes) => add(&bytes),
                Err(error) => assembly.warn("", format!("no materials: {error}")),
            }
        }
    }
    library
}

/// The texture in the scene for each name of a file.
type Images = HashMap<String, usize>;

fn read_images(
    folder: &Folder,
    materials: &[&Mtl],
    assembly: &mut Assembly<'_>,
    progress: &Progress,
) -> Result<Images, ImportError> {
    let mut encoded: Vec<EncodedImage> = Vec::new();
    let mut tried: HashMap<&str, ()> = HashMap::new();
    let maps = materials.iter().flat_map(|m| [m.diffuse_map.as_ref(), m.normal_map.as_ref()]).flatten();
    for map in maps {
        if tried.insert(&map.file, ()).is_some() {
            continue;
        }
        match folder.read_file(&map.file) {
            Ok(bytes) => encoded.push(EncodedImage { name: map.file.clone(), bytes }),
            Err(error) => assembly.warn("", format!("no image: {error}")),
        }
    }
    let mut images = Images::new();
    let decoded = decode_all(&encoded, IMAGE_BUDGET, progress)?;
    for (image, result) in encoded.into_iter().zip(decoded) {
        match result {
            Ok(texture) => {
                images.insert(image.name, assembly.scene.textures.len());
                let texture: Arc<Texture> = Arc::new(texture);
                assembly.scene.textures.push(texture);
            }
            Err(message) => assembly.warn("", format!("image `{}`: {message}", image.name)),
        }
    }
    Ok(images)
}

fn convert(mtl: &Mtl, images: &Images, assembly: &mut Assembly<'_>) -> Material {
    // Some writers mean 1 by 0.
    let is_seen = mtl.opacity > 0.0;
    let opacity = if is_seen { mtl.opacity.min(1.0) } else { 1.0 };
    if !is_seen {
        let (name, d) = (&mtl.name, mtl.opacity);
        assembly.warn("", format!("the material `{name}` cannot be seen (d = {d}); it is drawn opaque"));
    }
    let reference = |map: &Option<Map>| {
        let map = map.as_ref()?;
        Some(TextureRef {
            texture: *images.get(&map.file)?,
            transform: map.transform,
            wrap: [map.wrap; 2],
            nearest: false,
        })
    };
    let base_color_texture = reference(&mtl.diffuse_map);
    // Cut-out leaves and the like: the opacity is in the alpha channel of the color image.
    let same_file = |a: &Map, b: &Map| a.file == b.file;
    let cut_out = match (&mtl.diffuse_map, &mtl.opacity_map) {
        (Some(color), Some(opacity)) => same_file(color, opacity) && base_color_texture.is_some(),
        _ => false,
    };
    Material {
        name: mtl.name.clone(),
        base_color: mtl.base_color(base_color_texture.is_some()).truncate().extend(opacity),
        normal_texture: reference(&mtl.normal_map),
        normal_scale: mtl.normal_map.as_ref().map_or(1.0, |map| map.strength),
        base_color_texture,
        alpha: match (opacity < 1.0, cut_out) {
            (true, _) => AlphaMode::Blend,
            (false, true) => AlphaMode::Mask(0.5),
            (false, false) => AlphaMode::Opaque,
        },
        double_sided: true,
        unlit: false,
    }
}
