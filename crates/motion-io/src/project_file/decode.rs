//! From JSON to a [`Project`], checking everything on the way.

use std::collections::HashSet;

use motion_core::units::Fps;

use super::constraint::decode_constraints;
use super::model::{
    Character, Hashes, Interaction, Length, LengthMode, Member, Obstacle, Palette, Placement,
    Project, Search, Shape,
};
use super::{FORMAT_VERSION, names, tags};
use crate::diagnostic::{FileError, quoted};
use crate::json::{Node, Object};
use crate::limits::{
    MAX_ABS_PLACE_M, MAX_ALTERNATIVES, MAX_CHARACTERS, MAX_LIST, MAX_PROJECT_FRAMES,
};

/// Headings may be written with many turns, but not with so many that digits are lost.
pub(super) const MAX_HEADING_DEG: f64 = 1e6;
/// Largest weight, tolerance or threshold.
pub(super) const MAX_WEIGHT: f64 = 1e9;
/// Terms of the score that have a weight.
const TERMS: [&str; 9] = [
    "continuity",
    "length",
    "body",
    "joint",
    "pose",
    "style",
    "path",
    "environment",
    "interaction",
];

pub(super) fn decode_project(root: Node<'_>) -> Result<Project, FileError> {
    let mut object = root.object()?;
    check_version(&mut object)?;
    let name = match object.get("name") {
        Some(node) => node.string()?,
        None => String::new(),
    };
    let about = object.get("about").map(|node| node.string()).transpose()?;
    let fps = match object.get("fps") {
        Some(node) => {
            let fps = node.number(f64::MAX)?;
            Fps::new(fps)
                .map_err(|bad| node.error(format!("is {}", bad.0), "use a rate from 1 to 1000"))?
                .get()
        }
        None => Fps::THIRTY.get(),
    };
    let library = match object.get("library") {
        Some(node) => node.name()?,
        None => "builtin".to_owned(),
    };
    let hashes = object.get("hashes").map(decode_hashes).transpose()?;
    let palette = object.get("palette").map(decode_palette).transpose()?;
    let tags = object.get("tags").map(tags::decode_tags).transpose()?.unwrap_or_default();
    let node = object.require("characters", "[{\"name\": \"A\", \"constraints\": []}]")?;
    let characters = decode_characters(&node)?;
    let interactions = match object.get("interactions") {
        Some(node) => decode_interactions(&node, &characters)?,
        None => Vec::new(),
    };
    let obstacles = match object.get("obstacles") {
        Some(node) => {
            node.array(MAX_LIST)?.into_iter().map(decode_obstacle).collect::<Result<_, _>>()?
        }
        None => Vec::new(),
    };
    let search = object.get("search").map(decode_search).transpose()?.unwrap_or_default();
    let editor = object.get("editor").map(|node| node.value().clone());
    Ok(Project {
        name,
        about,
        fps,
        library,
        hashes,
        palette,
        tags,
        characters,
        interactions,
        obstacles,
        search,
        editor,
        extra: object.rest(),
    })
}

fn check_version(object: &mut Object<'_>) -> Result<(), FileError> {
    let Some(node) = object.get("gaitway") else {
        return Err(object.node.error(
            "has no \"gaitway\"",
            format!("check that it is the right file, or add \"gaitway\": {FORMAT_VERSION}"),
        ));
    };
    let version = node.whole_number(u32::MAX)?;
    if version > FORMAT_VERSION {
        return Err(node.error(
            format!("is version {version}, newer than the {FORMAT_VERSION} that is known here"),
            "open it with a newer Gaitway",
        ));
    }
    if version == 0 {
        return Err(node.error("is version 0", format!("write {FORMAT_VERSION}")));
    }
    Ok(())
}

fn decode_hashes(node: Node<'_>) -> Result<Hashes, FileError> {
    let mut object = node.object()?;
    let library = object.get("library").map(|node| node.string()).transpose()?;
    let clips = match object.get("clips") {
        Some(node) => node
            .object()?
            .members()
            .into_iter()
            .map(|(clip, hash)| Ok((clip.to_owned(), hash.string()?)))
            .collect::<Result<_, FileError>>()?,
        None => Vec::new(),
    };
    Ok(Hashes { library, clips, extra: object.rest() })
}

