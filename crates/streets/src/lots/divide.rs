//! Division of a block, and the resulting lots.

use glam::DVec2;

use super::block::StreetBlock;
use super::measure::{FrontRun, extent};
use super::options::{LotOptions, LotPattern};
use super::partition::{CellId, CornerId, Cut, Partition};
use crate::plan::network::PieceId;
use burgeon_geometry::{Line, Rings};

/// Use of a part of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LotUse {
    /// Building site with access to a street.
    Building,
    /// Whole block without buildings.
    Park,
    /// Area behind the lots without access to a street.
    Court,
    /// Area too small or too long for a building.
    Rest,
    /// Area that intersects an obstacle.
    Blocked,
}

impl LotUse {
    /// Returns the name in scripts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Building => "building",
            Self::Park => "park",
            Self::Court => "court",
            Self::Rest => "rest",
            Self::Blocked => "blocked",
        }
    }
}

/// Part of a block.
#[derive(Debug, Clone, PartialEq)]
pub struct Lot {
    /// Number within the block, from 1.
    pub number: usize,
    /// Use of the lot.
    pub purpose: LotUse,
    /// Rings (m), the outer one counter-clockwise. Adjacent lots share their corners.
    pub rings: Rings<DVec2>,
    /// Area (m²).
    pub area: f64,
    /// Boundary along streets (m), with the lot on the left; the longest front first.
    pub fronts: Vec<Line>,
    /// Length (m) of the first front.
    pub front_length: f64,
    /// Street segment adjacent to the first front.
    pub piece: Option<PieceId>,
    /// Midpoint of the first front (m).
    pub access: DVec2,
    /// Direction from the first front to the street.
    pub facing: DVec2,
    /// Extent (m) along the first front.
    pub width: f64,
    /// Extent (m) perpendicular to the first front.
    pub depth: f64,
    /// Set if the lot is on two streets, or at a bend of one.
    pub is_corner: bool,
    /// Ratio of length to width of the smallest bounding box.
    pub elongation: f64,
}

/// Block that is being divided.
pub(super) struct Division<'a> {
    pub(super) partition: Partition,
    pub(super) options: &'a LotOptions,
    random: &'a mut dyn FnMut() -> f64,
    goes_on: &'a dyn Fn() -> bool,
}

impl StreetBlock {
    /// Divides the block into lots. `random` returns numbers from 0 to 1. All random numbers are drawn within this
    /// call, so a separate stream for each block makes its lots independent of all other blocks.
    ///
    /// The lots are disjoint and fill the block. Each building lot has a front of at least the minimum width.
    ///
    /// ```
    /// use burgeon_geometry::Rings;
    /// use burgeon_streets::{Constraints, LotOptions, LotUse, Obstacles, StreetNetwork};
    /// use glam::DVec2;
    ///
    /// // Without streets every edge of a block is on one.
    /// let network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let ring = [(0.0, 0.0), (120.0, 0.0), (120.0, 60.0), (0.0, 60.0)].map(DVec2::from);
    /// let block = network.block(None, &Rings(vec![ring.to_vec()]), f64::INFINITY).expect("an area");
    /// let options = LotOptions::new(20.0, 30.0);
    /// let lots = block.divide(&options, &mut || 0.5);
    /// assert!(lots.len() >= 8);
    /// assert!((lots.iter().map(|lot| lot.area).sum::<f64>() - 7200.0).abs() < 1e-6);
    /// let mut built = lots.iter().filter(|lot| lot.purpose == LotUse::Building);
    /// assert!(built.all(|lot| lot.front_length >= options.min_width && lot.fronts[0].length() == lot.front_length));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn divide(&self, options: &LotOptions, random: &mut dyn FnMut() -> f64) -> Vec<Lot> {
        self.divide_while(options, random, &|| true).unwrap_or_default()
    }

    /// Divides the block like [`Self::divide`] while `goes_on` returns true; `goes_on` is called before each cut.
    /// Returns `None` if it returns false.
    pub fn divide_while(
        &self,
        options: &LotOptions,
        random: &mut dyn FnMut() -> f64,
        goes_on: &dyn Fn() -> bool,
    ) -> Option<Vec<Lot>> {
        let is_park = random() < options.parks;
        let Some(partition) = Partition::new(&self.rings, &self.edge_sides) else { return Some(Vec::new()) };
        let mut division = Division { partition, options, random, goes_on };
        if is_park {
            let rings = division.partition.rings(0).to_vec();
            return Some(vec![division.lot(self, &rings, 1, Some(LotUse::Park))]);
        }
        match options.pattern {
            LotPattern::Boxes => division.by_boxes(0),
            LotPattern::Strips | LotPattern::Skeleton => {
                // A block without a skeleton on the grid is divided by boxes.
                if division.by_strips(self).is_none() {
                    division.by_boxes(0);
                }
            }
        }
        division.merge_courts();
        division.merge_small();
        let lots = division.lots(self);
        goes_on().then_some(lots)
    }
}

