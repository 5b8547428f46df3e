//! Contacts: the intersections of the edges of two geometries.

use std::cmp::Ordering;

use glam::DVec2;

use super::edges::{DirectedEdge, WayEdges};
use super::locate::{begins_inside, is_between, is_on, place_in, side};

/// A point where an edge of one geometry meets an edge of the other.
#[derive(Debug, Clone, Copy)]
struct Contact {
    /// Edge of each geometry.
    edges: [usize; 2],
    place: DVec2,
}

/// A part that an edge of one geometry shares with an edge of the other.
#[derive(Debug, Clone, Copy)]
struct SharedPart {
    edges: [usize; 2],
    ends: [DVec2; 2],
}

/// All contacts of two geometries.
#[derive(Debug, Default)]
pub(crate) struct Contacts {
    /// Edges of each geometry that cross in their interiors, where neither geometry has a corner.
    crossings: Vec<[usize; 2]>,
    /// Presence of shared parts with the same direction, and with opposite directions.
    pub(crate) shares: [bool; 2],
    contacts: Vec<Contact>,
    parts: Vec<SharedPart>,
}

/// Positions of a geometry's edges relative to areas: inside, outside, or neither if they lie on the border.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct WalkSides {
    pub(crate) inside: bool,
    pub(crate) outside: bool,
}

impl WalkSides {
    /// Edges on both sides.
    pub(crate) const BOTH: Self = Self { inside: true, outside: true };
}

impl Contacts {
    /// Computes the contacts of two geometries with these bounds and edges; with `until_crossing`, it stops
    /// at the first crossing.
    pub(crate) fn new(
        (one, first): (Option<[DVec2; 2]>, &WayEdges),
        (two, second): (Option<[DVec2; 2]>, &WayEdges),
        until_crossing: bool,
    ) -> Self {
        let mut made = Self::default();
        let (Some([a, b]), Some([c, d])) = (one, two) else { return made };
        let (low, high) = (a.max(c), b.min(d));
        if !low.cmple(high).all() {
            return made;
        }
        let mut near: Vec<(usize, DirectedEdge)> = Vec::new();
        let turned = first.edges.len() > second.edges.len();
        let (few, many) = if turned { (second, first) } else { (first, second) };
        few.meeting(low, high, |number, edge| near.push((number, *edge)));
        near.sort_unstable_by_key(|(number, _)| *number);
        for (number, edge) in near {
            many.meeting(edge.low(), edge.high(), |other, found| {
                if turned {
                    made.meet([other, number], [found, &edge], [first, second]);
                } else {
                    made.meet([number, other], [&edge, found], [first, second]);
                }
            });
            if made.cross() && until_crossing {
                return made;
            }
        }
        made
    }

    /// Returns true if there are no contacts.
    pub(crate) fn is_empty(&self) -> bool {
        !self.cross() && self.contacts.is_empty()
    }

    /// Returns true if edges cross in their interiors.
    pub(crate) fn cross(&self) -> bool {
        !self.crossings.is_empty()
    }

    /// Returns true if edges share a part.
    pub(crate) fn has_shared(&self) -> bool {
        self.shares != [false; 2]
    }

    /// Returns the points where ends of edges meet the other geometry.
    pub(crate) fn places(&self) -> impl Iterator<Item = DVec2> + '_ {
        self.contacts.iter().map(|contact| contact.place)
    }

    /// Records the contacts of an edge of the first geometry and an edge of the second.
    fn meet(&mut self, edges: [usize; 2], [e, f]: [&DirectedEdge; 2], geometries: [&WayEdges; 2]) {
        let [p, q] = [side(f.from, f.to, e.from), side(f.from, f.to, e.to)];
        if p == q && p != Ordering::Equal {
            return;
        }
        let [r, s] = [side(e.from, e.to, f.from), side(e.from, e.to, f.to)];
        if r == s && r != Ordering::Equal {
            return;
        }
        if p == Ordering::Equal && q == Ordering::Equal {
            return self.meet_along(edges, e, f);
        }
        let ends = [(p, e.from, f), (q, e.to, f), (r, f.from, e), (s, f.to, e)];
        let mut on = ends.into_iter().filter(|(side, ..)| *side == Ordering::Equal).peekable();
        if on.peek().is_none() {
            match corner_on(e, f, geometries) {
                Some(place) => self.contacts.push(Contact { edges, place }),
                None => self.crossings.push(edges),
            }
        } else if let Some((_, place, _)) = on.find(|(_, place, edge)| is_between(edge, *place)) {
            self.contacts.push(Contact { edges, place });
        }
    }

    /// Records the contacts of two collinear edges.
    fn meet_along(&mut self, edges: [usize; 2], e: &DirectedEdge, f: &DirectedEdge) {
        let order = |a: &DVec2, b: &DVec2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
        let sorted = |edge: &DirectedEdge| match order(&edge.from, &edge.to) {
            Ordering::Greater => [edge.to, edge.from],
            _ => [edge.from, edge.to],
        };
        let ([a, b], [c, d]) = (sorted(e), sorted(f));
        let later = if order(&a, &c) == Ordering::Less { c } else { a };
        let sooner = if order(&b, &d) == Ordering::Greater { d } else { b };
        if later == sooner {
            self.contacts.push(Contact { edges, place: later });
        } else if order(&later, &sooner) == Ordering::Less {
            self.contacts.extend([later, sooner].map(|place| Contact { edges, place }));
            self.parts.push(SharedPart { edges, ends: [later, sooner] });
            let is_same = (order(&e.from, &e.to)) == order(&f.from, &f.to);
            self.shares[usize::from(!is_same)] = true;
        }
    }

    /// Returns the contacts, sorted by the edges of the first (0) or the second (1) geometry.
    pub(crate) fn of(&self, geometry: usize) -> SortedContacts<'_> {
        let mut contacts: Vec<&Contact> = self.contacts.iter().collect();
        contacts.sort_by_key(|contact| contact.edges[geometry]);
        let mut parts: Vec<&SharedPart> = self.parts.iter().collect();
        parts.sort_by_key(|part| part.edges[geometry]);
        SortedContacts { geometry, contacts, parts }
    }
}

