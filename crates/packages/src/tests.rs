//! Tests of packages in folders: finding and ordering them, and resolving the names of their files.

use std::path::{Path, PathBuf};

use proptest::prelude::*;

use super::*;

/// Creates a folder with packages, each given by its path and the content of its `mod.toml` after the name.
fn folder(packages: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (path, more) in packages {
        let name = path.rsplit('/').next().unwrap().split('@').next().unwrap();
        let head = if more.contains("version") { "" } else { "version = \"1.0.0\"\n" };
        write(
            folder.path(),
            &format!("{path}/mod.toml"),
            &format!("name = \"{name}\"\napi = \"1\"\n{head}{more}"),
        );
    }
    folder
}

fn write(folder: &Path, name: &str, content: &str) {
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, content).unwrap();
}

fn find(folder: &tempfile::TempDir) -> Packages {
    let path = folder.path();
    let (given, user) = ([path.join("given")], path.join("user"));
    let given = if given[0].is_dir() { &given[..] } else { &[] };
    let search = PackageSearch { script: Some(path), given, user: Some(&user) };
    Packages::find(search, &Version::new(1, 2, 0))
}

fn order(packages: &Packages) -> Vec<&str> {
    packages.order().iter().map(|package| package.manifest.name.as_str()).collect()
}

/// Formats problems without the path of the test folder.
fn messages(folder: &tempfile::TempDir, problems: &[burgeon_base::Error]) -> String {
    let text: Vec<String> = problems.iter().map(ToString::to_string).collect();
    text.join("\n").replace(&folder.path().display().to_string(), "FOLDER")
}

/// Formats all problems of packages, used or not, without the path of the test folder.
fn troubles(folder: &tempfile::TempDir, packages: &Packages) -> String {
    let of_packages = packages.order().iter().flat_map(|package| &package.problems);
    let broken = packages.broken.iter().map(|broken| &broken.error);
    let errors = packages.problems.iter().chain(of_packages).chain(broken).map(ToString::to_string);
    let mut all: Vec<String> = errors.chain(packages.warnings.iter().map(ToString::to_string)).collect();
    let mut known = std::collections::BTreeSet::new();
    all.retain(|text| known.insert(text.clone()));
    all.join("\n").replace(&folder.path().display().to_string(), "FOLDER")
}

fn locate(packages: &Packages, name: &str, asker: &str) -> std::result::Result<PathBuf, String> {
    let name = FileName::parse(name).map_err(|error| error.to_string())?;
    let found = packages.locate("file", &name, packages.get(asker), &mut |_, _| {});
    found.map(|found| found.path).map_err(|error| error.to_string())
}

#[test]
fn packages_come_after_what_they_depend_on_and_else_by_name() {
    let folder = folder(&[
        ("mods/a", "[depends]\nd = \"1\""),
        ("mods/b", ""),
        ("mods/c", "[optional]\nb = \"1\"\nnot_there = \"1\""),
        ("given/d", "[depends]\ne = \"*\""),
        ("user/e", ""),
    ]);
    let packages = find(&folder);
    assert_eq!(order(&packages), ["b", "c", "e", "d", "a"]);
    assert!(packages.problems.is_empty(), "{}", messages(&folder, &packages.problems));
}

