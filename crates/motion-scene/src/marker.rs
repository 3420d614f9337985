//! Wishes on the floor and in the air: checkpoints and joint targets.
//!
//! Both are made of simpler things: flat triangles on the floor, lines, a ball, a label.

use glam::{Quat, Vec2, Vec3};

use crate::body::{Emphasis, PickId};
use crate::color::{ColorRole, LinearRgba, Theme};
use crate::label::{Anchor, LABEL_PT, Label, LabelPlace};
use crate::line::{Line, Occlusion};
use crate::solid::Solid;

/// Triangles that lie flat, drawn in their own colour without light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Flat {
    /// Three points for each triangle, metres.
    pub points_m: Vec<Vec3>,
    /// One colour for all.
    pub color: Option<LinearRgba>,
    /// What picking it returns.
    pub pick: Option<PickId>,
}

/// Where a body must be and where it must look: ring, arrow and words.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// On what the body stands, metres.
    pub position_m: Vec3,
    /// 0 along +Z, a quarter turn along +X.
    pub heading_rad: f32,
    /// Filled where the place is exact, open where near is enough.
    pub is_exact: bool,
    /// Radius of the disc in which the body may be, where it was softened.
    pub tolerance_m: Option<f32>,
    /// Words beside it: number, frame, miss.
    pub label: String,
    /// Whether it is missed by what somebody can see: words are in the colour of misses then.
    pub is_off: bool,
    /// Whether it is marked.
    pub emphasis: Emphasis,
    /// What picking its ring returns.
    pub pick: Option<PickId>,
    /// What picking its arrow's tip returns.
    pub pick_tip: Option<PickId>,
}

/// Where a joint must be: ball, drop line to the floor, words.
#[derive(Clone, Debug, PartialEq)]
pub struct JointTarget {
    /// Where, metres.
    pub position_m: Vec3,
    /// Height of the floor below it, metres.
    pub floor_m: f32,
    /// Words beside it: joint, frame, height.
    pub label: String,
    /// Whether it is missed by what somebody can see: words are in the colour of misses then.
    pub is_off: bool,
    /// Whether it is marked.
    pub emphasis: Emphasis,
    /// What picking it returns.
    pub pick: Option<PickId>,
}

const RING_RADIUS_M: f32 = 0.24;
const RING_WIDTH_M: f32 = 0.035;
const ARROW_REACH_M: f32 = 0.62;
const ARROW_SHAFT_M: f32 = 0.055;
const ARROW_HEAD_M: Vec2 = Vec2::new(0.19, 0.17);
/// Over the floor, so that they do not fight for the same depth.
const LIFT_M: f32 = 0.004;
const N_RING: usize = 48;
const TARGET_RADIUS_M: f32 = 0.045;

impl Checkpoint {
    /// The flat parts, the tolerance disc first.
    pub fn to_flats(&self, theme: Theme) -> Vec<Flat> {
        let color = self.color(theme);
        let turn = Quat::from_rotation_y(self.heading_rad);
        let place = |p: Vec2| self.position_m + turn * Vec3::new(p.x, LIFT_M, p.y);
        let mut flats = Vec::with_capacity(4);
        let mut add = |points: Vec<Vec2>, color: LinearRgba, pick| {
            let points_m = points.into_iter().map(place).collect();
            flats.push(Flat { points_m, color: Some(color), pick });
        };
        if let Some(radius_m) = self.tolerance_m {
            add(disc(radius_m), color.with_alpha(0.12), None);
        }
        let inner_m = RING_RADIUS_M - RING_WIDTH_M;
        add(disc(inner_m), color.with_alpha(if self.is_exact { 0.45 } else { 0.10 }), self.pick);
        add(ring(inner_m, RING_RADIUS_M), color, self.pick);
        add(arrow(), color, self.pick_tip.or(self.pick));
        flats
    }

    /// The words beside it.
    pub fn to_label(&self, theme: Theme) -> Option<Label> {
        label(&self.label, self.is_off, (self.position_m, RING_RADIUS_M), theme)
    }

    fn color(&self, theme: Theme) -> LinearRgba {
        marked(ColorRole::Checkpoint, self.emphasis, theme)
    }
}

impl JointTarget {
    /// Its ball.
    pub fn to_solid(&self, theme: Theme) -> Solid {
        let color = marked(ColorRole::JointTarget, self.emphasis, theme);
        let mut ball = Solid::ball(self.position_m, TARGET_RADIUS_M, color);
        ball.emphasis = self.emphasis;
        ball.pick = self.pick;
        ball
    }

    /// The line to the floor and the dot where it meets it.
    pub fn to_lines(&self, theme: Theme) -> Vec<Line> {
        let color = marked(ColorRole::JointTarget, self.emphasis, theme);
        let foot = Vec3::new(self.position_m.x, self.floor_m + LIFT_M, self.position_m.z);
        let mut drop_line = Line::new(vec![self.position_m, foot], color.with_alpha(0.8), 1.5);
        drop_line.pick = self.pick;
        drop_line.occlusion = Occlusion::Hidden;
        vec![drop_line, Line::new(vec![foot], color, 7.0)]
    }

    /// The words above it.
    pub fn to_label(&self, theme: Theme) -> Option<Label> {
        let above = self.position_m + Vec3::Y * TARGET_RADIUS_M;
        label(&self.label, self.is_off, (above, 0.0), theme)
    }
}

