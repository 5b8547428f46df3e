//! Tests of TIFFs that GDAL writes and the encoder of the tests' crate does not: tiles, masks and absent parts.

use std::io::Cursor;

use tiff::decoder::Decoder;
use tiff::encoder::{Compression, TiffEncoder, colortype};
use tiff::tags::Tag;

use super::tests::read;
use super::{HeightOptions, Raster};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit};

/// TestImage of integers of 16 bits, or of a mask, in one directory of a TIFF.
#[derive(Clone, Default)]
struct TestImage {
    size: [u32; 2],
    /// Sides of tiles; strips of all rows if use none.
    tile: Option<[u32; 2]>,
    bits: u32,
    compression: u32,
    predictor: u32,
    /// Subfile type: 4 is a mask.
    kind: u32,
    missing: Option<&'static str>,
    /// Content of strips or tiles; an empty one is absent from the file.
    parts: Vec<Vec<u8>>,
}

impl TestImage {
    fn of(columns: u32, rows: u32, parts: Vec<Vec<u8>>) -> Self {
        let (size, predictor) = ([columns, rows], 1);
        Self { size, bits: 16, compression: 1, predictor, parts, ..Self::default() }
    }
}

/// Returns a little-endian TIFF of images in EPSG:3067 with samples of 10 m.
fn tiff(images: &[TestImage]) -> Vec<u8> {
    const SHORT: u16 = 3;
    const LONG: u16 = 4;
    const DOUBLE: u16 = 12;
    let mut bytes = b"II*\0\0\0\0\0".to_vec();
    let mut link = 4;
    for image in images {
        let place = |content: &[u8], bytes: &mut Vec<u8>| {
            let start = bytes.len() as u32;
            bytes.extend(content);
            if content.is_empty() { 0 } else { start }
        };
        let offsets: Vec<u32> = image.parts.iter().map(|part| place(part, &mut bytes)).collect();
        let sizes: Vec<u32> = image.parts.iter().map(|part| part.len() as u32).collect();
        let longs = |values: &[u32]| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
        let doubles =
            |values: &[f64]| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
        let one = |value: u32| longs(&[value]);
        let mut tags = vec![
            (254, LONG, one(image.kind)),
            (256, LONG, one(image.size[0])),
            (257, LONG, one(image.size[1])),
            (258, LONG, one(image.bits)),
            (259, LONG, one(image.compression)),
            (262, LONG, one(if image.kind == 4 { 4 } else { 1 })),
            (277, LONG, one(1)),
            (317, LONG, one(image.predictor)),
            (339, LONG, one(if image.kind == 4 { 1 } else { 2 })),
        ];
        match image.tile {
            Some([width, height]) => tags.extend([
                (322, LONG, one(width)),
                (323, LONG, one(height)),
                (324, LONG, longs(&offsets)),
                (325, LONG, longs(&sizes)),
            ]),
            None => tags.extend([
                (273, LONG, longs(&offsets)),
                (278, LONG, one(image.size[1].div_ceil(image.parts.len() as u32))),
                (279, LONG, longs(&sizes)),
            ]),
        }
        if let Some(missing) = image.missing {
            tags.push((42113, 2, format!("{missing}\0").into_bytes()));
        }
        if image.kind == 0 {
            let keys = [1u16, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 3067];
            tags.push((33550, DOUBLE, doubles(&[10.0, 10.0, 0.0])));
            tags.push((33922, DOUBLE, doubles(&[0.0, 0.0, 0.0, 385_000.0, 6_671_000.0, 0.0])));
            tags.push((34735, SHORT, keys.iter().flat_map(|key| key.to_le_bytes()).collect()));
        }
        tags.sort_by_key(|tag| tag.0);
        let mut entries = (tags.len() as u16).to_le_bytes().to_vec();
        for (tag, kind, mut value) in tags {
            let size = match kind {
                2 => 1,
                SHORT => 2,
                LONG => 4,
                _ => 8,
            };
            let count = value.len() as u32 / size;
            if value.len() > 4 {
                value = place(&value, &mut bytes).to_le_bytes().to_vec();
            }
            value.resize(4, 0);
            entries.extend([tag as u16, kind].map(u16::to_le_bytes).concat());
            entries.extend(count.to_le_bytes());
            entries.extend(value);
        }
        let start = bytes.len() as u32;
        bytes[link..link + 4].copy_from_slice(&start.to_le_bytes());
        bytes.extend(entries);
        link = bytes.len();
        bytes.extend([0; 4]);
    }
    bytes
}

