//! The device's skinning against the processor's.

use glam::{Mat4, Quat, Vec3};
use motion_render::skinning_check::positions_on_device_m;
use motion_scene::mesh::SkinnedMesh;

use crate::bodies::tube;
use crate::pictures::gpu;

#[test]
fn the_device_skins_as_the_processor_does() {
    let Some(gpu) = gpu() else { return };
    let mesh = tube(40, None);
    for k in 0..8 {
        let bend = k as f32 * 0.4;
        let world_from_joint = [
            Mat4::from_rotation_translation(
                Quat::from_rotation_y(0.7 * bend),
                Vec3::new(3.0, 0.7, -8.0 + bend),
            ),
            Mat4::from_rotation_translation(
                Quat::from_rotation_x(bend) * Quat::from_rotation_z(0.3),
                Vec3::new(3.1, 1.0, -8.0 + bend),
            ),
        ];
        let skin = mesh.skin_matrices(&world_from_joint);
        let on_device = positions_on_device_m(&gpu, &mesh, &skin).expect("the device answers");
        assert_eq!(on_device.len(), mesh.vertices().len());
        for (vertex, drawn) in mesh.vertices().iter().zip(on_device) {
            let twin = SkinnedMesh::skinned_position_m(vertex, &skin);
            assert!(twin.distance(drawn) < 1e-4, "bend {bend}: {twin} on the device {drawn}");
        }
    }
}
