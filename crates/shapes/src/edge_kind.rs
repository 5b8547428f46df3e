//! Kinds of edges.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::listed;

/// Kind of an edge by its faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeKind {
    /// Border of an open surface.
    Border,
    /// Level top of two slopes.
    Ridge,
    /// Inclined convex edge of two slopes.
    Hip,
    /// Concave edge of two upward faces, of which one slopes.
    Valley,
    /// Level bottom of a slope.
    Eave,
    /// Inclined edge between a slope and a wall.
    Rake,
    /// Upright edge.
    Corner,
    /// Any other edge.
    Plain,
}

/// Kinds with their names.
const KINDS: [(&str, EdgeKind); 8] = [
    ("border", EdgeKind::Border),
    ("ridge", EdgeKind::Ridge),
    ("hip", EdgeKind::Hip),
    ("valley", EdgeKind::Valley),
    ("eave", EdgeKind::Eave),
    ("rake", EdgeKind::Rake),
    ("corner", EdgeKind::Corner),
    ("plain", EdgeKind::Plain),
];

impl EdgeKind {
    /// Returns the name.
    pub fn name(self) -> &'static str {
        KINDS.iter().find(|(_, kind)| *kind == self).map_or("plain", |(name, _)| name)
    }

    /// Reads a name.
    pub fn read(name: &str) -> Result<Self> {
        let found = KINDS.iter().find(|(known, _)| *known == name);
        found.map(|(_, kind)| *kind).ok_or_else(|| {
            let names = || KINDS.iter().map(|(name, _)| *name);
            Error::not_found("edge", name, names(), format!("unknown kind of edge {name:?}"))
                .help(format!("use one of {}", listed(names())))
        })
    }
}
