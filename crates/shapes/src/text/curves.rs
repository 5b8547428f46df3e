//! Outlines of letters as rings of straight lines.

use glam::DVec2;
use ttf_parser::OutlineBuilder;

/// Maximum number of points of a letter.
const MOST_POINTS: usize = 200_000;
/// Maximum number of lines of a curve.
const MOST_LINES: f64 = 256.0;

/// Rings of a letter, in units of the font.
pub(super) struct OutlineRings {
    /// Closed rings, without a repeated first point.
    pub rings: Vec<Vec<DVec2>>,
    /// Maximum distance between a curve and its lines.
    tolerance: f64,
    /// Number of points of all rings.
    points: usize,
}

impl OutlineRings {
    /// Creates an outline without rings.
    pub(super) fn new(tolerance: f64) -> Self {
        Self { rings: Vec::new(), tolerance, points: 0 }
    }

    /// Returns the number of lines for a curve whose second differences are at most `bend` long, weighted for its degree.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 256")]
    fn lines(&self, bend: f64) -> u32 {
        (bend / self.tolerance).sqrt().ceil().clamp(1.0, MOST_LINES) as u32
    }

    fn last(&self) -> DVec2 {
        self.rings.last().and_then(|ring| ring.last()).copied().unwrap_or_default()
    }

    /// Adds a point. Unwinds beyond the maximum, the only way to end the reading of an outline.
    fn push(&mut self, at: DVec2) {
        self.count();
        if let Some(ring) = self.rings.last_mut() {
            ring.push(at);
        }
    }
}

impl OutlineRings {
    /// Counts a point of the outline.
    fn count(&mut self) {
        self.points += 1;
        if self.points > MOST_POINTS {
            std::panic::resume_unwind(Box::new("too many points"));
        }
    }
}

impl OutlineBuilder for OutlineRings {
    fn move_to(&mut self, x: f32, y: f32) {
        self.count();
        self.rings.push(vec![point(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.push(point(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let [from, middle, to] = [self.last(), point(x1, y1), point(x, y)];
        // A parabola is at most a quarter of its second difference from its chord, divided by the square of the number of lines.
        let count = self.lines((from - 2.0 * middle + to).length() / 4.0);
        for line in 1..count {
            let t = f64::from(line) / f64::from(count);
            self.push(from.lerp(middle, t).lerp(middle.lerp(to, t), t));
        }
        self.push(to);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let [from, one, two, to] = [self.last(), point(x1, y1), point(x2, y2), point(x, y)];
        let bend = (from - 2.0 * one + two).length().max((one - 2.0 * two + to).length());
        let count = self.lines(bend * 0.75);
        for line in 1..count {
            let t = f64::from(line) / f64::from(count);
            let (a, b, c) = (from.lerp(one, t), one.lerp(two, t), two.lerp(to, t));
            self.push(a.lerp(b, t).lerp(b.lerp(c, t), t));
        }
        self.push(to);
    }

    fn close(&mut self) {
        let Some(ring) = self.rings.last_mut() else { return };
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        if ring.len() < 3 {
            self.rings.pop();
        }
    }
}

fn point(x: f32, y: f32) -> DVec2 {
    DVec2::new(f64::from(x), f64::from(y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_a_curve_stay_within_the_tolerance() {
        for tolerance in [1.0, 0.1, 0.01] {
            let mut outline = OutlineRings::new(tolerance);
            let k = 100.0 * 0.552_285;
            outline.move_to(100.0, 0.0);
            outline.curve_to(100.0, k, k, 100.0, 0.0, 100.0);
            outline.line_to(0.0, 0.0);
            outline.close();
            let ring = &outline.rings[0];
            // The middle of each chord is the point that is farthest from the circle.
            let chords = ring[..ring.len() - 1].windows(2);
            let gap = chords.map(|ends| 100.0 - ends[0].midpoint(ends[1]).length()).fold(0.0, f64::max);
            assert!(gap < tolerance + 0.03, "{gap} {tolerance}");
            assert!(ring.len() > 4, "{}", ring.len());
        }
    }

    #[test]
    fn an_outline_without_end_is_ended() {
        let draw = || {
            let mut outline = OutlineRings::new(1.0);
            loop {
                outline.move_to(0.0, 0.0);
                outline.close();
            }
        };
        assert!(std::panic::catch_unwind(draw).is_err());
    }

    #[test]
    fn a_ring_without_area_is_dropped() {
        let mut outline = OutlineRings::new(1.0);
        outline.move_to(0.0, 0.0);
        outline.line_to(5.0, 0.0);
        outline.line_to(0.0, 0.0);
        outline.close();
        assert!(outline.rings.is_empty());
    }
}
