//! The tiles of noise and paper that sketches are drawn with, on the device.

use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, OnceLock};

use crate::gpu::{Gpu, GpuError, ImageArray};
use crate::render::base::noise::{SIDE, paper_tile, ranked, turbulence_tile};
use crate::render::base::style_images::StyleImages;
use crate::scene::Texture;
use crate::style;
use crate::style::sketch::{Noise, Wander};

/// Most tiles that are kept while they are not used.
const MAX_KEPT: usize = 8;

/// What a sketch is drawn on.
#[derive(Clone, Default)]
pub(super) struct SketchPaper(Option<Arc<ToothImage>>);

/// The tooth of a paper by rank, a tile of `SIDE` × `SIDE`.
struct ToothImage(Vec<u8>);

impl PartialEq for SketchPaper {
    fn eq(&self, other: &Self) -> bool {
        // Each image has one.
        match (&self.0, &other.0) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        }
    }
}

impl SketchPaper {
    /// That of a style; generated where its image is missing.
    pub(super) fn of(sketch: &style::Sketch, images: &StyleImages) -> Self {
        Self(sketch.tooth_image().and_then(|path| images.made(path, ToothImage::of_image)))
    }
}

/// Makes what takes long of an image that the parameter `key` names.
pub fn prepare_image(images: &StyleImages, key: &str, path: &Path) {
    if key == "sketch.grain.image" {
        images.made(path, ToothImage::of_image);
    }
}

impl ToothImage {
    fn of_image(image: &Texture) -> Self {
        let [width, height] = [image.width, image.height].map(|side| side.max(1) as usize);
        let light = |x: usize, y: usize| {
            let at = 4 * ((y % height) * width + x % width);
            image.rgba.get(at..at + 3).map_or(0.0, |rgb| {
                rgb.iter().zip([0.2126, 0.7152, 0.0722]).map(|(c, share)| f32::from(*c) * share).sum()
            })
        };
        // The mean of what a texel covers, so that fine paper does not become noise.
        let texel = |i: usize| {
            let (x, y) = (i % SIDE, i / SIDE);
            let span = |at: usize, side: usize| {
                let first = at * side / SIDE;
                first..((at + 1) * side / SIDE).max(first + 1)
            };
            let (columns, rows) = (span(x, width), span(y, height));
            let count = (columns.len() * rows.len()) as f32;
            let sum: f32 =
                rows.flat_map(|y| columns.clone().map(move |x| (x, y))).map(|(x, y)| light(x, y)).sum();
            sum / count
        };
        Self(ranked(&(0..SIDE * SIDE).map(texel).collect::<Vec<_>>()))
    }
}

/// What a tile of noise depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct TileKey {
    octaves: u32,
    seed: u32,
    turbulent: bool,
}

/// Tiles on the device, made when first asked for.
pub(super) struct SketchImages {
    sampler: wgpu::Sampler,
    nothing: ImageArray,
    tiles: HashMap<TileKey, Tile>,
    papers: Vec<(SketchPaper, Tile)>,
    made: u64,
}

/// A tile on the device.
struct Tile {
    image: ImageArray,
    /// Told apart by it.
    number: u64,
}

/// What a sketch is drawn with.
pub(super) struct Prepared<'a> {
    /// A tile of noise, for what follows the picture.
    pub(super) tile: &'a wgpu::TextureView,
    /// A tile of paper.
    pub(super) paper: &'a wgpu::TextureView,
    /// How they are read.
    pub(super) sampler: &'a wgpu::Sampler,
    /// Changes when they do.
    pub(super) revision: u64,
}

impl SketchImages {
    /// None yet.
    pub(super) fn new(gpu: &Gpu) -> Self {
        let nothing = ImageArray::none(gpu, wgpu::TextureFormat::Rgba8Unorm);
        let sampler = ImageArray::tile_sampler(gpu);
        Self { sampler, nothing, tiles: HashMap::new(), papers: Vec::new(), made: 0 }
    }

    /// The tile of noise of what follows the picture, and that of paper; `None`: nobody reads it.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub(super) fn prepare(
        &mut self,
        gpu: &Gpu,
        noise: Option<&Wander>,
        paper: Option<&SketchPaper>,
    ) -> Result<Prepared<'_>, GpuError> {
        gpu.check_texture_size("a tile of noise", [SIDE as u32; 2])?;
        let key = noise.map(|wander| TileKey {
            octaves: wander.octaves,
            seed: wander.seed,
            turbulent: wander.noise == Noise::Turbulence,
        });
        if let Some(key) = key.filter(|key| !self.tiles.contains_key(key)) {
            if self.tiles.len() >= MAX_KEPT {
                self.tiles.clear();
            }
            let texels = turbulence_tile(key.octaves, key.seed, key.turbulent);
            let halves: Vec<u16> =
                texels.iter().flatten().map(|value| half::f16::from_f32(*value).to_bits()).collect();
            let bytes = bytemuck::cast_slice(&halves);
            let image = tile(gpu, wgpu::TextureFormat::Rg16Float, bytes);
            self.made += 1;
            self.tiles.insert(key, Tile { image, number: self.made });
        }
        let known =
            |papers: &[(SketchPaper, Tile)]| papers.iter().position(|(known, _)| Some(known) == paper);
        if let Some(paper) = paper.filter(|_| known(&self.papers).is_none()) {
            if self.papers.len() >= MAX_KEPT {
                self.papers.clear();
            }
            let image = tile(gpu, wgpu::TextureFormat::Rgba8Unorm, &texels_of(paper));
            self.made += 1;
            self.papers.push((paper.clone(), Tile { image, number: self.made }));
        }
        let tile = key.and_then(|key| self.tiles.get(&key));
        let paper = known(&self.papers).and_then(|i| self.papers.get(i)).map(|(_, tile)| tile);
        Ok(Prepared {
            tile: tile.map_or(&self.nothing, |tile| &tile.image).view(),
            paper: paper.map_or(&self.nothing, |tile| &tile.image).view(),
            sampler: &self.sampler,
            revision: tile.map_or(0, |tile| tile.number) + (paper.map_or(0, |tile| tile.number) << 32),
        })
    }
}

/// The tile of paper: generated, or with the tooth of an image.
fn texels_of(paper: &SketchPaper) -> Vec<u8> {
    static GENERATED: OnceLock<Vec<[u8; 4]>> = OnceLock::new();
    let mut texels = GENERATED.get_or_init(paper_tile).clone();
    if let Some(tooth) = &paper.0 {
        for (texel, height) in texels.iter_mut().zip(&tooth.0) {
            texel[0] = *height;
        }
    }
    texels.into_flattened()
}

fn tile(gpu: &Gpu, format: wgpu::TextureFormat, bytes: &[u8]) -> ImageArray {
    let tile = ImageArray::new(gpu, "tile", format, SIDE as u32, 1, 1);
    tile.write(gpu, 0, 0, bytes);
    tile
}
