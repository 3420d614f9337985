//! A small library for tests, made once.

use std::sync::OnceLock;

use motion_core::cancel::CancelToken;
use motion_io::diagnostic::Warnings;
use motion_io::import::ImportOptions;
use motion_tests::cli::Dir;
use motion_tests::walker::small_library;

use crate::Library;
use crate::library_job::{GraphChoices, build, import};

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
