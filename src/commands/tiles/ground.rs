//! Colours of terrain tiles, from a terrain of the script.

use std::sync::Arc;

use burgeon::Run;
use burgeon::kit::declare::as_ref;
use burgeon::objects::Terrain;
use burgeon::results::DerivedSystem;
use burgeon::tiles::make::{GroundColors, GroundSample};

/// Terrain of a script that was run, whose covers and water give terrain tiles their colours.
pub(super) struct ScriptGround {
    systems: Vec<Arc<DerivedSystem>>,
    /// Number of the terrain among those of all systems.
    number: usize,
    /// Number of the terrains.
    pub(super) terrains: usize,
    /// Number of the terrains with more than one colour.
    pub(super) choices: usize,
}

/// Returns the terrains of systems, in their order.
fn terrains(systems: &[Arc<DerivedSystem>]) -> impl Iterator<Item = &Terrain> {
    let objects = systems.iter().flat_map(|system| &system.objects);
    objects.filter_map(|object| as_ref::<Terrain>(&**object))
}

impl ScriptGround {
    /// Finds the first terrain with more than one colour, or else the first terrain; `None` without terrains.
    pub(super) fn find(run: Run) -> Option<Self> {
        let systems = run.systems;
        let is_varied: Vec<bool> =
            terrains(&systems).map(|terrain| terrain.plain_color().is_none()).collect();
        let number = is_varied.iter().position(|is_varied| *is_varied).unwrap_or(0);
        let choices = is_varied.iter().filter(|is_varied| **is_varied).count();
        let terrains = is_varied.len();
        (terrains > 0).then_some(Self { systems, number, terrains, choices })
    }

    fn terrain(&self) -> Option<&Terrain> {
        terrains(&self.systems).nth(self.number)
    }
}

impl GroundColors for ScriptGround {
    fn uniform(&self) -> Option<[f32; 3]> {
        self.terrain().and_then(Terrain::plain_color)
    }

    fn is_bent(&self) -> bool {
        self.terrain().is_some_and(Terrain::is_colored_by_curvature)
    }

    fn color(&self, sample: &GroundSample) -> [f32; 3] {
        let GroundSample { place, height, slope, curvature } = *sample;
        let color = self.terrain().map(|terrain| terrain.ground_color(place, height, slope, curvature));
        color.unwrap_or_default()
    }
}
