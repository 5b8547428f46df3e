//! Faulty object type: it panics on request. It also warns.

use burgeon::kit::{Drawing, Warn, methods, object};
use burgeon::scene::Material;
use burgeon::{Result, Warning, WarningKind};
use burgeon_geometry as geometry;
use glam::DVec3;

/// A ball that may panic.
#[object("fuse", draws, can(Warn), begins_empty, crate = burgeon::kit)]
pub struct Fuse {
    /// Set to panic in all methods.
    pub blown: bool,
    drawing: Drawing,
    warnings: Vec<Warning>,
}

impl Warn for Fuse {
    fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }
}

#[methods("fuse", crate = burgeon::kit)]
impl Fuse {
    /// Draws the ball with `radius` (m), or panics.
    pub fn ball(&mut self, radius: f64) -> Result<()> {
        assert!(!self.blown, "the fuse is blown");
        if radius == 0.0 {
            self.warnings
                .push(Warning::new(WarningKind::DrawsNothing, "a ball without a radius draws nothing"));
            return Ok(());
        }
        let part = self.drawing.material(&Material::default());
        geometry::sphere(self.drawing.part(part), DVec3::ZERO, radius, 8)
    }

    /// Returns true if the fuse is blown, or panics.
    pub fn ask(&self) -> bool {
        assert!(!self.blown, "the fuse is blown");
        self.blown
    }
}
