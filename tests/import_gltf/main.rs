//! What becomes of glTF models: hierarchy, geometry, materials, cameras, lights, skins, compression.

#![allow(
    clippy::unwrap_used,
    clippy::needless_pass_by_value,
    clippy::approx_constant,
    reason = "tests are to be read"
)]

mod deformed;
#[path = "../gltf_builder/mod.rs"]
mod gltf_builder;
mod materials;

use std::path::Path;

use glam::{DVec3, Vec2, Vec3};
use gltf_builder::Model;
use hachure::geometry::{Mesh, SeamTolerance};
use hachure::import::{ImportError, ImportOptions, Progress, load, load_all};
use hachure::scene::{LightKind, Projection, Scene};
use serde_json::{Value, json};

const QUAD: [f32; 12] = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.];

fn load_bytes(name: &str, bytes: &[u8]) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    open(&path)
}

/// What is in a file; mending seams is another matter.
fn open(path: &Path) -> Scene {
    let options = ImportOptions { seams: SeamTolerance::Fraction(0.0), ..ImportOptions::default() };
    load(path, &options, &Progress::default()).unwrap()
}

fn scene_of(model: &Model) -> Scene {
    load_bytes("model.glb", &model.glb())
}

/// A model of one node with one mesh of these primitives.
fn with_primitives(model: &mut Model, primitives: Value) -> Scene {
    let mesh = model.push("meshes", json!({"primitives": primitives}));
    model.node(json!({"mesh": mesh}));
    scene_of(model)
}

fn paths(scene: &Scene) -> Vec<&str> {
    scene.nodes.iter().map(|n| n.path.as_str()).collect()
}

fn clean_mesh(scene: &Scene) -> &Mesh {
    assert_eq!(scene.warnings, []);
    assert_eq!(scene.meshes.len(), 1);
    &scene.meshes[0]
}

#[test]
fn nodes_keep_order_names_and_transforms() {
    let mut m = Model::triangle();
    m.json["nodes"] = json!([
        {"name": "crank", "children": [1, 2, 4], "translation": [1, 2, 3]},
        {"name": "rod", "mesh": 0, "scale": [-2, 1, 1]},
        {"name": "rod", "children": [3], "rotation": [0, 0, 0.70710678, 0.70710678]},
        {"name": "a/b", "mesh": 0, "translation": [1, 0, 0]},
        {"name": "rod", "mesh": 0, "scale": [0, 0, 0]},
        {"mesh": 0}
    ]);
    m.json["meshes"][0]["name"] = json!("plate");
    m.json["scenes"][0]["nodes"] = json!([5, 0]);
    let scene = load_bytes("my.model.glb", &m.glb());
    assert_eq!(
        paths(&scene),
        [
            "/my.model",
            "/my.model/plate",
            "/my.model/crank",
            "/my.model/crank/rod",
            "/my.model/crank/rod.2",
            "/my.model/crank/rod.2/a_b",
            "/my.model/crank/rod.3"
        ]
    );
    let descendants: Vec<usize> = scene.nodes.iter().map(|n| n.descendants).collect();
    assert_eq!(descendants, [6, 0, 4, 0, 1, 0, 0]);
    assert_eq!(scene.nodes[5].parent, Some(4));
    assert_eq!(scene.meshes.len(), 1, "nodes share the mesh");
    assert!(scene.nodes[3].world_from_local.determinant() < 0.0);
    assert_eq!(scene.nodes[6].world_from_local.determinant(), 0.0);
    let origin = scene.nodes[5].world_from_local.transform_point3(DVec3::ZERO);
    assert!((origin - DVec3::new(1.0, 3.0, 3.0)).length() < 1e-6, "{origin}");
}

#[test]
fn the_default_scene_is_shown() {
    let mut m = Model::triangle();
    m.push("nodes", json!({"name": "other", "mesh": 0}));
    m.json["scenes"] = json!([{"nodes": [0]}, {"nodes": [1]}]);
    m.json["scene"] = json!(1);
    assert_eq!(paths(&scene_of(&m)), ["/model", "/model/other"]);
    m.json["scene"] = Value::Null;
    assert_eq!(paths(&scene_of(&m)), ["/model", "/model/tri"]);
    m.json["scenes"] = json!([]);
    assert_eq!(paths(&scene_of(&m)), ["/model", "/model/tri", "/model/other"]);
}

