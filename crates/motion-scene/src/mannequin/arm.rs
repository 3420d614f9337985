//! Arms and hands.

use glam::Vec3;

use crate::body_plan::Side;

use super::field::Layer;
use super::figure::{Arm, sign};
use super::shape::{Frame, Loft, Shape, section};

/// The way the palm faces, across `along`: down where the arms are spread, inwards where they
/// hang.
pub(super) fn palm(side: Side, along: Vec3) -> Vec3 {
    let across = along.cross(Vec3::Z) * sign(side);
    across.try_normalize().unwrap_or(-Vec3::Y)
}

/// An arm without its hand. Frames have w to the front (the bend of the elbow), v across.
///
/// `breadth` is that of the shoulders, 1 where it is usual.
pub(super) fn arm(arm: &Arm, side: Side, scale: f32, breadth: f32) -> Layer {
    let mut layer = Layer::default();
    let upper = arm.elbow_m - arm.shoulder_m;
    let fore = arm.wrist_m - arm.elbow_m;
    let upper_s = girth(upper.length(), 0.285, scale);
    let fore_s = girth(fore.length(), 0.25, scale);

    let frame = Frame::new(arm.shoulder_m, upper, Vec3::Z);
    let sections = [
        section(0.0, [0.052; 2], [0.052, 0.054]),
        section(0.22, [0.049; 2], [0.049, 0.052]),
        section(0.48, [0.044; 2], [0.048, 0.047]),
        section(0.75, [0.039; 2], [0.043, 0.040]),
        section(1.0, [0.037; 2], [0.037, 0.037]),
    ];
    let caps = [0.045 * upper_s, 0.035 * upper_s];
    layer.add(0.0, vec![Shape::Loft(Loft::new(frame, upper.length(), caps, upper_s, &sections))]);
    // The shoulder's cap; less of it where the joints lie far outside, as CMU's do.
    let cap_s = scale * breadth.recip().clamp(0.8, 1.1);
    let cap = frame.at(0.028 * scale, 0.0, 0.0) + Vec3::Y * 0.004 * scale;
    let radii = [0.076, 0.051, 0.056].map(|r| r * cap_s);
    layer.add(0.03 * scale, vec![Shape::Ball(Frame::new(cap, upper, Vec3::Z), radii)]);

    let frame = Frame::new(arm.elbow_m, fore, Vec3::Z);
    let sections = [
        section(0.0, [0.038; 2], [0.038, 0.038]),
        section(0.22, [0.039; 2], [0.045, 0.041]),
        section(0.50, [0.033; 2], [0.038, 0.036]),
        section(0.80, [0.0245; 2], [0.031, 0.030]),
        section(1.0, [0.0215; 2], [0.0295, 0.0285]),
    ];
    let caps = [0.035 * fore_s, 0.02 * fore_s];
    layer.add(
        0.004 * scale,
        vec![Shape::Loft(Loft::new(frame, fore.length(), caps, fore_s, &sections))],
    );
    // The point of the elbow.
    let point = arm.elbow_m - frame.w * 0.017 * scale;
    layer
        .add(0.02 * scale, vec![Shape::Ball(Frame::new(point, fore, Vec3::Z), [0.019 * scale; 3])]);
    layer.grow(0.004 * scale, 1e3 * scale, vec![(hand(arm, side, scale), arm.wrist_m)]);
    layer
}

/// How much thicker a limb is than the table's, whose bone is `usual_m` long at scale 1: long
/// bones are a little thicker.
pub(super) fn girth(length_m: f32, usual_m: f32, scale: f32) -> f32 {
    let ratio = length_m / (usual_m * scale).max(1e-9);
    scale * ratio.clamp(0.2, 3.0).powf(0.25)
}

/// A relaxed hand: four fingers side by side, bent a little towards the palm, and a thumb.
fn hand(arm: &Arm, side: Side, scale: f32) -> Layer {
    let along = arm.tip_m - arm.wrist_m;
    let s = along.length() / 0.183;
    let palm_dir = palm(side, along);
    // u to the fingertips, v or −v to the thumb, w out of the back of the hand.
    let frame = Frame::new(arm.wrist_m, along, -palm_dir);
    let thumb = if frame.v.dot(Vec3::Z) >= 0.0 { 1.0 } else { -1.0 };
    let at = |u: f32, v: f32, w: f32| frame.at(u * s, v * thumb * s, w * s);
    let s_min = s.min(1.3 * scale);
    let mut layer = Layer::default();
    let sections = [
        section(0.0, [0.029; 2], [0.019, 0.019]),
        section(0.30, [0.034; 2], [0.016, 0.019]),
        section(0.65, [0.040; 2], [0.014, 0.017]),
        section(1.0, [0.041; 2], [0.0115, 0.0135]),
    ];
    let palm = Loft::new(frame, 0.088 * s, [0.02 * s, 0.010 * s], s_min, &sections).squared();
    layer.add(0.0, vec![Shape::Loft(palm)]);
    // (across at the knuckle, length, radius, knuckle along)
    const FINGERS: [(f32, f32, f32, f32); 4] = [
        (0.0300, 0.078, 0.0092, 0.088),
        (0.0100, 0.088, 0.0094, 0.091),
        (-0.0100, 0.081, 0.0091, 0.089),
        (-0.0292, 0.064, 0.0083, 0.083),
    ];
    for (v, length, r, knuckle) in FINGERS {
        let splay = v * 0.34;
        let bend = |share: f32, drop: f32| {
            at(knuckle + length * share, v + splay * share, -0.002 - drop * length)
        };
        let points = [bend(-0.12, -0.02), bend(0.45, 0.04), bend(0.75, 0.14), bend(0.95, 0.28)];
        for (i, pair) in points.windows(2).enumerate() {
            let radius = |i: usize| r * (1.0 - 0.07 * i as f32) * s;
            let rod =
                Shape::Rod { a_m: pair[0], b_m: pair[1], radii_m: [radius(i), radius(i + 1)] };
            layer.add(if i == 0 { 0.007 * s } else { 0.002 * s }, vec![rod]);
        }
    }
    let points = [
        at(0.018, 0.022, -0.008),
        at(0.052, 0.047, -0.018),
        at(0.083, 0.056, -0.022),
        at(0.106, 0.057, -0.025),
    ];
    let radii = [0.0175, 0.0140, 0.0115, 0.0098];
    for (i, pair) in points.windows(2).enumerate() {
        let rod =
            Shape::Rod { a_m: pair[0], b_m: pair[1], radii_m: [radii[i] * s, radii[i + 1] * s] };
        layer.add(if i == 0 { 0.018 * s } else { 0.005 * s }, vec![rod]);
    }
    layer
}
