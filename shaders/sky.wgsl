// What is behind everything. Keep in sync with primitive/sky.rs.

struct OnPicture {
    @builtin(position) clip: vec4f,
    @location(0) at: vec2f,
};

@vertex
fn vertex(@builtin(vertex_index) corner: u32) -> OnPicture {
    let at = vec2f(f32(corner & 1u), f32(corner >> 1u)) * 4.0 - 1.0;
    var out: OnPicture;
    out.clip = vec4f(at, 0.0, 1.0);
    out.at = at;
    return out;
}

@fragment
fn gradient(in: OnPicture) -> @location(0) vec4f {
    let across = frame.right.xyz * (frame.right.w * in.at.x) + frame.up.xyz * (frame.up.w * in.at.y);
    let slope = normalize(frame.forward.xyz + across).y;
    let sky = mix(frame.horizon.rgb, frame.sky_top.rgb, smoothstep(0.0, 0.45, slope));
    if (frame.eye.w > 0.5) {
        return vec4f(sky, 1.0);
    }
    // Parallel rays: the floor seen from the side is what is below its height.
    let height = (frame.eye.xyz + across).y;
    let wall = mix(frame.horizon.rgb, frame.sky_top.rgb, smoothstep(0.0, 4.0, height));
    let soft = fwidth(height);
    let is_above = smoothstep(-soft, soft, height);
    return vec4f(mix(frame.floor_color.rgb, wall, is_above), 1.0);
}
