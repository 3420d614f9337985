//! Where things are on a contact sheet.

use super::canvas::Rect;

/// The places of a contact sheet.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SheetLayout {
    /// The large picture of the whole motion; none where a motion stays in place.
    pub(crate) fan: Option<Rect>,
    /// Places for moments, in the order of reading.
    pub(crate) cells: Vec<Rect>,
}

/// Cells are taller than wide, as people are.
const CELL_ASPECT: f32 = 0.6;
/// Cells narrower than this show nobody, pixels.
const MIN_CELL_PX: f32 = 40.0;
/// At most so many rows of cells without a fan, and so many cells in a row.
const N_ROWS: u32 = 3;
const MAX_IN_A_ROW: u32 = 12;

impl SheetLayout {
    /// The layout below a header of `header` rows.
    #[must_use]
    pub(crate) fn below(mut self, header: u32) -> Self {
        for place in self.fan.iter_mut().chain(&mut self.cells) {
            place.top += header;
        }
        self
    }

    /// The layout of a sheet of `width` × `height` pixels for a motion of `n_frames`. A fan, where there
    /// is one, takes `fan_share` of the height. Between places are `gap` pixels.
    pub(crate) fn new(
        width: u32,
        height: u32,
        gap: u32,
        fan_share: Option<f32>,
        n_frames: usize,
    ) -> Self {
        let n_most = u32::try_from(n_frames.max(1)).unwrap_or(u32::MAX);
        if let Some(fan_share) = fan_share {
            let strip = ((height as f32 * (1.0 - fan_share)) as u32).max(1);
            let fan_height = height.saturating_sub(strip + gap).max(1);
            let fan = Rect { left: 0, top: 0, width, height: fan_height };
            let top = fan_height + gap;
            let n = in_a_row(width, strip).min(n_most);
            return Self {
                fan: Some(fan),
                cells: row(width, gap, n, top, height - top.min(height)),
            };
        }
        let mut n_rows = N_ROWS;
        let row_height = |n_rows: u32| (height.saturating_sub((n_rows - 1) * gap) / n_rows).max(1);
        // No row is for nothing.
        while n_rows > 1 && in_a_row(width, row_height(n_rows)) * (n_rows - 1) >= n_most {
            n_rows -= 1;
        }
        let each = row_height(n_rows);
        let n_all = (in_a_row(width, each) * n_rows).min(n_most);
        let mut cells = Vec::new();
        for nth in 0..n_rows {
            // Rows are filled evenly: the last is not left with one alone.
            let n = n_all * (nth + 1) / n_rows - n_all * nth / n_rows;
            let top = nth * (each + gap);
            let last = nth + 1 == n_rows;
            let row_height = if last { height.saturating_sub(top).max(1) } else { each };
            cells.extend(row(width, gap, n, top, row_height));
        }
        Self { fan: None, cells }
    }
}

/// How many cells fit beside each other.
fn in_a_row(width: u32, height: u32) -> u32 {
    let cell_width = (height as f32 * CELL_ASPECT).max(MIN_CELL_PX);
    ((width as f32 / cell_width).round() as u32).clamp(1, MAX_IN_A_ROW)
}

/// `n` places beside each other that fill the width to the last pixel.
fn row(width: u32, gap: u32, n: u32, top: u32, height: u32) -> Vec<Rect> {
    let free = width.saturating_sub((n.max(1) - 1) * gap);
    let left = |nth: u32| (u64::from(free) * u64::from(nth) / u64::from(n.max(1))) as u32;
    (0..n)
        .map(|nth| Rect {
            left: left(nth) + nth * gap,
            top,
            width: (left(nth + 1) - left(nth)).max(1),
            height,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_fill_the_sheet_without_touching() {
        for (width, height) in [(1600, 1000), (640, 360), (160, 90), (16, 16), (300, 2000)] {
            for fan_share in [Some(0.73), Some(0.6), None] {
                for n_frames in [1, 2, 7, 25, 10_000] {
                    let layout = SheetLayout::new(width, height, 2, fan_share, n_frames);
                    assert_eq!(layout.fan.is_some(), fan_share.is_some());
                    assert!(!layout.cells.is_empty() && layout.cells.len() <= n_frames);
                    let all: Vec<Rect> = layout.fan.into_iter().chain(layout.cells).collect();
                    let what = format!("{width} × {height}, {n_frames} frames: {all:?}");
                    let right = |r: &Rect| r.left + r.width;
                    let bottom = |r: &Rect| r.top + r.height;
                    assert_eq!(all.iter().map(right).max(), Some(width), "{what}");
                    assert_eq!(all.iter().map(bottom).max(), Some(height), "{what}");
                    for (nth, a) in all.iter().enumerate() {
                        for b in &all[nth + 1..] {
                            let apart = right(a) < b.left
                                || right(b) < a.left
                                || bottom(a) < b.top
                                || bottom(b) < a.top;
                            assert!(apart, "{what}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn rows_are_filled_evenly() {
        let layout = SheetLayout::new(1600, 1000, 2, None, 10);
        let in_row = |top: u32| layout.cells.iter().filter(|cell| cell.top == top).count();
        let mut tops: Vec<u32> = layout.cells.iter().map(|cell| cell.top).collect();
        tops.dedup();
        let counts: Vec<usize> = tops.into_iter().map(in_row).collect();
        assert_eq!(counts.iter().sum::<usize>(), 10);
        assert!(counts.iter().max().unwrap() - counts.iter().min().unwrap() <= 1, "{counts:?}");
    }
}
