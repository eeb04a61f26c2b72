//! PLY, ASCII and binary of either byte order: vertices with normals, colors and texture coordinates, polygons and
//! triangle strips. Unknown elements and properties are skipped.

mod header;
mod values;

use std::path::Path;

use glam::{Vec2, Vec3};

use super::assemble::{Assembly, Branch};
use super::text::{linear_byte, lossy};
use super::{ImportError, ImportOptions, Progress};
use crate::geometry::{Mesh, Triangulator, primitives};
use crate::scene::{Material, Scene};
use header::{Element, Header, Kind, NumberType};
use values::{Ascii, Binary, Values};

/// Makes a scene of a PLY file: one node with one mesh. Where the vertices have no normals they come from the crease
/// angle. Colors are taken to be sRGB.
///
/// # Errors
/// `Malformed` when the header is wrong or declares more than the file can hold, `Empty` when no triangle can be
/// drawn, `Canceled`.
pub(super) fn load(
    path: &Path,
    data: &[u8],
    options: &ImportOptions,
    progress: &Progress,
) -> Result<Scene, ImportError> {
    let mut assembly = Assembly::new(path, options, progress);
    assembly.scene.materials.push(Material { double_sided: true, ..Material::default() });
    let (header, body) = header::parse(data).map_err(|m| assembly.malformed(m))?;
    for axis in ["x", "y", "z"] {
        if !header.vertices_have(axis) {
            return Err(assembly.malformed(format!("its vertices have no `{axis}`")));
        }
    }
    let content = match header.big_endian {
        None => read(&header, Ascii::new(body), progress),
        Some(true) => read(&header, Binary::<true>::new(body), progress),
        Some(false) => read(&header, Binary::<false>::new(body), progress),
    };
    let content = content.map_err(|fault| match fault {
        Fault::Canceled => ImportError::Canceled,
        Fault::Malformed(message) => assembly.malformed(message),
    })?;
    for warning in content.warnings {
        assembly.warn("", warning);
    }
    progress.report(0.5);
    let branch = Branch {
        name: "mesh".into(),
        mesh: Some(content.vertices.into_mesh(content.indices)),
        children: Vec::new(),
    };
    let reason = if header.has_points_only() {
        "it holds only points; Hachure draws surfaces"
    } else {
        "it holds no triangle"
    };
    assembly.finish(vec![branch], reason)
}

enum Fault {
    Canceled,
    Malformed(String),
}

struct Content {
    vertices: Vertices,
    indices: Vec<u32>,
    warnings: Vec<String>,
}

fn read(header: &Header, mut values: impl Values, progress: &Progress) -> Result<Content, Fault> {
    let mut vertices = Vertices::default();
    let mut faces = Faces::default();
    let mut warnings = Vec::new();
    for element in &header.elements {
        progress.check().map_err(|_canceled| Fault::Canceled)?;
        if element.properties.is_empty() {
            continue;
        }
        let holds = element.count_that_fits(values.bytes_left(), values.is_text());
        let is_vertex = element.name == "vertex";
        if holds < element.count && is_vertex {
            return Err(Fault::Malformed(format!(
                "the header declares {} vertices, but the file has room for {holds} at most; get a complete copy",
                element.count
            )));
        }
        let complete = match element.name.as_str() {
            "vertex" => vertices.read(element, &mut values),
            "face" | "tristrips" => faces.read(element, &mut values),
            _ => skip(element, &mut values),
        };
        if complete < element.count {
            let what = format!("after {complete} of {} entries of `{}`", element.count, element.name);
            if is_vertex {
                return Err(Fault::Malformed(format!(
                    "the file ends or is damaged {what}; get a complete copy"
                )));
            }
            warnings.push(format!("the file ends or is damaged {what}"));
            break;
        }
    }
    if faces.short > 0 {
        warnings.push(format!("left out {} faces with fewer than three corners", faces.short));
    }
    Ok(Content { indices: faces.triangles(&vertices.positions), vertices, warnings })
}

