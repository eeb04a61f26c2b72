//! What each stage of a drawing depends on, by value.

use glam::Vec4;

use crate::render::base::edge_styles::EdgeStyles;
use crate::render::base::frame_uniform::FrameUniform;
use crate::render::effects::mirror::MirrorUniform;
use crate::render::effects::surface::Look;

/// What the color of the opaque surfaces depends on.
#[derive(PartialEq)]
pub(super) struct ColorKey {
    pub(super) gbuffer: u64,
    pub(super) shadows: Option<u64>,
    /// Edges and which of them reach each pixel; `None` where lines are not drawn with the surfaces.
    pub(super) lines: Option<(u64, Option<u64>)>,
    /// Where shading goes by lines.
    pub(super) shaded_by_lines: Option<u64>,
    pub(super) look: Look,
    pub(super) edge_styles: EdgeStyles,
    /// `None` where there are no surfaces: that looks the same from everywhere.
    pub(super) uniform: Option<FrameUniform>,
    /// Of each mirror, the revision of what is seen in it, and how that is laid over it.
    pub(super) reflected: Vec<(u64, MirrorUniform)>,
    /// Mirrors show the paper too.
    pub(super) paper_in_mirrors: Option<Vec4>,
    pub(super) hidden: Option<u64>,
    /// What is seen through, where it is drawn with the surfaces.
    pub(super) translucent: Vec<u64>,
}

/// What a picture depends on that is put together of parts.
#[derive(PartialEq)]
pub(super) struct TogetherKey {
    pub(super) shaders: u64,
    /// Color and ink of what is opaque.
    pub(super) opaque: [Option<u64>; 2],
    pub(super) translucent: Vec<u64>,
}
