//! What stands on a building whose own roof cannot be made.

use glam::DVec2;

use burgeon_base::error::Result;
use burgeon_geometry::roof::{Patch, PatchKind, RoofCover, RoofShape, RoofSurface, Support, floor};
use burgeon_geometry::{Plan, Polygon};

/// A roof, and what it is in place of.
pub(super) struct RoofReplacement {
    pub cover: RoofCover,
    /// What was done instead, and why.
    pub replaced: Option<(String, String)>,
}

/// How far (m) the outline of a simpler roof may be within the true one, in turn.
const SIMPLER: [f64; 3] = [0.05, 0.2, 0.5];
/// Parts of an outline that are smaller than this (m²) are left to the deck.
const LEAST: f64 = 1.0;

/// The roof that `make` makes over its support; where it fails, a level deck closes the walls, and a roof over a simpler
/// outline stands on it as a solid of its own, nowhere over a courtyard; or the deck alone.
pub(super) fn cover(
    shape: &RoofShape,
    kind: &str,
    support: &Support<'_>,
    make: &mut impl FnMut(&RoofShape, &Support<'_>) -> Result<RoofCover>,
) -> RoofReplacement {
    let why = match make(shape, support) {
        Ok(cover) => return RoofReplacement { cover, replaced: None },
        Err(error) => error.message().to_owned(),
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
        let outlines = within(walls, distance);
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
    RoofReplacement { cover, replaced: Some((format!("a flat roof in place of a {kind} roof"), why)) }
}

/// Simpler outlines within that of the walls, none of them nearer to it than the simplification may move them, so that
/// all courtyards stay open; none if one would not be sound.
fn within(walls: &Polygon, distance: f64) -> Vec<Polygon> {
    let mut outlines = Vec::new();
    for part in walls.inset(1.5 * distance) {
        let rings = part.simplified(distance);
        match Plan::new(&rings.at_height(0.0)) {
            Ok(plan) if plan.repairs().0.is_empty() && plan.polygon().len() == rings.len() => {
                outlines.push(plan.flat());
            }
            // Slivers between the walls and where they were moved to are no outlines.
            _ if part.area() < LEAST => {}
            _ => return Vec::new(),
        }
    }
    outlines
}
