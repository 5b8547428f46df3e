//! Construction of the surface of a sweep: rows of vertices, faces between them, and the ends.

use glam::{DVec2, DVec3, Vec2, Vec3};
use smallvec::{SmallVec, smallvec};

use super::options::{Lengthwise, SweepOptions, SweepResult};
use super::quad::Quad;
use super::ring::SectionRing;
use super::span::{NormalSpread, Span};
use crate::cross_section::section::Section;
use crate::cross_section::skin::Skin;
use crate::limits::NOTHING;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_scene::{Normal, Part};

/// A sweep under construction.
pub(super) struct SweepSurface<'a> {
    part: &'a mut Part,
    section: &'a Section,
    rings: &'a [SectionRing],
    options: &'a SweepOptions,
    skin: &'a Skin,
    /// Spans from each ring to the next one.
    spans: SmallVec<[Option<Span>; 1]>,
    /// Direction of the path: -1 if it runs against its headings, otherwise 1.
    direction: f64,
    open: Vec<[Vec3; 2]>,
    reached: Vec<(usize, usize)>,
}

/// Vertices of a ring for one of its two adjacent spans.
#[derive(Clone, Copy)]
struct SurfaceRow {
    first: u32,
}

impl<'a> SweepSurface<'a> {
    /// Prepares the surface of `section` through `rings`, which have its points, for `part`.
    pub(super) fn new(
        part: &'a mut Part,
        section: &'a Section,
        rings: &'a [SectionRing],
        options: &'a SweepOptions,
    ) -> Result<Self> {
        let skin = section.skin(options.around);
        let pairs = || pairs(rings, options.closed);
        let forwards: f64 = pairs()
            .map(|[a, b]| (b.centre() - a.centre()).dot(a.after.frame.heading + b.before.frame.heading))
            .sum();
        let direction = if forwards < 0.0 { -1.0 } else { 1.0 };
        let shading = NormalSpread { around: options.around, along: options.along };
        let spans =
            pairs().map(|pair| Span::new(section, skin, pair, direction, shading)).collect::<Result<_>>()?;
        Ok(Self {
            part,
            section,
            rings,
            options,
            skin,
            spans,
            direction,
            open: Vec::new(),
            reached: Vec::new(),
        })
    }

    /// Adds the sides and the ends.
    pub(super) fn build(mut self) -> Result<SweepResult> {
        self.refuse_too_many()?;
        let (columns, points) = (self.skin.columns.len(), self.section.points().count());
        let (spans, ends) = (self.spans.len(), 2 * points);
        self.part.make_room(2 * columns * spans + ends, 2 * columns * spans + ends);
        let before = (self.part.positions.len(), self.part.triangles.len());
        let v = self.sides()?;
        if self.section.is_open() {
            self.ribbon_edges();
            if self.options.back {
                self.back(before);
            }
        } else if !self.options.closed && self.spans.iter().any(Option::is_some) {
            self.end(0, self.options.start_cap, -self.direction);
            self.reach(0);
            self.end(self.rings.len() - 1, self.options.end_cap, self.direction);
            self.reach(self.rings.len() - 1);
        }
        Ok(SweepResult { v, open: self.open, reached: self.reached })
    }

    /// Records that all triangles up to `ring` have been added.
    fn reach(&mut self, ring: usize) {
        self.reached.push((self.rings[ring].station - 1, self.part.triangles.len()));
    }

    fn refuse_too_many(&self) -> Result<()> {
        let points = self.skin.columns.len() + self.section.points().count();
        let most = 4 * (self.rings.len() + 1) * points + self.part.positions.len();
        if most <= u32::MAX as usize {
            return Ok(());
        }
        Err(Error::limit(
            Limit::Size,
            format!("the sweep needs up to {most} vertices, but a mesh can have {}", u32::MAX),
        )
        .help("give fewer steps or points, or begin another mesh"))
    }

    /// Adds the faces between the rings, and returns v at the end.
    fn sides(&mut self) -> Result<f64> {
        let Some(wide) = self.rings.iter().find(|ring| ring.is_full()).or(self.rings.first()) else {
            return Ok(self.options.v);
        };
        let middles = self.skin.middles(&wide.exact);
        let mut v = self.options.v;
        let mut ready: Option<SurfaceRow> = None;
        for index in 0..self.spans.len() {
            let (a, b) = (&self.rings[index], &self.rings[(index + 1) % self.rings.len()]);
            let end = v + self.advance(a, b);
            if self.spans[index].is_none() {
                (ready, v) = (None, end);
                continue;
            }
            let below = match ready.take() {
                Some(row) => row,
                None => self.row(index, 0, v, &middles),
            };
            let above = self.row(index, 1, end, &middles);
            self.faces(index, [below, above])?;
            self.reach((index + 1) % self.rings.len());
            ready = self.joined(index).map(|_| above);
            v = end;
        }
        Ok(v)
    }

