// Lines around what is selected (red in the mask) and hovered (green). Keep in sync with
// primitive/outline.rs.

struct Colors {
    selected: vec4f,
    hovered: vec4f,
};

@group(1) @binding(0) var mask: texture_2d<f32>;
@group(1) @binding(1) var<uniform> colors: Colors;

@vertex
fn vertex(@builtin(vertex_index) corner: u32) -> @builtin(position) vec4f {
    let at = vec2f(f32(corner & 1u), f32(corner >> 1u)) * 4.0 - 1.0;
    return vec4f(at, 0.0, 1.0);
}

const TAPS = 12;

@fragment
fn outline(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let size = vec2i(textureDimensions(mask));
    let here = textureLoad(mask, vec2i(at.xy), 0).rg;
    let radius = 2.0 * frame.misc.x;
    var around = vec2f(0.0);
    for (var i = 0; i < TAPS; i++) {
        let angle = f32(i) * (6.2831853 / f32(TAPS));
        let tap = vec2i(floor(at.xy + vec2f(cos(angle), sin(angle)) * radius));
        around = max(around, textureLoad(mask, clamp(tap, vec2i(0), size - 1), 0).rg);
    }
    // Only outside: the thing itself stays as it is.
    let line = clamp(around - here, vec2f(0.0), vec2f(1.0));
    let selected = vec4f(colors.selected.rgb, colors.selected.a * line.r);
    let hovered = vec4f(colors.hovered.rgb, colors.hovered.a * line.g);
    return select(hovered, selected, selected.a >= hovered.a);
}
