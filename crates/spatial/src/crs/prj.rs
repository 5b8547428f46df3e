//! Identification of the EPSG coordinate system for the well-known text in a `.prj` file.
//!
//! ESRI's texts have their own names and no codes. Therefore the parameters are compared, and if several systems have
//! the same parameters, the name decides.

use super::corrections::replacement;
use super::epsg;
use super::system::Crs;
use super::vertical;
use super::well_known_text::TextNode;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;

/// Maximum difference of two lengths (m) of one unit; the two American feet differ by 6e-7 m.
const SAME_UNIT: f64 = 4e-7;

/// Minimum likeness of the names of a datum.
const SAME_DATUM: f64 = 0.5;

/// End of the name of a projection whose unit was changed to metres.
pub(crate) const IN_METRES: &str = " in metres";

/// Returns the coordinate system of a text; `label` and the remedy are used in messages.
pub fn crs_of_text(text: &str, label: &str, remedy: &str) -> Result<Crs> {
    let unknown = |name: &str| {
        Error::data(format!("{label}: unknown coordinate system \"{}\"", shown(name))).help(remedy)
    };
    let Some(node) = TextNode::read(text) else {
        return Err(unknown(text.lines().next().unwrap_or_default()));
    };
    // A compound system additionally has heights.
    let is_compound = matches!(&*node.word, "COMPD_CS" | "COMPOUNDCRS");
    let node = if is_compound { node.nodes.into_iter().next() } else { Some(node) };
    let Some(node) = node else { return Err(unknown("")) };
    if let Some(code) = node.code() {
        return Crs::epsg(code);
    }
    let name = node.name();
    let method = node.child(&["PROJECTION"]).map(|method| plain(method.name()));
    if method.as_deref() == Some("mercatorauxiliarysphere") {
        return Crs::epsg(3857);
    }
    // A projection that this program wrote.
    if let (true, Some(extension)) = (name.ends_with(IN_METRES), node.child(&["EXTENSION"]))
        && let [kind, definition] = &*extension.texts
        && kind == "PROJ4"
        && !definition.contains("+nadgrids")
    {
        return Crs::of_definition(name, definition);
    }
    let Some(wanted) = Parameters::of(&node) else { return Err(unknown(name)) };
    let mut best: Option<(f64, u16)> = None;
    epsg::for_each(|code, text| {
        // Most entries are of another type, which is the first word of their text.
        if !text.starts_with(&node.word) {
            return;
        }
        let Some(known) = TextNode::read(text) else { return };
        let Some(of_known) = Parameters::of(&known).filter(|known| known.is_same(&wanted)) else { return };
        let datums = wanted.likeness_of_datum(&of_known);
        // Many old datums share an ellipsoid, and are hundreds of metres apart.
        if datums < SAME_DATUM && !wanted.is_modern() || replacement(code).is_some() {
            return;
        }
        let score = likeness(&plain(name), &plain(known.name())) + datums;
        if best.is_none_or(|(most, _)| score > most) {
            best = Some((score, code));
        }
    })?;
    match (best, wanted.middle()) {
        (Some((_, code)), _) => Crs::epsg(code.into()),
        (None, Some(middle)) => Ok(Crs::around(middle)),
        (None, None) => Err(unknown(name)),
    }
}

/// Returns the length (m) of the unit of heights in the text of a compound system; `None` if the text has no vertical
/// system. `label` and the remedy are used in messages.
pub fn height_unit(text: &str, label: &str, remedy: &str) -> Result<Option<f64>> {
    let nodes = TextNode::read_all(text);
    let is_vertical = |node: &&TextNode| vertical::KEYWORDS.contains(&&*node.word);
    let Some(found) =
        nodes.iter().flat_map(|node| std::iter::once(node).chain(&node.nodes)).find(is_vertical)
    else {
        return Ok(None);
    };
    vertical::unit(found).map(Some).ok_or_else(|| {
        Error::data(format!("{label} does not specify the unit of its heights, \"{}\"", shown(found.name())))
            .help(remedy)
    })
}

