//! OBJ, STL and PLY files become the scenes that a person expects.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use std::io::Write as _;
use std::path::{Path, PathBuf};

use glam::{Vec2, Vec3};
use hachure::import::{ImportError, ImportOptions, Progress, load};
use hachure::scene::{AlphaMode, Scene, Up, Wrap};

/// A folder that vanishes with the value, and files in it.
struct Folder(tempfile::TempDir);

impl Folder {
    fn with(files: &[(&str, &[u8])]) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        for (name, data) in files {
            let path = folder.path(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, data).unwrap();
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
}

fn open(path: &Path) -> Scene {
    load(path, &ImportOptions::default(), &Progress::default()).unwrap()
}

fn open_bytes(name: &str, data: &[u8]) -> Scene {
    open(&Folder::with(&[(name, data)]).path(name))
}

fn paths(scene: &Scene) -> Vec<&str> {
    scene.nodes.iter().map(|n| n.path.as_str()).collect()
}

fn warnings(scene: &Scene) -> String {
    scene.warnings.iter().map(|w| format!("{w}\n")).collect()
}

fn png() -> Vec<u8> {
    let mut out = std::io::Cursor::new(Vec::new());
    image::RgbaImage::from_pixel(2, 2, image::Rgba([255, 0, 0, 255]))
        .write_to(&mut out, image::ImageFormat::Png)
        .unwrap();
    out.into_inner()
}

const CUBE_OBJ: &str = "
v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf -7 -6 -2 -3\n";

#[test]
fn an_obj_without_names_is_one_node_with_normals_by_crease_angle() {
    let scene = open_bytes("box.obj", CUBE_OBJ.as_bytes());
    assert_eq!(paths(&scene), ["/box", "/box/mesh"]);
    assert_eq!((scene.nodes[0].descendants, scene.nodes[1].parent), (1, Some(0)));
    assert_eq!(scene.up, Up::PosY);
    assert!(scene.warnings.is_empty(), "{}", warnings(&scene));
    let mesh = &scene.meshes[0];
    assert_eq!((mesh.triangle_count(), mesh.positions.len()), (12, 24));
    assert!(mesh.normals.iter().all(|n| n.abs().max_element() > 0.999));

    let folder = Folder::with(&[("box.obj", CUBE_OBJ.as_bytes())]);
    let soft = ImportOptions { crease_angle: 120.0, ..ImportOptions::default() };
    let scene = load(&folder.path("box.obj"), &soft, &Progress::default()).unwrap();
    assert_eq!(scene.meshes[0].positions.len(), 8);
}

#[test]
fn objects_and_groups_become_nodes_with_unique_paths_in_tree_order() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n\
        o frame\nf 1 2 3\ng left rail\nf 1 2 4\ng right/rail\nf 2 3 4\ng right_rail\nf 4 3 1\n\
        o wheel\nf 1 3 4\no frame\nf 1 2 3\ng\nusemtl red\nf 4 3 2\no empty\no wheel\ng wheel\nf 1 2 3\n";
    let scene = open_bytes("cart.obj", text.as_bytes());
    assert_eq!(
        paths(&scene),
        [
            "/cart",
            "/cart/frame",
            "/cart/frame/left rail",
            "/cart/frame/right_rail",
            "/cart/frame/right_rail.2",
            "/cart/wheel",
        ]
    );
    let descendants: Vec<usize> = scene.nodes.iter().map(|n| n.descendants).collect();
    assert_eq!(descendants, [5, 3, 0, 0, 0, 0]);
    for (id, node) in scene.nodes.iter().enumerate().skip(1) {
        assert!(scene.subtree(node.parent.unwrap()).contains(&id));
    }
    // What came back under an old name is in the old node; the same triangle twice is one.
    let frame = &scene.meshes[scene.nodes[1].mesh.unwrap()];
    assert_eq!((frame.triangle_count(), frame.submeshes.len()), (2, 2));
    assert!(warnings(&scene).contains("duplicate"));
}

