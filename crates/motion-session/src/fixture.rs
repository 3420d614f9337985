//! A small library for tests, made once.

use std::sync::OnceLock;

use motion_core::cancel::CancelToken;
use motion_io::diagnostic::Warnings;
use motion_io::import::ImportOptions;
use motion_io::project_file;
use motion_tests::cli::Dir;
use motion_tests::walker::small_library;

use crate::Library;
use crate::document::Document;
use crate::library_job::{GraphChoices, build, import};
use crate::live::ReadyLibrary;

/// The walks of [`small_library`] with their mirror images.
pub(crate) fn library() -> Library {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    let make = || {
        let dir = Dir::new();
        for (name, walk) in small_library() {
            dir.file(&format!("{name}.bvh"), walk.bvh());
        }
        let (options, cancel) = (ImportOptions::default(), CancelToken::new());
        let inputs = [dir.path().to_owned()];
        let (clips, _) =
            import(&inputs, &options, &cancel, &mut Warnings::new(), &|_, _| ()).unwrap();
        let choices = GraphChoices { mirror: true, ..GraphChoices::default() };
        Library::new(build(clips, &choices, &cancel, &|_, _| ()).unwrap(), None)
    };
    LIBRARY.get_or_init(make).clone()
}

/// The same, ready for searching.
pub(crate) fn ready_library() -> ReadyLibrary {
    static READY: OnceLock<ReadyLibrary> = OnceLock::new();
    READY.get_or_init(|| ReadyLibrary::new(library())).clone()
}

/// A document on it: from the origin past a corner to `(x, z)`, 120 frames.
pub(crate) fn walk_to(x_m: f64, z_m: f64) -> Document {
    let text = format!(
        "{{\"gaitway\": 1, \"name\": \"walk\", \"characters\": [{{\"name\": \"A\",
           \"length\": {{\"frames\": 120}}, \"constraints\": [
           {{\"id\": \"start\", \"kind\": \"body\", \"frame\": 0, \"position\": [0, 0], \"heading\": 0}},
           {{\"id\": \"corner\", \"kind\": \"body\", \"frame\": 60, \"position\": [0.2, 2.2], \"heading\": 10}},
           {{\"id\": \"end\", \"kind\": \"body\", \"frame\": 119, \"position\": [{x_m}, {z_m}], \"heading\": 30}}
         ]}}]}}"
    );
    let path = std::path::Path::new("walk.gaitway");
    let project = project_file::read(text.as_bytes(), path, &mut Warnings::new()).unwrap();
    Document::from_project(project)
}
