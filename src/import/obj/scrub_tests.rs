//! Texts before and after scrubbing.

use super::*;

fn scrubbed(text: &[u8]) -> String {
    let out = scrub(text, &Progress::default()).unwrap();
    out.head + &String::from_utf8_lossy(&out.body)
}

#[test]
fn corners_of_all_kinds() {
    let counts = [10, 5, 3];
    const BEFORE: Option<usize> = Some(usize::MAX);
    for (word, expected) in [
        ("1", Some([Some(1), None, None])),
        ("1/2", Some([Some(1), Some(2), None])),
        ("1//3", Some([Some(1), None, Some(3)])),
        ("-1/-2/-3", Some([Some(10), Some(4), Some(1)])),
        ("0", Some([BEFORE, None, None])),
        ("-11", Some([BEFORE, None, None])),
        ("99999999999", Some([Some(99_999_999_999), None, None])),
        ("-9223372036854775808", Some([BEFORE, None, None])),
        ("/1", None),
        ("1/2/3/4", None),
        ("x", None),
    ] {
        assert_eq!(corner(word, counts), expected, "{word}");
    }
}

#[test]
fn a_sound_text_is_not_copied() {
    let text =
        b"# made by hand\nmtllib a b.mtl\no box\nv 0 0 0\r\nv 1 0 0 \nv 0 1.5e1 0\nvt 0 0 1\nvn 0 0 1\n\
        usemtl my red\ns off\nf 1/1/1 2/1/1 3/1/-1\n";
    let out = scrub(text, &Progress::default()).unwrap();
    assert!(matches!(out.body, Cow::Borrowed(body) if body == text));
    assert_eq!(
        (out.counts, out.materials, out.libraries),
        ([3, 1, 1], vec!["my red".into()], vec!["a b.mtl".into()])
    );
}

#[test]
fn what_will_not_do_is_written_anew() {
    for (text, expected) in [
        ("v 1 2 3 0.5\nv 1 x\n", "v 1 2 3\nv nan nan nan\n"),
        ("v 1 2 3 1 1 0\nv 1 2 3 # here\n", "v 1 2 3 1 1 0\nv 1 2 3 1 1 1\n"),
        ("v 1 2 3 255 1 0\nv 1 2 3\n", "v 1 2 3 255 1 0\nv 1 2 3 255 255 255\n"),
        ("vt 0.5\nvn 1 2\n", "vt 0.5 0\nvn 1 2 0\n"),
        ("v 1 2 3\nvt 0 0\nfo 1/1 1/1 -1/1 # what\n", "v 1 2 3\nvt 0 0\nf 1/1/ 1/1/ 1/1/\n"),
        ("v 1 2 3\nvt 0 0\ng a\nf 1 1 1\nf 1/1 1/1 1/1", "v 1 2 3\nvt 0 0\ng a\nf 1 1 1\ng a\nf 1/1 1/1 1/1"),
        ("f 1 2 3\n", "\n"),
        ("f -1 2 1 1\nv 1 2 3\nv 1 2 3\n", "v 1 2 3\nv 1 2 3\n\n\n\n"),
        ("f 1 2 1\nv 1 2 3\nf -1 2 1\nv 4 5 6\n", "v 1 2 3\nv 4 5 6\nf 1// 2// 1//\n\nf 1// 2// 1//\n\n"),
        (" o\ta\ng b\ng default\nusemtl\n", "o a\ng a\u{1f}b\ng a\nusemtl \u{1f}\n"),
        ("l 1 2 3\rp 1\rv 1 2 \\\n 3\n", "\np 1\nv 1 2   3\n"),
    ] {
        assert_eq!(scrubbed(text.as_bytes()), expected, "{text}");
    }
}
