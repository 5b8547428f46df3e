//! Sites for buildings along streets: positions in a grid on both sides of each segment where there is space.
//!
//! Method: V. Vlaanderen Oldenzeel, "Procedural city generation using an L-system", 2020: each grid position is tested
//! against streets and against earlier sites, each with a spatial index. Here, all tests are exact.

use glam::DVec2;
use rstar::primitives::{GeomWithData, Line as IndexLine, Rectangle};
use rstar::{AABB, RTree};

use crate::lots::{FinePlace, fine_meet, fine_side};
use crate::plan::network::{PieceId, StreetNetwork};
use crate::shape::profile::StreetProfiles;
use crate::surface::parts::SurfaceOptions;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::planar::edges;

/// Maximum number of tested positions.
const MOST_PLACES: f64 = 20_000_000.0;

/// Options for sites.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteOptions {
    /// Width along the street and depth (m) of sites, by the depth of the street in the hierarchy; the last size
    /// applies to all greater depths.
    pub sizes: Vec<DVec2>,
    /// Distance (m) between positions along a street.
    pub along: f64,
    /// Distance (m) between rows of positions.
    pub away: f64,
    /// Distance (m) from the edge of the street to the farthest front.
    pub distance: f64,
    /// Distance (m) from the edge of the street to the nearest front.
    pub setback: f64,
    /// Minimum distance (m) between sites.
    pub gap: f64,
    /// Minimum factor for shortening one side at random; the smallest size is not shortened.
    pub shrink: f64,
}

impl SiteOptions {
    /// Checks that the values are in range and consistent; the error names the field.
    pub fn check(&self) -> Result<()> {
        let sides = self.sizes.iter().flat_map(|size| size.to_array());
        if self.sizes.is_empty() || !sides.into_iter().all(|side| (1.0..=500.0).contains(&side)) {
            return Err(Error::argument("sizes must contain at least one pair of numbers from 1 to 500")
                .help("write sizes = { { 24, 18 }, { 12, 10 } }"));
        }
        let ranges = [
            ("along", self.along, 0.5, 1000.0),
            ("away", self.away, 0.5, 1000.0),
            ("distance", self.distance, 0.0, 2000.0),
            ("setback", self.setback, 0.0, 500.0),
            ("gap", self.gap, 0.0, 500.0),
            ("shrink", self.shrink, 0.1, 1.0),
        ];
        for (name, value, low, high) in ranges {
            if !(low..=high).contains(&value) {
                return Err(Error::argument(format!("{name} must be from {low} to {high}, not {value}")));
            }
        }
        if self.setback > self.distance {
            let text = format!(
                "setback ({} m) is more than distance ({} m), so no site fits next to a street",
                self.setback, self.distance
            );
            return Err(Error::argument(text).help("use a smaller setback, or a greater distance"));
        }
        Ok(())
    }
}

/// Site for a building.
#[derive(Debug, Clone, PartialEq)]
pub struct StreetSite {
    /// Identifier: the midpoint of the street segment, the side, the row, and the number within the row.
    pub id: String,
    /// Corners (m), counter-clockwise, the front first.
    pub corners: [DVec2; 4],
    /// Street segment that the site faces.
    pub piece: PieceId,
    /// Row behind the street, from 0.
    pub row: u32,
    /// Width and depth (m).
    pub size: DVec2,
    /// Direction from the front to the street.
    pub facing: DVec2,
}

/// Sites, with search statistics.
#[derive(Debug, Clone, Default)]
pub struct StreetSites {
    /// Sites in order of placement.
    pub sites: Vec<StreetSite>,
    /// Number of tested positions.
    pub tried: u64,
    /// Numbers of positions refused because of a street, another site, and an obstacle.
    pub refused: [u64; 3],
    /// Number of edges of streets and sites that the indices returned.
    pub looked_at: u64,
}

type Corners = [FinePlace; 4];

/// Placed sites, and the edges of streets.
struct SiteIndex {
    edges: RTree<IndexLine<[f64; 2]>>,
    placed: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
    corners: Vec<Corners>,
    looked_at: u64,
}

