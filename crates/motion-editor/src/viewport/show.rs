//! The scene of a moment, with what is hovered and selected marked.

use motion_scene::body::Emphasis;
use motion_session::stage::pick::{PickTarget, Picks};
use motion_session::stage::{Show, Staged};

use crate::state::EditorState;

/// Poses of the same motion at other times.
const N_GHOSTS: usize = 7;

/// What is to be seen now; nothing while there is no take.
pub fn staged(state: &EditorState) -> Option<Staged> {
    let take = state.shown_take()?;
    let show = Show {
        wishes: true,
        trail: state.settings.trail,
        ghosts: if state.settings.ghosts { N_GHOSTS } else { 0 },
    };
    let mut staged = take.stage.scene_at(state.player.frame(), show);
    mark(&mut staged, state.selected, Emphasis::Selected);
    let hovered = state.hovered.map(whole);
    if hovered != state.selected {
        mark(&mut staged, hovered, Emphasis::Hovered);
    }
    Some(staged)
}

fn mark(staged: &mut Staged, target: Option<PickTarget>, emphasis: Emphasis) {
    let Some(target) = target else { return };
    let Staged { scene, picks } = staged;
    let is = |pick| means(picks, pick, target);
    for body in scene.bodies.iter_mut().filter(|body| is(body.pick)) {
        body.emphasis = emphasis;
    }
    for mark in scene.checkpoints.iter_mut().filter(|mark| is(mark.pick)) {
        mark.emphasis = emphasis;
    }
    for mark in scene.joint_targets.iter_mut().filter(|mark| is(mark.pick)) {
        mark.emphasis = emphasis;
    }
    for solid in scene.solids.iter_mut().filter(|solid| is(solid.pick)) {
        solid.emphasis = emphasis;
    }
}

fn means(picks: &Picks, pick: Option<motion_scene::body::PickId>, target: PickTarget) -> bool {
    pick.and_then(|id| picks.target(id)) == Some(target)
}

/// A checkpoint and the tip of its arrow are selected together.
pub fn whole(target: PickTarget) -> PickTarget {
    match target {
        PickTarget::CheckpointTip { character, constraint } => {
            PickTarget::Checkpoint { character, constraint }
        }
        other => other,
    }
}
