//! The header of a PLY file.

use super::quoted;
use crate::import::text::{TextLines, lossy, words};

/// What a file declares.
#[derive(Debug)]
pub(super) struct Header {
    /// Byte order of the content; `None` for ASCII.
    pub(super) big_endian: Option<bool>,
    /// Elements in the order of their content.
    pub(super) elements: Vec<Element>,
}

/// A table of the content.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    /// Number of entries; not to be trusted.
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

/// A column of a table.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

/// What a column holds.
#[derive(Debug, Clone, Copy)]
pub(super) enum Kind {
    /// One number per entry.
    Scalar(NumberType),
    /// A list per entry: type of its length, type of its items.
    List(NumberType, NumberType),
}

/// Types of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl NumberType {
    /// Bytes in binary files.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    fn parse(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }
}

impl Element {
    /// How many entries can be in so many bytes at most.
    pub(super) fn count_that_fits(&self, bytes: usize, text: bool) -> u64 {
        let size: usize = self
            .properties
            .iter()
            .map(|p| match (text, p.kind) {
                // A digit and a space.
                (true, _) => 2,
                (false, Kind::Scalar(number) | Kind::List(number, _)) => number.size(),
            })
            .sum();
        match size {
            0 => self.count,
            // The last number of a text needs no space behind it.
            _ => self.count.min(((bytes + usize::from(text)) / size) as u64),
        }
    }
}

/// Reads the header; returns it with the content behind it.
///
/// # Errors
/// A sentence that names the line.
pub(super) fn parse(data: &[u8]) -> Result<(Header, &[u8]), String> {
    const MAX_LINES: usize = 100_000;
    let mut lines = TextLines::new(data);
    if lines.next().is_none_or(|(_, line)| line.trim_ascii() != b"ply") {
        return Err("this is no PLY file: its first line is not `ply`".into());
    }
    let mut format = None;
    let mut elements: Vec<Element> = Vec::new();
    for (number, line) in lines.by_ref() {
        let words: Vec<&[u8]> = words(&line).collect();
        let fault = |message: String| Err(format!("line {number}: {message}"));
        match words.as_slice() {
            [b"end_header"] => {
                let big_endian = format.ok_or("the header has no `format` line".to_owned())?;
                let header = Header { big_endian, elements };
                return Ok((header, lines.rest()));
            }
            [] | [b"comment" | b"obj_info", ..] => {}
            [b"format", name, ..] => {
                format = Some(match *name {
                    b"ascii" => None,
                    b"binary_little_endian" => Some(false),
                    b"binary_big_endian" => Some(true),
                    other => return fault(format!("unknown format {}", quoted(other))),
                });
            }
            [b"element", name, count] => {
                let parsed = std::str::from_utf8(count).ok().and_then(|c| c.parse().ok());
                let Some(count) = parsed else {
                    return fault(format!("{} is no number of entries", quoted(count)));
                };
                elements.push(Element { name: lossy(name), count, properties: Vec::new() });
            }
            [b"property", rest @ ..] => {
                let Some(property) = property(rest) else {
                    return fault(format!("cannot understand {}", quoted(&line)));
                };
                match elements.last_mut() {
                    Some(element) => element.properties.push(property),
                    None => return fault("a property stands before the first element".into()),
                }
            }
            _ => return fault(format!("cannot understand {}", quoted(&line))),
        }
        if number > MAX_LINES {
            break;
        }
    }
    Err("the header has no `end_header` line; get a complete copy".into())
}

fn property(words: &[&[u8]]) -> Option<Property> {
    let (kind, name) = match words {
        [b"list", length, item, name] => {
            let length = NumberType::parse(length)?;
            if matches!(length, NumberType::F32 | NumberType::F64) {
                return None;
            }
            (Kind::List(length, NumberType::parse(item)?), name)
        }
        [number, name] => (Kind::Scalar(NumberType::parse(number)?), name),
        _ => return None,
    };
    Some(Property { name: lossy(name).to_ascii_lowercase(), kind })
}
