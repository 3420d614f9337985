//! A character's constraints as markers on the floor and in the air.

use glam::{Vec2, Vec3};
use motion_io::project_file::{Constraint, ConstraintKind};
use motion_io::report_file::ConstraintReport;
use motion_scene::body::Emphasis;
use motion_scene::color::{ColorRole, Theme};
use motion_scene::label::Label;
use motion_scene::line::Line;
use motion_scene::marker::{Checkpoint, JointTarget};
use motion_scene::solid::Solid;

use super::path_wish::path_wish;
use super::pick::{PickTarget, Picks};

/// What a motion makes of the constraints.
#[derive(Clone, Copy, Debug)]
pub struct Reality<'a> {
    /// Where the body's root is, frame by frame, metres.
    pub root_path_m: &'a [Vec3],
    /// How far off each constraint is, as the report says.
    pub misses: &'a [ConstraintReport],
}

/// Markers for all of a character's constraints that have a place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wishes {
    /// Body constraints, in the order of their frames.
    pub checkpoints: Vec<Checkpoint>,
    /// Joint constraints, in the project's order.
    pub joint_targets: Vec<JointTarget>,
    /// Paths to follow, velocities, and where bodies really are.
    pub lines: Vec<Line>,
    /// Balls in which joints may be.
    pub solids: Vec<Solid>,
    /// What is said of paths.
    pub labels: Vec<Label>,
}

/// A miss smaller than this is none that anybody could see, metres.
const SHOWN_MISS_M: f64 = 0.005;
/// And a heading that is off by less, degrees.
const SHOWN_MISS_DEG: f64 = 0.5;
/// From a checkpoint to a body further away than this a line is drawn, metres.
const JOINED_MISS_M: f32 = 0.02;
/// Lines over the floor, so that they do not fight with it for the same depth, metres.
const LIFT_M: f32 = 0.006;

/// A velocity is drawn as the way that it leads in so many seconds.
pub const VELOCITY_SECS: f32 = 0.25;

/// Where the arrow of a joint target's velocity ends.
pub fn velocity_tip_m(at_m: Vec3, velocity_m_s: Vec3) -> Vec3 {
    at_m + velocity_m_s * VELOCITY_SECS
}

fn vec3(numbers: [f64; 3]) -> Vec3 {
    Vec3::from_array(numbers.map(|x| x as f32))
}

/// A body constraint, taken apart.
struct Place<'a> {
    nth: usize,
    constraint: &'a Constraint,
    frame: u32,
    at_m: Vec2,
    height_m: f32,
    heading_deg: Option<f64>,
}

/// Markers for the constraints of the character that is the project's number `character`.
///
/// Labels are `2 · f 80 · miss 4 cm`: the checkpoint's number from 1, its frame, and how far off
/// the body is, where somebody could see it.
pub fn wishes(
    constraints: &[Constraint],
    character: usize,
    reality: Option<Reality<'_>>,
    theme: Theme,
    picks: &mut Picks,
) -> Wishes {
    let mut found = Wishes::default();
    let places = places(constraints);
    for (number, place) in places.iter().enumerate() {
        let name = |picks: &mut Picks, tip: bool| {
            let constraint = place.nth;
            picks.name(match tip {
                false => PickTarget::Checkpoint { character, constraint },
                true => PickTarget::CheckpointTip { character, constraint },
            })
        };
        let position_m = Vec3::new(place.at_m.x, place.height_m, place.at_m.y);
        let tolerance = place.constraint.tolerance.as_ref();
        let miss = reality.and_then(|reality| miss_of(reality, &place.constraint.id));
        found.checkpoints.push(Checkpoint {
            position_m,
            heading_rad: heading_rad(&places, number),
            is_exact: tolerance.is_none(),
            tolerance_m: tolerance.and_then(|t| t.position_m).map(|metres| metres as f32),
            label: format!("{} · f {}{}", number + 1, place.frame, miss_text(miss)),
            is_off: !miss_text(miss).is_empty(),
            emphasis: Emphasis::None,
            pick: name(picks, false),
            pick_tip: name(picks, true),
        });
        if let Some(reality) = reality {
            let is_last = number > 0 && number + 1 == places.len();
            found.lines.extend(line_to_body(position_m, place.frame, is_last, reality, theme));
        }
    }
    let mut n_paths = 0;
    for (nth, constraint) in constraints.iter().enumerate() {
        match &constraint.kind {
            ConstraintKind::Joint { frame, joint, position_m, velocity_m_s } => {
                let at_m = vec3(*position_m);
                let miss = reality.and_then(|reality| miss_of(reality, &constraint.id));
                let pick = picks.name(PickTarget::JointTarget { character, constraint: nth });
                let mut label = format!("{joint} · f {frame} · {:.2} m", at_m.y);
                if let Some(velocity_m_s) = velocity_m_s.map(vec3) {
                    label += &format!(" · {:.1} m/s", velocity_m_s.length());
                    let color = ColorRole::JointTarget.color(theme);
                    let tip_m = velocity_tip_m(at_m, velocity_m_s);
                    let line = |points_m, width_pt| Line::new(points_m, color, width_pt);
                    found.lines.push(Line { pick, ..line(vec![at_m, tip_m], 2.5) });
                    found.lines.push(Line { pick, ..line(vec![tip_m], 7.0) });
                }
                if let Some(radius_m) = constraint.tolerance.as_ref().and_then(|t| t.position_m) {
                    let color = ColorRole::JointTarget.color(theme).with_alpha(0.14);
                    found.solids.push(Solid::ball(at_m, radius_m as f32, color));
                }
                label += &miss_text(miss);
                found.joint_targets.push(JointTarget {
                    position_m: at_m,
                    floor_m: 0.0,
                    label,
                    is_off: !miss_text(miss).is_empty(),
                    emphasis: Emphasis::None,
                    pick,
                });
            }
            ConstraintKind::Path { .. } => {
                n_paths += 1;
                let miss = reality.and_then(|reality| miss_of(reality, &constraint.id));
                let pick = picks.name(PickTarget::Path { character, constraint: nth });
                let seen = path_wish(constraint, n_paths, miss, theme, pick);
                if let Some((lines, label)) = seen {
                    found.lines.extend(lines);
                    found.labels.push(label);
                }
            }
            _ => {}
        }
    }
    found
}

