//! Legs and feet.

use glam::Vec3;

use crate::body_plan::Side;

use super::arm::girth;
use super::field::Layer;
use super::figure::{Leg, sign};
use super::shape::{Frame, Loft, Section, Shape, section};

/// A leg. Frames run downwards with w to the front and v to the body's right, whence `inner`.
pub(super) fn leg(leg: &Leg, side: Side, scale: f32) -> Layer {
    let mut layer = Layer::default();
    let (thigh, shin) = (leg.knee_m - leg.hip_m, leg.ankle_m - leg.knee_m);
    let thigh_s = girth(thigh.length(), 0.42, scale);
    let shin_s = girth(shin.length(), 0.425, scale);
    // [towards the other leg, away from it] as [v, −v].
    let lateral = |inner: f32, outer: f32| {
        if side == Side::Left { [inner, outer] } else { [outer, inner] }
    };
    let frame = Frame::new(leg.hip_m, thigh, Vec3::Z);
    let frame = towards_right(frame);
    let sections = [
        section(0.0, lateral(0.068, 0.068), [0.080, 0.085]),
        section(0.15, lateral(0.080, 0.075), [0.083, 0.087]),
        section(0.35, lateral(0.074, 0.073), [0.080, 0.078]),
        section(0.60, lateral(0.060, 0.063), [0.070, 0.064]),
        section(0.82, lateral(0.052, 0.051), [0.057, 0.053]),
        section(1.0, lateral(0.049, 0.047), [0.050, 0.049]),
    ];
    let caps = [0.11 * thigh_s, 0.045 * thigh_s];
    layer.add(0.0, vec![Shape::Loft(Loft::new(frame, thigh.length(), caps, thigh_s, &sections))]);

    let frame = towards_right(Frame::new(leg.knee_m, shin, Vec3::Z));
    let sections = [
        section(0.0, lateral(0.049, 0.047), [0.047, 0.049]),
        section(0.12, lateral(0.049, 0.048), [0.045, 0.056]),
        section(0.30, lateral(0.052, 0.050), [0.045, 0.066]),
        section(0.50, lateral(0.045, 0.044), [0.041, 0.056]),
        section(0.75, lateral(0.033, 0.033), [0.035, 0.037]),
        section(0.90, lateral(0.030, 0.030), [0.033, 0.034]),
        section(1.0, lateral(0.032, 0.031), [0.034, 0.036]),
    ];
    let caps = [0.045 * shin_s, 0.03 * shin_s];
    layer.add(
        0.004 * scale,
        vec![Shape::Loft(Loft::new(frame, shin.length(), caps, shin_s, &sections))],
    );
    // The knee-cap.
    let cap = leg.knee_m + frame.w * 0.026 * scale - frame.u * 0.010 * scale;
    let radii = [0.062, 0.030, 0.019].map(|r| r * scale);
    layer.add(0.03 * scale, vec![Shape::Ball(Frame::new(cap, shin, Vec3::Z), radii)]);
    layer.grow(0.025 * scale, 1e3 * scale, vec![(foot(leg, side, scale), leg.ankle_m)]);
    layer
}

/// The same frame with v to the body's right (−X).
fn towards_right(frame: Frame) -> Frame {
    if frame.v.x > 0.0 { Frame { v: -frame.v, ..frame } } else { frame }
}

/// A foot with heel, instep, ball and toes on a flat sole.
///
/// Sections run from the heel (t = 0) to the tip (t = 1), by landmarks, so that feet of other
/// proportions keep their ball at the toe joint.
fn foot(leg: &Leg, side: Side, scale: f32) -> Layer {
    let s = scale;
    let up = leg.sole.normal;
    let ankle_m = leg.sole.above_m(leg.ankle_m).clamp(0.035 * s, 0.11 * s);
    let ball_along = (leg.ball_m - leg.ankle_m).dot(leg.forward).clamp(0.06 * s, 0.2 * s);
    let heel_m = 0.050 * s;
    let round_m = 0.024 * s;
    let length_m = heel_m + ball_along + leg.toes_m - 2.0 * round_m;
    // Towards the other foot.
    let inward = up.cross(leg.forward) * -sign(side);
    let under = leg.ankle_m - up * leg.sole.above_m(leg.ankle_m);
    let origin = under - leg.forward * (heel_m - round_m);
    let frame = Frame { origin_m: origin, u: leg.forward, v: inward, w: up };
    let t = |from_ankle: f32| (heel_m - round_m + from_ankle) / length_m;
    let ball_t = t(ball_along);
    let top = |height_m: f32| [height_m / s, 0.020];
    let low = leg.sole.above_m(leg.ball_m).clamp(0.015 * s, 0.06 * s);
    let ball_top = (low + 0.016 * s).clamp(0.034 * s, 0.06 * s);
    let instep = |share: f32| ball_top + (ankle_m + 0.012 * s - ball_top) * share;
    let sections: Vec<Section> = vec![
        section(0.0, [0.031, 0.031], top((ankle_m * 0.85).max(0.04 * s))),
        section(t(0.0), [0.034, 0.035], top(ankle_m)),
        section(t(0.35 * ball_along), [0.031, 0.036], top(instep(0.72))),
        section(t(0.70 * ball_along), [0.038, 0.041], top(instep(0.28))),
        section(ball_t, [0.045, 0.044], top(ball_top)),
        section(0.5 * (ball_t + 1.0), [0.043, 0.040], top(0.82 * ball_top)),
        section(1.0, [0.034, 0.026], top(0.66 * ball_top)).around(0.008, 0.0),
    ];
    let mut layer = Layer::default();
    let tube = Loft::new(frame, length_m, [round_m * 1.1, round_m], s, &sections).squared();
    layer.add(0.0, vec![Shape::Loft(tube)]);
    let ankle = leg.ankle_m;
    let bones = [
        ankle + inward * 0.0215 * s + up * 0.002 * s,
        ankle - inward * 0.0215 * s - up * 0.008 * s,
    ];
    let knob =
        |p: Vec3| Shape::Ball(Frame::new(p, up, leg.forward), [0.015 * s, 0.013 * s, 0.014 * s]);
    layer.add(0.03 * s, bones.map(knob).to_vec());
    layer.stand_on(leg.sole, 0.014 * s);
    layer
}
