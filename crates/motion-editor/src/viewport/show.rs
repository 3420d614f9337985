//! The scene of a moment, with what is hovered and selected marked.

use glam::Mat4;
use motion_core::ids::JointIdx;
use motion_core::skeleton::JointRole;
use motion_scene::body::{Body, Emphasis, Look, PickId};
use motion_scene::color::ColorRole;
use motion_session::ConstraintKind;
use motion_session::selection::Selectable;
use motion_session::stage::pick::PickTarget;
use motion_session::stage::{Show, Staged};

use super::compare;
use crate::settings::{GhostMode, Tool};
use crate::state::EditorState;

/// Poses of the same motion at other times.
const N_GHOSTS: usize = 7;
/// A clip that is only looked at must not pass for a take.
const PREVIEW_ALPHA: f32 = 0.45;
/// A limb of the motion before is thin, and must be found beside the one that was moved.
const BEFORE_ALPHA: f32 = 0.4;
/// Around the playhead, so many before and after.
const N_AROUND: i64 = 3;
/// So far apart, seconds.
const AROUND_SECS: f64 = 0.2;
/// The joints whose ways are shown.
const TRAILED: [JointRole; 5] = [
    JointRole::Head,
    JointRole::LeftHand,
    JointRole::RightHand,
    JointRole::LeftFoot,
    JointRole::RightFoot,
];

/// What is to be seen now; nothing while there is no take. `ghost` is a pose that a tool would put
/// down.
pub fn staged(state: &EditorState, ghost: Option<Vec<Mat4>>) -> Option<Staged> {
    if state.stage.actors.is_empty() {
        return None;
    }
    let mut staged = state.stage.scene_at(state.frame(), choices(state));
    if let Some(preview) = &state.preview {
        let color = ColorRole::Pose.color(state.settings.theme).with_alpha(PREVIEW_ALPHA);
        staged.scene.bodies.push(preview.actor.body_at(preview.frame, Look::Ghost(color)));
    }
    compare::add_others(&mut staged.scene, state);
    add_ghosts(&mut staged, state);
    add_before_hand(&mut staged, state);
    add_trails(&mut staged, state);
    if let (Some(pose), Some(actor)) = (ghost, state.stage.actors.first()) {
        let look = Look::Ghost(ColorRole::Pose.color(state.settings.theme).with_alpha(0.5));
        staged.scene.bodies.push(Body::new(actor.figure.mesh, pose, look));
    }
    // What is selected is said last, so that it shows under the pointer too.
    if let Some(hovered) = state.hovered {
        let hovered = whole(hovered);
        mark(&mut staged, |target| target == hovered, Emphasis::Hovered);
    }
    let document = state.session.document();
    let selected: Vec<&Selectable> = state.session.selection().items(document).collect();
    let is_selected = |target: PickTarget| {
        whole(target) == target
            && !matches!(target, PickTarget::Actor { .. } | PickTarget::Ghost { .. })
            && state.selectable_of(target).is_some_and(|item| selected.contains(&&item))
    };
    mark(&mut staged, is_selected, Emphasis::Selected);
    Some(staged)
}

/// What is shown besides bodies.
pub fn choices(state: &EditorState) -> Show {
    Show {
        wishes: true,
        trail: state.settings.trail,
        ghosts: if state.settings.ghosts == GhostMode::Fan { N_GHOSTS } else { 0 },
    }
}

/// The shown take as it was before it was changed by hand, faint: while it is being changed, and
/// where it is compared.
fn add_before_hand(staged: &mut Staged, state: &EditorState) {
    if state.settings.tool != Tool::ByHand && !state.compares_before_hand {
        return;
    }
    // Where nothing is changed it would only veil the body.
    if !state.is_changed_by_hand(state.hand_frame()) {
        return;
    }
    if let Some(before) = state.actor_before_hand() {
        let color = ColorRole::FaintText.color(state.settings.theme).with_alpha(BEFORE_ALPHA);
        let frame = state.source_frame(state.frame());
        staged.scene.bodies.push(before.body_at(frame, Look::Ghost(color)));
    }
}

