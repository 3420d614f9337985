//! Draws clips of the built-in library as stick figures: `contact_sheet CLIP... > sheet.svg`.
//!
//! Each clip gets two rows: a fan of frames from the side (the view turned with the body, moved
//! apart so that figures do not cover each other) and the whole clip from the top with feet in
//! contact filled. Left limbs are red, right limbs blue, the trunk black.

#![allow(clippy::print_stdout, reason = "a development tool that prints its result")]

use std::fmt::Write as _;

use glam::{Quat, Vec3};
use motion_core::clip::Clip;
use motion_core::skeleton::Skeleton;
use motion_performer::builtin_clips;

const PX_PER_M: f32 = 110.0;
const WIDTH: f32 = 1900.0;
const SIDE_H: f32 = 250.0;
const TOP_H: f32 = 330.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ids: Vec<String> = std::env::args().skip(1).collect();
    let set = builtin_clips()?;
    let chosen: Vec<&Clip> = set.clips().iter().filter(|c| ids.contains(&c.id)).collect();
    let height = (SIDE_H * 2.0 + TOP_H) * chosen.len() as f32;
    let mut svg = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{WIDTH}' height='{height}'>\
         <rect width='100%' height='100%' fill='white'/>"
    );
    for (row, clip) in chosen.into_iter().enumerate() {
        let y = row as f32 * (SIDE_H * 2.0 + TOP_H);
        writeln!(svg, "<text x='8' y='{}' font-size='16'>{}</text>", y + 18.0, clip.id)?;
        fan(&mut svg, set.skeleton(), clip, y + SIDE_H - 20.0, 0.0)?;
        fan(&mut svg, set.skeleton(), clip, y + 2.0 * SIDE_H - 20.0, 0.5 * std::f32::consts::PI)?;
        top(&mut svg, set.skeleton(), clip, y + 2.0 * SIDE_H)?;
    }
    svg.push_str("</svg>");
    println!("{svg}");
    Ok(())
}

fn color(name: &str) -> &'static str {
    match (name.starts_with("Left"), name.starts_with("Right")) {
        (true, _) => "#c22",
        (_, true) => "#24c",
        _ => "#222",
    }
}

/// A row of frames; `turn_rad` 0 shows the body's left side, π/2 its front.
fn fan(
    svg: &mut String,
    skeleton: &Skeleton,
    clip: &Clip,
    floor_y: f32,
    turn_rad: f32,
) -> std::fmt::Result {
    const FIGURES: usize = 22;
    writeln!(svg, "<path d='M0 {floor_y}H{WIDTH}' stroke='#999'/>")?;
    let (mut at, mut rotations) = (Vec::new(), Vec::new());
    let n = clip.n_frames();
    // Two cycles of gait fill the row; long clips are shown in larger steps.
    let step = if n > 80 { (n - 1) as f32 / (FIGURES - 1) as f32 } else { 3.0 };
    for i in 0..FIGURES {
        let frame = (i as f32 * step).round() as usize;
        if frame >= n {
            break;
        }
        clip.motion.forward_kinematics(skeleton, frame, &mut at, &mut rotations);
        let torso = clip.track.world_from_torso[frame];
        let turn = Quat::from_rotation_y(turn_rad) * torso.rotation().inverse();
        let x0 = (i as f32 + 0.55) * WIDTH / FIGURES as f32;
        let px = |p: Vec3| {
            let q = turn * (p - Vec3::new(torso.x_m, 0.0, torso.z_m));
            (x0 + q.z * PX_PER_M, floor_y - q.y * PX_PER_M)
        };
        let mut line = |a: Vec3, b: Vec3, name: &str| {
            let ((x1, y1), (x2, y2)) = (px(a), px(b));
            writeln!(
                svg,
                "<path d='M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}' stroke='{}' stroke-width='2.5' \
                 stroke-linecap='round'/>",
                color(name)
            )
        };
        for (j, joint) in skeleton.joints().iter().enumerate() {
            if let Some(parent) = joint.parent {
                line(at[parent.idx()], at[j], &joint.name)?;
            }
            if let Some(end) = joint.end_site_m {
                line(at[j], at[j] + rotations[j] * end, &joint.name)?;
            }
        }
        // The heel, which is no joint: what touches first.
        for (j, joint) in skeleton.joints().iter().enumerate() {
            if joint.name.ends_with("Foot") {
                line(at[j], at[j] + rotations[j] * Vec3::new(0.0, -0.08, -0.045), &joint.name)?;
            }
        }
        writeln!(
            svg,
            "<text x='{}' y='{}' font-size='10'>{frame}</text>",
            x0 - 6.0,
            floor_y + 14.0
        )?;
    }
    Ok(())
}

/// The whole clip seen from above: hips and head as lines, feet as dots, filled when planted.
fn top(svg: &mut String, skeleton: &Skeleton, clip: &Clip, y0: f32) -> std::fmt::Result {
    let positions = clip.motion.joint_positions_m(skeleton);
    let n_joints = skeleton.n_joints();
    let ground: Vec<(f32, f32)> = positions.iter().map(|p| (p.z, p.x)).collect();
    let fold = |f: fn(f32, f32) -> f32, of: fn(&(f32, f32)) -> f32| {
        ground.iter().map(of).reduce(f).unwrap_or(0.0)
    };
    let (min_a, max_a) = (fold(f32::min, |p| p.0), fold(f32::max, |p| p.0));
    let (min_b, max_b) = (fold(f32::min, |p| p.1), fold(f32::max, |p| p.1));
    let scale = ((WIDTH - 40.0) / (max_a - min_a)).min((TOP_H - 20.0) / (max_b - min_b));
    // +Z to the right, +X (the body's left) up.
    let px = |p: Vec3| (20.0 + (p.z - min_a) * scale, y0 + 10.0 + (max_b - p.x) * scale);
    for name in ["Hips", "LeftHand", "RightHand"] {
        let Some(joint) = skeleton.by_name(name) else { continue };
        let mut d = String::new();
        for frame in 0..clip.n_frames() {
            let (x, y) = px(positions[frame * n_joints + joint.idx()]);
            write!(d, "{}{x:.1} {y:.1}", if frame == 0 { 'M' } else { 'L' })?;
        }
        writeln!(svg, "<path d='{d}' fill='none' stroke='{}' opacity='0.6'/>", color(name))?;
    }
    for (foot, toe) in [("LeftFoot", "LeftToeBase"), ("RightFoot", "RightToeBase")] {
        let (Some(foot_j), Some(toe_j)) = (skeleton.by_name(foot), skeleton.by_name(toe)) else {
            continue;
        };
        for frame in 0..clip.n_frames() {
            let contacts = clip.track.contacts[frame];
            let planted = if foot == "LeftFoot" { contacts.left } else { contacts.right };
            let (x1, y1) = px(positions[frame * n_joints + foot_j.idx()]);
            let (x2, y2) = px(positions[frame * n_joints + toe_j.idx()]);
            writeln!(
                svg,
                "<path d='M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}' stroke='{}' stroke-width='{}' \
                 opacity='{}'/>",
                color(foot),
                if planted { 4 } else { 1 },
                if planted { 0.5 } else { 0.3 }
            )?;
        }
    }
    Ok(())
}
