//! Check boxes of the palette, with a search that goes on.

use std::collections::BTreeSet;

use super::tests::{has_motion, session, until};
use motion_core::tags::HandTags;

use super::*;
use crate::clip_rows::clip_rows;
use crate::document::TakePiece;
use crate::palette::{clips_outside, palette_with, palette_with_clips, tagged_clips};

/// Whether a take uses a clip or its mirror image.
fn uses(take: &Take, clip: &str) -> bool {
    let is = |piece: &TakePiece| piece.clip.strip_suffix("@mirror").unwrap_or(&piece.clip) == clip;
    take.pieces.iter().any(is)
}

fn takes(session: &Session) -> &[Take] {
    session.snapshot().characters.first().map_or(&[], |character| &character.takes)
}

#[test]
fn a_clip_switched_off_takes_its_takes_along_and_brings_them_back() {
    let mut session = session(None);
    // A clip that some takes use and some do not.
    let splits = |takes: &[Take], clip: &str| {
        let n = takes.iter().filter(|take| uses(take, clip)).count();
        n > 0 && n < takes.len()
    };
    let names = ["walk", "walk_late", "left", "right", "slow"];
    until(&mut session, "with takes of several kinds", |s| {
        has_motion(s) && takes(s).len() > 3 && names.iter().any(|clip| splits(takes(s), clip))
    });
    session.search().pause();
    until(&mut session, "paused", |s| s.state() == SearchState::Paused);
    let before: Vec<Take> = takes(&session).to_vec();
    let (version, rounds) = {
        let character = &session.snapshot().characters[0];
        (character.version, character.iterations)
    };
    let clip = names.into_iter().find(|clip| splits(&before, clip)).unwrap();
    let ids = |takes: &mut dyn Iterator<Item = &Take>| {
        takes.map(|take| take.id).collect::<BTreeSet<TakeId>>()
    };
    let others = ids(&mut before.iter().filter(|take| !uses(take, clip)));

    let palette = {
        let rows = clip_rows(session.library().unwrap(), None, &HandTags::default());
        let clips = tagged_clips(&rows);
        palette_with(session.document().palette(), &clips, clip, false)
    };
    session.apply(&Command::SetPalette { palette }).unwrap();
    assert_eq!(session.history().undo_label(), Some("Change palette"));
    until(&mut session, "without the clip", |s| s.snapshot().characters[0].version != version);
    let shown = session.snapshot().characters[0].shown;
    for take in takes(&session) {
        // What is looked at stays, and can be marked.
        let outside = clips_outside(
            session.document().palette(),
            &HandTags::default(),
            session.library().unwrap(),
            &take.pieces,
        );
        assert_eq!(outside.is_empty(), !uses(take, clip), "{:?}", take.pieces);
        assert!(outside.is_empty() || Some(take.id) == shown, "{:?}", take.pieces);
    }
    let now = ids(&mut takes(&session).iter());
    assert!(others.is_subset(&now), "{others:?} of {now:?}");
    assert!(session.snapshot().characters[0].iterations >= rounds, "it began anew");

    session.search().resume();
    until(&mut session, "searching on without it", |s| {
        s.snapshot().characters[0].iterations > rounds + 5
    });
    let shown = session.snapshot().characters[0].shown;
    let stray = takes(&session).iter().find(|take| uses(take, clip) && Some(take.id) != shown);
    assert!(stray.is_none(), "{:?}", stray.map(|take| &take.pieces));
    session.search().pause();
    session.undo();
    until(&mut session, "undone", |s| s.snapshot().characters[0].version == version);
    let back = ids(&mut takes(&session).iter());
    let all = ids(&mut before.iter());
    assert!(all.is_subset(&back), "{all:?} of {back:?}");
}

#[test]
fn switching_everything_off_is_said_and_undone() {
    let mut session = session(None);
    until(&mut session, "with a motion", has_motion);
    let rows = clip_rows(session.library().unwrap(), None, &HandTags::default());
    let clips = tagged_clips(&rows);
    let ids: Vec<&str> = clips.iter().map(|(id, _)| *id).collect();
    let palette = palette_with_clips(None, &clips, &ids, false);
    session.apply(&Command::SetPalette { palette }).unwrap();
    let is_refused = |s: &Session| matches!(s.state(), SearchState::Infeasible(_));
    until(&mut session, "refused", is_refused);
    let SearchState::Infeasible(sentence) = session.state() else { panic!("it was, just now") };
    assert!(sentence.contains("include more or exclude less"), "{sentence}");
    session.undo();
    until(&mut session, "searching again", |s| !is_refused(s) && has_motion(s));
}