fn shorts(values: impl IntoIterator<Item = i16>) -> Vec<u8> {
    values.into_iter().flat_map(i16::to_le_bytes).collect()
}

/// Compresses the rows of an image of this width.
fn packed(values: &[i16], width: u32, compression: Compression) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap().with_compression(compression);
    let height = values.len() as u32 / width;
    let mut image = encoder.new_image::<colortype::GrayI16>(width, height).unwrap();
    image.rows_per_strip(height).unwrap();
    image.write_data(values).unwrap();
    let bytes = bytes.into_inner();
    let mut tiff = Decoder::new(Cursor::new(&bytes)).unwrap();
    let [start, size] =
        [Tag::StripOffsets, Tag::StripByteCounts].map(|tag| tiff.get_tag_u64(tag).unwrap() as usize);
    bytes[start..start + size].to_vec()
}

#[test]
fn parts_that_a_file_leaves_out_are_missing_or_zero() {
    // Tiles of 16 by 16 samples: 7, absent; absent, 9.
    let tile = |value: i16| shorts([value; 256]);
    for compression in [1, 5, 8] {
        let content = |value: i16| match compression {
            1 => tile(value),
            5 => packed(&[value; 256], 16, Compression::Lzw),
            _ => packed(&[value; 256], 16, Compression::Deflate(tiff::encoder::DeflateLevel::Fast)),
        };
        let parts = vec![content(7), vec![], vec![], content(9)];
        let image = TestImage { tile: Some([16, 16]), compression, ..TestImage::of(30, 28, parts) };
        let raster = read(&tiff(std::slice::from_ref(&image)), "a.tif").unwrap();
        let at = |column: usize, row: usize| raster.heights[row * 30 + column];
        assert_eq!([at(0, 0), at(20, 3), at(3, 20), at(29, 27)], [7.0, 0.0, 0.0, 9.0], "{compression}");
        assert_eq!(raster.filled, 0);
        let raster = read(&tiff(&[TestImage { missing: Some("-9999"), ..image }]), "a.tif").unwrap();
        assert_eq!(raster.filled, 14 * 16 + 16 * 12, "{compression}");
    }
    // Strips of 2 rows, of which one is absent.
    let strips = TestImage::of(3, 6, vec![shorts([5; 6]), vec![], shorts([6; 6])]);
    let raster = read(&tiff(&[strips]), "a.tif").unwrap();
    assert_eq!(raster.heights[..9], [5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 0.0, 0.0, 0.0]);
    assert_eq!(raster.heights[12..], [6.0; 6]);
}

#[test]
fn heights_under_the_mask_of_a_file_are_missing() {
    let image = TestImage { tile: Some([16, 16]), ..TestImage::of(12, 10, vec![shorts([100; 256])]) };
    // The mask is in strips of 5 rows of two bytes, and excludes the columns 3 and 11 of the rows 2 and 7.
    let strip: Vec<u8> =
        (0..5).flat_map(|row| if row == 2 { [0b1110_1111, 0b1110_0000] } else { [0xFF, 0xF0] }).collect();
    let mask = TestImage { kind: 4, bits: 1, ..TestImage::of(12, 10, vec![strip.clone(), strip]) };
    // A smaller image and its mask are an overview.
    let overview = TestImage { kind: 1, ..TestImage::of(6, 5, vec![shorts([100; 30])]) };
    let raster = read(&tiff(&[image.clone(), overview.clone(), mask.clone()]), "a.tif").unwrap();
    assert_eq!((raster.filled, raster.heights.len()), (4, 120));
    assert_eq!(read(&tiff(&[image.clone(), overview]), "a.tif").unwrap().filled, 0);
    // An absent part of a mask excludes its samples.
    let half = TestImage { parts: vec![vec![], mask.parts[1].clone()], ..mask.clone() };
    assert_eq!(read(&tiff(&[image.clone(), half]), "a.tif").unwrap().filled, 62);
    let unknown = TestImage { compression: 7, ..mask };
    let error = read(&tiff(&[image, unknown]), "a.tif").unwrap_err();
    assert!(error.message().contains("has a mask"), "{error}");
}

