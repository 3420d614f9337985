//! What the window shows and how commands change it; no widget is known here.

use motion_scene::color::Theme;
use motion_session::command::Command;
use motion_session::stage::pick::PickTarget;
use motion_session::{ConstraintKind, Project, Warnings};

use crate::authoring::Authoring;
use crate::player::Player;
use crate::project_source::ProjectSource;
use crate::settings::{Navigation, Settings, Tool};
use crate::solving::{ClipLine, Outcome, Solving, Stage};
use crate::take::{Mark, Take};
use crate::ui_command::UiCommand;

/// The state that all panels share.
#[derive(Debug)]
pub struct EditorState {
    /// Rounds of the search after which motions are shown.
    rounds: &'static [u64],
    /// The project, if it could be read.
    pub authoring: Option<Authoring>,
    /// The work in the background.
    pub solving: Solving,
    /// What was found, best first.
    pub takes: Vec<Take>,
    /// The one that is shown.
    pub shown: Option<usize>,
    /// The one that was shown before.
    pub shown_before: Option<usize>,
    /// Sentences on what could not be met.
    pub unmet: Vec<String>,
    /// How long the search took, seconds.
    pub solved_in_secs: Option<f64>,
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
    /// Whether no take was shown yet for what is asked now.
    is_new_question: bool,
    /// What was asked for since the last frame.
    commands: Vec<UiCommand>,
    /// Starts work that wakes the window.
    wake: egui::Context,
}

impl EditorState {
    /// Opens a project and begins to solve it.
    pub fn new(source: &ProjectSource, rounds: &'static [u64], ctx: &egui::Context) -> Self {
        let (mut authoring, failure) = match source.read(&mut Warnings::new()) {
            Ok((project, path)) => (Some(Authoring::new(project, path)), String::new()),
            Err(sentence) => (None, sentence),
        };
        let solving = match &mut authoring {
            Some(authoring) => start(authoring, rounds, ctx),
            None => Solving::failed(failure),
        };
        Self {
            solving,
            rounds,
            authoring,
            is_new_question: true,
            takes: Vec::new(),
            shown: None,
            shown_before: None,
            unmet: Vec::new(),
            solved_in_secs: None,
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

    /// Takes in what the worker has done.
    pub fn drain(&mut self) {
        if let Some(outcome) = self.solving.poll() {
            self.accept(outcome);
        }
    }

    /// What was found first for a question is shown. Better takes come beside it later: what is
    /// looked at never changes by itself.
    fn accept(&mut self, outcome: Outcome) {
        let kept = self.shown_take().cloned().filter(|_| !self.is_new_question);
        let is_first = self.takes.is_empty();
        self.takes = outcome.takes;
        self.clips = outcome.clips;
        self.unmet = outcome.unmet;
        self.solved_in_secs = Some(outcome.seconds);
        (self.shown, self.shown_before) = (None, None);
        let mut show = 0;
        if let Some(kept) = kept {
            let same = |take: &Take| take.lane.pieces == kept.lane.pieces;
            show = self.takes.iter().position(same).unwrap_or_else(|| {
                let dearer = |take: &Take| take.lane.score > kept.lane.score;
                let at = self.takes.iter().position(dearer).unwrap_or(self.takes.len());
                self.takes.insert(at, kept);
                at
            });
        }
        for (take, number) in self.takes.iter_mut().zip(1..) {
            take.number = number;
            take.set_theme(self.settings.theme);
        }
        self.is_new_question = false;
        self.refresh_marks();
        self.show_take(show);
        if is_first {
            // A first look needs no key.
            self.player.play();
        }
    }

    /// Asks the worker anew where the project asks for something else than before, and shows what
    /// is asked now. To be called after every change.
    pub fn after_edit(&mut self) {
        self.refresh_marks();
        let Some(authoring) = &mut self.authoring else { return };
        if let Some(project) = authoring.to_be_solved() {
            self.solving = begin(project, authoring, self.rounds, &self.wake);
            self.is_new_question = true;
            // Said of what was asked before.
            self.unmet.clear();
        }
    }

    /// Has all takes show the constraints as they are now; misses only where they are still true.
    fn refresh_marks(&mut self) {
        let Some(authoring) = &self.authoring else { return };
        let is_stale = authoring.is_stale() || self.is_new_question;
        for take in &mut self.takes {
            for (nth, role) in take.stage.roles.iter_mut().enumerate() {
                role.constraints = authoring.constraints(nth).to_vec();
                role.misses.clear();
            }
            if let Some(role) = take.stage.roles.first_mut().filter(|_| !is_stale) {
                role.misses = take.lane.misses.clone();
            }
        }
        self.marks = marks_of(authoring, self.shown_take().filter(|_| !is_stale));
    }

    /// Whether the worker is busy.
    pub fn is_working(&self) -> bool {
        matches!(self.solving.stage, Stage::Working(..))
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

    /// Shows the take number `nth`, from 0, at the same frame.
    pub fn show_take(&mut self, nth: usize) {
        let Some(take) = self.takes.get(nth) else { return };
        self.player.set_motion(take.n_frames(), take.fps);
        if self.shown != Some(nth) {
            self.shown_before = self.shown;
            self.shown = Some(nth);
        }
        self.refresh_marks();
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
            C::ShowTake(n) => self.show_take(usize::from(n).saturating_sub(1)),
            C::FlipTakes => self.shown_before.into_iter().for_each(|nth| self.show_take(nth)),
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
            C::SolveAgain => {
                if let Some(authoring) = &mut self.authoring {
                    self.solving = start(authoring, self.rounds, &self.wake);
                    self.is_new_question = true;
                }
            }
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

fn start(authoring: &mut Authoring, rounds: &'static [u64], ctx: &egui::Context) -> Solving {
    let project = authoring.project_to_solve();
    begin(project, authoring, rounds, ctx)
}

fn begin(
    project: Project,
    authoring: &Authoring,
    rounds: &'static [u64],
    ctx: &egui::Context,
) -> Solving {
    let ctx = ctx.clone();
    Solving::start(project, authoring.path.clone(), rounds, move || ctx.request_repaint())
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
