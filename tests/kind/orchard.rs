//! Object type outside of Burgeon: rows of trees on a field of a data file.

use std::any::Any;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use burgeon::Result;
use burgeon::kit::{
    Drawing, Expand, Expectation, Object, Parameter, Prefetch, Rewriter, Table, Value, Vector, methods,
    object,
};
use burgeon::scene::Material;
use burgeon_data::{Features, Layer};
use burgeon_geometry::sphere;
use burgeon_spatial::{Geometry, GeometryObject};
use glam::{DVec2, DVec3};

/// Number of centres that were looked up in the prefetch.
pub static LOOKED_FOR: AtomicUsize = AtomicUsize::new(0);
/// Number of expansions.
pub static EXPANSIONS: AtomicUsize = AtomicUsize::new(0);

/// Corners of a field (m).
#[derive(Debug, Clone, Default)]
pub struct Corners(Vec<DVec3>);

impl Corners {
    fn of(geometry: &Geometry) -> Self {
        Self(match geometry {
            Geometry::Polygon(rings) => rings.first().cloned().unwrap_or_default(),
            Geometry::Line(points) => points.clone(),
            other => other.points().copied().collect(),
        })
    }

    fn middle(&self) -> DVec3 {
        self.0.iter().sum::<DVec3>() / self.0.len().max(1) as f64
    }
}

impl Parameter for Corners {
    fn luau() -> String {
        "any".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || Expectation::new("a feature's geometry");
        let Value::Object(object) = &value else { return Err(what()) };
        let any: &dyn Any = &**object;
        any.downcast_ref::<GeometryObject>().map(|shape| Self::of(shape.geometry())).ok_or_else(what)
    }

    fn into_value(self) -> Value {
        self.0.into_iter().map(Vector).collect::<Vec<_>>().into_value()
    }
}

/// Complete layer of a data file.
#[derive(Clone, Default)]
pub struct Whole(Option<Arc<Layer>>);

impl std::fmt::Debug for Whole {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "a layer of {} features", self.0.as_ref().map_or(0, |layer| layer.features.len()))
    }
}

impl Parameter for Whole {
    fn luau() -> String {
        "any".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let Value::Object(object) = &value else { return Err(Expectation::new("a source")) };
        let any: &dyn Any = &**object;
        let features = any.downcast_ref::<Features>().ok_or_else(|| Expectation::new("a source"))?;
        Ok(Self(Some(Arc::clone(&features.0))))
    }

    fn into_value(self) -> Value {
        Value::Nil
    }
}

/// Rows of trees on a field.
#[object(
    "orchard",
    first = "geometry",
    make = planted,
    draws,
    can(Expand),
    begins_empty,
    begin = restart,
    gathers = gather,
    prefetches = |features| Some(Arc::new(Middles::new(features)?)),
    crate = burgeon::kit
)]
pub struct Orchard {
    /// Field of the orchard: the geometry of a feature.
    pub geometry: Corners,
    /// Source of the wells: trees keep a distance of 1 m from each well.
    pub wells: Whole,
    /// Distance between trees (m).
    #[default(4.0)]
    pub spacing: f64,
    middle: DVec3,
    /// Distance to the nearest other orchard (m).
    #[default(f64::INFINITY)]
    nearest: f64,
    /// Positions of the trees relative to the centre (m).
    trees: Vec<DVec3>,
    drawing: Drawing,
}

#[methods("orchard", crate = burgeon::kit)]
impl Orchard {
    /// Draws each tree as a ball with `radius` (m).
    pub fn crowns(&mut self, radius: f64) -> Result<()> {
        let material = Material { base_color: [0.2, 0.5, 0.2, 1.0], ..Material::default() };
        let part = self.drawing.material(&material);
        for tree in &self.trees {
            sphere(self.drawing.part(part), *tree + DVec3::Z * radius, radius, 8)?;
        }
        Ok(())
    }

    /// Returns the number of trees.
    pub fn trees(&self) -> f64 {
        self.trees.len() as f64
    }

    /// Returns the distance to the nearest other orchard (m); infinite if there is none.
    pub fn nearest(&self) -> f64 {
        self.nearest
    }

