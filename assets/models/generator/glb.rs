//! Writes a scene of named, nested parts as binary glTF 2.0.

use glam::DQuat;
use serde_json::{Value, json};

/// An image that materials use.
pub(crate) struct Image {
    /// Name in the file.
    pub(crate) name: &'static str,
    /// Its PNG.
    pub(crate) png: Vec<u8>,
    /// Whether it repeats beyond its borders.
    pub(crate) tiles: bool,
}

/// A surface finish that parts share.
#[derive(Default)]
pub(crate) struct Material {
    /// Name in the file.
    pub(crate) name: &'static str,
    /// Base color as written in paint programs: `0xRRGGBB`, sRGB.
    pub(crate) srgb: u32,
    /// 0 = paint, 1 = bare metal.
    pub(crate) metallic: f32,
    /// 0 = mirror, 1 = chalk.
    pub(crate) roughness: f32,
    /// Index into [`Scene::images`] of a color image that is multiplied with the base color.
    pub(crate) color_image: Option<usize>,
    /// Index into [`Scene::images`] of a tangent-space normal map, green upwards.
    pub(crate) normal_image: Option<usize>,
    /// Whether the color image's alpha cuts the shape out of a sheet that is seen from both sides.
    pub(crate) cut_out: bool,
}

/// Indexed triangles with one material.
pub(crate) struct Mesh {
    /// Name in the file.
    pub(crate) name: String,
    /// Vertex positions in meters.
    pub(crate) positions: Vec<[f32; 3]>,
    /// Unit shading normals, one per vertex.
    pub(crate) normals: Vec<[f32; 3]>,
    /// Texture coordinates, one per vertex, or none at all.
    pub(crate) uvs: Vec<[f32; 2]>,
    /// Three vertices per triangle, counter-clockwise from outside.
    pub(crate) indices: Vec<u32>,
    /// Index into [`Scene::materials`].
    pub(crate) material: usize,
}

/// A named place in the hierarchy.
#[derive(Clone)]
pub(crate) struct Node {
    /// Name in the file.
    pub(crate) name: String,
    /// Index into [`Scene::meshes`].
    pub(crate) mesh: Option<usize>,
    /// Position in the parent, meters.
    pub(crate) translation: [f64; 3],
    /// Rotation in the parent, a unit quaternion x, y, z, w.
    pub(crate) rotation: [f64; 4],
    /// Parts of this part.
    pub(crate) children: Vec<Self>,
}

impl Node {
    /// A node at its parent's origin.
    pub(crate) fn new(name: impl Into<String>, mesh: Option<usize>) -> Self {
        Self {
            name: name.into(),
            mesh,
            translation: [0.0; 3],
            rotation: [0.0, 0.0, 0.0, 1.0],
            children: Vec::new(),
        }
    }

    /// The same node, elsewhere; in millimeters.
    pub(crate) fn at(mut self, x: f64, y: f64, z: f64) -> Self {
        self.translation = [x, y, z].map(|v| v * 1e-3);
        self
    }

    /// The same node, turned.
    pub(crate) fn turned(mut self, rotation: DQuat) -> Self {
        self.rotation = rotation.to_array();
        self
    }

    /// The same node with these children.
    pub(crate) fn with(mut self, children: Vec<Self>) -> Self {
        self.children = children;
        self
    }

    /// Triangles that this node and those below it show.
    pub(crate) fn triangles(&self, meshes: &[Mesh]) -> usize {
        let own = self.mesh.map_or(0, |mesh| meshes[mesh].indices.len() / 3);
        own + self.children.iter().map(|child| child.triangles(meshes)).sum::<usize>()
    }
}

/// What one file holds.
#[derive(Default)]
pub(crate) struct Scene {
    /// Images.
    pub(crate) images: Vec<Image>,
    /// Finishes.
    pub(crate) materials: Vec<Material>,
    /// Geometry, which several nodes may show.
    pub(crate) meshes: Vec<Mesh>,
    /// Top-level nodes.
    pub(crate) roots: Vec<Node>,
}

impl Scene {
    /// Adds geometry and returns its index.
    pub(crate) fn add(&mut self, mesh: Mesh) -> usize {
        self.meshes.push(mesh);
        self.meshes.len() - 1
    }

    /// Triangles shown, a mesh counted once per node that shows it.
    pub(crate) fn triangles(&self) -> usize {
        self.roots.iter().map(|root| root.triangles(&self.meshes)).sum()
    }

    /// The bytes of the file.
    pub(crate) fn to_glb(&self) -> Vec<u8> {
        let mut buffer = Buffer::default();
        let meshes: Vec<Value> = self.meshes.iter().map(|mesh| buffer.mesh(mesh)).collect();
        let mut nodes = Vec::new();
        let roots: Vec<usize> = self.roots.iter().map(|root| flatten(root, &mut nodes)).collect();
        let images: Vec<Value> = self.images.iter().map(|image| buffer.image(image)).collect();
        let mut document = json!({
            "asset": { "version": "2.0", "generator": "hachure models" },
            "scene": 0,
            "scenes": [{ "nodes": roots }],
            "nodes": nodes,
            "meshes": meshes,
            "materials": self.materials.iter().map(material_json).collect::<Vec<_>>(),
            "accessors": buffer.accessors,
            "bufferViews": buffer.views,
            "buffers": [{ "byteLength": buffer.bytes.len() }],
        });
        if !images.is_empty() {
            let texture =
                |(i, image): (usize, &Image)| json!({ "source": i, "sampler": usize::from(image.tiles) });
            document["textures"] = self.images.iter().enumerate().map(texture).collect();
            document["samplers"] = [Buffer::CLAMP, Buffer::REPEAT].into_iter().map(Buffer::sampler).collect();
            document["images"] = json!(images);
        }
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let total = 12 + 8 + text.len() + 8 + buffer.bytes.len();
        let mut out = Vec::with_capacity(total);
        out.extend(b"glTF");
        out.extend(2_u32.to_le_bytes());
        out.extend((total as u32).to_le_bytes());
        for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &buffer.bytes)] {
            out.extend((chunk.len() as u32).to_le_bytes());
            out.extend(kind);
            out.extend(chunk);
        }
        out
    }
}