#[test]
fn a_hostile_mask_obeys_the_limits_of_memory_and_time() {
    let image = TestImage { tile: Some([16, 16]), ..TestImage::of(12, 10, vec![shorts([100; 256])]) };
    let mask = TestImage { kind: 4, bits: 8, ..TestImage::of(12, 10, Vec::new()) };
    let with_mask = |tile: [u32; 2], parts: Vec<Vec<u8>>, compression: u32| {
        let mask = TestImage { tile: Some(tile), parts, compression, ..mask.clone() };
        tiff(&[image.clone(), mask])
    };
    let within =
        |bytes: &[u8], budget: &Budget| Raster::read(bytes, "a.tif", &HeightOptions::default(), budget);
    // Tiles that are much larger than the image, with and without compression.
    // A budget that was exceeded once stays so.
    let small = || Budget::within(std::time::Duration::from_secs(60), 20_000_000);
    for tile in [[65_536, 65_536], [u32::MAX, 16], [16, u32::MAX], [u32::MAX, u32::MAX]] {
        for compression in [1, 5, 8] {
            let error = within(&with_mask(tile, vec![vec![7; 40]], compression), &small()).unwrap_err();
            assert_eq!(
                error.message(),
                "reading exceeded the memory limit of 20 MB",
                "{tile:?} {compression}"
            );
        }
    }
    // Fewer tiles than the image has, none, and tiles without extent.
    for (tile, parts) in [([4, 4], vec![vec![1; 16]; 2]), ([16, 16], vec![]), ([16, 16], vec![vec![1; 255]])]
    {
        let error = within(&with_mask(tile, parts, 1), &small());
        assert!(error.is_err_and(|error| error.message().contains("has a mask that is damaged")), "{tile:?}");
    }
    // Many tiles, of which the time suffices for some.
    let tiles = with_mask([1, 1], vec![vec![1]; 120], 1);
    assert_eq!(within(&tiles, &small()).unwrap().filled, 0);
    let checks = std::sync::atomic::AtomicUsize::new(0);
    let hurried =
        Budget::new(usize::MAX, move || match checks.fetch_add(1, std::sync::atomic::Ordering::Relaxed) {
            0..60 => Ok(()),
            _ => Err(Error::limit(Limit::Time, "the time is over")),
        });
    assert_eq!(within(&tiles, &hurried).unwrap_err().message(), "the time is over");
}

#[test]
fn directories_in_a_circle_end_the_search_for_a_mask() {
    let image = TestImage::of(12, 10, vec![shorts([100; 120])]);
    let overview = TestImage { kind: 1, ..TestImage::of(6, 5, vec![shorts([100; 30])]) };
    let circle = |images: &[TestImage]| {
        let mut bytes = tiff(images);
        let (first, end) = (bytes[4..8].to_vec(), bytes.len());
        bytes[end - 4..].copy_from_slice(&first);
        read(&bytes, "a.tif")
    };
    assert_eq!(circle(std::slice::from_ref(&image)).unwrap_err().message(), "a.tif: damaged TIFF file");
    let raster = circle(&[image, overview]).unwrap();
    assert_eq!((raster.filled, raster.heights.len()), (0, 120));
}

#[test]
fn padded_lzw_tiles_are_read_to_their_end() {
    for predictor in [1, 2] {
        let height = |column: i16, row: i16| 100 + 3 * column.min(1) + row.min(13) * 2;
        let mut values: Vec<i16> = (0..256).map(|at| height(at % 16, at / 16)).collect();
        if predictor == 2 {
            for row in values.chunks_mut(16) {
                (1..16).rev().for_each(|at| row[at] -= row[at - 1]);
            }
        }
        let parts = vec![packed(&values, 16, Compression::Lzw)];
        let image =
            TestImage { tile: Some([16, 16]), compression: 5, predictor, ..TestImage::of(2, 14, parts) };
        let raster = read(&tiff(&[image]), "a.tif").unwrap();
        let expected: Vec<f32> =
            (0..14).flat_map(|row| [height(0, row), height(1, row)]).map(f32::from).collect();
        assert_eq!(raster.heights, expected, "{predictor}");
    }
}
