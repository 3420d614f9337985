//! Films as GIF: one palette for all pictures, and of every picture only what has changed.

use std::io::Write;

use gif::{DisposalMethod, Encoder, Frame, Repeat};
use motion_render::picture::Picture;

use super::delays::delay_cs;
use super::palette::{Palette, TRANSPARENT};

/// A GIF that is being written.
pub(crate) struct GifFilm<W: Write> {
    encoder: Encoder<W>,
    palette: Palette,
    width: u16,
    height: u16,
    fps: f64,
    n_pictures: usize,
    /// What a viewer shows after the last picture.
    shown: Vec<u8>,
    /// The next picture, kept for its memory.
    indices: Vec<u8>,
}

impl<W: Write> GifFilm<W> {
    /// Begins a film that repeats for ever.
    pub(crate) fn new(
        out: W,
        width: u16,
        height: u16,
        fps: f64,
        palette: Palette,
    ) -> Result<Self, gif::EncodingError> {
        let mut encoder = Encoder::new(out, width, height, &palette.bytes())?;
        encoder.set_repeat(Repeat::Infinite)?;
        let n_pixels = usize::from(width) * usize::from(height);
        Ok(Self {
            encoder,
            palette,
            width,
            height,
            fps,
            n_pictures: 0,
            // Nothing is shown yet, so that everything in the first picture has changed.
            shown: vec![TRANSPARENT; n_pixels],
            indices: Vec::with_capacity(n_pixels),
        })
    }

    /// Adds a picture, which must have the film's size.
    pub(crate) fn add(&mut self, picture: &Picture) -> Result<(), gif::EncodingError> {
        debug_assert_eq!(picture.rgba.len(), 4 * self.shown.len(), "a picture of another size");
        self.indices.clear();
        let palette = &mut self.palette;
        let pixels = picture.rgba.chunks_exact(4);
        self.indices.extend(pixels.map(|p| palette.index([p[0], p[1], p[2]])));
        let mut frame = changes(&self.shown, &self.indices, usize::from(self.width));
        frame.delay = delay_cs(self.n_pictures, self.fps);
        self.encoder.write_frame(&frame)?;
        std::mem::swap(&mut self.shown, &mut self.indices);
        self.n_pictures += 1;
        Ok(())
    }

    /// Ends the film.
    pub(crate) fn finish(self) -> Result<W, gif::EncodingError> {
        debug_assert!(self.height > 0, "a film has a size");
        self.encoder.into_inner()
    }
}

/// The smallest rectangle that holds what differs, with what does not left transparent: long runs of
/// it compress to nearly nothing. Where nothing differs, one transparent pixel.
fn changes(before: &[u8], after: &[u8], width: usize) -> Frame<'static> {
    let rows = before.chunks_exact(width).zip(after.chunks_exact(width));
    let (mut left, mut right, mut top, mut bottom) = (width, 0, usize::MAX, 0);
    for (y, (old, new)) in rows.enumerate() {
        let differs = |x: &usize| old[*x] != new[*x];
        let Some(first) = (0..width).find(differs) else { continue };
        let last = (0..width).rev().find(differs).unwrap_or(first);
        left = left.min(first);
        right = right.max(last + 1);
        top = top.min(y);
        bottom = y + 1;
    }
    if top == usize::MAX {
        (left, right, top, bottom) = (0, 1, 0, 1);
    }
    let mut buffer = Vec::with_capacity((right - left) * (bottom - top));
    for y in top..bottom {
        let row = y * width + left..y * width + right;
        let pairs = before[row.clone()].iter().zip(&after[row]);
        buffer.extend(pairs.map(|(old, new)| if old == new { TRANSPARENT } else { *new }));
    }
    // No picture is larger than the film, whose sides fit.
    Frame {
        left: left as u16,
        top: top as u16,
        width: (right - left) as u16,
        height: (bottom - top) as u16,
        transparent: Some(TRANSPARENT),
        dispose: DisposalMethod::Keep,
        buffer: buffer.into(),
        ..Frame::default()
    }
}

#[cfg(test)]
mod tests {
    use gif::{ColorOutput, DecodeOptions};

    use super::*;

    fn picture(width: u32, pixels: &[[u8; 3]]) -> Picture {
        let rgba = pixels.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect();
        Picture { width_px: width, height_px: pixels.len() as u32 / width, rgba }
    }

    #[test]
    fn only_changes_are_written_and_all_pictures_come_back() {
        let (gray, red, blue) = ([90, 90, 90], [220, 30, 20], [20, 40, 200]);
        let mut pixels = vec![gray; 12 * 7];
        let mut pictures = vec![picture(12, &pixels)];
        for (at, color) in [(30, red), (31, red), (44, blue), (30, gray)] {
            pixels[at] = color;
            pictures.push(picture(12, &pixels));
        }
        pictures.push(picture(12, &pixels));
        let palette = Palette::of_pictures(&pictures);
        let mut film = GifFilm::new(Vec::new(), 12, 7, 30.0, palette).unwrap();
        for picture in &pictures {
            film.add(picture).unwrap();
        }
        let bytes = film.finish().unwrap();

        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::RGBA);
        let mut decoder = options.read_info(bytes.as_slice()).unwrap();
        let mut screen = vec![0; 12 * 7 * 4];
        let mut n_frames = 0;
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            assert_eq!(frame.delay, [3, 3, 4][n_frames % 3]);
            let (width, height) = (usize::from(frame.width), usize::from(frame.height));
            assert!(n_frames == 0 || width * height <= 2, "frame {n_frames}: {width} × {height}");
            for y in 0..height {
                for x in 0..width {
                    let pixel = &frame.buffer[4 * (y * width + x)..][..4];
                    let at = (usize::from(frame.top) + y) * 12 + usize::from(frame.left) + x;
                    if pixel[3] > 0 {
                        screen[4 * at..4 * at + 4].copy_from_slice(pixel);
                    }
                }
            }
            let wanted = &pictures[n_frames].rgba;
            assert!(
                screen.iter().zip(wanted).all(|(a, b)| a.abs_diff(*b) <= 1),
                "frame {n_frames}"
            );
            n_frames += 1;
        }
        assert_eq!(n_frames, pictures.len());
    }
}
