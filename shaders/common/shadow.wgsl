// How much of the key light arrives.

@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;

// 0 in full shadow, 1 in full light. Nine taps two texels apart, each the mean of four
// comparisons: a box without gaps, six texels wide.
fn key_visibility(p_in_world: vec3f) -> f32 {
    let at = frame.shadow_from_world * vec4f(p_in_world, 1.0);
    let step = 2.0 * frame.misc.y;
    var lit = 0.0;
    for (var row = -1; row <= 1; row++) {
        for (var column = -1; column <= 1; column++) {
            let offset = vec2f(f32(column), f32(row)) * step;
            lit += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + offset, at.z);
        }
    }
    let is_outside = any(at.xy < vec2f(0.0)) || any(at.xy > vec2f(1.0));
    return select(lit / 9.0, 1.0, is_outside);
}
