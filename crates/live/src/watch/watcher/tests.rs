//! Tests of the watcher with all types of saves.

use std::fs;
use std::path::Path;
use std::sync::mpsc::{Receiver, channel};

use super::*;

/// Watch of `a.lua` in a new folder `sub`, and its reports.
struct Trial {
    folder: tempfile::TempDir,
    told: Receiver<Change>,
    watch: Watch,
}

/// System whose limit of watched folders is reached.
struct FullSystem;

impl notify::Watcher for FullSystem {
    fn new<F: notify::EventHandler>(_: F, _: notify::Config) -> notify::Result<Self> {
        Ok(Self)
    }
    fn watch(&mut self, _: &Path, _: notify::RecursiveMode) -> notify::Result<()> {
        Err(notify::Error::new(notify::ErrorKind::MaxFilesWatch))
    }
    fn unwatch(&mut self, _: &Path) -> notify::Result<()> {
        Ok(())
    }
    fn kind() -> notify::WatcherKind {
        notify::WatcherKind::NullWatcher
    }
}

impl Trial {
    fn new() -> Self {
        Self::by(folders::recommended, |why| panic!("{why}"))
    }

    fn by(
        make: impl FnOnce(Handler) -> notify::Result<AnyWatcher>,
        complain: impl FnOnce(String) + Send + 'static,
    ) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("sub")).unwrap();
        fs::write(folder.path().join("sub/a.lua"), "one").unwrap();
        let (teller, told) = channel();
        let files = vec![folder.path().join("sub/a.lua")];
        let changed = move |change| teller.send(change).unwrap();
        let watch = Watch::by(make, files, changed, complain).unwrap();
        // The first folders are watched before this is answered.
        watch.follow(vec![(folder.path().join("sub/a.lua"), true)], SystemTime::now());
        std::thread::sleep(Duration::from_millis(20));
        Self { folder, told, watch }
    }

    fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.at(name), text).unwrap();
    }

    /// Returns the time until the change is reported.
    #[track_caller]
    fn tells(&self, name: &str) -> Duration {
        let begin = Instant::now();
        let change = self.told.recv_timeout(Duration::from_secs(5)).unwrap();
        assert_eq!(change.files, [self.at(name)]);
        begin.elapsed()
    }

    #[track_caller]
    fn tells_nothing(&self) {
        assert!(self.told.recv_timeout(PATIENCE * 2).is_err());
    }
}

#[test]
fn every_way_to_save_is_told_once_and_soon() {
    let trial = Trial::new();
    let soon = Duration::from_millis(900);
    trial.write("sub/a.lua", "in place");
    assert!(trial.tells("sub/a.lua") < soon);
    trial.write("sub/.a.lua.swp", "renamed over");
    fs::rename(trial.at("sub/.a.lua.swp"), trial.at("sub/a.lua")).unwrap();
    assert!(trial.tells("sub/a.lua") < soon);
    fs::rename(trial.at("sub/a.lua"), trial.at("sub/a.lua~")).unwrap();
    trial.write("sub/a.lua", "after a backup");
    assert!(trial.tells("sub/a.lua") < soon);
    fs::remove_file(trial.at("sub/a.lua")).unwrap();
    std::thread::sleep(QUIET * 3);
    trial.write("sub/a.lua", "deleted and made again");
    assert!(trial.tells("sub/a.lua") < soon);
    trial.write("sub/a.lua", "");
    std::thread::sleep(QUIET * 3);
    trial.write("sub/a.lua", "cut to nothing and written");
    assert!(trial.tells("sub/a.lua") < soon);
    trial.write("sub/a.lua", "cut to nothing and written");
    trial.write("sub/b.lua", "another file");
    trial.tells_nothing();
    fs::remove_file(trial.at("sub/a.lua")).unwrap();
    assert!(trial.tells("sub/a.lua") < soon);
}