impl StreetNetwork {
    /// Returns sites along the streets, those at streets of the smallest depth first. `stream` returns random numbers
    /// from 0 to 1 for a segment's name, so the sites of a segment depend on nothing else.
    ///
    /// Fails if the options are invalid, or if too many positions would be tested.
    ///
    /// ```
    /// use burgeon_streets::{Constraints, Obstacles, SiteOptions, StreetAttributes, StreetNetwork, SurfaceOptions};
    /// use glam::DVec2;
    ///
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let start = network.begin(DVec2::ZERO)?;
    /// network.grow(start, DVec2::new(100.0, 0.0), StreetAttributes { width: 10.0, ..StreetAttributes::default() })?;
    /// let sizes = vec![DVec2::new(12.0, 10.0)];
    /// let options = SiteOptions { sizes, along: 4.0, away: 20.0, distance: 8.0, setback: 3.0, gap: 2.0, shrink: 1.0 };
    /// let found = network.sites(SurfaceOptions::default(), &options, &mut |_| Box::new(|| 0.5))?;
    /// assert!(found.sites.len() >= 6);
    /// assert!(found.sites.iter().all(|site| site.size == DVec2::new(12.0, 10.0)));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn sites(
        &self,
        surface: SurfaceOptions,
        options: &SiteOptions,
        stream: &mut dyn FnMut(&str) -> Box<dyn FnMut() -> f64>,
    ) -> Result<StreetSites> {
        options.check()?;
        let rows = self.rows(options);
        let length: f64 = self.pieces().map(|(piece, _)| self.length(piece)).sum();
        let places = length / options.along * 2.0 * f64::from(rows);
        if places > MOST_PLACES {
            let text = format!("{places:.0} positions along the streets are too many");
            return Err(Error::argument(text).help("use greater distances along and away"));
        }
        let mut index = SiteIndex::new(self, surface);
        let ground = self.pieces().filter(|(_, piece)| piece.attributes.level == 0);
        let mut pieces: Vec<PieceId> = ground.map(|(piece, _)| piece).collect();
        let order = |piece: &PieceId| {
            let [a, b] = self.grid_line(*piece);
            (self.attributes(*piece).depth, a.min(b), a.max(b))
        };
        pieces.sort_by_key(order);
        let mut found = StreetSites::default();
        for piece in pieces {
            self.sites_beside(piece, options, rows, &mut index, &mut found, stream);
        }
        found.looked_at = index.looked_at;
        Ok(found)
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "distances are limited")]
    fn rows(&self, options: &SiteOptions) -> u32 {
        ((options.distance - options.setback) / options.away).floor() as u32 + 1
    }

    fn sites_beside(
        &self,
        piece: PieceId,
        options: &SiteOptions,
        rows: u32,
        index: &mut SiteIndex,
        found: &mut StreetSites,
        stream: &mut dyn FnMut(&str) -> Box<dyn FnMut() -> f64>,
    ) {
        let [from, to] = self.line(piece);
        let middle = (from + to) / 2.0;
        let name = format!("{:.1}:{:.1}", middle.x + 0.0, middle.y + 0.0);
        let mut random = stream(&name);
        let depth = self.attributes(piece).depth as usize;
        let known = options.sizes[depth.min(options.sizes.len() - 1)];
        let smallest = options.sizes.iter().map(|size| size.element_product()).fold(f64::INFINITY, f64::min);
        let may_shrink = known.element_product() > smallest;
        // The same for both directions of a segment, because the direction is not visible.
        let way = (to - from).normalize_or_zero();
        let way = if way.x < 0.0 || (way.x == 0.0 && way.y < 0.0) { -way } else { way };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "places are limited")]
        let count = (self.length(piece) / options.along).floor() as u32 + 1;
        for row in 0..rows {
            for (side, letter) in [(1.0, 'l'), (-1.0, 'r')] {
                let aside = way.perp() * side;
                for number in 0..count {
                    let mut size = known;
                    let (which, share) = (random(), options.shrink + (1.0 - options.shrink) * random());
                    if may_shrink {
                        size[usize::from(which < 0.5)] *= share;
                    }
                    let along = (f64::from(number) - f64::from(count - 1) / 2.0) * options.along;
                    let edge = self.half(piece) + options.setback + f64::from(row) * options.away;
                    let foot = middle + way * along;
                    let front = foot + aside * edge;
                    found.tried += 1;
                    let half = way * side * (size.x / 2.0);
                    // The site is on the left of its front.
                    let corners = [
                        front - half,
                        front + half,
                        front + half + aside * size.y,
                        front - half + aside * size.y,
                    ];
                    let corners = corners.map(FinePlace::nearest);
                    let [Some(a), Some(b), Some(c), Some(d)] = corners else { continue };
                    let corners = [a, b, c, d];
                    let inside = front + aside * (size.y / 2.0);
                    if !index.is_off_streets(&corners, [foot, inside]) {
                        found.refused[0] += 1;
                    } else if !index.is_apart(&corners, options.gap) {
                        found.refused[1] += 1;
                    } else if self.obstacles().reach_into(&corners.map(FinePlace::metres)) {
                        found.refused[2] += 1;
                    } else {
                        index.add(corners);
                        found.sites.push(StreetSite {
                            id: format!("{name}/{letter}{row}.{number}"),
                            corners: corners.map(FinePlace::metres),
                            piece,
                            row,
                            size,
                            facing: -aside,
                        });
                    }
                }
            }
        }
    }
}

