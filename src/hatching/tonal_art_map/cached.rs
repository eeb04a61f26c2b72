//! Tonal art maps that are drawn once and kept.

use super::TonalArtMap;
use super::generator::{Recipe, RecipeError};
use crate::hatching::cache::{Cache, Key, KeyMaker};

/// Raised whenever a recipe gives another map than before.
pub const VERSION: u32 = 2;

impl Recipe {
    /// The map of [`Recipe::draw`]; from the cache, where it is put for the next time.
    ///
    /// # Errors
    /// Those of [`Recipe::draw`].
    pub fn draw_once(
        &self,
        cache: &Cache,
        progress: &(dyn Fn(f32) -> bool + Sync),
    ) -> Result<TonalArtMap, RecipeError> {
        let key = self.key();
        if let Some(kept) = cache.load(key).and_then(|bytes| TonalArtMap::from_png(&bytes).ok()) {
            // A file says what ink there is, not what was asked for.
            return Ok(TonalArtMap { inks: self.inks.clone(), ..kept });
        }
        let map = self.draw(progress)?.map;
        match map.to_png() {
            Ok(png) => cache.store(key, &png),
            Err(error) => log::warn!("{error}; the tonal art map is not kept"),
        }
        Ok(map)
    }

    fn key(&self) -> Key {
        let Self { shape, inks, side, levels, candidates, seed } = self;
        let numbers = [
            shape.length,
            shape.length_spread,
            shape.width,
            shape.width_spread,
            shape.taper[0],
            shape.taper[1],
            shape.waviness,
            shape.angle_spread,
            shape.pressure,
            shape.grain,
        ];
        let maker = KeyMaker::new("tonal art map", VERSION).numbers(&numbers).numbers(inks).integers(&[
            *side as u64,
            *levels as u64,
            *candidates as u64,
            *seed,
        ]);
        match &shape.image {
            Some(image) => {
                let [width, height] = image.size();
                maker.integers(&[width as u64, height as u64]).numbers(image.inks()).key()
            }
            None => maker.key(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hatching::cache::LIMIT;

    #[test]
    fn a_map_is_drawn_once() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::at(folder.path(), LIMIT);
        let recipe = Recipe { side: 64, levels: 2, inks: vec![0.2], candidates: 10, ..Recipe::default() };
        let drawn = recipe.draw_once(&cache, &|_| true).unwrap();
        assert!(recipe.draw_once(&cache, &|_| unreachable!()).as_ref() == Ok(&drawn));
        let other = Recipe { seed: 2, ..recipe.clone() };
        assert!(other.draw_once(&cache, &|_| false) == Err(RecipeError::Canceled));
        // What is kept under its key and no map is drawn anew.
        cache.store(recipe.key(), b"no image");
        assert!(recipe.draw_once(&cache, &|_| true).as_ref() == Ok(&drawn));
    }
}
