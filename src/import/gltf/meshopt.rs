//! `EXT_meshopt_compression` (and its successor `KHR_meshopt_compression`): unpacking of buffer views.

use std::ffi::c_int;

use ::gltf::json::{Buffer, Value, buffer};
use ::meshopt::ffi;

use super::fault::{Fault, Result, malformed};
use crate::import::memory_budget::MemoryBudget;

/// What the elements of a packed view are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

/// What is done to the elements after unpacking.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Filter {
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

/// A packed view, as declared.
#[derive(Debug)]
pub(super) struct Packing {
    /// Index of the buffer that holds the packed bytes.
    pub(super) buffer: usize,
    /// First packed byte.
    pub(super) offset: u64,
    /// Number of packed bytes.
    pub(super) length: u64,
    stride: usize,
    count: usize,
    mode: Mode,
    filter: Filter,
}

const NAMES: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Whether a buffer is only there for programs that cannot unpack; it need not exist.
pub(super) fn is_fallback(buffer: &Buffer) -> bool {
    buffer.extensions.as_ref().is_some_and(|e| {
        let declared = NAMES.iter().find_map(|name| e.others.get(*name));
        declared.and_then(|d| d.get("fallback")).and_then(Value::as_bool) == Some(true)
    })
}

/// The packing of a view, if it has one.
pub(super) fn packing_of(view: &buffer::View) -> Option<Result<Packing>> {
    let extensions = &view.extensions.as_ref()?.others;
    let value =
        extensions.get("EXT_meshopt_compression").or_else(|| extensions.get("KHR_meshopt_compression"))?;
    Some(parse(value))
}

fn parse(value: &Value) -> Result<Packing> {
    let number = |key: &str, default: Option<u64>| {
        value
            .get(key)
            .map_or(default, Value::as_u64)
            .ok_or_else(|| Fault::Malformed(format!("`{key}` is missing or no whole number")))
    };
    let index = |key: &str| {
        usize::try_from(number(key, None)?)
            .map_err(|e| Fault::Malformed(format!("`{key}` is out of range: {e}")))
    };
    let packing = Packing {
        buffer: index("buffer")?,
        offset: number("byteOffset", Some(0))?,
        length: number("byteLength", None)?,
        stride: index("byteStride")?,
        count: index("count")?,
        mode: match value.get("mode").and_then(Value::as_str) {
            Some("ATTRIBUTES") => Mode::Attributes,
            Some("TRIANGLES") => Mode::Triangles,
            Some("INDICES") => Mode::Indices,
            _ => return malformed("its mode is none of ATTRIBUTES, TRIANGLES and INDICES"),
        },
        filter: match value.get("filter").and_then(Value::as_str) {
            None | Some("NONE") => Filter::None,
            Some("OCTAHEDRAL") => Filter::Octahedral,
            Some("QUATERNION") => Filter::Quaternion,
            Some("EXPONENTIAL") => Filter::Exponential,
            Some("COLOR") => Filter::Color,
            Some(other) => {
                return Err(Fault::Unsupported(format!(
                    "the meshopt filter {}",
                    crate::import::source::shorten(other)
                )));
            }
        },
    };
    packing.check()?;
    Ok(packing)
}

impl Packing {
    /// Everything that the decoder takes for granted.
    fn check(&self) -> Result<()> {
        let stride = self.stride;
        let fits = match self.mode {
            Mode::Attributes => stride > 0 && stride <= 256 && stride.is_multiple_of(4),
            Mode::Triangles => matches!(stride, 2 | 4) && self.count.is_multiple_of(3),
            Mode::Indices => matches!(stride, 2 | 4),
        };
        let filter_fits = match self.filter {
            Filter::None => true,
            Filter::Octahedral | Filter::Color => matches!(stride, 4 | 8),
            Filter::Quaternion => stride == 8,
            Filter::Exponential => stride.is_multiple_of(4),
        } && (self.filter == Filter::None || self.mode == Mode::Attributes);
        if fits && filter_fits {
            return Ok(());
        }
        malformed(format!(
            "a stride of {stride} and a count of {} do not go with mode {:?} and filter {:?}",
            self.count, self.mode, self.filter
        ))
    }
}

/// Unpacks the bytes of a packed view.
///
/// # Errors
/// When they are damaged or would take more memory than is left.
pub(super) fn unpack(packing: &Packing, packed: &[u8], budget: &MemoryBudget) -> Result<Vec<u8>> {
    let size = (packing.stride as u64).saturating_mul(packing.count as u64);
    budget.take(size, || format!("its {} elements", packing.count))?;
    // Backed by 32-bit words, because the filters access whole components.
    let mut words = vec![0_u32; size.div_ceil(4) as usize];
    if packing.count > 0 && !decode(packing, packed, &mut words) {
        return malformed("the packed bytes are damaged");
    }
    let mut bytes: Vec<u8> = bytemuck::pod_collect_to_vec(&words);
    bytes.truncate(size as usize);
    Ok(bytes)
}

/// Runs decoder and filter. `out` must hold `count · stride` bytes, which is checked here.
#[expect(
    unsafe_code,
    reason = "the safe wrappers fix the stride at compile time; a file chooses it at run time"
)]
fn decode(packing: &Packing, packed: &[u8], out: &mut [u32]) -> bool {
    let (count, stride) = (packing.count, packing.stride);
    let fits = count.checked_mul(stride).is_some_and(|size| size <= size_of_val(out));
    if !fits || packing.check().is_err() {
        return false;
    }
    let target = out.as_mut_ptr();
    // SAFETY: `target` is aligned to 4 and points to at least `count · stride` writable bytes, `packed` is a valid
    // slice, and `check` has verified what each function asserts of stride and count. The decoders are made for
    // untrusted input: they stay within both ranges and report damage by their result.
    unsafe {
        let code: c_int = match packing.mode {
            Mode::Attributes => {
                ffi::meshopt_decodeVertexBuffer(target.cast(), count, stride, packed.as_ptr(), packed.len())
            }
            Mode::Triangles => {
                ffi::meshopt_decodeIndexBuffer(target.cast(), count, stride, packed.as_ptr(), packed.len())
            }
            Mode::Indices => {
                ffi::meshopt_decodeIndexSequence(target.cast(), count, stride, packed.as_ptr(), packed.len())
            }
        };
        if code != 0 {
            return false;
        }
        match packing.filter {
            Filter::None => {}
            Filter::Octahedral => ffi::meshopt_decodeFilterOct(target.cast(), count, stride),
            Filter::Quaternion => ffi::meshopt_decodeFilterQuat(target.cast(), count, stride),
            Filter::Exponential => ffi::meshopt_decodeFilterExp(target.cast(), count, stride),
            Filter::Color => ffi::meshopt_decodeFilterColor(target.cast(), count, stride),
        }
    }
    true
}
