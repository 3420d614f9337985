// What is behind everything: bands of even height whose colours are found at their edges, so that
// a pixel costs next to nothing. Keep in sync with primitive/sky.rs.

struct OnPicture {
    @builtin(position) clip: vec4f,
    @location(0) color: vec3f,
    // Parallel rays: height over the floor, metres. Else far above it.
    @location(1) height: f32,
};

const BANDS = 32u;

// A strip: two vertices at each edge of a band, from below.
@vertex
fn vertex(@builtin(vertex_index) idx: u32) -> OnPicture {
    let y = f32(idx >> 1u) * (2.0 / f32(BANDS)) - 1.0;
    let up = frame.up.xyz * (frame.up.w * y);
    let slope = normalize(frame.forward.xyz + up).y;
    let height = (frame.eye.xyz + up).y;
    let is_perspective = frame.eye.w > 0.5;
    let above = select(smoothstep(0.0, 4.0, height), smoothstep(0.0, 0.45, slope), is_perspective);
    var out: OnPicture;
    out.clip = vec4f(f32(idx & 1u) * 2.0 - 1.0, y, 0.0, 1.0);
    out.color = mix(frame.horizon.rgb, frame.sky_top.rgb, above);
    out.height = select(height, 1e3, is_perspective);
    return out;
}

// The floor seen from the side is what is below its height.
@fragment
fn gradient(in: OnPicture) -> @location(0) vec4f {
    let is_above = clamp(in.height * 400.0 + 0.5, 0.0, 1.0);
    return vec4f(mix(frame.floor_color.rgb, in.color, is_above), 1.0);
}
