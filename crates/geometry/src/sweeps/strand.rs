//! Strands: round tubes through many points, optimized for millions of branches.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use glam::{DVec2, DVec3, Vec2, Vec3, Vec3A, Vec4};

use crate::limits::MOST;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_scene::{Normal, Part, Triangles};

/// Maximum number of sides of a strand.
pub const MOST_SIDES: usize = 64;

/// Unit circles, indexed by number of sides.
static CIRCLES: LazyLock<Vec<Circle>> = LazyLock::new(|| (0..=MOST_SIDES).map(Circle::new).collect());

/// Points on a circle with a radius of 1 m.
#[derive(Debug)]
struct Circle {
    /// Points, one for each side.
    points: Vec<Vec2>,
    /// The x and y coordinates in groups of four, padded with zeros.
    fours: Vec<[Vec4; 2]>,
    /// Perimeter (m) of the polygon.
    perimeter: f32,
}

impl Circle {
    fn new(sides: usize) -> Self {
        let point = |i: usize| DVec2::from_angle(TAU * i as f64 / sides as f64).as_vec2();
        let points: Vec<Vec2> = (0..sides).map(point).collect();
        let four = |points: &[Vec2]| {
            let place = |axis: usize| std::array::from_fn(|i| points.get(i).map_or(0.0, |point| point[axis]));
            [0, 1].map(|axis| Vec4::from_array(place(axis)))
        };
        let edge = points.get(..2).map_or(0.0, |two| two[0].distance(two[1]));
        Self { fours: points.chunks(4).map(four).collect(), perimeter: edge * sides as f32, points }
    }

    #[inline]
    fn sides(&self) -> usize {
        self.points.len()
    }
}

/// Direction in which a ring is stretched, and the stretch factor minus 1.
type Mitre = (Vec3A, f32);

const STRAIGHT: Mitre = (Vec3A::ZERO, 0.0);

/// A round tube that grows from point to point: a closed solid after [`Strand::end`].
///
/// Each ring lies halfway between the segments that it joins, stretched to a mitre; rings turn with the path
/// without twisting. A radius of 0 at the start or the end creates a tip; other ends are flat. Texture
/// coordinates are in metres: u to both sides of the line opposite to the seam, v along the path.
///
/// A strand stores only its last ring and position, so several strands can grow alternately in the same part.
/// Call [`Strand::end`] exactly once, and do not continue a copy of a strand.
///
/// ```
/// use burgeon_geometry::{Strand, solid};
/// use burgeon_scene::Part;
/// use glam::DVec3;
///
/// let mut twig = Part::default();
/// let mut strand = Strand::begin(6, DVec3::ZERO, DVec3::X, 0.1)?;
/// strand.extend_to(&mut twig, DVec3::new(0.0, 0.0, 1.0), 0.06)?;
/// strand.extend_to(&mut twig, DVec3::new(0.5, 0.0, 1.5), 0.0)?;
/// assert_eq!(strand.position(), DVec3::new(0.5, 0.0, 1.5));
/// strand.end(&mut twig);
/// assert!(solid::check([&twig]).is_solid());
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Strand {
    circle: &'static Circle,
    /// Start of the ring, perpendicular to the last direction.
    side: Vec3A,
    /// Direction to which `side` is perpendicular.
    across: Vec3A,
    /// Current position (m); its ring is added when the next direction is known.
    position: DVec3,
    radius: f32,
    v: f64,
    /// Segment that ends at `position`, if any.
    last: Option<StrandPiece>,
}

/// A segment of a strand with its first ring but without its second.
#[derive(Debug, Clone, Copy)]
struct StrandPiece {
    direction: Vec3A,
    /// Decrease of the radius per metre.
    slope: f32,
    /// Index of the first vertex of its first ring.
    ring: u32,
    /// Marks a first ring that is a tip.
    tip: bool,
}

impl Strand {
    /// Begins a strand with `sides` faces around (3 to 64) at `position` (m) with `radius` (m).
    ///
    /// `side` points from the centre to the seam, perpendicular to the path; if it is zero or parallel to the
    /// path, another direction is chosen. Fails if a value is not finite or if there are too few or too many
    /// sides.
    pub fn begin(sides: usize, position: DVec3, side: DVec3, radius: f64) -> Result<Self> {
        refuse_infinite(position, radius)?;
        if !(3..=MOST_SIDES).contains(&sides) {
            return Err(Error::argument(format!("a round tube cannot have {sides} sides"))
                .help(format!("give 3 to {MOST_SIDES} sides, or sweep a cross-section")));
        }
        let side = if side.is_finite() { side.normalize_or_zero().as_vec3a() } else { Vec3A::ZERO };
        let circle = &CIRCLES[sides];
        let radius = radius.abs() as f32;
        Ok(Self { circle, side, across: Vec3A::ZERO, position, radius, v: 0.0, last: None })
    }