/// Body constraints by frame.
fn places(constraints: &[Constraint]) -> Vec<Place<'_>> {
    let mut places: Vec<Place<'_>> = constraints
        .iter()
        .enumerate()
        .filter_map(|(nth, constraint)| match constraint.kind {
            ConstraintKind::Body { frame, position_m: [x, z], heading_deg, height_m } => {
                let at_m = Vec2::new(x as f32, z as f32);
                let height_m = height_m.unwrap_or_default() as f32;
                Some(Place { nth, constraint, frame, at_m, height_m, heading_deg })
            }
            _ => None,
        })
        .collect();
    places.sort_by_key(|place| place.frame);
    places
}

/// The heading of a place, or where it is left open that of the way to it (from the first: of the
/// way from it), as the search takes it.
fn heading_rad(places: &[Place<'_>], nth: usize) -> f32 {
    if let Some(degrees) = places[nth].heading_deg {
        return degrees.to_radians() as f32;
    }
    let (a, b) = if nth == 0 { (0, 1.min(places.len() - 1)) } else { (nth - 1, nth) };
    let way = places[b].at_m - places[a].at_m;
    if way.length() > 0.05 { way.x.atan2(way.y) } else { 0.0 }
}

fn miss_of<'a>(reality: Reality<'a>, id: &str) -> Option<&'a ConstraintReport> {
    reality.misses.iter().find(|miss| miss.constraint == id)
}

