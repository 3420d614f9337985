//! What the window shows and how commands change it; no widget is known here.

use std::sync::Arc;

use motion_scene::color::Theme;
use motion_session::ConstraintKind;
use motion_session::command::Command;
use motion_session::document::{CharacterIdx, TakeId};
use motion_session::live::{SearchState, Wake};
use motion_session::stage::pick::PickTarget;

use crate::authoring::Authoring;
use crate::player::Player;
use crate::project_source::ProjectSource;
use crate::settings::{Navigation, Settings, Tool};
use crate::solving::{ClipLine, Dressing, clip_lines, takes_of};
use crate::take::{Mark, Take};
use crate::ui_command::UiCommand;

/// The state that all panels share.
pub struct EditorState {
    /// The project, if it could be read.
    pub authoring: Option<Authoring>,
    /// Why there is no project.
    failure: Option<String>,
    /// The bodies that motions are shown in.
    dressing: Dressing,
    /// What was found, best first.
    pub takes: Vec<Take>,
    /// The one that is shown.
    pub shown: Option<usize>,
    /// The one that was shown before.
    pub shown_before: Option<TakeId>,
    /// The library's clips.
    pub clips: Vec<ClipLine>,
    /// Body constraints of the first character, by frame.
    pub marks: Vec<Mark>,
    /// The playhead.
    pub player: Player,
    /// How the window is set up.
    pub settings: Settings,
    /// What the pointer is over, in the view or on the timeline.
    pub hovered: Option<PickTarget>,
    /// What is selected, everywhere.
    pub selected: Option<PickTarget>,
    /// What was asked for since the last frame.
    commands: Vec<UiCommand>,
    /// Starts work that wakes the window.
    wake: egui::Context,
}

