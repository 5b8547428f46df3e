//! Sheets: groups of faces of one colour. Few sheets, drawn in order, show the front faces correctly.

use super::faces::{Ink, PaperPoint, VisibleFace, VisibleFaces, VisibleLineKind};
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use rustc_hash::FxHashMap;

/// Maximum total number of cells that all faces touch; bounds the time.
const TOUCHES: f64 = 1e7;

/// Number of faces in a cell from which faces are assumed to overlap, because testing each pair would take too long.
const CROWD: u32 = 64;

/// Faces that are filled together, and the lines over them.
pub(super) struct PaperSheet {
    /// Fill of the faces.
    pub(super) ink: Ink,
    /// Indices of the faces.
    pub(super) faces: Vec<u32>,
    /// End points of lines around shapes.
    pub(super) lines: Vec<[PaperPoint; 2]>,
    /// End points of lines around shapes that are barely wider than a line.
    pub(super) thin: Vec<[PaperPoint; 2]>,
    /// End points of lines around shapes that are narrower than a line.
    pub(super) hairs: Vec<[PaperPoint; 2]>,
    /// End points of lines to lower sheets that have another shade of the same surface.
    pub(super) seams: Vec<[PaperPoint; 2]>,
}

impl PaperSheet {
    fn new(ink: Ink) -> Self {
        Self {
            ink,
            faces: Vec::new(),
            lines: Vec::new(),
            thin: Vec::new(),
            hairs: Vec::new(),
            seams: Vec::new(),
        }
    }
}

/// Sorts the faces into sheets from back to front.
///
/// Faces are placed from the back, each on the lowest sheet of its ink that is not below a face that it overlaps. Faces
/// of one ink that are not separated by others therefore share a sheet, and front faces come later. Shapes narrower
/// than three times the `pen` (m) are thin, and shapes narrower than the pen are hairs. Fails if `stop` requests
/// cancellation.
pub(super) fn stack(faces: &VisibleFaces, pen: f64, stop: &Stop) -> Result<Vec<PaperSheet>> {
    let Some(mut grid) = PaperGrid::around(faces) else { return Ok(Vec::new()) };
    let mut order: Vec<u32> = (0..faces.faces.len() as u32).collect();
    order.sort_by(|a, b| faces.faces[*a as usize].depth.total_cmp(&faces.faces[*b as usize].depth));
    let mut sheets: Vec<PaperSheet> = Vec::new();
    let mut of_ink: FxHashMap<Ink, Vec<u32>> = FxHashMap::default();
    let mut sheet_of = vec![0; faces.faces.len()];
    for index in order {
        stop.check()?;
        let face = &faces.faces[index as usize];
        let lowest = grid.highest(face, &faces.faces);
        let candidates = of_ink.entry(face.ink).or_default();
        let sheet = match candidates.get(candidates.partition_point(|sheet| *sheet < lowest)) {
            Some(sheet) => *sheet,
            None => {
                let sheet = sheets.len() as u32;
                candidates.push(sheet);
                sheets.push(PaperSheet::new(face.ink));
                sheet
            }
        };
        sheets[sheet as usize].faces.push(index);
        sheet_of[index as usize] = sheet;
        grid.lay(index, face, sheet);
    }
    for line in &faces.lines {
        // The later of two neighbours would cover half of the line, so the line belongs to the later sheet.
        let [one, other] = line.faces.map(|face| sheet_of[face as usize]);
        let sheet = &mut sheets[one.max(other) as usize];
        match line.kind {
            VisibleLineKind::Edge(width) if width >= pen * 3000.0 => sheet.lines.push(line.ends),
            VisibleLineKind::Edge(width) if width >= pen * 1000.0 => sheet.thin.push(line.ends),
            VisibleLineKind::Edge(_) => sheet.hairs.push(line.ends),
            VisibleLineKind::Seam => sheet.seams.push(line.ends),
        }
    }
    Ok(sheets)
}

/// Grid of square cells on the paper, with the faces that have been placed in them.
struct PaperGrid {
    low: PaperPoint,
    /// Side length (mm) of a cell.
    cell: f64,
    columns: usize,
    cells: Vec<PaperCell>,
    /// Faces with their sheets, as linked lists that begin in the cells. The last number is the index of the next entry
    /// plus one.
    laid: Vec<(u32, u32, u32)>,
}

#[derive(Clone, Default)]
struct PaperCell {
    /// Index of the first face in the list plus one; 0 if the list is empty.
    first: u32,
    /// Number of faces in the list.
    count: u32,
    /// Highest sheet of a face that touches the cell.
    highest: u32,
}

impl PaperGrid {
    fn around(faces: &VisibleFaces) -> Option<Self> {
        let (low, high) = faces.bounds()?;
        let [width, height] = [0, 1].map(|axis| (high[axis] - low[axis]) as f64 + 1.0);
        let covered: f64 =
            faces.faces.iter().map(|face| (extent(face, 0) + 1.0) * (extent(face, 1) + 1.0)).sum();
        let cell = (covered / TOUCHES).sqrt().max(width.max(height) / 512.0);
        let columns = (width / cell) as usize + 1;
        let rows = (height / cell) as usize + 1;
        Some(Self { low, cell, columns, cells: vec![PaperCell::default(); columns * rows], laid: Vec::new() })
    }

