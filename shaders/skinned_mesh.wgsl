// Bodies. Keep in sync with primitive/skinned_mesh.rs.

struct Part {
    base_color: vec4f,
    // x: roughness. y: texels under this alpha are not there.
    surface: vec4f,
};

@group(3) @binding(0) var<uniform> part: Part;
@group(3) @binding(1) var base_texture: texture_2d<f32>;
@group(3) @binding(2) var base_sampler: sampler;

struct Skinned {
    @builtin(position) @invariant clip: vec4f,
    @location(0) p_in_world: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(3) @interpolate(flat) instance: u32,
};

@vertex
fn vertex(in: Vertex, @builtin(instance_index) instance: u32) -> Skinned {
    let joint = blended(instances[instance].first_joint, in.joints, in.weights);
    var out: Skinned;
    out.p_in_world = moved(joint, vec4f(in.position, 1.0));
    out.normal = moved(joint, vec4f(in.normal, 0.0));
    out.clip = frame.clip_from_world * vec4f(out.p_in_world, 1.0);
    out.uv = in.uv;
    out.instance = instance;
    return out;
}

fn surface_color(uv: vec2f) -> vec4f {
    return part.base_color * textureSample(base_texture, base_sampler, uv);
}

@fragment
fn solid(in: Skinned, @builtin(front_facing) is_front: bool) -> @location(0) vec4f {
    let color = surface_color(in.uv);
    if (color.a < part.surface.y) {
        discard;
    }
    let towards = normalize(in.normal);
    let normal = select(-towards, towards, is_front);
    let to_eye = towards_eye(in.p_in_world);
    let visibility = body_visibility(in.p_in_world, normal);
    let albedo = color.rgb * instances[in.instance].tint.rgb;
    return vec4f(stored(lit(albedo, part.surface.x, normal, to_eye, visibility)), 1.0);
}

// Where only depth counts.
@fragment
fn nothing() -> @location(0) vec4f {
    return vec4f(0.0);
}

// See-through, denser towards the edge.
@fragment
fn ghost(in: Skinned) -> @location(0) vec4f {
    let normal = normalize(in.normal);
    let facing = abs(dot(normal, towards_eye(in.p_in_world)));
    let rim = (1.0 - facing) * (1.0 - facing);
    let tint = instances[in.instance].tint;
    let shade = 0.75 + 0.25 * normal.y;
    let color = mix(tint.rgb * shade, tint.rgb + 0.25, rim);
    return vec4f(color, clamp(tint.a + 0.65 * rim, 0.0, 1.0));
}

@fragment
fn id(in: Skinned) -> @location(0) u32 {
    return instances[in.instance].pick;
}

// Red where something is selected, green where something is hovered.
@fragment
fn mask(in: Skinned) -> @location(0) vec4f {
    let emphasis = instances[in.instance].emphasis;
    return vec4f(select(0.0, 1.0, emphasis == 1u), select(0.0, 1.0, emphasis == 2u), 0.0, 1.0);
}
