//! The edges that a corner may reach, looked through several at a time.

use glam::DVec2;

use super::edge::Direction;
use super::lines::MovingLine;

/// How many edges are looked at together: as a processor does with numbers that lie side by side.
const LANES: usize = 4;

/// An edge and its line at present.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeFront {
    pub line: MovingLine,
    pub direction: Direction,
    pub edge: usize,
}

/// How many edges before an edge are asked whether they run just as it does, as those of teeth and bays do.
const BEFORE: usize = 4;
/// Of an edge that is not known to run as others do.
const ALONE: f64 = f64::NAN;

/// The lines of some edges after one another, number by number.
#[derive(Debug, Clone, Copy, Default)]
struct FrontBlock {
    x: [f64; LANES],
    y: [f64; LANES],
    level: [f64; LANES],
    speed: [f64; LANES],
    slack: [f64; LANES],
    sort: [f64; LANES],
}

impl FrontBlock {
    fn set(&mut self, lane: usize, line: &MovingLine, sort: f64) {
        self.sort[lane] = sort;
        (self.x[lane], self.y[lane]) = (line.normal.x, line.normal.y);
        (self.level[lane], self.speed[lane], self.slack[lane]) = (line.level, line.speed, line.slack);
    }
}

/// What is known of a corner that moves along two lines: of the sums over three lines, by which they meet, what these two
/// add.
#[derive(Debug, Clone, Copy)]
pub(super) struct CornerCourse {
    pub cross: f64,
    pub levels: DVec2,
    pub speeds: DVec2,
    /// How far (m) a sum of levels may be off, but for what the third line adds.
    pub slack: f64,
    /// How far a sum of speeds may be off.
    pub noise: f64,
    /// What has been is before this time.
    pub now: f64,
    /// The sorts of the edges on the two lines.
    pub sorts: [f64; 2],
}

impl CornerCourse {
    /// The rate at which the three lines near each other, and the sum of their levels.
    pub(super) fn sums(&self, line: &MovingLine) -> [f64; 2] {
        [
            line.speed * self.cross + line.normal.perp_dot(self.speeds),
            line.level * self.cross + line.normal.perp_dot(self.levels),
        ]
    }
}

/// The edges that are still there, with their lines at present.
#[derive(Debug, Default)]
pub(super) struct EdgeFronts {
    all: Vec<EdgeFront>,
    blocks: Vec<FrontBlock>,
    /// For each edge the number of its sort: those of one sort have one direction and speed, to the last bit.
    sorts: Vec<f64>,
}

impl EdgeFronts {
    pub(super) fn clear(&mut self) {
        self.all.clear();
        self.blocks.clear();
        self.sorts.clear();
    }

    pub(super) fn len(&self) -> usize {
        self.all.len()
    }

    /// Adds the next edge.
    #[allow(clippy::cast_precision_loss, reason = "there is no memory for 2^53 edges")]
    #[allow(clippy::float_cmp, reason = "equal speeds are given as equal numbers")]
    pub(super) fn push(&mut self, front: EdgeFront) {
        let is_alike =
            |other: &&EdgeFront| other.direction == front.direction && other.line.speed == front.line.speed;
        let like = self.all.iter().rev().take(BEFORE).find(is_alike);
        let sort = like.map_or(front.edge as f64, |other| self.sorts[other.edge]);
        self.sorts.push(sort);
        self.add(front);
    }

    fn add(&mut self, front: EdgeFront) {
        let lane = self.all.len() % LANES;
        if lane == 0 {
            self.blocks.push(FrontBlock::default());
        }
        if let Some(block) = self.blocks.last_mut() {
            block.set(lane, &front.line, self.sorts[front.edge]);
        }
        self.all.push(front);
    }

    /// The sort of an edge.
    pub(super) fn sort(&self, edge: usize) -> f64 {
        self.sorts[edge]
    }

    /// Lets an edge have another line.
    pub(super) fn turn_to(&mut self, edge: usize, line: MovingLine) {
        self.sorts[edge] = ALONE;
        for (index, front) in self.all.iter_mut().enumerate().filter(|(_, front)| front.edge == edge) {
            front.line = line;
            self.blocks[index / LANES].set(index % LANES, &line, ALONE);
        }
    }

    /// Keeps the edges that are there.
    pub(super) fn retain(&mut self, is_there: impl Fn(usize) -> bool) {
        let all = std::mem::take(&mut self.all);
        self.blocks.clear();
        all.into_iter().filter(|front| is_there(front.edge)).for_each(|front| self.add(front));
    }

    /// All blocks, first those near that of an edge: what is next to a corner in its ring it often reaches first.
    pub(super) fn blocks_around(&self, edge: usize) -> impl Iterator<Item = usize> + use<> {
        let own = self.all.partition_point(|front| front.edge < edge) / LANES;
        (own..self.blocks.len()).chain((0..own).rev())
    }

    /// Those edges of a block that a corner may reach before the time `last`, as a number of one bit for each.
    ///
    /// Most lines are reached too late, or have been, to be divided for it.
    #[allow(clippy::float_cmp, reason = "sorts are numbered")]
    pub(super) fn within_reach(&self, block: usize, course: &CornerCourse, last: f64) -> u32 {
        let FrontBlock { x, y, level, speed, slack, sort } = &self.blocks[block];
        let CornerCourse { cross, levels, speeds, sorts, .. } = *course;
        let mut within = 0;
        for lane in 0..LANES {
            let rate = speed[lane] * cross + (x[lane] * speeds.y - y[lane] * speeds.x);
            let sum = level[lane] * cross + (x[lane] * levels.y - y[lane] * levels.x);
            let off = sum.abs() * 1e-6 + 3.0 * (course.slack + slack[lane]);
            let [slowest, fastest] = [rate - 2.0 * course.noise, rate + 2.0 * course.noise];
            let (is_late, is_over) = (-sum - off > last * fastest, off - sum < course.now * slowest.max(0.0));
            // Lines that run alike never meet.
            let is_alike = (sort[lane] == sorts[0]) | (sort[lane] == sorts[1]);
            let is_out = (rate < -course.noise) | is_late | is_over | is_alike;
            within |= u32::from(!is_out) << lane;
        }
        within
    }

    /// An edge of a block, if the block has so many.
    pub(super) fn get(&self, block: usize, lane: usize) -> Option<&EdgeFront> {
        self.all.get(block * LANES + lane)
    }
}
