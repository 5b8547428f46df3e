//! Existing streets, as scripts specify them for a network.

use std::borrow::Cow;
use std::sync::Arc;

use burgeon_base::error::Result;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Expectation, Field, Parameter, Table, Value, fields};
use burgeon_streets::{ExistingReport, ExistingStreet, StreetAttributes, StreetKind, StreetNetwork};
use glam::DVec3;

use super::lines::{ByLine, ExistingLine, StreetLines, is_set, number_of};

/// Maximum number of losses that a warning names; `network:omitted()` lists all losses.
const NAMED: usize = 5;
/// Maximum width of a sidewalk, as a fraction of a width that a line sets.
const SIDEWALK_PART: f64 = 0.2;

/// Streets in `network { existing = ... }`.
#[fields("a street of network { existing = ... }")]
pub struct ExistingLines {
    /// Lines (m): a source, features, geometries or lists of points.
    pub lines: StreetLines,
    /// Hierarchy level, as for streets that grow: 0 for a main street. A number, or the name of an attribute of the
    /// lines.
    pub depth: Option<ByLine>,
    /// Width (m) between the outer edges of the sidewalks: a number, or the name of an attribute such as "width". If
    /// omitted, the width of the street type.
    pub width: Option<ByLine>,
    /// Width (m) of the sidewalk on each side: a number, or the name of an attribute.
    pub sidewalk: Option<ByLine>,
    /// Number of lanes for both directions: a number, or the name of an attribute such as "lanes".
    pub lanes: Option<ByLine>,
    /// Level: 0 on the ground, 1 on a bridge, -1 in a tunnel. Streets of different levels cross without a junction. A
    /// number, or the name of an attribute; if omitted, it follows from the attributes `bridge`, `tunnel` and `layer`
    /// of OpenStreetMap.
    pub level: Option<ByLine>,
    /// Attribute of the lines that names the street in reports.
    #[default("name".into())]
    pub name: String,
    /// Set if the streets are bridges, which are on level 1 unless `level` is given.
    pub bridge: bool,
}

impl Parameter for ExistingLines {
    fn luau() -> String {
        "{ [string]: any }".into()
    }

    fn fields() -> Vec<Field> {
        Self::fields()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Table(table) => Self::from_table(&table)
                .map_err(|error| Expectation::new(format!("a street ({})", error.message()))),
            _ => Err(Expectation::new("a table of a street's fields, such as { lines = ..., depth = 1 }")),
        }
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}

/// Unusable attribute values, by attribute.
#[derive(Default)]
struct Unusable {
    /// Number of lines with an unusable value, and the name and value of the first.
    found: Vec<(&'static str, usize, String, String)>,
}

impl Unusable {
    fn add(&mut self, what: &'static str, street: &str, value: String) {
        match self.found.iter_mut().find(|(known, ..)| *known == what) {
            Some((_, count, ..)) => *count += 1,
            None => self.found.push((what, 1, street.to_owned(), value)),
        }
    }

