//! Roofs put together: the outline with its overhang, its skeleton, the slopes and what is below them.

use glam::{DVec2, DVec3};

use super::super::plan::{outset, room};
use super::super::skeleton::{Pace, Skeleton};
use super::overhang::{Rake, Rim};
use super::patches::{leveled, patches};
use super::shape::Profile;
use super::shed::Fall;
use super::{Eaves, Ends, Patch, PatchKind, Rise, Shape, Surface};
use crate::error::Result;

/// A finished roof.
#[derive(Debug, Clone, Default)]
pub struct Cover {
    /// Its faces. Together with walls up to the same height they close a building.
    pub patches: Vec<Patch>,
    /// How far (m) it juts out.
    pub overhang: f64,
    /// Whether it was to have gables, other than along neighbours, that it could not get.
    pub hipped: bool,
}

/// What stands over an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Over {
    Slope,
    /// A gable in the plane of the wall, with the roof jutting out over it.
    Raked,
    /// A gable at the end of the roof.
    Flush,
}

/// What part is used of the room that there is before an edge of the outline vanishes, as in a narrow recess.
const KEPT: f64 = 0.9;
/// Parts of the overhang that are tried where the outline would meet itself otherwise.
const FACTORS: [f64; 4] = [1.0, 0.5, 0.25, 0.0];
/// Corners of gables turn by more than this (radians).
const SHARP: f64 = 65.0 * std::f64::consts::PI / 180.0;
/// A gable may go on by this (m) beyond the ends of its wall.
const BEYOND: f64 = 0.05;
/// What part of a gable's height a Dutch hip leaves.
const BELOW_HIP: f64 = 0.5;

impl Shape {
    /// The roof over walls with this outline, which end at height `base` (m).
    ///
    /// The first ring is counter-clockwise, the holes are clockwise. Fails if there is no skeleton for it.
    pub fn cover(&self, walls: &[Vec<DVec2>], base: f64) -> Result<Cover> {
        self.cover_in_row(walls, base, &[])
    }

    /// As [`Shape::cover`], with gables where possible over `party`, the edges along neighbours.
    pub fn cover_in_row(&self, walls: &[Vec<DVec2>], base: f64, party: &[usize]) -> Result<Cover> {
        match self.surface {
            Surface::Shed => Ok(self.shed(walls, base)),
            Surface::Flat(None) => Ok(self.plate(walls, base)),
            Surface::Flat(_) => self.sloped(walls, base, Ends::Hips, &[]),
            Surface::Sloped(ends, _) => self.sloped(walls, base, ends, party),
        }
    }

    /// The outline moved outwards where there is room, and how far, in whole centimetres where that is less than all;
    /// not over flush gables.
    fn outline(&self, walls: &[Vec<DVec2>], over: &[Over]) -> (Vec<Vec<DVec2>>, f64) {
        let distances = |distance: f64| -> Vec<f64> {
            over.iter().map(|over| if *over == Over::Flush { 0.0 } else { distance }).collect()
        };
        if self.overhang > 0.0 {
            let room = room(walls, &distances(self.overhang));
            let most = if room < 1.0 { KEPT * room } else { 1.0 };
            for factor in FACTORS {
                let mut distance = self.overhang * most * factor;
                if distance < self.overhang {
                    distance = (distance * 100.0 + 1e-6).floor() / 100.0;
                }
                if let Some(rings) = outset(walls, &distances(distance)) {
                    return (rings, distance);
                }
            }
        }
        (walls.to_vec(), 0.0)
    }

    /// A level roof.
    fn plate(&self, walls: &[Vec<DVec2>], base: f64) -> Cover {
        let count = walls.iter().map(Vec::len).sum();
        let (outer, overhang) = self.outline(walls, &vec![Over::Slope; count]);
        let high = |ring: &Vec<DVec2>| ring.iter().map(|at| at.extend(base + self.slab)).collect();
        let top = Patch {
            kind: PatchKind::Slope,
            edge: 0,
            flap: 0,
            along: DVec2::X,
            rings: outer.iter().map(high).collect(),
        };
        let mut patches = vec![top];
        let profile = Profile::new(self, 1.0, overhang);
        Rim { walls, outer: &outer, profile: &profile, base, overhang, slab: self.slab }
            .close(&mut patches, &vec![None; count]);
        Cover { patches, overhang, hipped: false }
    }