#[test]
fn a_folder_that_is_deleted_and_made_again_is_watched_again() {
    let trial = Trial::new();
    for text in ["two", "three"] {
        fs::remove_dir_all(trial.at("sub")).unwrap();
        trial.tells("sub/a.lua");
        fs::create_dir(trial.at("sub")).unwrap();
        trial.write("sub/a.lua", text);
        trial.tells("sub/a.lua");
        trial.write("sub/a.lua", "another");
        assert!(trial.tells("sub/a.lua") < Duration::from_millis(900));
    }
}

#[test]
fn a_file_that_is_not_there_yet_is_told_when_it_comes() {
    let trial = Trial::new();
    let path = |name: &str| Path::new(&trial.at(name)).to_path_buf();
    trial.watch.follow(vec![(path("sub/a.lua"), true), (path("deep/er/b.lua"), false)], SystemTime::now());
    std::thread::sleep(QUIET);
    fs::create_dir_all(trial.at("deep/er")).unwrap();
    trial.write("deep/er/b.lua", "here");
    trial.tells("deep/er/b.lua");
    trial.watch.follow(vec![(path("deep/er/b.lua"), true)], SystemTime::now());
    std::thread::sleep(QUIET);
    trial.write("sub/a.lua", "not watched any more");
    trial.tells_nothing();
}

#[track_caller]
fn polls(make: impl FnOnce(Handler) -> notify::Result<AnyWatcher>, why: &str) {
    let (complainer, complaints) = channel();
    let trial = Trial::by(make, move |why| complainer.send(why).unwrap());
    for text in ["two", "six", "ten"] {
        trial.write("sub/a.lua", text);
        assert!(trial.tells("sub/a.lua") < Duration::from_millis(900));
    }
    fs::rename(trial.at("sub"), trial.at("away")).unwrap();
    trial.tells("sub/a.lua");
    fs::rename(trial.at("away"), trial.at("sub")).unwrap();
    trial.tells("sub/a.lua");
    trial.write("sub/b.lua", "another file");
    trial.tells_nothing();
    let told: Vec<String> = complaints.try_iter().collect();
    assert_eq!(told.len(), 1);
    assert!(told[0].contains("ten times a second") && told[0].contains(why), "{told:?}");
}

#[test]
fn files_are_polled_where_folders_cannot_be_watched_and_that_is_told_once() {
    polls(|_| Err(notify::Error::generic("no watcher")), "no watcher");
    polls(|_| Ok(Box::new(FullSystem)), "OS file watch limit reached");
}

#[test]
fn changes_without_an_event_are_found_in_time() {
    let silent = |_: Handler| Ok(Box::new(notify::NullWatcher) as AnyWatcher);
    let trial = Trial::by(silent, |why| panic!("{why}"));
    for text in ["two", "six"] {
        trial.write("sub/a.lua", text);
        assert!(trial.tells("sub/a.lua") < ROUND * 2);
    }
    trial.tells_nothing();
}

#[test]
fn events_of_other_files_do_not_put_off_the_look_at_one_without_an_event() {
    let noisy = |mut handler: Handler| {
        std::thread::spawn(move || {
            for _ in 0..600 {
                let kind = notify::EventKind::Create(notify::event::CreateKind::File);
                handler(Ok(notify::Event::new(kind).add_path("/elsewhere/x".into())));
                std::thread::sleep(Duration::from_millis(5));
            }
        });
        Ok(Box::new(notify::NullWatcher) as AnyWatcher)
    };
    let trial = Trial::by(noisy, |why| panic!("{why}"));
    trial.write("sub/a.lua", "two");
    assert!(trial.tells("sub/a.lua") < ROUND * 2);
}