fn decode_palette(node: Node<'_>) -> Result<Palette, FileError> {
    let mut object = node.object()?;
    let mut list = |key| match object.get(key) {
        Some(node) => node.strings(MAX_LIST).map(Some),
        None => Ok(None),
    };
    let include = list("include")?.unwrap_or_else(|| vec!["*".to_owned()]);
    let exclude = list("exclude")?.unwrap_or_default();
    let tags = list("tags")?.unwrap_or_default();
    Ok(Palette { include, exclude, tags, extra: object.rest() })
}

fn decode_characters(list: &Node<'_>) -> Result<Vec<Character>, FileError> {
    let nodes = list.array(MAX_CHARACTERS)?;
    if nodes.is_empty() {
        return Err(list.error("is empty", "add a character: {\"name\": \"A\"}"));
    }
    // Files are named after characters, and not every file system tells A from a.
    let mut names = HashSet::new();
    let mut characters = Vec::with_capacity(nodes.len());
    for node in nodes {
        let mut object = node.object()?;
        let name_node = object.require("name", "\"A\"")?;
        let name = name_node.name()?;
        if let Some(fault) = names::fault_as_file_name(&name) {
            return Err(name_node.error(
                format!("is {}, which {fault}", quoted(name.as_bytes())),
                "files are named after it: use letters, digits, blanks, - and _",
            ));
        }
        if !names.insert(name.to_lowercase()) {
            return Err(name_node.error(
                format!("is {} again", quoted(name.as_bytes())),
                "give every character its own name",
            ));
        }
        let length = object.get("length").map(decode_length).transpose()?;
        let body = object.get("body").map(|node| node.name()).transpose()?;
        let library = object.get("library").map(|node| node.name()).transpose()?;
        let constraints = match object.get("constraints") {
            Some(node) => decode_constraints(&node, length.as_ref())?,
            None => Vec::new(),
        };
        let extra = object.rest();
        characters.push(Character { name, length, body, library, constraints, extra });
    }
    Ok(characters)
}

fn decode_length(node: Node<'_>) -> Result<Length, FileError> {
    let mut object = node.object()?;
    let mode = match object.get("mode") {
        Some(node) => {
            let name = node.string()?;
            let known = LengthMode::ALL.into_iter().find(|(known, _)| *known == name);
            known
                .ok_or_else(|| {
                    node.error(
                        format!("is {}", quoted(name.as_bytes())),
                        "write \"free\", \"preferred\" or \"exact\"",
                    )
                })?
                .1
        }
        None => LengthMode::default(),
    };
    let frames = match object.get("frames") {
        Some(node) => {
            // A number of frames may be the limit itself.
            let frames = node.whole_number(MAX_PROJECT_FRAMES + 1)?;
            if frames == 0 {
                return Err(node.error("is 0", "a motion has at least 1 frame"));
            }
            Some(frames)
        }
        None if mode == LengthMode::Free => None,
        None => return Err(object.node.error("has no \"frames\"", "add \"frames\": 240")),
    };
    let weight = object.get("weight").map(|n| n.number_from_zero(MAX_WEIGHT)).transpose()?;
    Ok(Length { frames, mode, weight, extra: object.rest() })
}

fn decode_interactions(
    list: &Node<'_>,
    characters: &[Character],
) -> Result<Vec<Interaction>, FileError> {
    let mut interactions = Vec::new();
    let mut ids = names::Ids::default();
    for node in list.array(MAX_LIST)? {
        let mut object = node.object()?;
        let id = ids.read(&mut object)?;
        let frame = object.require("frame", "90")?.whole_number(MAX_PROJECT_FRAMES)?;
        let weight = object.get("weight").map(|n| n.number_from_zero(MAX_WEIGHT)).transpose()?;
        let members_node = object.require("members", "[{\"character\": \"A\", …}]")?;
        let members = members_node
            .array(MAX_CHARACTERS)?
            .into_iter()
            .map(|node| decode_member(node, characters))
            .collect::<Result<Vec<_>, _>>()?;
        if members.len() < 2 {
            return Err(members_node.error("has fewer than 2 entries", "name who meets whom"));
        }
        let relative_node =
            object.require("relative", "[{\"position\": [0, 0], \"heading\": 0}]")?;
        let relative = relative_node
            .array(MAX_CHARACTERS)?
            .into_iter()
            .map(decode_placement)
            .collect::<Result<Vec<_>, _>>()?;
        if relative.len() != members.len() {
            return Err(relative_node.error(
                format!("has {} entries for {} members", relative.len(), members.len()),
                "give every member one place",
            ));
        }
        let extra = object.rest();
        interactions.push(Interaction { id, frame, weight, members, relative, extra });
    }
    ids.complete(interactions.iter_mut().map(|i| (&mut i.id, "interaction")));
    Ok(interactions)
}

