//! Skinning against the format's own words, spoilt files, and the characters that are shared with
//! the project, where they are.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use ::gltf::json::mesh::Semantic;
use glam::{DAffine3, DVec3, Vec3};
use motion_core::bind_pose::BindPose;
use motion_core::ids::JointIdx;
use motion_core::retarget::Retarget;
use motion_core::skeleton::JointRole;

use super::body::inverse_binds;
use super::bound::{attribute, influences};
use super::document::Document;
use super::nodes::{Nodes, vec3};
use super::test_file::TestFile;
use super::*;
use crate::diagnostic::Warnings;
use crate::import::{ReadOptions, read_motion_file};

const CHARACTERS: [&str; 4] =
    ["CesiumMan.glb", "RiggedFigure/RiggedFigure.gltf", "greenman.glb", "robot.glb"];

/// A file of the shared folder, or `None` after saying that the test is skipped.
fn shared(name: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let path = root.join(name);
    if !path.is_file() {
        println!("skipped: there is no {}", path.display());
        return None;
    }
    Some(path)
}

fn character(path: &Path) -> Character {
    let mut warnings = Warnings::new();
    let character = read_character(path, &CharacterOptions::default(), &mut warnings)
        .unwrap_or_else(|error| panic!("{error}"));
    for warning in warnings.as_slice() {
        println!("{warning}");
    }
    character
}

fn bounds(points: &[Vec3]) -> (Vec3, Vec3) {
    let fold = |f: fn(Vec3, Vec3) -> Vec3, from| points.iter().copied().fold(from, f);
    (fold(Vec3::min, Vec3::INFINITY), fold(Vec3::max, Vec3::NEG_INFINITY))
}

/// Where a file itself puts the vertices of its character at a time of its first animation, by
/// the format's own words: Σ weight · world of the joint's node · inverse bind matrix; metres.
///
/// Only the node called `root` is moved, the others are turned: that is what a motion can say.
fn twin_m(document: &Document, secs: f64, root: &str, metres_per_unit: f64) -> Vec<Vec3> {
    let nodes = Nodes::new(document).unwrap();
    let mut places = nodes.places.clone();
    let mut is_moved = vec![false; places.len()];
    for track in animation::tracks(document, &document.root.animations[0]).unwrap() {
        let is_root = document.root.nodes[track.node].name.as_deref() == Some(root);
        if is_root || !track.is_translation() {
            is_moved[track.node] = true;
            track.apply(&mut places[track.node], secs);
        }
    }
    let world = nodes.world_with(&places, &is_moved);
    let mut points = Vec::new();
    for (idx, node) in document.root.nodes.iter().enumerate() {
        let Some(mesh) = node.mesh else { continue };
        for primitive in &document.root.meshes[mesh.value()].primitives {
            let positions = attribute(primitive, Semantic::Positions).unwrap();
            let positions = document.floats::<3>(positions).unwrap();
            let matrices: Vec<DAffine3> = match node.skin {
                None => vec![world[idx]],
                Some(skin) => {
                    let binds = inverse_binds(document, skin.value()).unwrap();
                    let joints = document.root.skins[skin.value()].joints.iter();
                    joints.zip(binds).map(|(joint, bind)| world[joint.value()] * bind).collect()
                }
            };
            let rigid = || vec![vec![(0, 1.0)]; positions.len()];
            let bound = influences(document, primitive, positions.len(), matrices.len()).unwrap();
            for (position, bound) in positions.iter().zip(bound.unwrap_or_else(rigid)) {
                let sum: f32 = bound.iter().map(|(_, weight)| weight).sum();
                let at = bound.iter().map(|&(joint, weight)| {
                    let at = matrices[joint as usize].transform_point3(vec3(*position));
                    at * f64::from(weight / sum)
                });
                points.push((at.sum::<DVec3>() * metres_per_unit).as_vec3());
            }
        }
    }
    points
}

