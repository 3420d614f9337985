//! Pictures as PNG.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _};
use motion_render::picture::Picture;

/// The file of a picture, without its alpha, which is full everywhere.
pub(crate) fn png(picture: &Picture) -> anyhow::Result<Vec<u8>> {
    let rgb: Vec<u8> = picture.rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive)
        .write_image(&rgb, picture.width_px, picture.height_px, ExtendedColorType::Rgb8)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_come_back() {
        let rgba: Vec<u8> =
            (0..4 * 6 * 5).map(|i| if i % 4 == 3 { 255 } else { i as u8 }).collect();
        let picture = Picture { width_px: 6, height_px: 5, rgba: rgba.clone() };
        let decoded = image::load_from_memory(&png(&picture).unwrap()).unwrap();
        assert_eq!((decoded.width(), decoded.height()), (6, 5));
        assert_eq!(decoded.to_rgba8().into_raw(), rgba);
    }
}