fn marked(role: ColorRole, emphasis: Emphasis, theme: Theme) -> LinearRgba {
    match emphasis {
        Emphasis::None => role.color(theme),
        Emphasis::Hovered => role.color(theme).mixed(ColorRole::Hovered.color(theme), 0.45),
        Emphasis::Selected => ColorRole::Selected.color(theme),
    }
}

fn label(text: &str, is_off: bool, (at_m, clear_m): (Vec3, f32), theme: Theme) -> Option<Label> {
    let role = if is_off { ColorRole::Miss } else { ColorRole::Text };
    (!text.is_empty()).then(|| Label {
        text: text.to_owned(),
        place: LabelPlace::World(at_m),
        anchor: Anchor::Below,
        clear_m,
        occlusion: Occlusion::Shown,
        size_pt: LABEL_PT,
        color: role.color(theme),
        plate: Some(ColorRole::TextPlate.color(theme).with_alpha(0.82)),
    })
}

/// Triangles of a disc in the plane: x to the left, y ahead.
fn disc(radius: f32) -> Vec<Vec2> {
    (0..N_RING).flat_map(|i| [Vec2::ZERO, on_circle(i, radius), on_circle(i + 1, radius)]).collect()
}

fn ring(inner: f32, outer: f32) -> Vec<Vec2> {
    (0..N_RING)
        .flat_map(|i| {
            let [a, b] = [on_circle(i, inner), on_circle(i + 1, inner)];
            let [c, d] = [on_circle(i, outer), on_circle(i + 1, outer)];
            [a, c, d, a, d, b]
        })
        .collect()
}

fn on_circle(i: usize, radius: f32) -> Vec2 {
    Vec2::from_angle(i as f32 / N_RING as f32 * std::f32::consts::TAU) * radius
}

/// A shaft from the ring outwards and a head.
fn arrow() -> Vec<Vec2> {
    let half = 0.5 * ARROW_SHAFT_M;
    let (from, neck) = (RING_RADIUS_M, ARROW_REACH_M - ARROW_HEAD_M.y);
    let shaft = [(-half, from), (half, from), (half, neck), (-half, neck)].map(Vec2::from);
    let half_head = 0.5 * ARROW_HEAD_M.x;
    let head = [(-half_head, neck), (half_head, neck), (0.0, ARROW_REACH_M)].map(Vec2::from);
    vec![shaft[0], shaft[1], shaft[2], shaft[0], shaft[2], shaft[3], head[0], head[1], head[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checkpoint(heading_rad: f32) -> Checkpoint {
        Checkpoint {
            position_m: Vec3::new(2.0, 0.5, -1.0),
            heading_rad,
            is_exact: false,
            tolerance_m: Some(0.8),
            label: "1 · f 0".to_owned(),
            is_off: false,
            emphasis: Emphasis::None,
            pick: PickId::nth(0),
            pick_tip: PickId::nth(1),
        }
    }

    /// The corner of the arrow furthest from the middle is its tip.
    fn tip(mark: &Checkpoint) -> Vec3 {
        let flats = mark.to_flats(Theme::Dark);
        let arrow = flats.last().unwrap();
        let from = |p: &Vec3| p.distance_squared(mark.position_m);
        let furthest = arrow.points_m.iter().copied();
        furthest.max_by(|a, b| from(a).total_cmp(&from(b))).unwrap()
    }

    #[test]
    fn arrows_point_where_the_heading_says() {
        let quarter = std::f32::consts::FRAC_PI_2;
        for (heading_rad, towards) in [(0.0, Vec3::Z), (quarter, Vec3::X), (-quarter, Vec3::NEG_X)]
        {
            let mark = checkpoint(heading_rad);
            let off = (tip(&mark) - mark.position_m).with_y(0.0);
            assert!(off.normalize_or_zero().distance(towards) < 1e-5, "{heading_rad}: {off}");
        }
    }

    #[test]
    fn everything_is_whole_triangles_just_over_what_it_marks() {
        let flats = checkpoint(1.0).to_flats(Theme::Light);
        assert_eq!(flats.len(), 4, "tolerance, disc, ring, arrow");
        for flat in &flats {
            assert_eq!(flat.points_m.len() % 3, 0);
            assert!(flat.points_m.iter().all(|p| (p.y - 0.5 - LIFT_M).abs() < 1e-6));
        }
        let reach = |flat: &Flat| {
            let off = flat.points_m.iter().map(|p| p.distance(Vec3::new(2.0, 0.5, -1.0)));
            off.fold(0.0, f32::max)
        };
        assert!((reach(&flats[0]) - 0.8).abs() < 1e-3, "the tolerance is as large as it says");
        assert_eq!(flats[0].pick, None, "a tolerance is not in the way of what is in it");
        assert_eq!(flats[3].pick, PickId::nth(1));
    }

    #[test]
    fn joint_targets_drop_to_their_floor() {
        let target = JointTarget {
            position_m: Vec3::new(1.0, 1.8, 2.0),
            floor_m: 0.3,
            label: String::new(),
            is_off: false,
            emphasis: Emphasis::Selected,
            pick: None,
        };
        let lines = target.to_lines(Theme::Dark);
        let foot = *lines[0].points_m.last().unwrap();
        assert!(foot.distance(Vec3::new(1.0, 0.3, 2.0)) < 0.01, "{foot}");
        assert_eq!(target.to_label(Theme::Dark), None, "no words, no plate");
        assert_eq!(target.to_solid(Theme::Dark).emphasis, Emphasis::Selected);
    }
}
