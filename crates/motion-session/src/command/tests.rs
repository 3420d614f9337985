//! What commands refuse, and what they leave alone.

use std::sync::Arc;

use motion_core::units::FrameIdx;

use super::*;
use crate::document::{HandChange, TakePiece};
use crate::sample;

fn document() -> Document {
    Document::from_project(sample::sample().unwrap())
}

fn at(id: &str) -> ConstraintRef {
    ConstraintRef::new(CharacterIdx(0), id)
}

/// What the sample says to these commands, one after the other.
#[track_caller]
fn check(commands: &[Command], expected: &str) {
    let said = match apply_all(&document(), commands) {
        Ok(_) => "fine".to_owned(),
        Err(error) => error.to_string(),
    };
    assert_eq!(said, expected, "{commands:?}");
}

#[test]
fn refusals_are_sentences() {
    let remove = |id| Command::Remove { at: at(id) };
    let retime = |id, frame| Command::Retime { at: at(id), frame };
    let exact = |frames| Command::SetLength {
        character: CharacterIdx(0),
        frames: Some(frames),
        mode: LengthMode::Exact,
    };
    check(&[remove("corner")], "fine");
    check(
        &[remove("corner"), remove("end")],
        "a motion needs a start and an end; move this checkpoint instead of deleting it",
    );
    check(
        &[remove("start")],
        "the motion begins at this checkpoint; move it instead of deleting it",
    );
    check(&[remove("start2")], "there is no \"start2\" any more");
    check(&[retime("corner", 100)], "fine");
    check(
        &[retime("corner", 239)],
        "there is a checkpoint at frame 239 already; choose another frame",
    );
    check(&[retime("start", 4)], "the start stays at frame 0; move other checkpoints in time");
    check(&[retime("start", 0)], "fine");
    check(&[retime("end", 1_000_000)], "a frame must be below a million");
    check(&[exact(240)], "fine");
    let beyond = "frame 239 is behind the end of a motion of exactly 200 frames; make the motion \
                  longer first";
    check(&[exact(200)], beyond);
    check(&[exact(240), retime("end", 238), exact(239)], "fine");
    check(&[Command::Duplicate { at: at("corner"), frame: 60 }, remove("body-1")], "fine");
    check(
        &[Command::Move { at: at("end"), position_m: [0.0, f64::NAN] }],
        "a place must be within 10 km of the origin",
    );
    check(
        &[Command::SetTag { at: at("end"), tag: "run".to_owned() }],
        "a body constraint has no tag",
    );
    check(
        &[Command::AddCharacter { name: "a".to_owned() }],
        "another character is called \"A\"; choose another name",
    );
    check(
        &[Command::RemoveCharacter { character: CharacterIdx(0) }],
        "a project needs a character; rename this one instead of deleting it",
    );
}

#[test]
fn what_is_not_touched_is_shared() {
    let two = apply(&document(), &Command::AddCharacter { name: "B".to_owned() }).unwrap();
    let moved = Command::Move { at: at("end"), position_m: [1.0, 1.0] };
    let after = apply(&two, &moved).unwrap();
    assert!(Arc::ptr_eq(&after.head, &two.head) && Arc::ptr_eq(&after.takes, &two.takes));
    assert!(Arc::ptr_eq(&after.characters[1], &two.characters[1]));
    assert!(!after.asks_the_same_as(&two));
    let renamed = Command::RenameProject { name: "other".to_owned() };
    assert!(apply(&two, &renamed).unwrap().asks_the_same_as(&two));
}

#[test]
fn a_take_is_kept_while_it_is_pinned_or_named() {
    let take = StoredTake {
        character: "A".to_owned(),
        name: None,
        pinned: false,
        pieces: vec![TakePiece { clip: "walk".to_owned(), from: 0, to: 9 }],
        by_hand: None,
        extra: Default::default(),
    };
    let id = take.id();
    let kept = |commands: &[Command]| {
        let after = apply_all(&document(), commands).unwrap();
        after.takes().get("A", id).map(|t| (t.pinned, t.name.clone()))
    };
    let pin = Command::PinTake { take: take.clone() };
    let name = |name: Option<&str>| Command::NameTake {
        take: take.clone(),
        name: name.map(str::to_owned),
    };
    let unpin = Command::UnpinTake { character: CharacterIdx(0), take: id };
    assert_eq!(kept(std::slice::from_ref(&pin)), Some((true, None)));
    assert_eq!(kept(&[pin.clone(), name(Some("x"))]), Some((true, Some("x".to_owned()))));
    assert_eq!(
        kept(&[pin.clone(), name(Some("x")), unpin.clone()]),
        Some((false, Some("x".to_owned())))
    );
    assert_eq!(kept(&[pin, name(Some("x")), unpin, name(None)]), None);
    let rename = Command::RenameCharacter { character: CharacterIdx(0), name: "Z".to_owned() };
    let after = apply_all(&document(), &[name(Some("x")), rename]).unwrap();
    assert!(after.takes().get("Z", id).is_some(), "takes follow their character's name");
}

