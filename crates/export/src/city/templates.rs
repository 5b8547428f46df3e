//! Templates: the shapes of placed models, each stored once.

use burgeon_scene::{Instance, Scene, SurfaceMeaning};
use rustc_hash::FxHashMap;
use serde_json::{Value as Json, json};

use super::super::check::proper_triangles;
use super::boundaries::{boundaries, level_name, semantics};
use super::faces::{Triangle, TriangleEdges, faces};

/// Maximum distance (m) of a point of a model from a plane that contains it.
const NEAR: f64 = 1e-5;

/// Templates in use, in the order of their first use.
#[derive(Default)]
pub(super) struct ShapeTemplates {
    numbers: FxHashMap<(usize, Option<SurfaceMeaning>), usize>,
    templates: Vec<Json>,
    points: Vec<[f32; 3]>,
}

impl ShapeTemplates {
    /// Returns the number of the template that an instance shows.
    pub(super) fn number(
        &mut self,
        scene: &Scene,
        instance: &Instance,
        has_surfaces: bool,
        detail: u8,
    ) -> usize {
        let key = (instance.mesh, instance.meaning.filter(|_| has_surfaces));
        if let Some(number) = self.numbers.get(&key) {
            return *number;
        }
        let first = self.points.len() as u32;
        let mut numbers: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        let mut triangles: Vec<Triangle> = Vec::new();
        for part in &scene.meshes[instance.mesh].parts {
            let mut number = |at: &glam::Vec3| {
                let at = (*at + 0.0).to_array();
                *numbers.entry(at.map(f32::to_bits)).or_insert_with(|| {
                    self.points.push(at);
                    self.points.len() as u32 - 1 - first
                })
            };
            let of: Vec<u32> = part.positions.iter().map(&mut number).collect();
            for corners in proper_triangles(part.triangles.iter()) {
                let corners = corners.map(|corner| of[corner as usize]);
                let [a, b, c] = corners;
                if a != b && b != c && c != a {
                    triangles.push((corners, key.1));
                }
            }
        }
        let points: Vec<glam::DVec3> =
            self.points[first as usize..].iter().map(|at| glam::Vec3::from(*at).as_dvec3()).collect();
        let faces = faces(&points, &triangles, &TriangleEdges::of(&triangles), NEAR);
        let mut template = json!({
            "type": "MultiSurface",
            "lod": level_name(detail),
            "boundaries": boundaries(&faces, |point| first + point),
        });
        if let Some(semantics) = semantics(&faces, false) {
            template["semantics"] = semantics;
        }
        self.templates.push(template);
        self.numbers.insert(key, self.templates.len() - 1);
        self.templates.len() - 1
    }

    /// Returns the templates as JSON, or `None` if there are none.
    pub(super) fn finish(self) -> Option<Json> {
        let Self { templates, points, .. } = self;
        (!templates.is_empty()).then(|| json!({ "templates": templates, "vertices-templates": points }))
    }
}
