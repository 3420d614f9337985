//! Letters as they were drawn once, side by side on one texture.

use std::collections::BTreeMap;

use ab_glyph::{Font as _, FontRef, PxScale, ScaleFont as _};

use crate::gpu::Gpu;

static INTER: &[u8] = include_bytes!("../../../assets/fonts/Inter-Medium.ttf");

/// Columns and rows of the atlas.
const ATLAS_PX: u32 = 1024;
/// Letters are drawn in this range of heights, pixels.
const SIZE_PX: std::ops::RangeInclusive<u32> = 6..=160;
/// Free texels around each letter.
const GAP_PX: u32 = 1;

/// A letter on the atlas.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Glyph {
    /// Upper left corner and size on the atlas, texels; nothing for a space.
    source: Option<[u32; 4]>,
    /// From the pen's place on the baseline to the upper left corner, pixels.
    offset: [f32; 2],
    /// How far the pen goes on, pixels.
    advance: f32,
}

/// A letter in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlacedGlyph {
    /// Upper left corner from the upper left corner of the words, pixels.
    pub(crate) at: [f32; 2],
    /// Upper left corner and size on the atlas, texels.
    pub(crate) source: [u32; 4],
}

/// Words, laid out.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Words {
    pub(crate) glyphs: Vec<PlacedGlyph>,
    pub(crate) width_px: f32,
    pub(crate) height_px: f32,
}

/// Letters drawn so far, by character and height.
#[derive(Debug)]
pub(crate) struct GlyphAtlas {
    /// `None` if the font cannot be read, which a test rules out; then there are no words.
    font: Option<FontRef<'static>>,
    glyphs: BTreeMap<(char, u32), Glyph>,
    coverage: Vec<u8>,
    /// Where the next letter goes, and how high this row is.
    pen: [u32; 2],
    row_px: u32,
    is_changed: bool,
    texture: wgpu::Texture,
}

impl GlyphAtlas {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let texture = gpu.create_texture(&wgpu::TextureDescriptor {
            label: Some("letters"),
            size: wgpu::Extent3d { width: ATLAS_PX, height: ATLAS_PX, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        Self {
            font: FontRef::try_from_slice(INTER).ok(),
            glyphs: BTreeMap::new(),
            coverage: vec![0; (ATLAS_PX * ATLAS_PX) as usize],
            pen: [0, 0],
            row_px: 0,
            is_changed: false,
            texture,
        }
    }

    pub(crate) fn view(&self) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor::default())
    }

    /// Forgets all letters if the atlas is nearly full; to be called between pictures.
    pub(crate) fn make_room(&mut self) {
        if self.pen[1] > ATLAS_PX / 4 * 3 {
            self.glyphs.clear();
            self.coverage.fill(0);
            self.pen = [0, 0];
            self.row_px = 0;
        }
    }

    /// Lays out one line of words, `size_px` from ascent to descent.
    pub(crate) fn lay_out(&mut self, text: &str, size_px: f32) -> Words {
        let size = (size_px.round() as u32).clamp(*SIZE_PX.start(), *SIZE_PX.end());
        let Some(font) = self.font.clone() else { return Words::default() };
        let scaled = font.as_scaled(PxScale::from(size as f32));
        let baseline = scaled.ascent().round();
        let mut words = Words { height_px: scaled.height().ceil(), ..Words::default() };
        let mut pen = 0.0_f32;
        let mut last = None;
        for letter in text.chars().filter(|c| !c.is_control()) {
            let id = font.glyph_id(letter);
            if let Some(last) = last {
                pen += scaled.kern(last, id);
            }
            last = Some(id);
            let glyph = self.glyph(&font, letter, size);
            if let Some(source) = glyph.source {
                let at = [(pen + glyph.offset[0]).round(), baseline + glyph.offset[1]];
                words.glyphs.push(PlacedGlyph { at, source });
            }
            pen += glyph.advance;
        }
        words.width_px = pen.ceil();
        words
    }

    /// Brings new letters to the device.
    pub(crate) fn upload(&mut self, gpu: &Gpu) {
        if !std::mem::take(&mut self.is_changed) {
            return;
        }
        gpu.queue().write_texture(
            self.texture.as_image_copy(),
            &self.coverage,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(ATLAS_PX),
                rows_per_image: None,
            },
            self.texture.size(),
        );
    }

    fn glyph(&mut self, font: &FontRef<'static>, letter: char, size: u32) -> Glyph {
        if let Some(&known) = self.glyphs.get(&(letter, size)) {
            return known;
        }
        let scale = PxScale::from(size as f32);
        let id = font.glyph_id(letter);
        let mut glyph =
            Glyph { source: None, offset: [0.0; 2], advance: font.as_scaled(scale).h_advance(id) };
        if let Some(outline) = font.outline_glyph(id.with_scale(scale)) {
            let bounds = outline.px_bounds();
            glyph.offset = [bounds.min.x, bounds.min.y];
            let (width, height) = (bounds.width() as u32, bounds.height() as u32);
            if let Some([x0, y0]) = self.place(width, height) {
                outline.draw(|x, y, coverage| {
                    let at = ((y0 + y) * ATLAS_PX + x0 + x) as usize;
                    self.coverage[at] = (coverage.clamp(0.0, 1.0) * 255.0).round() as u8;
                });
                self.is_changed = true;
                glyph.source = Some([x0, y0, width, height]);
            }
        }
        self.glyphs.insert((letter, size), glyph);
        glyph
    }

    /// A free place on the atlas; `None` when it is full.
    fn place(&mut self, width: u32, height: u32) -> Option<[u32; 2]> {
        if self.pen[0] + width + GAP_PX > ATLAS_PX {
            self.pen = [0, self.pen[1] + self.row_px];
            self.row_px = 0;
        }
        if width + GAP_PX > ATLAS_PX || self.pen[1] + height + GAP_PX > ATLAS_PX {
            return None;
        }
        let place = self.pen;
        self.pen[0] += width + GAP_PX;
        self.row_px = self.row_px.max(height + GAP_PX);
        Some(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_can_be_read_and_has_what_labels_say() {
        let font = FontRef::try_from_slice(INTER).unwrap();
        for letter in "0123456789 ·−°µ→×✓abcXYZäöüéß%:,.()/".chars().filter(|&c| c != ' ')
        {
            assert_ne!(font.glyph_id(letter).0, 0, "{letter:?} is not in the font");
        }
    }
}
