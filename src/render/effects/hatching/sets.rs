//! The strokes of tonal art maps on the device.

use std::sync::{Arc, OnceLock};

use crate::gpu::{Gpu, GpuError, ImageArray};
use crate::hatching::tonal_art_map::{TonalArtMap, sets};

/// Texels along the side of a tile at its finest resolution, as in `shaders/effects/hatching/tonal_art_map.wgsl`.
pub(super) const TILE: usize = 256;
/// Resolutions.
const LEVELS: usize = 4;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The built-in sets and those that styles describe on the device, made when first asked for.
pub(super) struct StrokeSets {
    pub(super) tones: ImageArray,
    pub(super) priorities: ImageArray,
    pub(super) sampler: wgpu::Sampler,
    /// Those beside the built-in ones; `None`: nothing is there yet.
    own: Option<Vec<OwnMap>>,
}

/// A map that a style describes: equal to another if it is the same one.
#[derive(Debug, Clone)]
pub(super) struct OwnMap(pub(super) Arc<TonalArtMap>);

impl PartialEq for OwnMap {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Number of built-in sets: those of styles come after them.
pub(super) fn built_in() -> usize {
    maps().len()
}

/// The built-in sets, read when first asked for.
fn maps() -> &'static [TonalArtMap] {
    static MAPS: OnceLock<Vec<TonalArtMap>> = OnceLock::new();
    // A test reads them all.
    MAPS.get_or_init(|| sets::all().iter().filter_map(|set| TonalArtMap::from_png(set.png).ok()).collect())
}

impl StrokeSets {
    /// None yet; a shader that reads none is given an empty texture.
    pub(super) fn new(gpu: &Gpu) -> Self {
        let nothing = || ImageArray::none(gpu, FORMAT);
        Self { tones: nothing(), priorities: nothing(), sampler: ImageArray::tile_sampler(gpu), own: None }
    }

    /// Uploads them, unless they are there.
    pub(super) fn prepare(&mut self, gpu: &Gpu, own: &[OwnMap]) -> Result<(), GpuError> {
        if self.own.as_deref() == Some(own) {
            return Ok(());
        }
        gpu.check_texture_size("strokes", [TILE as u32; 2])?;
        let maps: Vec<&TonalArtMap> = maps().iter().chain(own.iter().map(|own| &*own.0)).collect();
        let [tones, priorities] = [(); 2]
            .map(|()| ImageArray::new(gpu, "strokes", FORMAT, TILE as u32, maps.len() as u32, LEVELS as u32));
        for (layer, map) in maps.iter().enumerate() {
            let mut lights = Vec::new();
            for (number, level) in map.levels.iter().take(LEVELS).enumerate() {
                let (tile, depth) = (layer as u32, number as u32);
                lights = if number == 0 { lights_of(&level.tones) } else { halved(&lights, level.side) };
                tones.write(gpu, tile, depth, lights.as_flattened());
                let texels: Vec<[u8; 4]> = level
                    .priorities
                    .iter()
                    .map(|p| [p.thresholds[0], p.inks[0], p.thresholds[1], p.inks[1]])
                    .collect();
                priorities.write(gpu, tile, depth, texels.as_flattened());
            }
        }
        (self.tones, self.priorities, self.own) = (tones, priorities, Some(own.to_vec()));
        Ok(())
    }
}

/// The three light tones in one image.
fn lights_of(tones: &[Vec<u8>]) -> Vec<[u8; 4]> {
    let texel = |i: usize| {
        let ink = |tone: usize| tones.get(tone).and_then(|tone| tone.get(i)).copied().unwrap_or(0);
        [ink(0), ink(1), ink(2), 255]
    };
    (0..tones.first().map_or(0, Vec::len)).map(texel).collect()
}

/// An image of half the size: on the paper strokes that are drawn smaller only get finer.
fn halved(texels: &[[u8; 4]], side: usize) -> Vec<[u8; 4]> {
    let at = |x: usize, y: usize| texels.get(y * 2 * side + x).copied().unwrap_or_default();
    let texel = |i: usize| {
        let (x, y) = (2 * (i % side), 2 * (i / side));
        let four = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
        std::array::from_fn(|c| ((four.iter().map(|t| u32::from(t[c])).sum::<u32>() + 2) / 4) as u8)
    };
    (0..side * side).map(texel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_built_in_sets_are_as_the_device_expects() {
        let maps = maps();
        assert_eq!(maps.len(), sets::all().len());
        for map in maps {
            let sides: Vec<_> = map.levels.iter().map(|level| level.side).collect();
            assert_eq!(sides, [256, 128, 64, 32]);
        }
    }
}
