//! A scene drawn to a texture with the window's own device. The only file that knows wgpu.

use std::collections::BTreeMap;
use std::sync::Arc;

use egui::{Pos2, Rect, TextureId, Vec2};
use egui_wgpu::RenderState;
use egui_wgpu::wgpu::FilterMode;
use motion_render::gpu::Gpu;
use motion_render::picking::Picker;
use motion_render::renderer::Renderer;
use motion_render::targets::Targets;
use motion_render::view::View;
use motion_scene::body::PickId;
use motion_scene::camera::OrbitCamera;
use motion_scene::mesh::{BodyModel, MeshId};
use motion_scene::scene::Scene;

/// What draws the view. It draws only when scene, camera or size differ from the last time.
pub struct Canvas {
    state: RenderState,
    renderer: Renderer,
    picker: Picker,
    /// The main view, in which things are picked.
    main: Option<Drawing>,
    /// Views beside the main one.
    beside: Vec<Drawing>,
    models: BTreeMap<MeshId, Arc<BodyModel>>,
    /// How many pictures of the main view were drawn.
    n_drawn: u64,
    /// Whether a question to the picker has no answer yet.
    is_asking: bool,
}

/// A view with what it shows.
struct Drawing {
    targets: Targets,
    texture: TextureId,
    drawn: Option<(Scene, View)>,
}

impl Canvas {
    /// A canvas on the window's device. `ctx` is woken when the device is lost.
    pub fn new(state: &RenderState, ctx: &egui::Context) -> Self {
        let ctx = ctx.clone();
        let wake = move || ctx.request_repaint();
        let (device, queue) = (state.device.clone(), state.queue.clone());
        let gpu = Gpu::from_parts(device, queue, &state.adapter.get_info(), wake);
        Self {
            state: state.clone(),
            renderer: Renderer::new(&gpu),
            picker: Picker::new(&gpu),
            main: None,
            beside: Vec::new(),
            models: BTreeMap::new(),
            n_drawn: 0,
            is_asking: false,
        }
    }

    /// What draws, for a person.
    pub fn adapter_name(&self) -> &str {
        self.renderer.gpu().adapter_name()
    }

    /// Whether the device is gone.
    pub fn is_lost(&self) -> bool {
        let gpu = self.renderer.gpu();
        // Loss is told by a callback that only polling calls.
        let _polled = gpu.device().poll(egui_wgpu::wgpu::PollType::Poll);
        gpu.is_lost()
    }

    /// Waits until the device has done what it was given, or has gone over it.
    pub fn wait_for_device(&self) {
        let forever = egui_wgpu::wgpu::PollType::wait_indefinitely();
        let _polled = self.renderer.gpu().device().poll(forever);
    }

    /// Destroys the device, as a driver's fault would.
    pub fn destroy_device(&self) {
        self.renderer.gpu().device().destroy();
    }

    /// How many pictures were drawn so far.
    pub fn n_drawn(&self) -> u64 {
        self.n_drawn
    }

    /// Makes a model known, unless it is already.
    pub fn set_model(&mut self, id: MeshId, model: &Arc<BodyModel>) {
        if self.models.get(&id).is_some_and(|known| Arc::ptr_eq(known, model)) {
            return;
        }
        self.renderer.set_model(id, model);
        self.models.insert(id, Arc::clone(model));
        self.main.iter_mut().chain(&mut self.beside).for_each(|view| view.drawn = None);
    }

    /// Draws `scene` as large as `size_pt`, and gives the picture.
    pub fn draw(
        &mut self,
        scene: Scene,
        camera: OrbitCamera,
        size_pt: Vec2,
        pixels_per_point: f32,
    ) -> TextureId {
        let view = view_of(camera, size_pt, pixels_per_point);
        let old = self.main.take();
        let (drawing, is_new) = self.brought_to(old, scene, view);
        self.n_drawn += u64::from(is_new);
        self.main.insert(drawing).texture
    }

