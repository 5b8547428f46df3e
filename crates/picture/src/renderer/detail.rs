//! Parameters that determine the time and the quality of a render.

use super::super::settings::Quality;

/// Parameters of a [`Quality`].
#[derive(Debug, Clone)]
pub(super) struct RenderDetail {
    /// Number of sample columns in a pixel.
    pub columns: usize,
    /// Number of sample rows in a pixel. Each row is shifted, so that no two samples have the same x.
    pub rows: usize,
    /// Number of sky light directions.
    pub sky_maps: usize,
    /// Side of a square with as many texels as a map of the sky.
    pub sky_side: f32,
    /// Set if points may stand for small triangles in the maps of the sky.
    pub sky_points: bool,
    /// Side of a square with as many texels as the sun's map.
    pub sun_side: f32,
    /// Number of lookups in the sun's map for one pixel.
    pub sun_taps: usize,
    /// Set if the two by two pixels that see one surface share the sky's light, as do crowded pixels, and if the surfaces of a
    /// crowded pixel share the lookups in the sun's map.
    pub pools_light: bool,
    /// Number of neighbouring pixels among which the maps of the sky are divided: 1, or the square of 2 or 4. The pixels
    /// then share the light that they gather.
    pub turns: usize,
    /// Maximum number of surfaces of a pixel that are shaded; those of fewer samples count as the others.
    pub surfaces: usize,
    /// Diameter (pixels) below which tubes are drawn with fewer sides.
    pub thin_diameter: f32,
    /// Set if smooth surfaces mirror the model.
    pub traces: bool,
}

impl RenderDetail {
    /// Returns the parameters of `quality` for a scene with this number of `triangles`. Scenes with more triangles get
    /// fewer sky maps, because each map takes longer.
    pub(super) fn of(quality: Quality, triangles: usize) -> Self {
        let affordable =
            |budget: usize, most: usize, least: usize| (budget / triangles.max(1)).clamp(least, most);
        match quality {
            Quality::Draft => Self {
                columns: 1,
                rows: 4,
                sky_maps: affordable(4_000_000, 40, 16),
                sky_side: 192.0,
                sky_points: true,
                sun_side: 1024.0,
                sun_taps: 10,
                pools_light: true,
                turns: 1,
                surfaces: 2,
                thin_diameter: 0.5,
                traces: false,
            },
            Quality::Film => Self {
                columns: 2,
                rows: 4,
                sky_maps: affordable(56_000_000, 28, 20),
                sky_side: 192.0,
                sky_points: true,
                sun_side: 1280.0,
                sun_taps: 16,
                pools_light: true,
                turns: 1,
                surfaces: 4,
                thin_diameter: 0.5,
                traces: false,
            },
            Quality::Fine => Self {
                columns: 1,
                rows: 8,
                sky_maps: affordable(26_000_000, 72, 36),
                sky_side: 448.0,
                sky_points: true,
                sun_side: 3072.0,
                sun_taps: 28,
                pools_light: false,
                turns: 4,
                surfaces: 4,
                thin_diameter: 0.0,
                traces: true,
            },
            Quality::Best => Self {
                columns: 2,
                rows: 8,
                sky_maps: affordable(26_000_000, 112, 28),
                sky_side: 768.0,
                sky_points: false,
                sun_side: 4096.0,
                sun_taps: 40,
                pools_light: false,
                turns: 1,
                surfaces: usize::MAX,
                thin_diameter: 0.0,
                traces: true,
            },
        }
    }

    /// Returns the number of samples in a pixel.
    pub(super) fn samples(&self) -> usize {
        self.columns * self.rows
    }
}
