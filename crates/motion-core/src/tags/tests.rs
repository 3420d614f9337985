//! The rules on motions that are made for them.

use glam::{Quat, Vec3};

use super::*;
use crate::clip::Clip;
use crate::floor;
use crate::skeleton::mirror::MirrorMap;
use crate::testing::{Walk, legs};
use crate::units::FrameIdx;

fn clip_of(mut motion: Motion) -> Clip {
    let mut tracks = floor::calibrate(&legs(), std::slice::from_mut(&mut motion));
    Clip::found(&legs(), "clip".into(), vec![], motion, tracks.remove(0))
}

fn walk(speed_m_s: f32, turn_rad_s: f32) -> Clip {
    clip_of(Walk { n_frames: 90, speed_m_s, turn_rad_s, phase: 0.0 }.motion())
}

fn found(clip: &Clip) -> Vec<&str> {
    clip.tag_spans.iter().map(|span| span.tag.as_str()).collect()
}

#[test]
fn a_walk_is_a_walk_in_whatever_direction() {
    assert_eq!(found(&walk(0.8, 0.0)), ["walk"]);
    assert_eq!(found(&walk(-0.8, 0.0)), ["walk", "backward"]);
    assert_eq!(found(&walk(0.8, 0.7)), ["walk", "turn left"]);
    assert_eq!(found(&walk(0.8, -0.7)), ["walk", "turn right"]);
    assert_eq!(found(&walk(0.0, 0.0)), ["idle"]);
}

#[test]
fn a_whole_clip_is_one_stretch() {
    let walk = walk(0.8, 0.0);
    assert_eq!((walk.tag_spans[0].from, walk.tag_spans[0].to), (FrameIdx(0), FrameIdx(89)));
    assert!(walk.has_tag_at("Walk", FrameIdx(89)));
    assert!(!walk.has_tag_at("walk", FrameIdx(90)), "behind its end");
}

#[test]
fn the_mirror_exchanges_left_and_right() {
    let mirror = MirrorMap::new(&legs());
    for clip in [walk(0.8, 0.7), walk(-0.6, -0.3), walk(0.7, 0.2)] {
        let image = mirror.clip(&clip);
        assert_eq!(image.tag_spans, find(&legs(), &image.motion, &image.track));
    }
}

#[test]
fn hips_that_go_down_crouch() {
    let mut motion = Walk { n_frames: 90, speed_m_s: 0.0, turn_rad_s: 0.0, phase: 0.0 }.motion();
    // The legs of this body do not bend with it, so its feet are said to be on the ground.
    let track = clip_of(motion.clone()).track;
    for (frame, root) in motion.root_positions_m_mut().iter_mut().enumerate() {
        root.y -= if (30..60).contains(&frame) { 0.3 } else { 0.0 };
    }
    let spans = find(&legs(), &motion, &track);
    let crouch: Vec<&TagSpan> = spans.iter().filter(|span| span.tag == "crouch").collect();
    assert_eq!(crouch, [&TagSpan { tag: "crouch".into(), from: FrameIdx(30), to: FrameIdx(59) }]);
}

/// Stands, leaps by `apex_m` with straight legs, stands.
fn leap(apex_m: f32) -> Clip {
    let mut motion = Walk { n_frames: 90, speed_m_s: 0.0, turn_rad_s: 0.0, phase: 0.0 }.motion();
    let air_secs = 2.0 * (2.0 * apex_m / 9.81).sqrt();
    let n_air = (air_secs * 30.0).round() as usize;
    let still: Vec<Quat> = motion.rotations(0).to_vec();
    for frame in 0..motion.n_frames() {
        motion.rotations_mut(frame).copy_from_slice(&still);
        if (30..=30 + n_air).contains(&frame) {
            let t = (frame - 30) as f32 / n_air as f32;
            motion.root_positions_m_mut()[frame] += Vec3::Y * 4.0 * apex_m * t * (1.0 - t);
        }
    }
    clip_of(motion)
}

#[test]
fn what_leaves_the_ground_jumps() {
    assert!(!found(&leap(0.02)).contains(&"jump"), "a hop of 2 cm");
    let leap = leap(0.4);
    let jumps: Vec<&TagSpan> = leap.tag_spans.iter().filter(|span| span.tag == "jump").collect();
    assert_eq!(jumps.len(), 1, "{:?}", leap.tag_spans);
    assert!(jumps[0].has(FrameIdx(38)), "{:?}", jumps[0]);
    assert!(jumps[0].n_frames() < 50, "{:?}", jumps[0]);
}

#[test]
fn found_stretches_rule_over_a_name_and_names_over_nothing() {
    let mut clip = walk(0.8, 0.0);
    clip.tags = vec!["walk".into(), "stealthily".into(), "left".into(), "turn".into()];
    clip.tag_spans[0].from = FrameIdx(40);
    let has = |tag| clip.has_tag_at(tag, FrameIdx(3));
    assert!(!has("walk"), "found, but not here");
    assert!(has("stealthily"), "no rule knows it");
    assert!(has("turn left"), "nothing was found");
    assert!(!has("run"));
    let all = clip.frames_with_tag("walk");
    assert_eq!(all.iter().position(|has| *has), Some(40));
}

#[test]
fn bodies_without_legs_have_no_tags() {
    let arm = Skeleton::new(vec![
        crate::testing::joint("base", None, [0.0; 3]),
        crate::testing::joint("link", Some(0), [0.0, 1.0, 0.0]),
    ])
    .expect("a skeleton");
    let motion =
        Motion::new(crate::units::Fps::THIRTY, 2, vec![Vec3::ZERO; 3], vec![Quat::IDENTITY; 6])
            .expect("a motion");
    let track = GroundTrack::new(&motion, &[0.0; 3], vec![Default::default(); 3]);
    assert_eq!(find(&arm, &motion, &track), []);
}
