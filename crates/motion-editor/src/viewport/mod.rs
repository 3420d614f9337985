//! The view: the shown take in three dimensions.

pub mod canvas;
pub mod compare;
pub mod fly;
pub mod frame_on;
pub mod gesture;
pub mod gizmo;
pub mod glide;
pub mod navigation;
pub mod overlay;
pub mod pie;
pub mod show;

use egui::{Color32, Pos2, Rect, Role, Sense, Ui, Vec2, WidgetInfo};
use glam::Vec3;
use motion_scene::bounds::Bounds;
use motion_scene::camera::{FOV_RAD, OrbitCamera, Projection, StandardView, Viewport};
use motion_scene::scene::Scene;
use motion_session::document::CharacterIdx;
use motion_session::stage::pick::{PickTarget, Picks};

use crate::icons;
use crate::settings::{Navigation, Tool};
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::{Nudge, Side, UiCommand, key_text};
use crate::widgets::icon_button::icon_button_ui;
use canvas::Canvas;
use fly::{Flight, Fly};
use gesture::modal::Kind;
use gesture::sight::Sight;
use gesture::{Claim, Gesture};
use gizmo::Clicked;
use glide::Glide;

/// What tests and screen readers call the view.
pub const LABEL: &str = "Viewport";
/// Free room around what is framed, as a share of the picture.
const MARGIN: f32 = 0.1;
/// From the corner of the view to the middle of the gizmo, points.
const GIZMO_INSET_PT: f32 = 56.0;

/// What is to be brought into view.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Wanted {
    /// Everything, at once: the window has just opened.
    First,
    /// Everything.
    All,
    /// This.
    Room(Bounds),
}

impl Wanted {
    fn room(self, state: &EditorState) -> Option<Bounds> {
        match self {
            Self::First | Self::All => frame_on::whole_motion(&state.stage, &state.marks),
            Self::Room(room) => Some(room),
        }
    }
}

/// The view's own state; none of it belongs to the project.
pub struct ViewportPanel {
    canvas: Option<Canvas>,
    /// From where it is looked at.
    pub camera: OrbitCamera,
    /// What is to be brought into view when its size is known.
    wanted: Option<Wanted>,
    /// Where the camera is on its way to.
    glide: Option<Glide>,
    flight: Option<Fly>,
    /// How fast one flies, metres per second.
    fly_speed_m_s: f32,
    /// Where the usual views are offered.
    pie: Option<Pos2>,
    /// Whether the pointer is over the view.
    is_over: bool,
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
            wanted: Some(Wanted::First),
            glide: None,
            flight: None,
            fly_speed_m_s: 2.0,
            pie: None,
            is_over: false,
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

    /// Does a command that moves the camera, or begins something in the view.
    pub fn run(&mut self, command: UiCommand, ctx: &egui::Context, state: &mut EditorState) {
        let pointer = ctx.input(|input| input.pointer.latest_pos());
        match command {
            UiCommand::FrameAll => self.wanted = Some(Wanted::All),
            UiCommand::FrameSelection => {
                let room = frame_on::selection(state);
                self.wanted = Some(room.map_or(Wanted::All, Wanted::Room));
            }
            UiCommand::ViewFront => self.look_from(StandardView::Front, state),
            UiCommand::ViewBack => self.look_from(StandardView::Back, state),
            UiCommand::ViewLeft => self.look_from(StandardView::Left, state),
            UiCommand::ViewRight => self.look_from(StandardView::Right, state),
            UiCommand::ViewTop => self.look_from(StandardView::Top, state),
            UiCommand::ViewThreeQuarter => self.look_from(StandardView::ThreeQuarter, state),
            UiCommand::Perspective => self.toggle_perspective(),
            UiCommand::ViewPie => {
                self.pie = match self.pie {
                    Some(_) => None,
                    None => Some(pointer.unwrap_or_default()),
                }
            }
            UiCommand::Fly => self.flight = Some(Fly::begin(ctx, &self.camera, false)),
            UiCommand::MoveSelection => {
                self.gesture.begin_modal(Kind::Move, pointer.unwrap_or_default(), state);
            }
            UiCommand::TurnSelection => {
                self.gesture.begin_modal(Kind::Turn, pointer.unwrap_or_default(), state);
            }
            UiCommand::BoxSelect => self.gesture.begin_box(),
            UiCommand::Nudge(nudge) if state.selected_edit().is_some() => {
                state.nudge_hand(self.nudge_in_view_m(nudge));
            }
            UiCommand::Nudge(nudge) => state.nudge_selected(self.nudge_m(nudge)),
            _ => {}
        }
    }

