//! What of a session is to be seen: its document, and its characters in the takes that are shown.

use std::sync::Arc;

use motion_scene::color::Theme;

use super::Session;
use crate::document::{CharacterIdx, TakeId};
use crate::live::Take;
use crate::stage::actor::Actor;
use crate::stage::cast::look_of;
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
            }
        };
        let roles = characters.iter().enumerate().map(role).collect();
        Stage { theme, actors, roles, obstacles: self.document().obstacles().to_vec() }
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
