//! Shapes joined to one, and coplanar faces joined to larger ones.

use burgeon_base::Stop;
use burgeon_base::error::Result;
use glam::{DMat3, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::mesh::{EdgeSums, FaceSets, PolygonFace, PolygonMesh, trace_loops};
use crate::{Scope, Shape};

/// Distance (m) within which points are equal.
pub(crate) const SAME_POINT: f64 = 1e-6;
/// Largest sine of the angle between the normals of coplanar faces.
const SAME_NORMAL: f64 = 1e-6;
/// Number of faces between two checks for cancellation.
const STRETCH: usize = 4096;

impl Shape {
    /// Returns one shape with the faces of all `parts`, in their order, and the axes of the first; `None` without parts.
    ///
    /// Points within 1 µm are joined.
    pub fn join(parts: &[&Self]) -> Result<Option<Self>> {
        let joined = Self::all_faces(parts)?;
        Ok(joined.map(|(mesh, axes)| Self::of_mesh(weld(&mesh, SAME_POINT), axes)))
    }

    /// Returns one shape with the faces of all `parts`, as [`join`](Self::join) does, for parts that do not touch: no points are joined.
    pub(crate) fn join_separate(parts: &[&Self]) -> Result<Option<Self>> {
        Ok(Self::all_faces(parts)?.map(|(mesh, axes)| Self::of_mesh(mesh, axes)))
    }

    /// Returns the faces of all `parts` in their order, and the axes of the first; `None` without parts.
    fn all_faces(parts: &[&Self]) -> Result<Option<(PolygonMesh, DMat3)>> {
        let Some(first) = parts.first() else { return Ok(None) };
        let mut mesh = PolygonMesh::default();
        for part in parts {
            Stop::check_current()?;
            let own = part.mesh();
            let base = u32::try_from(mesh.points.len()).unwrap_or(u32::MAX);
            burgeon_base::MemoryOwner::ensure_room(own.memory())?;
            mesh.points.extend_from_slice(&own.points);
            mesh.faces.extend(own.faces.iter().cloned().map(|mut face| {
                face.rings.iter_mut().flatten().for_each(|point| *point += base);
                face
            }));
        }
        Ok(Some((mesh, first.scope().axes)))
    }

    /// Returns the shape with coplanar neighbouring faces of the same style joined, points on edges inserted there, and
    /// pairs of opposite equal faces removed. So the parts of a split become the whole again.
    pub fn recompose(&self) -> Result<Self> {
        if let crate::ShapeBody::Edge(..) = self.body {
            return Ok(self.clone());
        }
        let mut mesh = weld(&self.mesh(), SAME_POINT);
        insert_points_on_edges(&mut mesh)?;
        remove_opposite_faces(&mut mesh);
        Ok(Self::of_mesh(merge_coplanar(&mesh)?, self.scope().axes))
    }
}

/// Joins points within a distance (m), and drops faces without area.
pub(crate) fn weld(mesh: &PolygonMesh, near: f64) -> PolygonMesh {
    let cell = |at: DVec3| (at / (2.0 * near)).floor();
    let key = |cell: DVec3| cell.to_array().map(|number| (number + 0.0).to_bits());
    let mut cells: FxHashMap<[u64; 3], Vec<u32>> = FxHashMap::default();
    let mut points: Vec<DVec3> = Vec::new();
    let mut numbers = Vec::with_capacity(mesh.points.len());
    for &at in &mesh.points {
        let own = cell(at);
        // A cell is two tolerances wide, so that only neighbours on the nearer sides can hold an equal point.
        let nearer = (at / (2.0 * near) - own - 0.5).signum();
        let known = (0..8).find_map(|corner| {
            let step = DVec3::new(f64::from(corner & 1), f64::from(corner >> 1 & 1), f64::from(corner >> 2));
            let others = cells.get(&key(own + step * nearer))?;
            others.iter().copied().find(|other| points[*other as usize].distance(at) <= near)
        });
        numbers.push(known.unwrap_or_else(|| {
            points.push(at);
            let number = u32::try_from(points.len() - 1).unwrap_or(u32::MAX);
            cells.entry(key(own)).or_default().push(number);
            number
        }));
    }
    let mut faces = mesh.faces.clone();
    faces.retain_mut(|face| {
        for ring in &mut face.rings {
            ring.iter_mut().for_each(|point| *point = numbers[*point as usize]);
            ring.dedup();
            while ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
        }
        let is_face = face.rings.first().is_some_and(|ring| ring.len() > 2);
        face.rings.retain(|ring| ring.len() > 2);
        is_face
    });
    PolygonMesh::new(points, faces)
}

/// Inserts points that lie on edges of other faces into these edges.
fn insert_points_on_edges(mesh: &mut PolygonMesh) -> Result<()> {
    // Only ends of unmatched edges can lie within edges.
    let open: Vec<[u32; 2]> = mesh.open_edges().collect();
    let mut ends: Vec<u32> = open.iter().flatten().copied().collect();
    ends.sort_by(|a, b| mesh.at(*a).x.total_cmp(&mesh.at(*b).x).then(a.cmp(b)));
    ends.dedup();
    let open: FxHashSet<[u32; 2]> =
        open.into_iter().flat_map(|[from, to]| [[from, to], [to, from]]).collect();
    let points = &mesh.points;
    for (number, face) in mesh.faces.iter_mut().enumerate() {
        if number.is_multiple_of(256) {
            Stop::check_current()?;
        }
        for ring in &mut face.rings {
            let mut longer: Vec<u32> = Vec::with_capacity(ring.len());
            for index in 0..ring.len() {
                let (from, to) = (ring[index], ring[(index + 1) % ring.len()]);
                longer.push(from);
                if !open.contains(&[from, to]) {
                    continue;
                }
                let [a, b] = [from, to].map(|point| points[point as usize]);
                let first = ends.partition_point(|end| points[*end as usize].x < a.x.min(b.x) - SAME_POINT);
                let near = ends[first..]
                    .iter()
                    .take_while(|end| points[**end as usize].x <= a.x.max(b.x) + SAME_POINT);
                let length = a.distance(b);
                let along = (b - a) / length;
                let mut inside: Vec<(f64, u32)> = near
                    .filter_map(|&end| {
                        let offset = points[end as usize] - a;
                        let way = offset.dot(along);
                        let is_on = way > SAME_POINT
                            && way < length - SAME_POINT
                            && (offset - along * way).length() <= SAME_POINT;
                        is_on.then_some((way, end))
                    })
                    .collect();
                inside.sort_by(|a, b| a.0.total_cmp(&b.0));
                longer.extend(inside.into_iter().map(|(_, end)| end));
            }
            *ring = longer;
        }
    }
    *mesh = PolygonMesh::new(std::mem::take(&mut mesh.points), std::mem::take(&mut mesh.faces));
    Ok(())
}

/// Removes pairs of faces with the same outline and opposite directions, between which there is nothing.
pub(crate) fn remove_opposite_faces(mesh: &mut PolygonMesh) {
    // The same outline from its smallest point on, and in which direction it runs there.
    let outline = |face: &PolygonFace, reversed: bool| -> Vec<u32> {
        let mut ring: Vec<u32> = face.rings[0].clone();
        if reversed {
            ring.reverse();
        }
        let least = (0..ring.len()).min_by_key(|&index| ring[index]).unwrap_or(0);
        ring.rotate_left(least);
        ring
    };
    let mut known: FxHashMap<Vec<u32>, Vec<usize>> = FxHashMap::default();
    let mut rest: Vec<bool> = vec![true; mesh.faces.len()];
    for (number, face) in mesh.faces.iter().enumerate().filter(|(_, face)| face.rings.len() == 1) {
        if let Some(other) = known.get_mut(&outline(face, true)).and_then(Vec::pop) {
            rest[other] = false;
            rest[number] = false;
        } else {
            known.entry(outline(face, false)).or_default().push(number);
        }
    }
    if rest.contains(&false) {
        *mesh = mesh.select((0..rest.len()).filter(|number| rest[*number]));
    }
}

/// Joins coplanar faces with a common edge and the same style. Fails if the work of this thread is cancelled.
pub(crate) fn merge_coplanar(mesh: &PolygonMesh) -> Result<PolygonMesh> {
    merge(mesh, false)
}

/// Joins faces like [`merge_coplanar`], except those that would be too narrow to be filled with triangles.
pub(crate) fn merge_fillable(mesh: &PolygonMesh) -> Result<PolygonMesh> {
    merge(mesh, true)
}

/// Joins coplanar faces, all of them or those that can be filled with triangles afterwards (`fillable`).
fn merge(mesh: &PolygonMesh, fillable: bool) -> Result<PolygonMesh> {
    let normals: Vec<DVec3> = mesh.faces.iter().map(|face| mesh.normal(face)).collect();
    let mut sides: FxHashMap<[u32; 2], usize> = FxHashMap::default();
    let mut doubled: FxHashSet<[u32; 2]> = FxHashSet::default();
    for (number, face) in mesh.faces.iter().enumerate() {
        if number.is_multiple_of(STRETCH) {
            Stop::check_current()?;
        }
        for edge in face.edges() {
            if sides.insert(edge, number).is_some() {
                doubled.insert(edge);
            }
        }
    }
    let mut sets = FaceSets::new(mesh.faces.len());
    for (number, face) in mesh.faces.iter().enumerate() {
        if number.is_multiple_of(STRETCH) {
            Stop::check_current()?;
        }
        for [from, to] in face.edges() {
            let Some(&other) = sides.get(&[to, from]) else { continue };
            let same = normals[number].cross(normals[other]).length() <= SAME_NORMAL
                && normals[number].dot(normals[other]) > 0.0
                && face.style == mesh.faces[other].style
                && !doubled.contains(&[from, to])
                && !doubled.contains(&[to, from]);
            if same {
                sets.join(number, other);
            }
        }
    }
    let mut faces = Vec::new();
    for (number, group) in sets.groups().iter().enumerate() {
        if number.is_multiple_of(STRETCH) || group.len() > STRETCH {
            Stop::check_current()?;
        }
        if let [only] = group.as_slice() {
            faces.push(mesh.faces[*only].clone());
            continue;
        }
        let first = &mesh.faces[group[0]];
        let turn = Scope::face_axes(normals[group[0]], DMat3::IDENTITY).transpose();
        let mut rim = EdgeSums::default();
        group.iter().flat_map(|face| mesh.faces[*face].edges()).for_each(|edge| rim.add(edge));
        let edges: Vec<[u32; 2]> = rim.rest().collect();
        match trace_loops(&edges, |point| (turn * mesh.at(point)).truncate()) {
            // A ring without area would be missing.
            Some(loops) if loops.iter().flatten().map(Vec::len).sum::<usize>() == edges.len() => {
                let joined = faces.len();
                faces
                    .extend(loops.into_iter().map(|rings| PolygonFace { rings, style: first.style.clone() }));
                if fillable && !faces[joined..].iter().all(|face| mesh.is_face_fillable(face)) {
                    faces.truncate(joined);
                    faces.extend(group.iter().map(|face| mesh.faces[*face].clone()));
                }
            }
            _ => faces.extend(group.iter().map(|face| mesh.faces[*face].clone())),
        }
    }
    let mut merged = PolygonMesh::new(mesh.points.clone(), faces);
    let before = fillable.then(|| merged.faces.clone());
    remove_straight_points(&mut merged);
    if let Some(before) = before {
        let changed = merged.faces.iter().zip(&before).filter(|(face, before)| face.rings != before.rings);
        if !changed.into_iter().all(|(face, _)| merged.is_face_fillable(face)) {
            merged = PolygonMesh::new(mesh.points.clone(), before);
        }
    }
    let count = merged.faces.len();
    Ok(merged.select(0..count))
}

/// Removes points that lie on a straight line between their only two neighbours.
fn remove_straight_points(mesh: &mut PolygonMesh) {
    // Up to two different neighbours of each point, and whether there are more.
    let mut neighbors: Vec<([u32; 2], bool)> = vec![([u32::MAX; 2], false); mesh.points.len()];
    for [from, to] in mesh.faces.iter().flat_map(|face| face.edges()) {
        for (point, other) in [(from, to), (to, from)] {
            let (known, more) = &mut neighbors[point as usize];
            if known.contains(&other) {
                continue;
            }
            match known.iter_mut().find(|slot| **slot == u32::MAX) {
                Some(slot) => *slot = other,
                None => *more = true,
            }
        }
    }
    let points = &mesh.points;
    let is_straight = |point: u32| {
        let ([one, other], more) = neighbors[point as usize];
        if more || other == u32::MAX {
            return false;
        }
        let at = points[point as usize];
        let (back, forth) = (points[one as usize] - at, points[other as usize] - at);
        back.cross(forth).length() <= 1e-9 * back.length() * forth.length() && back.dot(forth) < 0.0
    };
    let straight: Vec<bool> =
        (0..mesh.points.len()).map(|point| u32::try_from(point).is_ok_and(is_straight)).collect();
    let mut removed = straight.clone();
    // A ring needs three points, and its neighbours have the same ones.
    for ring in mesh.faces.iter().flat_map(|face| &face.rings) {
        if ring.iter().filter(|point| !straight[**point as usize]).count() <= 2 {
            ring.iter().for_each(|point| removed[*point as usize] = false);
        }
    }
    for ring in mesh.faces.iter_mut().flat_map(|face| &mut face.rings) {
        ring.retain(|point| !removed[*point as usize]);
    }
}
