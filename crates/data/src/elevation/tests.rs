//! Tests of readers with valid and invalid files.

use std::io::{Cursor, Write};
use std::time::{Duration, Instant};

use proptest::prelude::*;
use tiff::encoder::{TiffEncoder, colortype};
use tiff::tags::Tag;
use zip::write::SimpleFileOptions;

use super::*;
use burgeon_base::budget::Budget;

/// Returns a tile of `side` by `side` heights; the first is `first`, and each next one is greater by 1.
fn tile(side: i16, first: i16) -> Vec<u8> {
    (0..side * side).flat_map(|at| (first + at).to_be_bytes()).collect()
}

/// Returns a tile of some columns and rows, whose heights encode their positions.
fn wide([columns, rows]: [usize; 2]) -> Vec<u8> {
    let height = |at: usize| i16::try_from(at % columns * 4 + at / columns % 4).unwrap();
    (0..columns * rows).flat_map(|at| height(at).to_be_bytes()).collect()
}

fn zipped(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        zip.start_file(*name, SimpleFileOptions::default()).unwrap();
        zip.write_all(content).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

/// Returns a TIFF of 6 by 4 samples with the given tags.
pub(super) fn geotiff(keys: &[u16], place: &[(Tag, &[f64])], missing: Option<&str>) -> Vec<u8> {
    geotiff_saying(keys, place, missing, None)
}

/// Returns the same TIFF with GDAL metadata of its band.
pub(super) fn geotiff_saying(
    keys: &[u16],
    place: &[(Tag, &[f64])],
    missing: Option<&str>,
    metadata: Option<&str>,
) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    let mut image = encoder.new_image::<colortype::GrayI16>(6, 4).unwrap();
    image.rows_per_strip(3).unwrap();
    let tags = image.encoder();
    for (tag, values) in place {
        tags.write_tag(*tag, *values).unwrap();
    }
    if !keys.is_empty() {
        tags.write_tag(Tag::GeoKeyDirectoryTag, keys).unwrap();
    }
    if let Some(missing) = missing {
        tags.write_tag(Tag::GdalNodata, missing).unwrap();
    }
    if let Some(metadata) = metadata {
        tags.write_tag(Tag::Unknown(42112), metadata).unwrap();
    }
    image.write_data(&(0..24i16).collect::<Vec<_>>()).unwrap();
    bytes.into_inner()
}

pub(super) fn read(bytes: &[u8], name: &str) -> Result<Raster, burgeon_base::error::Error> {
    Raster::read(bytes, name, &HeightOptions::default(), &Budget::default())
}

/// Reads a file that does not contain its position.
fn read_square(bytes: &[u8], name: &str) -> Result<Raster, burgeon_base::error::Error> {
    let wanted =
        HeightOptions { bounds: Some([7.0, 43.0, 8.0, 44.0]), crs: Some(4326), ..HeightOptions::default() };
    Raster::read(bytes, name, &wanted, &Budget::default())
}

pub(super) const SCALE: (Tag, &[f64]) = (Tag::ModelPixelScaleTag, &[10.0, 20.0, 0.0]);
pub(super) const TIE: (Tag, &[f64]) = (Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, 385_000.0, 6_671_000.0, 0.0]);

#[test]
fn a_tile_lies_where_its_name_says() {
    let bytes = wide([1201; 2]);
    for (name, first) in [
        ("N43E007.hgt", [7.0, 44.0]),
        ("data/s01w080.HGT", [-80.0, 0.0]),
        ("N43E007.SRTMGL1.hgt", [7.0, 44.0]),
    ] {
        let raster = read(&bytes, name).unwrap();
        assert_eq!((raster.columns, raster.rows, raster.grid.first), (1201, 1201, first), "{name}");
        assert_eq!((raster.grid.step, raster.heights[1201 + 6]), ([1.0 / 1200.0; 2], 25.0));
        assert_eq!(raster.crs.and_then(|crs| crs.code), Some(4326));
    }
    for name in ["N91E007.hgt", "N43E190.hgt", "a.hgt", "N4+E007.hgt"] {
        assert!(
            read(&bytes, name).unwrap_err().message().contains("does not contain its location"),
            "{name}"
        );
    }
    let north = read(&wide([1801, 3601]), "N61E007.hgt").unwrap();
    assert_eq!((north.columns, north.rows, north.grid.step), (1801, 3601, [1.0 / 1800.0, 1.0 / 3600.0]));
}

