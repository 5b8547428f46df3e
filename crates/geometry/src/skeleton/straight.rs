//! Computation of straight skeletons.

use std::cell::Cell;

use glam::I64Vec2;

use super::edge;
use super::faces::FaceLists;
use super::meeting::MeetingLists;
use super::skeleton::{Pace, Skeleton};
use super::wavefront::Wavefront;
use crate::planar::Polygon;
use burgeon_base::error::Result;

impl Skeleton {
    /// Computes the weighted straight skeleton of a polygon whose rings neither cross nor touch; `paces`
    /// defines the motion of each edge of all rings.
    ///
    /// ```
    /// use burgeon_geometry::skeleton::{Pace, Skeleton};
    /// use burgeon_geometry::{Polygon, Rings};
    /// use glam::DVec2;
    ///
    /// let plan = [(0.0, 0.0), (12.0, 0.0), (12.0, 8.0), (0.0, 8.0)].map(DVec2::from);
    /// let plan = Polygon::new(Rings(vec![plan.to_vec()]))?;
    /// let hip = Skeleton::new(&plan, &[Pace::default(); 4])?;
    /// // After its four corners those of the ridge, half the width of the house above its eaves.
    /// assert_eq!((hip.peaks.len(), hip.duration()), (6, 4.0));
    /// assert_eq!(hip.faces.iter().map(Vec::len).collect::<Vec<_>>(), [4, 3, 4, 3]);
    ///
    /// // Where the short edges stand still, the ridge goes from gable to gable.
    /// let gables = [Pace::default(), Pace::STILL, Pace::default(), Pace::STILL];
    /// let gabled = Skeleton::new(&plan, &gables)?;
    /// let mut ridge: Vec<f64> = gabled.peaks[4..].iter().map(|peak| peak.at.x).collect();
    /// ridge.sort_by(f64::total_cmp);
    /// assert_eq!(ridge, [0.0, 12.0]);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    ///
    /// The result scales with the polygon: a polygon scaled by a power of two has the same skeleton to the
    /// last bit, for extents from 1e-90 to 1e90 m.
    ///
    /// Method: wavefront propagation (O. Aichholzer and F. Aurenhammer, "Straight skeletons for general
    /// polygonal figures in the plane", 1996) of the polygon on a lattice of 2^-42 of its extent. All
    /// decisions are exact: the edges lie on lines with integer coefficients, of which only the speed is
    /// rounded, equally for parallel edges, so that times and positions are fractions. Floating-point numbers
    /// with an error bound decide most comparisons, the fractions decide the others. Ties: all events at
    /// exactly one time and position are resolved together; the edges that meet there are sorted around the
    /// point and paired again, regardless of the type of the events. Events at other positions at that time
    /// are independent. Between collinear edges with the same motion, the border runs straight on from the
    /// point where they met; at different speeds, the faster edge sweeps the area behind the slower edge. If
    /// all edges around an area never move, they start to move once no other edge does.
    ///
    /// Afterwards, borders and spikes of less than 2e-6 of the extent are closed if the faces remain a planar
    /// map. Fails if the result does not pass the checks: one closed face for each edge, every corner in the
    /// plane of its faces, no negative area, areas that add up to the area of the polygon (to 1e-6), and
    /// faces that are monotone along their edges, or do not cross themselves if paces differ.
    pub fn new(polygon: &Polygon, paces: &[Pace]) -> Result<Self> {
        Self::scaled(polygon, paces, edge::scale_of(polygon)?)
    }

    /// Computes the skeleton for a mesh in metres, regardless of the extent: borders and spikes of less than
    /// 1 mm are closed, on a lattice of 2^-32 m.
    pub fn for_mesh(polygon: &Polygon, paces: &[Pace]) -> Result<Self> {
        Self::scaled(polygon, paces, 1.0)
    }

    /// Computes the skeleton of a polygon that is temporarily scaled by a power of two.
    fn scaled(polygon: &Polygon, paces: &[Pace], scale: f64) -> Result<Self> {
        let mut spare = SPARE.take().unwrap_or_default();
        let skeleton = spare.skeleton(polygon, paces, scale);
        SPARE.set(Some(spare));
        skeleton
    }
}

thread_local! {
    /// Memory of the thread's last skeleton.
    static SPARE: Cell<Option<Box<SkeletonMaker>>> = const { Cell::new(None) };
}

/// Working memory of a skeleton, reused by the next one: a city has tens of thousands.
#[derive(Default)]
struct SkeletonMaker {
    /// Polygon on the lattice.
    rings: Vec<Vec<I64Vec2>>,
    /// Motion of the edges of the scaled polygon.
    paces: Vec<Pace>,
    front: Wavefront,
    meetings: MeetingLists,
    faces: FaceLists,
}

impl SkeletonMaker {
    fn skeleton(&mut self, polygon: &Polygon, paces: &[Pace], scale: f64) -> Result<Skeleton> {
        let middle = edge::snap(polygon, scale, &mut self.rings)?;
        self.paces.clear();
        self.paces.extend(paces.iter().map(|pace| Pace { rest: pace.rest * scale, ..*pace }));
        self.front.propagate(&self.rings, &self.paces, &mut self.meetings)?;
        let mut skeleton = self.faces.assemble(&self.rings, &mut self.front.traced)?;
        for peak in &mut skeleton.peaks {
            peak.at = peak.at / scale + middle;
            peak.time /= scale;
        }
        for pace in &mut skeleton.paces {
            pace.rest /= scale;
        }
        for (peak, at) in skeleton.peaks.iter_mut().zip(polygon.points()) {
            peak.at = at;
        }
        Ok(skeleton)
    }
}
