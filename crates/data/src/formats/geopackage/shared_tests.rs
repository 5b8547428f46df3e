//! Tests of packages that another process writes: one committed state is read, and no file is left next to the package.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};

use rusqlite::Connection;

use super::PackageState;
use crate::{Attribute, FeatureTable, Source, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;

/// Number of rows of a layer; they fill many pages.
const ROWS: i64 = 300;

/// Creates a package of two layers whose rows all contain the number of the batch that wrote them.
fn package(path: &Path, mode: &str) {
    let connection = Connection::open(path).unwrap();
    connection
        .execute_batch(&format!(
            "PRAGMA journal_mode = {mode};
             CREATE TABLE gpkg_contents(table_name TEXT PRIMARY KEY, data_type TEXT);
             CREATE TABLE gpkg_geometry_columns(table_name TEXT, column_name TEXT, srs_id INT);
             CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT, srs_id INT, organization TEXT, organization_coordsys_id INT);
             INSERT INTO gpkg_spatial_ref_sys VALUES ('a', 3067, 'EPSG', 3067);"
        ))
        .unwrap();
    for layer in ["a", "b"] {
        connection
            .execute_batch(&format!(
                "INSERT INTO gpkg_contents VALUES ('{layer}', 'features');
                 INSERT INTO gpkg_geometry_columns VALUES ('{layer}', 'geom', 3067);
                 CREATE TABLE {layer}(fid INTEGER PRIMARY KEY, geom BLOB, batch INTEGER, filling TEXT);"
            ))
            .unwrap();
        let point = [
            b"GP\0\x01\0\0\0\0\x01\x01\0\0\0".as_slice(),
            &385_000f64.to_le_bytes(),
            &6_672_000f64.to_le_bytes(),
        ];
        for fid in 1..=ROWS {
            let values = (fid, point.concat(), "x".repeat(300));
            connection.execute(&format!("INSERT INTO {layer} VALUES (?1, ?2, 0, ?3)"), values).unwrap();
        }
    }
}

/// Actions of another process on a package. It runs this test alone, with a task in its environment.
#[test]
fn the_other_process() {
    let (Ok(task), Ok(path)) = (std::env::var("BURGEON_WRITER"), std::env::var("BURGEON_WRITTEN")) else {
        return;
    };
    let path = PathBuf::from(path);
    let ready = path.with_extension("ready");
    let open = || {
        let connection = Connection::open(&path).unwrap();
        connection.busy_timeout(Duration::from_secs(20)).unwrap();
        connection
    };
    let batch = |connection: &Connection, number: i64| {
        connection
            .execute_batch(&format!(
                "BEGIN IMMEDIATE; UPDATE a SET batch = {number}; UPDATE b SET batch = {number}; COMMIT"
            ))
            .unwrap();
    };
    match task.as_str() {
        // A program that keeps the file open.
        "batches" => {
            let connection = open();
            for number in 1.. {
                batch(&connection, number);
                std::fs::write(&ready, "").unwrap();
            }
        }
        // A program that opens the file for each change.
        "visits" => {
            for number in 1.. {
                batch(&open(), number);
                std::fs::write(&ready, "").unwrap();
            }
        }
        "lock" => {
            let connection = open();
            connection
                .execute_batch("BEGIN EXCLUSIVE; UPDATE a SET batch = 1; UPDATE b SET batch = 1")
                .unwrap();
            std::fs::write(&ready, "").unwrap();
            std::thread::sleep(Duration::from_millis(1500));
            connection.execute_batch("COMMIT").unwrap();
        }
        // A program that dies in the middle of a change after writing some of its pages.
        "die" => {
            let connection = open();
            let _ = connection.execute_batch(
                "PRAGMA cache_size = 2; PRAGMA cache_spill = 1; BEGIN; UPDATE a SET batch = 9; UPDATE b SET batch = 9",
            );
            std::fs::write(&ready, "").unwrap();
            std::process::abort();
        }
        // A program that dies with committed changes in the log, and one that is not committed.
        "die in log" => {
            let connection = open();
            batch(&connection, 5);
            let _ = connection.execute_batch("PRAGMA cache_size = 2; BEGIN; UPDATE a SET batch = 9");
            std::fs::write(&ready, "").unwrap();
            std::process::abort();
        }
        task => panic!("{task}"),
    }
}

/// Another process at work, until this value is dropped.
struct OtherWriter(Child);

impl OtherWriter {
    fn start(task: &str, path: &Path) -> Self {
        let ready = path.with_extension("ready");
        let child = Command::new(std::env::current_exe().unwrap())
            .args(["the_other_process", "--nocapture"])
            .env("BURGEON_WRITER", task)
            .env("BURGEON_WRITTEN", path)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let begin = Instant::now();
        while !ready.exists() {
            assert!(begin.elapsed() < Duration::from_secs(60), "the other process does not begin");
            std::thread::sleep(Duration::from_millis(5));
        }
        Self(child)
    }
}

impl Drop for OtherWriter {
    fn drop(&mut self) {
        let _ = self.0.kill();
        self.0.wait().unwrap();
    }
}

fn layer(path: &Path, layer: &str, budget: &Arc<Budget>) -> Result<FeatureTable> {
    let wanted = SourceOptions {
        budget: Arc::clone(budget),
        layer: Some(layer.to_owned()),
        ..SourceOptions::default()
    };
    Source::open_within(path, "town.gpkg", &wanted)?.read("town.gpkg", &wanted)
}

