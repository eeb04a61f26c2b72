// Layers of several groups in one list per pixel, put in order and blended.
#import common/first_eight.wgsl
#import common/frame.wgsl
#import common/fullscreen.wgsl
#import common/pixel.wgsl
#import common/placed.wgsl
#import gpu/record_texture.wgsl

// The rows that have room now, for so many entries. Twin: `BandUniform` in src/render/passes/layer_lists.rs.
struct Band {
    first_row: u32,
    end_row: u32,
    capacity: u32,
}

// Appending.
var<uniform> band: Band;
// The entry of each pixel that was appended last, plus 1; 0: none.
var<storage, read_write> heads: array<u32>;
// Bits of the greatest depth so far of this group.
var<storage, read_write> deepest: array<u32>;
// Entries of this band, then those of each row, those without room included.
var<storage, read_write> counts: array<atomic<u32>>;
// x: the entry before it in its pixel, plus 1; y: depth (bits of a float); z, w: color as in common/placed.wgsl.
var new_entry_tex: texture_storage_2d<rgba32uint, write>;
// A layer; see common/placed.wgsl.
var ink_tex: texture_storage_2d<rgba32uint, read>;
var fill_tex: texture_storage_2d<rgba32uint, read>;

// Afterwards.
var<storage, read> listed: array<u32>;
var entry_tex: texture_storage_2d<rgba32uint, read>;

// What the layer has.
override WITH_INK: bool = true;
override WITH_FILL: bool = true;

const GROUP: u32 = 64u;

var<workgroup> group_count: atomic<u32>;
var<workgroup> group_first: u32;

fn append(index: u32, pixel: u32, texel: vec4<u32>) {
    // Depths are positive: their bits are in the same order.
    let depth = max(deepest[pixel], texel.z);
    deepest[pixel] = depth;
    if index < band.capacity {
        textureStore(new_entry_tex, texel_of_record(index), vec4(heads[pixel], depth, texel.xy));
        heads[pixel] = index + 1u;
    }
}

// A row of pixels per workgroup; in each pixel the ink comes before the fill.
@compute @workgroup_size(GROUP)
fn cs_append(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let size = vec2<u32>(frame.size);
    let is_in = id.x < size.x && id.y >= band.first_row && id.y < min(band.end_row, size.y);
    var ink = vec4(0u);
    var fill = vec4(0u);
    if is_in {
        if WITH_INK {
            ink = textureLoad(ink_tex, vec2<i32>(id.xy));
        }
        if WITH_FILL {
            fill = textureLoad(fill_tex, vec2<i32>(id.xy));
        }
    }
    let own = select(0u, 1u, ink.z != 0u) + select(0u, 1u, fill.z != 0u);
    var offset = 0u;
    if own != 0u {
        offset = atomicAdd(&group_count, own);
    }
    workgroupBarrier();
    if local == 0u {
        let count = atomicLoad(&group_count);
        if count != 0u {
            group_first = atomicAdd(&counts[0], count);
            atomicAdd(&counts[1u + id.y], count);
        }
    }
    workgroupBarrier();
    let pixel = id.y * size.x + id.x;
    var index = group_first + offset;
    if ink.z != 0u {
        append(index, pixel, ink);
        index += 1u;
    }
    if fill.z != 0u {
        append(index, pixel, fill);
    }
}

fn beneath(front: vec4<f32>, entry: Sorted) -> vec4<f32> {
    if entry.order == NONE.order {
        return front;
    }
    let texel = textureLoad(entry_tex, texel_of_record(entry.order));
    let color = vec4(unpack2x16float(texel.z), unpack2x16float(texel.w));
    return front + color * (1.0 - front.a);
}

// Eight entries at a time, the nearest ones first; of those that are equally deep what was appended first.
@fragment
fn fs_blend(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let head = listed[index_of_pixel(vec2<i32>(position.xy))];
    var color = vec4(0.0);
    var last = NONE;
    var is_first = true;
    loop {
        var first = EMPTY;
        var next = head;
        while next != 0u {
            let number = next - 1u;
            let texel = textureLoad(entry_tex, texel_of_record(number));
            var own = Sorted(texel.y, number, 0u);
            if !is_first && !is_before(last, own) {
                own = NONE;
            }
            first = with_another(first, own);
            next = texel.x;
        }
        color = beneath(color, first.a);
        color = beneath(color, first.b);
        color = beneath(color, first.c);
        color = beneath(color, first.d);
        color = beneath(color, first.e);
        color = beneath(color, first.f);
        color = beneath(color, first.g);
        color = beneath(color, first.h);
        last = first.h;
        is_first = false;
        if last.order == NONE.order || color.a >= 0.9999 {
            break;
        }
    }
    return color;
}
