//! Typed, checked reading of accessors: every component type, interleaved, sparse and normalized.

use ::gltf::json::accessor::{Accessor as Declared, ComponentType, Type};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Index, accessor};
use bytemuck::Pod;

use super::buffers::GltfDocument;
use super::fault::{Result, malformed};
use crate::import::memory_budget::MemoryBudget;

/// An accessor whose every element is known to lie within its bytes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Accessor<'a> {
    index: usize,
    /// Number of elements.
    pub(super) count: usize,
    /// Components of an element, 1 to 16.
    pub(super) width: usize,
    component: ComponentType,
    normalized: bool,
    /// `None`: all zero.
    dense: Option<Elements<'a>>,
    sparse: Option<Sparse<'a>>,
    budget: &'a MemoryBudget,
}

/// Elements at a constant distance.
#[derive(Debug, Clone, Copy)]
struct Elements<'a> {
    /// From the first byte of the first element on, at least to the last byte of the last one.
    bytes: &'a [u8],
    stride: usize,
}

/// Elements that replace some of the dense ones.
#[derive(Debug, Clone, Copy)]
struct Sparse<'a> {
    count: usize,
    indices: Elements<'a>,
    index_type: ComponentType,
    values: Elements<'a>,
}

impl GltfDocument<'_> {
    /// Looks an accessor up and checks that all that it declares is there.
    ///
    /// # Errors
    /// When anything is missing, out of range or contradictory.
    pub(super) fn accessor(&self, index: Index<Declared>) -> Result<Accessor<'_>> {
        let number = index.value();
        let Some(declared) = self.root.accessors.get(number) else {
            return malformed(format!("there is no accessor {number}"));
        };
        self.check(number, declared).map_err(|f| f.at(|| format!("accessor {number}")))
    }

    fn check(&self, index: usize, declared: &Declared) -> Result<Accessor<'_>> {
        let (Checked::Valid(component), Checked::Valid(kind)) = (declared.component_type, declared.type_)
        else {
            return malformed("its type or component type is unknown");
        };
        let component = component.0;
        let width = kind.multiplicity();
        let element = width * component.size();
        if matches!(kind, Type::Mat2 | Type::Mat3) && component.size() < 4 {
            return malformed("padded matrices are not read");
        }
        let count = count_of(declared.count.0)?;
        let dense = match declared.buffer_view {
            Some(view) => {
                let view = self.view(view)?;
                let offset = declared.byte_offset.unwrap_or_default().0;
                Some(elements(view.bytes, offset, view.stride, element, count)?)
            }
            None => None,
        };
        let sparse = match &declared.sparse {
            Some(sparse) => {
                Some(self.check_sparse(sparse, element).map_err(|f| f.at(|| "its sparse part".into()))?)
            }
            None => None,
        };
        Ok(Accessor {
            index,
            count,
            width,
            component,
            normalized: declared.normalized,
            dense,
            sparse,
            budget: &self.budget,
        })
    }

    fn check_sparse(&self, sparse: &accessor::sparse::Sparse, element: usize) -> Result<Sparse<'_>> {
        let Checked::Valid(index_type) = sparse.indices.component_type else {
            return malformed("the component type of its indices is unknown");
        };
        let index_type = index_type.0;
        let count = count_of(sparse.count.0)?;
        let part = |view, offset, size| elements(self.view(view)?.bytes, offset, None, size, count);
        Ok(Sparse {
            count,
            indices: part(sparse.indices.buffer_view, sparse.indices.byte_offset.0, index_type.size())?,
            index_type,
            values: part(sparse.values.buffer_view, sparse.values.byte_offset.0, element)?,
        })
    }
}

fn count_of(declared: u64) -> Result<usize> {
    match u32::try_from(declared) {
        Ok(count) => Ok(count as usize),
        Err(_) => malformed(format!("it declares {declared} elements; at most {} are read", u32::MAX)),
    }
}

