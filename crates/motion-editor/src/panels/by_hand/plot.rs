//! Where frames are in the plot of the timing.

use egui::{Pos2, Rect};

/// A plot: shown frames across, source frames up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plot {
    /// Where it is.
    pub rect: Rect,
    /// The output frame at its right edge, above 0.
    pub last_output: f64,
    /// The source frame at its top, above 0.
    pub last_source: f64,
}

impl Plot {
    /// A plot of a motion of so many source frames that is shown in so many output frames, with
    /// room for it to become longer.
    pub fn new(rect: Rect, n_output: usize, n_source: usize) -> Self {
        const ROOM: f64 = 1.15;
        let last_source = (n_source as f64 - 1.0).max(1.0);
        let last_output = (n_output as f64 - 1.0).max(last_source) * ROOM;
        Self { rect, last_output, last_source }
    }

    /// Where a point of the curve is.
    pub fn place(&self, output: f64, source: f64) -> Pos2 {
        let x = (output / self.last_output) as f32;
        let y = (source / self.last_source) as f32;
        Pos2::new(
            self.rect.left() + x * self.rect.width(),
            self.rect.bottom() - y * self.rect.height(),
        )
    }

    /// The output and the source frame at a place, within the plot.
    pub fn frames_at(&self, at: Pos2) -> (f64, f64) {
        let x = f64::from((at.x - self.rect.left()) / self.rect.width());
        let y = f64::from((self.rect.bottom() - at.y) / self.rect.height());
        (x.clamp(0.0, 1.0) * self.last_output, y.clamp(0.0, 1.0) * self.last_source)
    }
}

#[cfg(test)]
mod tests {
    use egui::Vec2;

    use super::*;

    #[test]
    fn places_are_found_again() {
        let rect = Rect::from_min_size(Pos2::new(10.0, 20.0), Vec2::new(230.0, 200.0));
        let plot = Plot::new(rect, 101, 101);
        assert_eq!(plot.place(0.0, 0.0), rect.left_bottom());
        let corner = plot.place(100.0, 100.0);
        assert!(corner.distance(Pos2::new(210.0, 20.0)) < 1e-3, "{corner:?}");
        let (output, source) = plot.frames_at(plot.place(40.0, 60.0));
        assert!((output - 40.0).abs() < 1e-3 && (source - 60.0).abs() < 1e-3);
        let outside = plot.frames_at(rect.right_top() + Vec2::new(50.0, -50.0));
        assert!((outside.0 - 115.0).abs() < 1e-6 && (outside.1 - 100.0).abs() < 1e-6);
        assert!(Plot::new(rect, 1, 1).place(0.0, 0.0).x.is_finite());
    }
}
