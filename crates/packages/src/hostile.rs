//! Tests that installed packages are valid, and that rejected packages leave no files behind.

use std::io::{Cursor, Read as _, Write as _};
use std::path::Path;

use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::*;

const MOD: &str = "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n";

/// Returns a zip of these files.
fn zip_of(files: &[(&str, &str)]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        if let Some(target) = content.strip_prefix("-> ") {
            zip.add_symlink(*name, target, SimpleFileOptions::default()).unwrap();
        } else if name.ends_with('/') {
            zip.add_directory(*name, SimpleFileOptions::default()).unwrap();
        } else {
            zip.start_file(*name, SimpleFileOptions::default()).unwrap();
            zip.write_all(content.as_bytes()).unwrap();
        }
    }
    zip.finish().unwrap().into_inner()
}

/// Returns every path below a folder.
fn all(folder: &Path) -> Vec<String> {
    let mut paths = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            paths.push(path.strip_prefix(folder).unwrap().display().to_string());
            if path.symlink_metadata().unwrap().is_dir() {
                folders.push(path);
            }
        }
    }
    paths.sort();
    paths
}

/// Returns the error for a zip that must not be installed, and checks that it leaves no files behind.
fn refusal(bytes: &[u8]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let zip = folder.path().join("castle.zip");
    std::fs::write(&zip, bytes).unwrap();
    let error = install(&zip, &folder.path().join("mods"), false, |_| Ok(())).unwrap_err();
    assert_eq!(all(folder.path()), ["castle.zip"], "{error}");
    assert!(error.remedy().is_some(), "{error}");
    error.message().replace(&folder.path().display().to_string(), "FOLDER")
}

#[test]
fn a_zip_is_installed_whole_from_its_root_or_from_its_only_folder() {
    for inner in ["", "castle-main/"] {
        let folder = tempfile::tempdir().unwrap();
        let zip = folder.path().join("a.zip");
        let file = |name: &str| format!("{inner}{name}");
        let (a, b, c, d) = (file("mod.toml"), file("a/b.lua"), file(".git/x"), file("empty/"));
        let files = [(a.as_str(), MOD), (&b, "return 1"), (&c, "x"), (&d, "")];
        std::fs::write(&zip, zip_of(&files)).unwrap();
        let mods = folder.path().join("mods");
        let made = install(&zip, &mods, false, |_| Ok(())).unwrap();
        assert_eq!((made.files, made.replaced.is_none(), made.folder), (2, true, mods.join("castle")));
        assert_eq!(all(&mods), ["castle", "castle/a", "castle/a/b.lua", "castle/mod.toml"]);
        // The package is only replaced if requested, and the replaced version is reported.
        let said = install(&zip, &mods, false, |_| Ok(())).unwrap_err().to_string();
        assert!(
            said.contains("a package castle 1.0.0 already exists in ") && said.contains("--replace"),
            "{said}"
        );
        std::fs::write(mods.join("castle/old.lua"), "").unwrap();
        std::fs::write(&zip, zip_of(&[(&a, &MOD.replace("1.0.0", "2.0.0"))])).unwrap();
        let made = install(&zip, &mods, true, |_| Ok(())).unwrap();
        assert_eq!(made.replaced.unwrap().to_string(), "1.0.0");
        assert_eq!(all(&mods), ["castle", "castle/mod.toml"]);
    }
}

