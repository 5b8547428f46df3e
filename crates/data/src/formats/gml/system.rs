//! Interpretation of `srsName`: the coordinate system and the order of coordinates.

use super::axes::is_north_first;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use burgeon_spatial::Crs;

/// Coordinate system named in a file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NamedSystem {
    pub(super) crs: Crs,
    /// Set if the first coordinate is the northing or the latitude.
    pub(super) north_first: bool,
    /// Set if the system has heights.
    pub(super) has_heights: bool,
}

impl NamedSystem {
    /// Interprets `name`; the code `forced` replaces the code in the name.
    ///
    /// A URN or an opengis.net URL implies the axis order of the registry, with latitude first. The older short forms
    /// always imply east first.
    pub(super) fn of_name(name: &str, forced: Option<u32>) -> Result<Self> {
        let parts: Vec<&str> = name.split(',').collect();
        let is_compound = parts.len() > 2 && parts[0].ends_with(":crs");
        let part = if is_compound { parts[1] } else { name };
        let (code, by_registry) = code(part.trim()).unwrap_or((None, false));
        let code = forced.or(code).ok_or_else(|| {
            Error::data(format!("unknown coordinate system \"{}\"", shown(name)))
                .help("specify its EPSG code: source(file, { crs = 3067 })")
        })?;
        let crs = Crs::epsg(code)?;
        let north_first = by_registry
            && (crs.is_geographic() && !part.contains("CRS84") || crs.code.is_some_and(is_north_first));
        Ok(Self { crs, north_first, has_heights: is_compound || matches!(code, 4979 | 4937 | 7423) })
    }
}

/// Returns the EPSG code in a name, and true if the axis order of the registry applies.
fn code(name: &str) -> Option<(Option<u32>, bool)> {
    let last = |separator: char| name.rsplit(separator).next().and_then(|code| code.parse().ok());
    let lower = name.to_ascii_lowercase();
    // Names used by German surveyors; east comes first.
    if let Some((_, zone)) = lower.split_once("etrs89_utm") {
        let zone: String = zone.chars().take_while(char::is_ascii_digit).collect();
        return Some((
            zone.parse::<u32>().ok().filter(|zone| (28..=38).contains(zone)).map(|zone| 25_800 + zone),
            false,
        ));
    }
    if lower.ends_with("crs84") || lower.ends_with("crs:84") {
        return Some((Some(4326), false));
    }
    if lower.starts_with("urn:") {
        return lower.contains(":epsg:").then(|| (last(':'), true));
    }
    if lower.contains("/def/crs/epsg/") {
        return Some((last('/'), true));
    }
    if lower.contains("epsg.xml#") {
        return Some((last('#'), false));
    }
    if lower.starts_with("epsg:") || lower.starts_with("crs:") {
        return Some((last(':'), false));
    }
    name.parse().ok().map(|code| (Some(code), false))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_all_forms_are_known_with_their_order() {
        let of = |name: &str| {
            NamedSystem::of_name(name, None)
                .map(|system| (system.crs.name(), system.north_first, system.has_heights))
                .ok()
        };
        for (name, code, north_first) in [
            ("urn:ogc:def:crs:EPSG::4326", 4326, true),
            ("urn:ogc:def:crs:EPSG:6.9:4326", 4326, true),
            ("urn:x-ogc:def:crs:EPSG:4326", 4326, true),
            ("http://www.opengis.net/def/crs/EPSG/0/4258", 4258, true),
            ("https://www.opengis.net/def/crs/EPSG/0/31467", 31467, true),
            ("urn:ogc:def:crs:EPSG::25832", 25832, false),
            ("urn:ogc:def:crs:EPSG::3035", 3035, true),
            ("http://www.opengis.net/gml/srs/epsg.xml#4326", 4326, false),
            ("EPSG:4326", 4326, false),
            ("epsg:31467", 31467, false),
            ("urn:ogc:def:crs:OGC:1.3:CRS84", 4326, false),
            ("CRS:84", 4326, false),
            ("urn:adv:crs:ETRS89_UTM32", 25832, false),
        ] {
            assert_eq!(of(name), Some((format!("EPSG:{code}"), north_first, false)), "{name}");
        }
        let compound = "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837";
        assert_eq!(of(compound), Some(("EPSG:25832".to_owned(), false, true)));
        for name in
            ["", "#crs", "urn:ogc:def:crs:EPSG::", "urn:adv:crs:DE_DHDN_3GK3", "EPSG:99999", "EPSG:-1"]
        {
            assert_eq!(of(name), None, "{name}");
        }
        assert!(NamedSystem::of_name("urn:ogc:def:crs:EPSG::99999", Some(4326)).unwrap().north_first);
    }
}
