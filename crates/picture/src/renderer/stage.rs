//! Scene prepared for rendering: checked, rotated upright, moved to the origin and scaled to unit size.
//!
//! Instances are not expanded. A triangle is identified by its number in the order of instances, parts and triangles,
//! and is found by a search in the draws.

use super::camera::Camera;
use super::clip::clip;
use super::extent::Extent;
use super::points::{self, SceneOutlines, StageFrame, to_single};
use super::texture::{MaterialImages, SampledTexture};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::stop::Stop;
use burgeon_scene::{Material, Mesh, Part, Scene, Triangles};
use glam::{Affine3A, DAffine3, DVec3, Mat3A, Vec3, Vec3A};
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

/// Maximum length of the sum of the areas of a closed surface, as vectors, relative to the sum of their lengths.
const CLOSED: f64 = 1e-3;
/// Minimum number of triangles of a mesh for which fewer sides of its tubes save more time than they take.
const MANY: usize = 10_000;

/// Scene around the origin, in units of the radius of the sphere around its box.
pub(super) struct Stage<'a> {
    /// Parts of all instances in order; their triangles are numbered consecutively.
    pub draws: Vec<DrawCall<'a>>,
    /// Materials of the scene.
    pub materials: &'a [Material],
    /// Minimum and maximum corner of the model's bounding box.
    pub bounds: (Vec3A, Vec3A),
    /// Points whose convex hull contains the model and is hardly larger.
    pub hull: Vec<Vec3A>,
    /// Transform from the world to the stage.
    pub shrink: DAffine3,
    count: u32,
    outlines: SceneOutlines<'a>,
    /// Cancellation signal. After cancellation nothing more is drawn.
    pub stop: &'a Stop,
}

/// Part of an instance.
pub(super) struct DrawCall<'a> {
    /// Part with the corners.
    pub part: &'a Part,
    /// Triangles of the part, or fewer for thin tubes.
    pub triangles: Cow<'a, Triangles>,
    /// Transform from the mesh's coordinates to the stage's.
    pub place: Affine3A,
    /// Transform of normals, whose lengths it changes.
    pub turn: Mat3A,
    /// Transform at double precision: corners shared by meshes coincide, regardless of the meshes' origins.
    exact: DAffine3,
    /// Number of its first triangle.
    pub first: u32,
    /// Set if the transform reverses the orientation of triangles.
    pub mirrored: bool,
    /// Opacity of the material, 0 to 1.
    pub opacity: f32,
    /// Texture of the material, if it has holes.
    pub cutout: Option<&'a SampledTexture>,
    /// Set if both sides are visible.
    pub double_sided: bool,
    /// Set if the part belongs to a closed solid, so that only its lit side casts shadows.
    closed: bool,
}

/// Triangle, or a clipped part of one, after projection to a view.
pub(super) struct ProjectedTriangle {
    /// Number of the triangle.
    pub number: u32,
    /// Corners after the projection.
    pub corners: [Vec3A; 3],
    /// Weights of each corner relative to the triangle's own corners, if the triangle was clipped.
    pub weights: Option<[Vec3A; 3]>,
}

impl<'a> Stage<'a> {
    /// Checks `scene` and measures it. Fails if an index is out of range or if the triangles are too many to number.
    pub(super) fn new(scene: &'a Scene) -> Result<Self> {
        static NEVER: Stop = Stop::new();
        Self::within(scene, &[], None, false, &NEVER)
    }

