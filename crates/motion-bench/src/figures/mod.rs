//! One figure of the table a file.

mod alternatives;
mod alternatives2s;
mod assembly;
pub(crate) mod build;
mod candidates;
mod candidates_all_kinds;
mod correction;
pub(crate) mod editor;
mod errand;
mod film;
mod first_acceptable;
mod leaf_edges;
mod load;
mod picture;
mod plain_features;
mod problems;
mod quantile;
mod random;
mod rescore;
mod runs;
pub(crate) mod scale;
mod score;
mod score1s;
mod seams;
mod tags;
mod threads;
mod trials;
mod versus;

use std::sync::Arc;

use motion_bench::asked::{self, Asked};
use motion_bench::clips::{Source, build as build_library, search_library};
use motion_bench::problems::ASKS;
use motion_core::search::SearchLibrary;

use crate::effort::Effort;
use crate::table::Row;
use runs::{Runs, run_all};

/// How a figure is called on the command line, and how it is measured.
pub(crate) struct Figure {
    pub(crate) name: &'static str,
    pub(crate) measure: fn(&mut Bench) -> anyhow::Result<Vec<Row>>,
}

/// Every figure, in the order of the table.
pub(crate) const FIGURES: &[Figure] = &[
    Figure { name: "build", measure: build::plain },
    Figure { name: "mirrored", measure: build::mirrored },
    Figure { name: "scale", measure: scale::measure },
    Figure { name: "load", measure: load::measure },
    Figure { name: "leaf-edges", measure: leaf_edges::measure },
    Figure { name: "candidates", measure: candidates::measure },
    Figure { name: "first", measure: first_acceptable::measure },
    Figure { name: "alternatives", measure: alternatives::measure },
    Figure { name: "score", measure: score::measure },
    Figure { name: "problems", measure: problems::measure },
    Figure { name: "score1s", measure: score1s::measure },
    Figure { name: "versus", measure: versus::measure },
    Figure { name: "candidates-all-kinds", measure: candidates_all_kinds::measure },
    Figure { name: "errand", measure: errand::measure },
    Figure { name: "alternatives2s", measure: alternatives2s::measure },
    Figure { name: "random", measure: random::measure },
    Figure { name: "rescore", measure: rescore::measure },
    Figure { name: "threads", measure: threads::measure },
    Figure { name: "correction", measure: correction::measure },
    Figure { name: "seams", measure: seams::measure },
    Figure { name: "assembly", measure: assembly::measure },
    Figure { name: "picture", measure: picture::measure },
    Figure { name: "film", measure: film::measure },
    Figure { name: "tags", measure: tags::measure },
    Figure { name: "editor", measure: editor::measure },
];

/// What figures share; made when the first one asks for it.
pub(crate) struct Bench {
    pub(crate) source: Source,
    pub(crate) effort: Effort,
    library: Option<Arc<SearchLibrary>>,
    runs: Option<Arc<Runs>>,
    asked: Option<Arc<[Asked]>>,
}

impl Bench {
    pub(crate) fn new(source: Source, effort: Effort) -> Self {
        Self { source, effort, library: None, runs: None, asked: None }
    }

    /// The library of the source's clips.
    pub(crate) fn library(&mut self) -> anyhow::Result<Arc<SearchLibrary>> {
        if let Some(library) = &self.library {
            return Ok(Arc::clone(library));
        }
        let library = search_library(build_library(self.source.load()?, false)?);
        self.library = Some(Arc::clone(&library));
        Ok(library)
    }

    /// The searches of one second: every problem with every seed.
    pub(crate) fn runs(&mut self) -> anyhow::Result<Arc<Runs>> {
        if let Some(runs) = &self.runs {
            return Ok(Arc::clone(runs));
        }
        let library = self.library()?;
        let runs = Arc::new(run_all(&library, self.effort.n_seeds)?);
        self.runs = Some(Arc::clone(&runs));
        Ok(runs)
    }

    /// The projects' problems; for want of the projects the five that are known as data.
    pub(crate) fn asked(&mut self) -> anyhow::Result<Arc<[Asked]>> {
        if let Some(asked) = &self.asked {
            return Ok(Arc::clone(asked));
        }
        let library = self.library()?;
        let n_clips = library.graph().n_clips();
        let asked: Arc<[Asked]> = match &self.source {
            Source::Cmu(_) => asked::load_all(&self.source.problems()?, &library)?.into(),
            Source::BuiltIn => ASKS
                .iter()
                .map(|ask| Asked { name: ask.name[..2].to_owned(), problem: ask.problem(n_clips) })
                .collect(),
        };
        self.asked = Some(Arc::clone(&asked));
        Ok(asked)
    }
}
