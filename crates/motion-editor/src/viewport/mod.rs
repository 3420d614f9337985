//! The view: the shown take in three dimensions.

pub mod canvas;
pub mod compare;
pub mod gesture;
pub mod gizmo;
pub mod navigation;
pub mod overlay;
pub mod show;

use egui::{Color32, Pos2, Rect, Role, Sense, Ui, Vec2, WidgetInfo};
use glam::Vec3;
use motion_scene::bounds::Bounds;
use motion_scene::camera::{FOV_RAD, OrbitCamera, Projection, StandardView, Viewport};
use motion_scene::scene::Scene;
use motion_session::document::CharacterIdx;
use motion_session::stage::Stage;
use motion_session::stage::pick::{PickTarget, Picks};

use crate::icons;
use crate::mark::Mark;
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::UiCommand;
use crate::widgets::icon_button::icon_button_ui;
use canvas::Canvas;
use gesture::Gesture;

/// What tests and screen readers call the view.
pub const LABEL: &str = "Viewport";
/// Free room around what is framed, as a share of the picture.
const MARGIN: f32 = 0.1;
/// From the corner of the view to the middle of the gizmo, points.
const GIZMO_INSET_PT: f32 = 56.0;

/// The view's own state; none of it belongs to the project.
pub struct ViewportPanel {
    canvas: Option<Canvas>,
    /// From where it is looked at.
    pub camera: OrbitCamera,
    /// Whether everything is to be brought into view when its size is known.
    frame_all: bool,
    /// Where the followed body was.
    followed_m: Option<Vec3>,
    gesture: Gesture,
    picks: Picks,
    /// Where the pointer was when it was asked what is under it.
    asked_at: Option<Pos2>,
    rect: Rect,
    /// How often the window is drawn while something moves, smoothed.
    fps: Option<f32>,
}

impl ViewportPanel {
    /// A view; without a device (a test that looks at no pictures) it stays empty.
    pub fn new(state: Option<&egui_wgpu::RenderState>, ctx: &egui::Context) -> Self {
        Self {
            canvas: state.map(|state| Canvas::new(state, ctx)),
            camera: OrbitCamera::default(),
            frame_all: true,
            followed_m: None,
            gesture: Gesture::default(),
            picks: Picks::default(),
            asked_at: None,
            rect: Rect::ZERO,
            fps: None,
        }
    }

    /// What draws, for a person.
    pub fn adapter_name(&self) -> Option<&str> {
        self.canvas.as_ref().map(Canvas::adapter_name)
    }

    /// Waits until the device has done what it was given, or has gone over it.
    pub fn wait_for_device(&self) {
        if let Some(canvas) = &self.canvas {
            canvas.wait_for_device();
        }
    }

    /// Destroys the device, as a driver's fault would.
    pub fn destroy_device(&self) {
        if let Some(canvas) = &self.canvas {
            canvas.destroy_device();
        }
    }

    /// Whether the device that draws is gone.
    pub fn is_device_lost(&self) -> bool {
        self.canvas.as_ref().is_some_and(Canvas::is_lost)
    }

    /// What draws, for pictures beside the view.
    pub fn canvas(&mut self) -> Option<&mut Canvas> {
        self.canvas.as_mut()
    }

    /// How many pictures were drawn so far.
    pub fn n_drawn(&self) -> u64 {
        self.canvas.as_ref().map_or(0, Canvas::n_drawn)
    }

    /// Where it was drawn last.
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// Does a command that moves the camera.
    pub fn run(&mut self, command: UiCommand) {
        match command {
            UiCommand::FrameAll => self.frame_all = true,
            UiCommand::ViewFront => self.look_from(StandardView::Front),
            UiCommand::ViewLeft => self.look_from(StandardView::Left),
            UiCommand::ViewTop => self.look_from(StandardView::Top),
            UiCommand::ViewThreeQuarter => self.look_from(StandardView::ThreeQuarter),
            UiCommand::Perspective => {
                self.camera.projection = match self.camera.projection {
                    Projection::Perspective { .. } => Projection::Orthographic,
                    Projection::Orthographic => {
                        Projection::Perspective { vertical_fov_rad: FOV_RAD }
                    }
                }
            }
            _ => {}
        }
    }

