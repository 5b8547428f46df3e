//! Path data of lines and of unions of faces.

use super::faces::{PaperPoint, VisibleFaces};

/// Returns the boundary of the union of the faces with these indices, as path data in metres with y downwards.
///
/// A side between two of the faces is traversed once in each direction, which cancels out. The remaining sides form
/// rings with unchanged winding numbers.
pub(super) fn filled_outline(faces: &VisibleFaces, indices: &[u32]) -> String {
    let mut sides: Vec<(PaperPoint, PaperPoint, i32)> = Vec::with_capacity(indices.len() * 3);
    for index in indices {
        let [a, b, c] = faces.faces[*index as usize].corners;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            sides.push(if from < to { (from, to, 1) } else { (to, from, -1) });
        }
    }
    sides.sort_unstable();
    let mut left = Vec::new();
    for same in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let balance: i32 = same.iter().map(|side| side.2).sum();
        let (low, high, _) = same[0];
        let side = if balance > 0 { [low, high] } else { [high, low] };
        left.extend(std::iter::repeat_n(side, balance.unsigned_abs() as usize));
    }
    path(&chain(left))
}

/// Returns lines between these end points, as path data.
pub(super) fn lines(ends: Vec<[PaperPoint; 2]>) -> String {
    path(&chain(ends))
}

/// Joins `sides` end to start into chains as long as possible; a ring ends where it begins.
fn chain(mut sides: Vec<[PaperPoint; 2]>) -> Vec<Vec<PaperPoint>> {
    sides.sort_unstable();
    let mut used = vec![false; sides.len()];
    let mut chains = Vec::new();
    // For each start of a run of equal points in `sides`, a number of sides known to be used. It keeps the search
    // short.
    let mut skip = vec![0; sides.len()];
    for first in 0..sides.len() {
        if used[first] {
            continue;
        }
        used[first] = true;
        let [start, mut at] = sides[first];
        let mut points = vec![start, at];
        while at != start {
            let block = sides.partition_point(|side| side[0] < at);
            let mut next = block + skip.get(block).copied().unwrap_or(0);
            while next < sides.len() && used[next] && sides[next][0] == at {
                next += 1;
            }
            if next >= sides.len() || sides[next][0] != at {
                break;
            }
            skip[block] = next + 1 - block;
            used[next] = true;
            at = sides[next][1];
            points.push(at);
        }
        chains.push(straighten(points));
    }
    chains
}

/// Removes the points in the interior of straight lines.
fn straighten(points: Vec<PaperPoint>) -> Vec<PaperPoint> {
    let mut kept: Vec<PaperPoint> = Vec::with_capacity(points.len());
    for point in points {
        if let [.., a, b] = kept[..]
            && is_straight(a, b, point)
        {
            kept.pop();
        }
        kept.push(point);
    }
    let ring = kept.len() > 3 && kept.first() == kept.last();
    if ring && is_straight(kept[kept.len() - 2], kept[0], kept[1]) {
        kept.pop();
        kept.remove(0);
        kept.push(kept[0]);
    }
    kept
}

/// Returns true if `b` is between `a` and `c` on the line through them.
fn is_straight(a: PaperPoint, b: PaperPoint, c: PaperPoint) -> bool {
    let side = |from: PaperPoint, to: PaperPoint| [i128::from(to[0] - from[0]), i128::from(to[1] - from[1])];
    let (ab, bc) = (side(a, b), side(b, c));
    ab[0] * bc[1] == ab[1] * bc[0] && ab[0] * bc[0] + ab[1] * bc[1] > 0
}

/// Returns path data with the first point of each chain as absolute and the others as relative coordinates.
fn path(chains: &[Vec<PaperPoint>]) -> String {
    let mut out = String::new();
    for chain in chains {
        let (Some(first), Some(last)) = (chain.first(), chain.last()) else { continue };
        let is_ring = first == last;
        out.push('M');
        number(first[0], &mut out);
        push_spaced(-first[1], &mut out);
        let mut at = *first;
        let steps = if is_ring { &chain[1..chain.len() - 1] } else { &chain[1..] };
        for (i, point) in steps.iter().enumerate() {
            if i == 0 {
                out.push('l');
                number(point[0] - at[0], &mut out);
            } else {
                push_spaced(point[0] - at[0], &mut out);
            }
            push_spaced(at[1] - point[1], &mut out);
            at = *point;
        }
        if is_ring {
            out.push('z');
        }
    }
    out
}

/// Appends a number after another one; a minus sign also serves as the separator.
fn push_spaced(millimetres: i64, out: &mut String) {
    if millimetres >= 0 {
        out.push(' ');
    }
    number(millimetres, out);
}

/// Appends a length in metres, as short as possible.
fn number(millimetres: i64, out: &mut String) {
    let (whole, rest) = (millimetres.unsigned_abs() / 1000, millimetres.unsigned_abs() % 1000);
    if millimetres < 0 {
        out.push('-');
    }
    if whole > 0 || rest == 0 {
        out.push_str(&whole.to_string());
    }
    if rest > 0 {
        out.push_str(format!(".{rest:03}").trim_end_matches('0'));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_as_short_as_it_goes() {
        let text = |number_: i64| {
            let mut out = String::new();
            number(number_, &mut out);
            out
        };
        assert_eq!([0, 1, -20, 500, -12_340, 7000].map(text), ["0", ".001", "-.02", ".5", "-12.34", "7"]);
    }

    #[test]
    fn sides_join_to_a_ring_and_straight_corners_go() {
        let ring = [[0, 0], [500, 0], [1000, 0], [1000, 1000], [0, 1000], [0, 500]];
        let sides = (0..6).map(|i| [ring[(i + 5) % 6], ring[(i + 6) % 6]]).collect();
        assert_eq!(path(&chain(sides)), "M0 0l1 0 0-1-1 0z");
    }

    #[test]
    fn rings_that_share_a_corner_stay_closed() {
        let sides = vec![
            [[0, 0], [1, 0]],
            [[1, 0], [0, 1]],
            [[0, 1], [0, 0]],
            [[0, 0], [-1, 0]],
            [[-1, 0], [0, -1]],
            [[0, -1], [0, 0]],
        ];
        let chains = chain(sides);
        assert!(chains.iter().all(|chain| chain.first() == chain.last()));
        assert_eq!(chains.iter().map(|chain| chain.len() - 1).sum::<usize>(), 6);
    }

    #[test]
    fn an_open_line_has_its_ends() {
        assert_eq!(lines(vec![[[0, 0], [1000, 0]], [[1000, 0], [1000, -2000]]]), "M0 0l1 0 0 2");
    }
}
