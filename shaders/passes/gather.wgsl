// Gathers the numbers of bits that are set, in their order: what comes of them is the same however busy the device is.
#import common/kept.wgsl

// Afterwards none is set.
@group(1) @binding(0) var<storage, read_write> sifted: array<u32>;
// The numbers, then `NO_STEP` up to a whole workgroup.
@group(1) @binding(1) var<storage, read_write> kept: array<u32>;
// Workgroups of the dispatches that they get.
@group(1) @binding(2) var<storage, read_write> workgroups: array<u32>;

const LANES: u32 = 256u;
// Numbers per workgroup, as in passes/segments.wgsl.
const GROUP: u32 = 256u;

var<workgroup> counts: array<u32, LANES>;

// Each invocation gathers from as many words, one after the other.
@compute @workgroup_size(LANES)
fn cs_main(@builtin(local_invocation_index) index: u32) {
    let words = arrayLength(&sifted);
    let each = (words + LANES - 1u) / LANES;
    let begin = min(index * each, words);
    let end = min(begin + each, words);
    var count = 0u;
    for (var word = begin; word < end; word++) {
        count += countOneBits(sifted[word]);
    }
    counts[index] = count;
    workgroupBarrier();
    var at = 0u;
    var all = 0u;
    for (var other = 0u; other < LANES; other++) {
        at += select(0u, counts[other], other < index);
        all += counts[other];
    }
    for (var word = begin; word < end; word++) {
        for (var bits = sifted[word]; bits != 0u; bits &= bits - 1u) {
            kept[at] = 32u * word + firstTrailingBit(bits);
            at++;
        }
        sifted[word] = 0u;
    }
    let groups = (all + GROUP - 1u) / GROUP;
    for (var rest = all + index; rest < groups * GROUP; rest += LANES) {
        kept[rest] = NO_STEP;
    }
    if index == 0u {
        workgroups[0] = groups;
        workgroups[1] = 1u;
        workgroups[2] = 1u;
    }
}