    fn look_from(&mut self, view: StandardView) {
        let OrbitCamera { target_m, distance_m, .. } = self.camera;
        self.camera = OrbitCamera::standard(view, target_m, distance_m);
    }

    /// The whole panel.
    pub fn ui(&mut self, ui: &mut Ui, state: &mut EditorState) {
        let whole = ui.available_size().max(Vec2::splat(1.0));
        let size = compare::size_of_main(whole, compare::n_views(state));
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, LABEL));
        self.rect = rect;
        self.measure_fps(ui, state);
        if !self.gesture.ui(ui, &response, &self.camera, state) {
            let scheme = state.settings.navigation;
            if navigation::navigate_ui(ui, &response, &mut self.camera, scheme) {
                state.settings.follow = false;
            }
        }
        self.keep_up(state);
        self.draw_ui(ui, rect, state);
        let whole = Rect::from_min_size(rect.min, whole);
        if let Some(canvas) = &mut self.canvas {
            compare::others_ui(ui, whole, canvas, &mut self.camera, state);
        }
        self.pick_ui(ui, &response, state);
        overlay::overlay_ui(ui, rect, state, self.fps);
        let corner = Pos2::new(rect.right() - GIZMO_INSET_PT, rect.top() + GIZMO_INSET_PT);
        if let Some(view) = gizmo::gizmo_ui(ui, corner, &mut self.camera) {
            self.look_from(view);
        }
        toggles_ui(ui, rect, state);
    }

    fn measure_fps(&mut self, ui: &Ui, state: &EditorState) {
        const NEW: f32 = 0.1;
        let dt = ui.input(|input| input.unstable_dt).max(1e-4);
        self.fps = state.is_playing().then(|| {
            let now = 1.0 / dt;
            self.fps.map_or(now, |fps| fps + (now - fps) * NEW)
        });
    }

    /// Frames and follows.
    fn keep_up(&mut self, state: &mut EditorState) {
        self.frame_all |= std::mem::take(&mut state.is_new_scene);
        if state.stage.actors.is_empty() {
            return;
        }
        if self.frame_all
            && let Some(bounds) = whole_motion(&state.stage, &state.marks)
        {
            let viewport = Viewport::new(self.rect.width(), self.rect.height());
            self.camera.frame(&bounds, viewport, MARGIN);
            self.frame_all = false;
        }
        let active = state.stage.actors.get(state.session.active().0);
        let root = active.map(|actor| actor.root_at_m(state.frame()));
        let here = root.filter(|_| state.settings.follow);
        if let (Some(before), Some(now)) = (self.followed_m, here) {
            self.camera.target_m += (now - before).with_y(0.0);
        } else if let Some(now) = here {
            self.camera.target_m = now.with_y(self.camera.target_m.y);
        }
        self.followed_m = here;
    }

    fn draw_ui(&mut self, ui: &Ui, rect: Rect, state: &EditorState) {
        let pixels_per_point = ui.ctx().pixels_per_point();
        let Some(canvas) = &mut self.canvas else { return };
        let scene = match show::staged(state) {
            Some(staged) => {
                self.picks = staged.picks;
                staged.scene
            }
            None => Scene::empty(state.settings.theme),
        };
        for actor in &state.stage.actors {
            canvas.set_model(actor.figure.mesh, &actor.figure.model);
        }
        let picture = canvas.draw(scene, self.camera, rect.size(), pixels_per_point);
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        // Untinted.
        ui.painter().image(picture, rect, whole, Color32::WHITE);
    }

    /// Hover and selection. Answers come a frame or two later; nothing waits for them.
    fn pick_ui(&mut self, ui: &Ui, response: &egui::Response, state: &mut EditorState) {
        let Some(canvas) = &mut self.canvas else { return };
        if let Some(answer) = canvas.picked() {
            let target = answer.and_then(|id| self.picks.target(id));
            if state.hovered != target && response.contains_pointer() {
                state.hovered = target;
                ui.ctx().request_repaint();
            }
        }
        match response.hover_pos() {
            Some(at) if self.asked_at != Some(at) && !response.dragged() => {
                if !canvas.is_asking() {
                    canvas.ask(at, response.rect);
                    self.asked_at = Some(at);
                }
                ui.ctx().request_repaint();
            }
            Some(_) => {}
            None if response.dragged() || self.asked_at.is_none() => {}
            None => {
                self.asked_at = None;
                state.hovered = None;
            }
        }
        if canvas.is_asking() {
            ui.ctx().request_repaint();
        }
        if response.clicked() {
            let is_adding = ui.input(|input| input.modifiers.shift);
            select(state, is_adding);
        }
        if response.double_clicked() && state.hovered.is_none() {
            self.frame_all = true;
        }
    }
}

