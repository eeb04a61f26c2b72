//! The ring test: rings of which each goes through others, so that no order of whole objects is right, each of another
//! look. Which surface is in front is known from cast rays, and its color from a picture of its ring alone; composed by
//! plain arithmetic, they are what the picture must be. `HACHURE_RINGS_DIR=folder` writes all pictures.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "how much was compared is said")]
#![allow(unreachable_pub, reason = "modules of a test program")]

mod alone;
#[path = "../common/mod.rs"]
mod common;
mod looks;
mod picture;
mod places;
mod rays;
mod report;
mod stage;
mod truth;
mod wide;

use alone::Shot;
use common::session;
use hachure::export::Session;
use hachure::scene::NodeId;
use looks::{Look, layered, surface_techniques, surfaces};
use rays::Hit;
use report::Report;
use stage::{CAMERAS, Stage};
use truth::truth;

/// Of all pictures, px.
const SIDE: u32 = 216;

/// Draws rings in company from all sides and compares.
fn check(session: &mut Session, report: &mut Report, stage: &Stage, companies: &[(String, Vec<NodeId>)]) {
    stage.enter(session);
    for (number, camera) in CAMERAS.iter().enumerate() {
        let mut shot = Shot::new(stage, number);
        for (name, company) in companies {
            let expected = truth(session, &mut shot, company);
            let picture = stage.picture(session, shot.camera, company, |look| look);
            report.add(name, camera, &expected, &picture);
        }
    }
}

/// Two rings, each through the other, of any of the first looks and any of the second ones.
fn check_pairs(first: &[Look], second: &[Look]) {
    let rings = first.iter().map(|look| (look.clone(), 0)).chain(second.iter().map(|look| (look.clone(), 1)));
    let stage = Stage::new(places::pair(), rings.collect());
    let pairs = (0..first.len()).flat_map(|a| (0..second.len()).map(move |b| (a, b)));
    let companies: Vec<_> = pairs
        .map(|(a, b)| (format!("{} through {}", first[a].name, second[b].name), vec![a, first.len() + b]))
        .collect();
    let mut report = Report::default();
    check(&mut session(), &mut report, &stage, &companies);
    report.finish();
}

/// Rings of these looks, one at each place.
fn one_each(links: places::Links, looks: &[Look]) -> Stage {
    let rings = looks.iter().cloned().enumerate().map(|(place, look)| (look, place)).collect();
    Stage::new(links, rings)
}

/// Checks all rings of a stage in one company.
fn check_all(session: &mut Session, report: &mut Report, name: &str, stage: &Stage) {
    let company: Vec<NodeId> = (0..stage.rings.len()).collect();
    check(session, report, stage, &[(name.to_owned(), company)]);
}

#[test]
fn linked_rings_lie_before_and_behind_each_other() {
    let knot = |count| (0..count).flat_map(move |a| (0..a).map(move |b| (a, b))).collect::<Vec<_>>();
    let chain = |count| (0..count).map(|a| (a, (a + 1) % count)).collect::<Vec<_>>();
    for (links, linked) in [
        (places::pair(), knot(2)),
        (places::knot(3), knot(3)),
        (places::knot(4), knot(4)),
        (places::chain(9), chain(9)),
    ] {
        let count = links.places.len();
        let stage = Stage::new(links, (0..count).map(|place| (Look::surface("unlit"), place)).collect());
        for (number, camera) in CAMERAS.iter().enumerate() {
            let shot = Shot::new(&stage, number);
            for &(a, b) in &linked {
                let is_before = |(a, b): &(&Vec<Hit>, &Vec<Hit>)| {
                    a.first().zip(b.last()).is_some_and(|(a, b)| a.depth < b.depth)
                };
                let (a_hits, b_hits) = (&shot.cast(a).hits, &shot.cast(b).hits);
                let before = a_hits.iter().zip(b_hits).filter(is_before).count();
                let behind = b_hits.iter().zip(a_hits).filter(is_before).count();
                let least = before.min(behind);
                assert!(least >= 10, "{count} rings, {camera}: {a} and {b} in {least} pixels");
            }
        }
    }
}

#[test]
fn surfaces_go_through_surfaces() {
    check_pairs(&surfaces(), &surfaces());
}

#[test]
fn what_is_seen_through_goes_through_surfaces() {
    check_pairs(&surfaces(), &layered());
}

#[test]
fn what_is_seen_through_goes_through_what_is_seen_through() {
    check_pairs(&layered(), &layered());
}

#[test]
fn a_chain_of_all_looks_is_right() {
    let looks: Vec<_> = surfaces().into_iter().chain(layered()).collect();
    let mut report = Report::default();
    check_all(&mut session(), &mut report, "chain", &one_each(places::chain(looks.len()), &looks));
    report.finish();
}

#[test]
fn two_blueprints_glass_and_a_surface_that_all_go_through_each_other_are_right() {
    let looks = [Look::blueprint_a(), Look::glass("unlit"), Look::blueprint_b(), Look::surface("gooch")];
    let (mut session, mut report) = (session(), Report::default());
    let mut stage = one_each(places::knot(4), &looks);
    for layers in ["lists", "peeling"] {
        stage.set("view.layer_method", layers);
        check_all(&mut session, &mut report, &format!("knot by {layers}"), &stage);
    }
    report.finish();
}

#[test]
fn blueprints_of_one_style_are_one_group_that_others_go_through() {
    let (mut session, mut report) = (session(), Report::default());
    for (name, through) in [
        ("twins and a surface", Look::surface("toon")),
        ("twins and glass", Look::glass("unlit")),
        ("twins and a blueprint", Look::blueprint_b()),
    ] {
        let looks = [Look::blueprint_a(), through, Look::blueprint_a()];
        check_all(&mut session, &mut report, name, &one_each(places::knot(3), &looks));
    }
    report.finish();
}

#[test]
fn glass_of_each_technique_goes_through_others() {
    let glass: Vec<_> = surface_techniques().map(Look::glass).collect();
    check_pairs(&glass, &[Look::surface("gooch"), Look::glass("unlit"), Look::blueprint_a()]);
}

#[test]
fn wide_lines_cover_what_is_farther_and_nothing_that_is_nearer() {
    let inked: Vec<_> =
        ["gooch", "unlit"].map(|name| Look::surface(name).with_width(2.0 * wide::RADIUS as f32)).into();
    let others: Vec<_> = surfaces().into_iter().chain(layered()).collect();
    let rings = inked.iter().map(|look| (look, 0)).chain(others.iter().map(|look| (look, 1)));
    let stage = Stage::new(places::pair(), rings.map(|(look, place)| (look.clone(), place)).collect());
    let mut report = Report::default();
    let mut session = session();
    stage.enter(&mut session);
    for (number, camera) in CAMERAS.iter().enumerate() {
        let mut shot = Shot::new(&stage, number);
        for (wide, look) in inked.iter().enumerate() {
            let alone = stage.picture(&mut session, shot.camera, &[wide], |look| look).colors;
            for (i, other) in others.iter().enumerate() {
                let other_node = inked.len() + i;
                let expected = wide::truth(&mut session, &mut shot, wide, &[other_node], &alone);
                let picture = stage.picture(&mut session, shot.camera, &[wide, other_node], |look| look);
                let name = format!("wide {} and {}", look.name, other.name);
                report.add(&name, camera, &expected, &picture);
            }
        }
    }
    report.finish();
}
