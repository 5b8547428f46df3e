//! Roofs put together: the outline with its overhang, its skeleton, the slopes and what is below them.

use glam::{DVec2, DVec3};

use super::super::skeleton::{Pace, Skeleton};
use super::mesh;
use super::outset::Outset;
use super::overhang::{Rake, Rim, SkeletonFaces};
use super::patches::{leveled, patches};
use super::plate::at_walls;
use super::shape::Profile;
use super::shed::Fall;
use super::{Eaves, Ends, Patch, PatchKind, Rise, RoofShape, RoofSurface, Support};
use crate::planar::{Polygon, Ring};
use burgeon_base::error::Result;

/// A finished roof.
#[derive(Debug, Clone, Default)]
pub struct RoofCover {
    /// Its faces. Together with walls up to the same height they close a building.
    pub patches: Vec<Patch>,
    /// How far (m) it juts out over each edge, beyond what stands out below.
    pub overhangs: Vec<f64>,
    /// The edges over which it juts out less than it was to, for want of room beside other parts of the building.
    pub tight: Vec<usize>,
    /// Whether it was to have gables, other than along neighbours, that it could not get.
    pub hipped: bool,
}

/// What stands over an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
enum EdgeCover {
    Slope,
    /// A gable in the plane of the wall, with the roof jutting out over it.
    Raked,
    /// A gable at the end of the roof.
    Flush,
}

/// Corners of gables turn by more than this (radians).
const SHARP: f64 = 65.0 * std::f64::consts::PI / 180.0;
/// A gable may go on by this (m) beyond the ends of its wall.
const BEYOND: f64 = 0.05;
/// What part of a gable's height a Dutch hip leaves.
const BELOW_HIP: f64 = 0.5;

