//! A human body put together: what grows from what, and what moves it.

use glam::Vec3;

use crate::body_plan::Side;

use super::field::{Layer, Plane};
use super::figure::{Arm, Figure, Leg, sign};
use super::grid::Detail;
use super::torso::{smooth, trunk_frame};
use super::weights::Weights;
use super::{arm, head, leg, torso};

/// A human body as a field, and its parts by themselves, by which skin is shared out.
pub(super) struct Human {
    pub(super) body: Layer,
    figure: Figure,
    trunk: Layer,
    neck: Layer,
    head: Layer,
    arms: [Option<Layer>; 2],
}

impl Human {
    pub(super) fn new(figure: Figure) -> Self {
        let s = figure.scale;
        let trunk = torso::trunk(&figure);
        let neck = head::neck(&figure);
        let head = head::head(&figure);
        let breadth = figure.half_shoulders_m / (0.18 * s);
        let arms = Side::BOTH
            .map(|side| figure.arms[side.idx()].as_ref().map(|a| arm::arm(a, side, s, breadth)));
        let mut body = trunk.clone();
        let mut above = neck.clone();
        let far = 1e3 * s;
        above.grow(0.028 * s, far, vec![(head.clone(), figure.skull_m)]);
        body.grow(0.06 * s, far, vec![(above, figure.chest_m)]);
        let legs = Side::BOTH
            .into_iter()
            .filter_map(|side| Some((side, figure.legs[side.idx()].as_ref()?)))
            .map(|(side, l)| (leg::leg(l, side, s), l.hip_m))
            .collect();
        body.grow(0.07 * s, 0.17 * s, legs);
        let grown = arms
            .iter()
            .zip(&figure.arms)
            .filter_map(|(layer, arm)| Some((layer.clone()?, arm.as_ref()?.shoulder_m)));
        body.grow(0.085 * s, 0.15 * s, grown.collect());
        Self { body, figure, trunk, neck, head, arms }
    }

    /// 1 for a body of usual height.
    pub(super) fn scale(&self) -> f32 {
        self.figure.scale
    }

    /// Where triangles must be small.
    pub(super) fn details(&self) -> Vec<Detail> {
        let s = self.figure.scale;
        let around = |points: &[Vec3], reach: f32, step: f32| {
            let low = points.iter().copied().reduce(Vec3::min).unwrap_or(Vec3::ZERO);
            let high = points.iter().copied().reduce(Vec3::max).unwrap_or(Vec3::ZERO);
            Detail { low_m: low - reach * s, high_m: high + reach * s, step_m: step * s }
        };
        let f = &self.figure;
        let mut details = vec![around(&[f.skull_m - Vec3::Y * 0.02 * s, f.crown_m], 0.03, 0.0075)];
        for arm in f.arms.iter().flatten() {
            details.push(around(&[arm.wrist_m, arm.tip_m], 0.022, 0.0046));
        }
        for leg in f.legs.iter().flatten() {
            details.push(around(&[leg.ankle_m, leg.ball_m], 0.05, 0.009));
        }
        details
    }

    /// How much more than elsewhere the shape at `p` is to be kept at a level of detail.
    ///
    /// The finest is looked at from near, where hands tell most; the others from far, where heads
    /// do.
    pub(super) fn importance(&self, p: Vec3, level: usize) -> f32 {
        let (f, s) = (&self.figure, self.figure.scale);
        let near = |at: Vec3, reach: f32| 1.0 - smooth(p.distance(at), 0.5 * reach * s, reach * s);
        let is_finest = level == 0;
        let face = f.skull_m.lerp(f.crown_m, 0.4) + Vec3::Z * 0.05 * s;
        let mut most = if is_finest { 2.0 } else { 4.0 } * near(face, 0.16);
        let mut least = 1.0_f32;
        for arm in f.arms.iter().flatten() {
            let hand = near(arm.wrist_m.lerp(arm.tip_m, 0.6), 0.13);
            if is_finest {
                most = most.max(5.0 * hand);
            } else {
                least = least.min(1.0 - 0.9 * hand);
            }
            most = most.max(2.0 * near(arm.elbow_m, 0.09)).max(1.5 * near(arm.shoulder_m, 0.12));
        }
        for leg in f.legs.iter().flatten() {
            most = most.max(2.0 * near(leg.knee_m, 0.11)).max(1.0 * near(leg.hip_m, 0.16));
            most = most.max(1.5 * near(leg.ball_m, 0.16)).max(near(leg.ankle_m, 0.12));
        }
        least * (1.0 + most)
    }

