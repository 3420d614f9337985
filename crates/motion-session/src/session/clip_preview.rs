//! A clip of the library as it would look at a place, before it is used for anything.

use std::sync::{Arc, Weak};

use glam::Vec2;
use motion_core::clip::Clip;
use motion_core::motion::Motion;
use motion_core::planar::PlanarTransform;
use motion_core::search::SearchLibrary;
use motion_scene::color::Theme;

use super::Session;
use crate::stage::actor::Actor;
use crate::stage::cast::look_of;

/// Where the first frame of a clip is put, on the floor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClipPlace {
    /// `[x, z]`, metres.
    pub position_m: [f64; 2],
    /// Degrees; 0 is +Z, 90 is +X.
    pub heading_deg: f64,
}

/// The clip that was asked for last: whoever hovers asks for it again in every frame.
#[derive(Debug)]
pub(super) struct Previewed {
    /// Of which library, which is not kept in memory for it.
    library: Weak<SearchLibrary>,
    clip: String,
    place: ClipPlace,
    motion: Arc<Motion>,
}

impl Session {
    /// A clip of the library on the library's figure, its first frame at a place on the floor;
    /// `None` where the library has no such clip, or is not there. One clip's motion is copied when
    /// another clip or place is asked for than the last time.
    pub fn preview_clip(&mut self, clip: &str, place: ClipPlace, theme: Theme) -> Option<Actor> {
        let ready = self.library.ready()?.clone();
        let known = self.previewed.as_ref().filter(|known| {
            known.clip == clip
                && known.place == place
                && known.library.ptr_eq(&Arc::downgrade(&ready.search))
        });
        let motion = match known {
            Some(known) => Arc::clone(&known.motion),
            None => {
                let set = &ready.library.clips;
                let motion = Arc::new(placed(set.clip(set.by_id(clip)?), place));
                self.previewed = Some(Previewed {
                    library: Arc::downgrade(&ready.search),
                    clip: clip.to_owned(),
                    place,
                    motion: Arc::clone(&motion),
                });
                motion
            }
        };
        Some(Actor {
            name: clip.to_owned(),
            figure: Arc::clone(&ready.figure),
            skeleton: Arc::clone(&ready.skeleton),
            motion,
            look: look_of(0, theme),
        })
    }
}

fn placed(clip: &Clip, place: ClipPlace) -> Motion {
    let mut motion = clip.motion.clone();
    let [x_m, z_m] = place.position_m;
    let heading_rad = place.heading_deg.to_radians() as f32;
    let world_from_torso =
        PlanarTransform::new(heading_rad, Vec2::new(x_m as f32, z_m as f32), 0.0);
    let torso_from_clip = clip.track.world_from_torso[0].inverse();
    let world_from_clip = world_from_torso * torso_from_clip;
    for at in motion.root_positions_m_mut() {
        *at = world_from_clip.apply(*at);
    }
    let turn = world_from_clip.rotation();
    for frame in 0..motion.n_frames() {
        if let Some(root) = motion.rotations_mut(frame).first_mut() {
            *root = (turn * *root).normalize();
        }
    }
    motion
}

#[cfg(test)]
mod tests {
    use super::super::tests::session;
    use super::*;

    #[test]
    fn the_first_frame_stands_where_it_is_put() {
        let mut session = session(None);
        let place = ClipPlace { position_m: [3.0, -2.0], heading_deg: 90.0 };
        let actor = session.preview_clip("left", place, Theme::Dark).unwrap();
        let clips = session.library().unwrap().library.clips.clone();
        let clip = clips.clip(clips.by_id("left").unwrap());
        assert_eq!(actor.n_frames(), clip.n_frames());
        let root = actor.root_at_m(0.0);
        assert!(glam::vec2(root.x - 3.0, root.z + 2.0).length() < 0.3, "{root}");
        assert!((root.y - clip.motion.root_positions_m()[0].y).abs() < 1e-4, "{root}");
        // It walks where it looks: to the left of +X, which is towards -Z, after a while.
        let end = actor.root_at_m(20.0);
        assert!(end.x > root.x + 0.3, "from {root} to {end}");
        // Shapes are kept: so far as the clip goes, it goes here.
        let ways = clip.motion.root_positions_m();
        let (own, here) = (ways[20].distance(ways[0]), end.distance(root));
        assert!((own - here).abs() < 1e-4);

        let again = session.preview_clip("left", place, Theme::Dark).unwrap();
        assert!(Arc::ptr_eq(&again.motion, &actor.motion), "not copied again");
        let other = session.preview_clip("left", ClipPlace::default(), Theme::Dark).unwrap();
        assert!(!Arc::ptr_eq(&other.motion, &actor.motion));
        assert_eq!(session.preview_clip("none", place, Theme::Dark), None);
    }
}
