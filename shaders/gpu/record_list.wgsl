// Lists of records that invocations keep, in any order; twin: src/gpu/record_list.rs.

// Records per workgroup of whatever works through a list.
const GROUP: u32 = 256u;

// How many workgroups work through it, and how many records it has.
struct ListHead {
    groups: vec3<u32>,
    count: u32,
}

// The same while it is being counted.
struct Counting {
    groups: array<atomic<u32>, 3>,
    count: atomic<u32>,
}

// While a list is made.
var<storage, read_write> keeping: Counting;
// Afterwards.
var<storage, read> list: ListHead;

// Makes room for so many records; returns the index of the first.
fn keep_many(count: u32) -> u32 {
    let first = atomicAdd(&keeping.count, count);
    let groups = (first + count + GROUP - 1u) / GROUP - (first + GROUP - 1u) / GROUP;
    if groups > 0u {
        atomicAdd(&keeping.groups[0], groups);
    }
    return first;
}
