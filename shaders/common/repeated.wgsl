// Lines of a layer that a nearer layer has at the same place (blueprints paper, section 4.1, Fig. 5).

// Whether they are left out.
override WITHOUT_REPEATED: bool = false;

// Closer than this, px, two spines are one.
const SAME: f32 = 1.0;

fn offset_in(spine: u32) -> vec2<f32> {
    return vec2(f32((spine >> 8u) & 255u), f32(spine & 255u)) / 127.0 - 1.0;
}

// Whether a spine is repeated; `nearer_lines_tex` holds the spines of all nearer layers.
fn is_repeated(nearer_lines_tex: texture_storage_2d<r32uint, read>, px: vec2<i32>, spine: u32) -> bool {
    var least = 1e9;
    for (var i = 0; i < 9; i++) {
        let away = vec2(i % 3, i / 3) - 1;
        let other = textureLoad(nearer_lines_tex, px + away).x;
        let apart = vec2<f32>(away) + offset_in(other) - offset_in(spine);
        least = select(least, min(least, dot(apart, apart)), other != 0u);
    }
    return least < SAME * SAME;
}

// The spines of a pixel, without repeated ones, and all of them so far.
struct NearerLines {
    own: u32,
    now: u32,
}

fn nearer_lines_at(nearer_lines_tex: texture_storage_2d<r32uint, read>, px: vec2<i32>, spine: u32) -> NearerLines {
    if !WITHOUT_REPEATED {
        return NearerLines(spine, spine);
    }
    let before = textureLoad(nearer_lines_tex, px).x;
    return NearerLines(select(spine, 0u, is_repeated(nearer_lines_tex, px, spine)), select(spine, before, spine == 0u));
}