/// Reads over an element; returns the number of complete entries.
fn skip(element: &Element, values: &mut impl Values) -> u64 {
    for entry in 0..element.count {
        for property in &element.properties {
            let read = match property.kind {
                Kind::Scalar(number) => values.next(number).map(|_| ()),
                Kind::List(length, item) => values
                    .next_length(length, item)
                    .and_then(|n| (0..n).try_for_each(|_| values.next(item).map(|_| ()))),
            };
            if read.is_none() {
                return entry;
            }
        }
    }
    element.count
}

/// What a property of a vertex is good for: places in a vertex row.
fn slot(name: &str) -> Option<usize> {
    const NAMES: [&[&str]; SLOTS] = [
        &["x"],
        &["y"],
        &["z"],
        &["nx", "normal_x"],
        &["ny", "normal_y"],
        &["nz", "normal_z"],
        &["red", "r", "diffuse_red"],
        &["green", "g", "diffuse_green"],
        &["blue", "b", "diffuse_blue"],
        &["alpha", "a", "diffuse_alpha"],
        &["u", "s", "texture_u", "texture_s"],
        &["v", "t", "texture_v", "texture_t"],
    ];
    NAMES.iter().position(|names| names.contains(&name))
}

const SLOTS: usize = 12;

#[derive(Default)]
struct Vertices {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    colors: Vec<[u8; 4]>,
    uvs: Vec<Vec2>,
}

impl Vertices {
    fn read(&mut self, element: &Element, values: &mut impl Values) -> u64 {
        let slots: Vec<(Kind, Option<usize>)> =
            element.properties.iter().map(|p| (p.kind, slot(&p.name))).collect();
        let kind_of = |wanted: usize| {
            let found = slots.iter().rev().find(|&&(_, slot)| slot == Some(wanted));
            found.map(|&(kind, _)| kind)
        };
        let has = |range: std::ops::Range<usize>| range.into_iter().all(|s| kind_of(s).is_some());
        let (normals, colors, uvs) = (has(3..6), has(6..9), has(10..12));
        let color_scale = match kind_of(6) {
            Some(Kind::Scalar(NumberType::F32 | NumberType::F64)) => 255.0,
            Some(Kind::Scalar(NumberType::U16 | NumberType::I16)) => 255.0 / 65535.0,
            _ => 1.0,
        };
        let linear: Vec<u8> = (0..=255).map(linear_byte).collect();
        let mut row = [0.0; SLOTS];
        row[9] = 255.0 / color_scale;
        for entry in 0..element.count {
            for &(kind, slot) in &slots {
                let value = match kind {
                    Kind::Scalar(number) => values.next(number),
                    Kind::List(length, item) => values
                        .next_length(length, item)
                        .and_then(|n| (0..n).try_fold(0.0, |_, _| values.next(item))),
                };
                let Some(value) = value else {
                    return entry;
                };
                if let Some(place) = slot.and_then(|s| row.get_mut(s)) {
                    *place = value;
                }
            }
            let [x, y, z, nx, ny, nz, r, g, b, a, u, v] = row;
            let vector = |x: f64, y: f64, z: f64| Vec3::new(x as f32, y as f32, z as f32);
            self.positions.push(vector(x, y, z));
            if normals {
                self.normals.push(vector(nx, ny, nz));
            }
            if colors {
                let byte = |c: f64| (c * color_scale).round() as u8;
                let to_linear = |c: f64| linear.get(usize::from(byte(c))).copied().unwrap_or(255);
                self.colors.push([to_linear(r), to_linear(g), to_linear(b), byte(a)]);
            }
            if uvs {
                self.uvs.push(Vec2::new(u as f32, 1.0 - v as f32));
            }
        }
        element.count
    }

    fn into_mesh(self, indices: Vec<u32>) -> Mesh {
        Mesh {
            normals: self.normals,
            colors: self.colors,
            uvs: self.uvs,
            ..primitives::from_triangles(self.positions, indices)
        }
    }
}

