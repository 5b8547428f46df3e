//! Construction of roofs: the outline with its overhang, the skeleton, the slopes and the faces below them.

use glam::{DVec2, DVec3};

use super::super::skeleton::{Pace, Skeleton};
use super::field::{self, HeightField, PlaneRule};
use super::mapped::{MapNodes, MappedSurface};
use super::mesh;
use super::outset::Outset;
use super::overhang::{Rake, Rim, SkeletonFaces};
use super::patches::{level_peaks, patches};
use super::plate::at_walls;
use super::shape::Profile;
use super::shed::Fall;
use super::{Eaves, Ends, Patch, PatchKind, Rise, RoofShape, RoofSurface, Support, UnusedLine};
use crate::planar::{Polygon, Ring};
use burgeon_base::error::Result;

/// A finished roof.
#[derive(Debug, Clone, Default)]
pub struct RoofCover {
    /// Faces of the roof; together with walls of the same base height they close a building.
    pub patches: Vec<Patch>,
    /// Overhang (m) over each edge, beyond the parts that project below.
    pub overhangs: Vec<f64>,
    /// Edges with less than the requested overhang, because other parts of the building are too close.
    pub tight: Vec<usize>,
    /// Set if a requested gable, other than along a neighbour, could not be built.
    pub hipped: bool,
    /// Difference from the requested form, if the plan requires one.
    pub remark: Option<&'static str>,
    /// Lines of the map that are not used as they are given.
    pub unused: Vec<UnusedLine>,
}

/// Type of the roof over an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
enum EdgeCover {
    Slope,
    /// A gable in the plane of the wall, with a roof overhang.
    Raked,
    /// A gable at the end of the roof, without an overhang.
    Flush,
}

/// Area (m²) up to which a mapped roof may be level at the eaves without a remark.
const LEVEL_AREA: f64 = 0.5;
/// Minimum turn of a gable's corners (radians).
const SHARP: f64 = 65.0 * std::f64::consts::PI / 180.0;
/// Maximum extension (m) of a gable beyond the ends of its wall.
const BEYOND: f64 = 0.05;
/// Fraction of a gable's height below a Dutch hip.
const BELOW_HIP: f64 = 0.5;

impl RoofShape {
    /// Creates the roof over walls with this outline, which end at height `base` (m).
    ///
    /// Fails if the outline has no valid skeleton.
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

    /// Creates the roof over a support; fails if its outline has no valid skeleton.
    pub fn cover_on(&self, support: &Support<'_>) -> Result<RoofCover> {
        let mut nodes = support.map.map(|map| MapNodes::new(map, support.walls, self.rise)).transpose()?;
        let unused = nodes.as_mut().map(|nodes| std::mem::take(&mut nodes.unused)).unwrap_or_default();
        let mut nodes = nodes.filter(|nodes| !nodes.is_empty());
        let mut cover = match support.outermost() {
            None => self.cover_walls(support, nodes.as_ref())?,
            Some(outermost) => {
                let pairs = support.within_reach(f64::INFINITY).into_iter().zip(&outermost.distances);
                let reach: Vec<f64> = pairs.map(|(reach, jut)| reach - jut).collect();
                let walls = &outermost.polygon;
                if let Some(nodes) = &mut nodes {
                    nodes.move_to(walls);
                }
                let inner = Support { walls, juts: &[], reach: &reach, ..*support };
                let mut cover = self.cover_walls(&inner, nodes.as_ref())?;
                support.add_soffit(&outermost, &mut cover.patches);
                cover
            }
        };
        mesh::mend(&mut cover.patches)?;
        Ok(RoofCover { unused, ..cover })
    }

    /// Creates the roof over walls without projecting parts, or over the lines of a map.
    fn cover_walls(&self, support: &Support<'_>, map: Option<&MapNodes>) -> Result<RoofCover> {
        if let Some(nodes) = map {
            let (surface, planes) = MappedSurface::new(nodes)?;
            let is_level = surface.level > LEVEL_AREA;
            let heights = HeightField { planes, rule: PlaneRule::Mapped(surface) };
            let remark =
                is_level.then_some("a part of it is level at the eaves, as no line of the map rises there");
            return Ok(RoofCover { remark, ..field::raised(self, &heights, support)? });
        }
        match self.surface {
            RoofSurface::Shed => Ok(self.shed(support)),
            RoofSurface::Field(form, axis) => form.cover(self, axis, support),
            RoofSurface::Flat(None) => Ok(self.level(support)),
            RoofSurface::Flat(_) => self.sloped_cover(&Support { party: &[], ..*support }, Ends::Hips),
            RoofSurface::Sloped(ends, _) => self.sloped_cover(support, ends),
        }
    }

    /// Returns the requested overhang over each edge: 0 over flush gables.
    fn wanted_overhangs(&self, most: &[f64], over: &[EdgeCover]) -> Vec<f64> {
        let wanted = |(over, most): (&EdgeCover, &f64)| if *over == EdgeCover::Flush { 0.0 } else { *most };
        over.iter().zip(most).map(wanted).collect()
    }

