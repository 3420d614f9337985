//! A project solved: every character's search, motions and report.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;
use std::sync::Arc;

use motion_core::assemble::Assembler;
use motion_core::cancel::CancelToken;
use motion_core::cast::CastProblem;
use motion_core::motion::Motion;
use motion_core::path::Path as CutPath;
use motion_core::search::{SearchKind, SearchLibrary};
use motion_core::units::Fps;
use motion_io::diagnostic::{FileError, Warnings};
use motion_io::project_file::{Character, Project, relative_to};
use motion_io::report_file::{
    CharacterReport, FORMAT_VERSION, FirstAcceptable, InteractionReport, LibraryFigures, Report,
    TogetherReport, TracePoint,
};

use crate::Library;
use crate::budget::Budget;
use crate::document::{CharacterIdx, Document, TakeId};
use crate::error::JobError;
use crate::finish::{digits_of, finish};
use crate::hand_layer::layer_on;
use crate::library_job::{GraphChoices, OnProgress};
use crate::library_source::{LibraryChoice, resolve};
use crate::live::ready_library::named_pieces;
use crate::problem::{CharacterProblem, cast_refusal, interactions_of, problem_of};
use crate::solve_cast::{CastFound, CastRequest, Together, solve_cast};
use crate::solve_job::{Found, SolveRequest, solve};
use crate::suggest::after_solve::suggest;
use crate::suggest::{Ground, Suggestion, WOULD_HELP};
use crate::unmet::unmet;

/// What is to be solved.
#[derive(Clone, Debug)]
pub struct ProjectRequest<'a> {
    /// The project.
    pub project: &'a Project,
    /// Its file: paths in it are relative to it, and messages name it.
    pub path: &'a Path,
    /// Instead of the project's choice of a library.
    pub library: Option<LibraryChoice>,
    /// Use mirror images even where the project does not say so.
    pub mirror: bool,
    /// Use no bridges even where the project does not say so.
    pub no_bridges: bool,
    /// Instead of the project's seed.
    pub seed: Option<u64>,
    /// Which search is used.
    pub kind: SearchKind,
    /// Instead of the project's number of alternatives.
    pub alternatives: Option<usize>,
    /// How long to search, all characters together.
    pub budget: Budget,
}

/// A project's motions and report.
#[derive(Debug)]
pub struct Solved {
    /// The report; files are not named yet.
    pub report: Report,
    /// Motions of each character of the report, best first.
    pub characters: Vec<SolvedCharacter>,
}

/// One character's motions.
#[derive(Debug)]
pub struct SolvedCharacter {
    /// The library that they are made from; its skeleton is theirs.
    pub library: Library,
    /// The motions, in the report's order.
    pub motions: Vec<Motion>,
}

/// A library made ready for searching.
type Ready = (Library, Arc<SearchLibrary>);

