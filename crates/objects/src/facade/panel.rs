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

/// Fields of `panel { ... }`.
#[fields("panel")]
pub struct PanelOptions {
    /// Width (m): preferred, { minimum, maximum } or { minimum, preferred, maximum }.
    pub width: Option<Size>,
    /// Height (m), in the same form.
    pub height: Option<Size>,
    /// Material of the face. If omitted, the template's.
    pub material: Option<MaterialOptions>,
    /// Material whose image covers the panel once, whatever its size, instead of `material`.
    pub decoration: Option<MaterialOptions>,
    /// Model in the middle of the panel: x to the right, z up, y into the wall.
    pub model: Option<Arc<Model>>,
    /// Stretch the model to the panel's width and height.
    pub stretch: bool,
    /// Vertical position of the model: "bottom", "center" or "top".
    pub at: Anchor,
    /// Draw the panel's own face. Set it to false if a model opens into the building.
    #[default(true)]
    pub background: bool,
    /// Meaning of the panel and its model in city models: "wall", "window" or "door".
    pub surface: Option<PanelMeaning>,
}

/// Returns the script type of panels.
pub fn kind() -> &'static Arc<Kind> {
    static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
        let kind = Kind::new("panel", "A plain wall panel, optionally with a model or an image on it.")
            .example(include_str!("../../scripts/panel.lua"));
        wall_kind(kind, PanelOptions::fields(), |table| make(PanelOptions::from_table(table)?))
    });
    &KIND
}

fn make(options: PanelOptions) -> Result<Wall> {
    let decoration = options.decoration.as_ref().map(MaterialOptions::material).transpose()?;
    let meaning = options.surface.map(|PanelMeaning(meaning)| meaning);
    let fixture =
        options.model.map(|model| Fixture { meaning, ..Fixture::new(model, options.stretch, options.at) });
    let extent = fixture.as_ref().map(Fixture::extent);
    // A model that is not stretched needs its full size.
    let room = extent.filter(|_| !options.stretch).unwrap_or_default();
    let sizes = room.map(|room| Sizes::between(room, f64::INFINITY));
    let targets = [0, 1].map(|side| extent.map(|extent| extent[side]));
    let meaning = meaning.unwrap_or(SurfaceMeaning::Wall);
    let decoration = decoration.map(Box::new);
    let rule = WallRule::Panel { decoration, fixture, background: options.background, meaning };
    Wall::new(kind(), rule, sizes, targets, [options.width, options.height], options.material.as_ref())
}
