//! Partition of a block into cells with shared corners: after any cut, the cells are disjoint and cover the block.

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};

use super::fine::{self, FinePlace};
use burgeon_geometry::planar::{edges, twice_area};

/// Index of a corner.
pub(super) type CornerId = u32;
/// Index of a cell.
pub(super) type CellId = u32;
/// Corners of a cell's rings: the outer ring first, counter-clockwise; the holes clockwise.
pub(super) type CellRings = Vec<Vec<CornerId>>;

/// Distance (m) from a corner below which a crossing uses that corner.
const NEAR: f64 = 0.02;

/// Cells that fill a block.
///
/// Two cells share only corners and whole edges, and each shared edge has one of the cells on either side. So the cells
/// never overlap, and their areas add up even though corners are on a grid.
#[derive(Debug, Clone, Default)]
pub(super) struct Partition {
    places: Vec<FinePlace>,
    /// Cells by index; `None` for a cell that was cut or joined.
    cells: Vec<Option<CellRings>>,
    /// Cell on the left of each edge.
    beside: FxHashMap<[CornerId; 2], CellId>,
    /// Side of the block for each edge along it.
    sides: FxHashMap<[CornerId; 2], u32>,
}

/// Cut of a cell that is not yet applied.
#[derive(Debug, Clone)]
pub(super) struct Cut {
    cell: CellId,
    /// Edges that get a corner between their ends.
    splits: Vec<([CornerId; 2], CornerId)>,
    /// Resulting cells.
    pub(super) pieces: Vec<CellRings>,
}

impl Partition {
    /// Creates a partition with one cell; `sides` contains the side of each edge of each ring, if the edge is along a
    /// street.
    ///
    /// Returns `None` if the rings intersect or have the wrong orientation.
    pub(super) fn new(rings: &[Vec<DVec2>], sides: &[Vec<Option<u32>>]) -> Option<Self> {
        let mut partition = Self::default();
        let mut cell = CellRings::new();
        for (ring, sides) in rings.iter().zip(sides) {
            let mut corners = Vec::with_capacity(ring.len());
            for place in ring {
                let place = FinePlace::nearest(*place)?;
                corners.push(partition.add(place));
            }
            for (edge, side) in edges(&corners).zip(sides) {
                if let Some(side) = side {
                    partition.sides.insert(edge, *side);
                }
            }
            cell.push(corners);
        }
        let places: Vec<Vec<FinePlace>> = cell.iter().map(|ring| partition.ring_places(ring)).collect();
        if !fine::are_simple(&places) || !partition.is_cell(&cell) {
            return None;
        }
        partition.push(cell);
        Some(partition)
    }

    fn add(&mut self, place: FinePlace) -> CornerId {
        #[allow(clippy::cast_possible_truncation, reason = "blocks have far fewer corners")]
        let id = self.places.len() as CornerId;
        self.places.push(place);
        id
    }

    fn ring_places(&self, ring: &[CornerId]) -> Vec<FinePlace> {
        ring.iter().map(|corner| self.places[*corner as usize]).collect()
    }

    fn is_cell(&self, cell: &CellRings) -> bool {
        let Some((outer, holes)) = cell.split_first() else { return false };
        let places = self.ring_places(outer);
        self.ring_area(outer) > 0.0
            && holes.iter().all(|hole| {
                self.ring_area(hole) < 0.0 && fine::is_inside(&places, self.places[hole[0] as usize])
            })
    }

    fn push(&mut self, rings: CellRings) -> CellId {
        #[allow(clippy::cast_possible_truncation, reason = "blocks have far fewer cells")]
        let id = self.cells.len() as CellId;
        for edge in rings.iter().flat_map(|ring| edges(ring)) {
            self.beside.insert(edge, id);
        }
        self.cells.push(Some(rings));
        id
    }

