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

// Lines every metre and every five metres, metres wide.
const FINE_WIDTH = 0.012;
const STRONG_WIDTH = 0.025;

// How much of a pixel is covered by lines `distance` from its middle: never thinner than a pixel,
// but fainter (after Ben Golus, "The best darn grid shader (yet)", 2023). All in metres.
fn coverage(distance: vec2f, width: f32, pixel: vec2f, per_pixel: vec2f) -> f32 {
    let drawn = max(vec2f(width), pixel);
    let share = clamp((0.5 * drawn - distance) * per_pixel + 0.5, vec2f(0.0), vec2f(1.0));
    let faded = share * min(width * per_pixel, vec2f(1.0));
    return max(faded.x, faded.y);
}

fn over(below: vec3f, color: vec4f, share: f32) -> vec3f {
    return mix(below, color.rgb, color.a * share);
}

@fragment
fn floor_and_grid(in: Placed) -> @location(0) vec4f {
    let at = in.p_in_world.xz;
    let pixel = max(fwidth(at), vec2f(1e-5));
    let per_pixel = 1.0 / pixel;
    let from_eye = in.p_in_world - frame.eye.xyz;
    // Squared share of the distance at which the floor has faded.
    let away = dot(from_eye, from_eye) / (frame.forward.w * frame.forward.w);
    var color = frame.floor_color.rgb;
    if (frame.misc.w > 0.5) {
        let to_metre = abs(fract(at - 0.5) - 0.5);
        let to_five = abs(fract(at * 0.2 - 0.5) - 0.5) * 5.0;
        // Lines closer than pixels would shimmer: fine ones go first, far away, then strong ones.
        let coarse = max(pixel.x, pixel.y);
        let fine = clamp(1.2 - 3.0 * away, 0.0, 1.0) * clamp(2.0 - 4.0 * coarse, 0.0, 1.0);
        let strong = clamp(2.0 - 0.8 * coarse, 0.0, 1.0);
        color = over(color, frame.grid, 0.6 * fine * coverage(to_metre, FINE_WIDTH, pixel, per_pixel));
        color = over(color, frame.grid, strong * coverage(to_five, STRONG_WIDTH, pixel, per_pixel));
        let half_axis = max(vec2f(0.012), pixel * 0.75);
        let on_axis = clamp((half_axis - abs(at)) * per_pixel + 0.5, vec2f(0.0), vec2f(1.0));
        color = over(color, frame.x_axis, on_axis.y);
        color = over(color, frame.z_axis, on_axis.x);
    }
    let fade = clamp(1.15 * away - 0.05, 0.0, 1.0) * frame.eye.w;
    return vec4f(mix(color, frame.horizon.rgb, fade), 1.0);
}
