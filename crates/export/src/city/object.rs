//! City objects: their ids, classes and shapes.

use std::borrow::Cow;

use crate::layers::OutputPlacement;
use burgeon_base::error::{Error, Result};
use burgeon_scene::{CityClass, Instance, Origin, Scene, SurfaceMeaning};
use burgeon_spatial::Record;
use glam::{DAffine3, DMat3, DVec3};
use rustc_hash::FxHashMap;

use super::super::check::{SceneCheck, proper_triangles};
use super::faces::{Face, Triangle, TriangleEdges, faces, volume};
use crate::SceneFacts;

/// City object with all instances that its chain has added to the scene.
pub(super) struct CityObject<'a> {
    pub(super) id: String,
    pub(super) class: CityClass,
    pub(super) record: Option<(&'a [String], &'a Record)>,
    /// Instances that the chain has drawn itself.
    drawn: Vec<&'a Instance>,
    /// Instances of models that the chain has placed.
    pub(super) placed: Vec<&'a Instance>,
}

/// Drawn shape of a city object, in quantised coordinates.
pub(super) struct ObjectShape {
    pub(super) points: Vec<[i64; 3]>,
    pub(super) faces: Vec<Face>,
    /// Set if the faces enclose a volume.
    pub(super) closed: bool,
}

/// Conversion of points of the scene to the integer coordinates of the file.
pub(super) struct Quantiser<'a> {
    pub(super) outward: &'a OutputPlacement<'a>,
    /// Origin of the integer coordinates.
    pub(super) origin: DVec3,
}

/// Quantisation steps per metre.
pub(super) const STEPS: f64 = 1000.0;
/// Maximum distance (m) of a point from a plane that contains it: twice the rounding error.
const NEAR: f64 = 2e-3;

impl<'a> Quantiser<'a> {
    /// Returns the conversion whose origin is the lowest corner of a scene, in whole metres.
    pub(super) fn new(scene: &Scene, outward: &'a OutputPlacement<'a>) -> Self {
        let low = scene.bounds().map_or(DVec3::ZERO, |(low, _)| low);
        Self { outward, origin: outward.place(low).unwrap_or_default().floor() + 0.0 }
    }

    /// Returns the quantised coordinates of a point (m). Fails if the point is outside the projection's domain.
    pub(super) fn place(&self, at: DVec3) -> Result<[i64; 3]> {
        let place = self.outward.place(at).ok_or_else(|| place_error(at))?;
        let steps = ((place - self.origin) * STEPS).round();
        #[allow(clippy::cast_possible_truncation, reason = "a scene that was checked ends before")]
        Ok(steps.to_array().map(|step| step as i64))
    }

    /// Returns the rotation that the projection applies near a point (m).
    pub(super) fn turn(&self, at: DVec3) -> DMat3 {
        let east = self.outward.place(at + DVec3::X).zip(self.outward.place(at)).map(|(to, from)| to - from);
        let angle = east.map_or(0.0, |east| east.y.atan2(east.x));
        DMat3::from_rotation_z(angle)
    }
}

fn place_error(at: DVec3) -> Error {
    Error::data(format!(
        "the position {}, {} m cannot be converted to the coordinate system of the data",
        at.x, at.y
    ))
    .help("remove it, or read the data in a projection that extends that far")
}

/// Returns the city objects of a scene, in the order of their first instances.
pub(super) fn objects<'a>(checked: &SceneCheck<'a>, facts: &SceneFacts<'a>) -> Vec<CityObject<'a>> {
    let scene = checked.scene;
    let mut known: FxHashMap<Option<Origin>, usize> = FxHashMap::default();
    let mut objects: Vec<CityObject<'a>> = Vec::new();
    let mut ids = Identifiers::default();
    for instance in scene.instances.iter().filter(|instance| checked.meshes[instance.mesh]) {
        let key = instance.origin;
        let index = *known.entry(key).or_insert_with(|| {
            let system = key.and_then(|key| facts.systems.iter().find(|it| it.system == key.system));
            let record = system.zip(key.and_then(|key| key.record)).and_then(|(system, record)| {
                Some((system.records.columns.as_slice(), system.records.records.get(record)?))
            });
            let id = match (&instance.feature, key) {
                (Some(feature), _) => Cow::Borrowed(feature.as_str()),
                (None, Some(Origin { system, chain, .. })) => {
                    Cow::Owned(format!("system {} chain {}", system + 1, chain + 1))
                }
                (None, None) => Cow::Borrowed("model"),
            };
            objects.push(CityObject {
                id: ids.unique_id(&id),
                class: system.and_then(|system| system.class).unwrap_or(CityClass::GENERIC),
                record,
                drawn: Vec::new(),
                placed: Vec::new(),
            });
            objects.len() - 1
        });
        let object = &mut objects[index];
        if object.class == CityClass::GENERIC && is_building(scene, instance) {
            object.class = CityClass::BUILDING;
        }
        if instance.placement.is_some() { &mut object.placed } else { &mut object.drawn }.push(instance);
    }
    for object in objects.iter_mut().filter(|object| !object.class.takes_instances()) {
        let placed = std::mem::take(&mut object.placed);
        object.drawn.extend(placed);
    }
    objects
}

