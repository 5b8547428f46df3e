//! The object types that Burgeon provides, one type per file.
//!
//! Input: values from scripts. Output: geometry for the scene. An object never depends on Lua, and only
//! the cells of a terrain are chains, which a `Rewriter` rewrites.
//!
//! A new type is a new file and a line in [`registry`]: a struct with `#[object]`, and `#[methods]` for the methods
//! that scripts may call. CONTRIBUTING.md lists the other steps, such as examples and the reference page.

mod curves;
mod elevation;
mod environment;
mod examples;
mod extruder;
pub mod facade;
mod footprint;
mod frame_stack;
mod import;
mod line_index;
mod mesh;
mod network;
pub mod planet;
mod roofs;
mod shapes;
mod surface;
pub mod terrain;
mod turtle;
mod universe;

pub use curves::curve::{CurveObject, CurveOptions};
pub use curves::ramp::{RampObject, RampOptions};
pub use curves::surface::{SplineSurfaceOptions, SurfaceObject};
pub use elevation::{Elevation, ElevationOptions};
pub use environment::{
    AttractorOptions, Attractors, DiscOptions, Discs, ObstacleSolids, ShadowVoxelOptions, ShadowVoxels, Soil,
    SoilOptions,
};
pub use examples::{EXAMPLES, PLAIN_EXAMPLES};
pub use extruder::Extruder;
pub use facade::{Facade, Template, Templates, Wall};
pub use footprint::{EdgeKeywords, Footprint, Walls};
pub use line_index::LineIndex;
pub use network::Network;
pub use planet::Planet;
pub use roofs::{Roof, RoofDetail, RoofLines, RoofPoints};
pub use shapes::{FontObject, ShapeObject, Volumes};
pub use surface::MaterialOptions;
pub use terrain::{EditFile, Terrain};
pub use turtle::Turtle;
pub use universe::Universe;

use std::sync::Arc;

use burgeon_kit::Registry;
use burgeon_spatial::GeometryObject;

/// Returns the registry of the object types that Burgeon provides.
///
/// ```
/// use burgeon_kit::{Table, TableKey, Value};
///
/// let registry = burgeon_objects::registry();
/// let extruder = registry.get("extruder").expect("a type of Burgeon");
/// let sides = Table { class: None, entries: vec![(TableKey::Name("sides".into()), Value::Number(6.0))] };
/// assert_eq!(extruder.make(&sides)?.kind().name, "extruder");
/// let misspelt = Table { class: None, entries: vec![(TableKey::Name("sidse".into()), Value::Number(6.0))] };
/// let error = extruder.make(&misspelt).err().expect("an unknown field");
/// assert_eq!(error.remedy(), Some("did you mean sides?"));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn registry() -> Registry {
    let model = Arc::new(import::kind());
    let own = [
        Extruder::kind(),
        Footprint::kind(),
        GeometryObject::kind(),
        ShapeObject::kind(),
        FontObject::kind(),
        Planet::kind(),
        LineIndex::kind(),
        Network::kind(),
        Terrain::kind(),
        Turtle::kind(),
        Universe::kind(),
        Template::kind(),
        Facade::kind(),
        &model,
        Elevation::kind(),
        EditFile::kind(),
        RampObject::kind(),
        CurveObject::kind(),
        SurfaceObject::kind(),
        ShadowVoxels::kind(),
        Attractors::kind(),
        Discs::kind(),
        ObstacleSolids::kind(),
        Soil::kind(),
        Volumes::kind(),
    ];
    own.into_iter().chain(facade::kinds()).map(Arc::clone).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn no_type_is_left_out_for_its_name() {
        super::registry().check().expect("each has a name of its own");
        assert_eq!(super::registry().kinds().count(), 25 + super::facade::kinds().len());
    }
}
