//! Commands at random, good and bad ones, and what must hold after each.

use std::ops::Range;
use std::path::Path;

use motion_core::by_hand::{Knot, Limb, Space};
use motion_core::tags::HandTag;
use motion_core::units::FrameIdx;
use motion_io::diagnostic::Warnings;
use motion_io::project_file::{
    self, LengthMode, Member, Palette, PathHeading, Placement, Shape, Tolerance,
};
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::TestCaseError;

use super::Command;
use crate::document::{
    CharacterIdx, ConstraintRef, Document, HandChange, HandEdit, ObstacleIdx, StoredTake, TakePiece,
};

/// Sequences of commands.
pub(crate) fn commands(n: Range<usize>) -> impl Strategy<Value = Vec<Command>> {
    prop::collection::vec(command(), n)
}

/// What is saved can be read again, as the same document; every motion has a start and an end.
pub(crate) fn is_sound(document: &Document) -> Result<(), TestCaseError> {
    let text = project_file::write(&document.to_project());
    let read = project_file::read(text.as_bytes(), Path::new("p"), &mut Warnings::new());
    let read = read.map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
    let again = Document::from_project(read);
    prop_assert_eq!(again.to_project(), document.to_project());
    prop_assert_eq!(project_file::write(&again.to_project()), text);
    for character in document.characters() {
        let frames: Vec<u32> = character
            .constraints
            .iter()
            .filter_map(|c| match c.kind {
                project_file::ConstraintKind::Body { frame, .. } => Some(frame),
                _ => None,
            })
            .collect();
        prop_assert!(frames.len() >= 2 && frames.contains(&0), "{:?}", frames);
    }
    Ok(())
}

fn character() -> impl Strategy<Value = CharacterIdx> {
    select(vec![0usize, 0, 0, 1, 7]).prop_map(CharacterIdx)
}

fn at() -> impl Strategy<Value = ConstraintRef> {
    let id = select(vec![
        "start", "corner", "end", "body-1", "body-2", "joint-1", "pose-1", "style-1", "path-1",
        "lock-1", "none",
    ]);
    (character(), id).prop_map(|(character, id)| ConstraintRef::new(character, id))
}

fn frame() -> impl Strategy<Value = u32> {
    prop_oneof![8 => 0u32..300, 1 => Just(u32::MAX), 1 => Just(999_999)]
}

fn metres() -> impl Strategy<Value = f64> {
    prop_oneof![12 => -20.0..20.0f64, 1 => Just(f64::NAN), 1 => Just(1e9)]
}

fn text() -> impl Strategy<Value = String> {
    select(vec!["A", "B", "a", "run", "", " ", "walk*", "nul", "x/y"]).prop_map(str::to_owned)
}

fn weight() -> impl Strategy<Value = Option<f64>> {
    prop_oneof![Just(None), (0.0..5.0f64).prop_map(Some), Just(Some(-1.0)), Just(Some(f64::NAN))]
}

fn shape() -> impl Strategy<Value = Shape> {
    (metres(), metres(), 0u8..3).prop_map(|(x, size, kind)| {
        let (center_m, size_m, heading_deg) = ([x, 0.5, 2.0], [size, 1.0, 1.0], x);
        match kind {
            0 => Shape::Box { center_m, size_m, heading_deg },
            1 => Shape::Ceiling { center_m, size_m, heading_deg },
            _ => Shape::Cylinder { center_m, radius_m: size, height_m: 1.0 },
        }
    })
}

/// Who meets whom, and where each stands.
fn meeting() -> impl Strategy<Value = (Vec<Member>, Vec<Placement>)> {
    let member =
        (text(), text(), frame(), metres()).prop_map(|(character, clip, clip_frame, x)| {
            let member = Member { character, clip, clip_frame, extra: Default::default() };
            let extra = Default::default();
            (member, Placement { position_m: [x, 1.0], heading_deg: 180.0, extra })
        });
    prop::collection::vec(member, 1..4).prop_map(|both| both.into_iter().unzip())
}

fn interaction_id() -> impl Strategy<Value = String> {
    select(vec!["interaction-1", "interaction-2", "none"]).prop_map(str::to_owned)
}

