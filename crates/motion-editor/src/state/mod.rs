//! What the window shows and how commands change it; no widget is known here.
//!
//! The session has the document, the search, the playhead and what is selected. The state adds what
//! only a window has: the order of the takes, what they look like, how panels are set up.

mod edit;
mod playing;
mod run;
mod showing;
mod timing;

pub use playing::SPEEDS;

use std::sync::Arc;

use motion_session::Session;
use motion_session::document::{CharacterIdx, TakeId};
use motion_session::live::{SearchState, Wake};
use motion_session::selection::Selectable;
use motion_session::session::{SessionError, SessionOptions};
use motion_session::stage::pick::PickTarget;
use motion_session::stage::{Role, Stage};

use crate::clip_line::{ClipLine, clip_lines};
use crate::mark::{Mark, marks_of};
use crate::notices::Notices;
use crate::project_source::{Opened, ProjectSource};
use crate::settings::Settings;
use crate::take_card::{TakeCard, cards_of};
use crate::ui_command::UiCommand;

/// How an editor begins.
pub struct EditorOptions {
    /// The project that is opened.
    pub source: ProjectSource,
    /// Where autosaves and locks are; without one there are none.
    pub state_folder: Option<std::path::PathBuf>,
    /// How the window is set up.
    pub settings: Settings,
}

impl EditorOptions {
    /// A project in a window as it is at first, which remembers nothing.
    pub fn new(source: ProjectSource) -> Self {
        Self { source, state_folder: None, settings: Settings::default() }
    }
}

/// The state that all panels share.
pub struct EditorState {
    /// The document with its history, its search, its playhead and its selection.
    pub session: Session,
    /// What the user is told.
    pub notices: Notices,
    /// How the window is set up.
    pub settings: Settings,
    /// Takes of the active character that have a motion, in the gallery's order.
    pub cards: Vec<TakeCard>,
    /// The take that was shown before.
    pub shown_before: Option<TakeId>,
    /// Constraints of the active character, by frame.
    pub marks: Vec<Mark>,
    /// The library's clips.
    pub clips: Vec<ClipLine>,
    /// Everybody in the take that is shown, with what is asked of them.
    pub stage: Stage,
    /// What the pointer is over, in the view or on the timeline.
    pub hovered: Option<PickTarget>,
    /// A drag is under way that changes nothing of the document; who ends it sets this to `false`.
    pub is_dragging_beside: bool,
    /// Whether cards stay in their places because the pointer is over them.
    pub cards_are_held: bool,
    /// What was asked for since the last frame.
    commands: Vec<UiCommand>,
    /// Wakes the window.
    wake: egui::Context,
}

impl EditorState {
    /// Opens a project and begins to search; where it cannot be read, the sample, and says why.
    pub fn new(options: EditorOptions, ctx: &egui::Context) -> Result<Self, SessionError> {
        let EditorOptions { source, state_folder, settings } = options;
        let for_search = ctx.clone();
        let wake: Wake = Arc::new(move || for_search.request_repaint());
        let mut session =
            Session::new(SessionOptions { state_folder, wake, builtin: None, project: None })?;
        let mut notices = Notices::default();
        match source.open_in(&mut session) {
            Ok(Opened { remarks }) => remarks.into_iter().for_each(|text| notices.note(text)),
            Err(sentence) => notices.refuse(sentence),
        }
        session.search().follow_best(settings.follow_best);
        let stage = Stage::new(settings.theme, Vec::new());
        Ok(Self {
            session,
            notices,
            settings,
            cards: Vec::new(),
            shown_before: None,
            marks: Vec::new(),
            clips: Vec::new(),
            stage,
            hovered: None,
            is_dragging_beside: false,
            cards_are_held: false,
            commands: Vec::new(),
            wake: ctx.clone(),
        })
    }

    /// Asks for a command; it is done at the beginning of the next frame.
    pub fn ask(&mut self, command: UiCommand) {
        self.commands.push(command);
        self.wake.request_repaint();
    }

    /// The commands asked for since this was called last.
    pub fn take_commands(&mut self) -> Vec<UiCommand> {
        std::mem::take(&mut self.commands)
    }

    /// Takes in what threads have done and lets `dt_secs` pass; never waits.
    pub fn poll(&mut self, dt_secs: f64) {
        let polled = self.session.poll(dt_secs);
        for remark in self.session.take_remarks() {
            self.notices.note(remark);
        }
        if let Some(library) = self.session.library()
            && (polled.library || self.clips.is_empty())
        {
            self.clips = clip_lines(library);
        }
        if polled.snapshot || polled.library {
            let was_empty = self.cards.is_empty();
            self.refresh();
            if was_empty && !self.cards.is_empty() {
                // A first look needs no key.
                self.play();
            }
        }
    }

