//! Functions of one variable as values: `ramp` in scripts.

use std::hash::{Hash as _, Hasher};
use std::sync::Arc;

use burgeon_base::error::Result;
use burgeon_geometry::{Ramp, RampKind};
use burgeon_kit::declare::as_ref;
use burgeon_kit::{
    Answer, ControlPoints, HasControlPoints, Object, ObjectContent, ObjectParameter, PointRows, PointSpace,
    Value, Vector, fields, methods, object,
};
use glam::{DVec2, DVec3};

use super::choice::{name_of, position, variant};

/// Names of the interpolations.
const KINDS: [(&str, RampKind); 3] =
    [("monotone", RampKind::Monotone), ("linear", RampKind::Linear), ("spline", RampKind::Spline)];

/// Fields of `ramp { ... }`.
#[fields("ramp")]
pub struct RampOptions {
    /// Points { x, y } of the function, in the order of increasing x, at least 2.
    pub points: Vec<Vector>,
    /// Interpolation: "monotone", smooth and without overshoot; "linear"; or "spline", a B-spline with the points as
    /// control points.
    #[default("monotone".into())]
    pub kind: String,
}

/// A function of one variable, defined by points, with one y for each x.
///
/// It never changes. Before the first point and after the last, it is constant.
#[object(
    "ramp",
    can(ObjectContent, HasControlPoints),
    options = RampOptions,
    first = "points",
    example = include_str!("../../scripts/ramp.lua"),
)]
pub struct RampObject {
    ramp: Arc<Ramp>,
    /// Points and interpolation; `None` between two functions.
    drawn: Option<Arc<(Vec<DVec2>, RampKind)>>,
}

#[methods("ramp")]
impl RampObject {
    /// Returns the y at `x`.
    pub fn at(&self, x: f64) -> f64 {
        self.ramp.at(x)
    }

    /// Returns the slope at `x`: 0 outside of the points, and the slope to the right of a corner.
    pub fn slope(&self, x: f64) -> f64 {
        self.ramp.slope(x)
    }

    /// Returns the integral from `a` to `b`, such as the growth between two ages if the function is a rate.
    pub fn integral(&self, a: f64, b: f64) -> f64 {
        self.ramp.integral(a, b)
    }

    /// Returns the function between this one (`t` is 0) and another (`t` is 1): at each x, it interpolates linearly
    /// between both values.
    pub fn mix(&self, other: Arc<Self>, t: f64) -> Result<Self> {
        let mixed = self.ramp.mix(&other.ramp, t).map_err(|error| error.about("ramp:mix"))?;
        Ok(Self { ramp: Arc::new(mixed), drawn: None })
    }
}

impl RampObject {
    /// Creates the function of the points.
    ///
    /// ```
    /// use burgeon_kit::Vector;
    /// use burgeon_objects::{RampObject, RampOptions};
    /// use glam::DVec3;
    ///
    /// let points = vec![Vector(DVec3::ZERO), Vector(DVec3::new(2.0, 1.0, 0.0))];
    /// let rise = RampObject::new(RampOptions { points, ..RampOptions::default() })?;
    /// assert_eq!((rise.at(1.0), rise.at(5.0)), (0.5, 1.0));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(options: RampOptions) -> Result<Self> {
        let kind = variant("ramp", "kind", &options.kind, &KINDS)?;
        let points: Vec<DVec2> = options.points.iter().map(|point| point.0.truncate()).collect();
        Self::of_points(points, kind).map_err(|error| error.about("ramp"))
    }

    fn of_points(points: Vec<DVec2>, kind: RampKind) -> Result<Self> {
        let ramp = Ramp::new(&points, kind)?;
        Ok(Self { ramp: Arc::new(ramp), drawn: Some(Arc::new((points, kind))) })
    }

    /// Returns the function.
    pub fn ramp(&self) -> &Ramp {
        &self.ramp
    }
}

impl ObjectContent for RampObject {
    fn equals(&self, other: &dyn Object) -> bool {
        as_ref::<Self>(other).is_some_and(|other| self.ramp == other.ramp)
    }

    fn hash(&self, mut state: &mut dyn Hasher) {
        let numbers = self.ramp.pieces().iter().flatten().flat_map(|point| point.to_array());
        // The two zeros are equal.
        numbers.for_each(|number| (number + 0.0).to_bits().hash(&mut state));
    }

    fn text(&self) -> String {
        let [from, to] = self.ramp.span();
        format!("ramp from {from} to {to}")
    }

    fn memory(&self) -> usize {
        let points = self.drawn.as_ref().map_or(0, |drawn| drawn.0.len() * size_of::<DVec2>());
        self.ramp.memory() + points
    }

    fn position(&self) -> Option<DVec3> {
        None
    }

    fn fragments(&self) -> Option<Vec<Value>> {
        None
    }
}

impl HasControlPoints for RampObject {
    fn control_points(&self) -> Option<ControlPoints> {
        let (points, kind) = &**self.drawn.as_ref()?;
        let points = PointRows(points.iter().map(|point| point.to_array().into()).collect());
        Some(ControlPoints {
            points,
            space: PointSpace::Function,
            kind: name_of(*kind, &KINDS),
            closed: false,
            columns: None,
        })
    }

    fn with_control_points(&self, points: &PointRows) -> Result<Arc<dyn Object>> {
        let kind = self.drawn.as_ref().map_or_else(RampKind::default, |drawn| drawn.1);
        let points = points.0.iter().map(|row| position(row).truncate()).collect();
        Ok(Arc::new(Self::of_points(points, kind)?))
    }

    fn bezier_pieces(&self) -> Vec<[[f64; 3]; 4]> {
        let pieces = self.ramp.pieces().iter();
        pieces.map(|piece| piece.map(|point| point.extend(0.0).to_array())).collect()
    }
}

impl ObjectParameter for RampObject {
    const LUAU: &str = "Ramp";
    const EXPECTED: &str = "a function of one variable: ramp({ { 0, 0.1 }, { 1, 0.8 } })";
}

impl Answer for RampObject {
    fn luau() -> String {
        Self::LUAU.into()
    }

    fn answer(self) -> Result<Value> {
        Ok(Value::Object(Arc::new(self)))
    }
}