#[test]
fn a_hostile_zip_is_refused_and_leaves_nothing_behind() {
    let with = |name: &str, content: &str| refusal(&zip_of(&[("mod.toml", MOD), (name, content)]));
    let said = [
        with("../evil.lua", "x"),
        with("a/../../evil.lua", "x"),
        with("/etc/evil", "x"),
        with("C:/evil", "x"),
        with("a\\..\\evil", "x"),
        with("a//b", "x"),
        with("a/./b", "x"),
        with("nul.lua", "x"),
        with("a\nb", "x"),
        with("trailing.", "x"),
        with("a\u{202e}gpj.lua", "x"),
        refusal(&zip_of(&[("mod.toml", MOD), ("\u{e9}.lua", "1"), ("e\u{301}.lua", "2")])),
        with("../evil/", ""),
        with("link.png", "-> /etc/passwd"),
        with("MOD.toml", "x"),
        with("mod.toml/x", "x"),
        with(&format!("{}x", "a/".repeat(40)), "x"),
        refusal(&zip_of(&[("a.lua", "x")])),
        refusal(&zip_of(&[("a/mod.toml", MOD), ("b/x.lua", "")])),
        refusal(&zip_of(&[("mod.toml", "name = \"castle\"")])),
        refusal(&zip_of(&[])),
        refusal(b"no zip at all"),
    ];
    insta::assert_snapshot!(said.join("\n"), @r"
    FOLDER/castle.zip has a file ../evil.lua, which is outside the package
    FOLDER/castle.zip has a file a/../../evil.lua, which is outside the package
    FOLDER/castle.zip has a file /etc/evil, which is outside the package
    FOLDER/castle.zip has a file C:/evil, with a name that not all systems support
    FOLDER/castle.zip has a file a\\..\\evil, with a name that not all systems support
    FOLDER/castle.zip has a file a//b, with a name that not all systems support
    FOLDER/castle.zip has a file a/./b, with a name that not all systems support
    FOLDER/castle.zip has a file nul.lua, with a name that not all systems support
    FOLDER/castle.zip has a file a\nb, with a name that not all systems support
    FOLDER/castle.zip has a file trailing., with a name that not all systems support
    FOLDER/castle.zip has a file a\u{202e}gpj.lua, with a name that not all systems support
    FOLDER/castle.zip has é.lua twice
    FOLDER/castle.zip has a file ../evil, which is outside the package
    FOLDER/castle.zip has link.png, which is a link
    FOLDER/castle.zip has mod.toml and MOD.toml, which are the same name on many systems
    FOLDER/castle.zip has mod.toml twice
    FOLDER/castle.zip has a file a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/x, which is nested too deep
    FOLDER/castle.zip has no mod.toml
    FOLDER/castle.zip has no mod.toml
    missing field `version` in mod.toml
    FOLDER/castle.zip has no mod.toml
    FOLDER/castle.zip cannot be unpacked
    ");
}

#[test]
fn a_name_that_a_zip_has_twice_is_refused() {
    // The zip writer rejects duplicate names, so rename one file in the bytes of the zip.
    let mut bytes = zip_of(&[("mod.toml", MOD), ("one.lua", "1"), ("two.lua", "2")]);
    let places: Vec<usize> = (0..bytes.len() - 7).filter(|at| &bytes[*at..at + 7] == b"two.lua").collect();
    assert_eq!(places.len(), 2);
    places.into_iter().for_each(|at| bytes[at..at + 7].copy_from_slice(b"one.lua"));
    assert_eq!(refusal(&bytes), "FOLDER/castle.zip has one.lua twice");
}

#[test]
fn a_zip_of_too_many_files_or_bytes_is_refused() {
    let names: Vec<String> = (0..=MOST).map(|index| format!("{index}.lua")).collect();
    let mut files: Vec<(&str, &str)> = names.iter().map(|name| (name.as_str(), "")).collect();
    files.push(("mod.toml", MOD));
    assert_eq!(refusal(&zip_of(&files)), "FOLDER/castle.zip has more than 10000 files and folders");
    // Folders count too, regardless of the number of files in them.
    let folder = tempfile::tempdir().unwrap();
    let mut copy = copy::PackageCopy::new(folder.path().join("new"), LARGEST, 20).unwrap();
    copy.add(Path::new("a.zip"), &format!("{}x", "a/".repeat(15)), &mut std::io::empty()).unwrap();
    let said =
        copy.add(Path::new("a.zip"), &format!("{}x", "b/".repeat(15)), &mut std::io::empty()).unwrap_err();
    assert_eq!(said.message(), "a.zip has more than 20 files and folders");
    // The size in a header is not trusted.
    let folder = tempfile::tempdir().unwrap();
    let mut copy = copy::PackageCopy::new(folder.path().join("new"), 2_000_000, MOST).unwrap();
    let said = copy.add(Path::new("bomb.zip"), "a.png", &mut std::io::repeat(0).take(u64::MAX)).unwrap_err();
    assert_eq!(said.message(), "bomb.zip has more than 2 MB");
}

#[test]
fn every_damaged_zip_is_refused_or_sound() {
    let bytes = zip_of(&[("mod.toml", MOD), ("a/b.lua", "return 1"), ("c.lua", "return 2")]);
    for at in 0..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[at] ^= if at % 2 == 0 { 0x01 } else { 0xff };
        let folder = tempfile::tempdir().unwrap();
        let zip = folder.path().join("castle.zip");
        std::fs::write(&zip, &damaged).unwrap();
        if install(&zip, &folder.path().join("mods"), false, |_| Ok(())).is_err() {
            assert_eq!(all(folder.path()), ["castle.zip"], "byte {at}");
        }
        if at % 5 == 0 {
            refusal(&bytes[..at]);
        }
    }
}

#[cfg(unix)]
#[test]
fn a_folder_with_links_or_devices_is_refused_and_a_sound_one_is_copied() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let from = folder.path().join("work");
    std::fs::create_dir_all(from.join("a")).unwrap();
    std::fs::write(from.join("mod.toml"), MOD).unwrap();
    std::fs::write(from.join("a/b.lua"), "return 1").unwrap();
    let mods = folder.path().join("mods");
    let refused = || {
        let error = install(&from, &mods, false, |_| Ok(())).unwrap_err();
        assert!(!mods.exists(), "{error}");
        error.message().replace(&folder.path().display().to_string(), "FOLDER")
    };
    symlink("/etc/passwd", from.join("a/stone.png")).unwrap();
    assert_eq!(refused(), "FOLDER/work has a/stone.png, which is a link");
    std::fs::remove_file(from.join("a/stone.png")).unwrap();
    symlink("..", from.join("loop")).unwrap();
    assert_eq!(refused(), "FOLDER/work has loop, which is a link");
    std::fs::remove_file(from.join("loop")).unwrap();
    let pipe = from.join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    assert_eq!(refused(), "FOLDER/work has pipe, which is a device or a pipe");
    std::fs::remove_file(&pipe).unwrap();
    std::fs::write(from.join("A"), "").unwrap();
    assert!(refused().contains("which are the same name on many systems"));
    std::fs::remove_file(from.join("A")).unwrap();
    install(&from, &mods, false, |_| Ok(())).unwrap();
    assert_eq!(all(&mods), ["castle", "castle/a", "castle/a/b.lua", "castle/mod.toml"]);
    // Copying a folder into itself must end.
    std::fs::rename(from.join("mod.toml"), from.join("a/mod.toml")).unwrap();
    let said = install(&from.join("a"), &from.join("a/mods"), false, |_| Ok(())).unwrap();
    assert_eq!(said.files, 2);
}
