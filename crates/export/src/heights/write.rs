//! Writes height maps in the format of a file name.

use std::io::Write;
use std::path::Path;

use super::formats::{HEIGHT_FORMATS, HeightFormat};
use super::height_map::HeightMap;
use crate::{Files, extension_list};
use burgeon_base::error::{Error, Result};
use burgeon_spatial::ReferenceFrame;

/// Writes `map` to the future file `path`, in the format of its extension.
///
/// Coordinates of a GeoTIFF and an ASCII grid are in the projection of the run. If the file format cannot store the
/// projection, a `.prj` file next to the file contains it. Without a projection, coordinates are in metres of the run.
/// Fails if the map has too few heights or infinite heights, if the format cannot store it, or if the disk is full.
///
/// ```
/// use burgeon_export::{Files, heights};
/// use glam::DVec2;
///
/// let heights = vec![1.0, 2.0, 3.0, 4.5];
/// let map = heights::HeightMap { columns: 2, rows: 2, step: 10.0, corner: DVec2::ZERO, frame: None, heights };
/// let folder = tempfile::tempdir()?;
/// let mut files = Files::default();
/// heights::write(&map, &folder.path().join("hill.asc"), &mut files)?;
/// files.publish()?;
/// let grid = std::fs::read_to_string(folder.path().join("hill.asc"))?;
/// assert!(grid.starts_with("ncols") && grid.trim_end().ends_with("3 4.5"), "{grid}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(map: &HeightMap, path: &Path, files: &mut Files) -> Result<()> {
    let format = HeightFormat::of(path)?;
    format.file.check()?;
    check(map, format).map_err(|error| error.about(&format!("cannot write {}", path.display())))?;
    if let Some(companion) = format.file.companion(path).filter(|_| !(format.has_projection)(map))
        && let Some(text) = map.frame.as_ref().and_then(ReferenceFrame::well_known_text)
    {
        files.write(&companion, |out| writeln!(out, "{text}"))?;
    }
    files.write(path, |out| (format.write)(map, out))
}

