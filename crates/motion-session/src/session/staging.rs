//! What of a session is to be seen: its document, and its characters in the takes that are shown.

use std::sync::Arc;

use glam::{Mat4, Vec2, Vec3};
use motion_core::planar::PlanarTransform;
use motion_io::project_file::{Constraint, ConstraintKind, Interaction, Member};
use motion_scene::color::Theme;

use super::Session;
use crate::document::{CharacterIdx, TakeId};
use crate::live::Take;
use crate::stage::actor::Actor;
use crate::stage::cast::look_of;
use crate::stage::meeting_wishes::{MeetingWish, placed, torso_at};
use crate::stage::pose_wishes::{PoseWish, placed_pose, top_of_m};
use crate::stage::{Role, Stage};

impl Session {
    /// Everybody in the take that is shown, with what is asked of them and how far off it is.
    ///
    /// Roles are in the order of the characters, and so are actors, who are there from the first
    /// character on as far as everybody has a motion: only in the first moments that is not all.
    pub fn stage(&self, theme: Theme) -> Stage {
        let shown = |nth| {
            let take = self.snapshot().character(CharacterIdx(nth))?.shown()?;
            self.actor(CharacterIdx(nth), take, theme)
        };
        let characters = self.document().characters();
        let actors = (0..characters.len()).map_while(shown).collect();
        let role = |(nth, character): (usize, &Arc<motion_io::project_file::Character>)| {
            let made = self.shown_of(CharacterIdx(nth)).and_then(|shown| shown.take.made.as_ref());
            Role {
                constraints: character.constraints.clone(),
                misses: made.map(|made| made.report.final_.clone()).unwrap_or_default(),
                root_path_m: made
                    .map(|made| made.motion.root_positions_m().to_vec())
                    .unwrap_or_default(),
                poses: self.pose_wishes(CharacterIdx(nth)),
            }
        };
        let roles = characters.iter().enumerate().map(role).collect();
        let obstacles = self.document().obstacles().to_vec();
        Stage { theme, actors, roles, obstacles, meetings: self.meetings() }
    }

    /// A character's pose constraints as bodies. One that may be anywhere is where the shown motion
    /// is at its frame, and where there is none it stays where its clip has it.
    fn pose_wishes(&self, character: CharacterIdx) -> Vec<PoseWish> {
        let Some(ready) = self.library() else { return Vec::new() };
        let constraints = self.document().character(character).map_or(&[][..], |c| &c.constraints);
        let made = self.shown_of(character).and_then(|shown| shown.take.made.as_ref());
        let body_at = |frame: u32| {
            let roots = made?.motion.root_positions_m();
            let root_m = roots.get(frame as usize).or(roots.last())?;
            Some(Vec2::new(root_m.x, root_m.z))
        };
        let wish = |(nth, constraint): (usize, &Constraint)| {
            let ConstraintKind::Pose { frame, clip, clip_frame, position_m, heading_deg, height_m } =
                &constraint.kind
            else {
                return None;
            };
            let at_m = position_m.map(|[x, z]| Vec2::new(x as f32, z as f32));
            let heading_rad = heading_deg.map(|deg| deg.to_radians() as f32);
            let at_m = at_m.or_else(|| body_at(*frame));
            let mut world = placed_pose(ready, clip, *clip_frame, at_m, heading_rad)?;
            let up = Mat4::from_translation(Vec3::Y * height_m.unwrap_or_default() as f32);
            world.iter_mut().for_each(|joint| *joint = up * *joint);
            Some(PoseWish {
                constraint: nth,
                id: constraint.id.clone(),
                frame: *frame,
                source: format!("{clip}:{clip_frame}"),
                mesh: ready.figure.mesh,
                top_m: top_of_m(&world),
                world_from_joint: world,
            })
        };
        constraints.iter().enumerate().filter_map(wish).collect()
    }

    /// Who meets whom, where the first of them is then in the shown take.
    fn meetings(&self) -> Vec<MeetingWish> {
        let interactions = self.document().interactions().iter().enumerate();
        interactions.filter_map(|(nth, interaction)| self.meeting(nth, interaction)).collect()
    }

    fn meeting(&self, nth: usize, interaction: &Interaction) -> Option<MeetingWish> {
        let ready = self.library()?;
        let characters = self.document().characters();
        let first = characters.iter().position(|c| c.name == interaction.members[0].character)?;
        let shown = self.shown_of(CharacterIdx(first));
        let made = shown.and_then(|shown| shown.take.made.as_ref());
        let anchor = made.and_then(|made| torso_at(&made.motion, interaction.frame));
        let places = placed(&interaction.relative, anchor.unwrap_or(PlanarTransform::IDENTITY));
        let body = |(member, place): (&Member, &PlanarTransform)| {
            let (at_m, heading_rad) = (Some(place.ground_m()), Some(place.heading_rad()));
            let joints = placed_pose(ready, &member.clip, member.clip_frame, at_m, heading_rad);
            (ready.figure.mesh, joints)
        };
        Some(MeetingWish {
            interaction: nth,
            frame: interaction.frame,
            names: interaction.members.iter().map(|m| m.character.clone()).collect(),
            bodies: interaction.members.iter().zip(&places).map(body).collect(),
            places,
        })
    }

    /// A character in a take of its own, to be shown as a ghost or beside another; `None` while its
    /// motion is not made.
    pub fn actor_in(&self, character: CharacterIdx, take: TakeId, theme: Theme) -> Option<Actor> {
        self.actor(character, self.snapshot().character(character)?.take(take)?, theme)
    }

    fn actor(&self, character: CharacterIdx, take: &Take, theme: Theme) -> Option<Actor> {
        let ready = self.library()?;
        let motion = &take.made.as_ref()?.motion;
        // The motion of the library before this one has other joints.
        let fits = motion.n_joints() == ready.skeleton.n_joints();
        fits.then(|| Actor {
            name: self.document().character(character).map(|c| c.name.clone()).unwrap_or_default(),
            figure: Arc::clone(&ready.figure),
            skeleton: Arc::clone(&ready.skeleton),
            motion: Arc::clone(motion),
            look: look_of(character.0, theme),
        })
    }
}
