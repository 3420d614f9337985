//! Neck and head: a face plane with brow, nose and jaw, so that one sees where it looks.

use glam::Vec3;

use super::field::Layer;
use super::figure::Figure;
use super::shape::{Frame, Loft, Section, Shape, section};

/// The face from the brow (t = 0) down to the mouth (t = 1): half the width, front, back; for a
/// head 0.2275 m high, measured from the ear's axis.
const FACE: [(f32, f32, f32, f32); 4] = [
    (0.00, 0.069, 0.088, 0.030),
    (0.35, 0.067, 0.085, 0.030),
    (0.65, 0.063, 0.086, 0.028),
    (1.00, 0.051, 0.083, 0.022),
];

/// From the chin to the crown.
const HEAD_M: f32 = 0.2275;

/// The head alone.
pub(super) fn head(figure: &Figure) -> Layer {
    let s = figure.scale;
    let at = |x: f32, down: f32, z: f32| {
        figure.crown_m + Vec3::new(x, -down * HEAD_M, z + 0.012) * Vec3::splat(s)
    };
    let mut layer = Layer::default();
    let skull = Frame::new(at(0.0, 0.395, -0.006), Vec3::Y, Vec3::Z);
    let scaled = |r: [f32; 3]| r.map(|r| r * s);
    layer.add(0.0, vec![Shape::Ball(skull, scaled([0.0900, 0.0775, 0.0970]))]);

    let sections: Vec<Section> = FACE
        .iter()
        .map(|&(t, wide, front, back)| {
            // The centre lies so that front and back may be anywhere.
            let mid = 0.5 * (front - back);
            let half = 0.5 * (front + back);
            section(t, [wide; 2], [half; 2]).around(0.0, mid)
        })
        .collect();
    let down = Frame::new(at(0.0, 0.43, 0.0), -Vec3::Y, Vec3::Z);
    let face = Loft::new(down, 0.37 * HEAD_M * s, [0.05 * s, 0.030 * s], s, &sections).squared();
    layer.add(0.035 * s, vec![Shape::Loft(face)]);

    // The jaw: a bow from below the ears to the chin.
    let jaw = [1.0, -1.0].map(|x| Shape::Rod {
        a_m: at(x * 0.041, 0.72, 0.004),
        b_m: at(x * 0.011, 0.93, 0.057),
        radii_m: [0.015 * s, 0.0165 * s],
    });
    layer.add(0.030 * s, jaw.to_vec());

    let nose = Shape::Rod {
        a_m: at(0.0, 0.49, 0.081),
        b_m: at(0.0, 0.635, 0.0895),
        radii_m: [0.007 * s, 0.0100 * s],
    };
    let both = |shape: &dyn Fn(f32) -> Shape| vec![shape(1.0), shape(-1.0)];
    let ball = |p: Vec3, r: [f32; 3]| Shape::Ball(Frame::new(p, Vec3::Y, Vec3::Z), scaled(r));
    // Eye sockets, then the brow over them.
    layer.carve(0.028 * s, both(&|x| ball(at(x * 0.034, 0.485, 0.108), [0.015, 0.023, 0.020])));
    layer.add(0.028 * s, vec![nose]);
    layer.add(0.012 * s, both(&|x| ball(at(x * 0.076, 0.53, -0.012), [0.027, 0.008, 0.015])));
    layer
}

/// The neck alone, with the slopes of the shoulders.
pub(super) fn neck(figure: &Figure) -> Layer {
    let s = figure.scale;
    let mut layer = Layer::default();
    let base = figure.chest_m + Vec3::new(0.0, 0.0, -0.014) * s;
    let top = figure.crown_m + Vec3::new(0.0, -0.55 * HEAD_M, -0.008) * s;
    let along = top - base;
    let frame = Frame::new(base, along, Vec3::Z);
    let sections = [
        section(0.0, [0.070; 2], [0.062, 0.064]),
        section(0.30, [0.058; 2], [0.057, 0.057]),
        section(0.65, [0.053; 2], [0.052, 0.054]),
        section(1.0, [0.053; 2], [0.050, 0.056]),
    ];
    let tube = Loft::new(frame, along.length(), [0.03 * s, 0.03 * s], s, &sections);
    layer.add(0.0, vec![Shape::Loft(tube)]);
    let slopes = [1.0, -1.0]
        .map(|x| Shape::Rod {
            a_m: base + along * 0.42 + Vec3::new(x * 0.020, 0.0, -0.012) * s,
            b_m: figure.chest_m
                + Vec3::new(x * 0.80 * figure.half_shoulders_m, 0.018 * s, -0.012 * s),
            radii_m: [0.036 * s, 0.036 * s],
        })
        .to_vec();
    layer.add(0.07 * s, slopes);
    layer
}