    /// Takes the keys that mean what is under way in the view, before they mean anything else.
    pub fn take_keys(&mut self, ctx: &egui::Context, state: &mut EditorState) {
        if ctx.text_edit_focused() {
            return;
        }
        let escape = |ctx: &egui::Context| {
            ctx.input_mut(|input| input.consume_key(egui::Modifiers::NONE, egui::Key::Escape))
        };
        if self.pie.is_some() && escape(ctx) {
            self.pie = None;
        }
        if let Some(flight) = self.flight {
            if escape(ctx) {
                self.camera = flight.before();
                self.land(ctx);
            } else if ctx.input(|input| input.key_pressed(egui::Key::Enter)) {
                self.land(ctx);
            }
            // Held keys are known besides.
            ctx.input_mut(|input| {
                input.events.retain(|event| !matches!(event, egui::Event::Key { .. }));
            });
            return;
        }
        let is_industry = state.settings.navigation == Navigation::Industry;
        let key_a = |input: &mut egui::InputState| {
            input.modifiers.is_none() && input.consume_key(egui::Modifiers::NONE, egui::Key::A)
        };
        if is_industry && ctx.input_mut(key_a) {
            self.wanted = Some(Wanted::All);
        }
        self.gesture.take_keys(ctx, state);
    }

    /// Has nothing hovered any more, unless the pointer is over the view: who shows it elsewhere
    /// says so in every frame.
    pub fn forget_hover(&self, state: &mut EditorState) {
        if !self.is_over {
            state.hovered = None;
        }
    }

    fn land(&mut self, ctx: &egui::Context) {
        self.flight = None;
        Fly::end(ctx);
    }

    fn look_from(&mut self, view: StandardView, state: &EditorState) {
        let OrbitCamera { target_m, distance_m, .. } = self.going_to();
        self.glide_to(OrbitCamera::standard(view, target_m, distance_m), state);
    }

    fn toggle_perspective(&mut self) {
        self.camera = self.going_to();
        self.glide = None;
        self.camera.projection = match self.camera.projection {
            Projection::Perspective { .. } => Projection::Orthographic,
            Projection::Orthographic => Projection::Perspective { vertical_fov_rad: FOV_RAD },
        };
    }

    /// Where the camera is, or will be in a moment.
    fn going_to(&self) -> OrbitCamera {
        self.glide.map_or(self.camera, |glide| glide.end())
    }

    fn glide_to(&mut self, camera: OrbitCamera, state: &EditorState) {
        if state.settings.reduced_motion {
            self.camera = camera;
            self.glide = None;
        } else {
            self.glide = Some(Glide::new(self.camera, camera));
        }
    }

    /// A step over the floor, as the camera sees it; along the nearest axis, so that it can be
    /// taken back.
    fn nudge_m(&self, nudge: Nudge) -> [f64; 3] {
        const COARSE_M: f64 = 0.1;
        const FINE_M: f64 = 0.01;
        let step = if nudge.is_fine { FINE_M } else { COARSE_M };
        let right = self.camera.world_from_view_rotation() * Vec3::X;
        let right = match right.x.abs() >= right.z.abs() {
            true => [f64::from(right.x.signum()), 0.0],
            false => [0.0, f64::from(right.z.signum())],
        };
        // Away is a quarter turn to the left of what is right.
        let away = [right[1], -right[0]];
        let (way, sign) = match nudge.to {
            Side::Right => (right, step),
            Side::Left => (right, -step),
            Side::Away => (away, step),
            Side::Near => (away, -step),
        };
        [way[0] * sign, 0.0, way[1] * sign]
    }

