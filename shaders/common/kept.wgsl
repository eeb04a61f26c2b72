// What is left of many invocations: how many workgroups look at them, and how many they are.
struct Kept {
    groups: vec3<u32>,
    count: u32,
}
