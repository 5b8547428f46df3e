//! Triangles of a drawing, projected to the paper.

use super::super::check::{SceneCheck, shown_parts, triangles};
use super::super::color::{fraction, srgb};
use super::super::texture::{ImageFile, Images};
use super::view::DrawingSide;
use burgeon_base::error::Result;
use burgeon_scene::{Instance, Material, Mesh};
use glam::{DVec3, Vec3};
use rustc_hash::FxHashMap;

/// Number of shades per material.
const SHADES: u32 = 24;

/// Direction towards the light. It comes from above the upper left corner of the paper, as on maps.
const LIGHT: DVec3 = DVec3::new(-0.42, 0.54, 0.73);

/// Cosine of the minimum angle of a bend that is drawn as a line: 25 degrees.
const BEND: f64 = 0.906;

/// Point on the paper (mm), y up.
pub(super) type PaperPoint = [i64; 2];

/// Material in one of its shades.
pub(super) type Ink = u32;

/// Triangle that faces the viewer.
pub(super) struct VisibleFace {
    /// Corners, counter-clockwise.
    pub(super) corners: [PaperPoint; 3],
    /// Depth (m) of the farthest corner, positive towards the viewer.
    pub(super) depth: f64,
    /// Material and shade.
    pub(super) ink: Ink,
    normal: DVec3,
}

/// Side of a face: the numbers of its end points, the lower one first, the face, and the end points.
type PaperSide = (u32, u32, u32, [PaperPoint; 2]);

/// Visible line: a side of a face at an edge or a seam.
pub(super) struct VisibleLine {
    /// End points.
    pub(super) ends: [PaperPoint; 2],
    /// Faces on both sides; the same face twice if there is only one.
    pub(super) faces: [u32; 2],
    /// Type of the line.
    pub(super) kind: VisibleLineKind,
}

/// Type of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum VisibleLineKind {
    /// Boundary, bend or change of material of a shape. The number is the mean width (mm) of the shape's area in that
    /// material, or the smaller of two widths. It serves to avoid dark lines that would hide a thin shape.
    Edge(f64),
    /// Change of shade on a smooth surface.
    Seam,
}

/// Visible triangles and lines of a drawing.
#[derive(Default)]
pub(super) struct VisibleFaces {
    /// Triangles, in the order of the scene.
    pub(super) faces: Vec<VisibleFace>,
    /// Lines between and around the triangles.
    pub(super) lines: Vec<VisibleLine>,
}

impl VisibleFaces {
    /// Collects all triangles whose front `view` sees, and the lines between them.
    pub(super) fn collect(checked: &SceneCheck<'_>, view: DrawingSide) -> Self {
        let mut all = Self::default();
        let mut welded: FxHashMap<usize, Vec<Vec<u32>>> = FxHashMap::default();
        for instance in checked.scene.instances.iter().filter(|instance| checked.meshes[instance.mesh]) {
            let mesh = &checked.scene.meshes[instance.mesh];
            let corners = welded.entry(instance.mesh).or_insert_with(|| weld(mesh));
            all.add(checked, instance, mesh, corners, view);
        }
        all
    }

    /// Returns the minimum and maximum coordinates (mm); `None` if there are no faces.
    pub(super) fn bounds(&self) -> Option<(PaperPoint, PaperPoint)> {
        let mut points = self.faces.iter().flat_map(|face| &face.corners);
        let first = *points.next()?;
        Some(points.fold((first, first), |(low, high), at| {
            ([low[0].min(at[0]), low[1].min(at[1])], [high[0].max(at[0]), high[1].max(at[1])])
        }))
    }

