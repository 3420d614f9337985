//! `gaitway library build`, `merge`, `info` and `edges`; `coverage` is in a file of its own.

mod build;
mod merge;

use std::fmt::Write as _;

use motion_session::Library;
use motion_session::library_info::LibraryInfo;
use motion_session::library_source::{self, LibraryChoice};

use super::coverage;
use crate::args;
use crate::output::{Console, Failure};

/// Does what was asked.
pub(crate) fn run(console: &Console, command: &args::Library) -> Result<(), Failure> {
    match command {
        args::Library::Build(args) => build::run(console, args),
        args::Library::Merge { parts, output } => merge::run(console, parts, output),
        args::Library::Info { library } => {
            let info = LibraryInfo::new(&open(console, library)?, None);
            console.answer(&info, || info.text(console.is_verbose()))
        }
        args::Library::Coverage { library } => coverage::run(console, library),
        args::Library::Edges { library: path, from, to } => {
            let library = open(console, path)?;
            let edges = library.edges(from, to).map_err(|missing| {
                let similar = library.similar_ids(&missing).join(", ");
                let path = path.display();
                Failure::wrong(format!(
                    "{path}: it has no clip {missing:?}; did you mean {similar}?"
                ))
            })?;
            console.answer(&edges, || {
                let mut text = String::new();
                for edge in &edges {
                    // Writing to a string cannot fail.
                    let _ok = writeln!(text, "{} {} {}", edge.from_frame, edge.to_frame, edge.cost);
                }
                text
            })
        }
    }
}

pub(super) fn open(console: &Console, path: &std::path::Path) -> Result<Library, Failure> {
    let bar = console.bar();
    Ok(library_source::open(&LibraryChoice::typed(path), &|what, share| bar.set(what, share))?)
}
