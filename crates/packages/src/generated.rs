//! Tests of random sets of packages against a simple model of the packages that can be used.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use proptest::prelude::*;

use super::*;

/// Number of different names.
const NAMES: usize = 8;

/// Package as a test writes it.
#[derive(Debug, Clone)]
struct PackageSketch {
    major: u64,
    needs: Vec<(usize, u64)>,
    may_use: Vec<(usize, u64)>,
    conflicts: Vec<(usize, u64)>,
    api: u64,
    root: usize,
    state: PackageCondition,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum PackageCondition {
    Sound,
    /// Package with an invalid `mod.toml`.
    Broken,
    /// Disabled package.
    Off,
    /// Package whose folder is a link.
    Link,
    /// Missing package.
    Missing,
}

fn name(number: usize) -> String {
    format!("p{number}")
}

fn package_sketch() -> impl Strategy<Value = PackageSketch> {
    // 0 represents all versions.
    let others = |most: usize| prop::collection::vec((0..NAMES, 0..3_u64), 0..most);
    let state = prop_oneof![
        8 => Just(PackageCondition::Sound), 1 => Just(PackageCondition::Broken), 1 => Just(PackageCondition::Off), 1 => Just(PackageCondition::Link), 1 => Just(PackageCondition::Missing),
    ];
    let api = prop_oneof![12 => Just(1_u64), 1 => Just(9_u64)];
    let major = prop_oneof![3 => Just(1_u64), 1 => Just(2_u64)];
    (major, others(3), others(3), others(2), api, 0..3_usize, state).prop_map(
        |(major, needs, may_use, conflicts, api, root, state)| {
            let once =
                |list: Vec<(usize, u64)>| list.into_iter().collect::<BTreeMap<_, _>>().into_iter().collect();
            let (needs, may_use, conflicts) = (once(needs), once(may_use), once(conflicts));
            PackageSketch { major, needs, may_use, conflicts, api, root, state }
        },
    )
}

fn text(number: usize, of: &PackageSketch) -> String {
    let list = |what: &str, list: &[(usize, u64)]| {
        let lines = list.iter().map(|(other, major)| match major {
            0 => format!("{} = \"*\"\n", name(*other)),
            _ => format!("{} = \"{major}\"\n", name(*other)),
        });
        format!("[{what}]\n{}", lines.collect::<String>())
    };
    format!(
        "name = \"{}\"\nversion = \"{}.0.0\"\napi = \"{}\"\n{}{}{}",
        name(number),
        of.major,
        of.api,
        list("depends", &of.needs),
        list("optional", &of.may_use),
        list("conflicts", &of.conflicts)
    )
}

fn write(packages: &[PackageSketch]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let roots = ["work/mods", "given", "user"];
    std::fs::create_dir_all(folder.path().join("work/mods")).unwrap();
    std::fs::create_dir_all(folder.path().join("given")).unwrap();
    let mut off = String::new();
    for (number, package) in packages.iter().enumerate() {
        let at = folder.path().join(roots[package.root]).join(name(number));
        let place = match package.state {
            PackageCondition::Missing => continue,
            PackageCondition::Link if cfg!(unix) => folder.path().join("checkouts").join(name(number)),
            _ => at.clone(),
        };
        std::fs::create_dir_all(&place).unwrap();
        std::fs::create_dir_all(at.parent().unwrap()).unwrap();
        #[cfg(unix)]
        if place != at {
            std::os::unix::fs::symlink(&place, &at).unwrap();
        }
        let nonsense = package.state == PackageCondition::Broken;
        let text = if nonsense { "name = ".to_owned() } else { text(number, package) };
        std::fs::write(place.join(MANIFEST), text).unwrap();
        std::fs::write(place.join("a.lua"), "return 1").unwrap();
        if package.state == PackageCondition::Off {
            off += &format!("{} # for a while\n", name(number));
        }
    }
    if !off.is_empty() {
        std::fs::write(folder.path().join("work/mods").join(SWITCHES), off).unwrap();
    }
    folder
}

fn find(folder: &Path) -> Packages {
    let [script, given, user] = ["work", "given", "user"].map(|name| folder.join(name));
    let search = PackageSearch { script: Some(&script), given: &[given], user: Some(&user) };
    Packages::find(search, &Version::new(1, 0, 0))
}

/// Returns true if the package `number` exists and can be read.
fn is_there(packages: &[PackageSketch], number: usize) -> bool {
    matches!(packages[number].state, PackageCondition::Sound | PackageCondition::Link)
}

fn fits(packages: &[PackageSketch], (other, major): (usize, u64)) -> bool {
    is_there(packages, other) && (major == 0 || packages[other].major == major)
}

/// Returns the package and all packages that it requires.
fn closure(packages: &[PackageSketch], number: usize, with_optional: bool) -> BTreeSet<usize> {
    let (mut all, mut next) = (BTreeSet::from([number]), vec![number]);
    while let Some(at) = next.pop() {
        let optional = packages[at].may_use.iter().filter(|_| with_optional);
        for (other, _) in packages[at].needs.iter().chain(optional) {
            if is_there(packages, *other) && all.insert(*other) {
                next.push(*other);
            }
        }
    }
    all
}

/// Returns true if a package requires itself, directly or indirectly.
fn is_in_circle(packages: &[PackageSketch], number: usize) -> bool {
    let mut needs = packages[number].needs.iter();
    needs.any(|(other, _)| is_there(packages, *other) && closure(packages, *other, false).contains(&number))
}

fn can_be_used(packages: &[PackageSketch], number: usize) -> bool {
    let all = closure(packages, number, false);
    let sound = |it: &usize| {
        let needs_fit = packages[*it].needs.iter().all(|need| fits(packages, *need));
        let own = closure(packages, *it, false);
        // Required packages are used together with the package. A package without requirements cannot conflict.
        let clashes = |one: &usize| {
            packages[*one].conflicts.iter().any(|(other, major)| {
                own.contains(other) && (*major == 0 || packages[*other].major == *major)
            })
        };
        packages[*it].api == 1
            && needs_fit
            && !is_in_circle(packages, *it)
            && !(own.len() > 1 && own.iter().any(clashes))
    };
    is_there(packages, number) && all.iter().all(sound)
}

fn locate(found: &Packages, number: usize) -> burgeon_base::Result<()> {
    let file = FileName::parse(&format!("@{}/a.lua", name(number))).unwrap();
    found.locate("file", &file, None, &mut |_, _| {}).map(|_| ())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_package_can_be_used_whatever_is_wrong_with_others(
        packages in prop::collection::vec(package_sketch(), NAMES),
    ) {
        let folder = write(&packages);
        let found = find(folder.path());
        prop_assert!(found.problems.is_empty(), "{:?}", found.problems);
        let order: Vec<&str> = found.order().iter().map(|package| package.manifest.name.as_str()).collect();
        let place = |number: usize| order.iter().position(|known| *known == name(number));
        for number in 0..NAMES {
            let usable = can_be_used(&packages, number);
            let located = locate(&found, number);
            prop_assert_eq!(located.is_ok(), usable, "p{}: {:?}\n{:?}", number, located.err().map(|it| it.to_string()), packages);
            prop_assert_eq!(found.get(&name(number)).is_some_and(Package::replaces), usable && found.get(&name(number)).is_some_and(|it| it.is_replacing));
            if let Err(error) = locate(&found, number) {
                prop_assert!(error.problems().all(|it| it.remedy().is_some()), "{}", error);
            }
            let Some(at) = place(number).filter(|_| usable) else { continue };
            for (other, _) in &packages[number].needs {
                prop_assert!(place(*other).unwrap() < at, "{:?}", order);
            }
            for (other, _) in packages[number].may_use.iter().filter(|(other, _)| is_there(&packages, *other)) {
                let leads_back = closure(&packages, *other, true).contains(&number);
                let waits = closure(&packages, *other, false).iter().any(|it| is_in_circle(&packages, *it));
                prop_assert!(leads_back || waits || place(*other).unwrap() < at, "p{} and p{}: {:?}\n{:?}", number, other, order, packages);
            }
        }
        // Required packages are locked together with the package that requires them.
        for number in (0..NAMES).filter(|number| can_be_used(&packages, *number)) {
            let needed: Vec<String> = found.with_dependencies(&name(number)).iter().map(|it| it.manifest.name.clone()).collect();
            let lock = found.lock(|name| needed.iter().any(|it| it == name)).unwrap();
            prop_assert_eq!(lock.iter().map(|it| it.name.clone()).collect::<Vec<_>>(), needed);
        }
    }

    #[test]
    fn what_is_wrong_elsewhere_changes_nothing(
        packages in prop::collection::vec(package_sketch(), NAMES),
        others in prop::collection::vec(package_sketch(), NAMES),
        seen in 0..NAMES,
    ) {
        // All packages that the package does not depend on, not even optionally, are replaced by others.
        let own = closure(&packages, seen, true);
        let changed: Vec<PackageSketch> = (0..NAMES)
            .map(|number| if own.contains(&number) || !is_there(&packages, number) { packages[number].clone() } else { others[number].clone() })
            .collect();
        let (one, other) = (write(&packages), write(&changed));
        let (one, other) = (locate(&find(one.path()), seen), locate(&find(other.path()), seen));
        // A required package that was missing may exist now; no other difference may change the result.
        let text = |result: &burgeon_base::Result<()>| result.as_ref().err().map(|error| error.problems().count());
        prop_assert_eq!(text(&one).is_some(), text(&other).is_some());
    }

    #[test]
    fn the_hash_follows_names_and_contents_and_nothing_else(
        files in prop::collection::btree_map("[a-c]{1,2}", "[xy]{0,3}", 1..5),
        changed in "[a-c]{1,2}", content in "[xy]{0,3}",
    ) {
        let hash = |files: &BTreeMap<String, String>, root: &str| {
            let folder = tempfile::tempdir().unwrap();
            let at = folder.path().join(root).join("castle");
            std::fs::create_dir_all(&at).unwrap();
            std::fs::write(at.join(MANIFEST), "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n").unwrap();
            for (name, content) in files.iter().rev() {
                std::fs::write(at.join(name), content).unwrap();
            }
            std::fs::create_dir_all(at.join(".git")).unwrap();
            std::fs::write(at.join(".git/HEAD"), root).unwrap();
            let search = PackageSearch { given: &[at], ..PackageSearch::default() };
            Packages::find(search, &Version::new(1, 0, 0)).lock(|_| true).unwrap().remove(0).hash
        };
        prop_assert_eq!(hash(&files, "one"), hash(&files, "two"));
        let mut other = files.clone();
        other.insert(changed, content);
        prop_assert_eq!(hash(&files, "one") == hash(&other, "one"), files == other);
    }
}