#[derive(Default)]
struct Faces {
    /// Corners of all polygons, one after the other; `u32::MAX` where the file says what cannot be an index.
    corners: Vec<u32>,
    /// Where each polygon ends in `corners`.
    ends: Vec<usize>,
    /// Polygons with fewer than three corners.
    short: usize,
}

impl Faces {
    /// Reads polygons or triangle strips; returns the number of complete entries.
    fn read(&mut self, element: &Element, values: &mut impl Values) -> u64 {
        let strips = element.name == "tristrips";
        for entry in 0..element.count {
            for property in &element.properties {
                let start = self.corners.len();
                let is_corners = matches!(property.name.as_str(), "vertex_indices" | "vertex_index");
                let read = match property.kind {
                    Kind::Scalar(number) => values.next(number).map(|_| ()),
                    Kind::List(length, item) => values.next_length(length, item).and_then(|n| {
                        (0..n).try_for_each(|_| {
                            let value = values.next(item)?;
                            if is_corners {
                                let index = value as u32;
                                let exact = f64::from(index) == value;
                                self.corners.push(if exact { index } else { u32::MAX });
                            }
                            Some(())
                        })
                    }),
                };
                if read.is_none() {
                    self.corners.truncate(start);
                    return entry;
                }
                if strips {
                    self.unroll(start);
                } else if is_corners {
                    self.close(start);
                }
            }
        }
        element.count
    }

    /// Ends the polygon that began at `start`.
    fn close(&mut self, start: usize) {
        if self.corners.len() < start + 3 {
            self.corners.truncate(start);
            self.short += 1;
        } else {
            self.ends.push(self.corners.len());
        }
    }

    /// Makes triangles of the strips that began at `start`; an index of −1 begins a new one.
    fn unroll(&mut self, start: usize) {
        let strips = self.corners.split_off(start);
        for strip in strips.split(|&v| v == u32::MAX) {
            for (k, triangle) in strip.windows(3).enumerate() {
                let &[a, b, c] = triangle else { continue };
                if a == b || b == c || c == a {
                    continue;
                }
                self.corners.extend(if k % 2 == 0 { [a, b, c] } else { [b, a, c] });
                self.ends.push(self.corners.len());
            }
        }
    }

    /// All polygons as triangles.
    fn triangles(self, positions: &[Vec3]) -> Vec<u32> {
        if self.ends.len() * 3 == self.corners.len() {
            return self.corners;
        }
        let mut triangulator = Triangulator::default();
        let mut points = Vec::new();
        let mut indices = Vec::with_capacity(self.corners.len());
        let mut start = 0;
        for end in self.ends {
            let corners = self.corners.get(start..end).unwrap_or_default();
            start = end;
            points.clear();
            // Corners out of range are left to the cleaning, which counts them.
            points.extend(corners.iter().map(|&v| {
                let position = positions.get(v as usize);
                position.copied().unwrap_or(Vec3::NAN)
            }));
            triangulator.triangulate(&points, |triangle| {
                for corner in triangle {
                    indices.push(corners.get(corner as usize).copied().unwrap_or(u32::MAX));
                }
            });
        }
        indices
    }
}

impl Header {
    /// Whether the vertices, if there are any, have this property.
    fn vertices_have(&self, property: &str) -> bool {
        let mut vertices = self.elements.iter().filter(|e| e.name == "vertex");
        vertices.all(|e| e.count == 0 || e.properties.iter().any(|p| p.name == property))
    }

    /// Whether there are vertices and nothing that connects them.
    fn has_points_only(&self) -> bool {
        let count = |name: &str| {
            let same = self.elements.iter().filter(|e| e.name == name);
            same.map(|e| e.count).sum::<u64>()
        };
        count("vertex") > 0 && count("face") + count("tristrips") == 0
    }
}

/// A word of the header for a message.
fn quoted(word: &[u8]) -> String {
    format!("`{}`", super::source::shorten(&lossy(word)))
}
