//! Pictures put together.

use motion_render::picture::Picture;

/// A place on a picture, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rect {
    pub(crate) left: u32,
    pub(crate) top: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// An empty picture of one colour.
pub(crate) fn canvas(width: u32, height: u32, color: [u8; 4]) -> Picture {
    let n_pixels = width as usize * height as usize;
    Picture { width_px: width, height_px: height, rgba: color.repeat(n_pixels) }
}

/// Puts `picture` on `canvas`; what hangs over is cut off.
pub(crate) fn place(canvas: &mut Picture, picture: &Picture, at: Rect) {
    let width = at.width.min(picture.width_px).min(canvas.width_px.saturating_sub(at.left));
    let height = at.height.min(picture.height_px).min(canvas.height_px.saturating_sub(at.top));
    let row_bytes = 4 * width as usize;
    for y in 0..height {
        let to = 4 * ((at.top + y) as usize * canvas.width_px as usize + at.left as usize);
        let from = 4 * y as usize * picture.width_px as usize;
        canvas.rgba[to..to + row_bytes].copy_from_slice(&picture.rgba[from..from + row_bytes]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_placed_and_cut_off() {
        let mut whole = canvas(4, 3, [1, 1, 1, 255]);
        let part = canvas(3, 2, [9, 9, 9, 255]);
        place(&mut whole, &part, Rect { left: 2, top: 1, width: 3, height: 2 });
        place(&mut whole, &part, Rect { left: 9, top: 9, width: 3, height: 2 });
        let reds: Vec<u8> = whole.rgba.iter().step_by(4).copied().collect();
        assert_eq!(reds, [1, 1, 1, 1, 1, 1, 9, 9, 1, 1, 9, 9]);
    }
}
