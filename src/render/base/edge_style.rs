//! What the passes that find and draw lines read of an object's style.

use encase::ShaderType;
use glam::Vec3;

use crate::geometry::EdgeClass;
use crate::style::{Color, EdgeMode, EdgeOperator, Edges, HiddenMode};

/// Twin of `LineStyle` in `shaders/common/edge_style.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuLineStyle {
    color: Vec3,
    /// Opacity; 0: not drawn.
    pub opacity: f32,
    /// px of the picture.
    pub width: f32,
    /// What an edge must reach to be drawn. Silhouettes, borders and outlines of objects: the step in depth behind it, in
    /// widths of a pixel at the depth of the edge; textures: the difference of the colors, 0 to 1; all others: the angle between the
    /// surfaces, radians.
    pub threshold: f32,
    /// 1: dashed.
    pub dashed: u32,
}

/// Twin of `EdgeStyle` in `shaders/common/edge_style.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuEdgeStyle {
    /// By class.
    pub lines: [GpuLineStyle; EdgeClass::ALL.len()],
    /// 0: none.
    pub mode: u32,
    /// Of profile edges; 0: both sides of the spine.
    pub alignment: u32,
    /// px of the picture.
    pub dash_period: f32,
    dash_share: f32,
    /// Share of the surface's own color.
    pub object_color: f32,
    darken: f32,
    /// How far creases are weighed by their angle.
    pub by_angle: f32,
    /// Thinner far away.
    pub by_distance: f32,
    /// Thinner on the lit side.
    pub by_light: f32,
    /// Thinner by hand pressure.
    pub pressure: f32,
    pressure_scale: f32,
    /// Image-space mode: ink per unit of the depth discontinuity of the diagonal operator, `1 − I_Z`; 0: no profile edges.
    gain_z: f32,
    /// The same of the C1 operator, in place of `gain_z`: ink per unit of C1.
    gain_c1: f32,
    /// Ink per unit of the normal discontinuity, `1 − I_N`; 0: no inner edges.
    gain_n: f32,
    /// Ink at or below this share is dropped.
    profile_threshold: f32,
    inner_threshold: f32,
    profile_color: Vec3,
    profile_opacity: f32,
    inner_color: Vec3,
    inner_opacity: f32,
    /// 0: diagonal, 1: C1, 2: Sobel.
    found_by: u32,
    /// Of Sobel operators: 1 where the sign of normals makes silhouettes.
    by_sign: u32,
    /// Gradients that make an edge; 0: not looked at.
    normal_gradient: f32,
    depth_gradient: f32,
    color_gradient: f32,
    /// How a Sobel operator makes one gradient of the changes across and down: 1: their sum |x| + |y|, 0: the length of (x, y).
    sums_changes: u32,
    /// Shorter pieces of lines that nothing continues are left out, px of the picture.
    pub min_length: f32,
}

// As in `shaders/common/edge_style.wgsl`.
const EXACT: u32 = 1;
const IMAGE_SPACE: u32 = 2;
const C1: u32 = EdgeOperator::C1 as u32;
const SOBEL: u32 = EdgeOperator::Sobel as u32;

/// The width of a line, px of a picture with this many pixels per reference pixel. Where the picture is so small that lines
/// would fade away they keep some ink, in proportion to each other.
fn width_in_px(width: f32, scale: f32) -> f32 {
    (width * scale).max((0.25 * width).min(0.75))
}

