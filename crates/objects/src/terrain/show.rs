//! The drawing of a terrain.

use glam::{DAffine3, DVec3};

use super::beds::RiverBeds;
use super::object::Terrain;
use super::streets::StreetsOnGround;
use super::water::Water;
use super::{looks, sides};
use burgeon_base::ModuleKey;
use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};
use burgeon_kit::{Drawing, Show};
use burgeon_scene::{Instance, Material, Mesh, Part, Scene};
use burgeon_terrain::{GroundCuts, GroundMesh};

impl Show for Terrain {
    fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        if self.options.visible { self.draw(scene, name, feature) } else { Ok(()) }
    }
}

impl Terrain {
    /// Adds the expanded ground to `scene`: a mesh for each tile, sides, water and rivers, and plants.
    fn draw(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        let ground = &self.ground;
        if ground.heights() == 0 {
            return Err(Error::script("terrain: nothing is expanded").help(
                "set levels, or focus on a position: this:focus(x, y, view) in an interpretation rule",
            ));
        }
        let mesh = GroundMesh::new(ground, self.error());
        let lift = DVec3::Z * self.options.position.0.z;
        let cuts = match &self.options.under {
            Some(StreetsOnGround(streets)) => streets.ground_cuts(lift.z)?,
            None => GroundCuts::default(),
        };
        let masks = self.options.covers.iter().map(|cover| &cover.on);
        for mask in masks.chain(self.options.plants.iter().map(|plants| &plants.on)) {
            mask.check("terrain", ground.world())?;
        }
        let mut lowest = f64::INFINITY;
        for (number, tile) in ground.tiles().iter().enumerate() {
            let (corner, size) = tile.bounds(ground.world());
            let origin = (corner + size / 2.0).extend(0.0);
            Stop::check_current()?;
            let place = tile.place;
            let of = format!("{name} {}/{}/{}", place.level, place.x, place.y);
            let mut parts = Vec::new();
            let mut part = Part::default();
            if self.options.covers.is_empty() {
                mesh.write(number, origin, 0.0, &cuts, &mut part);
                let material =
                    Material { base_color: self.options.color.0, roughness: 0.95, ..Material::default() };
                part.material = scene.material(&material);
            } else {
                let (bytes, across) = looks::paint(ground, tile, &self.options.covers);
                mesh.write(number, origin, looks::half_texel(size, across), &cuts, &mut part);
                let material = looks::material(of.clone(), &bytes, across, size, 0.95)?;
                part.material = scene.material(&material);
            }
            lowest = part.positions.iter().map(|at| f64::from(at.z)).fold(lowest, f64::min);
            parts.push(part);
            let water = self.options.water.as_ref();
            if let Some((part, bytes, across)) = water.and_then(|water| water.surface(ground, tile, origin)) {
                let material = looks::material(format!("{of} water"), &bytes, across, size, 0.12)?;
                parts.push(Part { material: scene.material(&material), ..part });
            }
            scene.meshes.push(Mesh { name: of.clone(), parts, ..Mesh::default() });
            scene.instances.push(Instance {
                mesh: scene.meshes.len() - 1,
                transform: DAffine3::from_translation(origin + lift),
                name: of,
                feature: feature.map(str::to_owned),
                origin: None,
                placement: None,
                meaning: None,
            });
        }
        let mut drawing = Drawing::at(lift);
        if let Some(base) = self.options.base {
            let material =
                Material { base_color: self.options.sides.0, roughness: 1.0, ..Material::default() };
            let part = drawing.material(&material);
            let base = base.height(lowest, self.options.size);
            sides::draw(&mesh.rim(), base, drawing.part(part))?;
        }
        if let Some(water) = &self.options.water {
            let material = Material { base_color: water.color.0, roughness: 0.12, ..Material::default() };
            let part = drawing.material(&material);
            sides::draw_water(&mesh.rim(), water.level, drawing.part(part));
        }
        let water = self.options.water.as_ref();
        let shallow = water.map_or_else(|| Water::default().shallow, |water| water.shallow);
        for river in &self.rivers {
            let material = Material { base_color: shallow.0, roughness: 0.12, ..Material::default() };
            let part = drawing.material(&material);
            river.draw(drawing.part(part));
        }
        let beds = RiverBeds::new(&self.rivers);
        for (number, plants) in (1u64..).zip(&self.options.plants) {
            let key = ModuleKey(self.key.0.wrapping_add(number)).child(0);
            plants.scatter(ground, key, &beds, &mut drawing)?;
        }
        drawing.show(scene, name, feature)
    }

    /// Returns the maximum distance (m) between the triangles and the surface.
    fn error(&self) -> f64 {
        self.options.error.unwrap_or_else(|| self.ground.world().cell(self.ground.finest()) / 10.0)
    }
}
