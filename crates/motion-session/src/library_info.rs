//! What `library info` says.

use std::fmt::Write as _;

use motion_core::clip::Clip;
use motion_core::graph::{BuildOptions, Connectivity};
use motion_core::ids::ClipId;
use serde::Serialize;

use crate::Library;

/// What is in a library.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LibraryInfo {
    /// Version of this document.
    pub gaitway: u32,
    /// Hash of the content, where the library is a file.
    pub hash: Option<String>,
    /// Frames per second.
    pub fps: f64,
    /// Joints, parents before children.
    pub joints: Vec<String>,
    /// How many clips.
    pub clips: usize,
    /// Frames of all clips.
    pub frames: usize,
    /// Cuts cheaper than this are edges.
    pub tau: f64,
    /// Cuts within a clip jump at least so many frames.
    pub min_jump_frames: u32,
    /// What the cost of a cut is made of.
    pub metric: MetricInfo,
    /// Leaf edges under τ.
    pub edges: usize,
    /// How many of them leave a frame at most; `None` where all are kept.
    pub edges_per_frame: Option<usize>,
    /// Edges of the coarsest level.
    pub coarse_edges: usize,
    /// Edges in use at each level, the coarsest first.
    pub edges_per_level: Vec<usize>,
    /// Cuts above τ that join what τ leaves apart.
    pub bridges: usize,
    /// Parts that cannot reach each other: clips by edges in use, bridges included.
    pub components: u32,
    /// The same with edges under τ alone.
    pub components_by_tau: u32,
    /// Clips in the largest part by τ alone.
    pub largest_component_clips: usize,
    /// Frames from which the main part cannot be reached any more.
    pub dead_end_frames: usize,
    /// Where those begin.
    pub dead_ends: Vec<DeadEnd>,
    /// Bytes that the library takes in memory.
    pub memory_bytes: usize,
    /// Every clip.
    pub clip_list: Vec<ClipInfo>,
    /// How long it took, when it was just built.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub build: Option<BuildTimes>,
}

/// The metric: one entry for each column in every list (`docs/metric.md`).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MetricInfo {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Weights of the columns.
    #[serde(rename = "M")]
    pub m: Vec<f64>,
    /// Weights of their derivatives.
    #[serde(rename = "W")]
    pub w: Vec<f64>,
    /// Normalisers of the columns.
    #[serde(rename = "O")]
    pub o: Vec<f64>,
    /// Normalisers of their derivatives.
    #[serde(rename = "L")]
    pub l: Vec<f64>,
}

/// A clip that leads nowhere from some frame on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeadEnd {
    /// The clip.
    pub clip: String,
    /// The first frame from which the main part cannot be reached.
    pub from: u32,
    /// How many frames that are.
    pub frames: u32,
}

/// A clip in a list.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClipInfo {
    /// Its id.
    pub id: String,
    /// How many frames.
    pub frames: usize,
    /// How long, seconds.
    pub seconds: f64,
    /// Words for what happens in it.
    pub tags: Vec<String>,
    /// Hash of the file that it came from.
    pub hash: String,
    /// The part it belongs to by τ alone; 0 is the largest.
    pub component: u32,
}

/// Seconds that the parts of a build took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BuildTimes {
    /// Reading and understanding files.
    pub import_s: f64,
    /// Features, edges, levels and bridges.
    pub graph_s: f64,
    /// Writing the library.
    pub save_s: f64,
}

impl LibraryInfo {
    /// What is in `library`.
    pub fn new(library: &Library, build: Option<BuildTimes>) -> Self {
        let (clips, graph) = (&library.clips, &library.graph);
        let fps = clips.fps();
        let per_level = graph.forest.edges_per_level();
        let bridges: usize = graph.forest.pairs().iter().map(|p| p.bridge_nodes().len()).sum();
        let in_use = &graph.with_bridges;
        let clip_info = |(idx, clip): (usize, &Clip)| ClipInfo {
            id: clip.id.clone(),
            frames: clip.n_frames(),
            seconds: fps.duration_secs(clip.n_frames()),
            tags: clip.tags.clone(),
            hash: library.content_hashes[idx].to_string(),
            component: graph.by_tau.part_of_clip[idx],
        };
        let rule = BuildOptions::default();
        let is_large = clips.n_frames() > rule.all_edges_until_frames;
        let metric = &graph.metric;
        let of_columns = |value: fn(&motion_core::similarity::Column) -> f64| {
            metric.columns.iter().map(value).collect()
        };
        Self {
            gaitway: 1,
            hash: library.hash.map(|hash| hash.to_string()),
            fps: fps.get(),
            joints: clips.skeleton().joints().iter().map(|joint| joint.name.clone()).collect(),
            clips: clips.clips().len(),
            frames: clips.n_frames(),
            tau: graph.tau,
            min_jump_frames: graph.min_jump,
            metric: MetricInfo {
                columns: metric.columns.iter().map(|column| column.name.clone()).collect(),
                m: of_columns(|column| column.weight),
                w: of_columns(|column| column.derivative_weight),
                o: metric.change.clone(),
                l: metric.derivative_change.clone(),
            },
            edges: per_level.last().map_or(0, |all| all.saturating_sub(bridges)),
            edges_per_frame: is_large.then_some(rule.edges_per_frame),
            coarse_edges: per_level.first().map_or(0, |all| all.saturating_sub(bridges)),
            edges_per_level: per_level,
            bridges,
            components: in_use.n_parts,
            components_by_tau: graph.by_tau.n_parts,
            largest_component_clips: graph.by_tau.part_of_clip.iter().filter(|&&p| p == 0).count(),
            dead_end_frames: in_use.n_dead_frames(&graph.clip_frames),
            dead_ends: dead_ends(library, in_use),
            memory_bytes: memory_bytes(library),
            clip_list: clips.clips().iter().enumerate().map(clip_info).collect(),
            build,
        }
    }

