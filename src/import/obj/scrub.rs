//! Makes the text of an OBJ file such that `tobj` reads all of it: one bad line or index makes it refuse a file.
//!
//! Nothing is read here: lines are checked, and those that will not do are left out or written anew. A sound file is
//! not even copied.

use std::borrow::Cow;
use std::collections::HashSet;
use std::fmt::Write;
use std::ops::Range;

use crate::import::text::{RepeatedFault, TextLines};
use crate::import::{ImportError, Progress};

/// Stands between the name of an object and that of a group inside it.
pub(super) const INSIDE: char = '\u{1f}';

/// A text for `tobj`, and what the lines say that `tobj` does not tell.
#[derive(Debug, Default)]
pub(super) struct Scrubbed<'a> {
    /// Vertices that must come before everything else.
    pub(super) head: String,
    /// The text.
    pub(super) body: Cow<'a, [u8]>,
    /// Names of materials in the order of their first use.
    pub(super) materials: Vec<String>,
    /// Lists of material files, as written.
    pub(super) libraries: Vec<String>,
    /// Number of lines with positions, texture coordinates and normals.
    pub(super) counts: [usize; 3],
    /// Lines with faces, good or bad.
    pub(super) faces: usize,
    /// Whether a component of a vertex color exceeds 1.
    pub(super) bright: bool,
    /// Lines that cannot be understood.
    pub(super) bad_lines: RepeatedFault,
    /// Faces with fewer than three corners.
    pub(super) short_faces: RepeatedFault,
    /// Faces with a corner at a vertex that does not exist, and how many triangles they would have given.
    pub(super) lost_faces: RepeatedFault,
    pub(super) lost_triangles: usize,
    /// References to texture coordinates and to normals that do not exist.
    pub(super) bad_references: [usize; 2],
    /// Points and lines.
    pub(super) points_and_lines: RepeatedFault,
    /// Free-form curves and surfaces.
    pub(super) free_form: RepeatedFault,
}

/// Checks all lines.
///
/// # Errors
/// Only `Canceled`.
pub(super) fn scrub<'a>(data: &'a [u8], progress: &Progress) -> Result<Scrubbed<'a>, ImportError> {
    let first = pass(data, Scrubber::default(), progress)?;
    let all = first.out.counts;
    let some_colored = (1..all[0]).contains(&first.colored);
    let forward = first.farthest.iter().zip(all).any(|(&index, count)| (1..=count).contains(&index));
    if !some_colored && !forward {
        return Ok(first.out);
    }
    let white = if first.out.bright { " 255 255 255" } else { " 1 1 1" };
    let second = Scrubber {
        white: some_colored.then_some(white),
        total: forward.then_some(all),
        ..Scrubber::default()
    };
    Ok(pass(data, second, progress)?.out)
}

fn pass<'a>(
    data: &'a [u8],
    mut scrubber: Scrubber<'a>,
    progress: &Progress,
) -> Result<Scrubber<'a>, ImportError> {
    let mut lines = TextLines::new(data);
    scrubber.data = lines.rest();
    let whole = scrubber.data;
    let mut start = 0;
    while let Some((number, line)) = lines.next() {
        if number % 65_536 == 0 {
            progress.check()?;
            progress.report(0.2 * start as f32 / data.len() as f32);
        }
        let end = whole.len() - lines.rest().len();
        let text = String::from_utf8_lossy(&line);
        let raw = whole.get(start..end).unwrap_or_default();
        let as_it_is =
            matches!((&line, &text), (Cow::Borrowed(_), Cow::Borrowed(_))) && !raw.ends_with(b"\r");
        scrubber.range = start..end;
        scrubber.number = number;
        match scrubber.line(&text) {
            Verdict::Keep if as_it_is => {}
            Verdict::Keep => scrubber.replace(&text),
            Verdict::Drop => scrubber.replace(""),
            Verdict::Replace(with) => scrubber.replace(&with),
        }
        start = end;
    }
    let rest = whole.get(scrubber.kept..).unwrap_or_default();
    scrubber.out.body = if scrubber.body.is_empty() {
        Cow::Borrowed(rest)
    } else {
        scrubber.body.extend_from_slice(rest);
        Cow::Owned(std::mem::take(&mut scrubber.body))
    };
    Ok(scrubber)
}

