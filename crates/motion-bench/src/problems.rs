//! The five problems that figures are promised for (`shared/problems/01` to `05`), as data, so
//! that they can be asked of any library.

use glam::Vec2;
use motion_core::constraint::{BodyConstraint, LengthMode, LengthWish, Tolerance};
use motion_core::score::Wishes;
use motion_core::search::Problem;

/// A problem by its checkpoints; the last one stands at the last frame of the wished length.
#[derive(Clone, Copy, Debug)]
pub struct Ask {
    /// What its project file is called.
    pub name: &'static str,
    /// `(frame, x, z, heading)` in metres and degrees.
    pub checkpoints: &'static [(u32, f32, f32, f32)],
}

/// The problems in order.
pub const ASKS: [Ask; 5] = [
    Ask { name: "01-straight-walk", checkpoints: &[(0, 0.0, 0.0, 0.0), (239, 0.0, 9.0, 0.0)] },
    Ask { name: "02-left-corner", checkpoints: &[(0, 0.0, 0.0, 0.0), (209, 4.0, 4.0, 90.0)] },
    Ask {
        name: "03-three-checkpoints",
        checkpoints: &[(0, 0.0, 0.0, 0.0), (140, 2.5, 3.5, 60.0), (299, 7.0, 1.5, 135.0)],
    },
    Ask { name: "04-run", checkpoints: &[(0, 0.0, 0.0, 0.0), (119, 0.0, 15.0, 0.0)] },
    Ask { name: "05-about-turn", checkpoints: &[(0, 0.0, 0.0, 0.0), (239, 0.5, 0.0, 180.0)] },
];

impl Ask {
    /// The problem on a library of `n_clips`, all of them allowed.
    pub fn problem(&self, n_clips: usize) -> Problem {
        let checkpoint = |&(frame, x, z, heading_deg): &(u32, f32, f32, f32)| BodyConstraint {
            frame,
            position_m: Vec2::new(x, z),
            heading_rad: heading_deg.to_radians(),
            height_m: None,
            weight: 1.0,
            tolerance: Tolerance::default(),
        };
        let body: Vec<BodyConstraint> = self.checkpoints.iter().map(checkpoint).collect();
        let length = body.last().map(|last| LengthWish {
            frames: last.frame + 1,
            mode: LengthMode::Preferred,
            weight: 1.0,
        });
        let wishes = Wishes { length, body, ..Wishes::default() };
        Problem { wishes, allowed_clips: vec![true; n_clips], bridges: true }
    }
}

/// A minute of anything: 1,800 frames from the origin to six metres ahead.
pub fn a_minute(n_clips: usize) -> Problem {
    let ask = Ask { name: "a-minute", checkpoints: &[(0, 0.0, 0.0, 0.0), (1799, 0.0, 6.0, 0.0)] };
    let mut problem = ask.problem(n_clips);
    if let Some(length) = &mut problem.wishes.length {
        length.mode = LengthMode::Exact;
    }
    problem
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_io::diagnostic::Warnings;
    use motion_io::project_file::{self, ConstraintKind};

    #[test]
    fn the_problems_are_those_of_the_shared_folder() {
        let Some(shared) = motion_tests::shared_dir() else { return };
        for ask in ASKS {
            let path = shared.join("problems").join(ask.name).with_extension("gaitway");
            let project = project_file::load(&path, &mut Warnings::new()).unwrap();
            let character = &project.characters[0];
            let found: Vec<(u32, f32, f32, f32)> = character
                .constraints
                .iter()
                .filter_map(|constraint| match constraint.kind {
                    ConstraintKind::Body { frame, position_m: [x, z], heading_deg, .. } => {
                        Some((frame, x as f32, z as f32, heading_deg.unwrap() as f32))
                    }
                    _ => None,
                })
                .collect();
            assert_eq!(found, ask.checkpoints, "{}", ask.name);
            let length = character.length.as_ref().unwrap();
            assert_eq!(length.frames, ask.problem(1).wishes.length.map(|l| l.frames));
        }
    }
}
