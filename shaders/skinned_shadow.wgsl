// Bodies as the key light sees them. Keep in sync with primitive/skinned_mesh.rs.

@vertex
fn vertex(in: Vertex, @builtin(instance_index) instance: u32) -> @builtin(position) vec4f {
    let joint = blended(instances[instance].first_joint, in.joints, in.weights);
    return frame.clip_from_world * vec4f(moved(joint, vec4f(in.position, 1.0)), 1.0);
}