/// What becomes of a line.
enum Verdict {
    Keep,
    Drop,
    Replace(String),
}

#[derive(Default)]
struct Scrubber<'a> {
    out: Scrubbed<'a>,
    data: &'a [u8],
    /// Where the part of `data` begins that is not yet in `body`.
    kept: usize,
    body: Vec<u8>,
    /// Number of the line in work, and where it is.
    number: usize,
    range: Range<usize>,
    /// Color for vertices without one; set where only some have one, which `tobj` would mix up.
    white: Option<&'static str>,
    /// How many vertices of each kind there will be; set where a face refers to one behind it. All vertices then go to
    /// the head of the text.
    total: Option<[usize; 3]>,
    /// Vertices with a color.
    colored: usize,
    /// The greatest index (from 1) of each kind that a face used too early.
    farthest: [usize; 3],
    object: String,
    /// What the faces at hand belong to, and whether they have texture coordinates and normals.
    name: String,
    kind: Option<[bool; 2]>,
    used: HashSet<String>,
    corners: Vec<[Option<usize>; 3]>,
}

impl Scrubber<'_> {
    /// Puts a line in the place of the one in work.
    fn replace(&mut self, line: &str) {
        self.insert(line);
        self.kept = self.range.end;
    }

    /// Puts a line before the one in work.
    fn insert(&mut self, line: &str) {
        self.body.extend_from_slice(self.data.get(self.kept..self.range.start).unwrap_or_default());
        self.body.extend_from_slice(line.as_bytes());
        self.body.push(b'\n');
        self.kept = self.range.start;
    }

    fn line(&mut self, line: &str) -> Verdict {
        let mut words = line.split_whitespace();
        let Some(keyword) = words.next() else { return Verdict::Keep };
        let rest = line.trim_start().get(keyword.len()..).unwrap_or_default().trim();
        let out = &mut self.out;
        match keyword {
            "v" => return self.position(rest),
            "vt" => return self.vertex(1, rest),
            "vn" => return self.vertex(2, rest),
            "f" | "fo" => return self.face(keyword, rest),
            "o" => {
                rest.clone_into(&mut self.object);
                return self.rename("o", rest.to_owned(), line);
            }
            "g" => {
                // `default` is what the format calls "no group".
                let none = rest == "default" || rest == self.object;
                let name = match (self.object.as_str(), if none { "" } else { rest }) {
                    ("", group) => group.to_owned(),
                    (object, "") => object.to_owned(),
                    (object, group) => format!("{object}{INSIDE}{group}"),
                };
                return self.rename("g", name, line);
            }
            "usemtl" => {
                if !rest.is_empty() && self.used.insert(rest.to_owned()) {
                    out.materials.push(rest.to_owned());
                }
                return canonical(line, "usemtl", material_name(rest));
            }
            "mtllib" => {
                if !out.libraries.iter().any(|l| l == rest) {
                    out.libraries.push(rest.to_owned());
                }
            }
            "p" | "l" => out.points_and_lines.note(self.number),
            "curv" | "curv2" | "surf" => out.free_form.note(self.number),
            "s" | "usemap" | "maplib" | "bevel" | "c_interp" | "d_interp" | "lod" | "shadow_obj"
            | "trace_obj" | "mg" | "vp" | "cstype" | "deg" | "bmat" | "step" | "parm" | "trim" | "hole"
            | "scrv" | "sp" | "end" | "con" | "ctech" | "stech" | "call" | "csh" => {}
            _ if keyword.starts_with('#') => {}
            _ => out.bad_lines.note(self.number),
        }
        // `tobj` takes lines for faces, and passes over everything else.
        if keyword == "l" { Verdict::Drop } else { Verdict::Keep }
    }

    fn rename(&mut self, keyword: &str, name: String, line: &str) -> Verdict {
        self.name = name;
        self.kind = None;
        canonical(line, keyword, &self.name)
    }

    /// Three numbers, with a color or not. The weight that may follow says nothing for polygons.
    fn position(&mut self, rest: &str) -> Verdict {
        let mut numbers = [0.0; 6];
        let count = floats(rest, &mut numbers);
        let [_, _, _, color @ ..] = numbers;
        let colored = count == 6;
        if colored {
            self.colored += 1;
            self.out.bright |= color.iter().any(|&c| c > 1.0);
        }
        if count < 3 {
            self.out.bad_lines.note(self.number);
        }
        let wanted = if colored { 6 } else { 3 };
        let white = self.white.filter(|_| !colored).unwrap_or_default();
        let sound = count >= 3 && white.is_empty() && rest.split_whitespace().nth(wanted).is_none();
        // Bad ones stay as NaN, so that the others keep their number.
        let words = if count < 3 { "nan nan nan" } else { rest };
        self.add(0, sound, || format!("v {}{white}", first_words(words, wanted)))
    }

    /// Texture coordinates (1) or a normal (2).
    fn vertex(&mut self, kind: usize, rest: &str) -> Verdict {
        let wanted = kind + 1;
        let mut numbers = [0.0; 3];
        let count = floats(rest, numbers.get_mut(..wanted).unwrap_or_default());
        // One texture coordinate is enough.
        if count < if kind == 1 { 1 } else { wanted } {
            self.out.bad_lines.note(self.number);
        }
        let [x, y, z] = numbers;
        self.add(kind, count == wanted, || {
            if kind == 1 { format!("vt {x} {y}") } else { format!("vn {x} {y} {z}") }
        })
    }

    fn add(&mut self, kind: usize, sound: bool, anew: impl FnOnce() -> String) -> Verdict {
        if let Some(count) = self.out.counts.get_mut(kind) {
            *count += 1;
        }
        if self.total.is_none() {
            return if sound { Verdict::Keep } else { Verdict::Replace(anew()) };
        }
        let head = if sound { self.line_text() } else { anew() };
        self.out.head.push_str(&head);
        self.out.head.push('\n');
        Verdict::Drop
    }

    /// The line in work.
    fn line_text(&self) -> String {
        let raw = self.data.get(self.range.clone()).unwrap_or_default();
        let line = TextLines::new(raw).next().map(|(_, line)| String::from_utf8_lossy(&line).into_owned());
        line.unwrap_or_default()
    }

    fn face(&mut self, keyword: &str, rest: &str) -> Verdict {
        self.out.faces += 1;
        self.corners.clear();
        let counts = self.total.unwrap_or(self.out.counts);
        let mut commented = false;
        let mut bad = [0; 3];
        for word in rest.split_whitespace() {
            commented = word.starts_with('#');
            if commented {
                break;
            }
            let Some(indices) = corner(word, self.out.counts) else {
                self.out.bad_lines.note(self.number);
                return Verdict::Drop;
            };
            let mut valid = [None; 3];
            for (kind, index) in indices.into_iter().enumerate() {
                let count = counts.get(kind).copied().unwrap_or(0);
                let good = index.filter(|i| (1..=count).contains(i));
                if let (Some(index), None, Some(bad)) = (index, good, bad.get_mut(kind)) {
                    *bad += 1;
                    if let Some(farthest) = self.farthest.get_mut(kind) {
                        // What is behind the end of the file must not hide what is not.
                        if *farthest == 0 || index < *farthest {
                            *farthest = index;
                        }
                    }
                }
                if let Some(slot) = valid.get_mut(kind) {
                    *slot = good;
                }
            }
            self.corners.push(valid);
        }
        if self.corners.len() < 3 {
            self.out.short_faces.note(self.number);
            return Verdict::Drop;
        }
        let [lost, bad_uvs, bad_normals] = bad;
        for (sum, n) in self.out.bad_references.iter_mut().zip([bad_uvs, bad_normals]) {
            *sum += n;
        }
        if lost > 0 {
            self.out.lost_faces.note(self.number);
            self.out.lost_triangles += self.corners.len() - 2;
            return Verdict::Drop;
        }
        let all = |f: fn(&[Option<usize>; 3]) -> bool| self.corners.iter().all(f);
        let any = |f: fn(&[Option<usize>; 3]) -> bool| self.corners.iter().any(f);
        let (has_uvs, has_normals) = (all(|c| c[1].is_some()), all(|c| c[2].is_some()));
        let mixed = (!has_uvs && any(|c| c[1].is_some())) || (!has_normals && any(|c| c[2].is_some()));
        self.begin(has_uvs, has_normals);
        let sound = keyword == "f" && !commented && !mixed && bad == [0; 3] && self.total.is_none();
        if sound {
            return Verdict::Keep;
        }
        let mut text = "f".to_owned();
        for &[position, uv, normal] in &self.corners {
            let index = |i: Option<usize>| i.map_or(String::new(), |i| i.to_string());
            let uv = index(uv.filter(|_| has_uvs));
            let normal = index(normal.filter(|_| has_normals));
            // Writing to a string cannot fail.
            let _ = write!(text, " {}/{uv}/{normal}", index(position));
        }
        Verdict::Replace(text)
    }

    /// Begins a new model where faces begin or cease to have texture coordinates or normals: `tobj` numbers those of
    /// one model without gaps.
    fn begin(&mut self, has_uvs: bool, has_normals: bool) {
        let kind = [has_uvs, has_normals];
        if self.kind.is_some_and(|k| k != kind) {
            let name = format!("g {}", self.name);
            self.insert(&name);
        }
        self.kind = Some(kind);
    }
}

