//! Images of the ground on terrain tiles.

use burgeon_base::error::Result;
use burgeon_base::srgb_byte;
use burgeon_scene::{Material, Texture};
use glam::{DVec2, Vec2};
use rayon::prelude::*;

/// Point of the ground whose colour is wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroundSample {
    /// Place (m) in the coordinates of the run.
    pub place: DVec2,
    /// Height (m).
    pub height: f64,
    /// Slope (degrees).
    pub slope: f64,
    /// Curvature (1/m), positive in hollows; 0 if the colours do not depend on it.
    pub curvature: f64,
}

/// Colours of the ground, in linear red, green and blue from 0 to 1.
pub trait GroundColors: Sync {
    /// Returns the colour of the whole ground; `None` if it differs between points.
    fn uniform(&self) -> Option<[f32; 3]>;

    /// Returns true if colours depend on the curvature.
    fn is_bent(&self) -> bool;

    /// Returns the colour of a point.
    fn color(&self, sample: &GroundSample) -> [f32; 3];
}

/// Colours of a terrain that no script describes.
pub struct PlainGround;

/// Colour of a terrain that no script describes, in linear red, green and blue.
const PLAIN: [f32; 3] = [0.42, 0.44, 0.34];

impl GroundColors for PlainGround {
    fn uniform(&self) -> Option<[f32; 3]> {
        Some(PLAIN)
    }

    fn is_bent(&self) -> bool {
        false
    }

    fn color(&self, _sample: &GroundSample) -> [f32; 3] {
        PLAIN
    }
}

/// Number of intervals between texels along a side of an image.
const INTERVALS: u16 = 128;

/// Largest number of samples along a side of the square that a texel stands for.
const MOST_SAMPLES: f64 = 4.0;

/// Square on the ground that an image covers. Its outermost texels are on the sides, so that images of adjacent tiles match.
pub(super) struct GroundImage {
    /// South-western corner (m).
    corner: DVec2,
    /// Length (m) of the sides.
    side: f64,
    /// Red, green and blue of the texels, row by row from the north.
    bytes: Vec<u8>,
}

impl GroundImage {
    /// Paints the image of the square at `corner` with sides of `side` (m). `height` returns the height (m) at a place, if there is
    /// one, and slopes are measured over `step` (m), the same for all levels.
    ///
    /// A texel has the mean colour of samples around it, so that small patches stay as a shade in the images of large squares. Fails as
    /// soon as `proceed` fails, which is called before each row.
    pub(super) fn paint(
        (corner, side, step): (DVec2, f64, f64),
        colors: &dyn GroundColors,
        height: impl Fn(DVec2) -> Option<f64> + Sync,
        proceed: &(impl Fn() -> Result<()> + Sync),
    ) -> Result<Self> {
        let distance = side / f64::from(INTERVALS);
        let samples = (distance / step).clamp(1.0, MOST_SAMPLES).floor();
        let offsets: Vec<f64> = std::iter::successors(Some(0.0), |at| Some(at + 1.0))
            .take_while(|at| *at < samples)
            .map(|at| ((at + 0.5) / samples - 0.5) * distance)
            .collect();
        let sample = |place: DVec2| {
            let here = height(place)?;
            let beside = |x: f64, y: f64| height(place + DVec2::new(x, y) * step).unwrap_or(here);
            let [east, west, north, south] =
                [beside(1.0, 0.0), beside(-1.0, 0.0), beside(0.0, 1.0), beside(0.0, -1.0)];
            let slope = DVec2::new(east - west, north - south).length() / (2.0 * step);
            let curvature = match colors.is_bent() {
                true => (east + west + north + south - 4.0 * here) / (step * step),
                false => 0.0,
            };
            let sample = GroundSample { place, height: here, slope: slope.atan().to_degrees(), curvature };
            Some(colors.color(&sample))
        };
        let texel = |column: u16, row: u16| {
            let middle = corner + DVec2::new(f64::from(column), f64::from(INTERVALS - row)) * distance;
            let around = offsets.iter().flat_map(|y| offsets.iter().map(|x| DVec2::new(*x, *y)));
            mean(around.filter_map(|offset| sample(middle + offset)))
        };
        let row = |row: u16| -> Result<Vec<Option<[f32; 3]>>> {
            proceed()?;
            Ok((0..=INTERVALS).map(|column| texel(column, row)).collect())
        };
        let rows: Vec<_> = (0..=INTERVALS).into_par_iter().map(row).collect::<Result<_>>()?;
        let texels = || rows.iter().flatten();
        // Reduced images also show texels beside the ground.
        let rest = mean(texels().flatten().copied()).unwrap_or_default();
        let bytes = texels().flat_map(|texel| texel.unwrap_or(rest).map(srgb_byte)).collect();
        Ok(Self { corner, side, bytes })
    }

    /// Returns the texture coordinates (m) of a place.
    pub(super) fn tex_coord(&self, place: DVec2) -> Vec2 {
        let half = self.side / f64::from(INTERVALS) / 2.0;
        (place - self.corner + half).as_vec2()
    }

