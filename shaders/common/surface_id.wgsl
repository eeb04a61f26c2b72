// Tells the surfaces of all objects apart; 0 is the background. Twin: `surface_id` in src/render/base/ids.rs.
fn surface_id_of(object: u32, surface: u32) -> u32 {
    return max((object & 0x7fffffffu) * 2654435769u + surface, 1u);
}

// The surface of an object by such a number.
fn surface_of(id: u32, object: u32) -> u32 {
    return id - (object & 0x7fffffffu) * 2654435769u;
}
