//! How shaders read textures of whole numbers. They are written for storage textures, which software devices read faster than
//! others. Other devices read the same texels as sampled textures: they need not offer many storage textures, and naga does not
//! translate functions that are given some to Metal's language (`tests/translation.rs`).

use std::collections::BTreeSet;

use wgpu::naga::{Expression, Function, Handle, ImageClass, Module, StorageAccess, Type, TypeInner};

/// Storage textures that the shader that takes most of them reads and writes.
pub const MAX_STORAGE_TEXTURES: u32 = 9;

/// Formats that shaders read whole numbers of.
const FORMATS: [&str; 3] = ["r32uint", "rg32uint", "rgba32uint"];

/// How textures of whole numbers are bound where shaders only read them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum IntegerTextures {
    /// As storage textures.
    #[default]
    Storage,
    /// As sampled textures.
    Sampled,
}

impl IntegerTextures {
    /// What suits a device.
    pub fn of(device_type: wgpu::DeviceType, limits: &wgpu::Limits) -> Self {
        let has_enough = limits.max_storage_textures_per_shader_stage >= MAX_STORAGE_TEXTURES;
        if has_enough && device_type == wgpu::DeviceType::Cpu { Self::Storage } else { Self::Sampled }
    }

    /// One of them in a bind group of its own.
    pub fn binding(self, format: wgpu::TextureFormat) -> wgpu::BindingType {
        let view_dimension = wgpu::TextureViewDimension::D2;
        match self {
            Self::Storage => wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::ReadOnly,
                format,
                view_dimension,
            },
            Self::Sampled => wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Uint,
                view_dimension,
                multisampled: false,
            },
        }
    }
}

/// A shader's text with sampled textures in place of storage textures that it only reads. Lines stay where they are.
pub(super) fn sampled(text: &str, module: &Module) -> String {
    let functions = module.functions.iter().map(|(_, function)| function);
    let entry_points = module.entry_points.iter().map(|entry_point| &entry_point.function);
    let ends: BTreeSet<usize> =
        functions.chain(entry_points).flat_map(|function| ends_of_reads(text, module, function)).collect();
    let mut sampled = text.to_owned();
    for &end in ends.iter().rev() {
        // A sampled texture has mip levels.
        sampled.insert_str(end, ", 0");
    }
    FORMATS.iter().fold(sampled, |text, format| {
        text.replace(&format!("texture_storage_2d<{format}, read>"), "texture_2d<u32>")
    })
}

/// Where in the text the closing brackets stand of calls that read storage textures which are only read.
fn ends_of_reads<'a>(
    text: &'a str,
    module: &'a Module,
    function: &'a Function,
) -> impl Iterator<Item = usize> + 'a {
    function.expressions.iter().filter_map(move |(call, expression)| {
        let Expression::ImageLoad { image, level: None, .. } = expression else { return None };
        let ty = type_of(module, function, *image)?;
        let TypeInner::Image { class: ImageClass::Storage { access, .. }, .. } = module.types[ty].inner
        else {
            return None;
        };
        let name = function.expressions.get_span(call).to_range()?;
        (access == StorageAccess::LOAD).then(|| closing_bracket(text, name.end)).flatten()
    })
}

/// Where the bracket that opens first from a place on is closed.
fn closing_bracket(text: &str, from: usize) -> Option<usize> {
    let mut depth = 0;
    let closed = text.get(from..)?.char_indices().find(|(_, c)| {
        depth += i32::from(*c == '(') - i32::from(*c == ')');
        *c == ')' && depth == 0
    });
    closed.map(|(at, _)| from + at)
}

fn type_of(module: &Module, function: &Function, image: Handle<Expression>) -> Option<Handle<Type>> {
    match function.expressions[image] {
        Expression::GlobalVariable(variable) => Some(module.global_variables[variable].ty),
        Expression::FunctionArgument(number) => Some(function.arguments.get(number as usize)?.ty),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wgpu::naga::front::wgsl;

    #[test]
    fn only_what_is_read_and_not_written_is_sampled() {
        let text = "\
var a: texture_storage_2d<rgba32uint, read>;
@group(0) @binding(1) var b: texture_storage_2d<r32uint, read_write>;
fn at(c: texture_storage_2d<rgba32uint, read>, i: u32) -> vec4<u32> {
    return textureLoad(c, vec2(i, textureDimensions(c).x));
}
@compute @workgroup_size(1)
fn main() {
    textureStore(b, vec2(0), at(a, 1u) + textureLoad(b, vec2(1)) + textureLoad(a, (vec2(2)) ));
}
";
        let wanted = text
            .replace("texture_storage_2d<rgba32uint, read>", "texture_2d<u32>")
            .replace("textureDimensions(c).x))", "textureDimensions(c).x), 0)")
            .replace("(vec2(2)) )", "(vec2(2)) , 0)");
        let found = sampled(text, &wgsl::parse_str(text).unwrap());
        assert_eq!(found, wanted);
        assert!(wgsl::parse_str(&found).is_ok());
    }
}
