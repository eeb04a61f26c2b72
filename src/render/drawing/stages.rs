//! What each stage of a drawing depends on, by value.

use glam::{UVec2, Vec2, Vec4};

use crate::gpu::Recorder;
use crate::render::base::edge_style::EdgeUniform;
use crate::render::base::frame_uniform::{FrameUniform, View};
use crate::render::base::instances::{DrawCall, Instance};
use crate::render::base::scene_view::SceneView;
use crate::render::base::strokes::StrokeStyle;
use crate::render::effects::mirror::MirrorUniform;
use crate::render::effects::surface::Look;

/// What the G-buffer depends on.
#[derive(PartialEq)]
pub(super) struct GeometryKey {
    shaders: u64,
    scene_revision: u64,
    size: UVec2,
    /// `None` where nothing is drawn: that looks the same from everywhere.
    through: Option<View>,
    pub(super) draws: Vec<Instance>,
    pub(super) calls: Vec<DrawCall>,
}

impl GeometryKey {
    pub(super) fn new(
        rec: &Recorder<'_>,
        seen: &SceneView<'_>,
        draws: Vec<Instance>,
        calls: Vec<DrawCall>,
    ) -> Self {
        Self {
            shaders: rec.pipelines.generation(),
            scene_revision: seen.scene_revision,
            size: seen.view.size,
            through: (!calls.is_empty()).then_some(*seen.view),
            draws,
            calls,
        }
    }
}

/// What the lines that topology knows depend on.
#[derive(PartialEq)]
pub(super) struct SegmentsKey {
    pub(super) scene_revision: u64,
    pub(super) view: View,
    pub(super) styles: Vec<EdgeUniform>,
    pub(super) crease_angle: f32,
    pub(super) strokes: Option<StrokeStyle>,
}

/// What the edge map depends on.
#[derive(PartialEq)]
pub(super) struct EdgeKey {
    pub(super) gbuffer: u64,
    pub(super) shadows: Option<u64>,
    pub(super) styles: Vec<EdgeUniform>,
    pub(super) depth_range: Vec2,
    pub(super) light: Option<FrameUniform>,
    pub(super) strokes: Option<StrokeStyle>,
}

/// What the ink of surfaces depends on.
#[derive(PartialEq)]
pub(super) struct InkKey {
    pub(super) gbuffer: u64,
    pub(super) edges: u64,
    pub(super) reach: Option<u64>,
    pub(super) edge_styles: Vec<EdgeUniform>,
    pub(super) uniform: FrameUniform,
}

/// What the colour of a drawing depends on.
#[derive(PartialEq)]
pub(super) struct ColorKey {
    pub(super) gbuffer: u64,
    pub(super) shadows: Option<u64>,
    pub(super) edges: Option<u64>,
    pub(super) reach: Option<u64>,
    pub(super) look: Look,
    pub(super) edge_styles: Vec<EdgeUniform>,
    pub(super) uniform: FrameUniform,
    /// Of each mirror, the revision of what is seen in it, and how that is laid over it.
    pub(super) reflected: Vec<(u64, MirrorUniform)>,
    /// Mirrors show the paper too.
    pub(super) paper_in_mirrors: Option<Vec4>,
    pub(super) hidden: Option<u64>,
    pub(super) translucent: Vec<u64>,
}