/// How far off something is, in words behind a label; nothing where nobody could see it.
pub(super) fn miss_text(miss: Option<&ConstraintReport>) -> String {
    let Some(miss) = miss else { return String::new() };
    let metres = miss.position_error_m.filter(|metres| *metres >= SHOWN_MISS_M);
    let degrees = miss.heading_error_deg.map(f64::abs).filter(|deg| *deg >= SHOWN_MISS_DEG);
    let parts = [
        metres.map(|metres| format!("{:.0} cm", 100.0 * metres)),
        degrees.map(|degrees| format!("{degrees:.0}°")),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    let mut text = String::new();
    if !parts.is_empty() {
        text += &format!(" · miss {}", parts.join(", "));
    }
    match miss.frame_error.unwrap_or_default() {
        0 => {}
        late @ 1.. => text += &format!(" · {late} f late"),
        early => text += &format!(" · {} f early", early.unsigned_abs()),
    }
    text
}

/// A line on the floor from a checkpoint to where the body is when it is judged there: at its
/// frame, the last one at the motion's end.
fn line_to_body(
    position_m: Vec3,
    frame: u32,
    is_last: bool,
    reality: Reality<'_>,
    theme: Theme,
) -> Option<Line> {
    let last = reality.root_path_m.len().checked_sub(1)?;
    let frame = if is_last { last } else { last.min(frame as usize) };
    let body_m = reality.root_path_m[frame].with_y(position_m.y);
    let color = ColorRole::Miss.color(theme);
    let up = Vec3::Y * LIFT_M;
    (body_m.distance(position_m) > JOINED_MISS_M)
        .then(|| Line::new(vec![position_m + up, body_m + up], color, 1.5))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use motion_io::diagnostic::Warnings;
    use motion_io::project_file;

    use super::*;

    fn constraints(text: &str) -> Vec<Constraint> {
        let text = format!(
            "{{\"gaitway\": 1, \"name\": \"p\", \"fps\": 30, \"library\": \"builtin\",
              \"characters\": [{{\"name\": \"A\", \"constraints\": [{text}]}}]}}"
        );
        let path = Path::new("p.gaitway");
        let mut project =
            project_file::read(text.as_bytes(), path, &mut Warnings::new()).expect("a project");
        project.characters.remove(0).constraints
    }

    const BODIES: &str = "{\"id\": \"b\", \"kind\": \"body\", \"frame\": 80, \"position\": [3, 1],
          \"heading\": 90, \"height\": 0.4},
         {\"id\": \"a\", \"kind\": \"body\", \"frame\": 0, \"position\": [0, 1], \"heading\": 0}";

    #[test]
    fn markers_are_where_the_constraints_are() {
        let found = wishes(&constraints(BODIES), 0, None, Theme::Dark, &mut Picks::default());
        let [a, b] = found.checkpoints.as_slice() else { panic!("{found:?}") };
        assert_eq!(a.position_m, Vec3::new(0.0, 0.0, 1.0));
        assert_eq!(b.position_m, Vec3::new(3.0, 0.4, 1.0));
        assert_eq!((a.label.as_str(), b.label.as_str()), ("1 · f 0", "2 · f 80"));
        // Heading 0 looks along +Z, 90 along +X: the arrow's tip tells.
        let tip = |c: &Checkpoint| {
            let arrow = c.to_flats(Theme::Dark).pop().expect("an arrow");
            (arrow.points_m[8] - c.position_m).with_y(0.0).normalize_or_zero()
        };
        assert!(tip(a).distance(Vec3::Z) < 1e-5 && tip(b).distance(Vec3::X) < 1e-5);
    }

    #[test]
    fn misses_are_said_and_drawn() {
        let miss = ConstraintReport {
            constraint: "b".into(),
            position_error_m: Some(0.041),
            heading_error_deg: Some(-3.2),
            frame_error: Some(-3),
            ..ConstraintReport::default()
        };
        let path: Vec<Vec3> = (0..78).map(|_| Vec3::new(3.0, 0.9, 1.041)).collect();
        let reality = Reality { root_path_m: &path, misses: &[miss] };
        let mut picks = Picks::default();
        let found = wishes(&constraints(BODIES), 2, Some(reality), Theme::Dark, &mut picks);
        assert_eq!(found.checkpoints[1].label, "2 · f 80 · miss 4 cm, 3° · 3 f early");
        assert!(found.checkpoints[1].is_off && !found.checkpoints[0].is_off);
        assert_eq!(found.lines.len(), 2, "the first is missed as well, by three metres");
        let tip = found.checkpoints[1].pick_tip.and_then(|id| picks.target(id));
        assert_eq!(tip, Some(PickTarget::CheckpointTip { character: 2, constraint: 0 }));
    }

    #[test]
    fn an_open_heading_is_that_of_the_way() {
        let open = "{\"kind\": \"body\", \"frame\": 0, \"position\": [0, 0]},
                    {\"kind\": \"body\", \"frame\": 30, \"position\": [2, 0]}";
        let found = wishes(&constraints(open), 0, None, Theme::Dark, &mut Picks::default());
        let degrees = found.checkpoints.iter().map(|c| c.heading_rad.to_degrees().round());
        assert_eq!(degrees.collect::<Vec<_>>(), [90.0, 90.0]);
    }

    #[test]
    fn joint_targets_say_how_high_they_are() {
        let joint = "{\"kind\": \"joint\", \"frame\": 120, \"joint\": \"Head\",
                      \"position\": [1.2, 2.0, 0.4]}";
        let found = wishes(&constraints(joint), 0, None, Theme::Dark, &mut Picks::default());
        let target = &found.joint_targets[0];
        assert_eq!(target.position_m, Vec3::new(1.2, 2.0, 0.4));
        assert_eq!(target.label, "Head · f 120 · 2.00 m");
        let fast = joint.replace('}', ", \"velocity\": [0, 3.0, -4.0], \"tolerance\": 0.2}");
        let found = wishes(&constraints(&fast), 0, None, Theme::Dark, &mut Picks::default());
        assert_eq!(found.joint_targets[0].label, "Head · f 120 · 2.00 m · 5.0 m/s");
        assert_eq!(found.lines[0].points_m[1], Vec3::new(1.2, 2.75, -0.6), "a quarter second on");
        assert_eq!(found.solids.len(), 1, "where it may be");
    }
}
