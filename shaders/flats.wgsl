// Flat shapes in their own colour. Keep in sync with primitive/flats.rs.

struct Vertex {
    @location(0) p_in_world: vec3f,
    @location(1) color: vec4f,
    @location(2) pick: u32,
};

struct Placed {
    @builtin(position) clip: vec4f,
    @location(0) color: vec4f,
    @location(1) @interpolate(flat) pick: u32,
};

const LIFT = 0.0012;

@vertex
fn vertex(in: Vertex) -> Placed {
    var out: Placed;
    out.clip = frame.clip_from_world * vec4f(lifted_to_eye(in.p_in_world, LIFT), 1.0);
    out.color = in.color;
    out.pick = in.pick;
    return out;
}

@fragment
fn flat(in: Placed) -> @location(0) vec4f {
    return in.color;
}

@fragment
fn id(in: Placed) -> @location(0) u32 {
    return in.pick;
}