/// Largest distance between our skinning of a file's own animation and the file's, metres.
fn worst_against_twin_m(path: &Path) -> f32 {
    let document = Document::new(&std::fs::read(path).unwrap(), path).unwrap();
    let options = CharacterOptions::default();
    let character = read_character(path, &options, &mut Warnings::new()).unwrap();
    let options = ReadOptions { keep_tpose: true, ..ReadOptions::default() };
    let file = read_motion_file(path, &options, &mut Warnings::new()).unwrap();
    assert_eq!(file.skeleton, character.skeleton, "motion and character are one body");
    let tracks = animation::tracks(&document, &document.root.animations[0]).unwrap();
    let first = tracks.iter().map(|track| track.secs[0]).fold(f32::INFINITY, f32::min);
    let (mut positions, mut rotations) = (Vec::new(), Vec::new());
    let mut worst: f32 = 0.0;
    for frame in 0..file.motion.n_frames() {
        let secs = f64::from(first) + frame as f64 / file.motion.fps().get();
        let root = &file.skeleton.joints()[0].name;
        let expected = twin_m(&document, secs, root, character.metres_per_unit);
        file.motion.forward_kinematics(&file.skeleton, frame, &mut positions, &mut rotations);
        let skinned = character.skinned_positions_m(&positions, &rotations);
        assert_eq!(skinned.len(), expected.len());
        let distances = skinned.iter().zip(&expected).map(|(a, b)| a.distance(*b));
        worst = distances.fold(worst, f32::max);
    }
    worst
}

fn saved(file: &TestFile) -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.glb");
    std::fs::File::create(&path).unwrap().write_all(&file.glb()).unwrap();
    (dir, path)
}

#[test]
fn turned_and_scaled_nodes_are_skinned_as_the_format_says() {
    let (_dir, path) = saved(&TestFile::column());
    let worst = worst_against_twin_m(&path);
    assert!(worst < 1e-5, "{worst} m");
}

