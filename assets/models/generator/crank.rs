//! The crank mechanism of a three-cylinder engine: crankshaft, connecting rods, pistons, flywheel, pulley.
//!
//! Millimeters; the crankshaft lies along X, the flywheel at −X, the cylinders stand along Y.

use glam::DQuat;

use crate::flywheel;
use crate::glb::{Material, Node, Scene};
use crate::solid::Solid;
use crate::{crankshaft, piston, rod};

/// From the crankshaft's axis to a crank pin's.
pub(crate) const THROW: f64 = 40.0;
/// From a crank pin's axis to a wrist pin's.
pub(crate) const ROD: f64 = 144.0;
/// Between neighboring cylinders.
pub(crate) const PITCH: f64 = 88.0;
/// How far the whole model is moved to have the origin in its middle.
const SHIFT: [f64; 2] = [4.0, -52.0];
/// How far the crankshaft has turned; degrees past the first piston's top.
const TURNED: f64 = 38.0;
/// Edges that turn by more stay hard, in degrees.
const CREASE: f64 = 35.0;

/// Finishes, in the order of [`materials`].
#[derive(Clone, Copy)]
enum Finish {
    Forged,
    Ground,
    Aluminium,
    Steel,
    Brass,
    Red,
    Black,
    Iron,
    Blue,
}

/// The colors of the finishes.
fn materials() -> Vec<Material> {
    let finish =
        |name, srgb, metallic, roughness| Material { name, srgb, metallic, roughness, ..Material::default() };
    vec![
        finish("forged steel", 0xa3_abb3, 0.0, 0.6),
        finish("ground steel", 0xd6_dbdf, 0.0, 0.3),
        finish("aluminium", 0xe6_e5df, 0.0, 0.5),
        finish("steel", 0xb4_c0cc, 0.0, 0.45),
        finish("brass", 0xd9_a441, 0.0, 0.4),
        finish("red paint", 0xc9_4431, 0.0, 0.6),
        finish("black oxide", 0x4f_555c, 0.0, 0.6),
        finish("cast iron", 0x87_8e94, 0.0, 0.8),
        finish("blue paint", 0x4d_86b8, 0.0, 0.6),
    ]
}

/// The file's contents.
pub(crate) fn scene() -> Scene {
    let mut shop = Shop { scene: Scene { materials: materials(), ..Scene::default() } };
    let mut roots = vec![crankshaft(&mut shop)];
    roots.extend(rods(&mut shop));
    roots.extend(pistons(&mut shop));
    roots.extend(bearings(&mut shop));
    roots.push(flywheel_end(&mut shop));
    roots.extend(front_end(&mut shop));
    for root in &mut roots {
        root.translation[0] += SHIFT[0] * 1e-3;
        root.translation[1] += SHIFT[1] * 1e-3;
    }
    shop.scene.roots = roots;
    shop.scene
}

/// Turns solids into meshes of the scene.
struct Shop {
    scene: Scene,
}

impl Shop {
    /// Adds a part's geometry once; nodes may show it often.
    fn make(&mut self, name: &str, finish: Finish, solid: Solid) -> Option<usize> {
        let mesh = solid.into_mesh(name, finish as usize, CREASE);
        Some(self.scene.add(mesh))
    }
}

/// The angle of a throw from straight up, turning from +Y to +Z, in radians.
fn throw_angle(cylinder: usize) -> f64 {
    (TURNED + 240.0 * cylinder as f64).to_radians()
}

/// Where a cylinder's axis crosses the crankshaft's.
fn cylinder_x(cylinder: usize) -> f64 {
    PITCH * (1.0 - cylinder as f64)
}

/// The height of a wrist pin and the tilt of its rod about X.
fn slider(cylinder: usize) -> (f64, f64) {
    let angle = throw_angle(cylinder);
    let side = THROW * angle.sin();
    let height = THROW * angle.cos() + (ROD * ROD - side * side).sqrt();
    (height, -(side / ROD).asin())
}

/// The crankshaft with its webs, journals and pins.
fn crankshaft(shop: &mut Shop) -> Node {
    let web = shop.make("web", Finish::Forged, crankshaft::web());
    let journal = shop.make("journal", Finish::Ground, crankshaft::journal());
    let pin = shop.make("crank_pin", Finish::Ground, crankshaft::pin());
    let nose = shop.make("nose", Finish::Ground, crankshaft::nose());
    let flange = shop.make("flange", Finish::Forged, crankshaft::flange());
    let mut children = Vec::new();
    for i in 0..4 {
        let x = PITCH * (1.5 - i as f64);
        children.push(Node::new(format!("journal.{}", i + 1), journal).at(x, 0.0, 0.0));
    }
    for i in 0..3 {
        let turn = DQuat::from_rotation_x(throw_angle(i));
        let at = turn * glam::dvec3(cylinder_x(i), THROW, 0.0);
        children.push(Node::new(format!("pin.{}", i + 1), pin).at(at.x, at.y, at.z).turned(turn));
        for (side, about_y) in [(1.0, std::f64::consts::PI), (-1.0, 0.0)] {
            let number = children.iter().filter(|c| c.name.starts_with("web")).count() + 1;
            children.push(
                Node::new(format!("web.{number}"), web)
                    .at(cylinder_x(i) + side * crankshaft::WEB_AT, 0.0, 0.0)
                    .turned(turn * DQuat::from_rotation_y(about_y)),
            );
        }
    }
    children.push(Node::new("nose", nose));
    children.push(Node::new("flange", flange));
    Node::new("crankshaft", None).with(children)
}