    fn add(
        &mut self,
        checked: &SceneCheck<'_>,
        instance: &Instance,
        mesh: &Mesh,
        welded: &[Vec<u32>],
        view: DrawingSide,
    ) {
        let matrix = view.matrix();
        let mirrored = instance.transform.matrix3.determinant() < 0.0;
        let mut edges: Vec<PaperSide> = Vec::new();
        // Points that coincide on the paper, where a triangle between them has degenerated.
        let mut merged: FxHashMap<u32, u32> = FxHashMap::default();
        let first_face = self.faces.len();
        for (part, welded) in shown_parts(mesh).zip(welded) {
            let double_sided = checked.scene.materials[part.material].double_sided;
            for mut corners in triangles(part) {
                if mirrored {
                    corners.swap(1, 2);
                }
                let place = |corner: u32| {
                    let at = instance.transform.transform_point3(part.positions[corner as usize].as_dvec3());
                    matrix * (at - checked.origin)
                };
                let mut points = corners.map(place);
                let mut normal = (points[1] - points[0]).cross(points[2] - points[0]).normalize_or_zero();
                if normal.z < 0.0 && double_sided {
                    corners.swap(1, 2);
                    points.swap(1, 2);
                    normal = -normal;
                }
                let flat = points.map(|at| [(at.x * 1000.0).round() as i64, (at.y * 1000.0).round() as i64]);
                for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                    let (a, b) = (welded[corners[i] as usize], welded[corners[j] as usize]);
                    if a != b && flat[i] == flat[j] && (points[i].z - points[j].z).abs() < 1e-3 {
                        let (a, b) = (last(&merged, a), last(&merged, b));
                        if a != b {
                            merged.insert(a.max(b), a.min(b));
                        }
                    }
                }
                if normal.z <= 0.0 || !is_counter_clockwise(flat) {
                    continue;
                }
                let shade =
                    (normal.dot(LIGHT).max(0.0) * f64::from(SHADES - 1)).round().min(f64::from(SHADES - 1));
                let ink = part.material as u32 * SHADES + shade as u32;
                let depth = points[0].z.min(points[1].z).min(points[2].z);
                let face = self.faces.len() as u32;
                self.faces.push(VisibleFace { corners: flat, depth, ink, normal });
                for i in 0..3 {
                    let j = (i + 1) % 3;
                    let (a, b) = (welded[corners[i] as usize], welded[corners[j] as usize]);
                    edges.push((a.min(b), a.max(b), face, [flat[i], flat[j]]));
                }
            }
        }
        if !merged.is_empty() {
            for edge in &mut edges {
                let (a, b) = (last(&merged, edge.0), last(&merged, edge.1));
                (edge.0, edge.1) = (a.min(b), a.max(b));
            }
        }
        edges.sort_unstable();
        self.add_lines(&edges, first_face);
    }

    /// Adds the lines between the faces from `first_face` on; `edges` are sorted.
    fn add_lines(&mut self, edges: &[PaperSide], first_face: usize) {
        // Area of each material, and the length of the lines around it.
        let mut sizes: FxHashMap<u32, (f64, f64)> = FxHashMap::default();
        for face in &self.faces[first_face..] {
            let [a, b, c] = face.corners.map(|at| DVec3::new(at[0] as f64, at[1] as f64, 0.0));
            sizes.entry(face.ink / SHADES).or_default().0 += (b - a).cross(c - a).z / 2.0;
        }
        let first_line = self.lines.len();
        for side in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let (first, last) = (&side[0], &side[side.len() - 1]);
            let faces = [first.2, last.2];
            let [one, other] = faces.map(|face| &self.faces[face as usize]);
            let ends = first.3;
            if ends[0] == ends[1] {
                continue;
            }
            let same = one.ink / SHADES == other.ink / SHADES;
            if side.len() != 2 || !same || one.normal.dot(other.normal) < BEND {
                let [from, to] = ends;
                let length = ((to[0] - from[0]) as f64).hypot((to[1] - from[1]) as f64);
                for material in [Some(one.ink / SHADES), (!same).then_some(other.ink / SHADES)] {
                    if let Some((_, around)) = material.and_then(|material| sizes.get_mut(&material)) {
                        *around += length;
                    }
                }
                self.lines.push(VisibleLine { ends, faces, kind: VisibleLineKind::Edge(0.0) });
            } else if one.ink != other.ink {
                self.lines.push(VisibleLine { ends, faces, kind: VisibleLineKind::Seam });
            }
        }
        for line in &mut self.lines[first_line..] {
            if let VisibleLineKind::Edge(width) = &mut line.kind {
                let of = line.faces.map(|face| self.faces[face as usize].ink / SHADES);
                let widths = of.map(|material| sizes[&material]).map(|(area, around)| 2.0 * area / around);
                *width = widths[0].min(widths[1]);
            }
        }
    }
}

/// Returns the number of each point, for each shown part. Points at the same position have the same number.
fn weld(mesh: &Mesh) -> Vec<Vec<u32>> {
    let mut known: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    let mut number = |at: &Vec3| {
        let next = known.len() as u32;
        // Adding zero turns -0 into 0.
        *known.entry((*at + 0.0).to_array().map(f32::to_bits)).or_insert(next)
    };
    shown_parts(mesh).map(|part| part.positions.iter().map(&mut number).collect()).collect()
}

/// Returns the final point that a point was merged with.
fn last(merged: &FxHashMap<u32, u32>, mut point: u32) -> u32 {
    while let Some(next) = merged.get(&point) {
        point = *next;
    }
    point
}

