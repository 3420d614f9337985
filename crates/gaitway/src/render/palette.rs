//! The 255 colours of a GIF, chosen once for all of its pictures, so that nothing flickers.

use motion_render::picture::Picture;

/// What is not drawn: the picture before shows through.
pub(crate) const TRANSPARENT: u8 = 0;
/// Colours beside the transparent one.
const N_COLORS: usize = 255;
/// Rounds in which colours move to the middle of what they stand for.
const N_ROUNDS: usize = 6;
/// At most so many pixels are looked at.
const MAX_SAMPLES: usize = 4_000_000;
/// What small things count against large ones: a marker must not lose its colour to the floor.
const COUNT_POWER: f32 = 0.55;
/// How much differences of red, green and blue are seen.
const SEEN: [f32; 3] = [1.0, 1.25, 0.75];

/// Colours, and which of them is nearest to a given one.
pub(crate) struct Palette {
    colors: Vec<[u8; 3]>,
    /// The nearest colour's index by `0xRRGGBB`; [`TRANSPARENT`] where nobody has asked yet.
    nearest: Vec<u8>,
}

/// A colour of the samples.
#[derive(Clone, Copy)]
struct Sample {
    at: [f32; 3],
    weight: f32,
}

impl Palette {
    /// The colours that stand for those of `pictures` best.
    pub(crate) fn of_pictures(pictures: &[Picture]) -> Self {
        let mut samples = samples(pictures);
        let mut colors = cut(&mut samples);
        for _ in 0..N_ROUNDS {
            move_to_middles(&mut colors, &samples);
        }
        let mut colors: Vec<[u8; 3]> = colors.iter().map(|c| unseen(*c)).collect();
        colors.sort_unstable();
        colors.dedup();
        Self { colors, nearest: vec![TRANSPARENT; 1 << 24] }
    }

    /// Red, green and blue of every index, the transparent one first.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        [[0; 3]].iter().chain(&self.colors).flatten().copied().collect()
    }

    /// The index of the colour nearest to this one.
    pub(crate) fn index(&mut self, [r, g, b]: [u8; 3]) -> u8 {
        let key = usize::from(r) << 16 | usize::from(g) << 8 | usize::from(b);
        if self.nearest[key] == TRANSPARENT {
            let wanted = seen([r, g, b]);
            let distance = |c: &[u8; 3]| distance_squared(seen(*c), wanted);
            let nearest = (0..self.colors.len())
                .min_by(|&a, &b| distance(&self.colors[a]).total_cmp(&distance(&self.colors[b])));
            // There are at most 255, so that one more fits into a byte.
            self.nearest[key] = nearest.unwrap_or_default() as u8 + 1;
        }
        self.nearest[key]
    }
}

fn seen(color: [u8; 3]) -> [f32; 3] {
    std::array::from_fn(|i| f32::from(color[i]) * SEEN[i])
}

fn unseen(at: [f32; 3]) -> [u8; 3] {
    std::array::from_fn(|i| (at[i] / SEEN[i]).round().clamp(0.0, 255.0) as u8)
}

fn distance_squared(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [x, y, z] = std::array::from_fn(|i| a[i] - b[i]);
    x * x + y * y + z * z
}

/// The distinct colours, to half their depth, with weights by how often they are there.
fn samples(pictures: &[Picture]) -> Vec<Sample> {
    let n_pixels: usize = pictures.iter().map(|picture| picture.rgba.len() / 4).sum();
    let step = n_pixels.div_ceil(MAX_SAMPLES).max(1);
    let pixels = pictures.iter().flat_map(|picture| picture.rgba.chunks_exact(4).step_by(step));
    let mut keys: Vec<u32> =
        pixels.map(|p| u32::from_be_bytes([0, p[0] & !1, p[1] & !1, p[2] & !1])).collect();
    keys.sort_unstable();
    keys.chunk_by(|a, b| a == b)
        .map(|same| {
            let [_, r, g, b] = same[0].to_be_bytes();
            // The middle of the two depths that were taken for one.
            let at = std::array::from_fn(|i| (f32::from([r, g, b][i]) + 0.5) * SEEN[i]);
            Sample { at, weight: (same.len() as f32).powf(COUNT_POWER) }
        })
        .collect()
}

/// A box of the median cut: some of the samples, and how much they differ.
struct Cell {
    from: usize,
    to: usize,
    axis: usize,
    mean: [f32; 3],
    /// Weighted squared distance from the mean along the axis on which it is greatest.
    spread: f32,
}

impl Cell {
    fn new(samples: &[Sample], from: usize, to: usize) -> Self {
        let inside = &samples[from..to];
        let weight: f32 = inside.iter().map(|s| s.weight).sum::<f32>().max(f32::MIN_POSITIVE);
        let mean: [f32; 3] = std::array::from_fn(|i| {
            inside.iter().map(|s| s.weight * s.at[i]).sum::<f32>() / weight
        });
        let spreads: [f32; 3] = std::array::from_fn(|i| {
            inside.iter().map(|s| s.weight * (s.at[i] - mean[i]).powi(2)).sum()
        });
        let axis = (0..3).max_by(|&a, &b| spreads[a].total_cmp(&spreads[b])).unwrap_or_default();
        // The mean of one sample may differ from it by rounding; there is nothing to cut all the same.
        let spread = if to - from > 1 { spreads[axis] } else { 0.0 };
        Self { from, to, axis, mean, spread }
    }
}