#[test]
fn changes_by_hand_keep_their_take_and_come_along_to_what_it_became() {
    let pieces = |from| vec![TakePiece { clip: "walk".to_owned(), from, to: 9 }];
    let take = |from| StoredTake {
        character: "A".to_owned(),
        name: None,
        pinned: false,
        pieces: pieces(from),
        by_hand: None,
        extra: Default::default(),
    };
    let turn = |degrees| HandEdit {
        change: HandChange::Joint { joint: "Head".to_owned(), turn_deg: [0.0, degrees, 0.0] },
        from: 3,
        to: 5,
        ease_in: 2,
        ease_out: 2,
    };
    let (first, id) = (take(0), "joint-1".to_owned());
    let add = Command::AddByHand { take: first.clone(), edit: turn(30.0) };
    let change = Command::ChangeByHand { take: first.clone(), id: id.clone(), edit: turn(40.0) };
    let remove = Command::RemoveByHand { take: first.clone(), id };
    let none = "there is no change by hand \"joint-1\" on this take any more";
    check(std::slice::from_ref(&change), none);
    check(&[add.clone(), remove.clone(), remove.clone()], none);
    let far = Command::AddByHand { take: first.clone(), edit: turn(200.0) };
    check(&[far], "a turn must be by 180° at most");
    let knot = |output, source| Knot { output, source };
    let retime = |knots| Command::RetimeByHand { take: first.clone(), knots };
    let back = retime(Some(vec![knot(3, 5.0), knot(6, 2.0)]));
    check(&[back], "time must be on its way forwards, or standing still");

    let kept = |commands: &[Command], of: &StoredTake| {
        let after = apply_all(&document(), commands).unwrap();
        after.takes().get("A", of.id()).map(|take| take.by_hand.clone())
    };
    let changed = kept(&[add.clone(), change], &first).flatten().unwrap();
    assert_eq!(changed.edit("joint-1"), Some(&turn(40.0)));
    let unpin = Command::UnpinTake { character: CharacterIdx(0), take: first.id() };
    let pin = Command::PinTake { take: first.clone() };
    assert!(kept(&[add.clone(), pin, unpin], &first).is_some(), "it is kept without a pin");
    assert_eq!(kept(&[add.clone(), remove.clone()], &first), None, "nothing is left of it");
    let timed = retime(Some(vec![knot(3, 6.0)]));
    assert_eq!(kept(&[timed, retime(None)], &first), None);

    // What the take became is edited with the layer that it has from it.
    let descendant = StoredTake { by_hand: Some(changed.clone()), ..take(1) };
    let edit = Command::AddByHand { take: descendant.clone(), edit: turn(10.0) };
    let layer = kept(&[add.clone(), edit], &descendant).flatten().unwrap();
    assert_eq!(layer.edits().map(|(id, _)| id).collect::<Vec<_>>(), ["joint-1", "joint-2"]);
    let pin = Command::PinTake { take: descendant.clone() };
    assert_eq!(kept(&[add.clone(), pin], &descendant), Some(Some(changed)));
    let unnamed = Command::NameTake { take: descendant.clone(), name: None };
    assert_eq!(kept(&[unnamed], &descendant), None);
    let clear = Command::ClearByHand { take: descendant.clone() };
    let cleared = kept(&[add, clear.clone()], &descendant).unwrap().unwrap();
    assert!(cleared.is_empty(), "an empty layer keeps the other one's off");
    assert_eq!(kept(&[clear], &descendant), None, "there is none to be kept off");
}

