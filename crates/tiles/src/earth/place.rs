//! Scenes in the local axes of a tile.

use burgeon_base::error::{Error, Result};
use burgeon_scene::{Normal, Scene};
use glam::{DAffine3, DMat3, DVec3, Vec3, Vec4};

use super::{EarthMap, TileAxes};

/// Moves a scene from the coordinates of its run to the local axes of a tile: x east, y north, z up (m).
///
/// A mesh with one instance is mapped point by point. Instances that share a mesh are moved and turned, and keep the size
/// that they have in the projection. Fails if a point has no position on the earth.
pub fn place_scene(scene: &mut Scene, map: &EarthMap<'_>, axes: &TileAxes) -> Result<()> {
    let mut counts = vec![0_usize; scene.meshes.len()];
    for instance in &scene.instances {
        *counts.get_mut(instance.mesh).ok_or_else(|| Error::internal("an instance has no mesh"))? += 1;
    }
    for instance in &mut scene.instances {
        let given = instance.transform;
        let local = map.around(axes, given.translation)?;
        if counts[instance.mesh] > 1 || given.matrix3.determinant() <= 0.0 {
            let rotation = local.rotation();
            instance.transform = DAffine3 { matrix3: rotation * given.matrix3, translation: local.to };
            continue;
        }
        let turn = (local.slope * given.matrix3).inverse().transpose();
        for part in &mut scene.meshes[instance.mesh].parts {
            for position in &mut part.positions {
                let point = given.transform_point3(position.as_dvec3());
                let image = match local.reaches(point) {
                    true => local.apply(point),
                    false => map.local(axes, point)? - local.to,
                };
                *position = image.as_vec3();
            }
            for normals in part.normals.chunks_mut(4) {
                turn_normals(normals, &turn);
            }
        }
        instance.transform = DAffine3::from_translation(local.to);
    }
    scene.upright = None;
    Ok(())
}

/// Turns up to four normals.
fn turn_normals(normals: &mut [Normal], turn: &DMat3) {
    let mut axes = [[0.0_f32; 4]; 3];
    for (number, normal) in normals.iter().enumerate() {
        let turned = (*turn * normal.vector().as_dvec3()).try_normalize().unwrap_or(DVec3::Z);
        let Vec3 { x, y, z } = turned.as_vec3();
        for (axis, value) in axes.iter_mut().zip([x, y, z]) {
            axis[number] = value;
        }
    }
    let four = Normal::four(axes.map(Vec4::from_array));
    normals.iter_mut().zip(four).for_each(|(normal, turned)| *normal = turned);
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_scene::{Instance, Mesh};
    use burgeon_spatial::{Crs, ReferenceFrame};

    fn scene(instances: &[(usize, DVec3)]) -> Scene {
        let mut scene = Scene::default();
        let material = scene.material(&Default::default());
        for _ in 0..2 {
            let mut mesh = Mesh::default();
            let part = mesh.part(material);
            part.positions = vec![Vec3::ZERO, Vec3::new(90.0, 0.0, 0.0), Vec3::new(0.0, 90.0, 30.0)];
            part.normals = vec![Normal::Z; 3];
            part.uvs = vec![Default::default(); 3];
            part.triangles.push([0, 1, 2]);
            scene.meshes.push(mesh);
        }
        for (mesh, place) in instances {
            scene.instances.push(Instance {
                mesh: *mesh,
                transform: DAffine3::from_translation(*place),
                name: String::new(),
                feature: None,
                origin: None,
                placement: None,
                meaning: None,
            });
        }
        scene
    }

    #[test]
    fn every_point_is_where_the_exact_map_puts_it() {
        let frame = ReferenceFrame::around(&Crs::epsg(2154).unwrap(), [900_000.0, 6_400_000.0], "a").unwrap();
        let map = EarthMap::new(&frame, 48.0).unwrap();
        let axes = map.axes([1000.0, 2000.0]).unwrap();
        let place = DVec3::new(-800.0, 3300.0, 120.0);
        let mut single = scene(&[(0, place), (1, place), (1, place + 40.0)]);
        let before = single.clone();
        place_scene(&mut single, &map, &axes).unwrap();
        for (number, most) in [(0, 2e-4), (1, 0.1), (2, 0.1)] {
            let (was, is) = (&before.instances[number], &single.instances[number]);
            let points = |scene: &Scene, instance: &Instance| -> Vec<DVec3> {
                let positions = &scene.meshes[instance.mesh].parts[0].positions;
                positions.iter().map(|point| instance.transform.transform_point3(point.as_dvec3())).collect()
            };
            for (from, to) in points(&before, was).into_iter().zip(points(&single, is)) {
                let error = (map.local(&axes, from).unwrap() - to).length();
                assert!(error < most, "{number}: {error}");
            }
            assert!(
                (is.transform.translation - map.local(&axes, was.transform.translation).unwrap()).length()
                    < 1e-9
            );
        }
        // At the edge of the projection the grid is turned by about a degree and a half; up stays up.
        assert!(single.meshes[0].parts[0].normals[0].vector().z > 0.999);
    }
}