impl GpuEdgeStyle {
    /// The parameters of an object in a picture with this many pixels per reference pixel.
    pub fn new(edges: &Edges, scale: f32) -> Self {
        let (profile, inner) = (&edges.profile, &edges.inner);
        let gain = |show: bool, gain: f32| if show { gain } else { 0.0 };
        let threshold = |show: bool, least: f32| if show { least } else { 0.0 };
        let (length, gap) = (edges.dash.length, edges.dash.gap);
        let lines = EdgeClass::ALL.map(|class| {
            let line = edges.line(class);
            GpuLineStyle {
                color: line.color.to_linear(),
                opacity: if line.show { line.opacity } else { 0.0 },
                width: width_in_px(line.width, scale),
                threshold: match class {
                    EdgeClass::Silhouette | EdgeClass::Border | EdgeClass::Object => line.threshold * scale,
                    EdgeClass::Texture => line.threshold,
                    _ => line.threshold.to_radians(),
                },
                dashed: u32::from(line.dashed),
            }
        });
        Self {
            lines,
            mode: match edges.mode {
                EdgeMode::Exact => EXACT,
                EdgeMode::ImageSpace => IMAGE_SPACE,
            },
            alignment: edges.alignment as u32,
            dash_period: (length + gap) * scale,
            dash_share: length / (length + gap),
            object_color: edges.object_color,
            darken: edges.darken,
            by_angle: edges.inner.more.by_angle,
            by_distance: edges.variation.distance,
            by_light: edges.variation.light,
            pressure: edges.pressure.amount,
            pressure_scale: edges.pressure.scale * scale,
            profile_color: profile.color.to_linear(),
            profile_opacity: profile.opacity,
            inner_color: inner.color.to_linear(),
            inner_opacity: inner.opacity,
            gain_z: gain(profile.show, profile.gain),
            gain_c1: gain(profile.show, profile.more.gain_c1),
            gain_n: gain(inner.show, inner.gain),
            profile_threshold: profile.threshold,
            inner_threshold: inner.threshold,
            found_by: edges.operator as u32,
            by_sign: u32::from(edges.sobel.silhouettes && profile.show),
            normal_gradient: threshold(edges.sobel.normals && inner.show, edges.sobel.normal_threshold),
            depth_gradient: threshold(edges.sobel.depth && profile.show, edges.sobel.depth_threshold),
            color_gradient: threshold(edges.sobel.color && inner.show, edges.sobel.color_threshold),
            sums_changes: u32::from(edges.sobel.sum),
            min_length: edges.min_length * scale,
        }
    }

    /// The same in one color, but for the classes that have a color of their own.
    #[must_use]
    pub fn inked(mut self, edges: &Edges, color: Color) -> Self {
        for (class, line) in EdgeClass::ALL.into_iter().zip(&mut self.lines) {
            line.color = edges.class(class).color.unwrap_or(color).to_linear();
        }
        (self.profile_color, self.inner_color) = (color.to_linear(), color.to_linear());
        self
    }

    /// The same for hidden lines, which are not aligned to any side; of an object that has none, nothing.
    pub fn of_hidden_lines(edges: &Edges, scale: f32) -> Self {
        let hidden = &edges.hidden;
        if hidden.mode == HiddenMode::Off {
            return Self::default();
        }
        let mut style = Self { alignment: 0, ..Self::new(edges, scale) };
        for (class, line) in EdgeClass::ALL.into_iter().zip(&mut style.lines) {
            if class.is_detail() {
                line.opacity = 0.0;
            }
            if hidden.mode == HiddenMode::Own {
                line.color = hidden.color.to_linear();
                line.width = width_in_px(hidden.width, scale);
                line.dashed = u32::from(hidden.dashed);
            } else {
                line.opacity *= hidden.opacity;
                line.width *= hidden.relative_width;
                line.dashed = u32::from(hidden.mode == HiddenMode::Dashed);
            }
        }
        if hidden.mode == HiddenMode::Own {
            style.object_color = 0.0;
            (style.profile_color, style.inner_color) = (hidden.color.to_linear(), hidden.color.to_linear());
        } else {
            style.profile_opacity *= hidden.opacity;
            style.inner_opacity *= hidden.opacity;
        }
        let (length, gap) = (hidden.dash, hidden.gap);
        Self { dash_period: (length + gap) * scale, dash_share: length / (length + gap), ..style }
    }

