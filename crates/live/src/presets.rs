//! Presets in a file next to the script: `tower.presets.json` for `tower.lua`.
//!
//! ```json
//! {
//!   "tall": {
//!     "seed": 7,
//!     "params": {
//!       "floors": 60,
//!       "twist": 2
//!     }
//!   },
//!   "dark": {
//!     "extends": "tall",
//!     "params": { "lit": false }
//!   }
//! }
//! ```
//!
//! A preset that extends another one has its seed and its values, except those of its own.
//!
//! Input: the path of a script, or a [`Preset`] to save. Output: its [`Presets`], and their file. A file in another
//! format is rejected and never overwritten.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::value::RawValue;
use serde_json::{Map, Number, Value};

use super::json_file::write_json;
use crate::watch::settled;
use burgeon_base::error::{Error, Limit, Result, SourcePlace};
use burgeon_base::names::{has_bidi_controls, normal_form};
use burgeon_engine::script::{JsonText, Preset, Setting, json_excerpt};

/// Maximum size (bytes) of a presets file.
const LARGEST: u64 = 16_000_000;

/// Maximum number of characters of a preset's name.
const LONGEST: usize = 80;

/// Maximum number of presets that extend one another.
const DEEPEST: usize = 16;

/// Presets of a script, in the order of their file.
#[derive(Debug, Clone, PartialEq)]
pub struct Presets {
    path: PathBuf,
    presets: Vec<Preset>,
}

impl Presets {
    /// Returns the path of the presets file of `script`.
    pub fn path_of(script: &Path) -> PathBuf {
        script.with_extension("presets.json")
    }

    /// Reads the presets of `script`; empty if there is no file. Fails with the line if the file is invalid.
    pub fn read(script: &Path) -> Result<Self> {
        Self::read_file(&Self::path_of(script))
    }

    /// Reads the presets in the file at `path`; empty if there is no file. Fails as [`read`](Self::read) does.
    pub fn read_file(path: &Path) -> Result<Self> {
        settled(path, || Self::read_once(path))
    }