    /// Replaces the first cell by faces. The first of `places` are the cell's corners, in order. Returns the cell of
    /// each face, or `None` for a face without area. Returns `None` as a whole if the faces do not fill the cell or if
    /// they intersect.
    pub(super) fn tile(&mut self, places: &[DVec2], faces: &[Vec<usize>]) -> Option<Vec<Option<CellId>>> {
        let whole = self.area(self.rings(0));
        let known = self.places.len();
        let mut tiled = self.clone();
        tiled.take(0);
        for place in places.get(known..)? {
            tiled.add(FinePlace::nearest(*place)?);
        }
        let mut cells = Vec::with_capacity(faces.len());
        let mut sum = 0.0;
        for face in faces {
            let ring: Option<Vec<CornerId>> =
                face.iter().map(|corner| CornerId::try_from(*corner).ok()).collect();
            let ring = ring?;
            let area = if ring.len() < 3 { 0.0 } else { tiled.ring_area(&ring) };
            if area < NEAR * NEAR {
                if area < -NEAR * NEAR {
                    return None;
                }
                cells.push(None);
                continue;
            }
            if edges(&ring).any(|edge| tiled.beside.contains_key(&edge))
                || !fine::are_simple(&[tiled.ring_places(&ring)])
            {
                return None;
            }
            sum += area;
            cells.push(Some(tiled.push(vec![ring])));
        }
        // After rounding, a corner of one face may be beyond an edge of another.
        if (sum - whole).abs() > 2e-7 * whole || !tiled.are_apart() {
            return None;
        }
        *self = tiled;
        Some(cells)
    }

    /// Returns true if the borders of cells meet only at their corners.
    fn are_apart(&self) -> bool {
        let borders = self.cells().flat_map(|(_, rings)| rings).flat_map(|ring| edges(ring));
        let once = borders.filter(|[a, b]| a < b || !self.beside.contains_key(&[*b, *a]));
        fine::are_apart(once.map(|edge| edge.map(|corner| self.places[corner as usize])).collect())
    }

    /// Returns the cell on the left of an edge.
    pub(super) fn cell_beside(&self, edge: [CornerId; 2]) -> Option<CellId> {
        self.beside.get(&edge).copied()
    }

    /// Returns the cells in order of creation.
    pub(super) fn cells(&self) -> impl Iterator<Item = (CellId, &CellRings)> {
        (0..).zip(&self.cells).filter_map(|(id, cell)| Some((id, cell.as_ref()?)))
    }

    /// Returns the rings of a cell; empty if it was cut or joined.
    pub(super) fn rings(&self, cell: CellId) -> &[Vec<CornerId>] {
        self.cells[cell as usize].as_deref().unwrap_or_default()
    }

    /// Returns the position of a corner (m).
    pub(super) fn at(&self, corner: CornerId) -> DVec2 {
        self.places[corner as usize].metres()
    }

    /// Returns the area (m²) inside a ring; negative if the ring is clockwise.
    fn ring_area(&self, ring: &[CornerId]) -> f64 {
        twice_area(ring.iter().map(|corner| self.at(*corner))) / 2.0
    }

    /// Returns the area (m²) of a cell, or of a possible cell.
    pub(super) fn area(&self, rings: &[Vec<CornerId>]) -> f64 {
        rings.iter().map(|ring| self.ring_area(ring)).sum()
    }

    /// Returns the side of the block along an edge, including parts of an edge that `cut` would divide.
    pub(super) fn side(&self, edge: [CornerId; 2], cut: Option<&Cut>) -> Option<u32> {
        let whole = || {
            let splits = &cut?.splits;
            let split = splits.iter().find(|([a, b], v)| edge == [*a, *v] || edge == [*v, *b]);
            self.sides.get(&split?.0).copied()
        };
        self.sides.get(&edge).copied().or_else(whole)
    }

