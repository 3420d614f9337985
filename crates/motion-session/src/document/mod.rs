//! What the user authors, as one value that is cheap to clone.
//!
//! A document is a project with the takes that its user has pinned, named or changed by hand. It is never changed in
//! place: a [`Command`](crate::command::Command) makes another one that shares what is the same, so
//! that an undo history is a list of documents.
//!
//! Invariant: what a document says can be saved, and read again as the same document.

pub mod by_hand;
mod by_hand_file;
pub mod ids;
pub mod take;
mod take_file;

use std::sync::Arc;

use motion_core::tags::HandTags;
use motion_io::project_file::{
    Character, Constraint, Hashes, Interaction, Obstacle, Palette, Project, Search,
};
use serde_json::Value;

pub use by_hand::{ByHand, HandChange, HandEdit, HandFault};
pub use ids::{CharacterIdx, ConstraintRef, ObstacleIdx};
pub use take::{StoredTake, TakeBook, TakeId, TakePiece};

/// What the user authors.
#[derive(Clone, Debug)]
pub struct Document {
    /// The project without its characters, obstacles and editor part, which stand beside it so that
    /// changing one of them copies nothing else.
    pub(crate) head: Arc<Project>,
    pub(crate) characters: Arc<Vec<Arc<Character>>>,
    pub(crate) obstacles: Arc<Vec<Obstacle>>,
    pub(crate) takes: Arc<TakeBook>,
    /// What the file has under `"editor"` besides takes.
    editor: Option<Arc<Value>>,
}

impl Document {
    /// The document of a project.
    pub fn from_project(mut project: Project) -> Self {
        let characters = std::mem::take(&mut project.characters);
        let obstacles = std::mem::take(&mut project.obstacles);
        let mut editor = project.editor.take();
        let takes = take_file::take_out(editor.as_mut());
        Self {
            head: Arc::new(project),
            characters: Arc::new(characters.into_iter().map(Arc::new).collect()),
            obstacles: Arc::new(obstacles),
            takes: Arc::new(takes),
            editor: editor.map(Arc::new),
        }
    }

    /// The project of the document: what is saved.
    pub fn to_project(&self) -> Project {
        Project {
            characters: self.characters.iter().map(|c| Character::clone(c)).collect(),
            obstacles: self.obstacles.to_vec(),
            editor: take_file::put_back(self.editor.as_deref().cloned(), &self.takes),
            ..Project::clone(&self.head)
        }
    }

    /// What the user calls it.
    pub fn name(&self) -> &str {
        &self.head.name
    }

    /// A sentence on what it is for.
    pub fn about(&self) -> Option<&str> {
        self.head.about.as_deref()
    }

    /// Frames per second of everything in it.
    pub fn fps(&self) -> f64 {
        self.head.fps
    }

    /// The library as written: `builtin`, or a path relative to the project file.
    pub fn library(&self) -> &str {
        &self.head.library
    }

    /// Content hashes of what the project was made with.
    pub fn hashes(&self) -> Option<&Hashes> {
        self.head.hashes.as_ref()
    }

    /// Which clips may be used; all where there is none.
    pub fn palette(&self) -> Option<&Palette> {
        self.head.palette.as_ref()
    }

    /// Tags given to clips by hand.
    pub fn hand_tags(&self) -> HandTags {
        self.head.hand_tags()
    }

    /// How to search: seed, weights and the like.
    pub fn search(&self) -> &Search {
        &self.head.search
    }

    /// Where characters meet.
    pub fn interactions(&self) -> &[Interaction] {
        &self.head.interactions
    }

    /// At least one.
    pub fn characters(&self) -> &[Arc<Character>] {
        &self.characters
    }

    /// A character, if it is there.
    pub fn character(&self, character: CharacterIdx) -> Option<&Character> {
        self.characters.get(character.0).map(AsRef::as_ref)
    }

    /// A constraint, if it is there.
    pub fn constraint(&self, at: &ConstraintRef) -> Option<&Constraint> {
        self.character(at.character)?.constraints.iter().find(|c| c.id == at.id)
    }

    /// What stands in the way.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// An obstacle, if it is there.
    pub fn obstacle(&self, obstacle: ObstacleIdx) -> Option<&Obstacle> {
        self.obstacles.get(obstacle.0)
    }

    /// Takes that the user has pinned, named or changed by hand.
    pub fn takes(&self) -> &TakeBook {
        &self.takes
    }

