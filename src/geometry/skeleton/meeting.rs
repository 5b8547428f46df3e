//! What meets in a place is cut there and paired anew.

use glam::DVec2;
use smallvec::SmallVec;

use super::Peak;
use super::edge::Direction;
use super::wavefront::{ALIGNED, NEAR, Wavefront};
use crate::error::{Error, Result};

/// Places further (m) from each other than this are not one, even where a corner is at both almost at once.
const APART: f64 = 1e-4;

/// A list that is short almost always.
type Few<T> = SmallVec<[T; 12]>;

/// A corner, or a point of an edge (by the corner where the piece of the edge begins), that an event moves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    corner: usize,
    cut: bool,
    place: DVec2,
    /// The spot that stands for all at its place.
    leader: usize,
    /// The number of the meeting that it takes part in, once it is known.
    meeting: usize,
}

/// Where a piece of an edge ends: at a corner that stays, or at what meets in a place.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    Corner(usize),
    Meeting(usize),
}

#[derive(Debug, Clone, Copy)]
struct Piece {
    edge: usize,
    ends: [End; 2],
}

/// An end of a piece, as seen from the place where it meets others.
#[derive(Debug, Clone, Copy)]
struct Ray {
    meeting: usize,
    direction: Direction,
    along: DVec2,
    leaves: bool,
    piece: usize,
}

impl Wavefront {
    /// The spot of a corner.
    pub(super) fn spot(&mut self, corner: usize, place: DVec2) -> usize {
        if let Some(known) = self.spot_of(corner) {
            return known;
        }
        self.corners[corner].spot = self.spots.len();
        self.add_spot(corner, false, place)
    }

    fn spot_of(&self, corner: usize) -> Option<usize> {
        let known = self.corners[corner].spot;
        self.spots.get(known).filter(|spot| spot.corner == corner && !spot.cut).map(|_| known)
    }

    /// Whether a corner is at `place` as far as is known: fast corners come by several places almost at once.
    pub(super) fn may_be_at(&self, corner: usize, place: DVec2) -> bool {
        self.spot_of(corner).is_none_or(|spot| self.spots[spot].place.distance(place) <= APART)
    }

    /// A new spot on the piece of an edge that begins at a corner.
    pub(super) fn spot_between(&mut self, corner: usize, place: DVec2) -> usize {
        self.add_spot(corner, true, place)
    }

    fn add_spot(&mut self, corner: usize, cut: bool, place: DVec2) -> usize {
        let leader = self.spots.len();
        self.spots.push(Spot { corner, cut, place, leader, meeting: 0 });
        leader
    }

    fn leader(&self, mut spot: usize) -> usize {
        while self.spots[spot].leader != spot {
            spot = self.spots[spot].leader;
        }
        spot
    }

