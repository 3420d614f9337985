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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dot_for_every_frame_and_a_larger_one_for_now() {
        let points_m: Vec<Vec3> = (0..10).map(|i| Vec3::X * i as f32).collect();
        let lines = Trail { points_m: points_m.clone(), now: 4 }.to_lines(Theme::Dark);
        let past = ColorRole::Past.color(Theme::Dark);
        let future = ColorRole::Future.color(Theme::Dark);
        let dots_of = |color| {
            let dots = lines.iter().filter(|l| l.points_m.len() == 1 && l.color == color);
            dots.map(|l| l.points_m[0].x).collect::<Vec<_>>()
        };
        assert_eq!(dots_of(past), [0.0, 1.0, 2.0, 3.0, 4.0]);
        assert_eq!(dots_of(future), [4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        let now = lines.last().unwrap();
        assert_eq!((now.points_m[0], now.width_pt), (points_m[4], NOW_PT));
    }

    #[test]
    fn short_and_overrun_trails() {
        assert!(Trail { points_m: Vec::new(), now: 0 }.to_lines(Theme::Dark).is_empty());
        let one = Trail { points_m: vec![Vec3::ONE], now: 99 }.to_lines(Theme::Light);
        assert!(one.iter().all(|line| line.points_m == [Vec3::ONE]));
    }
}