#[test]
fn only_tiles_of_known_sizes_are_a_degree_large_unless_their_place_is_given() {
    for side in [2, 5, 400, 1200, 1202] {
        let bytes = vec![1; side * side * 2];
        let error = read(&bytes, "N43E007.hgt").unwrap_err();
        assert_eq!(
            error.message(),
            format!("N43E007.hgt has {side} x {side} heights, which is not the size of a one-degree tile")
        );
        let zip = zipped(&[("N43E007.hgt", &bytes)]);
        assert!(
            read(&zip, "N43E007.hgt.zip")
                .unwrap_err()
                .message()
                .contains("not the size of a one-degree tile")
        );
        let raster = read_square(&bytes, "N43E007.hgt").unwrap();
        assert_eq!((raster.columns, raster.bounds()[0]), (side, 7.0));
    }
}

#[test]
fn a_zip_gives_its_one_tile() {
    let plain = read_square(&tile(9, 1), "N43E007.hgt").unwrap();
    let zip = zipped(&[("read.me", b"x"), ("a/N43E007.hgt", &tile(9, 1))]);
    let packed = read_square(&zip, "b.zip").unwrap();
    assert_eq!((packed.heights, packed.grid), (plain.heights, plain.grid));
    for (files, why) in [
        (&[("a.txt", b"x".as_slice())][..], "contains no .hgt file"),
        (&[("a.hgt", b"x"), ("b.hgt", b"x")], "contains 2 .hgt files"),
        (&[("a.hgt", b"")], "is empty"),
        (&[("a.hgt", b"xyz")], "is not square"),
    ] {
        let error = read(&zipped(files), "b.zip").unwrap_err();
        assert!(error.message().contains(why), "{error}");
    }
    assert!(read(&zip[..zip.len() / 2], "b.zip").unwrap_err().message().contains("cannot be unpacked"));
}

