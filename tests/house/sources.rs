//! Reads the sources of a crate: code without comments and tests, and the paths in it.

use std::fs;
use std::path::{Path, PathBuf};

/// Rust source file.
pub(crate) struct Source {
    /// Path relative to the root of the tree.
    pub(crate) path: PathBuf,
    /// Path of its module from the root of the crate; empty for the root itself.
    pub(crate) module: Vec<String>,
    /// Code without comments and tests; in a test file, code without comments.
    pub(crate) code: String,
    /// Code of the tests, without comments.
    pub(crate) tests: String,
    /// Comments, whose examples are tests too.
    pub(crate) comments: String,
}

impl Source {
    /// Returns all files under `folder`, the `src` of a crate, sorted by path.
    pub(crate) fn all(folder: &Path) -> Vec<Self> {
        let mut files = Vec::new();
        collect(folder, "rs", &mut files);
        files.sort();
        let whole: Vec<String> = files.iter().map(|file| fs::read_to_string(file).unwrap()).collect();
        let texts: Vec<String> = whole.iter().map(|text| bare(text)).collect();
        let tests: Vec<Vec<String>> = files
            .iter()
            .zip(&texts)
            .flat_map(|(file, text)| {
                let module = module(folder, file);
                test_modules(text).into_iter().map(move |name| [module.as_slice(), &[name]].concat())
            })
            .collect();
        let read = files.into_iter().zip(texts).zip(whole).map(|((path, text), whole)| {
            let module = module(folder, &path);
            let is_test = tests.iter().any(|test| module.starts_with(test));
            let end = if is_test { 0 } else { text.find("#[cfg(test)]\nmod tests {").unwrap_or(text.len()) };
            let (code, tests) = text.split_at(end);
            Self { code: code.to_owned(), tests: tests.to_owned(), comments: comments(&whole), path, module }
        });
        read.collect()
    }

    /// Returns the paths in the code, relative to the root of the crate; `crate`, `self` and `super` are
    /// resolved.
    pub(crate) fn inner_paths(&self) -> Vec<Vec<String>> {
        let mut found = Vec::new();
        for path in paths(&self.code) {
            let ups = path.iter().take_while(|name| *name == "super").count();
            let rest = match path.first().map(String::as_str) {
                Some("crate") => path[1..].to_vec(),
                Some("self") => [&self.module, &path[1..]].concat(),
                Some("super") if ups <= self.module.len() => {
                    [&self.module[..self.module.len() - ups], &path[ups..]].concat()
                }
                _ => continue,
            };
            found.push(rest);
        }
        found
    }
}

/// Collects the files under `folder` with the extension `extension`.
pub(crate) fn collect(folder: &Path, extension: &str, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, extension, files);
        } else if path.extension().is_some_and(|found| found == extension) {
            files.push(path);
        }
    }
}

/// Returns the module path of `file` from the root of the crate in `folder`.
fn module(folder: &Path, file: &Path) -> Vec<String> {
    let inner = file.strip_prefix(folder).unwrap().with_extension("");
    let mut names: Vec<String> = inner.iter().map(|name| name.to_string_lossy().into_owned()).collect();
    names.pop_if(|last| matches!(&**last, "lib" | "main" | "mod"));
    names
}

/// Returns the names of the test modules in separate files.
fn test_modules(text: &str) -> Vec<String> {
    let after = text.split("#[cfg(test)]\n").skip(1);
    let lines = after.filter_map(|rest| rest.lines().next());
    lines.filter_map(|line| Some(line.trim().strip_suffix(';')?.split_once("mod ")?.1.to_owned())).collect()
}

