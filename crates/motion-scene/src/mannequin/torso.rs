//! The trunk: pelvis, waist, rib cage, shoulders.

use glam::Vec3;

use super::field::Layer;
use super::figure::Figure;
use super::shape::{Frame, Loft, Section, Shape, section};

/// Widths and depths from the crotch (t = 0) to the base of the neck (t = 1), for a body whose
/// shoulder joints are half a metre above its hip joints: half the width, front, back, metres.
const OUTLINE: [(f32, f32, f32, f32); 11] = [
    (0.00, 0.060, 0.050, 0.060),
    (0.07, 0.120, 0.082, 0.092),
    (0.15, 0.152, 0.096, 0.104),
    (0.25, 0.155, 0.098, 0.098),
    (0.36, 0.142, 0.094, 0.082),
    (0.47, 0.128, 0.090, 0.078),
    (0.58, 0.130, 0.096, 0.085),
    (0.72, 0.146, 0.108, 0.100),
    (0.84, 0.152, 0.106, 0.108),
    (0.93, 0.132, 0.082, 0.100),
    (1.00, 0.080, 0.056, 0.080),
];

/// The crotch is this far below the hip joints, the base of the neck above the shoulder joints.
const BELOW_HIPS_M: f32 = 0.085;
const ABOVE_SHOULDERS_M: f32 = 0.055;

/// The trunk without neck and limbs.
pub(super) fn trunk(figure: &Figure) -> Layer {
    let s = figure.scale;
    let frame = trunk_frame(figure);
    let length_m = figure.pelvis_m.distance(figure.chest_m).max(0.1 * s);
    let total_m = length_m + (BELOW_HIPS_M + ABOVE_SHOULDERS_M) * s;
    // As wide as the joints say, near the joints.
    let hips = (figure.half_hips_m / (0.092 * s)).powf(0.6);
    let shoulders = (figure.half_shoulders_m / (0.180 * s)).powf(0.6);
    let sections: Vec<Section> = OUTLINE
        .iter()
        .map(|&(t, wide, front, back)| {
            let wide = wide * (hips + (shoulders - hips) * smooth(t, 0.3, 0.75));
            section(t, [wide; 2], [front, back])
        })
        .collect();
    let mut layer = Layer::default();
    let tube = Loft::new(frame, total_m, [0.02 * s, 0.02 * s], s, &sections).squared(2.35);
    layer.add(0.0, vec![Shape::Loft(tube)]);

    let both = |at: &dyn Fn(f32) -> Vec3, radii: [f32; 3], lean: Vec3| -> Vec<Shape> {
        [1.0, -1.0]
            .map(|side| {
                let u = Vec3::new(side * lean.x, lean.y, lean.z);
                let ball = Frame::new(at(side), u, Vec3::Z);
                Shape::Ball(ball, radii.map(|r| r * s))
            })
            .to_vec()
    };
    let at = |x: f32, y: f32, z: f32| move |side: f32| frame.at(y * s, side * x * s, z * s);
    let hip_y = BELOW_HIPS_M;
    // The seat.
    layer.add(
        0.05 * s,
        both(&at(0.070 * hips, hip_y - 0.005, -0.062), [0.085, 0.080, 0.062], Vec3::Y),
    );
    // The chest's two halves; hardly more than a hint.
    let chest_y = hip_y + length_m / s;
    layer.add(
        0.05 * s,
        both(&at(0.068, chest_y - 0.085, 0.066), [0.062, 0.078, 0.042], Vec3::new(0.25, 1.0, -0.2)),
    );
    // Shoulder blades and the broad muscle of the back.
    layer.add(
        0.05 * s,
        both(&at(0.085, chest_y - 0.075, -0.066), [0.090, 0.060, 0.042], Vec3::new(0.15, 1.0, 0.1)),
    );
    layer
}

/// Up from the crotch; v to the left, w to the front.
pub(super) fn trunk_frame(figure: &Figure) -> Frame {
    let up = (figure.chest_m - figure.pelvis_m).try_normalize().unwrap_or(Vec3::Y);
    let up = if up.y < 0.3 { Vec3::Y } else { up };
    Frame::new(figure.pelvis_m - up * BELOW_HIPS_M * figure.scale, up, Vec3::Z)
}

/// 0 below `from`, 1 above `to`, smooth between.
pub(super) fn smooth(x: f32, from: f32, to: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
