// Light on a surface: Lambert and GGX for the key light, an even light from sky and floor.

const PI = 3.14159265;

// In software `pow` costs more than all the rest.
fn fourth_power(x: f32) -> f32 {
    let squared = x * x;
    return squared * squared;
}

// Light that leaves the surface towards the eye. `visibility` is the share of the key light that
// arrives. Specular: GGX with Smith's visibility in Hammon's form and Schlick's Fresnel, F0 = 0.04
// (Walter et al. 2007; Hammon 2017).
fn lit(albedo: vec3f, roughness: f32, normal: vec3f, to_eye: vec3f, visibility: f32) -> vec3f {
    let to_key = frame.towards_key.xyz;
    let n_dot_l = max(dot(normal, to_key), 0.0);
    let n_dot_v = max(dot(normal, to_eye), 1e-3);
    let half_way = normalize(to_key + to_eye);
    let n_dot_h = max(dot(normal, half_way), 0.0);
    let v_dot_h = max(dot(to_eye, half_way), 0.0);
    let alpha = roughness * roughness;
    let a2 = alpha * alpha;
    let d = n_dot_h * n_dot_h * (a2 - 1.0) + 1.0;
    let distribution = a2 / (PI * d * d);
    let smith = 0.5 / mix(2.0 * n_dot_l * n_dot_v, n_dot_l + n_dot_v, alpha);
    let fresnel = 0.04 + 0.96 * fourth_power(1.0 - v_dot_h) * (1.0 - v_dot_h);
    let from_key = frame.key.xyz * (n_dot_l * visibility) * (albedo / PI + distribution * smith * fresnel);
    // The brightest of the sky is behind the camera's left shoulder, so that shaded sides have
    // shape from wherever they are seen.
    let brightest = normalize(vec3f(0.0, 1.2, 0.0) - 0.55 * frame.forward.xyz - 0.4 * frame.right.xyz);
    let above = 0.5 + 0.5 * dot(normal, brightest);
    let ambient = mix(frame.bounce_light.xyz, frame.sky_light.xyz, above);
    // Grazing surfaces mirror what surrounds them: edges stand out from a dark background.
    let edge = 0.35 * fourth_power(1.0 - n_dot_v);
    return from_key + ambient * (albedo + edge);
}

// From light to what a picture stores, sRGB (IEC 61966-2-1). Bright light bends towards white
// instead of being cut off: linear up to 0.7.
fn stored(light: vec3f) -> vec3f {
    let over = max(light - 0.7, vec3f(0.0));
    let shown = min(light, vec3f(0.7)) + 0.3 * (over / (over + 0.3));
    let curve = 1.055 * pow(max(shown, vec3f(0.0031308)), vec3f(1.0 / 2.4)) - 0.055;
    return select(curve, 12.92 * shown, shown <= vec3f(0.0031308));
}
