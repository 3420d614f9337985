//! Feature vectors written down from the definition (`C` of AF02 appendix A), in f64 and with
//! nothing shared with the crate that is measured but the clips and the list of columns.

use glam::{DQuat, DVec3};
use motion_core::clip::{Clip, ClipSet};
use motion_core::similarity::{ColumnSource, Metric};
use motion_core::skeleton::Skeleton;

use super::quantile::quantile;

/// The share of neighbouring-frame changes that a normaliser covers, and its least value.
const NORMALISER: (f64, f64) = (0.999, 1e-6);

/// A vector for every frame of a set of clips.
pub(crate) struct PlainFeatures {
    /// Row of each clip's frame 0; one more entry at the end.
    pub(crate) frame_starts: Vec<usize>,
    /// How far the normalisers found here are from those of the graph, relative, at most.
    pub(crate) normaliser_error: f64,
    n_dims: usize,
    rows: Vec<f64>,
}

impl PlainFeatures {
    /// Vectors by the columns and weights of `metric`, with normalisers of their own.
    pub(crate) fn new(set: &ClipSet, metric: &Metric) -> Self {
        let columns: Vec<Vec<Vec<DVec3>>> =
            set.clips().iter().map(|clip| columns(set.skeleton(), clip, metric)).collect();
        let weights = metric.columns.iter().map(|c| c.weight);
        let weights: Vec<f64> =
            weights.chain(metric.columns.iter().map(|c| c.derivative_weight)).collect();
        let known: Vec<f64> =
            metric.change.iter().chain(&metric.derivative_change).copied().collect();
        let mut normaliser_error = 0f64;
        let mut scales = Vec::new();
        for (k, weight) in weights.iter().enumerate() {
            let changes = columns.iter().flat_map(|clip| {
                clip[k].windows(2).map(|pair| (pair[1] - pair[0]).length_squared())
            });
            let changes: Vec<f64> = changes.collect();
            let normaliser = quantile(&changes, NORMALISER.0).max(NORMALISER.1);
            normaliser_error = normaliser_error.max((known[k] / normaliser - 1.0).abs());
            scales.push((weight / normaliser).sqrt());
        }
        let mut frame_starts = vec![0];
        let mut rows = Vec::new();
        for (clip, columns) in set.clips().iter().zip(&columns) {
            for frame in 0..clip.n_frames() {
                for (column, scale) in columns.iter().zip(&scales) {
                    rows.extend((column[frame] * *scale).to_array());
                }
            }
            frame_starts.push(rows.len() / (3 * scales.len()));
        }
        Self { frame_starts, normaliser_error, n_dims: 3 * scales.len(), rows }
    }

    /// How many frames there are.
    pub(crate) fn n_rows(&self) -> usize {
        self.frame_starts[self.frame_starts.len() - 1]
    }

    /// The cost of a pair where it is below `limit`.
    pub(crate) fn cost_below(&self, a: usize, b: usize, limit: f64) -> Option<f64> {
        let row = |row: usize| &self.rows[row * self.n_dims..(row + 1) * self.n_dims];
        let mut sum = 0.0;
        for (x, y) in row(a).chunks(12).zip(row(b).chunks(12)) {
            sum += x.iter().zip(y).map(|(x, y)| (x - y) * (x - y)).sum::<f64>();
            if sum >= limit {
                return None;
            }
        }
        Some(sum)
    }
}

/// Every column frame by frame, then every column's time derivative.
fn columns(skeleton: &Skeleton, clip: &Clip, metric: &Metric) -> Vec<Vec<DVec3>> {
    let motion = &clip.motion;
    let frames = 0..motion.n_frames();
    let fps = motion.fps().get();
    let quat = |q: glam::Quat| q.as_dquat().normalize();
    let root: Vec<DVec3> = motion.root_positions_m().iter().map(|p| p.as_dvec3()).collect();
    let into_torso: Vec<DQuat> = clip
        .track
        .world_from_torso
        .iter()
        .map(|t| DQuat::from_rotation_y(-f64::from(t.sin()).atan2(f64::from(t.cos()))))
        .collect();
    let torso_at = |frame: usize| {
        let torso = clip.track.world_from_torso[frame];
        DVec3::new(f64::from(torso.x_m), f64::from(torso.level_m), f64::from(torso.z_m))
    };
    let mut joints: Vec<Vec<DVec3>> = Vec::new();
    let mut rotations: Vec<Vec<DQuat>> = Vec::new();
    for (idx, joint) in skeleton.joints().iter().enumerate() {
        let own = frames.clone().map(|frame| quat(motion.rotations(frame)[idx]));
        let (at, turned): (Vec<DVec3>, Vec<DQuat>) = match joint.parent.map(|p| p.idx()) {
            None => root.iter().copied().zip(own).unzip(),
            Some(p) => own
                .enumerate()
                .map(|(frame, q)| {
                    let carrier = rotations[p][frame];
                    (joints[p][frame] + carrier * joint.offset_m.as_dvec3(), carrier * q)
                })
                .unzip(),
        };
        joints.push(at);
        rotations.push(turned);
    }
    let velocity = differences(&root, fps, |a, b| b - a);
    let turn = differences(&rotations[0], fps, |a, b| {
        let q = b * a.inverse();
        let q = if q.w < 0.0 { -q } else { q };
        let axis = DVec3::new(q.x, q.y, q.z);
        let sin = axis.length();
        if sin == 0.0 { DVec3::ZERO } else { axis * (2.0 * sin.atan2(q.w) / sin) }
    });
    let seen = |series: &[DVec3]| -> Vec<DVec3> {
        series.iter().zip(&into_torso).map(|(v, q)| *q * *v).collect()
    };
    let (mut values, mut derivatives) = (Vec::new(), Vec::new());
    for column in &metric.columns {
        let of_velocity = |v: &[DVec3]| (seen(v), seen(&differences(v, fps, |a, b| b - a)));
        let (value, derivative) = match column.source {
            ColumnSource::Joint(joint) => {
                let at = joints[joint.idx()].iter().enumerate();
                let value: Vec<DVec3> =
                    at.map(|(frame, p)| into_torso[frame] * (*p - torso_at(frame))).collect();
                let derivative = differences(&value, fps, |a, b| b - a);
                (value, derivative)
            }
            ColumnSource::TorsoVelocity => of_velocity(&velocity),
            ColumnSource::TorsoTurn => of_velocity(&turn),
        };
        values.push(value);
        derivatives.push(derivative);
    }
    values.append(&mut derivatives);
    values
}

/// Central differences a second, one-sided at the ends, 0 for a single frame.
fn differences<T: Copy>(series: &[T], fps: f64, minus: impl Fn(T, T) -> DVec3) -> Vec<DVec3> {
    let last = series.len() - 1;
    let at = |frame: usize| {
        let (before, after) = (frame.saturating_sub(1), (frame + 1).min(last));
        minus(series[before], series[after]) * (fps / (after - before).max(1) as f64)
    };
    (0..series.len()).map(at).collect()
}
