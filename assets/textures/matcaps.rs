//! The built-in matcaps: pictures of a shaded sphere, indexed by the normal as the viewer sees it
//! ("The Lit Sphere", Sloan et al. 2001).

use std::{error::Error, path::Path};

use glam::{Vec2, Vec3, vec2, vec3};
use image::{Rgb, RgbImage};

/// Width and height of a picture in pixels.
const SIZE: u32 = 512;

/// Samples along each side of a pixel; the bands on metal are finer than a pixel near the rim.
const SAMPLES: u32 = 4;

/// The color in linear light for a normal of length 1, with x to the right, y up and z to the viewer.
type Look = fn(Vec3) -> Vec3;

const LOOKS: [(&str, Look); 4] = [("clay", clay), ("porcelain", porcelain), ("metal", metal), ("jade", jade)];

/// Where the key light stands: upper left and before the sphere, as in drawing lessons.
const KEY: Vec3 = vec3(-0.53, 0.62, 0.58);

/// Writes `clay.png`, `porcelain.png`, `metal.png` and `jade.png` into `folder`.
pub(crate) fn write(folder: &Path) -> Result<(), Box<dyn Error>> {
    for (name, look) in LOOKS {
        RgbImage::from_fn(SIZE, SIZE, |x, y| pixel(look, x, y)).save(folder.join(format!("{name}.png")))?;
    }
    Ok(())
}

/// The mean of the samples in a pixel, taken in linear light so that bright edges keep their width.
fn pixel(look: Look, x: u32, y: u32) -> Rgb<u8> {
    let place = |i: u32, sub: u32| (i as f32 + (sub as f32 + 0.5) / SAMPLES as f32) / SIZE as f32 * 2.0 - 1.0;
    let samples = (0..SAMPLES).flat_map(|v| (0..SAMPLES).map(move |u| (u, v)));
    let sum: Vec3 = samples
        .map(|(u, v)| look(normal(vec2(place(x, u), -place(y, v)))).clamp(Vec3::ZERO, Vec3::ONE))
        .sum();
    let mean = sum / (SAMPLES * SAMPLES) as f32;
    Rgb(mean.to_array().map(|light| (srgb(light) * 255.0).round() as u8))
}

/// The normal of the unit sphere seen at `at`. Outside of the disc it is that of the rim, so that
/// filtering at a silhouette never mixes in a foreign color.
fn normal(at: Vec2) -> Vec3 {
    let at = at.clamp_length_max(1.0);
    at.extend((1.0 - at.length_squared()).max(0.0).sqrt())
}

/// Sculpting clay: dull, so that nothing but the form decides the tone.
fn clay(n: Vec3) -> Vec3 {
    let toward = n.dot(KEY.normalize());
    let key = vec3(0.95, 0.90, 0.83) * wrapped(toward, 0.25).powf(1.25);
    let sky = vec3(0.13, 0.14, 0.16) * wrapped(n.y, 1.0);
    let bounce = vec3(0.30, 0.19, 0.12) * wrapped(n.dot(vec3(0.45, -0.85, 0.25).normalize()), 0.3).powi(2);
    // The core shadow is darkest just beyond the terminator, where neither key nor bounce arrives.
    let core = 1.0 - 0.35 * bump(toward, -0.15, 0.28);
    // Fingers leave a faint sheen, too wide to be read as a highlight.
    let sheen = 0.045 * half(n, KEY).powi(10);
    vec3(0.475, 0.375, 0.31) * (key + (sky + bounce + 0.07) * core) + sheen
}

/// Glazed porcelain in a photographer's studio: a white body below a clear coat.
fn porcelain(n: Vec3) -> Vec3 {
    let key = wrapped(n.dot(KEY.normalize()), 0.45).powf(1.15);
    let body = vec3(0.17, 0.19, 0.23).lerp(vec3(0.79, 0.78, 0.755), key);
    let fill = vec3(0.07, 0.08, 0.10) * wrapped(n.dot(vec3(0.7, -0.6, 0.3).normalize()), 0.2);
    let reflected = mirror(n);
    let lamp = softbox(reflected, KEY, vec2(0.36, 0.46), 0.22);
    let strip = softbox(reflected, vec3(0.95, 0.05, 0.1), vec2(0.14, 0.8), 0.25);
    body + fill + 0.5 * lamp + 0.08 * strip + vec3(0.20, 0.22, 0.25) * fresnel(n)
}