    /// Returns the current position (m).
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// Adds a straight segment to `position` (m) with `radius` (m) at its end.
    ///
    /// A position closer than the rounding error of a coordinate only changes the radius. Fails if a value is
    /// not finite or if the part is full.
    #[inline]
    pub fn extend_to(&mut self, part: &mut Part, position: DVec3, radius: f64) -> Result<()> {
        refuse_infinite(position, radius)?;
        // Only positions need f64: directions are rounded to f32 in the output, and errors do not accumulate.
        let way = (position - self.position).as_vec3a();
        let length = way.length();
        let radius = radius.abs() as f32;
        if length <= rounding(position) {
            self.radius = radius;
            return Ok(());
        }
        let most = part.positions.len().max(part.triangles.len());
        if most > Triangles::MOST_BEFORE - 8 * self.vertices() {
            return Err(Error::limit(
                Limit::Size,
                format!("a mesh can have at most {} vertices or triangles", u32::MAX),
            )
            .help("draw fewer branches or fewer sides, or begin another mesh"));
        }
        // Room for the maximum of one segment and the end: two rings and two caps, or the faces of two tips.
        part.make_room(4 * self.vertices(), 2 * self.vertices());
        let direction = way / length;
        let slope = (self.radius - radius) / length;
        let (ring, tip) = match self.last {
            None => self.start(part, direction, slope),
            Some(last) => (self.joint(part, last, direction, slope), false),
        };
        self.last = Some(StrandPiece { direction, slope, ring, tip });
        self.position = position;
        self.radius = radius;
        self.v += f64::from(length);
        Ok(())
    }

    /// Closes the strand; a strand without segments adds nothing.
    pub fn end(self, part: &mut Part) {
        let Some(last) = self.last else { return };
        if self.radius <= self.least_radius() && !last.tip {
            let tip = self.tip(part, last.direction, last.slope, 1.0);
            self.faces(part, last.ring, tip, false, true);
            return;
        }
        let ring = self.ring(part, last.direction, STRAIGHT, last.slope);
        self.faces(part, last.ring, ring, last.tip, false);
        self.cap(part, last.direction, ring, false);
    }

    /// Adds the first ring with its cap, or the tip.
    fn start(&mut self, part: &mut Part, direction: Vec3A, slope: f32) -> (u32, bool) {
        let side = self.side.reject_from_normalized(direction);
        let side = if side.length_squared() > 1e-6 { side } else { direction.any_orthonormal_vector() };
        (self.side, self.across) = (side.normalize(), direction);
        if self.radius <= self.least_radius() {
            return (self.tip(part, direction, slope, -1.0), true);
        }
        let ring = self.ring(part, direction, STRAIGHT, slope);
        self.cap(part, direction, ring, true);
        (ring, false)
    }

    /// Adds the ring between the last segment and a segment in `direction`, and the faces of the last
    /// segment.
    #[inline]
    fn joint(&mut self, part: &mut Part, last: StrandPiece, direction: Vec3A, slope: f32) -> u32 {
        let sum = last.direction + direction;
        let square = sum.length_squared();
        let mut normal = last.direction;
        let mut mitre = STRAIGHT;
        // The square is 4 times the squared cosine of half the turn. Beyond 120 degrees the ring is
        // perpendicular to the last segment, because a mitre would be too long.
        let bend = direction - last.direction;
        let bent = bend.length_squared();
        if square > 1.0 && bent > 1e-10 {
            let length = square.sqrt();
            normal = sum / length;
            // Along the bend, a mitre is longer by the reciprocal of the cosine.
            mitre = (bend / bent.sqrt(), 2.0 / length - 1.0);
        }
        self.carry_side(normal);
        let ring = self.ring(part, normal, mitre, (last.slope + slope) / 2.0);
        // The side turns via the direction of each segment: the shortest rotations between rings alone would
        // twist it.
        self.carry_side(direction);
        self.faces(part, last.ring, ring, last.tip, false);
        ring
    }