/// Returns `text` without whole-line comments.
fn bare(text: &str) -> String {
    let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// Returns the whole-line comments of `text`.
fn comments(text: &str) -> String {
    let lines = text.lines().filter_map(|line| line.trim_start().strip_prefix("//"));
    lines.flat_map(|line| [line.trim_start_matches(['/', '!', ' ', '#']), "\n"]).collect()
}

/// Returns the words of a text: the parts that can be in a name.
pub(crate) fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// Returns all paths of two or more names in `code`, and single names that are imported or refer to a crate.
/// Paths in a group with braces are listed separately.
pub(crate) fn paths(code: &str) -> Vec<Vec<String>> {
    let tokens = tokens(code);
    let (mut found, mut at) = (Vec::new(), 0);
    while at < tokens.len() {
        let used = at > 0 && matches!(tokens[at - 1], "use" | "crate");
        if is_name(tokens[at]) && (used || tokens.get(at + 1) == Some(&"::")) {
            path(&tokens, &mut at, &[], &mut found);
        } else {
            at += 1;
        }
    }
    found
}

/// Reads the path that begins at token `at`, after the names `before`.
fn path(tokens: &[&str], at: &mut usize, before: &[String], found: &mut Vec<Vec<String>>) {
    let mut names = before.to_vec();
    while let Some(name) = tokens.get(*at).filter(|name| is_name(name)) {
        names.push((*name).to_owned());
        *at += 1;
        if tokens.get(*at) != Some(&"::") {
            break;
        }
        *at += 1;
        if tokens.get(*at) == Some(&"{") {
            *at += 1;
            while tokens.get(*at).is_some_and(|token| *token != "}") {
                let begin = *at;
                path(tokens, at, &names, found);
                *at = (*at).max(begin + 1);
            }
            *at += 1;
            return;
        }
    }
    if names.len() > before.len() {
        found.push(names);
    }
}

/// Name that a `use` item brings into scope.
#[derive(Debug, PartialEq)]
pub(crate) struct Import {
    /// Name in the scope; `*` for all names of a module.
    pub(crate) name: String,
    /// Path of the item as written.
    pub(crate) path: Vec<String>,
    /// Set for `pub use`, whatever its visibility.
    pub(crate) is_public: bool,
}

/// Returns the names that the `use` items of `code` bring into scope.
pub(crate) fn imports(code: &str) -> Vec<Import> {
    let tokens = tokens(code);
    let mut found = Vec::new();
    for (at, _) in tokens.iter().enumerate().filter(|(_, token)| **token == "use") {
        let is_public = match at.checked_sub(1).map(|before| tokens[before]) {
            Some("pub") => true,
            Some(")") => tokens[..at].iter().rev().take(8).any(|token| *token == "pub"),
            _ => false,
        };
        import(&tokens, &mut (at + 1), &[], is_public, &mut found);
    }
    found
}

/// Reads the tree of a `use` item that begins at token `at`, after the names `before`.
fn import(tokens: &[&str], at: &mut usize, before: &[String], is_public: bool, found: &mut Vec<Import>) {
    let mut path = before.to_vec();
    loop {
        match tokens.get(*at).copied() {
            Some("{") => {
                *at += 1;
                while tokens.get(*at).is_some_and(|token| *token != "}") {
                    let before = *at;
                    if tokens[*at] != "," {
                        import(tokens, at, &path, is_public, found);
                    }
                    // Words in a string can look like an import, such as "use network { max_segments = 5 }".
                    if *at == before {
                        *at += 1;
                    }
                }
                *at += 1;
                return;
            }
            Some("*") => {
                *at += 1;
                found.push(Import { name: "*".to_owned(), path, is_public });
                return;
            }
            Some("as") => {
                let name = tokens.get(*at + 1).copied().unwrap_or_default().to_owned();
                *at += 2;
                found.push(Import { name, path, is_public });
                return;
            }
            Some("::") => *at += 1,
            Some(name) if is_name(name) => {
                path.push(name.to_owned());
                *at += 1;
            }
            _ => break,
        }
    }
    *at = (*at).max(1);
    if let Some(name) = path.last().cloned() {
        // `a::{self}` brings `a` into scope.
        let (name, path) = match (name.as_str(), path.len()) {
            ("self", 2..) => (path[path.len() - 2].clone(), path[..path.len() - 1].to_vec()),
            _ => (name, path),
        };
        found.push(Import { name, path, is_public });
    }
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Splits code into tokens: names, `::`, and all other characters except spaces.
fn tokens(code: &str) -> Vec<&str> {
    let (mut found, mut rest) = (Vec::new(), code.trim_start());
    while let Some(first) = rest.chars().next() {
        let name = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let end = if name > 0 {
            name
        } else if rest.starts_with("::") {
            2
        } else {
            first.len_utf8()
        };
        found.push(&rest[..end]);
        rest = rest[end..].trim_start();
    }
    found
}

#[test]
fn a_group_of_names_is_as_many_paths() {
    let found = paths("use crate::{a::{B, C}, d};\nlet e = super::f::<G>(h) + i;\nuse j::*;");
    let found: Vec<String> = found.iter().map(|path| path.join(" ")).collect();
    assert_eq!(found, ["crate a B", "crate a C", "crate d", "super f", "j"]);
}

#[test]
fn tests_and_comments_are_no_code() {
    let text = "//! Uses a::b.\nuse c::d;\n#[cfg(test)]\nmod far;\nfn e() {}\n#[cfg(test)]\nmod tests {\n}\n";
    assert_eq!(test_modules(&bare(text)), ["far"]);
    assert!(!bare(text).contains("a::b"));
}

#[test]
fn imports_have_their_names_in_the_scope() {
    let found = imports("pub use a::{B, c::D as E, f::*};\nuse g::h;\npub(crate) use i::{self, J};");
    let found: Vec<String> = found
        .iter()
        .map(|it| format!("{}{} = {}", if it.is_public { "pub " } else { "" }, it.name, it.path.join(" ")))
        .collect();
    assert_eq!(found, ["pub B = a B", "pub E = a c D", "pub * = a f", "h = g h", "pub i = i", "pub J = i J"]);
}