#[test]
fn materials_images_and_options_of_an_obj() {
    let obj = "mtllib my materials.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nvt 0 0\nvt 1 0\nvt 0 1\n\
        usemtl wood\nf 1/1 2/2 3/3\nusemtl glass\nf 1/1 2/2 4/3\nusemtl leaf\nf 1/1 3/2 4/3\nusemtl void\nf 4/1 3/2 5/3\nusemtl gone\nf 2/1 3/2 4/3\n";
    let mtl = "newmtl wood\nKd 1 1 1\nmap_Kd -clamp on tex\\wood.png\nnewmtl glass\nKd 0 0 1\nd 0.5\n\
        newmtl void\nd 0\nnewmtl leaf\nmap_Kd tex/wood.png\nmap_d tex/wood.png\n";
    let folder = Folder::with(&[
        ("a.obj", obj.as_bytes()),
        ("my materials.mtl", mtl.as_bytes()),
        ("tex/wood.png", &png()),
    ]);
    let scene = open(&folder.path("a.obj"));
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.submeshes.len(), 5);
    let material = |part: usize| &scene.materials[mesh.submeshes[part].material];
    let wood = material(0);
    let image = wood.base_color_texture.as_ref().unwrap();
    assert_eq!((wood.name.as_str(), image.wrap), ("wood", [Wrap::Clamp; 2]));
    assert_eq!(&scene.textures[image.texture].rgba[..4], [255, 0, 0, 255]);
    let glass = material(1);
    assert_eq!((glass.base_color.z, glass.base_color.w, glass.alpha), (1.0, 0.5, AlphaMode::Blend));
    // Some writers mean 1 by 0.
    assert_eq!((material(3).base_color.w, material(3).alpha), (1.0, AlphaMode::Opaque));
    assert_eq!(material(2).alpha, AlphaMode::Mask(0.5));
    assert_eq!(material(4).name, "gone");
    let said = warnings(&scene);
    assert!(said.contains("`void` cannot be seen") && said.contains("`gone`"), "{said}");
    // The origin of texture coordinates moves to the upper left.
    let corner = mesh.positions.iter().position(|&p| p == Vec3::ZERO).unwrap();
    assert_eq!(mesh.uvs[corner], Vec2::new(0.0, 1.0));
}

#[test]
fn obj_normals_colors_concave_faces_and_odd_lines() {
    // A letter L, with normals, colors, a continued line, a carriage return, Latin-1 bytes and a line of nonsense.
    let text = b"# caf\xe9\r\nv 0 0 0 1 0 0\nv 3 0 0 1 0 0\nv 3 1 0\nv 1 1 0 0 1 0\nv 1 3 0 0 0 1\nv 0 3 0\nvn 0 0 1\n\
        o caf\xe9\nnonsense\nf 1//1 2//1 3//1 \\\n 4//1 5//1 6//1\nl 1 2\n";
    let scene = open_bytes("l.obj", text);
    assert_eq!(paths(&scene), ["/l", "/l/caf\u{fffd}"]);
    let mesh = &scene.meshes[0];
    let area: f32 = mesh
        .triangles()
        .iter()
        .map(|&t| {
            let [a, b, c] = mesh.corners(t);
            (b - a).cross(c - a).z * 0.5
        })
        .sum();
    assert_eq!((mesh.triangle_count(), area), (4, 5.0));
    assert_eq!(mesh.normals, [Vec3::Z; 6]);
    assert_eq!((mesh.colors[0], mesh.colors[2]), ([255, 0, 0, 255], [255; 4]));
    let said = warnings(&scene);
    assert!(said.contains("l.obj, line 10: cannot be understood"), "{said}");
    assert!(said.contains("points and lines"), "{said}");
}