/// Checks that `count` elements of `size` bytes lie within `bytes` from `offset` on.
fn elements(
    bytes: &[u8],
    offset: u64,
    stride: Option<usize>,
    size: usize,
    count: usize,
) -> Result<Elements<'_>> {
    let stride = if count > 1 { stride.unwrap_or(size) } else { size };
    if stride < size {
        return malformed(format!("its stride of {stride} bytes is less than its elements' {size} bytes"));
    }
    let need = match count {
        0 => Some(0),
        _ => (count - 1).checked_mul(stride).and_then(|n| n.checked_add(size)),
    };
    let bytes_from = usize::try_from(offset).ok().and_then(|o| bytes.get(o..));
    match (bytes_from, need) {
        (Some(from), Some(need)) if need <= from.len() => Ok(Elements { bytes: from, stride }),
        _ => malformed(format!(
            "its {count} elements of {size} bytes (offset {offset}, stride {stride}) lie outside its buffer view of \
             {} bytes",
            bytes.len()
        )),
    }
}

impl Accessor<'_> {
    /// The elements as floats; integers are converted, and scaled to 0..1 or −1..1 where the accessor is normalized.
    ///
    /// With `picks` only those elements are read; they must be in range (what is not becomes 0).
    ///
    /// # Errors
    /// When the accessor's width is not `N` or memory would run out.
    pub(super) fn floats<const N: usize>(&self, picks: Option<&[u32]>) -> Result<Vec<[f32; N]>> {
        self.expect_width(N)?;
        let unsigned = |max: f32| move |v: f32| v / max;
        let signed = |max: f32| move |v: f32| (v / max).max(-1.0);
        match (self.component, self.normalized) {
            (ComponentType::F32, _) => self.read(picks, true, f32::from_le_bytes),
            (ComponentType::U32, _) => self.read(picks, false, |b| u32::from_le_bytes(b) as f32),
            (ComponentType::U16, false) => self.read(picks, false, |b| f32::from(u16::from_le_bytes(b))),
            (ComponentType::I16, false) => self.read(picks, false, |b| f32::from(i16::from_le_bytes(b))),
            (ComponentType::U8, false) => self.read(picks, false, |[b]: [u8; 1]| f32::from(b)),
            (ComponentType::I8, false) => self.read(picks, false, |b| f32::from(i8::from_le_bytes(b))),
            (ComponentType::U16, true) => {
                let scale = unsigned(65535.0);
                self.read(picks, false, |b| scale(f32::from(u16::from_le_bytes(b))))
            }
            (ComponentType::I16, true) => {
                let scale = signed(32767.0);
                self.read(picks, false, |b| scale(f32::from(i16::from_le_bytes(b))))
            }
            (ComponentType::U8, true) => {
                let scale = unsigned(255.0);
                self.read(picks, false, |[b]: [u8; 1]| scale(f32::from(b)))
            }
            (ComponentType::I8, true) => {
                let scale = signed(127.0);
                self.read(picks, false, |b| scale(f32::from(i8::from_le_bytes(b))))
            }
        }
    }

    /// The elements as unsigned integers (indices, joints). `picks` as in [`Accessor::floats`].
    ///
    /// # Errors
    /// When the accessor's width is not `N`, its components are not unsigned integers, or memory would run out.
    pub(super) fn integers<const N: usize>(&self, picks: Option<&[u32]>) -> Result<Vec<[u32; N]>> {
        self.expect_width(N)?;
        match self.component {
            ComponentType::U32 => self.read(picks, true, u32::from_le_bytes),
            ComponentType::U16 => self.read(picks, false, |b| u32::from(u16::from_le_bytes(b))),
            ComponentType::U8 => self.read(picks, false, |[b]: [u8; 1]| u32::from(b)),
            _ => malformed(format!("accessor {}: unsigned integers are needed here", self.index)),
        }
    }

    fn expect_width(&self, width: usize) -> Result<()> {
        if self.width == width {
            return Ok(());
        }
        malformed(format!(
            "accessor {}: its elements have {} components where {width} are needed",
            self.index, self.width
        ))
    }

    /// `same_bits`: a component in memory is exactly a `T`, so that packed elements can be copied as a whole.
    fn read<T: Pod, const N: usize, const S: usize>(
        &self,
        picks: Option<&[u32]>,
        same_bits: bool,
        convert: impl Fn([u8; S]) -> T,
    ) -> Result<Vec<[T; N]>>
    where
        [T; N]: Pod,
    {
        if let (Some(picks), Some(_)) = (picks, self.sparse) {
            let all = self.read(None, same_bits, convert)?;
            let zero = [T::zeroed(); N];
            return Ok(picks.iter().map(|&i| all.get(i as usize).copied().unwrap_or(zero)).collect());
        }
        let count = picks.map_or(self.count, <[u32]>::len);
        let size = size_of::<[T; N]>();
        self.budget.take((count as u64) * size as u64, || {
            format!("accessor {}: its {count} elements", self.index)
        })?;
        let mut out = match (self.dense, picks) {
            (Some(dense), None) if same_bits && dense.stride == size && cfg!(target_endian = "little") => {
                // Checked at look-up: count · size bytes are there.
                let packed = dense.bytes.get(..count * size).unwrap_or_default();
                bytemuck::pod_collect_to_vec(packed)
            }
            (dense, _) => {
                let mut out: Vec<[T; N]> = bytemuck::zeroed_vec(count);
                match (dense, picks) {
                    (Some(dense), None) => dense.fill(&mut out, &convert),
                    (Some(dense), Some(picks)) => dense.fill_picked(&mut out, picks, &convert),
                    (None, _) => {}
                }
                out
            }
        };
        if let Some(sparse) = &self.sparse {
            self.budget.take(sparse.count as u64 * size as u64, || {
                format!("accessor {}: its sparse elements", self.index)
            })?;
            let mut values: Vec<[T; N]> = bytemuck::zeroed_vec(sparse.count);
            sparse.values.fill(&mut values, &convert);
            for (value, index) in values.into_iter().zip(sparse.targets()) {
                match out.get_mut(index as usize) {
                    Some(place) => *place = value,
                    None => {
                        return malformed(format!(
                            "accessor {}: sparse index {index} is out of range",
                            self.index
                        ));
                    }
                }
            }
        }
        Ok(out)
    }
}

