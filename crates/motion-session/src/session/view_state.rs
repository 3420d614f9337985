//! What the editor keeps in the project file beside the document: camera, panels and the like.
//!
//! It is saved with the project and not undone.

use motion_io::project_file::Project;
use serde_json::{Map, Value};

/// Keys under `"editor"`. Those that were not set here are kept as the file has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ViewState {
    members: Map<String, Value>,
}

impl ViewState {
    /// The view state of a project.
    pub fn of(project: &Project) -> Self {
        let members = project.editor.as_ref().and_then(Value::as_object).cloned();
        Self { members: members.unwrap_or_default() }
    }

    /// What is kept under a key.
    pub fn get(&self, key: &str) -> Option<&Value> {
        self.members.get(key)
    }

    /// Keeps something under a key. `takes` is the document's.
    pub fn set(&mut self, key: &str, value: Value) {
        if key != "takes" {
            self.members.insert(key.to_owned(), value);
        }
    }

    /// Puts everything but the document's takes into a project that is to be saved.
    pub(super) fn put_into(&self, project: &mut Project) {
        for (key, value) in self.members.iter().filter(|(key, _)| *key != "takes") {
            let editor = project.editor.get_or_insert_with(|| Value::Object(Map::new()));
            if let Some(members) = editor.as_object_mut() {
                members.insert(key.clone(), value.clone());
            }
        }
    }
}
