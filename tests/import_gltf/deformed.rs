//! Meshes whose vertices are not simply there: morph targets, skins, compression.

use glam::Vec3;
use hachure::import::{ImportOptions, Progress, load_all};
use serde_json::json;

use crate::gltf_builder::Model;
use crate::{clean_mesh, scene_of, with_primitives};

#[test]
fn default_morph_weights_are_applied() {
    let mut m = Model::triangle();
    let deltas = m.floats("VEC3", &[0., 0., 2., 0., 0., 2., 0., 0., 4.]);
    m.json["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": deltas}]);
    m.json["meshes"][0]["weights"] = json!([0.5]);
    m.node(json!({"mesh": 0, "weights": [0.25]}));
    let scene = scene_of(&m);
    assert_eq!(scene.meshes.len(), 2);
    assert_eq!(scene.meshes[0].positions[2], Vec3::new(0.0, 1.0, 2.0));
    assert_eq!(scene.meshes[1].positions[2], Vec3::new(0.0, 1.0, 1.0));
}

#[test]
fn skinned_meshes_stand_in_the_pose_of_the_file() {
    let mut m = Model::triangle();
    let joints = m.accessor(5121, "VEC4", 3, &[0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0]);
    let weights = m.floats("VEC4", &[1., 0., 0., 0., 2., 0., 0., 0., 0.5, 0.5, 0., 0.]);
    let mut inverse = [0.0_f32; 32];
    for matrix in inverse.chunks_exact_mut(16) {
        matrix.copy_from_slice(&glam::Mat4::from_translation(Vec3::NEG_X).to_cols_array());
    }
    let binds = m.floats("MAT4", &inverse);
    let attributes = &mut m.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = json!(joints);
    attributes["WEIGHTS_0"] = json!(weights);
    m.json["nodes"][0]["skin"] = json!(0);
    m.json["nodes"][0]["translation"] = json!([99, 99, 99]);
    let left = m.node(json!({"name": "left", "translation": [1, 0, 0]}));
    let right = m.node(json!({"name": "right", "translation": [1, 0, 4]}));
    m.push("skins", json!({"joints": [left, right], "inverseBindMatrices": binds}));
    let scene = scene_of(&m);
    let mesh = clean_mesh(&scene);
    // The node's own transform does not count; the joints' do.
    assert_eq!(scene.nodes[1].world_from_local, glam::DMat4::IDENTITY);
    let expected = [Vec3::ZERO, Vec3::new(1., 0., 4.), Vec3::new(0., 1., 2.)];
    assert_eq!(mesh.positions, expected);
    let rig = mesh.rig.as_ref().unwrap();
    assert_eq!(
        rig.joints.iter().map(|&j| scene.nodes[j].name.as_str()).collect::<Vec<_>>(),
        ["left", "right"]
    );
    assert_eq!(rig.rest_positions[1], Vec3::X);
    assert_eq!(rig.vertex_weights[1], [1.0, 0.0, 0.0, 0.0]);

    // Two files in one scene: joints still name the right nodes.
    let folder = tempfile::tempdir().unwrap();
    let path = m.write(folder.path(), "arm.glb");
    let both = load_all(&[path.clone(), path], &ImportOptions::default(), &Progress::default()).unwrap();
    let rig = both.meshes[1].rig.as_ref().unwrap();
    assert_eq!(both.nodes[rig.joints[1]].path, "/arm.2/right");
}

/// Declares that a view is packed in these bytes.
fn pack(m: &mut Model, view: usize, stride: usize, count: usize, mode: &str, filter: &str, packed: &[u8]) {
    let source = m.view(packed);
    let offset = m.json["bufferViews"][source]["byteOffset"].clone();
    let declared = &mut m.json["bufferViews"][view];
    declared["buffer"] = json!(1);
    declared["byteOffset"] = json!(0);
    declared["byteLength"] = json!(stride * count);
    declared["extensions"] = json!({"EXT_meshopt_compression": {"buffer": 0, "byteOffset": offset,
        "byteLength": packed.len(), "byteStride": stride, "count": count, "mode": mode, "filter": filter}});
}

