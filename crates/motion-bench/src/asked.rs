//! Project files as search problems, with every kind of constraint: what the figures of the search are
//! measured on.

use std::path::Path;

use anyhow::Context as _;
use glam::{DVec2, DVec3, Vec2, Vec3};
use motion_core::clip::ClipSet;
use motion_core::constraint::{
    BodyConstraint, FollowConstraint, JointConstraint, LengthMode, LengthWish, LockConstraint,
    Obstacle, PoseConstraint, StyleConstraint, Tolerance,
};
use motion_core::path::Piece;
use motion_core::score::Wishes;
use motion_core::search::Problem;
use motion_core::units::FrameIdx;
use motion_io::diagnostic::Warnings;
use motion_io::project_file::{self, Character, Constraint, ConstraintKind, PathHeading, Shape};

/// The sample that asks for what cannot be.
const IMPOSSIBLE: &str = "09";

/// A problem and what it is called.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The project's number, and the character's name where there are several: `01`, `10B`.
    pub name: String,
    /// What is asked.
    pub problem: Problem,
}

/// Every character of every project in `folder`, in the order of their names, but for the impossible
/// one. Characters are asked for one by one: each keeps to its own wishes.
pub fn load_all(folder: &Path, clips: &ClipSet) -> anyhow::Result<Vec<Asked>> {
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "gaitway") {
            paths.push(path);
        }
    }
    paths.sort();
    let mut all = Vec::new();
    for path in paths {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let number = stem.split('-').next().unwrap_or_default().to_owned();
        if number == IMPOSSIBLE {
            continue;
        }
        let project = project_file::load(&path, &mut Warnings::new())?;
        let obstacles: Vec<Obstacle> =
            project.obstacles.iter().map(|obstacle| solid(&obstacle.shape)).collect();
        for character in &project.characters {
            let wishes = wishes(character, clips, &obstacles).with_context(|| stem.clone())?;
            let allowed_clips = vec![true; clips.clips().len()];
            let problem = Problem { wishes, allowed_clips, bridges: true };
            let alone = project.characters.len() == 1;
            let name = if alone { number.clone() } else { number.clone() + &character.name };
            all.push(Asked { name, problem });
        }
    }
    Ok(all)
}

/// A point on the ground of a file.
fn ground(position_m: [f64; 2]) -> Vec2 {
    DVec2::from(position_m).as_vec2()
}

/// A place or a size of a file.
fn space(position_m: [f64; 3]) -> Vec3 {
    DVec3::from(position_m).as_vec3()
}

fn radians(heading_deg: f64) -> f32 {
    heading_deg.to_radians() as f32
}

fn wishes(
    character: &Character,
    clips: &ClipSet,
    obstacles: &[Obstacle],
) -> anyhow::Result<Wishes> {
    let mut wishes = Wishes { obstacles: obstacles.to_vec(), ..Wishes::default() };
    if let Some(length) = &character.length {
        let mode = match length.mode {
            project_file::LengthMode::Free => LengthMode::Free,
            project_file::LengthMode::Preferred => LengthMode::Preferred,
            project_file::LengthMode::Exact => LengthMode::Exact,
        };
        let weight = length.weight.unwrap_or(1.0) as f32;
        wishes.length = length.frames.map(|frames| LengthWish { frames, mode, weight });
    }
    for constraint in &character.constraints {
        add(&mut wishes, constraint, clips)?;
    }
    wishes.body.sort_by_key(|wish| wish.frame);
    Ok(wishes)
}

fn add(wishes: &mut Wishes, constraint: &Constraint, clips: &ClipSet) -> anyhow::Result<()> {
    let weight = constraint.weight.unwrap_or(1.0) as f32;
    let clip_id = |name: &str| clips.by_id(name).with_context(|| format!("no clip is {name}"));
    match &constraint.kind {
        ConstraintKind::Body { frame, position_m, heading_deg, height_m } => {
            let mut tolerance = Tolerance::default();
            if heading_deg.is_none() {
                tolerance.heading_rad = f32::INFINITY;
            }
            wishes.body.push(BodyConstraint {
                frame: *frame,
                position_m: ground(*position_m),
                heading_rad: radians(heading_deg.unwrap_or_default()),
                height_m: height_m.map(|height| height as f32),
                weight,
                tolerance,
            });
        }
        ConstraintKind::Joint { frame, joint, position_m, velocity_m_s } => {
            let found = clips.skeleton().find(joint);
            let joint = found.with_context(|| format!("no joint is {joint}"))?;
            let velocity_m_s = velocity_m_s.map(space);
            let wish = JointConstraint::new(*frame, joint, space(*position_m));
            wishes.joints.push(JointConstraint { velocity_m_s, weight, ..wish });
        }
        ConstraintKind::Pose { frame, clip, clip_frame, position_m, heading_deg, height_m } => {
            let wish = PoseConstraint::new(*frame, clip_id(clip)?, FrameIdx(*clip_frame));
            wishes.poses.push(PoseConstraint {
                ground_m: position_m.map(ground),
                heading_rad: heading_deg.map(radians),
                height_m: height_m.map(|height| height as f32),
                weight,
                ..wish
            });
        }
        ConstraintKind::Style { from, to, tag } => {
            let (from, to, tag) = (*from, *to, tag.clone());
            wishes.styles.push(StyleConstraint {
                from,
                to,
                tag,
                weight,
                by_hand: Default::default(),
            });
        }
        ConstraintKind::Path { from, to, points_m, heading } => {
            let points_m = points_m.iter().copied().map(ground).collect();
            wishes.follows.push(FollowConstraint {
                weight,
                looks_along: *heading == PathHeading::Along,
                ..FollowConstraint::new(*from, *to, points_m)
            });
        }
        ConstraintKind::Lock { from, to, pieces } => {
            let pieces = pieces.iter().map(|piece| {
                let clip = clip_id(&piece.clip)?;
                Ok(Piece { clip, from: FrameIdx(piece.from), to: FrameIdx(piece.to) })
            });
            let pieces = pieces.collect::<anyhow::Result<_>>()?;
            wishes.locks.push(LockConstraint { from: *from, to: *to, pieces });
        }
    }
    Ok(())
}

fn solid(shape: &Shape) -> Obstacle {
    match *shape {
        Shape::Box { center_m, size_m, heading_deg } => Obstacle::Box {
            center_m: space(center_m),
            size_m: space(size_m),
            heading_rad: radians(heading_deg),
        },
        Shape::Cylinder { center_m, radius_m, height_m } => Obstacle::Cylinder {
            center_m: space(center_m),
            radius_m: radius_m as f32,
            height_m: height_m as f32,
        },
        Shape::Ceiling { center_m, size_m: [x, _, z], heading_deg } => Obstacle::Ceiling {
            center_m: space(center_m),
            size_m: ground([x, z]),
            heading_rad: radians(heading_deg),
        },
    }
}
