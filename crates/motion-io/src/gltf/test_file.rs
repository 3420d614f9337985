//! A small glTF file for tests, to be spoilt in every way.

use glam::{DAffine3, DQuat, DVec3};
use serde_json::{Value, json};

/// JSON and binary chunk of a `.glb`.
#[derive(Clone)]
pub(crate) struct TestFile {
    pub(crate) json: Value,
    pub(crate) bin: Vec<u8>,
}

impl TestFile {
    /// A column with a joint at each end under an armature in centimetres with Z up: the joints
    /// rest turned and the upper one scaled, the mesh was bound with both unturned, a hat hangs
    /// on the upper one without a skin. Three keys turn and move it.
    pub(crate) fn column() -> Self {
        let mut file = Self { json: json!({"asset": {"version": "2.0"}}), bin: Vec::new() };
        let quarter = std::f32::consts::FRAC_1_SQRT_2;
        let armature = [-quarter, 0.0, 0.0, quarter];
        file.json["nodes"] = json!([
            {"name": "Armature", "scale": [0.01, 0.01, 0.01], "rotation": armature,
             "children": [1, 3]},
            {"name": "Hips", "translation": [10.0, 0.0, 80.0], "rotation": [0.0, 0.6, 0.0, 0.8],
             "children": [2]},
            {"name": "Chest", "translation": [0.0, 0.0, 60.0], "rotation": [0.6, 0.0, 0.0, 0.8],
             "children": [4]},
            {"name": "Body", "mesh": 0, "skin": 0},
            {"name": "Hat", "mesh": 1, "translation": [0.0, 0.0, 20.0], "scale": [2.0, 2.0, 2.0]},
        ]);
        let ring = |z: f32| {
            (0..4)
                .map(move |i| [[5.0, 0.0], [0.0, 5.0], [-5.0, 0.0], [0.0, -5.0]][i])
                .map(move |[x, y]| [10.0 + x, y, z])
        };
        let points: Vec<[f32; 3]> = ring(80.0).chain(ring(110.0)).chain(ring(140.0)).collect();
        let positions = file.floats("VEC3", points.as_flattened());
        let joints: Vec<u8> = (0..12).flat_map(|_| [0, 1, 0, 0]).collect();
        let joints = file.accessor(&joints, 5121, "VEC4", 12);
        let weights: Vec<[f32; 4]> =
            (0..12).map(|i| [1.0 - (i / 4) as f32 / 2.0, (i / 4) as f32 / 2.0, 0.0, 0.0]).collect();
        let weights = file.floats("VEC4", weights.as_flattened());
        let mut indices = Vec::new();
        for side in 0..8_u16 {
            let (low, next) = (side, side / 4 * 4 + (side + 1) % 4);
            indices.extend([low, next, low + 4, next, next + 4, low + 4]);
        }
        let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        let indices = file.accessor(&bytes, 5123, "SCALAR", 48);
        let hat = file.floats("VEC3", &[0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 5.0, 0.0]);
        file.json["meshes"] = json!([
            {"primitives": [{"attributes": {"POSITION": positions, "JOINTS_0": joints,
                "WEIGHTS_0": weights}, "indices": indices, "material": 0}]},
            {"primitives": [{"attributes": {"POSITION": hat}}]},
        ]);
        file.json["materials"] =
            json!([{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.2, 0.1, 1.0]}}]);
        let bind = |z: f64| {
            DAffine3::from_scale_rotation_translation(
                DVec3::ONE,
                DQuat::IDENTITY,
                DVec3::new(10.0, 0.0, z),
            )
        };
        let matrices: Vec<f32> = [bind(80.0), bind(140.0)]
            .iter()
            .flat_map(|bind| glam::DMat4::from(bind.inverse()).to_cols_array())
            .map(|value| value as f32)
            .collect();
        let matrices = file.floats("MAT4", &matrices);
        file.json["skins"] = json!([{"joints": [1, 2], "inverseBindMatrices": matrices}]);
        let secs = file.floats("SCALAR", &[0.0, 0.05, 0.1]);
        let places = file.floats("VEC3", &[10.0, 0.0, 80.0, 20.0, 3.0, 82.0, 30.0, 5.0, 79.0]);
        let turns =
            file.floats("VEC4", &[0.0, 0.6, 0.0, 0.8, 0.0, 0.0, 0.6, 0.8, 0.36, 0.48, 0.0, 0.8]);
        file.json["animations"] = json!([{"name": "sway",
            "samplers": [{"input": secs, "output": places}, {"input": secs, "output": turns}],
            "channels": [
                {"sampler": 0, "target": {"node": 1, "path": "translation"}},
                {"sampler": 1, "target": {"node": 1, "path": "rotation"}},
                {"sampler": 1, "target": {"node": 2, "path": "rotation"}}]}]);
        file
    }

    /// Adds an accessor of floats.
    pub(crate) fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(&bytes, 5126, kind, values.len() / width)
    }

    /// Adds an accessor with a view of its own.
    pub(crate) fn accessor(&mut self, bytes: &[u8], kind: u32, shape: &str, n: usize) -> usize {
        while !self.bin.len().is_multiple_of(4) {
            self.bin.push(0);
        }
        let from = self.bin.len();
        self.bin.extend_from_slice(bytes);
        for list in ["bufferViews", "accessors"] {
            if self.json[list].is_null() {
                self.json[list] = json!([]);
            }
        }
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(json!({"buffer": 0, "byteOffset": from, "byteLength": bytes.len()}));
        let view = views.len() - 1;
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors
            .push(json!({"bufferView": view, "componentType": kind, "type": shape, "count": n}));
        accessors.len() - 1
    }

    /// The bytes of the `.glb`.
    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if json["buffers"].is_null() {
            json["buffers"] = json!([{"byteLength": self.bin.len()}]);
        }
        let mut json = json.to_string().into_bytes();
        while !json.len().is_multiple_of(4) {
            json.push(b' ');
        }
        let mut bin = self.bin.clone();
        while !bin.len().is_multiple_of(4) {
            bin.push(0);
        }
        let word = |value: usize| (value as u32).to_le_bytes();
        let mut glb = b"glTF".to_vec();
        glb.extend(word(2));
        glb.extend(word(12 + 8 + json.len() + 8 + bin.len()));
        glb.extend(word(json.len()));
        glb.extend(b"JSON");
        glb.extend(json);
        glb.extend(word(bin.len()));
        glb.extend(b"BIN\0");
        glb.extend(bin);
        glb
    }
}
