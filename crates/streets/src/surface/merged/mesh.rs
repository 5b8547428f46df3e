//! One triangulation of the area that the streets of a level cover, and of the blocks between them.
//!
//! Method: the borders of all parts are noded on the grid (snap rounding). Only borders between different surfaces are
//! kept. A constrained Delaunay triangulation of these borders is divided into surfaces, triangle by triangle.

use std::collections::BTreeMap;

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::cover::{CoverIndex, StreetCover};
use super::loops::{MeshTriangle, components, loops};
use crate::existing::{StreetStrand, node};
use crate::plan::corner::StreetLine;
use crate::plan::grid::GridPlace;
use crate::plan::merge_cache::{MergeOptions, MergedBlock, MergedLevel};
use crate::plan::network::StreetNetwork;
use burgeon_geometry::Rings;
use burgeon_geometry::planar::twice_area;

/// Distance (m) from both sides of a border at which its surfaces are tested.
const ASIDE: f64 = 0.002;
/// Minimum mean width (m) and minimum area (m²) of a block; smaller areas between streets are paved.
const LEAST_BLOCK: [f64; 2] = [2.5, 15.0];

/// Computes the surfaces of the streets of a level.
pub(super) fn level(network: &StreetNetwork, level: i32, options: MergeOptions) -> MergedLevel {
    let cover = CoverIndex::new(network, level, options);
    let mut borders: Vec<StreetStrand> = Vec::new();
    for line in [StreetLine::Edge, StreetLine::Kerb] {
        borders.extend(borders_of(&cover, line));
    }
    node(&mut borders);
    let mut edges: FxHashSet<[GridPlace; 2]> = FxHashSet::default();
    for pair in borders.iter().flat_map(|border| border.places.windows(2)) {
        edges.insert([pair[0].min(pair[1]), pair[0].max(pair[1])]);
    }
    let mut edges: Vec<[GridPlace; 2]> = edges.into_iter().filter(|[a, b]| a != b).collect();
    edges.sort_unstable();
    let edges = divide_edges(edges, options.longest);
    let mut made = MergedLevel { level, ..MergedLevel::default() };
    let triangles = triangulate(&edges, &mut made.points);
    sort_out(&cover, &triangles, level == 0, &mut made);
    made
}

/// Returns the borders between different surfaces, of whole streets or of their carriageways.
fn borders_of(cover: &CoverIndex, line: StreetLine) -> Vec<StreetStrand> {
    let mut strands: Vec<StreetStrand> = Vec::new();
    for part in cover.parts.iter().filter(|part| part.line == line) {
        let mut places: Vec<GridPlace> = part.ring.iter().filter_map(|at| GridPlace::nearest(*at)).collect();
        places.extend(places.first().copied());
        places.dedup();
        if places.len() > 2 {
            strands.push(StreetStrand { street: 0, level: 0, length: 0.0, places });
        }
    }
    node(&mut strands);
    let mut known: FxHashSet<[GridPlace; 2]> = FxHashSet::default();
    let mut kept = Vec::new();
    let is_covered = |covered: StreetCover| covered != StreetCover::Free;
    for pair in strands.iter().flat_map(|strand| strand.places.windows(2)) {
        let ends = [pair[0].min(pair[1]), pair[0].max(pair[1])];
        if ends[0] == ends[1] || !known.insert(ends) {
            continue;
        }
        let [a, b] = ends.map(GridPlace::metres);
        let aside = (b - a).normalize_or_zero().perp() * ASIDE;
        let sides = [1.0, -1.0].map(|side| cover.at(a.midpoint(b) + aside * side));
        let differs = match line {
            StreetLine::Edge => is_covered(sides[0]) != is_covered(sides[1]),
            StreetLine::Kerb => sides[0] != sides[1],
        };
        if differs {
            kept.push(StreetStrand { street: 0, level: 0, length: 0.0, places: ends.to_vec() });
        }
    }
    kept
}

