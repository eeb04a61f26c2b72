//! The sample models in `assets/models` are what an illustrator needs: closed, clean, of the promised size.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test may stop at the first surprise in files that the project itself made"
)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use glam::{DVec2, DVec3, Vec3};
use hachure::geometry::{CreaseRule, Topology};
use hachure::import::{ImportOptions, Progress, load};
use hachure::scene::{AlphaMode, Scene};

/// A named mesh with its geometry.
struct Part {
    name: String,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<[f32; 2]>,
    faces: Vec<[usize; 3]>,
}

/// One file, opened.
struct Model {
    document: gltf::Document,
    parts: Vec<Part>,
    bytes: usize,
}

/// A position that can be compared exactly.
type Key = [u32; 3];

impl Model {
    fn open(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/models");
        let bytes = std::fs::read(folder.join(name)).expect("the models are in the repository");
        let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(&bytes).unwrap();
        let parts = document
            .meshes()
            .map(|mesh| {
                let primitive = mesh.primitives().next().unwrap();
                let reader = primitive.reader(|_| blob.as_deref());
                let indices = reader.read_indices().unwrap().into_u32();
                let indices: Vec<usize> = indices.map(|i| i as usize).collect();
                let uvs = reader.read_tex_coords(0);
                Part {
                    name: mesh.name().unwrap().to_owned(),
                    positions: reader.read_positions().unwrap().map(Vec3::from).collect(),
                    normals: reader.read_normals().unwrap().map(Vec3::from).collect(),
                    uvs: uvs.map(|uvs| uvs.into_f32().collect()).unwrap_or_default(),
                    faces: indices.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
                }
            })
            .collect();
        Self { document, parts, bytes: bytes.len() }
    }

    /// Triangles shown: a mesh counts once for each node that shows it.
    fn triangles(&self) -> usize {
        let meshes = self.document.nodes().filter_map(|node| node.mesh());
        meshes.map(|mesh| self.parts[mesh.index()].faces.len()).sum()
    }

    /// What holds for every part of every model.
    fn check(&self) {
        assert!(self.document.materials().len() >= 3, "too few materials");
        for part in &self.parts {
            part.check_closed();
            part.check_faces();
        }
    }
}

impl Part {
    /// A face's corners.
    fn corners(&self, face: [usize; 3]) -> [DVec3; 3] {
        face.map(|i| self.positions[i].as_dvec3())
    }

    /// A face's unit normal.
    fn normal(&self, face: [usize; 3]) -> DVec3 {
        let [a, b, c] = self.corners(face);
        (b - a).cross(c - a).normalize()
    }

    /// For each directed edge, welded by position, the faces that run along it.
    fn edges(&self) -> BTreeMap<(Key, Key), Vec<usize>> {
        // Adding zero makes −0 and 0 equal.
        let key = |i: usize| (self.positions[i] + Vec3::ZERO).to_array().map(f32::to_bits);
        let mut edges: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        for (f, face) in self.faces.iter().enumerate() {
            for k in 0..3 {
                let edge = (key(face[k]), key(face[(k + 1) % 3]));
                edges.entry(edge).or_default().push(f);
            }
        }
        edges
    }

