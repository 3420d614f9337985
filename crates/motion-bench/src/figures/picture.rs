//! Drawing: one character, many characters, what is made on the way.

use std::sync::Arc;
use std::time::Instant;

use anyhow::Context as _;
use glam::{Mat4, Vec3};
use motion_bench::stopwatch::{Spent, timed};
use motion_core::ids::ClipId;
use motion_render::gpu::AdapterChoice;
use motion_render::offscreen::Offscreen;
use motion_render::renderer::DrawStats;
use motion_render::view::View;
use motion_scene::body::Look;
use motion_scene::camera::{OrbitCamera, StandardView};
use motion_scene::color::Theme;
use motion_scene::mesh::MeshId;
use motion_scene::scene::Scene;
use motion_session::library_source::builtin_clips;
use motion_session::stage::actor::Actor;
use motion_session::stage::figure::Figure;
use motion_session::stage::standing::set_on_floor;

use super::Bench;
use super::quantile::median;
use crate::table::Row;

/// Pictures that are not counted: the first ones make buffers and compile shaders.
const N_FIRST: usize = 5;
const N_PICTURES: usize = 40;
/// Between characters that stand side by side, metres.
const APART_M: f32 = 1.3;

/// What is drawn, and how fast that must be.
struct Case {
    figure: &'static str,
    target: &'static str,
    target_ms: f64,
    n_bodies: usize,
    size_px: (u32, u32),
    distance_m: f32,
}

const SOFTWARE: [Case; 2] = [
    Case {
        figure: "picture, 1 character",
        target: "30 ms",
        target_ms: 30.0,
        n_bodies: 1,
        size_px: (1280, 720),
        distance_m: 4.5,
    },
    Case {
        figure: "picture, 50 characters",
        target: "150 ms",
        target_ms: 150.0,
        n_bodies: 50,
        size_px: (1280, 720),
        distance_m: 14.0,
    },
];
const REAL: Case = Case {
    figure: "picture, 1000 characters",
    target: "4 ms",
    target_ms: 4.0,
    n_bodies: 1000,
    size_px: (1920, 1080),
    distance_m: 60.0,
};

/// Draws walking mannequins with shadows, each in another pose, a new pose in every picture.
pub(crate) fn measure(_: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let clips = builtin_clips()?.set;
    let walk = clips.by_id("walk").context("the built-in library walks")?;
    let (actor, building) = actor(&clips, walk);
    let mut rows = vec![mannequin_row(&actor, building)];
    let mut software = match Offscreen::new(AdapterChoice::Software) {
        Ok(software) => software,
        Err(error) => {
            rows[0].notes.push(format!("pictures: {error}"));
            return Ok(rows);
        }
    };
    for case in &SOFTWARE {
        rows.push(case.measure(&mut software, &actor)?);
    }
    let mut real = Offscreen::new(AdapterChoice::Any)?;
    if !real.gpu().is_software() {
        rows.push(REAL.measure(&mut real, &actor)?);
    }
    Ok(rows)
}

fn actor(clips: &motion_core::clip::ClipSet, walk: ClipId) -> (Actor, Spent) {
    let skeleton = clips.skeleton().clone();
    let standing = set_on_floor(&skeleton, clips.clip(walk).motion.clone(), None);
    let motion = standing.motion;
    let (figure, building) =
        timed(|| Figure::mannequin(MeshId(1), &skeleton, Some(&motion), standing.soles));
    let actor = Actor {
        name: "A".to_owned(),
        figure: Arc::new(figure),
        skeleton: Arc::new(skeleton),
        motion: Arc::new(motion),
        look: Look::neutral(Theme::Dark),
    };
    (actor, building)
}

fn mannequin_row(actor: &Actor, building: Spent) -> Row {
    let levels = actor.figure.model.levels().iter();
    let triangles: Vec<String> = levels.map(|l| l.triangles().len().to_string()).collect();
    let secs = building.wall.as_secs_f64();
    Row {
        figure: "mannequin".to_owned(),
        target: "0.5 s",
        measured: format!("{secs:.2} s"),
        is_met: secs < 0.5,
        spent: building,
        notes: vec![format!("{} triangles by level", triangles.join(", "))],
    }
}

impl Case {
    fn measure(&self, offscreen: &mut Offscreen, actor: &Actor) -> anyhow::Result<Row> {
        offscreen.set_model(actor.figure.mesh, &actor.figure.model);
        let mut walls_ms = Vec::with_capacity(N_PICTURES);
        let mut before: Option<DrawStats> = None;
        let mut last: Option<DrawStats> = None;
        let (done, spent) = timed(|| -> anyhow::Result<()> {
            for nth in 0..N_FIRST + N_PICTURES {
                let (scene, view) = (self.scene(actor, nth), self.view());
                let start = Instant::now();
                let stats = offscreen.draw_only(&scene, &view)?;
                if nth >= N_FIRST {
                    walls_ms.push(start.elapsed().as_secs_f64() * 1e3);
                    last = Some(stats);
                } else {
                    before = Some(stats);
                }
            }
            Ok(())
        });
        done?;
        let (before, last) = before.zip(last).context("pictures were drawn")?;
        let made = last.created != before.created;
        let ms = median(&walls_ms);
        let best = walls_ms.iter().copied().fold(f64::INFINITY, f64::min);
        let all = (N_FIRST + N_PICTURES) as f64;
        Ok(Row {
            figure: self.figure.to_owned(),
            target: self.target,
            measured: format!("{ms:.1} ms"),
            is_met: ms <= self.target_ms && !made,
            spent,
            notes: vec![
                format!(
                    "{}, {} × {}, MSAA 4×, shadows; median of {N_PICTURES}, best {best:.1} ms, \
                     {:.1} ms of processor time each",
                    offscreen.adapter_name(),
                    self.size_px.0,
                    self.size_px.1,
                    spent.cpu.as_secs_f64() * 1e3 / all,
                ),
                format!(
                    "{} triangles of bodies in {} draws; made on the device in steady state: {}",
                    last.n_body_triangles,
                    last.n_body_batches,
                    if made { "SOMETHING" } else { "nothing" },
                ),
            ],
        })
    }

    fn view(&self) -> View {
        let middle = Vec3::new(0.0, 0.9, 0.0);
        View {
            camera: OrbitCamera::standard(StandardView::ThreeQuarter, middle, self.distance_m),
            width_px: self.size_px.0,
            height_px: self.size_px.1,
            pixels_per_point: 1.0,
        }
    }

    fn scene(&self, actor: &Actor, nth: usize) -> Scene {
        let mut scene = Scene::empty(Theme::Dark);
        let side = (self.n_bodies as f32).sqrt().ceil() as usize;
        for idx in 0..self.n_bodies {
            let frame = (3 * nth + 7 * idx) % actor.n_frames();
            let mut body = actor.body_at(frame as f64, actor.look);
            let place = |i: usize| (i as f32 - 0.5 * (side as f32 - 1.0)) * APART_M;
            let to = Vec3::new(place(idx % side), 0.0, place(idx / side));
            let shift = to - actor.root_at_m(frame as f64).with_y(0.0);
            let shift = Mat4::from_translation(shift);
            body.world_from_joint.iter_mut().for_each(|world| *world = shift * *world);
            scene.bodies.push(body);
        }
        scene
    }
}
