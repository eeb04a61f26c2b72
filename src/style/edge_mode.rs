//! How edges are found and where their lines lie: what the parameters of all lines ask for.

use super::slot::choice;

choice! {
    /// How edges are found.
    pub enum EdgeMode {
        /// From the edges of the meshes and from what is in front of what.
        #[default]
        Exact,
        /// By operators on the picture's normals, depths and colors, as the edge-enhancement paper does.
        ImageSpace,
    }
}

choice! {
    /// Where the width of a profile edge lies.
    pub enum Alignment {
        /// Half on either side of the edge.
        #[default]
        Centered,
        /// Outside of the object.
        Outward,
        /// On the object.
        Inward,
    }
}

choice! {
    /// Operators of image-space mode (edge-enhancement paper, section 4.1.2).
    pub enum EdgeOperator {
        /// Two diagonal pairs: finer edges, softer intensities.
        #[default]
        Diagonal,
        /// Eight neighbors against the center.
        C1,
        /// Sobel operators on normals, depth and color, and the sign of normals (hatching paper, section 3, "Outline").
        Sobel,
    }
}