    /// Rotates `side` by the smallest rotation from the direction that it is perpendicular to, to
    /// `direction`.
    #[inline]
    fn carry_side(&mut self, direction: Vec3A) {
        let sum = self.across + direction;
        let cosine = 1.0 + self.across.dot(direction);
        if cosine > 1e-6 {
            let side = self.side - sum * (self.side.dot(direction) / cosine);
            let side = side - direction * direction.dot(side);
            // Corrects the rounding error of the length with a step of Newton's method for 1 / sqrt(x).
            self.side = side * (1.5 - 0.5 * side.length_squared());
        }
        self.across = direction;
    }

    /// Adds a ring perpendicular to `normal`, stretched in the direction of the `mitre` by its factor;
    /// returns its first vertex.
    #[inline]
    fn ring(&self, part: &mut Part, normal: Vec3A, mitre: Mitre, slope: f32) -> u32 {
        let first = part.positions.len() as u32;
        let (x, y) = (self.side, normal.cross(self.side));
        let radius = self.radius.max(self.least_radius());
        let wide = |axis: Vec3A| (axis + mitre.0 * (mitre.1 * mitre.0.dot(axis))) * radius;
        let (wide_x, wide_y) = (wide(x), wide(y));
        let shrink = 1.0 / (1.0 + slope * slope).sqrt();
        let (flat_x, flat_y, lift) = (x * shrink, y * shrink, normal * slope * shrink);
        let Circle { points, fours, perimeter } = self.circle;
        let around = perimeter * radius;
        let (left, step) = (-around / 2.0, around / points.len() as f32);
        let (position, v) = (self.position.as_vec3a(), self.v as f32);
        let place = |point: &Vec2| Vec3::from(position + (wide_x * point.x + wide_y * point.y));
        part.positions.extend(points.iter().map(place));
        for [x, y] in fours {
            let along = |axis: usize| lift[axis] + (flat_x[axis] * *x + flat_y[axis] * *y);
            part.normals.extend_from_slice(&Normal::four([along(0), along(1), along(2)]));
        }
        // The last vertex repeats the first with another texture coordinate; the last group of four may have
        // been padded.
        let at = first as usize;
        part.normals.truncate(at + points.len());
        part.positions.push(part.positions[at]);
        part.normals.push(part.normals[at]);
        part.uvs.extend((0..self.vertices()).map(|i| Vec2::new(left + step * i as f32, v)));
        first
    }

    /// Adds a tip, the same point once for each face, and returns its first vertex; `outwards` is -1 at the
    /// start and 1 at the end.
    fn tip(&self, part: &mut Part, direction: Vec3A, slope: f32, outwards: f32) -> u32 {
        let first = part.positions.len() as u32;
        let y = direction.cross(self.side);
        let (count, points) = (self.vertices(), &self.circle.points);
        part.positions.extend(std::iter::repeat_n(self.position.as_vec3(), count));
        let normal = |pair: usize| {
            let middle = points[pair % (count - 1)] + points[(pair + 1) % (count - 1)];
            let radial = (self.side * middle.x + y * middle.y).normalize();
            Normal::from((radial + direction * slope).normalize_or(direction * outwards))
        };
        part.normals.extend((0..count).map(normal));
        part.uvs.extend(std::iter::repeat_n(Vec2::new(0.0, self.v as f32), count));
        first
    }

    /// Adds the faces from one ring to the next; either may be a tip.
    #[inline]
    fn faces(&self, part: &mut Part, from: u32, to: u32, from_tip: bool, to_tip: bool) {
        let sides = self.circle.sides() as u32;
        match (from_tip, to_tip) {
            (false, false) => part.triangles.band(from, to, sides as u16),
            (true, _) => part.triangles.extend((0..sides).map(|i| [from + i, to + i + 1, to + i])),
            (false, true) => part.triangles.extend((0..sides).map(|i| [from + i, from + i + 1, to + i])),
        }
    }

    /// Closes a ring with a flat fan that faces against `direction` at the `start` and along it at the end.
    fn cap(&self, part: &mut Part, direction: Vec3A, ring: u32, start: bool) {
        let first = part.positions.len() as u32;
        let sides = self.circle.sides();
        let (normal, mirrored) = if start { (-direction, -1.0) } else { (direction, 1.0) };
        let radius = self.radius.max(self.least_radius());
        part.positions.extend_from_within(ring as usize..ring as usize + sides);
        part.normals.extend(std::iter::repeat_n(Normal::from(normal), sides));
        part.uvs.extend(self.circle.points.iter().map(|point| *point * Vec2::new(mirrored, 1.0) * radius));
        part.triangles.fan(first, sides as u16, start);
    }