    /// The same for people. With `all`, every clip has a line.
    pub fn text(&self, all: bool) -> String {
        let mut out = String::new();
        let seconds: f64 = self.clip_list.iter().map(|clip| clip.seconds).sum();
        let mut line = |name: &str, value: String| {
            // Writing to a string cannot fail.
            let _ok = writeln!(out, "{name:<18} {value}");
        };
        line("clips", format!("{}, {:.1} minutes", self.clips, seconds / 60.0));
        line("frames", format!("{} at {} per second", self.frames, self.fps));
        line("skeleton", format!("{} joints, root {}", self.joints.len(), self.joints[0]));
        line("τ", format!("{:.4}", self.tau));
        line("edges", format!("{}, {} at the coarsest level", self.edges, self.coarse_edges));
        if let Some(most) = self.edges_per_frame {
            line("edges kept", format!("{most} a frame at most: local minima, then the cheapest"));
        }
        let levels: Vec<String> = self.edges_per_level.iter().map(ToString::to_string).collect();
        line("edges per level", levels.join(" "));
        line(
            "components",
            format!(
                "{} by τ alone ({} clips in the largest), {} with bridges",
                self.components_by_tau, self.largest_component_clips, self.components
            ),
        );
        line("bridges", self.bridges.to_string());
        let per_cent = 100.0 * self.dead_end_frames as f64 / self.frames.max(1) as f64;
        line("dead ends", format!("{} frames ({per_cent:.1} %)", self.dead_end_frames));
        line("memory", format!("{:.1} MB", self.memory_bytes as f64 / 1e6));
        if let Some(build) = self.build {
            line(
                "build",
                format!(
                    "import {:.2} s, graph {:.2} s, save {:.2} s",
                    build.import_s, build.graph_s, build.save_s
                ),
            );
        }
        if let Some(hash) = &self.hash {
            line("hash", hash.clone());
        }
        if all {
            out.push('\n');
            self.write_tables(&mut out);
        }
        out
    }

    fn write_tables(&self, out: &mut String) {
        let _ok = writeln!(out, "{:<24} {:>8} {:>8} {:>12} {:>12}", "column", "M", "W", "O", "L");
        for (k, name) in self.metric.columns.iter().enumerate() {
            let MetricInfo { m, w, o, l, .. } = &self.metric;
            let _ok = writeln!(
                out,
                "{name:<24} {:>8.3} {:>8.3} {:>12.4e} {:>12.4e}",
                m[k], w[k], o[k], l[k]
            );
        }
        let _ok =
            writeln!(out, "\n{:<24} {:>7} {:>9} {:>9}", "clip", "frames", "seconds", "component");
        for clip in &self.clip_list {
            let _ok = writeln!(
                out,
                "{:<24} {:>7} {:>9.2} {:>9}  {}",
                clip.id,
                clip.frames,
                clip.seconds,
                clip.component,
                clip.tags.join(" ")
            );
        }
    }
}

fn dead_ends(library: &Library, connectivity: &Connectivity) -> Vec<DeadEnd> {
    let clip_frames = &library.graph.clip_frames;
    clip_frames
        .iter()
        .zip(&connectivity.dead_from)
        .enumerate()
        .filter(|(_, (n_frames, from))| from < n_frames)
        .map(|(clip, (&n_frames, &from))| DeadEnd {
            clip: library.clips.clip(ClipId::from_idx(clip)).id.clone(),
            from,
            frames: n_frames - from,
        })
        .collect()
}

/// What the arrays take; names and the like are left out.
fn memory_bytes(library: &Library) -> usize {
    let clips = &library.clips;
    let per_frame = 16 * clips.skeleton().n_joints() + 12 + 16 + 2;
    let n_nodes = library.graph.forest.n_nodes();
    clips.n_frames() * per_frame + n_nodes * 16 + library.graph.forest.pairs().len() * 20
}
