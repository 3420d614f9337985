//! Every limit on what a file may claim, with its reason. Each is checked before memory is taken
//! for what is claimed, so that a damaged or hostile file costs an error and not the machine.

/// Largest motion file that is read, bytes: 512 MiB, an hour of 1024 joints as text. Files are
/// read whole.
pub const MAX_MOTION_FILE_BYTES: u64 = 512 << 20;

/// Largest library file, bytes: 4 GiB, some fifty times the CMU set with its graph.
pub const MAX_LIBRARY_FILE_BYTES: u64 = 4 << 30;

/// Largest project file, bytes: 64 MiB, far above thousands of constraints and baked takes.
pub const MAX_PROJECT_FILE_BYTES: u64 = 64 << 20;

/// Largest index of clip descriptions (`INDEX.tsv`), bytes.
pub const MAX_INDEX_FILE_BYTES: u64 = 16 << 20;

/// Longest line of a text format, bytes: a frame of 1024 joints with 6 channels of 40
/// characters each is a quarter of it.
pub const MAX_LINE_BYTES: usize = 1 << 20;

/// Longest joint name, bytes. Names are repeated in reports and messages.
pub const MAX_NAME_BYTES: usize = 256;

/// Most joints of a skeleton. A body with all fingers and a face has about 150.
pub const MAX_JOINTS: usize = 1024;

/// Deepest nesting of joints. Chains of a body stay under 20, ropes and tails under 100.
pub const MAX_JOINT_DEPTH: usize = 256;

/// Most channels of one joint: three positions, three rotations.
pub const MAX_JOINT_CHANNELS: usize = 6;

/// Most frames of one motion file: an hour at 120 Hz is less than half of it.
pub const MAX_CLIP_FRAMES: usize = 1_000_000;

/// Most frames of all clips of one import together, at the library's rate: 18 hours at 30 Hz,
/// about 1 GB for a body of 31 joints.
pub const MAX_LIBRARY_FRAMES: usize = 2_000_000;

/// Most motion files of one import.
pub const MAX_LIBRARY_FILES: usize = 100_000;

/// Deepest folder that a recursive import enters; a loop of links would never end.
pub const MAX_FOLDER_DEPTH: usize = 32;

/// Largest size of an offset's coordinate, file units: 100 m in millimetres.
pub const MAX_ABS_OFFSET: f64 = 1e5;

/// Largest size of a channel's value: 10 km in millimetres, or 27,000 whole turns in degrees.
pub const MAX_ABS_VALUE: f64 = 1e7;

/// Shortest frame time, seconds: 1000 frames per second.
pub const MIN_FRAME_SECS: f64 = 1e-3;

/// Longest frame time, seconds: 1 frame per second.
pub const MAX_FRAME_SECS: f64 = 1.0;

/// Frame numbers of a project are below this: nine hours at 30 Hz.
pub const MAX_PROJECT_FRAMES: u32 = 1_000_000;

/// Largest coordinate of a project, metres: beyond it f32 no longer resolves a millimetre.
pub const MAX_ABS_PLACE_M: f64 = 1e4;

/// Most characters of a project.
pub const MAX_CHARACTERS: usize = 1_000;

/// Most constraints of a character.
pub const MAX_CONSTRAINTS: usize = 10_000;

/// Most points of a path constraint, pieces of a lock, obstacles or interactions of a project.
pub const MAX_LIST: usize = 100_000;

/// Most alternatives that a project may ask for.
pub const MAX_ALTERNATIVES: u32 = 1_000;

/// Longest name of a character, characters: it is a part of file names.
pub const MAX_CHARACTER_NAME: usize = 64;

/// Most sections of a container file.
pub const MAX_SECTIONS: u32 = 1_024;

/// Most nodes, meshes, accessors and the like of a glTF file, of each kind.
pub const MAX_GLTF_ITEMS: usize = 100_000;

/// Deepest nesting of nodes of a glTF file. Joints are as deep as [`MAX_JOINT_DEPTH`] at most, with
/// other nodes between them.
pub const MAX_NODE_DEPTH: usize = 1024;

/// Most numbers of one accessor that are read, and of all tracks of an animation: 64 MiB of them.
/// An accessor without data is all zeros, so that its claim is all there is.
pub const MAX_ACCESSOR_VALUES: usize = 1 << 24;

/// Most sets of four influences of a vertex that are looked at; four of them all count.
pub const MAX_INFLUENCE_SETS: u32 = 4;

/// Most nodes and tracks of an animation that are looked at, over all its frames: ten seconds of
/// work.
pub const MAX_ANIMATION_STEPS: f64 = 1e9;

/// Most vertices of a character: fifty times a detailed one.
pub const MAX_MESH_VERTICES: usize = 4_000_000;

/// Most triangles of a character.
pub const MAX_MESH_TRIANGLES: usize = 8_000_000;

/// Longest side of a picture, pixels.
pub const MAX_TEXTURE_SIDE: u32 = 8192;

/// Most memory that decoding a picture may take, and all of a character's pictures together,
/// bytes: two of 8192 by 8192.
pub const MAX_TEXTURE_BYTES: u64 = 512 << 20;