#[test]
fn of_one_name_the_one_beside_the_script_counts_and_the_others_are_told() {
    let folder = folder(&[
        ("mods/castle", "version = \"1.0.0\""),
        ("given/castle", "version = \"2.0.0\""),
        ("user/castle", "version = \"3.0.0\""),
    ]);
    let packages = find(&folder);
    assert_eq!(packages.get("castle").unwrap().manifest.version, Version::new(1, 0, 0));
    assert_eq!(packages.hidden.len(), 2);
    // The user's folder is shared by all scripts, so other versions in it cause no warning.
    let warnings: Vec<String> = packages.warnings.iter().map(ToString::to_string).collect();
    insta::assert_snapshot!(warnings.join("\n").replace(&folder.path().display().to_string(), "FOLDER"), @r"
    FOLDER/given/castle/mod.toml:1: ignored castle 2.0.0 in FOLDER/given/castle: castle 1.0.0 in FOLDER/mods/castle takes precedence
      help: remove one of them
    ");
}

#[test]
fn what_cannot_be_used_together_is_told_with_its_line() {
    let told_of = |packages: &[(&str, &str)]| {
        let folder = folder(packages);
        let packages = find(&folder);
        assert!(packages.problems.is_empty());
        troubles(&folder, &packages)
    };
    insta::assert_snapshot!(told_of(&[("mods/castle", "[depends]\nmasonry = \"1\"")]), @r"
    FOLDER/mods/castle/mod.toml:5: the package castle needs masonry ^1, which is not installed
      help: install it next to the other packages: burgeon mods add FOLDER
    ");
    insta::assert_snapshot!(told_of(&[("mods/castle", "[depends]\nmasonry = \"2\""), ("mods/masonry", "")]), @r"
    FOLDER/mods/castle/mod.toml:5: the package castle needs masonry ^2, but 1.0.0 is in FOLDER/mods/masonry
      help: install a masonry of that version
    ");
    insta::assert_snapshot!(told_of(&[("mods/castle", "[depends]\nmasonry = \"2\""), ("mods/masonry", ""), ("user/masonry", "version = \"2.1.0\"")]), @r"
    FOLDER/mods/castle/mod.toml:5: the package castle needs masonry ^2, but 1.0.0 is in FOLDER/mods/masonry
      help: 2.1.0 in FOLDER/user/masonry is suitable: remove the other one
    ");
    insta::assert_snapshot!(told_of(&[("mods/a", "[depends]\nb = \"1\""), ("mods/b", "[depends]\nc = \"1\""), ("mods/c", "[depends]\na = \"1\"")]), @r"
    FOLDER/mods/a/mod.toml:5: circular package dependency: a -> b -> c -> a
      help: move the common part into a third package
    ");
    insta::assert_snapshot!(told_of(&[("mods/a", "[depends]\na = \"1\"")]), @r"
    FOLDER/mods/a/mod.toml:5: circular package dependency: a -> a
      help: move the common part into a third package
    ");
    insta::assert_snapshot!(told_of(&[("mods/a", "[conflicts]\nb = \"1\""), ("given/b", "")]), @r"
    FOLDER/mods/a/mod.toml:5: the package a conflicts with b 1.0.0
      help: remove one of FOLDER/mods/a and FOLDER/given/b
    ");
    insta::assert_snapshot!(told_of(&[("mods/a", "[replaces]\n\"@b/x.png\" = \"x.png\""), ("given/b", "")]), @r#"
    FOLDER/mods/a/mod.toml:5: the package a replaces a file of b, but does not depend on it
      help: write below [depends]: b = "*"
    FOLDER/mods/a/mod.toml:5: a changes nothing of b: the package a replaces a file of b, but does not depend on it
      help: write below [depends]: b = "*"
    "#);
    insta::assert_snapshot!(told_of(&[("mods/a", "[params.b]\nx = 1"), ("given/b", "")]), @r#"
    FOLDER/mods/a/mod.toml:5: the package a sets a parameter of b, but does not depend on it
      help: write below [depends]: b = "*"
    FOLDER/mods/a/mod.toml:5: a changes nothing of b: the package a sets a parameter of b, but does not depend on it
      help: write below [depends]: b = "*"
    "#);
    insta::assert_snapshot!(told_of(&[("mods/one/castle", "")]), @"");
}

#[test]
fn optional_packages_may_name_one_another() {
    let folder = folder(&[
        ("mods/a", "[optional]\nb = \"1\""),
        ("mods/b", "[optional]\na = \"1\"\n[depends]\nc = \"1\""),
        ("mods/c", "[optional]\nb = \"2\"\na = \"1\""),
    ]);
    write(folder.path(), "mods/b/x.lua", "");
    let packages = find(&folder);
    assert_eq!(order(&packages), ["a", "c", "b"]);
    assert!(locate(&packages, "@b/x.lua", "a").is_ok());
    // An optional package of another version is ignored, and rejected for packages that request it.
    assert!(locate(&packages, "@b/x.lua", "").is_ok());
    let said = locate(&packages, "@b/x.lua", "c").unwrap_err();
    assert!(said.contains("the package c needs b ^2, but 1.0.0 is in"), "{said}");
    insta::assert_snapshot!(troubles(&folder, &packages), @r"
    FOLDER/mods/c/mod.toml:5: c does not use its optional dependency b: the package c needs b ^2, but 1.0.0 is in FOLDER/mods/b
      help: install a b of that version
    ");
}

#[cfg(unix)]
#[test]
fn switched_off_packages_are_not_there() {
    let folder =
        folder(&[("mods/castle", ""), ("user/castle", ""), ("mods/ruins", "[depends]\ncastle = \"1\"")]);
    let script = folder.path();
    assert!(!switch(script, "castle", true).unwrap().1);
    assert!(switch(script, "castle", false).unwrap().1);
    assert!(!switch(script, "castle", false).unwrap().1);
    let packages = find(&folder);
    assert_eq!((order(&packages), packages.disabled.len()), (vec!["ruins"], 1));
    insta::assert_snapshot!(locate(&packages, "@ruins/a.lua", "").unwrap_err().replace(&script.display().to_string(), "FOLDER"), @r"
    FOLDER/mods/ruins/mod.toml:5: the package ruins needs castle, which is disabled in FOLDER/mods/disabled.txt
      help: enable it: burgeon mods enable castle
    ");
    insta::assert_snapshot!(locate(&packages, "@castle/a.lua", "").unwrap_err().replace(&script.display().to_string(), "FOLDER"), @r"
    the package castle is disabled in FOLDER/mods/disabled.txt
      help: enable it: burgeon mods enable castle
    ");
    let file = script.join("mods").join(SWITCHES);
    std::fs::write(&file, "# for now\ncastle # until it is done\n\nruins\n").unwrap();
    switch(script, "castle", true).unwrap();
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "# for now\n\nruins\n");
    switch(script, "ruins", true).unwrap();
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "# for now\n\n");
    std::fs::write(&file, "Castle!").unwrap();
    assert!(switch(script, "castle", false).unwrap_err().place().is_some());
    assert_eq!(order(&find(&folder)), ["castle", "ruins"]);
    // A link is not followed, because its target would be shown.
    std::fs::remove_file(&file).unwrap();
    std::os::unix::fs::symlink("/etc/passwd", &file).unwrap();
    let said = switch(script, "castle", false).unwrap_err().to_string();
    assert!(said.contains("it is not a regular file") && !said.contains("root"), "{said}");
}

#[test]
fn names_of_files_are_the_same_however_their_accents_are_written() {
    let folder = folder(&[("mods/castle", "")]);
    write(folder.path(), "mods/castle/de\u{301}cor/e\u{301}.lua", "");
    write(folder.path(), "mods/castle/\u{fc}.lua", "");
    let packages = find(&folder);
    for name in ["d\u{e9}cor/\u{e9}.lua", "de\u{301}cor/\u{e9}.lua", "u\u{308}.lua", "\u{fc}.lua"] {
        assert!(locate(&packages, &format!("@castle/{name}"), "").is_ok(), "{name:?}");
    }
    let said = locate(&packages, "@castle/a\u{202e}b.lua", "").unwrap_err();
    assert!(said.contains("reverses text") && !said.contains('\u{202e}'), "{said}");
}

#[test]
fn a_package_that_nobody_uses_breaks_no_script_from_the_users_folder() {
    let folder = folder(&[("user/a", "[depends]\nb = \"1\""), ("user/c", "nonsense"), ("mods/d", "")]);
    let packages = find(&folder);
    assert!(packages.problems.is_empty(), "{}", messages(&folder, &packages.problems));
    assert!(locate(&packages, "@a/x.lua", "").unwrap_err().contains("needs b ^1, which is not installed"));
    assert!(locate(&packages, "@c/x.lua", "").unwrap_err().contains("this is not TOML"));
}

#[test]
fn the_last_package_that_replaces_a_file_counts_and_finds_the_one_before_it() {
    let folder = folder(&[
        ("mods/castle", ""),
        ("mods/ruins", "[depends]\ncastle = \"1\"\n[replaces]\n\"@castle/a.lua\" = \"a.lua\""),
        (
            "mods/snow",
            "[depends]\ncastle = \"1\"\nruins = \"1\"\n[replaces]\n\"@castle/a.lua\" = \"b.lua\"\n\"@ruins/c.lua\" = \"c.lua\"",
        ),
        ("user/fog", "[depends]\ncastle = \"1\"\n[replaces]\n\"@castle/a.lua\" = \"a.lua\""),
    ]);
    for file in ["castle/a.lua", "ruins/a.lua", "ruins/c.lua", "snow/b.lua", "snow/c.lua"] {
        write(folder.path(), &format!("mods/{file}"), "");
    }
    let packages = find(&folder);
    assert!(packages.problems.is_empty() && packages.warnings.is_empty(), "{:?}", packages.warnings);
    let is = |name: &str, asker: &str, file: &str| {
        let wanted = folder.path().join("mods").join(file).canonicalize().unwrap();
        assert_eq!(locate(&packages, name, asker).unwrap(), wanted, "{name} for {asker}");
    };
    is("@castle/a.lua", "", "snow/b.lua");
    is("@castle/a.lua", "castle", "snow/b.lua");
    is("@castle/a.lua", "snow", "ruins/a.lua");
    is("@castle/a.lua", "ruins", "castle/a.lua");
    is("@ruins/c.lua", "", "snow/c.lua");
    is("@ruins/c.lua", "snow", "ruins/c.lua");
}

#[test]
fn two_packages_that_replace_the_same_are_told_of_unless_one_knows_the_other() {
    let replaces = "[replaces]\n\"@castle/a.png\" = \"a.png\"\n[params.castle]\nheight = 3";
    let folder = folder(&[
        ("mods/castle", ""),
        ("mods/ruins", &format!("[depends]\ncastle = \"1\"\n{replaces}")),
        ("mods/snow", &format!("[depends]\ncastle = \"1\"\n{replaces}")),
        ("mods/spring", &format!("[depends]\ncastle = \"1\"\nsnow = \"1\"\n{replaces}")),
    ]);
    let warnings: Vec<String> = find(&folder).warnings.iter().map(ToString::to_string).collect();
    insta::assert_snapshot!(warnings.join("\n").replace(&folder.path().display().to_string(), "FOLDER"), @r"
    FOLDER/mods/ruins/mod.toml:7: ruins and snow both replace @castle/a.png; snow takes precedence
      help: remove one of them, or add ruins to the dependencies of snow if this is intended
    FOLDER/mods/ruins/mod.toml:9: ruins and snow both replace the default of height of castle; snow takes precedence
      help: remove one of them, or add ruins to the dependencies of snow if this is intended
    ");
}

#[test]
fn names_lead_nowhere_but_into_the_folders_of_packages() {
    for name in [
        "@castle/../secret",
        "@castle/..",
        "@castle/a/../../b",
        "@castle//etc/passwd",
        "@castle/C:/x",
        "@castle/a\\..\\b",
        "@castle/a\0b",
    ] {
        assert!(
            FileName::parse(name).unwrap_err().to_string().contains("is outside the package castle"),
            "{name:?}"
        );
    }
    for name in [
        "castle/a",
        "@",
        "@/a",
        "@Castle/a",
        "@../a",
        "@a b/c",
        "@c:/a",
        "@1/a",
        &format!("@{}", "a".repeat(41)),
    ] {
        assert!(FileName::parse(name).is_err(), "{name:?}");
    }
    assert_eq!(FileName::parse("@castle/./a//b").unwrap().to_string(), "@castle/a/b");
    assert_eq!(FileName::parse("@castle").unwrap().path, "");
}

#[cfg(unix)]
#[test]
fn links_lead_nowhere_but_into_the_folders_of_packages() {
    use std::os::unix::fs::symlink;
    let outside = folder(&[("castle", ""), ("gate", "")]);
    write(outside.path(), "secret", "secret");
    write(outside.path(), "gate/a.lua", "return 1");
    let folder = folder(&[("mods/castle", ""), ("mods/tower", "")]);
    let mods = folder.path().join("mods");
    symlink(outside.path().join("secret"), mods.join("castle/stone.png")).unwrap();
    symlink(outside.path(), mods.join("castle/all")).unwrap();
    symlink("../tower/mod.toml", mods.join("castle/beside")).unwrap();
    symlink("mod.toml", mods.join("castle/within")).unwrap();
    // A package under development elsewhere, and a link to a missing one.
    symlink(outside.path().join("gate"), mods.join("gate")).unwrap();
    symlink(outside.path().join("nowhere"), mods.join("gone")).unwrap();
    symlink(outside.path().join("gate"), mods.join("castle/inner")).unwrap();
    let packages = find(&folder);
    assert_eq!(
        locate(&packages, "@gate/a.lua", ""),
        Ok(outside.path().canonicalize().unwrap().join("gate/a.lua"))
    );
    for name in ["stone.png", "all/secret", "beside", "inner/a.lua"] {
        let said = locate(&packages, &format!("@castle/{name}"), "").unwrap_err();
        assert!(said.contains("is a link to a file outside the package castle"), "{said}");
    }
    assert!(locate(&packages, "@castle/within", "").is_ok());
    insta::assert_snapshot!(troubles(&folder, &packages), @r"
    FOLDER/mods/gone is a broken link
      help: remove it, or replace it by a package
    ");
    // A mod.toml must be inside the folder of its package.
    std::fs::remove_file(mods.join("gone")).unwrap();
    std::fs::remove_file(mods.join("tower/mod.toml")).unwrap();
    symlink(outside.path().join("castle/mod.toml"), mods.join("tower/mod.toml")).unwrap();
    insta::assert_snapshot!(troubles(&folder, &find(&folder)), @r"
    cannot read FOLDER/mods/tower/mod.toml: it is a link to a file outside the package
      help: a package is a folder with a text file mod.toml
    ");
    let linked = tempfile::tempdir().unwrap();
    symlink(outside.path(), linked.path().join("mods")).unwrap();
    assert_eq!(order(&find(&linked)), ["castle", "gate"]);
}

#[test]
fn a_mod_toml_is_refused_with_its_line() {
    let refused = |text: &str| Manifest::parse(text, "mod.toml").unwrap_err().to_string();
    let said: Vec<String> = [
        "name = 3",
        "name = \"castle\nversion = 1",
        "name = \"castle\"\nname = \"castle\"",
        "version = \"1.0.0\"",
        "name = \"Castle\"",
        "name = \"castle\"",
        "name = \"castle\"\nversion = \"1.0\"\napi = \"1\"",
        "name = \"castle\"\nversion = \"1.0.0\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"one\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\nauthors = \"Ada\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n[dependss]\na = \"1\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\nicon = \"a.png\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\ndepends = [\"a\"]",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n[depends]\nmasonry = 1",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n[depends]\n\"../masonry\" = \"1\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n[depends]\nmasonry = \"newest\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n[replaces]\n\"stone.png\" = \"a.png\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n[replaces]\n\"@a\" = \"a.png\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n[replaces]\n\"@a/../b\" = \"a.png\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n[replaces]\n\"@a/b\" = \"../a.png\"",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n[params]\nheight = 3",
        "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n[params.masonry]\nheight = [3]",
    ]
    .map(refused)
    .to_vec();
    insta::assert_snapshot!(said.join("\n"), @r#"
    mod.toml:1: name must be a string in quotes, not a number
      help: write name = "..."
    mod.toml:1: this is not TOML: invalid basic string, expected `"`
      help: write name = "castle", one field per line
    mod.toml:2: this is not TOML: duplicate key
      help: write name = "castle", one field per line
    mod.toml:1: missing field `name` in mod.toml
      help: write name = "castle"
    mod.toml:1: invalid package name "Castle"
      help: a name begins with a lowercase letter and contains lowercase letters, digits, _ and -, at most 40 characters
    mod.toml:1: missing field `version` in mod.toml
      help: write version = "1.0.0"
    mod.toml:2: invalid version "1.0": unexpected end of input while parsing minor version number
      help: a version has three numbers: version = "1.0.0"
    mod.toml:1: missing field `api` in mod.toml
      help: write api = "1.0"
    mod.toml:3: invalid version requirement "one": unexpected character 'o' while parsing major version number
      help: write "1.2" for 1.2.0 to 2.0.0 (exclusive); ">=1.2, <1.5"; or "*" for all
    mod.toml:4: authors must be a list of strings, not a text
      help: write authors = ["Ada"]
    mod.toml:4: unknown field `dependss` in mod.toml
      help: did you mean depends?
    mod.toml:4: unknown field `icon` in mod.toml
      help: it has name, version, api, doc, authors, licence, depends, optional, conflicts, replaces, params
    mod.toml:4: depends must be a table, not a list
      help: write [depends] and below it masonry = "1.0"
    mod.toml:5: depends: masonry must be a string in quotes, not a number
      help: write "1.0"
    mod.toml:5: depends: invalid package name "../masonry"
      help: write [depends] and below it masonry = "1.0"
    mod.toml:5: invalid version requirement "newest": unexpected character 'n' while parsing major version number
      help: write "1.2" for 1.2.0 to 2.0.0 (exclusive); ">=1.2, <1.5"; or "*" for all
    mod.toml:5: "stone.png" is not a file of a package
      help: write "@castle/stone.png" for stone.png of the package castle
    mod.toml:5: replaces: @a does not contain a file name
      help: write [replaces] and below it "@castle/stone.png" = "stone.png"
    mod.toml:5: @a/../b is outside the package a
      help: use a file in its folder or its subfolders: "@a/stone.png"
    mod.toml:5: replaces: "../a.png" is not a file of the package
      help: use a path relative to the package's folder: "textures/stone.png"
    mod.toml:5: params: height must be a table, not a number
      help: write [params.castle] and below it height = 12
    mod.toml:5: params: masonry: height must be a number, a boolean or a string, not a list
      help: write [params.castle] and below it height = 12
    "#);
}

#[test]
fn a_mod_toml_says_what_it_says() {
    let text = "name = \"castle\"\nversion = \"1.2.3-rc.1\"\napi = \"1.1\"\ndoc = \"Towers.\"\nauthors = [\"Ada\", \"Bob\"]\n\
                licence = \"CC0-1.0\"\n[depends]\nz = \"1\"\na = \"*\"\n[replaces]\n\"@z/a.png\" = \"t/a.png\"\n\
                [params.z]\nheight = 12.5\nlit = true\nkind = \"gate\"\ncount = -3";
    let read = Manifest::parse(text, "mod.toml").unwrap();
    assert_eq!((read.name.as_str(), read.version.to_string().as_str()), ("castle", "1.2.3-rc.1"));
    assert_eq!((read.doc.as_str(), read.licence.as_str(), read.authors.len()), ("Towers.", "CC0-1.0", 2));
    assert_eq!(
        read.depends.iter().map(|it| (it.name.as_str(), it.line)).collect::<Vec<_>>(),
        [("z", 8), ("a", 9)]
    );
    let params: Vec<(&str, &str)> =
        read.params.iter().map(|it| (it.name.as_str(), it.value.as_str())).collect();
    assert_eq!(params, [("height", "12.5"), ("lit", "true"), ("kind", "gate"), ("count", "-3")]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn no_text_makes_reading_a_mod_toml_panic(text in "(name|version|api|depends|replaces|params|[=\\[\\]\".@/{}, \n]|[a-z0-9]){0,60}") {
        if let Err(error) = Manifest::parse(&text, "mod.toml") {
            prop_assert!(error.place().is_some() && error.remedy().is_some(), "{error}");
        }
    }

    #[test]
    fn names_that_are_read_stay_in_their_package(path in "(\\.\\.|\\.|/|\\\\|[a-z:\0]){0,20}") {
        if let Ok(name) = FileName::parse(&format!("@castle/{path}")) {
            prop_assert!(!name.path.starts_with('/') && name.path.split('/').all(|part| part != ".."));
            prop_assert_eq!(FileName::parse(&name.to_string()).unwrap(), name);
        }
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn the_order_is_that_of_dependencies_and_never_that_of_folders(
        edges in prop::collection::vec((0..12_usize, 0..12_usize), 0..30),
        places in prop::collection::vec(0..3_usize, 12),
    ) {
        let text = |package: usize| {
            let mut others: Vec<usize> = edges.iter().filter(|(from, to)| *from == package && to < from).map(|it| it.1).collect();
            others.sort_unstable();
            others.dedup();
            let lines: Vec<String> = others.iter().map(|other| format!("p{other} = \"1\"\n")).collect();
            format!("[depends]\n{}", lines.concat())
        };
        let roots = ["mods", "given", "user"];
        let paths = |place: &dyn Fn(usize) -> usize| -> Vec<(String, String)> {
            (0..12).map(|package| (format!("{}/p{package}", roots[place(package)]), text(package))).collect()
        };
        let made = |paths: Vec<(String, String)>| {
            let paths: Vec<(&str, &str)> = paths.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
            let folder = folder(&paths);
            let packages = find(&folder);
            assert!(packages.problems.is_empty());
            packages.order().iter().map(|package| package.manifest.name.clone()).collect::<Vec<_>>()
        };
        let one = made(paths(&|_| 0));
        prop_assert_eq!(&one, &made(paths(&|package| places[package])));
        for (at, name) in one.iter().enumerate() {
            let package: usize = name[1..].parse().unwrap();
            for (from, to) in &edges {
                if *from == package && to < from {
                    let other = format!("p{to}");
                    prop_assert!(one[..at].contains(&other), "{} stands before {}", name, other);
                }
            }
        }
    }
}
