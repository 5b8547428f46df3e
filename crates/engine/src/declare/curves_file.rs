//! Drawn functions, curves and surfaces in a file next to the script: `vase.curves.json` for `vase.lua`.
//!
//! ```json
//! {
//!   "profile": [
//!     [0, 0.4],
//!     [0.5, 1],
//!     [1, 0.3]
//!   ]
//! }
//! ```
//!
//! A member is named after a parameter, whose default it replaces. Input: the path of a script. Output: its
//! [`CurvesFile`], with the location of each point for messages.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::json_text::{JsonText, PlacedPoints};
use super::param::{Control, Param, Setting};
use burgeon_base::error::{Error, Limit, Result, SourcePlace, did_you_mean, nearest};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::PointRows;

/// Maximum size (bytes) of a file of drawn curves.
const LARGEST: u64 = 16_000_000;

/// Drawn functions, curves and surfaces of a script, in the order of their file.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvesFile {
    path: PathBuf,
    curves: Vec<DrawnCurve>,
}

/// Drawn value of a parameter.
#[derive(Debug, Clone, PartialEq)]
struct DrawnCurve {
    name: String,
    points: PointRows,
    /// Location of the value; `None` if it is not from a file.
    place: Option<SourcePlace>,
    /// Location of each point; empty if the value is not from a file.
    places: Vec<SourcePlace>,
}

impl CurvesFile {
    /// Returns the path of the file of drawn curves of `script`.
    pub fn path_of(script: &Path) -> PathBuf {
        script.with_extension("curves.json")
    }

    /// Reads the drawn curves of `script`; empty if there is no file. Fails with the line if the file is invalid.
    pub fn read(script: &Path) -> Result<Self> {
        Self::read_file(Self::path_of(script))
    }

    /// Reads the drawn curves in the file `path`; empty if there is no file. Fails with the line if the file is invalid.
    pub(super) fn read_file(path: PathBuf) -> Result<Self> {
        let cannot = |why: &dyn std::fmt::Display| {
            Error::file(&path, format!("cannot read the drawn curves in {}: {why}", path.display()))
                .help("drawn curves are in a JSON file; move this file away if it contains something else")
        };
        // Messages show lines of the file, and the target of a link may belong to another user.
        if path.is_symlink() {
            return Err(cannot(&"it is a link"));
        }
        let bytes = match burgeon_base::files::read(&path, LARGEST) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return Ok(Self { path, curves: Vec::new() });
            }
            Err(error) if error.kind() == ErrorKind::FileTooLarge => {
                let message = format!("{} is too large for drawn curves", path.display());
                return Err(Error::limit(Limit::Size, message)
                    .help(format!("the file can have at most {LARGEST} bytes; move it away")));
            }
            Err(error) => return Err(cannot(&error)),
        };
        let text = String::from_utf8(bytes).map_err(|_| cannot(&"it is not UTF-8"))?;
        let curves = parse(&JsonText::new(path.display().to_string(), &text))?;
        Ok(Self { path, curves })
    }

    /// Returns the path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the names and the points, in the order of the file.
    pub fn curves(&self) -> impl ExactSizeIterator<Item = (&str, &PointRows)> {
        self.curves.iter().map(|curve| (curve.name.as_str(), &curve.points))
    }

    /// Returns the points of the parameter `name`.
    pub fn get(&self, name: &str) -> Option<&PointRows> {
        self.find(name).map(|curve| &curve.points)
    }

    /// Sets the points of the parameter `name`, or removes them. The file itself does not change.
    pub fn set(&mut self, name: &str, points: Option<PointRows>) {
        let known = self.curves.iter().position(|curve| curve.name == name);
        match (known, points) {
            (Some(index), Some(points)) => self.curves[index].points = points,
            (Some(index), None) => {
                self.curves.remove(index);
            }
            (None, Some(points)) => self.curves.push(DrawnCurve {
                name: name.to_owned(),
                points,
                place: None,
                places: Vec::new(),
            }),
            (None, None) => {}
        }
    }

    /// Returns true if `other` has the same names and points, regardless of locations.
    pub fn is_like(&self, other: &Self) -> bool {
        self.curves().eq(other.curves())
    }

    /// Returns the value that the file has for `param`, if any. Fails with the line if the parameter does not allow it.
    pub(crate) fn setting(&self, param: &Param) -> Result<Option<Setting>> {
        let (Some(curve), Control::Points(control)) = (self.find(&param.name), &param.control) else {
            return Ok(None);
        };
        match control.check(&curve.points) {
            Ok(_) => Ok(Some(Setting::Points(curve.points.clone()))),
            Err(problem) => {
                let place = problem.point.and_then(|point| curve.places.get(point)).or(curve.place.as_ref());
                Err(problem.error.about(&format!("param {}", param.name)).at_place(place))
            }
        }
    }

    /// Returns a warning for each value that none of `params` uses.
    pub(crate) fn unused(&self, script: &Path, params: &[Param]) -> Vec<Warning> {
        let is_drawn = |param: &&Param| matches!(param.control, Control::Points(_));
        let mut warnings = Vec::new();
        for curve in &self.curves {
            let (name, script) = (&curve.name, script.display());
            let param = params.iter().find(|param| param.name == *name);
            if param.as_ref().is_some_and(is_drawn) {
                continue;
            }
            let (message, help) = match param {
                Some(_) => (
                    format!("the parameter `{name}` of {script} is not drawn, so its points are unused"),
                    format!(
                        "remove {name} from the file; only parameters that are functions or curves are drawn"
                    ),
                ),
                None => {
                    let names = params.iter().filter(is_drawn).map(|param| param.name.as_str());
                    let message = format!("{script} has no parameter `{name}`, so its points are unused");
                    let help = match nearest(name, names) {
                        Some(near) => did_you_mean(near),
                        None => format!(
                            "remove {name} from the file, or declare param(\"{name}\", {{ default = ramp(...) }})"
                        ),
                    };
                    (message, help)
                }
            };
            let warning =
                Warning::new(WarningKind::NoEffect, message).at_place(curve.place.as_ref()).help(help);
            warnings.push(warning);
        }
        warnings
    }

    fn find(&self, name: &str) -> Option<&DrawnCurve> {
        self.curves.iter().find(|curve| curve.name == name)
    }
}

fn parse(text: &JsonText<'_>) -> Result<Vec<DrawnCurve>> {
    let form = "{ \"taper\": [[0, 1], [1, 0.2]] }";
    let mut curves = Vec::new();
    for (name, raw) in text.members(text.value()?, "the file", form)? {
        let PlacedPoints { points, places } = text.points(raw, &name)?;
        curves.push(DrawnCurve { name, points, place: Some(text.place(raw)), places });
    }
    Ok(curves)
}
