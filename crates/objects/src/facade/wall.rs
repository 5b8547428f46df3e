//! The common part of all walls: their permitted sizes, their material, and their methods in scripts.

use std::ops::RangeInclusive;
use std::sync::Arc;

use super::fixture::Fixture;
use super::size::Size;
use crate::MaterialOptions;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_geometry::{Sizes, Split};
use burgeon_kit::{Expectation, Field, Kind, Object, Parameter, Table, Value, methods};
use burgeon_scene::{Material, SurfaceMeaning};

/// A wall of a facade, made by one of five rules. A wall is immutable.
#[derive(Clone)]
pub struct Wall(pub(super) Arc<WallData>);

pub(super) struct WallData {
    /// Type of the wall in scripts.
    pub kind: &'static Arc<Kind>,
    /// Permitted widths and heights (m).
    pub sizes: [Sizes; 2],
    /// Preferred width and height, if any.
    pub targets: [Option<f64>; 2],
    /// Material of the wall's own faces, if specified.
    pub material: Option<Material>,
    /// Nesting depth of walls.
    pub depth: usize,
    pub rule: WallRule,
}

/// Maximum nesting depth of walls.
const DEEPEST: usize = 100;

/// The rule of a wall and its parts.
pub(super) enum WallRule {
    Panel {
        decoration: Option<Box<Material>>,
        fixture: Option<Fixture>,
        background: bool,
        meaning: SurfaceMeaning,
    },
    Bordered {
        columns: Split,
        rows: Split,
        wall: Wall,
    },
    Extruded {
        depth: f64,
        sides: [bool; 4],
        fixture: Option<Fixture>,
        wall: Wall,
    },
    List {
        upwards: bool,
        split: Split,
        walls: Vec<Wall>,
    },
    Grid {
        counts: [RangeInclusive<u32>; 2],
        wall: Wall,
    },
}

/// Creates the type `kind`, whose constructor accepts `fields` and calls `make` to create a wall.
pub(super) fn wall_kind(
    kind: Kind,
    fields: Vec<Field>,
    make: impl Fn(&Table) -> Result<Wall> + Send + Sync + 'static,
) -> Arc<Kind> {
    Arc::new(kind.made_of(fields, make).methods(Wall::methods()).of_family(Wall::FAMILY))
}

#[methods("wall")]
impl Wall {
    /// Returns the minimum width (m).
    pub fn min_width(&self) -> f64 {
        self.0.sizes[0].low()
    }

    /// Returns the maximum width (m), or math.huge if there is none.
    pub fn max_width(&self) -> f64 {
        self.0.sizes[0].high()
    }

    /// Returns the minimum height (m).
    pub fn min_height(&self) -> f64 {
        self.0.sizes[1].low()
    }

    /// Returns the maximum height (m), or math.huge if there is none.
    pub fn max_height(&self) -> f64 {
        self.0.sizes[1].high()
    }

    /// Returns true if the wall can be exactly `width` (m) wide and `height` (m) high.
    pub fn fits(&self, width: f64, height: f64) -> bool {
        self.0.sizes[0].contains(width) && self.0.sizes[1].contains(height)
    }
}

impl Wall {
    /// Creates a wall of type `kind` by `rule`, with the sizes that both its parts and the options permit. Fails if there are none.
    pub(super) fn new(
        kind: &'static Arc<Kind>,
        rule: WallRule,
        of_parts: [Sizes; 2],
        of_targets: [Option<f64>; 2],
        own: [Option<Size>; 2],
        material: Option<&MaterialOptions>,
    ) -> Result<Self> {
        let name = &kind.name;
        let depth = 1 + rule.parts().iter().map(|wall| wall.0.depth).max().unwrap_or(0);
        if depth > DEEPEST {
            return Err(Error::limit(
                Limit::Size,
                format!("{name}: walls are nested more than {DEEPEST} deep"),
            )
            .help("repeat a wall with grid or list"));
        }
        let own = own.map(Option::unwrap_or_default);
        let mut sizes = of_parts;
        for ((sizes, own), side) in sizes.iter_mut().zip(&own).zip(["wide", "high"]) {
            let both = sizes.and(&own.sizes());
            if both.is_empty() {
                return Err(Error::argument(format!(
                    "{name}: it can never fit: its parts are {}, but it must be {}",
                    range(sizes, side),
                    range(&own.sizes(), side)
                ))
                .help("allow a larger range of sizes for the parts or the wall"));
            }
            *sizes = both;
        }
        let target = |side: usize| own[side].target().or(of_targets[side]);
        let material = material.map(MaterialOptions::material).transpose()?;
        let targets = [target(0), target(1)];
        Ok(Self(Arc::new(WallData { kind, sizes, targets, material, depth, rule })))
    }
}

/// Describes sizes in words: "2 m wide", "at least 2 m wide", "0.5 to 2 m wide".
pub(super) fn range(sizes: &Sizes, side: &str) -> String {
    let shown = |length: f64| (length * 1e6).round() / 1e6;
    let (low, high) = (shown(sizes.low()), shown(sizes.high()));
    if high.is_infinite() {
        format!("at least {low} m {side}")
    } else if low < high {
        format!("{low} to {high} m {side}")
    } else {
        format!("{low} m {side}")
    }
}

impl WallRule {
    /// Returns the walls that this rule contains.
    fn parts(&self) -> &[Wall] {
        match self {
            Self::Panel { .. } => &[],
            Self::Bordered { wall, .. } | Self::Extruded { wall, .. } | Self::Grid { wall, .. } => {
                std::slice::from_ref(wall)
            }
            Self::List { walls, .. } => walls,
        }
    }
}

impl Wall {
    /// Name of all types of walls in Luau.
    pub(super) const FAMILY: &str = "Wall";
}

impl Parameter for Wall {
    fn luau() -> String {
        Self::FAMILY.into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || Expectation::new("a wall: panel, bordered, extruded, list or grid");
        let Value::Object(object) = value else { return Err(what()) };
        let any: &dyn std::any::Any = &*object;
        any.downcast_ref::<Self>().cloned().ok_or_else(what)
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(self))
    }
}

impl Object for Wall {
    fn kind(&self) -> &Arc<Kind> {
        self.0.kind
    }

    fn boxed(&self) -> Box<dyn Object> {
        Box::new(self.clone())
    }
}

impl std::fmt::Debug for Wall {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0.kind.name)
    }
}
