//! Step 1: pairs of border edges whose ends nearly coincide.

use glam::{DVec3, I64Vec3};
use rayon::prelude::*;

use super::border_points::{BorderPoint, Tie};
use super::borders::{Border, Borders, NO_BORDER};
use super::limits::{COS_FOLD, COS_SMOOTH, Limits};

/// Width of the cells in which middles are sorted, in widest gaps: few places are near a wall.
const CELL: f64 = 8.0;
/// Of more edges in one cell, not all are tried out.
const MAX_IN_A_CELL: usize = 64;

/// The border edge that each is paired with, or [`NO_BORDER`].
pub(super) fn pairs(borders: &Borders, limits: &Limits) -> Vec<u32> {
    let cells = Cells::new(borders, limits);
    let best: Vec<u32> =
        (0..borders.list.len()).into_par_iter().map(|b| cells.best_partner(borders, b as u32)).collect();
    let is_mutual = |(border, &partner): (usize, &u32)| {
        if best.get(partner as usize) == Some(&(border as u32)) { partner } else { NO_BORDER }
    };
    best.iter().enumerate().map(is_mutual).collect()
}

/// What joining two edges of which both ends nearly coincide takes.
pub(super) fn ties(a: &Border, b: &Border) -> [Tie; 2] {
    let ends = facing_ends(a, b);
    [0, 1].map(|k| Tie::new([BorderPoint::Point(a.ends[k]), BorderPoint::Point(ends[k])]))
}

/// The ends of `b` in the order in which `a` meets them.
fn facing_ends(a: &Border, b: &Border) -> [u32; 2] {
    if a.direction.dot(b.direction) < 0.0 { [b.ends[1], b.ends[0]] } else { b.ends }
}

/// Border edges by the cell of their middle.
struct Cells<'a> {
    limits: &'a Limits,
    width: f64,
    reach: f64,
    /// (hash of the cell, edge), sorted.
    entries: Vec<(u64, u32)>,
    /// Where the entries begin whose hashes begin with each number; about as many as entries.
    first: Vec<u32>,
    /// By how many bits a hash is shifted for its beginning.
    shift: u32,
}

impl<'a> Cells<'a> {
    fn new(borders: &Borders, limits: &'a Limits) -> Self {
        let reach = limits.greatest_open_gap();
        let width = CELL * reach;
        let entries = borders.list.par_iter().enumerate();
        let mut entries: Vec<(u64, u32)> =
            entries.map(|(number, b)| (hash(cell(b.at(0.5), width)), number as u32)).collect();
        entries.par_sort_unstable();
        let bits = entries.len().max(2).ilog2();
        let shift = u64::BITS - bits;
        let mut first = vec![0; (1 << bits) + 1];
        for &(key, _) in &entries {
            first[(key >> shift) as usize + 1] += 1;
        }
        for slot in 1..first.len() {
            first[slot] += first[slot - 1];
        }
        Self { limits, width, reach, entries, first, shift }
    }

    fn best_partner(&self, borders: &Borders, number: u32) -> u32 {
        let border = borders.get(number);
        let middle = border.at(0.5);
        let low = cell(middle - self.reach, self.width);
        let high = cell(middle + self.reach, self.width);
        // Where three sides meet, those that one surface goes on through belong together.
        let mut best = (true, self.reach, NO_BORDER);
        for x in low.x..=high.x {
            for y in low.y..=high.y {
                for z in low.z..=high.z {
                    for &(_, other) in self.at(I64Vec3::new(x, y, z)) {
                        let partner = borders.get(other);
                        let gap = widest_end(border, partner);
                        let turns = !border.is_unfolded(partner, COS_SMOOTH);
                        if other != number
                            && (turns, gap, other) < best
                            && gap <= self.limits.open_gap(border, partner)
                            && is_seam(border, partner)
                        {
                            best = (turns, gap, other);
                        }
                    }
                }
            }
        }
        best.2
    }

    fn at(&self, cell: I64Vec3) -> &[(u64, u32)] {
        let key = hash(cell);
        let slot = (key >> self.shift) as usize;
        let entries = &self.entries[self.first[slot] as usize..self.first[slot + 1] as usize];
        let entries = &entries[entries.iter().take_while(|&&(k, _)| k < key).count()..];
        let count = entries.iter().take(MAX_IN_A_CELL).take_while(|&&(k, _)| k == key).count();
        &entries[..count]
    }
}

fn cell(point: DVec3, width: f64) -> I64Vec3 {
    (point / width).floor().as_i64vec3()
}

fn hash(cell: I64Vec3) -> u64 {
    let [x, y, z] = cell.to_array().map(|c| c as u64);
    let mixed = x.wrapping_mul(0x9e37_79b9_7f4a_7c15)
        ^ y.wrapping_mul(0xd6e8_feb8_6659_fd93).rotate_left(21)
        ^ z.wrapping_mul(0xbf58_476d_1ce4_e5b9).rotate_left(42);
    (mixed ^ mixed >> 31).wrapping_mul(0x94d0_49bb_1331_11eb)
}

/// The larger distance between two ends that face each other.
fn widest_end(a: &Border, b: &Border) -> f64 {
    let [p, q] = if a.direction.dot(b.direction) < 0.0 { [1, 0] } else { [0, 1] };
    a.positions[0].distance(b.positions[p]).max(a.positions[1].distance(b.positions[q]))
}

fn is_seam(a: &Border, b: &Border) -> bool {
    a.face != b.face && a.is_unfolded(b, COS_FOLD) && a.is_outside(b, b.at(0.5) - a.at(0.5), 0.5)
}
