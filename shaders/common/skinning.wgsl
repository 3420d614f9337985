// Linear blend skinning. Keep in sync with `SkinnedMesh::skinned_position_m` of motion-scene.

// Three rows of an affine matrix `world_from_mesh`.
struct Joint {
    x: vec4f,
    y: vec4f,
    z: vec4f,
};

@group(2) @binding(0) var<storage, read> joints: array<Joint>;

fn blended(first: u32, which: vec4u, weights: vec4f) -> Joint {
    var sum = Joint(vec4f(0.0), vec4f(0.0), vec4f(0.0));
    for (var i = 0; i < 4; i++) {
        let joint = joints[first + which[i]];
        let weight = weights[i];
        sum.x += joint.x * weight;
        sum.y += joint.y * weight;
        sum.z += joint.z * weight;
    }
    return sum;
}

fn moved(joint: Joint, point: vec4f) -> vec3f {
    return vec3f(dot(joint.x, point), dot(joint.y, point), dot(joint.z, point));
}