/// Returns true if a part of an instance is marked as a surface of a building.
fn is_building(scene: &Scene, instance: &Instance) -> bool {
    let parts = &scene.meshes[instance.mesh].parts;
    instance.placement.is_none() && parts.iter().any(|part| !part.surfaces.is_empty())
}

/// Ids that are in use, each with the last number that was appended to it.
#[derive(Default)]
pub(super) struct Identifiers(FxHashMap<String, usize>);

impl Identifiers {
    pub(super) fn unique_id(&mut self, id: &str) -> String {
        let id = if id.is_empty() { "_" } else { id };
        let mut free = Cow::Borrowed(id);
        while self.0.contains_key(&*free)
            && let Some(count) = self.0.get_mut(id)
        {
            *count += 1;
            free = Cow::Owned(format!("{id}.{count}"));
        }
        let free = free.into_owned();
        self.0.insert(free.clone(), 1);
        free
    }
}

impl CityObject<'_> {
    /// Returns the drawn shape.
    pub(super) fn shape(&self, scene: &Scene, quantiser: &Quantiser<'_>) -> Result<ObjectShape> {
        let mut builder = ShapeBuilder::default();
        for instance in &self.drawn {
            let mirrored = instance.transform.matrix3.determinant() < 0.0;
            for part in &scene.meshes[instance.mesh].parts {
                let place = |at: &glam::Vec3| {
                    quantiser
                        .place(instance.transform.transform_point3(at.as_dvec3()))
                        .map(|at| builder.point(at))
                };
                let numbers: Vec<u32> = part.positions.iter().map(place).collect::<Result<_>>()?;
                for (range, own) in part.surfaces.stretches(part.triangles.len()) {
                    let meaning = instance.meaning.or(own).filter(|_| self.class.has_surfaces());
                    for [a, b, c] in proper_triangles(part.triangles.range(range)) {
                        let [a, b, c] = if mirrored { [a, c, b] } else { [a, b, c] };
                        builder.triangle([a, b, c].map(|corner| numbers[corner as usize]), meaning);
                    }
                }
            }
        }
        Ok(builder.finish())
    }
}

/// Distinct points, and triangles between them.
#[derive(Default)]
struct ShapeBuilder {
    points: Vec<[i64; 3]>,
    numbers: FxHashMap<[i64; 3], u32>,
    triangles: Vec<Triangle>,
}

impl ShapeBuilder {
    fn point(&mut self, at: [i64; 3]) -> u32 {
        *self.numbers.entry(at).or_insert_with(|| {
            self.points.push(at);
            (self.points.len() - 1) as u32
        })
    }

    fn triangle(&mut self, corners: [u32; 3], meaning: Option<SurfaceMeaning>) {
        let [a, b, c] = corners;
        if a != b && b != c && c != a {
            self.triangles.push((corners, meaning));
        }
    }

    fn finish(self) -> ObjectShape {
        let first = self.points.first().copied().unwrap_or_default();
        let near = |at: &[i64; 3]| DVec3::from([0, 1, 2].map(|axis| (at[axis] - first[axis]) as f64 / STEPS));
        let near: Vec<DVec3> = self.points.iter().map(near).collect();
        let edges = TriangleEdges::of(&self.triangles);
        let closed = edges.are_closed() && volume(&near, &self.triangles) > 0.0;
        let mut faces = faces(&near, &self.triangles, &edges, NEAR);
        // Points that no face uses are removed.
        let mut numbers: Vec<Option<u32>> = vec![None; self.points.len()];
        let mut points = Vec::new();
        for point in faces.iter_mut().flat_map(|face| face.rings.iter_mut().flatten()) {
            *point = *numbers[*point as usize].get_or_insert_with(|| {
                points.push(self.points[*point as usize]);
                points.len() as u32 - 1
            });
        }
        ObjectShape { points, faces, closed }
    }
}

/// Returns the transform of a placed model: its matrix, rotated with the projection, and its position.
pub(super) fn placed_transform(instance: &Instance, quantiser: &Quantiser<'_>) -> Result<(DMat3, [i64; 3])> {
    let DAffine3 { matrix3, translation } = instance.transform;
    Ok((quantiser.turn(translation) * matrix3, quantiser.place(translation)?))
}
