//! Makes the sample models: `cargo run --release --example models` writes `assets/models/*.glb`, always the same bytes.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a tool for the people who change the models: it may stop with a message and report on its standard output"
)]

mod cloister;
mod cloister_arcade;
mod cloister_church;
mod cloister_column;
mod cloister_court;
mod cloister_masonry;
mod cloister_roof;
mod cloister_vault;
mod cloister_walls;
mod cloister_well;
mod crank;
mod crankshaft;
mod curve;
mod delaunay;
mod flywheel;
mod glb;
mod leaf;
mod lettering;
mod loft;
mod noise;
mod ogre;
mod ogre_body;
mod ogre_charts;
mod ogre_gear;
mod ogre_head;
mod outline;
mod picture;
mod piston;
mod plate;
mod remesh;
mod rod;
mod sdf;
mod sets;
mod soften;
mod solid;
mod still_life;
mod still_life_bottle;
mod still_life_fruit;
mod still_life_mirror;
mod still_life_plant;
mod still_life_table;
mod still_life_toys;
mod still_life_vase;
mod still_life_whisk;
mod temple;
mod temple_chambers;
mod temple_columns;
mod temple_hall;
mod temple_masonry;
mod temple_pylon;
mod temple_statue;
mod temple_yard;
mod untangle;
mod unwrap;
mod wood;

/// Writes each model, or only those named on the command line, and reports their sizes.
fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let models: [(&str, fn() -> glb::Scene); 5] = [
        ("cloister", cloister::scene),
        ("crank", crank::scene),
        ("ogre", ogre::scene),
        ("still_life", still_life::scene),
        ("temple", temple::scene),
    ];
    for (name, make) in models {
        if !wanted.is_empty() && !wanted.iter().any(|w| w == name) {
            continue;
        }
        let scene = make();
        let bytes = scene.to_glb();
        let path = format!("assets/models/{name}.glb");
        std::fs::write(&path, &bytes).expect("run this in the repository's root");
        println!("{path}: {} triangles, {} KiB", scene.triangles(), bytes.len().div_ceil(1024));
        for root in &scene.roots {
            println!("  {:12} {:6}", root.name, root.triangles(&scene.meshes));
        }
    }
}