fn take() -> impl Strategy<Value = StoredTake> {
    (text(), 0u32..3, 0u32..3).prop_map(|(character, from, to)| StoredTake {
        character,
        name: None,
        pinned: false,
        pieces: vec![TakePiece { clip: "walk".to_owned(), from, to }],
        by_hand: None,
        extra: Default::default(),
    })
}

fn hand_tag() -> impl Strategy<Value = HandTag> {
    let frames = prop::option::of((frame(), frame()));
    (text(), frames).prop_map(|(tag, frames)| HandTag {
        tag,
        frames: frames.map(|(from, to)| (FrameIdx(from), FrameIdx(to))),
    })
}

fn hand_edit() -> impl Strategy<Value = HandEdit> {
    let vector = prop_oneof![6 => -1.0..1.0f64, 1 => Just(f64::NAN), 1 => Just(90.0)];
    let change = (text(), vector, select(vec![None, Some(Space::World), Some(Space::Torso)]))
        .prop_map(|(joint, x, space)| match space {
            None => HandChange::Joint { joint, turn_deg: [x, 0.1, -x] },
            Some(space) => {
                HandChange::Hand { limb: Limb::RightFoot, shift_m: [x, x / 3.0, 0.0], space }
            }
        });
    (change, frame(), frame(), 0u32..20).prop_map(|(change, from, to, ease_in)| HandEdit {
        change,
        from,
        to,
        ease_in,
        ease_out: 7,
    })
}

fn knots() -> impl Strategy<Value = Vec<Knot>> {
    prop::collection::vec((0u32..300, 0.0..300.0f64), 0..4).prop_map(|mut knots| {
        knots.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        knots.into_iter().map(|(output, source)| Knot { output, source }).collect()
    })
}

fn hand_id() -> impl Strategy<Value = String> {
    select(vec!["joint-1", "hand-1", "hand-2", "none"]).prop_map(str::to_owned)
}

