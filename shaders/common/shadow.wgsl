// How much of the key light arrives.

@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;

// What is further from the light than the map reaches is compared as if it were at its end, where
// nothing stands before it.
fn in_shadow_map(p_in_world: vec3f) -> vec3f {
    let at = (frame.shadow_from_world * vec4f(p_in_world, 1.0)).xyz;
    return vec3f(at.xy, min(at.z, 1.0));
}

// One tap is the mean of four comparisons.
fn tap(at: vec3f, right: f32, down: f32) -> f32 {
    let px = at.xy + vec2f(right, down) * frame.misc.y;
    return textureSampleCompareLevel(shadow_map, shadow_sampler, px, at.z);
}

fn or_lit_outside(at: vec3f, lit: f32) -> f32 {
    let is_outside = any(at.xy < vec2f(0.0)) || any(at.xy > vec2f(1.0));
    return select(lit, 1.0, is_outside);
}

// On a floor, where edges are seen best: 0 in full shadow, 1 in full light. Nine taps two texels
// apart: a box without gaps, six texels wide.
fn floor_visibility(p_in_world: vec3f) -> f32 {
    let at = in_shadow_map(p_in_world);
    var lit = tap(at, -2.0, -2.0) + tap(at, 0.0, -2.0) + tap(at, 2.0, -2.0);
    lit += tap(at, -2.0, 0.0) + tap(at, 0.0, 0.0) + tap(at, 2.0, 0.0);
    lit += tap(at, -2.0, 2.0) + tap(at, 0.0, 2.0) + tap(at, 2.0, 2.0);
    return or_lit_outside(at, lit / 9.0);
}

// On a body. Four taps: a box four texels wide. It is looked up a little outside, so that a
// surface does not shade itself.
fn body_visibility(p_in_world: vec3f, normal: vec3f) -> f32 {
    let at = in_shadow_map(p_in_world + normal * (2.5 * frame.misc.z));
    let lit = tap(at, -1.0, -1.0) + tap(at, 1.0, -1.0) + tap(at, -1.0, 1.0) + tap(at, 1.0, 1.0);
    return or_lit_outside(at, 0.25 * lit);
}