/// Solves every character of a project. What was found until `cancel` was raised is kept.
/// `on_progress` hears what is done and the share of it.
pub fn solve_project(
    request: &ProjectRequest<'_>,
    cancel: &CancelToken,
    warnings: &mut Warnings,
    on_progress: OnProgress<'_>,
) -> Result<Solved, JobError> {
    let ProjectRequest { project, path, .. } = request;
    let project = *project;
    let seed = request.seed.unwrap_or(project.search.seed);
    let bridges = !request.no_bridges && project.search.bridges.unwrap_or(true);
    // A take that is found again is shown with what was changed on it by hand.
    let kept = Document::from_project(project.clone());
    let mut ready: BTreeMap<LibraryChoice, Ready> = BTreeMap::new();
    let mut problems = Vec::new();
    for character in &project.characters {
        let choice = library_choice(request, character);
        let (library, search) = match ready.entry(choice) {
            Entry::Occupied(entry) => entry.into_mut(),
            Entry::Vacant(entry) => {
                let loaded = load(request, entry.key(), cancel, warnings, on_progress)?;
                entry.insert(loaded)
            }
        };
        let problem = problem_of(project, character, library, bridges, path)?;
        problems.push((problem, library.clone(), Arc::clone(search)));
    }

    let n_alternatives = request.alternatives.unwrap_or(project.search.alternatives as usize);
    let mut report = Report {
        gaitway: FORMAT_VERSION,
        project: project.name.clone(),
        seed,
        seconds: Some(0.0),
        library: problems
            .first()
            .map(|(problem, library, _)| {
                library_figures(library, &problem.problem.allowed_clips, bridges)
            })
            .unwrap_or_default(),
        ..Report::default()
    };
    let found = solve_together(request, &problems, seed, n_alternatives, cancel, on_progress)?;
    report.seconds = Some(found.seconds);
    report.together = together_reports(project, &found);
    // What is tried after it may take as long as it would for each alone.
    let budget = match request.budget {
        Budget::Time(all) => Budget::Time(all / problems.len().max(1) as u32),
        rounds @ Budget::Iterations(_) => rounds,
    };
    let mut characters = Vec::new();
    let all = problems.into_iter().zip(&found.characters).enumerate();
    for (nth, ((character, library, search), of_character)) in all {
        // Every rank has its own places of interactions.
        let asked: Vec<CharacterProblem> = found
            .together
            .iter()
            .map(|together| character.among_others(together.problems[nth].clone(), project))
            .collect();
        let best = asked.first().unwrap_or(&character);
        let mut sentences = unmet(best, &library, of_character);
        let ground = Ground {
            document: &kept,
            character: CharacterIdx(nth),
            library: &library,
            project_path: path,
            bridges,
        };
        let from = (&search, seed.wrapping_add(nth as u64));
        // Changes are tried on the character alone, so only where it has to do with nobody.
        let is_alone = best.problem == character.problem;
        let suggestions = if is_alone {
            suggest(&ground, &character, from, of_character, budget, cancel)
        } else {
            Vec::new()
        };
        let said = suggestions.iter().map(|one| format!("{WOULD_HELP}{}", one.sentence));
        sentences.extend(said);
        let assembler = Assembler::new(&library.clips);
        let layer_of = |path: &CutPath| {
            let take = TakeId::of(&named_pieces(&library, path));
            let layer = kept.takes().get(&character.name, take)?.by_hand.as_ref()?;
            Some(layer_on(layer, library.clips.skeleton()).0)
        };
        let finished: Vec<_> = of_character
            .alternatives
            .iter()
            .zip(&asked)
            .zip(1..)
            .filter_map(|((alternative, asked), rank)| {
                let layer = layer_of(&alternative.path);
                finish(&library, &assembler, asked, alternative, layer.as_ref(), rank)
            })
            .collect();
        let (motions, alternatives) = finished
            .into_iter()
            .map(|finished| (Arc::unwrap_or_clone(finished.motion), finished.report))
            .unzip();
        report.iterations += of_character.progress.iteration;
        report.characters.push(CharacterReport {
            name: character.name,
            first_acceptable: of_character
                .progress
                .first_acceptable
                .map(|iteration| FirstAcceptable { s: of_character.first_acceptable_s, iteration }),
            alternatives,
            trace: trace(of_character),
            unmet: sentences,
            suggestions: suggestions.iter().map(Suggestion::report).collect(),
        });
        characters.push(SolvedCharacter { library, motions });
    }
    Ok(Solved { report, characters })
}

/// Searches for all characters together.
fn solve_together(
    request: &ProjectRequest<'_>,
    problems: &[(CharacterProblem, Library, Arc<SearchLibrary>)],
    seed: u64,
    n_alternatives: usize,
    cancel: &CancelToken,
    on_progress: OnProgress<'_>,
) -> Result<CastFound, JobError> {
    let ProjectRequest { project, path, .. } = request;
    let asked: Vec<(&CharacterProblem, &Library)> =
        problems.iter().map(|(problem, library, _)| (problem, library)).collect();
    if asked.is_empty() {
        return Ok(CastFound::default());
    }
    if request.kind != SearchKind::Gaitway {
        return solve_apart(request, problems, (seed, n_alternatives), cancel, on_progress);
    }
    let problem = CastProblem {
        characters: asked.iter().map(|(asked, _)| asked.problem.clone()).collect(),
        interactions: interactions_of(project, &asked, path)?,
    };
    let solve_request = CastRequest {
        libraries: problems.iter().map(|(.., search)| Arc::clone(search)).collect(),
        problem,
        seed,
        budget: request.budget,
        n_alternatives,
    };
    let names: Vec<&str> = asked.iter().map(|(asked, _)| asked.name.as_str()).collect();
    let label = format!("searching for {}", names.join(" and "));
    solve_cast(solve_request, cancel, &mut |share| on_progress(&label, share)).map_err(|error| {
        let asked: Vec<&CharacterProblem> = asked.iter().map(|(asked, _)| *asked).collect();
        cast_refusal(&error, project, &asked, path).into()
    })
}