/// The binary chunk while it grows, with the JSON that describes it.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    const F32: u32 = 5126;
    const U16: u32 = 5123;
    const U32: u32 = 5125;
    const VERTICES: u32 = 34962;
    const INDICES: u32 = 34963;
    const LINEAR: u32 = 9729;
    const MIPMAPS: u32 = 9987;
    const CLAMP: u32 = 33071;
    const REPEAT: u32 = 10497;

    /// Stores a mesh and returns its JSON.
    fn mesh(&mut self, mesh: &Mesh) -> Value {
        let mut low = [f32::INFINITY; 3];
        let mut high = [f32::NEG_INFINITY; 3];
        for p in &mesh.positions {
            for axis in 0..3 {
                low[axis] = low[axis].min(p[axis]);
                high[axis] = high[axis].max(p[axis]);
            }
        }
        let position = self.floats("VEC3", &mesh.positions);
        self.accessors[position]["min"] = json!(low);
        self.accessors[position]["max"] = json!(high);
        let mut attributes = json!({
            "POSITION": position,
            "NORMAL": self.floats("VEC3", &mesh.normals),
        });
        if !mesh.uvs.is_empty() {
            attributes["TEXCOORD_0"] = json!(self.floats("VEC2", &mesh.uvs));
        }
        let short = mesh.positions.len() < 65_535;
        let indices: Vec<u8> = if short {
            mesh.indices.iter().flat_map(|&i| (i as u16).to_le_bytes()).collect()
        } else {
            mesh.indices.iter().flat_map(|i| i.to_le_bytes()).collect()
        };
        let kind = if short { Self::U16 } else { Self::U32 };
        let indices = self.accessor(&indices, Self::INDICES, kind, "SCALAR", mesh.indices.len());
        json!({
            "name": mesh.name,
            "primitives": [{ "attributes": attributes, "indices": indices, "material": mesh.material }],
        })
    }

    /// Stores a vertex attribute.
    fn floats<const N: usize>(&mut self, shape: &str, values: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = values.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor(&bytes, Self::VERTICES, Self::F32, shape, values.len())
    }

    /// The JSON of a smooth sampler.
    fn sampler(wrap: u32) -> Value {
        json!({ "magFilter": Self::LINEAR, "minFilter": Self::MIPMAPS, "wrapS": wrap, "wrapT": wrap })
    }

    /// Stores an image and returns its JSON.
    fn image(&mut self, image: &Image) -> Value {
        json!({ "name": image.name, "mimeType": "image/png", "bufferView": self.view(&image.png) })
    }

    /// Stores bytes behind an accessor of their own.
    fn accessor(&mut self, bytes: &[u8], target: u32, kind: u32, shape: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.views[view]["target"] = json!(target);
        self.accessors.push(json!({
            "bufferView": view, "componentType": kind, "type": shape, "count": count,
        }));
        self.accessors.len() - 1
    }

    /// Stores bytes behind a view of their own.
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(),
        }));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }
}

/// Appends a node after its children and returns its index.
fn flatten(node: &Node, nodes: &mut Vec<Value>) -> usize {
    let children: Vec<usize> = node.children.iter().map(|child| flatten(child, nodes)).collect();
    let mut json = json!({ "name": node.name });
    if let Some(mesh) = node.mesh {
        json["mesh"] = json!(mesh);
    }
    if node.translation != [0.0; 3] {
        json["translation"] = json!(node.translation.map(|v| v as f32));
    }
    if node.rotation != [0.0, 0.0, 0.0, 1.0] {
        json["rotation"] = json!(node.rotation.map(|v| v as f32));
    }
    if !children.is_empty() {
        json["children"] = json!(children);
    }
    nodes.push(json);
    nodes.len() - 1
}

/// A material's JSON; glTF wants linear color.
fn material_json(material: &Material) -> Value {
    let channel = |shift: u32| {
        let c = f64::from((material.srgb >> shift) & 0xff) / 255.0;
        let linear = if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
        (linear * 1e5).round() / 1e5
    };
    let mut json = json!({
        "name": material.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [channel(16), channel(8), channel(0), 1.0],
            "metallicFactor": material.metallic,
            "roughnessFactor": material.roughness,
        },
    });
    if let Some(image) = material.color_image {
        json["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": image });
    }
    if let Some(image) = material.normal_image {
        json["normalTexture"] = json!({ "index": image });
    }
    if material.cut_out {
        json["alphaMode"] = json!("MASK");
        json["alphaCutoff"] = json!(0.5);
        json["doubleSided"] = json!(true);
    }
    json
}
