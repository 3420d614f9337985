// Boxes, cylinders, balls. Keep in sync with primitive/solids.rs.

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) world_x: vec4f,
    @location(3) world_y: vec4f,
    @location(4) world_z: vec4f,
    @location(5) color: vec4f,
    // Pick id, emphasis.
    @location(6) marks: vec2u,
};

struct Placed {
    @builtin(position) clip: vec4f,
    @location(0) p_in_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec4f,
    @location(3) @interpolate(flat) marks: vec2u,
};

@vertex
fn vertex(in: Vertex) -> Placed {
    let p = vec4f(in.position, 1.0);
    // A normal is a plane: it goes by the inverse transpose, which for a matrix of stretched axes
    // is each axis over its squared length.
    let columns = transpose(mat3x3f(in.world_x.xyz, in.world_y.xyz, in.world_z.xyz));
    let n = in.normal / vec3f(
        dot(columns[0], columns[0]),
        dot(columns[1], columns[1]),
        dot(columns[2], columns[2]),
    );
    var out: Placed;
    out.p_in_world = vec3f(dot(in.world_x, p), dot(in.world_y, p), dot(in.world_z, p));
    out.normal = columns * n;
    out.clip = frame.clip_from_world * vec4f(out.p_in_world, 1.0);
    out.color = in.color;
    out.marks = in.marks;
    return out;
}

@fragment
fn solid(in: Placed) -> @location(0) vec4f {
    let normal = normalize(in.normal);
    let visibility = body_visibility(in.p_in_world, normal);
    let light = lit(in.color.rgb, 0.7, normal, towards_eye(in.p_in_world), visibility);
    return vec4f(stored(light), in.color.a);
}

@fragment
fn id(in: Placed) -> @location(0) u32 {
    return in.marks.x;
}

@fragment
fn mask(in: Placed) -> @location(0) vec4f {
    return vec4f(select(0.0, 1.0, in.marks.y == 1u), select(0.0, 1.0, in.marks.y == 2u), 0.0, 1.0);
}
