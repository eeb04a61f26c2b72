// Steps fill whole workgroups; this stands for none.
const NO_STEP: u32 = 0xffffffffu;
