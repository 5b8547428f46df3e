//! The replacement for a roof that cannot be constructed.

use glam::DVec2;

use burgeon_base::error::Result;
use burgeon_geometry::roof::{Patch, PatchKind, RoofCover, RoofShape, RoofSurface, Support, floor};
use burgeon_geometry::{Plan, Polygon};

/// A roof, and a note if it replaces another roof.
pub(super) struct RoofReplacement {
    pub cover: RoofCover,
    /// Description of the replacement, and the reason for it.
    pub replaced: Option<(String, String)>,
}

/// Distances (m) by which the outline of a simpler roof may be inside the true one, in the order of attempts.
const SIMPLER: [f64; 3] = [0.05, 0.2, 0.5];
/// Minimum area (m²) of a part of an outline. Smaller parts are covered only by the deck.
const LEAST: f64 = 1.0;

/// Returns the roof that `make` constructs over its support. If `make` fails, a level deck closes the walls. A roof
/// over a simpler outline is then added on the deck as a separate solid, and never covers a courtyard. If that fails as
/// well, only the deck remains.
pub(super) fn cover(
    shape: &RoofShape,
    kind: &str,
    support: &Support<'_>,
    make: &mut impl FnMut(&RoofShape, &Support<'_>) -> Result<RoofCover>,
) -> RoofReplacement {
    let why = match make(shape, support) {
        Ok(cover) => return RoofReplacement { cover, replaced: None },
        Err(error) => error.into_message(),
    };
    let &Support { walls, base, .. } = support;
    let level = |walls: &Polygon, upwards: bool| Patch {
        kind: if upwards { PatchKind::Slope } else { PatchKind::Underside },
        edge: 0,
        flap: 0,
        along: DVec2::X,
        rings: if upwards { walls.at_height(base).to_vec() } else { floor(walls, base) },
    };
    let flush = RoofShape { overhang: 0.0, ..*shape };
    for distance in SIMPLER {
        let outlines = inset_parts(walls, distance);
        let covers = outlines.iter().map(|outline| make(&flush, &Support::new(outline, base)));
        let Ok(covers) = covers.collect::<Result<Vec<RoofCover>>>() else { continue };
        if covers.is_empty() {
            break;
        }
        let mut patches = vec![level(walls, true)];
        for (outline, cover) in outlines.iter().zip(covers) {
            patches.push(level(outline, false));
            patches.extend(cover.patches);
        }
        let text = format!("a {kind} roof over an outline simplified to {distance} m");
        return RoofReplacement {
            cover: RoofCover { patches, ..RoofCover::default() },
            replaced: Some((text, why)),
        };
    }
    let deck = RoofShape { surface: RoofSurface::Flat(None), slab: 0.0, ..flush };
    let cover = make(&deck, &Support::new(walls, base))
        .unwrap_or_else(|_| RoofCover { patches: vec![level(walls, true)], ..RoofCover::default() });
    RoofReplacement { cover, replaced: Some((format!("a flat roof instead of a {kind} roof"), why)) }
}

/// Returns simpler outlines inside the outline of the walls. They keep at least the distance by which simplification
/// may move them, so that all courtyards stay open. Returns none if one of them is invalid.
fn inset_parts(walls: &Polygon, distance: f64) -> Vec<Polygon> {
    let mut outlines = Vec::new();
    for part in walls.inset(1.5 * distance) {
        let rings = part.simplified(distance);
        match Plan::new(&rings.at_height(0.0)) {
            Ok(plan) if plan.repairs().0.is_empty() && plan.polygon().len() == rings.len() => {
                outlines.push(plan.flat());
            }
            // Slivers between the walls and the moved walls are not outlines.
            _ if part.area() < LEAST => {}
            _ => return Vec::new(),
        }
    }
    outlines
}
