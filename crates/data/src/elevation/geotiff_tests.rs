//! Tests of the scale, offset and unit of heights in GeoTIFF files.

use tiff::tags::Tag;

use super::tests::{SCALE, TIE, geotiff, geotiff_saying, read};

#[test]
fn scale_and_offset_of_the_band_make_heights_of_its_samples() {
    let area = [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 3067];
    let item = |name: &str, value: &str| {
        let role = name.to_ascii_lowercase();
        format!("<Item name=\"{name}\" sample=\"0\" role=\"{role}\">{value}</Item>")
    };
    let metadata = |items: &[String]| format!("<GDALMetadata>\n  {}\n</GDALMetadata>\n", items.join("\n  "));
    let heights = |metadata: &str| {
        let bytes = geotiff_saying(&area, &[SCALE, TIE], Some("3"), Some(metadata));
        read(&bytes, "a.tif").map(|raster| (raster.filled, raster.heights[5], raster.heights[20]))
    };
    let both = metadata(&[item("OFFSET", "5"), item("SCALE", "0.1")]);
    // The marker of missing values applies to samples, not to heights.
    assert_eq!(heights(&both).unwrap(), (1, 5.5, 7.0));
    assert_eq!(heights(&metadata(&[item("SCALE", "2")])).unwrap(), (1, 10.0, 40.0));
    assert_eq!(heights(&metadata(&[item("OFFSET", "-100")])).unwrap(), (1, -95.0, -80.0));
    assert_eq!(heights(&metadata(&[item("UNITTYPE", "cm")])).unwrap(), (1, 0.05, 0.2));
    assert_eq!(heights(&metadata(&[])).unwrap(), (1, 5.0, 20.0));
    for wrong in ["0", "nan", "inf"] {
        assert!(
            heights(&metadata(&[item("SCALE", wrong)])).unwrap_err().message().contains("with the scale")
        );
    }
    assert!(
        heights(&metadata(&[item("UNITTYPE", "furlong")])).unwrap_err().message().contains("unknown unit")
    );
}

#[test]
fn a_place_in_space_scales_heights_where_the_file_says_that_they_are_heights() {
    let area = [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 3067];
    let vertical = [1, 1, 0, 4, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 3067, 4096, 0, 1, 5773];
    let scale = (SCALE.0, &[10.0, 20.0, 0.5][..]);
    let tie = (TIE.0, &[0.0, 0.0, 4.0, 385_000.0, 6_671_000.0, 100.0][..]);
    let height = |keys: &[u16], place: &[(Tag, &[f64])]| {
        read(&geotiff(keys, place, None), "a.tif").unwrap().heights[10]
    };
    assert_eq!(height(&vertical, &[scale, tie]), 103.0);
    assert_eq!((height(&area, &[scale, tie]), height(&vertical, &[SCALE, TIE])), (10.0, 10.0));
    let matrix =
        [10.0, 0.0, 0.0, 385_000.0, 0.0, -20.0, 0.0, 6_671_000.0, 0.0, 0.0, 2.0, 7.0, 0.0, 0.0, 0.0, 1.0];
    let place = (Tag::ModelTransformationTag, &matrix[..]);
    assert_eq!((height(&vertical, &[place]), height(&area, &[place])), (27.0, 10.0));
}