/// The facets of a tetrahedron.
const TETRAHEDRON: [[[f32; 3]; 3]; 4] = [
    [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
];

fn binary_stl(header: &[u8], declared: u32) -> Vec<u8> {
    let mut out = header.to_vec();
    out.resize(80, b' ');
    out.extend(declared.to_le_bytes());
    for facet in TETRAHEDRON {
        out.extend([0; 12]);
        out.extend(facet.as_flattened().iter().flat_map(|c| c.to_le_bytes()));
        out.extend([0; 2]);
    }
    out
}

#[test]
fn binary_stl_is_told_by_its_length_even_when_it_begins_with_solid() {
    for header in [&b"made by hand"[..], b"solid but binary", b"SOLID facet normal"] {
        let scene = open_bytes("part.STL", &binary_stl(header, 4));
        assert_eq!(paths(&scene), ["/part", "/part/mesh"]);
        assert_eq!(scene.up, Up::PosZ);
        let mesh = &scene.meshes[0];
        assert_eq!((mesh.triangle_count(), mesh.positions.len()), (4, 12));
        assert!(scene.warnings.is_empty());
    }
    // A wrong count, or none, is repaired and told.
    for (declared, shown) in [(0, 4), (3, 3), (100, 4)] {
        let scene = open_bytes("part.stl", &binary_stl(b"x", declared));
        assert_eq!(scene.triangle_count(), shown);
        assert!(warnings(&scene).contains(&format!("declares {declared} triangles")));
    }
}

#[test]
fn text_stl_has_a_node_per_solid() {
    let mut text = String::new();
    for name in ["Lid", "lid", "Lid", ""] {
        text += &format!("SOLID {name}\n");
        for [a, b, c] in TETRAHEDRON {
            text += " facet normal 0 0 0\n  outer loop\n";
            for [x, y, z] in [a, b, c] {
                text += &format!("   vertex {x:e} {y} {z}\r\n");
            }
            text += "  endloop\n endfacet\n";
        }
        text += &format!("endsolid {name}\n");
    }
    let scene = open_bytes("box.stl", text.as_bytes());
    assert_eq!(paths(&scene), ["/box", "/box/Lid", "/box/lid", "/box/Lid.2", "/box/mesh"]);
    assert!(scene.warnings.is_empty(), "{}", warnings(&scene));
    assert_eq!(scene.triangle_count(), 16);
}

#[test]
fn soup_of_a_sphere_is_welded_and_smooth() {
    let sphere = hachure::geometry::primitives::sphere(2.0, 24, 48);
    let mut stl = vec![0; 80];
    stl.extend((sphere.triangle_count() as u32).to_le_bytes());
    for &t in sphere.triangles() {
        stl.extend([0; 12]);
        let corners = sphere.corners(t);
        stl.extend(corners.iter().flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes));
        stl.extend([0; 2]);
    }
    let scene = open_bytes("sphere.stl", &stl);
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.positions.len(), 23 * 48 + 2);
    assert_eq!(mesh.normals.len(), mesh.positions.len());
    for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
        assert!(n.distance(*p * 0.5) < 0.02);
    }
}

fn ply(format: &str) -> Vec<u8> {
    let header = format!(
        "ply\nformat {format} 1.0\ncomment made by hand\nelement camera 1\nproperty float zoom\n\
         property list uchar short marks\nelement vertex 5\nproperty double x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int quality\n\
         element face 2\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n"
    );
    let mut out = header.into_bytes();
    let vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1]];
    let faces: [&[i32]; 2] = [&[0, 1, 2, 3], &[0, 1, 4]];
    if format == "ascii" {
        out.extend(b"1.5 2 7 8\n");
        for [x, y, z] in vertices {
            out.extend(format!("{x} {y} {z} 255 0 128 -7\n").bytes());
        }
        for face in faces {
            let list: Vec<String> = face.iter().map(i32::to_string).collect();
            out.extend(format!("1 {} {}\n", face.len(), list.join(" ")).bytes());
        }
        return out;
    }
    let mut put = |bytes: &[u8]| {
        let reversed = bytes.iter().rev().copied();
        if format == "binary_big_endian" { out.extend(reversed) } else { out.extend(bytes) }
    };
    put(&1.5_f32.to_le_bytes());
    put(&[2]);
    put(&7_i16.to_le_bytes());
    put(&8_i16.to_le_bytes());
    for [x, y, z] in vertices {
        put(&f64::from(x).to_le_bytes());
        put(&(y as f32).to_le_bytes());
        put(&(z as f32).to_le_bytes());
        [255, 0, 128].iter().for_each(|&c| put(&[c]));
        put(&(-7_i32).to_le_bytes());
    }
    for face in faces {
        put(&[1]);
        put(&[face.len() as u8]);
        face.iter().for_each(|v| put(&v.to_le_bytes()));
    }
    out
}

