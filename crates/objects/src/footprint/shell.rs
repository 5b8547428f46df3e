//! The lower part of a building: its groundwork.

use crate::MaterialOptions;
use glam::DVec3;

use super::object::Footprint;
use super::sides::horizontal_direction;
use super::state::Shell;
use crate::roofs::unknown_kind;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::{Ring, fill};
use burgeon_scene::SurfaceMeaning;

const GROUNDWORK: [&str; 3] = ["z_min", "z_max", "extruded"];

impl Footprint {
    pub(super) fn lay(&mut self, kind: &str, material: Option<&MaterialOptions>) -> Result<()> {
        self.check_open("groundwork")?;
        if self.shell.begun {
            return Err(Error::script("footprint:groundwork: the building already has parts")
                .help("call groundwork first"));
        }
        let (low, high) = self.plan.ground();
        let base = match kind {
            "z_min" => low,
            "z_max" | "extruded" => high,
            _ => return Err(unknown_kind("footprint:groundwork", kind, &GROUNDWORK)),
        };
        let part = self.part(None, material)?;
        if self.detail == 0 {
            let plan = self.plan.flat().at_height(base);
            self.shell = Shell { top: base, bottom: base, begun: true, closed: false };
            return fill(self.drawing.surface(part, SurfaceMeaning::Ground), &plan, DVec3::X, DVec3::ZERO)
                .map_err(Error::of_data);
        }
        self.shell = Shell { top: base, bottom: base, begun: true, closed: false };
        let plan = std::sync::Arc::clone(&self.plan);
        if kind == "extruded" {
            let part = self.drawing.surface(part, SurfaceMeaning::Wall);
            for [a, b] in plan.polygon().edges() {
                let face = Ring::without_repeats(vec![a, b, b.with_z(base), a.with_z(base)]);
                if let Some(face) = face {
                    fill(part, &[face], horizontal_direction(a.truncate(), b.truncate()), a.with_z(base))?;
                }
            }
        }
        // Rings are reversed as seen from below.
        let floor = match kind {
            "extruded" => plan.polygon().from_below(),
            _ => plan.flat().at_height(base).from_below(),
        };
        let part = self.drawing.surface(part, SurfaceMeaning::Ground);
        fill(part, &floor, DVec3::X, DVec3::ZERO).map_err(Error::of_data)
    }
}
