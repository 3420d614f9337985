// The floor: a large square around what is looked at, fading into the horizon long before its
// edge. Keep in sync with primitive/ground.rs.

struct Placed {
    @builtin(position) clip: vec4f,
    @location(0) p_in_world: vec3f,
};

// Far beyond where it has faded.
const REACH = 3.0;

@vertex
fn vertex(@builtin(vertex_index) corner: u32) -> Placed {
    let side = vec2f(f32(corner & 1u), f32(corner >> 1u)) * 2.0 - 1.0;
    let at = frame.eye.xz + side * frame.forward.w * REACH;
    var out: Placed;
    out.p_in_world = vec3f(at.x, 0.0, at.y);
    out.clip = frame.clip_from_world * vec4f(out.p_in_world, 1.0);
    return out;
}

// How much of a pixel a line of a grid covers: 0 between lines, 1 on them; the mean where lines
// are closer than pixels (after Ben Golus, "The best darn grid shader (yet)", 2023).
fn coverage(along: f32, pixel: f32, width: f32) -> f32 {
    let drawn = clamp(width, pixel, 0.5);
    let blur = max(pixel, 1e-6) * 1.2;
    let distance_to_line = abs(fract(along - 0.5) - 0.5);
    let sharp = 1.0 - smoothstep(drawn * 0.5 - blur * 0.5, drawn * 0.5 + blur * 0.5, distance_to_line);
    let faded = sharp * clamp(width / drawn, 0.0, 1.0);
    return mix(faded, width, clamp(pixel * 2.0 - 1.0, 0.0, 1.0));
}

fn over(below: vec3f, color: vec4f, share: f32) -> vec3f {
    return mix(below, color.rgb, color.a * share);
}

@fragment
fn floor_and_grid(in: Placed) -> @location(0) vec4f {
    let at = in.p_in_world.xz;
    let pixel = max(fwidth(at), vec2f(1e-5));
    let away = distance(in.p_in_world, frame.eye.xyz);
    let fade = smoothstep(0.25, 1.0, away / frame.forward.w);
    var color = frame.floor_color.rgb;
    if (frame.misc.w > 0.5) {
        let metre = max(coverage(at.x, pixel.x, 0.012), coverage(at.y, pixel.y, 0.012));
        let five = max(
            coverage(at.x * 0.2, pixel.x * 0.2, 0.005),
            coverage(at.y * 0.2, pixel.y * 0.2, 0.005),
        );
        let near = 1.0 - smoothstep(0.1, 0.6, away / frame.forward.w);
        color = over(color, frame.grid, 0.55 * metre * near);
        color = over(color, frame.grid, five);
        let half_axis = max(vec2f(0.012), pixel * 0.75);
        let on_axis = 1.0 - smoothstep(half_axis - pixel * 0.5, half_axis + pixel * 0.5, abs(at));
        color = over(color, frame.x_axis, on_axis.y);
        color = over(color, frame.z_axis, on_axis.x);
    }
    return vec4f(mix(color, frame.horizon.rgb, fade * frame.eye.w), 1.0);
}