#[test]
fn tags_are_given_to_clips_and_taken_again() {
    let over = |tag: &str, frames: Option<(u32, u32)>| {
        let frames = frames.map(|(from, to)| (FrameIdx(from), FrameIdx(to)));
        HandTag { tag: tag.to_owned(), frames }
    };
    let tag = |tag| Command::TagClip { clip: "walk".to_owned(), tag };
    let untag = |tag| Command::UntagClip { clip: "walk".to_owned(), tag };
    check(&[tag(over(" , ", None))], "a tag needs a name");
    check(
        &[tag(over("limp", Some((9, 3))))],
        "it would end at frame 3, before it begins at frame 9",
    );
    check(&[untag(over("limp", None))], "the clip \"walk\" was not given the tag \"limp\" by hand");
    let both = [tag(over(" tired ", None)), tag(over("limp", Some((3, 9))))];
    let tagged = apply_all(&document(), &both).unwrap();
    assert_eq!(tagged.hand_tags().of("walk"), [over("tired", None), over("limp", Some((3, 9)))]);
    assert!(!tagged.asks_the_same_as(&document()), "styles and palettes look at tags");
    let gone = apply_all(&tagged, &[untag(over("tired", None)), untag(over("limp", Some((3, 9))))]);
    assert_eq!(gone, Ok(document()));
}

#[test]
fn characters_meet_and_part() {
    let member = |character: &str, clip: &str| Member {
        character: character.to_owned(),
        clip: clip.to_owned(),
        clip_frame: 10,
        extra: Default::default(),
    };
    let stands =
        |z, heading_deg| Placement { position_m: [0.0, z], heading_deg, extra: Default::default() };
    let relative = vec![stands(0.0, 0.0), stands(1.0, 180.0)];
    let meet = |members| Command::AddInteraction { frame: 90, members, relative: relative.clone() };
    let both = vec![member("A", "walk"), member("B", "walk")];
    let add = [Command::AddCharacter { name: "B".to_owned() }, meet(both.clone())];
    let with = |more: &[Command]| [&add[..], more].concat();
    check(&[meet(both.clone())], "there is no such character any more");
    let alone = "a meeting is of two or more characters, each of them once";
    check(&with(&[meet(vec![member("A", "walk"), member("A", "walk")])]), alone);
    check(&with(&[meet(vec![member("A", "walk")])]), alone);
    check(
        &with(&[meet(vec![member("A", "walk"), member("B", " ")])]),
        "a pose's clip needs a name",
    );
    let id = || "interaction-1".to_owned();
    let later = Command::ChangeInteraction {
        id: id(),
        frame: 100,
        members: both,
        relative: relative.clone(),
    };
    let with_both = Command::RemoveCharacter { character: CharacterIdx(1) };
    let part = Command::RemoveInteraction { id: id() };
    check(
        &with(std::slice::from_ref(&with_both)),
        "\"B\" meets somebody in an interaction; delete that first",
    );
    check(&with(&[part.clone(), with_both]), "fine");
    check(&with(&[part.clone(), part]), "there is no meeting \"interaction-1\" any more");
    let before = apply_all(&document(), &add).unwrap();
    let after = apply(&before, &later).unwrap();
    assert_eq!(after.interactions()[0].frame, 100);
    assert!(!after.asks_the_same_as(&before), "another moment is another question");
    assert!(Arc::ptr_eq(&after.characters, &before.characters));
}

#[test]
fn poses_and_joints_are_exchanged_and_let_loose() {
    let character = CharacterIdx(0);
    let pose = Command::AddPose {
        character,
        frame: 60,
        clip: "walk".to_owned(),
        clip_frame: 3,
        position_m: Some([1.0, 2.0]),
        heading_deg: None,
    };
    let source =
        |at, clip: &str| Command::SetPoseSource { at, clip: clip.to_owned(), clip_frame: 9 };
    let anywhere = |at| Command::SetPlace { at, position_m: None };
    let after = apply_all(&document(), &[pose.clone(), anywhere(at("pose-1"))]).unwrap();
    let kind = after.constraint(&at("pose-1")).map(|c| c.kind.clone());
    assert!(matches!(kind, Some(ConstraintKind::Pose { position_m: None, .. })), "{kind:?}");
    check(&[pose.clone(), source(at("pose-1"), "run")], "fine");
    check(&[pose, source(at("pose-1"), "")], "a pose's clip needs a name");
    check(&[anywhere(at("end"))], "a body constraint has no place that may be any");
    let joint = Command::SetJoint { at: at("end"), joint: "Head".to_owned() };
    check(&[joint], "a body constraint has no joint");
    let along = Command::SetPathHeading { at: at("end"), heading: PathHeading::Along };
    check(&[along], "a body constraint has no way to look along");
}
