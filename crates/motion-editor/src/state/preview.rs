//! A clip that is played in the view because the pointer rests on it.

use motion_session::session::ClipPlace;
use motion_session::stage::actor::Actor;

use super::EditorState;

/// Which clip, and how far it has played.
#[derive(Clone, Debug)]
pub struct ClipPreview {
    /// The clip's id.
    pub clip: String,
    /// It, where the active character is.
    pub actor: Actor,
    /// The moment that is shown, frames.
    pub frame: f64,
}

impl EditorState {
    /// Plays this clip from its beginning, or none; goes on with it where it is played already.
    pub fn preview_clip(&mut self, clip: Option<String>) {
        let Some(clip) = clip else {
            self.preview = None;
            return;
        };
        if self.preview.as_ref().is_some_and(|known| known.clip == clip) {
            return;
        }
        let here = self.stage.actors.get(self.session.active().0);
        let at = here.map(|actor| actor.root_at_m(self.frame())).unwrap_or_default();
        let position_m = [f64::from(at.x), f64::from(at.z)];
        let place = ClipPlace { position_m, heading_deg: 0.0 };
        let actor = self.session.preview_clip(&clip, place, self.settings.theme);
        self.preview = actor.map(|actor| ClipPreview { clip, actor, frame: 0.0 });
    }

    /// Lets the preview play on; it begins again at its end. Gives whether there is one.
    pub fn advance_preview(&mut self, dt_secs: f64) -> bool {
        let fps = self.fps();
        let Some(preview) = &mut self.preview else { return false };
        let n_frames = preview.actor.n_frames().max(1) as f64;
        preview.frame = (preview.frame + dt_secs.clamp(0.0, 0.25) * fps) % n_frames;
        true
    }
}