    /// Returns the number of vertices of a ring: one for each side, and the first again where the texture
    /// ends.
    #[inline]
    fn vertices(&self) -> usize {
        self.circle.sides() + 1
    }

    /// Returns the radius (m) below which the points of a ring would coincide at export precision.
    #[inline]
    fn least_radius(&self) -> f32 {
        rounding(self.position) * self.vertices() as f32
    }
}

/// Adds one closed, straight, round tube with flat ends or tips; see [`Strand`].
pub fn tube(part: &mut Part, sides: usize, from: (DVec3, f64), to: (DVec3, f64)) -> Result<()> {
    let mut strand = Strand::begin(sides, from.0, DVec3::ZERO, from.1)?;
    strand.extend_to(part, to.0, to.1)?;
    strand.end(part);
    Ok(())
}

/// Returns a length (m) of a few times the export precision at `position`.
#[inline]
fn rounding(position: DVec3) -> f32 {
    1e-6 + position.as_vec3a().abs().max_element() * 5e-7
}

#[inline]
fn refuse_infinite(position: DVec3, radius: f64) -> Result<()> {
    // The comparisons are false for NaN.
    if position.abs().max_element() <= MOST && position.is_finite() && radius.abs() <= MOST {
        return Ok(());
    }
    let DVec3 { x, y, z } = position;
    Err(Error::geometry(format!("a branch ends at ({x}, {y}, {z}) with a radius of {radius}"))
        .help("give a position and a radius in metres, within 1e9 of the origin"))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;
    use crate::solid::{check, volume};

    fn strand(sides: usize, points: &[(DVec3, f64)]) -> Part {
        let mut part = Part::default();
        let mut strand = Strand::begin(sides, points[0].0, DVec3::X, points[0].1).expect("a strand");
        for &(position, radius) in &points[1..] {
            strand.extend_to(&mut part, position, radius).expect("a place");
        }
        strand.end(&mut part);
        assert!(part.normals.iter().all(|normal| (normal.vector().length() - 1.0).abs() < 1e-5));
        assert!(part.uvs.iter().all(|uv| uv.is_finite()));
        part
    }

    fn polygon(sides: usize) -> f64 {
        sides as f64 / 2.0 * (TAU / sides as f64).sin()
    }

    fn looks_outwards(part: &Part) -> bool {
        part.triangles.iter().all(|triangle| {
            let [a, b, c] = triangle.map(|corner| part.positions[corner as usize]);
            let face = (b - a).cross(c - a);
            triangle.iter().all(|&corner| face.dot(part.normals[corner as usize].vector()) > 0.0)
        })
    }

    #[test]
    fn a_straight_strand_is_a_prism_and_a_fine_one_a_cylinder() {
        for sides in [3, 5, 6, 64] {
            let points = [(DVec3::ZERO, 0.5), (DVec3::Z, 0.5), (DVec3::Z * 4.0, 0.5)];
            let part = strand(sides, &points);
            assert!(check([&part]).is_solid() && looks_outwards(&part));
            assert!((volume([&part]) - polygon(sides)).abs() < 1e-5);
            assert_eq!(part.triangles.len(), 4 * sides + 2 * (sides - 2));
        }
        let part = strand(64, &[(DVec3::ZERO, 0.5), (DVec3::Z * 4.0, 0.5)]);
        assert!((volume([&part]) - PI).abs() < 0.01);
    }

    #[test]
    fn a_tapered_strand_has_a_tip_and_the_volume_of_a_pyramid() {
        for points in
            [[(DVec3::ZERO, 0.5), (DVec3::Y * 3.0, 0.0)], [(DVec3::ZERO, 0.0), (DVec3::Y * 3.0, 0.5)]]
        {
            let part = strand(6, &points);
            assert!(check([&part]).is_solid() && looks_outwards(&part));
            assert!((volume([&part]) - polygon(6) * 0.25).abs() < 1e-6);
            assert_eq!(part.triangles.len(), 6 + 4);
            let slopes = part.normals.iter().map(|normal| normal.vector().y.abs()).filter(|y| *y < 0.99);
            assert!(slopes.clone().count() == 14);
            slopes.for_each(|y| {
                assert!((y - (0.5f32 / 3.0) / (1.0f32 + 0.25 / 9.0).sqrt()).abs() < Normal::PRECISION)
            });
        }
    }

    #[test]
    fn a_mitre_keeps_the_volume_and_the_seam_does_not_twist() {
        let bent = [DVec3::ZERO, DVec3::Z * 2.0, DVec3::new(0.0, 2.0, 3.0), DVec3::new(2.0, 2.0, 4.0)];
        let length: f64 = bent.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let part = strand(8, &bent.map(|point| (point, 0.1)));
        assert!(check([&part]).is_solid() && looks_outwards(&part));
        let expected = length * 0.01 * polygon(8);
        assert!((volume([&part]) - expected).abs() < 1e-6, "{} {expected}", volume([&part]));
        // Around a planar bend the seam stays on its side.
        let circle: Vec<_> = (0..40).map(|i| DVec2::from_angle(f64::from(i) * 0.1)).collect();
        let planar: Vec<_> = circle.iter().map(|p| (DVec3::new(0.0, p.x, p.y), 0.05)).collect();
        let part = strand(5, &planar);
        let seams = part.positions.iter().zip(&part.uvs).filter(|(_, uv)| uv.x < -0.1);
        assert!(seams.clone().count() == 40 && seams.clone().all(|(p, _)| (p.x - 0.05).abs() < 1e-6));
    }

    #[test]
    fn textures_are_in_metres() {
        let part = strand(6, &[(DVec3::ZERO, 0.5), (DVec3::Z, 0.5), (DVec3::Z * 4.0, 0.5)]);
        let us = part.uvs[..7].iter().map(|uv| uv.x);
        assert!(us.clone().fold(0.0, f32::max) == 1.5 && us.fold(0.0, f32::min) == -1.5);
        assert_eq!(part.uvs.iter().map(|uv| uv.y).fold(0.0, f32::max), 4.0);
    }

    #[test]
    fn turning_back_and_standing_still_leave_a_closed_strand() {
        let near = DVec3::Z * 1e-8;
        let ways: [&[(DVec3, f64)]; 6] = [
            &[(DVec3::ZERO, 0.1), (DVec3::Z, 0.1), (DVec3::Z + near, 0.1), (DVec3::Z * 2.0, 0.1)],
            &[(DVec3::ZERO, 0.1), (DVec3::Z, 0.1), (DVec3::ZERO, 0.1)],
            &[(DVec3::ZERO, 0.1), (DVec3::Z, 0.1), (DVec3::ZERO, 0.1), (DVec3::X, 0.0)],
            &[(DVec3::ZERO, 0.1), (DVec3::ZERO, 0.2), (DVec3::Z, 0.1), (DVec3::Z, 0.1), (DVec3::Z, 0.0)],
            &[
                (DVec3::ZERO, 0.0),
                (DVec3::Z, 0.0),
                (DVec3::Z * 2.0, 0.1),
                (DVec3::Z * 3.0, 0.0),
                (DVec3::Z * 4.0, 0.0),
            ],
            &[(DVec3::ZERO, 0.0), (DVec3::Z, 0.0)],
        ];
        for (index, way) in ways.iter().enumerate() {
            let found = check([&strand(5, way)]);
            assert!(found.is_solid(), "{index}: {found:?}");
        }
        assert_eq!(strand(5, &[(DVec3::ZERO, 0.1), (DVec3::ZERO, 0.2)]), Part::default());
    }

    #[test]
    fn what_is_not_finite_or_has_no_sides_is_refused() {
        let mut part = Part::default();
        let mut nan =
            |radius| tube(&mut part, 6, (DVec3::ZERO, 1.0), (DVec3::Z, radius)).expect_err("refused");
        insta::assert_snapshot!(nan(f64::NAN), @r"
        a branch ends at (0, 0, 1) with a radius of NaN
          help: give a position and a radius in metres, within 1e9 of the origin
        ");
        insta::assert_snapshot!(Strand::begin(2, DVec3::ZERO, DVec3::X, 1.0).expect_err("refused"), @r"
        a round tube cannot have 2 sides
          help: give 3 to 64 sides, or sweep a cross-section
        ");
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn every_strand_is_solid(
            steps in prop::collection::vec((-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0, prop_oneof![0.0f64..0.3, Just(0.0)]), 2..20),
            sides in 3usize..12,
            far in 0.0f64..100.0,
        ) {
            let mut position = DVec3::splat(far);
            let mut points = Vec::new();
            for (x, y, z, radius) in steps {
                position += DVec3::new(x, y, z);
                points.push((position, radius));
            }
            let found = check([&strand(sides, &points)]);
            prop_assert!(found.is_solid(), "{:?}", found);
        }
    }
}
