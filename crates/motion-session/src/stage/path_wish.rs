//! A path that a body is asked to follow, as lines on the floor.

use glam::{Vec2, Vec3};
use motion_io::project_file::{Constraint, ConstraintKind, PathHeading};
use motion_io::report_file::ConstraintReport;
use motion_scene::body::PickId;
use motion_scene::color::{ColorRole, LinearRgba, Theme};
use motion_scene::label::{Anchor, LABEL_PT, Label, LabelPlace};
use motion_scene::line::{Line, Occlusion};

use super::wishes::miss_text;

/// Lines over the floor, so that they do not fight with it for the same depth, metres.
const LIFT_M: f32 = 0.006;
/// How thick the path is, points.
const WIDTH_PT: f32 = 3.0;
/// How thick the edges of what is near enough are, points.
const EDGE_PT: f32 = 1.0;
/// Arrows that say where one looks are so far apart, metres.
const ARROWS_M: f32 = 0.6;
/// How long the sides of an arrow are, metres.
const ARROW_M: f32 = 0.12;

/// The lines of a path and its words; nothing of other constraints.
pub(super) fn path_wish(
    constraint: &Constraint,
    number: usize,
    miss: Option<&ConstraintReport>,
    theme: Theme,
    pick: Option<PickId>,
) -> Option<(Vec<Line>, Label)> {
    let ConstraintKind::Path { from, to, points_m, heading } = &constraint.kind else {
        return None;
    };
    let points: Vec<Vec2> = points_m.iter().map(|&[x, z]| Vec2::new(x as f32, z as f32)).collect();
    let color = ColorRole::Checkpoint.color(theme).with_alpha(0.85);
    let line = |points: &[Vec2], color: LinearRgba, width_pt| {
        let points_m = points.iter().map(|p| Vec3::new(p.x, LIFT_M, p.y)).collect();
        Line { pick, ..Line::new(points_m, color, width_pt) }
    };
    let mut lines = vec![line(&points, color, WIDTH_PT)];
    lines.extend(points.first().map(|first| line(&[*first], color, 9.0)));
    let way = ways(&points);
    let n_arrows = match heading {
        PathHeading::Along => (length_m(&points) / ARROWS_M).floor() as usize,
        PathHeading::Free => 0,
    };
    let shares = (0..n_arrows).map(|nth| (nth as f32 + 0.5) / n_arrows as f32);
    for share in shares.chain([1.0]) {
        let Some((at, ahead)) = along(&way, share) else { continue };
        lines.push(line(&arrow(at, ahead), color, WIDTH_PT));
    }
    let radius_m = constraint.tolerance.as_ref().and_then(|tolerance| tolerance.position_m);
    if let Some(radius_m) = radius_m {
        let faint = color.with_alpha(0.35);
        for side in [-1.0, 1.0] {
            let edge = beside(&points, side * radius_m as f32);
            lines.push(Line { pick: None, ..line(&edge, faint, EDGE_PT) });
        }
    }
    // In the middle: where it begins there is often a checkpoint, which has words of its own.
    let middle = along(&way, 0.5).map_or(Vec2::ZERO, |(at, _)| at);
    let is_off = !miss_text(miss).is_empty();
    let role = if is_off { ColorRole::Miss } else { ColorRole::Text };
    let label = Label {
        text: format!("Path {number} · f {from}–{to}{}", miss_text(miss)),
        place: LabelPlace::World(Vec3::new(middle.x, LIFT_M, middle.y)),
        anchor: Anchor::Below,
        clear_m: 0.06,
        occlusion: Occlusion::Shown,
        size_pt: LABEL_PT,
        color: role.color(theme),
        plate: Some(ColorRole::TextPlate.color(theme).with_alpha(0.82)),
    };
    Some((lines, label))
}

/// How long a way is, metres.
fn length_m(points: &[Vec2]) -> f32 {
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// The pieces of a way that lead somewhere.
fn ways(points: &[Vec2]) -> Vec<[Vec2; 2]> {
    let pairs = points.windows(2).map(|pair| [pair[0], pair[1]]);
    pairs.filter(|[a, b]| a.distance(*b) > 1e-4).collect()
}

/// The place at a share of a way's length, and where the way goes there.
fn along(ways: &[[Vec2; 2]], share: f32) -> Option<(Vec2, Vec2)> {
    let total: f32 = ways.iter().map(|[a, b]| a.distance(*b)).sum();
    let mut rest = share * total;
    for (nth, [a, b]) in ways.iter().enumerate() {
        let length = a.distance(*b);
        if rest <= length || nth + 1 == ways.len() {
            let ahead = (*b - *a) / length;
            return Some((*a + ahead * rest.min(length), ahead));
        }
        rest -= length;
    }
    None
}

/// A bracket that points ahead, its tip at a place.
fn arrow(tip: Vec2, ahead: Vec2) -> [Vec2; 3] {
    let side = ahead.perp();
    let foot = |sign: f32| tip - ARROW_M * (ahead - sign * 0.7 * side);
    [foot(1.0), tip, foot(-1.0)]
}

/// A way that runs beside another.
fn beside(points: &[Vec2], by_m: f32) -> Vec<Vec2> {
    let ahead = |nth: usize| {
        let (before, after) = (nth.saturating_sub(1), (nth + 1).min(points.len() - 1));
        (points[after] - points[before]).normalize_or_zero()
    };
    (0..points.len()).map(|nth| points[nth] + ahead(nth).perp() * by_m).collect()
}

#[cfg(test)]
mod tests {
    use motion_io::project_file::{Extra, Tolerance};

    use super::*;

    fn path(heading: PathHeading, tolerance_m: Option<f64>) -> Constraint {
        let points_m = vec![[0.0, 0.0], [0.0, 3.0], [3.0, 3.0]];
        Constraint {
            id: "path-1".to_owned(),
            kind: ConstraintKind::Path { from: 10, to: 90, points_m, heading },
            weight: None,
            tolerance: tolerance_m
                .map(|m| Tolerance { position_m: Some(m), ..Tolerance::default() }),
            extra: Extra::new(),
        }
    }

    #[test]
    fn arrows_say_where_one_looks() {
        let seen = |heading, tolerance_m| {
            let path = path(heading, tolerance_m);
            path_wish(&path, 2, None, Theme::Dark, None).map(|(lines, label)| (lines, label.text))
        };
        let (lines, words) = seen(PathHeading::Free, None).expect("a path");
        assert_eq!((lines.len(), words.as_str()), (3, "Path 2 · f 10–90"), "way, begin, end");
        let tip = lines[2].points_m[1];
        assert!(tip.distance(Vec3::new(3.0, LIFT_M, 3.0)) < 1e-5, "{tip}");
        assert!(lines[2].points_m.iter().all(|p| p.x <= tip.x), "it points ahead");
        let (lines, _) = seen(PathHeading::Along, Some(0.5)).expect("a path");
        assert_eq!(lines.len(), 3 + 10 + 2, "an arrow every 60 cm, an edge on each side");
        assert!((lines[13].points_m[0].x.abs() - 0.5).abs() < 1e-5);
    }

    #[test]
    fn places_on_a_way_are_found_by_its_length() {
        let ways = ways(&[Vec2::ZERO, Vec2::ZERO, Vec2::new(0.0, 1.0), Vec2::new(3.0, 1.0)]);
        let (at, ahead) = along(&ways, 0.5).expect("a way");
        assert!(at.distance(Vec2::new(1.0, 1.0)) < 1e-5 && ahead == Vec2::X, "{at} {ahead}");
        assert_eq!(along(&[], 0.5), None);
    }
}
