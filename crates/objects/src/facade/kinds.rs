//! The object types of walls.

use std::sync::Arc;

use super::{bordered, extruded, grid, list, panel};
use burgeon_kit::Kind;

/// Returns the types of walls.
pub(crate) fn kinds() -> [&'static Arc<Kind>; 5] {
    [panel::kind(), bordered::kind(), extruded::kind(), list::kind(), grid::kind()]
}