/// The moments around the playhead, or those at which something is asked for.
fn add_ghosts(staged: &mut Staged, state: &EditorState) {
    let now = state.frame_number() as i64;
    for (nth, actor) in state.stage.actors.iter().enumerate() {
        let last = actor.n_frames().saturating_sub(1);
        let frames: Vec<usize> = match state.settings.ghosts {
            GhostMode::Off | GhostMode::Fan => continue,
            GhostMode::Around => {
                let apart = (AROUND_SECS * state.fps()).round().max(1.0) as i64;
                let steps = (-N_AROUND..=N_AROUND).filter(|step| *step != 0);
                let frames = steps.filter_map(|step| usize::try_from(now + step * apart).ok());
                frames.filter(|frame| *frame <= last).collect()
            }
            GhostMode::AtConstraints => {
                let role = state.stage.roles.get(nth);
                let asked = role.map_or(&[][..], |role| role.constraints.as_slice());
                let frames = asked.iter().filter_map(|constraint| match constraint.kind {
                    ConstraintKind::Body { frame, .. }
                    | ConstraintKind::Joint { frame, .. }
                    | ConstraintKind::Pose { frame, .. } => Some(last.min(frame as usize)),
                    _ => None,
                });
                let mut frames: Vec<usize> = frames.filter(|frame| *frame as i64 != now).collect();
                frames.sort_unstable();
                frames.dedup();
                frames
            }
        };
        state.stage.add_ghosts(staged, nth, &frames);
    }
}

/// The ways of hands, feet and head where they are wanted, and of a joint whose target is selected.
fn add_trails(staged: &mut Staged, state: &EditorState) {
    let frame = state.frame();
    let asked = state.selected_mark().and_then(|mark| match &mark.constraint.kind {
        ConstraintKind::Joint { joint, .. } => Some((mark.at.character.0, joint.as_str())),
        _ => None,
    });
    for (nth, actor) in state.stage.actors.iter().enumerate() {
        let skeleton = &actor.skeleton;
        let trailed = TRAILED.iter().filter(|_| state.settings.joint_trails);
        let mut joints: Vec<JointIdx> =
            trailed.filter_map(|role| skeleton.by_role(*role)).collect();
        if let Some((_, name)) = asked.filter(|(character, _)| *character == nth) {
            joints.extend(skeleton.find(name).filter(|joint| !joints.contains(joint)));
        }
        for joint in joints {
            state.stage.add_joint_trail(staged, nth, joint, frame);
        }
    }
}

fn mark(staged: &mut Staged, is_meant: impl Fn(PickTarget) -> bool, emphasis: Emphasis) {
    let Staged { scene, picks } = staged;
    let is = |pick: Option<PickId>| pick.and_then(|id| picks.target(id)).is_some_and(&is_meant);
    for body in scene.bodies.iter_mut().filter(|body| is(body.pick)) {
        body.emphasis = emphasis;
    }
    for mark in scene.checkpoints.iter_mut().filter(|mark| is(mark.pick)) {
        mark.emphasis = emphasis;
    }
    for mark in scene.joint_targets.iter_mut().filter(|mark| is(mark.pick)) {
        mark.emphasis = emphasis;
    }
    let theme = scene.theme;
    for line in scene.lines.iter_mut().filter(|line| is(line.pick)) {
        let role = match emphasis {
            Emphasis::None => continue,
            Emphasis::Hovered => ColorRole::Hovered,
            Emphasis::Selected => ColorRole::Selected,
        };
        let share = if emphasis == Emphasis::Hovered { 0.45 } else { 1.0 };
        line.color = line.color.mixed(role.color(theme), share);
    }
    for solid in scene.solids.iter_mut().filter(|solid| is(solid.pick)) {
        solid.emphasis = emphasis;
    }
}

/// A checkpoint and the tip of its arrow are selected together.
pub fn whole(target: PickTarget) -> PickTarget {
    match target {
        // All of a meeting is one thing.
        PickTarget::Meeting { interaction, .. } => PickTarget::Meeting { interaction, member: 0 },
        PickTarget::CheckpointTip { character, constraint } => {
            PickTarget::Checkpoint { character, constraint }
        }
        other => other,
    }
}