impl RoofShape {
    /// The roof over walls with this outline, which end at height `base` (m).
    ///
    /// Fails if there is no skeleton for it.
    ///
    /// ```
    /// use burgeon_geometry::roof::{Eaves, Ends, PatchKind, Rise, RoofShape, RoofSurface};
    /// use burgeon_geometry::{Polygon, Rings};
    /// use glam::DVec2;
    ///
    /// let walls = [(0.0, 0.0), (12.0, 0.0), (12.0, 8.0), (0.0, 8.0)].map(DVec2::from);
    /// let walls = Polygon::new(Rings(vec![walls.to_vec()]))?;
    /// let surface = RoofSurface::Sloped(Ends::Gables, &[]);
    /// let roof = RoofShape { surface, rise: Rise::Height(4.0), overhang: 0.0, eaves: Eaves::Closed, slab: 0.0 };
    /// let cover = roof.cover(&walls, 3.0)?;
    /// let count = |kind: PatchKind| cover.patches.iter().filter(|patch| patch.kind == kind).count();
    /// assert_eq!((count(PatchKind::Slope), count(PatchKind::Gable)), (2, 2));
    /// let heights = cover.patches.iter().flat_map(|patch| &patch.rings).flatten().map(|at| at.z);
    /// assert_eq!(heights.fold(0.0, f64::max), 7.0);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn cover(&self, walls: &Polygon, base: f64) -> Result<RoofCover> {
        self.cover_on(&Support::new(walls, base))
    }

    /// The roof over what stands below it. Fails if there is no skeleton for it.
    pub fn cover_on(&self, support: &Support<'_>) -> Result<RoofCover> {
        let mut cover = match support.outermost() {
            None => self.cover_walls(support)?,
            Some(outermost) => {
                let pairs = support.within_reach(f64::INFINITY).into_iter().zip(&outermost.distances);
                let reach: Vec<f64> = pairs.map(|(reach, jut)| reach - jut).collect();
                let walls = &outermost.polygon;
                let mut cover = self.cover_walls(&Support { walls, juts: &[], reach: &reach, ..*support })?;
                support.add_soffit(&outermost, &mut cover.patches);
                cover
            }
        };
        mesh::mend(&mut cover.patches);
        Ok(cover)
    }

    /// The roof over walls that nothing stands out of.
    fn cover_walls(&self, support: &Support<'_>) -> Result<RoofCover> {
        match self.surface {
            RoofSurface::Shed => Ok(self.shed(support)),
            RoofSurface::Flat(None) => Ok(self.level(support)),
            RoofSurface::Flat(_) => self.sloped(&Support { party: &[], ..*support }, Ends::Hips),
            RoofSurface::Sloped(ends, _) => self.sloped(support, ends),
        }
    }

    /// How far it is to jut out over each edge: not over flush gables.
    fn wanted(&self, most: &[f64], over: &[EdgeCover]) -> Vec<f64> {
        let wanted = |(over, most): (&EdgeCover, &f64)| if *over == EdgeCover::Flush { 0.0 } else { *most };
        over.iter().zip(most).map(wanted).collect()
    }

    /// The cover with these patches and this outline.
    fn finished(
        &self,
        patches: Vec<Patch>,
        support: &Support<'_>,
        over: &[EdgeCover],
        outset: Outset,
        hipped: bool,
    ) -> RoofCover {
        let wanted = self.wanted(&support.within_reach(self.overhang), over);
        let tight = (0..wanted.len()).filter(|&edge| outset.distances[edge] < wanted[edge]).collect();
        RoofCover { patches, overhangs: outset.distances, tight, hipped }
    }

    /// A level roof.
    fn level(&self, support: &Support<'_>) -> RoofCover {
        let &Support { walls, base, .. } = support;
        let over = vec![EdgeCover::Slope; support.edges()];
        let outset = Outset::new(walls, support.within_reach(self.overhang), |_| false);
        let top = Patch {
            kind: PatchKind::Slope,
            edge: 0,
            flap: 0,
            along: DVec2::X,
            rings: outset.polygon.at_height(base + self.slab).to_vec(),
        };
        let mut patches = vec![top];
        let profile = Profile::new(self, 1.0, outset.most());
        self.rim(support, &outset, &profile).close(&mut patches, &vec![None; over.len()], None);
        self.finished(patches, support, &over, outset, false)
    }

    fn rim<'a>(&self, support: &Support<'a>, outset: &'a Outset, profile: &'a Profile) -> Rim<'a> {
        Rim {
            walls: support.walls,
            outer: &outset.polygon,
            profile,
            base: support.base,
            overhang: outset.most(),
            distances: &outset.distances,
            slab: self.slab,
        }
    }

    /// A roof with a slope over each edge, but for gables.
    ///
    /// Where a gable would go on beyond its wall, over other parts of the roof, there is a slope as well. Slopes that run
    /// on beyond the walls are at the top of all walls at once: where they jut out less, they begin later.
    fn sloped(&self, support: &Support<'_>, ends: Ends) -> Result<RoofCover> {
        let &Support { walls, base, .. } = support;
        let even = vec![Pace::default(); support.edges()];
        let mut hip = if ends == Ends::Hips { None } else { Some(Skeleton::for_mesh(walls, &even)?) };
        let mut party = support.party.to_vec();
        let mut over = self.over(walls, hip.as_ref(), ends, &party);
        let mut most = support.within_reach(self.overhang);
        let mut hipped = false;
        loop {
            let outset = Outset::new(walls, self.wanted(&most, &over), |_| false);
            let overhang = outset.most();
            let paces = self.paces(walls, &outset, &over, ends);
            let hips = overhang == 0.0 && over.iter().all(|over| *over == EdgeCover::Slope);
            // Without a gable and an overhang, the roof is the one that the gables were looked for in.
            let known = if hips { hip.take() } else { None };
            let skeleton = match known.map_or_else(|| Skeleton::for_mesh(&outset.polygon, &paces), Ok) {
                Ok(skeleton) => skeleton,
                Err(_) if !party.is_empty() => {
                    party.clear();
                    over = self.over(walls, hip.as_ref(), ends, &party);
                    continue;
                }
                Err(error) if over.iter().all(|over| *over == EdgeCover::Slope) => {
                    // What juts out may be harder than what stands below.
                    if overhang == 0.0 {
                        return Err(error);
                    }
                    most.fill(0.0);
                    continue;
                }
                Err(_) => {
                    over.fill(EdgeCover::Slope);
                    hipped = true;
                    continue;
                }
            };
            let gable = |edge: &usize| over[*edge] != EdgeCover::Slope;
            let astray: Vec<usize> =
                (0..over.len()).filter(gable).filter(|&edge| strays(&skeleton, edge, paces[edge])).collect();
            if !astray.is_empty() {
                let rows = party.len();
                party.retain(|edge| !astray.contains(edge));
                if party.len() < rows {
                    over = self.over(walls, hip.as_ref(), ends, &party);
                } else {
                    astray.into_iter().for_each(|edge| over[edge] = EdgeCover::Slope);
                    hipped = true;
                }
                continue;
            }
            let profile = Profile::new(self, skeleton.duration(), overhang);
            let rim = self.rim(support, &outset, &profile);
            let mut points = leveled(&skeleton, &paces, &profile);
            let is_plate = profile.beyond() > 0.0;
            let mut rings = skeleton.faces;
            if is_plate {
                let ends: Vec<[DVec2; 2]> = walls.edges().collect();
                let raked: Vec<bool> = over.iter().map(|over| *over == EdgeCover::Raked).collect();
                let rest = |pace: &Pace| if pace.speed > 0.0 { pace.rest } else { f64::INFINITY };
                let rests: Vec<f64> = paces.iter().map(rest).collect();
                match at_walls(&rings, &mut points, overhang, &ends, &raked, &rests) {
                    Ok(faces) => rings = faces,
                    Err(astray) => {
                        give_way(&astray, walls, &outset.distances, &mut most);
                        continue;
                    }
                }
            }
            let faces = SkeletonFaces { rings: &rings, points: &points };
            let rakes: Vec<Option<Rake>> = (0..over.len())
                .map(|edge| if over[edge] == EdgeCover::Raked { rim.rake(edge, faces) } else { None })
                .collect();
            let mut failed = false;
            for (over, rake) in over.iter_mut().zip(&rakes) {
                if *over == EdgeCover::Raked && rake.is_none() {
                    *over = EdgeCover::Flush;
                    failed = true;
                }
            }
            if failed {
                continue;
            }
            let mut patches = patches(&rings, &paces, &profile, base, points.clone(), &rakes);
            rim.close(&mut patches, &rakes, is_plate.then_some(faces));
            return Ok(self.finished(patches, support, &over, outset, hipped));
        }
    }

    /// What is to stand over each edge: `hip`, the hip roof, shows where gables may.
    fn over(&self, walls: &Polygon, hip: Option<&Skeleton>, ends: Ends, party: &[usize]) -> Vec<EdgeCover> {
        let mut over = vec![EdgeCover::Slope; walls.size()];
        for edge in party {
            over[*edge] = EdgeCover::Flush;
        }
        let raked = self.eaves == Eaves::Open && self.overhang > 0.0 && ends == Ends::Gables;
        let kind = if raked { EdgeCover::Raked } else { EdgeCover::Flush };
        for edge in hip.into_iter().flat_map(|hip| gables(walls, hip, party)) {
            over[edge] = kind;
        }
        over
    }

    /// How the edges of the outline move.
    fn paces(&self, walls: &Polygon, outset: &Outset, over: &[EdgeCover], ends: Ends) -> Vec<Pace> {
        let mut paces = Vec::with_capacity(over.len());
        let is_plate = self.eaves == Eaves::Open && matches!(self.surface, RoofSurface::Sloped(..));
        let beyond = if is_plate { outset.most() } else { 0.0 };
        for ring in if is_plate { walls } else { &outset.polygon } {
            let count = ring.len();
            for index in 0..count {
                let at = |offset: usize| ring[(index + count + offset - 1) % count];
                let [before, along, after] = [at(1) - at(0), at(2) - at(1), at(3) - at(2)];
                let edge = paces.len();
                paces.push(match over[edge] {
                    EdgeCover::Slope if is_plate => {
                        Pace { speed: outset.stretches[edge], rest: beyond - outset.distances[edge] }
                    }
                    EdgeCover::Slope => Pace::default(),
                    _ if ends == Ends::DutchHips => {
                        // How much of the edge both neighbours use up while they move 1 m.
                        let used = |side: DVec2| side.length() * along.length() / side.perp_dot(along).abs();
                        let top = along.length() / (used(before) + used(after));
                        let rest = beyond + BELOW_HIP * top;
                        // So that hips that begin nearly at once do so at once.
                        Pace { speed: 1.0, rest: ((rest * 64.0).round() / 64.0).max(beyond) }
                    }
                    _ => Pace::STILL,
                });
            }
        }
        paces
    }

    /// A roof of one slope, highest over the longest edge and lowest at the place furthest from it.
    fn shed(&self, support: &Support<'_>) -> RoofCover {
        let &Support { walls, base, .. } = support;
        let fall = Fall::new(walls);
        let open = self.eaves == Eaves::Open;
        let over: Vec<EdgeCover> = if open {
            vec![EdgeCover::Slope; support.edges()]
        } else {
            fall.eaves(walls)
                .into_iter()
                .map(|eaves| if eaves { EdgeCover::Slope } else { EdgeCover::Flush })
                .collect()
        };
        let wanted = self.wanted(&support.within_reach(self.overhang), &over);
        let outset = Outset::new(walls, wanted, |edge| over[edge] == EdgeCover::Flush);
        let high = match self.rise {
            Rise::Height(height) => height,
            // As high as a gable roof of this slope would be.
            Rise::Slope(slope) => {
                let hip = Skeleton::for_mesh(walls, &vec![Pace::default(); over.len()]);
                let half = fall.length() / 2.0;
                slope * hip.map_or(half, |hip| hip.duration()).min(half)
            }
        };
        let patches = super::shed::patches(self, &fall, walls, &outset.polygon, base, outset.most(), high);
        self.finished(patches, support, &over, outset, false)
    }
}

