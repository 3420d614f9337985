//! What the window shows and how commands change it; no widget is known here.
//!
//! The session has the document, the search, the playhead and what is selected. The state adds what
//! only a window has: the order of the takes, what they look like, how panels are set up.

pub mod by_hand;
mod comparing;
mod edit;
mod gain;
mod keeping;
mod meeting;
pub mod moving;
mod nudge;
mod playing;
mod preview;
mod run;
mod showing;
mod timing;

pub use comparing::{CompareMode, Comparing, MAX_COMPARED};
pub use gain::Gain;
pub use playing::SPEEDS;
pub use preview::ClipPreview;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use motion_core::tags::HandTags;
use motion_session::clip_rows::{ClipRow, clip_rows};
use motion_session::document::{CharacterIdx, TakeId};
use motion_session::live::{ReadyLibrary, SearchState, Wake};
use motion_session::preferences::PreferencesFile;
use motion_session::selection::Selectable;
use motion_session::session::{SessionError, SessionOptions};
use motion_session::stage::pick::PickTarget;
use motion_session::stage::{Role, Stage};
use motion_session::{Palette, Session};

use crate::dialogs::Answers;
use crate::mark::{Mark, Unknown, marks_of};
use crate::notices::Notices;
use crate::obstacle_form::ObstacleForm;
use crate::panels::right_tab::RightTab;
use crate::project_source::{Opened, ProjectSource};
use crate::settings::Settings;
use crate::take_card::{Order, TakeCard, cards_of};
use crate::ui_command::UiCommand;

/// How an editor begins.
pub struct EditorOptions {
    /// The project that is opened.
    pub source: ProjectSource,
    /// Where autosaves and locks are; without one there are none.
    pub state_folder: Option<PathBuf>,
    /// Where settings are remembered; without one they are the usual ones and are not.
    pub config_folder: Option<PathBuf>,
    /// Who answers questions for files.
    pub answers: Answers,
}

impl EditorOptions {
    /// A project in a window as it is at first, which remembers nothing.
    pub fn new(source: ProjectSource) -> Self {
        Self { source, state_folder: None, config_folder: None, answers: Answers::Own }
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
    /// Where that is remembered.
    preferences: Option<PreferencesFile>,
    /// Projects that were open lately and are still there, the latest first.
    pub recent: Vec<PathBuf>,
    /// Whether the project's first motion was played by itself.
    pub(crate) has_played: bool,
    /// Whether another project has come that the view has not framed yet.
    pub is_new_scene: bool,
    /// Takes of the active character that have a motion, in the gallery's order.
    pub cards: Vec<TakeCard>,
    /// The take that was shown before.
    pub shown_before: Option<TakeId>,
    /// Constraints of the active character, by frame.
    pub marks: Vec<Mark>,
    /// The library's clips.
    pub clips: Vec<ClipRow>,
    /// What the clips were listed for.
    clips_of: Option<(Option<Palette>, HandTags, ReadyLibrary)>,
    /// The clip that is played in the view because the pointer rests on it.
    pub preview: Option<ClipPreview>,
    /// Everybody in the take that is shown, with what is asked of them.
    pub stage: Stage,
    /// What the pointer is over, in the view or on the timeline.
    pub hovered: Option<PickTarget>,
    /// Whether newcomers are welcomed.
    pub welcomes: bool,
    /// How often something was exported.
    pub n_exports: usize,
    /// What the pose tool places: a clip and a frame of it.
    pub pose_clip: Option<(String, u32)>,
    /// What the obstacle tool draws.
    pub obstacle_form: ObstacleForm,
    /// How fast somebody goes along a path that is drawn, metres per second.
    pub path_speed_m_s: f64,
    /// The tag that a new style gets: the one chosen last.
    pub style_tag: Option<String>,
    /// A drag is under way that changes nothing of the document; who ends it sets this to `false`.
    pub is_dragging_beside: bool,
    /// Whether cards stay in their places because the pointer is over them.
    pub cards_are_held: bool,
    /// The take whose card the pointer is over: it is seen as a ghost.
    pub hovered_card: Option<TakeId>,
    /// The frame of the shown take whose source the pointer is over, on the timeline.
    pub hovered_source: Option<usize>,
    /// What is looked at beside the shown take.
    pub comparing: Comparing,
    /// The take whose name is being typed, and what it is so far.
    pub renaming: Option<(TakeId, String)>,
    /// The change by hand on the shown take that was selected last.
    pub selected_hand_edit: Option<String>,
    /// The knot of its timing that was selected last.
    pub selected_knot: Option<usize>,
    /// Whether the shown take is also seen as it was before it was changed by hand.
    pub compares_before_hand: bool,
    /// What the lower part of the right panel shows.
    pub right_tab: RightTab,
    /// When the best take last got better.
    pub gain: Gain,
    /// Seconds since the window opened.
    pub clock_secs: f64,
    /// What was asked for since the last frame.
    commands: Vec<UiCommand>,
    /// The last small step by key, which the next one of its kind joins.
    merging: Option<nudge::Merging>,
    /// Wakes the window.
    wake: egui::Context,
}

impl EditorState {
    /// Opens a project and begins to search; where it cannot be read, the sample, and says why.
    pub fn new(options: EditorOptions, ctx: &egui::Context) -> Result<Self, SessionError> {
        let EditorOptions { source, state_folder, config_folder, .. } = options;
        let mut preferences = config_folder.as_deref().map(PreferencesFile::open);
        let settings = preferences.as_ref().map(|file| Settings::of(file.get()));
        let settings = settings.unwrap_or_default();
        let recent = preferences.as_ref().map(|file| file.get().recent.shown());
        let autosave_secs = preferences.as_ref().map(|file| file.get().autosave_secs);
        let for_search = ctx.clone();
        let wake: Wake = Arc::new(move || for_search.request_repaint());
        let mut session =
            Session::new(SessionOptions { state_folder, wake, builtin: None, project: None })?;
        autosave_secs.into_iter().for_each(|secs| session.set_autosave_secs(secs));
        let mut notices = Notices::default();
        let odd = preferences.as_mut().map(PreferencesFile::take_remarks);
        odd.into_iter().flatten().for_each(|text| notices.note(text));
        match source.open_in(&mut session) {
            Ok(Opened { remarks }) => remarks.into_iter().for_each(|text| notices.note(text)),
            Err(sentence) => notices.refuse(sentence),
        }
        session.search().follow_best(settings.follow_best);
        let stage = Stage::new(settings.theme, Vec::new());
        // Who opens a project knows the window, and nobody wants a word they cannot send away.
        let welcomes = source == ProjectSource::Sample && preferences.is_some();
        let mut state = Self {
            session,
            notices,
            settings,
            preferences,
            recent: recent.unwrap_or_default(),
            has_played: false,
            is_new_scene: false,
            cards: Vec::new(),
            shown_before: None,
            marks: Vec::new(),
            clips: Vec::new(),
            clips_of: None,
            preview: None,
            stage,
            hovered: None,
            welcomes,
            n_exports: 0,
            pose_clip: None,
            obstacle_form: ObstacleForm::default(),
            path_speed_m_s: edit::WALK_M_S,
            style_tag: None,
            merging: None,
            is_dragging_beside: false,
            cards_are_held: false,
            hovered_card: None,
            hovered_source: None,
            comparing: Comparing::default(),
            renaming: None,
            selected_hand_edit: None,
            selected_knot: None,
            compares_before_hand: false,
            right_tab: RightTab::default(),
            gain: Gain::default(),
            clock_secs: 0.0,
            commands: Vec::new(),
            wake: ctx.clone(),
        };
        if let Some(path) = state.session.path().map(Path::to_owned) {
            state.note_recent(&path);
        }
        Ok(state)
    }

