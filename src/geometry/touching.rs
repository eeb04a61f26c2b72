//! Which boxes touch each other.

use std::cmp::Ordering;

use glam::DVec3;

use super::Bounds;

/// The pairs of boxes that overlap or are no farther apart than `margin`, by their indices. The order of the pairs, and that within
/// them, depends on the boxes alone and not on the order in which they are given, unless two are the same.
pub fn touching(boxes: &[Bounds], margin: f64) -> Vec<[usize; 2]> {
    let reach = DVec3::splat(margin);
    let by_corners = |&a: &usize, &b: &usize| {
        let corners = |i: usize| boxes[i].min.to_array().into_iter().chain(boxes[i].max.to_array());
        let orders = corners(a).zip(corners(b)).map(|(one, other)| one.total_cmp(&other));
        orders.fold(Ordering::Equal, Ordering::then)
    };
    let mut order: Vec<usize> = (0..boxes.len()).filter(|&i| !boxes[i].is_empty()).collect();
    order.sort_by(by_corners);
    let mut pairs = Vec::new();
    let mut before: Vec<usize> = Vec::new();
    for i in order {
        let own = &boxes[i];
        before.retain(|&other| boxes[other].max.x + margin >= own.min.x);
        for &other in &before {
            let Bounds { min, max } = boxes[other];
            if min.cmple(own.max + reach).all() && max.cmpge(own.min - reach).all() {
                pairs.push([other, i]);
            }
        }
        before.push(i);
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bounds::cube;

    #[test]
    fn numbers_that_are_none_touch_nothing() {
        let none = Bounds { min: DVec3::NAN, max: DVec3::NAN };
        let boxes: Vec<Bounds> =
            (0..64).map(|i| if i % 3 == 0 { none } else { cube([f64::from(i * 7 % 64); 3], 0.5) }).collect();
        assert!(touching(&boxes, 0.0).is_empty());
    }

    #[test]
    fn each_pair_is_found_once_in_an_order_of_its_own() {
        let boxes = [
            cube([4.0, 0.0, 0.0], 1.0),
            cube([0.0; 3], 2.0),
            Bounds::EMPTY,
            cube([1.0; 3], 2.0),
            cube([3.1, 1.0, 1.0], 1.0),
        ];
        assert_eq!(touching(&boxes, 0.0), [[1, 3], [4, 0]]);
        assert_eq!(touching(&boxes, 0.2), [[1, 3], [3, 4], [4, 0]]);
        let mut reversed = boxes;
        reversed.reverse();
        let of_reversed: Vec<[usize; 2]> =
            touching(&reversed, 0.2).into_iter().map(|pair| pair.map(|i| boxes.len() - 1 - i)).collect();
        assert_eq!(of_reversed, touching(&boxes, 0.2));
    }
}
