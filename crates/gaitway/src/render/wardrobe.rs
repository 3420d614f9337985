//! Bodies that actors are seen in: mannequins, and characters from files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use motion_core::retarget::PathScale;
use motion_io::diagnostic::{FileError, Warnings};
use motion_io::gltf::{Character, CharacterOptions, is_gltf, read_character};
use motion_scene::color::Theme;
use motion_scene::mesh::MeshId;
use motion_session::stage::actor::Actor;
use motion_session::stage::cast::{self, Part};
use motion_session::stage::character::{dressed, figure_of_character};
use motion_session::stage::figure::Figure;

use crate::output::Failure;

/// Characters that were read, each once.
pub(crate) struct Wardrobe<'a> {
    /// What everybody is to wear.
    for_all: Option<&'a Path>,
    warnings: &'a mut Warnings,
    read: BTreeMap<PathBuf, Arc<Character>>,
    figures: BTreeMap<PathBuf, Arc<Figure>>,
}

impl<'a> Wardrobe<'a> {
    /// With the character that everybody is to wear, if one was asked for.
    pub(crate) fn new(for_all: Option<&'a Path>, warnings: &'a mut Warnings) -> Self {
        Self { for_all, warnings, read: BTreeMap::new(), figures: BTreeMap::new() }
    }

    /// The actor number `nth`, in the body that was asked for, else in that of `own`, else as a
    /// mannequin.
    pub(crate) fn dress(
        &mut self,
        nth: usize,
        part: Part,
        own: Option<&Path>,
        way: PathScale,
        theme: Theme,
    ) -> Result<Actor, Failure> {
        let Some(path) = self.for_all.or(own) else {
            return Ok(cast::as_mannequin(nth, part, theme));
        };
        let character = self.character(path)?;
        let figure = self.figure(path, &character)?;
        let actor = dressed(part, &character, figure, way).map_err(|error| {
            // In the error's words the source is what moves, the target what is seen.
            let what = format!("the motion cannot be brought to its body: {error}");
            FileError::new(path, what, "choose a character with two legs, or name its joints")
        })?;
        Ok(actor)
    }

    /// The body of a motion's own file; `None`, with a warning, where it has none that can be shown.
    pub(crate) fn own_body(&mut self, path: &Path) -> Option<Arc<Character>> {
        let mut again = Warnings::new();
        let character = read_character(path, &CharacterOptions::default(), &mut again);
        // The file was read for its motion before; what is odd about it was said then.
        for warning in again.as_slice() {
            if !self.warnings.as_slice().contains(warning) {
                self.warnings.warn(&warning.path, warning.line, warning.what.clone());
            }
        }
        match character {
            Ok(character) => {
                let character = Arc::new(character);
                self.read.insert(path.to_owned(), Arc::clone(&character));
                Some(character)
            }
            Err(error) => {
                let what = format!("a mannequin is shown, since {}", error.what);
                self.warnings.warn(path, error.line, what);
                None
            }
        }
    }

    /// The character of a file.
    fn character(&mut self, path: &Path) -> Result<Arc<Character>, FileError> {
        if let Some(known) = self.read.get(path) {
            return Ok(Arc::clone(known));
        }
        if !is_gltf(path) {
            let what = "it is no glTF file";
            let what_to_do = "choose a .glb or .gltf with a skinned body";
            return Err(FileError::new(path, what, what_to_do));
        }
        let character = read_character(path, &CharacterOptions::default(), self.warnings)?;
        let character = Arc::new(character);
        self.read.insert(path.to_owned(), Arc::clone(&character));
        Ok(character)
    }

    /// Its surface, under a name that no mannequin has.
    fn figure(&mut self, path: &Path, character: &Character) -> Result<Arc<Figure>, Failure> {
        /// Mannequins are counted from 0.
        const FIRST: u64 = 1 << 32;
        if let Some(known) = self.figures.get(path) {
            return Ok(Arc::clone(known));
        }
        let mesh = MeshId(FIRST + self.figures.len() as u64);
        let figure = figure_of_character(mesh, character)
            .map_err(|error| FileError::new(path, error.to_string(), "export it again"))?;
        let figure = Arc::new(figure);
        self.figures.insert(path.to_owned(), Arc::clone(&figure));
        Ok(figure)
    }
}
