// Gradient noise in space (Perlin, "An Image Synthesizer", 1985), of which octaves come and go with the distance, so that waves
// keep their length on paper. Twin: src/render/base/noise.rs.

// The mean square of noise is 1, the mean of its absolute value and the deviation of that are these.
const NOISE_SCALE: f32 = 5.08;
const MEAN_ABSOLUTE: f32 = 0.804;
const DEVIATION_ABSOLUTE: f32 = 0.595;

fn mixed_bits(bits: u32) -> u32 {
    var h = bits;
    h ^= h >> 16u;
    h *= 0x7feb352du;
    h ^= h >> 15u;
    h *= 0x846ca68bu;
    return h ^ (h >> 16u);
}

// Two independent noises at a place; they repeat nowhere.
fn noise3x2(p: vec3<f32>, seed: u32) -> vec2<f32> {
    let cell = floor(p);
    let f = p - cell;
    let w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let at = vec3<u32>(vec3<i32>(cell));
    var sum = vec2(0.0);
    for (var x = 0u; x < 2u; x++) {
        let hx = mixed_bits((at.x + x) ^ seed);
        for (var y = 0u; y < 2u; y++) {
            let hy = mixed_bits(hx + at.y + y);
            for (var z = 0u; z < 2u; z++) {
                let h = mixed_bits(hy + at.z + z);
                let corner = vec3(f32(x), f32(y), f32(z));
                let away = f - corner;
                let weights = 1.0 - corner + w * (2.0 * corner - 1.0);
                let first = vec3(f32(h & 31u), f32((h >> 5u) & 31u), f32((h >> 10u) & 31u)) / 15.5 - 1.0;
                let second = vec3(f32((h >> 15u) & 31u), f32((h >> 20u) & 31u), f32((h >> 25u) & 31u)) / 15.5 - 1.0;
                sum += weights.x * weights.y * weights.z * vec2(dot(first, away), dot(second, away));
            }
        }
    }
    return sum * NOISE_SCALE;
}

// The same with kinks: absolute values, again of mean 0 and mean square 1.
fn octave(p: vec3<f32>, seed: u32, turbulent: bool) -> vec2<f32> {
    let n = noise3x2(p, seed);
    return select(n, (abs(n) - MEAN_ABSOLUTE) / DEVIATION_ABSOLUTE, turbulent);
}

// Where the lattice of an octave lies, in cells: at corners of it noise is 0, which are not to meet in the middle of every object.
fn lattice_shift(seed: u32) -> vec3<f32> {
    let h = mixed_bits(seed);
    return vec3(f32(h & 1023u), f32((h >> 10u) & 1023u), f32((h >> 20u) & 1023u)) / 1024.0;
}

// Logarithm to base 2 of how much larger each octave is than the one before: a factor of 8. Waves are replaced all the time as the
// camera comes nearer, and change the less the longer each of them stays.
const OCTAVE: f32 = 3.0;

// Waves that are `wave` long wherever it is measured, from octaves a factor of 8 apart, each of which is 0 where it comes and
// goes. `at` and `wave`: in one unit.
fn waves(at: vec3<f32>, wave: f32, seed: u32, turbulent: bool) -> vec2<f32> {
    let s = (log2(max(wave, 1e-30)) + 0.5) / OCTAVE;
    // Below so many cells numbers have no digits left.
    let least = (log2(max(max(abs(at.x), max(abs(at.y), abs(at.z))), 1e-30)) - 20.0) / OCTAVE;
    var sum = vec2(0.0);
    var power = 0.0;
    let first = ceil(s - 2.0);
    for (var i = 0; i < 4; i++) {
        let k = first + f32(i);
        let x = k - s;
        let weight = cos(0.785398 * x) * exp2(0.3 * x);
        let level = max(k, least);
        let own = seed + u32(i32(k) * 17);
        sum += weight * octave(at * exp2(-OCTAVE * level) + lattice_shift(own), own, turbulent);
        power += weight * weight;
    }
    return sum * inverseSqrt(max(power, 1e-12));
}

// The same with two octaves only: for details.
fn fine_waves(at: vec3<f32>, wave: f32, seed: u32, turbulent: bool) -> vec2<f32> {
    let s = log2(max(wave, 1e-30)) / OCTAVE;
    let least = (log2(max(max(abs(at.x), max(abs(at.y), abs(at.z))), 1e-30)) - 20.0) / OCTAVE;
    var sum = vec2(0.0);
    var power = 0.0;
    let first = ceil(s - 1.0);
    for (var i = 0; i < 2; i++) {
        let k = first + f32(i);
        let x = k - s;
        let weight = cos(1.570796 * x);
        let level = max(k, least);
        let own = seed + u32(i32(k) * 17) + 8191u;
        sum += weight * octave(at * exp2(-OCTAVE * level) + lattice_shift(own), own, turbulent);
        power += weight * weight;
    }
    return sum * inverseSqrt(max(power, 1e-12));
}
