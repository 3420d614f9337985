//! What identifies a file's content.

use std::fmt;

/// The BLAKE3 hash of a file's bytes; prints as 64 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ContentHash(pub [u8; 32]);

impl ContentHash {
    /// The hash of `bytes`.
    pub fn of(bytes: &[u8]) -> Self {
        Self(*blake3::hash(bytes).as_bytes())
    }
}

impl fmt::Display for ContentHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_prints_as_hexadecimal() {
        let text = ContentHash::of(b"").to_string();
        assert_eq!(&text[..8], "af1349b9", "BLAKE3 of nothing, as published");
        assert_eq!(text.len(), 64);
    }
}
