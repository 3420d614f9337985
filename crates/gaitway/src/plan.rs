//! What was typed, understood: budgets, libraries, formats, checked before any work begins.

use std::path::Path;
use std::time::Duration;

use motion_core::search::SearchKind;
use motion_io::diagnostic::FileError;
use motion_io::guess::UpAxis;
use motion_io::import::ReadOptions;
use motion_io::roles_file::RoleOverrides;
use motion_session::budget::Budget;
use motion_session::library_source::LibraryChoice;
use motion_session::results::Clocks;

use crate::args::{self, Reading, Solve};

/// How motion files are read.
pub(crate) fn read_options(reading: &Reading) -> Result<ReadOptions, FileError> {
    let roles = match &reading.roles {
        Some(path) => RoleOverrides::load(path)?,
        None => RoleOverrides::default(),
    };
    let up = reading.up.map(|up| match up {
        args::UpAxis::Y => UpAxis::Y,
        args::UpAxis::Z => UpAxis::Z,
    });
    Ok(ReadOptions {
        metres_per_unit: reading.scale,
        up,
        roles,
        keep_tpose: false,
        animation: None,
    })
}

/// How long a search lasts without a word about it.
const DEFAULT_SECS: f64 = 5.0;

/// How a search is limited, and where its clock shows.
pub(crate) fn budget(args: &Solve) -> (Budget, Clocks) {
    match args.iterations {
        Some(rounds) => (Budget::Iterations(rounds), Clocks::Apart),
        None => {
            let secs = args.time.unwrap_or(DEFAULT_SECS);
            // Longer than a duration can be is as good as for ever.
            let limit = Duration::try_from_secs_f64(secs).unwrap_or(Duration::MAX);
            (Budget::Time(limit), Clocks::InReport)
        }
    }
}

/// Which search was named.
pub(crate) fn search_kind(args: &Solve) -> SearchKind {
    match args.search {
        args::SearchName::Gaitway => SearchKind::Gaitway,
        args::SearchName::Af02 => SearchKind::Af02,
        args::SearchName::Astar => SearchKind::AStar,
    }
}

/// The library that was named instead of the project's.
pub(crate) fn library(args: &Solve) -> Option<LibraryChoice> {
    args.library.as_deref().map(LibraryChoice::typed)
}

/// Fails unless the ending of `path` names a format of motions that can be written.
pub(crate) fn check_motion_output(path: &Path) -> Result<(), FileError> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let what = match ending.as_deref() {
        Some("bvh") => return Ok(()),
        Some(other) => format!(".{other} cannot be written"),
        None => "the name has no ending that says the format".to_owned(),
    };
    Err(FileError::new(path, what, "choose a name that ends in .bvh"))
}

/// Fails unless `path` is a name for a library.
pub(crate) fn check_library_output(path: &Path) -> Result<(), FileError> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gwlib")) {
        return Ok(());
    }
    let what = "the name of a library ends in .gwlib";
    Err(FileError::new(path, what, "choose such a name, so that others know what it is"))
}

/// Fails unless `path` is a name for a part of a library.
pub(crate) fn check_part_output(path: &Path) -> Result<(), FileError> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gwpart")) {
        return Ok(());
    }
    let what = "the name of a part of a library ends in .gwpart";
    Err(FileError::new(path, what, "choose such a name, so that others know what it is"))
}

/// Fails where `path` cannot become a folder for results, before hours of searching for them.
pub(crate) fn check_results_folder(path: &Path) -> Result<(), FileError> {
    if path.exists() && !path.is_dir() {
        return Err(FileError::new(path, "it is a file", "name a folder for the results"));
    }
    Ok(())
}

/// How many threads work is spread over.
pub(crate) fn use_threads(n: Option<u16>) -> anyhow::Result<()> {
    let mut pool = rayon::ThreadPoolBuilder::new().thread_name(|nth| format!("worker-{nth}"));
    if let Some(n) = n {
        pool = pool.num_threads(usize::from(n));
    }
    Ok(pool.build_global()?)
}
