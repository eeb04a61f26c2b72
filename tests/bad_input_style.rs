//! Hostile and damaged style files and images of styles, on the command line: a style file ends with a message that
//! says what, where and what to do; an image that cannot be had is a warning, and everything is drawn without it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::PathBuf;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use image::{DynamicImage, ImageFormat, Rgb, RgbImage};

/// A square with a pyramid on it: something with more than one shade.
const MODEL: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

struct Workplace {
    folder: tempfile::TempDir,
}

impl Workplace {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("model.obj"), MODEL).unwrap();
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, content: &[u8]) {
        std::fs::create_dir_all(self.path(name).parent().unwrap()).unwrap();
        std::fs::write(self.path(name), content).unwrap();
    }

    fn hachure(&self, args: &[&str]) -> Output {
        let began = Instant::now();
        let output = Command::new(env!("CARGO_BIN_EXE_hachure"))
            .current_dir(self.folder.path())
            .args(["render", "--resolution", "64,64", "--output", "out.png"])
            .args(args)
            .output()
            .unwrap();
        assert!(began.elapsed() < Duration::from_secs(60), "{args:?}");
        output
    }

    /// The picture that a call makes, and what it says.
    fn drawn(&self, args: &[&str]) -> (RgbImage, String) {
        let _ = std::fs::remove_file(self.path("out.png"));
        let output = self.hachure(args);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{args:?}: {said}");
        // Graphics drivers may say something too.
        let said = said.lines().filter(|line| line.starts_with("hachure: ")).collect();
        (image::open(self.path("out.png")).unwrap().into_rgb8(), said)
    }
}

fn png(image: &DynamicImage) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

fn ramp(width: u32, height: u32) -> Vec<u8> {
    let shade = |x: u32| [60, 40, (40 + 215 * x / width) as u8];
    png(&RgbImage::from_fn(width, height, |x, _| Rgb(shade(x))).into())
}

const TOON: [&str; 6] =
    ["--set", "technique=toon", "--set", "toon.ramp=image", "--set", "toon.object_color=0"];
const HALFTONE: [&str; 4] = ["--set", "technique=halftone", "--set", "halftone.texture=image"];

#[test]
fn an_image_that_cannot_be_had_is_a_warning_and_the_rest_is_drawn() {
    let place = Workplace::new();
    place.write("text.png", b"hello, this is text");
    place.write("empty.png", b"");
    let mut cut = ramp(64, 4);
    cut.truncate(60);
    place.write("cut.png", &cut);
    let mut gif = b"GIF89a".to_vec();
    gif.extend([1, 0, 1, 0, 0, 0, 0]);
    place.write("image.png", &gif);
    std::fs::create_dir(place.path("folder.png")).unwrap();
    let bands = place.drawn(&["model.obj", "--set", "technique=toon", "--set", "toon.object_color=0"]).0;
    let strokes = place.drawn(&["model.obj", "--set", "technique=halftone"]).0;
    let uses = [("toon.image", &TOON[..], bands), ("halftone.image", &HALFTONE[..], strokes)];
    let rows: &[(&str, &str)] = &[
        ("missing.png", "cannot read missing.png"),
        ("text.png", "text.png: it is neither a PNG nor a JPEG image"),
        ("empty.png", "empty.png: it is empty"),
        ("cut.png", "cut.png: "),
        ("image.png", "image.png: it is a gif image; save it as PNG or JPEG"),
        ("folder.png", "directory"),
        ("", "names no image"),
    ];
    for ((name, message), (key, args, built_in)) in
        rows.iter().flat_map(|row| uses.iter().map(move |u| (row, u)))
    {
        let set = format!("{key}={name}");
        let (picture, said) = place.drawn(&[&["model.obj", "--set", &set], *args].concat());
        assert!(
            said.starts_with(&format!("hachure: warning: {key}: ")) && said.contains(message),
            "{name}: {said}"
        );
        assert!(said.contains("name a"), "{name}: {said}");
        assert!(picture == *built_in, "{name}: what is built in is drawn");
    }
    let json =
        place.hachure(&[&["model.obj", "--json", "--set", "toon.image=missing.png"], &TOON[..]].concat());
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert!(json["warnings"][0].as_str().unwrap().contains("missing.png"));
    let unused = place.drawn(&["model.obj", "--set", "toon.image=missing.png"]);
    assert_eq!(unused.1, "", "an image that no choice asks for is not read");
}

