//! Little-endian numbers and slices in and out of bytes, with every length checked.

use std::fmt;

/// What is wrong with bytes that were to be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// They end too early.
    End,
    /// A length is larger than what is there.
    Length,
    /// So many bytes are left that nobody reads.
    LeftOver(usize),
    /// A text is not UTF-8.
    Text,
    /// The checksum of something is wrong.
    Checksum(String),
    /// A value that cannot be; the text names it.
    Value(&'static str),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::End => f.write_str("it ends too early"),
            Self::Length => f.write_str("a length is larger than the file"),
            Self::LeftOver(n) => write!(f, "{n} bytes are left over"),
            Self::Text => f.write_str("a text is not UTF-8"),
            Self::Checksum(of) => write!(f, "the checksum of {of} is wrong"),
            Self::Value(name) => write!(f, "the {name} cannot be"),
        }
    }
}

impl std::error::Error for Fault {}

/// Appends numbers to bytes.
#[derive(Clone, Debug, Default)]
pub struct ByteWriter {
    bytes: Vec<u8>,
}

/// Reads what a [`ByteWriter`] wrote.
#[derive(Clone, Debug)]
pub struct ByteReader<'a> {
    bytes: &'a [u8],
}

macro_rules! numbers {
    ($($type:ident, $slice:ident, $vec:ident;)*) => {
        impl ByteWriter {
            $(
                #[doc = concat!("Appends a `", stringify!($type), "`.")]
                pub fn $type(&mut self, value: $type) {
                    self.bytes.extend_from_slice(&value.to_le_bytes());
                }

                #[doc = concat!("Appends the length (`u64`) and the elements of a `[",
                    stringify!($type), "]`.")]
                pub fn $slice(&mut self, values: &[$type]) {
                    self.u64(values.len() as u64);
                    self.bytes.reserve(std::mem::size_of_val(values));
                    for value in values {
                        self.bytes.extend_from_slice(&value.to_le_bytes());
                    }
                }
            )*
        }

        impl ByteReader<'_> {
            $(
                #[doc = concat!("The next `", stringify!($type), "`.")]
                pub fn $type(&mut self) -> Result<$type, Fault> {
                    let (bytes, rest) = self.bytes.split_first_chunk().ok_or(Fault::End)?;
                    self.bytes = rest;
                    Ok($type::from_le_bytes(*bytes))
                }

                #[doc = concat!("The next length and so many `", stringify!($type), "`.")]
                pub fn $vec(&mut self) -> Result<Vec<$type>, Fault> {
                    const SIZE: usize = size_of::<$type>();
                    let len = usize::try_from(self.u64()?).or(Err(Fault::Length))?;
                    let n_bytes = len.checked_mul(SIZE).ok_or(Fault::Length)?;
                    if n_bytes > self.bytes.len() {
                        return Err(Fault::Length);
                    }
                    let (elements, _) = self.raw(n_bytes)?.as_chunks::<SIZE>();
                    Ok(elements.iter().map(|bytes| $type::from_le_bytes(*bytes)).collect())
                }
            )*
        }
    };
}

numbers! {
    u8, u8_slice, u8_vec;
    u16, u16_slice, u16_vec;
    u32, u32_slice, u32_vec;
    u64, u64_slice, u64_vec;
    i32, i32_slice, i32_vec;
    f32, f32_slice, f32_vec;
    f64, f64_slice, f64_vec;
}

impl ByteWriter {
    /// No bytes yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// No bytes yet, with room for `n_bytes`.
    pub fn with_capacity(n_bytes: usize) -> Self {
        Self { bytes: Vec::with_capacity(n_bytes) }
    }

    /// Appends bytes as they are.
    pub fn raw(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// Appends the length (`u32`) and the bytes of a text of less than 4 GiB.
    pub fn str(&mut self, text: &str) {
        debug_assert!(u32::try_from(text.len()).is_ok(), "a text of {} bytes", text.len());
        self.u32(text.len() as u32);
        self.raw(text.as_bytes());
    }

    /// Appends the number of texts (`u32`) and each text.
    pub fn strs<S: AsRef<str>>(&mut self, texts: &[S]) {
        self.u32(texts.len() as u32);
        for text in texts {
            self.str(text.as_ref());
        }
    }

    /// What was written.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}

impl<'a> ByteReader<'a> {
    /// The start of `bytes`.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    /// The bytes that are left, without taking them.
    pub fn rest(&self) -> &'a [u8] {
        self.bytes
    }

    /// The next `len` bytes as they are.
    pub fn raw(&mut self, len: usize) -> Result<&'a [u8], Fault> {
        let (bytes, rest) = self.bytes.split_at_checked(len).ok_or(Fault::End)?;
        self.bytes = rest;
        Ok(bytes)
    }

    /// The next text.
    pub fn str(&mut self) -> Result<&'a str, Fault> {
        let len = self.u32()? as usize;
        if len > self.bytes.len() {
            return Err(Fault::Length);
        }
        std::str::from_utf8(self.raw(len)?).or(Err(Fault::Text))
    }

    /// The next number of texts and each text.
    pub fn strs(&mut self) -> Result<Vec<String>, Fault> {
        let len = self.u32()? as usize;
        // Every text takes the four bytes of its length at least.
        if len.saturating_mul(4) > self.bytes.len() {
            return Err(Fault::Length);
        }
        (0..len).map(|_| self.str().map(str::to_owned)).collect()
    }

    /// Fails where bytes are left.
    pub fn finish(&self) -> Result<(), Fault> {
        match self.bytes.len() {
            0 => Ok(()),
            n => Err(Fault::LeftOver(n)),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn what_is_written_is_read(
            a in any::<u16>(), b in any::<f32>(), text in ".{0,20}",
            list in prop::collection::vec(any::<u32>(), 0..20),
            texts in prop::collection::vec(".{0,5}", 0..5),
        ) {
            let mut writer = ByteWriter::new();
            writer.u16(a);
            writer.f32(b);
            writer.str(&text);
            writer.u32_slice(&list);
            writer.strs(&texts);
            let bytes = writer.into_bytes();
            let mut reader = ByteReader::new(&bytes);
            prop_assert_eq!(reader.u16(), Ok(a));
            prop_assert_eq!(reader.f32().map(f32::to_bits), Ok(b.to_bits()));
            prop_assert_eq!(reader.str(), Ok(&text[..]));
            prop_assert_eq!(reader.u32_vec(), Ok(list));
            prop_assert_eq!(reader.strs(), Ok(texts));
            prop_assert_eq!(reader.finish(), Ok(()));
        }
    }

    #[test]
    fn lengths_are_not_believed() {
        let huge = u64::MAX.to_le_bytes();
        assert_eq!(ByteReader::new(&huge).u16_vec(), Err(Fault::Length));
        assert_eq!(ByteReader::new(&huge).u8_vec(), Err(Fault::Length));
        assert_eq!(ByteReader::new(&huge).str(), Err(Fault::Length));
        assert_eq!(ByteReader::new(&huge).strs(), Err(Fault::Length));
        assert_eq!(ByteReader::new(&huge).raw(9), Err(Fault::End));
        assert_eq!(ByteReader::new(&[1]).u32(), Err(Fault::End));
    }

    #[test]
    fn numbers_are_little_endian() {
        let mut writer = ByteWriter::new();
        writer.u32(0x0403_0201);
        assert_eq!(writer.into_bytes(), [1, 2, 3, 4]);
    }
}