#[test]
fn the_rest_pose_is_the_one_in_which_the_mesh_was_bound() {
    let (_dir, path) = saved(&TestFile::column());
    let character = character(&path);
    // Bound 80 and 140 cm up an unturned Z axis, which the armature turns to Y.
    let rest = character.skeleton.rest_positions_m();
    assert!(rest[1].distance(Vec3::new(0.0, 0.6, 0.0)) < 1e-6, "{rest:?}");
    let vertex = character.mesh.positions_m[0];
    assert!(vertex.distance(Vec3::new(0.05, 0.0, 0.0)) < 1e-6, "{vertex}");
    assert!(character.mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
    assert_eq!(character.mesh.parts.len(), 2, "the hat is a part of its own");
    assert_eq!(character.mesh.joints[12], [1, 0, 0, 0], "and hangs on the chest");
    let colour = character.materials[character.mesh.parts[0].material].base_colour_linear;
    assert_eq!(colour, [0.5, 0.2, 0.1, 1.0]);
}

#[test]
fn shared_characters_are_skinned_as_the_format_says() {
    for name in CHARACTERS {
        let Some(path) = shared(&format!("characters/{name}")) else { return };
        let worst = worst_against_twin_m(&path);
        println!("{name}: {worst} m");
        // The robot's feet are moved on their own, and do not quite keep its shins' length.
        let allowed = if name == "robot.glb" { 3e-3 } else { 1e-4 };
        assert!(worst < allowed, "{name}: {worst} m");
    }
}

#[test]
fn an_animation_is_chosen_by_name_or_number() {
    let mut file = TestFile::column();
    let mut second = file.json["animations"][0].clone();
    second["name"] = "bow".into();
    file.json["animations"].as_array_mut().unwrap().push(second);
    let (_dir, path) = saved(&file);
    let read = |wanted: &str| {
        let animation = Some(wanted.to_owned());
        let options = ReadOptions { animation, ..ReadOptions::default() };
        read_motion_file(&path, &options, &mut Warnings::new())
    };
    assert_eq!(read("bow").unwrap().motion.fps().get(), 20.0);
    assert_eq!(read("1").unwrap().motion.n_frames(), 3);
    let error = read("jump").unwrap_err().to_string();
    assert!(
        error.ends_with("there is no animation \"jump\"; choose 0 \"sway\", 1 \"bow\""),
        "{error}"
    );
}

#[test]
fn steps_and_splines_pass_through_their_keys() {
    for (kind, per_key) in [("STEP", 1), ("CUBICSPLINE", 3)] {
        let mut file = TestFile::column();
        let keys = [[10.0, 0.0, 80.0], [20.0, 3.0, 82.0], [30.0, 5.0, 79.0]];
        let values: Vec<f32> = keys
            .iter()
            .flat_map(
                |key| if per_key == 1 { key.to_vec() } else { [[0.0; 3], *key, [0.0; 3]].concat() },
            )
            .collect();
        let output = file.floats("VEC3", &values);
        file.json["animations"][0]["samplers"][0]["output"] = output.into();
        file.json["animations"][0]["samplers"][0]["interpolation"] = kind.into();
        let (_dir, path) = saved(&file);
        let options = ReadOptions::default();
        let motion = read_motion_file(&path, &options, &mut Warnings::new()).unwrap().motion;
        let middle = motion.root_positions_m()[1];
        // Centimetres with Z up.
        assert!(middle.distance(Vec3::new(0.2, 0.82, -0.03)) < 1e-5, "{kind}: {middle}");
    }
}

#[test]
fn joints_that_leave_their_place_are_warned_about() {
    let mut file = TestFile::column();
    file.json["animations"][0]["channels"][0]["target"]["node"] = 2.into();
    let (_dir, path) = saved(&file);
    let mut warnings = Warnings::new();
    read_motion_file(&path, &ReadOptions::default(), &mut warnings).unwrap();
    let said = warnings.as_slice()[0].to_string();
    assert!(said.contains("joint \"Chest\" leaves its place by up to"), "{said}");
}

#[test]
fn data_within_and_beside_the_file_is_found() {
    use base64::Engine as _;
    let file = TestFile::column();
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.gltf");
    let save = |path: &Path, bytes: &[u8]| {
        std::fs::File::create(path).unwrap().write_all(bytes).unwrap();
    };
    let mut json = file.json.clone();
    let data = base64::engine::general_purpose::STANDARD.encode(&file.bin);
    json["buffers"] = serde_json::json!([{"byteLength": file.bin.len(),
        "uri": format!("data:application/octet-stream;base64,{data}")}]);
    save(&path, json.to_string().as_bytes());
    let within = character(&path);
    json["buffers"][0]["uri"] = "the%20data.bin".into();
    save(&path, json.to_string().as_bytes());
    let error =
        read_character(&path, &CharacterOptions::default(), &mut Warnings::new()).unwrap_err();
    assert_eq!(
        (error.what.as_str(), error.what_to_do.as_str()),
        (
            "it needs the file \"the%20data.bin\": there is no such file",
            "put that file beside it, or export it as one .glb"
        )
    );
    save(&dir.path().join("the data.bin"), &file.bin);
    assert_eq!(character(&path).mesh, within.mesh);
}

#[test]
fn pictures_are_decoded_and_missing_ones_left_out() {
    let mut file = TestFile::column();
    let mut png = std::io::Cursor::new(Vec::new());
    image::RgbaImage::from_pixel(3, 2, image::Rgba([1, 2, 3, 255]))
        .write_to(&mut png, image::ImageFormat::Png)
        .unwrap();
    file.accessor(png.get_ref(), 5121, "SCALAR", 1);
    let view = file.json["bufferViews"].as_array().unwrap().len() - 1;
    file.json["images"] = serde_json::json!([{"bufferView": view, "mimeType": "image/png"}]);
    file.json["textures"] = serde_json::json!([{"source": 0}]);
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] =
        serde_json::json!({"index": 0});
    let (_dir, path) = saved(&file);
    let read = character(&path);
    assert_eq!((read.textures[0].width, read.textures[0].height), (3, 2));
    assert_eq!(read.textures[0].rgba8_srgb[..4], [1, 2, 3, 255]);
    assert_eq!(read.materials[0].base_colour_texture, Some(0));
    file.json["images"] = serde_json::json!([{"uri": "none.png"}]);
    let (_dir, path) = saved(&file);
    let mut warnings = Warnings::new();
    let read = read_character(&path, &CharacterOptions::default(), &mut warnings).unwrap();
    assert_eq!(read.textures, []);
    let said = warnings.as_slice()[0].to_string();
    assert!(said.ends_with("there is no such file; the picture is left out"), "{said}");
}