    /// A roof with a slope over each edge, but for gables.
    ///
    /// Where a gable would go on beyond its wall, over other parts of the roof, there is a slope as well.
    fn sloped(&self, walls: &[Vec<DVec2>], base: f64, ends: Ends, party: &[usize]) -> Result<Cover> {
        let even = vec![Pace::default(); walls.iter().map(Vec::len).sum()];
        let mut hip = if ends == Ends::Hips { None } else { Some(Skeleton::new(walls, &even)?) };
        let mut party = party.to_vec();
        let mut over = self.over(walls, hip.as_ref(), ends, &party);
        let mut hipped = false;
        loop {
            let (outer, overhang) = self.outline(walls, &over);
            let paces = self.paces(&outer, &over, ends, overhang);
            let hips = overhang == 0.0 && over.iter().all(|over| *over == Over::Slope);
            // Without a gable and an overhang, the roof is the one that the gables were looked for in.
            let known = if hips { hip.take() } else { None };
            let skeleton = match known.map_or_else(|| Skeleton::new(&outer, &paces), Ok) {
                Ok(skeleton) => skeleton,
                Err(_) if !party.is_empty() => {
                    party.clear();
                    over = self.over(walls, hip.as_ref(), ends, &party);
                    continue;
                }
                Err(error) if over.iter().all(|over| *over == Over::Slope) => {
                    // What juts out may be harder than what stands below.
                    if overhang == 0.0 {
                        return Err(error);
                    }
                    let mut flush = Self { overhang: 0.0, ..*self }.sloped(walls, base, ends, &party)?;
                    flush.hipped |= hipped;
                    return Ok(flush);
                }
                Err(_) => {
                    over.fill(Over::Slope);
                    hipped = true;
                    continue;
                }
            };
            let astray: Vec<usize> =
                (0..over.len()).filter(|&edge| strays(&skeleton, edge, paces[edge])).collect();
            if !astray.is_empty() {
                let rows = party.len();
                party.retain(|edge| !astray.contains(edge));
                if party.len() < rows {
                    over = self.over(walls, hip.as_ref(), ends, &party);
                } else {
                    astray.into_iter().for_each(|edge| over[edge] = Over::Slope);
                    hipped = true;
                }
                continue;
            }
            let profile = Profile::new(self, skeleton.duration(), overhang);
            let rim = Rim { walls, outer: &outer, profile: &profile, base, overhang, slab: self.slab };
            let points = leveled(&skeleton, &paces, &profile);
            let rakes: Vec<Option<Rake>> = over
                .iter()
                .enumerate()
                .map(|(edge, over)| {
                    (*over == Over::Raked).then(|| rim.rake(edge, &skeleton, &points)).flatten()
                })
                .collect();
            let mut failed = false;
            for (over, rake) in over.iter_mut().zip(&rakes) {
                if *over == Over::Raked && rake.is_none() {
                    *over = Over::Flush;
                    failed = true;
                }
            }
            if failed {
                continue;
            }
            let mut patches = patches(&skeleton, &paces, &profile, base, points);
            patches.retain(|patch| patch.kind != PatchKind::Gable || rakes[patch.edge].is_none());
            rim.close(&mut patches, &rakes);
            return Ok(Cover { patches, overhang, hipped });
        }
    }

    /// What is to stand over each edge: `hip`, the hip roof, shows where gables may.
    fn over(&self, walls: &[Vec<DVec2>], hip: Option<&Skeleton>, ends: Ends, party: &[usize]) -> Vec<Over> {
        let mut over = vec![Over::Slope; walls.iter().map(Vec::len).sum()];
        for edge in party {
            over[*edge] = Over::Flush;
        }
        let raked = self.eaves == Eaves::Open && self.overhang > 0.0 && ends == Ends::Gables;
        let kind = if raked { Over::Raked } else { Over::Flush };
        for edge in hip.into_iter().flat_map(|hip| gables(walls, hip, party)) {
            over[edge] = kind;
        }
        over
    }

    /// How the edges move.
    fn paces(&self, outer: &[Vec<DVec2>], over: &[Over], ends: Ends, overhang: f64) -> Vec<Pace> {
        let mut paces = Vec::with_capacity(over.len());
        let beyond = if self.eaves == Eaves::Open { overhang } else { 0.0 };
        for ring in outer {
            let count = ring.len();
            for index in 0..count {
                let at = |offset: usize| ring[(index + count + offset - 1) % count];
                let [before, along, after] = [at(1) - at(0), at(2) - at(1), at(3) - at(2)];
                paces.push(match over[paces.len()] {
                    Over::Slope => Pace::default(),
                    _ if ends == Ends::DutchHips => {
                        // How much of the edge both neighbours use up while they move 1 m.
                        let used = |side: DVec2| side.length() * along.length() / side.perp_dot(along).abs();
                        let top = along.length() / (used(before) + used(after));
                        let rest = beyond + BELOW_HIP * (top - beyond).max(0.0);
                        // So that hips that begin nearly at once do so at once.
                        Pace { speed: 1.0, rest: (rest * 64.0).round() / 64.0 }
                    }
                    _ => Pace::STILL,
                });
            }
        }
        paces
    }

    /// A roof of one slope, highest over the longest edge and lowest at the place furthest from it.
    fn shed(&self, walls: &[Vec<DVec2>], base: f64) -> Cover {
        let fall = Fall::new(walls);
        let over: Vec<Over> = if self.eaves == Eaves::Open {
            vec![Over::Slope; walls.iter().map(Vec::len).sum()]
        } else {
            fall.eaves(walls).into_iter().map(|eaves| if eaves { Over::Slope } else { Over::Flush }).collect()
        };
        let (outer, overhang) = self.outline(walls, &over);
        let high = match self.rise {
            Rise::Height(height) => height,
            // As high as a gable roof of this slope would be.
            Rise::Slope(slope) => {
                let hip = Skeleton::new(walls, &vec![Pace::default(); over.len()]);
                let half = fall.length() / 2.0;
                slope * hip.map_or(half, |hip| hip.duration()).min(half)
            }
        };
        let patches = super::shed::patches(self, &fall, walls, &outer, base, overhang, high);
        Cover { patches, overhang, hipped: false }
    }
}

/// Whether the face over an edge that stands still goes on beyond the edge's ends.
fn strays(skeleton: &Skeleton, edge: usize, pace: Pace) -> bool {
    if pace.moves() {
        return false;
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
fn gables(rings: &[Vec<DVec2>], hip: &Skeleton, already: &[usize]) -> Vec<usize> {
    let mut candidates: Vec<(f64, usize, [usize; 2])> = Vec::new();
    let mut first = 0;
    for ring in rings {
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
pub(crate) fn floor(rings: &[Vec<DVec2>], base: f64) -> Vec<Vec<DVec3>> {
    rings.iter().map(|ring| ring.iter().rev().map(|at| at.extend(base)).collect()).collect()
}
