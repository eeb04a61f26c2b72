//! Reading line-based formats from bytes of unknown encoding.

use std::borrow::Cow;

/// The lines of a text with their numbers (from 1), split at `\n`, `\r\n` or `\r`. A line that ends in a backslash is
/// joined with the next one.
pub(super) struct TextLines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> TextLines<'a> {
    /// Begins at the start of `data`, after a byte order mark.
    pub(super) fn new(data: &'a [u8]) -> Self {
        Self { rest: data.strip_prefix(b"\xef\xbb\xbf").unwrap_or(data), number: 0 }
    }

    /// What has not been read yet.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    fn next_raw(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = self.rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest
            .strip_prefix(b"\r\n")
            .or_else(|| rest.split_first().map(|(_, rest)| rest))
            .unwrap_or_default();
        Some(line)
    }
}

impl<'a> Iterator for TextLines<'a> {
    type Item = (usize, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let line = self.next_raw()?;
        let number = self.number;
        if !line.ends_with(b"\\") {
            return Some((number, Cow::Borrowed(line)));
        }
        let mut joined = line.to_vec();
        while joined.last() == Some(&b'\\') {
            joined.pop();
            joined.push(b' ');
            match self.next_raw() {
                Some(more) => joined.extend_from_slice(more),
                None => break,
            }
        }
        Some((number, Cow::Owned(joined)))
    }
}

/// The words of a line.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// What follows the first word of a line, without the space around it.
pub(super) fn after_first_word(line: &[u8]) -> &[u8] {
    let line = line.trim_ascii();
    let end = line.iter().position(u8::is_ascii_whitespace);
    end.and_then(|end| line.get(end..)).unwrap_or_default().trim_ascii()
}

/// A number; `None` if the word is none.
pub(super) fn float(word: &[u8]) -> Option<f32> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Bytes as text; what is not UTF-8 becomes �.
pub(super) fn lossy(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// An 8-bit sRGB value as 8-bit linear.
pub(super) fn linear_byte(srgb: u8) -> u8 {
    (linear(f32::from(srgb) / 255.0) * 255.0).round() as u8
}

/// An sRGB value, 0 to 1, as linear.
pub(super) fn linear(srgb: f32) -> f32 {
    let c = srgb.clamp(0.0, 1.0);
    if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// A fault that may occur on many lines and is told once.
#[derive(Debug, Default)]
pub(super) struct RepeatedFault {
    count: usize,
    first_line: usize,
}

impl RepeatedFault {
    /// Notes the fault on a line.
    pub(super) fn note(&mut self, line: usize) {
        if self.count == 0 {
            self.first_line = line;
        }
        self.count += 1;
    }

    /// How often it occurred.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// `line 12` or `line 12 and 3 more`, if it occurred.
    pub(super) fn place(&self) -> Option<String> {
        match self.count {
            0 => None,
            1 => Some(format!("line {}", self.first_line)),
            n => Some(format!("line {} and {} more", self.first_line, n - 1)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_any_way_and_go_on_after_a_backslash() {
        let lines: Vec<_> = TextLines::new(b"\xef\xbb\xbfa\r\nb \\\n c\rd\n\ne\\")
            .map(|(n, line)| (n, lossy(&line)))
            .collect();
        let expected = [(1, "a"), (2, "b   c"), (4, "d"), (5, ""), (6, "e ")];
        assert_eq!(lines, expected.map(|(n, s)| (n, s.to_owned())));
    }

    #[test]
    fn words_and_numbers() {
        assert_eq!(words(b"  v\t1  2 ").count(), 3);
        assert_eq!(after_first_word(b" g  my part "), b"my part");
        assert_eq!(after_first_word(b"g"), b"");
        assert_eq!(float(b"-1e2"), Some(-100.0));
        assert_eq!(float(b"\xff"), None);
        assert_eq!((linear_byte(0), linear_byte(255)), (0, 255));
    }
}