/// By a search that knows of one character only: each by itself.
fn solve_apart(
    request: &ProjectRequest<'_>,
    problems: &[(CharacterProblem, Library, Arc<SearchLibrary>)],
    (seed, n_alternatives): (u64, usize),
    cancel: &CancelToken,
    on_progress: OnProgress<'_>,
) -> Result<CastFound, JobError> {
    // Each has its share of the time, or as many rounds as asked for.
    let budget = match request.budget {
        Budget::Time(all) => Budget::Time(all / problems.len().max(1) as u32),
        rounds @ Budget::Iterations(_) => rounds,
    };
    let mut found = CastFound::default();
    for (nth, (character, _, search)) in problems.iter().enumerate() {
        let solve_request = SolveRequest {
            library: Arc::clone(search),
            problem: character.problem.clone(),
            seed: seed.wrapping_add(nth as u64),
            kind: request.kind,
            budget,
            n_alternatives,
        };
        let label = format!("searching for {}", character.name);
        let alone = solve(solve_request, cancel, &mut |share, _| on_progress(&label, share))
            .map_err(|error| character.refusal(&error).in_file(request.path))?;
        found.seconds += alone.seconds;
        found.characters.push(alone);
    }
    let n_ranks = found.characters.iter().map(|one| one.alternatives.len()).max().unwrap_or(0);
    found.together = (0..n_ranks)
        .map(|rank| Together {
            score: found
                .characters
                .iter()
                .filter_map(|one| one.alternatives.get(rank))
                .map(|alternative| alternative.judgement.terms.total())
                .sum(),
            problems: problems.iter().map(|(asked, ..)| asked.problem.clone()).collect(),
            places: Vec::new(),
        })
        .collect();
    Ok(found)
}

/// What motions of one rank score together, and where their interactions are; nothing where there is
/// one character.
fn together_reports(project: &Project, found: &CastFound) -> Vec<TogetherReport> {
    if found.characters.len() < 2 {
        return Vec::new();
    }
    let report = |(together, rank): (&Together, u32)| TogetherReport {
        rank,
        score: digits_of(together.score),
        interactions: project
            .interactions
            .iter()
            .zip(&together.places)
            .map(|(interaction, place)| InteractionReport {
                interaction: interaction.id.clone(),
                frame: interaction.frame,
                position_m: place.ground_m().to_array().map(digits_of),
                heading_deg: digits_of(place.heading_rad().to_degrees()),
            })
            .collect(),
    };
    found.together.iter().zip(1..).map(report).collect()
}

fn library_choice(request: &ProjectRequest<'_>, character: &Character) -> LibraryChoice {
    if let Some(choice) = &request.library {
        return choice.clone();
    }
    let written = character.library.as_ref().unwrap_or(&request.project.library);
    LibraryChoice(relative_to(written, request.path))
}

/// Loads or builds a library and arranges it for searching.
fn load(
    request: &ProjectRequest<'_>,
    choice: &LibraryChoice,
    cancel: &CancelToken,
    warnings: &mut Warnings,
    on_progress: OnProgress<'_>,
) -> Result<Ready, JobError> {
    let ProjectRequest { project, path, .. } = request;
    let choices = GraphChoices {
        tau: project.search.tau,
        mirror: request.mirror || project.search.mirror.unwrap_or(false),
        ..GraphChoices::default()
    };
    let fps = Fps::new(project.fps)
        .map_err(|bad| FileError::new(*path, bad.to_string(), "correct the project's fps"))?;
    let library = resolve(choice, fps, &choices, cancel, warnings, on_progress)?;
    let library_fps = library.clips.fps().get();
    if (library_fps - project.fps).abs() > 1e-3 {
        let what = format!(
            "the project counts {} frames per second and its library {library_fps}",
            project.fps
        );
        let what_to_do = "build the library again with --fps, or change the project";
        return Err(FileError::new(*path, what, what_to_do).into());
    }
    warn_of_changes(project, path, &library, warnings);
    let search = SearchLibrary::new(Arc::clone(&library.clips), Arc::clone(&library.graph));
    Ok((library, Arc::new(search)))
}

