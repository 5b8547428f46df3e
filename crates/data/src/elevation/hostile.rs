//! Tests of files that declare more data than they contain, or contain more than they declare.

use std::io::{Cursor, Write};
use std::time::{Duration, Instant};

use tiff::encoder::{Compression, DeflateLevel, TiffEncoder, colortype};
use zip::write::SimpleFileOptions;

use super::tests::{SCALE, TIE, read, samples, wanted};
use super::*;
use burgeon_base::budget::Budget;

/// Returns a budget of a few megabytes.
fn small(megabytes: usize) -> std::sync::Arc<Budget> {
    Budget::within(Duration::from_secs(60), megabytes * 1_000_000)
}

#[test]
fn a_zip_bomb_is_refused_before_it_is_unpacked() {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    zip.start_file("N43E007.hgt", SimpleFileOptions::default()).unwrap();
    let zeros = vec![0; 1 << 20];
    (0..420).for_each(|_| zip.write_all(&zeros).unwrap());
    let mut bomb = zip.finish().unwrap().into_inner();
    let begin = Instant::now();
    let error = read(&bomb, "b.zip").unwrap_err();
    assert!(error.message().contains("is not square"), "{error}");
    // The same file, with the size of a tile declared everywhere instead of its real size.
    let [told, real] = [1201 * 1201 * 2u32, 420 << 20].map(u32::to_le_bytes);
    for at in 0..bomb.len() - 4 {
        if bomb[at..at + 4] == real {
            bomb[at..at + 4].copy_from_slice(&told);
        }
    }
    let error = Raster::read(&bomb, "b.zip", &HeightOptions::default(), &small(20)).unwrap_err();
    assert!(error.message().contains("cannot be unpacked"), "{error}");
    assert!(bomb.len() < 1 << 20 && begin.elapsed() < Duration::from_secs(5));
}

/// Returns a TIFF without heights that declares some: integer tags, optionally followed by its position.
fn claiming(tags: &[(u16, u32)], place: bool) -> Vec<u8> {
    let mut tags = tags.to_vec();
    if place {
        // After the directory.
        tags.extend([(33550, 0), (33922, 0)]);
    }
    let after = 8 + 2 + 12 * tags.len() as u32 + 4;
    let mut bytes = [b"II*\0".as_slice(), &8u32.to_le_bytes(), &(tags.len() as u16).to_le_bytes()].concat();
    for (tag, value) in tags {
        let (kind, count, value) = match tag {
            33550 => (12u16, 3u32, after),
            33922 => (12, 6, after + 24),
            _ => (4, 1, value),
        };
        bytes.extend([tag.to_le_bytes(), kind.to_le_bytes()].concat());
        bytes.extend([count.to_le_bytes(), value.to_le_bytes()].concat());
    }
    bytes.extend([0; 4]);
    bytes.extend([10.0f64, 10.0, 0.0, 0.0, 0.0, 0.0, 5000.0, 6000.0, 0.0].map(f64::to_le_bytes).concat());
    bytes
}

#[test]
fn a_file_that_says_it_has_more_than_it_can_hold_is_refused_before_there_is_room_for_it() {
    for (columns, rows) in [(14_000, 14_000), (100, 1_000_000), (1_000_000, 150)] {
        for compression in [1, 5, 8, 32946] {
            // One strip of 40 bytes.
            let tags = [
                (256, columns),
                (257, rows),
                (258, 16),
                (259, compression),
                (262, 1),
                (273, 180),
                (277, 1),
                (278, rows),
                (279, 40),
                (339, 2),
            ];
            let bytes = claiming(&tags, true);
            assert!(bytes.len() < 300);
            let error = Raster::read(&bytes, "a.tif", &HeightOptions::default(), &small(1)).unwrap_err();
            assert!(error.message().contains("cannot hold"), "{compression}: {error}");
        }
    }
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, 14_000, 14_000);
    encoder.set_color(::png::ColorType::Grayscale);
    encoder.set_depth(::png::BitDepth::Sixteen);
    drop(encoder.write_header().unwrap());
    let wanted = HeightOptions {
        low: Some(0.0),
        high: Some(1.0),
        bounds: Some([0.0, 0.0, 1.0, 1.0]),
        ..HeightOptions::default()
    };
    let error = Raster::read(&bytes, "a.png", &wanted, &small(1)).unwrap_err();
    assert!(error.message().contains("cannot hold 14000 x 14000"), "{error}");
}

#[test]
fn the_place_is_asked_for_and_memory_taken_before_heights_are_unpacked() {
    let deflated = |place: bool| {
        let mut bytes = Cursor::new(Vec::new());
        let mut encoder =
            TiffEncoder::new(&mut bytes).unwrap().with_compression(Compression::Deflate(DeflateLevel::Fast));
        let mut image = encoder.new_image::<colortype::GrayI16>(3000, 3000).unwrap();
        image.rows_per_strip(1000).unwrap();
        if place {
            image.encoder().write_tag(SCALE.0, SCALE.1).unwrap();
            image.encoder().write_tag(TIE.0, TIE.1).unwrap();
        }
        image.write_data(&vec![7i16; 9_000_000]).unwrap();
        bytes.into_inner()
    };
    let begin = Instant::now();
    let (without, with) = (deflated(false), deflated(true));
    assert!(without.len() < 200_000);
    let packing = begin.elapsed();
    let begin = Instant::now();
    // There is no memory budget, but no memory is needed yet.
    let error = Raster::read(&without, "a.tif", &HeightOptions::default(), &small(0)).unwrap_err();
    assert_eq!(error.message(), "a.tif does not contain its location");
    let error = Raster::read(&with, "a.tif", &HeightOptions::default(), &small(30)).unwrap_err();
    assert_eq!(error.message(), "reading exceeded the memory limit of 30 MB");
    assert!(begin.elapsed() < packing.max(Duration::from_millis(200)));
    let raster = Raster::read(&with, "a.tif", &HeightOptions::default(), &small(90)).unwrap();
    assert!(raster.heights.len() == 9_000_000 && raster.heights.iter().all(|height| *height == 7.0));
    // The same with no time.
    let over = Budget::new(usize::MAX, || {
        Err(burgeon_base::error::Error::limit(burgeon_base::error::Limit::Time, "the time is over"))
    });
    for (name, bytes) in samples() {
        let error = Raster::read(&bytes, name, &wanted(name), &over).unwrap_err();
        assert_eq!(error.message(), "the time is over", "{name}");
    }
}