    /// Prepares `scene` as [`new`](Self::new) does, with the `images` of the materials, relative to the centre and
    /// the radius of `extent`. If the stage `is_shared`, the bounding box and the hull are those of the extent, and
    /// the scene is not measured.
    pub(super) fn within(
        scene: &'a Scene,
        images: &'a [MaterialImages],
        extent: Option<&Extent>,
        is_shared: bool,
        stop: &'a Stop,
    ) -> Result<Self> {
        check(scene)?;
        stop.check()?;
        let shared = extent.filter(|extent| is_shared && !extent.is_empty());
        let outlines = match shared {
            Some(_) => SceneOutlines::empty(scene),
            None => SceneOutlines::new(scene),
        };
        let StageFrame { shrink, bounds } = outlines.frame(extent);
        let closed: Vec<bool> = scene.meshes.par_iter().map(is_closed).collect();
        let mut draws = Vec::new();
        let mut count = 0_u32;
        for instance in &scene.instances {
            let exact = shrink * instance.transform;
            if !exact.is_finite() {
                continue;
            }
            let place = to_single(&exact);
            let mirrored = place.matrix3.determinant() < 0.0;
            let turn = place.matrix3.inverse().transpose();
            for part in &scene.meshes[instance.mesh].parts {
                let material = &scene.materials[part.material];
                let (opacity, double_sided) = (material.base_color[3], material.double_sided);
                let texture = images.get(part.material).and_then(|images| images.texture.as_ref());
                let cutout = texture.filter(|texture| texture.has_holes());
                draws.push(DrawCall {
                    part,
                    triangles: Cow::Borrowed(&part.triangles),
                    place,
                    turn,
                    exact,
                    first: count,
                    mirrored,
                    opacity,
                    cutout,
                    double_sided,
                    closed: closed[instance.mesh] && !double_sided,
                });
                let length = u32::try_from(part.triangles.len()).ok();
                count = length
                    .and_then(|length| count.checked_add(length))
                    .filter(|count| *count < u32::MAX)
                    .ok_or_else(|| {
                        Error::limit(Limit::Size, "the scene has more than 4294 million triangles")
                            .help("draw a part of it, or simplify the meshes")
                    })?;
            }
        }
        draws.retain(|draw: &DrawCall<'a>| !draw.triangles.is_empty());
        let materials = &scene.materials;
        let mut stage = Self { draws, materials, bounds, hull: Vec::new(), shrink, count, outlines, stop };
        match shared {
            Some(extent) => stage.surround(&extent.points(&stage.shrink)),
            None => stage.hull = points::hull(stage.points(), bounds),
        }
        Ok(stage)
    }

    /// Replaces the bounding box and the hull by those of `points`, unless there are none.
    fn surround(&mut self, points: &[Vec3A]) {
        let bounds = points.iter().fold(None, |bounds: Option<(Vec3A, Vec3A)>, point| {
            Some(bounds.map_or((*point, *point), |(low, high)| (low.min(*point), high.max(*point))))
        });
        if let Some(bounds) = bounds {
            (self.bounds, self.hull) = (bounds, points.to_vec());
        }
    }

    /// Draws tubes that are thinner than `pixels` with fewer sides, in meshes of many triangles that have one instance.
    pub(super) fn reduce_tubes(&mut self, camera: &Camera, pixels: f32) {
        let mut uses: HashMap<*const Part, usize> = HashMap::default();
        for draw in &self.draws {
            *uses.entry(std::ptr::from_ref(draw.part)).or_default() += 1;
        }
        for draw in &mut self.draws {
            let part = draw.part;
            if part.triangles.len() < MANY || uses[&std::ptr::from_ref(part)] > 1 {
                continue;
            }
            let (place, stop) = (draw.place, self.stop);
            let reduced = part.triangles.with_fewer_sides(|corners| {
                if stop.is_stopped() {
                    return false;
                }
                let at = corners.map(|i| place.transform_point3a(part.positions[i as usize].into()));
                let least = pixels * camera.footprint(at[0]);
                let size = (at[2] - at[0]).length_squared().max((at[3] - at[1]).length_squared());
                least > 0.0 && size < least * least
            });
            draw.triangles = reduced.map_or(Cow::Borrowed(&part.triangles), Cow::Owned);
        }
        self.count = 0;
        for draw in &mut self.draws {
            draw.first = self.count;
            // There are not more triangles than before.
            self.count += draw.triangles.len() as u32;
        }
    }

    /// Returns the number of triangles, counted for each instance.
    pub(super) fn triangles(&self) -> usize {
        self.count as usize
    }

    /// Returns points whose extent in every direction equals the model's extent to within a percent.
    pub(super) fn points(&self) -> impl Iterator<Item = Vec3A> {
        self.outlines.stage_points(self.shrink)
    }

    /// Returns the numbers of all triangles, divided into ranges of work for one thread.
    pub(super) fn batches(&self) -> Vec<Range<u32>> {
        let size = 8192;
        (0..self.count.div_ceil(size)).map(|i| i * size..((i + 1) * size).min(self.count)).collect()
    }

    /// Returns the draw that contains triangle `number`, and the triangle's index in its part.
    pub(super) fn find(&self, number: u32) -> (&DrawCall<'a>, usize) {
        let index = self.draws.partition_point(|draw| draw.first <= number) - 1;
        let draw = &self.draws[index];
        (draw, (number - draw.first) as usize)
    }

    /// Returns the same as [`find`](Self::find). `hint` is the index of a draw that may contain the triangle, and becomes the
    /// index of the one that does.
    pub(super) fn find_near(&self, number: u32, hint: &mut usize) -> (&DrawCall<'a>, usize) {
        let is_here = |draw: &&DrawCall<'a>| {
            number.checked_sub(draw.first).is_some_and(|index| (index as usize) < draw.triangles.len())
        };
        if !self.draws.get(*hint).as_ref().is_some_and(is_here) {
            *hint = self.draws.partition_point(|draw| draw.first <= number) - 1;
        }
        let draw = &self.draws[*hint];
        (draw, (number - draw.first) as usize)
    }

