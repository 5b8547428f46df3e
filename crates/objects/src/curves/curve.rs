//! Curves as values: `curve` in scripts.

use std::hash::{Hash as _, Hasher};
use std::sync::{Arc, OnceLock};

use burgeon_base::error::Result;
use burgeon_geometry::{Curve, CurveKind, check_contour};
use burgeon_kit::declare::as_ref;
use burgeon_kit::{
    Answer, ControlPoints, HasControlPoints, Object, ObjectContent, ObjectParameter, PointRows, PointSpace,
    Value, Vector, fields, methods, object,
};
use glam::DVec3;

use super::choice::{name_of, position, variant};

/// Names of the relations of a curve to its points.
const KINDS: [(&str, CurveKind); 4] = [
    ("through", CurveKind::Through),
    ("b-spline", CurveKind::BSpline),
    ("bezier", CurveKind::Bezier),
    ("linear", CurveKind::Linear),
];

/// Fields of `curve { ... }`.
#[fields("curve")]
pub struct CurveOptions {
    /// Points that define the curve (m).
    pub points: Vec<Vector>,
    /// Relation to the points: "through", a smooth curve through them; "b-spline", with the points as control points;
    /// "bezier", cubic pieces with a point of the curve and two control points in turn; or "linear".
    #[default("through".into())]
    pub kind: String,
    /// The end is joined to the start, as in a contour.
    pub closed: bool,
}

/// A curve in space or in a plane, with positions and tangents by the part of its length.
///
/// It never changes. A closed curve in the plane z = 0 is a contour.
#[object(
    "curve",
    can(ObjectContent, HasControlPoints),
    options = CurveOptions,
    first = "points",
    example = include_str!("../../scripts/curve.lua"),
)]
pub struct CurveObject {
    curve: Arc<Curve>,
    /// Result of the check as a contour, made by the first use.
    contour: Arc<OnceLock<Result<()>>>,
}

#[methods("curve")]
impl CurveObject {
    /// Returns the position (m) at the part `t` of the length: 0 is the start, 1 is the end. Beyond them, an open curve
    /// stays at its end, and a closed curve continues.
    pub fn point(&self, t: f64) -> DVec3 {
        self.curve.point(t)
    }

    /// Returns the direction, a vector of length 1, at the part `t` of the length.
    pub fn tangent(&self, t: f64) -> DVec3 {
        self.curve.tangent(t)
    }

    /// Returns the length (m).
    pub fn length(&self) -> f64 {
        self.curve.length()
    }

    /// Returns the curve between this one (`t` is 0) and another (`t` is 1). Curves of the same kind with as many
    /// points are mixed point by point; others are resampled by length.
    pub fn mix(&self, other: Arc<Self>, t: f64) -> Result<Self> {
        let mixed = self.curve.mix(&other.curve, t).map_err(|error| error.about("curve:mix"))?;
        Ok(Self::from(mixed))
    }
}

impl CurveObject {
    /// Creates the curve of the points.
    ///
    /// ```
    /// use burgeon_kit::Vector;
    /// use burgeon_objects::{CurveObject, CurveOptions};
    /// use glam::DVec3;
    ///
    /// let points = vec![Vector(DVec3::ZERO), Vector(DVec3::X), Vector(DVec3::ONE)];
    /// let bend = CurveObject::new(CurveOptions { points, ..CurveOptions::default() })?;
    /// assert_eq!((bend.point(0.0), bend.point(1.0)), (DVec3::ZERO, DVec3::ONE));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(options: CurveOptions) -> Result<Self> {
        let kind = variant("curve", "kind", &options.kind, &KINDS)?;
        let points: Vec<DVec3> = options.points.iter().map(|point| point.0).collect();
        let curve = Curve::new(&points, kind, options.closed).map_err(|error| error.about("curve"))?;
        Ok(Self::from(curve))
    }

    /// Returns the curve.
    pub fn curve(&self) -> &Arc<Curve> {
        &self.curve
    }

    /// Returns the curve as the contour of a generalised cylinder. Fails if it is open, not flat, or crosses itself.
    pub(crate) fn contour(&self) -> Result<&Arc<Curve>> {
        self.contour.get_or_init(|| check_contour(&self.curve)).clone()?;
        Ok(&self.curve)
    }
}

impl From<Curve> for CurveObject {
    fn from(curve: Curve) -> Self {
        Self { curve: Arc::new(curve), contour: Arc::default() }
    }
}

impl ObjectContent for CurveObject {
    fn equals(&self, other: &dyn Object) -> bool {
        as_ref::<Self>(other).is_some_and(|other| self.curve == other.curve)
    }

    fn hash(&self, mut state: &mut dyn Hasher) {
        (self.curve.kind(), self.curve.is_closed()).hash(&mut state);
        let numbers = self.curve.points().iter().flat_map(|point| point.to_array());
        // The two zeros are equal.
        numbers.for_each(|number| (number + 0.0).to_bits().hash(&mut state));
    }

    fn text(&self) -> String {
        let closed = if self.curve.is_closed() { "closed " } else { "" };
        format!("{closed}curve of {} points", self.curve.points().len())
    }

    fn memory(&self) -> usize {
        self.curve.memory()
    }

    fn position(&self) -> Option<DVec3> {
        None
    }

    fn fragments(&self) -> Option<Vec<Value>> {
        None
    }
}

impl HasControlPoints for CurveObject {
    fn control_points(&self) -> Option<ControlPoints> {
        let is_flat = self.curve.points().iter().all(|point| point.z == 0.0);
        let space = if is_flat { PointSpace::Plane } else { PointSpace::Space };
        let row = |point: &DVec3| point.to_array()[..space.axes().len()].to_vec();
        Some(ControlPoints {
            points: PointRows(self.curve.points().iter().map(row).collect()),
            space,
            kind: name_of(self.curve.kind(), &KINDS),
            closed: self.curve.is_closed(),
            columns: None,
        })
    }

    fn with_control_points(&self, points: &PointRows) -> Result<Arc<dyn Object>> {
        let points: Vec<DVec3> = points.0.iter().map(|row| position(row)).collect();
        Ok(Arc::new(Self::from(Curve::new(&points, self.curve.kind(), self.curve.is_closed())?)))
    }

    fn bezier_pieces(&self) -> Vec<[[f64; 3]; 4]> {
        self.curve.pieces().iter().map(|piece| piece.map(|point| point.to_array())).collect()
    }
}

impl ObjectParameter for CurveObject {
    const LUAU: &str = "Curve";
    const EXPECTED: &str = "a curve: curve({ vec(0, 0, 0), vec(0, 1, 2), vec(0, 1, 4) })";
}

impl Answer for CurveObject {
    fn luau() -> String {
        Self::LUAU.into()
    }

    fn answer(self) -> Result<Value> {
        Ok(Value::Object(Arc::new(self)))
    }
}
