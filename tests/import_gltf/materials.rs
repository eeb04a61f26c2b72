//! Materials, their images, and the tangents that normal maps need.

use glam::{Vec2, Vec3};
use hachure::scene::{AlphaMode, Scene, Wrap};
use serde_json::{Value, json};

use crate::gltf_builder::{Model, png};
use crate::{QUAD, clean_mesh, with_primitives};

/// A quad with texture coordinates and this material.
fn with_material(material: &Value, image: &[u8]) -> Scene {
    let mut m = Model::new();
    let positions = m.floats("VEC3", &QUAD);
    let normals = m.floats("VEC3", &[0., 0., 1.].repeat(4));
    let uvs = m.floats("VEC2", &[0., 0., 1., 0., 1., 1., 0., 1.]);
    let other = m.floats("VEC2", &[0.5; 8]);
    let indices = m.u16s(&[0, 1, 2, 0, 2, 3]);
    let view = m.view(image);
    m.push("images", json!({"bufferView": view, "mimeType": "image/png", "name": "paint"}));
    m.push("samplers", json!({"magFilter": 9728, "wrapS": 33071, "wrapT": 33648}));
    m.push("textures", json!({"source": 0, "sampler": 0}));
    m.push("materials", material.clone());
    let attributes =
        json!({"POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs, "TEXCOORD_1": other});
    with_primitives(&mut m, json!([{"attributes": attributes, "indices": indices, "material": 0}]))
}

#[test]
fn materials_bring_factors_textures_and_samplers() {
    let scene = with_material(
        &json!({
            "name": "skin", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25,
            "extensions": {"KHR_materials_unlit": {}},
            "pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 0.25, 1], "baseColorTexture": {"index": 0,
                "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "rotation": 1.5707963, "scale": [2, 1]}}}}
        }),
        &png(8, 4),
    );
    assert_eq!(scene.warnings, []);
    let material = &scene.materials[0];
    assert_eq!((material.name.as_str(), material.double_sided, material.unlit), ("skin", true, true));
    assert_eq!(material.alpha, AlphaMode::Mask(0.25));
    assert_eq!(material.base_color.to_array(), [0.5, 1.0, 0.25, 1.0]);
    let used = material.base_color_texture.as_ref().unwrap();
    assert_eq!((used.wrap, used.nearest), ([Wrap::Clamp, Wrap::Mirror], true));
    // A quarter turn: u runs along −v of the image, v along u.
    let moved = used.transform.0.transform_point2(Vec2::new(1.0, 0.0));
    assert!((moved - Vec2::new(0.5, -2.0)).length() < 1e-5, "{moved}");
    let texture = &scene.textures[used.texture];
    assert_eq!((texture.width, texture.height, &texture.rgba[..4]), (8, 4, &[200, 100, 50, 255][..]));
    assert!(scene.meshes[0].tangents.is_empty(), "only a normal map needs tangents");
}

#[test]
fn a_missing_image_is_a_warning_and_transparency_is_none() {
    let texture = json!({"baseColorTexture": {"index": 0}});
    let scene = with_material(&json!({"alphaMode": "BLEND", "pbrMetallicRoughness": texture}), b"no image");
    let warnings: Vec<String> = scene.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].contains("model.glb, image 0 \"paint\"") && warnings[0].contains("neither a PNG"));
    assert_eq!(scene.materials[0].base_color_texture, None);
    assert_eq!(scene.materials[0].alpha, AlphaMode::Blend);
}

#[test]
fn normal_maps_get_tangents() {
    let scene = with_material(&json!({"normalTexture": {"index": 0, "scale": 0.5}}), &png(2, 2));
    let mesh = clean_mesh(&scene);
    assert_eq!(mesh.tangents.len(), mesh.positions.len());
    assert_eq!(mesh.positions.len(), 4, "equal tangents are not split");
    for tangent in &mesh.tangents {
        assert!((tangent.truncate() - Vec3::X).length() < 1e-5, "{tangent}");
        // The image stands on its head, so its green axis points down.
        assert_eq!(tangent.w, -1.0);
    }
    assert_eq!(scene.materials[0].normal_scale, 0.5);
}

#[test]
fn the_texture_coordinates_are_those_of_the_material() {
    let texture = json!({"baseColorTexture": {"index": 0, "texCoord": 1}});
    let scene = with_material(&json!({"pbrMetallicRoughness": texture}), &png(2, 2));
    assert_eq!(scene.meshes[0].uvs[2], Vec2::splat(0.5));
}
