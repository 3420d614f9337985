//! Everything that can be authored, as plain data.
//!
//! [`apply`] makes a document of a document and a command, or says in a sentence why not. It
//! depends on these two alone, so that commands can be stored, repeated and tested without a window.

mod by_hand;
mod character;
mod check;
mod constraint;
pub mod error;
mod interaction;
mod label;
mod settings;
mod tagging;

#[cfg(test)]
pub(crate) mod arbitrary;

use motion_core::by_hand::Knot;
use motion_core::tags::HandTag;
use motion_io::project_file::{
    ConstraintKind, LengthMode, LockedPiece, Member, Obstacle, Palette, PathHeading, Placement,
    Shape, Tolerance,
};

use crate::document::{
    CharacterIdx, ConstraintRef, Document, HandEdit, ObstacleIdx, StoredTake, TakeId,
};
pub use error::CommandError;

/// A change of a document. Frames are the motion's, from 0; `[x, z]` and `[x, y, z]` are metres in
/// the world, headings degrees (0 is +Z, 90 is +X).
#[derive(Clone, Debug, PartialEq)]
#[expect(
    missing_docs,
    reason = "fields are named as in the project file, where they are explained"
)]
pub enum Command {
    /// A place to be at a frame. Its id is [`Document::next_id`] of `body`; so for the others.
    AddCheckpoint {
        character: CharacterIdx,
        frame: u32,
        position_m: [f64; 2],
        heading_deg: Option<f64>,
    },
    /// A joint to be at a place at a frame.
    AddJointTarget {
        character: CharacterIdx,
        frame: u32,
        joint: String,
        position_m: [f64; 3],
        velocity_m_s: Option<[f64; 3]>,
    },
    /// A pose of a clip at a frame, at a place or anywhere.
    AddPose {
        character: CharacterIdx,
        frame: u32,
        clip: String,
        clip_frame: u32,
        position_m: Option<[f64; 2]>,
        heading_deg: Option<f64>,
    },
    /// A kind of motion over a stretch of time.
    AddStyle {
        character: CharacterIdx,
        from: u32,
        to: u32,
        tag: String,
    },
    /// A way to follow over a stretch of time.
    AddPath {
        character: CharacterIdx,
        from: u32,
        to: u32,
        points_m: Vec<[f64; 2]>,
    },
    /// A part of a take that stays.
    AddLock {
        character: CharacterIdx,
        from: u32,
        to: u32,
        pieces: Vec<LockedPiece>,
    },

    /// A checkpoint or a placed pose to another place on the floor.
    Move {
        at: ConstraintRef,
        position_m: [f64; 2],
    },
    /// A pose to a place on the floor, or to wherever the body is then.
    SetPlace {
        at: ConstraintRef,
        position_m: Option<[f64; 2]>,
    },
    /// A checkpoint or a pose to another heading, or to any.
    Turn {
        at: ConstraintRef,
        heading_deg: Option<f64>,
    },
    /// A checkpoint or a pose to a ground of another height, or of any.
    Raise {
        at: ConstraintRef,
        height_m: Option<f64>,
    },
    /// A joint target to another place.
    MoveJointTarget {
        at: ConstraintRef,
        position_m: [f64; 3],
    },
    /// Another joint to be at the place of a joint target.
    SetJoint {
        at: ConstraintRef,
        joint: String,
    },
    /// Another pose to be taken.
    SetPoseSource {
        at: ConstraintRef,
        clip: String,
        clip_frame: u32,
    },
    /// How fast the joint goes there.
    SetVelocity {
        at: ConstraintRef,
        velocity_m_s: Option<[f64; 3]>,
    },
    /// Another tag of a style.
    SetTag {
        at: ConstraintRef,
        tag: String,
    },
    /// Another way of a path.
    Reshape {
        at: ConstraintRef,
        points_m: Vec<[f64; 2]>,
    },
    /// Where the body looks on its way along a path.
    SetPathHeading {
        at: ConstraintRef,
        heading: PathHeading,
    },
    /// A checkpoint, joint target or pose to another frame; others keep their length and begin there.
    Retime {
        at: ConstraintRef,
        frame: u32,
    },
    /// A style, path or lock to another stretch of time.
    RetimeSpan {
        at: ConstraintRef,
        from: u32,
        to: u32,
    },
    /// The same once more at another frame.
    Duplicate {
        at: ConstraintRef,
        frame: u32,
    },
    /// Away with it.
    Remove {
        at: ConstraintRef,
    },
    /// How much it counts; `None` is 1.
    SetWeight {
        at: ConstraintRef,
        weight: Option<f64>,
    },
    /// How far off is still well.
    SetTolerance {
        at: ConstraintRef,
        tolerance: Option<Tolerance>,
    },

