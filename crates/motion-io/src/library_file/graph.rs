//! The graph of a library file: sections `metric`, `edges` and `components`.

use motion_core::clip::ClipSet;
use motion_core::graph::forest::ForestParts;
use motion_core::graph::{ClipPair, Connectivity, Forest, MotionGraph};
use motion_core::ids::{ClipId, JointIdx};
use motion_core::similarity::{Column, ColumnSource, Metric};

use crate::bytes::{ByteReader, ByteWriter, Fault};
use crate::container::{Container, ContainerWriter};
use crate::diagnostic::FileError;
use crate::limits::MAX_JOINTS;

/// What a column measures, beside joints from 0.
const TORSO_VELOCITY: u32 = u32::MAX;
const TORSO_TURN: u32 = u32::MAX - 1;
/// No frame: a clip that is in no cycle.
const NO_FRAME: u32 = u32::MAX;

/// Adds the sections of `graph`.
pub(super) fn add_graph(container: &mut ContainerWriter, graph: &MotionGraph) {
    let mut metric = ByteWriter::new();
    metric.f64(graph.tau);
    metric.u32(graph.min_jump);
    metric.u32(graph.metric.columns.len() as u32);
    for column in &graph.metric.columns {
        metric.str(&column.name);
        metric.u32(match column.source {
            ColumnSource::Joint(joint) => joint.0,
            ColumnSource::TorsoVelocity => TORSO_VELOCITY,
            ColumnSource::TorsoTurn => TORSO_TURN,
        });
        metric.f64(column.weight);
        metric.f64(column.derivative_weight);
    }
    metric.f64_slice(&graph.metric.change);
    metric.f64_slice(&graph.metric.derivative_change);
    container.add("metric", metric.into_bytes());

    let ForestParts { from_frames, to_frames, costs, n_leaves, pairs } = graph.forest.to_parts();
    let mut edges = ByteWriter::new();
    edges.u32_slice(&from_frames);
    edges.u32_slice(&to_frames);
    edges.f32_slice(&costs);
    edges.u32_slice(&n_leaves);
    edges.u32(pairs.len() as u32);
    for pair in &pairs {
        let nodes = [pair.first_node, pair.first_bridge, pair.end_node];
        for value in [pair.from.0, pair.to.0].into_iter().chain(nodes) {
            edges.u32(value);
        }
    }
    container.add("edges", edges.into_bytes());

    let mut components = ByteWriter::new();
    for connectivity in [&graph.by_tau, &graph.with_bridges] {
        components.u32(connectivity.n_parts);
        components.u32_slice(&connectivity.part_of_clip);
        components.u32_slice(&connectivity.dead_from);
        components.u32_slice(&connectivity.reachable_from);
        for core in &connectivity.core {
            let (first, last) = core.unwrap_or((NO_FRAME, NO_FRAME));
            components.u32(first);
            components.u32(last);
        }
    }
    container.add("components", components.into_bytes());
}

/// Reads what [`add_graph`] wrote, for the clips of the same file.
pub(super) fn read_graph(
    container: &Container<'_>,
    clips: &ClipSet,
) -> Result<MotionGraph, FileError> {
    let clip_frames: Vec<u32> = clips.clips().iter().map(|clip| clip.n_frames() as u32).collect();
    let n_joints = clips.skeleton().n_joints();
    let (tau, min_jump, metric) = container.section("metric", |r| read_metric(r, n_joints))?;
    let parts = container.section("edges", read_forest_parts)?;
    let forest = container.checked("edges", Forest::from_parts(parts, &clip_frames))?;
    let [by_tau, with_bridges] = container.section("components", |reader| {
        Ok([read_connectivity(reader, &clip_frames)?, read_connectivity(reader, &clip_frames)?])
    })?;
    Ok(MotionGraph { metric, tau, min_jump, clip_frames, forest, by_tau, with_bridges })
}