    /// Returns the material of the ground with the image.
    pub(super) fn material(&self, roughness: f32) -> Result<Material> {
        let across = u32::from(INTERVALS) + 1;
        let png = burgeon_scene::image::encode_opaque(across, across, &self.bytes)?;
        let whole = self.side * f64::from(across) / f64::from(INTERVALS);
        let texture = Texture { path: "ground.png".into(), size: [whole, whole], content: Some(png.into()) };
        Ok(Material { base_color: [1.0; 4], roughness, texture: Some(texture), ..Material::default() })
    }
}

/// Returns the mean of colours; `None` without colours.
fn mean(colors: impl Iterator<Item = [f32; 3]>) -> Option<[f32; 3]> {
    let add = |(sum, count): ([f32; 3], f32), color: [f32; 3]| {
        ([0, 1, 2].map(|at| sum[at] + color[at]), count + 1.0)
    };
    let (sum, count) = colors.fold(([0.0; 3], 0.0), add);
    (count > 0.0).then(|| sum.map(|sum| sum / count))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use burgeon_base::error::Error;

    use super::*;

    /// Colours that differ with the slope and with the place, in stripes of 3 m.
    struct Stripes;

    impl GroundColors for Stripes {
        fn uniform(&self) -> Option<[f32; 3]> {
            None
        }

        fn is_bent(&self) -> bool {
            false
        }

        fn color(&self, sample: &GroundSample) -> [f32; 3] {
            let is_odd = (sample.place.x / 3.0).floor().rem_euclid(2.0) > 0.5;
            [if is_odd { 1.0 } else { 0.0 }, if sample.slope > 20.0 { 1.0 } else { 0.0 }, 0.25]
        }
    }

    fn paint_square(square: (DVec2, f64, f64), height: impl Fn(DVec2) -> Option<f64> + Sync) -> GroundImage {
        GroundImage::paint(square, &Stripes, height, &|| Ok(())).unwrap()
    }

    fn texel(image: &GroundImage, column: usize, row: usize) -> &[u8] {
        let at = (row * (usize::from(INTERVALS) + 1) + column) * 3;
        &image.bytes[at..at + 3]
    }

    #[test]
    fn images_of_adjacent_squares_have_the_same_texels_at_their_common_side() {
        let height = |place: DVec2| Some(place.x * place.y * 0.01);
        let at = |x: f64, side: f64| paint_square((DVec2::new(x, -64.0), side, 1.0), height);
        let (west, east) = (at(-128.0, 128.0), at(0.0, 128.0));
        let last = usize::from(INTERVALS);
        assert!((0..=last).all(|row| texel(&west, last, row) == texel(&east, 0, row)));
        assert!((0..=last).any(|row| texel(&east, 0, row)[1] > 0) && texel(&east, 0, last / 2)[1] == 0);
        assert_eq!(west.tex_coord(DVec2::new(0.0, -64.0)), Vec2::new(128.5, 0.5));
    }

    #[test]
    fn a_texel_of_a_large_square_has_the_mean_colour_and_slopes_do_not_depend_on_the_level() {
        // Waves of 8 m with slopes of up to 45 degrees, which are invisible at intervals of 32 m.
        let height =
            |place: DVec2| Some((place.y * std::f64::consts::TAU / 8.0).sin() * 8.0 / std::f64::consts::TAU);
        let image = paint_square((DVec2::ZERO, 4096.0, 1.0), height);
        let greens = (20..100).map(|row| u32::from(texel(&image, 64, row)[1])).sum::<u32>() / 80;
        assert!(greens > 150, "{greens}");
        let reds = (20..100).map(|column| u32::from(texel(&image, column, 64)[0])).sum::<u32>() / 80;
        // Half of the light is 188 in sRGB.
        assert!((150..210).contains(&reds), "{reds}");
    }

    #[test]
    fn an_image_ends_before_the_row_at_which_it_may_not_proceed() {
        let (rows, heights) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let height = |_: DVec2| {
            heights.fetch_add(1, Ordering::Relaxed);
            Some(0.0)
        };
        let proceed = || match rows.fetch_add(1, Ordering::Relaxed) {
            0..10 => Ok(()),
            _ => Err(Error::cancellation("stopped")),
        };
        let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let square = (DVec2::ZERO, 128.0, 1.0);
        let image = threads.install(|| GroundImage::paint(square, &Stripes, height, &proceed));
        assert_eq!(image.err().unwrap().message(), "stopped");
        // A sample needs five heights, and a row has 129 samples.
        assert_eq!(heights.into_inner(), 10 * 129 * 5);
    }

    #[test]
    fn texels_without_ground_have_the_mean_colour_of_the_others() {
        let height = |place: DVec2| (place.x < 32.0).then_some(0.0);
        let image = paint_square((DVec2::ZERO, 128.0, 1.0), height);
        assert_eq!(texel(&image, 100, 5), texel(&image, 120, 90));
        assert!(texel(&image, 100, 5)[0] > 100 && texel(&image, 100, 5)[2] == 137);
    }
}
