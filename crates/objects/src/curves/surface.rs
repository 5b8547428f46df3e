//! Surfaces of control points as values: `surface` in scripts.

use std::hash::{Hash as _, Hasher};
use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_geometry::{SplineSurface, SurfaceGrid, SurfaceKind};
use burgeon_kit::declare::as_ref;
use burgeon_kit::{
    Answer, ControlPoints, HasControlPoints, Object, ObjectContent, ObjectParameter, PointRows, PointSpace,
    Value, Vector, fields, methods, object,
};
use burgeon_scene::Part;
use glam::{DAffine3, DVec3};

use super::choice::{name_of, position, variant};

/// Names of the relations of a surface to its points.
const KINDS: [(&str, SurfaceKind); 3] =
    [("bezier", SurfaceKind::Bezier), ("b-spline", SurfaceKind::BSpline), ("nurbs", SurfaceKind::Nurbs)];
/// Maximum number of divisions of a patch.
const MOST_DIVISIONS: u32 = 256;

/// Fields of `surface { ... }`.
#[fields("surface")]
pub struct SplineSurfaceOptions {
    /// Rows of control points (m), all of one length. Along a row u increases from 0 to 1, from row to row v.
    pub points: Vec<Vec<Vector>>,
    /// Relation to the points: "bezier", patches of 4 rows of 4 points that share their border points; "b-spline"; or
    /// "nurbs", with weights.
    #[default("bezier".into())]
    pub kind: String,
    /// Rows of weights above 0 of a "nurbs" surface, one for each point.
    pub weights: Option<Vec<Vec<f64>>>,
    /// Degree of a "b-spline" or "nurbs" surface in both directions, from 1 to 7; 3 if omitted, and less with few points.
    pub degree: Option<u32>,
    /// Knots along u of a "b-spline" or "nurbs" surface; uniform if omitted.
    pub u_knots: Option<Vec<f64>>,
    /// Knots along v, as along u.
    pub v_knots: Option<Vec<f64>>,
    /// Number of divisions of each patch in both directions when it is drawn, from 1 to 256.
    #[default(8)]
    pub divisions: u32,
}

/// A surface of control points: Bezier patches, a B-spline or NURBS, such as a leaf or a petal.
///
/// It never changes. A turtle draws it with `surface`.
#[object(
    "surface",
    can(ObjectContent, HasControlPoints),
    options = SplineSurfaceOptions,
    first = "points",
    example = include_str!("../../scripts/surface.lua"),
)]
pub struct SurfaceObject {
    surface: Arc<SplineSurface>,
    divisions: u32,
}

#[methods("surface")]
impl SurfaceObject {
    /// Returns the position (m) at `u` along the rows and `v` across them, both from 0 to 1.
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        self.surface.point(u, v)
    }

    /// Returns the normal, a vector of length 1, at `u` and `v`: that of the side from which u runs to the right and v
    /// upwards.
    pub fn normal(&self, u: f64, v: f64) -> DVec3 {
        self.surface.normal(u, v)
    }

    /// Returns the surface between this one (`t` is 0) and another (`t` is 1). Surfaces of the same kind with as many
    /// points are mixed point by point; others are resampled at equal u and v.
    pub fn mix(&self, other: Arc<Self>, t: f64) -> Result<Self> {
        let mixed = self.surface.mix(&other.surface, t).map_err(|error| error.about("surface:mix"))?;
        Ok(Self { surface: Arc::new(mixed), divisions: self.divisions.max(other.divisions) })
    }
}

impl SurfaceObject {
    /// Creates the surface of the points.
    ///
    /// ```
    /// use burgeon_kit::Vector;
    /// use burgeon_objects::{SurfaceObject, SplineSurfaceOptions};
    /// use glam::DVec3;
    ///
    /// let row = |y: f64| vec![Vector(DVec3::new(0.0, y, 0.0)), Vector(DVec3::new(2.0, y, 0.0))];
    /// let (points, kind) = (vec![row(0.0), row(1.0)], "b-spline".to_owned());
    /// let flat = SurfaceObject::new(SplineSurfaceOptions { points, kind, ..SplineSurfaceOptions::default() })?;
    /// assert_eq!((flat.point(0.5, 1.0), flat.normal(0.0, 0.0)), (DVec3::new(1.0, 1.0, 0.0), DVec3::Z));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(options: SplineSurfaceOptions) -> Result<Self> {
        let kind = variant("surface", "kind", &options.kind, &KINDS)?;
        let divisions = options.divisions;
        if !(1..=MOST_DIVISIONS).contains(&divisions) {
            let message = format!("surface: divisions must be from 1 to {MOST_DIVISIONS}, not {divisions}");
            return Err(Error::argument(message));
        }
        let points = options.points.iter().map(|row| row.iter().map(|point| point.0).collect());
        let grid = SurfaceGrid {
            points: points.collect(),
            weights: options.weights,
            degree: options.degree.map(|degree| degree as usize),
            knots: [options.u_knots, options.v_knots],
        };
        let surface = SplineSurface::new(kind, grid).map_err(|error| error.about("surface"))?;
        Ok(Self { surface: Arc::new(surface), divisions })
    }

    /// Adds the triangles at `transform` to `part`.
    pub(crate) fn draw(&self, part: &mut Part, transform: &DAffine3) -> Result<()> {
        self.surface.draw(part, transform, self.divisions as usize)
    }
}

impl ObjectContent for SurfaceObject {
    fn equals(&self, other: &dyn Object) -> bool {
        let other = as_ref::<Self>(other);
        other.is_some_and(|other| self.surface == other.surface && self.divisions == other.divisions)
    }

    fn hash(&self, mut state: &mut dyn Hasher) {
        (self.surface.sizes(), self.divisions).hash(&mut state);
        // The two zeros are equal.
        self.surface.numbers().for_each(|number| (number + 0.0).to_bits().hash(&mut state));
    }

    fn text(&self) -> String {
        let [columns, rows] = self.surface.sizes();
        format!("surface of {rows} rows of {columns} points")
    }

    fn memory(&self) -> usize {
        self.surface.memory()
    }

    fn position(&self) -> Option<DVec3> {
        None
    }

    fn fragments(&self) -> Option<Vec<Value>> {
        None
    }
}

impl HasControlPoints for SurfaceObject {
    fn control_points(&self) -> Option<ControlPoints> {
        let points = self.surface.points().iter().map(|point| point.to_array().into());
        Some(ControlPoints {
            points: PointRows(points.collect()),
            space: PointSpace::Space,
            kind: name_of(self.surface.kind(), &KINDS),
            closed: false,
            columns: Some(self.surface.sizes()[0]),
        })
    }

    fn with_control_points(&self, points: &PointRows) -> Result<Arc<dyn Object>> {
        let points = points.0.iter().map(|row| position(row)).collect();
        let surface = Arc::new(self.surface.with_points(points)?);
        Ok(Arc::new(Self { surface, divisions: self.divisions }))
    }

    fn bezier_pieces(&self) -> Vec<[[f64; 3]; 4]> {
        self.surface.isolines().iter().map(|piece| piece.map(|point| point.to_array())).collect()
    }
}

impl ObjectParameter for SurfaceObject {
    const LUAU: &str = "Surface";
    const EXPECTED: &str = "a surface: surface({ points = { { vec(...), ... }, ... } })";
}

impl Answer for SurfaceObject {
    fn luau() -> String {
        Self::LUAU.into()
    }

    fn answer(self) -> Result<Value> {
        Ok(Value::Object(Arc::new(self)))
    }
}