/// Returns the corner or line end of either geometry at the crossing of two edges. There a geometry touches
/// itself, and the sides of an edge differ before and after the crossing.
fn corner_on(e: &DirectedEdge, f: &DirectedEdge, geometries: [&WayEdges; 2]) -> Option<DVec2> {
    let (low, high) = (e.low().max(f.low()), e.high().min(f.high()));
    let mut found = None;
    for edges in geometries {
        edges.meeting(low, high, |_, edge| {
            found =
                found.or([edge.from, edge.to].into_iter().find(|place| is_on(e, *place) && is_on(f, *place)));
        });
    }
    found
}

/// Contacts, sorted by the edges of one geometry.
pub(crate) struct SortedContacts<'a> {
    geometry: usize,
    contacts: Vec<&'a Contact>,
    parts: Vec<&'a SharedPart>,
}

impl SortedContacts<'_> {
    fn on(&self, edge: usize) -> &[&Contact] {
        let begin = self.contacts.partition_point(|it| it.edges[self.geometry] < edge);
        let count = self.contacts[begin..].partition_point(|it| it.edges[self.geometry] == edge);
        &self.contacts[begin..begin + count]
    }

    /// Returns true if the other geometry shares a piece of an edge.
    fn has(&self, edge: usize, piece: [DVec2; 2]) -> bool {
        let begin = self.parts.partition_point(|it| it.edges[self.geometry] < edge);
        let parts = self.parts[begin..].iter().take_while(|it| it.edges[self.geometry] == edge);
        parts.into_iter().any(|part| {
            let [from, to] = part.ends;
            piece.iter().all(|end| is_between(&DirectedEdge { from, to }, *end))
        })
    }

    /// Returns the pieces into which contacts divide an edge.
    fn pieces(&self, number: usize, edge: &DirectedEdge) -> Vec<[DVec2; 2]> {
        let mut stops: Vec<DVec2> = self.on(number).iter().map(|contact| contact.place).collect();
        stops.extend([edge.from, edge.to]);
        // All points are collinear.
        stops.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        stops.dedup();
        if stops.first() != Some(&edge.from) {
            stops.reverse();
        }
        stops.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    }

    /// Returns true if a part of the edges does not belong to the other geometry.
    pub(crate) fn has_own(&self, edges: &WayEdges) -> bool {
        edges.edges.iter().enumerate().any(|(number, edge)| {
            self.on(number).len() < 2
                || self.pieces(number, edge).into_iter().any(|piece| !self.has(number, piece))
        })
    }

    /// Determines on which sides of the other geometry's border the edges lie; the edges do not cross it in
    /// their interiors.
    pub(crate) fn walk(&self, edges: &WayEdges, areas: &WayEdges) -> WalkSides {
        let mut sides = WalkSides::default();
        for way in edges.ways() {
            // Side of the last piece, if no contact followed.
            let mut known = None;
            for number in way {
                let edge = &edges.edges[number];
                let contacts = self.on(number);
                let pieces =
                    if contacts.is_empty() { vec![[edge.from, edge.to]] } else { self.pieces(number, edge) };
                for [from, to] in pieces {
                    let mut here = contacts.iter().filter(|contact| contact.place == from).peekable();
                    let meets = here.peek().is_some();
                    if meets && self.has(number, [from, to]) {
                        continue;
                    }
                    let other = 1 - self.geometry;
                    let is_inside = match known.filter(|_| !meets) {
                        Some(known) => known,
                        None if meets => {
                            begins_inside(here.map(|contact| areas.edges[contact.edges[other]]), from, to)
                        }
                        None => place_in(areas, from) == Ordering::Greater,
                    };
                    sides.inside |= is_inside;
                    sides.outside |= !is_inside;
                    known = Some(is_inside);
                }
            }
            if sides.inside && sides.outside {
                break;
            }
        }
        sides
    }
}
