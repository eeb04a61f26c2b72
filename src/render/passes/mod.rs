//! What effects are made of: plain functions from textures to textures.

pub mod accumulate;
pub mod composition;
pub mod coordinates;
pub mod count;
pub mod depth_mask;
pub mod designated;
pub mod edge_map;
pub mod fragment_lists;
pub mod front;
pub mod gbuffer;
pub mod layer_lists;
pub mod layer_report;
pub mod layers;
pub mod line_blocks;
pub mod line_classes;
pub mod line_distance;
pub mod line_pixels;
pub mod lines;
pub mod moved_edges;
pub mod occlusion_culling;
pub mod offset_field;
pub mod operators;
pub mod overlay;
pub mod peel;
pub mod place;
pub mod repeated;
pub mod resolve;
pub mod segments;
pub mod selection;
pub mod shadow_map;
pub mod shadow_mask;
pub mod shadows;
pub mod show;

pub mod traversal;
