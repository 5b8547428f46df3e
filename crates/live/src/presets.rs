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