/// The connecting rods on their pins.
fn rods(shop: &mut Shop) -> Vec<Node> {
    let shank = shop.make("rod_shank", Finish::Steel, rod::shank());
    let cap = shop.make("rod_cap", Finish::Red, rod::cap());
    let bolt = shop.make("rod_bolt", Finish::Black, rod::bolt());
    let bushing = shop.make("bushing", Finish::Brass, rod::bushing());
    let shell = shop.make("rod_shell", Finish::Brass, rod::shell());
    let half_turn = DQuat::from_rotation_x(std::f64::consts::PI);
    (0..3)
        .map(|i| {
            let turn = DQuat::from_rotation_x(throw_angle(i));
            let at = turn * glam::dvec3(cylinder_x(i), THROW, 0.0);
            Node::new(format!("rod.{}", i + 1), None)
                .at(at.x, at.y, at.z)
                .turned(DQuat::from_rotation_x(slider(i).1))
                .with(vec![
                    Node::new("shank", shank),
                    Node::new("cap", cap),
                    Node::new("bolt.1", bolt).at(0.0, rod::BOLT_Y, rod::BOLT_Z),
                    Node::new("bolt.2", bolt).at(0.0, rod::BOLT_Y, -rod::BOLT_Z),
                    Node::new("bushing", bushing).at(0.0, ROD, 0.0),
                    Node::new("shell.1", shell),
                    Node::new("shell.2", shell).turned(half_turn),
                ])
        })
        .collect()
}

/// The pistons at the heights that their rods give them.
fn pistons(shop: &mut Shop) -> Vec<Node> {
    let body = shop.make("piston_body", Finish::Aluminium, piston::body());
    let ring = shop.make("compression_ring", Finish::Black, piston::ring(1.7));
    let oil = shop.make("oil_ring", Finish::Black, piston::ring(2.5));
    let pin = shop.make("wrist_pin", Finish::Ground, piston::pin());
    (0..3)
        .map(|i| {
            let mut children = vec![Node::new("body", body)];
            for (k, &y) in piston::RINGS.iter().enumerate() {
                let mesh = if k == 2 { oil } else { ring };
                let gap = DQuat::from_rotation_y(2.1 * k as f64 + 0.9);
                children.push(Node::new(format!("ring.{}", k + 1), mesh).at(0.0, y, 0.0).turned(gap));
            }
            children.push(Node::new("pin", pin));
            Node::new(format!("piston.{}", i + 1), None).at(cylinder_x(i), slider(i).0, 0.0).with(children)
        })
        .collect()
}

/// The lower shells of the main bearings.
fn bearings(shop: &mut Shop) -> Vec<Node> {
    let shell = shop.make("main_shell", Finish::Brass, crankshaft::main_shell());
    (0..4)
        .map(|i| Node::new(format!("bearing.{}", i + 1), shell).at(PITCH * (1.5 - i as f64), 0.0, 0.0))
        .collect()
}

/// The flywheel with its ring gear and bolts.
fn flywheel_end(shop: &mut Shop) -> Node {
    let disc = shop.make("flywheel_disc", Finish::Iron, flywheel::disc());
    let teeth = shop.make("ring_gear", Finish::Steel, flywheel::ring_gear());
    let bolt = shop.make("flywheel_bolt", Finish::Black, flywheel::bolt());
    let mut children = vec![Node::new("disc", disc), Node::new("ring_gear", teeth)];
    for i in 0..flywheel::BOLTS {
        let (sin, cos) = flywheel::bolt_angle(i).sin_cos();
        let r = flywheel::BOLT_CIRCLE;
        children.push(
            Node::new(format!("bolt.{}", i + 1), bolt)
                .at(flywheel::BOLT_X, r * sin, -r * cos)
                .turned(DQuat::from_rotation_y(std::f64::consts::PI)),
        );
    }
    Node::new("flywheel", None)
        .at(flywheel::AT, 0.0, 0.0)
        .turned(DQuat::from_rotation_x(throw_angle(0)))
        .with(children)
}

/// What sits on the nose of the crankshaft.
fn front_end(shop: &mut Shop) -> Vec<Node> {
    let gear = shop.make("timing_gear", Finish::Steel, flywheel::timing_gear());
    let pulley = shop.make("pulley_wheel", Finish::Blue, flywheel::pulley());
    let washer = shop.make("washer", Finish::Ground, flywheel::washer());
    let bolt = shop.make("nose_bolt", Finish::Black, flywheel::nose_bolt());
    let turn = DQuat::from_rotation_x(throw_angle(0));
    vec![
        Node::new("timing_gear", gear).at(flywheel::GEAR_AT, 0.0, 0.0).turned(turn),
        Node::new("pulley", None).at(flywheel::PULLEY_AT, 0.0, 0.0).turned(turn).with(vec![
            Node::new("wheel", pulley),
            Node::new("washer", washer),
            Node::new("bolt", bolt),
        ]),
    ]
}