/// Lets the roof jut out less over edges that go `astray`, and over those beside them; at last nowhere.
fn give_way(astray: &[usize], walls: &Polygon, distances: &[f64], most: &mut [f64]) {
    let mut changed = false;
    let mut first = 0;
    for count in walls.iter().map(|ring| ring.len()) {
        for index in
            astray.iter().filter(|edge| (first..first + count).contains(*edge)).map(|edge| edge - first)
        {
            for edge in [index + count - 1, index, index + 1].map(|index| first + index % count) {
                changed |= distances[edge] > 0.0;
                let half = (distances[edge] * 50.0).floor() / 100.0;
                most[edge] = most[edge].min(half);
            }
        }
        first += count;
    }
    if !changed {
        most.fill(0.0);
    }
}

/// Whether the face over an edge that stands still goes on beyond the edge's ends, or the edge has had to move.
fn strays(skeleton: &Skeleton, edge: usize, pace: Pace) -> bool {
    if pace.moves() {
        return false;
    }
    if skeleton.paces[edge] != pace {
        return true;
    }
    let face = &skeleton.faces[edge];
    let [from, to] = [face[0], face[1]].map(|peak| skeleton.peaks[peak].at);
    let (along, length) = ((to - from).normalize_or_zero(), from.distance(to));
    let upright = face.iter().map(|&peak| skeleton.peaks[peak]).filter(|peak| pace.way(peak.time) <= 0.0);
    let mut places = upright.map(|peak| along.dot(peak.at - from));
    places.any(|place| !(-BEYOND..=length + BEYOND).contains(&place))
}