#[test]
fn ply_in_all_three_encodings_is_the_same_scene() {
    let scenes = ["ascii", "binary_little_endian", "binary_big_endian"].map(|f| open_bytes("a.ply", &ply(f)));
    for scene in &scenes {
        assert_eq!(paths(scene), ["/a", "/a/mesh"]);
        assert!(scene.warnings.is_empty(), "{}", warnings(scene));
        assert_eq!(scene.triangle_count(), 3);
        assert_eq!(scene.meshes[0].colors[0], [255, 0, 55, 255]);
        assert!(scene.meshes == scenes[0].meshes);
    }
}

#[test]
fn ply_normals_float_colors_texture_coordinates_and_strips() {
    let text = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
        property float nx\nproperty float ny\nproperty float nz\nproperty float red\nproperty float green\n\
        property float blue\nproperty float s\nproperty float t\nelement tristrips 1\n\
        property list int int vertex_indices\nend_header\n\
        0 0 0 0 0 2 1 1 1 0 0\n1 0 0 0 0 2 1 1 1 1 0\n0 1 0 0 0 2 0 0 0 0 1\n1 1 0 0 0 2 0 0 0 1 1\n\
        9 9 9 0 0 2 0 0 0 1 1\n8 0 1 2 -1 2 1 3 -1\n";
    let scene = open_bytes("strip.ply", text.as_bytes());
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.indices, [0, 1, 2, 2, 1, 3]);
    assert_eq!(mesh.positions.len(), 4, "the vertex that nothing uses is gone");
    assert_eq!(mesh.normals, [Vec3::Z; 4]);
    assert_eq!((mesh.colors[0], mesh.colors[3]), ([255; 4], [0, 0, 0, 255]));
    assert_eq!(mesh.uvs[0], Vec2::new(0.0, 1.0));
    assert!(scene.warnings.is_empty(), "{}", warnings(&scene));
}

#[test]
fn loading_reports_progress_and_can_be_canceled() {
    let folder = Folder::with(&[("box.obj", CUBE_OBJ.as_bytes()), ("a.ply", &ply("ascii"))]);
    for name in ["box.obj", "a.ply"] {
        let progress = Progress::default();
        load(&folder.path(name), &ImportOptions::default(), &progress).unwrap();
        assert!((progress.share() - 1.0).abs() < 1e-6);
        progress.cancel();
        let stopped = load(&folder.path(name), &ImportOptions::default(), &progress);
        assert!(matches!(stopped, Err(ImportError::Canceled)));
    }
}

#[test]
fn real_models_load_where_they_are_at_hand() {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models");
    if !models.exists() {
        // What a test prints is only shown where it fails, what it writes always is.
        writeln!(std::io::stderr(), "NOT TESTED: real models; there is no folder {}", models.display())
            .unwrap();
        return;
    }
    for (name, triangles, warnings_expected) in [
        ("spot.obj", 5856, 0),
        ("kaykit_building_obj/building_H.obj", 1885, 0),
        ("featuretype.stl", 3476, 0),
        ("cycloidal_drive.ply", 43368, 0),
    ] {
        let path = models.join(name);
        assert!(path.exists(), "{} is missing", path.display());
        let scene = open(&path);
        assert_eq!(scene.warnings.len(), warnings_expected, "{name}: {}", warnings(&scene));
        assert_eq!(scene.triangle_count(), triangles, "{name}");
        assert!(!scene.bounds().is_empty());
        let textured = scene.materials.iter().filter(|m| m.base_color_texture.is_some()).count();
        assert_eq!(textured, usize::from(name.contains("kaykit")));
    }
}