    /// A project was opened or saved.
    pub fn note_recent(&mut self, path: &Path) {
        let Some(preferences) = &mut self.preferences else { return };
        preferences.change(|preferences| preferences.recent.note(path));
        self.recent = preferences.get().recent.shown();
    }

    /// Remembers how the window is set up, a moment after that has changed.
    pub fn remember(&mut self, dt_secs: f64) {
        let Some(preferences) = &mut self.preferences else { return };
        preferences.change(|preferences| self.settings.put_into(preferences));
        preferences.poll(dt_secs);
        preferences.take_remarks().into_iter().for_each(|text| self.notices.note(text));
    }

    /// The window closes, and its user was asked about unsaved work.
    pub fn close(&mut self) {
        self.session.close();
        if let Some(preferences) = &mut self.preferences {
            preferences.change(|preferences| self.settings.put_into(preferences));
            // Nobody is there to be told any more.
            drop(preferences.save());
        }
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
        self.clock_secs += dt_secs;
        self.forget_edit();
        // Cards say so anew in every frame.
        self.hovered_card = None;
        let polled = self.session.poll(dt_secs);
        for remark in self.session.take_remarks() {
            self.notices.note(remark);
        }
        if polled.snapshot || polled.library {
            self.refresh();
            if !self.has_played && !self.cards.is_empty() {
                // A first look needs no key.
                self.has_played = true;
                self.play();
            }
        }
    }

    /// Has what is shown say what session and document say. To be called after every change.
    pub fn refresh(&mut self) {
        let theme = self.settings.theme;
        self.list_clips();
        let order = Order { are_held: self.cards_are_held, now_secs: self.clock_secs };
        self.cards = cards_of(&self.session, theme, &self.cards, order);
        self.forget_gone_takes();
        self.note_gain();
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
        let mut marks = marks_of(self.session.document(), self.session.active(), misses);
        let remarks = self.remarks();
        for mark in &mut marks {
            mark.unknown = Unknown::of(&mark.constraint, misses, remarks);
        }
        self.marks = marks;
    }

    /// Lists the clips anew where library or palette are others than before.
    fn list_clips(&mut self) {
        let Some(library) = self.session.library() else { return };
        let document = self.session.document();
        let (palette, by_hand) = (document.palette(), document.hand_tags());
        let is_known = self.clips_of.as_ref().is_some_and(|(known_palette, tags, known)| {
            known.is(library) && known_palette.as_ref() == palette && *tags == by_hand
        });
        if !is_known {
            self.clips = clip_rows(library, palette, &by_hand);
            self.clips_of = Some((palette.cloned(), by_hand, library.clone()));
        }
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
            | PickTarget::JointTarget { character, constraint }
            | PickTarget::Pose { character, constraint }
            | PickTarget::Path { character, constraint } => {
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
            PickTarget::Meeting { interaction, .. } => {
                let id = document.interactions().get(interaction)?.id.clone();
                Some(Selectable::Interaction(id))
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
            K::Pose { .. } => Some(PickTarget::Pose { character, constraint }),
            K::Path { .. } => Some(PickTarget::Path { character, constraint }),
            K::Style { .. } | K::Lock { .. } => None,
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
