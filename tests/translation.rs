//! Every shader in the languages of all systems, and within the limits of WebGPU: Linux, macOS and Windows get the same pictures,
//! and so does a device that offers no more than every device has.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::panic::{AssertUnwindSafe, catch_unwind};

use hachure::gpu::Shaders;
use hachure::gpu::bindings::INPUTS;
use hachure::gpu::integer_textures::{IntegerTextures, MAX_STORAGE_TEXTURES};
use hachure::gpu::uniform_arrays::{can_be_uniform, make_uniform};
use naga::back::{PipelineConstants, hlsl, msl, pipeline_constants::process_overrides, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, ImageClass, Module, ShaderStage, TypeInner};

/// How a shader reads arrays of structs: see `hachure::gpu::uniform_arrays`.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Arrays {
    Stored,
    Uniform,
}

/// A shader with its imports, in one of the ways to read whole numbers and arrays.
struct Shader {
    file: String,
    textures: IntegerTextures,
    arrays: Arrays,
    module: Module,
    info: ModuleInfo,
}

/// All that have entry points.
fn shaders() -> Vec<Shader> {
    let shaders = Shaders::default();
    let mut all = Vec::new();
    for file in Shaders::embedded() {
        for textures in [IntegerTextures::Storage, IntegerTextures::Sampled] {
            for arrays in [Arrays::Stored, Arrays::Uniform] {
                let (mut module, _) =
                    shaders.module(&file, textures).unwrap_or_else(|error| panic!("{error}"));
                if arrays == Arrays::Uniform {
                    let fitting = module.global_variables.iter().filter(|(_, v)| can_be_uniform(&module, v));
                    let numbers: Vec<_> =
                        fitting.filter_map(|(_, v)| v.binding.as_ref().map(|place| place.binding)).collect();
                    make_uniform(&mut module, INPUTS, &numbers);
                }
                let capabilities = Capabilities::SHADER_FLOAT16_IN_FLOAT32 | Capabilities::PRIMITIVE_INDEX;
                let info =
                    Validator::new(ValidationFlags::all(), capabilities).validate(&module).unwrap_or_else(
                        |error| panic!("{file}, {textures:?}, {arrays:?}: {}", error.into_inner()),
                    );
                if !module.entry_points.is_empty() {
                    all.push(Shader { file: file.clone(), textures, arrays, module, info });
                }
            }
        }
    }
    assert!(all.len() > 120, "{}", all.len());
    all
}

type EntryPoint<'a> = (ShaderStage, &'a str);

/// What Vulkan is given.
fn to_spirv(module: &Module, info: &ModuleInfo, (shader_stage, name): EntryPoint<'_>) -> Result<(), String> {
    let options = spv::Options { lang_version: (1, 3), ..spv::Options::default() };
    let of = spv::PipelineOptions { shader_stage, entry_point: name.to_owned() };
    spv::write_vec(module, info, &options, Some(&of)).map(|_| ()).map_err(|error| error.to_string())
}

/// What Metal is given, since macOS 10.15 and Metal 2.3: older ones do not number triangles.
fn to_msl(module: &Module, info: &ModuleInfo, (stage, name): EntryPoint<'_>) -> Result<(), String> {
    let options = msl::Options { lang_version: (2, 3), ..msl::Options::default() };
    let of = msl::PipelineOptions {
        entry_point: Some((stage, name.to_owned())),
        ..msl::PipelineOptions::default()
    };
    let (_, translated) =
        msl::write_string(module, info, &options, &of).map_err(|error| error.to_string())?;
    let fault = translated.entry_point_names.iter().find_map(|name| name.as_ref().err());
    fault.map_or(Ok(()), |error| Err(error.to_string()))
}

/// What Direct3D 12 is given, of the oldest shader model that wgpu asks for.
fn to_hlsl(module: &Module, info: &ModuleInfo, (stage, name): EntryPoint<'_>) -> Result<(), String> {
    let options = hlsl::Options { shader_model: hlsl::ShaderModel::V6_0, ..hlsl::Options::default() };
    let of = hlsl::PipelineOptions { entry_point: Some((stage, name.to_owned())) };
    let mut text = String::new();
    let written = hlsl::Writer::new(&mut text, &options, &of).write(module, info, None);
    let fault =
        written.map_err(|error| error.to_string())?.entry_point_names.into_iter().find_map(Result::err);
    fault.map_or(Ok(()), |error| Err(error.to_string()))
}

