//! Solids cut by the planes between a face and its neighbours.

use std::sync::{Arc, OnceLock};

use burgeon_base::Stop;
use burgeon_base::error::Result;
use glam::DAffine3;

use crate::trim_planes::{TrimFace, TrimSource};
use crate::{Shape, ShapeBody, TrimPlane};

impl Shape {
    /// Returns the planes between this face and its neighbours in the solid that it was taken from, in the order of the
    /// edges of the whole face. Parts of the face have the same planes; other shapes have none.
    pub fn trim_planes(&self) -> Vec<TrimPlane> {
        self.trim.as_ref().map_or_else(Vec::new, |trim| trim.planes())
    }

    /// Returns true if both shapes have the same trim planes, or none.
    pub fn has_trim_of(&self, other: &Self) -> bool {
        match (&self.trim, &other.trim) {
            (None, None) => true,
            (Some(one), Some(two)) => one.is_same(two),
            _ => false,
        }
    }

    /// Returns the shape cut by planes between a face and its neighbours, and whether a solid could not be closed; `None` if
    /// nothing remains.
    ///
    /// A plane only cuts shapes beside its edge, so that the edges of a recess do not cut what lies elsewhere on the face.
    pub fn trim_by(&self, planes: &[TrimPlane]) -> Result<(Option<Self>, bool)> {
        let (mut rest, mut open) = (self.clone(), false);
        for trim in planes {
            Stop::check_current()?;
            if !rest.is_beside(trim) {
                continue;
            }
            let ([below, above], is_open) = rest.cut(&trim.plane)?;
            open |= is_open;
            if above.is_none() {
                continue;
            }
            match below {
                Some(below) => rest = Self { trim: self.trim.clone(), ..below },
                None => return Ok((None, open)),
            }
        }
        Ok((Some(rest), open))
    }

    /// Returns true if a part of the shape lies between the ends of an edge, along its direction.
    fn is_beside(&self, trim: &TrimPlane) -> bool {
        let [from, to] = trim.ends;
        let Some(along) = (to - from).try_normalize() else { return false };
        let mesh = self.mesh();
        let places = mesh.points.iter().map(|at| (*at - from).dot(along));
        let (low, high) =
            places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        low < from.distance(to) - 1e-6 && high > 1e-6
    }

    /// Returns the trim planes of a face with this number of this shape.
    pub(crate) fn trim_source(&self) -> Option<Arc<TrimSource>> {
        match &self.body {
            ShapeBody::Box(_) => Some(Arc::new(TrimSource::Box(self.scope.clone()))),
            ShapeBody::Recess(_) => Some(Arc::new(TrimSource::Recess(self.scope.clone()))),
            ShapeBody::Mesh(mesh) if mesh.faces.len() > 1 => {
                Some(Arc::new(TrimSource::Mesh(Arc::clone(mesh), OnceLock::new())))
            }
            _ => None,
        }
    }

    /// Returns the shape as a face with this number of another shape.
    #[allow(clippy::cast_possible_truncation, reason = "a mesh has fewer than 2^32 faces")]
    pub(crate) fn with_trim(self, source: Option<&Arc<TrimSource>>, face: usize) -> Self {
        let trim = source.map(|source| TrimFace { source: Arc::clone(source), face: face as u32 });
        Self { trim, ..self }
    }

    /// Returns the shape with the trim planes of another one.
    pub(crate) fn with_trim_of(self, other: &Self) -> Self {
        Self { trim: other.trim.clone(), ..self }
    }

