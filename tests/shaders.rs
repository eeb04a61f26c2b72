//! Uniform twins: each Rust struct that goes to the device has the members of the shader's own struct. They are found in the
//! sources, by what they derive and by the words that stand above them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};

use hachure::geometry::EdgeClass;
use hachure::gpu::Shaders;
use hachure::gpu::uniform_arrays::can_be_uniform;
use hachure::style::Technique;
use strum::VariantNames as _;
use wgpu::naga::{
    AddressSpace, ArraySize, Expression, Handle, Literal, Module, Scalar, ScalarKind, StorageAccess, Type,
    TypeInner, VectorSize,
};

/// A struct that derives `ShaderType`.
struct Twin {
    /// Its name.
    rust: String,
    /// That of the shader's struct, and the file of that below `shaders/`.
    wgsl: String,
    file: String,
    /// Names and types.
    members: Vec<(String, String)>,
}

/// The texts of all files of the program.
fn sources() -> Vec<String> {
    let files = glob::glob(concat!(env!("CARGO_MANIFEST_DIR"), "/src/**/*.rs")).unwrap();
    files.map(|file| std::fs::read_to_string(file.unwrap()).unwrap()).collect()
}

fn twins(sources: &[String]) -> Vec<Twin> {
    let mut twins = Vec::new();
    for source in sources {
        let lines: Vec<&str> = source.lines().map(str::trim).collect();
        for (number, _) in lines.iter().enumerate().filter(|(_, line)| derives_layout(line)) {
            let first =
                lines[..number].iter().rposition(|line| !line.starts_with("///")).map_or(0, |i| i + 1);
            let words: String =
                lines[first..number].iter().map(|line| line.trim_start_matches('/')).collect();
            let mut below = lines[number..].iter().skip_while(|line| !line.contains("struct "));
            let rust =
                below.next().unwrap().split("struct ").nth(1).unwrap().trim_end_matches(" {").to_owned();
            let quoted = words.to_lowercase().find("twin of `").map(|at| words[at..].split('`'));
            let quoted: Vec<&str> = quoted.into_iter().flatten().collect();
            let [_, wgsl, _, file, ..] = quoted[..] else {
                panic!("{rust}: say \"Twin of `…` in `shaders/…`\" above it")
            };
            let members = below
                .take_while(|line| **line != "}")
                .filter(|line| !line.starts_with("//") && !line.starts_with("#["))
                .map(|line| line.trim_end_matches(',').split_once(": ").unwrap())
                .map(|(name, ty)| (name.split(' ').next_back().unwrap().to_owned(), rust_type(ty, sources)));
            twins.push(Twin {
                rust,
                wgsl: wgsl.to_owned(),
                file: file.strip_prefix("shaders/").unwrap().to_owned(),
                members: members.collect(),
            });
        }
    }
    twins
}

fn derives_layout(line: &str) -> bool {
    line.starts_with("#[derive(") && line.contains("ShaderType")
}

/// A type without its path, arrays with their lengths in figures.
fn rust_type(ty: &str, sources: &[String]) -> String {
    match ty.strip_prefix('[').and_then(|array| array.trim_end_matches(']').split_once("; ")) {
        Some((element, length)) => format!("[{element}; {}]", figures(length, sources)),
        None => ty.trim_start_matches("glam::").to_owned(),
    }
}

fn figures(length: &str, sources: &[String]) -> usize {
    if length == "EdgeClass::ALL.len()" {
        return EdgeClass::ALL.len();
    }
    let name = length.trim_end_matches(" as usize").trim_start_matches("parted_counter::");
    let constant = format!("const {name}: ");
    let declared =
        |source: &String| source.split_once(&constant)?.1.split_once("= ")?.1.split(';').next()?.parse().ok();
    let found: BTreeSet<usize> = match name.parse() {
        Ok(figures) => BTreeSet::from([figures]),
        Err(_) => sources.iter().filter_map(declared).collect(),
    };
    assert_eq!(found.len(), 1, "one length: {length}");
    found.into_iter().sum()
}

