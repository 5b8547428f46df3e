//! What meets in a place is cut there and paired anew.

use std::cmp::Ordering;

use super::Peak;
use super::edge::Direction;
use super::lines::{EventTime, FINE, LineMeeting};
use super::wavefront::Wavefront;
use burgeon_base::error::{Error, Result};

/// A corner, or a point of an edge (by the corner where the piece of the edge begins), that an event moves.
#[derive(Debug, Clone, Copy)]
pub(super) struct EventPoint {
    corner: usize,
    cut: bool,
    place: LineMeeting,
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
struct EdgePiece {
    edge: usize,
    ends: [End; 2],
}

/// Lists that are empty between two meetings, and keep their memory.
#[derive(Debug, Default)]
pub(super) struct MeetingLists {
    /// The spots from left to right.
    order: Vec<usize>,
    places: Vec<LineMeeting>,
    /// The corners where pieces of edges begin.
    begins: Vec<usize>,
    /// What meets on an edge, by the corner where its piece begins, and the numbers of the meetings.
    cuts: Vec<(usize, LineMeeting, usize)>,
    pieces: Vec<EdgePiece>,
    rays: Vec<Ray>,
    /// The new corners.
    fresh: Vec<usize>,
}

/// An end of a piece, as seen from the place where it meets others.
#[derive(Debug, Clone, Copy)]
struct Ray {
    meeting: usize,
    direction: Direction,
    leaves: bool,
    piece: usize,
}

impl Wavefront {
    /// The spot of a corner.
    pub(super) fn spot(&mut self, corner: usize, place: LineMeeting) -> usize {
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

    /// A new spot on the piece of an edge that begins at a corner.
    pub(super) fn spot_between(&mut self, corner: usize, place: LineMeeting) -> usize {
        self.add_spot(corner, true, place)
    }

    fn add_spot(&mut self, corner: usize, cut: bool, place: LineMeeting) -> usize {
        let leader = self.spots.len();
        self.spots.push(EventPoint { corner, cut, place, leader, meeting: 0 });
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

    /// Makes the new wavefront of what the spots' corners and edges meet, until nothing more happens at this time.
    pub(super) fn resolve(&mut self, lists: &mut MeetingLists, when: &mut EventTime) -> Result<()> {
        self.lines.settle(when, FINE);
        self.last = Some(*when);
        self.now = when.low();
        for _ in 0..=self.corners.len() {
            self.pair_anew(lists, when)?;
            self.close(&lists.fresh, when);
            self.rush(&lists.fresh, when);
            self.go_on(&lists.fresh);
            if self.spots.is_empty() {
                if std::mem::take(&mut self.restarted) {
                    self.look_again();
                }
                return Ok(());
            }
        }
        Err(Error::geometry("edges in one line do not come to rest"))
    }

    /// Cuts what meets and pairs it anew in new corners.
    fn pair_anew(&mut self, lists: &mut MeetingLists, when: &mut EventTime) -> Result<()> {
        self.join_same(&mut lists.order, when);
        let first_peak = self.traced.peaks.len();
        self.number_meetings(&mut lists.places, when);
        self.cut(lists, when);
        let MeetingLists { places, pieces, rays, fresh, .. } = lists;
        for index in 0..self.spots.len() {
            let spot = self.spots[index];
            if !spot.cut {
                self.end(spot.corner, first_peak + spot.meeting);
            }
        }
        rays.clear();
        for (index, piece) in pieces.iter().enumerate() {
            let direction = self.lines.direction(piece.edge);
            if let End::Meeting(meeting) = piece.ends[0] {
                rays.push(Ray { meeting, direction, leaves: true, piece: index });
            }
            if let End::Meeting(meeting) = piece.ends[1] {
                rays.push(Ray { meeting, direction: direction.reversed(), leaves: false, piece: index });
            }
        }
        rays.sort_by_key(|ray| ray.meeting);
        fresh.clear();
        for rays in rays.chunk_by_mut(|a, b| a.meeting == b.meeting) {
            // Between two edges that lie on each other is what they have swept, never what is outside.
            rays.sort_by(|a, b| a.direction.compare(b.direction).then(b.leaves.cmp(&a.leaves)));
            let next = |index: usize| &rays[(index + 1) % rays.len()];
            if (0..rays.len()).any(|index| rays[index].leaves == next(index).leaves) {
                return Err(Error::geometry("the edges that meet in a place do not enclose areas"));
            }
            // Each that leaves is followed by the one that arrives across the area between them, counter-clockwise.
            for (number, ray) in rays.iter().enumerate().filter(|(_, ray)| ray.leaves) {
                let arriving = next(number).piece;
                let edges = [pieces[arriving].edge, pieces[ray.piece].edge];
                let corner = self.corner(edges, first_peak + ray.meeting, &places[ray.meeting], when);
                pieces[arriving].ends[1] = End::Corner(corner);
                pieces[ray.piece].ends[0] = End::Corner(corner);
                fresh.push(corner);
            }
        }
        for piece in pieces.iter() {
            if let [End::Corner(a), End::Corner(b)] = piece.ends {
                self.corners[a].after = b;
                self.corners[b].before = a;
            }
        }
        Ok(())
    }

    /// Joins the spots whose places are one.
    fn join_same(&mut self, order: &mut Vec<usize>, when: &mut EventTime) {
        if (1..self.spots.len()).all(|spot| self.leader(spot) == 0) {
            return;
        }
        order.clear();
        order.extend(0..self.spots.len());
        let low = |spot: &EventPoint| spot.place.at.x - spot.place.slack;
        order.sort_by(|&a, &b| low(&self.spots[a]).total_cmp(&low(&self.spots[b])));
        for (rank, &a) in order.iter().enumerate() {
            let place = self.spots[a].place;
            for &b in &order[rank + 1..] {
                let other = self.spots[b].place;
                if other.at.x - other.slack > place.at.x + place.slack {
                    break;
                }
                if self.leader(a) != self.leader(b) && self.lines.is_one(&place, &other, when) {
                    self.join(a, b);
                }
            }
        }
    }

    /// Numbers the meetings, from 0, and adds a peak for each, in their order; their places.
    fn number_meetings(&mut self, places: &mut Vec<LineMeeting>, when: &mut EventTime) {
        places.clear();
        for index in 0..self.spots.len() {
            let leader = self.leader(index);
            if leader == index {
                let mut place = self.spots[index].place;
                self.lines.settle_place(&mut place, when);
                self.spots[index].meeting = places.len();
                self.traced.peaks.push(Peak { at: place.at, time: when.time });
                places.push(place);
            } else {
                self.spots[index].meeting = self.spots[leader].meeting;
            }
        }
    }

    /// Finds the pieces of edges that the spots touch, cut there.
    fn cut(&mut self, lists: &mut MeetingLists, when: &mut EventTime) {
        let MeetingLists { begins, cuts, pieces, .. } = lists;
        begins.clear();
        cuts.clear();
        pieces.clear();
        for index in 0..self.spots.len() {
            let EventPoint { corner, cut, place, meeting, .. } = self.spots[index];
            begins.push(corner);
            if !cut {
                begins.push(self.corners[corner].before);
                continue;
            }
            let line = self.traced.edges[self.corners[corner].edges[1]].line;
            let mut rank = cuts.len();
            while rank > 0 {
                let (other, there, _) = &cuts[rank - 1];
                let mut follows = || self.lines.compare_along(line, there, &place, when) != Ordering::Greater;
                if *other < corner || (*other == corner && follows()) {
                    break;
                }
                rank -= 1;
            }
            cuts.insert(rank, (corner, place, meeting));
        }
        begins.sort_unstable();
        begins.dedup();
        let end = |corner: usize| match self.spot_of(corner) {
            Some(spot) => End::Meeting(self.spots[spot].meeting),
            None => End::Corner(corner),
        };
        for &from in begins.iter() {
            let corner = &self.corners[from];
            let mut last = end(from);
            let mut add = |next: End| {
                if next != last || matches!(next, End::Corner(_)) {
                    pieces.push(EdgePiece { edge: corner.edges[1], ends: [last, next] });
                }
                last = next;
            };
            let between = cuts.partition_point(|cut| cut.0 < from)..cuts.partition_point(|cut| cut.0 <= from);
            cuts[between].iter().for_each(|cut| add(End::Meeting(cut.2)));
            add(end(corner.after));
        }
    }
}