    /// Plans the cut of a cell along the line through `at` in the direction `way`; `None` if the line does not divide
    /// the cell, or if the cut is not possible on the grid.
    pub(super) fn cut(&mut self, cell: CellId, at: DVec2, way: DVec2) -> Option<Cut> {
        let mut rings = self.cells[cell as usize].clone()?;
        let mut splits = Vec::new();
        let mut ends: Vec<(f64, CornerId)> = Vec::new();
        for ring in &mut rings {
            let mut divided = Vec::with_capacity(ring.len() + 4);
            for [a, b] in edges(ring) {
                divided.push(a);
                let [from, to] = [a, b].map(|end| self.at(end));
                let [before, behind] = [from, to].map(|end| way.perp_dot(end - at));
                if (before >= 0.0) == (behind >= 0.0) {
                    continue;
                }
                let place = from.lerp(to, before / (before - behind));
                let near = [(a, from), (b, to)].into_iter().find(|(_, end)| end.distance(place) < NEAR);
                let corner = match near {
                    Some((end, _)) => end,
                    None => {
                        let corner = self.add(FinePlace::nearest(place)?);
                        splits.push(([a, b], corner));
                        divided.push(corner);
                        corner
                    }
                };
                ends.push(((self.at(corner) - at).dot(way), corner));
            }
            *ring = divided;
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let pairs = ends.chunks_exact(2).map(|pair| [pair[0].1, pair[1].1]);
        let chords: Vec<[CornerId; 2]> = pairs.filter(|[a, b]| a != b).collect();
        let mut seen = FxHashSet::default();
        if chords.is_empty() || !chords.iter().flatten().all(|end| seen.insert(*end)) {
            return None;
        }
        if !self.is_free(cell, &rings, &splits, &chords) {
            return None;
        }
        let pieces = self.pieces(&rings, &chords)?;
        Some(Cut { cell, splits, pieces })
    }

    /// Returns true if the chords intersect no edge of a cell, and if edges with a new corner intersect nothing on
    /// either side.
    fn is_free(
        &self,
        cell: CellId,
        rings: &CellRings,
        splits: &[([CornerId; 2], CornerId)],
        chords: &[[CornerId; 2]],
    ) -> bool {
        let placed = |edge: [CornerId; 2]| edge.map(|end| self.places[end as usize]);
        let halves = splits.iter().flat_map(|([a, b], v)| [[*a, *v], [*v, *b]]);
        let changed: Vec<[CornerId; 2]> = chords.iter().copied().chain(halves).collect();
        let all: Vec<[CornerId; 2]> = rings.iter().flat_map(|ring| edges(ring)).collect();
        let is_free = |edge: &[CornerId; 2], others: &[[CornerId; 2]]| {
            others.iter().all(|other| other == edge || !fine::meet(placed(*edge), placed(*other)))
        };
        if !changed.iter().all(|edge| is_free(edge, &all) && is_free(edge, chords)) {
            return false;
        }
        splits.iter().all(|([a, b], v)| {
            // An edge without an adjacent cell may still have a cell behind it, closer than the grid resolution.
            let others: Vec<[CornerId; 2]> = match self.beside.get(&[*b, *a]) {
                Some(other) if *other == cell => return true,
                Some(other) => self.rings(*other).iter().flat_map(|ring| edges(ring)).collect(),
                None => self
                    .cells()
                    .filter(|(other, _)| *other != cell)
                    .flat_map(|(_, rings)| rings.iter().flat_map(|ring| edges(ring)))
                    .collect(),
            };
            let others: Vec<[CornerId; 2]> = others.into_iter().filter(|edge| *edge != [*b, *a]).collect();
            is_free(&[*b, *v], &others) && is_free(&[*v, *a], &others)
        })
    }

    /// Returns the cells into which chords divide rings.
    fn pieces(&self, rings: &CellRings, chords: &[[CornerId; 2]]) -> Option<Vec<CellRings>> {
        let mut next: FxHashMap<[CornerId; 2], CornerId> = FxHashMap::default();
        let mut across: FxHashMap<CornerId, CornerId> = FxHashMap::default();
        for [a, b] in chords {
            across.insert(*a, *b);
            across.insert(*b, *a);
        }
        for ring in rings {
            for index in 0..ring.len() {
                let [before, here, after] = [0, 1, 2].map(|offset| ring[(index + offset) % ring.len()]);
                match across.get(&here) {
                    Some(far) => {
                        next.insert([before, here], *far);
                        next.insert([*far, here], after);
                    }
                    None => {
                        next.insert([before, here], after);
                    }
                }
            }
        }
        let mut due: Vec<[CornerId; 2]> = rings.iter().flat_map(|ring| edges(ring)).collect();
        due.extend(chords.iter().flat_map(|[a, b]| [[*a, *b], [*b, *a]]));
        let mut outer: Vec<CellRings> = Vec::new();
        let mut holes = Vec::new();
        for first in due {
            let mut ring = Vec::new();
            let mut edge = first;
            while let Some(after) = next.remove(&edge) {
                ring.push(edge[0]);
                edge = [edge[1], after];
            }
            if ring.is_empty() {
                continue;
            }
            let mut seen = FxHashSet::default();
            if ring.len() < 3 || !ring.iter().all(|corner| seen.insert(*corner)) {
                return None;
            }
            if self.ring_area(&ring) > 0.0 { outer.push(vec![ring]) } else { holes.push(ring) }
        }
        for hole in holes {
            let place = self.places[*hole.first()? as usize];
            let around = outer.iter_mut().find(|cell| fine::is_inside(&self.ring_places(&cell[0]), place));
            around?.push(hole);
        }
        (outer.len() > 1).then_some(outer)
    }

    /// Applies a cut; returns the resulting cells in the order of the cut's pieces.
    pub(super) fn commit(&mut self, cut: Cut) -> Vec<CellId> {
        for (edge @ [a, b], v) in cut.splits {
            if let Some(side) = self.sides.remove(&edge) {
                self.sides.insert([a, v], side);
                self.sides.insert([v, b], side);
            }
            if let Some(other) = self.beside.remove(&[b, a]) {
                self.beside.insert([b, v], other);
                self.beside.insert([v, a], other);
                for ring in self.cells[other as usize].iter_mut().flatten() {
                    let found = edges(ring).position(|edge| edge == [b, a]);
                    if let Some(index) = found {
                        ring.insert(index + 1, v);
                    }
                }
            }
        }
        self.take(cut.cell);
        cut.pieces.into_iter().map(|rings| self.push(rings)).collect()
    }

    fn take(&mut self, cell: CellId) -> CellRings {
        let rings = self.cells[cell as usize].take().unwrap_or_default();
        for edge in rings.iter().flat_map(|ring| edges(ring)) {
            if self.beside.get(&edge) == Some(&cell) {
                self.beside.remove(&edge);
            }
        }
        rings
    }

    /// Returns the cells that share an edge with a cell, each with the total length (m) of the shared edges.
    pub(super) fn neighbors(&self, cell: CellId) -> Vec<(CellId, f64)> {
        let mut found: Vec<(CellId, f64)> = Vec::new();
        for [a, b] in self.rings(cell).iter().flat_map(|ring| edges(ring)) {
            let Some(other) = self.beside.get(&[b, a]).copied() else { continue };
            let length = self.at(a).distance(self.at(b));
            match found.iter_mut().find(|(known, _)| *known == other) {
                Some((_, sum)) => *sum += length,
                None => found.push((other, length)),
            }
        }
        found
    }

    /// Returns the union of cells; `None` if it would touch itself at a corner or fall apart.
    fn joined_rings(&self, cells: &[CellId]) -> Option<CellRings> {
        let all = cells.iter().flat_map(|cell| self.rings(*cell)).flat_map(|ring| edges(ring));
        let all: Vec<[CornerId; 2]> = all.collect();
        let known: FxHashSet<[CornerId; 2]> = all.iter().copied().collect();
        let mut next: FxHashMap<CornerId, CornerId> = FxHashMap::default();
        let mut due = Vec::new();
        for [from, to] in all.into_iter().filter(|[from, to]| !known.contains(&[*to, *from])) {
            if next.insert(from, to).is_some() {
                return None;
            }
            due.push(from);
        }
        let mut rings = CellRings::new();
        for first in due {
            let mut ring = Vec::new();
            let mut corner = first;
            while let Some(after) = next.remove(&corner) {
                ring.push(corner);
                corner = after;
            }
            if !ring.is_empty() {
                rings.push(ring);
            }
        }
        let outer = rings.iter().position(|ring| self.ring_area(ring) > 0.0)?;
        rings.swap(0, outer);
        let places: Vec<Vec<FinePlace>> = rings.iter().map(|ring| self.ring_places(ring)).collect();
        (self.is_cell(&rings) && fine::are_simple(&places)).then_some(rings)
    }

    /// Joins cells; returns the resulting cell, or `None` if it would touch itself at a corner or fall apart.
    pub(super) fn join(&mut self, cells: &[CellId]) -> Option<CellId> {
        let rings = self.joined_rings(cells)?;
        for cell in cells {
            self.take(*cell);
        }
        Some(self.push(rings))
    }
}
