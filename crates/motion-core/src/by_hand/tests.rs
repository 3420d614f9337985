//! What a layer promises.

use glam::{Quat, Vec3};
use proptest::prelude::*;

use super::*;
use crate::ids::JointIdx;
use crate::rotation::angle_between_rad;
use crate::skeleton::JointRole;
use crate::testing::bodies::{lively, t_pose};
use crate::testing::legs;

fn body() -> (Skeleton, Motion) {
    let skeleton = t_pose(1.0);
    let motion = lively(&skeleton);
    (skeleton, motion)
}

fn stretch() -> impl Strategy<Value = Stretch> {
    (0u32..30, 0u32..10, 0u32..12, 0u32..12).prop_map(|(from, more, ease_in, ease_out)| Stretch {
        from,
        to: from + more,
        ease_in,
        ease_out,
    })
}

fn vector(size: f32) -> impl Strategy<Value = Vec3> {
    [-size..size, -size..size, -size..size].prop_map(Vec3::from)
}

fn limb() -> impl Strategy<Value = Limb> {
    prop::sample::select(Limb::ALL.to_vec())
}

fn space() -> impl Strategy<Value = Space> {
    prop_oneof![Just(Space::World), Just(Space::Torso)]
}

fn joint_layer(joint: usize, turn_rad: Vec3, stretch: Stretch) -> ByHand {
    let joints = vec![JointOffset { joint: JointIdx::from_idx(joint), turn_rad, stretch }];
    ByHand { joints, ..ByHand::default() }
}

fn hand_layer(limb: Limb, shift_m: Vec3, space: Space, stretch: Stretch) -> ByHand {
    let hands = vec![HandOffset { limb, shift_m, space, stretch }];
    ByHand { hands, ..ByHand::default() }
}

/// The joint that an offset of `limb` moves.
fn end_of(skeleton: &Skeleton, limb: Limb) -> JointIdx {
    skeleton.by_role(limb.end_role()).expect("a whole body")
}

#[test]
fn an_empty_layer_is_the_same_bits() {
    let (skeleton, motion) = body();
    assert_eq!(apply(&ByHand::default(), &skeleton, &motion), motion);
    let knots = [7, 20, 39].map(|at| Knot { output: at, source: f64::from(at) });
    let retime = Retime::new(knots.to_vec()).expect("a curve");
    assert_eq!(apply(&ByHand { retime, ..ByHand::default() }, &skeleton, &motion), motion);
}

#[test]
fn what_the_body_does_not_have_is_left_out() {
    let stretch = Stretch { from: 0, to: 39, ease_in: 0, ease_out: 0 };
    let (skeleton, motion) = body();
    let layers = [
        joint_layer(99, Vec3::X, stretch),
        joint_layer(3, Vec3::NAN, stretch),
        hand_layer(Limb::LeftHand, Vec3::splat(f32::INFINITY), Space::World, stretch),
    ];
    for layer in layers {
        assert_eq!(apply(&layer, &skeleton, &motion), motion);
    }
    let skeleton = legs();
    let motion = lively(&skeleton);
    assert!(!Limb::LeftHand.is_on(&skeleton) && Limb::LeftFoot.is_on(&skeleton));
    let layer = hand_layer(Limb::LeftHand, Vec3::Y, Space::World, stretch);
    assert_eq!(apply(&layer, &skeleton, &motion), motion);
}

#[test]
fn offsets_of_one_hand_add_up() {
    let (skeleton, motion) = body();
    let stretch = Stretch { from: 10, to: 20, ease_in: 5, ease_out: 5 };
    let mut twice = hand_layer(Limb::LeftHand, 0.02 * Vec3::Y, Space::World, stretch);
    twice.hands.push(twice.hands[0]);
    let once = hand_layer(Limb::LeftHand, 0.04 * Vec3::Y, Space::World, stretch);
    assert_eq!(apply(&twice, &skeleton, &motion), apply(&once, &skeleton, &motion));
}

