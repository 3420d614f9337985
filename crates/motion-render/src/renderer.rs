//! The order of drawing.

use glam::Mat4;
use motion_scene::bounds::Bounds;
use motion_scene::mesh::{BodyModel, MeshId};
use motion_scene::scene::Scene;

use crate::frame_uniform::FrameUniform;
use crate::gpu::{Created, Gpu};
use crate::mesh_cache::MeshCache;
use crate::primitive::flats::Flats;
use crate::primitive::ground::GroundPlane;
use crate::primitive::ground_shade::GroundShade;
use crate::primitive::labels::Labels;
use crate::primitive::lines::Lines;
use crate::primitive::outline::Outline;
use crate::primitive::skinned_mesh::SkinnedMeshes;
use crate::primitive::sky::Sky;
use crate::primitive::solids::{Solids, corners_m};
use crate::shadow::ShadowFit;
use crate::shared_bindings::SharedBindings;
use crate::targets::Targets;
use crate::view::View;

/// Draws scenes on one device.
///
/// It holds pipelines, uploaded models and buffers that grow to what pictures need; a scene is
/// turned into buffers anew for every picture, and drawn in this order:
///
/// 1. the key light's view of what stops light, into the shadow map;
/// 2. what is outlined, into a mask, if anything is;
/// 3. the picture: bodies, solids, floor (near things first, so that little is drawn twice), what
///    darkens the floor, sky, flat marks, lines, see-through solids, ghosts, and over all of it
///    lines that nothing hides, outlines and words.
#[derive(Debug)]
pub struct Renderer {
    gpu: Gpu,
    shared: SharedBindings,
    meshes: MeshCache,
    bodies: SkinnedMeshes,
    solids: Solids,
    ground: GroundPlane,
    ground_shade: GroundShade,
    sky: Sky,
    flats: Flats,
    lines: Lines,
    outline: Outline,
    labels: Labels,
}

/// What a picture took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawStats {
    /// Triangles of bodies, shadows and marks apart.
    pub n_body_triangles: u64,
    /// Draws of bodies, shadows and marks apart; each is of all bodies of a model and level.
    pub n_body_batches: usize,
    /// What has been made on the device so far.
    pub created: Created,
}

