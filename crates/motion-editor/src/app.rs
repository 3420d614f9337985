//! The window, frame by frame: take in news, do commands, lay out panels.

use std::time::Duration;

use egui::{CentralPanel, Frame, Margin, Panel, Rect, Ui, UiBuilder, Vec2};

use motion_session::preferences::UI_SCALES;
use motion_session::session::SessionError;

use crate::command_palette::CommandPalette;
use crate::coverage_window::CoverageWindow;
use crate::dialogs::Answers;
use crate::export::ExportDialog;
use crate::files::{FileFlow, Next};
use crate::focus;
use crate::guide::Guide;
use crate::log_window::log_window_ui;
use crate::panels::library::LibraryPanel;
use crate::panels::takes::TakesPanel;
use crate::panels::{right_tab, status, top_bar};
use crate::settings::Settings;
use crate::settings_window::settings_window_ui;
use crate::shortcut_sheet::ShortcutSheet;
use crate::state::{EditorOptions, EditorState};
use crate::theme;
use crate::timeline::TimelinePanel;
use crate::ui_command::{UiCommand, pressed};
use crate::viewport::ViewportPanel;
use crate::welcome::welcome_ui;

/// The editor. It needs a window's device to show the view, and nothing else of a window.
pub struct EditorApp {
    /// What all panels share.
    pub state: EditorState,
    /// The view.
    pub viewport: ViewportPanel,
    /// The timeline.
    pub timeline: TimelinePanel,
    library: LibraryPanel,
    takes: TakesPanel,
    palette: CommandPalette,
    sheet: ShortcutSheet,
    guide: Guide,
    settings_are_open: bool,
    log_is_open: bool,
    coverage: CoverageWindow,
    /// Taking motions out.
    pub export: ExportDialog,
    /// Opening and saving.
    pub files: FileFlow,
}

impl EditorApp {
    /// Opens a project and begins to search. Fails only where the system has no thread to give.
    pub fn new(
        cc: &eframe::CreationContext<'_>,
        options: EditorOptions,
    ) -> Result<Self, SessionError> {
        theme::install(&cc.egui_ctx);
        let mut answers = options.answers.clone();
        let state = EditorState::new(options, &cc.egui_ctx)?;
        if answers == Answers::System && state.settings.own_file_dialog {
            answers = Answers::Own;
        }
        let files = FileFlow::new(answers, &state);
        cc.egui_ctx.set_zoom_factor(state.settings.ui_scale);
        theme::choose(&cc.egui_ctx, state.settings.theme);
        Ok(Self {
            state,
            viewport: ViewportPanel::new(cc.wgpu_render_state.as_ref(), &cc.egui_ctx),
            timeline: TimelinePanel::default(),
            library: LibraryPanel::default(),
            takes: TakesPanel::default(),
            palette: CommandPalette::default(),
            sheet: ShortcutSheet::default(),
            guide: Guide::default(),
            settings_are_open: false,
            log_is_open: false,
            coverage: CoverageWindow::default(),
            export: ExportDialog::default(),
            files,
        })
    }

    /// The gallery.
    pub fn takes(&self) -> &TakesPanel {
        &self.takes
    }

