//! Meetings: edges that meet in a point are cut there and paired again.

use std::cmp::Ordering;

use super::Peak;
use super::edge::Direction;
use super::lines::{EventTime, FINE, LineMeeting};
use super::wavefront::Wavefront;
use burgeon_base::error::{Error, Result};

/// A corner that an event moves, or a point of an edge (identified by the corner at the start of the edge's
/// segment).
#[derive(Debug, Clone, Copy)]
pub(super) struct EventPoint {
    corner: usize,
    cut: bool,
    place: LineMeeting,
    /// Representative of all spots at the same position.
    leader: usize,
    /// Index of its meeting, once it is assigned.
    meeting: usize,
}

/// End of a segment of an edge: a corner that stays, or a meeting.
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

/// Reusable lists, empty between two meetings.
#[derive(Debug, Default)]
pub(super) struct MeetingLists {
    /// Spots from left to right.
    order: Vec<usize>,
    places: Vec<LineMeeting>,
    /// Corners at the start of segments of edges.
    begins: Vec<usize>,
    /// Meetings within an edge: the corner at the start of the segment, the position, and the index of the
    /// meeting.
    cuts: Vec<(usize, LineMeeting, usize)>,
    pieces: Vec<EdgePiece>,
    rays: Vec<Ray>,
    /// New corners.
    fresh: Vec<usize>,
}

/// End of a segment, seen from its meeting.
#[derive(Debug, Clone, Copy)]
struct Ray {
    meeting: usize,
    direction: Direction,
    leaves: bool,
    piece: usize,
}

impl Wavefront {
    /// Returns the spot of a corner; adds it if necessary.
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

    /// Adds a spot on the segment of an edge that begins at a corner.
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

    /// Computes the new wavefront at the spots, until nothing more happens at this time.
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

    /// Cuts the edges at the meetings, and pairs them again in new corners.
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
            // Between two overlapping edges lies the area that they have swept, never the outside.
            rays.sort_by(|a, b| a.direction.compare(b.direction).then(b.leaves.cmp(&a.leaves)));
            let next = |index: usize| &rays[(index + 1) % rays.len()];
            if (0..rays.len()).any(|index| rays[index].leaves == next(index).leaves) {
                return Err(Error::geometry("the edges that meet in a place do not enclose areas"));
            }
            // Each leaving edge is followed, counter-clockwise across the area between them, by the arriving
            // edge.
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

    /// Joins the spots at equal positions.
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

    /// Numbers the meetings from 0, adds a peak for each, in order, and stores their positions in `places`.
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

    /// Finds the segments of edges that the spots touch, and cuts them there.
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