#[test]
fn tags_tell_where_a_geotiff_lies() {
    let area = [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 3067];
    let raster = read(&geotiff(&area, &[SCALE, TIE], Some("5")), "a.tif").unwrap();
    assert_eq!((raster.columns, raster.rows, raster.filled), (6, 4, 1));
    assert_eq!(raster.grid, SampleGrid { first: [385_005.0, 6_670_990.0], step: [10.0, 20.0] });
    assert_eq!(raster.bounds(), [385_000.0, 6_670_920.0, 385_060.0, 6_671_000.0]);
    assert_eq!((raster.heights[4], raster.heights[23]), (4.0, 23.0));
    assert_eq!(raster.crs.and_then(|crs| crs.code), Some(3067));
    let mut point = area;
    point[11] = 2;
    let raster = read(&geotiff(&point, &[SCALE, TIE], None), "a.tif").unwrap();
    assert_eq!(raster.grid.first, [385_000.0, 6_671_000.0]);
    // The same position given by a matrix, and a file with rows from the south.
    let matrix = |dy: f64| {
        [10.0, 0.0, 0.0, 385_000.0, 0.0, dy, 0.0, 6_671_000.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    };
    let by_matrix = |dy: f64| {
        let place = (Tag::ModelTransformationTag, &matrix(dy)[..]);
        read(&geotiff(&area, &[place], None), "a.tif").unwrap()
    };
    assert_eq!(by_matrix(-20.0).bounds(), [385_000.0, 6_670_920.0, 385_060.0, 6_671_000.0]);
    let flipped = by_matrix(20.0);
    assert_eq!(flipped.bounds(), [385_000.0, 6_671_000.0, 385_060.0, 6_671_080.0]);
    assert_eq!(flipped.heights[..7], [18.0, 19.0, 20.0, 21.0, 22.0, 23.0, 12.0]);
}

#[test]
fn a_prj_file_beside_heights_tells_their_coordinate_system() {
    let folder = tempfile::tempdir().unwrap();
    let grid = "ncols 2\nnrows 2\nxllcorner 385000\nyllcorner 6672000\ncellsize 2\n1 2\n3 4\n";
    let plain = geotiff(&[], &[SCALE, TIE], None);
    let other = [1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32632];
    let named = geotiff(&other, &[SCALE, TIE], None);
    for (name, bytes, code) in [
        ("a.asc", grid.as_bytes(), Some(3067)),
        ("a.tif", &plain, Some(3067)),
        ("b.tif", &named, Some(32632)),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let open = || Raster::open(&path, name, &HeightOptions::default(), &Budget::default());
        let without = open().unwrap();
        assert_eq!(
            without.crs.as_ref().and_then(|crs| crs.code),
            code.filter(|code| *code != 3067),
            "{name}"
        );
        if without.crs.is_none() {
            let error = Relief::new(std::sync::Arc::new(without), &mut None).unwrap_err();
            assert!(error.message().contains("has no coordinate system"), "{error}");
            assert!(error.remedy().unwrap().contains("crs = 3067"), "{error}");
        }
        let prj = "PROJCS[\"EUREF_FIN_TM35FIN\",GEOGCS[\"GCS_ETRS_1989\",DATUM[\"D_ETRS_1989\",SPHEROID[\"GRS_1980\",6378137.0,298.257222101]],PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"False_Easting\",500000.0],PARAMETER[\"False_Northing\",0.0],PARAMETER[\"Central_Meridian\",27.0],PARAMETER[\"Scale_Factor\",0.9996],PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]";
        std::fs::write(path.with_extension("prj"), prj).unwrap();
        assert_eq!(open().unwrap().crs.and_then(|crs| crs.code), code, "{name}");
        std::fs::write(path.with_extension("prj"), "LOCAL[\"x\"]").unwrap();
        if code == Some(3067) {
            assert!(open().unwrap_err().message().contains("unknown coordinate system"), "{name}");
        }
        std::fs::remove_file(path.with_extension("prj")).unwrap();
    }
}

#[test]
fn a_prj_file_beside_heights_tells_the_unit_of_their_heights() {
    let folder = tempfile::tempdir().unwrap();
    let plain = geotiff(&[], &[SCALE, TIE], None);
    let told = geotiff(&[1, 1, 0, 1, 4099, 0, 1, 9001], &[SCALE, TIE], None);
    // NAD83 / California zone 1 (ftUS) with NAVD88 height (ftUS): as GDAL, PROJ and ESRI write it.
    let flat = "PROJCS[\"NAD83 / California zone 1 (ftUS)\",AUTHORITY[\"EPSG\",\"2225\"]]";
    let foot = "UNIT[\"US survey foot\",0.304800609601219]";
    let vertical =
        format!("VERT_CS[\"NAVD88 height (ftUS)\",VERT_DATUM[\"NAVD88\",2005],{foot},AXIS[\"Up\",UP]]");
    let axis = "VERTCRS[\"NAVD88 height (ftUS)\",VDATUM[\"NAVD88\"],CS[vertical,1],AXIS[\"height\",up,LENGTHUNIT[\"US survey foot\",0.304800609601219]]]";
    let esri = format!(
        "{flat},VERTCS[\"NAVD88_height_(ftUS)\",VDATUM[\"NAVD88\"],PARAMETER[\"Direction\",1.0],{foot}]"
    );
    let all = [
        format!("COMPD_CS[\"a\",{flat},{vertical}]"),
        format!("COMPOUNDCRS[\"a\",{flat},{axis}]"),
        esri,
        format!("COMPD_CS[\"a\",{flat},VERT_CS[\"a\",AUTHORITY[\"EPSG\",\"6360\"]]]"),
    ];
    let path = folder.path().join("a.tif");
    let height = |bytes: &[u8], prj: &str, wanted: &HeightOptions| {
        std::fs::write(&path, bytes).unwrap();
        std::fs::write(path.with_extension("prj"), prj).unwrap();
        Raster::open(&path, "a.tif", wanted, &Budget::default()).map(|raster| raster.heights[10])
    };
    let as_told = HeightOptions::default();
    for prj in &all {
        let found = height(&plain, prj, &as_told).unwrap();
        assert!((found - 3.048_006).abs() < 1e-5, "{prj}: {found}");
        let by_code = height(&plain, prj, &HeightOptions { crs: Some(2225), ..as_told.clone() }).unwrap();
        assert!((by_code - 3.048_006).abs() < 1e-5, "{prj}: {by_code}");
        // The unit in the file counts.
        assert_eq!(height(&told, prj, &as_told).unwrap(), 10.0);
    }
    assert_eq!(height(&plain, flat, &as_told).unwrap(), 10.0);
    let unclear = format!("COMPD_CS[\"a\",{flat},VERT_CS[\"Local heights\",VERT_DATUM[\"Local\",2005]]]");
    let error = height(&plain, &unclear, &as_told).unwrap_err();
    assert_eq!(error.message(), "a.prj does not specify the unit of its heights, \"Local heights\"");
}

#[test]
fn a_prj_file_that_is_too_large_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.tif");
    std::fs::write(&path, geotiff(&[], &[SCALE, TIE], None)).unwrap();
    let prj = "PROJCS[\"a\",AUTHORITY[\"EPSG\",\"3067\"]]";
    std::fs::write(path.with_extension("prj"), prj.to_owned() + &" ".repeat((1 << 20) - prj.len())).unwrap();
    let open = |crs: Option<u32>| {
        Raster::open(&path, "b/a.tif", &HeightOptions { crs, ..HeightOptions::default() }, &Budget::default())
    };
    assert_eq!(open(None).unwrap().crs.unwrap().code, Some(3067));
    std::fs::write(path.with_extension("prj"), prj.to_owned() + &" ".repeat((1 << 20) + 1 - prj.len()))
        .unwrap();
    let error = open(None).unwrap_err();
    assert_eq!(error.message(), "b/a.prj is larger than 1 MB");
    assert!(error.remedy().unwrap().contains("elevation(file, { crs = 3067 })"), "{error}");
    assert_eq!(open(Some(3067)).unwrap().crs.unwrap().code, Some(3067));
}

