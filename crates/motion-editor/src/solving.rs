//! What the live search has found, made ready to be shown.
//!
//! The search is the session's and runs on a thread of its own; this brings its snapshots to
//! [`Take`]s, which have a body to be drawn. Bodies take a while to make, so that is done on another
//! thread.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};

use motion_core::floor::soles_of;
use motion_core::skeleton::Skeleton;
use motion_scene::body::Look;
use motion_scene::color::Theme;
use motion_scene::mesh::MeshId;
use motion_session::Session;
use motion_session::document::CharacterIdx;
use motion_session::live::{ReadyLibrary, Take as Found};
use motion_session::stage::actor::Actor;
use motion_session::stage::cast::look_of;
use motion_session::stage::figure::Figure;
use motion_session::stage::{Role, Stage};

use crate::take::{Cut, Lane, Piece, Take, plants_of};

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

/// The body that motions of a library are shown in.
#[derive(Debug, Default)]
pub struct Dressing {
    library: Option<ReadyLibrary>,
    coming: Option<Receiver<Dress>>,
    dress: Option<Dress>,
}

/// A skeleton with its mannequin.
#[derive(Clone, Debug)]
pub struct Dress {
    skeleton: Arc<Skeleton>,
    figure: Arc<Figure>,
}

impl Dressing {
    /// The body for this library, once it is there; begins to make it where it is another library
    /// than before. `wake` is called when it has come.
    pub fn poll(
        &mut self,
        library: &ReadyLibrary,
        wake: impl Fn() + Send + 'static,
    ) -> Option<&Dress> {
        if self.library.as_ref().is_none_or(|known| !known.is(library)) {
            self.library = Some(library.clone());
            self.dress = None;
            self.coming = begin(library.clone(), wake);
        }
        if let Some(dress) = self.coming.as_ref().and_then(|coming| coming.try_recv().ok()) {
            self.dress = Some(dress);
            self.coming = None;
        }
        self.dress.as_ref()
    }
}

fn begin(library: ReadyLibrary, wake: impl Fn() + Send + 'static) -> Option<Receiver<Dress>> {
    let (sender, coming) = sync_channel(1);
    let work = move || {
        let set = &library.library.clips;
        let soles =
            soles_of(set.skeleton(), set.clips().iter().map(|clip| (&clip.motion, &clip.track)));
        let motion = set.clips().first().map(|clip| &clip.motion);
        let figure = Figure::mannequin(MeshId(0), set.skeleton(), motion, soles);
        let skeleton = Arc::new(set.skeleton().clone());
        // Nobody listens any more: the window was closed.
        drop(sender.send(Dress { skeleton, figure: Arc::new(figure) }));
        wake();
    };
    let thread = std::thread::Builder::new().name("dressing".to_owned()).spawn(work);
    thread.is_ok().then_some(coming)
}

/// The clips of a library.
pub fn clip_lines(library: &ReadyLibrary) -> Vec<ClipLine> {
    let line = |clip: &motion_core::clip::Clip| ClipLine {
        id: clip.id.clone(),
        n_frames: clip.n_frames(),
        tags: clip.tags.clone(),
    };
    library.library.clips.clips().iter().map(line).collect()
}

/// The takes of the first character that have a motion, best first; everybody else is shown in the
/// take that is looked at. `known` takes are used again where they are the same.
pub fn takes_of(session: &Session, dress: &Dress, theme: Theme, known: &[Take]) -> Vec<Take> {
    let Some(first) = session.snapshot().character(CharacterIdx(0)) else { return Vec::new() };
    let others: Vec<Actor> = (1..session.document().characters().len())
        .filter_map(|nth| {
            let shown = session.shown_of(CharacterIdx(nth))?;
            actor_of(nth, &session.document().characters()[nth].name, shown.take, dress, theme)
        })
        .collect();
    let found = first.takes.iter().filter_map(|found| {
        let made = found.made.as_ref()?;
        let same = known.iter().find(|take| Arc::ptr_eq(&take.motion, &made.motion));
        let mut take = match same {
            Some(take) => take.clone(),
            None => new_take(found, first.name.as_str(), dress, theme)?,
        };
        take.stage.actors.truncate(1);
        take.stage.actors.extend(others.iter().cloned());
        take.is_stale = first.is_stale(found);
        take.lane.score = f64::from(found.score);
        let t = &found.terms;
        take.lane.terms = [t.continuity, t.length, t.body, t.environment].map(f64::from);
        Some(take)
    });
    let mut takes: Vec<Take> = found.collect();
    for (take, number) in takes.iter_mut().zip(1..) {
        take.number = number;
    }
    takes
}

fn actor_of(nth: usize, name: &str, found: &Found, dress: &Dress, theme: Theme) -> Option<Actor> {
    let motion = Arc::clone(&found.made.as_ref()?.motion);
    let Dress { skeleton, figure } = dress.clone();
    let look: Look = look_of(nth, theme);
    Some(Actor { name: name.to_owned(), figure, skeleton, motion, look })
}

fn new_take(found: &Found, name: &str, dress: &Dress, theme: Theme) -> Option<Take> {
    let made = found.made.as_ref()?;
    let actor = actor_of(0, name, found, dress, theme)?;
    let mut stage = Stage::new(theme, vec![actor]);
    let root_path_m = made.motion.root_positions_m().to_vec();
    stage.roles = vec![Role { root_path_m, ..Role::default() }];
    Some(Take {
        id: found.id,
        number: 0,
        fps: made.motion.fps().get(),
        lane: lane_of(&made.report, &stage),
        stage,
        motion: Arc::clone(&made.motion),
        is_stale: false,
    })
}

fn lane_of(report: &motion_session::AlternativeReport, stage: &Stage) -> Lane {
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
    Lane {
        score: report.score,
        terms: [0.0; 4],
        pieces,
        cuts: report.seams.iter().map(cut).collect(),
        misses: report.final_.clone(),
        plants: plants_of(stage),
        foot_slide_cm_per_s: report.quality.as_ref().and_then(|q| q.foot_slide_cm_per_s),
    }
}