#[test]
fn images_of_any_size_are_ramps_and_halftones() {
    let place = Workplace::new();
    for (name, [width, height]) in [("one.png", [1, 1]), ("wide.png", [16384, 3]), ("high.png", [2, 700])] {
        place.write(name, &ramp(width, height));
        let set = format!("toon.image={name}");
        let (picture, said) = place.drawn(&[&["model.obj", "--set", &set], &TOON[..]].concat());
        assert_eq!(said, "", "{name}");
        let set = format!("halftone.image={name}");
        let (_, said) = place.drawn(&[&["model.obj", "--set", &set], &HALFTONE[..]].concat());
        assert_eq!(said, "", "{name}");
        let own = picture.pixels().filter(|p| p.0[0] == 60 && p.0[1] == 40).count();
        assert!(own > 200, "{name}: {own} pixels of the ramp");
    }
}

#[test]
fn images_are_sought_beside_the_file_that_names_them() {
    let place = Workplace::new();
    place.write("styles/ramps/a.png", &ramp(4, 1));
    place.write(
        "styles/my.toml",
        b"technique = \"toon\"\n[toon]\nramp = \"image\"\nimage = \"ramps/a.png\"\nobject_color = 0\n",
    );
    let (by_style, said) = place.drawn(&["model.obj", "--style", "styles/my.toml"]);
    assert_eq!(said, "");
    // As it is by default, not as in a new document.
    place.write("base.toml", b"");
    let by_hand = ["model.obj", "--style", "base.toml", "--set", "toon.image=styles/ramps/a.png"];
    let (by_hand, _) = place.drawn(&[&by_hand[..], &TOON[..]].concat());
    assert!(by_style == by_hand);
    place.write(
        "styles/a.hachure",
        b"models = ['../model.obj']\n[style]\ntechnique = 'toon'\ntoon = { ramp = 'image', image = 'ramps/a.png', object_color = 0 }\n",
    );
    let (by_document, said) = place.drawn(&["styles/a.hachure"]);
    assert_eq!((by_document == by_hand, said.as_str()), (true, ""));
}

