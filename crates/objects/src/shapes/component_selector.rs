//! Selectors of the components of a shape.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_shapes::{EdgeKind, Selector, ShapeBody};

use super::object::ShapeObject;

/// Selector of an edge by its kind, or of any component by its direction, inclination or tags.
pub(super) enum ComponentSelector {
    /// Edges of a kind.
    Edge(EdgeKind),
    /// Components that a selector of faces matches.
    Face(Selector),
}

impl ComponentSelector {
    /// Reads the name of a selector, of edges or of other components.
    pub(super) fn read(name: &str, of_edges: bool) -> Result<Self> {
        // The error of an unknown kind has a suggestion, which takes longer than the rest.
        if of_edges && let Ok(kind) = EdgeKind::read(name) {
            return Ok(Self::Edge(kind));
        }
        Selector::read(name).map(Self::Face)
    }
}

impl ShapeObject {
    /// Returns true if the shape is an edge.
    pub(super) fn is_edge(&self) -> bool {
        matches!(self.shape.body, ShapeBody::Edge(..))
    }

    /// Returns true if `selector` selects this component among those of the shape that it comes from.
    pub(super) fn is_selected(&self, selector: &ComponentSelector) -> bool {
        let selector = match (selector, &self.shape.body) {
            (ComponentSelector::Edge(wanted), ShapeBody::Edge(kind, _)) => return kind == wanted,
            (ComponentSelector::Edge(_), _) => return false,
            (ComponentSelector::Face(selector), _) => selector,
        };
        match selector.bit() {
            Some(bit) if self.matching != 0 => self.matching & bit != 0,
            _ => {
                let (normal, axes) = (self.shape.normal(), &self.shape.scope().axes);
                match &self.shape.body {
                    ShapeBody::Rectangle(style) => selector.matches(normal, style, axes),
                    _ => self.shape.styles().iter().any(|style| selector.matches(normal, style, axes)),
                }
            }
        }
    }
}

/// Choice of components of a kind by selectors.
pub(super) struct ComponentChoice {
    components: ComponentsOf,
    selectors: Vec<ComponentSelector>,
}

/// Components of a kind of a shape.
type ComponentsOf = fn(&ShapeObject) -> Result<Vec<Arc<ShapeObject>>>;

impl ComponentChoice {
    /// Reads the kind of the components and the names of the selectors.
    pub(super) fn read(kind: &str, selectors: &[String]) -> Result<Self> {
        let components: ComponentsOf = match kind {
            "faces" => |shape| shape.faces(None),
            "edges" => |shape| shape.edges(None),
            "holes" => |shape| Ok(shape.holes()),
            "pieces" => |shape| shape.pieces(),
            other => {
                return Err(Error::argument(format!("shape:components: unknown kind {other:?}"))
                    .help("use \"faces\", \"edges\", \"holes\" or \"pieces\""));
            }
        };
        let read = |name: &String| ComponentSelector::read(name, kind == "edges");
        let selectors = selectors.iter().map(read).collect::<Result<_>>();
        Ok(Self { components, selectors: selectors.map_err(|error| error.about("shape:components"))? })
    }

    /// Returns the components of a shape that a selector matches, with the number of the first that does.
    pub(super) fn of(&self, shape: &ShapeObject) -> Result<Vec<Arc<ShapeObject>>> {
        let mut components = (self.components)(shape)?;
        components.retain_mut(|component| {
            let found = self.selectors.iter().position(|selector| component.is_selected(selector));
            if let (Some(number), Some(component)) = (found, Arc::get_mut(component)) {
                component.place.entry = u32::try_from(number).unwrap_or(u32::MAX);
            }
            found.is_some()
        });
        Ok(components)
    }
}