#[test]
fn heights_in_feet_become_metres() {
    let feet = [1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, 3067, 4099, 0, 1, 9002];
    let raster = read(&geotiff(&feet, &[SCALE, TIE], None), "a.tif").unwrap();
    assert!((raster.heights[10] - 3.048).abs() < 1e-6);
    // Without a unit, the vertical coordinate system tells it: NAVD88 in US survey feet, in feet, and in metres.
    for (system, height) in [(6360, 12_000.0 / 3937.0), (8228, 3.048), (5703, 10.0)] {
        let keys = [1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, 3067, 4096, 0, 1, system];
        let found = read(&geotiff(&keys, &[SCALE, TIE], None), "a.tif").unwrap().heights[10];
        assert!((found - height).abs() < 1e-6, "{system}: {found}");
    }
}

#[test]
fn options_win_over_what_a_file_says() {
    let other = [1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32767];
    let bytes = geotiff(&other, &[SCALE, TIE], None);
    assert!(read(&bytes, "a.tif").unwrap_err().message().contains("without an EPSG code"));
    let wanted =
        HeightOptions { crs: Some(3067), bounds: Some([0.0, 0.0, 60.0, 40.0]), ..HeightOptions::default() };
    let raster = Raster::read(&bytes, "a.tif", &wanted, &Budget::default()).unwrap();
    assert_eq!((raster.grid.first, raster.bounds()), ([5.0, 35.0], [0.0, 0.0, 60.0, 40.0]));
    assert_eq!(raster.crs.and_then(|crs| crs.code), Some(3067));
}