    /// Characters who stand to each other in a given way, each in a pose, at a frame. Its id is
    /// [`Document::next_interaction_id`].
    AddInteraction {
        frame: u32,
        members: Vec<Member>,
        relative: Vec<Placement>,
    },
    /// Another moment, other members, poses or places of an interaction.
    ChangeInteraction {
        id: String,
        frame: u32,
        members: Vec<Member>,
        relative: Vec<Placement>,
    },
    SetInteractionWeight {
        id: String,
        weight: Option<f64>,
    },
    RemoveInteraction {
        id: String,
    },

    AddObstacle {
        shape: Shape,
    },
    ChangeObstacle {
        obstacle: ObstacleIdx,
        shape: Shape,
    },
    RemoveObstacle {
        obstacle: ObstacleIdx,
    },

    /// How long the motion shall be. `frames` may be left out only where the length is free.
    SetLength {
        character: CharacterIdx,
        frames: Option<u32>,
        mode: LengthMode,
    },
    /// How much the length counts; `None` is 1.
    SetLengthWeight {
        character: CharacterIdx,
        weight: Option<f64>,
    },
    /// How much a term of the score counts; `None` is 1.
    SetTermWeight {
        term: String,
        weight: Option<f64>,
    },
    /// Which clips may be used; `None` is all.
    SetPalette {
        palette: Option<Palette>,
    },
    /// A tag to a clip, or to a stretch of its frames, both ends included.
    TagClip {
        clip: String,
        tag: HandTag,
    },
    /// A tag given by hand away again.
    UntagClip {
        clip: String,
        tag: HandTag,
    },
    SetSeed {
        seed: u64,
    },
    SetMirror {
        mirror: Option<bool>,
    },
    SetBridges {
        bridges: Option<bool>,
    },
    /// `builtin`, or a path relative to the project file.
    SetLibrary {
        library: String,
    },
    RenameProject {
        name: String,
    },

    /// Somebody else, with a start and an end.
    AddCharacter {
        name: String,
    },
    RenameCharacter {
        character: CharacterIdx,
        name: String,
    },
    RemoveCharacter {
        character: CharacterIdx,
    },
    /// The character's own mesh, relative to the project file.
    SetBody {
        character: CharacterIdx,
        body: Option<String>,
    },

    /// Keep a take with the project whatever is found.
    PinTake {
        take: StoredTake,
    },
    UnpinTake {
        character: CharacterIdx,
        take: TakeId,
    },
    /// Call a take something, and so keep it; without a name and a pin it is not kept any more.
    NameTake {
        take: StoredTake,
        name: Option<String>,
    },

    /// Change something by hand on a take; so it is kept with the project. Its id is the layer's
    /// [`next_id`](crate::document::ByHand::next_id). For this and the next: a `take` as
    /// [`Take::stored`](crate::live::Take::stored) gives it brings the layer along that it has from
    /// the take that it was improved from.
    AddByHand {
        take: StoredTake,
        edit: HandEdit,
    },
    ChangeByHand {
        take: StoredTake,
        id: String,
        edit: HandEdit,
    },
    RemoveByHand {
        take: StoredTake,
        id: String,
    },
    /// Say when what of a take is shown; `None` shows everything in its own time.
    RetimeByHand {
        take: StoredTake,
        knots: Option<Vec<Knot>>,
    },
    /// The take as it was found.
    ClearByHand {
        take: StoredTake,
    },
}

/// The document after `command`. What is the same is shared with `document`.
pub fn apply(document: &Document, command: &Command) -> Result<Document, CommandError> {
    let mut new = document.clone();
    apply_in_place(&mut new, command)?;
    Ok(new)
}

/// The document after all of `commands`, or the first refusal.
pub fn apply_all(document: &Document, commands: &[Command]) -> Result<Document, CommandError> {
    let mut new = document.clone();
    commands.iter().try_for_each(|command| apply_in_place(&mut new, command))?;
    Ok(new)
}

