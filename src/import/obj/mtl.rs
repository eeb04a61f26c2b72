//! MTL: the materials of an OBJ file.

use glam::{Mat3, Vec3, Vec4};

use super::scrub::material_name;
use crate::import::text::{TextLines, after_first_word, float, linear, lossy, words};
use crate::scene::{UvTransform, Wrap};

/// One material as far as a drawing needs it.
#[derive(Debug, Clone)]
pub(super) struct Mtl {
    pub(super) name: String,
    /// Diffuse color (`Kd`), taken to be sRGB, here linear.
    pub(super) diffuse: Vec3,
    /// Opacity (`d`, or 1 − `Tr`).
    pub(super) opacity: f32,
    /// Image of the diffuse color (`map_Kd`).
    pub(super) diffuse_map: Option<Map>,
    /// Image of the opacity (`map_d`).
    pub(super) opacity_map: Option<Map>,
    /// Tangent-space normal map (`norm`).
    pub(super) normal_map: Option<Map>,
}

impl Mtl {
    fn new(material: &tobj::Material) -> Self {
        let map = |text: Option<&String>| text.and_then(|text| map(text.as_bytes()));
        Self {
            name: material.name.clone(),
            diffuse: material.diffuse.map_or(Vec3::splat(0.8), |color| Vec3::from(color).map(linear)),
            opacity: material.dissolve.unwrap_or(1.0),
            diffuse_map: map(material.diffuse_texture.as_ref()),
            opacity_map: map(material.dissolve_texture.as_ref()),
            normal_map: map(material.unknown_param.get("norm")),
        }
    }

    /// The color to multiply the image with. Most writers leave a gray `Kd` beside an image without meaning it, so
    /// that only a colored one counts there.
    pub(super) fn base_color(&self, has_image: bool) -> Vec4 {
        let c = self.diffuse;
        let gray = c.x == c.y && c.y == c.z;
        if has_image && gray { Vec4::ONE } else { c.extend(1.0) }
    }
}

/// A reference to an image with its options.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Map {
    /// Name of the file, relative to the model's folder.
    pub(super) file: String,
    /// Scale and offset (`-s`, `-o`) for texture coordinates whose origin is the upper left.
    pub(super) transform: UvTransform,
    /// `-clamp on`.
    pub(super) wrap: Wrap,
    /// `-bm`, the strength of a normal map.
    pub(super) strength: f32,
}

/// Reads all materials with `tobj`; what is unknown or wrong is skipped.
pub(super) fn read(data: &[u8]) -> Vec<Mtl> {
    // Reading from memory, the scrubbed text has nothing that `tobj` refuses.
    let (materials, _) = tobj::load_mtl_buf(&mut scrub(data).as_bytes()).unwrap_or_default();
    materials.iter().map(Mtl::new).collect()
}

/// The lines that matter, as `tobj` wants them: it refuses a whole file for one bad number, and fewer than three make
/// it panic.
fn scrub(data: &[u8]) -> String {
    let mut text = String::new();
    for (_, line) in TextLines::new(data) {
        let line = String::from_utf8_lossy(&line);
        let mut words = line.split_whitespace();
        let Some(keyword) = words.next() else { continue };
        let rest = line.trim_start().get(keyword.len()..).unwrap_or_default().trim();
        let numbers: Vec<f32> = words.map_while(|word| word.parse().ok()).take(3).collect();
        text += &match (keyword.to_ascii_lowercase().as_str(), numbers.as_slice()) {
            ("newmtl", _) => format!("newmtl {}\n", material_name(rest)),
            ("kd", &[r, g, b]) => format!("Kd {r} {g} {b}\n"),
            ("kd", &[gray, ..]) => format!("Kd {gray} {gray} {gray}\n"),
            ("d", &[opacity, ..]) => format!("d {opacity}\n"),
            ("tr", &[transparency, ..]) => format!("d {}\n", 1.0 - transparency),
            ("map_kd", _) if !rest.is_empty() => format!("map_Kd {rest}\n"),
            ("map_d", _) if !rest.is_empty() => format!("map_d {rest}\n"),
            ("norm", _) => format!("norm {rest}\n"),
            _ => continue,
        };
    }
    text
}

/// `-option value … file name`.
fn map(mut rest: &[u8]) -> Option<Map> {
    let mut scale = [1.0; 3];
    let mut offset = [0.0; 3];
    let mut wrap = Wrap::Repeat;
    let mut strength = 1.0;
    while let Some(option) = words(rest).next().filter(|w| w.starts_with(b"-")) {
        rest = after_first_word(rest);
        let mut take = |value: &mut f32| {
            let number = words(rest).next().and_then(float);
            if let Some(number) = number {
                *value = number;
                rest = after_first_word(rest);
            }
            number.is_some()
        };
        let mut ignored = [0.0; 3];
        match option {
            b"-s" => _ = scale.iter_mut().all(&mut take),
            b"-o" => _ = offset.iter_mut().all(&mut take),
            b"-t" => _ = ignored.iter_mut().all(&mut take),
            b"-mm" => _ = ignored.iter_mut().take(2).all(&mut take),
            b"-bm" => _ = take(&mut strength),
            b"-boost" | b"-texres" => _ = ignored.iter_mut().take(1).all(&mut take),
            b"-clamp" => {
                if words(rest).next() == Some(b"on") {
                    wrap = Wrap::Clamp;
                }
                rest = after_first_word(rest);
            }
            b"-blendu" | b"-blendv" | b"-cc" | b"-imfchan" | b"-type" => {
                rest = after_first_word(rest);
            }
            // No option after all, but a file whose name begins with a dash has lost its first word.
            _ => break,
        }
    }
    let [su, sv, _] = scale;
    let [ou, ov, _] = offset;
    let file = lossy(rest);
    (!file.is_empty()).then(|| Map {
        file,
        // In the file v points up: v' = sv v + ov becomes 1 − v' = sv (1 − v) + 1 − sv − ov.
        transform: UvTransform(Mat3::from_cols(
            Vec3::new(su, 0.0, 0.0),
            Vec3::new(0.0, sv, 0.0),
            Vec3::new(ou, 1.0 - sv - ov, 1.0),
        )),
        wrap,
        strength,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn materials_with_their_colors_and_images() {
        let text = b"Kd 9 9 9\nnewmtl my red\n Kd 1 0 0\nTr 0.25\nmap_Kd -s 2 3 -o 0.5 -clamp on -bm 2 my image.png\n\
            newmtl plain\nKd 0.5\nd 0.5\nmap_Kd\n";
        let materials = read(text);
        let [red, plain] = materials.as_slice() else { panic!("{materials:?}") };
        assert_eq!((&red.name[..], red.diffuse, red.opacity), ("my red", Vec3::X, 0.75));
        let map = red.diffuse_map.clone().unwrap();
        assert_eq!((&map.file[..], map.wrap, map.strength), ("my image.png", Wrap::Clamp, 2.0));
        // The lower left corner (0, 1) of our coordinates is (0, 0) in the file, and (0.5, 0) after its transform.
        assert_eq!(map.transform.0 * Vec3::new(0.0, 1.0, 1.0), Vec3::new(0.5, 1.0, 1.0));
        assert_eq!(red.base_color(true), Vec4::new(1.0, 0.0, 0.0, 1.0));
        assert_eq!(plain.base_color(true), Vec4::ONE);
        assert!(plain.diffuse_map.is_none() && plain.opacity == 0.5);
    }
}