/// Colours by cutting, again and again, the box with the greatest spread at its mean.
fn cut(samples: &mut [Sample]) -> Vec<[f32; 3]> {
    let mut cells = vec![Cell::new(samples, 0, samples.len())];
    while cells.len() < N_COLORS {
        let widest = (0..cells.len()).max_by(|&a, &b| cells[a].spread.total_cmp(&cells[b].spread));
        let Some(widest) = widest.filter(|&nth| cells[nth].spread > 0.0) else { break };
        let Cell { from, to, axis, mean, .. } = cells[widest];
        samples[from..to].sort_unstable_by(|a, b| a.at[axis].total_cmp(&b.at[axis]));
        let low = samples[from..to].partition_point(|s| s.at[axis] < mean[axis]);
        // Rounding can bring the mean to the edge of its box.
        let middle = from + low.clamp(1, to - from - 1);
        cells[widest] = Cell::new(samples, from, middle);
        cells.push(Cell::new(samples, middle, to));
    }
    cells.into_iter().map(|cell| cell.mean).collect()
}

/// One round of k-means: every colour moves to the weighted middle of the samples nearest to it.
fn move_to_middles(colors: &mut [[f32; 3]], samples: &[Sample]) {
    // By their brightness, so that the search can stop where all others are further away.
    colors.sort_unstable_by(|a, b| a[1].total_cmp(&b[1]));
    let mut sums = vec![([0.0f64; 3], 0.0f64); colors.len()];
    for sample in samples {
        let nearest = nearest_sorted(colors, sample.at);
        let (sum, weight) = &mut sums[nearest];
        for (sum, at) in sum.iter_mut().zip(sample.at) {
            *sum += f64::from(sample.weight * at);
        }
        *weight += f64::from(sample.weight);
    }
    for (color, (sum, weight)) in colors.iter_mut().zip(sums) {
        if weight > 0.0 {
            *color = std::array::from_fn(|i| (sum[i] / weight) as f32);
        }
    }
}

/// The nearest of colours that are sorted by their second coordinate.
fn nearest_sorted(colors: &[[f32; 3]], at: [f32; 3]) -> usize {
    let middle = colors.partition_point(|color| color[1] < at[1]);
    let (mut best, mut best_distance) = (0, f32::INFINITY);
    let mut look = |nth: usize| {
        let apart = colors[nth][1] - at[1];
        let distance = distance_squared(colors[nth], at);
        if distance < best_distance {
            (best, best_distance) = (nth, distance);
        }
        apart * apart < best_distance
    };
    let _ = (middle..colors.len()).all(&mut look);
    let _ = (0..middle).rev().all(&mut look);
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(pixels: &[[u8; 3]]) -> Picture {
        let rgba = pixels.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect();
        Picture { width_px: pixels.len() as u32, height_px: 1, rgba }
    }

    #[test]
    fn few_colors_are_all_kept() {
        let pixels = [[10, 20, 30], [200, 100, 50], [0, 0, 0], [255, 255, 255]];
        let mut palette = Palette::of_pictures(&[picture(&pixels)]);
        let bytes = palette.bytes();
        for pixel in pixels {
            let index = usize::from(palette.index(pixel));
            assert_ne!(index, usize::from(TRANSPARENT));
            let found = &bytes[3 * index..3 * index + 3];
            let off = found.iter().zip(pixel).map(|(a, b)| a.abs_diff(b)).max();
            assert!(off <= Some(1), "{pixel:?} became {found:?}");
        }
    }

    #[test]
    fn a_small_thing_keeps_its_color_beside_a_large_gradient() {
        let gradient = (0..60_000u32).map(|i| [(i / 300) as u8, (i / 400) as u8, (i / 500) as u8]);
        let mut pixels: Vec<[u8; 3]> = gradient.collect();
        pixels.extend([[0xE6, 0x9F, 0x00]; 60]);
        let mut palette = Palette::of_pictures(&[picture(&pixels)]);
        let bytes = palette.bytes();
        assert!(bytes.len() <= 3 * 256);
        for pixel in pixels {
            let index = usize::from(palette.index(pixel));
            let found = &bytes[3 * index..3 * index + 3];
            let off = found.iter().zip(pixel).map(|(a, b)| a.abs_diff(b)).max();
            assert!(off <= Some(4), "{pixel:?} became {found:?}");
        }
    }

    #[test]
    fn the_nearest_is_the_nearest() {
        let pixels: Vec<[u8; 3]> =
            (0..3000u32).map(|i| [(i * 37) as u8, (i * 101) as u8, (i * 59) as u8]).collect();
        let mut palette = Palette::of_pictures(&[picture(&pixels)]);
        let colors = palette.colors.clone();
        for wanted in [[3, 200, 90], [255, 0, 255], [77, 77, 77]] {
            let index = usize::from(palette.index(wanted)) - 1;
            let distance = |c: [u8; 3]| distance_squared(seen(c), seen(wanted));
            let best = colors.iter().map(|c| distance(*c)).fold(f32::INFINITY, f32::min);
            assert_eq!(distance(colors[index]), best);
        }
        let mut sorted: Vec<[f32; 3]> = colors.iter().map(|c| seen(*c)).collect();
        sorted.sort_by(|a, b| a[1].total_cmp(&b[1]));
        for at in [[10.0, 100.0, 60.0], [0.0, 0.0, 0.0], [255.0, 320.0, 190.0]] {
            let fast = distance_squared(sorted[nearest_sorted(&sorted, at)], at);
            let slow =
                sorted.iter().map(|c| distance_squared(*c, at)).fold(f32::INFINITY, f32::min);
            assert_eq!(fast, slow);
        }
    }

    #[test]
    fn no_pictures_have_some_palette() {
        let mut palette = Palette::of_pictures(&[]);
        assert_ne!(palette.index([1, 2, 3]), TRANSPARENT);
    }
}
