//! Prints figures of every built-in clip: worst accelerations, foot slide, knees, turn, travel.

#![allow(clippy::print_stdout, reason = "a development tool that prints its result")]

use motion_core::clip::Clip;
use motion_core::contacts::{Side, toe_joint};
use motion_core::ids::JointIdx;
use motion_core::rotation;
use motion_core::skeleton::{JointRole, Skeleton};
use motion_performer::builtin_clips;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let start = std::time::Instant::now();
    let set = builtin_clips()?;
    println!("{} clips, {} frames in {:?}", set.clips().len(), set.n_frames(), start.elapsed());
    for clip in set.clips() {
        describe(set.skeleton(), clip);
    }
    Ok(())
}

fn describe(skeleton: &Skeleton, clip: &Clip) {
    let (n, n_frames) = (skeleton.n_joints(), clip.n_frames());
    let at = clip.motion.joint_positions_m(skeleton);
    let mut worst = [(0.0f32, 0, 0); 2];
    let mut all = Vec::new();
    for frame in 1..n_frames - 1 {
        for joint in 0..n {
            let [a, b, c] = [frame - 1, frame, frame + 1].map(|f| at[f * n + joint]);
            let accel_m_s2 = (c - b * 2.0 + a).length() * 900.0;
            all.push(accel_m_s2);
            let name = &skeleton.joints()[joint].name;
            let leg = ["Leg", "Foot", "Toe"].iter().any(|part| name.contains(part));
            let kind = &mut worst[usize::from(!leg)];
            if accel_m_s2 > kind.0 {
                *kind = (accel_m_s2, frame, joint);
            }
        }
    }
    all.sort_by(f32::total_cmp);

    let mut slide_m = 0.0f32;
    for side in Side::BOTH {
        let Some(JointIdx(toe)) = toe_joint(skeleton, side) else { continue };
        for frame in 1..n_frames {
            let contacts = &clip.track.contacts;
            if contacts[frame - 1].side(side) && contacts[frame].side(side) {
                let [a, b] = [frame - 1, frame].map(|f| at[f * n + toe as usize]);
                slide_m = slide_m.max(a.distance(b));
            }
        }
    }
    let knees = [JointRole::LeftLeg, JointRole::RightLeg].map(|role| skeleton.by_role(role));
    let flexions = knees.iter().flatten().flat_map(|knee| {
        (0..n_frames).map(|f| rotation::log(clip.motion.rotations(f)[knee.idx()]).x.to_degrees())
    });
    let (low, high) = flexions.fold((f32::INFINITY, 0.0f32), |(l, h), k| (l.min(k), h.max(k)));
    let track = &clip.track.world_from_torso;
    let turn_rad: f32 =
        track.windows(2).map(|pair| (pair[0].inverse() * pair[1]).heading_rad()).sum();
    let end = track[n_frames - 1];
    let [legs, upper] = worst.map(|(accel, frame, joint)| {
        format!("{accel:5.1} {:13} f{frame:3}", skeleton.joints()[joint].name)
    });
    println!(
        "{:24} {n_frames:3} frames  legs {legs}  upper {upper}  p99 {:4.1}  slide {slide_m:.0e}  \
         knee {low:2.0}..{high:3.0}  turn {:6.1}  end ({:5.2}, {:5.2})",
        clip.id,
        all[all.len() * 99 / 100],
        turn_rad.to_degrees(),
        end.x_m,
        end.z_m,
    );
}