    /// Draws `scene` for the view number `nth` beside the main one (from 0), which has to come after
    /// the one before it. Nothing is picked in it.
    pub fn draw_beside(
        &mut self,
        nth: usize,
        scene: Scene,
        camera: OrbitCamera,
        size_pt: Vec2,
        pixels_per_point: f32,
    ) -> TextureId {
        let view = view_of(camera, size_pt, pixels_per_point);
        let old = (nth < self.beside.len()).then(|| self.beside.remove(nth));
        let (drawing, _) = self.brought_to(old, scene, view);
        let texture = drawing.texture;
        self.beside.insert(nth.min(self.beside.len()), drawing);
        texture
    }

    /// A view that shows `scene`: the `old` one where its size is right. Gives whether anything had
    /// to be drawn for it.
    fn brought_to(&mut self, old: Option<Drawing>, scene: Scene, view: View) -> (Drawing, bool) {
        let size_px = (view.width_px, view.height_px);
        let mut drawing = match old {
            Some(drawing) if drawing.targets.size_px() == size_px => drawing,
            old => {
                let (targets, texture) = self.resized(old.map(|old| old.texture), &view);
                Drawing { targets, texture, drawn: None }
            }
        };
        let shows = |(drawn, from): &(Scene, View)| *drawn == scene && *from == view;
        let is_new = !drawing.drawn.as_ref().is_some_and(shows);
        if is_new {
            self.renderer.draw(&scene, &view, &mut drawing.targets);
            drawing.drawn = Some((scene, view));
        }
        (drawing, is_new)
    }

    /// Lets go of the views beside the main one past the first `n`. To be called before anything of
    /// this frame is painted.
    pub fn keep_beside(&mut self, n: usize) {
        let gone: Vec<TextureId> =
            self.beside.drain(n.min(self.beside.len())..).map(|b| b.texture).collect();
        gone.into_iter().for_each(|texture| self.free(texture));
    }

    /// A picture that is drawn once and kept; whoever has it gives it back to [`Self::free`].
    pub fn still(
        &mut self,
        scene: &Scene,
        camera: OrbitCamera,
        size_pt: Vec2,
        pixels_per_point: f32,
    ) -> TextureId {
        let view = view_of(camera, size_pt, pixels_per_point);
        let (mut targets, texture) = self.resized(None, &view);
        self.renderer.draw(scene, &view, &mut targets);
        texture
    }

    /// Lets go of a picture that nothing of this frame paints.
    pub fn free(&self, texture: TextureId) {
        self.state.renderer.write().free_texture(&texture);
    }

    fn resized(&self, texture: Option<TextureId>, view: &View) -> (Targets, TextureId) {
        let targets = Targets::new(self.renderer.gpu(), view.width_px, view.height_px);
        let picture = targets.picture().create_view(&Default::default());
        let mut egui = self.state.renderer.write();
        let device = &self.state.device;
        // The picture has as many pixels as its place: nothing lies between two of them.
        let texture = match texture {
            Some(texture) => {
                let filter = FilterMode::Nearest;
                egui.update_egui_texture_from_wgpu_texture(device, &picture, filter, texture);
                texture
            }
            None => egui.register_native_texture(device, &picture, FilterMode::Nearest),
        };
        (targets, texture)
    }

    /// Asks what is under a place of the picture that was drawn last, unless an answer is still
    /// waited for. Nothing waits here; [`Self::picked`] has the answer in a later frame.
    pub fn ask(&mut self, at: Pos2, rect: Rect) {
        let Some((scene, view)) = self.main.as_ref().and_then(|main| main.drawn.as_ref()) else {
            return;
        };
        if self.is_asking {
            return;
        }
        let px = (at - rect.min) * view.pixels_per_point;
        self.picker.ask(&mut self.renderer, scene, view, glam::Vec2::new(px.x, px.y));
        self.is_asking = true;
    }

    /// Whether a question has no answer yet.
    pub fn is_asking(&self) -> bool {
        self.is_asking
    }

    /// The answer, once: `Some(None)` for nothing.
    pub fn picked(&mut self) -> Option<Option<PickId>> {
        if !self.is_asking {
            return None;
        }
        let answer = self.picker.poll(self.renderer.gpu());
        self.is_asking = answer.is_none();
        answer
    }
}

fn view_of(camera: OrbitCamera, size_pt: Vec2, pixels_per_point: f32) -> View {
    let px = |pt: f32| (pt * pixels_per_point).round().max(1.0) as u32;
    View { camera, width_px: px(size_pt.x), height_px: px(size_pt.y), pixels_per_point }
}
