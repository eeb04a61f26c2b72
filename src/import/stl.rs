//! STL, binary and ASCII: loose triangles without materials, +Z up.
//!
//! The facets' own normals are ignored, as they say nothing that the corners do not, and are often wrong.

use std::path::Path;

use glam::Vec3;
use rayon::prelude::*;

use super::assemble::{Assembly, Branch};
use super::text::{RepeatedFault, TextLines, after_first_word, float, lossy, words};
use super::{ImportError, ImportOptions, Progress};
use crate::geometry::{Mesh, Weld, primitives};
use crate::scene::{Material, Scene, Up};

/// Bytes before the first triangle of a binary file: 80 of comment, 4 of count.
const HEADER: usize = 84;
/// Bytes of a triangle in a binary file: normal and corners as 12 floats, 2 of attributes.
const RECORD: usize = 50;

/// Makes a scene of an STL file: one node per solid, corners welded, normals by crease angle.
///
/// # Errors
/// `Malformed` when it is neither kind of STL, `Empty` when no triangle can be drawn, `Unsupported` above 1.4 billion
/// triangles, `Canceled`.
pub(super) fn load(
    path: &Path,
    data: &[u8],
    options: &ImportOptions,
    progress: &Progress,
) -> Result<Scene, ImportError> {
    let mut assembly = Assembly::new(path, options, progress);
    assembly.scene.up = Up::PosZ;
    assembly.scene.materials.push(Material { double_sided: true, ..Material::default() });
    if data.len() / RECORD > (u32::MAX / 3) as usize {
        return Err(ImportError::Unsupported {
            path: path.into(),
            feature: "more than 1.4 billion triangles".into(),
        });
    }
    let solids = if is_binary(data) {
        vec![read_binary(data, &mut assembly)?]
    } else {
        read_ascii(data, &mut assembly)?
    };
    progress.report(0.2);
    let mut branches = Vec::with_capacity(solids.len());
    for solid in solids {
        progress.check()?;
        branches.push(Branch { mesh: Some(indexed(&solid.corners)), name: solid.name, children: Vec::new() });
    }
    progress.report(0.5);
    assembly.finish(branches, "it holds no triangle")
}

/// Loose triangles, three corners each.
struct Solid {
    name: String,
    corners: Vec<Vec3>,
}

fn indexed(corners: &[Vec3]) -> Mesh {
    let (positions, indices) = Weld::exact(corners).indexed(corners);
    primitives::from_triangles(positions, indices)
}

/// The number of triangles that a binary file declares.
fn declared_count(data: &[u8]) -> Option<u32> {
    let bytes = data.get(HEADER - 4..HEADER)?;
    Some(u32::from_le_bytes(bytes.try_into().ok()?))
}

/// Whether the file is binary: many binary files begin with "solid" too, so that the length decides first.
fn is_binary(data: &[u8]) -> bool {
    let Some(count) = declared_count(data) else {
        return false;
    };
    if data.len() as u64 == HEADER as u64 + RECORD as u64 * u64::from(count) {
        return true;
    }
    let start = data.get(..data.len().min(1024)).unwrap_or(data);
    let text = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start).trim_ascii_start();
    let begins_as_text = text.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    !begins_as_text || start.contains(&0)
}

fn read_binary(data: &[u8], assembly: &mut Assembly<'_>) -> Result<Solid, ImportError> {
    let declared = declared_count(data).unwrap_or(0) as usize;
    let body = data.get(HEADER..).unwrap_or_default();
    let records = body.as_chunks::<RECORD>().0;
    if records.is_empty() && declared > 0 {
        return Err(assembly.malformed(format!(
            "the file ends before the first of its {declared} triangles; get a complete copy"
        )));
    }
    if records.len() < declared {
        assembly.warn(
            "",
            format!("the file is cut off: it declares {declared} triangles and holds {}", records.len()),
        );
    }
    // Some writers leave the count at 0.
    let wanted = if declared == 0 { records.len() } else { declared.min(records.len()) };
    if wanted < records.len() || (declared == 0 && wanted > 0) {
        assembly.warn(
            "",
            format!(
                "the file declares {declared} triangles and has room for {}; {wanted} are shown",
                records.len()
            ),
        );
    }
    let mut corners = vec![Vec3::ZERO; 3 * wanted];
    corners.par_chunks_exact_mut(3).zip(records).with_min_len(4096).for_each(|(corners, record)| {
        let floats = record.as_chunks::<4>().0;
        let mut numbers = floats.iter().skip(3).map(|&b| f32::from_le_bytes(b));
        let mut next = || numbers.next().unwrap_or(f32::NAN);
        for corner in corners {
            *corner = Vec3::new(next(), next(), next());
        }
    });
    Ok(Solid { name: "mesh".into(), corners })
}

fn read_ascii(data: &[u8], assembly: &mut Assembly<'_>) -> Result<Vec<Solid>, ImportError> {
    let mut solids: Vec<Solid> = Vec::new();
    let mut current = Solid { name: "mesh".into(), corners: Vec::new() };
    let (mut bad_numbers, mut bad_facets) = (RepeatedFault::default(), RepeatedFault::default());
    let mut facet: Vec<Vec3> = Vec::new();
    let mut understood = false;
    for (number, line) in TextLines::new(data) {
        let mut words = words(&line);
        while let Some(word) = words.next() {
            let is = |keyword: &str| word.eq_ignore_ascii_case(keyword.as_bytes());
            if is("vertex") {
                let mut coordinate = || match words.next().and_then(float) {
                    Some(value) => value,
                    None => {
                        bad_numbers.note(number);
                        f32::NAN
                    }
                };
                facet.push(Vec3::new(coordinate(), coordinate(), coordinate()));
            } else if is("endloop") || is("endfacet") || is("facet") {
                understood = true;
                match facet.as_slice() {
                    [] => {}
                    [_] | [_, _] => bad_facets.note(number),
                    [first, rest @ ..] => {
                        for pair in rest.windows(2) {
                            current.corners.push(*first);
                            current.corners.extend_from_slice(pair);
                        }
                    }
                }
                facet.clear();
            } else if is("solid") {
                understood = true;
                let name = lossy(after_first_word(&line));
                let name = if name.is_empty() { "mesh".into() } else { name };
                let before = std::mem::replace(&mut current, Solid { name, corners: Vec::new() });
                if !before.corners.is_empty() {
                    solids.push(before);
                }
                break;
            } else if is("endsolid") {
                break;
            }
        }
        if !understood && number > 100 {
            break;
        }
    }
    if !understood {
        return Err(assembly.malformed(
            "neither a binary STL file (84 bytes, then 50 per triangle) nor an ASCII one (`solid`, `facet`, `vertex`)",
        ));
    }
    if !facet.is_empty() {
        assembly.warn("", "the file is cut off in its last facet");
    }
    solids.push(current);
    if let Some(place) = bad_numbers.place() {
        assembly.warn(&place, "a coordinate is missing or no number");
    }
    if let Some(place) = bad_facets.place() {
        assembly.warn(&place, "a facet has fewer than three vertices");
    }
    Ok(solids)
}