/// Says where the library or a clip is not what the project was made with.
fn warn_of_changes(project: &Project, path: &Path, library: &Library, warnings: &mut Warnings) {
    let Some(hashes) = &project.hashes else { return };
    if let (Some(known), Some(hash)) = (&hashes.library, library.hash)
        && *known != hash.to_string()
    {
        warnings.warn(path, None, "the library has changed since the project was saved");
    }
    for (id, known) in &hashes.clips {
        let what = match library.clips.by_id(id) {
            None => "is not in the library any more",
            Some(clip) if library.content_hashes[clip.idx()].to_string() != *known => {
                "has changed since the project was saved"
            }
            Some(_) => continue,
        };
        warnings.warn(path, None, format!("clip {id:?} {what}"));
    }
}

fn library_figures(library: &Library, allowed: &[bool], bridges: bool) -> LibraryFigures {
    let graph = &library.graph;
    let clips = library.clips.clips().iter().zip(allowed).filter(|(_, allowed)| **allowed);
    let (mut n_clips, mut n_frames) = (0, 0);
    for (clip, _) in clips {
        n_clips += 1;
        n_frames += clip.n_frames() as u64;
    }
    let (mut edges, mut coarse_edges) = (0, 0);
    for pair in graph.forest.pairs() {
        if allowed[pair.from.idx()] && allowed[pair.to.idx()] {
            for root in graph.forest.roots(pair.tau_nodes()) {
                coarse_edges += 1;
                edges += u64::from(graph.forest.n_leaves(root));
            }
        }
    }
    let connectivity = if bridges { &graph.with_bridges } else { &graph.by_tau };
    LibraryFigures {
        clips: n_clips,
        frames: n_frames,
        edges,
        coarse_edges,
        components: u64::from(connectivity.n_parts),
    }
}

fn trace(found: &Found) -> Vec<TracePoint> {
    let point = |point: &crate::solve_job::TracePoint| TracePoint {
        s: Some(point.s),
        iteration: point.iteration,
        best: digits_of(point.best),
        alternatives: point.n_alternatives as u32,
    };
    found.trace.iter().map(point).collect()
}

#[cfg(test)]
mod tests {
    use motion_tests::cli::Dir;
    use motion_tests::walker::small_library;
    use serde_json::json;

    use super::*;
    use crate::fixture::walk_to;

    #[test]
    fn a_take_that_is_found_again_has_what_was_changed_on_it_by_hand() {
        let dir = Dir::new();
        for (name, walk) in small_library() {
            dir.file(&format!("{name}.bvh"), walk.bvh());
        }
        let solved = |project: &Project| {
            let request = ProjectRequest {
                project,
                path: Path::new("walk.gaitway"),
                library: Some(LibraryChoice(Some(dir.path().to_owned()))),
                mirror: false,
                no_bridges: false,
                seed: None,
                kind: SearchKind::default(),
                alternatives: Some(2),
                budget: Budget::Iterations(8),
            };
            let (cancel, mut warnings) = (CancelToken::new(), Warnings::new());
            solve_project(&request, &cancel, &mut warnings, &|_, _| ()).unwrap()
        };
        let mut project = walk_to(0.8, 4.0).to_project();
        let plain = solved(&project);
        let pieces = &plain.report.characters[0].alternatives[0].pieces;
        let turn = json!({"id": "joint-1", "kind": "joint", "joint": "LeftArm", "turn": [0.0, 0.0, 20.0],
            "from": 10, "to": 20, "ease_in": 4, "ease_out": 4});
        let take = json!({"character": "A", "pieces": pieces, "by_hand": {"edits": [turn]}});
        project.editor = Some(json!({"takes": [take]}));
        let changed = solved(&project);
        let [was, is] = [&plain, &changed].map(|solved| &solved.characters[0].motions);
        assert_ne!(was[0].rotations(15), is[0].rotations(15));
        assert_eq!(was[0].rotations(40), is[0].rotations(40));
        assert_eq!(was[1..], is[1..], "other takes are as they were");
    }
}
