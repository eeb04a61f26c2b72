// How wide and how strong a line is at one point.
#import common/frame.wgsl
#import common/edge_map.wgsl
#import common/edge_style.wgsl

// Whether any object's lines vary in width, and whether by hand pressure.
override WITH_VARIATION: bool = true;
override WITH_PRESSURE: bool = true;
// Whether any object's creases are weighed by their angle.
override WITH_ANGLES: bool = true;

fn hash3(p: vec3<i32>) -> f32 {
    var h = u32(p.x) * 0x8da6b343u ^ u32(p.y) * 0xd8163841u ^ u32(p.z) * 0xcb1ab31fu;
    h ^= h >> 13u;
    h *= 0x2c1b3c6du;
    h ^= h >> 15u;
    return f32(h & 0xffffu) / 65535.0;
}

// Value noise, 0 to 1, of scale 1.
fn noise3(p: vec3<f32>) -> f32 {
    let cell = floor(p);
    let f = p - cell;
    let u = f * f * (3.0 - 2.0 * f);
    let c = vec3<i32>(cell);
    let x00 = mix(hash3(c), hash3(c + vec3(1, 0, 0)), u.x);
    let x10 = mix(hash3(c + vec3(0, 1, 0)), hash3(c + vec3(1, 1, 0)), u.x);
    let x01 = mix(hash3(c + vec3(0, 0, 1)), hash3(c + vec3(1, 0, 1)), u.x);
    let x11 = mix(hash3(c + vec3(0, 1, 1)), hash3(c + vec3(1, 1, 1)), u.x);
    return mix(mix(x00, x10, u.y), mix(x01, x11, u.y), u.z);
}

// Half the width in px at a point of a surface with this normal.
fn half_width(object: u32, class_of: u32, pos_view: vec3<f32>, normal: vec3<f32>) -> f32 {
    let style = style_of(object);
    let full = edge_styles[style].lines[class_of - 1u].width;
    if !WITH_VARIATION {
        return 0.5 * full;
    }
    var width = full * (1.0 - edge_styles[style].by_distance * range_share(-pos_view.z));
    let lit = max(dot(normal, towards_light(frame.lights[0], pos_view)), 0.0);
    width *= 1.0 - edge_styles[style].by_light * lit;
    if WITH_PRESSURE {
        // Fixed to the world, so that strokes do not swim when the camera turns.
        let pixel = pixel_at(frame.center_depth);
        let pos_world = (frame.world_from_view * vec4(pos_view, 1.0)).xyz;
        let p = pos_world / (edge_styles[style].pressure_scale * pixel);
        let n = 0.7 * noise3(p) + 0.3 * noise3(p * 2.3 + 17.0);
        // The middle half of the noise's values is spread over the whole range.
        width *= 1.0 - edge_styles[style].pressure * smoothstep(0.25, 0.75, n);
    }
    // Never quite nothing: a line gets thin, it does not break.
    return 0.5 * max(width, 0.1 * full);
}

// How many halves of its width a line of this object has on one side of its spine: inner edges have no outside.
fn halves_of(object: u32, class_of: u32) -> f32 {
    return select(1.0, 2.0, edge_styles[style_of(object)].alignment != 0u && is_of_profile(class_of));
}

// The share of a crease's ink by its dihedral angle (radians): the paper's 1 − cos, full at 41° as the operator's.
fn crease_weight(object: u32, angle: f32) -> f32 {
    if !WITH_ANGLES {
        return 1.0;
    }
    return mix(1.0, clamp(4.0 * (1.0 - cos(angle)), 0.0, 1.0), edge_styles[style_of(object)].by_angle);
}
