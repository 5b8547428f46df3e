//! Named cross-sections: regular polygons, stars and rectangles.

use std::cmp::Ordering;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use glam::DVec2;

use super::point::SectionPoint;
use super::section::{Section, refuse_too_many};
use crate::planar::Rings;
use burgeon_base::error::{Error, Result};

impl Section {
    /// Creates a smooth regular polygon with points at 1 m from the centre, the first at (1, 0).
    ///
    /// Fails with fewer than 3 `sides`.
    ///
    /// ```
    /// use burgeon_geometry::Section;
    /// use glam::DVec2;
    ///
    /// let hexagon = Section::regular(6)?;
    /// assert_eq!(hexagon.points().next(), Some(DVec2::X));
    /// assert!((hexagon.perimeter() - 6.0).abs() < 1e-12);
    /// assert!(Section::regular(2).is_err());
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn regular(sides: usize) -> Result<Self> {
        if sides < 3 {
            return Err(Error::geometry(format!("a regular cross-section of {sides} sides has no area"))
                .help("give at least 3 sides"));
        }
        refuse_too_many(sides)?;
        let points = (0..sides).map(|i| SectionPoint::smooth(on_circle(i, sides))).collect();
        Self::new(&Rings(vec![points]))
    }

    /// Creates a star of sharp points at 1 m from the centre, the first at (1, 0), with notches at `inner`
    /// (m) between.
    ///
    /// Fails with fewer than 2 `points` or if `inner` is not positive.
    ///
    /// ```
    /// use burgeon_geometry::Section;
    ///
    /// let star = Section::star(5, 0.5)?;
    /// assert_eq!(star.corners(), 10);
    /// assert!(star.area() < Section::regular(5)?.area());
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn star(points: usize, inner: f64) -> Result<Self> {
        if points < 2 || !inner.is_finite() || inner <= 0.0 {
            return Err(Error::geometry(format!(
                "a star of {points} points with its notches at {inner} m has no area"
            ))
            .help("give at least 2 points and notches at more than 0 m from the centre"));
        }
        refuse_too_many(points.saturating_mul(2))?;
        let corner = |i: usize| on_circle(i, 2 * points) * if i.is_multiple_of(2) { 1.0 } else { inner };
        Self::polygon(&Rings(vec![(0..2 * points).map(corner).collect()]))
    }

    /// Creates a rectangle of `width` by `height` (m) about the centre, with the first point at the lower
    /// left.
    ///
    /// Fails if either size is not positive.
    pub fn rectangle(width: f64, height: f64) -> Result<Self> {
        refuse_flat(width, height)?;
        let half = DVec2::new(width, height) / 2.0;
        let corners = [-half, DVec2::new(half.x, -half.y), half, DVec2::new(-half.x, half.y)];
        // The general validation refuses rectangles that are as thin as a line.
        if width.min(height) < 1e-6 * width.max(height).max(1.0) {
            return Self::polygon(&Rings(vec![corners.to_vec()]));
        }
        Ok(Self::convex(corners.map(SectionPoint::sharp)))
    }
}

/// Returns point `index` of `count` at 1 m from the centre, counter-clockwise from (1, 0).
fn on_circle(index: usize, count: usize) -> DVec2 {
    // Computed by quadrant, so that mirrored points are equal to the last bit.
    let (quarter, rest) = (4 * index / count % 4, (4 * index) % count);
    let angle = |part: usize| FRAC_PI_2 * (part as f64 / count as f64);
    let point = match (2 * rest).cmp(&count) {
        Ordering::Less => DVec2::from_angle(angle(rest)),
        Ordering::Equal => DVec2::splat(FRAC_1_SQRT_2),
        Ordering::Greater => DVec2::from(angle(count - rest).sin_cos()),
    };
    match quarter {
        0 => point,
        1 => point.perp(),
        2 => -point,
        _ => -point.perp(),
    }
}

fn refuse_flat(width: f64, height: f64) -> Result<()> {
    if width.is_finite() && height.is_finite() && width > 0.0 && height > 0.0 {
        return Ok(());
    }
    Err(Error::geometry(format!("a rectangle of {width} by {height} m has no area"))
        .help("give a width and a height of more than 0 m"))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::MOST_POINTS;

    #[test]
    fn areas_and_perimeters_follow_their_formulas() {
        let sides = 7.0;
        let heptagon = Section::regular(7).expect("a heptagon");
        assert!((heptagon.area() - sides / 2.0 * (TAU / sides).sin()).abs() < 1e-12);
        assert!((heptagon.perimeter() - sides * 2.0 * (TAU / sides / 2.0).sin()).abs() < 1e-12);
        let star = Section::star(5, 0.4).expect("a star");
        assert!((star.area() - 5.0 * 0.4 * (TAU / 10.0).sin()).abs() < 1e-12);
        assert_eq!(Section::rectangle(3.0, 2.0).expect("a rectangle").area(), 6.0);
    }

    #[test]
    fn a_regular_section_begins_at_one_metre_to_the_right_and_mirrors_itself_exactly() {
        for sides in 3..40 {
            let points: Vec<DVec2> = Section::regular(sides).expect("a polygon").points().collect();
            assert_eq!(points[0], DVec2::X);
            for i in 1..sides {
                let mirrored = points[sides - i];
                assert_eq!((points[i].x, points[i].y), (mirrored.x, -mirrored.y), "{i} of {sides}");
                assert!((points[i] - DVec2::from_angle(TAU * i as f64 / sides as f64)).length() < 4e-15);
            }
        }
    }

    #[test]
    fn a_shape_without_area_or_with_too_many_points_is_refused() {
        insta::assert_snapshot!(Section::regular(2).expect_err("no area"), @r"
        a regular cross-section of 2 sides has no area
          help: give at least 3 sides
        ");
        insta::assert_snapshot!(Section::star(5, 0.0).expect_err("no area"), @r"
        a star of 5 points with its notches at 0 m has no area
          help: give at least 2 points and notches at more than 0 m from the centre
        ");
        insta::assert_snapshot!(Section::rectangle(-1.0, 2.0).expect_err("no area"), @r"
        a rectangle of -1 by 2 m has no area
          help: give a width and a height of more than 0 m
        ");
        insta::assert_snapshot!(Section::regular(MOST_POINTS + 1).expect_err("too many"), @r"
        a cross-section of 10001 points is too fine
          help: give at most 10000 points
        ");
    }
}