/// The edges for gables, in place of the triangles of a hip roof: the shortest first, and no two neighbours, nor
/// neighbours of those that have gables `already`.
fn gables(walls: &Polygon, hip: &Skeleton, already: &[usize]) -> Vec<usize> {
    let mut candidates: Vec<(f64, usize, [usize; 2])> = Vec::new();
    let mut first = 0;
    for ring in walls {
        let count = ring.len();
        for index in 0..count {
            let at = |offset: usize| ring[(index + offset) % count];
            let [a, b, c] = [at(1) - at(0), at(2) - at(1), at(3) - at(2)];
            let number = first + (index + 1) % count;
            let turns = [a.angle_to(b), b.angle_to(c)].iter().all(|turn| *turn > SHARP);
            if turns && hip.faces[number].len() == 3 {
                candidates.push((b.length(), number, [first + index, first + (index + 2) % count]));
            }
        }
        first += count;
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut found: Vec<usize> = already.to_vec();
    for (_, number, neighbours) in candidates {
        if [number].iter().chain(&neighbours).all(|edge| !found.contains(edge)) {
            found.push(number);
        }
    }
    found.split_off(already.len())
}

/// The lowest face of a roof that stands by itself: its outline at height `base` (m), seen from below.
pub fn floor(outline: &Polygon, base: f64) -> Vec<Ring<DVec3>> {
    outline.at_height(base).from_below()
}