impl Renderer {
    /// A renderer on a device, without models.
    pub fn new(gpu: &Gpu) -> Self {
        let shared = SharedBindings::new(gpu);
        let meshes = MeshCache::new(gpu);
        Self {
            bodies: SkinnedMeshes::new(gpu, &shared, &meshes),
            solids: Solids::new(gpu, &shared),
            ground: GroundPlane::new(gpu, &shared),
            ground_shade: GroundShade::new(gpu, &shared),
            sky: Sky::new(gpu, &shared),
            flats: Flats::new(gpu, &shared),
            lines: Lines::new(gpu, &shared),
            outline: Outline::new(gpu, &shared),
            labels: Labels::new(gpu, &shared),
            gpu: gpu.clone(),
            meshes,
            shared,
        }
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Makes a model known, in place of one with the same name.
    pub fn set_model(&mut self, id: MeshId, model: &BodyModel) {
        self.meshes.set(&self.gpu, id, model);
    }

    /// Forgets a model; bodies of it are not drawn any more.
    pub fn remove_model(&mut self, id: MeshId) {
        self.meshes.remove(id);
    }

    /// Draws a scene and submits the work. The picture is in [`Targets::picture`] when the device
    /// has done it. The picture's size is the targets'; the view's is not looked at.
    pub fn draw(&mut self, scene: &Scene, view: &View, targets: &mut Targets) -> DrawStats {
        let (width_px, height_px) = targets.size_px();
        let view = View { width_px, height_px, ..*view };
        let fit = ShadowFit::new(
            self.caster_bounds(scene),
            scene.light.towards_key,
            view.camera.target_m,
            self.shared.shadow_px(),
        );
        self.shared.grow_shadow_map(&self.gpu, fit.texture_px);
        let clip_from_world = view.camera.clip_from_world(view.viewport());
        let uniform = FrameUniform::new(scene, &view, clip_from_world, &fit);
        self.shared.frame.write(&self.gpu, &uniform);
        self.shared.light.write(&self.gpu, &FrameUniform::of_light(&fit));
        self.prepare(scene, &view);

        let mut encoder = self
            .gpu
            .device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("scene") });
        self.draw_shadow_map(&mut encoder, &fit);
        let has_outlines = scene.has_emphasis();
        if has_outlines {
            self.draw_mask(&mut encoder, scene, targets);
        }
        self.draw_picture(&mut encoder, scene, targets, has_outlines);
        self.gpu.queue().submit([encoder.finish()]);
        DrawStats {
            n_body_triangles: self.bodies.n_triangles(),
            n_body_batches: self.bodies.n_batches(),
            created: self.gpu.created(),
        }
    }

    /// What holds everything that stops light.
    fn caster_bounds(&self, scene: &Scene) -> Option<Bounds> {
        let bodies =
            scene.bodies.iter().filter(|body| body.casts_shadow()).filter_map(|body| {
                self.meshes.get(body.model)?.model.bounds(&body.world_from_joint)
            });
        let solids = scene.solids.iter().filter(|solid| solid.casts_shadow());
        let solids = solids.filter_map(|solid| Bounds::of_points(&corners_m(solid)));
        bodies.chain(solids).reduce(Bounds::union)
    }

    fn prepare(&mut self, scene: &Scene, view: &View) {
        self.bodies.prepare(&self.gpu, &self.meshes, scene, view);
        self.solids.prepare(&self.gpu, scene);
        self.ground_shade.prepare(&self.gpu, &self.meshes, scene);
        self.flats.prepare(&self.gpu, scene);
        self.lines.prepare(&self.gpu, scene, view.pixels_per_point);
        self.labels.prepare(&self.gpu, scene, view);
    }

    fn draw_shadow_map(&self, encoder: &mut wgpu::CommandEncoder, fit: &ShadowFit) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow map"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.shared.shadow_view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        let size = fit.size_px as f32;
        pass.set_viewport(0.0, 0.0, size, size, 0.0, 1.0);
        pass.set_bind_group(0, &self.shared.light.group, &[]);
        self.bodies.draw_shadow(&mut pass, &self.meshes);
        self.solids.draw_shadow(&mut pass);
    }

    fn draw_mask(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene,
        targets: &mut Targets,
    ) {
        let (mask, is_new) = targets.mask(&self.gpu);
        self.outline.prepare(&self.gpu, scene, is_new.then_some(&mask.resolved));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("mask"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &mask.samples,
                depth_slice: None,
                resolve_target: Some(&mask.resolved),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Discard,
                },
            })],
            depth_stencil_attachment: None,
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_bind_group(0, &self.shared.frame.group, &[]);
        pass.set_bind_group(1, &self.shared.shadow_group, &[]);
        self.bodies.draw_mask(&mut pass, &self.meshes);
        self.solids.draw_mask(&mut pass);
    }

    fn draw_picture(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene,
        targets: &Targets,
        has_outlines: bool,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &targets.color_samples,
                depth_slice: None,
                resolve_target: Some(&targets.color_resolved),
                ops: self.color_ops(),
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_bind_group(0, &self.shared.frame.group, &[]);
        pass.set_bind_group(1, &self.shared.shadow_group, &[]);
        self.bodies.draw_solid(&mut pass, &self.meshes);
        self.solids.draw_opaque(&mut pass);
        if scene.ground.is_some() {
            self.ground.draw(&mut pass);
            self.ground_shade.draw(&mut pass);
        }
        self.sky.draw(&mut pass);
        self.flats.draw(&mut pass);
        self.lines.draw_hidden(&mut pass);
        self.solids.draw_see_through(&mut pass);
        self.bodies.draw_ghosts(&mut pass, &self.meshes);
        self.lines.draw_shown(&mut pass);
        if has_outlines {
            self.outline.draw(&mut pass);
        }
        self.labels.draw(&mut pass);
    }

    /// Every pixel is drawn over, so what was there does not matter: a graphics card is quickest
    /// when it need not fetch it, a processor when it need not clear it.
    fn color_ops(&self) -> wgpu::Operations<wgpu::Color> {
        if self.gpu.is_software() {
            wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store }
        } else {
            wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                store: wgpu::StoreOp::Discard,
            }
        }
    }

    /// Draws names into a small target that shows a part of the picture. The scene's buffers are
    /// those of the last picture unless it is prepared again.
    pub(crate) fn draw_ids(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene,
        view: &View,
        part_from_clip: Mat4,
        target: &crate::picking::IdTarget,
    ) {
        let fit = ShadowFit::new(None, scene.light.towards_key, view.camera.target_m, 0);
        let clip_from_world = part_from_clip * view.camera.clip_from_world(view.viewport());
        let uniform = FrameUniform::new(scene, view, clip_from_world, &fit);
        self.shared.pick.write(&self.gpu, &uniform.with_viewport_px(target.size_px as f32));
        self.prepare(scene, view);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("names"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target.ids_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &target.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_bind_group(0, &self.shared.pick.group, &[]);
        pass.set_bind_group(1, &self.shared.shadow_group, &[]);
        self.bodies.draw_ids(&mut pass, &self.meshes);
        self.solids.draw_ids(&mut pass);
        self.flats.draw_ids(&mut pass);
        self.lines.draw_ids(&mut pass);
    }
}