#[test]
fn every_shader_is_translated_for_every_system() {
    type Translate = fn(&Module, &ModuleInfo, EntryPoint<'_>) -> Result<(), String>;
    let languages: [(&str, Translate); 3] = [("SPIR-V", to_spirv), ("MSL", to_msl), ("HLSL", to_hlsl)];
    let mut faults = Vec::new();
    for Shader { file, textures, arrays, module, info } in shaders() {
        for entry_point in &module.entry_points {
            let place = (entry_point.stage, entry_point.name.as_str());
            for on in [false, true] {
                // All switches are booleans.
                let names = module.overrides.iter().filter_map(|(_, switch)| switch.name.clone());
                let switches: PipelineConstants = names.map(|name| (name, f64::from(u8::from(on)))).collect();
                let (module, info) = process_overrides(&module, &info, Some(place), &switches).unwrap();
                for (language, translate) in languages {
                    // Which nobody gives Metal: see `IntegerTextures`.
                    if textures == IntegerTextures::Storage && language == "MSL" {
                        continue;
                    }
                    // Where it cannot go on, naga panics.
                    let translated = catch_unwind(AssertUnwindSafe(|| translate(&module, &info, place)));
                    if let Err(error) = translated.unwrap_or_else(|_| Err("naga panicked".to_owned())) {
                        let name = place.1;
                        faults.push(format!(
                            "shaders/{file}, {name}, {textures:?}, {arrays:?}, {language}: {error}"
                        ));
                    }
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Per stage.
#[derive(Debug, Default, Clone, Copy)]
struct Bound {
    sampled: u32,
    samplers: u32,
    storage_textures: u32,
    storage_buffers: u32,
    uniforms: u32,
}

impl Bound {
    fn of(module: &Module, info: &ModuleInfo, entry_point: usize) -> Self {
        let mut bound = Self::default();
        let uses = info.get_entry_point(entry_point);
        for (_, variable) in module.global_variables.iter().filter(|(handle, _)| !uses[*handle].is_empty()) {
            let count = match (variable.space, &module.types[variable.ty].inner) {
                (AddressSpace::Uniform, _) => &mut bound.uniforms,
                (AddressSpace::Storage { .. }, _) => &mut bound.storage_buffers,
                (_, TypeInner::Sampler { .. }) => &mut bound.samplers,
                (_, TypeInner::Image { class: ImageClass::Storage { .. }, .. }) => {
                    &mut bound.storage_textures
                }
                (_, TypeInner::Image { .. }) => &mut bound.sampled,
                _ => continue,
            };
            *count += 1;
        }
        bound
    }

    fn fits(self, limits: &wgpu::Limits) -> bool {
        self.sampled <= limits.max_sampled_textures_per_shader_stage
            && self.samplers <= limits.max_samplers_per_shader_stage
            && self.storage_textures <= limits.max_storage_textures_per_shader_stage
            && self.storage_buffers <= limits.max_storage_buffers_per_shader_stage
            && self.uniforms <= limits.max_uniform_buffers_per_shader_stage
    }
}

#[test]
fn every_shader_reads_and_writes_no_more_than_every_device_binds() {
    let mut faults = Vec::new();
    for Shader { file, textures, arrays, module, info } in shaders() {
        let limits = match textures {
            IntegerTextures::Sampled => wgpu::Limits::default(),
            IntegerTextures::Storage => wgpu::Limits {
                max_storage_textures_per_shader_stage: MAX_STORAGE_TEXTURES,
                ..wgpu::Limits::default()
            },
        };
        for (number, entry_point) in module.entry_points.iter().enumerate() {
            let bound = Bound::of(&module, &info, number);
            if !bound.fits(&limits) {
                faults.push(format!(
                    "shaders/{file}, {}, {textures:?}, {arrays:?}: {bound:?}",
                    entry_point.name
                ));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
