//! `panel { ... }`: the only wall without parts.

use std::sync::{Arc, LazyLock};

use super::fixture::{Anchor, Fixture, PanelMeaning};
use super::size::Size;
use super::wall::{Wall, WallRule, wall_kind};
use crate::MaterialOptions;
use burgeon_base::error::Result;
use burgeon_geometry::Sizes;
use burgeon_kit::{Kind, Model, fields};
use burgeon_scene::SurfaceMeaning;

/// What `panel { ... }` takes.
#[fields("panel")]
pub struct PanelOptions {
    /// Width (m): preferred, { least, greatest } or { least, preferred, greatest }.
    pub width: Option<Size>,
    /// Height (m), in the same way.
    pub height: Option<Size>,
    /// Material of its face; the template's if left out.
    pub material: Option<MaterialOptions>,
    /// A material whose image covers the panel once, whatever its size, in place of its own.
    pub decoration: Option<MaterialOptions>,
    /// A model in its middle: x to the right, z up, y into the wall.
    pub model: Option<Arc<Model>>,
    /// Whether the model is stretched to the panel's width and height.
    pub stretch: bool,
    /// Where the model sits: "bottom", "center" or "top".
    pub at: Anchor,
    /// Whether it has a face of its own; false where a model leads into the building.
    #[default(true)]
    pub background: bool,
    /// What it is, with its model: "wall", "window" or "door"; city models tell them apart.
    pub surface: Option<PanelMeaning>,
}

/// The type, as scripts see it.
pub fn kind() -> &'static Arc<Kind> {
    static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
        let kind = Kind::new("panel", "A plain piece of wall, with a model or an image on it if wanted.")
            .example(include_str!("../../scripts/panel.lua"));
        wall_kind(kind, PanelOptions::fields(), |table| make(&PanelOptions::from_table(table)?))
    });
    &KIND
}

fn make(options: &PanelOptions) -> Result<Wall> {
    let decoration = options.decoration.as_ref().map(MaterialOptions::material).transpose()?;
    let model = options.model.clone();
    let meaning = options.surface.map(|PanelMeaning(meaning)| meaning);
    let fixture = model.map(|model| Fixture { meaning, ..Fixture::new(model, options.stretch, options.at) });
    let extent = fixture.as_ref().map(Fixture::extent);
    // A model that is not stretched needs its room.
    let room = extent.filter(|_| !options.stretch).unwrap_or_default();
    let sizes = room.map(|room| Sizes::between(room, f64::INFINITY));
    let targets = [0, 1].map(|side| extent.map(|extent| extent[side]));
    let meaning = meaning.unwrap_or(SurfaceMeaning::Wall);
    let rule = WallRule::Panel { decoration, fixture, background: options.background, meaning };
    Wall::new(rule, sizes, targets, [options.width, options.height], options.material.as_ref())
}
