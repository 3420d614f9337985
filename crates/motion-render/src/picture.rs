//! A finished picture in memory.

/// Opaque pixels, sRGB, row after row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// `4 · width · height` bytes: red, green, blue, 255.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// The pixel in column `x`, row `y`; `None` outside.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        if x >= self.width_px || y >= self.height_px {
            return None;
        }
        let at = 4 * (y as usize * self.width_px as usize + x as usize);
        self.rgba.get(at..at + 4)?.try_into().ok()
    }
}
