// What is left of many invocations: how many workgroups look at them, and how many they are.
struct ListHead {
    groups: vec3<u32>,
    count: u32,
}

// The same while it is being counted.
struct Counting {
    groups: array<atomic<u32>, 3>,
    count: atomic<u32>,
}
