//! BVH out.

use std::fmt::Write as _;

use glam::{DMat3, DQuat, DVec3, Vec3};
use motion_core::ids::JointIdx;
use motion_core::motion::Motion;
use motion_core::skeleton::Skeleton;
use motion_core::units::Fps;

use super::frames::nominal_rate;
use crate::text::parse_number;

/// Writes into a `String`, which cannot fail.
macro_rules! put {
    ($out:expr, $($format:tt)*) => {
        if $out.write_fmt(format_args!($($format)*)).is_err() {
            debug_assert!(false, "a string takes everything");
        }
    };
}

/// How a motion is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BvhWriteOptions {
    /// Metres of one file unit.
    pub metres_per_unit: f64,
    /// The order of the rotation channels of every joint.
    pub euler_order: EulerOrder,
}

impl Default for BvhWriteOptions {
    /// Centimetres and Z X Y, as most programs write BVH.
    fn default() -> Self {
        Self { metres_per_unit: 0.01, euler_order: EulerOrder::Zxy }
    }
}

/// An order of rotation channels, the outermost first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EulerOrder {
    /// `Rz · Rx · Ry`: singular where a joint is pitched by a quarter turn. Headings are free of
    /// it.
    Zxy,
    /// `Rz · Ry · Rx`: singular at headings of a quarter turn.
    Zyx,
}

/// The text of a BVH file.
///
/// Joints come in the skeleton's order, children behind their parents. Numbers have six decimals,
/// so a motion that is read back agrees within 0.1 mm and 0.01°. Angles go on from frame to frame
/// without jumps of a whole turn, so they may leave ±180°. The same motion gives the same bytes.
///
/// The rest pose is written as it is: in a library it faces +Z with Y up.
pub fn write(skeleton: &Skeleton, motion: &Motion, options: &BvhWriteOptions) -> String {
    debug_assert_eq!(skeleton.n_joints(), motion.n_joints(), "another skeleton's motion");
    let order = nested_order(skeleton);
    let mut out = String::from("HIERARCHY\n");
    write_joints(&mut out, skeleton, &order, options);
    put!(out, "MOTION\nFrames: {}\nFrame Time: {}\n", motion.n_frames(), frame_time(motion.fps()));
    let mut angles_rad = vec![DVec3::ZERO; skeleton.n_joints()];
    for frame in 0..motion.n_frames() {
        let position = motion.root_positions_m()[frame];
        push_vec(&mut out, position, options.metres_per_unit);
        let rotations = motion.rotations(frame);
        for &(joint, _) in &order {
            let angles = &mut angles_rad[joint.idx()];
            *angles = euler_near(rotations[joint.idx()].as_dquat(), options.euler_order, *angles);
            for axis in 0..3 {
                out.push(' ');
                push_number(&mut out, angles[axis].to_degrees());
            }
        }
        out.push('\n');
    }
    out
}

/// The shortest of a few usual precisions that reads back as the same rate.
fn frame_time(fps: Fps) -> String {
    for decimal_places in [7u8, 9, 12] {
        let text = format!("{:.*}", usize::from(decimal_places), fps.frame_secs());
        let read = parse_number(text.as_bytes());
        if read.map(|secs| nominal_rate(secs, i32::from(decimal_places))) == Some(fps.get()) {
            return text;
        }
    }
    format!("{:.17}", fps.frame_secs())
}

/// Joints depth first with their depth, siblings in the skeleton's order.
pub(super) fn nested_order(skeleton: &Skeleton) -> Vec<(JointIdx, usize)> {
    let joints = skeleton.joints();
    let mut children = vec![Vec::new(); joints.len()];
    for (idx, joint) in joints.iter().enumerate() {
        if let Some(parent) = joint.parent {
            children[parent.idx()].push(JointIdx::from_idx(idx));
        }
    }
    let mut order = Vec::with_capacity(joints.len());
    let mut stack = vec![(JointIdx(0), 0)];
    while let Some((joint, depth)) = stack.pop() {
        order.push((joint, depth));
        stack.extend(children[joint.idx()].iter().rev().map(|&child| (child, depth + 1)));
    }
    order
}

fn write_joints(
    out: &mut String,
    skeleton: &Skeleton,
    order: &[(JointIdx, usize)],
    options: &BvhWriteOptions,
) {
    let rotations = match options.euler_order {
        EulerOrder::Zxy => "Zrotation Xrotation Yrotation",
        EulerOrder::Zyx => "Zrotation Yrotation Xrotation",
    };
    let mut names = std::collections::HashSet::new();
    for (at, &(idx, depth)) in order.iter().enumerate() {
        let joint = skeleton.joint(idx);
        let pad = "\t".repeat(depth);
        let keyword = if depth == 0 { "ROOT" } else { "JOINT" };
        let name = writable_name(&joint.name, &mut names);
        put!(out, "{pad}{keyword} {name}\n{pad}{{\n{pad}\tOFFSET ");
        push_vec(out, joint.offset_m, options.metres_per_unit);
        let channels = if depth == 0 { "6 Xposition Yposition Zposition" } else { "3" };
        put!(out, "\n{pad}\tCHANNELS {channels} {rotations}\n");
        let next_depth = order.get(at + 1).map_or(0, |&(_, depth)| depth);
        if next_depth <= depth {
            // Readers expect an end at every leaf, so one without gets an end of no length.
            let end = joint.end_site_m.unwrap_or(Vec3::ZERO);
            put!(out, "{pad}\tEnd Site\n{pad}\t{{\n{pad}\t\tOFFSET ");
            push_vec(out, end, options.metres_per_unit);
            put!(out, "\n{pad}\t}}\n");
            let n_closed = if at + 1 == order.len() { depth + 1 } else { depth + 1 - next_depth };
            for closed in 0..n_closed {
                put!(out, "{}}}\n", "\t".repeat(depth - closed));
            }
        }
    }
}

