//! The upper part of a building: its roof and what stands on it.

mod detail;
mod kinds;
mod replace;
#[cfg(test)]
mod tests;

use glam::{DVec2, DVec3};

use super::{Color, Footprint, Surface};
use crate::error::{Error, Result};
use crate::geometry::fill;
use crate::geometry::roof::{Patch, PatchKind, Shape, Surface as SurfaceOf};
use crate::objects::Note;
pub use detail::Detail;

fields! {
    /// What `footprint:roof { ... }` takes.
    pub struct Roof for "footprint:roof" {
        /// "flat", "shed", "gable", "gambrel", "shed_gambrel", "hip", "mansard", "pagoda", "porch" or "dutch_hip".
        pub kind: String = "hip".into(),
        /// How high the highest ridge is above the eaves (m); after `slope` if left out.
        pub height: Option<f64> = None,
        /// Slope (degrees) from the eaves to the highest ridge, where no height is given.
        pub slope: f64 = 35.0,
        /// How far it juts out over the walls (m), where there is room.
        pub overhang: f64 = 0.0,
        /// "closed", with a level underside; "slab", with upright faces along the outline too; or "open", a plate
        /// that follows the slope. "slab" if a `slab` is given, "closed" otherwise.
        pub eaves: Option<String> = None,
        /// Height of the upright faces along the outline, and of the edge of a plate (m); 0.15 where one is needed.
        pub slab: f64 = 0.0,
        /// Height of the border of a flat roof (m).
        pub border: f64 = 0.0,
        /// Width of the border of a flat roof (m).
        pub border_width: f64 = 0.3,
        /// Its colour.
        pub color: Option<Color> = None,
        /// Its material, in place of the colour.
        pub material: Option<Surface> = None,
        /// The material of gables; the footprint's colour if left out.
        pub gable: Option<Surface> = None,
        /// The material of slabs and borders; the roof's if left out.
        pub trim: Option<Surface> = None,
        /// The material of undersides; that of slabs if left out.
        pub underside: Option<Surface> = None,
        /// Whether walls along neighbours that run away from the street end in gables, as in a row of houses.
        pub party_gables: bool = true,
        /// What stands on it: a list of { model, on, every, ... }.
        pub details: Vec<Detail> = Vec::new(),
    }
}

impl Footprint {
    pub(super) fn cover(&mut self, options: &Roof) -> Result<()> {
        self.check_open("roof")?;
        let shape = kinds::shape(options)?;
        for detail in &options.details {
            detail.check()?;
        }
        if !self.shell.begun {
            self.lay("z_min", options.material.clone())?;
        }
        self.finish_walls()?;
        self.shell.closed = true;
        match self.detail {
            0 => return Ok(()),
            1 => return self.cap(options),
            _ => {}
        }
        let (walls, base) = (self.plan.flat(), self.shell.top);
        let rows = options.party_gables && matches!(shape.surface, SurfaceOf::Sloped(..));
        let party = if rows { self.party_walls() } else { Vec::new() };
        let mut make = |shape: &Shape, outline: &[Vec<DVec2>]| {
            let own = std::ptr::eq(outline, walls.as_slice());
            shape.cover_in_row(outline, base, if own { &party } else { &[] })
        };
        let made = replace::cover(&shape, &options.kind, &walls, base, &mut make);
        let mut note = |what: String, why: String| self.notes.push(Note::new(what, why));
        if let Some((what, why)) = made.replaced {
            note(what, why);
        }
        if made.cover.hipped {
            note(format!("hips in place of gables of a {} roof", options.kind), String::new());
        }
        let overhang = made.cover.overhang;
        if overhang < options.overhang {
            let why = format!("{overhang} m in place of {} m", options.overhang);
            note("a smaller overhang, as there is no room".into(), why);
        }
        self.draw(options, &made.cover.patches).map_err(Error::of_data)?;
        if self.detail < 3 {
            return Ok(());
        }
        for (index, detail) in options.details.iter().enumerate() {
            let seed = self.seed.wrapping_add((index as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
            for (model, frame) in detail.frames(&made.cover.patches, seed) {
                self.drawing.place(&model, frame);
            }
        }
        Ok(())
    }

    /// Ends the walls level, in place of a roof.
    fn cap(&mut self, options: &Roof) -> Result<()> {
        let base = self.shell.top;
        let top: Vec<Vec<DVec3>> =
            self.plan.flat().iter().map(|ring| ring.iter().map(|at| at.extend(base)).collect()).collect();
        let part = self.part(options.color, options.material.as_ref())?;
        fill(self.drawing.part(part), &top, DVec3::X, DVec3::ZERO).map_err(Error::of_data)
    }

    fn draw(&mut self, options: &Roof, patches: &[Patch]) -> Result<()> {
        let material = options.material.as_ref();
        let trim = options.trim.as_ref().or(material);
        let slope = self.part(options.color, material)?;
        let gable = self.part(None, options.gable.as_ref())?;
        let fascia = self.part(options.color, trim)?;
        let underside = self.part(options.color, options.underside.as_ref().or(trim))?;
        for patch in patches {
            let part = match patch.kind {
                PatchKind::Slope => slope,
                PatchKind::Gable => gable,
                PatchKind::Fascia => fascia,
                PatchKind::Underside => underside,
            };
            let Some(&origin) = patch.rings.first().and_then(|ring| ring.first()) else { continue };
            let right = if patch.along == glam::DVec2::ZERO { DVec3::X } else { patch.along.extend(0.0) };
            fill(self.drawing.part(part), &patch.rings, right, origin)?;
        }
        Ok(())
    }
}
