//! Straight skeletons of polygons.

use std::cell::Cell;

use glam::{DVec2, I64Vec2};

use super::edge;
use super::faces::FaceLists;
use super::meeting::MeetingLists;
use super::wavefront::Wavefront;
use crate::planar::Polygon;
use burgeon_base::error::Result;

/// A place where faces meet: on the plan (m), and when the wavefront reached it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The place (m).
    pub at: DVec2,
    /// How far an edge of speed 1 had moved (m).
    pub time: f64,
}

/// How an edge moves inwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// How far it moves while an edge of speed 1 moves 1 m.
    pub speed: f64,
    /// How long it stands still at first: how far (m) an edge of speed 1 moves meanwhile.
    pub rest: f64,
}

impl Default for Pace {
    /// It moves from the beginning, at speed 1.
    fn default() -> Self {
        Self { speed: 1.0, rest: 0.0 }
    }
}

impl Pace {
    /// It stands still for ever, as under a gable; its face has no area on the plan.
    pub const STILL: Self = Self { speed: 0.0, rest: 0.0 };

    /// How far (m) it has moved at `time`.
    pub fn way(&self, time: f64) -> f64 {
        self.speed * (time - self.rest).max(0.0)
    }

    /// Whether it moves from the beginning.
    pub fn moves(&self) -> bool {
        self.speed > 0.0 && self.rest <= 0.0
    }

    /// Whether it moves at `time`.
    pub fn moves_at(&self, time: f64) -> bool {
        self.speed > 0.0 && self.rest <= time
    }
}

/// The faces over a polygon, one for each edge, in the order of the edges.
#[derive(Debug, Clone, Default)]
pub struct Skeleton {
    /// The corners of all faces; first those of the polygon, in their order.
    pub peaks: Vec<Peak>,
    /// Indices into `peaks`, counter-clockwise; each begins with the edge itself.
    pub faces: Vec<Vec<usize>>,
    /// How the edges have moved: as they were to, but for those that had to begin as nothing else would have swept an
    /// area between them.
    pub paces: Vec<Pace>,
}

impl Skeleton {
    /// The weighted straight skeleton of a polygon whose rings neither cross nor touch; `paces` says of each edge of all
    /// rings how it moves.
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
    /// The result scales with the polygon: scaled by a power of two, it has the same skeleton to the last bit, of any
    /// extent from 1e-90 to 1e90 m.
    ///
    /// Method: wavefront propagation (O. Aichholzer and F. Aurenhammer, "Straight skeletons for general
    /// polygonal figures in the plane", 1996) of the polygon on a lattice of 2^-42 of its extent. All decisions are exact: its
    /// edges lie on lines of whole numbers, of which only the speed is rounded, alike for parallel ones, so that times
    /// and places are fractions. Rounded numbers with a bound on their error tell most of them apart, the fractions
    /// the rest. Ties: what happens at exactly one time and place is resolved at once, the edges that meet there are
    /// sorted around it and paired anew, whatever the kind of the events; at other places of that time it changes
    /// nothing. Between edges in one line that move alike the border runs straight on from where they met; at
    /// different speeds the faster one sweeps what the slower one has left. Around an area where all edges stand still
    /// for ever, these begin to move once nothing else does.
    ///
    /// Afterwards borders and spikes of less than 2e-6 of the extent are closed where the faces stay a map of the plane.
    /// Fails if the result does not pass the checks: one closed face for each edge, every corner in the plane of its faces, no
    /// negative area, areas that add up to the polygon's (to 1e-6), faces that are monotone along their edges, or do
    /// not cross themselves where paces differ.
    pub fn new(polygon: &Polygon, paces: &[Pace]) -> Result<Self> {
        Self::scaled(polygon, paces, edge::scale_of(polygon)?)
    }

    /// The same for a mesh in metres, whatever the extent: borders and spikes of less than 1 mm are closed, on a lattice
    /// of 2^-32 m.
    pub fn for_mesh(polygon: &Polygon, paces: &[Pace]) -> Result<Self> {
        Self::scaled(polygon, paces, 1.0)
    }

    /// The skeleton of a polygon that is scaled by a power of two meanwhile.
    fn scaled(polygon: &Polygon, paces: &[Pace], scale: f64) -> Result<Self> {
        let mut spare = SPARE.take().unwrap_or_default();
        let skeleton = spare.skeleton(polygon, paces, scale);
        SPARE.set(Some(spare));
        skeleton
    }

    /// The greatest time: the height of the highest ridge at a slope of 1.
    pub fn duration(&self) -> f64 {
        self.peaks.iter().map(|peak| peak.time).fold(0.0, f64::max)
    }
}

thread_local! {
    /// What the last skeleton of the thread was made with.
    static SPARE: Cell<Option<Box<SkeletonMaker>>> = const { Cell::new(None) };
}

/// What a skeleton is made with, whose memory the next one uses again: a city has tens of thousands.
#[derive(Default)]
struct SkeletonMaker {
    /// The polygon on the lattice.
    rings: Vec<Vec<I64Vec2>>,
    /// How the edges of the scaled polygon move.
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