/// The few things that are switched in the view itself.
fn toggles_ui(ui: &mut Ui, rect: Rect, state: &mut EditorState) {
    let all = [
        (icons::SELECT, UiCommand::SelectTool),
        (icons::CHECKPOINT, UiCommand::CheckpointTool),
        (icons::FOLLOW, UiCommand::Follow),
        (icons::TRAIL, UiCommand::Trail),
        (icons::GHOSTS, UiCommand::Ghosts),
        (icons::FRAME, UiCommand::FrameAll),
    ];
    let width = theme::ICON_BUTTON;
    let top = rect.top() + 2.0 * GIZMO_INSET_PT + 8.0;
    let left = rect.right() - GIZMO_INSET_PT - 0.5 * width;
    let height = all.len() as f32 * (width + theme::GRID) - theme::GRID;
    let place = Rect::from_min_size(Pos2::new(left, top), Vec2::new(width, height));
    let plate = theme::of(ui).panel.gamma_multiply(0.8);
    ui.painter().rect_filled(place.expand(2.0), f32::from(theme::RADIUS), plate);
    let mut column = ui.new_child(egui::UiBuilder::new().max_rect(place));
    for (icon, command) in all {
        let is_on = command.is_on(state).unwrap_or_default();
        let tooltip = described(ui, command);
        if icon_button_ui(&mut column, icon, &command.label(), &tooltip, is_on).clicked() {
            state.ask(command);
        }
    }
}

/// A command's tooltip with its key.
pub fn described(ui: &Ui, command: UiCommand) -> String {
    match command.shortcut() {
        Some(key) => format!("{} ({})", command.tooltip(), ui.ctx().format_shortcut(&key)),
        None => command.tooltip().to_owned(),
    }
}

/// Selects what the pointer is over, or nothing; with `is_adding` beside what is selected.
fn select(state: &mut EditorState, is_adding: bool) {
    let item = state.hovered.and_then(|target| match target {
        // Bodies fill the view; a click on one is rather meant for what it does.
        PickTarget::Actor { .. } | PickTarget::Ghost { .. } => None,
        other => state.selectable_of(other),
    });
    if let Some(PickTarget::Actor { actor } | PickTarget::Ghost { actor, .. }) = state.hovered {
        state.session.set_active(CharacterIdx(actor));
        state.refresh();
    }
    let selection = state.session.selection_mut();
    match item {
        Some(item) if is_adding => selection.toggle(item),
        Some(item) => selection.select(item),
        None if is_adding => {}
        None => selection.clear(),
    }
}

/// Room for the whole motion and its marks.
fn whole_motion(stage: &Stage, marks: &[Mark]) -> Option<Bounds> {
    const N_MOMENTS: usize = 24;
    let last = stage.n_frames().saturating_sub(1) as f64;
    let moments = (0..=N_MOMENTS).map(|i| last * i as f64 / N_MOMENTS as f64);
    let bodies =
        moments.flat_map(|frame| stage.actors.iter().filter_map(move |a| a.bounds_at(frame)));
    let marks = marks.iter().filter_map(Mark::body).map(|(at_m, _)| {
        Bounds::of_point(Vec3::new(at_m[0] as f32, 0.0, at_m[1] as f32)).grown(0.4)
    });
    bodies.chain(marks).reduce(Bounds::union)
}