    /// Each edge has one face on either side, and the surface encloses a volume outwards.
    fn check_closed(&self) {
        let edges = self.edges();
        for ((a, b), faces) in &edges {
            assert_eq!(faces.len(), 1, "{}: faces overlap at an edge", self.name);
            assert!(edges.contains_key(&(*b, *a)), "{}: open edge", self.name);
        }
        let volume: f64 = self
            .faces
            .iter()
            .map(|&face| {
                let [a, b, c] = self.corners(face);
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        assert!(volume > 0.0, "{}: inside out", self.name);
    }

    /// No degenerate triangle, no wrong normal.
    fn check_faces(&self) {
        let name = &self.name;
        for &face in &self.faces {
            let [a, b, c] = self.corners(face);
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            let area = (b - a).cross(c - a).length();
            assert!(area > 1e-3 * longest * longest, "{name}: degenerate face");
            for i in face {
                let shading = self.normals[i].as_dvec3();
                assert!((shading.length() - 1.0).abs() < 1e-3, "{name}: not unit");
                assert!(shading.dot(self.normal(face)) > 0.0, "{name}: normal points in");
            }
        }
    }

    /// The angles between neighboring faces, in degrees.
    fn bends(&self) -> Vec<f64> {
        let edges = self.edges();
        let faces = |edge: &(Key, Key)| edges.get(edge).map(|faces| faces[0]);
        edges
            .keys()
            .filter(|(a, b)| a < b)
            .filter_map(|&(a, b)| Some((faces(&(a, b))?, faces(&(b, a))?)))
            .map(|(f, g)| self.normal(self.faces[f]).angle_between(self.normal(self.faces[g])))
            .map(f64::to_degrees)
            .collect()
    }
}

#[test]
fn the_crank_is_an_assembly_of_closed_parts() {
    let crank = Model::open("crank.glb");
    crank.check();
    let triangles = crank.triangles();
    assert!((23_000..=27_000).contains(&triangles), "{triangles}");
    assert!(crank.bytes <= 1 << 20, "{} bytes", crank.bytes);
    let names = |nodes: &mut dyn Iterator<Item = gltf::Node<'_>>| -> Vec<String> {
        nodes.map(|node| node.name().unwrap().to_owned()).collect()
    };
    let shown = names(&mut crank.document.nodes().filter(|node| node.mesh().is_some()));
    assert!(shown.len() >= 20, "{shown:?}");
    let scene = crank.document.default_scene().unwrap();
    let roots = names(&mut scene.nodes());
    for name in ["crankshaft", "rod.3", "piston.3", "flywheel", "bearing.1", "pulley"] {
        assert!(roots.iter().any(|root| root == name), "{name} in {roots:?}");
    }
    for root in scene.nodes() {
        let children = names(&mut root.children());
        let unique: BTreeSet<&String> = children.iter().collect();
        assert_eq!(unique.len(), children.len(), "{children:?}");
    }
}

#[test]
fn the_ogre_is_closed_and_has_no_hard_edge() {
    let ogre = Model::open("ogre.glb");
    ogre.check();
    let triangles = ogre.triangles();
    assert!((45_000..=55_000).contains(&triangles), "{triangles}");
    assert!(ogre.bytes <= 2 << 20, "{} bytes", ogre.bytes);
    let mut bends: Vec<f64> = ogre.parts.iter().flat_map(Part::bends).collect();
    bends.sort_by(f64::total_cmp);
    let share = |part: f64| bends[(bends.len() as f64 * part) as usize];
    assert!(bends[bends.len() - 1] < 50.0, "{:?}", bends.last());
    assert!(share(0.99) < 30.0, "{}", share(0.99));
    assert!(share(0.999) < 38.0, "{}", share(0.999));
}

#[test]
fn the_ogre_can_be_textured() {
    let ogre = Model::open("ogre.glb");
    let mut stretched = 0;
    for part in &ogre.parts {
        assert_eq!(part.uvs.len(), part.positions.len(), "{}", part.name);
        let inside = |uv: &[f32; 2]| uv.iter().all(|v| (0.0..=1.0).contains(v));
        assert!(part.uvs.iter().all(inside), "{}", part.name);
        let ratio = |face: &[usize; 3]| {
            let uv = face.map(|i| DVec2::from(part.uvs[i].map(f64::from)));
            let longest = |side: &dyn Fn(usize) -> f64| (0..3).map(side).fold(0.0, f64::max);
            let across = longest(&|k| uv[k].distance(uv[(k + 1) % 3]));
            let corners = part.corners(*face);
            across / longest(&|k| corners[k].distance(corners[(k + 1) % 3]))
        };
        let mut ratios: Vec<f64> = part.faces.iter().map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        let usual = ratios[ratios.len() / 2];
        stretched += ratios.iter().filter(|r| **r > 4.0 * usual || **r < usual / 4.0).count();
    }
    assert!(stretched * 100 < ogre.triangles() * 2, "{stretched} stretched faces");
}

#[test]
fn the_temple_is_built_of_closed_parts() {
    Model::open("temple.glb").check();
}

#[test]
fn the_cloister_is_built_of_closed_parts() {
    Model::open("cloister.glb").check();
}

/// The still life as the program imports it.
fn still_life() -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/models/still_life.glb");
    load(&path, &ImportOptions::default(), &Progress::default()).unwrap()
}

