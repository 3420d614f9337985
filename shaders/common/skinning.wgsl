// Linear blend skinning. Keep in sync with `SkinnedMesh::skinned_position_m` of motion-scene.

// Three rows of an affine matrix `world_from_mesh`.
struct Joint {
    x: vec4f,
    y: vec4f,
    z: vec4f,
};

@group(2) @binding(0) var<storage, read> joints: array<Joint>;

fn blended(first: u32, which: vec4u, weights: vec4f) -> Joint {
    let a = joints[first + which.x];
    let b = joints[first + which.y];
    let c = joints[first + which.z];
    let d = joints[first + which.w];
    return Joint(
        a.x * weights.x + b.x * weights.y + c.x * weights.z + d.x * weights.w,
        a.y * weights.x + b.y * weights.y + c.y * weights.z + d.y * weights.w,
        a.z * weights.x + b.z * weights.y + c.z * weights.z + d.z * weights.w,
    );
}

fn moved(joint: Joint, point: vec4f) -> vec3f {
    return vec3f(dot(joint.x, point), dot(joint.y, point), dot(joint.z, point));
}
