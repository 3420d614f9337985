// Where vertices go, written down: what drawing computes, for comparison with the processor's.
// Keep in sync with skinning_check.rs.

struct Vertex {
    position: vec4f,
    weights: vec4f,
    joints: vec4u,
};

@group(0) @binding(0) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(1) var<storage, read_write> positions: array<vec4f>;

@compute @workgroup_size(64)
fn skin(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= arrayLength(&vertices)) {
        return;
    }
    let vertex = vertices[id.x];
    let joint = blended(0u, vertex.joints, vertex.weights);
    positions[id.x] = vec4f(moved(joint, vertex.position), 1.0);
}