    fn read_once(path: &Path) -> Result<Self> {
        let path = path.to_path_buf();
        let cannot = |why: &dyn std::fmt::Display| {
            Error::file(&path, format!("cannot read the presets in {}: {why}", path.display()))
                .help("presets are in a JSON file; move this file away if it contains something else")
        };
        // Messages show lines of the file, and the target of a link may belong to another user.
        if path.is_symlink() {
            return Err(cannot(&"it is a link"));
        }
        let bytes = match burgeon_base::files::read(&path, LARGEST) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                return Ok(Self { path, presets: Vec::new() });
            }
            Err(error) if error.kind() == std::io::ErrorKind::FileTooLarge => {
                return Err(Error::limit(
                    Limit::Size,
                    format!("{} is too large for presets", path.display()),
                )
                .help(format!("a presets file can have at most {LARGEST} bytes; move this file away")));
            }
            Err(error) => return Err(cannot(&error)),
        };
        let text = String::from_utf8(bytes).map_err(|_| cannot(&"stream did not contain valid UTF-8"))?;
        let presets = parse(&JsonText::new(path.display().to_string(), &text))?;
        Ok(Self { path, presets })
    }

    /// Saves `preset` for `script`, replacing one with the same name, and returns all presets.
    ///
    /// The file is written completely or not at all. Fails as [`read`](Self::read) does, if the name is invalid, or if
    /// the file cannot be written.
    ///
    /// ```
    /// use burgeon_engine::script::{Preset, Setting};
    /// use burgeon_live::presets::Presets;
    ///
    /// # let folder = std::env::temp_dir().join(format!("burgeon-presets-{}", std::process::id()));
    /// # std::fs::create_dir_all(&folder)?;
    /// let script = folder.join("tower.lua");
    /// let params = vec![("floors".to_owned(), Setting::Number(60.0))];
    /// Presets::save(&script, Preset { name: "tall".into(), seed: Some(7), params, ..Preset::default() })?;
    /// assert!(folder.join("tower.presets.json").exists());
    /// assert_eq!(Presets::read(&script)?.get("tall")?.seed, Some(7));
    /// assert!(Presets::read(&script)?.get("small").is_err());
    /// # std::fs::remove_dir_all(&folder)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn save(script: &Path, preset: Preset) -> Result<Self> {
        check_name(&preset.name)?;
        let mut presets = Self::read(script)?;
        let preset = Preset { name: normal_form(&preset.name).into_owned(), ..preset };
        match presets.presets.iter_mut().find(|known| is_same(&known.name, &preset.name)) {
            Some(known) => *known = preset,
            None => presets.presets.push(preset),
        }
        presets.write()?;
        Ok(presets)
    }

    /// Removes the preset called `name` of `script` and returns the others. The file is deleted together with its last
    /// preset.
    ///
    /// Fails as [`save`](Self::save) does, if there is no such preset, and if another one extends it.
    pub fn remove(script: &Path, name: &str) -> Result<Self> {
        let mut presets = Self::read(script)?;
        presets.get(name)?;
        let extends = |preset: &&Preset| preset.extends.as_ref().is_some_and(|base| is_same(base, name));
        if let Some(other) = presets.presets.iter().find(extends) {
            return Err(Error::argument(format!("preset {} extends {name}, which stays", other.name))
                .help(format!("remove {} first, or write its values into it", other.name)));
        }
        presets.presets.retain(|known| !is_same(&known.name, name));
        presets.write()?;
        Ok(presets)
    }

    /// Returns the preset called `name`, with the values of those that it extends. Fails if it does not exist; the error lists
    /// the names.
    pub fn get(&self, name: &str) -> Result<Preset> {
        let find = |name: &str| self.presets.iter().find(|preset| is_same(&preset.name, name));
        let mut own = find(name).cloned().ok_or_else(|| self.unknown_preset(name))?;
        let mut next = own.extends.take();
        // The file was checked when it was read.
        for _ in 0..DEEPEST {
            let Some(base) = next.and_then(|name| find(&name)) else { break };
            own = own.over(base);
            next = base.extends.clone();
        }
        Ok(own)
    }

    fn unknown_preset(&self, name: &str) -> Error {
        let file = self.path.display();
        if self.presets.is_empty() {
            let message = format!("unknown preset `{name}`: the script has no presets");
            return Error::not_found("preset", name, [], message)
                .help(format!("write presets into {file}, or save one: burgeon run --save-preset NAME"));
        }
        let names: Vec<&str> = self.names().collect();
        let message = format!("unknown preset `{name}` in {file}");
        Error::not_found("preset", name, names.iter().copied(), message)
            .help(format!("it has {}", names.join(", ")))
    }

    /// Returns the names of the presets, in the order of the file.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.presets.iter().map(|preset| preset.name.as_str())
    }

    fn write(&self) -> Result<()> {
        if self.presets.is_empty() {
            let path = self.path.display();
            return std::fs::remove_file(&self.path)
                .map_err(|error| Error::file(&self.path, format!("cannot remove {path}: {error}")));
        }
        let presets = self.presets.iter().map(|preset| {
            let mut object = Map::new();
            if let Some(base) = &preset.extends {
                object.insert("extends".into(), base.as_str().into());
            }
            if let Some(seed) = preset.seed {
                object.insert("seed".into(), seed.into());
            }
            let params = preset.params.iter().map(|(name, setting)| (name.as_str(), value(setting)));
            object.insert("params".into(), params.collect());
            (preset.name.as_str(), object)
        });
        write_json(&self.path, &presets.collect())
    }
}

/// Returns true if two names are equal after Unicode normalisation.
fn is_same(one: &str, other: &str) -> bool {
    normal_form(one) == normal_form(other)
}