/// Returns true if the corners turn left, and the area is not zero.
fn is_counter_clockwise([a, b, c]: [PaperPoint; 3]) -> bool {
    let side = |from: PaperPoint, to: PaperPoint| [i128::from(to[0] - from[0]), i128::from(to[1] - from[1])];
    let (ab, ac) = (side(a, b), side(a, c));
    ab[0] * ac[1] > ab[1] * ac[0]
}

/// Colours of a drawing.
pub(super) struct Palette(Vec<([f32; 3], f32)>);

impl Palette {
    /// Computes the colour of each material, including the mean of its image. Fails as [`ImageFile::mean_color`] does.
    pub(super) fn new(materials: &[Material], images: &Images) -> Result<Self> {
        let means: Vec<_> = images.files.iter().map(ImageFile::mean_color).collect::<Result<_>>()?;
        let color = |(material, image): (&Material, &Option<usize>)| {
            let mean = image.map_or([1.0; 3], |image| means[image]);
            let light =
                |i: usize| srgb(material.base_color[i].max(0.0) * mean[i] + material.emissive[i].max(0.0));
            ([light(0), light(1), light(2)], fraction(material.base_color[3]))
        };
        Ok(Self(materials.iter().zip(&images.of_material).map(color).collect()))
    }

    /// Returns the colour of `ink` and its opacity.
    pub(super) fn fill(&self, ink: Ink) -> (String, f64) {
        let (color, opacity) = self.0[(ink / SHADES) as usize];
        // A surface parallel to the paper has its own colour; one that faces the light more is slightly lighter.
        let flat = LIGHT.z as f32;
        let shade = (ink % SHADES) as f32 / (SHADES - 1) as f32 - flat;
        let brightness = 1.0 + shade * if shade > 0.0 { 0.5 } else { 0.62 };
        (hex(color.map(|it| it * brightness)), f64::from(opacity))
    }

    /// Returns the colour of lines on `ink`: the material's colour times `brightness`.
    pub(super) fn tone(&self, ink: Ink, brightness: f32) -> String {
        let (color, _) = self.0[(ink / SHADES) as usize];
        hex(color.map(|it| it * brightness))
    }
}

fn hex(color: [f32; 3]) -> String {
    let [r, g, b] = color.map(|it| (fraction(it) * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::super::super::{check::check, samples};
    use super::*;

    #[test]
    fn a_box_shows_its_top_with_four_lines() {
        let scene = samples::boxes(1);
        let faces = VisibleFaces::collect(&check(&scene).unwrap(), DrawingSide::Plan);
        assert_eq!((faces.faces.len(), faces.lines.len()), (2, 4));
        assert_eq!(faces.bounds(), Some(([-500, -500], [500, 500])));
    }

    #[test]
    fn a_triangle_that_vanishes_on_paper_leaves_no_line() {
        let mut scene = samples::boxes(1);
        // A fan of three triangles around the origin. The middle one is thinner than the resolution of the paper.
        let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [9.9999, 10.0], [0.0, 10.0]];
        let part = &mut scene.meshes[0].parts[0];
        part.positions = corners.iter().map(|[x, y]| Vec3::new(*x, *y, 0.0)).collect();
        part.normals = vec![burgeon_scene::Normal::from(DVec3::Z); corners.len()];
        part.uvs = vec![glam::Vec2::ZERO; corners.len()];
        part.triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 4]].into_iter().collect();
        let faces = VisibleFaces::collect(&check(&scene).unwrap(), DrawingSide::Plan);
        assert_eq!((faces.faces.len(), faces.lines.len()), (2, 4));
    }

    #[test]
    fn a_smooth_hill_has_lines_at_its_border_alone() {
        let scene = samples::hill(40);
        let faces = VisibleFaces::collect(&check(&scene).unwrap(), DrawingSide::Plan);
        let edges = faces.lines.iter().filter(|line| line.kind != VisibleLineKind::Seam).count();
        assert_eq!((faces.faces.len(), edges), (3200, 160));
        assert!(faces.lines.len() > 200);
    }

    #[test]
    fn a_mirrored_box_shows_its_top_too_and_a_leaf_both_its_sides() {
        let mut scene = samples::boxes(1);
        scene.instances[0].transform.matrix3.x_axis.x = -1.0;
        assert_eq!(VisibleFaces::collect(&check(&scene).unwrap(), DrawingSide::Plan).faces.len(), 2);
        scene.materials[0].double_sided = true;
        assert_eq!(VisibleFaces::collect(&check(&scene).unwrap(), DrawingSide::Plan).faces.len(), 4);
    }
}
