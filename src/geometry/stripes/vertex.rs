//! What stripes need to know of a vertex, in few bits.
//!
//! The phase of a level is nearly twice that of the level before, so only the difference is kept, rounded to 1/128 of a cycle. What
//! rounding leaves does not add up, as differences are taken to what the levels before come back as.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::levels::{FAMILIES, LEVELS, Phases};
use crate::geometry::octahedron::{from_octahedron, to_octahedron};

/// Bits of a difference of phases.
const BITS: u32 = 7;
/// Differences in the first of the two words of a family.
const IN_FIRST: usize = 4;
/// Bits of what each family has room for beside its differences.
const EXTRA_BITS: u32 = 64 - BITS * LEVELS as u32;
/// Of them, bits in the first word.
const EXTRA_IN_FIRST: u32 = 32 - BITS * IN_FIRST as u32;

/// The number that stands for 0 where numbers have a sign.
const MIDDLE: i32 = (1 << (EXTRA_BITS - 1)) - 1;

/// Words that a vertex is packed in.
pub const WORDS: usize = 2 * FAMILIES;

/// What stripes need to know of a vertex: 24 bytes. Read by `stripes_of` and `rows_at` in `shaders/effects/hatching/stripes.wgsl`.
///
/// Each family has two words. From the lowest bit on they hold the differences of the first four levels and of the other three,
/// and in the bits that are left a number: the two octahedral coordinates of the normal (−1 to 1) and the angle of the direction
/// about the normal (0 to 2π).
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
pub struct StripeVertex {
    families: [[u32; 2]; FAMILIES],
}

impl StripeVertex {
    /// A vertex with strokes of family 0 in this direction, on a surface with this normal: unit vectors.
    pub fn new(direction: Vec3, normal: Vec3, phases: &Phases) -> Self {
        let shares = to_octahedron(normal).map(|c| (i32::from(c) + 1).div_euclid(2).min(MIDDLE - 1) + MIDDLE);
        let shares = shares.map(i32::cast_unsigned);
        let (x, y) = decoded_normal(shares).any_orthonormal_pair();
        let turn = direction.dot(y).atan2(direction.dot(x)) / std::f32::consts::TAU;
        let steps = 1 << EXTRA_BITS;
        let angle = ((turn * steps as f32).round() as i32).rem_euclid(steps).cast_unsigned();
        let extra = [shares[0], shares[1], angle];
        Self { families: std::array::from_fn(|f| packed(&phases[f], extra[f])) }
    }

    /// Direction of the strokes of family 0: a unit vector across [`StripeVertex::normal`].
    pub fn direction(&self) -> Vec3 {
        let (x, y) = self.normal().any_orthonormal_pair();
        let angle = self.extra(2) as f32 / (1 << EXTRA_BITS) as f32 * std::f32::consts::TAU;
        x * angle.cos() + y * angle.sin()
    }

    /// Unit normal of the plane in which the families are turned against each other.
    pub fn normal(&self) -> Vec3 {
        decoded_normal([self.extra(0), self.extra(1)])
    }

    /// The phases.
    pub fn phases(&self) -> Phases {
        self.families.map(|words| {
            let mut phase = 0_u16;
            std::array::from_fn(|level| {
                phase = after(phase, difference(words, level));
                phase
            })
        })
    }

    /// All of it.
    pub fn words(&self) -> [u32; WORDS] {
        bytemuck::cast(self.families)
    }

    fn extra(&self, family: usize) -> u32 {
        let [first, second] = self.families[family];
        first >> (32 - EXTRA_IN_FIRST) | second >> (32 - EXTRA_BITS + EXTRA_IN_FIRST) << EXTRA_IN_FIRST
    }
}

impl From<[u32; WORDS]> for StripeVertex {
    fn from(words: [u32; WORDS]) -> Self {
        Self { families: bytemuck::cast(words) }
    }
}

fn decoded_normal(shares: [u32; 2]) -> Vec3 {
    from_octahedron(shares.map(|share| (2 * (share.cast_signed() - MIDDLE)) as i16))
}

/// The phase after another one, from how far it is from twice that.
fn after(phase: u16, difference: u32) -> u16 {
    phase.wrapping_mul(2).wrapping_add((difference << (16 - BITS)) as u16)
}

fn difference([first, second]: [u32; 2], level: usize) -> u32 {
    let word = if level < IN_FIRST { first } else { second };
    word >> (BITS * (level % IN_FIRST) as u32) & ((1 << BITS) - 1)
}

fn packed(phases: &[u16; LEVELS], extra: u32) -> [u32; 2] {
    let mut words = [0; 2];
    let mut before = 0_u16;
    for (level, phase) in phases.iter().enumerate() {
        let exact = phase.wrapping_sub(before.wrapping_mul(2));
        let rounded = u32::from(exact.wrapping_add(1 << (15 - BITS)) >> (16 - BITS));
        words[level / IN_FIRST] |= rounded << (BITS * (level % IN_FIRST) as u32);
        before = after(before, rounded);
    }
    let low = extra & ((1 << EXTRA_IN_FIRST) - 1);
    [
        words[0] | low << (32 - EXTRA_IN_FIRST),
        words[1] | extra >> EXTRA_IN_FIRST << (32 - EXTRA_BITS + EXTRA_IN_FIRST),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::primitives::sphere;

    #[test]
    fn packing_keeps_directions_and_normals() {
        assert_eq!(size_of::<StripeVertex>(), 24);
        let axes = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| [axis, -axis]);
        for normal in sphere(1.0, 24, 40).normals.iter().chain(axes.as_flattened()) {
            let (x, y) = normal.any_orthonormal_pair();
            for turn in 0..50_u8 {
                let (sin, cos) = (0.37 * f32::from(turn)).sin_cos();
                let direction = x * cos + y * sin;
                let vertex = StripeVertex::new(direction, *normal, &[[0; LEVELS]; FAMILIES]);
                assert!(vertex.normal().distance(*normal) < 3e-4, "{normal}");
                assert!(vertex.direction().distance(direction) < 6e-4, "{normal} {direction}");
                assert!(vertex.direction().dot(vertex.normal()).abs() < 1e-6);
                assert_eq!(StripeVertex::from(vertex.words()), vertex);
            }
        }
    }

    #[test]
    fn no_phase_is_off_by_more_than_a_step_whatever_those_before_it_are() {
        for seed in 0..500_u32 {
            let hash = |k: u32| ((seed * 977 + k).wrapping_mul(2_654_435_761) >> 13) as u16;
            let phases: Phases =
                std::array::from_fn(|f| std::array::from_fn(|level| hash((f * LEVELS + level) as u32)));
            let found = StripeVertex::new(Vec3::X, Vec3::Z, &phases).phases();
            for (exact, found) in phases.as_flattened().iter().zip(found.as_flattened()) {
                let off = found.wrapping_sub(*exact).cast_signed();
                assert!(off.unsigned_abs() <= 1 << (15 - BITS), "{exact} {found}");
            }
        }
    }
}