    pub(super) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.leader(a), self.leader(b));
        self.spots[a.max(b)].leader = a.min(b);
    }

    /// Makes the new wavefront of what the spots' corners and edges meet.
    pub(super) fn resolve(&mut self, time: f64) -> Result<()> {
        self.join_near();
        let first_peak = self.traced.peaks.len();
        self.number_meetings(time);
        let mut pieces = self.cut();
        for index in 0..self.spots.len() {
            let spot = self.spots[index];
            if !spot.cut {
                self.end(spot.corner, first_peak + spot.meeting);
            }
        }
        let mut rays: Few<Ray> = Few::new();
        for (index, piece) in pieces.iter().enumerate() {
            let (along, direction) = (self.traced.edges[piece.edge].along, self.directions[piece.edge]);
            if let End::Meeting(meeting) = piece.ends[0] {
                rays.push(Ray { meeting, direction, along, leaves: true, piece: index });
            }
            if let End::Meeting(meeting) = piece.ends[1] {
                let direction = direction.reversed();
                rays.push(Ray { meeting, direction, along: -along, leaves: false, piece: index });
            }
        }
        rays.sort_by(|a, b| a.meeting.cmp(&b.meeting).then_with(|| a.direction.compare(b.direction)));
        let mut fresh: Few<usize> = Few::new();
        for rays in rays.chunk_by_mut(|a, b| a.meeting == b.meeting) {
            pair(rays)?;
            for (number, ray) in rays.iter().enumerate().filter(|(_, ray)| ray.leaves) {
                let arriving = rays[(number + 1) % rays.len()].piece;
                let edges = [pieces[arriving].edge, pieces[ray.piece].edge];
                let peak = first_peak + ray.meeting;
                let corner = self.corner(edges, peak, self.traced.peaks[peak].at, time)?;
                pieces[arriving].ends[1] = End::Corner(corner);
                pieces[ray.piece].ends[0] = End::Corner(corner);
                fresh.push(corner);
            }
        }
        for piece in &pieces {
            if let [End::Corner(a), End::Corner(b)] = piece.ends {
                self.corners[a].after = b;
                self.corners[b].before = a;
            }
        }
        self.go_on(&fresh, time);
        Ok(())
    }

    /// Joins the spots whose places are one.
    fn join_near(&mut self) {
        let mut order: Few<usize> = (0..self.spots.len()).collect();
        order.sort_by(|&a, &b| self.spots[a].place.x.total_cmp(&self.spots[b].place.x));
        for (rank, &a) in order.iter().enumerate() {
            for &b in &order[rank + 1..] {
                if self.spots[b].place.x - self.spots[a].place.x > NEAR {
                    break;
                }
                if self.spots[a].place.distance(self.spots[b].place) <= NEAR {
                    self.join(a, b);
                }
            }
        }
    }

    /// Numbers the meetings, from 0, and adds a peak for each, in their order.
    fn number_meetings(&mut self, time: f64) {
        let mut count = 0;
        for index in 0..self.spots.len() {
            let leader = self.leader(index);
            if leader == index {
                self.spots[index].meeting = count;
                self.traced.peaks.push(Peak { at: self.spots[index].place, time });
                count += 1;
            } else {
                self.spots[index].meeting = self.spots[leader].meeting;
            }
        }
    }

    /// The pieces of edges that the spots touch, cut there.
    fn cut(&self) -> Few<Piece> {
        // Where pieces begin, and the meetings on them by their distance along.
        let mut begins: Few<usize> = Few::new();
        let mut whole: Few<(usize, usize)> = Few::new();
        let mut cuts: Few<(usize, f64, usize)> = Few::new();
        for spot in &self.spots {
            begins.push(spot.corner);
            if spot.cut {
                let along = self.traced.edges[self.corners[spot.corner].edges[1]].along;
                cuts.push((spot.corner, spot.place.dot(along), spot.meeting));
            } else {
                begins.push(self.corners[spot.corner].before);
                whole.push((spot.corner, spot.meeting));
            }
        }
        begins.sort_unstable();
        begins.dedup();
        whole.sort_unstable();
        cuts.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let end = |corner: usize| match whole.binary_search_by_key(&corner, |entry| entry.0) {
            Ok(found) => End::Meeting(whole[found].1),
            Err(_) => End::Corner(corner),
        };
        let mut pieces = Few::new();
        for &from in &begins {
            let corner = &self.corners[from];
            let mut last = end(from);
            let between = cuts.partition_point(|cut| cut.0 < from)..cuts.partition_point(|cut| cut.0 <= from);
            let between = cuts[between].iter().map(|cut| End::Meeting(cut.2));
            for next in between.chain([end(corner.after)]) {
                if next != last || matches!(next, End::Corner(_)) {
                    pieces.push(Piece { edge: corner.edges[1], ends: [last, next] });
                }
                last = next;
            }
        }
        pieces
    }
}

/// Orders the rays around a place, which are sorted by their angle, so that each that leaves is followed by the
/// one that arrives across the area between them, counter-clockwise.
fn pair(rays: &mut [Ray]) -> Result<()> {
    let count = rays.len();
    for index in 0..count {
        let [before, next, behind] = [index, (index + 1) % count, (index + 2) % count];
        // Which of two edges that lie on each other comes first is settled by those around them.
        let (a, b) = (rays[next].along, rays[behind].along);
        let aligned = a.dot(b) > 0.0 && a.perp_dot(b).abs() < ALIGNED;
        let odd = rays[before].leaves == rays[next].leaves && rays[next].leaves != rays[behind].leaves;
        if aligned && odd {
            rays.swap(next, behind);
        }
    }
    let alternate = (0..count).all(|index| rays[index].leaves != rays[(index + 1) % count].leaves);
    if alternate { Ok(()) } else { Err(Error::new("the edges that meet in a place do not enclose areas")) }
}
