//! Meetings: edges that meet in a point are cut there and paired again.

use std::cmp::Ordering;

use super::edge::Direction;
use super::lines::{EventTime, FINE, LineMeeting};
use super::skeleton::Peak;
use super::wavefront::{ANY, CornerKind, EventPoint, Wavefront, WavefrontCorner};
use burgeon_base::error::{Error, Result};

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

    /// Ends rings of two new corners, which enclose no area.
    fn close(&mut self, fresh: &[usize], when: &mut EventTime) {
        for &index in fresh {
            let WavefrontCorner { alive, before, after, .. } = self.corners[index];
            if !alive {
                continue;
            }
            if after == index {
                self.end(index, self.corners[index].peak);
            } else if after == before {
                let mut peak = self.corners[after].peak;
                if self.lines.compare(&mut self.corners[after].born, when) == Ordering::Less {
                    peak = self.traced.peaks.len();
                    let mut place = self.place(after, when);
                    self.lines.settle_place(&mut place, when);
                    let at = place.at;
                    self.traced.peaks.push(Peak { at, time: when.time });
                }
                self.end(after, peak);
                self.end(index, peak);
            }
        }
    }

    /// Lets new rushing corners meet the ends of the segments that they jump to.
    fn rush(&mut self, fresh: &[usize], when: &mut EventTime) {
        self.spots.clear();
        for &index in fresh {
            let WavefrontCorner { alive, kind, before, after, lines, .. } = self.corners[index];
            if !alive || kind != CornerKind::Rushing {
                continue;
            }
            let [mut low, mut high] = [before, after];
            let [a, b] = lines.map(|line| self.lines.line(line).speed);
            if self.lines.direction(lines[0]).agrees(self.lines.direction(lines[1])) {
                // The faster edge sweeps the area behind the slower edge.
                if a < b {
                    high = low;
                } else {
                    low = high;
                }
            } else {
                let places = [low, high].map(|end| self.place(end, when));
                // Both ends are in the direction of the second edge; the corner meets the nearer end.
                match self.lines.compare_along(lines[1], &places[0], &places[1], when) {
                    Ordering::Less => high = low,
                    Ordering::Greater => low = high,
                    Ordering::Equal => {}
                }
            }
            for end in [low, high] {
                let place = self.place(end, when);
                let [own, other] = [self.spot(index, place), self.spot(end, place)];
                self.join(own, other);
            }
        }
    }

    /// Predicts the events of new corners.
    fn go_on(&mut self, fresh: &[usize]) {
        if self.corners.len() > self.known + self.current.len() / 2 {
            self.known = self.corners.len();
            self.current.retain(|edge| self.alive[edge] > 0);
        }
        for &index in fresh {
            let WavefrontCorner { alive, before, after, .. } = self.corners[index];
            if alive {
                self.expect_collapse(before, index);
                // If the next corner is new as well, its own iteration predicts the edge before it.
                if after < fresh[0] {
                    self.expect_collapse(index, after);
                }
            }
        }
        for &index in fresh {
            let WavefrontCorner { alive, before, after, .. } = self.corners[index];
            if alive {
                self.expect_split(index, ANY);
                for beside in [before, after] {
                    self.expect_later_split(beside);
                }
            }
        }
    }

    /// Predicts the events of all old corners again, because edges have started to move.
    fn look_again(&mut self) {
        for index in 0..self.corners.len() {
            if self.corners[index].alive {
                self.expect_split(index, ANY);
            }
        }
    }
}
