//! The angles that make creases, and what was found among the edges for them, kept.

use std::sync::{Arc, Mutex, PoisonError};

/// From which angles (radians) creases are ridges and valleys.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::geometry) struct CreaseAngles {
    pub ridge: f32,
    pub valley: f32,
}

/// How many choices of angles are kept.
const MAX_CACHED: usize = 8;

/// What was asked for before. No part of what makes edges equal.
#[derive(Debug)]
pub(super) struct Cached<T>(Mutex<Vec<(CreaseAngles, Arc<T>)>>);

impl<T> Cached<T> {
    /// That of these angles; made when it is asked for first.
    pub(super) fn get(&self, angles: CreaseAngles, make: impl FnOnce() -> T) -> Arc<T> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, found)) = kept.iter().find(|(of, _)| *of == angles) {
            return Arc::clone(found);
        }
        let made = Arc::new(make());
        if kept.len() >= MAX_CACHED {
            kept.remove(0);
        }
        kept.push((angles, Arc::clone(&made)));
        made
    }
}

impl<T> Default for Cached<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<T> Clone for Cached<T> {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl<T> PartialEq for Cached<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
