//! From a [`Project`] to JSON: known keys in a fixed order, unknown ones behind them.

use serde_json::{Map, Value, json};

use super::FORMAT_VERSION;
use super::model::{
    Character, Constraint, ConstraintKind, Extra, Hashes, Interaction, Length, LengthMode,
    Obstacle, Palette, PathHeading, Placement, Project, Search, Shape, Tolerance,
};
use super::tags::encode_tags;

/// An object under construction.
#[derive(Default)]
struct Members(Map<String, Value>);

impl Members {
    fn put(&mut self, key: &str, value: impl Into<Value>) {
        self.0.insert(key.to_owned(), value.into());
    }

    fn put_some(&mut self, key: &str, value: Option<impl Into<Value>>) {
        if let Some(value) = value {
            self.put(key, value);
        }
    }

    fn put_list<T>(&mut self, key: &str, list: &[T], encode: impl Fn(&T) -> Value) {
        if !list.is_empty() {
            self.put(key, list.iter().map(encode).collect::<Vec<_>>());
        }
    }

    fn with(mut self, extra: &Extra) -> Value {
        for (key, value) in extra {
            self.0.entry(key.clone()).or_insert_with(|| value.clone());
        }
        Value::Object(self.0)
    }
}

pub(super) fn encode_project(project: &Project) -> Value {
    let mut members = Members::default();
    members.put("gaitway", FORMAT_VERSION);
    members.put("name", project.name.as_str());
    members.put_some("about", project.about.as_deref());
    members.put("fps", project.fps);
    members.put("library", project.library.as_str());
    members.put_some("hashes", project.hashes.as_ref().map(encode_hashes));
    members.put_some("palette", project.palette.as_ref().map(encode_palette));
    if !project.tags.is_empty() {
        members.put("tags", encode_tags(&project.tags));
    }
    members.put("characters", project.characters.iter().map(encode_character).collect::<Vec<_>>());
    members.put_list("interactions", &project.interactions, encode_interaction);
    members.put_list("obstacles", &project.obstacles, encode_obstacle);
    members.put("search", encode_search(&project.search));
    members.put_some("editor", project.editor.clone());
    members.with(&project.extra)
}

fn encode_hashes(hashes: &Hashes) -> Value {
    let mut members = Members::default();
    members.put_some("library", hashes.library.as_deref());
    let clips: Map<String, Value> =
        hashes.clips.iter().map(|(clip, hash)| (clip.clone(), json!(hash))).collect();
    if !clips.is_empty() {
        members.put("clips", clips);
    }
    members.with(&hashes.extra)
}

fn encode_palette(palette: &Palette) -> Value {
    let mut members = Members::default();
    members.put("include", palette.include.as_slice());
    members.put("exclude", palette.exclude.as_slice());
    members.put("tags", palette.tags.as_slice());
    members.with(&palette.extra)
}

fn encode_character(character: &Character) -> Value {
    let mut members = Members::default();
    members.put("name", character.name.as_str());
    members.put_some("length", character.length.as_ref().map(encode_length));
    members.put_some("body", character.body.as_deref());
    members.put_some("library", character.library.as_deref());
    let constraints: Vec<Value> = character.constraints.iter().map(encode_constraint).collect();
    members.put("constraints", constraints);
    members.with(&character.extra)
}

fn encode_length(length: &Length) -> Value {
    let mut members = Members::default();
    members.put_some("frames", length.frames);
    // Left out where it is what leaving out means, as people write it.
    let mode = Some(length.mode).filter(|&mode| mode != LengthMode::default());
    members.put_some("mode", mode.map(LengthMode::name));
    members.put_some("weight", length.weight);
    members.with(&length.extra)
}