/// Files of 50 by 40 heights written by GDAL 3.10, with their EPSG codes and bounds according to GDAL.
const BY_GDAL: [(&[u8], u16, [f64; 4]); 5] = [
    // Tiles, Deflate, predictor 2, with holes.
    (
        include_bytes!("../../../../tests/elevation/tiles_i16.tif"),
        32632,
        [370_000.0, 4_848_800.0, 371_500.0, 4_850_000.0],
    ),
    // Strips of 7 rows, LZW.
    (
        include_bytes!("../../../../tests/elevation/strips_f64.tif"),
        4326,
        [7.1, 43.9 - 1.0 / 30.0, 7.1 + 1.0 / 24.0, 43.9],
    ),
    // Tiles, Deflate, predictor 3.
    (
        include_bytes!("../../../../tests/elevation/floats_f32.tif"),
        2154,
        [1_040_000.0, 6_299_800.0, 1_040_250.0, 6_300_000.0],
    ),
    // Big-endian BigTIFF, ten times as high.
    (
        include_bytes!("../../../../tests/elevation/big_i32.tif"),
        3857,
        [800_000.0, 5_399_000.0, 801_250.0, 5_400_000.0],
    ),
    // Samples that are points.
    (
        include_bytes!("../../../../tests/elevation/point_u16.tif"),
        3067,
        [385_000.0, 6_670_600.0, 385_500.0, 6_671_000.0],
    ),
];

#[test]
fn what_gdal_writes_is_read_as_gdal_reads_it() {
    for (index, (bytes, code, bounds)) in BY_GDAL.into_iter().enumerate() {
        let raster = read(bytes, "a.tif").unwrap();
        assert_eq!((raster.columns, raster.rows, raster.filled), (50, 40, if index == 0 { 20 } else { 0 }));
        assert_eq!(raster.crs.as_ref().and_then(|crs| crs.code), Some(code));
        for (found, edge) in raster.bounds().into_iter().zip(bounds) {
            assert!((found - edge).abs() < 1e-9 * edge.abs(), "{:?}", raster.bounds());
        }
        let scale = if code == 3857 { 10.0 } else { 1.0 };
        for (row, column, height) in [(0, 0, 200.0), (7, 33, 285.784), (39, 49, 268.916), (12, 22, 247.8)] {
            let found = raster.heights[row * 50 + column] / scale;
            // Integers, and a hole that was filled.
            let tolerance = if row == 12 { 4.0 } else { 0.5 };
            assert!((found - height).abs() <= tolerance, "{code}: {found} {height}");
        }
    }
}

#[test]
fn a_text_that_is_longer_than_the_file_is_refused_before_it_is_read() {
    let mut bytes = geotiff(&[], &[SCALE, TIE], Some("5"));
    // The tag 42113 of type 2, in a directory at the end.
    let at = bytes.windows(4).position(|part| part == [0x81, 0xa4, 2, 0]).unwrap();
    bytes[at + 4..at + 8].fill(0xff);
    let error = read(&bytes, "a.tif").unwrap_err();
    assert_eq!(error.message(), "a.tif has a strip or a tag that is too large");
}

/// Returns a PNG of 3 by 2 samples.
fn picture(color: ::png::ColorType, depth: ::png::BitDepth, content: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, 3, 2);
    encoder.set_color(color);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(content).unwrap();
    writer.finish().unwrap();
    bytes
}