/// Polished steel outdoors, seen from a little above, so that the horizon bends around the sphere.
fn metal(n: Vec3) -> Vec3 {
    let reflected = mirror(n);
    let height = reflected.dot(vec3(0.06, 0.97, 0.21).normalize());
    let sky = vec3(0.88, 0.90, 0.92).lerp(vec3(0.15, 0.20, 0.275), smooth(0.0, 0.95, height).powf(0.8));
    let ground = vec3(0.05, 0.047, 0.045).lerp(vec3(0.44, 0.42, 0.395), smooth(-0.06, -0.62, height));
    // The sphere stands in its own shadow straight below.
    let ground = ground * (1.0 - 0.72 * smooth(-0.72, -1.0, height));
    let scene = ground.lerp(sky, smooth(-0.02, 0.05, height));
    // Trees and houses far away stand before the brightest part of the sky.
    let scene = scene * (1.0 - 0.75 * bump(height, 0.0, 0.07));
    let sun = half(n, KEY).powi(900) * 2.0 + half(n, KEY).powi(60) * 0.25;
    // Steel swallows some light, less where one looks along its surface.
    scene * vec3(0.92, 0.93, 0.94).lerp(Vec3::ONE, fresnel(n)) + sun
}

/// Jade: light enters at the key's side and gathers inside on the far one.
fn jade(n: Vec3) -> Vec3 {
    let toward = n.dot(KEY.normalize());
    let surface = vec3(0.09, 0.31, 0.155) * wrapped(toward, 0.2).powf(1.7);
    let inside = wrapped(n.dot(vec3(0.60, -0.72, 0.22).normalize()), 0.05);
    let glow = vec3(0.20, 0.46, 0.15) * inside.powf(2.6);
    let deep = vec3(0.010, 0.056, 0.032);
    let lamp = softbox(mirror(n), KEY, vec2(0.15, 0.19), 0.1);
    let coat = vec3(0.11, 0.17, 0.145) * fresnel(n) * wrapped(n.y, 1.0);
    deep + surface + glow + 0.75 * lamp + 0.09 * half(n, KEY).powi(30) + coat
}

/// Diffuse light that reaches `wrap` beyond the terminator, as from a large lamp; 1 where it is full.
fn wrapped(cosine: f32, wrap: f32) -> f32 {
    ((cosine + wrap) / (1.0 + wrap)).max(0.0)
}

/// The cosine between the normal and the direction halfway between viewer and light.
fn half(n: Vec3, light: Vec3) -> f32 {
    n.dot((light.normalize() + Vec3::Z).normalize()).max(0.0)
}

/// Where the viewer's ray goes from a mirror with normal `n`.
fn mirror(n: Vec3) -> Vec3 {
    2.0 * n.z * n - Vec3::Z
}

/// How much more a glossy surface mirrors at grazing angles (Schlick's approximation).
fn fresnel(n: Vec3) -> f32 {
    (1.0 - n.z).max(0.0).powi(4)
}

/// A rectangular lamp with round corners at `lamp`, from 0 beside it to 1 inside; `soft` is its edge's width.
fn softbox(ray: Vec3, lamp: Vec3, size: Vec2, soft: f32) -> f32 {
    let lamp = lamp.normalize();
    let right = Vec3::Y.cross(lamp).normalize();
    let ahead = ray.dot(lamp);
    let on_plane = vec2(ray.dot(right), ray.dot(lamp.cross(right))) / ahead.max(0.01);
    let outside = (on_plane.abs() - size + soft).max(Vec2::ZERO).length() - soft;
    // A ray that leaves the lamp behind it would meet the plane a second time.
    smooth(soft, -soft, outside) * smooth(0.0, 0.1, ahead)
}

/// A smooth hill of height 1 at `center`.
fn bump(x: f32, center: f32, width: f32) -> f32 {
    (-((x - center) / width).powi(2)).exp()
}

/// A smooth step from 0 at `from` to 1 at `to`, which may be the smaller one.
fn smooth(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Linear light as an sRGB value.
fn srgb(light: f32) -> f32 {
    if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}