impl Division<'_> {
    pub(super) fn draw(&mut self) -> f64 {
        (self.random)()
    }

    /// Returns the next cell to process; `None` if the division was cancelled.
    pub(super) fn next(&self, due: &mut Vec<CellId>) -> Option<CellId> {
        if (self.goes_on)() { due.pop() } else { None }
    }

    /// Returns true if a piece has a front of at least the minimum width.
    pub(super) fn has_access(&self, piece: &[Vec<CornerId>], cut: Option<&Cut>) -> bool {
        self.partition.fronts(piece, cut).iter().any(|front| front.length >= self.options.min_width)
    }

    /// Joins adjacent cells without access to a street.
    fn merge_courts(&mut self) {
        let is_court = |division: &Self, cell: CellId| {
            let rings = division.partition.rings(cell);
            !rings.is_empty() && division.partition.fronts(rings, None).is_empty()
        };
        let mut due: Vec<CellId> = self.partition.cells().map(|(cell, _)| cell).collect();
        while let Some(cell) = self.next(&mut due) {
            if !is_court(self, cell) {
                continue;
            }
            let mut others = self.partition.neighbors(cell);
            others.retain(|(other, _)| is_court(self, *other));
            let joined = others.into_iter().find_map(|(other, _)| self.partition.join(&[cell, other]));
            due.extend(joined);
        }
    }

    /// Joins each cell that is neither a valid lot nor a court to the neighbour with the longest shared border.
    fn merge_small(&mut self) {
        let is_fine = |division: &Self, rings: &[Vec<CornerId>]| {
            let fronts = division.partition.fronts(rings, None);
            let area = division.partition.area(rings);
            match division.purpose(rings, &fronts, area) {
                LotUse::Court => area >= division.options.min_area * 0.5,
                purpose => purpose == LotUse::Building,
            }
        };
        let mut due: Vec<CellId> = self.partition.cells().map(|(cell, _)| cell).collect();
        due.reverse();
        while let Some(cell) = self.next(&mut due) {
            let rings = self.partition.rings(cell);
            if rings.is_empty() || is_fine(self, rings) {
                continue;
            }
            // A cell with a front is joined to a court only if no neighbour is a lot.
            let has_front =
                |cell: CellId| !self.partition.fronts(self.partition.rings(cell), None).is_empty();
            let own = has_front(cell);
            let mut others = self.partition.neighbors(cell);
            others.sort_by(|a, b| {
                let differs = |cell: CellId| has_front(cell) != own;
                differs(a.0).cmp(&differs(b.0)).then(b.1.total_cmp(&a.1))
            });
            let joined = others.into_iter().find_map(|(other, _)| self.partition.join(&[cell, other]));
            due.extend(joined);
        }
    }

    fn lots(&self, block: &StreetBlock) -> Vec<Lot> {
        let cells = (1..).zip(self.partition.cells()).take_while(|_| (self.goes_on)());
        cells.map(|(number, (_, rings))| self.lot(block, rings, number, None)).collect()
    }

    fn purpose(&self, rings: &[Vec<CornerId>], fronts: &[FrontRun], area: f64) -> LotUse {
        if fronts.is_empty() {
            return LotUse::Court;
        }
        let has_access = fronts.iter().any(|front| front.length >= self.options.min_width);
        if has_access && area >= self.options.min_area && !rings.is_empty() && !self.is_long(rings) {
            LotUse::Building
        } else {
            LotUse::Rest
        }
    }

    fn lot(
        &self,
        block: &StreetBlock,
        rings: &[Vec<CornerId>],
        number: usize,
        purpose: Option<LotUse>,
    ) -> Lot {
        let mut fronts = self.partition.fronts(rings, None);
        fronts.sort_by(|a, b| b.length.total_cmp(&a.length));
        let area = self.partition.area(rings);
        let purpose = purpose.unwrap_or_else(|| self.purpose(rings, &fronts, area));
        let way = fronts.first().map_or(DVec2::X, FrontRun::way);
        let [along, behind] = [way, way.perp()].map(|axis| {
            let [low, high] = extent(self.partition.outline(rings), axis);
            high - low
        });
        let long = self.options.min_width * 0.5;
        let is_corner = fronts.get(1).is_some_and(|second| second.length >= long);
        let first = fronts.first();
        Lot {
            number,
            purpose,
            rings: rings.iter().map(|ring| ring.iter().map(|at| self.partition.at(*at)).collect()).collect(),
            area,
            front_length: first.map_or(0.0, |front| front.length),
            piece: first.and_then(|front| {
                block.piece_at(front.side, front.access(|at| block.off_street(front.side, at)))
            }),
            access: first.map_or(DVec2::ZERO, |front| front.access(|at| block.off_street(front.side, at))),
            facing: -way.perp(),
            width: along,
            depth: behind,
            is_corner,
            elongation: self.partition.box_around(rings).map_or(1.0, |around| around.elongation()),
            fronts: fronts.into_iter().filter_map(|front| Line::without_repeats(front.points)).collect(),
        }
    }
}
