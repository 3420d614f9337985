//! The device's skinning against the processor's.

use glam::{Mat4, Quat, Vec3};
use motion_render::skinning_check::positions_on_device_m;
use motion_scene::color::Theme;
use motion_scene::mesh::SkinnedMesh;

use crate::bodies::tube;
use crate::pictures::gpu;
use crate::scenes::performer;

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

/// The same on a whole body with all its joints, in frames of a walk.
#[test]
fn the_device_skins_a_walking_mannequin_as_the_processor_does() {
    let Some(gpu) = gpu() else { return };
    let actor = performer("walk", Theme::Dark);
    let mesh = &actor.figure.model.levels()[0];
    for frame in [0.0, 17.5, 60.0] {
        let skin = mesh.skin_matrices(&actor.body_at(frame, actor.look).world_from_joint);
        let on_device = positions_on_device_m(&gpu, mesh, &skin).expect("the device answers");
        let twins = mesh.vertices().iter().map(|v| SkinnedMesh::skinned_position_m(v, &skin));
        let furthest = twins.zip(on_device).map(|(twin, drawn)| twin.distance(drawn));
        let furthest = furthest.fold(0.0, f32::max);
        assert!(furthest < 1e-4, "frame {frame}: {furthest} m apart");
    }
}
