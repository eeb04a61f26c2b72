//! The numbers behind a PLY header, one after the other.

use super::header::NumberType;

/// A stream of numbers. All types fit a double exactly.
pub(super) trait Values {
    /// The next number; `None` at the end of the file or where there is none.
    fn next(&mut self, number: NumberType) -> Option<f64>;

    /// Bytes that have not been read.
    fn bytes_left(&self) -> usize;

    /// Whether numbers are written as text.
    fn is_text(&self) -> bool;

    /// The length of a list whose items fit into what is left.
    fn next_length(&mut self, length: NumberType, item: NumberType) -> Option<usize> {
        let n = self.next(length)?;
        if n < 0.0 || n.fract() != 0.0 {
            return None;
        }
        let n = n as usize;
        let size = if self.is_text() { 2 } else { item.size() };
        (n.saturating_mul(size) <= self.bytes_left() + 1).then_some(n)
    }
}

/// Numbers as words.
pub(super) struct Ascii<'a>(&'a [u8]);

impl<'a> Ascii<'a> {
    pub(super) fn new(data: &'a [u8]) -> Self {
        Self(data)
    }
}

impl Values for Ascii<'_> {
    fn next(&mut self, number: NumberType) -> Option<f64> {
        let start = self.0.trim_ascii_start();
        let end = start.iter().position(u8::is_ascii_whitespace);
        let (word, rest) = start.split_at(end.unwrap_or(start.len()));
        let word = std::str::from_utf8(word).ok()?;
        let value: f64 = match number {
            NumberType::F32 | NumberType::F64 => word.parse().ok()?,
            // Some writers put `255.0` where they declare an integer.
            _ => word.parse::<i64>().map_or_else(|_| word.parse().ok(), |n| Some(n as f64))?,
        };
        self.0 = rest;
        Some(value)
    }

    fn bytes_left(&self) -> usize {
        self.0.len()
    }

    fn is_text(&self) -> bool {
        true
    }
}

/// Numbers as bytes.
pub(super) struct Binary<'a, const BIG_ENDIAN: bool>(&'a [u8]);

impl<'a, const BIG_ENDIAN: bool> Binary<'a, BIG_ENDIAN> {
    pub(super) fn new(data: &'a [u8]) -> Self {
        Self(data)
    }

    #[inline]
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        let mut bytes = *bytes;
        if BIG_ENDIAN {
            bytes.reverse();
        }
        Some(bytes)
    }
}

impl<const BIG_ENDIAN: bool> Values for Binary<'_, BIG_ENDIAN> {
    #[inline]
    fn next(&mut self, number: NumberType) -> Option<f64> {
        Some(match number {
            NumberType::I8 => i8::from_le_bytes(self.take()?).into(),
            NumberType::U8 => u8::from_le_bytes(self.take()?).into(),
            NumberType::I16 => i16::from_le_bytes(self.take()?).into(),
            NumberType::U16 => u16::from_le_bytes(self.take()?).into(),
            NumberType::I32 => i32::from_le_bytes(self.take()?).into(),
            NumberType::U32 => u32::from_le_bytes(self.take()?).into(),
            NumberType::F32 => f32::from_le_bytes(self.take()?).into(),
            NumberType::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn bytes_left(&self) -> usize {
        self.0.len()
    }

    fn is_text(&self) -> bool {
        false
    }
}