#[test]
fn who_catches_up_has_been_told_of_all_that_has_changed_before() {
    let trial = Trial::new();
    for round in 0..20 {
        trial.write("sub/a.lua", &format!("round {round}"));
        trial.watch.catch_up();
        assert_eq!(trial.told.try_iter().flat_map(|change| change.files).last(), Some(trial.at("sub/a.lua")));
        trial.watch.catch_up();
        assert!(trial.told.try_recv().is_err());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_that_someone_still_writes_into_is_told_when_it_is_closed_but_not_waited_for_for_ever() {
    use std::io::Write;
    for pause in [PATIENCE * 2, SAVE * 2] {
        // A late notice of the first pause must not count for the second.
        let trial = Trial::new();
        let mut file = fs::File::create(trial.at("sub/a.lua")).unwrap();
        let begin = Instant::now();
        writeln!(file, "half, {pause:?}").unwrap();
        while begin.elapsed() < pause {
            let told = trial.told.recv_timeout(QUIET).is_ok();
            assert!(!told || begin.elapsed() > SAVE - QUIET * 2, "{:?}", begin.elapsed());
        }
        writeln!(file, "whole").unwrap();
        drop(file);
        trial.tells("sub/a.lua");
    }
}

#[test]
fn what_was_just_written_in_part_is_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.json");
    fs::write(&path, "{").unwrap();
    let rest = path.clone();
    let writer = std::thread::spawn(move || {
        std::thread::sleep(PATIENCE / 3);
        fs::write(rest, "{}").unwrap();
    });
    let read = || match fs::read_to_string(&path).unwrap() {
        text if text == "{}" => Ok(text),
        text => Err(Error::data(text)),
    };
    assert_eq!(settled(&path, read).unwrap(), "{}");
    writer.join().unwrap();
    fs::write(&path, "[").unwrap();
    assert_eq!(settled(&path, read).unwrap_err().message(), "[");
}

/// Creates a watch of a database that is written through one connection, which stays open.
fn database(mode: &str) -> (Trial, rusqlite::Connection) {
    let trial = Trial::new();
    let path = trial.at("sub/town.gpkg");
    let writer = rusqlite::Connection::open(&path).unwrap();
    writer
        .execute_batch(&format!(
            "PRAGMA journal_mode = {mode}; CREATE TABLE a(x, filling); \
             INSERT INTO a VALUES (0, randomblob(200000)), (0, 'x')"
        ))
        .unwrap();
    trial.watch.follow(vec![(path, true)], SystemTime::now() + Duration::from_secs(5));
    std::thread::sleep(Duration::from_millis(300));
    while trial.told.try_recv().is_ok() {}
    (trial, writer)
}

#[test]
fn every_commit_to_a_database_that_stays_open_is_told_once() {
    for mode in ["wal", "delete", "truncate", "persist"] {
        let (trial, writer) = database(mode);
        for round in 1..=6 {
            writer.execute("UPDATE a SET x = ?1", [round]).unwrap();
            assert!(trial.tells("sub/town.gpkg") < Duration::from_millis(900), "{mode}");
            trial.tells_nothing();
        }
        // Neither an uncommitted nor a rolled-back change is reported.
        for end in ["COMMIT", "ROLLBACK"] {
            writer.execute_batch("BEGIN; UPDATE a SET x = x + 1").unwrap();
            trial.tells_nothing();
            writer.execute_batch(end).unwrap();
            match end {
                "COMMIT" => drop(trial.tells("sub/town.gpkg")),
                _ => trial.tells_nothing(),
            }
        }
        // The changes that a checkpoint transfers have been reported before.
        if mode == "wal" {
            for kind in ["PASSIVE", "TRUNCATE"] {
                writer.execute("UPDATE a SET x = x + 1", []).unwrap();
                trial.tells("sub/town.gpkg");
                writer.query_row(&format!("PRAGMA wal_checkpoint({kind})"), [], |_| Ok(())).unwrap();
                trial.tells_nothing();
            }
            writer.execute("UPDATE a SET x = x + 1", []).unwrap();
            trial.tells("sub/town.gpkg");
            drop(writer);
            trial.tells_nothing();
        }
    }
}