/// Returns a name reduced to lower-case letters and digits, with years as in EPSG names.
fn plain(name: &str) -> String {
    let mut plain: String = name.to_lowercase().chars().filter(|letter| letter.is_alphanumeric()).collect();
    for (long, short) in [
        ("1984", "84"),
        ("1983", "83"),
        ("1989", "89"),
        ("1972", "72"),
        ("1927", "27"),
        ("1993", "93"),
        ("gcs", ""),
    ] {
        plain = plain.replace(long, short);
    }
    // Datums of the French Antilles that ESRI calls after their first points.
    let aliases = [("sainteanne", "guadeloupe1948"), ("fortdesaix", "martinique1938")];
    let aliases = [("europeanterrestrialreferencesystem", "etrs"), ("worldgeodeticsystem", "wgs")]
        .into_iter()
        .chain(aliases);
    aliases.fold(plain, |plain, (long, short)| plain.replace(long, short))
}

fn datum(node: &TextNode) -> String {
    let base = node.child(&["GEOGCS"]).unwrap_or(node);
    let name = base.child(&["DATUM"]).map(|datum| plain(datum.name())).unwrap_or_default();
    name.strip_prefix('d').map(str::to_owned).unwrap_or(name)
}

/// Returns the similarity of two names, from 0 to 1: the fraction of common letter pairs.
#[allow(clippy::cast_precision_loss, reason = "names are short")]
fn likeness(a: &str, b: &str) -> f64 {
    let pairs = |text: &str| text.chars().zip(text.chars().skip(1)).collect::<Vec<_>>();
    let (a, mut b) = (pairs(a), pairs(b));
    let all = (a.len() + b.len()).max(1);
    let same = a.iter().filter(|pair| {
        let found = b.iter().position(|other| other == *pair);
        found.map(|at| b.swap_remove(at)).is_some()
    });
    2.0 * same.count() as f64 / all as f64
}

/// Parameters that determine coordinates.
struct Parameters {
    method: &'static str,
    /// Values by name, sorted.
    values: Vec<(&'static str, f64)>,
    ellipsoid: [f64; 2],
    unit: f64,
    datum: String,
    /// Name of the geographic system.
    base: String,
}

impl Parameters {
    fn of(node: &TextNode) -> Option<Self> {
        let is_projected = node.word == "PROJCS";
        let base = if is_projected { node.child(&["GEOGCS"])? } else { node };
        if !is_projected && node.word != "GEOGCS" {
            return None;
        }
        let ellipsoid = base.child(&["DATUM"])?.child(&["SPHEROID"])?;
        let ellipsoid = [*ellipsoid.numbers.first()?, *ellipsoid.numbers.get(1)?];
        let unit = node.child(&["UNIT"]).and_then(|unit| unit.numbers.first().copied()).unwrap_or(1.0);
        let prime = base.child(&["PRIMEM"]).and_then(|prime| prime.numbers.first().copied()).unwrap_or(0.0);
        let mut values = vec![("prime", prime)];
        let mut method = "geographic";
        if is_projected {
            method = method_of(node.child(&["PROJECTION"])?.name())?;
            for parameter in node.nodes.iter().filter(|node| node.word == "PARAMETER") {
                let (Some(name), Some(value)) = (parameter_of(parameter.name()), parameter.numbers.first())
                else {
                    continue;
                };
                values.push((name, *value));
            }
            if method == "lcc" && !values.iter().any(|(name, _)| *name == "second") {
                // With one standard parallel, that parallel is the latitude of origin.
                values.retain(|(name, _)| *name != "first");
            }
        }
        // Either of two parallels may be the first.
        let place = |wanted: &str| values.iter().position(|(name, _)| *name == wanted);
        if let (Some(first), Some(second)) = (place("first"), place("second"))
            && values[first].1 > values[second].1
        {
            (values[first].1, values[second].1) = (values[second].1, values[first].1);
        }
        // A scale of 1 and offsets of 0 may be omitted.
        values.retain(|(name, value)| {
            let usual = if *name == "scale" { 1.0 } else { 0.0 };
            (value - usual).abs() > 1e-9
        });
        values.sort_by(|a, b| a.0.cmp(b.0));
        Some(Self { method, values, ellipsoid, unit, datum: datum(node), base: plain(base.name()) })
    }