    fn do_commands(&mut self, ctx: &egui::Context) {
        let mut commands = self.state.take_commands();
        // What asks is answered first: keys are its own.
        let is_asking = self.files.is_asking() || self.export.is_open() || self.palette.is_open();
        if !is_asking {
            self.close_on_escape(ctx);
            self.timeline.take_keys(ctx);
            self.viewport.take_keys(ctx, &mut self.state);
            commands.extend(self.timeline.pressed(ctx));
            commands.extend(pressed(ctx));
        }
        for command in commands {
            if self.state.run(command) || self.timeline.run(command, &mut self.state) {
                continue;
            }
            match command {
                UiCommand::Palette => self.palette.toggle(),
                UiCommand::ShortcutSheet => self.sheet.is_open = !self.sheet.is_open,
                UiCommand::Export => self.export.open(),
                UiCommand::ExportAgain => self.export.repeat(&mut self.state),
                UiCommand::Settings => self.settings_are_open = !self.settings_are_open,
                UiCommand::Coverage => self.coverage.is_open = !self.coverage.is_open,
                UiCommand::Log => self.log_is_open = !self.log_is_open,
                UiCommand::FullScreen => {
                    let is_full = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
                    ctx.send_viewport_cmd(egui::ViewportCommand::Fullscreen(!is_full));
                }
                UiCommand::Guide => self.guide.toggle(),
                UiCommand::NextPanel | UiCommand::PreviousPanel => {
                    let ahead = command == UiCommand::NextPanel;
                    focus::step(ctx, |panel| is_panel_open(panel, &self.state.settings), ahead);
                }
                other if self.files.run(other, &mut self.state, ctx) => {}
                other => self.viewport.run(other, ctx, &mut self.state),
            }
        }
    }

    /// What lies on top gets Escape before anything else.
    fn close_on_escape(&mut self, ctx: &egui::Context) {
        let pages = [
            &mut self.sheet.is_open,
            &mut self.settings_are_open,
            &mut self.log_is_open,
            &mut self.coverage.is_open,
        ];
        let Some(page) = pages.into_iter().find(|is_open| **is_open) else { return };
        let none = egui::Modifiers::NONE;
        if ctx.input_mut(|input| input.consume_key(none, egui::Key::Escape)) {
            *page = false;
        }
    }

    /// Answers of dialogs, files dropped on the window, and whether it may close.
    fn see_to_files(&mut self, ctx: &egui::Context) {
        let Self { files, state, .. } = self;
        if let Some(answer) = files.poll(state, ctx) {
            self.export.answered(&answer, state);
        }
        let dropped = ctx.input_mut(|input| std::mem::take(&mut input.raw.dropped_files));
        let dropped = dropped.into_iter().map(|file| file.path().to_owned());
        files.drop_in(dropped.collect(), state, ctx);
        let is_closing = ctx.input(|input| input.viewport().close_requested());
        if is_closing && !files.may_close() && state.session.is_changed() {
            ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            files.request(Next::Close, state, ctx);
        }
    }

    /// Has the next frame come in time, though nobody touches anything.
    fn wake_again(&mut self, ctx: &egui::Context, dt_secs: f64) {
        if self.state.advance_preview(dt_secs) || self.state.is_playing() {
            ctx.request_repaint();
        }
        let state = &mut self.state;
        state.settings.ui_scale = ctx.zoom_factor().clamp(*UI_SCALES.start(), *UI_SCALES.end());
        state.remember(dt_secs);
        let word_ends = state.notices.advance(dt_secs);
        // An autosave comes due.
        let at_risk = self.state.session.is_changed().then_some(1.0);
        let next_secs = word_ends.into_iter().chain(at_risk).reduce(f64::min);
        if let Some(secs) = next_secs {
            ctx.request_repaint_after(Duration::from_secs_f64(secs.max(0.05)));
        }
    }