    /// The plane in which the body is its own mirror image, if it is.
    pub(super) fn mirror_x_m(&self) -> Option<f32> {
        let f = &self.figure;
        let x = f.pelvis_m.x;
        let tolerance_m = 2e-5 * f.scale;
        let is_image =
            |a: Vec3, b: Vec3| (a - Vec3::new(2.0 * x - b.x, b.y, b.z)).length() < tolerance_m;
        let middle = [f.pelvis_m, f.chest_m, f.skull_m, f.crown_m];
        let arms = match &f.arms {
            [Some(l), Some(r)] => {
                is_image(l.shoulder_m, r.shoulder_m)
                    && is_image(l.elbow_m, r.elbow_m)
                    && is_image(l.wrist_m, r.wrist_m)
                    && is_image(l.tip_m, r.tip_m)
            }
            [None, None] => true,
            _ => false,
        };
        let legs = match &f.legs {
            [Some(l), Some(r)] => {
                is_image(l.hip_m, r.hip_m)
                    && is_image(l.knee_m, r.knee_m)
                    && is_image(l.ankle_m, r.ankle_m)
                    && is_image(l.ball_m, r.ball_m)
                    && (l.toes_m - r.toes_m).abs() < tolerance_m
                    && is_image(l.sole.point_m, r.sole.point_m)
                    && (l.sole.normal + r.sole.normal).x.abs() < 1e-4
            }
            [None, None] => true,
            _ => false,
        };
        (arms && legs && middle.iter().all(|&p| is_image(p, p))).then_some(x)
    }

    /// The sole below `p`, for points within `slack_m` of it or under it.
    pub(super) fn sole(&self, p: Vec3, slack_m: f32) -> Option<Plane> {
        let s = self.figure.scale;
        self.figure.legs.iter().flatten().map(|leg| (leg, leg.sole.above_m(p))).find_map(
            |(leg, above_m)| {
                let middle = leg.ankle_m.lerp(leg.ball_m, 0.5);
                let aside_m = (p - middle).reject_from_normalized(leg.sole.normal).length();
                let is_near = aside_m < 0.2 * s && above_m > -0.05 * s && above_m < slack_m;
                is_near.then_some(leg.sole)
            },
        )
    }

    /// Which joints move the skin at `p`.
    pub(super) fn weights(&self, p: Vec3) -> Weights {
        let mut weights = self.trunk_weights(p);
        for side in Side::BOTH {
            if let (Some(arm), Some(layer)) =
                (&self.figure.arms[side.idx()], &self.arms[side.idx()])
            {
                self.add_arm(&mut weights, p, side, arm, layer);
            }
        }
        for side in Side::BOTH {
            if let Some(leg) = &self.figure.legs[side.idx()] {
                self.add_leg(&mut weights, p, side, leg);
            }
        }
        weights
    }

    /// Along the back each link takes over from the one below it, around its joint.
    fn trunk_weights(&self, p: Vec3) -> Weights {
        let f = &self.figure;
        let s = f.scale;
        let frame = trunk_frame(f);
        let height = |at: Vec3| (at - f.pelvis_m).dot(frame.u);
        let neck_from = f.spine.len() - f.n_neck;
        let chest = height(f.chest_m) + 0.035 * s;
        let skull = height(f.skull_m).max(chest + 0.02 * s);
        let mut weights = Weights::default();
        let mut share = 1.0_f32;
        for (idx, &(joint, at)) in f.spine.iter().enumerate() {
            let is_last = idx + 1 == f.spine.len();
            let next = f.spine.get(idx + 1).map_or(0.0, |&(next, next_at)| {
                let is_head = f.n_neck > 0 && idx + 2 == f.spine.len() && next == f.head_joint;
                let taken = if is_head && self.has_head() {
                    let toward_head = self.neck.distance_m(p) - self.head.distance_m(p);
                    smooth(toward_head, -0.028 * s, 0.028 * s)
                } else if idx + 1 >= neck_from {
                    let h = height(next_at).clamp(chest, skull.max(chest));
                    let aside = ((p - f.chest_m).dot(frame.v).abs() - 0.05 * s).max(0.0);
                    let at_p = height(p) - 0.8 * aside;
                    smooth(at_p, h - 0.03 * s, h + 0.04 * s)
                } else {
                    // A trunk may be shorter than what is kept free below and above.
                    let low = 0.07 * s;
                    let h = height(next_at).clamp(low, (chest - 0.08 * s).max(low));
                    let reach = (0.6 * at.distance(next_at)).clamp(0.05 * s, 0.075 * s);
                    smooth(height(p), h - reach, h + reach)
                };
                taken.min(share)
            });
            weights.add(joint, share - if is_last { 0.0 } else { next });
            share = next;
        }
        weights
    }

    fn has_head(&self) -> bool {
        self.figure.n_neck > 0
    }

