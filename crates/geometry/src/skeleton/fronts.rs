//! The edges that a corner may reach, looked through several at a time.

use glam::{DVec2, Vec2};

use super::edge::Direction;
use super::events::short;
use super::lines::MovingLine;

/// How many edges are looked at together: as a processor does with short numbers that lie side by side.
const LANES: usize = 8;
/// How much more short numbers may be off than long ones.
const SHORT: f32 = (1 << 28) as f32;

/// An edge and its line at present.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeFront {
    pub line: MovingLine,
    pub direction: Direction,
    pub edge: usize,
}

/// How many edges before an edge are asked whether they run just as it does, as those of teeth and bays do.
const BEFORE: usize = 4;

/// The lines of some edges after one another, number by number, in short numbers.
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
        self.level[lane] = near(line.level);
        (self.speed[lane], self.slack[lane]) = (near(line.speed), near(line.slack));
    }
}

/// The short number that is nearest to a number.
#[allow(clippy::cast_possible_truncation, reason = "what is lost is reckoned with")]
fn near(number: f64) -> f32 {
    number as f32
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
    /// How far by rounding a sum of levels (m) may be off, and one of speeds.
    pub noise: [f64; 2],
    /// What has been is before this time.
    pub now: f64,
    /// The sorts of the edges on the two lines.
    pub sorts: [u32; 2],
}

/// A [`CornerCourse`] in short numbers.
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
        let noise = self.noise.map(|noise| SHORT * near(noise));
        ShortCourse {
            cross: near(self.cross),
            levels: self.levels.as_vec2(),
            speeds: self.speeds.as_vec2(),
            slack: near(self.slack) + noise[0],
            noise,
            now: near(self.now.max(0.0)),
            sorts: self.sorts,
        }
    }

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

    /// Puts the edge of a rank, which no other has had, into its block.
    fn put(&mut self, rank: usize, front: &EdgeFront) {
        let lane = rank % LANES;
        if lane == 0 {
            self.blocks.push(FrontBlock::default());
        }
        if let Some(block) = self.blocks.last_mut() {
            block.set(lane, &front.line, self.sorts[front.edge]);
        }
    }

    /// The sort of an edge.
    pub(super) fn sort(&self, edge: usize) -> u32 {
        self.sorts[edge]
    }

    /// Lets an edge have another line.
    pub(super) fn turn_to(&mut self, edge: usize, line: MovingLine) {
        // One that no other edge has.
        let sort = short(self.sorts.len() + edge);
        self.sorts[edge] = sort;
        for (index, front) in self.all.iter_mut().enumerate().filter(|(_, front)| front.edge == edge) {
            front.line = line;
            self.blocks[index / LANES].set(index % LANES, &line, sort);
        }
    }

    /// Keeps the edges that are there.
    pub(super) fn retain(&mut self, is_there: impl Fn(usize) -> bool) {
        self.all.retain(|front| is_there(front.edge));
        self.blocks.clear();
        for rank in 0..self.all.len() {
            let front = self.all[rank];
            self.put(rank, &front);
        }
    }

    /// All blocks, first those near that of an edge: what is next to a corner in its ring it often reaches first.
    pub(super) fn blocks_around(&self, edge: usize) -> impl Iterator<Item = usize> + use<> {
        let own = self.all.partition_point(|front| front.edge < edge) / LANES;
        (own..self.blocks.len()).chain((0..own).rev())
    }

    /// Those edges of a block that a corner may reach before the time `last`, as a number of one bit for each.
    ///
    /// Most lines are reached too late, or have been. Short numbers tell that of twice as many at once.
    pub(super) fn within_reach(&self, block: usize, course: &ShortCourse, last: f64) -> u32 {
        let FrontBlock { x, y, level, speed, slack, sort } = &self.blocks[block];
        let ShortCourse { cross, levels, speeds, noise, now, sorts, .. } = *course;
        let last = near(last.max(0.0));
        let mut within = 0;
        for lane in 0..LANES {
            let rate = speed[lane] * cross + (x[lane] * speeds.y - y[lane] * speeds.x);
            let sum = level[lane] * cross + (x[lane] * levels.y - y[lane] * levels.x);
            let off = sum.abs() * 1e-6 + 3.0 * (course.slack + slack[lane]);
            let [slowest, fastest] = [rate - 2.0 * noise[1], rate + 2.0 * noise[1]];
            let (is_late, is_over) = (-sum - off > last * fastest, off - sum < now * slowest.max(0.0));
            // Lines that run alike never meet.
            let is_alike = (sort[lane] == sorts[0]) | (sort[lane] == sorts[1]);
            let is_out = (rate < -noise[1]) | is_late | is_over | is_alike;
            within |= u32::from(!is_out) << lane;
        }
        within
    }

    /// An edge of a block, if the block has so many.
    pub(super) fn get(&self, block: usize, lane: usize) -> Option<&EdgeFront> {
        self.all.get(block * LANES + lane)
    }
}