    /// A small step in the plane of the picture: a centimetre, or a millimetre.
    fn nudge_in_view_m(&self, nudge: Nudge) -> Vec3 {
        let step_m = if nudge.is_fine { 0.001 } else { 0.01 };
        let way = match nudge.to {
            Side::Left => Vec3::NEG_X,
            Side::Right => Vec3::X,
            Side::Away => Vec3::Y,
            Side::Near => Vec3::NEG_Y,
        };
        self.camera.world_from_view_rotation() * way * step_m
    }

    /// The whole panel.
    pub fn ui(&mut self, ui: &mut Ui, state: &mut EditorState) {
        let whole = ui.available_size().max(Vec2::splat(1.0));
        let size = compare::size_of_main(whole, compare::n_views(state));
        let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, LABEL));
        self.rect = rect;
        self.is_over = response.contains_pointer() || response.dragged();
        self.measure_fps(ui, state);
        let corner = Pos2::new(rect.right() - GIZMO_INSET_PT, rect.top() + GIZMO_INSET_PT);
        let taken = [gizmo::room(corner), toggles_room(rect)];
        let sight = Sight { camera: self.camera, rect };
        let claim = if self.flight.is_some() {
            Claim { button: true, wheel: true, click: true }
        } else {
            self.gesture.ui(ui, &response, &sight, &taken, state)
        };
        self.navigate_ui(ui, &response, claim, state);
        self.keep_up(ui, state);
        self.draw_ui(ui, rect, state);
        let whole = Rect::from_min_size(rect.min, whole);
        if let Some(canvas) = &mut self.canvas {
            compare::others_ui(ui, whole, canvas, &mut self.camera, state);
        }
        self.pick_ui(ui, &response, claim, state);
        overlay::overlay_ui(ui, rect, state, self.fps);
        self.gesture.overlay_ui(ui, &Sight { camera: self.camera, rect }, state);
        match gizmo::gizmo_ui(ui, corner, &mut self.camera) {
            Some(Clicked::View(view)) => self.look_from(view, state),
            Some(Clicked::Middle) => self.toggle_perspective(),
            Some(Clicked::Dragged) => self.glide = None,
            None => {}
        }
        toggles_ui(ui, rect, state);
        if let Some(at) = self.pie
            && !pie::pie_ui(ui, at, rect, state)
        {
            self.pie = None;
        }
    }

    /// The mouse and a flight move the camera.
    fn navigate_ui(
        &mut self,
        ui: &Ui,
        response: &egui::Response,
        claim: Claim,
        state: &mut EditorState,
    ) {
        let scheme = state.settings.navigation;
        let begins = scheme == Navigation::Industry
            && response.drag_started_by(egui::PointerButton::Secondary)
            && !ui.input(|input| input.modifiers.alt);
        if begins && self.flight.is_none() {
            self.flight = Some(Fly::begin(ui.ctx(), &self.camera, true));
        }
        if let Some(flight) = self.flight {
            self.glide = None;
            state.settings.follow = false;
            match flight.ui(ui, &mut self.camera, &mut self.fly_speed_m_s) {
                Flight::Goes => {}
                Flight::Landed => self.land(ui.ctx()),
                Flight::Cancelled => {
                    self.camera = flight.before();
                    self.land(ui.ctx());
                }
            }
            return;
        }
        let moved = navigation::navigate_ui(ui, response, &mut self.camera, scheme, claim);
        if moved.any {
            self.glide = None;
        }
        if moved.across {
            state.settings.follow = false;
        }
    }

    fn measure_fps(&mut self, ui: &Ui, state: &EditorState) {
        const NEW: f32 = 0.1;
        let dt = ui.input(|input| input.unstable_dt).max(1e-4);
        self.fps = state.is_playing().then(|| {
            let now = 1.0 / dt;
            self.fps.map_or(now, |fps| fps + (now - fps) * NEW)
        });
    }

    /// Glides, frames and follows.
    fn keep_up(&mut self, ui: &Ui, state: &mut EditorState) {
        if std::mem::take(&mut state.is_new_scene) {
            self.wanted = Some(Wanted::First);
        }
        if let Some(mut glide) = self.glide {
            let (camera, has_arrived) = glide.advance(ui.input(|input| input.stable_dt));
            self.camera = camera;
            self.glide = (!has_arrived).then_some(glide);
            ui.ctx().request_repaint();
        }
        if state.stage.actors.is_empty() {
            return;
        }
        if let Some(wanted) = self.wanted
            && let Some(room) = wanted.room(state)
        {
            let mut camera = self.going_to();
            camera.frame(&room, Viewport::new(self.rect.width(), self.rect.height()), MARGIN);
            self.wanted = None;
            if wanted == Wanted::First {
                self.camera = camera;
            } else {
                self.glide_to(camera, state);
                ui.ctx().request_repaint();
            }
        }
        let active = state.stage.actors.get(state.session.active().0);
        let root = active.map(|actor| actor.root_at_m(state.frame()));
        let here = root.filter(|_| state.settings.follow);
        let target_m = self.camera.target_m;
        if let (Some(before), Some(now)) = (self.followed_m, here) {
            self.camera.target_m += (now - before).with_y(0.0);
        } else if let Some(now) = here {
            self.camera.target_m = now.with_y(target_m.y);
        }
        if here.is_some() && self.camera.target_m != target_m {
            self.glide = None;
        }
        self.followed_m = here;
    }

    fn draw_ui(&mut self, ui: &Ui, rect: Rect, state: &EditorState) {
        let pixels_per_point = ui.ctx().pixels_per_point();
        let ghost = self.gesture.ghost(state);
        let Some(canvas) = &mut self.canvas else { return };
        let scene = match show::staged(state, ghost) {
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
    fn pick_ui(
        &mut self,
        ui: &Ui,
        response: &egui::Response,
        claim: Claim,
        state: &mut EditorState,
    ) {
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
        if claim.click {
            return;
        }
        if response.clicked() {
            let is_adding = ui.input(|input| input.modifiers.shift);
            select(state, is_adding);
        }
        if response.double_clicked() && state.settings.tool == Tool::Select {
            let is_body = matches!(state.hovered, Some(PickTarget::Actor { .. }));
            if is_body && ui.input(|input| input.modifiers.alt) {
                state.settings.follow = !state.settings.follow;
                return;
            }
            let room = state.hovered.and_then(|target| frame_on::target(target, state));
            self.wanted = Some(room.map_or(Wanted::All, Wanted::Room));
        }
    }
}

/// The tools.
const TOGGLES: [(&str, UiCommand); 7] = [
    (icons::SELECT, UiCommand::SelectTool),
    (icons::CHECKPOINT, UiCommand::CheckpointTool),
    (icons::JOINT_TARGET, UiCommand::JointTargetTool),
    (icons::POSE, UiCommand::PoseTool),
    (icons::PATH, UiCommand::PathTool),
    (icons::OBSTACLE, UiCommand::ObstacleTool),
    (icons::HAND, UiCommand::ByHandTool),
];

fn toggles_room(rect: Rect) -> Rect {
    let width = theme::ICON_BUTTON;
    let top = rect.top() + 2.0 * GIZMO_INSET_PT + 8.0;
    let left = rect.right() - GIZMO_INSET_PT - 0.5 * width;
    let height = TOGGLES.len() as f32 * (width + theme::GRID) - theme::GRID;
    Rect::from_min_size(Pos2::new(left, top), Vec2::new(width, height))
}

fn toggles_ui(ui: &mut Ui, rect: Rect, state: &mut EditorState) {
    let place = toggles_room(rect);
    let plate = theme::of(ui).panel.gamma_multiply(0.8);
    ui.painter().rect_filled(place.expand(2.0), f32::from(theme::RADIUS), plate);
    let mut column = ui.new_child(egui::UiBuilder::new().max_rect(place));
    for (icon, command) in TOGGLES {
        let is_on = command.is_on(state).unwrap_or_default();
        let tooltip = described(command);
        if icon_button_ui(&mut column, icon, &command.label(), &tooltip, is_on).clicked() {
            state.ask(command);
        }
    }
}

/// A command's tooltip with its key.
pub fn described(command: UiCommand) -> String {
    match command.shortcut() {
        Some(key) => format!("{} ({})", command.tooltip(), key_text(&key)),
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