    fn warnings(self) -> impl Iterator<Item = Warning> {
        self.found.into_iter().map(|(what, count, street, value)| {
            let lines = if count == 1 { "line has" } else { "lines have" };
            let text = format!(
                "network: existing: {count} {lines} no usable {what}, e.g. {value} of {street}: the value of the street type is used"
            );
            Warning::new(WarningKind::Data, text)
                .help(format!("correct the data, or set {what} to a number or another attribute"))
        })
    }
}

/// Adds existing streets to a network. Returns their report and the warnings.
pub(super) fn add(
    network: &mut StreetNetwork,
    existing: &[ExistingLines],
    kinds: &[StreetKind],
) -> Result<(ExistingReport, Vec<Warning>)> {
    let (mut streets, mut warnings) = (Vec::new(), Vec::new());
    let mut unusable = Unusable::default();
    for (number, lines) in (1..).zip(existing) {
        if let Some((count, first)) = &lines.lines.refused {
            let text =
                format!("network: existing: {count} items of lines of entry {number} are not lines: {first}");
            let help = "give lines: features, geometries or lists of at least two positions";
            warnings.push(Warning::new(WarningKind::Data, text).help(help));
        }
        for (index, line) in (1..).zip(&lines.lines.lines) {
            let given = line.fact(&lines.name).and_then(|name| name.text());
            let given =
                given.or_else(|| line.fact("ref")?.text()).or_else(|| Some(line.id.as_ref()?.to_string()));
            let name = given.unwrap_or_else(|| format!("line {index} of entry {number}"));
            streets.push(street(lines, line, name, kinds, &mut unusable));
        }
    }
    warnings.extend(unusable.warnings());
    if streets.is_empty() && !existing.is_empty() && warnings.is_empty() {
        let text = "network: existing contains no lines, so no street exists";
        warnings
            .push(Warning::new(WarningKind::Data, text).help("give lines: a layer of streets, not of areas"));
    }
    let report = network.add_existing(&streets)?;
    warnings.extend(losses(&report));
    Ok((report, warnings))
}

/// Creates the street of a line from the line's attributes.
fn street(
    lines: &ExistingLines,
    line: &ExistingLine,
    name: String,
    kinds: &[StreetKind],
    unusable: &mut Unusable,
) -> ExistingStreet {
    let mut number =
        |what: &'static str, by: &Option<ByLine>, is_right: &dyn Fn(f64) -> bool| -> Option<f64> {
            let by = by.as_ref()?;
            let value = match by {
                ByLine::Number(number) => {
                    return Some(*number).filter(|number| is_right(*number)).or_else(|| {
                        unusable.add(what, &name, number.to_string());
                        None
                    });
                }
                ByLine::Attribute(attribute) => line.fact(attribute)?,
            };
            let found = number_of(&value).filter(|number| is_right(*number));
            if found.is_none() {
                unusable.add(what, &name, value.display_text());
            }
            found
        };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "tested to be in range")]
    let depth = number("depth", &lines.depth, &|depth| (0.0..=1e6).contains(&depth)).unwrap_or(0.0) as u32;
    let kind = StreetKind::of(kinds, depth);
    let fits = |kind: &StreetKind| {
        kind.adapt_to(kind.attributes(depth)).width == kind.width && kind.carriageway() >= 2.0
    };
    let with_width =
        |width: f64| StreetKind { width, sidewalk: kind.sidewalk.min(width * SIDEWALK_PART), ..kind };
    let width =
        number("width", &lines.width, &|width| (2.0..=200.0).contains(&width) && fits(&with_width(width)));
    let mut of_line = width.map_or(kind, with_width);
    let walk = number("sidewalk", &lines.sidewalk, &|walk| walk >= 0.0 && of_line.width - 2.0 * walk >= 2.0);
    of_line.sidewalk = walk.unwrap_or(of_line.sidewalk);
    if of_line.median > 0.0 && of_line.carriageway() < of_line.median + 4.0 {
        of_line.median = 0.0;
    }
    let room = of_line.carriageway() - of_line.median;
    let lanes =
        number("lanes", &lines.lanes, &|lanes| (1.0..=24.0).contains(&lanes) && lanes.floor() * 2.0 <= room);
    let usual = if lines.bridge { 1 } else { 0 };
    #[allow(clippy::cast_possible_truncation, reason = "tested to be in range")]
    let level = match &lines.level {
        None => level_of(line, lines.bridge),
        by => number("level", by, &|level| (-100.0..=100.0).contains(&level))
            .map_or(usual, |level| level as i32),
    };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "tested to be in range")]
    let attributes =
        StreetAttributes { lanes: lanes.map_or(0, |lanes| lanes as u32), level, ..of_line.attributes(depth) };
    ExistingStreet {
        line: line.line.iter().copied().map(DVec3::truncate).collect(),
        attributes,
        is_bridge: lines.bridge || level > 0,
        name,
    }
}

/// Returns the level of a line according to its OpenStreetMap attributes.
fn level_of(line: &ExistingLine, is_bridge: bool) -> i32 {
    let layer = line.fact("layer").and_then(|layer| number_of(&layer)).filter(|layer| layer.abs() <= 100.0);
    #[allow(clippy::cast_possible_truncation, reason = "tested to be in range")]
    let layer = layer.map(|layer| layer as i32).filter(|layer| *layer != 0);
    let is = |name: &str| line.fact(name).is_some_and(|value| is_set(&value));
    // A passage through a building is on the ground.
    let is_passage =
        line.fact("tunnel").and_then(|tunnel| tunnel.text()).is_some_and(|kind| kind == "building_passage");
    let usual = match (is_bridge || is("bridge"), is("tunnel") && !is_passage) {
        (true, _) => 1,
        (false, true) => -1,
        (false, false) => 0,
    };
    layer.unwrap_or(usual)
}

/// Returns the warning about streets that are missing in the network.
fn losses(report: &ExistingReport) -> Option<Warning> {
    if report.losses.is_empty() {
        return None;
    }
    let lost: f64 = report.losses.iter().map(|loss| loss.length).filter(|length| length.is_finite()).sum();
    let shown = |loss: &burgeon_streets::ExistingLoss| {
        let place = loss.at.map_or_else(String::new, |at| format!(" at {:.1}, {:.1}", at.x, at.y));
        let length = if loss.length.is_finite() {
            format!("{:.2} m", loss.length).into()
        } else {
            Cow::Borrowed("endless")
        };
        format!("{}{place} ({length}, {})", loss.name, loss.why.name())
    };
    let named: Vec<String> = report.losses.iter().take(NAMED).map(shown).collect();
    let rest = report.losses.len() - named.len();
    let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
    let text = format!(
        "network: existing: {lost:.1} of {:.1} m of streets are missing in the network: {}{more}",
        report.asked,
        named.join(", ")
    );
    Some(Warning::new(WarningKind::Data, text).help(
        "outside: give positions within 500 km of the origin; no length: give lines of at least two positions; network:omitted() lists all missing parts",
    ))
}