    /// Calls `emit` with the draw and each triangle in `numbers` that casts a shadow in a map with the projection `view`,
    /// at single precision. Of closed solids these are the triangles that face the light.
    pub(super) fn each_caster(
        &self,
        numbers: Range<u32>,
        view: &Affine3A,
        mut emit: impl FnMut(&DrawCall<'a>, ProjectedTriangle),
    ) {
        let mut corners: Vec<Vec3A> = Vec::new();
        let start = self.draws.partition_point(|draw| draw.first <= numbers.start).saturating_sub(1);
        for draw in self.draws.get(start..).unwrap_or_default() {
            if draw.first >= numbers.end || self.stop.is_stopped() {
                break;
            }
            let from = (numbers.start.max(draw.first) - draw.first) as usize;
            let to = ((numbers.end - draw.first) as usize).min(draw.triangles.len());
            let Some((least, most)) = draw.triangles.corner_bounds(from..to) else { continue };
            let place = *view * draw.place;
            let project = |point: &Vec3| place.transform_point3a(Vec3A::from(*point));
            let positions = &draw.part.positions;
            let dense = ((most - least) as usize) < 3 * (to - from);
            if dense {
                corners.clear();
                corners.extend(positions[least as usize..=most as usize].iter().map(project));
            }
            let first = draw.first + from as u32;
            for (number, numbers) in (first..).zip(draw.triangles.range(from..to)) {
                let [a, b, c] = match dense {
                    true => numbers.map(|i| corners[(i - least) as usize]),
                    false => numbers.map(|i| project(&positions[i as usize])),
                };
                if draw.closed {
                    let turn = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
                    if (turn < 0.0) != draw.mirrored {
                        continue;
                    }
                }
                if (a + b + c).is_finite() {
                    emit(draw, ProjectedTriangle { number, corners: [a, b, c], weights: None });
                }
            }
        }
    }

    /// Calls `emit` with the draw and each triangle in `numbers`, its corners transformed by `view` and `project`.
    ///
    /// Triangles with a corner that `project` cannot project are clipped at the plane at the distance `near` and at side
    /// planes with a slope, if given.
    /// Triangles with a corner that is not finite are skipped.
    pub(super) fn each_triangle(
        &self,
        numbers: Range<u32>,
        view: &Affine3A,
        project: impl Fn(Vec3A) -> Vec3A,
        near: Option<[f32; 2]>,
        mut emit: impl FnMut(&DrawCall<'a>, ProjectedTriangle),
    ) {
        if numbers.is_empty() {
            return;
        }
        let mut corners: Vec<Vec3A> = Vec::new();
        let start = self.draws.partition_point(|draw| draw.first <= numbers.start) - 1;
        for draw in &self.draws[start..] {
            if draw.first >= numbers.end || self.stop.is_stopped() {
                break;
            }
            let from = (numbers.start.max(draw.first) - draw.first) as usize;
            let to = ((numbers.end - draw.first) as usize).min(draw.triangles.len());
            let triangles = draw.triangles.range(from..to);
            let matrix = to_double(view) * draw.exact;
            let place = |point: &Vec3| matrix.transform_point3(point.as_dvec3()).as_vec3a();
            let turn = |point: &Vec3| project(place(point));
            let Some((least, most)) = draw.triangles.corner_bounds(from..to) else { continue };
            let (least, most) = (least as usize, most as usize);
            let positions = &draw.part.positions;
            // Neighbours share corners, so transforming the whole range is cheaper unless the range is sparse.
            let dense = most - least < 3 * triangles.len();
            if dense {
                corners.clear();
                corners.extend(positions[least..=most].iter().map(turn));
            }
            let first = draw.first + from as u32;
            for (number, numbers) in (first..).zip(triangles) {
                let triangle = if dense {
                    numbers.map(|i| corners[i as usize - least])
                } else {
                    numbers.map(|i| turn(&positions[i as usize]))
                };
                if triangle.iter().all(|corner| corner.is_finite()) {
                    emit(draw, ProjectedTriangle { number, corners: triangle, weights: None });
                    continue;
                }
                let placed = numbers.map(|i| place(&positions[i as usize]));
                let Some(near) = near.filter(|_| placed.iter().all(|corner| corner.is_finite())) else {
                    continue;
                };
                clip(placed, near, |corners, weights| {
                    // Rounding can place a corner behind the plane, so move it onto the plane.
                    let corners = corners.map(|corner| project(corner.with_z(corner.z.max(near[0]))));
                    emit(draw, ProjectedTriangle { number, corners, weights: Some(weights) });
                });
            }
        }
    }
}

/// Returns true if as much of the surface of `mesh` faces each direction as faces away from it, as with all closed solids.
fn is_closed(mesh: &Mesh) -> bool {
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for part in &mesh.parts {
        for numbers in part.triangles.iter() {
            let [a, b, c] = numbers.map(|i| part.positions[i as usize]);
            let cross = (b - a).cross(c - a).as_dvec3();
            if cross.is_finite() {
                sum += cross;
                total += cross.length();
            }
        }
    }
    sum.length() < CLOSED * total
}

/// Converts `place` to double precision.
fn to_double(place: &Affine3A) -> DAffine3 {
    DAffine3 { matrix3: place.matrix3.as_dmat3(), translation: place.translation.as_dvec3() }
}

/// Fails if an index of the scene is out of range.
pub(super) fn check(scene: &Scene) -> Result<()> {
    for (number, instance) in scene.instances.iter().enumerate() {
        if instance.mesh >= scene.meshes.len() {
            return Err(scene_error(format!(
                "instance {number} refers to mesh {} of {}",
                instance.mesh,
                scene.meshes.len()
            )));
        }
    }
    for (number, mesh) in scene.meshes.iter().enumerate() {
        for part in &mesh.parts {
            if part.material >= scene.materials.len() {
                let message = format!(
                    "mesh {number} refers to material {} of {}",
                    part.material,
                    scene.materials.len()
                );
                return Err(scene_error(message));
            }
            let corners = part.positions.len();
            let most = part.triangles.corner_bounds(0..part.triangles.len()).map_or(0, |(_, most)| most);
            if most as usize >= corners && !part.triangles.is_empty() {
                let outside = |corner: &u32| *corner as usize >= corners;
                let corner = part.triangles.iter().flatten().find(outside).unwrap_or(most);
                return Err(scene_error(format!("mesh {number} refers to corner {corner} of {corners}")));
            }
        }
    }
    Ok(())
}

fn scene_error(message: String) -> Error {
    Error::internal(message)
        .help("count indices from 0, and add meshes, materials and corners before referring to them")
}

#[cfg(test)]
mod tests {
    use super::super::light_map::LightProjection;
    use super::super::samples;
    use super::*;

    #[test]
    fn a_triangle_is_found_by_its_number() {
        let mut scene = samples::boxes(&[DVec3::ZERO, DVec3::new(5.0, 0.0, 0.0)]);
        scene.instances.push(scene.instances[0].clone());
        let stage = Stage::new(&scene).unwrap();
        assert_eq!(stage.triangles(), 36);
        let mut seen = 0;
        stage.each_triangle(
            5..30,
            &Affine3A::IDENTITY,
            |p| p,
            None,
            |draw, ProjectedTriangle { number, .. }| {
                let (found, index) = stage.find(number);
                assert_eq!((found.first, index), (draw.first, (number - draw.first) as usize));
                seen += 1;
            },
        );
        assert_eq!(seen, 25);
    }

    #[test]
    fn a_closed_solid_casts_shadows_with_half_of_its_triangles_and_a_sheet_with_all() {
        let mut scene = samples::boxes(&[DVec3::ZERO]);
        scene.instances[0].transform = DAffine3::from_scale(DVec3::new(1.0, -2.0, 1.0));
        let casters = |scene: &Scene| {
            let stage = Stage::new(scene).unwrap();
            let frame = LightProjection::fit(&stage.hull, Vec3A::new(0.48, 0.6, 0.64), 20.0);
            let mut sum = 0.0;
            let mut seen = 0;
            stage.each_caster(0..stage.triangles() as u32, &frame.to_texels, |_, triangle| {
                sum += triangle.corners.iter().map(|corner| corner.z).sum::<f32>() / 3.0;
                seen += 1;
            });
            (seen, sum / seen as f32 / frame.depth)
        };
        let (seen, depth) = casters(&scene);
        assert!(seen == 6 && depth < 0.5, "{seen} triangles at the depth {depth}");
        scene.meshes[0].parts[0].triangles.truncate(10);
        assert_eq!(casters(&scene).0, 10);
    }

    #[test]
    fn an_index_out_of_range_is_refused() {
        let mut scene = samples::boxes(&[DVec3::ZERO]);
        scene.instances[0].mesh = 7;
        assert!(Stage::new(&scene).err().unwrap().to_string().contains("mesh 7 of 1"));
        let mut scene = samples::boxes(&[DVec3::ZERO]);
        scene.meshes[0].parts[0].triangles.push([0, 1, 99]);
        assert!(Stage::new(&scene).err().unwrap().to_string().contains("corner 99 of 24"));
    }
}