impl EditorState {
    /// Opens a project and begins to solve it.
    pub fn new(source: &ProjectSource, ctx: &egui::Context) -> Self {
        let for_search = ctx.clone();
        let wake: Wake = Arc::new(move || for_search.request_repaint());
        let (authoring, failure) = match Authoring::new(source, wake) {
            Ok(authoring) => (Some(authoring), None),
            Err(sentence) => (None, Some(sentence)),
        };
        Self {
            authoring,
            failure,
            dressing: Dressing::default(),
            takes: Vec::new(),
            shown: None,
            shown_before: None,
            clips: Vec::new(),
            marks: Vec::new(),
            player: Player::default(),
            settings: Settings::default(),
            hovered: None,
            selected: None,
            commands: Vec::new(),
            wake: ctx.clone(),
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

    /// Takes in what the search has found; never waits.
    pub fn drain(&mut self, dt_secs: f64) {
        let Some(authoring) = &mut self.authoring else { return };
        let polled = authoring.session.poll(dt_secs);
        let remarks = authoring.session.take_remarks();
        if let Some(last) = remarks.into_iter().next_back() {
            authoring.refusal = Some(last);
        }
        let Some(library) = authoring.session.library() else { return };
        let ctx = self.wake.clone();
        let had_takes = !self.takes.is_empty();
        let Some(dress) = self.dressing.poll(library, move || ctx.request_repaint()) else {
            return;
        };
        if polled.library || self.clips.is_empty() {
            self.clips = clip_lines(library);
        }
        if polled.snapshot || !had_takes {
            let session = &authoring.session;
            self.takes = takes_of(session, dress, self.settings.theme, &self.takes);
            let shown = session.shown_of(CharacterIdx(0)).map(|shown| shown.take.id);
            self.shown = self.takes.iter().position(|take| Some(take.id) == shown);
            if let Some(take) = self.shown.and_then(|shown| self.takes.get(shown)) {
                self.player.set_motion(take.n_frames(), take.fps);
                if !had_takes {
                    // A first look needs no key.
                    self.player.play();
                }
            }
            self.after_edit();
        }
    }

    /// Has what is shown say what the document says. To be called after every change.
    pub fn after_edit(&mut self) {
        let Some(authoring) = &self.authoring else { return };
        for take in &mut self.takes {
            let n = take.stage.actors.len();
            take.stage.roles.resize_with(n, Default::default);
            for (nth, role) in take.stage.roles.iter_mut().enumerate() {
                role.constraints = authoring.constraints(nth).to_vec();
                role.misses.clear();
            }
            if let Some(role) = take.stage.roles.first_mut().filter(|_| !take.is_stale) {
                role.misses = take.lane.misses.clone();
            }
        }
        let shown = self.shown.and_then(|shown| self.takes.get(shown));
        self.marks = marks_of(authoring, shown.filter(|take| !take.is_stale));
    }

    /// Where the search stands.
    pub fn search_state(&self) -> SearchState {
        match (&self.authoring, &self.failure) {
            (Some(authoring), _) => authoring.session.state(),
            (None, failure) => SearchState::Error(failure.clone().unwrap_or_default()),
        }
    }

    /// Why there is nothing to be found.
    pub fn failure(&self) -> Option<String> {
        match self.search_state() {
            SearchState::Infeasible(sentence) | SearchState::Error(sentence) => Some(sentence),
            _ => None,
        }
    }

    /// Sentences on what is asked and not considered, or cannot be.
    pub fn remarks(&self) -> &[String] {
        let session = self.authoring.as_ref().map(|authoring| &authoring.session);
        let first = session.and_then(|session| session.snapshot().character(CharacterIdx(0)));
        first.map_or(&[], |character| character.remarks.as_slice())
    }

    /// By how much a take is better than the shown one, percent.
    pub fn better_percent(&self) -> Option<f32> {
        let session = &self.authoring.as_ref()?.session;
        let better = session.snapshot().character(CharacterIdx(0))?.better.as_ref()?;
        Some(better.by_percent)
    }

    /// The take that is shown.
    pub fn shown_take(&self) -> Option<&Take> {
        self.shown.and_then(|shown| self.takes.get(shown))
    }

    /// The checkpoint that is selected, with its number from 1.
    pub fn selected_mark(&self) -> Option<(usize, &Mark)> {
        let Some(PickTarget::Checkpoint { character: 0, constraint }) = self.selected else {
            return None;
        };
        let nth = self.marks.iter().position(|mark| mark.constraint == constraint)?;
        Some((nth + 1, &self.marks[nth]))
    }

    /// Shows the take number `nth`, from 0, at the same frame, from now on.
    pub fn pick_take(&mut self, nth: usize) {
        let Some(take) = self.takes.get(nth) else { return };
        if self.shown == Some(nth) {
            return;
        }
        self.shown_before = self.shown_take().map(|take| take.id);
        let (id, n_frames, fps) = (take.id, take.n_frames(), take.fps);
        self.player.set_motion(n_frames, fps);
        // The search hears of it and answers in a later snapshot; the eye need not wait.
        self.shown = Some(nth);
        if let Some(authoring) = &mut self.authoring {
            authoring.session.pick(CharacterIdx(0), id);
        }
        self.after_edit();
    }

    /// Frames at which something happens: ends, checkpoints, cuts.
    pub fn stops(&self) -> Vec<usize> {
        let mut stops = vec![0, self.player.last()];
        if let Some(take) = self.shown_take() {
            stops.extend(take.lane.cuts.iter().map(|cut| cut.frame));
        }
        stops.extend(self.marks.iter().map(|mark| mark.frame));
        stops.retain(|stop| *stop <= self.player.last());
        stops.sort_unstable();
        stops.dedup();
        stops
    }

    /// Does a command that needs nothing but the state; gives whether it was one.
    pub fn run(&mut self, command: UiCommand) -> bool {
        use UiCommand as C;
        if !command.is_enabled(self) {
            return true;
        }
        let (now, second) = (self.player.frame_number(), self.player.fps().round() as i32);
        let settings = &mut self.settings;
        let flip = |flag: &mut bool| *flag = !*flag;
        match command {
            C::PlayPause => self.player.toggle(),
            C::StepBack => self.player.step(-1),
            C::StepAhead => self.player.step(1),
            C::SecondBack => self.player.step(-second),
            C::SecondAhead => self.player.step(second),
            C::PreviousStop => {
                let stop = self.stops().into_iter().rev().find(|stop| *stop < now);
                self.jump(stop);
            }
            C::NextStop => {
                let stop = self.stops().into_iter().find(|stop| *stop > now);
                self.jump(stop);
            }
            C::ToStart => self.player.seek(0.0),
            C::ToEnd => self.jump(Some(self.player.last())),
            C::Loop => self.player.toggle_loop(),
            C::Slower => self.player.change_speed(false),
            C::Faster => self.player.change_speed(true),
            C::NormalSpeed => self.player.set_speed(1.0),
            C::ShowTake(n) => self.pick_take(usize::from(n).saturating_sub(1)),
            C::FlipTakes => {
                let before = self.shown_before;
                let nth = self.takes.iter().position(|take| Some(take.id) == before);
                nth.into_iter().for_each(|nth| self.pick_take(nth));
            }
            C::Follow => flip(&mut settings.follow),
            C::Trail => flip(&mut settings.trail),
            C::Ghosts => flip(&mut settings.ghosts),
            C::LeftPanel => flip(&mut settings.left_open),
            C::RightPanel => flip(&mut settings.right_open),
            C::Timeline => flip(&mut settings.timeline_open),
            C::Theme => self.flip_theme(),
            C::Navigation => {
                settings.navigation = match settings.navigation {
                    Navigation::Blender => Navigation::Industry,
                    Navigation::Industry => Navigation::Blender,
                }
            }
            C::Save | C::PauseSearch | C::Shake | C::FollowBest => self.search(command),
            C::Undo | C::Redo | C::Delete => self.edit(command),
            C::SelectTool => {
                let cancelled = self.authoring.as_mut().is_some_and(Authoring::cancel);
                if !cancelled && self.settings.tool == Tool::Select {
                    self.selected = None;
                }
                self.settings.tool = Tool::Select;
                self.after_edit();
            }
            C::CheckpointTool => self.settings.tool = Tool::Checkpoint,
            _ => return false,
        }
        true
    }

    fn search(&mut self, command: UiCommand) {
        let Some(authoring) = &mut self.authoring else { return };
        let search = authoring.session.search();
        match command {
            UiCommand::PauseSearch if search.is_paused() => search.resume(),
            UiCommand::PauseSearch => search.pause(),
            UiCommand::Shake => search.shake(),
            UiCommand::FollowBest => {
                self.settings.follow_best = !self.settings.follow_best;
                search.follow_best(self.settings.follow_best);
            }
            _ => authoring.save(),
        }
    }

    fn edit(&mut self, command: UiCommand) {
        let selected = self.selected;
        let Some(authoring) = &mut self.authoring else { return };
        match command {
            UiCommand::Undo => authoring.undo(),
            UiCommand::Redo => authoring.redo(),
            _ => {
                let at = selected.and_then(|target| authoring.constraint_of(target));
                at.into_iter().for_each(|at| authoring.apply(&Command::Remove { at }));
                self.selected = None;
            }
        }
        // Names of marks are places in a list, which may be another's now.
        self.selected = self.selected.filter(|_| command == UiCommand::Delete);
        self.hovered = None;
        self.after_edit();
    }

    fn jump(&mut self, to: Option<usize>) {
        to.into_iter().for_each(|frame| self.player.stop_at(frame));
    }

    fn flip_theme(&mut self) {
        let theme = match self.settings.theme {
            Theme::Dark => Theme::Light,
            Theme::Light => Theme::Dark,
        };
        self.settings.theme = theme;
        self.takes.iter_mut().for_each(|take| take.set_theme(theme));
        crate::theme::choose(&self.wake, theme);
    }
}

fn marks_of(authoring: &Authoring, shown: Option<&Take>) -> Vec<Mark> {
    let mut marks = Vec::new();
    for (nth, constraint) in authoring.constraints(0).iter().enumerate() {
        let ConstraintKind::Body { frame, position_m, heading_deg, .. } = &constraint.kind else {
            continue;
        };
        let misses = shown.map_or(&[][..], |take| take.lane.misses.as_slice());
        let miss = misses.iter().find(|miss| miss.constraint == constraint.id);
        marks.push(Mark {
            constraint: nth,
            frame: *frame as usize,
            at_m: *position_m,
            heading_deg: *heading_deg,
            miss: miss.cloned(),
        });
    }
    marks.sort_by_key(|mark| mark.frame);
    marks
}
