//! Tests of damaged files in all formats: no reader panics, and all files are read or refused within bounds.

use std::path::Path;
use std::time::Duration;

use crate::{Layer, Listing, Source, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::random::Stream;

/// Reads a file in every possible way; returns true if a layer was read.
fn read(path: &Path) -> bool {
    let budget = Budget::within(Duration::from_secs(20), 200_000_000);
    let _ = Listing::read(path, &budget).map(|listing| (listing.text(), listing.to_json()));
    let wanted = SourceOptions { budget, ..SourceOptions::default() };
    let Ok(source) = Source::open_within(path, "a", &wanted) else { return false };
    let layer = source.layers().first().map(|&layer| layer.to_owned());
    let wanted = SourceOptions { layer, ..wanted };
    let table = Source::open_within(path, "a", &wanted).and_then(|source| source.read("a", &wanted));
    table.and_then(|table| Layer::new(table, &mut None)).is_ok_and(|layer| {
        let _ = (layer.warnings(), layer.derived_note());
        layer.bounds.iter().flatten().all(|value| value.is_finite())
    })
}

/// Returns the valid files of the fuzzing corpus, with their names as data files.
fn samples() -> Vec<(String, Vec<u8>)> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus");
    let mut samples = Vec::new();
    for (folder, name) in [
        ("csv", "a.csv"),
        ("kml", "a.kml"),
        ("gpx", "a.gpx"),
        ("cityjson", "a.city.json"),
        ("osm_xml", "a.osm"),
        ("gml", "a.gml"),
        ("packed", "a"),
    ] {
        let mut files: Vec<_> =
            std::fs::read_dir(corpus.join(folder)).unwrap().map(|entry| entry.unwrap().path()).collect();
        files.sort();
        for file in files {
            let own = file.file_name().unwrap().to_str().unwrap().to_owned();
            if own.starts_with("good") {
                let name = if folder == "packed" { own } else { name.to_owned() };
                samples.push((name, std::fs::read(&file).unwrap()));
            }
        }
    }
    samples
}

#[test]
fn damaged_files_of_all_formats_are_read_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut stream = Stream::new(11);
    let mut whole = |number: usize| (stream.uniform() * number as f64) as usize;
    let (mut cases, mut good) = (0, 0);
    for (name, bytes) in samples() {
        let path = folder.path().join(&name);
        std::fs::write(&path, &bytes).unwrap();
        assert!(read(&path), "{name} is good");
        for round in 0..160 {
            let mut damaged = bytes.clone();
            match round % 4 {
                0 => damaged.truncate(whole(bytes.len())),
                1 => {
                    let (from, count) = (whole(bytes.len()), whole(30));
                    damaged.drain(from..bytes.len().min(from + count));
                }
                _ => {
                    for _ in 0..1 + whole(4) {
                        let at = whole(bytes.len());
                        damaged[at] = whole(256) as u8;
                    }
                }
            }
            std::fs::write(&path, &damaged).unwrap();
            good += usize::from(read(&path));
            cases += 1;
        }
    }
    assert!(cases > 1500 && good > 100, "{good} of {cases}");
}

#[test]
fn damaged_shapefiles_are_read_or_refused() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/shapefile");
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    write("a.prj", b"PROJCS[\"a\",AUTHORITY[\"EPSG\",\"3067\"]]");
    let mut stream = Stream::new(12);
    let mut whole = |number: usize| (stream.uniform() * number as f64) as usize;
    let mut good = 0;
    for name in ["good_areas", "good_points_z"] {
        let bytes = std::fs::read(corpus.join(name)).unwrap();
        let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
        for round in 0..1000 {
            let mut damaged = bytes[4..].to_vec();
            let cut = if round % 4 == 0 { whole(damaged.len()) } else { damaged.len() };
            for _ in 0..round % 5 {
                let at = whole(damaged.len());
                damaged[at] = if round % 3 == 0 { 0xff } else { whole(256) as u8 };
            }
            damaged.truncate(cut);
            let (shapes, table) = damaged.split_at(length.min(damaged.len()));
            write("a.shp", shapes);
            write("a.dbf", table);
            good += usize::from(read(&folder.path().join("a.shp")));
        }
    }
    assert!(good > 300, "{good}");
}

#[test]
fn a_packed_file_is_unpacked_within_the_budget() {
    use std::io::Write;

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bomb.geojson.gz");
    let mut encoder =
        flate2::write::GzEncoder::new(std::fs::File::create(&path).unwrap(), flate2::Compression::fast());
    (0..300).for_each(|_| encoder.write_all(&[b' '; 1 << 20]).unwrap());
    encoder.finish().unwrap();
    let budget = Budget::within(Duration::from_secs(20), 100_000_000);
    let wanted = SourceOptions { budget, ..SourceOptions::default() };
    let error = Source::open_within(&path, "bomb.geojson.gz", &wanted).err().unwrap();
    assert!(error.message().contains("memory limit of 100 MB"), "{error}");
}
