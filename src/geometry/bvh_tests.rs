use super::*;
use crate::geometry::primitives;

/// Numbers between −1 and 1 that look random (a linear congruential generator).
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn point(noise: &mut impl FnMut() -> f64) -> DVec3 {
    DVec3::new(noise(), noise(), noise())
}

#[test]
fn rays_meet_what_they_meet_without_the_tree() {
    let mut noise = noise(1);
    let triangles: Vec<[DVec3; 3]> = (0..20_000)
        .map(|_| {
            let center = point(&mut noise);
            [(); 3].map(|()| center + point(&mut noise) * 0.08)
        })
        .collect();
    let tree = Bvh::new(&triangles);
    let (mut hits, mut misses) = (0, 0);
    for i in 0..200 {
        let (origin, mut direction) = (point(&mut noise) * 2.0, point(&mut noise));
        if i % 10 == 0 {
            direction.x = 0.0;
        }
        let (t_min, t_max) = (0.05, 3.0);
        let skip = |hit: &Hit| hit.triangle.is_multiple_of(3);
        let expected = triangles
            .iter()
            .enumerate()
            .filter_map(|(triangle, corners)| {
                let hit = Hit::of(origin, direction, triangle, corners)?;
                let [a, b, c] = *corners;
                let there = a + (b - a) * hit.weights[0] + (c - a) * hit.weights[1];
                assert!(there.distance(origin + direction * hit.t) < 1e-6);
                Some(hit)
            })
            .filter(|hit| hit.t > t_min && hit.t < t_max && !skip(hit))
            .min_by(|a, b| a.t.total_cmp(&b.t));
        assert_eq!(tree.closest_hit(origin, direction, t_min, t_max, skip), expected);
        let any = tree.any_hit(origin, direction, t_min, t_max, skip);
        assert_eq!(any.is_some(), expected.is_some());
        assert!(any.is_none_or(|hit| hit.t > t_min && hit.t < t_max && !skip(&hit)));
        *(if expected.is_some() { &mut hits } else { &mut misses }) += 1;
    }
    assert!(hits > 20 && misses > 20, "{hits} hits, {misses} misses prove little");
}

#[test]
fn boxes_overlap_what_they_overlap_without_the_tree() {
    let mut noise = noise(2);
    let triangles: Vec<[DVec3; 3]> = (0..3000)
        .map(|_| {
            let center = point(&mut noise);
            [(); 3].map(|()| center + point(&mut noise) * 0.1)
        })
        .collect();
    let tree = Bvh::new(&triangles);
    for _ in 0..50 {
        let center = point(&mut noise);
        let bounds = Bounds { min: center - 0.1, max: center + 0.1 };
        let mut found = Vec::new();
        tree.overlapping(&bounds, |t| found.push(t));
        found.sort_unstable();
        let expected: Vec<usize> = (0..triangles.len())
            .filter(|&t| {
                let [a, b, c] = triangles[t];
                a.min(b).min(c).cmple(bounds.max).all() && a.max(b).max(c).cmpge(bounds.min).all()
            })
            .collect();
        assert_eq!(found, expected);
    }
}

#[test]
fn no_ray_slips_through_a_closed_surface() {
    let mesh = primitives::cube(2.0);
    let triangles: Vec<[DVec3; 3]> =
        mesh.triangles().iter().map(|&t| mesh.corners(t).map(|p| p.as_dvec3())).collect();
    let tree = Bvh::new(&triangles);
    // Along the diagonals of the sides and through the corners, where triangles meet.
    for i in -10..=10 {
        for j in -10..=10 {
            let target = DVec3::new(f64::from(i) / 10.0, f64::from(j) / 10.0, 1.0);
            assert!(tree.any_hit(DVec3::ZERO, target, 0.0, 2.0, |_| false).is_some(), "{target}");
        }
    }
    let empty = Bvh::new(&[[DVec3::NAN; 3]]);
    assert_eq!(empty.any_hit(DVec3::ZERO, DVec3::X, 0.0, 1.0, |_| false), None);
}
