//! Numbers of accessors, every one of them checked.

use ::gltf::json::accessor::{ComponentType, Type};
use ::gltf::json::validation::Checked;

use super::document::Document;
use crate::diagnostic::FileError;
use crate::limits::MAX_ACCESSOR_VALUES;

impl Document {
    /// The elements of a floating-point accessor of `N` components, normalised integers as the
    /// fractions that they mean.
    ///
    /// Fails for another shape, for places outside of the buffer and for what is no number.
    pub(super) fn floats<const N: usize>(
        &self,
        accessor: usize,
    ) -> Result<Vec<[f32; N]>, FileError> {
        let raw = self.raw(accessor, &[N])?;
        let normalized = self.root.accessors[accessor].normalized;
        let mut values = Vec::with_capacity(raw.count);
        for element in raw.elements() {
            let mut value = [0.0; N];
            for (value, bytes) in value.iter_mut().zip(element.chunks_exact(raw.size)) {
                *value = number(bytes, raw.component, normalized);
            }
            values.push(value);
        }
        self.overwrite_sparse(accessor, &raw, |at, element| {
            for (value, bytes) in values[at].iter_mut().zip(element.chunks_exact(raw.size)) {
                *value = number(bytes, raw.component, normalized);
            }
        })?;
        if values.iter().flatten().any(|value| !value.is_finite()) {
            return Err(self.error(format!("accessor {accessor} holds what is no finite number")));
        }
        Ok(values)
    }

    /// The elements of an accessor of `N` whole numbers.
    pub(super) fn integers<const N: usize>(
        &self,
        accessor: usize,
    ) -> Result<Vec<[u32; N]>, FileError> {
        let raw = self.raw(accessor, &[N])?;
        let whole = |bytes: &[u8]| match *bytes {
            [a] => Some(u32::from(a)),
            [a, b] => Some(u32::from(u16::from_le_bytes([a, b]))),
            [a, b, c, d] if raw.component == ComponentType::U32 => {
                Some(u32::from_le_bytes([a, b, c, d]))
            }
            _ => None,
        };
        let bad = || self.error(format!("accessor {accessor} does not hold whole numbers"));
        let mut values = Vec::with_capacity(raw.count);
        for element in raw.elements() {
            let mut value = [0; N];
            for (value, bytes) in value.iter_mut().zip(element.chunks_exact(raw.size)) {
                *value = whole(bytes).ok_or_else(bad)?;
            }
            values.push(value);
        }
        self.overwrite_sparse(accessor, &raw, |at, element| {
            for (value, bytes) in values[at].iter_mut().zip(element.chunks_exact(raw.size)) {
                *value = whole(bytes).unwrap_or(0);
            }
        })?;
        Ok(values)
    }

    /// How many components an element of the accessor has; 0 where there is no such accessor.
    pub(super) fn n_components(&self, accessor: usize) -> usize {
        match self.root.accessors.get(accessor).map(|accessor| &accessor.type_) {
            Some(Checked::Valid(kind)) => kind.multiplicity(),
            _ => 0,
        }
    }