/// Checks that `map` can be written in `format`.
fn check(map: &HeightMap, format: &HeightFormat) -> Result<()> {
    let (columns, rows) = (map.columns, map.rows);
    let fits = columns.checked_mul(rows) == Some(map.heights.len());
    if !fits || columns < 2 || rows < 2 {
        let count = map.heights.len();
        return Err(Error::argument(format!(
            "the height map has {columns} x {rows} cells, but {count} heights"
        ))
        .help("give one height for each place, at least 2 x 2"));
    }
    if !(map.step.is_finite() && map.step > 0.0 && map.corner.is_finite()) {
        return Err(Error::argument(format!(
            "the height map has steps of {} m from {}",
            map.step, map.corner
        ))
        .help("give a positive step and a finite corner"));
    }
    if let Some(index) = map.heights.iter().position(|height| height.is_infinite()) {
        return Err(Error::argument(format!(
            "the height in row {}, column {} is infinite",
            index / columns + 1,
            index % columns + 1
        ))
        .help("give finite heights"));
    }
    let extension = format.file.extension();
    if !format.has_gaps && map.heights.iter().any(|height| height.is_nan()) {
        let others = extension_list(HEIGHT_FORMATS.iter().filter(|other| other.has_gaps), "or");
        return Err(Error::argument(format!("a .{extension} file cannot leave heights out"))
            .help(format!("write one of the formats {others}")));
    }
    if !format.has_size && columns != rows {
        let others = extension_list(HEIGHT_FORMATS.iter().filter(|other| other.has_size), "or");
        return Err(Error::argument(format!(
            "a .{extension} file stores no width, and {columns} x {rows} is not square"
        ))
        .help(format!("make it square, or write one of the formats {others}")));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write_alone(map: &HeightMap, path: &Path) -> Result<()> {
        let mut files = Files::default();
        write(map, path, &mut files)?;
        files.publish()
    }
    use burgeon_data::elevation::{HeightOptions, Raster};
    use burgeon_spatial::Crs;
    use glam::DVec2;

    /// Returns hills of 12 by `rows` heights.
    fn map(rows: usize, frame: Option<ReferenceFrame>) -> HeightMap {
        let height =
            |at: usize| 250.0 + 80.0 * ((at % 12) as f64 * 0.7).sin() * ((at / 12) as f64 * 0.4).cos();
        let heights = (0..12 * rows).map(height).collect();
        HeightMap { columns: 12, rows, step: 2.5, corner: DVec2::new(-40.0, 30.0), frame, heights }
    }

    fn frame(code: u32, at: [f64; 2]) -> Option<ReferenceFrame> {
        Some(ReferenceFrame::around(&Crs::epsg(code).unwrap(), at, "a").unwrap())
    }

    /// Writes a map and reads it back.
    fn write_and_read(map: &HeightMap, name: &str, wanted: &HeightOptions) -> Raster {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        write_alone(map, &path).unwrap();
        let has_text = path.with_extension("prj").exists();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1 + usize::from(has_text));
        Raster::open(&path, name, wanted, &burgeon_base::budget::Budget::default()).unwrap()
    }

    fn assert_same(raster: &Raster, map: &HeightMap, tolerance: f64) {
        assert_eq!((raster.columns, raster.rows, raster.filled), (map.columns, map.rows, 0));
        for (found, height) in raster.heights.iter().zip(&map.heights) {
            assert!((f64::from(*found) - height).abs() <= tolerance, "{found} {height}");
        }
    }

    #[test]
    fn what_is_written_is_read_back_in_every_format() {
        let edges = [-40.0, 30.0, -10.0, 52.5];
        let wanted = HeightOptions { bounds: Some(edges), ..HeightOptions::default() };
        let (hills, square) = (map(9, None), map(12, None));
        for (name, tolerance) in [("a.asc", 2e-5), ("a.tif", 2e-5), ("a.TIFF", 2e-5)] {
            let raster = write_and_read(&hills, name, &HeightOptions::default());
            assert_same(&raster, &hills, tolerance);
            assert_eq!((raster.bounds(), raster.crs), (edges, None), "{name}");
        }
        assert_same(&write_and_read(&hills, "a.png", &wanted), &hills, 160.0 / 65535.0);
        for name in ["a.r32", "a.f32", "a.r64", "a.f64"] {
            assert_same(&write_and_read(&square, name, &wanted), &square, 2e-5);
        }
    }

    #[test]
    fn a_geotiff_and_an_ascii_grid_tell_the_projection_of_the_run() {
        // Feet become metres, which no EPSG code describes.
        for (code, at, crs) in [
            (3067, [385_423.0, 6_671_463.0], "EPSG:3067"),
            (4326, [7.42, 43.73], "transverse Mercator around 7.4, 43.7"),
            (2272, [2_690_000.0, 235_000.0], "NAD83 / Pennsylvania South (ftUS) in metres"),
        ] {
            let map = map(9, frame(code, at));
            for name in ["a.tif", "a.asc"] {
                let raster = write_and_read(&map, name, &HeightOptions::default());
                assert_same(&raster, &map, 2e-5);
                assert_eq!(raster.crs.as_ref().unwrap().name(), crs, "{name}");
                let mut there = map.frame.clone();
                let origin = map.frame.as_ref().unwrap().origin;
                assert_eq!(raster.bounds()[..2], [origin[0] - 40.0, origin[1] + 30.0], "{name} {code}");
                let relief = burgeon_data::elevation::Relief::new(raster.into(), &mut there).unwrap();
                assert!(relief.low().truncate().distance(map.corner) < 1e-6, "{name} {code}");
            }
        }
    }

    #[test]
    fn a_plain_and_holes_are_written_too() {
        let mut plain = map(9, None);
        plain.heights.fill(42.0);
        let wanted = HeightOptions { bounds: Some([0.0, 0.0, 1.0, 1.0]), ..HeightOptions::default() };
        assert_same(&write_and_read(&plain, "a.png", &wanted), &plain, 1e-6);
        plain.heights[17] = f64::NAN;
        for name in ["a.asc", "a.tif"] {
            let raster = write_and_read(&plain, name, &HeightOptions::default());
            assert_eq!((raster.filled, raster.heights[17]), (1, 42.0));
        }
    }

    #[test]
    fn what_cannot_be_written_is_refused_and_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let told = |map: &HeightMap, name: &str| {
            let path = folder.path().join(name);
            let error = write_alone(map, &path).unwrap_err();
            assert!(error.remedy().is_some() && !path.exists(), "{error}");
            error.message().replace(&folder.path().display().to_string(), "FOLDER")
        };
        let mut hills = map(9, None);
        insta::assert_snapshot!(told(&hills, "a.r32"), @"cannot write FOLDER/a.r32: a .r32 file stores no width, and 12 x 9 is not square");
        insta::assert_snapshot!(told(&hills, "a.obj"), @"cannot write FOLDER/a.obj: unknown file extension .obj");
        hills.heights[13] = f64::NAN;
        insta::assert_snapshot!(told(&hills, "a.png"), @"cannot write FOLDER/a.png: a .png file cannot leave heights out");
        hills.heights[13] = f64::INFINITY;
        insta::assert_snapshot!(told(&hills, "a.tif"), @"cannot write FOLDER/a.tif: the height in row 2, column 2 is infinite");
        hills.heights.pop();
        insta::assert_snapshot!(told(&hills, "a.tif"), @"cannot write FOLDER/a.tif: the height map has 12 x 9 cells, but 107 heights");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