#[test]
fn primitives_become_parts_with_the_same_attributes() {
    let mut m = Model::new();
    let a = m.floats("VEC3", &QUAD);
    let b = m.floats("VEC3", &QUAD.map(|v| v + 5.0));
    let normals = m.floats("VEC3", &[0., 0., 2.].repeat(4));
    let colors = m.accessor(5121, "VEC4", 4, &[255, 0, 0, 128].repeat(4));
    m.json["accessors"][colors]["normalized"] = json!(true);
    let indices = m.u16s(&[0, 1, 2, 0, 2, 3]);
    m.json["materials"] = json!([{"name": "first"}, {"name": "second"}]);
    let scene = with_primitives(
        &mut m,
        json!([
            {"attributes": {"POSITION": b}, "indices": indices, "material": 1},
            {"attributes": {"POSITION": a, "NORMAL": normals, "COLOR_0": colors}, "indices": indices, "material": 0},
            {"attributes": {"POSITION": b}, "indices": indices, "material": 1},
        ]),
    );
    let mesh = &scene.meshes[0];
    let parts: Vec<_> = mesh.submeshes.iter().map(|p| (p.first_index, p.index_count, p.material)).collect();
    // The third primitive repeats the first, and duplicate triangles go.
    assert_eq!(parts, [(0, 6, 0), (6, 6, 1)]);
    assert_eq!(mesh.normals.len(), mesh.positions.len());
    assert!(mesh.normals.iter().all(|n| (*n - Vec3::Z).length() < 1e-6));
    assert_eq!(mesh.colors[0], [255, 0, 0, 128]);
    assert_eq!(mesh.colors[mesh.indices[6] as usize], [255; 4]);
    assert_eq!(mesh.positions[mesh.indices[6] as usize], Vec3::splat(5.0));
    assert!(scene.warnings[0].to_string().contains("duplicate"));
}

#[test]
fn without_normals_a_mesh_stays_flat() {
    let mut m = Model::new();
    let a = m.floats("VEC3", &QUAD);
    let indices = m.u16s(&[0, 1, 2, 0, 2, 3]);
    let scene = with_primitives(&mut m, json!([{"attributes": {"POSITION": a}, "indices": indices}]));
    let mesh = clean_mesh(&scene);
    assert!(mesh.normals.is_empty());
    assert_eq!((mesh.positions.len(), mesh.indices.len()), (4, 6));
    assert_eq!(scene.materials.len(), 1);
}

#[test]
fn strips_fans_and_lists_without_indices_are_read() {
    let mut m = Model::new();
    let strip = m.floats("VEC3", &[0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0.]);
    let scene = with_primitives(&mut m, json!([{"attributes": {"POSITION": strip}, "mode": 5}]));
    assert_eq!(clean_mesh(&scene).indices, [0, 1, 2, 1, 3, 2]);

    let mut m = Model::new();
    let fan = m.floats("VEC3", &QUAD);
    let scene = with_primitives(&mut m, json!([{"attributes": {"POSITION": fan}, "mode": 6}]));
    assert_eq!(clean_mesh(&scene).indices, [0, 1, 2, 0, 2, 3]);
    assert_eq!(clean_mesh(&scene_of(&Model::triangle())).indices, [0, 1, 2]);
}

#[test]
fn indices_of_every_width_are_read() {
    for component in [5121, 5123, 5125] {
        let mut m = Model::new();
        let positions = m.floats("VEC3", &QUAD);
        let indices = match component {
            5121 => m.accessor(5121, "SCALAR", 3, &[0, 2, 3]),
            5123 => m.u16s(&[0, 2, 3]),
            _ => m.u32s(&[0, 2, 3]),
        };
        let primitives = json!([{"attributes": {"POSITION": positions}, "indices": indices}]);
        assert_eq!(clean_mesh(&with_primitives(&mut m, primitives)).indices, [0, 2, 3]);
    }
}

