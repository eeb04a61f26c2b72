//! Builds small glTF models for the tests.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used, reason = "each test binary uses its own part")]

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

/// A model in the making: the JSON, and the binary chunk behind buffer 0.
pub struct Model {
    pub json: Value,
    pub bin: Vec<u8>,
}

impl Model {
    /// A model with a scene, but without nodes and meshes.
    pub fn new() -> Self {
        Self {
            json: json!({
                "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                "accessors": [], "bufferViews": [], "materials": []
            }),
            bin: Vec::new(),
        }
    }

    /// One triangle in one node.
    pub fn triangle() -> Self {
        let mut model = Self::new();
        let positions = model.floats("VEC3", &[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
        let mesh = model.push("meshes", json!({"primitives": [{"attributes": {"POSITION": positions}}]}));
        model.node(json!({"name": "tri", "mesh": mesh}));
        model
    }

    /// Appends to a list of the JSON and tells the index.
    pub fn push(&mut self, list: &str, value: Value) -> usize {
        if self.json[list].is_null() {
            self.json[list] = json!([]);
        }
        let list = self.json[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    /// Adds a node and shows it in scene 0.
    pub fn node(&mut self, value: Value) -> usize {
        let index = self.push("nodes", value);
        self.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(index));
        index
    }

    /// Adds bytes as a buffer view.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let offset = self.bin.len();
        self.bin.extend(bytes);
        self.push("bufferViews", json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}))
    }

    /// Adds bytes as an accessor of its own.
    pub fn accessor(&mut self, component: u32, kind: &str, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": component, "count": count, "type": kind}),
        )
    }

    pub fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor(5126, kind, values.len() / width, &bytes)
    }

    pub fn u16s(&mut self, values: &[u16]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor(5123, "SCALAR", values.len(), &bytes)
    }

    pub fn u32s(&mut self, values: &[u32]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor(5125, "SCALAR", values.len(), &bytes)
    }

    /// The JSON with its buffer declared, unless it declares buffers itself.
    pub fn finished_json(&self) -> Value {
        let mut json = self.json.clone();
        if json["buffers"].is_null() && !self.bin.is_empty() {
            json["buffers"] = json!([{"byteLength": self.bin.len()}]);
        }
        json
    }

    /// The model as a GLB.
    pub fn glb(&self) -> Vec<u8> {
        glb(&serde_json::to_vec(&self.finished_json()).unwrap(), &self.bin)
    }

    /// Writes the GLB into a folder.
    pub fn write(&self, folder: &Path, name: &str) -> PathBuf {
        let path = folder.join(name);
        std::fs::write(&path, self.glb()).unwrap();
        path
    }
}

/// A GLB of these two chunks.
pub fn glb(json: &[u8], bin: &[u8]) -> Vec<u8> {
    let pad = |n: usize| n.next_multiple_of(4);
    let mut out = b"glTF\x02\0\0\0".to_vec();
    let bin_size = if bin.is_empty() { 0 } else { 8 + pad(bin.len()) };
    out.extend((20 + pad(json.len()) as u32 + bin_size as u32).to_le_bytes());
    out.extend((pad(json.len()) as u32).to_le_bytes());
    out.extend(b"JSON");
    out.extend(json);
    out.resize(20 + pad(json.len()), b' ');
    if !bin.is_empty() {
        out.extend((pad(bin.len()) as u32).to_le_bytes());
        out.extend(b"BIN\0");
        out.extend(bin);
        out.resize(out.len().next_multiple_of(4), 0);
    }
    out
}

/// A PNG of one color.
pub fn png(width: u32, height: u32) -> Vec<u8> {
    let mut out = std::io::Cursor::new(Vec::new());
    image::RgbaImage::from_pixel(width, height, image::Rgba([200, 100, 50, 255]))
        .write_to(&mut out, image::ImageFormat::Png)
        .unwrap();
    out.into_inner()
}

/// A PNG of one pixel whose header declares another size.
pub fn lying_png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = png(1, 1);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let crc = !bytes[12..29].iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { (c >> 1) ^ 0xEDB8_8320 } else { c >> 1 })
    });
    bytes[29..33].copy_from_slice(&crc.to_be_bytes());
    bytes
}