/// Reads a file as a character and as a motion; the first error.
fn error_of(bytes: &[u8], name: &str) -> Option<String> {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join(name);
    std::fs::File::create(&path).unwrap().write_all(bytes).unwrap();
    let mut warnings = Warnings::new();
    let character = read_character(&path, &CharacterOptions::default(), &mut warnings).err();
    let motion = read_motion_file(&path, &ReadOptions::default(), &mut warnings).err();
    let said = character.or(motion)?.to_string();
    assert!(!said.contains('\n') && said.contains("; "), "{said:?} is one line with a way out");
    Some(said.replace(&format!("{}/", dir.path().display()), ""))
}

/// Spoils the column's JSON at a pointer and expects an error that contains `expected`.
#[track_caller]
fn check_refused(pointer: &str, value: serde_json::Value, expected: &str) {
    let mut file = TestFile::column();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = file.json.pointer_mut(parent).unwrap();
    match key.parse::<usize>() {
        Ok(at) => parent[at] = value,
        Err(_) => parent[key] = value,
    }
    let said = error_of(&file.glb(), "a.glb");
    let said = said.unwrap_or_else(|| panic!("{pointer} was taken"));
    assert!(said.contains(expected), "{pointer}: {said}");
}

#[test]
fn spoilt_files_are_refused_with_a_word() {
    use serde_json::json;
    assert_eq!(error_of(&TestFile::column().glb(), "a.glb"), None);
    check_refused("/skins", json!([]), "there is no skin in the file");
    check_refused("/skins/0/joints", json!([]), "has no joints");
    check_refused("/skins/0/joints/1", json!(99), "joint 99 that is no node");
    check_refused("/skins/0/inverseBindMatrices", json!(99), "there is no accessor 99");
    check_refused("/skins/0/inverseBindMatrices", json!(0), "another shape");
    check_refused("/nodes/2/children/0", json!(1), "two parents");
    check_refused("/nodes/2/children/0", json!(77), "no child 77");
    check_refused("/nodes/4/children", json!([0]), "in a circle");
    check_refused("/nodes/3/mesh", json!(7), "there is no mesh 7");
    check_refused("/nodes/3/skin", json!(7), "there is no skin 7");
    check_refused("/accessors/0/count", json!(1u64 << 31), "claims 2147483648 elements");
    check_refused("/accessors/0/count", json!(13), "leads beyond its buffer");
    check_refused("/accessors/0/byteOffset", json!(u64::MAX), "leads beyond its buffer");
    check_refused("/accessors/1/bufferView", json!(99), "buffer view 99");
    check_refused("/bufferViews/0/byteOffset", json!(u64::MAX), "beyond its buffer");
    check_refused("/bufferViews/0/buffer", json!(3), "beyond its buffer");
    check_refused("/meshes/0/primitives/0/material", json!(9), "there is no material 9");
    check_refused("/meshes/0/primitives/0/mode", json!(99), "unknown mode");
    check_refused("/animations/0/channels/0/sampler", json!(9), "has no sampler");
    check_refused("/animations/0/channels/0/target/node", json!(9), "moves no node");
    check_refused("/animations/0/samplers/0/input", json!(0), "another shape");
    check_refused("/animations", json!([]), "there is no animation");
    check_refused("/asset/version", json!("1.0"), "glTF \"1.0\"");
    check_refused("/extensionsRequired", json!(["KHR_draco_mesh_compression"]), "without Draco");
    check_refused("/extensionsRequired", json!(["EXT_meshopt_compression"]), "without meshopt");
    check_refused("/extensionsRequired", json!(["X"]), "it needs the extension \"X\"");
    check_refused("/buffers", json!([{"byteLength": 1u64 << 40}]), "buffer 0 has");
    check_refused("/buffers", json!([{"byteLength": 4, "uri": "http://a.b/c"}]), "not a file");
    check_refused("/buffers", json!([{"byteLength": 4, "uri": "data:x,y"}]), "base64");
}