#[test]
fn the_still_life_is_made_of_named_solids_leaves_and_a_pane() {
    let scene = still_life();
    assert_eq!(scene.warnings, []);
    assert!((30_000..60_000).contains(&scene.triangle_count()), "{}", scene.triangle_count());
    assert!(Model::open("still_life.glb").bytes <= 5 << 19, "larger than 2.5 MiB");
    for path in [
        "table/plank.4",
        "table/batten.2",
        "mirror/frame",
        "mirror/strut",
        "vase",
        "plant/stem.6",
        "plant/leaf.07",
        "bottle/label",
        "ball/checker",
        "cube",
        "pear/body",
        "apple/stalk",
        "whisk/handle",
        "whisk/wire.4",
    ] {
        let found = scene.find(&format!("/still_life/{path}")).and_then(|id| scene.nodes[id].mesh);
        assert!(found.is_some(), "{path}");
    }
    let leaves = scene.nodes.iter().filter(|node| node.path.contains("/leaf.")).count();
    assert!((15..=30).contains(&leaves), "{leaves}");
    for node in &scene.nodes {
        let Some(mesh) = node.mesh.map(|mesh| &scene.meshes[mesh]) else { continue };
        let sheet = ["/leaf.", "/label", "/glass"].iter().any(|name| node.path.contains(name));
        assert_eq!(Topology::new(mesh, 0.6, CreaseRule::default()).is_solid, !sheet, "{}", node.path);
    }
    for part in Model::open("still_life.glb").parts {
        part.check_faces();
    }
}

#[test]
fn the_still_life_has_a_plane_mirror() {
    let scene = still_life();
    let glass = &scene.nodes[scene.find("/still_life/mirror/glass").unwrap()];
    let mesh = &scene.meshes[glass.mesh.unwrap()];
    assert_eq!((mesh.triangle_count(), mesh.positions.len()), (2, 4));
    assert!(mesh.positions.iter().all(|p| p.z.to_bits() == mesh.positions[0].z.to_bits()));
    assert!(mesh.normals.iter().all(|normal| *normal == Vec3::Z));
    // Before it, and higher than the table, stands everything that it is there to show.
    let mirror_from_world = glass.world_from_local.inverse();
    for path in ["vase", "bottle/body", "ball/checker", "cube", "apple/body"] {
        let id = scene.find(&format!("/still_life/{path}")).unwrap();
        let middle = scene.bounds_of([id]).center();
        assert!(mirror_from_world.transform_point3(middle).z > 0.03, "{path}");
    }
}

#[test]
fn the_still_life_has_images_of_each_kind() {
    let scene = still_life();
    let material_of = |path: &str| {
        let mesh = scene.nodes[scene.find(&format!("/still_life/{path}")).unwrap()].mesh.unwrap();
        (&scene.materials[scene.meshes[mesh].submeshes[0].material], &scene.meshes[mesh])
    };
    for path in ["table/plank.1", "vase"] {
        let (material, mesh) = material_of(path);
        assert!(material.base_color_texture.is_some() && material.normal_texture.is_some(), "{path}");
        assert_eq!(mesh.tangents.len(), mesh.positions.len(), "{path}");
        let seen = mesh.tangents.iter().zip(&mesh.normals).filter(|(_, normal)| normal.y > -0.5);
        assert!(seen.clone().all(|(t, _)| t.w == 1.0), "{path}: an image is mirrored or on its head");
        assert!(seen.count() > 8, "{path}");
    }
    for path in ["bottle/label", "ball/checker"] {
        let (material, mesh) = material_of(path);
        assert!(material.base_color_texture.is_some() && !mesh.uvs.is_empty(), "{path}");
    }
    let (leaf, _) = material_of("plant/leaf.07");
    assert_eq!((leaf.alpha, leaf.double_sided), (AlphaMode::Mask(0.5), true));
    let texture = &scene.textures[leaf.base_color_texture.as_ref().unwrap().texture];
    let covered = texture.rgba.chunks_exact(4).filter(|texel| texel[3] >= 128).count();
    let share = covered as f64 / f64::from(texture.width * texture.height);
    assert!((0.3..0.8).contains(&share), "{share} of the image is leaf");
}