/// Converts a setting to JSON; integers have no decimal point.
fn value(setting: &Setting) -> Value {
    match setting {
        #[allow(clippy::cast_possible_truncation, reason = "whole and small enough to be exact")]
        Setting::Number(number) if number.fract() == 0.0 && number.abs() < 9e15 => (*number as i64).into(),
        Setting::Number(number) => Number::from_f64(*number).map_or(Value::Null, Value::Number),
        Setting::Boolean(_) | Setting::Text(_) | Setting::Points(_) => setting.to_json(),
    }
}

/// Fails unless a name has 1 to 80 characters, no spaces at its ends, and no control or bidirectional control
/// characters.
///
/// ```
/// use burgeon_live::presets::check_name;
///
/// assert!(check_name("tall & thin").is_ok());
/// assert!(check_name("").is_err() && check_name(" tall").is_err() && check_name("two\nlines").is_err());
/// ```
pub fn check_name(name: &str) -> Result<()> {
    let fits = name.trim() == name && !name.is_empty() && name.chars().count() <= LONGEST;
    if fits && !name.chars().any(char::is_control) && !has_bidi_controls(name) {
        return Ok(());
    }
    Err(Error::argument(format!("{name:?} cannot be the name of a preset")).help(format!(
        "use 1 to {LONGEST} characters, without line breaks, bidirectional controls, and spaces at the beginning or the end"
    )))
}

/// Parses the presets of a file.
fn parse(text: &JsonText<'_>) -> Result<Vec<Preset>> {
    let (mut presets, mut bases) = (Vec::new(), Vec::new());
    for (name, raw) in
        text.members(text.value()?, "the file", "{ \"name\": { \"seed\": 0, \"params\": {} } }")?
    {
        let what = format!("preset {name}");
        let mut preset = Preset { name, place: Some(text.place(raw)), ..Preset::default() };
        for (key, raw) in text.members(raw, &what, "{ \"seed\": 0, \"params\": {} }")? {
            match key.as_str() {
                "seed" => {
                    let seed = serde_json::from_str(raw.get()).map_err(|_| {
                        Error::data(format!("{what}: invalid seed {}", json_excerpt(raw)))
                            .help("write an integer of at least 0")
                            .at(Some(text.place(raw)))
                    })?;
                    preset.seed = Some(seed);
                }
                "extends" => {
                    let base: String = serde_json::from_str(raw.get()).map_err(|_| {
                        Error::data(format!("{what}: invalid name {} in extends", json_excerpt(raw)))
                            .help("write the name of another preset of the file")
                            .at(Some(text.place(raw)))
                    })?;
                    bases.push((presets.len(), text.place(raw)));
                    preset.extends = Some(base);
                }
                "params" => {
                    for (name, raw) in text.members(raw, &format!("{what}: params"), "{ \"height\": 3 }")? {
                        let setting = read_setting(text, raw, &what, &name)?;
                        preset.params.push((name, setting));
                        preset.places.push(text.place(raw));
                    }
                }
                _ => {
                    let message = format!("unknown field `{key}` in {what}");
                    return Err(Error::not_found("field", &key, ["extends", "seed", "params"], message)
                        .help("a preset has a seed, params, and another one that it extends; put parameters into params")
                        .at(Some(text.place(raw))));
                }
            }
        }
        presets.push(preset);
    }
    check_bases(&presets, bases)?;
    Ok(presets)
}