#[test]
fn interleaved_sparse_and_quantized_accessors_are_read() {
    // Positions as i16, normals as normalized i8, texture coordinates as normalized u16, in elements of 16 bytes.
    let mut m = Model::new();
    let mut bytes = Vec::new();
    for (x, y) in [(0_i16, 0_i16), (100, 0), (0, -100)] {
        bytes.extend([x, y, 7, 0].iter().flat_map(|v| v.to_le_bytes()));
        bytes.extend([0_u8, 0, 0x81, 0]);
        bytes.extend([u16::MAX, 0].iter().flat_map(|v| v.to_le_bytes()));
    }
    let view = m.view(&bytes);
    m.json["bufferViews"][view]["byteStride"] = json!(16);
    let mut accessor = |offset: usize, component: u32, kind: &str, normalized: bool| {
        let value = json!({"bufferView": view, "byteOffset": offset, "componentType": component, "count": 3,
            "type": kind, "normalized": normalized});
        m.push("accessors", value)
    };
    let positions = accessor(0, 5122, "VEC3", false);
    let normals = accessor(8, 5120, "VEC3", true);
    let uvs = accessor(12, 5123, "VEC2", true);
    let at = m.view(&[2, 0, 0, 0]);
    let values = m.view(bytemuck::cast_slice(&[50_i16, 60, 70]));
    m.json["accessors"][positions]["sparse"] = json!({"count": 1,
        "indices": {"bufferView": at, "componentType": 5121}, "values": {"bufferView": values}});
    m.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let attributes = json!({"POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs});
    let scene = with_primitives(&mut m, json!([{"attributes": attributes}]));
    let mesh = clean_mesh(&scene);
    let expected = [Vec3::new(0., 0., 7.), Vec3::new(100., 0., 7.), Vec3::new(50., 60., 70.)];
    assert_eq!(mesh.positions, expected);
    assert_eq!(mesh.normals, [Vec3::NEG_Z; 3]);
    assert_eq!(mesh.uvs, [Vec2::X; 3]);
}

#[test]
fn shared_vertices_are_stored_once_and_unused_ones_not_at_all() {
    let mut m = Model::new();
    let many: Vec<f32> = (0..3000).map(|i| (i * i % 997) as f32).collect();
    let positions = m.floats("VEC3", &many);
    let all: Vec<u32> = (0..999).collect();
    let first = m.u32s(&all[..600]);
    let second = m.u32s(&all[300..]);
    let few = m.u32s(&[996, 997, 998]);
    let primitive = |indices: usize| json!({"attributes": {"POSITION": positions}, "indices": indices});
    let mesh = m.push("meshes", json!({"primitives": [primitive(first), primitive(second)]}));
    let small = m.push("meshes", json!({"primitives": [primitive(few)]}));
    m.node(json!({"mesh": mesh}));
    m.node(json!({"mesh": small}));
    let scene = scene_of(&m);
    assert!(scene.meshes[0].positions.len() <= 1000);
    assert_eq!(scene.meshes[1].positions.len(), 3);
    assert_eq!(scene.meshes[1].positions[2].x, many[998 * 3]);
}

#[test]
fn buffers_come_from_side_files_and_data_uris() {
    let model = Model::triangle();
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("sub")).unwrap();
    std::fs::write(folder.path().join("sub/my data.bin"), &model.bin).unwrap();
    let mut json = model.finished_json();
    let path = folder.path().join("side.gltf");
    json["buffers"][0]["uri"] = json!("sub/my%20data.bin");
    std::fs::write(&path, json.to_string()).unwrap();
    assert_eq!(open(&path).triangle_count(), 1);
    // Nine floats: 0 0 0  1 0 0  0 1 0.
    let payload = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    json["buffers"][0]["uri"] = json!(format!("data:application/octet-stream;base64,{payload}"));
    std::fs::write(&path, json.to_string()).unwrap();
    assert_eq!(open(&path).meshes[0].positions[1], Vec3::X);
}

#[test]
fn cameras_and_lights_are_in_world_space() {
    let mut m = Model::triangle();
    m.json["cameras"] = json!([
        {"type": "perspective", "perspective": {"yfov": 0.785398163, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 3, "znear": 0, "zfar": 9}}
    ]);
    m.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "directional", "intensity": 2, "color": [1, 0.5, 0]}, {"type": "spot", "intensity": 500, "spot": {}}
    ]}});
    let light = |index: usize| json!({"KHR_lights_punctual": {"light": index}});
    m.node(json!({"name": "eye", "camera": 0, "translation": [0.5, 0.5, 10], "extensions": light(1)}));
    m.node(json!({"name": "top", "camera": 1, "rotation": [-0.70710678, 0, 0, 0.70710678], "extensions": light(0)}));
    let scene = scene_of(&m);
    let (name, eye) = &scene.cameras[0];
    assert_eq!(name, "eye");
    assert!((eye.focal_point - DVec3::new(0.5, 0.5, 0.0)).length() < 1e-9, "{:?}", eye.focal_point);
    let Projection::Perspective { view_angle } = eye.projection else { panic!("{eye:?}") };
    assert!((view_angle - 45.0).abs() < 1e-4);
    let (_, top) = &scene.cameras[1];
    assert_eq!(top.projection, Projection::Orthographic { view_height: 6.0 });
    assert!((top.forward() - DVec3::NEG_Y).length() < 1e-6);
    assert_eq!(scene.lights.len(), 2);
    assert_eq!(scene.lights[0].kind, LightKind::Point { position: DVec3::new(0.5, 0.5, 10.0) });
    assert_eq!(scene.lights[0].intensity, 1.0);
    assert!((scene.lights[1].intensity - 0.004).abs() < 1e-6);
    let LightKind::Directional { direction } = scene.lights[1].kind else { panic!() };
    assert!((direction - DVec3::NEG_Y).length() < 1e-6);
}

#[test]
fn several_files_become_one_scene() {
    let folder = tempfile::tempdir().unwrap();
    let paths_given: Vec<_> = ["a.glb", "b.glb", "c/a.glb"]
        .iter()
        .map(|name| {
            std::fs::create_dir_all(folder.path().join("c")).unwrap();
            Model::triangle().write(folder.path(), name)
        })
        .collect();
    let progress = Progress::default();
    let scene = load_all(&paths_given, &ImportOptions::default(), &progress).unwrap();
    assert_eq!(paths(&scene), ["/a", "/a/tri", "/b", "/b/tri", "/a.2", "/a.2/tri"]);
    assert_eq!(scene.nodes[5].parent, Some(4));
    assert_eq!(scene.nodes[5].mesh, Some(2));
    assert_eq!(scene.meshes[2].submeshes[0].material, 2);
    assert!(progress.share() > 0.99, "{}", progress.share());

    progress.cancel();
    let stopped = load_all(&paths_given, &ImportOptions::default(), &progress);
    assert!(matches!(stopped, Err(ImportError::Canceled)));
}
