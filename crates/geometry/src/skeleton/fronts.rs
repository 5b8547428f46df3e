//! Search for the edges that a corner may reach, several at a time.

use glam::{DVec2, Vec2};

use super::edge::{Direction, short};
use super::lines::MovingLine;

/// Number of edges per block, for SIMD instructions on single-precision numbers.
const LANES: usize = 8;
/// Ratio of the rounding errors of single and double precision, with a margin.
const SHORT: f32 = (1 << 28) as f32;

/// An edge with its current line.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeFront {
    pub line: MovingLine,
    pub direction: Direction,
    pub edge: usize,
}

/// Number of previous edges that are compared for an equal direction and speed, as in teeth and bays.
const BEFORE: usize = 4;

/// Lines of consecutive edges as a structure of arrays, in single precision.
#[derive(Debug, Clone, Copy, Default)]
struct FrontBlock {
    x: [f32; LANES],
    y: [f32; LANES],
    level: [f32; LANES],
    speed: [f32; LANES],
    slack: [f32; LANES],
    sort: [u32; LANES],
}

impl FrontBlock {
    fn set(&mut self, lane: usize, line: &MovingLine, sort: u32) {
        self.sort[lane] = sort;
        let normal = line.normal.as_vec2();
        (self.x[lane], self.y[lane]) = (normal.x, normal.y);
        self.level[lane] = to_single(line.level);
        (self.speed[lane], self.slack[lane]) = (to_single(line.speed), to_single(line.slack));
    }
}

/// Rounds a number to single precision.
#[allow(clippy::cast_possible_truncation, reason = "what is lost is reckoned with")]
fn to_single(number: f64) -> f32 {
    number as f32
}

/// Motion of a corner along two lines: their contribution to the sums over three lines, which determine the
/// time when the lines meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct CornerCourse {
    pub cross: f64,
    pub levels: DVec2,
    pub speeds: DVec2,
    /// Error (m) of a sum of levels, without the contribution of the third line.
    pub slack: f64,
    /// Rounding errors of a sum of levels (m) and of a sum of speeds.
    pub noise: [f64; 2],
    /// Current time; earlier events are over.
    pub now: f64,
    /// Classes of the edges on the two lines.
    pub sorts: [u32; 2],
}

/// A [`CornerCourse`] in single precision.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShortCourse {
    cross: f32,
    levels: Vec2,
    speeds: Vec2,
    slack: f32,
    noise: [f32; 2],
    now: f32,
    sorts: [u32; 2],
}

impl CornerCourse {
    pub(super) fn short(&self) -> ShortCourse {
        let noise = self.noise.map(|noise| SHORT * to_single(noise));
        ShortCourse {
            cross: to_single(self.cross),
            levels: self.levels.as_vec2(),
            speeds: self.speeds.as_vec2(),
            slack: to_single(self.slack) + noise[0],
            noise,
            now: to_single(self.now.max(0.0)),
            sorts: self.sorts,
        }
    }

    /// Returns the rate at which the three lines approach each other, and the sum of their levels.
    pub(super) fn sums(&self, line: &MovingLine) -> [f64; 2] {
        [
            line.speed * self.cross + line.normal.perp_dot(self.speeds),
            line.level * self.cross + line.normal.perp_dot(self.levels),
        ]
    }
}

/// Remaining edges with their current lines.
#[derive(Debug, Default)]
pub(super) struct EdgeFronts {
    all: Vec<EdgeFront>,
    blocks: Vec<FrontBlock>,
    /// Class of each edge: edges of one class have the same direction and speed, to the last bit.
    sorts: Vec<u32>,
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
    #[allow(clippy::float_cmp, reason = "equal speeds are given as equal numbers")]
    pub(super) fn push(&mut self, front: EdgeFront) {
        let is_alike =
            |other: &&EdgeFront| other.direction == front.direction && other.line.speed == front.line.speed;
        let like = self.all.iter().rev().take(BEFORE).find(is_alike);
        let sort = like.map_or(short(front.edge), |other| self.sorts[other.edge]);
        self.sorts.push(sort);
        self.put(self.all.len(), &front);
        self.all.push(front);
    }

    /// Adds the edge of the next rank to its block.
    fn put(&mut self, rank: usize, front: &EdgeFront) {
        let lane = rank % LANES;
        if lane == 0 {
            self.blocks.push(FrontBlock::default());
        }
        if let Some(block) = self.blocks.last_mut() {
            block.set(lane, &front.line, self.sorts[front.edge]);
        }
    }

    /// Returns the class of an edge.
    pub(super) fn sort(&self, edge: usize) -> u32 {
        self.sorts[edge]
    }

    /// Changes the line of an edge.
    pub(super) fn turn_to(&mut self, edge: usize, line: MovingLine) {
        // A class without other edges.
        let sort = short(self.sorts.len() + edge);
        self.sorts[edge] = sort;
        for (index, front) in self.all.iter_mut().enumerate().filter(|(_, front)| front.edge == edge) {
            front.line = line;
            self.blocks[index / LANES].set(index % LANES, &line, sort);
        }
    }

    /// Keeps the edges for which `is_there` returns true.
    pub(super) fn retain(&mut self, is_there: impl Fn(usize) -> bool) {
        self.all.retain(|front| is_there(front.edge));
        self.blocks.clear();
        for rank in 0..self.all.len() {
            let front = self.all[rank];
            self.put(rank, &front);
        }
    }

    /// Returns all blocks, beginning with those near an edge's block: a corner often reaches edges near it in
    /// its ring first.
    pub(super) fn blocks_around(&self, edge: usize) -> impl Iterator<Item = usize> + use<> {
        let own = self.all.partition_point(|front| front.edge < edge) / LANES;
        (own..self.blocks.len()).chain((0..own).rev())
    }

    /// Returns a bit mask of the edges of a block that a corner may reach before the time `last`.
    ///
    /// Most lines are reached too late or in the past. Single precision tests twice as many lines at once.
    pub(super) fn within_reach(&self, block: usize, course: &ShortCourse, last: f64) -> u32 {
        let FrontBlock { x, y, level, speed, slack, sort } = &self.blocks[block];
        let ShortCourse { cross, levels, speeds, noise, now, sorts, .. } = *course;
        let last = to_single(last.max(0.0));
        let mut within = 0;
        for lane in 0..LANES {
            let rate = speed[lane] * cross + (x[lane] * speeds.y - y[lane] * speeds.x);
            let sum = level[lane] * cross + (x[lane] * levels.y - y[lane] * levels.x);
            let off = sum.abs() * 1e-6 + 3.0 * (course.slack + slack[lane]);
            let [slowest, fastest] = [rate - 2.0 * noise[1], rate + 2.0 * noise[1]];
            let (is_late, is_over) = (-sum - off > last * fastest, off - sum < now * slowest.max(0.0));
            // Parallel lines of the same speed never meet.
            let is_alike = (sort[lane] == sorts[0]) | (sort[lane] == sorts[1]);
            let is_out = (rate < -noise[1]) | is_late | is_over | is_alike;
            within |= u32::from(!is_out) << lane;
        }
        within
    }

    /// Returns an edge of a block, if the block has that many edges.
    pub(super) fn get(&self, block: usize, lane: usize) -> Option<&EdgeFront> {
        self.all.get(block * LANES + lane)
    }
}