impl Sparse<'_> {
    fn targets(&self) -> impl Iterator<Item = u32> + '_ {
        let size = self.index_type.size();
        self.indices
            .bytes
            .chunks_exact(size)
            .take(self.count)
            .map(|b| b.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte)))
    }
}

impl Elements<'_> {
    fn fill<T: Pod, const N: usize, const S: usize>(
        &self,
        out: &mut [[T; N]],
        convert: &impl Fn([u8; S]) -> T,
    ) {
        for (element, bytes) in out.iter_mut().zip(self.bytes.chunks(self.stride.max(1))) {
            convert_element(element, bytes, convert);
        }
    }

    fn fill_picked<T: Pod, const N: usize, const S: usize>(
        &self,
        out: &mut [[T; N]],
        picks: &[u32],
        convert: &impl Fn([u8; S]) -> T,
    ) {
        for (element, &pick) in out.iter_mut().zip(picks) {
            let start = (pick as usize).saturating_mul(self.stride);
            if let Some(bytes) = self.bytes.get(start..) {
                convert_element(element, bytes, convert);
            }
        }
    }
}

#[inline(always)]
fn convert_element<T, const N: usize, const S: usize>(
    element: &mut [T; N],
    bytes: &[u8],
    convert: &impl Fn([u8; S]) -> T,
) {
    for (component, bytes) in element.iter_mut().zip(bytes.as_chunks::<S>().0) {
        *component = convert(*bytes);
    }
}
