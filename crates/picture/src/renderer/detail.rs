//! How much time a picture takes, in numbers.

use super::super::settings::Quality;

/// The numbers behind a [`Quality`].
#[derive(Debug, Clone)]
pub(super) struct RenderDetail {
    /// Columns of samples in a pixel.
    pub columns: usize,
    /// Rows of samples in a pixel. Each row is shifted, so that no two samples share their x.
    pub rows: usize,
    /// Directions from which the sky shines.
    pub sky_maps: usize,
    /// Side of a square with as many texels as a map of the sky.
    pub sky_side: f32,
    /// Side of a square with as many texels as the sun's map.
    pub sun_side: f32,
    /// Lookups in the sun's map for one pixel.
    pub sun_taps: usize,
}

impl RenderDetail {
    /// What `quality` means for a scene of so many `triangles`: the sky gets fewer maps where each costs
    /// more.
    pub(super) fn of(quality: Quality, triangles: usize) -> Self {
        let affordable =
            |budget: usize, most: usize, least: usize| (budget / triangles.max(1)).clamp(least, most);
        match quality {
            Quality::Draft => Self {
                columns: 1,
                rows: 4,
                sky_maps: affordable(2_500_000, 40, 10),
                sky_side: 160.0,
                sun_side: 768.0,
                sun_taps: 12,
            },
            Quality::Fine => Self {
                columns: 2,
                rows: 8,
                sky_maps: affordable(26_000_000, 112, 18),
                sky_side: 768.0,
                sun_side: 4096.0,
                sun_taps: 40,
            },
        }
    }

    /// The number of samples in a pixel.
    pub(super) fn samples(&self) -> usize {
        self.columns * self.rows
    }
}
