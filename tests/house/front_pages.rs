//! A `mod.rs` contains only the documentation and the items of its folder.

use crate::sources::Source;
use crate::{members, root, text};

/// Returns `code` without attributes.
fn without_attributes(code: &str) -> String {
    let mut found = String::new();
    let mut rest = code;
    while let Some((before, behind)) = rest.split_once('#') {
        found += before;
        let mut depth = 0_usize;
        let end = behind.find(|c: char| {
            depth = match c {
                '[' => depth + 1,
                ']' => depth.saturating_sub(1),
                _ => depth,
            };
            c == ']' && depth == 0
        });
        rest = end.map_or("", |end| &behind[end + 1..]);
    }
    found + rest
}

/// Returns the items of `code` that do more than refer to other files.
fn work(code: &str) -> Vec<String> {
    let listed = |item: &&str| {
        let is_shown = item.starts_with("pub");
        let item = item.strip_prefix("pub").unwrap_or(item);
        let item =
            item.strip_prefix('(').and_then(|scope| scope.split_once(')')).map_or(item, |(_, rest)| rest);
        let item = item.trim_start();
        item.starts_with("use ") && is_shown || item.starts_with("mod ") && !item.contains('{')
    };
    let code = without_attributes(code);
    let items = code.split(';').map(str::trim).filter(|item| !item.is_empty());
    items.filter(|item| !listed(item)).map(str::to_owned).collect()
}

#[test]
fn a_mod_rs_lists_what_is_in_its_folder_and_holds_no_work() {
    let folders = members().into_iter().map(|member| root().join("crates").join(member).join("src"));
    let all = folders.chain([root().join("src")]).flat_map(|folder| Source::all(&folder));
    let pages: Vec<Source> = all.filter(|source| source.path.ends_with("mod.rs")).collect();
    assert!(pages.len() > 25, "{} pages", pages.len());
    for Source { path, code, tests, .. } in pages {
        let page = text(&path);
        assert!(page.starts_with("//! "), "{} does not say what its folder is for", path.display());
        assert_eq!(work(&(code + &tests)), [""; 0], "{}: it stands in a file of its own", path.display());
    }
}

#[test]
fn work_is_told_from_a_list() {
    let list = "#![allow(a, reason = \"[b]\")]\n#[cfg(test)]\nmod c;\npub(in crate::d) mod e;\npub use c::{F, G};\npub(super) use e::h;\n";
    assert_eq!(work(list), [""; 0]);
    for item in [
        "fn a() {}",
        "pub struct B;",
        "const C: u32 = 1;",
        "mod d {\n    fn e() {}\n}",
        "impl F for G {}",
        "use i::J;",
    ] {
        assert_eq!(work(&format!("{list}{item}\n")).len(), 1, "{item}");
    }
}
