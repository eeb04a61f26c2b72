//! Hostile and damaged files: each gives the error or warning that it must, quickly and in bounded memory.
//!
//! This table is about glTF, GLB and what holds for every format; the rows for OBJ, STL and PLY are in
//! `bad_input_text.rs`.

#![allow(clippy::unwrap_used, reason = "a test may")]

mod gltf_builder;

use std::alloc::{GlobalAlloc, Layout, System};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use gltf_builder::{Model, glb, lying_png};
use hachure::import::{ImportError, ImportOptions, Progress, load};
use hachure::scene::Scene;
use serde_json::json;

/// Counts what is allocated, and the most that ever was.
struct Counting;

static NOW: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

#[expect(unsafe_code, reason = "an allocator cannot be written without")]
// SAFETY: everything is passed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        grew(layout.size());
        unsafe { System.alloc(layout) }
    }
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        grew(layout.size());
        unsafe { System.alloc_zeroed(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Ordering::Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }
}

fn grew(bytes: usize) {
    let now = NOW.fetch_add(bytes, Ordering::Relaxed) + bytes;
    PEAK.fetch_max(now, Ordering::Relaxed);
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// What must come of a file.
#[derive(Debug)]
enum Expect {
    Read(&'static str),
    UnknownFormat,
    Malformed(&'static str),
    Unsupported(&'static str),
    Empty(&'static str),
    /// It loads, with a warning that contains the text.
    Warning(&'static str),
    /// It loads without a warning.
    Loads,
}

fn agrees(result: &Result<Scene, ImportError>, expected: &Expect) -> bool {
    let message = result.as_ref().err().map(ToString::to_string).unwrap_or_default();
    match (result, expected) {
        (Err(ImportError::Read { .. }), Expect::Read(text))
        | (Err(ImportError::Malformed { .. }), Expect::Malformed(text))
        | (Err(ImportError::Unsupported { .. }), Expect::Unsupported(text))
        | (Err(ImportError::Empty { .. }), Expect::Empty(text)) => message.contains(text),
        (Err(ImportError::UnknownFormat { .. }), Expect::UnknownFormat) => true,
        (Ok(scene), Expect::Warning(text)) => {
            scene.triangle_count() > 0 && scene.warnings.iter().any(|w| w.to_string().contains(text))
        }
        (Ok(scene), Expect::Loads) => scene.triangle_count() > 0 && scene.warnings.is_empty(),
        _ => false,
    }
}

/// The triangle after a change of its JSON.
fn changed(change: impl FnOnce(&mut Model)) -> Vec<u8> {
    let mut model = Model::triangle();
    change(&mut model);
    model.glb()
}

/// The triangle with a color image.
fn with_image(image: serde_json::Value, view: Option<&[u8]>) -> Vec<u8> {
    changed(|m| {
        let mut image = image;
        if let Some(bytes) = view {
            image["bufferView"] = json!(m.view(bytes));
            image["mimeType"] = json!("image/png");
        }
        m.push("images", image);
        m.push("textures", json!({"source": 0}));
        let material = json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}});
        m.push("materials", material);
        m.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    })
}

/// A chain of nodes with the triangle at its end.
fn chain(levels: usize) -> Vec<u8> {
    changed(|m| {
        m.json["scenes"][0]["nodes"] = json!([1]);
        for level in 1..=levels {
            let child = if level == levels { 0 } else { level + 1 };
            m.push("nodes", json!({"name": "link", "children": [child]}));
        }
    })
}

// Long, as it is a table: a file and what is to be said of it per row.
fn rows() -> Vec<(&'static str, Vec<u8>, Expect)> {
    use Expect::*;
    let good = Model::triangle().glb();
    let cut = |n: usize| good[..n].to_vec();
    let buffers = |uri: &str| {
        let json = json!({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": uri}]});
        serde_json::to_vec(&json).unwrap()
    };
    let nodes = |nodes: serde_json::Value, roots: serde_json::Value| {
        changed(|m| {
            m.json["nodes"] = nodes;
            m.json["scenes"][0]["nodes"] = roots;
        })
    };
    let accessor =
        |key: &'static str, value: serde_json::Value| changed(|m| m.json["accessors"][0][key] = value);
    let packed = |count: u64, mode: &str, bytes: &[u8]| {
        changed(|m| {
            let view = m.view(bytes);
            let source = m.json["bufferViews"][view].clone();
            m.json["bufferViews"][0]["extensions"] = json!({"EXT_meshopt_compression": {
                "buffer": 0, "byteOffset": source["byteOffset"], "byteLength": bytes.len(), "byteStride": 12,
                "count": count, "mode": mode}});
        })
    };
    // `é` as one byte, as exporters that know no UTF-8 write it.
    let mut latin = Model::triangle().glb();
    let at = latin.windows(5).position(|w| w == b"\"tri\"").unwrap();
    latin[at + 1] = 0xE9;
    let utf16: Vec<u8> = "{\"asset\":{}}".encode_utf16().flat_map(u16::to_le_bytes).collect();
    vec![
        ("empty.glb", Vec::new(), Malformed("0 bytes")),
        ("cut-header.glb", cut(10), Malformed("cut off")),
        ("cut-json.glb", cut(40), Malformed("incomplete")),
        ("cut-bin.glb", cut(good.len() - 8), Malformed("incomplete")),
        ("magic.glb", b"GLTF\x02\0\0\0 nonsense".to_vec(), Malformed("neither a GLB")),
        ("unknown.xyz", b"\x7FELF".to_vec(), UnknownFormat),
        ("version1.glb", b"glTF\x01\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0".to_vec(), Unsupported("version 1")),
        ("version3.gltf", br#"{"asset":{"version":"3.0"}}"#.to_vec(), Unsupported("glTF version 3.0")),
        ("no-json.glb", b"glTF\x02\0\0\0\x0C\0\0\0".to_vec(), Malformed("no JSON chunk")),
        ("half.gltf", br#"{"asset":{"version":"2.0"},"nodes":[{"#.to_vec(), Malformed("line 1")),
        ("deep.gltf", [&b"{\"a\":"[..], &vec![b'['; 100_000]].concat(), Malformed("cannot be read")),
        ("utf16.gltf", utf16, Malformed("cannot be read")),
        ("latin1-name.glb", latin, Warning("not UTF-8")),
        (
            "many-objects.gltf",
            {
                let mut text = br#"{"asset":{"version":"2.0"},"nodes":["#.to_vec();
                text.extend(b"{},".repeat(3_000_000));
                text.extend(b"{}]}");
                text
            },
            Malformed("no sensible model"),
        ),
        ("accessor-outside.glb", accessor("byteOffset", json!(4)), Malformed("accessor 0: its 3 elements")),
        ("accessor-count.glb", accessor("count", json!(4)), Malformed("outside its buffer view of 36 bytes")),
        ("accessor-huge.glb", accessor("count", json!(1_u64 << 40)), Malformed("1099511627776 elements")),
        (
            "accessor-offset.glb",
            accessor("byteOffset", json!(u64::MAX)),
            Malformed("outside its buffer view"),
        ),
        ("accessor-zeros.glb", accessor("bufferView", json!(null)), Empty("degenerate")),
        (
            "accessor-many-zeros.glb",
            changed(|m| {
                m.json["accessors"][0] =
                    json!({"componentType": 5126, "type": "VEC3", "count": 4_000_000_000_u32});
            }),
            Malformed("more than the file's size justifies"),
        ),
        ("accessor-type.glb", accessor("type", json!("VEC2")), Malformed("2 components where 3")),
        ("accessor-kind.glb", accessor("componentType", json!(7)), Malformed("unknown")),
        (
            "stride-huge.glb",
            changed(|m| m.json["bufferViews"][0]["byteStride"] = json!(1_u64 << 60)),
            Malformed("stride 1152921504606846976"),
        ),
        (
            "stride-small.glb",
            changed(|m| m.json["bufferViews"][0]["byteStride"] = json!(4)),
            Malformed("less than its elements"),
        ),
        (
            "view-outside.glb",
            changed(|m| m.json["bufferViews"][0]["byteLength"] = json!(5000)),
            Malformed("outside buffer 0"),
        ),
        (
            "view-overflow.glb",
            changed(|m| m.json["bufferViews"][0]["byteOffset"] = json!(u64::MAX)),
            Malformed("outside buffer 0"),
        ),
        (
            "no-buffer.glb",
            changed(|m| m.json["bufferViews"][0]["buffer"] = json!(9)),
            Malformed("no buffer 9"),
        ),
        (
            "buffer-without-data.gltf",
            {
                let mut json = Model::triangle().finished_json();
                json["buffers"][0] = json!({"byteLength": 36});
                serde_json::to_vec(&json).unwrap()
            },
            Malformed("neither a URI nor"),
        ),
        ("uri-outside.gltf", buffers("../secret.bin"), Malformed("outside the model's folder")),
        ("uri-percent.gltf", buffers("%2e%2e/secret.bin"), Malformed("outside the model's folder")),
        ("uri-absolute.gltf", buffers("/etc/passwd"), Malformed("outside the model's folder")),
        ("uri-network.gltf", buffers("https://example.com/a.bin"), Malformed("scheme `https:`")),
        ("uri-file.gltf", buffers("file:///etc/passwd"), Malformed("scheme `file:`")),
        ("uri-missing.gltf", buffers("not-there.bin"), Read("not-there.bin")),
        ("uri-folder.gltf", buffers("."), Read("directory")),
        ("uri-base64.gltf", buffers("data:;base64,%%%"), Malformed("base64")),
        ("image-huge.glb", with_image(json!({}), Some(&lying_png(60_000, 60_000))), Warning("60000 × 60000")),
        ("image-cut.glb", with_image(json!({}), Some(&gltf_builder::png(64, 64)[..70])), Warning("image 0")),
        ("image-medium-cut.glb", with_image(json!({}), Some(&lying_png(4000, 4000))), Warning("image 0")),
        (
            "image-outside.glb",
            with_image(json!({"uri": "../../a.png"}), None),
            Warning("outside the model's"),
        ),
        (
            "image-network.glb",
            with_image(json!({"uri": "http://example.com/a.png"}), None),
            Warning("`http:`"),
        ),
        ("image-missing.glb", with_image(json!({"uri": "no.png"}), None), Warning("no.png")),
        ("image-view.glb", with_image(json!({"bufferView": 77}), None), Warning("no buffer view 77")),
        (
            "cycle.glb",
            nodes(json!([{"children": [1]}, {"children": [0], "mesh": 0}]), json!([0])),
            Malformed("cycle"),
        ),
        ("self.glb", nodes(json!([{"children": [0], "mesh": 0}]), json!([0])), Malformed("cycle")),
        (
            "two-parents.glb",
            nodes(json!([{"children": [2]}, {"name": "b", "children": [2]}, {"mesh": 0}]), json!([0, 1])),
            Malformed("two parents (node 0 and node 1 \"b\")"),
        ),
        ("child-missing.glb", nodes(json!([{"children": [5], "mesh": 0}]), json!([0])), Malformed("child 5")),
        ("root-missing.glb", nodes(json!([{"mesh": 0}]), json!([3])), Malformed("shows node 3")),
        (
            "root-twice.glb",
            nodes(json!([{"children": [1]}, {"mesh": 0}]), json!([0, 1])),
            Warning("shown once"),
        ),
        (
            "scene-missing.glb",
            changed(|m| m.json["scene"] = json!(4)),
            Malformed("default scene is number 4"),
        ),
        ("levels-300.glb", chain(300), Loads),
        ("levels-5000.glb", chain(5000), Loads),
        ("levels-60000.glb", chain(60_000), Malformed("paths of the nodes")),
        ("mesh-missing.glb", nodes(json!([{"mesh": 8}]), json!([0])), Malformed("no mesh 8")),
        (
            "transform.glb",
            nodes(
                json!([{"mesh": 0, "scale": [1e38, 1e38, 1e38], "children": [1]},
                {"mesh": 0, "matrix": [1e39, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}]),
                json!([0]),
            ),
            Warning("not finite"),
        ),
        (
            "index-range.glb",
            changed(|m| {
                let indices = m.u16s(&[0, 1, 2, 0, 1, 999]);
                m.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
            }),
            Warning("index out of range"),
        ),
        (
            "index-all-bad.glb",
            changed(|m| {
                let indices = m.u32s(&[7, 8, u32::MAX]);
                m.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
            }),
            Empty("damaged or degenerate"),
        ),
        (
            "index-floats.glb",
            changed(|m| {
                let indices = m.floats("SCALAR", &[0., 1., 2.]);
                m.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
            }),
            Malformed("unsigned integers"),
        ),
        (
            "index-count.glb",
            changed(|m| {
                let indices = m.u16s(&[0, 1, 2, 0]);
                m.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
            }),
            Warning("no multiple of 3"),
        ),
        (
            "nan.glb",
            changed(|m| {
                let nan = f32::NAN;
                let positions = m.floats("VEC3", &[nan, 0., 0., 1., nan, 0., f32::INFINITY, 1., 0.]);
                m.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(positions);
            }),
            Empty("no numbers"),
        ),
        (
            "required.glb",
            changed(|m| {
                m.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
            }),
            Unsupported("KHR_draco_mesh_compression"),
        ),
        (
            "required-unknown.glb",
            changed(|m| m.json["extensionsRequired"] = json!(["ACME_magic"])),
            Unsupported("ACME_magic"),
        ),
        (
            "points.glb",
            changed(|m| m.json["meshes"][0]["primitives"][0]["mode"] = json!(0)),
            Empty("only points or lines"),
        ),
        (
            "mode.glb",
            changed(|m| m.json["meshes"][0]["primitives"][0]["mode"] = json!(17)),
            Empty("no triangles"),
        ),
        (
            "no-positions.glb",
            changed(|m| m.json["meshes"][0]["primitives"][0]["attributes"] = json!({})),
            Empty("no triangles"),
        ),
        (
            "empty-scene.glb",
            changed(|m| m.json["scenes"][0]["nodes"] = json!([])),
            Empty("no node of the default scene"),
        ),
        ("nothing.gltf", br#"{"asset":{"version":"2.0"}}"#.to_vec(), Empty("no meshes")),
        (
            "material-missing.glb",
            changed(|m| m.json["meshes"][0]["primitives"][0]["material"] = json!(3)),
            Warning("material 3"),
        ),
        (
            "skin-missing.glb",
            changed(|m| {
                let positions = m.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].clone();
                let joints = m.accessor(5121, "VEC4", 3, &[0; 12]);
                let weights = m.floats("VEC4", &[1.0; 12]);
                m.json["meshes"][0]["primitives"][0]["attributes"] =
                    json!({"POSITION": positions, "JOINTS_0": joints, "WEIGHTS_0": weights});
                m.json["nodes"][0]["skin"] = json!(2);
            }),
            Malformed("no skin 2"),
        ),
        ("packed-damaged.glb", packed(3, "ATTRIBUTES", b"\xA0 nonsense"), Malformed("damaged")),
        ("packed-huge.glb", packed(1 << 45, "ATTRIBUTES", b"\xA0 nonsense"), Malformed("justifies")),
        ("packed-mode.glb", packed(3, "TRIANGLES", b"\xE1 nonsense"), Malformed("do not go with")),
        (
            "expansion.glb",
            {
                // Each primitive reads the same 1.2 MB again, in another combination of attributes.
                let mut m = Model::new();
                let positions = m.floats("VEC3", &vec![1.0; 300_000]);
                for target in 0..2000 {
                    let uv =
                        m.push("accessors", json!({"componentType": 5126, "type": "VEC2", "count": 100_000}));
                    let mesh =
                        json!({"primitives": [{"attributes": {"POSITION": positions, "TEXCOORD_0": uv}}]});
                    let mesh = m.push("meshes", mesh);
                    assert_eq!(mesh, target);
                    m.node(json!({"mesh": mesh}));
                }
                m.glb()
            },
            Malformed("justifies"),
        ),
        ("glb bomb: not a GLB.glb", glb(b"{}", &[]), Malformed("missing field `asset`")),
    ]
}

fn check(path: &Path, size: usize, expected: &Expect) -> Result<(), String> {
    let before = NOW.load(Ordering::Relaxed);
    PEAK.store(before, Ordering::Relaxed);
    let start = Instant::now();
    let result = load(path, &ImportOptions::default(), &Progress::default());
    let taken = start.elapsed();
    let peak = PEAK.load(Ordering::Relaxed).saturating_sub(before);
    let name = path.file_name().unwrap().to_string_lossy();
    let mut problems = String::new();
    if !agrees(&result, expected) {
        let got = match &result {
            Ok(scene) => format!("loaded {} triangles, {:?}", scene.triangle_count(), scene.warnings),
            Err(e) => format!("{e:?}: {e}"),
        };
        problems += &format!("{name}: expected {expected:?}, got {got}\n");
    }
    if taken > Duration::from_secs(10) {
        problems += &format!("{name}: took {taken:?}\n");
    }
    if peak > 20 * size + (300 << 20) {
        problems += &format!("{name}: took {} MB for {size} bytes\n", peak >> 20);
    }
    if problems.is_empty() { Ok(()) } else { Err(problems) }
}

// One test, so that the count of memory is not disturbed by others.
#[test]
fn bad_files_give_the_error_they_must() {
    let outer = tempfile::tempdir().unwrap();
    std::fs::write(outer.path().join("secret.bin"), [0; 4]).unwrap();
    let folder = outer.path().join("models");
    std::fs::create_dir(&folder).unwrap();
    let mut problems = String::new();
    for (name, bytes, expected) in rows() {
        let path = folder.join(name);
        std::fs::write(&path, &bytes).unwrap();
        problems += &check(&path, bytes.len(), &expected).err().unwrap_or_default();
    }
    problems += &check(&folder, 0, &Expect::Read("directory")).err().unwrap_or_default();
    let missing = folder.join("missing.glb");
    problems += &check(&missing, 0, &Expect::Read("missing.glb")).err().unwrap_or_default();
    #[cfg(unix)]
    {
        let link = folder.join("link.bin");
        std::os::unix::fs::symlink(outer.path().join("secret.bin"), link).unwrap();
        let path = folder.join("symlink.gltf");
        let json = json!({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "link.bin"}]});
        std::fs::write(&path, json.to_string()).unwrap();
        let expected = Expect::Malformed("outside the model's folder");
        problems += &check(&path, 100, &expected).err().unwrap_or_default();
    }
    assert!(problems.is_empty(), "\n{problems}");
}
