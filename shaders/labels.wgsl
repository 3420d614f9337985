// Letters and the plates behind them, in pixels of the picture. Keep in sync with
// primitive/labels.rs.

struct Quad {
    // Upper left corner and size, pixels.
    @location(0) place: vec4f,
    // The same on the atlas, texels; a plate has no size there.
    @location(1) source: vec4f,
    @location(2) color: vec4f,
    // Radius of a plate's corners, pixels; depth.
    @location(3) radius_and_depth: vec2f,
};

@group(1) @binding(0) var atlas: texture_2d<f32>;

struct Placed {
    @builtin(position) clip: vec4f,
    @location(0) texel: vec2f,
    @location(1) from_center: vec2f,
    @location(2) @interpolate(flat) half_size: vec2f,
    @location(3) @interpolate(flat) radius: f32,
    @location(4) @interpolate(flat) is_plate: u32,
    @location(5) color: vec4f,
};

@vertex
fn vertex(in: Quad, @builtin(vertex_index) corner: u32) -> Placed {
    let share = vec2f(f32(corner & 1u), f32(corner >> 1u));
    let px = in.place.xy + share * in.place.zw;
    var out: Placed;
    out.clip = vec4f(px * frame.viewport.zw * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0), in.radius_and_depth.y, 1.0);
    out.texel = in.source.xy + share * in.source.zw;
    out.from_center = (share - 0.5) * in.place.zw;
    out.half_size = 0.5 * in.place.zw;
    out.radius = in.radius_and_depth.x;
    out.is_plate = select(0u, 1u, in.source.z <= 0.0);
    out.color = in.color;
    return out;
}

@fragment
fn label(in: Placed) -> @location(0) vec4f {
    let corner = abs(in.from_center) - in.half_size + in.radius;
    let outside = length(max(corner, vec2f(0.0))) + min(max(corner.x, corner.y), 0.0) - in.radius;
    let plate = clamp(0.5 - outside, 0.0, 1.0);
    let letter = textureLoad(atlas, vec2i(in.texel), 0).r;
    let coverage = select(letter, plate, in.is_plate == 1u);
    return vec4f(in.color.rgb, in.color.a * coverage);
}
