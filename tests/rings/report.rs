//! What came out, in words and pictures.

use std::fmt::Write as _;
use std::path::Path;

use glam::{DVec4, dvec4};
use image::{GenericImage as _, RgbaImage};

use super::SIDE;
use super::picture::{Picture, shown};
use super::truth::{Expected, Tally, tallies};

/// Which share of the pixels may be wrong; a single one may be anyway.
const SHARE: f64 = 1e-4;

/// Collects all cases, so that one that fails does not hide the others.
#[derive(Default)]
pub struct Report {
    lines: String,
    failed: usize,
    cases: usize,
}

impl Tally {
    fn is_passed(self) -> bool {
        self.wrong as f64 <= (SHARE * self.compared as f64).max(1.0)
    }

    fn percent(self) -> f64 {
        100.0 * self.wrong as f64 / self.compared.max(1) as f64
    }
}

impl Report {
    /// Compares a picture with what it must be. With `HACHURE_RINGS_DIR=folder`, writes it there beside that and where
    /// they differ: red and, beneath what is seen through, blue; white where they agree.
    pub fn add(&mut self, scene: &str, camera: &str, expected: &[Expected], picture: &Picture) {
        let [all, above] = tallies(expected, picture);
        let is_passed = all.is_passed() && above.is_passed() && all.compared > 0;
        self.cases += 1;
        if !is_passed {
            self.failed += 1;
            let _ = writeln!(
                self.lines,
                "{scene}, {camera}: {:.3} % of {} pixels are wrong, and {:.3} % of {} beneath something",
                all.percent(),
                all.compared,
                above.percent(),
                above.compared
            );
        }
        if let Some(folder) = std::env::var_os("HACHURE_RINGS_DIR") {
            write(Path::new(&folder), &format!("{scene}, {camera}.png"), expected, picture);
        }
    }

    /// Fails where any case has.
    pub fn finish(self) {
        let Self { lines, failed, cases } = self;
        assert!(cases > 0, "nothing was compared");
        assert!(failed == 0, "{failed} of {cases} pictures are wrong:\n{lines}");
        println!("{cases} pictures are right");
    }
}

fn write(folder: &Path, name: &str, expected: &[Expected], picture: &Picture) {
    let known = expected.iter().map(|expected| match expected {
        Expected::Unknown | Expected::Nothing => DVec4::ZERO,
        Expected::Exactly(color) | Expected::Above(color) => *color,
    });
    let difference =
        expected.iter().enumerate().map(|(px, expected)| match (expected.is_met(picture, px), expected) {
            (Some(false), Expected::Above(_)) => dvec4(0.0, 0.0, 1.0, 1.0),
            (Some(false), _) => dvec4(1.0, 0.0, 0.0, 1.0),
            (Some(true), _) => DVec4::ONE,
            (None, _) => DVec4::ZERO,
        });
    let mut strip = RgbaImage::new(3 * SIDE, SIDE);
    let parts = [shown(picture.colors.iter().copied()), shown(known), shown(difference)];
    for (i, part) in parts.iter().enumerate() {
        strip.copy_from(part, i as u32 * SIDE, 0).unwrap();
    }
    std::fs::create_dir_all(folder).unwrap();
    strip.save(folder.join(name)).unwrap();
}