#[test]
fn numbers_that_are_none_are_refused() {
    let column = TestFile::column();
    for (accessor, bytes, expected) in [
        (0, f32::NAN.to_le_bytes().to_vec(), "no finite number"),
        (2, f32::INFINITY.to_le_bytes().to_vec(), "no finite number"),
        (1, vec![200; 4], "joint 200 of 2"),
        (3, 60_000_u16.to_le_bytes().to_vec(), "vertex 60000 of 12"),
        (6, 1.0_f32.to_le_bytes().to_vec(), "back in time"),
        (6, 1e30_f32.to_le_bytes().to_vec(), "back in time"),
    ] {
        let mut file = column.clone();
        let view = file.json["accessors"][accessor]["bufferView"].as_u64().unwrap() as usize;
        let from = file.json["bufferViews"][view]["byteOffset"].as_u64().unwrap() as usize;
        file.bin[from..from + bytes.len()].copy_from_slice(&bytes);
        let said = error_of(&file.glb(), "a.glb").unwrap_or_default();
        assert!(said.contains(expected), "accessor {accessor}: {said}");
    }
    let mut file = column;
    let long = file.floats("SCALAR", &[0.0, 1e6, 1e30]);
    for sampler in 0..2 {
        file.json["animations"][0]["samplers"][sampler]["input"] = long.into();
    }
    let said = error_of(&file.glb(), "a.glb").unwrap_or_default();
    assert!(said.contains("longer than is read"), "{said}");
}

#[test]
fn claims_without_data_cost_nothing() {
    use serde_json::json;
    // Zeros without a buffer, many times over.
    let mut file = TestFile::column();
    file.json["accessors"][0] = json!({"componentType": 5126, "type": "VEC3", "count": 3_000_000});
    file.json["accessors"][1] = json!({"componentType": 5121, "type": "VEC4", "count": 3_000_000});
    file.json["accessors"][2] = json!({"componentType": 5126, "type": "VEC4", "count": 3_000_000});
    let primitive = file.json["meshes"][0]["primitives"][0].clone();
    file.json["meshes"][0]["primitives"] = vec![primitive; 1000].into();
    let said = error_of(&file.glb(), "a.glb").unwrap_or_default();
    assert!(said.contains("more than 4000000 vertices"), "{said}");

    let mut file = TestFile::column();
    let chain = (5..5000).map(|node| json!({"children": [node + 1]}));
    let nodes: Vec<_> = chain.chain([json!({})]).collect();
    file.json["nodes"].as_array_mut().unwrap().extend(nodes);
    let said = error_of(&file.glb(), "a.glb").unwrap_or_default();
    assert!(said.contains("more than 1024 deep"), "{said}");
}

#[test]
fn truncated_and_scrambled_files_do_no_harm() {
    let glb = TestFile::column().glb();
    for cut in (0..glb.len()).step_by(61).chain([1, 4, 8, 11, 12, 19, 20]) {
        assert!(error_of(&glb[..cut], "a.glb").is_some(), "{cut} bytes are no file");
    }
    let mut state = 1_u64;
    for _ in 0..400 {
        let mut bytes = glb.clone();
        for _ in 0..3 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let at = (state >> 33) as usize % bytes.len();
            bytes[at] = (state >> 20) as u8;
        }
        error_of(&bytes, "a.glb");
    }
    for text in ["", "{}", "[]", "{\"asset\": {\"version\": \"2.0\"}}", "glTF", "\u{0}"] {
        assert!(error_of(text.as_bytes(), "a.gltf").is_some(), "{text:?} is no file");
    }
}

/// What is known of a shared character.
struct Known {
    name: &'static str,
    /// Joints of both arms and both legs that are recognised; pelvis, back and head always are.
    n_limb_roles: usize,
    height_m: f32,
    /// How deep and how high its feet get on the floor, over a walk. Large feet of one piece dip
    /// their toes where a heel leaves the ground.
    feet_m: [f32; 2],
}