    /// Returns the number of features in the layer of wells.
    pub fn wells(&self) -> f64 {
        self.wells.0.as_ref().map_or(0.0, |layer| layer.features.len() as f64)
    }
}

impl Orchard {
    fn planted(table: &Table) -> Result<Self> {
        let orchard = Self::from_table(table)?;
        let middle = prefetched(table).unwrap_or_else(|| orchard.geometry.middle());
        Ok(Self { middle, drawing: Drawing::at(middle), ..orchard })
    }

    fn restart(&mut self) {
        self.drawing.clear();
    }
}

/// Returns the centre of a feature's corners, if it was prefetched.
fn prefetched(table: &Table) -> Option<DVec3> {
    let Some(Value::Object(object)) = table.get("geometry") else { return None };
    let any: &dyn Any = &**object;
    let (prefetch, number) = any.downcast_ref::<GeometryObject>()?.prefetch()?;
    let any: &dyn Any = prefetch;
    LOOKED_FOR.fetch_add(1, Ordering::Relaxed);
    any.downcast_ref::<Middles>()?.middles.get(number)?.get().copied()
}

/// Centres of a layer's features, computed by an idle thread.
struct Middles {
    layer: Arc<Layer>,
    middles: Vec<std::sync::OnceLock<DVec3>>,
    over: AtomicBool,
}

impl Middles {
    fn new(features: &Arc<dyn Object>) -> Option<Self> {
        let any: &dyn Any = &**features;
        let layer = &any.downcast_ref::<Features>()?.0;
        let middles = layer.features.iter().map(|_| Default::default()).collect();
        Some(Self { layer: Arc::clone(layer), middles, over: AtomicBool::new(false) })
    }
}

impl Prefetch for Middles {
    fn work(&self) {
        for (feature, middle) in self.layer.features.iter().zip(&self.middles) {
            if self.over.load(Ordering::Relaxed) {
                return;
            }
            middle.get_or_init(|| Corners::of(&feature.geometry).middle());
        }
    }

    fn end(&self) {
        self.over.store(true, Ordering::Relaxed);
    }
}

/// Sets in each orchard the distance to the nearest other one.
fn gather(all: &mut [Box<dyn Object>]) {
    let middle = |object: &dyn Object| {
        let any: &dyn Any = object;
        any.downcast_ref::<Orchard>().map(|orchard| orchard.middle)
    };
    let middles: Vec<Option<DVec3>> = all.iter().map(|object| middle(&**object)).collect();
    for (own, object) in all.iter_mut().enumerate() {
        let any: &mut dyn Any = &mut **object;
        let Some(orchard) = any.downcast_mut::<Orchard>() else { continue };
        let others = middles.iter().enumerate().filter(|(number, _)| *number != own);
        let distances = others.filter_map(|(_, other)| Some(other.as_ref()?.distance(orchard.middle)));
        orchard.nearest = distances.fold(f64::INFINITY, f64::min);
    }
}

impl Expand for Orchard {
    fn expand(&mut self, rules: &dyn Rewriter) -> Result<()> {
        rules.check()?;
        EXPANSIONS.fetch_add(1, Ordering::Relaxed);
        let wells: Vec<DVec2> =
            self.wells.0.iter().flat_map(|layer| &layer.features).fold(Vec::new(), |mut wells, feature| {
                wells.push((Corners::of(&feature.geometry).middle() - self.middle).truncate());
                wells
            });
        let low = self.geometry.0.iter().copied().fold(DVec3::INFINITY, DVec3::min) - self.middle;
        let high = self.geometry.0.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max) - self.middle;
        let along = |from: f64, to: f64| {
            let spacing = self.spacing;
            (1..100).map(move |step| from + f64::from(step) * spacing).take_while(move |at| *at < to)
        };
        let places = along(low.x, high.x).flat_map(|x| along(low.y, high.y).map(move |y| DVec2::new(x, y)));
        let dry = places.filter(|place| wells.iter().all(|well| well.distance(*place) > 1.0));
        self.trees = dry.map(|place| place.extend(0.0)).collect();
        Ok(())
    }

    fn sketch(&mut self) {
        self.trees = vec![DVec3::ZERO];
    }
}