fn command() -> impl Strategy<Value = Command> {
    use Command as C;
    let plane = || [metres(), metres()];
    let space = || [metres(), metres(), metres()];
    let heading = || prop::option::of(metres());
    let mode = select(vec![LengthMode::Free, LengthMode::Preferred, LengthMode::Exact]);
    let frames = prop::option::of(0u32..400);
    let tolerance =
        weight().prop_map(|position_m| Tolerance { position_m, ..Tolerance::default() });
    let palette = text().prop_map(|pattern| Palette {
        include: vec![pattern],
        exclude: Vec::new(),
        tags: Vec::new(),
        extra: Default::default(),
    });
    let adding = prop_oneof![
        (character(), frame(), plane(), heading()).prop_map(
            |(character, frame, position_m, heading_deg)| C::AddCheckpoint {
                character,
                frame,
                position_m,
                heading_deg
            }
        ),
        (character(), frame(), text(), space()).prop_map(
            |(character, frame, joint, position_m)| {
                C::AddJointTarget { character, frame, joint, position_m, velocity_m_s: None }
            }
        ),
        (character(), frame(), text(), frame(), prop::option::of(plane())).prop_map(
            |(character, frame, clip, clip_frame, position_m)| C::AddPose {
                character,
                frame,
                clip,
                clip_frame,
                position_m,
                heading_deg: None
            }
        ),
        (character(), frame(), frame(), text())
            .prop_map(|(character, from, to, tag)| C::AddStyle { character, from, to, tag }),
        (character(), frame(), frame(), prop::collection::vec(plane(), 1..4)).prop_map(
            |(character, from, to, points_m)| C::AddPath { character, from, to, points_m }
        ),
        shape().prop_map(|shape| C::AddObstacle { shape }),
        (frame(), meeting()).prop_map(|(frame, (members, relative))| C::AddInteraction {
            frame,
            members,
            relative
        }),
        text().prop_map(|name| C::AddCharacter { name }),
        (at(), frame()).prop_map(|(at, frame)| C::Duplicate { at, frame }),
    ];
    let changing = prop_oneof![
        (at(), plane()).prop_map(|(at, position_m)| C::Move { at, position_m }),
        (at(), heading()).prop_map(|(at, heading_deg)| C::Turn { at, heading_deg }),
        (at(), heading()).prop_map(|(at, height_m)| C::Raise { at, height_m }),
        (at(), space()).prop_map(|(at, position_m)| C::MoveJointTarget { at, position_m }),
        (at(), prop::option::of(space()))
            .prop_map(|(at, velocity_m_s)| C::SetVelocity { at, velocity_m_s }),
        (at(), text()).prop_map(|(at, tag)| C::SetTag { at, tag }),
        (at(), prop::option::of(plane()))
            .prop_map(|(at, position_m)| C::SetPlace { at, position_m }),
        (at(), text()).prop_map(|(at, joint)| C::SetJoint { at, joint }),
        (at(), text(), frame()).prop_map(|(at, clip, clip_frame)| C::SetPoseSource {
            at,
            clip,
            clip_frame
        }),
        (at(), select(vec![PathHeading::Free, PathHeading::Along]))
            .prop_map(|(at, heading)| C::SetPathHeading { at, heading }),
        (interaction_id(), frame(), meeting()).prop_map(|(id, frame, (members, relative))| {
            C::ChangeInteraction { id, frame, members, relative }
        }),
        (interaction_id(), weight())
            .prop_map(|(id, weight)| C::SetInteractionWeight { id, weight }),
        (at(), frame()).prop_map(|(at, frame)| C::Retime { at, frame }),
        (at(), frame(), frame()).prop_map(|(at, from, to)| C::RetimeSpan { at, from, to }),
        (at(), weight()).prop_map(|(at, weight)| C::SetWeight { at, weight }),
        (at(), prop::option::of(tolerance))
            .prop_map(|(at, tolerance)| C::SetTolerance { at, tolerance }),
        (0usize..3, shape())
            .prop_map(|(nth, shape)| C::ChangeObstacle { obstacle: ObstacleIdx(nth), shape }),
        (character(), frames, mode).prop_map(|(character, frames, mode)| C::SetLength {
            character,
            frames,
            mode
        }),
        (character(), weight())
            .prop_map(|(character, weight)| C::SetLengthWeight { character, weight }),
        (text(), weight()).prop_map(|(term, weight)| C::SetTermWeight { term, weight }),
        prop::option::of(palette).prop_map(|palette| C::SetPalette { palette }),
        any::<u64>().prop_map(|seed| C::SetSeed { seed }),
        (text(), hand_tag()).prop_map(|(clip, tag)| C::TagClip { clip, tag }),
        (text(), hand_tag()).prop_map(|(clip, tag)| C::UntagClip { clip, tag }),
        text().prop_map(|library| C::SetLibrary { library }),
        (character(), text()).prop_map(|(character, name)| C::RenameCharacter { character, name }),
        take().prop_map(|take| C::PinTake { take }),
        (take(), prop::option::of(text())).prop_map(|(take, name)| C::NameTake { take, name }),
        (character(), take())
            .prop_map(|(character, take)| C::UnpinTake { character, take: take.id() }),
    ];
    let by_hand = prop_oneof![
        3 => (take(), hand_edit()).prop_map(|(take, edit)| C::AddByHand { take, edit }),
        2 => (take(), hand_id(), hand_edit())
            .prop_map(|(take, id, edit)| C::ChangeByHand { take, id, edit }),
        1 => (take(), hand_id()).prop_map(|(take, id)| C::RemoveByHand { take, id }),
        2 => (take(), prop::option::of(knots()))
            .prop_map(|(take, knots)| C::RetimeByHand { take, knots }),
        1 => take().prop_map(|take| C::ClearByHand { take }),
    ];
    let removing = prop_oneof![
        at().prop_map(|at| C::Remove { at }),
        interaction_id().prop_map(|id| C::RemoveInteraction { id }),
        (0usize..3).prop_map(|nth| C::RemoveObstacle { obstacle: ObstacleIdx(nth) }),
        character().prop_map(|character| C::RemoveCharacter { character }),
    ];
    prop_oneof![4 => adding, 5 => changing, 2 => by_hand, 2 => removing]
}