    /// Has what is shown say what session and document say. To be called after every change.
    pub fn refresh(&mut self) {
        let theme = self.settings.theme;
        self.cards = cards_of(&self.session, theme, &self.cards, self.cards_are_held);
        self.stage = self.session.stage(theme);
        // A miss of earlier constraints is no news, but while something is dragged new ones come
        // faster than a flicker.
        if !self.session.history().is_in_gesture() {
            for (nth, role) in self.stage.roles.iter_mut().enumerate() {
                forget_stale_misses(&self.session, CharacterIdx(nth), role);
            }
        }
        let role = self.stage.roles.get(self.session.active().0);
        let misses = role.map_or(&[][..], |role| role.misses.as_slice());
        self.marks = marks_of(self.session.document(), self.session.active(), misses);
    }

    /// Where the search stands.
    pub fn search_state(&self) -> SearchState {
        self.session.state()
    }

    /// Sentences on what is asked of the active character and not considered, or cannot be.
    pub fn remarks(&self) -> &[String] {
        let snapshot = self.session.snapshot().character(self.session.active());
        snapshot.map_or(&[], |character| character.remarks.as_slice())
    }

    /// Frames at which something happens: ends, constraints, cuts.
    pub fn stops(&self) -> Vec<usize> {
        let mut stops = vec![0, self.last_frame()];
        if let Some(card) = self.shown_card() {
            stops.extend(card.lane.cuts.iter().map(|cut| cut.frame));
        }
        stops.extend(self.marks.iter().map(Mark::frame));
        stops.retain(|stop| *stop <= self.last_frame());
        stops.sort_unstable();
        stops.dedup();
        stops
    }

    /// What a thing in the view is in the document.
    pub fn selectable_of(&self, target: PickTarget) -> Option<Selectable> {
        let document = self.session.document();
        match target {
            PickTarget::Checkpoint { character, constraint }
            | PickTarget::CheckpointTip { character, constraint }
            | PickTarget::JointTarget { character, constraint } => {
                let character = CharacterIdx(character);
                let id = &document.character(character)?.constraints.get(constraint)?.id;
                Some(Selectable::Constraint(motion_session::document::ConstraintRef::new(
                    character,
                    id.clone(),
                )))
            }
            PickTarget::Actor { actor } | PickTarget::Ghost { actor, .. } => {
                Some(Selectable::Character(CharacterIdx(actor)))
            }
            PickTarget::Obstacle { obstacle } => {
                Some(Selectable::Obstacle(motion_session::document::ObstacleIdx(obstacle)))
            }
        }
    }

    /// What a constraint is in the view, where it can be pointed at there.
    pub fn pick_target_of(
        &self,
        at: &motion_session::document::ConstraintRef,
    ) -> Option<PickTarget> {
        use motion_session::ConstraintKind as K;
        let mark = self.marks.iter().find(|mark| mark.at == *at)?;
        let (character, constraint) = (at.character.0, mark.index);
        match mark.constraint.kind {
            K::Body { .. } => Some(PickTarget::Checkpoint { character, constraint }),
            K::Joint { .. } => Some(PickTarget::JointTarget { character, constraint }),
            K::Pose { .. } | K::Style { .. } | K::Path { .. } | K::Lock { .. } => None,
        }
    }

    /// What is selected, the latest.
    pub fn selected(&self) -> Option<&Selectable> {
        self.session.selection().active(self.session.document())
    }

    /// Whether a constraint is selected.
    pub fn is_selected(&self, at: &motion_session::document::ConstraintRef) -> bool {
        self.session.selection().constraints(self.session.document()).any(|known| known == at)
    }

    /// The mark of the selected constraint, if the active character has it.
    pub fn selected_mark(&self) -> Option<&Mark> {
        let Some(Selectable::Constraint(at)) = self.selected() else { return None };
        self.marks.iter().find(|mark| mark.at == *at)
    }
}

fn forget_stale_misses(session: &Session, character: CharacterIdx, role: &mut Role) {
    let of_character = session.snapshot().character(character);
    let shown = of_character.and_then(|known| Some((known, known.shown()?)));
    if shown.is_none_or(|(known, take)| known.is_stale(take)) {
        role.misses.clear();
    }
}
