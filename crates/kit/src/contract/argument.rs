//! Arguments of functions that scripts call, with the units and defaults that their docs state.

use super::kind::SharedText;
use crate::Field;

/// Units that docs give in round brackets.
const UNITS: [&str; 10] = ["m", "m²", "m³", "1/m", "m/m", "%", "degrees", "s", "bytes", "light years"];

/// An argument of a method.
#[derive(Debug, Clone)]
pub struct Argument {
    /// Name of the argument.
    pub name: SharedText,
    /// Luau type.
    pub luau: String,
    /// Unit, such as "m", if the argument has one.
    pub unit: Option<SharedText>,
    /// Fields of the argument, if it is a table of named fields.
    pub fields: Vec<Field>,
    /// Default as written in a script: `nil` if an omitted argument has no other value, empty if the argument is
    /// required.
    pub default: String,
}

impl Argument {
    /// Creates an argument of any type.
    pub fn new(name: impl Into<SharedText>) -> Self {
        Self::typed(name, "any")
    }

    /// Creates an argument of type `luau`; a type that ends with `?` makes it optional.
    pub fn typed(name: impl Into<SharedText>, luau: impl Into<String>) -> Self {
        let luau = luau.into();
        let default = if luau.ends_with('?') { "nil" } else { "" }.to_owned();
        Self { name: name.into(), luau, unit: None, fields: Vec::new(), default }
    }

    /// Adds the unit and the default that the function's `doc` gives in round brackets directly after the argument's
    /// name, such as `margin` (m, 5 unless given).
    ///
    /// ```
    /// use burgeon_kit::Argument;
    ///
    /// let doc = "Adds a fence at the distance `margin` (m, 5 unless given).";
    /// let margin = Argument::typed("margin", "number?").described(doc);
    /// assert_eq!((margin.unit.as_deref(), &*margin.default), (Some("m"), "5"));
    /// ```
    #[must_use]
    pub fn described(mut self, doc: &str) -> Self {
        let doc = doc.split_whitespace().collect::<Vec<_>>().join(" ");
        let name = format!("`{}` ", self.name);
        let told = || doc.match_indices(&name).filter_map(|(at, name)| bracketed(&doc[at + name.len()..]));
        self.unit = told().find_map(unit_in).map(SharedText::from);
        if let Some(default) =
            told().flat_map(|told| told.split(", ")).find_map(|part| part.strip_suffix(" unless given"))
        {
            self.default = default.replace('`', "");
        }
        self
    }
}

/// Returns the first unit that a doc gives in round brackets: `m` for "Its height (m)." and for "Its height (m, 5
/// unless given)."
///
/// ```
/// use burgeon_kit::declare::unit;
///
/// assert_eq!(unit("Area (m²) without the holes."), Some("m²"));
/// assert_eq!(unit("Roughness (0 to 1)."), None);
/// ```
pub fn unit(doc: &str) -> Option<&'static str> {
    doc.match_indices('(').find_map(|(at, _)| bracketed(&doc[at..]).and_then(unit_in))
}

/// Returns the content of the round brackets that `text` begins with.
fn bracketed(text: &str) -> Option<&str> {
    Some(text.strip_prefix('(')?.split_once(')')?.0)
}

/// Returns the unit at the start of the content of a bracket.
fn unit_in(told: &str) -> Option<&'static str> {
    let first = told.split(',').next()?.split(" from ").next()?;
    UNITS.into_iter().find(|unit| *unit == first)
}

#[cfg(test)]
mod tests {
    use std::borrow::Cow;

    use super::*;

    #[test]
    fn a_unit_stands_in_round_brackets() {
        for (doc, expected) in [
            ("Its height (m).", Some("m")),
            ("Its area (m²) without the holes.", Some("m²")),
            ("Height (m): preferred, or { least, greatest }.", Some("m")),
            ("How far it reaches (m, 5 unless given).", Some("m")),
            ("Where it stands (m from the star).", Some("m")),
            ("As `footprint(geometry)` takes it, how far it turns (degrees).", Some("degrees")),
            ("How rough it is (0 to 1).", None),
            ("Turns by more than a little (8 degrees).", None),
            ("It has m and (no end", None),
        ] {
            assert_eq!(unit(doc), expected, "{doc}");
        }
    }

    #[test]
    fn an_arguments_unit_and_its_default_follow_its_name() {
        let doc = "Raises it by `height` (m) within `time` (s, `tower.time` unless given), turned by `angle`, `often` \
                   (3 unless given), all in all (bytes).";
        let told = |name: &'static str, luau: &str| {
            let argument = Argument::typed(name, luau).described(doc);
            (argument.unit.map(Cow::into_owned), argument.default)
        };
        assert_eq!(told("height", "number"), (Some("m".to_owned()), String::new()));
        assert_eq!(told("time", "number?"), (Some("s".to_owned()), "tower.time".to_owned()));
        assert_eq!(told("often", "number?"), (None, "3".to_owned()));
        assert_eq!(told("angle", "number?"), (None, "nil".to_owned()));
    }
}
