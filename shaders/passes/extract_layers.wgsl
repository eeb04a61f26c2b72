// Depth layers of fragment lists: the fragments of each pixel are sorted, as many layers as there are targets at a time, and
// each layer is made of its own ones.
#import common/first_eight.wgsl
#import common/fragments.wgsl
#import common/fullscreen.wgsl
#import common/layer_color.wgsl

// The fragment of each pixel that was drawn last.
var<storage, read> heads: array<u32>;
var node_tex: texture_storage_2d<rgba32uint, read>;
var payload_tex: texture_storage_2d<rgba32uint, read>;
var<storage, read> colors: array<u32>;
// The numbers of the fragments of a layer, plus 1; 0: none; undefined where nothing is listed. Sorting: that which was sorted
// last; cutting: that which is cut.
var number_tex: texture_storage_2d<r32uint, read>;

// Whether anybody asks for shading normals.
override WITH_NORMALS: bool = true;

fn node_at(number: u32) -> FragmentNode {
    return node_of(texel_at(node_tex, number - 1u));
}

fn number_at(position: vec4<f32>) -> u32 {
    return textureLoad(number_tex, vec2<i32>(position.xy)).x;
}

struct Depth {
    @builtin(frag_depth) depth: f32,
}

// Covers pixels that have any fragments.
@fragment
fn fs_listed(@builtin(position) position: vec4<f32>) -> Depth {
    if heads[index_of_pixel(vec2<i32>(position.xy))] == 0u {
        discard;
    }
    return Depth(1.0);
}

// The numbers of fragments of up to eight layers, plus 1.
struct Numbers {
    @location(0) a: u32,
    @location(1) b: u32,
    @location(2) c: u32,
    @location(3) d: u32,
    @location(4) e: u32,
    @location(5) f: u32,
    @location(6) g: u32,
    @location(7) h: u32,
}

// What is nearer comes first, and of what is equally deep what is drawn first. A surface that comes twice equally deep is kept
// once, as it was drawn first. Reversed depth 0 is the far plane itself, which is not drawn.
fn sorted(position: vec4<f32>, last: Sorted) -> Numbers {
    var first = EMPTY;
    var number = heads[index_of_pixel(vec2<i32>(position.xy))];
    while number != 0u {
        let node = node_at(number);
        var own = Sorted(~node.depth, node.order, number);
        if !is_before(last, own) || node.depth == 0u {
            own = NONE;
        }
        first = with_another(first, own);
        number = node.next;
    }
    return Numbers(
        first.a.number,
        first.b.number,
        first.c.number,
        first.d.number,
        first.e.number,
        first.f.number,
        first.g.number,
        first.h.number,
    );
}

@fragment
fn fs_sort(@builtin(position) position: vec4<f32>) -> Numbers {
    return sorted(position, Sorted(0u, 0u, 0u));
}

// Those behind the layer that was sorted last.
@fragment
fn fs_sort_behind(@builtin(position) position: vec4<f32>) -> Numbers {
    let number = number_at(position);
    let node = node_at(max(number, 1u));
    // Behind none there are none.
    return sorted(position, Sorted(select(~node.depth, NONE.depth, number == 0u), node.order, number));
}

@fragment
fn fs_depth(@builtin(position) position: vec4<f32>) -> Depth {
    let number = number_at(position);
    if heads[index_of_pixel(vec2<i32>(position.xy))] == 0u || number == 0u {
        discard;
    }
    return Depth(bitcast<f32>(node_at(number).depth));
}

struct Layer {
    @location(0) geometry: vec4<u32>,
    @location(1) surface_id: u32,
    @location(2) base_color: vec4<f32>,
}

// Covers pixels that have no fragment in this layer.
@fragment
fn fs_ended(@builtin(position) position: vec4<f32>) {
    if number_at(position) != 0u {
        discard;
    }
}

@fragment
fn fs_layer(@builtin(position) position: vec4<f32>) -> Layer {
    let number = number_at(position);
    let payload = payload_of(texel_at(payload_tex, number - 1u));
    var normal = payload.face;
    if WITH_NORMALS {
        normal = node_at(number).normal;
    }
    var color = 0u;
    if WITH_COLOR {
        color = colors[number - 1u];
    }
    let geometry = vec4(normal, payload.face, payload.depth, payload.object);
    return Layer(geometry, payload.surface_id, unpack_layer_color(color));
}
