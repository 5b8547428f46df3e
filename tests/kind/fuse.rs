//! A type of object with a mistake in it: it panics when it is told to.

use std::sync::{Arc, LazyLock};

use burgeon::kit::{Draw, Drawing, Kind, Object, Table, fields, methods};
use burgeon::scene::Material;
use burgeon::{Result, geometry};
use glam::DVec3;

/// What `fuse { ... }` takes.
#[fields("fuse", crate = burgeon::kit)]
pub struct FuseOptions {
    /// Whether it is to panic.
    pub blown: bool,
}

/// A ball that may panic.
#[derive(Clone, Draw)]
#[draw(crate = burgeon::kit)]
pub struct Fuse {
    blown: bool,
    drawing: Drawing,
}

#[methods("fuse", crate = burgeon::kit)]
impl Fuse {
    /// Draws the ball with `radius` (m), or panics.
    pub fn ball(&mut self, radius: f64) -> Result<()> {
        assert!(!self.blown, "the fuse is blown");
        let part = self.drawing.material(&Material::default());
        geometry::sphere(self.drawing.part(part), DVec3::ZERO, radius, 8)
    }

    /// Tells whether it is blown, or panics.
    pub fn ask(&self) -> bool {
        assert!(!self.blown, "the fuse is blown");
        self.blown
    }
}

impl Fuse {
    /// The type, as scripts see it.
    pub fn kind() -> &'static Arc<Kind> {
        static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
            let make = |table: &Table| {
                let FuseOptions { blown } = FuseOptions::from_table(table)?;
                Ok(Fuse { blown, drawing: Drawing::default() })
            };
            let kind = Kind::new("fuse", "A ball that may panic.").made_of(FuseOptions::fields(), make);
            Arc::new(kind.methods(Fuse::methods()).begins_empty().draws::<Fuse>())
        });
        &KIND
    }
}

impl Object for Fuse {
    fn kind(&self) -> &Arc<Kind> {
        Self::kind()
    }

    fn boxed(&self) -> Box<dyn Object> {
        Box::new(self.clone())
    }

    fn begin(&mut self) {
        self.drawing.clear();
    }
}
