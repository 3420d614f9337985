//! The window, frame by frame: take in news, do commands, lay out panels.

use std::time::Duration;

use egui::{CentralPanel, Frame, Margin, Panel, Ui};

use motion_session::session::SessionError;

use crate::command_palette::CommandPalette;
use crate::panels::library::LibraryPanel;
use crate::panels::{inspector, status, takes, top_bar};
use crate::shortcut_sheet::shortcut_sheet_ui;
use crate::state::{EditorOptions, EditorState};
use crate::theme;
use crate::timeline::TimelinePanel;
use crate::ui_command::{UiCommand, pressed};
use crate::viewport::ViewportPanel;

/// The editor. It needs a window's device to show the view, and nothing else of a window.
pub struct EditorApp {
    /// What all panels share.
    pub state: EditorState,
    /// The view.
    pub viewport: ViewportPanel,
    /// The timeline.
    pub timeline: TimelinePanel,
    library: LibraryPanel,
    palette: CommandPalette,
    sheet_is_open: bool,
}

impl EditorApp {
    /// Opens a project and begins to search. Fails only where the system has no thread to give.
    pub fn new(
        cc: &eframe::CreationContext<'_>,
        options: EditorOptions,
    ) -> Result<Self, SessionError> {
        theme::install(&cc.egui_ctx);
        let state = EditorState::new(options, &cc.egui_ctx)?;
        theme::choose(&cc.egui_ctx, state.settings.theme);
        Ok(Self {
            state,
            viewport: ViewportPanel::new(cc.wgpu_render_state.as_ref(), &cc.egui_ctx),
            timeline: TimelinePanel::default(),
            library: LibraryPanel::default(),
            palette: CommandPalette::default(),
            sheet_is_open: false,
        })
    }

    fn do_commands(&mut self, ctx: &egui::Context) {
        // What lies on top gets Escape before anything else.
        let no_modifiers = egui::Modifiers::NONE;
        if self.sheet_is_open
            && ctx.input_mut(|input| input.consume_key(no_modifiers, egui::Key::Escape))
        {
            self.sheet_is_open = false;
        }
        let mut commands = self.state.take_commands();
        commands.extend(self.timeline.pressed(ctx));
        commands.extend(pressed(ctx));
        for command in commands {
            if self.state.run(command) || self.timeline.run(command, &self.state) {
                continue;
            }
            match command {
                UiCommand::Palette => self.palette.toggle(),
                UiCommand::ShortcutSheet => self.sheet_is_open = !self.sheet_is_open,
                UiCommand::Quit => ctx.send_viewport_cmd(egui::ViewportCommand::Close),
                other => self.viewport.run(other),
            }
        }
    }

    /// Has the next frame come in time, though nobody touches anything.
    fn wake_again(&mut self, ctx: &egui::Context, dt_secs: f64) {
        if self.state.is_playing() {
            ctx.request_repaint();
        }
        let word_ends = self.state.notices.advance(dt_secs);
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
        Panel::top("top bar")
            .exact_size(theme::TOP_BAR_HEIGHT)
            .frame(bar)
            .show(ui, |ui| top_bar::top_bar_ui(ui, state));
        Panel::bottom("status")
            .exact_size(theme::STATUS_BAR_HEIGHT)
            .frame(bar)
            .show(ui, |ui| status::status_ui(ui, state, self.viewport.adapter_name()));
        if state.settings.timeline_open {
            Panel::bottom("timeline")
                .resizable(true)
                .default_size(256.0)
                .size_range(150.0..=480.0)
                .frame(Frame::new().fill(p.panel))
                .show(ui, |ui| self.timeline.ui(ui, state));
        }
        if state.settings.left_open {
            Panel::left("library")
                .resizable(true)
                .default_size(248.0)
                .size_range(180.0..=420.0)
                .frame(side)
                .show(ui, |ui| self.library.ui(ui, state));
        }
        if state.settings.right_open {
            Panel::right("takes")
                .resizable(true)
                .default_size(320.0)
                .size_range(240.0..=520.0)
                .frame(side)
                .show(ui, |ui| {
                    let scroll = |name| egui::ScrollArea::vertical().id_salt(name);
                    // Whatever is found, what is selected stays in sight.
                    let room = 0.6 * ui.available_height();
                    scroll("takes")
                        .auto_shrink([false, true])
                        .max_height(room)
                        .show(ui, |ui| takes::takes_ui(ui, state));
                    ui.add_space(2.0 * theme::GRID);
                    scroll("inspector")
                        .auto_shrink(false)
                        .show(ui, |ui| inspector::inspector_ui(ui, state));
                });
        }
        CentralPanel::no_frame().show(ui, |ui| self.viewport.ui(ui, state));
    }
}

impl eframe::App for EditorApp {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        let dt_secs = f64::from(ctx.input(|input| input.unstable_dt));
        self.state.poll(dt_secs);
        self.do_commands(&ctx);
        self.panels_ui(ui);
        if let Some(command) = self.palette.ui(ui, &self.state) {
            self.state.ask(command);
        }
        shortcut_sheet_ui(ui, &mut self.sheet_is_open);
        self.wake_again(&ctx, dt_secs);
    }
}
