//! The lines of an OBJ file, collected without judging them.

use std::collections::HashMap;

use glam::{Vec2, Vec3};

use crate::import::text::{Fault, Lines, after_first_word, float, lossy, words};
use crate::import::{ImportError, Progress};

/// Stands for an index that is not given.
pub(super) const NONE: u32 = u32::MAX;
/// Stands for an index that points before the first entry.
pub(super) const INVALID: u32 = u32::MAX - 1;

/// Everything in a file.
#[derive(Debug, Default)]
pub(super) struct Parsed {
    pub(super) positions: Vec<Vec3>,
    /// Colours of the first vertices, as in the file; empty when there are none.
    pub(super) colors: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    pub(super) normals: Vec<Vec3>,
    pub(super) groups: Vec<Group>,
    /// Names of materials in the order of their first use.
    pub(super) materials: Vec<String>,
    /// Lists of material files, as written.
    pub(super) libraries: Vec<String>,
    /// Lines that could not be understood.
    pub(super) bad_lines: Fault,
    /// Faces with fewer than three corners.
    pub(super) short_faces: Fault,
    /// Points and lines.
    pub(super) points_and_lines: Fault,
    /// Free-form curves and surfaces.
    pub(super) free_form: Fault,
}

/// The faces of one object and group.
#[derive(Debug, Default)]
pub(super) struct Group {
    /// Name after `o`; empty if there is none.
    pub(super) object: String,
    /// Name after `g`; empty if there is none.
    pub(super) group: String,
    /// Runs of faces with one material.
    pub(super) runs: Vec<Run>,
}

/// Faces with one material.
#[derive(Debug, Default)]
pub(super) struct Run {
    /// Index into [`Parsed::materials`].
    pub(super) material: Option<usize>,
    /// Per corner the indices (from 0) of position, texture coordinates and normal.
    pub(super) corners: Vec<[u32; 3]>,
    /// Where each face ends in `corners`.
    pub(super) ends: Vec<usize>,
}

/// Reads all lines.
///
/// # Errors
/// Only `Cancelled`: lines that cannot be understood are counted.
pub(super) fn parse(data: &[u8], progress: &Progress) -> Result<Parsed, ImportError> {
    let mut parser = Parser::default();
    let mut lines = Lines::new(data);
    while let Some((number, line)) = lines.next() {
        if number % 65_536 == 0 {
            progress.check()?;
            progress.report(0.4 * (1.0 - lines.rest().len() as f32 / data.len() as f32));
        }
        parser.line(number, &line);
    }
    Ok(parser.out)
}

#[derive(Default)]
struct Parser {
    out: Parsed,
    object: String,
    group: String,
    material: Option<usize>,
    /// Where faces go, once there is one after the last change of names or material.
    place: Option<(usize, usize)>,
    groups: HashMap<(String, String), usize>,
    materials: HashMap<String, usize>,
}

impl Parser {
    fn line(&mut self, number: usize, line: &[u8]) {
        let mut words = words(line);
        let Some(keyword) = words.next() else { return };
        let out = &mut self.out;
        match keyword {
            b"v" => {
                let mut values = [0.0; 7];
                let count = numbers(words, &mut values);
                if count < 3 {
                    out.bad_lines.note(number);
                }
                let [x, y, z, ..] = values;
                out.positions.push(if count < 3 { Vec3::NAN } else { Vec3::new(x, y, z) });
                if count >= 6 {
                    let [.., r, g, b, _] = values;
                    out.colors.resize(out.positions.len() - 1, Vec3::ONE);
                    out.colors.push(Vec3::new(r, g, b));
                }
            }
            b"vt" => {
                let mut values = [0.0; 2];
                if numbers(words, &mut values) == 0 {
                    out.bad_lines.note(number);
                }
                out.uvs.push(values.into());
            }
            b"vn" => {
                let mut values = [0.0; 3];
                if numbers(words, &mut values) < 3 {
                    out.bad_lines.note(number);
                }
                out.normals.push(values.into());
            }
            b"f" | b"fo" => self.face(number, words),
            b"o" => self.rename(true, line),
            b"g" => self.rename(false, line),
            b"usemtl" => {
                let name = lossy(after_first_word(line));
                let next = self.materials.len();
                self.material = Some(*self.materials.entry(name.clone()).or_insert_with(|| {
                    out.materials.push(name);
                    next
                }));
                self.place = None;
            }
            b"mtllib" => {
                let name = lossy(after_first_word(line));
                if !out.libraries.contains(&name) {
                    out.libraries.push(name);
                }
            }
            b"p" | b"l" => out.points_and_lines.note(number),
            b"curv" | b"curv2" | b"surf" => out.free_form.note(number),
            b"s" | b"usemap" | b"maplib" | b"bevel" | b"c_interp" | b"d_interp" | b"lod" | b"shadow_obj"
            | b"trace_obj" | b"mg" | b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"parm" | b"trim"
            | b"hole" | b"scrv" | b"sp" | b"end" | b"con" | b"ctech" | b"stech" | b"call" | b"csh" => {}
            _ if keyword.starts_with(b"#") => {}
            _ => out.bad_lines.note(number),
        }
    }