#[test]
fn grey_and_colours_become_heights() {
    let bounds = Some([0.0, 0.0, 30.0, 20.0]);
    let grey = picture(
        ::png::ColorType::Grayscale,
        ::png::BitDepth::Sixteen,
        &[0, 0, 255, 255, 128, 0, 0, 1, 0, 0, 0, 0],
    );
    let wanted = HeightOptions { low: Some(100.0), high: Some(755.35), bounds, ..HeightOptions::default() };
    let raster = Raster::read(&grey, "a.png", &wanted, &Budget::default()).unwrap();
    for (found, height) in raster.heights.iter().zip([100.0, 755.35, 427.68, 100.01]) {
        assert!((found - height).abs() < 1e-3, "{found} {height}");
    }
    assert_eq!((raster.grid.first, raster.crs), ([5.0, 15.0], None));
    // 1 134 240 tenths above -10 000 m are 103 424 m, which is too high; 1, 134, 160 is 0 m.
    let colors = [[1, 134, 160]; 6].concat();
    let colored = picture(::png::ColorType::Rgb, ::png::BitDepth::Eight, &colors);
    let wanted = HeightOptions { terrain_rgb: true, bounds, ..HeightOptions::default() };
    assert_eq!(Raster::read(&colored, "a.png", &wanted, &Budget::default()).unwrap().heights, [0.0; 6]);
    assert!(Raster::read(&grey, "a.png", &wanted, &Budget::default()).is_err());
    assert!(read(&colored, "a.png").unwrap_err().remedy().unwrap().contains("terrain-rgb"));
    let bytes = picture(::png::ColorType::Grayscale, ::png::BitDepth::Eight, &[0; 6]);
    assert!(read(&bytes, "a.png").unwrap_err().message().contains("256 levels"));
}

/// Returns one complete file of each format, with its name.
pub(super) fn samples() -> Vec<(&'static str, Vec<u8>)> {
    let area = [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 3067];
    let grey = picture(::png::ColorType::Grayscale, ::png::BitDepth::Sixteen, &[7; 12]);
    vec![
        ("N43E007.hgt", tile(5, 1)),
        ("N43E007.hgt.zip", zipped(&[("N43E007.hgt", &tile(5, 1))])),
        ("a.tif", geotiff(&area, &[SCALE, TIE], Some("5"))),
        ("b.tif", BY_GDAL[0].0.to_vec()),
        ("c.tif", BY_GDAL[2].0.to_vec()),
        ("a.asc", b"ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n1 2 3\n4 5 6\n".to_vec()),
        ("a.png", grey),
        ("a.r32", [1.5f32.to_le_bytes(); 9].concat()),
        ("a.r64", [1.5f64.to_le_bytes(); 9].concat()),
    ]
}

/// Returns the options that make a file readable.
pub(super) fn wanted(name: &str) -> HeightOptions {
    let bounds = Some([0.0, 0.0, 30.0, 20.0]);
    match name {
        "a.png" => HeightOptions { low: Some(0.0), high: Some(9.0), bounds, ..HeightOptions::default() },
        "a.r32" | "a.r64" | "N43E007.hgt" | "N43E007.hgt.zip" => {
            HeightOptions { bounds, ..HeightOptions::default() }
        }
        _ => HeightOptions::default(),
    }
}

#[test]
fn whole_files_are_read_and_cut_ones_are_told() {
    for (name, bytes) in samples() {
        Raster::read(&bytes, name, &wanted(name), &Budget::default()).unwrap();
        for length in 0..bytes.len() {
            // A part of a square may be a square, and a file may end after its last height.
            if let Err(error) = Raster::read(&bytes[..length], name, &wanted(name), &Budget::default()) {
                assert!(
                    error.remedy().is_some() && error.message().contains(name),
                    "{name} {length}: {error}"
                );
            } else {
                let is_square =
                    !matches!(name, "a.tif" | "a.png" | "a.asc") && [8, 16, 18, 32].contains(&length);
                assert!(is_square || length + 40 > bytes.len(), "{name} {length}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn changed_bytes_never_panic_or_take_long(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
    ) {
        for (name, mut bytes) in samples() {
            for (at, byte) in &changes {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            let begin = Instant::now();
            if let Ok(raster) = Raster::read(&bytes, name, &wanted(name), &Budget::default()) {
                prop_assert!(raster.heights.iter().all(|height| height.is_finite()));
                let _ = Relief::new(std::sync::Arc::new(raster), &mut None);
            }
            prop_assert!(begin.elapsed() < Duration::from_secs(5), "{}", name);
        }
    }
}
