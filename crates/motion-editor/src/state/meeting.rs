//! Characters who meet, and what else is asked for by a command rather than a drag.

use motion_core::skeleton::JointRole;
use motion_session::command::Command;
use motion_session::document::CharacterIdx;
use motion_session::selection::Selectable;
use motion_session::stage::meeting_wishes::MeetingWish;
use motion_session::{Interaction, Member, Placement};

use super::EditorState;
use super::moving::rounded;
use crate::settings::Tool;
use crate::timeline::style_drag;
use crate::viewport::gesture::pose;

/// Who meet stand so far apart at first, metres: near enough to take a hand.
const APART_M: f64 = 1.0;

impl EditorState {
    /// Has the active character and the one after it meet at the playhead, each in the pose that it
    /// has then, face to face; as one step. The meeting is selected.
    pub fn meet_here(&mut self) {
        let characters = self.session.document().characters().len();
        let active = self.session.active();
        if characters < 2 {
            return;
        }
        let other = CharacterIdx((active.0 + 1) % characters);
        let frame = self.frame_number() as u32;
        let pose_of_active = pose::source(self);
        let (Some(first), Some(second)) =
            (self.member(active, pose_of_active), self.member(other, self.pose_of(other, frame)))
        else {
            return;
        };
        let stands = |z, heading_deg| Placement {
            position_m: [0.0, z],
            heading_deg,
            extra: Default::default(),
        };
        let relative = vec![stands(0.0, 0.0), stands(APART_M, 180.0)];
        let members = vec![first, second];
        let mut commands = vec![Command::AddInteraction { frame, members, relative }];
        commands.extend([active, other].into_iter().filter_map(|c| self.length_of_for(c, frame)));
        let id = self.session.document().next_interaction_id();
        if self.apply_all("Meet", &commands) {
            self.session.selection_mut().select(Selectable::Interaction(id));
            self.settings.tool = Tool::Select;
        }
    }

    fn member(&self, character: CharacterIdx, pose: Option<(String, u32)>) -> Option<Member> {
        let name = self.session.document().character(character)?.name.clone();
        let (clip, clip_frame) = pose?;
        Some(Member { character: name, clip, clip_frame, extra: Default::default() })
    }

    /// The clip and the frame of it that a character shows at a frame; the library's first where it
    /// shows none.
    fn pose_of(&self, character: CharacterIdx, frame: u32) -> Option<(String, u32)> {
        let shown = self.session.shown_of(character);
        let pieces = shown.map_or(&[][..], |shown| &shown.take.pieces);
        let mut rest = frame;
        let mut last = None;
        for piece in pieces {
            let n = piece.to.saturating_sub(piece.from) + 1;
            if rest < n {
                return Some((piece.clip.clone(), piece.from + rest));
            }
            rest -= n;
            last = Some((piece.clip.clone(), piece.to));
        }
        last.or_else(|| Some((self.clips.first()?.id.clone(), 0)))
    }

    /// A meeting as it is to be seen, where there are bodies for it.
    pub fn meeting_wish(&self, id: &str) -> Option<&MeetingWish> {
        let all = self.session.document().interactions();
        let nth = all.iter().position(|known| known.id == id)?;
        self.stage.meetings.iter().find(|wish| wish.interaction == nth)
    }

    /// The meetings that the active character takes part in.
    pub fn meetings(&self) -> impl Iterator<Item = &Interaction> {
        let document = self.session.document();
        let active = document.character(self.session.active()).map(|c| c.name.as_str());
        let takes_part =
            move |known: &&Interaction| known.members.iter().any(|m| Some(&*m.character) == active);
        document.interactions().iter().filter(takes_part)
    }

    /// What brings a meeting to another frame; motions get as long as they must be.
    pub fn retime_meeting(&self, known: &Interaction, frame: u32) -> Vec<Command> {
        let (members, relative) = (known.members.clone(), known.relative.clone());
        let characters = self.session.document().characters().iter().enumerate();
        let takes_part = |name: &str| members.iter().any(|m| m.character == name);
        let of_members = characters.filter(|(_, c)| takes_part(&c.name));
        let lengths =
            of_members.filter_map(|(nth, _)| self.length_of_for(CharacterIdx(nth), frame));
        let mut commands: Vec<Command> = lengths.collect();
        commands.push(crate::meeting::changed(known, frame, members, relative));
        commands
    }

    /// The meeting that is selected.
    pub fn selected_meeting(&self) -> Option<&Interaction> {
        match self.selected() {
            Some(Selectable::Interaction(id)) => self.session.document().interaction(id),
            _ => None,
        }
    }

    /// Asks for the head where it is at the playhead, and selects that.
    pub fn add_joint_target_here(&mut self) {
        let character = self.session.active();
        let Some(actor) = self.stage.actors.get(character.0) else { return };
        let Some(head) = actor.skeleton.by_role(JointRole::Head) else { return };
        let body = actor.body_at(self.frame(), actor.look);
        let Some(world) = body.world_from_joint.get(head.idx()) else { return };
        let position_m = world.w_axis.truncate().to_array().map(|x| rounded(f64::from(x)));
        let frame = self.frame_number() as u32;
        let mut commands = vec![Command::AddJointTarget {
            character,
            frame,
            joint: JointRole::Head.name().to_owned(),
            position_m,
            velocity_m_s: None,
        }];
        commands.extend(self.length_for(frame));
        if self.apply_all("Add joint target", &commands) {
            self.select_newest();
        }
    }

    /// Asks for the chosen clip's pose at the playhead, wherever the body is, and selects that.
    pub fn add_pose_here(&mut self) {
        let Some((clip, clip_frame)) = pose::source(self) else { return };
        let (character, frame) = (self.session.active(), self.frame_number() as u32);
        let (position_m, heading_deg) = (None, None);
        let mut commands =
            vec![Command::AddPose { character, frame, clip, clip_frame, position_m, heading_deg }];
        commands.extend(self.length_for(frame));
        if self.apply_all("Add pose", &commands) {
            self.select_newest();
        }
    }

    /// Asks for a style over the part that is played, or a second from the playhead on, and selects
    /// that.
    pub fn add_style_here(&mut self) {
        let (from, to) = match self.session.playback().chosen_range() {
            Some(_) => {
                let range = self.session.playback().range();
                (range.from, range.to)
            }
            None => {
                let from = self.frame_number() as u32;
                (from, from + self.fps().round() as u32)
            }
        };
        let commands = style_drag::commands(self, from, to);
        if self.apply_all("Add style", &commands) {
            self.select_newest();
        }
    }
}
