//! An animation as a motion of the file's body.

use ::gltf::json::animation::{Animation, Interpolation, Property};
use ::gltf::json::validation::Checked;
use glam::{DAffine3, DQuat, DVec3};
use motion_core::ids::JointIdx;
use motion_core::motion::Motion;
use motion_core::units::Fps;

use super::body::Body;
use super::document::Document;
use super::nodes::{Nodes, Place, nearest_rotation, quat, vec3};
use crate::diagnostic::{FileError, Warnings, quoted};
use crate::limits::{
    MAX_ACCESSOR_VALUES, MAX_ANIMATION_STEPS, MAX_CLIP_FRAMES, MAX_FRAME_SECS, MAX_LIBRARY_FRAMES,
};

/// A bone that changes its length by more than this share of the body is warned about: 1 cm of a
/// person.
const STRETCH_SHARE: f64 = 0.006;

/// Scales that change by more than this are warned about.
const GROWTH: f64 = 0.01;

/// Rates below this are those of a few key poses, not of samples.
const MIN_SAMPLED_FPS: f64 = 9.9;

/// The animation that a person asked for, by name or by number from 0; the first one otherwise.
///
/// Fails for a file without any and for one that is not there, with the names of those that are.
pub(super) fn choose<'a>(
    document: &'a Document,
    wanted: Option<&str>,
) -> Result<&'a Animation, FileError> {
    let all = &document.root.animations;
    let Some(first) = all.first() else {
        return Err(FileError::new(
            &document.path,
            "there is no animation in the file",
            "export it with its animations",
        ));
    };
    let Some(wanted) = wanted else { return Ok(first) };
    let named = all.iter().find(|animation| animation.name.as_deref() == Some(wanted));
    let numbered = || wanted.parse().ok().and_then(|number: usize| all.get(number));
    named.or_else(numbered).ok_or_else(|| {
        let what = format!("there is no animation {}", quoted(wanted.as_bytes()));
        FileError::new(&document.path, what, format!("choose {}", names(all)))
    })
}

/// `0 "idle", 1 "walk"`, the first twenty.
fn names(all: &[Animation]) -> String {
    const MAX_SHOWN: usize = 20;
    let name = |animation: &Animation| match &animation.name {
        Some(name) => format!(" {}", quoted(name.as_bytes())),
        None => String::new(),
    };
    let shown = all.iter().take(MAX_SHOWN).enumerate();
    let mut shown: Vec<String> =
        shown.map(|(number, animation)| format!("{number}{}", name(animation))).collect();
    if all.len() > MAX_SHOWN {
        shown.push(format!("… {}", all.len() - 1));
    }
    shown.join(", ")
}

/// Samples this close to a key are at it.
const KEY_SLACK_SECS: f64 = 1e-5;

/// Values over time.
pub(super) struct Track {
    pub(super) node: usize,
    interpolation: Interpolation,
    pub(super) secs: Vec<f32>,
    values: Values,
}

/// What a track changes; with cubic interpolation three values a key: the slope before it, the
/// value, the slope after it.
enum Values {
    Translation(Vec<[f32; 3]>),
    Rotation(Vec<[f32; 4]>),
    Scale(Vec<[f32; 3]>),
}

impl Track {
    /// Whether it changes where a node is in its parent's space.
    #[cfg(test)]
    pub(super) fn is_translation(&self) -> bool {
        matches!(self.values, Values::Translation(_))
    }

    fn n_values(&self) -> usize {
        match &self.values {
            Values::Translation(values) | Values::Scale(values) => values.len(),
            Values::Rotation(values) => values.len(),
        }
    }

