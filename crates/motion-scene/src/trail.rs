//! The path of a joint with a dot for every frame.

use glam::Vec3;

use crate::color::{ColorRole, Theme};
use crate::line::Line;

/// Where a joint goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Trail {
    /// One point a frame, metres.
    pub points_m: Vec<Vec3>,
    /// The frame that is shown: before it the colour is that of the past.
    pub now: usize,
}

const LINE_PT: f32 = 1.5;
const DOT_PT: f32 = 3.5;
const NOW_PT: f32 = 7.0;

impl Trail {
    /// What is drawn: a line and dots for the past, the same for the future, a larger dot now.
    pub fn to_lines(&self, theme: Theme) -> Vec<Line> {
        if self.points_m.is_empty() {
            return Vec::new();
        }
        let now = self.now.min(self.points_m.len() - 1);
        let mut lines = Vec::with_capacity(self.points_m.len() + 3);
        let halves =
            [(&self.points_m[..=now], ColorRole::Past), (&self.points_m[now..], ColorRole::Future)];
        for (points, role) in halves {
            let color = role.color(theme);
            if points.len() > 1 {
                lines.push(Line::new(points.to_vec(), color.with_alpha(0.55), LINE_PT));
            }
            lines.extend(points.iter().map(|&p| Line::new(vec![p], color, DOT_PT)));
        }
        let color = ColorRole::Text.color(theme);
        lines.push(Line::new(vec![self.points_m[now]], color, NOW_PT));
        lines
    }
}