    fn add_arm(&self, weights: &mut Weights, p: Vec3, side: Side, arm: &Arm, layer: &Layer) {
        let f = &self.figure;
        let s = f.scale;
        let frame = trunk_frame(f);
        // The collar bone carries what is between the neck and the shoulder, above the armpit.
        let from_middle = (p - f.chest_m).dot(Vec3::X) * sign(side) / f.half_shoulders_m;
        let up = (p - f.chest_m).dot(frame.u);
        let collar = 0.9 * smooth(from_middle, 0.25, 0.95) * smooth(up, -0.14 * s, -0.01 * s);
        weights.take(arm.movers[0], collar);

        let (upper, fore, hand) = (
            direction(arm.shoulder_m, arm.elbow_m),
            direction(arm.elbow_m, arm.wrist_m),
            direction(arm.wrist_m, arm.tip_m),
        );
        let out = (p - arm.shoulder_m).dot(upper);
        if out < -0.10 * s {
            return;
        }
        let on_arm = self.trunk.distance_m(p) - layer.distance_m(p);
        let member = smooth(on_arm, -0.03 * s, 0.03 * s);
        let taken = smooth(out, -0.085 * s, 0.085 * s) * member;
        weights.take(arm.movers[1], taken);
        if taken <= 0.0 || out < 0.03 * s {
            return;
        }
        let radius = 0.042 * s;
        let front = Vec3::Z.reject_from_normalized(fore);
        // The point of the elbow belongs to the forearm.
        let elbow =
            Bend { at: arm.elbow_m, from: upper, to: fore, radius, flexes: front, shift: -0.7 };
        weights.pass_on(arm.movers[1], arm.movers[2], elbow.share(p));
        let along = (p - arm.wrist_m).dot((fore + hand).normalize_or_zero());
        weights.pass_on(arm.movers[2], arm.movers[3], smooth(along, -0.045 * s, 0.022 * s));
    }

    fn add_leg(&self, weights: &mut Weights, p: Vec3, side: Side, leg: &Leg) {
        let f = &self.figure;
        let s = f.scale;
        let (thigh, shin) = (direction(leg.hip_m, leg.knee_m), direction(leg.knee_m, leg.ankle_m));
        let q = p - leg.hip_m;
        let down = q.dot(thigh);
        if down < -0.16 * s {
            return;
        }
        let outward = q.x * sign(side);
        let back = smooth(-q.z, -0.03 * s, 0.08 * s);
        let center = -0.005 * s + 0.012 * s * back - 0.25 * outward.max(0.0);
        let reach = (0.062 + 0.035 * back) * s;
        let mut taken = smooth(down, center - reach, center + reach);
        // What is between the legs stays with the pelvis.
        let from_middle = (p.x - f.pelvis_m.x) * sign(side);
        let apart = smooth(from_middle, 0.0, 0.05 * s);
        taken *=
            apart + (1.0 - apart) * smooth(down, 0.09 * s, 0.17 * s) * f32::from(from_middle > 0.0);
        // Hands may hang beside the thighs.
        let arms: f32 = f.arms.iter().flatten().map(|arm| weights.of(&arm.movers[1..])).sum();
        weights.take(leg.movers[0], taken * (1.0 - arms.min(1.0)));
        if taken <= 0.0 {
            return;
        }
        let front = Vec3::Z.reject_from_normalized(thigh);
        // The knee-cap stays with the thigh: so the knee keeps its corner as it bends.
        let knee = Bend {
            at: leg.knee_m,
            from: thigh,
            to: shin,
            radius: 0.052 * s,
            flexes: -front,
            shift: 0.75,
        };
        weights.pass_on(leg.movers[0], leg.movers[1], knee.share(p));
        let across = (shin + 0.35 * leg.forward).normalize_or_zero();
        let below = (p - leg.ankle_m).dot(across);
        weights.pass_on(leg.movers[1], leg.movers[2], smooth(below, -0.045 * s, 0.02 * s));
        let before = (p - leg.ball_m).dot(leg.forward);
        weights.pass_on(leg.movers[2], leg.movers[3], smooth(before, -0.024 * s, 0.020 * s));
    }
}

fn direction(from: Vec3, to: Vec3) -> Vec3 {
    (to - from).try_normalize().unwrap_or(-Vec3::Y)
}

/// How skin is shared around a hinge.
struct Bend {
    at: Vec3,
    from: Vec3,
    to: Vec3,
    radius: f32,
    /// The side on which the angle closes.
    flexes: Vec3,
    /// How far the change is moved along the limb on the other side, in radii.
    shift: f32,
}

impl Bend {
    /// How much of `p` goes with the far bone.
    ///
    /// Linear blending draws what is shared half and half towards the hinge, by 1 − cos(θ/2). On
    /// the closing side that makes room; on the other side the change is narrow and moved off the
    /// joint, so that one bone's flesh keeps the corner.
    fn share(&self, p: Vec3) -> f32 {
        let along = (self.from + self.to).try_normalize().unwrap_or(self.to);
        let q = p - self.at;
        let closing = smooth(q.dot(self.flexes.normalize_or_zero()) / self.radius, -0.9, 0.7);
        let center = self.shift * self.radius * (1.0 - closing);
        let reach = self.radius * (0.45 + 0.40 * closing);
        smooth(q.dot(along), center - reach, center + reach)
    }
}
