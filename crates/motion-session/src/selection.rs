//! What is selected and what is pointed at.
//!
//! A selection is no part of a document, so undo does not undo it. What it names may be gone after
//! an undo; then it is not selected as long as it is gone, and is again when a redo brings it back.

use crate::document::{CharacterIdx, ConstraintRef, Document, ObstacleIdx, TakeId};

/// Something that can be selected.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Selectable {
    /// A character.
    Character(CharacterIdx),
    /// A constraint.
    Constraint(ConstraintRef),
    /// An obstacle.
    Obstacle(ObstacleIdx),
    /// An interaction, by its id.
    Interaction(String),
    /// A take of a character. Takes come and go with the search, so it counts as there.
    Take(CharacterIdx, TakeId),
}

impl Selectable {
    /// Whether it is in the document.
    pub fn exists_in(&self, document: &Document) -> bool {
        match self {
            Self::Character(character) | Self::Take(character, _) => {
                document.character(*character).is_some()
            }
            Self::Constraint(at) => document.constraint(at).is_some(),
            Self::Obstacle(obstacle) => document.obstacle(*obstacle).is_some(),
            Self::Interaction(id) => document.interaction(id).is_some(),
        }
    }
}

/// What is selected, in the order in which it was, and what is pointed at.
///
/// Invariant: nothing is in it twice.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    items: Vec<Selectable>,
    hovered: Option<Selectable>,
}

impl Selection {
    /// What is selected and in `document`, in the order of selecting.
    pub fn items<'a>(&'a self, document: &'a Document) -> impl Iterator<Item = &'a Selectable> {
        self.items.iter().filter(|item| item.exists_in(document))
    }

    /// The one that was selected last: what an inspector shows.
    pub fn active<'a>(&'a self, document: &'a Document) -> Option<&'a Selectable> {
        self.items.iter().rev().find(|item| item.exists_in(document))
    }

    /// The constraints among the items.
    pub fn constraints<'a>(
        &'a self,
        document: &'a Document,
    ) -> impl Iterator<Item = &'a ConstraintRef> {
        self.items(document).filter_map(|item| match item {
            Selectable::Constraint(at) => Some(at),
            _ => None,
        })
    }

    /// Whether an item is selected.
    pub fn contains(&self, item: &Selectable) -> bool {
        self.items.contains(item)
    }

    /// Selects this and nothing else.
    pub fn select(&mut self, item: Selectable) {
        self.items = vec![item];
    }

    /// Selects these and nothing else, the last being the active one.
    pub fn select_all(&mut self, items: impl IntoIterator<Item = Selectable>) {
        self.items.clear();
        items.into_iter().for_each(|item| self.add(item));
    }

    /// Selects this too; it becomes the active one.
    pub fn add(&mut self, item: Selectable) {
        self.items.retain(|known| *known != item);
        self.items.push(item);
    }

    /// Selects this too, or no longer.
    pub fn toggle(&mut self, item: Selectable) {
        match self.items.iter().position(|known| *known == item) {
            Some(at) => drop(self.items.remove(at)),
            None => self.items.push(item),
        }
    }

    /// Selects nothing.
    pub fn clear(&mut self) {
        self.items.clear();
    }

    /// What the pointer is over, wherever that is: viewport, timeline and lists share it.
    pub fn hovered(&self) -> Option<&Selectable> {
        self.hovered.as_ref()
    }

    /// Says what the pointer is over.
    pub fn hover(&mut self, item: Option<Selectable>) {
        self.hovered = item;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::Command;
    use crate::history::History;
    use crate::sample;

    fn constraint(id: &str) -> Selectable {
        Selectable::Constraint(ConstraintRef::new(CharacterIdx(0), id))
    }

    #[test]
    fn a_selection_survives_undo_where_the_things_still_exist() {
        let mut history = History::new(Document::from_project(sample::sample().unwrap()));
        let mut selection = Selection::default();
        selection.select_all([constraint("end"), constraint("corner")]);
        let at = ConstraintRef::new(CharacterIdx(0), "corner");
        history.apply(&Command::Remove { at }).unwrap();
        assert_eq!(selection.active(history.present()), Some(&constraint("end")));
        history.undo();
        assert_eq!(selection.active(history.present()), Some(&constraint("corner")));
        assert_eq!(selection.items(history.present()).count(), 2);
    }

    #[test]
    fn nothing_is_selected_twice() {
        let mut selection = Selection::default();
        let document = Document::from_project(sample::sample().unwrap());
        selection.select_all([constraint("end"), constraint("start"), constraint("end")]);
        assert_eq!(selection.items(&document).count(), 2);
        assert_eq!(selection.active(&document), Some(&constraint("end")));
        selection.toggle(constraint("end"));
        selection.toggle(constraint("corner"));
        assert!(!selection.contains(&constraint("end")));
        assert_eq!(selection.constraints(&document).count(), 2);
        selection.clear();
        assert_eq!(selection.active(&document), None);
    }
}
