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
    /// The color of a surface changes.
    Texture,
    /// The relief of a surface changes, which only its normal map knows.
    Relief,
    /// The shadow of something ends on a surface.
    Shadow,
    /// A section plane cuts the surface open.
    Section,
}

impl EdgeClass {
    /// All classes, in order.
    pub const ALL: [Self; 11] = [
        Self::Silhouette,
        Self::Border,
        Self::Object,
        Self::Ridge,
        Self::Valley,
        Self::Material,
        Self::Intersection,
        Self::Texture,
        Self::Relief,
        Self::Shadow,
        Self::Section,
    ];

    /// Whether it belongs to the profile edges; the others are inner edges.
    pub fn is_profile(self) -> bool {
        self <= Self::Object || self == Self::Section
    }

    /// Whether it is a line within a surface that has nothing to do with its shape.
    pub fn is_detail(self) -> bool {
        matches!(self, Self::Texture | Self::Relief | Self::Shadow)
    }
}

/// Some of the classes of lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct ClassSet(u16);

impl ClassSet {
    /// No class.
    pub const NONE: Self = Self(0);
    /// Every class.
    pub const ALL: Self = Self::of(&EdgeClass::ALL);

    /// These classes.
    pub const fn of(classes: &[EdgeClass]) -> Self {
        let (mut bits, mut i) = (0, 0);
        while i < classes.len() {
            bits |= 1 << classes[i] as u8;
            i += 1;
        }
        Self(bits)
    }

    /// Whether a class is among them.
    pub const fn contains(self, class: EdgeClass) -> bool {
        self.0 >> class as u8 & 1 != 0
    }

    /// Whether there are none.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// These and one more.
    #[must_use]
    pub const fn with(self, class: EdgeClass) -> Self {
        Self(self.0 | 1 << class as u8)
    }
}