    /// Returns the cells that the bounding box of `face` touches, as one range for each row.
    fn rows(&self, face: &VisibleFace) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let [left, right, bottom, top] =
            [(0, true), (0, false), (1, true), (1, false)].map(|(axis, least)| {
                let values = face.corners.map(|corner| corner[axis]);
                let value = if least { values.iter().min() } else { values.iter().max() };
                (value.map_or(0.0, |value| (value - self.low[axis]) as f64) / self.cell) as usize
            });
        let columns = self.columns;
        (bottom..=top).map(move |row| row * columns + left..row * columns + right + 1)
    }

    /// Returns the highest sheet that `face` must not be below.
    fn highest(&self, face: &VisibleFace, faces: &[VisibleFace]) -> u32 {
        let mut highest = 0;
        for cell in self.rows(face).flat_map(|row| &self.cells[row]) {
            if cell.highest <= highest {
                continue;
            }
            if cell.count >= CROWD {
                highest = cell.highest;
                continue;
            }
            let mut next = cell.first;
            while next > 0 {
                let (other, sheet, after) = self.laid[next as usize - 1];
                if sheet > highest && overlap(&face.corners, &faces[other as usize].corners) {
                    highest = sheet;
                }
                next = after;
            }
        }
        highest
    }

    fn lay(&mut self, index: u32, face: &VisibleFace, sheet: u32) {
        for row in self.rows(face) {
            for cell in &mut self.cells[row] {
                cell.highest = cell.highest.max(sheet);
                if cell.count < CROWD {
                    self.laid.push((index, sheet, cell.first));
                    cell.first = self.laid.len() as u32;
                    cell.count += 1;
                }
            }
        }
    }
}

/// Returns true if the interiors of two counter-clockwise triangles intersect.
fn overlap(one: &[PaperPoint; 3], other: &[PaperPoint; 3]) -> bool {
    let separates = |of: &[PaperPoint; 3], from: &[PaperPoint; 3]| {
        (0..3).any(|i| {
            let (a, b) = (of[i], of[(i + 1) % 3]);
            from.iter().all(|c| {
                let side = |to: PaperPoint| [i128::from(to[0] - a[0]), i128::from(to[1] - a[1])];
                let (ab, ac) = (side(b), side(*c));
                ab[0] * ac[1] <= ab[1] * ac[0]
            })
        })
    };
    !separates(one, other) && !separates(other, one)
}

/// Returns the size of `face` (mm) along an axis.
fn extent(face: &VisibleFace, axis: usize) -> f64 {
    let [a, b, c] = face.corners.map(|corner| corner[axis]);
    (a.max(b).max(c) - a.min(b).min(c)) as f64
}

#[cfg(test)]
mod tests {
    use super::super::super::{check::check, samples};
    use super::super::view::DrawingSide;
    use super::*;

    #[test]
    fn houses_of_one_colour_share_sheets_above_the_ground() {
        let scene = samples::town(6);
        let faces = VisibleFaces::collect(&check(&scene).unwrap(), DrawingSide::Plan);
        let sheets = stack(&faces, 0.01, &Stop::default()).unwrap();
        assert_eq!(sheets.iter().map(|sheet| sheet.faces.len()).sum::<usize>(), faces.faces.len());
        assert_eq!(sheets[0].faces.len(), 2, "the ground is the lowest");
        assert!(sheets.len() < 40, "{} sheets for 36 houses", sheets.len());
    }

    #[test]
    fn a_hill_needs_one_sheet_for_each_shade() {
        let faces = VisibleFaces::collect(&check(&samples::hill(60)).unwrap(), DrawingSide::Plan);
        let inks: std::collections::BTreeSet<_> = faces.faces.iter().map(|face| face.ink).collect();
        assert_eq!(stack(&faces, 0.01, &Stop::default()).unwrap().len(), inks.len());
    }

    #[test]
    fn triangles_that_share_a_side_or_a_corner_do_not_overlap() {
        let one = [[0, 0], [10, 0], [0, 10]];
        assert!(!overlap(&one, &[[10, 0], [10, 10], [0, 10]]));
        assert!(!overlap(&one, &[[10, 0], [20, 0], [20, 10]]));
        assert!(overlap(&one, &[[1, 1], [20, 0], [20, 20]]) && overlap(&one, &one));
    }

    #[test]
    fn what_is_in_front_comes_later() {
        let mut scene = samples::boxes(3);
        scene.materials.push(burgeon_scene::Material::default());
        scene.meshes.push(samples::cube("other", 1));
        scene.instances[1].mesh = 1;
        for (i, height) in [4.0, 0.0, 2.0].into_iter().enumerate() {
            scene.instances[i].transform = glam::DAffine3::from_translation(glam::DVec3::Z * height);
        }
        let sheets =
            stack(&VisibleFaces::collect(&check(&scene).unwrap(), DrawingSide::Plan), 0.01, &Stop::default())
                .unwrap();
        let materials: Vec<_> = sheets.iter().map(|sheet| (sheet.ink / 24, sheet.faces.len())).collect();
        assert_eq!(materials, [(1, 2), (0, 4)]);
    }
}