    fn panels_ui(&mut self, ui: &mut Ui) {
        let p = theme::of(ui);
        let state = &mut self.state;
        let bar = Frame::new().fill(p.panel).inner_margin(Margin::symmetric(4, 0));
        let side = Frame::new().fill(p.panel).inner_margin(Margin::symmetric(12, 4));
        Panel::top("top bar").exact_size(theme::TOP_BAR_HEIGHT).frame(bar).show(ui, |ui| {
            focus::anchor_ui(ui, focus::PANELS[0]);
            top_bar::top_bar_ui(ui, state);
        });
        Panel::bottom("status")
            .exact_size(theme::STATUS_BAR_HEIGHT)
            .frame(bar)
            .show(ui, |ui| status::status_ui(ui, state, self.viewport.adapter_name()));
        if state.settings.timeline.open {
            let size = state.settings.timeline.size_pt.unwrap_or(256.0);
            let shown = Panel::bottom("timeline")
                .resizable(true)
                .default_size(size)
                .size_range(150.0..=480.0)
                .frame(Frame::new().fill(p.panel))
                .show(ui, |ui| {
                    focus::anchor_ui(ui, focus::PANELS[4]);
                    self.timeline.ui(ui, state);
                });
            state.settings.timeline.size_pt = Some(shown.response.rect.height());
        }
        if state.settings.left.open {
            let size = state.settings.left.size_pt.unwrap_or(248.0);
            let shown = Panel::left("library")
                .resizable(true)
                .default_size(size)
                .size_range(180.0..=420.0)
                .frame(side)
                .show(ui, |ui| {
                    focus::anchor_ui(ui, focus::PANELS[1]);
                    self.library.ui(ui, state);
                });
            state.settings.left.size_pt = Some(shown.response.rect.width());
        }
        if state.settings.right.open {
            let size = state.settings.right.size_pt.unwrap_or(320.0);
            let shown = Panel::right("takes")
                .resizable(true)
                .default_size(size)
                .size_range(240.0..=520.0)
                .frame(side)
                .show(ui, |ui| {
                    focus::anchor_ui(ui, focus::PANELS[3]);
                    // Whatever is found, what is selected stays in sight, and where it is: what moves
                    // under the pointer while takes come is not clicked.
                    let room = Vec2::new(ui.available_width(), 0.58 * ui.available_height());
                    let builder =
                        UiBuilder::new().max_rect(Rect::from_min_size(ui.cursor().min, room));
                    self.takes.ui(&mut ui.new_child(builder), state);
                    ui.advance_cursor_after_rect(Rect::from_min_size(ui.cursor().min, room));
                    ui.add_space(3.0 * theme::GRID);
                    right_tab::tab_bar_ui(ui, state);
                    // What is selected now is seen from its top.
                    let of = state.selected().cloned();
                    egui::ScrollArea::vertical()
                        .id_salt(("right tab", of))
                        .auto_shrink(false)
                        .show(ui, |ui| right_tab::tab_ui(ui, state));
                });
            state.settings.right.size_pt = Some(shown.response.rect.width());
        }
        CentralPanel::no_frame().show(ui, |ui| {
            focus::anchor_ui(ui, focus::PANELS[2]);
            self.viewport.ui(ui, state);
        });
    }
}

/// Whether keys can go to a panel.
fn is_panel_open(panel: &str, settings: &Settings) -> bool {
    match focus::PANELS.iter().position(|known| *known == panel) {
        Some(1) => settings.left.open,
        Some(3) => settings.right.open,
        Some(4) => settings.timeline.open,
        _ => true,
    }
}

impl eframe::App for EditorApp {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        let dt_secs = f64::from(ctx.input(|input| input.unstable_dt));
        self.state.poll(dt_secs);
        self.do_commands(&ctx);
        self.see_to_files(&ctx);
        self.viewport.forget_hover(&mut self.state);
        self.takes.keep_up(&ctx, self.viewport.canvas(), &self.state);
        self.panels_ui(ui);
        if let Some(command) = self.palette.ui(ui, &self.state) {
            self.state.ask(command);
        }
        self.sheet.ui(ui);
        let view = self.viewport.rect();
        welcome_ui(ui, view, &mut self.state);
        self.guide.ui(ui, view, &mut self.state);
        let theme = self.state.settings.theme;
        settings_window_ui(ui, &mut self.state.settings, &mut self.settings_are_open);
        if self.state.settings.theme != theme {
            self.state.refresh();
        }
        log_window_ui(ui, &self.state.notices, &mut self.log_is_open);
        self.coverage.ui(ui, &self.state);
        self.export.ui(ui, &mut self.state, &mut self.files);
        self.files.ui(ui, &mut self.state);
        self.wake_again(&ctx, dt_secs);
    }

    fn on_exit(&mut self) {
        self.state.close();
    }
}