    /// The id that the next constraint of `kind` gets: the first free of `kind-1`, `kind-2`, ….
    pub fn next_id(&self, character: CharacterIdx, kind: &str) -> String {
        let taken = self.character(character).map_or(&[][..], |c| &c.constraints);
        // Of one more than there are constraints, one is free.
        let ids = (1..=taken.len() + 1).map(|nth| format!("{kind}-{nth}"));
        ids.into_iter().find(|id| taken.iter().all(|c| c.id != *id)).unwrap_or_default()
    }

    /// The id that the next interaction gets: the first free of `interaction-1`, ….
    pub fn next_interaction_id(&self) -> String {
        let taken = self.interactions();
        // Of one more than there are, one is free.
        let ids = (1..=taken.len() + 1).map(|nth| format!("interaction-{nth}"));
        ids.into_iter().find(|id| taken.iter().all(|i| i.id != *id)).unwrap_or_default()
    }

    /// An interaction, if it is there.
    pub fn interaction(&self, id: &str) -> Option<&Interaction> {
        self.interactions().iter().find(|interaction| interaction.id == id)
    }

    /// Whether both speak of the same motions: everything but names and kept takes is equal.
    pub fn asks_the_same_as(&self, other: &Self) -> bool {
        let of_head = |d: &Self| {
            let Project { fps, library, palette, tags, search, interactions, .. } = &*d.head;
            let asked = (palette.clone(), tags.clone(), search.clone(), interactions.clone());
            (*fps, library.clone(), asked)
        };
        let same_head = Arc::ptr_eq(&self.head, &other.head) || of_head(self) == of_head(other);
        same_head
            && (Arc::ptr_eq(&self.characters, &other.characters)
                || self.characters == other.characters)
            && (Arc::ptr_eq(&self.obstacles, &other.obstacles) || self.obstacles == other.obstacles)
    }

    /// About how much memory the document takes beside `other`, with which it may share parts,
    /// bytes.
    pub(crate) fn bytes_beside(&self, other: &Self) -> usize {
        const PER_CONSTRAINT: usize = 256;
        const PER_TAKE: usize = 1024;
        const PER_EDIT: usize = 192;
        const PER_OBSTACLE: usize = 160;
        const PER_INTERACTION: usize = 512;
        let mut bytes = size_of::<Self>();
        if !Arc::ptr_eq(&self.head, &other.head) {
            bytes += size_of::<Project>() + PER_INTERACTION * self.head.interactions.len();
        }
        if !Arc::ptr_eq(&self.characters, &other.characters) {
            for (nth, character) in self.characters.iter().enumerate() {
                let shared = other.characters.get(nth).is_some_and(|o| Arc::ptr_eq(o, character));
                bytes += size_of::<Arc<Character>>();
                bytes +=
                    if shared { 0 } else { PER_CONSTRAINT * (1 + character.constraints.len()) };
            }
        }
        if !Arc::ptr_eq(&self.obstacles, &other.obstacles) {
            bytes += PER_OBSTACLE * self.obstacles.len();
        }
        if !Arc::ptr_eq(&self.takes, &other.takes) {
            let edits = |take: &StoredTake| take.by_hand.as_ref().map_or(0, |l| l.edits().count());
            bytes += self.takes.iter().map(|t| PER_TAKE + PER_EDIT * edits(t)).sum::<usize>();
        }
        bytes
    }
}

