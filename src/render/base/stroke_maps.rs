//! The tonal art maps of strokes that styles describe: drawn in the background, once.

use std::sync::Arc;

use crate::hatching::cache::Cache;
use crate::hatching::tonal_art_map::TonalArtMap;
use crate::hatching::tonal_art_map::generator::{Recipe, RecipeError};

/// A map, and what it was drawn from. Equal to others only if it is the same one.
#[derive(Debug, Clone)]
pub struct StrokeMap {
    /// What was asked for.
    pub recipe: Recipe,
    /// What was drawn, or why there is nothing.
    pub map: Result<Arc<TonalArtMap>, RecipeError>,
}

impl StrokeMap {
    /// Draws a map, or takes it from a cache. `progress` is given the share that is done, 0 to 1, and says whether to go on: `None`
    /// when it did not.
    pub fn draw(cache: &Cache, recipe: &Recipe, progress: &(dyn Fn(f32) -> bool + Sync)) -> Option<Self> {
        match recipe.draw_once(cache, progress) {
            Err(RecipeError::Canceled) => None,
            drawn => Some(Self { recipe: recipe.clone(), map: drawn.map(Arc::new) }),
        }
    }
}

/// Maps that have been drawn. Clones share them.
#[derive(Debug, Clone, Default)]
pub struct StrokeMaps(Vec<StrokeMap>);

/// So many of those that were drawn last are kept.
const MOST: usize = 16;

impl StrokeMaps {
    /// Whether a map has been drawn, or cannot be.
    pub fn is_known(&self, recipe: &Recipe) -> bool {
        self.0.iter().any(|known| known.recipe == *recipe)
    }

    /// The map of a recipe, if it has been drawn.
    pub fn map(&self, recipe: &Recipe) -> Option<&Arc<TonalArtMap>> {
        self.0.iter().find(|known| known.recipe == *recipe)?.map.as_ref().ok()
    }

    /// Takes one more over.
    pub fn add(&mut self, map: StrokeMap) {
        self.0.retain(|known| known.recipe != map.recipe);
        if self.0.len() >= MOST {
            self.0.remove(0);
        }
        self.0.push(map);
    }
}
