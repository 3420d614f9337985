//! From which side a motion is best looked at.

use std::f32::consts::TAU;

use glam::Vec3;
use motion_scene::camera::{OrbitCamera, StandardView, Viewport};

use super::framing::{Margins, frame_points};

/// A pose that is to be told from the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standpoint {
    /// Between the feet, metres.
    pub foot_m: Vec3,
    /// Over the head, metres.
    pub head_m: Vec3,
    /// Where the body looks, on the ground.
    pub facing: Vec3,
}

/// As many directions are tried.
const N_YAWS: usize = 48;
/// Poses whose middles are this share of their height apart do not hide each other.
const APART_SHARE: f32 = 0.42;
/// A body is best seen from this far beside where it looks, radians: 35°.
const BESIDE_RAD: f32 = 0.61;

/// The yaw, for a camera with `pitch_rad`, from which the poses hide each other least, are large,
/// show faces rather than backs, and lead from left to right. Three-quarter from the first for no
/// poses at all.
pub fn best_yaw_rad(poses: &[Standpoint], pitch_rad: f32, viewport: Viewport) -> f32 {
    let mut camera = OrbitCamera::standard(StandardView::ThreeQuarter, Vec3::ZERO, 1.0);
    camera.pitch_rad = pitch_rad;
    if poses.is_empty() {
        return camera.yaw_rad;
    }
    let points: Vec<Vec3> = poses.iter().flat_map(|pose| [pose.foot_m, pose.head_m]).collect();
    let margins = Margins { side: 0.08, top: 0.1, bottom: 0.08 };
    let merit = |nth: usize| {
        let mut camera = camera;
        camera.yaw_rad = nth as f32 * TAU / N_YAWS as f32;
        frame_points(&mut camera, &points, viewport, margins);
        merit(&camera, poses, viewport)
    };
    // The first of equally good ones, so that the choice is always the same.
    let best = (0..N_YAWS)
        .map(|nth| (merit(nth), nth))
        .reduce(|best, next| if next.0 > best.0 { next } else { best });
    best.map_or(camera.yaw_rad, |(_, nth)| nth as f32 * TAU / N_YAWS as f32)
}

/// How well a camera shows the poses; terms are about 1 where they count fully.
fn merit(camera: &OrbitCamera, poses: &[Standpoint], viewport: Viewport) -> f32 {
    let n = poses.len() as f32;
    let seen: Vec<(f32, f32)> = poses
        .iter()
        .filter_map(|pose| {
            let foot = camera.project(pose.foot_m, viewport)?.px;
            let head = camera.project(pose.head_m, viewport)?.px;
            Some((0.5 * (foot.x + head.x), (foot.y - head.y).abs().max(1.0)))
        })
        .collect();
    let mut hidden = 0.0;
    for (nth, a) in seen.iter().enumerate() {
        for b in &seen[nth + 1..] {
            let apart = (a.0 - b.0).abs() / (APART_SHARE * a.1.max(b.1));
            hidden += (1.0 - apart).max(0.0);
        }
    }
    let large = seen.iter().map(|pose| pose.1).sum::<f32>() / (n * viewport.height_px);
    let towards_eye = -camera.forward().with_y(0.0).normalize_or_zero();
    let turned = |pose: &Standpoint| {
        let cos = pose.facing.with_y(0.0).normalize_or_zero().dot(towards_eye);
        (cos.clamp(-1.0, 1.0).acos() - BESIDE_RAD).cos()
    };
    let faces = poses.iter().map(turned).sum::<f32>() / n;
    let leads = match (seen.first(), seen.last()) {
        (Some(first), Some(last)) => ((last.0 - first.0) / viewport.width_px).clamp(-0.5, 0.5),
        _ => 0.0,
    };
    large - 0.5 * hidden / n + 0.12 * faces + 0.12 * leads
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walk_to(direction: Vec3, n: usize) -> Vec<Standpoint> {
        let at = |k: usize| direction * k as f32;
        let pose =
            |k| Standpoint { foot_m: at(k), head_m: at(k) + Vec3::Y * 1.7, facing: direction };
        (0..n).map(pose).collect()
    }

    #[test]
    fn a_walk_is_seen_from_its_side_and_leads_to_the_right() {
        let viewport = Viewport::new(1600.0, 700.0);
        for direction in [Vec3::Z, Vec3::X, Vec3::new(-0.6, 0.0, 0.8)] {
            let yaw = best_yaw_rad(&walk_to(direction, 7), 0.3, viewport);
            let camera = OrbitCamera { yaw_rad: yaw, ..OrbitCamera::default() };
            let right = camera.world_from_view_rotation() * Vec3::X;
            assert!(right.dot(direction) > 0.75, "{direction}: yaw {yaw}");
            assert!(camera.forward().dot(direction) < 0.05, "{direction}: faces are seen");
        }
    }

    #[test]
    fn one_pose_is_seen_from_its_front_and_beside() {
        let viewport = Viewport::new(640.0, 360.0);
        let yaw = best_yaw_rad(&walk_to(Vec3::Z, 1), 0.3, viewport);
        let off = if yaw > std::f32::consts::PI { TAU - yaw } else { yaw };
        assert!((off - BESIDE_RAD).abs() < 0.14, "{yaw}");
        assert_eq!(best_yaw_rad(&[], 0.3, viewport), OrbitCamera::default().yaw_rad);
    }
}
