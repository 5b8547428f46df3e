//! Solids of revolution for scripts.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Parameter, Table, Value, Vector, fields};
use burgeon_shapes::{Revolution, Shape};
use burgeon_spatial::PolygonArgument;
use glam::DVec3;

use super::construct::flat_ring;
use super::object::ShapeObject;

/// Options of `revolve(outline, { ... })`.
#[fields("revolve")]
pub(super) struct RevolveOptions {
    /// Direction of the axis through the origin.
    #[default(Vector(DVec3::Z))]
    pub axis: Vector,
    /// Angle of the turn (degrees), up to 360.
    #[default(360.0)]
    pub angle: f64,
    /// Number of flat sides of the turn.
    #[default(32)]
    pub sides: u32,
    /// Size of a tile of the texture (m).
    #[default(1.0)]
    pub tile: f64,
}

/// Makes the solid that an outline sweeps around an axis.
pub(super) fn revolve(given: &[Value]) -> Result<Value> {
    let (outline, options) = match given {
        [outline] | [outline, Value::Nil] => (outline, None),
        [outline, options] => (outline, Some(options)),
        _ => {
            return Err(Error::argument(format!("revolve takes 1 or 2 arguments, not {}", given.len()))
                .help("write revolve({ { 0, 0 }, { 2, 0 }, { 1, 3 }, { 0, 3 } }, { sides = 24 })"));
        }
    };
    let options = match options {
        None => RevolveOptions::default(),
        Some(table) => {
            let read =
                Arc::<Table>::read_value(table).map_err(|error| error.refuse("revolve", "options", table))?;
            RevolveOptions::from_table(&read)?
        }
    };
    let rings =
        PolygonArgument::read_value(outline).map_err(|error| error.refuse("revolve", "outline", outline))?.0;
    let rings: Vec<_> = rings.iter().map(|ring| flat_ring(ring)).collect();
    let turn = Revolution {
        axis: options.axis.0,
        angle: options.angle.to_radians(),
        sides: options.sides,
        tile: options.tile,
    };
    let shape = Shape::revolve(&rings, &turn).map_err(|error| error.about("revolve"))?;
    Ok(Value::Object(Arc::new(ShapeObject::new(shape))))
}
