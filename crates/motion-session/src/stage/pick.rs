//! What the names under the pointer mean.

use motion_scene::body::PickId;

/// A thing on the stage that can be pointed at. Indices are the project's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PickTarget {
    /// A character.
    Actor {
        /// Which.
        actor: usize,
    },
    /// A character at another time.
    Ghost {
        /// Whose.
        actor: usize,
        /// The frame it shows.
        frame: usize,
    },
    /// The place of a body constraint.
    Checkpoint {
        /// Whose.
        character: usize,
        /// Which of the character's constraints.
        constraint: usize,
    },
    /// The arrow of a body constraint, which turns it.
    CheckpointTip {
        /// Whose.
        character: usize,
        /// Which of the character's constraints.
        constraint: usize,
    },
    /// A joint constraint.
    JointTarget {
        /// Whose.
        character: usize,
        /// Which of the character's constraints.
        constraint: usize,
    },
    /// A pose constraint.
    Pose {
        /// Whose.
        character: usize,
        /// Which of the character's constraints.
        constraint: usize,
    },
    /// A path to follow.
    Path {
        /// Whose.
        character: usize,
        /// Which of the character's constraints.
        constraint: usize,
    },
    /// A character's part in a meeting.
    Meeting {
        /// Which of the project's.
        interaction: usize,
        /// Which of its members.
        member: usize,
    },
    /// Something in the way.
    Obstacle {
        /// Which of the project's.
        obstacle: usize,
    },
}

/// The names given out for one scene, in the order in which things were put on the stage: the same
/// stage gives the same names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Picks(Vec<PickTarget>);

impl Picks {
    /// A name for `target`; `None` once four thousand million things have one.
    pub fn name(&mut self, target: PickTarget) -> Option<PickId> {
        let id = PickId::nth(u32::try_from(self.0.len()).ok()?)?;
        self.0.push(target);
        Some(id)
    }

    /// What a name means; `None` for a name of another scene.
    pub fn target(&self, id: PickId) -> Option<PickTarget> {
        self.0.get(id.0.get() as usize - 1).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back_to_things() {
        let mut picks = Picks::default();
        let things = [PickTarget::Actor { actor: 0 }, PickTarget::Obstacle { obstacle: 3 }];
        let ids = things.map(|thing| picks.name(thing).unwrap());
        assert_eq!(ids.map(|id| picks.target(id).unwrap()), things);
        let mut other = Picks::default();
        assert_eq!(other.name(things[1]), Some(ids[0]), "names are given in order");
        assert_eq!(other.target(ids[1]), None);
    }
}