    fn rename(&mut self, is_object: bool, line: &[u8]) {
        let name = lossy(after_first_word(line));
        if is_object {
            self.object = name;
            self.group.clear();
        } else {
            // `default` is what the format calls "no group".
            self.group = if name == "default" { String::new() } else { name };
        }
        self.place = None;
    }

    fn face<'a>(&mut self, number: usize, words: impl Iterator<Item = &'a [u8]>) {
        let (group, run) = *self.place.get_or_insert_with(|| {
            let groups = &mut self.out.groups;
            let names = (self.object.clone(), self.group.clone());
            let group = *self.groups.entry(names).or_insert_with(|| {
                groups.push(Group {
                    object: self.object.clone(),
                    group: self.group.clone(),
                    runs: Vec::new(),
                });
                groups.len() - 1
            });
            let runs = groups.get_mut(group).map(|g| &mut g.runs);
            let run = runs.map_or(0, |runs| {
                let same = runs.iter().position(|r| r.material == self.material);
                same.unwrap_or_else(|| {
                    runs.push(Run { material: self.material, ..Run::default() });
                    runs.len() - 1
                })
            });
            (group, run)
        });
        let out = &mut self.out;
        let counts = [out.positions.len(), out.uvs.len(), out.normals.len()];
        let group = out.groups.get_mut(group);
        let Some(run) = group.and_then(|g| g.runs.get_mut(run)) else {
            return;
        };
        let start = run.corners.len();
        for word in words {
            if word.starts_with(b"#") {
                break;
            }
            match corner(word, counts) {
                Some(corner) => run.corners.push(corner),
                None => {
                    out.bad_lines.note(number);
                    run.corners.truncate(start);
                    return;
                }
            }
        }
        if run.corners.len() < start + 3 {
            run.corners.truncate(start);
            out.short_faces.note(number);
        } else {
            run.ends.push(run.corners.len());
        }
    }
}

/// Reads numbers until there are enough or one is none; returns how many.
fn numbers<'a>(words: impl Iterator<Item = &'a [u8]>, values: &mut [f32]) -> usize {
    let mut count = 0;
    for (value, word) in values.iter_mut().zip(words) {
        let Some(number) = float(word) else { break };
        *value = number;
        count += 1;
    }
    count
}

/// `position/uv/normal`, the last two optional, as indices from 0.
fn corner(word: &[u8], counts: [usize; 3]) -> Option<[u32; 3]> {
    let mut corner = [NONE; 3];
    let mut fields = word.split(|&b| b == b'/');
    for (place, (slot, count)) in corner.iter_mut().zip(counts).enumerate() {
        match fields.next() {
            None => break,
            Some([]) if place > 0 => {}
            Some(field) => *slot = index(field, count)?,
        }
    }
    fields.next().is_none().then_some(corner)
}

/// An index from 0; negative ones count back from the last entry so far.
fn index(field: &[u8], count: usize) -> Option<u32> {
    let value: i64 = std::str::from_utf8(field).ok()?.parse().ok()?;
    let index = match value {
        1.. => value - 1,
        _ => match (count as i64).checked_add(value) {
            Some(index) if value < 0 && index >= 0 => index,
            _ => return Some(INVALID),
        },
    };
    Some(u32::try_from(index).unwrap_or(INVALID).min(INVALID))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_of_all_kinds() {
        let counts = [10, 5, 3];
        for (word, expected) in [
            ("1", Some([0, NONE, NONE])),
            ("1/2", Some([0, 1, NONE])),
            ("1//3", Some([0, NONE, 2])),
            ("-1/-2/-3", Some([9, 3, 0])),
            ("0", Some([INVALID, NONE, NONE])),
            ("-11", Some([INVALID, NONE, NONE])),
            ("99999999999", Some([INVALID, NONE, NONE])),
            ("/1", None),
            ("1/2/3/4", None),
            ("x", None),
            ("-9223372036854775808", Some([INVALID, NONE, NONE])),
        ] {
            assert_eq!(corner(word.as_bytes(), counts), expected, "{word}");
        }
    }

    #[test]
    fn groups_that_come_back_are_the_same_group() {
        let text = b"v 0 0 0\ng a\nf 1 1 1\ng b\nf 1 1 1\ng a\nusemtl red\nf 1 1 1 # 2\nf 1 1\nwhat\n";
        let parsed = parse(text, &Progress::default()).unwrap();
        let names: Vec<_> = parsed.groups.iter().map(|g| (&g.group[..], g.runs.len())).collect();
        assert_eq!(names, [("a", 2), ("b", 1)]);
        assert_eq!(parsed.short_faces.count(), 1);
        assert_eq!(parsed.bad_lines.place().unwrap(), "line 10");
    }
}
