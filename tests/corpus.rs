//! Tests that every file of `fuzz/corpus` is read by its reader, and that no reader panics.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]

#[path = "../fuzz/src/targets.rs"]
mod targets;

use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn readers_of_foreign_bytes_take_or_refuse_each_file_of_the_corpus() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus");
    let names = |path: &Path| -> BTreeSet<String> {
        let entries = std::fs::read_dir(path).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    };
    let known: BTreeSet<String> = targets::TARGETS.iter().map(|target| target.name.to_owned()).collect();
    assert_eq!(names(&corpus), known);
    let scratch = tempfile::tempdir().unwrap();
    let (mut size, mut wrong) = (0, Vec::new());
    for target in &targets::TARGETS {
        assert!(target.words.iter().all(|word| !word.is_empty()));
        let folder = corpus.join(target.name);
        let good = names(&folder).into_iter().filter(|name| {
            let bytes = std::fs::read(folder.join(name)).unwrap();
            size += bytes.len();
            let read = (target.read)(&bytes, scratch.path());
            // The name of a file determines the expected result.
            if read != name.starts_with("good") {
                wrong.push(format!("{}/{name}", target.name));
            }
            read
        });
        assert!(good.count() > 0, "{}: no file can be read", target.name);
    }
    assert_eq!(wrong, [""; 0], "these are called otherwise than they are read");
    assert!(size < 200_000, "{size} bytes");
}