/// Equal parts are mostly the same part, which need not be looked at.
impl PartialEq for Document {
    fn eq(&self, other: &Self) -> bool {
        fn same<T: PartialEq>(a: &Arc<T>, b: &Arc<T>) -> bool {
            Arc::ptr_eq(a, b) || **a == **b
        }
        let same_editor = match (&self.editor, &other.editor) {
            (Some(a), Some(b)) => same(a, b),
            (None, None) => true,
            _ => false,
        };
        same_editor
            && same(&self.head, &other.head)
            && same(&self.characters, &other.characters)
            && same(&self.obstacles, &other.obstacles)
            && same(&self.takes, &other.takes)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use motion_io::diagnostic::Warnings;
    use motion_io::project_file;

    use super::*;
    use crate::sample;

    fn read(text: &str) -> Project {
        project_file::read(text.as_bytes(), Path::new("p"), &mut Warnings::new()).unwrap()
    }

    /// Saving a document of a saved text gives that text.
    #[track_caller]
    fn check(text: &str) {
        let saved = project_file::write(&read(text));
        let document = Document::from_project(read(&saved));
        assert_eq!(project_file::write(&document.to_project()), saved);
    }

    #[test]
    fn a_loaded_and_saved_document_is_the_same_bytes() {
        check(sample::TEXT);
        let head = "{\"gaitway\": 1, \"name\": \"p\", \"later\": [1], \"characters\": [{\"name\": \"A\", \
             \"hat\": \"red\"}], \"obstacles\": [{\"shape\": \"box\", \"center\": [0,1,0], \"size\": [1,1,1]}]";
        for editor in [
            "",
            ", \"editor\": null",
            ", \"editor\": \"strange\"",
            ", \"editor\": {\"camera\": [1, 2], \"takes\": [], \"panels\": {}}",
            ", \"editor\": {\"takes\": \"strange\", \"b\": 1}",
            ", \"editor\": {\"a\": 0, \"takes\": [{\"character\": \"A\", \"name\": \"good\", \"pinned\": true, \
              \"pieces\": [{\"clip\": \"walk\", \"from\": 3, \"to\": 50}], \"mood\": 3}, \"strange\"], \"b\": 1}",
            ", \"editor\": {\"takes\": [{\"character\": \"A\", \"pieces\": [{\"clip\": \"walk\", \"from\": 3, \
              \"to\": 50}], \"by_hand\": {}}]}",
            BY_HAND,
        ] {
            check(&format!("{head}{editor}}}"));
        }
    }

    /// A take with a layer in which not everything is understood.
    const BY_HAND: &str = ", \"editor\": {\"takes\": [{\"character\": \"A\", \"pieces\": [{\"clip\": \
        \"walk\", \"from\": 3, \"to\": 50}], \"by_hand\": {\"edits\": [{\"id\": \"joint-1\", \"kind\": \
        \"joint\", \"joint\": \"Head\", \"turn\": [0.0, 30.5, 0.25], \"from\": 10, \"to\": 20, \"ease_in\": 4, \
        \"ease_out\": 0, \"mood\": 1}, {\"kind\": \"squash\"}, {\"id\": \"hand-1\", \"kind\": \"hand\", \
        \"limb\": \"RightFoot\", \"shift\": [0.0, 0.1, -0.2], \"space\": \"torso\", \"from\": 0, \"to\": 9, \
        \"ease_in\": 0, \"ease_out\": 8}], \"retime\": [{\"output\": 10, \"source\": 5.5}, {\"output\": 20, \
        \"source\": 20.0}], \"later\": [1]}}]}";

    /// The only take of a document with this editor part.
    fn only_take(editor: &str) -> Option<StoredTake> {
        let head = "{\"gaitway\": 1, \"characters\": [{\"name\": \"A\"}]";
        let document = Document::from_project(read(&format!("{head}{editor}}}")));
        document.takes().iter().next().cloned()
    }

    #[test]
    fn what_is_changed_by_hand_is_read_and_the_rest_kept() {
        let layer = only_take(BY_HAND).unwrap().by_hand.unwrap();
        let ids: Vec<&str> = layer.edits().map(|(id, _)| id).collect();
        assert_eq!(ids, ["joint-1", "hand-1"], "a kind of later versions is kept and not shown");
        assert_eq!(layer.edit("joint-1").unwrap().ease_in, 4);
        assert_eq!(layer.retime().knots()[0].source, 5.5);
        let whole = only_take(&BY_HAND.replace("[0.0, 30.5", "[0, 30.5"));
        assert_eq!(whole.unwrap().by_hand, Some(layer), "0 is as good as 0.0");
        // A curve that goes back in time is none, and a take with one is kept as it stands.
        let bad = BY_HAND.replace("20.0}", "2.0}");
        assert_eq!(only_take(&bad), None);
        check(&format!("{{\"gaitway\": 1, \"characters\": [{{\"name\": \"A\"}}]{bad}}}"));
    }

    #[test]
    fn takes_are_read() {
        let document = Document::from_project(read(
            "{\"gaitway\": 1, \"characters\": [{\"name\": \"A\"}], \"editor\": {\"takes\": [{\"character\": \
              \"A\", \"pinned\": true, \"pieces\": [{\"clip\": \"walk\", \"from\": 3, \"to\": 50}]}]}}",
        ));
        let take = document.takes().iter().next().unwrap();
        assert!(take.pinned && take.name.is_none());
        assert_eq!(take.id(), TakeId::of(&take.pieces));
    }

    #[test]
    fn ids_are_the_first_free_ones() {
        let document = Document::from_project(sample::sample().unwrap());
        assert_eq!(document.next_id(CharacterIdx(0), "body"), "body-1");
        assert_eq!(document.next_id(CharacterIdx(9), "body"), "body-1");
    }
}
