//! Grid of the heights of a geoid above the ellipsoid.

use std::path::Path;

use burgeon_base::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_data::elevation::{HeightOptions, Raster, SampleGrid};
use burgeon_spatial::Crs;

/// Heights (m) of a geoid, above which national heights are, above the WGS 84 ellipsoid.
#[derive(Debug, Clone)]
pub struct GeoidGrid(Raster);

impl GeoidGrid {
    /// Reads a grid in longitudes and latitudes, in a format of height files such as GeoTIFF; `name` is its name in messages.
    ///
    /// Fails if it cannot be read, if heights are missing, or if its coordinates are not degrees.
    pub fn open(path: &Path, name: &str) -> Result<Self> {
        let raster = Raster::open(path, name, &HeightOptions::default(), &Budget::default())?;
        if raster.filled > 0 {
            return Err(Error::data(format!(
                "{} heights of the geoid grid {name} are missing",
                raster.filled
            ))
            .help("cut out a part without missing heights: gdalwarp -te WEST SOUTH EAST NORTH IN OUT.tif"));
        }
        if raster.crs.as_ref().is_some_and(Crs::is_geographic) {
            return Ok(Self(raster));
        }
        Err(Error::data(format!("{name} is not a grid of longitudes and latitudes"))
            .help("convert it: gdalwarp -t_srs EPSG:4326 IN OUT.tif"))
    }

    /// Returns the height (m) of the geoid at a longitude and a latitude (degrees), interpolated between four samples.
    ///
    /// Fails outside the grid.
    pub fn height(&self, [longitude, latitude]: [f64; 2]) -> Result<f64> {
        let SampleGrid { first, step } = self.0.grid;
        let row = (first[1] - latitude) / step[1];
        // A grid may count longitudes from 0 to 360.
        let columns = [0.0, 360.0, -360.0].map(|turn| (longitude + turn - first[0]) / step[0]);
        let found = columns.into_iter().find_map(|column| self.interpolate(column, row));
        found.ok_or_else(|| {
            let name = &self.0.name;
            Error::data(format!(
                "the geoid grid {name} does not cover longitude {longitude:.4}, latitude {latitude:.4}"
            ))
            .help("specify a grid of the whole region: --geoid FILE; or a constant: --geoid-height METRES")
        })
    }

    /// Returns the height (m) at a column and a row; `None` outside.
    fn interpolate(&self, column: f64, row: f64) -> Option<f64> {
        let (x, left) = cell(column, self.0.columns)?;
        let (y, top) = cell(row, self.0.rows)?;
        let at =
            |x: usize, y: usize| self.0.heights.get(y * self.0.columns + x).map(|height| f64::from(*height));
        let mix = |a: f64, b: f64, part: f64| a + (b - a) * part;
        let upper = mix(at(left, top)?, at(left + 1, top)?, x);
        let lower = mix(at(left, top + 1)?, at(left + 1, top + 1)?, x);
        Some(mix(upper, lower, y)).filter(|height| height.is_finite())
    }
}

/// Returns the sample before a place between samples, and the part of the way to the next; `None` outside.
fn cell(place: f64, count: usize) -> Option<(f64, usize)> {
    // Samples at the border are exact up to the rounding of their coordinates.
    let near = 1e-6;
    let last = count.checked_sub(1)?;
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a grid has fewer samples than f64 has integers, and the range is checked"
    )]
    let found = (-near..=last as f64 + near).contains(&place).then(|| {
        let before = (place.max(0.0) as usize).min(last.saturating_sub(1));
        (place - before as f64, before)
    });
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEGREES: &str = r#"GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4326"]]"#;

    const METRES: &str = r#"PROJCS["RGF93 / Lambert-93",GEOGCS["RGF93",DATUM["RGF93",SPHEROID["GRS 1980",6378137,298.257222101]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Lambert_Conformal_Conic_2SP"],PARAMETER["standard_parallel_1",49],PARAMETER["standard_parallel_2",44],PARAMETER["latitude_of_origin",46.5],PARAMETER["central_meridian",3],PARAMETER["false_easting",700000],PARAMETER["false_northing",6600000],UNIT["metre",1],AUTHORITY["EPSG","2154"]]"#;

    fn grid(text: &str, crs: &str) -> Result<GeoidGrid> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("geoid.asc");
        std::fs::write(&path, text).unwrap();
        std::fs::write(path.with_extension("prj"), crs).unwrap();
        GeoidGrid::open(&path, "geoid.asc")
    }

    #[test]
    fn heights_are_interpolated_and_not_extrapolated() {
        let text =
            "ncols 3\nnrows 3\nxllcenter 2\nyllcenter 48\ncellsize 0.5\n44 45 46\n44 45 46\n40 41 42\n";
        let grid = grid(text, DEGREES).unwrap();
        let height = |longitude: f64, latitude: f64| grid.height([longitude, latitude]).ok();
        assert_eq!(height(2.0, 49.0), Some(44.0));
        assert!((height(2.25, 48.75).unwrap() - 44.5).abs() < 1e-6);
        assert!((height(2.5, 48.25).unwrap() - 43.0).abs() < 1e-6);
        assert!((height(362.25, 48.75).unwrap() - 44.5).abs() < 1e-6);
        for (longitude, latitude) in [(1.9, 48.5), (2.5, 49.1), (f64::NAN, 48.5)] {
            assert_eq!(height(longitude, latitude), None, "{longitude} {latitude}");
        }
        let error = grid.height([9.0, 48.5]).unwrap_err();
        assert!(
            error.message().contains("geoid.asc does not cover longitude 9.0000, latitude 48.5000"),
            "{error}"
        );
    }

    #[test]
    fn a_grid_in_metres_or_with_missing_heights_is_refused() {
        let holes =
            "ncols 2\nnrows 2\nxllcorner 2\nyllcorner 48\ncellsize 1\nNODATA_value -9999\n1 2\n3 -9999\n";
        let error = grid(holes, DEGREES).unwrap_err();
        assert!(error.message().starts_with("1 heights of the geoid grid geoid.asc are missing"), "{error}");
        let error =
            grid("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2\n3 4\n", METRES).unwrap_err();
        assert!(error.message().contains("not a grid of longitudes"), "{error}");
    }
}