    /// Returns the cover with these patches and this outline.
    fn finish(
        &self,
        patches: Vec<Patch>,
        support: &Support<'_>,
        over: &[EdgeCover],
        outset: Outset,
        hipped: bool,
    ) -> RoofCover {
        let wanted = self.wanted_overhangs(&support.within_reach(self.overhang), over);
        let tight = (0..wanted.len()).filter(|&edge| outset.distances[edge] < wanted[edge]).collect();
        RoofCover { patches, overhangs: outset.distances, tight, hipped, ..RoofCover::default() }
    }

    /// Creates a level roof.
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
        self.finish(patches, support, &over, outset, false)
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

    /// Creates a roof with a slope over each edge, except for gables.
    ///
    /// If a gable would extend beyond its wall, over other parts of the roof, it is replaced by a slope.
    /// Slopes that continue beyond the walls pass the top of all walls at the same time: slopes with a
    /// smaller overhang start later.
    fn sloped_cover(&self, support: &Support<'_>, ends: Ends) -> Result<RoofCover> {
        let &Support { walls, base, .. } = support;
        let even = vec![Pace::default(); support.edges()];
        let mut hip = if ends == Ends::Hips { None } else { Some(Skeleton::for_mesh(walls, &even)?) };
        let mut party = support.party.to_vec();
        let mut over = self.edge_covers(walls, hip.as_ref(), ends, &party);
        let mut most = support.within_reach(self.overhang);
        let mut hipped = false;
        loop {
            let outset = Outset::new(walls, self.wanted_overhangs(&most, &over), |_| false);
            let overhang = outset.most();
            let paces = self.paces(walls, &outset, &over, ends);
            let hips = overhang == 0.0 && over.iter().all(|over| *over == EdgeCover::Slope);
            // Without gables and overhang, the result is the hip roof in which the gables were searched.
            let known = if hips { hip.take() } else { None };
            let skeleton = match known.map_or_else(|| Skeleton::for_mesh(&outset.polygon, &paces), Ok) {
                Ok(skeleton) => skeleton,
                Err(_) if !party.is_empty() => {
                    party.clear();
                    over = self.edge_covers(walls, hip.as_ref(), ends, &party);
                    continue;
                }
                Err(error) if over.iter().all(|over| *over == EdgeCover::Slope) => {
                    // The outline with an overhang may be harder to solve than the walls.
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
                    over = self.edge_covers(walls, hip.as_ref(), ends, &party);
                } else {
                    astray.into_iter().for_each(|edge| over[edge] = EdgeCover::Slope);
                    hipped = true;
                }
                continue;
            }
            let profile = Profile::new(self, skeleton.duration(), overhang);
            let rim = self.rim(support, &outset, &profile);
            let mut points = level_peaks(&skeleton, &paces, &profile);
            let is_plate = profile.plate_overhang() > 0.0;
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
            return Ok(self.finish(patches, support, &over, outset, hipped));
        }
    }

    /// Returns the type of roof over each edge: the hip roof `hip` shows possible positions of gables.
    fn edge_covers(
        &self,
        walls: &Polygon,
        hip: Option<&Skeleton>,
        ends: Ends,
        party: &[usize],
    ) -> Vec<EdgeCover> {
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

    /// Returns the motion of each edge of the outline.
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
                        // Length of the edge that both neighbours consume while they move 1 m.
                        let used = |side: DVec2| side.length() * along.length() / side.perp_dot(along).abs();
                        let top = along.length() / (used(before) + used(after));
                        let rest = beyond + BELOW_HIP * top;
                        // Hips that begin at nearly the same time begin at exactly the same time.
                        Pace { speed: 1.0, rest: ((rest * 64.0).round() / 64.0).max(beyond) }
                    }
                    _ => Pace::STILL,
                });
            }
        }
        paces
    }

    /// Creates a roof of one slope, highest over the longest edge and lowest at the point farthest from it.
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
        let wanted = self.wanted_overhangs(&support.within_reach(self.overhang), &over);
        let outset = Outset::new(walls, wanted, |edge| over[edge] == EdgeCover::Flush);
        let high = match self.rise {
            Rise::Height(height) => height,
            // The roof has the height of a gable roof of the same slope.
            Rise::Slope(slope) => {
                let hip = Skeleton::for_mesh(walls, &vec![Pace::default(); over.len()]);
                let half = fall.length() / 2.0;
                slope * hip.map_or(half, |hip| hip.duration()).min(half)
            }
        };
        let patches = super::shed::patches(self, &fall, walls, &outset.polygon, base, outset.most(), high);
        self.finish(patches, support, &over, outset, false)
    }
}

/// Reduces the overhang over the edges in `astray` and their neighbours; to 0 everywhere if nothing else
/// helps.
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

/// Returns true if the face over a still edge extends beyond the edge's ends, or if the edge had to move.
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

/// Returns the edges whose hip triangles become gables: the shortest first, and no two neighbours, nor
/// neighbours of edges with gables `already`.
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

/// Returns the lowest face of a detached roof: its outline at height `base` (m), seen from below.
pub fn floor(outline: &Polygon, base: f64) -> Vec<Ring<DVec3>> {
    outline.at_height(base).from_below()
}