#[test]
fn offsets_keep_with_what_the_body_does_when_it_is_retimed() {
    let (skeleton, motion) = body();
    let stretch = Stretch { from: 20, to: 20, ease_in: 4, ease_out: 4 };
    let mut layer = joint_layer(12, Vec3::X, stretch);
    let in_time = apply(&layer, &skeleton, &motion);
    layer.retime = Retime::new(vec![Knot { output: 10, source: 20.0 }]).expect("a curve");
    let early = apply(&layer, &skeleton, &motion);
    assert_eq!(early.n_frames(), 30);
    assert_eq!(early.rotations(10), in_time.rotations(20));
    assert_eq!(early.rotations(29), in_time.rotations(39));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(192))]

    #[test]
    fn nothing_changes_outside_the_stretch_nor_on_other_joints(
        joint in 0usize..22, turn in vector(2.0), stretch in stretch(), limb in limb(),
        shift in vector(1.0), space in space(),
    ) {
        let (skeleton, motion) = body();
        let turned = apply(&joint_layer(joint, turn, stretch), &skeleton, &motion);
        let moved = apply(&hand_layer(limb, shift, space, stretch), &skeleton, &motion);
        let chain = limb.roles().map(|role| skeleton.by_role(role).expect("a whole body").idx());
        prop_assert_eq!(turned.root_positions_m(), motion.root_positions_m());
        prop_assert_eq!(moved.root_positions_m(), motion.root_positions_m());
        for frame in 0..motion.n_frames() {
            let outside = !stretch.touches(frame);
            for (nth, was) in motion.rotations(frame).iter().enumerate() {
                if outside || nth != joint {
                    prop_assert_eq!(turned.rotations(frame)[nth], *was);
                }
                if outside || !chain.contains(&nth) {
                    prop_assert_eq!(moved.rotations(frame)[nth], *was);
                }
                prop_assert!(moved.rotations(frame)[nth].is_normalized());
            }
        }
    }

    #[test]
    fn what_can_be_reached_is_reached_and_the_end_keeps_its_attitude(
        limb in limb(), shift in vector(0.25), space in space(), frame in 0usize..40,
    ) {
        let (skeleton, motion) = body();
        let stretch = Stretch { from: 0, to: 39, ease_in: 0, ease_out: 0 };
        let moved = apply(&hand_layer(limb, shift, space, stretch), &skeleton, &motion);
        let (mut was_m, mut was, mut is_m, mut is) = (vec![], vec![], vec![], vec![]);
        motion.forward_kinematics(&skeleton, frame, &mut was_m, &mut was);
        moved.forward_kinematics(&skeleton, frame, &mut is_m, &mut is);
        let [upper, lower, end] =
            limb.roles().map(|role| skeleton.by_role(role).expect("a whole body").idx());
        prop_assert!(angle_between_rad(was[end], is[end]) < 2e-3);
        let shift = match space {
            Space::World => shift,
            Space::Torso => {
                Quat::from_rotation_y(crate::ground::yaw_series_rad(&motion)[frame]) * shift
            }
        };
        let target_m = was_m[end] + shift;
        let length_m = was_m[upper].distance(was_m[lower]) + was_m[lower].distance(was_m[end]);
        let away = target_m.distance(was_m[upper]) / length_m;
        if (0.3..0.98).contains(&away) {
            prop_assert!(is_m[end].distance(target_m) < 1e-3, "{}", is_m[end].distance(target_m));
        }
        // Farther than that it goes where it was asked to go.
        if away >= 0.98 {
            let (wish, got) = (target_m - was_m[upper], is_m[end] - was_m[upper]);
            prop_assert!(wish.angle_between(got) < 1e-2);
        }
    }

    #[test]
    fn hands_have_no_pops(
        limb in limb(), shift in vector(0.2), from in 12u32..22, more in 0u32..6, ease in 6u32..12,
    ) {
        let (skeleton, motion) = body();
        let stretch = Stretch { from, to: from + more, ease_in: ease, ease_out: ease };
        let moved = apply(&hand_layer(limb, shift, Space::World, stretch), &skeleton, &motion);
        let end = end_of(&skeleton, limb);
        let (was_m, is_m) = (motion.joint_path_m(&skeleton, end), moved.joint_path_m(&skeleton, end));
        let own = was_m.windows(2).map(|p| p[0].distance(p[1])).fold(0.0, f32::max);
        let most = 1.875 * shift.length() / ease as f32;
        for (frame, pair) in is_m.windows(2).enumerate() {
            // The end is no farther from the shoulder than the wish, and follows it: what the reach
            // takes away can only add the limb's own motion once more.
            let step = pair[0].distance(pair[1]);
            prop_assert!(step <= 2.0 * own + most + 1e-3, "{} at {}", step, frame);
        }
    }

    #[test]
    fn joints_have_no_pops(joint in 0usize..22, turn in vector(1.0), from in 12u32..22, ease in 4u32..12) {
        let (skeleton, motion) = body();
        let stretch = Stretch { from, to: from + 3, ease_in: ease, ease_out: ease };
        let turned = apply(&joint_layer(joint, turn, stretch), &skeleton, &motion);
        let step = |motion: &Motion, frame: usize| {
            angle_between_rad(motion.rotations(frame)[joint], motion.rotations(frame + 1)[joint])
        };
        for frame in 0..39 {
            let most = step(&motion, frame) + 1.875 * turn.length() / ease as f32;
            prop_assert!(step(&turned, frame) <= most + 2e-3);
        }
    }

    #[test]
    fn no_wish_breaks_a_limb(limb in limb(), shift in vector(50.0), stretch in stretch()) {
        let (skeleton, motion) = body();
        let moved = apply(&hand_layer(limb, shift, Space::Torso, stretch), &skeleton, &motion);
        for frame in 0..moved.n_frames() {
            prop_assert!(moved.rotations(frame).iter().all(|q| q.is_normalized()));
        }
    }

    #[test]
    fn retiming_has_no_pops_and_meets_the_ends(
        steps in prop::collection::vec((1u32..20, 0.0f64..2.5), 1..6),
    ) {
        let (skeleton, motion) = body();
        let (mut output, mut source) = (0, 0.0);
        let knots = steps.iter().map(|&(frames, speed)| {
            output += frames;
            source += speed * f64::from(frames);
            Knot { output, source }
        });
        let retime = Retime::new(knots.collect()).expect("a curve");
        let layer = ByHand { retime, ..ByHand::default() };
        let made = apply(&layer, &skeleton, &motion);
        prop_assert_eq!(made.rotations(0), motion.rotations(0));
        prop_assert_eq!(made.rotations(made.n_frames() - 1), motion.rotations(39));
        let times = layer.retime.source_frames(40);
        let joint = skeleton.by_role(JointRole::LeftHand).expect("a whole body").idx();
        let step = |frame: usize| {
            angle_between_rad(motion.rotations(frame)[joint], motion.rotations(frame + 1)[joint])
        };
        let own = (0..39).map(step).fold(0.0, f32::max);
        for (frame, pair) in times.windows(2).enumerate() {
            let turned =
                angle_between_rad(made.rotations(frame)[joint], made.rotations(frame + 1)[joint]);
            // A cubic through samples may be a little faster than they are.
            prop_assert!(turned <= 1.5 * own * (pair[1] - pair[0]) as f32 + 3e-3);
        }
    }
}
