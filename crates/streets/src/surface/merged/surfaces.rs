//! Merged surfaces at the heights of the streets.

use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use crate::plan::grid::foot;
use crate::plan::merge_cache::{MergeOptions, MergedLevel, MergedStreets};
use crate::plan::network::StreetNetwork;
use crate::shape::profile::StreetProfiles;
use crate::surface::parts::{StreetDeck, StreetSurface, StreetSurfaces, SurfaceOptions};
use burgeon_geometry::Rings;

/// Maximum length (m) of an edge if streets are not level.
const LONGEST: f64 = 12.0;
/// Maximum distance (m) between piers, and minimum distance (m) between a pier and the streets below.
const BAY: f64 = 24.0;
const BESIDE: f64 = 1.5;
/// Minimum height (m) above the ground at which a street has piers.
const LEAST_PIER: f64 = 3.0;

impl StreetNetwork {
    /// Returns the options for merged surfaces.
    pub(crate) fn merge_options(&self, options: SurfaceOptions, profiles: &StreetProfiles) -> MergeOptions {
        MergeOptions {
            turning: options.turning,
            longest: if profiles.is_flat() { f64::INFINITY } else { LONGEST },
        }
    }

    /// Returns the points (m) of a level at the heights of its streets.
    fn raise_points(&self, level: &MergedLevel, profiles: &StreetProfiles) -> Vec<DVec3> {
        if profiles.is_flat() {
            return level.points.iter().map(|at| at.extend(0.0)).collect();
        }
        level.points.iter().map(|at| at.extend(self.height_of(*at, level.level, profiles))).collect()
    }

    /// Returns the height (m) of the nearest street of a level.
    fn height_of(&self, at: DVec2, level: i32, profiles: &StreetProfiles) -> f64 {
        let nearest = self.nearest_of_level(at, level);
        nearest.map_or(0.0, |(piece, _)| profiles.height_near(self, piece, at))
    }

    pub(crate) fn add_merged(
        &self,
        merged: &MergedStreets,
        profiles: &StreetProfiles,
        surfaces: &mut StreetSurfaces,
    ) {
        for level in &merged.levels {
            let points = self.raise_points(level, profiles);
            let edge = |[a, b]: [u32; 2]| [points[a as usize], points[b as usize]];
            for (depth, triangles) in &level.carriageways {
                surfaces.carriageways.push(part(&points, triangles, *depth));
            }
            if !level.walks.is_empty() {
                surfaces.merged.walks.push(part(&points, &level.walks, 0));
            }
            surfaces.merged.kerbs.extend(level.kerbs.iter().copied().map(edge));
            if level.level == 0 {
                surfaces.merged.edges.extend(level.edges.iter().copied().map(edge));
            } else {
                surfaces.merged.decks.push(self.deck(level, &points, profiles));
            }
        }
    }

    /// Returns the deck that carries a level.
    fn deck(&self, level: &MergedLevel, points: &[DVec3], profiles: &StreetProfiles) -> StreetDeck {
        let carriageways = level.carriageways.iter().flat_map(|(_, triangles)| triangles);
        let triangles: Vec<[u32; 3]> = level.walks.iter().chain(carriageways).copied().collect();
        let sides = level.edges.iter().map(|edge| {
            let [a, b] = edge.map(|end| points[end as usize]);
            let way = (b - a).truncate().normalize_or_zero();
            let street = self.nearest_of_level(a.midpoint(b).truncate(), level.level);
            let along = street.is_some_and(|(piece, distance)| {
                let [from, to] = self.line(piece);
                let is_along = way.dot((to - from).normalize_or_zero()).abs() > 0.7;
                is_along && distance > self.half(piece) - 0.5
            });
            ([a, b], along)
        });
        StreetDeck {
            sides: sides.collect(),
            surface: part(points, &triangles, 0),
            piers: self.piers(level.level, profiles),
        }
    }

    /// Returns the piers below the streets of a level, placed between the streets below.
    fn piers(&self, level: i32, profiles: &StreetProfiles) -> Vec<(DVec3, DVec2)> {
        let mut piers = Vec::new();
        for (piece, _) in self.pieces().filter(|(_, piece)| piece.attributes.level == level) {
            let [from, to] = self.line(piece);
            let length = from.distance(to);
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pieces are short")]
            let count = (length / BAY).round() as u32;
            for index in 0..count {
                let along = length * (f64::from(index) + 0.5) / f64::from(count);
                let at = from.lerp(to, along / length);
                let height = profiles.height_along(piece, along);
                let mut below = self.pieces_near([at; 2], self.widest());
                let is_free = below.all(|other| {
                    let of = self.attributes(other);
                    of.level >= level
                        || of.level < 0
                        || foot(at, self.line(other)).0 > self.half(other) + BESIDE
                });
                if height > LEAST_PIER && is_free {
                    piers.push((at.extend(height), (to - from).normalize_or_zero()));
                }
            }
        }
        piers
    }

    pub(crate) fn merged_blocks(&self, merged: &MergedStreets, profiles: &StreetProfiles) -> Vec<Rings> {
        let Some(level) = merged.levels.iter().find(|level| level.level == 0) else { return Vec::new() };
        let is_flat = profiles.is_flat();
        let height = |at: DVec2| if is_flat { 0.0 } else { self.height_of(at, 0, profiles) };
        let raised = |ring: &Vec<DVec2>| ring.iter().map(|at| at.extend(height(*at))).collect::<Vec<_>>();
        level.blocks.iter().map(|block| block.rings.iter().map(raised).collect()).collect()
    }
}

/// Builds a surface from some triangles.
fn part(points: &[DVec3], triangles: &[[u32; 3]], depth: u32) -> StreetSurface {
    let mut surface = StreetSurface { depth, ..StreetSurface::default() };
    let mut numbers: FxHashMap<u32, u32> = FxHashMap::default();
    for corners in triangles {
        surface.triangles.push(corners.map(|corner| {
            *numbers.entry(corner).or_insert_with(|| {
                surface.points.push(points[corner as usize]);
                u32::try_from(surface.points.len() - 1).unwrap_or(u32::MAX)
            })
        }));
    }
    surface
}