/// On an error the document may be half changed; callers drop it then.
fn apply_in_place(document: &mut Document, command: &Command) -> Result<(), CommandError> {
    use Command as C;
    match command.clone() {
        C::AddCheckpoint { character, frame, position_m, heading_deg } => {
            let kind = ConstraintKind::Body { frame, position_m, heading_deg, height_m: None };
            constraint::add(document, character, kind)
        }
        C::AddJointTarget { character, frame, joint, position_m, velocity_m_s } => {
            let kind = ConstraintKind::Joint { frame, joint, position_m, velocity_m_s };
            constraint::add(document, character, kind)
        }
        C::AddPose { character, frame, clip, clip_frame, position_m, heading_deg } => {
            let height_m = None;
            let kind =
                ConstraintKind::Pose { frame, clip, clip_frame, position_m, heading_deg, height_m };
            constraint::add(document, character, kind)
        }
        C::AddStyle { character, from, to, tag } => {
            constraint::add(document, character, ConstraintKind::Style { from, to, tag })
        }
        C::AddPath { character, from, to, points_m } => {
            let heading = PathHeading::default();
            let kind = ConstraintKind::Path { from, to, points_m, heading };
            constraint::add(document, character, kind)
        }
        C::AddLock { character, from, to, pieces } => {
            constraint::add(document, character, ConstraintKind::Lock { from, to, pieces })
        }
        C::Move { at, position_m } => constraint::move_to(document, &at, position_m),
        C::SetPlace { at, position_m } => constraint::set_place(document, &at, position_m),
        C::Turn { at, heading_deg } => constraint::turn(document, &at, heading_deg),
        C::Raise { at, height_m } => constraint::raise(document, &at, height_m),
        C::MoveJointTarget { at, position_m } => constraint::move_joint(document, &at, position_m),
        C::SetJoint { at, joint } => constraint::set_joint(document, &at, joint),
        C::SetPoseSource { at, clip, clip_frame } => {
            constraint::set_pose_source(document, &at, clip, clip_frame)
        }
        C::SetVelocity { at, velocity_m_s } => {
            constraint::set_velocity(document, &at, velocity_m_s)
        }
        C::SetTag { at, tag } => constraint::set_tag(document, &at, tag),
        C::Reshape { at, points_m } => constraint::reshape(document, &at, points_m),
        C::SetPathHeading { at, heading } => constraint::set_path_heading(document, &at, heading),
        C::Retime { at, frame } => constraint::retime(document, &at, frame),
        C::RetimeSpan { at, from, to } => constraint::retime_span(document, &at, from, to),
        C::Duplicate { at, frame } => constraint::duplicate(document, &at, frame),
        C::Remove { at } => constraint::remove(document, &at),
        C::SetWeight { at, weight } => constraint::set_weight(document, &at, weight),
        C::SetTolerance { at, tolerance } => constraint::set_tolerance(document, &at, tolerance),
        C::AddInteraction { frame, members, relative } => {
            interaction::add(document, frame, members, relative)
        }
        C::ChangeInteraction { id, frame, members, relative } => {
            interaction::change(document, &id, frame, members, relative)
        }
        C::SetInteractionWeight { id, weight } => interaction::set_weight(document, &id, weight),
        C::RemoveInteraction { id } => interaction::remove(document, &id),
        C::AddObstacle { shape } => settings::add_obstacle(document, shape),
        C::ChangeObstacle { obstacle, shape } => {
            settings::change_obstacle(document, obstacle, shape)
        }
        C::RemoveObstacle { obstacle } => settings::remove_obstacle(document, obstacle),
        C::SetLength { character, frames, mode } => {
            character::set_length(document, character, frames, mode)
        }
        C::SetLengthWeight { character, weight } => {
            character::set_length_weight(document, character, weight)
        }
        C::SetTermWeight { term, weight } => settings::set_term_weight(document, term, weight),
        C::SetPalette { palette } => settings::set_palette(document, palette),
        C::TagClip { clip, tag } => tagging::tag(document, clip, tag),
        C::UntagClip { clip, tag } => tagging::untag(document, &clip, &tag),
        C::SetSeed { seed } => settings::set_seed(document, seed),
        C::SetMirror { mirror } => settings::set_mirror(document, mirror),
        C::SetBridges { bridges } => settings::set_bridges(document, bridges),
        C::SetLibrary { library } => settings::set_library(document, library),
        C::RenameProject { name } => settings::rename(document, name),
        C::AddCharacter { name } => character::add(document, name),
        C::RenameCharacter { character, name } => character::rename(document, character, name),
        C::RemoveCharacter { character } => character::remove(document, character),
        C::SetBody { character, body } => character::set_body(document, character, body),
        C::PinTake { take } => settings::pin(document, take),
        C::UnpinTake { character, take } => settings::unpin(document, character, take),
        C::NameTake { take, name } => settings::name_take(document, take, name),
        C::AddByHand { take, edit } => by_hand::add(document, take, edit),
        C::ChangeByHand { take, id, edit } => by_hand::change(document, take, &id, edit),
        C::RemoveByHand { take, id } => by_hand::remove(document, take, &id),
        C::RetimeByHand { take, knots } => by_hand::set_retime(document, take, knots),
        C::ClearByHand { take } => by_hand::clear(document, take),
    }
}

/// An obstacle of this shape that no file knew anything else of.
fn obstacle_of(shape: Shape) -> Obstacle {
    Obstacle { shape, extra: Default::default() }
}

#[cfg(test)]
mod tests;
