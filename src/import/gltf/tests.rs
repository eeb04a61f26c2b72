//! Mutations of a small valid file: the importer itself, without the safety net around it, must never panic.

use std::path::Path;

use super::load;
use crate::import::{ImportOptions, Progress};

/// A GLB with two triangles, normals, texture coordinates, a skin, a morph target, a sparse accessor, an image, a
/// camera and a light.
fn small_glb() -> Vec<u8> {
    let mut bin = Vec::new();
    let floats = |bin: &mut Vec<u8>, values: &[f32]| {
        let start = bin.len();
        bin.extend(values.iter().flat_map(|v| v.to_le_bytes()));
        (start, bin.len() - start)
    };
    let positions = floats(&mut bin, &[0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.]);
    let normals = floats(&mut bin, &[0., 0., 1., 0., 0., 1., 0., 0., 1., 0., 0., 1.]);
    let uvs = floats(&mut bin, &[0., 0., 1., 0., 1., 1., 0., 1.]);
    let weights = floats(&mut bin, &[1., 0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0.]);
    let delta = floats(&mut bin, &[0.1, 0.2, 0.3]);
    let joints = (bin.len(), 16);
    bin.extend([0_u8; 16]);
    let indices = (bin.len(), 6);
    bin.extend([0_u8, 1, 2, 0, 2, 3, 0, 0]);
    let mut png = Vec::new();
    ::image::DynamicImage::new_rgb8(2, 2)
        .write_to(&mut std::io::Cursor::new(&mut png), ::image::ImageFormat::Png)
        .unwrap();
    let image = (bin.len(), png.len());
    bin.extend(png);
    let view = |(offset, length): (usize, usize)| serde_json::json!({"buffer": 0, "byteOffset": offset, "byteLength": length});
    let json = serde_json::json!({
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 3.0, "spot": {}}]}},
        "scene": 0,
        "scenes": [{"nodes": [0, 2]}],
        "nodes": [
            {"name": "quad", "mesh": 0, "skin": 0, "children": [1]},
            {"name": "joint", "translation": [0.0, 1.0, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0]},
            {"name": "eye", "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}
        ],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
        "skins": [{"joints": [1]}],
        "meshes": [{"weights": [0.5], "primitives": [{
            "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "JOINTS_0": 3, "WEIGHTS_0": 4},
            "indices": 5, "material": 0, "targets": [{"POSITION": 6}]}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 0}}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"magFilter": 9728, "wrapS": 33071}],
        "images": [{"bufferView": 6, "mimeType": "image/png"}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 3, "componentType": 5121, "count": 4, "type": "VEC4"},
            {"bufferView": 4, "componentType": 5126, "count": 4, "type": "VEC4"},
            {"bufferView": 5, "componentType": 5121, "count": 6, "type": "SCALAR"},
            {"componentType": 5126, "count": 4, "type": "VEC3", "sparse": {"count": 1,
                "indices": {"bufferView": 5, "componentType": 5121}, "values": {"bufferView": 7}}}
        ],
        "bufferViews": [view(positions), view(normals), view(uvs), view(joints), view(weights), view(indices),
            view(image), view(delta)],
        "buffers": [{"byteLength": bin.len()}]
    });
    let mut json = serde_json::to_vec(&json).unwrap();
    json.resize(json.len().next_multiple_of(4), b' ');
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend((28 + json.len() as u32 + bin.len() as u32).to_le_bytes());
    glb.extend((json.len() as u32).to_le_bytes());
    glb.extend(b"JSON");
    glb.extend(json);
    glb.extend((bin.len() as u32).to_le_bytes());
    glb.extend(b"BIN\0");
    glb.extend(bin);
    glb
}

/// A small generator of numbers that are the same in every run (xorshift).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % end as u64) as usize
    }
}

#[test]
fn mutated_files_never_panic() {
    let good = small_glb();
    let read = |data: &[u8]| {
        load(Path::new("fuzz/mutant.glb"), data, &ImportOptions::default(), &Progress::default())
    };
    let scene = read(&good).unwrap();
    assert_eq!(scene.triangle_count(), 2);
    assert_eq!(scene.warnings, []);
    assert_eq!((scene.cameras.len(), scene.lights.len()), (1, 1));
    assert!(scene.meshes[0].rig.is_some());
    assert!(!scene.meshes[0].tangents.is_empty());

    let mut numbers = Numbers(0x9E37_79B9_7F4A_7C15);
    let (mut loaded, mut refused) = (0, 0);
    for round in 0..400 {
        let mut mutant = good.clone();
        for _ in 0..=numbers.below(4) {
            let at = numbers.below(mutant.len());
            match round % 4 {
                0 => mutant[at] ^= 1 << numbers.below(8),
                1 => mutant[at] = b"0123456789-eE.,"[numbers.below(15)],
                2 => {
                    // Digits only: the JSON stays whole while its numbers go wrong.
                    if let Some(digit) = (at..mutant.len()).find(|&i| mutant[i].is_ascii_digit()) {
                        mutant[digit] = b'0' + numbers.below(10) as u8;
                    }
                }
                _ => mutant.truncate(at.max(1)),
            }
        }
        match read(&mutant) {
            Ok(_) => loaded += 1,
            Err(_) => refused += 1,
        }
    }
    assert!(loaded > 40 && refused > 100, "{loaded} loaded, {refused} refused");
}

#[test]
fn mutated_buffers_load_without_panic() {
    let good = small_glb();
    let json_len = u32::from_le_bytes(good[12..16].try_into().unwrap()) as usize;
    let mut numbers = Numbers(42);
    for _ in 0..200 {
        let mut mutant = good.clone();
        for _ in 0..20 {
            let at = 28 + json_len + numbers.below(good.len() - 28 - json_len);
            mutant[at] = [0, 255, 127, 128, 1][numbers.below(5)];
        }
        let _ = load(Path::new("fuzz/mutant.glb"), &mutant, &ImportOptions::default(), &Progress::default());
    }
}