    /// Returns the length (m) of the texture from one ring to the next.
    fn advance(&self, a: &SectionRing, b: &SectionRing) -> f64 {
        let along = a.centre().distance(b.centre());
        if self.options.lengthwise == Lengthwise::Axis && along > NOTHING {
            return along;
        }
        let (mut weights, mut sum) = (0.0, 0.0);
        for strip in &self.skin.strips {
            for pair in self.skin.columns_of(strip).windows(2) {
                let [left, right] = [pair[0].point, pair[1].point];
                let weight = a.exact[left].distance(a.exact[right]) + b.exact[left].distance(b.exact[right]);
                let middles = [a, b].map(|ring| (ring.exact[left] + ring.exact[right]) / 2.0);
                weights += weight;
                sum += weight * middles[0].distance(middles[1]);
            }
        }
        if weights > 0.0 { sum / weights } else { along }
    }

    /// Returns the next span if the surface continues smoothly into it.
    fn joined(&self, index: usize) -> Option<usize> {
        let next = if self.options.closed { (index + 1) % self.spans.len() } else { index + 1 };
        let ring = &self.rings[(index + 1) % self.rings.len()];
        let (span, other) = (self.spans.get(index)?.as_ref()?, self.spans.get(next)?.as_ref()?);
        let smooth = self.options.along && !ring.sharp && ring.is_full() && !span.step && !other.step;
        smooth.then_some(next)
    }

    /// Adds the vertices of a span's first ring (`side` 0) or second ring (`side` 1).
    fn row(&mut self, index: usize, side: usize, v: f64, middles: &[f64]) -> SurfaceRow {
        let ring = &self.rings[(index + side) % self.rings.len()];
        let opposite = &self.rings[(index + 1 - side) % self.rings.len()];
        let first = self.part.positions.len() as u32;
        let Some(span) = &self.spans[index] else { return SurfaceRow { first } };
        let neighbour = match side {
            1 => self.joined(index).map(|next| (next, 0)),
            _ => {
                let previous = (index + self.spans.len() - 1) % self.spans.len();
                (self.joined(previous) == Some(index)).then_some((previous, 1))
            }
        };
        let neighbour = neighbour.and_then(|(span, side)| Some(&self.spans[span].as_ref()?.normals[side]));
        let mut across = self.skin.coordinates_across(&ring.exact, middles);
        if ring.is_apex() {
            self.spread_tip(&mut across, &self.skin.coordinates_across(&opposite.exact, middles));
        }
        for (column, u) in across.into_iter().enumerate() {
            let normal =
                if ring.is_apex() { self.tip_normal(span, side, column) } else { span.normals[side][column] };
            let normal = neighbour.map_or(normal, |other| (normal + other[column]).normalize_or(normal));
            self.part.positions.push(ring.points[self.skin.columns[column].point]);
            self.part.normals.push(normal.into());
            self.part.uvs.push(Vec2::new((span.sign * u) as f32, v as f32));
        }
        SurfaceRow { first }
    }

    /// Moves the texture coordinates of a round tip to the centre of each face, instead of one point for all
    /// faces.
    fn spread_tip(&self, across: &mut [f64], opposite: &[f64]) {
        for strip in self.skin.strips.iter().filter(|strip| !strip.straight) {
            for column in strip.columns.start + 1..strip.columns.end {
                across[column] = (opposite[column - 1] + opposite[column]) / 2.0;
            }
        }
    }

    /// Returns the normal of a tip in the face before a column: each face has its own, because a tip has no
    /// unique normal.
    fn tip_normal(&self, span: &Span, side: usize, column: usize) -> DVec3 {
        let normals = &span.normals[side];
        let begins = self.skin.strips.iter().any(|strip| strip.columns.start == column);
        if begins {
            normals[column]
        } else {
            (normals[column - 1] + normals[column]).normalize_or(normals[column])
        }
    }

    fn faces(&mut self, index: usize, [below, above]: [SurfaceRow; 2]) -> Result<()> {
        let (a, b) = (&self.rings[index], &self.rings[(index + 1) % self.rings.len()]);
        let Some(Span { sign, step, .. }) = self.spans[index] else { return Ok(()) };
        let mut sides: SmallVec<[f64; 1]> = smallvec![0.0; self.section.ring_count()];
        for strip in &self.skin.strips {
            for column in strip.columns.start..strip.columns.end - 1 {
                let [left, right] = [column, column + 1].map(|column| self.skin.columns[column].point);
                let quad = Quad::new([(a, left), (a, right), (b, right), (b, left)]);
                let Some(split) = quad.split() else { return Err(no_area(a, b, left)) };
                for corners in split.into_iter().flatten() {
                    if step {
                        let side = quad.area(corners).dot(a.normal).signum();
                        let known = &mut sides[strip.ring];
                        if *known * side < 0.0 {
                            return Err(crossing(a, b));
                        }
                        *known = side;
                    }
                    let vertex = |corner: usize| {
                        let row = if corner < 2 { below } else { above };
                        row.first + column as u32 + u32::from(corner == 1 || corner == 2)
                    };
                    let [p, q, r] = corners.map(vertex);
                    self.part.triangles.push(if sign < 0.0 { [p, r, q] } else { [p, q, r] });
                }
            }
        }
        Ok(())
    }