    /// The key before `secs` (or the first), the one after it (or the last), and how far between
    /// them.
    fn span(&self, secs: f64) -> (usize, usize, f64) {
        // Keys are rounded to f32: a sample that is meant to be at one must not be before it.
        let after = self.secs.partition_point(|&key| f64::from(key) <= secs + KEY_SLACK_SECS);
        let (a, b) = (after.saturating_sub(1), after.min(self.secs.len() - 1));
        let (from, to) = (f64::from(self.secs[a]), f64::from(self.secs[b]));
        let t = if to > from { ((secs - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        (a, b, t)
    }

    /// Components at a time by the track's interpolation; rotations are not yet of unit length.
    fn at<const N: usize>(&self, values: &[[f32; N]], secs: f64) -> [f64; N] {
        let (a, b, t) = self.span(secs);
        let step = f64::from(self.secs[b]) - f64::from(self.secs[a]);
        std::array::from_fn(|i| {
            let value = |at: usize| f64::from(values[at][i]);
            match self.interpolation {
                Interpolation::Step => value(if t >= 1.0 { b } else { a }),
                Interpolation::Linear => value(a) + t * (value(b) - value(a)),
                Interpolation::CubicSpline => {
                    let (t2, t3) = (t * t, t * t * t);
                    (2.0 * t3 - 3.0 * t2 + 1.0) * value(3 * a + 1)
                        + (t3 - 2.0 * t2 + t) * step * value(3 * a + 2)
                        + (3.0 * t2 - 2.0 * t3) * value(3 * b + 1)
                        + (t3 - t2) * step * value(3 * b)
                }
            }
        })
    }

    fn rotation(&self, values: &[[f32; 4]], secs: f64) -> DQuat {
        if !matches!(self.interpolation, Interpolation::Linear) {
            return quat(self.at(values, secs).map(|value| value as f32));
        }
        let (a, b, t) = self.span(secs);
        let (from, to) = (quat(values[a]), quat(values[b]));
        let to = if from.dot(to) < 0.0 { -to } else { to };
        from.slerp(to, t)
    }

    /// Moves a node's place to where it is at a time.
    pub(super) fn apply(&self, place: &mut Place, secs: f64) {
        match &self.values {
            Values::Translation(values) => place.translation = DVec3::from(self.at(values, secs)),
            Values::Rotation(values) => place.rotation = self.rotation(values, secs),
            Values::Scale(values) => place.scale = DVec3::from(self.at(values, secs)),
        }
    }
}

/// The motion of `body` in the file's units and world, rotations relative to its rest pose.
///
/// Samples lie at the file's own rate where its keys have one, else 30 times a second, from the
/// first key to the last.
pub(super) fn motion(
    document: &Document,
    nodes: &Nodes,
    body: &Body,
    animation: &Animation,
    warnings: &mut Warnings,
) -> Result<Motion, FileError> {
    let tracks = tracks(document, animation)?;
    let first = tracks.iter().map(|track| f64::from(track.secs[0])).fold(f64::INFINITY, f64::min);
    let last = tracks.iter().map(|track| f64::from(track.secs[track.secs.len() - 1]));
    let last = last.fold(f64::NEG_INFINITY, f64::max);
    let fps = implied_fps(&tracks);
    if !first.is_finite() || !last.is_finite() {
        return Err(document.error("its animation has no keys"));
    }
    // The slack keeps the last frame of times that were rounded.
    let n_frames = ((last - first) * fps.get() + 1e-3).floor().max(0.0) + 1.0;
    let n_steps = n_frames * (nodes.parents.len() + tracks.len()) as f64;
    let is_long = n_frames > MAX_CLIP_FRAMES as f64 || n_steps > MAX_ANIMATION_STEPS;
    if is_long || n_frames * body.nodes.len() as f64 > (MAX_LIBRARY_FRAMES * 31) as f64 {
        let what = format!("its animation lasts {:.0} s, longer than is read", last - first);
        return Err(FileError::new(&document.path, what, "cut it into several"));
    }
    let n_frames = n_frames as usize;

    let mut is_moved = vec![false; nodes.parents.len()];
    for track in &tracks {
        is_moved[track.node] = true;
    }
    let joints = body.skeleton.joints();
    let rest_from_joint: Vec<DAffine3> =
        body.world_at_rest.iter().map(|rest| rest.inverse()).collect();
    let pivots = rest_from_joint.iter().zip(&body.pivots);
    let pivots: Vec<DVec3> = pivots.map(|(rest, pivot)| rest.transform_point3(*pivot)).collect();
    let mut places = nodes.places.clone();
    let mut positions = Vec::with_capacity(n_frames);
    let mut rotations = Vec::with_capacity(n_frames * joints.len());
    let mut stretch = Stretch::default();
    for frame in 0..n_frames {
        let secs = first + frame as f64 / fps.get();
        for track in &tracks {
            track.apply(&mut places[track.node], secs);
        }
        let world = nodes.world_with(&places, &is_moved);
        let turned: Vec<DQuat> = body
            .nodes
            .iter()
            .zip(&rest_from_joint)
            .map(|(&node, rest)| nearest_rotation(world[node].matrix3 * rest.matrix3))
            .collect();
        for (idx, joint) in joints.iter().enumerate() {
            let place = |joint: usize| world[body.nodes[joint]].transform_point3(pivots[joint]);
            let at = place(idx);
            let Some(parent) = joint.parent.map(JointIdx::idx) else {
                positions.push(at.as_vec3());
                rotations.push(turned[idx].as_quat());
                continue;
            };
            let bone = turned[parent] * joint.offset_m.as_dvec3();
            stretch.note(idx, (at - place(parent)).distance(bone));
            let local: DQuat = turned[parent].inverse() * turned[idx];
            rotations.push(local.normalize().as_quat());
        }
    }
    stretch.warn(document, body, warnings);
    warn_of_growth(document, &tracks, warnings);
    let bad = |_error| document.error("its animation holds what is no motion");
    let n_joints = joints.len();
    Motion::new(fps, n_joints, positions, rotations).map_err(bad)
}

/// The tracks that move nodes, every key checked.
pub(super) fn tracks(document: &Document, animation: &Animation) -> Result<Vec<Track>, FileError> {
    let mut tracks = Vec::new();
    let mut n_values = 0;
    for (number, channel) in animation.channels.iter().enumerate() {
        let bad = |what: &str| document.error(format!("channel {number} of its animation {what}"));
        let node = channel.target.node.value();
        let sampler = animation.samplers.get(channel.sampler.value());
        let sampler = sampler.ok_or_else(|| bad("has no sampler"))?;
        if node >= document.root.nodes.len() {
            return Err(bad("moves no node"));
        }
        let Checked::Valid(interpolation) = sampler.interpolation else {
            return Err(bad("interpolates in no known way"));
        };
        let output = sampler.output.value();
        let values = match channel.target.path {
            Checked::Valid(Property::Translation) => Values::Translation(document.floats(output)?),
            Checked::Valid(Property::Rotation) => Values::Rotation(document.floats(output)?),
            Checked::Valid(Property::Scale) => Values::Scale(document.floats(output)?),
            // Faces and other shapes are no part of a motion.
            Checked::Valid(Property::MorphTargetWeights) => continue,
            Checked::Invalid => return Err(bad("moves an unknown property")),
        };
        let secs: Vec<f32> =
            document.floats::<1>(sampler.input.value())?.into_iter().flatten().collect();
        if secs.windows(2).any(|pair| pair[0] > pair[1]) {
            return Err(bad("goes back in time"));
        }
        let track = Track { node, interpolation, secs, values };
        let per_key = if matches!(interpolation, Interpolation::CubicSpline) { 3 } else { 1 };
        if track.secs.is_empty() || track.n_values() != per_key * track.secs.len() {
            return Err(bad("has other numbers of times than of values"));
        }
        n_values += 4 * track.n_values() + track.secs.len();
        if n_values > MAX_ACCESSOR_VALUES {
            let what = "its animation has more keys than are read";
            return Err(FileError::new(&document.path, what, "cut it into several"));
        }
        tracks.push(track);
    }
    if tracks.is_empty() {
        return Err(FileError::new(
            &document.path,
            "its animation moves nothing",
            "choose another animation, or export it again",
        ));
    }
    Ok(tracks)
}

/// The rate of the track with most keys where they are evenly spaced, else 30.
fn implied_fps(tracks: &[Track]) -> Fps {
    let longest = tracks.iter().max_by_key(|track| track.secs.len());
    let secs = longest.map_or(&[][..], |track| &track.secs);
    if secs.len() < 3 {
        return Fps::THIRTY;
    }
    let (first, last) = (f64::from(secs[0]), f64::from(secs[secs.len() - 1]));
    let step = (last - first) / (secs.len() - 1) as f64;
    let even = secs
        .iter()
        .enumerate()
        .all(|(at, &key)| (f64::from(key) - first - step * at as f64).abs() < 0.05 * step);
    let rate = 1.0 / step;
    let whole = if (rate / rate.round() - 1.0).abs() < 5e-3 { rate.round() } else { rate };
    let usable = even && step < MAX_FRAME_SECS && whole > MIN_SAMPLED_FPS;
    Fps::new(whole).ok().filter(|_| usable).unwrap_or(Fps::THIRTY)
}

/// The bone whose length or place on its parent changes most.
#[derive(Default)]
struct Stretch {
    joint: usize,
    units: f64,
}

impl Stretch {
    fn note(&mut self, joint: usize, units: f64) {
        if units > self.units {
            *self = Self { joint, units };
        }
    }

    fn warn(&self, document: &Document, body: &Body, warnings: &mut Warnings) {
        let positions = body.skeleton.rest_positions_m();
        let reach = positions.iter().map(|at| f64::from(at.length())).fold(0.0, f64::max);
        if self.units > STRETCH_SHARE * 2.0 * reach.max(1e-9) {
            let name = quoted(body.skeleton.joints()[self.joint].name.as_bytes());
            let what = format!(
                "joint {name} leaves its place by up to {:.3} units; joints are turned, not moved, \
                 so it is kept there",
                self.units
            );
            warnings.warn(&document.path, None, what);
        }
    }
}

fn warn_of_growth(document: &Document, tracks: &[Track], warnings: &mut Warnings) {
    let grows = tracks.iter().find(|track| match &track.values {
        Values::Scale(values) => {
            // Of three values a key the middle one is the scale itself.
            let per_key = values.len() / track.secs.len();
            let first = vec3(values[per_key / 2]);
            let spread = |value: &[f32; 3]| (vec3(*value) - first).abs().max_element();
            let keys = values.iter().skip(per_key / 2).step_by(per_key);
            keys.map(spread).fold(0.0, f64::max) > GROWTH * first.abs().max_element().max(1e-6)
        }
        _ => false,
    });
    if let Some(track) = grows {
        let name = document.root.nodes[track.node].name.as_deref().unwrap_or("");
        let name = quoted(name.as_bytes());
        warnings.warn(&document.path, None, format!("{name} changes its size, which is left out"));
    }
}