/// Fails if a preset extends one that does not exist, itself, or too many. `bases` are the numbers of those that extend another one,
/// with the place of its name.
fn check_bases(presets: &[Preset], bases: Vec<(usize, SourcePlace)>) -> Result<()> {
    let names = presets.iter().enumerate().map(|(index, preset)| (normal_form(&preset.name), index));
    let known: BTreeMap<_, usize> = names.collect();
    for (index, place) in bases {
        let (name, mut at) = (&presets[index].name, index);
        for step in 0.. {
            let Some(base) = &presets[at].extends else { break };
            let Some(next) = known.get(&normal_form(base)) else {
                let message = format!("preset {} extends the unknown preset `{base}`", presets[at].name);
                let names = presets.iter().map(|preset| preset.name.as_str());
                return Err(Error::not_found("preset", base, names, message)
                    .help("write the name of another preset of the file")
                    .at(Some(place)));
            };
            if *next == index || step >= DEEPEST {
                let cause = if *next == index {
                    "extends itself".into()
                } else {
                    format!("extends more than {DEEPEST} others")
                };
                return Err(Error::data(format!("preset {name} {cause}, by way of {base}"))
                    .help("remove extends from one of them")
                    .at(Some(place)));
            }
            at = *next;
        }
    }
    Ok(())
}

