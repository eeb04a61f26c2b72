// Steps that passes/gather.wgsl has gathered fill whole workgroups; this stands for none.
const NO_STEP: u32 = 0xffffffffu;
