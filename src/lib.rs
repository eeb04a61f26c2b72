//! Hachure draws 3D models: as technical illustrations, cartoons, prints, hatching, sketches and blueprints, with exact lines.
//!
//! The rooms of the house, from the top floor down; a room imports only from floors below its own:
//! [`app`] the window, [`export`] pictures without a window, [`render`] one frame of one scene, [`import`] files
//! become scenes, [`gpu`] the device, [`hatching`] what strokes are drawn
//! with, [`document`] what is saved and undone, [`scene`] nodes, cameras, lights and
//! materials, [`style`] the parameters of every effect, [`geometry`] meshes.

pub mod app;
pub mod cli;
pub mod document;
pub mod export;
pub mod geometry;
pub mod gpu;
pub mod hatching;
pub mod import;
pub mod render;
pub mod scene;
pub mod style;