/// Returns the batches that a run reads in both layers; a single batch if it reads one state.
fn batches(path: &Path, budget: &Arc<Budget>) -> Result<Vec<i64>> {
    let mut seen = Vec::new();
    for name in ["a", "b"] {
        let table = layer(path, name, budget)?;
        assert_eq!(table.features.len() as i64, ROWS);
        let batch = table.names.iter().position(|name| name == "batch").unwrap();
        for feature in &table.features {
            let value = feature.attributes.iter().find(|(index, _)| *index == batch);
            let Some((_, Attribute::Number(number))) = value else { panic!("a batch") };
            #[allow(clippy::cast_possible_truncation, reason = "a count")]
            seen.push(*number as i64);
        }
    }
    seen.dedup();
    Ok(seen)
}

fn within(time: Duration) -> Arc<Budget> {
    Budget::within(time, 500_000_000)
}

/// Returns the files in the folder of a package.
fn beside(path: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(path.parent().unwrap()).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.retain(|name| !name.ends_with(".ready"));
    names.sort();
    names
}

#[test]
fn a_run_sees_one_committed_state_of_a_package_that_is_written_all_the_time() {
    let mut all = 0;
    for (mode, task) in [
        ("delete", "batches"),
        ("truncate", "batches"),
        ("persist", "batches"),
        ("wal", "batches"),
        ("delete", "visits"),
        ("wal", "visits"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("town.gpkg");
        package(&path, mode);
        let writer = OtherWriter::start(task, &path);
        let (mut good, mut locked, mut states) = (0, 0, std::collections::BTreeSet::new());
        for _ in 0..25 {
            match batches(&path, &within(Duration::from_secs(30))) {
                Ok(seen) => {
                    assert_eq!(seen.len(), 1, "{mode} {task}: {seen:?}");
                    states.extend(seen);
                    good += 1;
                }
                Err(error) => {
                    assert_eq!(error.kind().code(), "unavailable", "{mode} {task}: {error}");
                    locked += 1;
                }
            }
        }
        drop(writer);
        assert!(good > 20 && states.len() > 3, "{mode} {task}: {good} good, {locked} locked, {states:?}");
        all += good;
    }
    assert!(all > 130, "{all}");
}

#[test]
fn a_locked_package_is_waited_for_within_the_time_limit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("town.gpkg");
    package(&path, "delete");
    let writer = OtherWriter::start("lock", &path);
    let begin = Instant::now();
    let error = batches(&path, &within(Duration::from_millis(200))).unwrap_err();
    assert!(begin.elapsed() < Duration::from_secs(1));
    insta::assert_snapshot!(error, @"
    reading exceeded the time limit of 0.2 s (another program has locked town.gpkg)
      help: read a part of the data, or raise the limit: --time-limit SECONDS
    ");
    assert_eq!(batches(&path, &within(Duration::from_secs(30))).unwrap(), [1]);
    drop(writer);
    assert_eq!(beside(&path), ["town.gpkg"]);
}

#[test]
fn what_a_dead_program_has_left_is_taken_back_in_a_copy_alone() {
    for (mode, task, left, batch) in
        [("delete", "die", "town.gpkg-journal", 0), ("wal", "die in log", "town.gpkg-wal", 5)]
    {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("town.gpkg");
        package(&path, mode);
        drop(OtherWriter::start(task, &path));
        // As in a copied folder, where no program has the file open.
        let _ = std::fs::remove_file(folder.path().join("town.gpkg-shm"));
        assert_eq!(beside(&path), ["town.gpkg", left]);
        let before = [&path, &folder.path().join(left)].map(|path| std::fs::read(path).unwrap());
        for _ in 0..3 {
            assert_eq!(batches(&path, &within(Duration::from_secs(30))).unwrap(), [batch], "{mode}");
        }
        assert_eq!(beside(&path), ["town.gpkg", left]);
        let after = [&path, &folder.path().join(left)].map(|path| std::fs::read(path).unwrap());
        assert!(before == after, "{mode}");
    }
}

#[test]
fn a_closed_package_in_log_mode_is_read_without_making_a_log() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("town.gpkg");
    package(&path, "wal");
    assert_eq!(beside(&path), ["town.gpkg"]);
    assert_eq!(batches(&path, &within(Duration::from_secs(30))).unwrap(), [0]);
    assert_eq!(beside(&path), ["town.gpkg"]);
}

#[test]
fn a_large_package_is_read_in_place_and_a_change_meanwhile_is_no_second_state() {
    for mode in ["delete", "wal"] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("town.gpkg");
        package(&path, mode);
        let writer = Connection::open(&path).unwrap();
        writer
            .execute_batch("CREATE TABLE filling(a); INSERT INTO filling VALUES (zeroblob(70000000))")
            .unwrap();
        writer.busy_timeout(Duration::from_millis(50)).unwrap();
        let budget = within(Duration::from_secs(60));
        assert_eq!(layer(&path, "a", &budget).unwrap().features.len() as i64, ROWS);
        let state = PackageState::open(&path, "town.gpkg", &budget).unwrap();
        assert!(state.is_locked(), "{mode}");
        let written = writer.execute_batch("UPDATE a SET batch = 1; UPDATE b SET batch = 1");
        if mode == "delete" {
            // A writer waits until the run has finished reading.
            assert!(written.is_err());
            assert_eq!(batches(&path, &budget).unwrap(), [0]);
            drop((state, budget));
            writer.execute_batch("UPDATE a SET batch = 1; UPDATE b SET batch = 1").unwrap();
        } else {
            written.unwrap();
            let error = batches(&path, &budget).unwrap_err();
            insta::assert_snapshot!(error, @"
            another program changed town.gpkg while Burgeon read it
              help: save and close the file there, and run again
            ");
        }
        assert_eq!(batches(&path, &within(Duration::from_secs(60))).unwrap(), [1]);
    }
}
