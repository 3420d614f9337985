// A body and its vertices. Keep in sync with primitive/skinned_mesh.rs and mesh_cache.rs.

struct Instance {
    tint: vec4f,
    first_joint: u32,
    pick: u32,
    // 1 for bodies that are selected, 2 for hovered ones.
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