fn encode_constraint(constraint: &Constraint) -> Value {
    let mut members = Members::default();
    members.put("id", constraint.id.as_str());
    members.put("kind", constraint.kind.name());
    match &constraint.kind {
        ConstraintKind::Body { frame, position_m, heading_deg, height_m } => {
            members.put("frame", *frame);
            members.put("position", position_m.as_slice());
            members.put_some("heading", *heading_deg);
            members.put_some("height", *height_m);
        }
        ConstraintKind::Joint { frame, joint, position_m, velocity_m_s } => {
            members.put("frame", *frame);
            members.put("joint", joint.as_str());
            members.put("position", position_m.as_slice());
            members.put_some("velocity", velocity_m_s.as_ref().map(<[f64; 3]>::as_slice));
        }
        ConstraintKind::Pose { frame, clip, clip_frame, position_m, heading_deg, height_m } => {
            members.put("frame", *frame);
            members.put("clip", clip.as_str());
            members.put("clip_frame", *clip_frame);
            members.put_some("position", position_m.as_ref().map(<[f64; 2]>::as_slice));
            members.put_some("heading", *heading_deg);
            members.put_some("height", *height_m);
        }
        ConstraintKind::Style { from, to, tag } => {
            members.put("from", *from);
            members.put("to", *to);
            members.put("tag", tag.as_str());
        }
        ConstraintKind::Path { from, to, points_m, heading } => {
            members.put("from", *from);
            members.put("to", *to);
            members.put("points", points_m.iter().map(|p| json!(p)).collect::<Vec<_>>());
            // Left out where it is what leaving out means, as people write it.
            let heading = Some(*heading).filter(|&heading| heading != PathHeading::default());
            members.put_some("heading", heading.map(PathHeading::name));
        }
        ConstraintKind::Lock { from, to, pieces } => {
            members.put("from", *from);
            members.put("to", *to);
            let pieces = pieces.iter().map(|piece| {
                let mut members = Members::default();
                members.put("clip", piece.clip.as_str());
                members.put("from", piece.from);
                members.put("to", piece.to);
                members.with(&piece.extra)
            });
            members.put("pieces", pieces.collect::<Vec<_>>());
        }
    }
    members.put_some("weight", constraint.weight);
    members.put_some("tolerance", constraint.tolerance.as_ref().map(encode_tolerance));
    members.with(&constraint.extra)
}

fn encode_tolerance(tolerance: &Tolerance) -> Value {
    if let Tolerance { position_m: Some(position_m), heading_deg: None, frames: None, extra } =
        tolerance
        && extra.is_empty()
    {
        return json!(position_m);
    }
    let mut members = Members::default();
    members.put_some("position", tolerance.position_m);
    members.put_some("heading", tolerance.heading_deg);
    members.put_some("frames", tolerance.frames);
    members.with(&tolerance.extra)
}

fn encode_interaction(interaction: &Interaction) -> Value {
    let mut members = Members::default();
    members.put("id", interaction.id.as_str());
    members.put("frame", interaction.frame);
    members.put_some("weight", interaction.weight);
    members.put_list("members", &interaction.members, |member| {
        let mut members = Members::default();
        members.put("character", member.character.as_str());
        members.put("clip", member.clip.as_str());
        members.put("clip_frame", member.clip_frame);
        members.with(&member.extra)
    });
    members.put_list("relative", &interaction.relative, encode_placement);
    members.with(&interaction.extra)
}

fn encode_placement(placement: &Placement) -> Value {
    let mut members = Members::default();
    members.put("position", placement.position_m.as_slice());
    members.put("heading", placement.heading_deg);
    members.with(&placement.extra)
}

fn encode_obstacle(obstacle: &Obstacle) -> Value {
    let mut members = Members::default();
    match &obstacle.shape {
        Shape::Box { center_m, size_m, heading_deg } => {
            members.put("shape", "box");
            members.put("center", center_m.as_slice());
            members.put("size", size_m.as_slice());
            members.put("heading", *heading_deg);
        }
        Shape::Cylinder { center_m, radius_m, height_m } => {
            members.put("shape", "cylinder");
            members.put("center", center_m.as_slice());
            members.put("radius", *radius_m);
            members.put("height", *height_m);
        }
        Shape::Ceiling { center_m, size_m, heading_deg } => {
            members.put("shape", "ceiling");
            members.put("center", center_m.as_slice());
            members.put("size", size_m.as_slice());
            members.put("heading", *heading_deg);
        }
    }
    members.with(&obstacle.extra)
}

fn encode_search(search: &Search) -> Value {
    let mut members = Members::default();
    members.put("seed", search.seed);
    members.put("alternatives", search.alternatives);
    members.put_some("tau", search.tau);
    members.put_some("mirror", search.mirror);
    members.put_some("bridges", search.bridges);
    if !search.weights.is_empty() {
        let weights = search.weights.iter().map(|(term, weight)| (term.clone(), json!(weight)));
        members.put("weights", weights.collect::<Map<_, _>>());
    }
    members.with(&search.extra)
}
