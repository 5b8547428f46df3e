//! Vertex colours: triangles are grouped by their colour, because a surface has only the colour of its material.

use std::collections::BTreeMap;

use gltf_json::{Accessor, Index};

use super::bytes::NumberColumns;
use burgeon_base::error::{Error, Result};

/// Triangles, grouped by the factor for their material's colour.
type TintedTriangles = Vec<([f32; 4], Vec<[u32; 3]>)>;

/// Number of shades per channel: as in an image, or fewer if there would be too many colours.
const SHADES: [f32; 2] = [255.0, 15.0];
/// Maximum number of colours of a primitive with the finer shades.
const MOST: usize = 256;

/// Groups `triangles` by the mean colour of their points, of which there are `count`. Without `colors`, there is one
/// group.
pub(super) fn group_by_tint(
    columns: &mut NumberColumns<'_>,
    colors: Option<Index<Accessor>>,
    count: usize,
    triangles: Vec<[u32; 3]>,
) -> Result<TintedTriangles> {
    if triangles.is_empty() {
        return Ok(Vec::new());
    }
    let Some(index) = colors else { return Ok(vec![([1.0; 4], triangles)]) };
    let colors: Vec<[f32; 4]> = if columns.width(index) == 3 {
        let triples = columns.triples(index)?;
        columns.budget.take(triples.len() * size_of::<[f32; 4]>())?;
        triples.iter().map(|[red, green, blue]| [*red, *green, *blue, 1.0]).collect()
    } else {
        columns.fours(index)?.to_vec()
    };
    if colors.len() != count {
        return Err(Error::data("its number of colours differs from its number of points"));
    }
    let _held = columns.budget.hold(triangles.len() * (size_of::<[u32; 3]>() + 8))?;
    let key = |triangle: &[u32; 3], shades: f32| -> [u8; 4] {
        std::array::from_fn(|channel| {
            let sum: f32 = triangle.iter().map(|point| colors[*point as usize][channel]).sum();
            let mean = if sum.is_finite() { (sum / 3.0).clamp(0.0, 1.0) } else { 1.0 };
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
            let shade = (mean.sqrt() * shades).round() as u8;
            shade
        })
    };
    for shades in SHADES {
        let mut groups: BTreeMap<[u8; 4], Vec<[u32; 3]>> = BTreeMap::new();
        for triangle in &triangles {
            groups.entry(key(triangle, shades)).or_default().push(*triangle);
            if groups.len() > MOST && shades > SHADES[1] {
                break;
            }
        }
        if groups.len() <= MOST || shades <= SHADES[1] {
            let tint = |key: [u8; 4]| key.map(|shade| (f32::from(shade) / shades).powi(2));
            return Ok(groups.into_iter().map(|(key, triangles)| (tint(key), triangles)).collect());
        }
    }
    Ok(Vec::new())
}
