//! An object type outside of Burgeon: beads, balls stacked on each other. The program registers the type, runs a script
//! that uses it, and writes the model to `beads.glb` and a render of it to `beads.png`, in the folder of its argument
//! or the current folder.

use std::path::PathBuf;
use std::sync::Arc;

use burgeon::kit::{Color, Drawing, Registry, methods, object};
use burgeon::picture::Picture;
use burgeon::scene::Material;
use burgeon::script::RunOptions;
use burgeon::{Result, export};
use burgeon_geometry::sphere;
use glam::DVec3;

/// Balls stacked on each other.
#[object("beads", draws, begins_empty, crate = burgeon::kit)]
pub struct Beads {
    /// Radius of a bead (m).
    #[default(0.5)]
    pub radius: f64,
    /// Colour of the beads.
    #[default(Color([0.6, 0.1, 0.1, 1.0]))]
    pub color: Color,
    height: f64,
    drawing: Drawing,
}

#[methods("beads", crate = burgeon::kit)]
impl Beads {
    /// Adds a bead on top.
    pub fn add(&mut self) -> Result<()> {
        let material = Material { base_color: self.color.0, ..Material::default() };
        let part = self.drawing.material(&material);
        let middle = DVec3::Z * (self.height + self.radius);
        self.height += 2.0 * self.radius;
        sphere(self.drawing.part(part), middle, self.radius, 16)
    }

    /// Returns the height of the beads (m).
    pub fn height(&self) -> f64 {
        self.height
    }
}

/// Returns the object types of Burgeon, and beads.
fn registry() -> Result<Registry> {
    let mut registry = burgeon::registry();
    registry.add(Arc::clone(Beads::kind()))?;
    Ok(registry)
}

fn main() -> Result<()> {
    let folder = std::env::args().nth(1).map_or_else(|| PathBuf::from("."), PathBuf::from);
    let script = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples/beads.lua");
    let run = burgeon::run(&script, RunOptions { registry: registry()?, ..burgeon::options() })?;
    for name in ["beads.glb", "beads.png"] {
        export::write(&run.scene, &folder.join(name), &Picture::default())?;
    }
    eprintln!("{} triangles in {}", run.scene.triangles(), folder.display());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_registered_type_is_like_a_built_in_one() {
        let script = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples/beads.lua");
        let run = |registry| burgeon::run(&script, RunOptions { registry, ..burgeon::options() });
        let made = run(registry().expect("the name is free")).expect("the script runs");
        let (low, high) = made.scene.bounds().expect("there are beads");
        assert!(low.z.abs() < 1e-6 && (high.z - 12.0 * 0.6).abs() < 1e-5, "{low} {high}");
        assert!(run(burgeon::registry()).is_err(), "beads are unknown without the registration");
    }
}
