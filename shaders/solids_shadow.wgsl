// Solids as the key light sees them. Keep in sync with primitive/solids.rs.

struct Vertex {
    @location(0) position: vec3f,
    @location(2) world_x: vec4f,
    @location(3) world_y: vec4f,
    @location(4) world_z: vec4f,
};

@vertex
fn vertex(in: Vertex) -> @builtin(position) vec4f {
    let p = vec4f(in.position, 1.0);
    let p_in_world = vec3f(dot(in.world_x, p), dot(in.world_y, p), dot(in.world_z, p));
    return frame.clip_from_world * vec4f(p_in_world, 1.0);
}