    /// Returns the likeness of two datums, from the names that they and their geographic systems have: ESRI shortens
    /// one of them.
    fn likeness_of_datum(&self, other: &Self) -> f64 {
        likeness(&self.datum, &other.datum).max(likeness(&self.base, &other.base))
    }

    /// Returns the centre (longitude and latitude in degrees) of a transverse Mercator projection that is specific to a
    /// run, if it is one.
    fn middle(&self) -> Option<[f64; 2]> {
        let value =
            |key: &str| self.values.iter().find(|(name, _)| *name == key).map_or(0.0, |found| found.1);
        let middle = ["longitude", "latitude"].map(value);
        let is_plain = self.values.iter().all(|(name, _)| matches!(*name, "longitude" | "latitude"));
        let is_wgs_84 = self.is_modern() && (self.ellipsoid[1] - 298.257_223_563).abs() < 1e-6;
        let is_ours = self.method == "tmerc" && is_plain && is_wgs_84 && (self.unit - 1.0).abs() < 1e-9;
        (is_ours && middle[0].abs() <= 180.0 && middle[1].abs() <= 90.0).then_some(middle)
    }

    /// Returns true if the ellipsoid is one of satellite navigation: GRS 80 or WGS 84. Datums on it differ by metres.
    fn is_modern(&self) -> bool {
        (self.ellipsoid[0] - 6_378_137.0).abs() < 0.1 && (self.ellipsoid[1] - 298.257).abs() < 1e-3
    }

    fn is_same(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64, least: f64| (a - b).abs() <= least;
        self.method == other.method
            && near(self.unit, other.unit, SAME_UNIT)
            && near(self.ellipsoid[0], other.ellipsoid[0], 0.1)
            && near(self.ellipsoid[1], other.ellipsoid[1], 1e-3)
            && self.values.len() == other.values.len()
            && self.values.iter().zip(&other.values).all(|(a, b)| {
                let least = if matches!(a.0, "east" | "north") { 1e-3 } else { 1e-7 };
                a.0 == b.0 && near(a.1, b.1, least)
            })
    }
}

/// Returns the canonical name of a method that has several names.
fn method_of(name: &str) -> Option<&'static str> {
    Some(match plain(name).as_str() {
        "transversemercator" | "gausskruger" => "tmerc",
        "lambertconformalconic" | "lambertconformalconic1sp" | "lambertconformalconic2sp" => "lcc",
        "mercator" | "mercator1sp" | "mercator2sp" => "merc",
        "doublestereographic" | "obliquestereographic" => "sterea",
        "stereographic" | "polarstereographic" | "stereographicnorthpole" | "stereographicsouthpole" => {
            "stere"
        }
        "albers" | "albersconicequalarea" => "albers",
        "lambertazimuthalequalarea" => "laea",
        "azimuthalequidistant" => "aeqd",
        "cassini" | "cassinisoldner" => "cass",
        "krovak" => "krovak",
        "newzealandmapgrid" => "nzmg",
        "swissobliquecylindrical"
        | "hotineobliquemercatorazimuthcenter"
        | "obliquemercator"
        | "rectifiedskeworthomorphiccenter" => "somerc",
        _ => return None,
    })
}

fn parameter_of(name: &str) -> Option<&'static str> {
    Some(match plain(name).as_str() {
        "centralmeridian" | "longitudeofcenter" | "longitudeoforigin" | "longitudeofnaturalorigin" => {
            "longitude"
        }
        "latitudeoforigin" | "latitudeofcenter" | "latitudeofnaturalorigin" => "latitude",
        "scalefactor" => "scale",
        "falseeasting" => "east",
        "falsenorthing" => "north",
        "standardparallel1" => "first",
        "standardparallel2" => "second",
        "azimuth" => "azimuth",
        _ => return None,
    })
}
