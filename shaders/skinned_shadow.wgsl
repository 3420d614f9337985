// Bodies as the key light sees them. Keep in sync with primitive/skinned_mesh.rs.

struct Instance {
    tint: vec4f,
    first_joint: u32,
    pick: u32,
    emphasis: u32,
    unused: u32,
};

@group(2) @binding(1) var<storage, read> instances: array<Instance>;

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(3) joints: vec4u,
    @location(4) weights: vec4f,
};

@vertex
fn vertex(in: Vertex, @builtin(instance_index) instance: u32) -> @builtin(position) vec4f {
    let joint = blended(instances[instance].first_joint, in.joints, in.weights);
    return frame.clip_from_world * vec4f(moved(joint, vec4f(in.position, 1.0)), 1.0);
}
