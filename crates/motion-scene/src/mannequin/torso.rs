//! The trunk: pelvis, waist, rib cage, shoulders.

use glam::Vec3;

use super::field::Layer;
use super::figure::Figure;
use super::shape::{Frame, Loft, Section, Shape, section};

/// Widths and depths from the hip joints (t = 0) to a little below the shoulder joints (t = 1), for
/// a body whose shoulder joints are half a metre above its hip joints: half the width, front, back,
/// metres. Both ends go on as domes: the seat, and the slope to the neck.
const OUTLINE: [(f32, f32, f32, f32); 8] = [
    (0.00, 0.150, 0.092, 0.104),
    (0.10, 0.155, 0.096, 0.104),
    (0.26, 0.148, 0.096, 0.088),
    (0.41, 0.131, 0.091, 0.078),
    (0.55, 0.132, 0.094, 0.083),
    (0.72, 0.153, 0.107, 0.100),
    (0.88, 0.164, 0.114, 0.108),
    (1.00, 0.157, 0.106, 0.108),
];

/// The upper dome begins this far below the shoulder joints.
const BELOW_SHOULDERS_M: f32 = 0.03;
/// How far the domes reach.
const DOMES_M: [f32; 2] = [0.072, 0.085];

/// The trunk without neck and limbs.
pub(super) fn trunk(figure: &Figure) -> Layer {
    let s = figure.scale;
    let frame = trunk_frame(figure);
    let length_m = figure.pelvis_m.distance(figure.chest_m).max(0.1 * s);
    let total_m = length_m - BELOW_SHOULDERS_M * s;
    // As wide as the joints say, near the joints.
    let hips = (figure.half_hips_m / (0.092 * s)).powf(0.6);
    let shoulders = (figure.half_shoulders_m / (0.180 * s)).powf(0.8);
    let sections: Vec<Section> = OUTLINE
        .iter()
        .map(|&(t, wide, front, back)| {
            let wide = wide * (hips + (shoulders - hips) * smooth(t, 0.3, 0.75));
            section(t, [wide; 2], [front, back])
        })
        .collect();
    let mut layer = Layer::default();
    let tube = Loft::new(frame, total_m, DOMES_M.map(|dome| dome * s), s, &sections).squared();
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
    // The seat.
    let seat = both(&at(0.072 * hips, -0.008, -0.056), [0.090, 0.082, 0.056], Vec3::Y);
    layer.add(0.06 * s, seat);
    // The plates of the chest and the shoulder blades; hardly more than a hint.
    let chest_y = length_m / s;
    let lean = Vec3::new(0.30, 1.0, -0.25);
    let plates = both(&at(0.078, chest_y - 0.060, 0.062), [0.085, 0.070, 0.034], lean);
    layer.add(0.035 * s, plates);
    let blades = both(&at(0.090, chest_y - 0.065, -0.062), [0.075, 0.050, 0.036], Vec3::Y);
    layer.add(0.035 * s, blades);
    layer
}

/// Up from between the hip joints; v to the left, w to the front.
pub(super) fn trunk_frame(figure: &Figure) -> Frame {
    let up = (figure.chest_m - figure.pelvis_m).try_normalize().unwrap_or(Vec3::Y);
    let up = if up.y < 0.3 { Vec3::Y } else { up };
    Frame::new(figure.pelvis_m, up, Vec3::Z)
}

/// 0 below `from`, 1 above `to`, smooth between.
pub(super) fn smooth(x: f32, from: f32, to: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
