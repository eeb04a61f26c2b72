//! What a pass gives to a shader, by the names of the shader's variables.

use super::{ArrayBuffer, Target, UniformBuffer};

/// What a variable of a shader can stand for.
#[derive(Clone, Copy)]
pub enum Resource<'a> {
    /// A texture as large as a picture, read or written as the shader says.
    Target(&'a Target),
    /// A uniform or storage buffer.
    Buffer(&'a wgpu::Buffer),
    /// A storage buffer that holds an array.
    Array(&'a ArrayBuffer),
    /// Images of one size above each other, read through a sampler.
    Layers(&'a wgpu::TextureView),
    /// How they are read.
    Sampler(&'a wgpu::Sampler),
}

impl<'a> From<&'a Target> for Resource<'a> {
    fn from(target: &'a Target) -> Self {
        Self::Target(target)
    }
}

impl<'a> From<&'a wgpu::Buffer> for Resource<'a> {
    fn from(buffer: &'a wgpu::Buffer) -> Self {
        Self::Buffer(buffer)
    }
}

impl<'a, T> From<&'a UniformBuffer<T>> for Resource<'a> {
    fn from(uniform: &'a UniformBuffer<T>) -> Self {
        Self::Buffer(uniform.buffer())
    }
}

impl<'a> From<&'a ArrayBuffer> for Resource<'a> {
    fn from(array: &'a ArrayBuffer) -> Self {
        Self::Array(array)
    }
}

impl<'a> From<&'a wgpu::TextureView> for Resource<'a> {
    fn from(layers: &'a wgpu::TextureView) -> Self {
        Self::Layers(layers)
    }
}

impl<'a> From<&'a wgpu::Sampler> for Resource<'a> {
    fn from(sampler: &'a wgpu::Sampler) -> Self {
        Self::Sampler(sampler)
    }
}

/// A resource, or `None` of one: an input that there is not.
pub trait IntoInput<'a> {
    /// The resource, if there is one.
    fn into_input(self) -> Option<Resource<'a>>;
}

impl<'a, R: Into<Resource<'a>>> IntoInput<'a> for R {
    fn into_input(self) -> Option<Resource<'a>> {
        Some(self.into())
    }
}

impl<'a, R: Into<Resource<'a>>> IntoInput<'a> for Option<R> {
    fn into_input(self) -> Option<Resource<'a>> {
        self.map(Into::into)
    }
}

/// What a pass reads and writes, by the names of the shader's variables. Made by [`crate::gpu::inputs!`]. What is `None` is
/// replaced by a placeholder, for shaders that do not read it by the switches they are run with.
#[derive(Clone, Default)]
pub struct Inputs<'a>(Vec<(&'static str, Option<Resource<'a>>)>);

/// No inputs.
pub static NOTHING: Inputs<'static> = Inputs(Vec::new());

impl<'a> Inputs<'a> {
    /// Adds one, in place of an earlier one of that name.
    pub fn set(&mut self, name: &'static str, input: impl IntoInput<'a>) {
        self.0.retain(|(known, _)| *known != name);
        self.0.push((name, input.into_input()));
    }

    /// Adds others, in place of earlier ones of the same names.
    pub fn extend(&mut self, others: &Self) {
        for (name, input) in &others.0 {
            self.set(name, *input);
        }
    }

    /// These and others.
    #[must_use]
    pub fn and(mut self, others: &Self) -> Self {
        self.extend(others);
        self
    }

    /// The names of the variables for which something is given, or that there is nothing.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.0.iter().map(|(name, _)| *name)
    }

    /// What is given for a variable; `None`: nothing is, not even that there is nothing.
    pub fn find(&self, name: &str) -> Option<Option<Resource<'a>>> {
        self.0.iter().find(|(known, _)| *known == name).map(|(_, input)| *input)
    }
}

/// [`Inputs`] by name: `inputs! { geometry_tex: &gbuffer.geometry, seen_tex: seen }`.
#[macro_export]
macro_rules! inputs {
    ($($name:ident: $value:expr),* $(,)?) => {{
        #[allow(unused_mut, reason = "there may be none")]
        let mut inputs = $crate::gpu::Inputs::default();
        $(inputs.set(stringify!($name), $value);)*
        inputs
    }};
}
pub use inputs;