fn decode_member(node: Node<'_>, characters: &[Character]) -> Result<Member, FileError> {
    let mut object = node.object()?;
    let character_node = object.require("character", "\"A\"")?;
    let character = character_node.name()?;
    if !characters.iter().any(|known| known.name == character) {
        return Err(character_node.error(
            format!("is {}, whom the project does not have", quoted(character.as_bytes())),
            "name one of its characters",
        ));
    }
    let clip = object.require("clip", "\"16_15\"")?.name()?;
    let clip_frame = object.require("clip_frame", "10")?.whole_number(MAX_PROJECT_FRAMES)?;
    Ok(Member { character, clip, clip_frame, extra: object.rest() })
}

fn decode_placement(node: Node<'_>) -> Result<Placement, FileError> {
    let mut object = node.object()?;
    let position_m = object.require("position", "[0, 0]")?.numbers(MAX_ABS_PLACE_M)?;
    let heading_deg = object.require("heading", "0")?.number(MAX_HEADING_DEG)?;
    Ok(Placement { position_m, heading_deg, extra: object.rest() })
}

fn decode_obstacle(node: Node<'_>) -> Result<Obstacle, FileError> {
    let mut object = node.object()?;
    let shape_node = object.require("shape", "\"box\"")?;
    let center_m = object.require("center", "[0, 0.5, 0]")?.numbers(MAX_ABS_PLACE_M)?;
    let shape = match shape_node.string()?.as_str() {
        "box" => Shape::Box {
            center_m,
            size_m: decode_size(&mut object)?,
            heading_deg: heading_or_zero(&mut object)?,
        },
        "cylinder" => Shape::Cylinder {
            center_m,
            radius_m: object.require("radius", "0.4")?.number_from_zero(MAX_ABS_PLACE_M)?,
            height_m: object.require("height", "2")?.number_from_zero(MAX_ABS_PLACE_M)?,
        },
        "ceiling" => Shape::Ceiling {
            center_m,
            size_m: decode_size(&mut object)?,
            heading_deg: heading_or_zero(&mut object)?,
        },
        other => {
            return Err(shape_node.error(
                format!("is {}", quoted(other.as_bytes())),
                "write \"box\", \"cylinder\" or \"ceiling\"",
            ));
        }
    };
    Ok(Obstacle { shape, extra: object.rest() })
}

fn decode_size(object: &mut Object<'_>) -> Result<[f64; 3], FileError> {
    let node = object.require("size", "[1, 1, 1]")?;
    let size = node.numbers(MAX_ABS_PLACE_M)?;
    if size.iter().any(|&edge: &f64| edge < 0.0) {
        return Err(node.error("has an edge below 0", "write lengths of 0 or more"));
    }
    Ok(size)
}

fn heading_or_zero(object: &mut Object<'_>) -> Result<f64, FileError> {
    object.get("heading").map_or(Ok(0.0), |node| node.number(MAX_HEADING_DEG))
}

fn decode_search(node: Node<'_>) -> Result<Search, FileError> {
    let mut object = node.object()?;
    let defaults = Search::default();
    let seed = object.get("seed").map_or(Ok(defaults.seed), |node| node.seed())?;
    let alternatives = match object.get("alternatives") {
        Some(node) => {
            let alternatives = node.whole_number(MAX_ALTERNATIVES + 1)?;
            if alternatives == 0 {
                return Err(node.error("is 0", "ask for at least 1"));
            }
            alternatives
        }
        None => defaults.alternatives,
    };
    let tau = object.get("tau").map(|node| node.number_from_zero(MAX_WEIGHT)).transpose()?;
    let mirror = object.get("mirror").map(|node| node.boolean()).transpose()?;
    let bridges = object.get("bridges").map(|node| node.boolean()).transpose()?;
    let mut weights = Vec::new();
    if let Some(node) = object.get("weights") {
        for (term, weight) in node.object()?.members() {
            if !TERMS.contains(&term) {
                weight.warn("is no term of the score; it is kept");
            }
            weights.push((term.to_owned(), weight.number_from_zero(MAX_WEIGHT)?));
        }
    }
    let extra = object.rest();
    Ok(Search { seed, alternatives, tau, mirror, bridges, weights, extra })
}
