//! Smaller copies of textures, for surfaces far away.

use motion_scene::color::{linear_from_srgb, srgb_from_linear};
use motion_scene::mesh::Texture;

/// The texture and its halves down to one texel. Each texel is the mean, in light, of those it
/// stands for; transparent ones count by their alpha.
///
/// A texture whose bytes are fewer than its size says, or that has no size, becomes one white
/// texel.
pub(crate) fn mip_levels(texture: &Texture) -> Vec<Texture> {
    let n_texels = u64::from(texture.width) * u64::from(texture.height);
    if n_texels == 0 || n_texels.saturating_mul(4) != texture.rgba.len() as u64 {
        return vec![Texture { width: 1, height: 1, rgba: vec![255; 4] }];
    }
    let to_light: Vec<f32> =
        (0..=255_u8).map(|byte| linear_from_srgb(f32::from(byte) / 255.0)).collect();
    let mut levels = vec![texture.clone()];
    while let Some(last) = levels.last()
        && last.width.max(last.height) > 1
    {
        let smaller = half(last, &to_light);
        levels.push(smaller);
    }
    levels
}

fn half(texture: &Texture, to_light: &[f32]) -> Texture {
    let width = (texture.width / 2).max(1);
    let height = (texture.height / 2).max(1);
    let mut rgba = Vec::with_capacity(4 * (width * height) as usize);
    for y in 0..height {
        for x in 0..width {
            rgba.extend(mean_of_four(texture, 2 * x, 2 * y, to_light));
        }
    }
    Texture { width, height, rgba }
}

fn mean_of_four(texture: &Texture, x: u32, y: u32, to_light: &[f32]) -> [u8; 4] {
    let mut light = [0.0_f32; 3];
    let mut alpha = 0.0_f32;
    for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        let x = (x + dx).min(texture.width - 1);
        let y = (y + dy).min(texture.height - 1);
        let at = 4 * (y as usize * texture.width as usize + x as usize);
        // Never quite nothing, so that all-transparent texels keep their colour.
        let weight = f32::from(texture.rgba[at + 3]) + 1e-3;
        alpha += weight;
        for (channel, sum) in light.iter_mut().enumerate() {
            *sum += to_light[usize::from(texture.rgba[at + channel])] * weight;
        }
    }
    let byte = |x: f32| (x.clamp(0.0, 1.0) * 255.0).round() as u8;
    let [r, g, b] = light.map(|sum| byte(srgb_from_linear(sum / alpha)));
    [r, g, b, (0.25 * alpha).round().min(255.0) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(width: u32, height: u32, rgba: Vec<u8>) -> Texture {
        Texture { width, height, rgba }
    }

    #[test]
    fn halves_down_to_one() {
        let levels = mip_levels(&texture(8, 3, vec![200; 96]));
        let sizes: Vec<_> = levels.iter().map(|level| (level.width, level.height)).collect();
        assert_eq!(sizes, [(8, 3), (4, 1), (2, 1), (1, 1)]);
        assert!(levels.iter().all(|level| level.rgba.iter().all(|&byte| byte == 200)));
    }

    #[test]
    fn means_are_of_light() {
        // Half black, half white is 188 in sRGB, not 128.
        let rgba = [[0, 0, 0, 255], [255; 4], [255; 4], [0, 0, 0, 255]].concat();
        assert_eq!(mip_levels(&texture(2, 2, rgba))[1].rgba, [188, 188, 188, 255]);
    }

    #[test]
    fn transparent_texels_do_not_bleed() {
        let rgba = [[255, 0, 0, 255], [0, 255, 0, 0], [0, 255, 0, 0], [255, 0, 0, 255]].concat();
        let [r, g, _, a] = mip_levels(&texture(2, 2, rgba))[1].rgba[..] else { panic!("a texel") };
        assert!(r > 250 && g < 5 && (a == 127 || a == 128), "{r} {g} {a}");
    }

    #[test]
    fn wrong_sizes_become_white() {
        assert_eq!(mip_levels(&texture(2, 2, vec![0; 3])).len(), 1);
        assert_eq!(mip_levels(&texture(0, 5, Vec::new()))[0].rgba, [255; 4]);
        assert_eq!(mip_levels(&texture(u32::MAX, u32::MAX, vec![1])).len(), 1);
    }
}