/// The name of a material for `tobj`, which refuses an empty one.
pub(super) fn material_name(name: &str) -> &str {
    if name.is_empty() { "\u{1f}" } else { name }
}

/// Keeps the line if `tobj` will find the name in it.
fn canonical(line: &str, keyword: &str, name: &str) -> Verdict {
    let found = line.strip_prefix(keyword).and_then(|l| l.strip_prefix(' ')).map(str::trim);
    if found == Some(name) { Verdict::Keep } else { Verdict::Replace(format!("{keyword} {name}")) }
}

/// Reads numbers until there are enough or a word is none; returns how many.
fn floats(rest: &str, numbers: &mut [f32]) -> usize {
    let words = rest.split_whitespace().map_while(|word| word.parse().ok());
    numbers.iter_mut().zip(words).map(|(number, word)| *number = word).count()
}

fn first_words(text: &str, count: usize) -> String {
    text.split_whitespace().take(count).collect::<Vec<_>>().join(" ")
}

/// `position/uv/normal`, the last two optional, as indices from 1; negative ones count back from the last entry so
/// far. What is before the first becomes `usize::MAX`.
fn corner(word: &str, counts: [usize; 3]) -> Option<[Option<usize>; 3]> {
    let mut corner = [None; 3];
    let mut fields = word.split('/');
    for (place, (slot, count)) in corner.iter_mut().zip(counts).enumerate() {
        match fields.next() {
            None => break,
            Some("") if place > 0 => {}
            Some(field) => {
                let index: isize = field.parse().ok()?;
                let index = if index < 0 { index.saturating_add_unsigned(count + 1) } else { index };
                *slot = Some(usize::try_from(index).ok().filter(|&i| i > 0).unwrap_or(usize::MAX));
            }
        }
    }
    fields.next().is_none().then_some(corner)
}

#[cfg(test)]
#[path = "scrub_tests.rs"]
mod tests;