    /// Closes the end at a ring with a cap that faces `outwards` along its headings, or records its edges as
    /// open.
    fn end(&mut self, ring: usize, cap: bool, outwards: f64) {
        let ring = &self.rings[ring];
        if !ring.is_full() {
            return;
        }
        if !cap {
            let mut first = 0;
            for knots in self.section.rings() {
                let point = |i: usize| ring.points[first + i % knots.len()];
                let edges = (0..knots.len()).map(|i| [point(i), point(i + 1)]);
                self.open.extend(edges.filter(|[from, to]| from != to));
                first += knots.len();
            }
            return;
        }
        let first = self.part.positions.len() as u32;
        let scale = ring.after.scale;
        let normal = Normal::from(ring.normal * outwards);
        for (point, &position) in self.section.points().zip(&ring.points) {
            let DVec2 { x, y } = point * scale;
            self.part.positions.push(position);
            self.part.normals.push(normal);
            self.part.uvs.push(DVec2::new(x * outwards, y).as_vec2());
        }
        let turned = scale.x * scale.y * outwards < 0.0;
        for &[a, b, c] in self.section.cap() {
            let [p, q, r] = [a, b, c].map(|corner| ring.points[corner]);
            if p != q && q != r && r != p {
                let [a, b, c] = [a, b, c].map(|corner| first + corner as u32);
                self.part.triangles.push(if turned { [a, c, b] } else { [a, b, c] });
            }
        }
    }

    /// Records the border of a ribbon as open edges.
    fn ribbon_edges(&mut self) {
        let mut edges = Vec::new();
        let present = pairs(self.rings, self.options.closed).zip(&self.spans);
        for ([a, b], _) in present.filter(|(_, span)| span.is_some()) {
            let last = a.points.len() - 1;
            edges.extend([[a.points[0], b.points[0]], [a.points[last], b.points[last]]]);
        }
        if let (false, false, [first, .., last]) = (self.options.closed, edges.is_empty(), self.rings) {
            for ring in [first, last] {
                edges.extend(ring.points.windows(2).map(|edge| [edge[0], edge[1]]));
            }
        }
        self.open.extend(edges.into_iter().filter(|[from, to]| from != to));
    }

    /// Adds the back side of all geometry since `vertices` and `triangles`.
    fn back(&mut self, (vertices, triangles): (usize, usize)) {
        let part = &mut *self.part;
        let offset = (part.positions.len() - vertices) as u32;
        part.positions.extend_from_within(vertices..);
        part.normals.extend_from_within(vertices..);
        part.uvs.extend_from_within(vertices..);
        let behind = vertices + offset as usize;
        part.normals[behind..].iter_mut().for_each(|normal| *normal = -*normal);
        part.uvs[behind..].iter_mut().for_each(|uv| uv.x = -uv.x);
        let turned: Vec<_> = part.triangles.range(triangles..part.triangles.len()).collect();
        let added = turned.len();
        part.triangles.extend(turned.into_iter().map(|[a, b, c]| [a + offset, c + offset, b + offset]));
        let behind: Vec<_> = self.reached.iter().map(|(station, count)| (*station, count + added)).collect();
        self.reached.extend(behind);
    }
}

/// Returns each ring with the next one.
fn pairs(rings: &[SectionRing], closed: bool) -> impl Iterator<Item = [&SectionRing; 2]> {
    let count = if closed && rings.len() > 2 { rings.len() } else { rings.len().saturating_sub(1) };
    (0..count).map(|index| [&rings[index], &rings[(index + 1) % rings.len()]])
}

fn no_area(a: &SectionRing, b: &SectionRing, point: usize) -> Error {
    let (from, to) = (a.station, b.station);
    let message = format!("between stations {from} and {to} the face after point {} has no area", point + 1);
    Error::geometry(message)
        .help("increase the length between the stations, or centre the cross-section differently")
}

fn crossing(a: &SectionRing, b: &SectionRing) -> Error {
    Error::geometry(format!(
        "the outlines at stations {} and {} are at the same position and cross",
        a.station, b.station
    ))
    .help("increase the length between the stations, or end the run there and begin a new one")
}