    /// The same without folds of which the operators of the papers would make fainter ink than this, 0 to 1: gain times
    /// 1 − cos, full at 41°.
    #[must_use]
    pub fn without_fainter(mut self, ink: f32) -> Self {
        let angle = (1.0 - 0.25 * ink.clamp(0.0, 1.0)).acos();
        for class in [EdgeClass::Ridge, EdgeClass::Valley, EdgeClass::Intersection] {
            let line = &mut self.lines[class as usize];
            line.threshold = line.threshold.max(angle);
        }
        self
    }

    /// The same, but for a class that is not drawn.
    #[must_use]
    pub fn without(mut self, class: EdgeClass) -> Self {
        self.lines[class as usize].opacity = 0.0;
        self
    }

    /// Whether exact lines are drawn.
    pub fn is_exact(&self) -> bool {
        self.mode == EXACT && self.lines.iter().any(|l| l.opacity > 0.0)
    }

    /// Whether shading normals decide where its lines run or how wide they are.
    pub fn reads_normals(&self) -> bool {
        let classes = [EdgeClass::Intersection, EdgeClass::Relief];
        self.is_image_space() || self.by_light > 0.0 || classes.into_iter().any(|class| self.draws(class))
    }

    /// Whether its lines take the color of the surface beside them.
    pub fn takes_object_color(&self) -> bool {
        self.is_exact() && self.object_color > 0.0
    }

    /// Whether base colors decide where its lines run or what color they have.
    pub fn reads_color(&self) -> bool {
        self.takes_object_color() || self.draws(EdgeClass::Texture) || self.is_image_space_with_color()
    }

    /// Whether the width of its lines varies.
    pub fn varies(&self) -> bool {
        self.by_distance > 0.0 || self.by_light > 0.0 || self.pressure > 0.0
    }

    /// Whether the papers' operators draw.
    pub fn is_image_space(&self) -> bool {
        let (profile, inner) = match self.found_by {
            C1 => (self.gain_c1, self.gain_n),
            SOBEL => (self.by_sign as f32 + self.depth_gradient, self.normal_gradient + self.color_gradient),
            _ => (self.gain_z, self.gain_n),
        };
        self.mode == IMAGE_SPACE && (profile * self.profile_opacity > 0.0 || inner * self.inner_opacity > 0.0)
    }

    /// Whether the papers' operators draw by the C1 operator.
    pub fn is_c1(&self) -> bool {
        self.is_image_space() && self.found_by == C1
    }

    /// Whether the papers' operators draw by Sobel operators.
    pub fn is_sobel(&self) -> bool {
        self.is_image_space() && self.found_by == SOBEL
    }

    /// Whether the papers' operators compare base colors.
    pub fn is_image_space_with_color(&self) -> bool {
        self.is_sobel() && self.color_gradient * self.inner_opacity > 0.0
    }

    /// The lines that are drawn in exact mode.
    pub fn drawn(&self) -> impl Iterator<Item = (EdgeClass, &GpuLineStyle)> {
        let is_exact = self.mode == EXACT;
        EdgeClass::ALL.into_iter().zip(&self.lines).filter(move |(_, l)| is_exact && l.opacity > 0.0)
    }

    /// Whether lines of a class are drawn.
    pub fn draws(&self, class: EdgeClass) -> bool {
        self.drawn().any(|(drawn, _)| drawn == class)
    }

    /// Greatest distance from the spine at which a line of this object has ink, px.
    pub fn greatest_radius(&self) -> f32 {
        let reach = |(class, line): (EdgeClass, &GpuLineStyle)| {
            if self.alignment != 0 && class.is_profile() { line.width } else { 0.5 * line.width }
        };
        self.drawn().map(reach).fold(0.0, f32::max)
    }

    /// The same as far as finding edges goes: what only drawing them depends on is left out.
    #[must_use]
    pub fn for_finding(&self) -> Self {
        let mut same = *self;
        for line in &mut same.lines {
            line.color = Vec3::ZERO;
            line.opacity = f32::from(u8::from(line.opacity > 0.0));
        }
        (same.profile_color, same.inner_color) = (Vec3::ZERO, Vec3::ZERO);
        (same.object_color, same.darken) = (0.0, 0.0);
        same
    }
}