    /// The bytes of an accessor whose elements have one of `shapes` components.
    fn raw(&self, index: usize, shapes: &[usize]) -> Result<Raw<'_>, FileError> {
        let missing = || self.error(format!("there is no accessor {index}"));
        let accessor = self.root.accessors.get(index).ok_or_else(missing)?;
        let bad = |what: &str| self.error(format!("accessor {index} {what}"));
        let (Checked::Valid(kind), Checked::Valid(component)) =
            (&accessor.type_, &accessor.component_type)
        else {
            return Err(bad("is of an unknown type"));
        };
        let (n, component) = (kind.multiplicity(), component.0);
        let is_matrix = matches!(kind, Type::Mat2 | Type::Mat3 | Type::Mat4);
        if !shapes.contains(&n) || (is_matrix && component != ComponentType::F32) {
            return Err(bad("has another shape than its use"));
        }
        let count = usize::try_from(accessor.count.0).unwrap_or(usize::MAX);
        if count.saturating_mul(n) > MAX_ACCESSOR_VALUES {
            return Err(bad(&format!("claims {count} elements, more than is read")));
        }
        let size = component.size();
        let Some(view) = accessor.buffer_view else {
            // Zeros, by the format's rule; what is not zero is sparse.
            return Ok(Raw { bytes: None, count, n, size, stride: n * size, component });
        };
        let bytes = self.view(view.value())?;
        let stride = self.root.buffer_views[view.value()].byte_stride;
        let stride = stride.map_or(n * size, |stride| stride.0);
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        let offset = usize::try_from(offset).unwrap_or(usize::MAX);
        let length = count
            .saturating_sub(1)
            .checked_mul(stride)
            .and_then(|all| all.checked_add(n * size))
            .filter(|_| stride >= n * size);
        let length = if count == 0 { Some(0) } else { length };
        let end = length.and_then(|length| length.checked_add(offset));
        let bytes = end
            .and_then(|end| bytes.get(offset..end))
            .ok_or_else(|| bad("leads beyond its buffer"))?;
        Ok(Raw { bytes: Some(bytes), count, n, size, stride, component })
    }

    /// Calls `set` with the place and bytes of every element that is stored apart.
    fn overwrite_sparse(
        &self,
        index: usize,
        raw: &Raw<'_>,
        mut set: impl FnMut(usize, &[u8]),
    ) -> Result<(), FileError> {
        let Some(sparse) = &self.root.accessors[index].sparse else { return Ok(()) };
        let bad = || self.error(format!("accessor {index} is sparse beyond its elements"));
        let n_sparse = usize::try_from(sparse.count.0).map_err(|_error| bad())?;
        let Checked::Valid(kind) = &sparse.indices.component_type else { return Err(bad()) };
        let width = kind.0.size();
        let part = |view: usize, offset: u64, width: usize| -> Result<&[u8], FileError> {
            let from = usize::try_from(offset).map_err(|_error| bad())?;
            let end = n_sparse.checked_mul(width).and_then(|n| n.checked_add(from));
            end.and_then(|end| self.view(view).ok()?.get(from..end)).ok_or_else(bad)
        };
        let indices = &sparse.indices;
        let places = part(indices.buffer_view.value(), indices.byte_offset.0, width)?;
        let values = &sparse.values;
        let element = raw.n * raw.size;
        let elements = part(values.buffer_view.value(), values.byte_offset.0, element)?;
        for (place, element) in places.chunks_exact(width).zip(elements.chunks_exact(element)) {
            let mut wide = [0; 4];
            wide[..width.min(4)].copy_from_slice(&place[..width.min(4)]);
            let at = u32::from_le_bytes(wide) as usize;
            if at >= raw.count {
                return Err(bad());
            }
            set(at, element);
        }
        Ok(())
    }
}

/// Where an accessor's elements are.
struct Raw<'a> {
    /// From the first element to the end of the last; `None` for zeros.
    bytes: Option<&'a [u8]>,
    count: usize,
    n: usize,
    size: usize,
    stride: usize,
    component: ComponentType,
}

impl Raw<'_> {
    fn elements(&self) -> impl Iterator<Item = &[u8]> {
        const ZEROS: [u8; 64] = [0; 64];
        let width = self.n * self.size;
        (0..self.count).map(move |at| match self.bytes {
            Some(bytes) => &bytes[at * self.stride..at * self.stride + width],
            None => &ZEROS[..width],
        })
    }
}

fn number(bytes: &[u8], component: ComponentType, normalized: bool) -> f32 {
    let (value, most) = match (component, bytes) {
        (ComponentType::I8, &[a]) => (f32::from(a as i8), 127.0),
        (ComponentType::U8, &[a]) => (f32::from(a), 255.0),
        (ComponentType::I16, &[a, b]) => (f32::from(i16::from_le_bytes([a, b])), 32767.0),
        (ComponentType::U16, &[a, b]) => (f32::from(u16::from_le_bytes([a, b])), 65535.0),
        (ComponentType::U32, &[a, b, c, d]) => {
            (u32::from_le_bytes([a, b, c, d]) as f32, u32::MAX as f32)
        }
        (_, &[a, b, c, d]) => return f32::from_le_bytes([a, b, c, d]),
        _ => return f32::NAN,
    };
    if normalized { (value / most).max(-1.0) } else { value }
}