/// Divides edges into parts of at most `longest` (m).
fn divide_edges(edges: Vec<[GridPlace; 2]>, longest: f64) -> Vec<[GridPlace; 2]> {
    if longest.is_infinite() {
        return edges;
    }
    let divide = |[a, b]: [GridPlace; 2]| {
        let (from, to) = (a.metres(), b.metres());
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "edges are short")]
        let count = (from.distance(to) / longest).ceil().max(1.0) as u32;
        let at = |index: u32| GridPlace::nearest(from.lerp(to, f64::from(index) / f64::from(count)));
        let places: Vec<GridPlace> =
            std::iter::once(a).chain((1..count).filter_map(at)).chain(std::iter::once(b)).collect();
        places.windows(2).map(|pair| [pair[0], pair[1]]).collect::<Vec<_>>()
    };
    let mut strands: Vec<StreetStrand> = edges
        .into_iter()
        .flat_map(divide)
        .map(|ends| StreetStrand { street: 0, level: 0, length: 0.0, places: ends.to_vec() })
        .collect();
    // Rounding may have moved a point over another edge.
    node(&mut strands);
    let mut edges: Vec<[GridPlace; 2]> = strands
        .iter()
        .flat_map(|strand| strand.places.windows(2))
        .map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])])
        .filter(|[a, b]| a != b)
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Triangulates the convex hull of the edges; adds the vertices to `points`.
fn triangulate(edges: &[[GridPlace; 2]], points: &mut Vec<DVec2>) -> Vec<MeshTriangle> {
    let mut places: Vec<GridPlace> = edges.iter().flatten().copied().collect();
    places.sort_unstable();
    places.dedup();
    // Coordinates relative to the centre keep all their digits.
    let middle = match (places.first(), places.last()) {
        (Some(first), Some(last)) => first.metres().midpoint(last.metres()).round(),
        _ => return Vec::new(),
    };
    let numbers: FxHashMap<GridPlace, usize> = places.iter().copied().zip(0..).collect();
    let vertices =
        places.iter().map(|place| place.metres() - middle).map(|at| Point2::new(at.x, at.y)).collect();
    let constraints = edges.iter().filter_map(|[a, b]| Some([*numbers.get(a)?, *numbers.get(b)?])).collect();
    // Edges that would cross others are skipped; there are none by construction.
    let Ok(mesh) =
        ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(vertices, constraints, |_| {})
    else {
        return Vec::new();
    };
    points.extend(mesh.vertices().map(|vertex| {
        let at = vertex.position();
        middle + DVec2::new(at.x, at.y)
    }));
    let mut of_face: FxHashMap<usize, u32> = FxHashMap::default();
    for (number, face) in (0..).zip(mesh.inner_faces()) {
        of_face.insert(face.fix().index(), number);
    }
    let number = |index: usize| u32::try_from(index).unwrap_or(u32::MAX);
    mesh.inner_faces()
        .map(|face| {
            let edges = face.adjacent_edges();
            MeshTriangle {
                corners: edges.map(|edge| number(edge.from().fix().index())),
                beyond: edges.map(|edge| {
                    edge.rev().face().as_inner().and_then(|face| of_face.get(&face.fix().index()).copied())
                }),
            }
        })
        .collect()
}

/// Assigns triangles to surfaces, and finds the edges between surfaces.
fn sort_out(cover: &CoverIndex, triangles: &[MeshTriangle], has_blocks: bool, made: &mut MergedLevel) {
    let middle = |triangle: &MeshTriangle| {
        triangle.corners.map(|corner| made.points[corner as usize]).iter().sum::<DVec2>() / 3.0
    };
    let mut covered: Vec<StreetCover> = triangles.iter().map(|triangle| cover.at(middle(triangle))).collect();
    let free = components(triangles, &covered);
    for component in &free {
        let all = || component.iter().map(|number| &triangles[*number as usize]);
        let area: f64 = all()
            .map(|triangle| twice_area(triangle.corners.map(|corner| made.points[corner as usize])) / 2.0)
            .sum();
        let sides = all().flat_map(|triangle| (0..3).map(move |side| (triangle, side)));
        let border = sides.filter(|(triangle, side)| {
            triangle.beyond[*side].is_none_or(|beyond| covered[beyond as usize] != StreetCover::Free)
        });
        let around: f64 = border
            .map(|(triangle, side)| {
                let [a, b] =
                    [side, (side + 1) % 3].map(|corner| made.points[triangle.corners[corner] as usize]);
                a.distance(b)
            })
            .sum();
        if area < LEAST_BLOCK[1] || 2.0 * area < LEAST_BLOCK[0] * around {
            component.iter().for_each(|number| covered[*number as usize] = StreetCover::Walk);
        } else if has_blocks {
            made.blocks.push(MergedBlock {
                rings: Rings(Vec::new()),
                triangles: component.iter().map(|number| triangles[*number as usize].corners).collect(),
            });
        }
    }
    let mut carriageways: BTreeMap<u32, Vec<[u32; 3]>> = BTreeMap::new();
    for (triangle, covered) in triangles.iter().zip(&covered) {
        match covered {
            StreetCover::Free => {}
            StreetCover::Walk => made.walks.push(triangle.corners),
            StreetCover::Carriageway(depth) => carriageways.entry(*depth).or_default().push(triangle.corners),
        }
    }
    made.carriageways = carriageways.into_iter().collect();
    let is_carriageway = |covered: StreetCover| matches!(covered, StreetCover::Carriageway(_));
    for (triangle, own) in triangles.iter().zip(&covered) {
        for side in 0..3 {
            let beyond = triangle.beyond[side].map_or(StreetCover::Free, |beyond| covered[beyond as usize]);
            // The triangle itself is on the right of the edge.
            let edge = [triangle.corners[(side + 1) % 3], triangle.corners[side]];
            if is_carriageway(*own) && !is_carriageway(beyond) {
                made.kerbs.push(edge);
            }
            if *own != StreetCover::Free && beyond == StreetCover::Free {
                made.edges.push(edge);
            }
        }
    }
    for block in &mut made.blocks {
        block.rings = loops(&block.triangles, &made.points);
    }
    made.blocks.retain(|block| !block.rings.is_empty());
}
