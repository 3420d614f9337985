//! The worker that solves a project while the window goes on.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel};
use std::time::Instant;

use motion_core::cancel::CancelToken;
use motion_core::clip::Clip;
use motion_scene::color::Theme;
use motion_session::budget::Budget;
use motion_session::project_job::{ProjectRequest, Solved, solve_project};
use motion_session::stage::actor::Actor;
use motion_session::stage::cast;
use motion_session::{Project, Warnings};

use crate::take::{Cut, Lane, Piece, Take, plants_of};

/// What comes out of a project.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Best first.
    pub takes: Vec<Take>,
    /// The library's clips.
    pub clips: Vec<ClipLine>,
    /// Sentences on what could not be met.
    pub unmet: Vec<String>,
    /// How long it took, seconds.
    pub seconds: f64,
    /// Whether no better one will follow.
    pub is_final: bool,
}

/// A clip of the library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClipLine {
    /// Its id.
    pub id: String,
    /// How long it is.
    pub n_frames: usize,
    /// What it is labelled with.
    pub tags: Vec<String>,
}

/// Where the work stands.
#[derive(Clone, Debug)]
pub enum Stage {
    /// It goes on: what is done, and the share of it, 0 to 1.
    Working(String, f64),
    /// It is done.
    Done,
    /// It cannot be done; a sentence.
    Failed(String),
}

enum Event {
    Progress(String, f64),
    Found(Box<Outcome>),
    Failed(String),
}

/// A project being solved on a thread of its own. Dropping it stops the work.
#[derive(Debug)]
pub struct Solving {
    events: Receiver<Event>,
    cancel: CancelToken,
    /// Where the work stood when it was last looked at.
    pub stage: Stage,
}

/// Rounds of the search after which its motions are shown: soon the first ones, then better ones.
/// Rounds, not seconds, so that the same project gives the same motions every time.
pub const ROUNDS: &[u64] = &[12, 60];
/// News that nobody has read yet; more is dropped, since only the newest matters.
const N_WAITING: usize = 16;

impl Solving {
    /// Begins a search that shows its motions after so many `rounds` each. `wake` is called whenever there is news.
    pub fn start(
        project: Project,
        path: PathBuf,
        rounds: &'static [u64],
        wake: impl Fn() + Send + Sync + 'static,
    ) -> Self {
        let (sender, events) = sync_channel(N_WAITING);
        let cancel = CancelToken::new();
        let token = cancel.clone();
        let work = move || {
            let mut worker = Worker { project, path, cancel: token, sender, bodies: Vec::new() };
            for n in rounds {
                let event = match worker.solve(*n, Some(n) == rounds.last(), &wake) {
                    Ok(outcome) => Event::Found(Box::new(outcome)),
                    Err(sentence) => Event::Failed(sentence),
                };
                let is_over = matches!(event, Event::Failed(_)) || worker.cancel.is_cancelled();
                // Nobody listens any more: the window was closed, or asks for something else.
                let is_heard = worker.sender.send(event).is_ok();
                wake();
                if is_over || !is_heard {
                    break;
                }
            }
        };
        let thread = std::thread::Builder::new().name("solving".to_owned()).spawn(work);
        let stage = match thread {
            Ok(_detached) => Stage::Working("Starting".to_owned(), 0.0),
            Err(error) => Stage::Failed(format!("no thread could be started ({error})")),
        };
        Self { events, cancel, stage }
    }

    /// Work that cannot even begin.
    pub fn failed(sentence: String) -> Self {
        let (_, events) = sync_channel(1);
        Self { events, cancel: CancelToken::new(), stage: Stage::Failed(sentence) }
    }

    /// Takes in the news; an outcome comes once, better ones later.
    pub fn poll(&mut self) -> Option<Outcome> {
        loop {
            match self.events.try_recv() {
                Ok(Event::Progress(what, share)) => self.stage = Stage::Working(what, share),
                Ok(Event::Found(outcome)) => {
                    if outcome.is_final {
                        self.stage = Stage::Done;
                    }
                    return Some(*outcome);
                }
                Ok(Event::Failed(sentence)) => self.stage = Stage::Failed(sentence),
                Err(TryRecvError::Empty) => return None,
                Err(TryRecvError::Disconnected) => {
                    if matches!(self.stage, Stage::Working(..)) {
                        self.stage = Stage::Failed("the search ended unexpectedly".to_owned());
                    }
                    return None;
                }
            }
        }
    }
}