#[test]
fn meshopt_compression_is_unpacked() {
    let grid: Vec<[f32; 3]> = (0..64).map(|i| [(i % 8) as f32, (i / 8) as f32, (i % 5) as f32]).collect();
    let mut indices = Vec::new();
    for i in (0..56_u32).filter(|i| i % 8 < 7) {
        indices.extend([i, i + 1, i + 9, i, i + 9, i + 8]);
    }
    let normals: Vec<[f32; 4]> = grid
        .iter()
        .map(|p| Vec3::new(p[0] - 3.0, 1.0, p[2] - 2.0).normalize().extend(0.0).to_array())
        .collect();
    for (mode, exponential) in [("TRIANGLES", false), ("INDICES", true)] {
        let mut m = Model::new();
        let positions = m.floats("VEC3", grid.as_flattened());
        let normal = m.accessor(5120, "VEC3", 64, &[0; 256]);
        m.json["accessors"][normal]["normalized"] = json!(true);
        let view_of = |m: &Model, a: usize| m.json["accessors"][a]["bufferView"].as_u64().unwrap() as usize;
        let normal_view = view_of(&m, normal);
        m.json["bufferViews"][normal_view]["byteStride"] = json!(4);
        let index = m.u32s(&indices);

        let position_view = view_of(&m, positions);
        if exponential {
            let flat: Vec<[f32; 3]> = grid.clone();
            let encoded = meshopt::encode_filter_exp(&flat, 15, meshopt::EncodeExpMode::SharedVector);
            let packed = meshopt::encode_vertex_buffer(&encoded).unwrap();
            pack(&mut m, position_view, 12, 64, "ATTRIBUTES", "EXPONENTIAL", &packed);
        } else {
            let packed = meshopt::encode_vertex_buffer(&grid).unwrap();
            pack(&mut m, position_view, 12, 64, "ATTRIBUTES", "NONE", &packed);
        }
        let octahedral: Vec<[i8; 4]> = meshopt::encode_filter_oct(&normals, 8);
        let packed = meshopt::encode_vertex_buffer(&octahedral).unwrap();
        pack(&mut m, normal_view, 4, 64, "ATTRIBUTES", "OCTAHEDRAL", &packed);
        let packed = if mode == "TRIANGLES" {
            meshopt::encode_index_buffer(&indices, 64).unwrap()
        } else {
            meshopt::encode_index_sequence(&indices, 64).unwrap()
        };
        let index_view = view_of(&m, index);
        pack(&mut m, index_view, 4, indices.len(), mode, "NONE", &packed);
        let fallback = json!({"EXT_meshopt_compression": {"fallback": true}});
        m.json["buffers"] = json!([{"byteLength": m.bin.len()}, {"byteLength": 9999, "uri": "absent.bin", "extensions": fallback}]);
        m.json["extensionsRequired"] = json!(["EXT_meshopt_compression"]);
        let attributes = json!({"POSITION": positions, "NORMAL": normal});
        let scene = with_primitives(&mut m, json!([{"attributes": attributes, "indices": index}]));
        let mesh = clean_mesh(&scene);
        // The encoder may turn triangles, but not wind them the other way.
        let turned = |t: &[u32; 3]| (0..3).map(|k| [t[k], t[(k + 1) % 3], t[(k + 2) % 3]]).min().unwrap();
        let sorted = |indices: &[u32]| indices.as_chunks().0.iter().map(turned).collect::<Vec<_>>();
        assert_eq!(sorted(&mesh.indices), sorted(&indices), "{mode}");
        for (vertex, position) in grid.iter().enumerate() {
            assert!((mesh.positions[vertex] - Vec3::from_array(*position)).length() < 1e-3);
            let wanted = Vec3::from_slice(&normals[vertex]);
            assert!((mesh.normals[vertex] - wanted).length() < 0.03, "{mode} {vertex}");
        }
    }
}