/// The name without what would end it: line breaks and braces. Blanks become `_` too, since many
/// readers take one word.
fn writable_name(name: &str, names: &mut std::collections::HashSet<String>) -> String {
    let clean: String = name
        .chars()
        .map(
            |c| if c.is_whitespace() || c.is_control() || matches!(c, '{' | '}') { '_' } else { c },
        )
        .collect();
    let mut unique = clean.clone();
    let mut count = 1;
    while !names.insert(unique.clone()) {
        count += 1;
        unique = format!("{clean}_{count}");
    }
    unique
}

fn push_vec(out: &mut String, v_m: Vec3, metres_per_unit: f64) {
    let v = v_m.as_dvec3() / metres_per_unit;
    push_number(out, v.x);
    out.push(' ');
    push_number(out, v.y);
    out.push(' ');
    push_number(out, v.z);
}

/// Six decimals; never `-0.000000`, which would make equal motions differ in bytes.
fn push_number(out: &mut String, value: f64) {
    let start = out.len();
    put!(out, "{value:.6}");
    if out[start..].starts_with('-')
        && out[start..].bytes().all(|b| matches!(b, b'-' | b'0' | b'.'))
    {
        out.remove(start);
    }
}

/// The angles of `q` in channel order, radians: of all triples of angles that make `q`, the one
/// nearest to `previous_rad`.
///
/// At the singularity, where two axes fall together, the first angle stays what it was and the
/// others follow.
fn euler_near(q: DQuat, order: EulerOrder, previous_rad: DVec3) -> DVec3 {
    /// Below this sine the first angle is noise: a millionth of a radian.
    const SINGULAR: f64 = 1e-6;
    let m = DMat3::from_quat(q);
    // m.col(c)[r] is row r, column c. The first angle z is what makes one entry of
    // Rz(−z) · m vanish that the other two rotations cannot fill.
    let (y, x) = match order {
        EulerOrder::Zxy => (-m.y_axis.x, m.y_axis.y),
        EulerOrder::Zyx => (m.x_axis.y, m.x_axis.x),
    };
    let z = if y.hypot(x) < SINGULAR { previous_rad.x } else { y.atan2(x) };
    let candidates = [z, z + std::f64::consts::PI].map(|z| {
        let rest = DMat3::from_rotation_z(-z) * m;
        let (second, third) = match order {
            EulerOrder::Zxy => {
                (rest.y_axis.z.atan2(rest.y_axis.y), rest.z_axis.x.atan2(rest.x_axis.x))
            }
            EulerOrder::Zyx => {
                ((-rest.x_axis.z).atan2(rest.x_axis.x), (-rest.z_axis.y).atan2(rest.y_axis.y))
            }
        };
        let turn = std::f64::consts::TAU;
        let angles = DVec3::new(z, second, third);
        angles + ((previous_rad - angles) / turn).round() * turn
    });
    let [a, b] = candidates;
    if a.distance_squared(previous_rad) <= b.distance_squared(previous_rad) { a } else { b }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn from_euler(angles_rad: DVec3, order: EulerOrder) -> DQuat {
        let z = DQuat::from_rotation_z(angles_rad.x);
        match order {
            EulerOrder::Zxy => {
                z * DQuat::from_rotation_x(angles_rad.y) * DQuat::from_rotation_y(angles_rad.z)
            }
            EulerOrder::Zyx => {
                z * DQuat::from_rotation_y(angles_rad.y) * DQuat::from_rotation_x(angles_rad.z)
            }
        }
    }

    fn angles() -> impl Strategy<Value = DVec3> {
        (-6.0..6.0, -6.0..6.0, -6.0..6.0).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    proptest! {
        #[test]
        fn euler_angles_make_the_rotation(a in angles(), near in angles(), zxy in any::<bool>()) {
            let order = if zxy { EulerOrder::Zxy } else { EulerOrder::Zyx };
            let q = from_euler(a, order);
            let again = from_euler(euler_near(q, order, near), order);
            prop_assert!(q.dot(again).abs() > 1.0 - 1e-9);
        }

        #[test]
        fn the_nearest_angles_are_found(a in angles(), step in angles()) {
            prop_assume!(a.y.cos().abs() > 0.2);
            let near = a + 0.02 * step;
            let found = euler_near(from_euler(a, EulerOrder::Zxy), EulerOrder::Zxy, near);
            prop_assert!(found.distance(a) < 1e-6, "{found} is not {a}");
        }
    }

    #[test]
    fn a_roll_through_the_singularity_keeps_its_other_angles() {
        let mut angles = DVec3::ZERO;
        for step in 0..=720 {
            let pitch = f64::from(step).to_radians();
            angles = euler_near(DQuat::from_rotation_x(pitch), EulerOrder::Zxy, angles);
            assert!(angles.distance(DVec3::new(0.0, pitch, 0.0)) < 1e-6, "{step}°: {angles}");
        }
    }

    #[test]
    fn zero_has_no_sign() {
        let mut out = String::new();
        for value in [-0.0, -1e-9, 0.0, -0.5] {
            push_number(&mut out, value);
            out.push(' ');
        }
        assert_eq!(out, "0.000000 0.000000 0.000000 -0.500000 ");
    }
}
