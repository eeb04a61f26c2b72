//! Surface materials and their images.

use glam::{Mat3, Vec4};

/// What a surface is made of, as far as a drawing needs it.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name in the file; may be empty.
    pub name: String,
    /// Linear RGBA factor, 0 to 1, multiplied with the texture and the vertex color.
    pub base_color: Vec4,
    /// Base color image (sRGB).
    pub base_color_texture: Option<TextureRef>,
    /// Tangent-space normal map (linear).
    pub normal_texture: Option<TextureRef>,
    /// Scale of the normal map's x and y.
    pub normal_scale: f32,
    /// How the alpha of the base color is used.
    pub alpha: AlphaMode,
    /// Whether back faces are meant to be seen.
    pub double_sided: bool,
    /// Whether the file asks for no shading (`KHR_materials_unlit`).
    pub unlit: bool,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: Vec4::new(0.8, 0.8, 0.8, 1.0),
            base_color_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            alpha: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
        }
    }
}

/// Use of the alpha channel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum AlphaMode {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// A pixel whose alpha lies below the cut-off (0 to 1) is a hole.
    Mask(f32),
    /// What lies behind shows through.
    Blend,
}

/// A use of an image: which, and how it lies on the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureRef {
    /// Index into `Scene::textures`.
    pub texture: usize,
    /// Applied to the mesh's texture coordinates first (`KHR_texture_transform`).
    pub transform: UvTransform,
    /// Behavior outside 0..1 along u and v.
    pub wrap: [Wrap; 2],
    /// Nearest instead of linear filtering.
    pub nearest: bool,
}

/// A 2D affine map of texture coordinates, as a matrix for (u, v, 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UvTransform(pub Mat3);

impl Default for UvTransform {
    fn default() -> Self {
        Self(Mat3::IDENTITY)
    }
}

/// Texture addressing outside the unit square.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Wrap {
    /// Repeat.
    #[default]
    Repeat,
    /// Repeat, every second copy mirrored.
    Mirror,
    /// Stretch the border texel.
    Clamp,
}