impl SiteIndex {
    fn new(network: &StreetNetwork, surface: SurfaceOptions) -> Self {
        let surfaces = network.surfaces(surface, &StreetProfiles::default());
        let edges =
            surfaces.sidewalks.iter().flat_map(|sidewalk| burgeon_geometry::planar::edges(&sidewalk.edge));
        let edges = edges.chain(surfaces.merged.edges.iter().copied());
        let edges = edges.filter_map(|edge| {
            let [a, b] = edge.map(|end| FinePlace::nearest(end.truncate()));
            let (a, b) = (a?.metres(), b?.metres());
            (a != b).then(|| IndexLine::new(a.to_array(), b.to_array()))
        });
        Self {
            edges: RTree::bulk_load(edges.collect()),
            placed: RTree::new(),
            corners: Vec::new(),
            looked_at: 0,
        }
    }

    /// Returns true if no street edge enters a site, and if only the edge of its own street is between it and the
    /// centreline.
    fn is_off_streets(&mut self, corners: &Corners, way: [DVec2; 2]) -> bool {
        let [low, high] = bounds(corners);
        let envelope = AABB::from_corners(low.min(way[0]).to_array(), high.max(way[0]).to_array());
        let [Some(foot), Some(inside)] = way.map(FinePlace::nearest) else { return false };
        let mut between = 0;
        for line in self.edges.locate_in_envelope_intersecting(&envelope) {
            self.looked_at += 1;
            let [Some(a), Some(b)] = [line.from, line.to].map(|at| FinePlace::nearest(DVec2::from(at)))
            else {
                return false;
            };
            if reaches([a, b], corners) {
                return false;
            }
            between += u32::from(fine_meet([foot, inside], [a, b]));
        }
        between == 1
    }

    /// Returns true if a site keeps its distance from all placed sites.
    fn is_apart(&mut self, corners: &Corners, gap: f64) -> bool {
        let wide = if gap > 0.0 { widen(corners, gap) } else { Some(*corners) };
        let Some(wide) = wide else { return false };
        let [low, high] = bounds(&wide);
        let envelope = AABB::from_corners(low.to_array(), high.to_array());
        for item in self.placed.locate_in_envelope_intersecting(&envelope) {
            self.looked_at += 1;
            if overlap(&wide, &self.corners[item.data]) {
                return false;
            }
        }
        true
    }

    fn add(&mut self, corners: Corners) {
        let [low, high] = bounds(&corners);
        let rectangle = Rectangle::from_corners(low.to_array(), high.to_array());
        self.placed.insert(GeomWithData::new(rectangle, self.corners.len()));
        self.corners.push(corners);
    }
}

fn bounds(corners: &Corners) -> [DVec2; 2] {
    let first = corners[0].metres();
    corners.iter().fold([first; 2], |[low, high], at| [low.min(at.metres()), high.max(at.metres())])
}

/// Returns the rectangle extended by `gap` (m) on each side.
fn widen(corners: &Corners, gap: f64) -> Option<Corners> {
    let [a, b, c, d] = corners.map(FinePlace::metres);
    let (x, y) = ((b - a).normalize_or_zero() * gap, (d - a).normalize_or_zero() * gap);
    let wide = [a - x - y, b + x - y, c + x + y, d - x + y].map(FinePlace::nearest);
    let [Some(a), Some(b), Some(c), Some(d)] = wide else { return None };
    Some([a, b, c, d])
}

fn sides(corners: &Corners) -> [[FinePlace; 2]; 4] {
    std::array::from_fn(|index| [corners[index], corners[(index + 1) % 4]])
}

/// Returns true if an edge intersects a convex area with counter-clockwise corners, including its border.
fn reaches(edge: [FinePlace; 2], corners: &Corners) -> bool {
    let outside = sides(corners).into_iter().any(|[a, b]| edge.iter().all(|end| fine_side(a, b, *end) < 0));
    let beside = |sign: i32| corners.iter().all(|corner| fine_side(edge[0], edge[1], *corner) == sign);
    !outside && !beside(1) && !beside(-1)
}

/// Returns true if two convex areas, counter-clockwise, share a point that is not on the border of both.
///
/// Method: separating axes. The areas do not overlap if a side of one has the whole other area on its outer side. The
/// test is exact.
pub(crate) fn overlap(a: &[FinePlace], b: &[FinePlace]) -> bool {
    let separates = |one: &[FinePlace], other: &[FinePlace]| {
        edges(one).any(|[from, to]| other.iter().all(|place| fine_side(from, to, *place) <= 0))
    };
    !separates(a, b) && !separates(b, a)
}
