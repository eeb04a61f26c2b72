//! What effects are made of: plain functions from textures to textures.

pub mod edge_map;
pub mod gbuffer;
pub mod resolve;
pub mod selection;
pub mod show;