    /// Returns the shape with the trim planes of another one that moved.
    pub(crate) fn with_trim_moved(self, other: &Self, frame: &DAffine3) -> Self {
        let trim = other.trim.as_ref().map(|trim| trim.transform(frame));
        Self { trim, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PartSize, PartSizes, Selector, SizedParts, SplitAxis};
    use glam::{DVec2, DVec3};

    fn select(solid: &Shape, name: &str) -> Vec<Shape> {
        solid.faces(&Selector::read(name).expect("a selector")).expect("faces")
    }

    /// Returns plates of 0.2 m on these faces, and the volume of their union if no two of them overlap.
    fn plates(faces: &[Shape], wants: impl Fn(&TrimPlane) -> bool) -> Vec<Shape> {
        let plate = |face: &Shape| {
            // Beyond the face on all sides, so that the planes cut it.
            let wide = face.offset(-0.5).expect("wider").remove(0).extrude(0.2, None).expect("a plate");
            let planes: Vec<TrimPlane> =
                face.trim_planes().into_iter().filter(|plane| wants(plane)).collect();
            let (part, open) = wide.trim_by(&planes).expect("cut");
            assert!(!open);
            part.expect("a part")
        };
        faces.iter().map(plate).collect()
    }

    #[test]
    fn plates_on_the_faces_of_a_box_meet_at_its_edges() {
        let faces = Shape::cuboid(DVec3::new(4.0, 3.0, 2.0)).faces(&Selector::All).expect("faces");
        assert!(faces.iter().all(|face| face.trim_planes().len() == 4));
        let parts = plates(&faces, |_| true);
        let volume: f64 = parts.iter().map(Shape::volume).sum();
        assert!((volume - (4.4 * 3.4 * 2.4 - 24.0)).abs() < 1e-9, "{volume}");
        assert!(parts.iter().all(Shape::is_closed));
        for (number, part) in parts.iter().enumerate() {
            assert!(parts[..number].iter().all(|other| !part.overlaps(other).expect("known")));
        }
    }

    #[test]
    fn tiles_of_a_hip_roof_end_at_the_hips() {
        let plan = Shape::rectangle(DVec2::new(8.0, 8.0)).taper(3.0, 0.0).expect("a pyramid");
        let slopes = select(&plan, "slanted");
        assert_eq!(slopes.len(), 4);
        // Hips rise by more than 40 degrees on the slope; the eave is level.
        let parts = plates(&slopes, |plane| plane.inclination > 40f64.to_radians());
        for (number, part) in parts.iter().enumerate() {
            assert!(part.is_closed());
            assert!(parts[..number].iter().all(|other| !part.overlaps(other).expect("known")));
        }
        let planes = slopes[0].trim_planes();
        assert_eq!(planes.iter().filter(|plane| plane.inclination < 0.1).count(), 1);
        assert_eq!(planes.len(), 3);
    }

    #[test]
    fn planes_survive_splits_and_movements() {
        let solid = Shape::cuboid(DVec3::new(4.0, 3.0, 2.0));
        let front = &select(&solid, "front")[0];
        let sizes = PartSizes(vec![SizedParts::Repeated(vec![PartSize::Flexible(1.0)])]);
        let parts = front.split(SplitAxis::X, &sizes).expect("parts").parts;
        assert!(parts.iter().all(|(_, part)| part.has_trim_of(front) && part.trim_planes().len() == 4));
        let turned = front.rotate(DVec3::ZERO, DVec3::Z, 0.7).translate(DVec3::new(5.0, 1.0, 0.0));
        let whole = solid.rotate(DVec3::ZERO, DVec3::Z, 0.7).translate(DVec3::new(5.0, 1.0, 0.0));
        let (one, two) = (turned.trim_planes(), select(&whole, "front")[0].trim_planes());
        for (one, two) in one.iter().zip(&two) {
            assert!((one.plane.normal - two.plane.normal).length() < 1e-12);
            assert!((one.plane.offset - two.plane.offset).abs() < 1e-12);
        }
        assert!(!turned.has_trim_of(front));
    }

    #[test]
    fn an_edge_of_a_recess_does_not_cut_below_it() {
        // An L in elevation: the inner upright edge is 2 m to 4 m high.
        let outline =
            [(0.0, 0.0), (6.0, 0.0), (6.0, 2.0), (3.0, 2.0), (3.0, 4.0), (0.0, 4.0)].map(DVec2::from);
        let wall =
            Shape::plan(&[outline.to_vec()], 0.0).expect("a plan").extrude(1.0, None).expect("a solid");
        let face = &select(&wall, "top")[0];
        let brick = Shape::cuboid(DVec3::new(2.0, 1.0, 0.2)).translate(DVec3::new(2.0, 0.5, 1.0));
        let (rest, _) = brick.trim_by(&face.trim_planes()).expect("cut");
        assert!((rest.expect("a part").volume() - brick.volume()).abs() < 1e-9);
    }
}
