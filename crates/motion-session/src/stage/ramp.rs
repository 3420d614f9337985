//! Colours that say when.

use motion_scene::color::{LinearRgba, Theme};

/// From early to late: dark violet over rose to yellow, evenly brighter, so that the order also
/// reads without colours; on a light ground the other way round in lightness.
const EARLY_TO_LATE: [u32; 5] = [0x6C6FD9, 0xA46BC4, 0xDC7590, 0xEF9F5B, 0xF3D560];

/// The colour of a moment, `share` (0 to 1) of the way from the first frame to the last.
pub fn time_color(share: f32, theme: Theme) -> LinearRgba {
    let stops = EARLY_TO_LATE.map(LinearRgba::from_srgb_hex);
    let at = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) } * (stops.len() - 1) as f32;
    let a = (at as usize).min(stops.len() - 2);
    let color = stops[a].mixed(stops[a + 1], at - a as f32);
    match theme {
        Theme::Dark => color,
        // The same hues with less light stand out from a bright floor.
        Theme::Light => color.mixed(LinearRgba([0.0, 0.0, 0.0, 1.0]), 0.25),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_is_brighter() {
        let light = |share| {
            let LinearRgba([r, g, b, _]) = time_color(share, Theme::Dark);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for step in 0..20 {
            let share = step as f32 / 20.0;
            assert!(light(share) < light(share + 0.05), "at {share}");
        }
        assert_eq!(time_color(-3.0, Theme::Dark), time_color(0.0, Theme::Dark));
        assert_eq!(time_color(f32::NAN, Theme::Dark), time_color(0.0, Theme::Dark));
    }
}