/// As a type of the shader is called in Rust.
fn wgsl_type(module: &Module, ty: Handle<Type>, twins: &BTreeMap<&str, &str>) -> String {
    let element = |base| wgsl_type(module, base, twins);
    match &module.types[ty].inner {
        TypeInner::Scalar(scalar) | TypeInner::Atomic(scalar) => {
            if scalar.kind == ScalarKind::Float { "f32" } else { "u32" }.to_owned()
        }
        TypeInner::Vector { size, scalar: Scalar { kind, .. } } => {
            format!("{}Vec{}", if *kind == ScalarKind::Float { "" } else { "U" }, *size as u8)
        }
        TypeInner::Matrix { columns: VectorSize::Quad, rows: VectorSize::Quad, .. } => "Mat4".to_owned(),
        TypeInner::Matrix { columns: VectorSize::Tri, rows: VectorSize::Tri, .. } => "Mat3".to_owned(),
        TypeInner::Array { base, size: ArraySize::Constant(length), .. } => {
            format!("[{}; {length}]", element(*base))
        }
        TypeInner::Array { base, size: ArraySize::Dynamic, .. } => format!("Vec<{}>", element(*base)),
        TypeInner::Struct { .. } => {
            let name = module.types[ty].name.as_deref().unwrap();
            twins.get(name).map_or_else(|| format!("a twin of {name}"), |rust| (*rust).to_owned())
        }
        other => panic!("{other:?}"),
    }
}

/// Names and types of the members of a shader's struct.
fn members(file: &str, name: &str, twins: &BTreeMap<&str, &str>) -> Vec<(String, String)> {
    let module = Shaders::default().validate(file).unwrap();
    let (_, found) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).unwrap();
    let TypeInner::Struct { members, .. } = &found.inner else { panic!("{name} is no struct") };
    members.iter().map(|m| (m.name.clone().unwrap(), wgsl_type(&module, m.ty, twins))).collect()
}

#[test]
fn rust_and_wgsl_agree_on_every_struct() {
    let twins = twins(&sources());
    let by_wgsl: BTreeMap<&str, &str> =
        twins.iter().map(|twin| (twin.wgsl.as_str(), twin.rust.as_str())).collect();
    assert!(twins.len() >= 29, "{}", twins.len());
    for Twin { rust, wgsl, file, members: own } in &twins {
        assert_eq!(*own, members(file, wgsl, &by_wgsl), "{rust} and {wgsl} in shaders/{file}");
    }
    // Where two shaders declare the same buffer.
    let members = |file, name| members(file, name, &by_wgsl);
    let counted = members("common/counted.wgsl", "Counted");
    assert!(
        counted.starts_with(&members("common/layer_count.wgsl", "LayerCount")),
        "a blueprint reads the beginning of it"
    );
    assert_eq!(members("passes/depth_mask.wgsl", "Counted"), members("common/depth_mask.wgsl", "Masked"));
}

#[test]
fn no_uniform_is_without_a_twin_and_no_array_of_structs_unfit_for_one() {
    let twins = twins(&sources());
    for file in Shaders::embedded() {
        let module = Shaders::default().validate(&file).unwrap();
        for (_, variable) in module.global_variables.iter() {
            let ty = &module.types[variable.ty];
            if let (AddressSpace::Uniform, Some(name)) = (variable.space, ty.name.as_deref()) {
                assert!(name == "LayerCount" || twins.iter().any(|twin| twin.wgsl == name), "{file}: {name}");
            }
            let is_read = variable.space == AddressSpace::Storage { access: StorageAccess::LOAD };
            if let TypeInner::Array { size: ArraySize::Dynamic, base, .. } = ty.inner
                && matches!(module.types[base].inner, TypeInner::Struct { .. })
                && is_read
            {
                assert!(
                    can_be_uniform(&module, variable),
                    "{file}: {:?} lies otherwise than uniforms do",
                    variable.name
                );
            }
        }
    }
}

/// The value of a whole number that a shader calls so.
fn constant(module: &Module, name: &str) -> Option<u32> {
    let (_, found) = module.constants.iter().find(|(_, c)| c.name.as_deref() == Some(name))?;
    match module.global_expressions[found.init] {
        Expression::Literal(Literal::U32(number)) => Some(number),
        _ => None,
    }
}

#[test]
fn shaders_number_techniques_as_styles_do() {
    let module = Shaders::default().validate("effects/surface.wgsl").unwrap();
    for name in Technique::VARIANTS {
        let number = name.parse::<Technique>().unwrap() as u32;
        assert_eq!(constant(&module, &name.to_uppercase()), Some(number), "{name}");
    }
}

#[test]
fn shaders_number_classes_of_edges_from_1() {
    let module = Shaders::default().validate("passes/show.wgsl").unwrap();
    for (number, class) in (1..).zip(EdgeClass::ALL) {
        let name = <&str>::from(class);
        assert_eq!(constant(&module, &name.to_uppercase()), Some(number), "{name}");
    }
}
