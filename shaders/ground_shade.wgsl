// What darkens the floor: shadow of the key light, and contact. Both multiply what is there.
// Keep in sync with primitive/ground_shade.rs.

struct Cell {
    // Least x and z, size; metres.
    @location(0) corner_and_size: vec3f,
};

struct Shaded {
    @builtin(position) clip: vec4f,
    @location(0) p_in_world: vec3f,
};

const LIFT = 0.0006;

@vertex
fn shadow_cell(in: Cell, @builtin(vertex_index) corner: u32) -> Shaded {
    let side = vec2f(f32(corner & 1u), f32(corner >> 1u));
    let at = in.corner_and_size.xy + side * in.corner_and_size.z;
    var out: Shaded;
    out.p_in_world = vec3f(at.x, 0.0, at.y);
    out.clip = frame.clip_from_world * vec4f(lifted_to_eye(out.p_in_world, LIFT), 1.0);
    return out;
}

@fragment
fn shadow(in: Shaded) -> @location(0) vec4f {
    let dark = frame.towards_key.w * (1.0 - floor_visibility(in.p_in_world));
    return vec4f(vec3f(1.0 - dark), 1.0);
}

struct Occluder {
    // Center and radius, metres.
    @location(0) ball: vec4f,
};

struct Contact {
    @builtin(position) clip: vec4f,
    @location(0) offset: vec2f,
    @location(1) @interpolate(flat) height_and_radius: vec2f,
};

// How far contact is felt, in radii and heights.
const CONTACT_REACH = 3.0;

@vertex
fn contact_quad(in: Occluder, @builtin(vertex_index) corner: u32) -> Contact {
    let side = vec2f(f32(corner & 1u), f32(corner >> 1u)) * 2.0 - 1.0;
    var out: Contact;
    out.offset = side * (CONTACT_REACH * (in.ball.w + max(in.ball.y, 0.0)));
    let at = in.ball.xz + out.offset;
    let p_in_world = vec3f(at.x, 0.0, at.y);
    out.clip = frame.clip_from_world * vec4f(lifted_to_eye(p_in_world, LIFT), 1.0);
    out.height_and_radius = vec2f(max(in.ball.y, in.ball.w), in.ball.w);
    return out;
}

// A ball of radius r at height h takes h·r²/d³ of the sky from a point of the floor at distance d
// from its center.
@fragment
fn contact(in: Contact) -> @location(0) vec4f {
    let h = in.height_and_radius.x;
    let r = in.height_and_radius.y;
    let d2 = dot(in.offset, in.offset) + h * h;
    let reach = CONTACT_REACH * (r + h);
    let end = 1.0 - smoothstep(0.5, 1.0, length(in.offset) / reach);
    let hidden = clamp(h * r * r / (d2 * sqrt(d2)), 0.0, 1.0) * end;
    return vec4f(vec3f(1.0 - 0.55 * hidden), 1.0);
}
