//! Unit vectors as points of an unfolded octahedron (Cigolle et al., "A Survey of Efficient Representations for Independent Unit
//! Vectors", 2014).

use glam::{Vec2, Vec3};

/// A unit vector as two 16-bit signed shares of 1.
pub fn to_octahedron(v: Vec3) -> [i16; 2] {
    let sum = v.abs().element_sum().max(f32::MIN_POSITIVE);
    let p = v.truncate() / sum;
    let p = if v.z >= 0.0 { p } else { folded(p) };
    (p.clamp(Vec2::NEG_ONE, Vec2::ONE) * f32::from(i16::MAX)).round().to_array().map(|c| c as i16)
}

/// The reverse.
pub fn from_octahedron(packed: [i16; 2]) -> Vec3 {
    let p = Vec2::from_array(packed.map(|c| f32::from(c) / f32::from(i16::MAX)));
    let z = 1.0 - p.x.abs() - p.y.abs();
    (if z < 0.0 { folded(p) } else { p }).extend(z).normalize_or(Vec3::Z)
}

fn folded(p: Vec2) -> Vec2 {
    (Vec2::ONE - Vec2::new(p.y, p.x).abs()) * Vec2::ONE.copysign(p)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_come_back_within_a_hundredth_of_a_degree() {
        for i in 0..1000 {
            let t = i as f32 * 0.61803;
            let v = Vec3::new((t * 3.1).sin(), (t * 5.3).cos(), (t * 7.7).sin()).normalize_or(Vec3::Z);
            let back = from_octahedron(to_octahedron(v));
            assert!((back - v).length() < 1.5e-4, "{v} {back}");
        }
    }
}