/// Returns the value in `raw` of the parameter `name`; lists are the points of a drawn function, curve or surface.
fn read_setting<'a>(text: &JsonText<'a>, raw: &'a RawValue, what: &str, name: &str) -> Result<Setting> {
    let read = match serde_json::from_str(raw.get()) {
        Ok(Value::Number(number)) => number.as_f64().filter(|number| number.is_finite()).map(Setting::Number),
        Ok(Value::Bool(value)) => Some(Setting::Boolean(value)),
        Ok(Value::String(text)) => Some(Setting::Text(text)),
        Ok(Value::Array(_)) => {
            return Ok(Setting::Points(text.points(raw, &format!("{what}: {name}"))?.points));
        }
        _ => None,
    };
    read.ok_or_else(|| {
        Error::data(format!("{what}: invalid value {} for {name}", json_excerpt(raw)))
            .help("write a number, true, false, a string or a list of points")
            .at(Some(text.place(raw)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_engine::script::PointRows;

    fn preset(name: &str, twist: f64) -> Preset {
        let params = vec![
            ("twist".to_owned(), Setting::Number(twist)),
            ("lit".to_owned(), Setting::Boolean(true)),
            ("kind".to_owned(), Setting::Text("a \"b\"".to_owned())),
            ("taper".to_owned(), Setting::Points(PointRows(vec![vec![0.0, 1.0], vec![1.0, 0.25]]))),
        ];
        Preset { name: name.to_owned(), seed: Some(u64::MAX), params, ..Preset::default() }
    }

    fn refused(text: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("tower.lua");
        std::fs::write(Presets::path_of(&script), text).unwrap();
        let error = Presets::read(&script).unwrap_err();
        assert!(error.place().is_some(), "{error}");
        Presets::save(&script, preset("tall", 1.0)).unwrap_err();
        assert_eq!(std::fs::read_to_string(Presets::path_of(&script)).unwrap(), text);
        error.to_string().replace(&folder.path().display().to_string(), "FOLDER")
    }

    #[test]
    fn what_is_saved_reads_back_and_the_others_stay() {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("tower.lua");
        assert_eq!(Presets::read(&script).unwrap().names().count(), 0);
        for (name, twist) in [("tall", 2.5), ("flat", 3.0), ("tall", -4.0)] {
            Presets::save(&script, preset(name, twist)).unwrap();
        }
        let presets = Presets::read(&script).unwrap();
        assert_eq!(presets.names().collect::<Vec<_>>(), ["tall", "flat"]);
        let tall = presets.get("tall").unwrap();
        assert_eq!((&tall.params, tall.seed), (&preset("tall", -4.0).params, Some(u64::MAX)));
        assert_eq!(tall.places.iter().map(|place| place.line).collect::<Vec<_>>(), [5, 6, 7, 8]);
        insta::assert_snapshot!(std::fs::read_to_string(Presets::path_of(&script)).unwrap(), @r#"
        {
          "tall": {
            "seed": 18446744073709551615,
            "params": {
              "twist": -4,
              "lit": true,
              "kind": "a \"b\"",
              "taper": [
                [0, 1],
                [1, 0.25]
              ]
            }
          },
          "flat": {
            "seed": 18446744073709551615,
            "params": {
              "twist": 3,
              "lit": true,
              "kind": "a \"b\"",
              "taper": [
                [0, 1],
                [1, 0.25]
              ]
            }
          }
        }
        "#);
        Presets::remove(&script, "tall").unwrap();
        assert_eq!(Presets::read(&script).unwrap().names().collect::<Vec<_>>(), ["flat"]);
        assert!(Presets::remove(&script, "tall").is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        Presets::remove(&script, "flat").unwrap();
        assert_eq!(Presets::read(&script).unwrap().names().count(), 0);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_file_of_another_form_is_refused_with_its_line_and_kept() {
        insta::assert_snapshot!(refused("{\n  \"tall\": {\n    \"seed\": 7,,\n"), @r"
        FOLDER/tower.presets.json:3: this is not JSON: key must be a string
          help: fix the file, or move it away
        ");
        insta::assert_snapshot!(refused(""), @r"
        FOLDER/tower.presets.json:1: this is not JSON: EOF while parsing a value
          help: fix the file, or move it away
        ");
        insta::assert_snapshot!(refused("[1, 2]"), @r#"
        FOLDER/tower.presets.json:1: the file is [1, 2], not an object
          help: write { "name": { "seed": 0, "params": {} } }
        "#);
        insta::assert_snapshot!(refused("{ \"tall\": 3 }"), @r#"
        FOLDER/tower.presets.json:1: preset tall is 3, not an object
          help: write { "seed": 0, "params": {} }
        "#);
        insta::assert_snapshot!(refused("{ \"tall\": {\n\"sed\": 3 } }"), @r"
        FOLDER/tower.presets.json:2: unknown field `sed` in preset tall
          help: did you mean seed?
        ");
        insta::assert_snapshot!(refused("{ \"tall\": {\n\"floors\": 3 } }"), @r"
        FOLDER/tower.presets.json:2: unknown field `floors` in preset tall
          help: a preset has a seed, params, and another one that it extends; put parameters into params
        ");
        insta::assert_snapshot!(refused("{ \"tall\": { \"seed\": -1 } }"), @r"
        FOLDER/tower.presets.json:1: preset tall: invalid seed -1
          help: write an integer of at least 0
        ");
        insta::assert_snapshot!(refused("{ \"tall\": { \"seed\": 1e400 } }"), @r"
        FOLDER/tower.presets.json:1: preset tall: invalid seed 1e400
          help: write an integer of at least 0
        ");
        insta::assert_snapshot!(refused("{ \"tall\": { \"params\": {\n\n\"a\": [[0, 1],\n1] } } }"), @r"
        FOLDER/tower.presets.json:4: preset tall: a: point 2 is 1, not a list of numbers
          help: write a list of points: [[0, 1], [1, 0.2]]
        ");
        insta::assert_snapshot!(refused("{ \"tall\": { \"params\": {\n\n\"a\": null } } }"), @r"
        FOLDER/tower.presets.json:3: preset tall: invalid value null for a
          help: write a number, true, false, a string or a list of points
        ");
        insta::assert_snapshot!(refused("{ \"tall\": { \"params\": { \"a\": 1e999 } } }"), @r"
        FOLDER/tower.presets.json:1: preset tall: invalid value 1e999 for a
          help: write a number, true, false, a string or a list of points
        ");
        insta::assert_snapshot!(refused("{ \"tall\": {},\n\"tall\": {} }"), @r"
        FOLDER/tower.presets.json:2: the file has two members named `tall`
          help: remove or rename one of them
        ");
    }

    #[test]
    fn a_preset_that_extends_others_has_their_values_and_the_nearest_ones_win() {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("t.lua");
        let file = r#"{ "dark": { "extends": "tall", "params": { "lit": false } },
            "tall": { "extends": "base", "seed": 7, "params": { "floors": 60 } },
            "base": { "seed": 1, "params": { "floors": 3, "lit": true, "twist": 2 } } }"#;
        std::fs::write(Presets::path_of(&script), file).unwrap();
        let dark = Presets::read(&script).unwrap().get("dark").unwrap();
        let number = |name: &str, value: f64| (name.to_owned(), Setting::Number(value));
        let lit = ("lit".to_owned(), Setting::Boolean(false));
        assert_eq!(
            (dark.params, dark.seed),
            (vec![lit, number("floors", 60.0), number("twist", 2.0)], Some(7))
        );
        let lines: Vec<usize> = dark.places.iter().map(|place| place.line).collect();
        assert_eq!(lines, [1, 2, 3]);
        // The file keeps what extends what.
        Presets::save(&script, preset("new", 1.0)).unwrap();
        let written = std::fs::read_to_string(Presets::path_of(&script)).unwrap();
        assert_eq!(written.matches("\"extends\"").count(), 2);
        let kept = Presets::remove(&script, "tall").unwrap_err().to_string();
        assert!(kept.contains("preset dark extends tall, which stays"), "{kept}");
        Presets::remove(&script, "dark").unwrap();
        Presets::remove(&script, "tall").unwrap();
    }

    #[test]
    fn a_preset_that_extends_itself_or_nothing_is_refused() {
        insta::assert_snapshot!(refused("{ \"a\": {\n\"extends\": \"b\" }, \"c\": {} }"), @"");
        insta::assert_snapshot!(refused("{ \"a\": { \"extends\": \"b\" },\n\"b\": { \"extends\": \"a\" } }"), @"");
        insta::assert_snapshot!(refused("{ \"a\": { \"extends\": 3 } }"), @"");
        let chain: Vec<String> =
            (0..40).map(|number| format!("\"p{number}\": {{ \"extends\": \"p{}\" }}", number + 1)).collect();
        let long = refused(&format!("{{ {}, \"p40\": {{}} }}", chain.join(",\n")));
        assert!(long.contains("preset p0 extends more than 16 others"), "{long}");
    }

    #[test]
    fn names_that_look_the_same_are_one() {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("t.lua");
        Presets::save(&script, preset("e\u{301}te\u{301}", 1.0)).unwrap();
        let presets = Presets::save(&script, preset("\u{e9}t\u{e9}", 2.0)).unwrap();
        assert_eq!(presets.names().collect::<Vec<_>>(), ["\u{e9}t\u{e9}"]);
        assert_eq!(presets.get("e\u{301}te\u{301}").unwrap().params[0].1, Setting::Number(2.0));
        assert!(refused("{ \"\u{e9}\": {},\n\"e\u{301}\": {} }").contains("two members named"));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_not_read_and_nothing_of_its_target_is_shown() {
        let folder = tempfile::tempdir().unwrap();
        let (script, secret) = (folder.path().join("t.lua"), folder.path().join("secret"));
        std::fs::write(&secret, "password = hunter2\n").unwrap();
        std::os::unix::fs::symlink(&secret, Presets::path_of(&script)).unwrap();
        for error in [
            Presets::read(&script).unwrap_err(),
            Presets::save(&script, preset("a", 1.0)).unwrap_err(),
            Presets::remove(&script, "a").unwrap_err(),
        ] {
            let text = format!("{error} {:?}", error.place());
            assert!(text.contains("it is a link") && !text.contains("hunter2"), "{text}");
            assert!(error.place().is_none(), "{text}");
        }
        assert_eq!(std::fs::read_to_string(&secret).unwrap(), "password = hunter2\n");
    }

    #[test]
    fn a_name_that_is_hard_to_write_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["", " ", "a ", "a\nb", "\u{7}", "a\u{202e}b", "\u{2067}a", &"x".repeat(81)] {
            assert!(Presets::save(&folder.path().join("t.lua"), preset(name, 1.0)).is_err(), "{name:?}");
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