impl Drop for Solving {
    fn drop(&mut self) {
        self.cancel.cancel();
    }
}

/// What the thread works with.
struct Worker {
    project: Project,
    path: PathBuf,
    cancel: CancelToken,
    sender: SyncSender<Event>,
    /// Dressing takes a while, and all takes of a character have the same body.
    bodies: Vec<Actor>,
}

impl Worker {
    fn solve(
        &mut self,
        rounds: u64,
        is_final: bool,
        wake: &(impl Fn() + Sync),
    ) -> Result<Outcome, String> {
        let start = Instant::now();
        let request = ProjectRequest {
            project: &self.project,
            path: &self.path,
            library: None,
            mirror: false,
            no_bridges: false,
            seed: None,
            alternatives: None,
            budget: Budget::Iterations(rounds),
        };
        let on_progress = |what: &str, share: f64| {
            // Full: the window is busy and will hear of a later moment.
            drop(self.sender.try_send(Event::Progress(what.to_owned(), share)));
            wake();
        };
        let mut warnings = Warnings::new();
        let solved = solve_project(&request, &self.cancel, &mut warnings, &on_progress)
            .map_err(|error| error.to_string())?;
        let takes = takes_of(&self.project, &solved, &mut self.bodies)?;
        let clips = solved.characters.first().map(|character| {
            let line = |clip: &Clip| ClipLine {
                id: clip.id.clone(),
                n_frames: clip.n_frames(),
                tags: clip.tags.clone(),
            };
            character.library.clips.clips().iter().map(line).collect()
        });
        let mut unmet: Vec<String> = Vec::new();
        for sentence in solved.report.characters.iter().flat_map(|character| &character.unmet) {
            if !unmet.contains(sentence) {
                unmet.push(sentence.clone());
            }
        }
        Ok(Outcome {
            takes,
            clips: clips.unwrap_or_default(),
            unmet,
            seconds: start.elapsed().as_secs_f64(),
            is_final,
        })
    }
}

fn takes_of(
    project: &Project,
    solved: &Solved,
    bodies: &mut Vec<Actor>,
) -> Result<Vec<Take>, String> {
    let n_takes = solved.characters.iter().map(|c| c.motions.len()).min().unwrap_or_default();
    let theme = Theme::Dark;
    let mut takes = Vec::new();
    for take in 0..n_takes.max(1) {
        let parts = cast::parts(solved, take).map_err(|nobody| nobody.to_string())?;
        let mut actors = Vec::with_capacity(parts.len());
        for (nth, part) in parts.into_iter().enumerate() {
            let actor = match bodies.get(nth) {
                Some(body) => Actor { motion: part.motion, ..body.clone() },
                None => cast::as_mannequin(nth, part, theme),
            };
            if bodies.len() == nth {
                bodies.push(actor.clone());
            }
            actors.push(actor);
        }
        let stage = cast::stage_of_project(project, solved, take, actors, theme);
        let lane = lane_of(solved, take, &stage);
        takes.push(Take { number: take + 1, fps: project.fps, stage, lane });
    }
    Ok(takes)
}

/// What is said of the first character.
fn lane_of(solved: &Solved, take: usize, stage: &motion_session::stage::Stage) -> Lane {
    let Some(report) = solved.report.characters.first().and_then(|c| c.alternatives.get(take))
    else {
        return Lane::default();
    };
    let mut pieces = Vec::with_capacity(report.pieces.len());
    for (nth, piece) in report.pieces.iter().enumerate() {
        let frame_of = |nth: usize| report.seams.get(nth).map(|seam| seam.frame as usize);
        let from = nth.checked_sub(1).and_then(frame_of).unwrap_or_default();
        let to = frame_of(nth).unwrap_or(report.frames as usize);
        pieces.push(Piece {
            clip: piece.clip.clone(),
            frames: from..to.max(from),
            of_clip: (piece.from, piece.to),
        });
    }
    let cut = |seam: &motion_session::SeamReport| Cut {
        frame: seam.frame as usize,
        cost: seam.cost,
        is_bridge: seam.bridge,
    };
    let t = &report.terms;
    Lane {
        score: report.score,
        terms: [t.continuity, t.length, t.body, t.joint, t.style, t.environment],
        pieces,
        cuts: report.seams.iter().map(cut).collect(),
        misses: report.final_.clone(),
        plants: plants_of(stage),
        foot_slide_cm_per_s: report.quality.as_ref().and_then(|q| q.foot_slide_cm_per_s),
    }
}
