// What every shader knows of a picture. Keep in sync with `FrameUniform` in frame_uniform.rs.

struct Frame {
    clip_from_world: mat4x4f,
    // From the world to the shadow map: x and y are texture coordinates, z is depth.
    shadow_from_world: mat4x4f,
    // xyz: where the eye is. w: 1 for perspective, 0 for parallel rays.
    eye: vec4f,
    // xyz: where the eye looks, unit length. w: distance at which the floor fades, metres.
    forward: vec4f,
    // xyz: right and up on the picture; w: half the picture's width and height at unit distance
    // (perspective) or in metres (parallel).
    right: vec4f,
    up: vec4f,
    // Width, height, their inverses; pixels.
    viewport: vec4f,
    // xyz: unit length. w: how dark full shadow makes the floor.
    towards_key: vec4f,
    key: vec4f,
    sky_light: vec4f,
    bounce_light: vec4f,
    sky_top: vec4f,
    horizon: vec4f,
    floor_color: vec4f,
    grid: vec4f,
    x_axis: vec4f,
    z_axis: vec4f,
    // x: pixels per point. y: width of a texel of the shadow map in texture coordinates.
    // z: the same in metres. w: 1 where the floor has a grid.
    misc: vec4f,
};

@group(0) @binding(0) var<uniform> frame: Frame;

// From a point towards the eye, unit length.
fn towards_eye(p_in_world: vec3f) -> vec3f {
    return normalize(mix(-frame.forward.xyz, frame.eye.xyz - p_in_world, frame.eye.w));
}

// The point a little nearer to the eye, at the same place of the picture: what lies on a surface is
// drawn over it without fighting for its depth.
fn lifted_to_eye(p_in_world: vec3f, share: f32) -> vec3f {
    let along_ray = mix(p_in_world, frame.eye.xyz, share);
    let along_view = p_in_world - frame.forward.xyz * (share * 10.0);
    return mix(along_view, along_ray, frame.eye.w);
}