#[test]
fn every_shared_character_is_a_person_that_walks_on_the_floor() {
    let known = [
        Known { name: "CesiumMan.glb", n_limb_roles: 14, height_m: 1.51, feet_m: [-0.03, 0.03] },
        Known {
            name: "RiggedFigure/RiggedFigure.gltf",
            n_limb_roles: 14,
            height_m: 1.45,
            feet_m: [-0.04, 0.02],
        },
        Known { name: "greenman.glb", n_limb_roles: 4, height_m: 2.03, feet_m: [-0.12, 0.0] },
        Known { name: "robot.glb", n_limb_roles: 10, height_m: 2.34, feet_m: [-0.23, 0.0] },
    ];
    for known in known {
        let Some(path) = shared(&format!("characters/{}", known.name)) else { return };
        let Some(walk) = shared("mocap/cmu/16_15.bvh") else { return };
        let character = character(&path);
        let (skeleton, name) = (&character.skeleton, known.name);
        let limb_roles =
            JointRole::ALL[6..].iter().filter(|&&role| skeleton.by_role(role).is_some());
        // Collar bones are no limbs.
        let collars = [JointRole::LeftShoulder, JointRole::RightShoulder];
        let n = limb_roles.filter(|role| !collars.contains(role)).count();
        assert_eq!(n, known.n_limb_roles, "{name}");
        for role in [JointRole::Hips, JointRole::Spine, JointRole::Neck, JointRole::Head] {
            assert!(skeleton.by_role(role).is_some(), "{name} has {role:?}");
        }
        assert_eq!(skeleton.by_role(JointRole::Hips), Some(JointIdx(0)), "{name}");
        let (low, high) = bounds(&character.mesh.positions_m);
        assert!((high.y - low.y - known.height_m).abs() < 0.01, "{name}: {}", high.y - low.y);
        let rest = skeleton.rest_positions_m();
        let arm = skeleton.by_role(JointRole::LeftArm).unwrap();
        assert!(rest[arm.idx()].x > 0.05, "{name}: its left is at +X");
        if let Some(toe) = skeleton.by_role(JointRole::LeftToeBase) {
            assert!(skeleton.joint(toe).offset_m.z > 0.02, "{name}: its feet point to +Z");
        }

        let walk = read_motion_file(&walk, &ReadOptions::default(), &mut Warnings::new()).unwrap();
        let walk_bind = BindPose::of(&walk.skeleton, Some(&walk.motion));
        let bind = character.bind_pose();
        let retarget = Retarget::new(&walk.skeleton, &walk_bind, skeleton, &bind).unwrap();
        let walked = retarget.apply(&walk.motion);
        let thighs =
            [JointRole::LeftUpLeg, JointRole::RightUpLeg].map(|role| skeleton.by_role(role));
        let mut is_leg = vec![false; skeleton.n_joints()];
        for (idx, joint) in skeleton.joints().iter().enumerate() {
            is_leg[idx] = thighs.contains(&Some(JointIdx::from_idx(idx)))
                || joint.parent.is_some_and(|parent| is_leg[parent.idx()]);
        }
        let (mut positions, mut rotations) = (Vec::new(), Vec::new());
        let mut lowest = Vec::new();
        for frame in 0..walked.n_frames() {
            walked.forward_kinematics(skeleton, frame, &mut positions, &mut rotations);
            let skinned = character.skinned_positions_m(&positions, &rotations);
            let legs = skinned.iter().zip(&character.mesh.joints);
            let legs = legs.filter(|(_, joints)| is_leg[joints[0] as usize]);
            lowest.push(legs.map(|(position, _)| position.y).fold(f32::INFINITY, f32::min));
        }
        let deepest = lowest.iter().copied().fold(f32::INFINITY, f32::min);
        let highest = lowest.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let ratio = retarget.leg_ratio();
        println!("{name}: legs × {ratio:.3}, feet from {deepest:.3} to {highest:.3} m");
        assert!(deepest > known.feet_m[0] && highest < known.feet_m[1], "{name}");

        let file = read_motion_file(&path, &ReadOptions::default(), &mut Warnings::new()).unwrap();
        assert_eq!(file.skeleton, *skeleton, "{name}: motion and character are one body");
    }
}