fn read_metric(reader: &mut ByteReader<'_>, n_joints: usize) -> Result<(f64, u32, Metric), Fault> {
    let tau = reader.f64()?;
    if !(tau > 0.0 && tau.is_finite()) {
        return Err(Fault::Value("threshold"));
    }
    let min_jump = reader.u32()?;
    let n_columns = reader.u32()? as usize;
    if n_columns > MAX_JOINTS + 2 {
        return Err(Fault::Value("number of columns"));
    }
    let mut columns = Vec::with_capacity(n_columns);
    for _ in 0..n_columns {
        let name = reader.str()?.to_owned();
        let source = match reader.u32()? {
            TORSO_VELOCITY => ColumnSource::TorsoVelocity,
            TORSO_TURN => ColumnSource::TorsoTurn,
            joint if (joint as usize) < n_joints => ColumnSource::Joint(JointIdx(joint)),
            _ => return Err(Fault::Value("joint of a column")),
        };
        let (weight, derivative_weight) = (reader.f64()?, reader.f64()?);
        if !are_weights(&[weight, derivative_weight]) {
            return Err(Fault::Value("weight of a column"));
        }
        columns.push(Column { name, source, weight, derivative_weight });
    }
    let metric =
        Metric { columns, change: reader.f64_vec()?, derivative_change: reader.f64_vec()? };
    let are_normalisers =
        |list: &[f64]| list.len() == n_columns && are_weights(list) && !list.contains(&0.0);
    if !are_normalisers(&metric.change) || !are_normalisers(&metric.derivative_change) {
        return Err(Fault::Value("list of normalisers"));
    }
    Ok((tau, min_jump, metric))
}

fn are_weights(values: &[f64]) -> bool {
    values.iter().all(|value| value.is_finite() && *value >= 0.0)
}

fn read_forest_parts(reader: &mut ByteReader<'_>) -> Result<ForestParts, Fault> {
    /// Two clips and three nodes.
    const PAIR_BYTES: usize = 5 * 4;
    let from_frames = reader.u32_vec()?;
    let to_frames = reader.u32_vec()?;
    let costs = reader.f32_vec()?;
    let n_leaves = reader.u32_vec()?;
    let n_pairs = reader.u32()? as usize;
    if n_pairs.saturating_mul(PAIR_BYTES) > reader.rest().len() {
        return Err(Fault::Length);
    }
    let mut pairs = Vec::with_capacity(n_pairs);
    for _ in 0..n_pairs {
        pairs.push(ClipPair {
            from: ClipId(reader.u32()?),
            to: ClipId(reader.u32()?),
            first_node: reader.u32()?,
            first_bridge: reader.u32()?,
            end_node: reader.u32()?,
        });
    }
    Ok(ForestParts { from_frames, to_frames, costs, n_leaves, pairs })
}

fn read_connectivity(
    reader: &mut ByteReader<'_>,
    clip_frames: &[u32],
) -> Result<Connectivity, Fault> {
    let n_parts = reader.u32()?;
    let part_of_clip = reader.u32_vec()?;
    let dead_from = reader.u32_vec()?;
    let reachable_from = reader.u32_vec()?;
    let n_clips = clip_frames.len();
    let are_frames = |list: &[u32]| {
        list.len() == n_clips && list.iter().zip(clip_frames).all(|(frame, n)| frame <= n)
    };
    let are_parts = part_of_clip.len() == n_clips
        && n_parts as usize <= n_clips
        && part_of_clip.iter().all(|&part| part < n_parts);
    if !are_parts || !are_frames(&dead_from) || !are_frames(&reachable_from) {
        return Err(Fault::Value("list of components"));
    }
    let mut core = Vec::with_capacity(n_clips);
    for &n_frames in clip_frames {
        core.push(match (reader.u32()?, reader.u32()?) {
            (NO_FRAME, NO_FRAME) => None,
            (first, last) if first <= last && last < n_frames => Some((first, last)),
            _ => return Err(Fault::Value("cycle of a clip")),
        });
    }
    Ok(Connectivity { part_of_clip, n_parts, dead_from, reachable_from, core })
}
