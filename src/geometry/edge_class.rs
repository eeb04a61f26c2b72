//! What kind of line an edge is.

/// The classes of lines, profile edges first. Where several apply, the first one counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, strum::IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[repr(u8)]
pub enum EdgeClass {
    /// All surfaces at the edge lie on one side of it in the picture; at least two.
    Silhouette,
    /// The surface ends.
    Border,
    /// A silhouette or border behind which another object lies.
    Object,
    /// Convex crease.
    Ridge,
    /// Concave crease.
    Valley,
    /// Two materials of one object meet.
    Material,
    /// Two surfaces run through each other.
    Intersection,
}

impl EdgeClass {
    /// All classes, in order.
    pub const ALL: [Self; 7] = [
        Self::Silhouette,
        Self::Border,
        Self::Object,
        Self::Ridge,
        Self::Valley,
        Self::Material,
        Self::Intersection,
    ];

    /// Whether it belongs to the profile edges; the others are inner edges.
    pub fn is_profile(self) -> bool {
        self <= Self::Object
    }
}