#[test]
fn a_wrong_style_file_ends_with_a_message_and_no_picture() {
    let place = Workplace::new();
    let nonsense: Vec<u8> = (0..10_u32 << 20).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let rows: &[(&str, &[u8], &str)] = &[
        (
            "unknown.toml",
            b"technique = \"toon\"\n[toon]\nbnads = 3\n",
            "line 3: unknown parameter `toon.bnads`; did you mean `toon.bands`?",
        ),
        (
            "type.toml",
            b"[toon]\nbands = \"many\"\n",
            "line 2: `toon.bands` takes a whole number from 2 to 8, not the text `many`",
        ),
        ("part.toml", b"[toon]\nbands = 2.5\n", "takes a whole number from 2 to 8, not the number 2.5"),
        ("range.toml", b"[toon]\nbands = 900\n", "line 2: `toon.bands` = 900 is out of range: 2 to 8"),
        (
            "choice.toml",
            b"toon.ramp = \"rainbow\"\n",
            "one of bands, soft, two_step, warm_cool, ink_wash, image",
        ),
        ("image.toml", b"toon.image = 7\n", "takes the path of a PNG or JPEG image"),
        ("huge.toml", b"[toon]\nbands = 99999999999999999999\n", "an integer that is too large"),
        (
            "array.toml",
            b"toon = [1, 2]\n",
            "`toon` takes a switch, a number, a text, a matrix as [[a, b], [c, d]] or a curve as [[x, y], …]",
        ),
        (
            "flat.toml",
            b"[sketch.pass1]\nmatrix = [1, 2, 3, 4]\n",
            "line 2: `sketch.pass1.matrix` takes a matrix of numbers from -32 to 32, [[a, b], [c, d]] in a file",
        ),
        ("words.toml", b"sketch.fill.matrix = \"1,2,3,4\"\n", "behind --set, not the text `1,2,3,4`"),
        (
            "nan.toml",
            b"[sketch.pass1]\nmatrix = [[nan, 0], [0, 1]]\n",
            "line 2: `sketch.pass1.matrix` = NaN is out of range: -32 to 32",
        ),
        (
            "far.toml",
            b"[sketch.pass8]\nmatrix = [[1e9, 0], [0, 1]]\n",
            "line 2: `sketch.pass8.matrix` = 1000000000 is out of range: -32 to 32",
        ),
        (
            "pass.toml",
            b"[sketch.pass9]\nmatrix = [[1, 0], [0, 1]]\n",
            "line 2: unknown parameter `sketch.pass9.matrix`; did you mean `sketch.pass",
        ),
        ("passes.toml", b"[sketch]\npasses = 9\n", "line 2: `sketch.passes` = 9 is out of range: 1 to 8"),
        ("syntax.toml", b"[toon\n", "syntax.toml, line 1: "),
        ("binary.toml", &[0xff; 300], "cannot read style binary.toml: "),
        ("nonsense.toml", &nonsense, "it has 10485760 bytes, a style file has at most"),
    ];
    for (name, content, message) in rows {
        place.write(name, content);
        let output = place.hachure(&["model.obj", "--style", name]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{name}: {said}");
        assert!(said.contains(message), "{name}: {said}");
        assert!(!place.path("out.png").exists(), "{name} left a picture behind");
    }
    let missing = place.hachure(&["model.obj", "--style", "none.toml"]);
    assert!(String::from_utf8_lossy(&missing.stderr).contains("cannot read style none.toml"));
    let folder = place.hachure(&["model.obj", "--style", place.folder.path().to_str().unwrap()]);
    assert_eq!(folder.status.code(), Some(1));
}

#[test]
fn a_matrix_is_set_by_its_rows() {
    let place = Workplace::new();
    place.write("sketch.toml", b"[sketch]\nenabled = true\npass1.matrix = [[1, 0.2], [-0.2, 1]]\n");
    let set = ["model.obj", "--style", "sketch.toml", "--set", "sketch.pass1.matrix=1,0.2,-0.2,1"];
    let (by_hand, said) = place.drawn(&set);
    assert_eq!(said, "");
    assert!(by_hand == place.drawn(&["model.obj", "--style", "sketch.toml"]).0);
    let _ = std::fs::remove_file(place.path("out.png"));
    for (value, message) in [
        ("1,2,3", "a,b,c,d behind --set, not the text `1,2,3`"),
        ("[[1,2],[3,4]]", "a,b,c,d behind --set, not the text `[[1,2],[3,4]]`"),
        ("1,2,3,x", "not the text `1,2,3,x`"),
        ("1.5", "not the number 1.5"),
        ("inherit", "it inherits from nothing"),
        ("nan,0,0,1", "`sketch.pass1.matrix` = NaN is out of range: -32 to 32"),
        ("0,1e9,0,1", "= 1000000000 is out of range: -32 to 32"),
    ] {
        let setting = format!("sketch.pass1.matrix={value}");
        let output = place.hachure(&["model.obj", "--set", &setting]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{value}: {said}");
        assert!(said.contains(message), "{value}: {said}");
        assert!(!place.path("out.png").exists(), "{value} left a picture behind");
    }
}

/// The whole style list answers for what it prints.
#[test]
fn the_reference_lists_whole_numbers_and_images() {
    let output = Command::new(env!("CARGO_BIN_EXE_hachure")).arg("styles").output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("3, a whole number from 2 to 8\n"), "{text}");
    assert!(text.contains("none, the path of a PNG or JPEG image, or an empty text\n"), "{text}");
    assert!(text.contains("(technique=toon, toon.ramp=image)"), "{text}");
}
