// Straight pieces with round ends, of even width on the picture. Keep in sync with
// primitive/lines.rs.

struct Piece {
    @location(0) from_in_world: vec3f,
    // Pixels.
    @location(1) width: f32,
    @location(2) to_in_world: vec3f,
    @location(3) pick: u32,
    @location(4) color: vec4f,
};

struct Placed {
    @builtin(position) clip: vec4f,
    // From the piece's beginning, in pixels along it and across.
    @location(0) at: vec2f,
    // Length and radius, pixels.
    @location(1) @interpolate(flat) shape: vec2f,
    @location(2) color: vec4f,
    @location(3) @interpolate(flat) pick: u32,
};

const LIFT = 0.002;
const LEAST_W = 1e-4;

// Ends behind the eye are brought before it.
fn before_eye(end: vec4f, other: vec4f) -> vec4f {
    if (end.w >= LEAST_W || other.w <= LEAST_W) {
        return end;
    }
    return mix(end, other, (LEAST_W - end.w) / (other.w - end.w));
}

@vertex
fn vertex(in: Piece, @builtin(vertex_index) corner: u32) -> Placed {
    let a = frame.clip_from_world * vec4f(lifted_to_eye(in.from_in_world, LIFT), 1.0);
    let b = frame.clip_from_world * vec4f(lifted_to_eye(in.to_in_world, LIFT), 1.0);
    let start = before_eye(a, b);
    let to = before_eye(b, a);
    let half = 0.5 * frame.viewport.xy;
    let from_px = start.xy / start.w * half;
    let to_px = to.xy / to.w * half;
    let length_px = distance(from_px, to_px);
    var along = vec2f(1.0, 0.0);
    if (length_px > 1e-3) {
        along = (to_px - from_px) / length_px;
    }
    let across = vec2f(-along.y, along.x);
    // Half a pixel more on every side, where the edge fades.
    let radius = 0.5 * in.width;
    let grown = radius + 0.75;
    let at_end = f32(corner & 1u);
    let side = f32(corner >> 1u) * 2.0 - 1.0;
    let offset = along * grown * (at_end * 2.0 - 1.0) + across * grown * side;
    let end = mix(start, to, at_end);
    let is_gone = select(0.0, 1.0, start.w < LEAST_W || to.w < LEAST_W);
    var out: Placed;
    out.clip = vec4f(end.xy + offset / half * end.w, end.z, end.w) * (1.0 - is_gone);
    out.at = vec2f(mix(-grown, length_px + grown, at_end), grown * side);
    out.shape = vec2f(length_px, radius);
    out.color = in.color;
    out.pick = in.pick;
    return out;
}

fn distance_to_piece(in: Placed) -> f32 {
    let nearest = clamp(in.at.x, 0.0, in.shape.x);
    return length(vec2f(in.at.x - nearest, in.at.y));
}

@fragment
fn line(in: Placed) -> @location(0) vec4f {
    let coverage = clamp(in.shape.y - distance_to_piece(in) + 0.5, 0.0, 1.0);
    return vec4f(in.color.rgb, in.color.a * coverage);
}

@fragment
fn id(in: Placed) -> @location(0) u32 {
    if (distance_to_piece(in) > in.shape.y) {
        discard;
    }
    return in.pick;
}
