//! Corrections of the registry of coordinate systems: wrong parameters, axes, withdrawn codes, and shifts of datums.
//!
//! The registry is the crate `crs-definitions`. The parameters and shifts are those of EPSG 12, as PROJ 9 has them.

use std::borrow::Cow;

use burgeon_base::error::{Error, Result};

/// Codes that EPSG withdrew because their parameters or their unit were wrong, with the code that replaced each. GDAL
/// reads the replacement, other programs read the old parameters, so the position of the coordinates is not known.
const WITHDRAWN: [(u16, u16); 37] = [
    (2194, 3102),
    (2244, 2965),
    (2245, 2966),
    (2889, 2967),
    (2890, 2968),
    (3359, 3404),
    (3454, 4457),
    (3973, 6931),
    (3974, 6932),
    (3975, 6933),
    (6200, 6966),
    (6996, 7131),
    (6997, 7132),
    (26814, 26847),
    (26815, 26848),
    (26819, 26849),
    (26820, 26850),
    (26821, 26851),
    (26822, 26852),
    (26823, 26853),
    (26824, 26854),
    (26825, 26855),
    (26826, 26856),
    (26830, 26857),
    (26831, 26858),
    (26832, 26859),
    (26833, 26860),
    (26834, 26861),
    (26835, 26862),
    (26836, 26863),
    (26837, 26864),
    (26841, 26865),
    (26842, 26866),
    (26843, 26867),
    (26844, 26868),
    (26845, 26869),
    (26846, 26870),
];

/// Parts of definitions that are wrong in the registry, with what replaces them.
const REPLACED: [(u16, &str, &str); 6] = [
    // The false easting is 40,000 chains of 20.116756 m.
    (3167, "+x_0=40000 ", "+x_0=804670.24 "),
    // EPSG's Madrid is 3 degrees 41 minutes 14.55 seconds west of Greenwich.
    (2062, "+pm=madrid", "+pm=-3.687375"),
    // The axes are south and west.
    (2065, "+proj=krovak", "+proj=krovak +axis=swu"),
    (5513, "+proj=krovak", "+proj=krovak +axis=swu"),
    (8044, "+proj=cass", "+proj=cass +axis=swu"),
    (8045, "+proj=cass", "+proj=cass +axis=swu"),
];

/// Shifts to WGS 84 by the name of the datum in well-known text: three lengths (m), three rotations (arc seconds) as
/// position vectors, and a scale (ppm).
const SHIFTS: [(&str, &str); 10] = [
    // DB_REF to ETRS89 (1).
    ("Deutsche_Bahn_Reference_System", "584.9636,107.7175,413.8067,1.1155,0.2824,-3.1384,7.9922"),
    ("Deutsche Bahn Reference System", "584.9636,107.7175,413.8067,1.1155,0.2824,-3.1384,7.9922"),
    // Korean 1985 to WGS 84 (1), as rotations around the centre of the earth.
    ("Korean_Datum_1985", "-114.62,475.963,675.018,1.162,-2.347,-1.592,6.342"),
    // Pampa del Castillo to WGS 84 (2).
    ("Pampa_del_Castillo", "-233.43,6.65,173.64,0,0,0,0"),
    // Chos Malal 1914 to WGS 84 (3).
    ("Chos_Malal_1914", "15.75,164.93,126.18,0,0,0,0"),
    // Kertau (RSO) to Kertau 1968, whose shift is Kertau 1968 to WGS 84 (1).
    ("Kertau_RSO", "-11,851,5,0,0,0,0"),
    // Fatu Iva 72 to WGS 84 (2): the registry has the signs of coordinate frames.
    ("Fatu_Iva_72", "347.175,1077.618,2623.677,33.9058,-70.6776,9.4013,186.0647"),
    // Indian 1975 to WGS 84 (4).
    ("Indian_1975", "293,836,318,0.5,1.6,-2.8,2.1"),
    // Kalianpur 1937 to WGS 84 (1).
    ("Kalianpur_1937", "282,726,254,0,0,0,0"),
    // MGI to WGS 84 (3).
    ("Militar_Geographische_Institut_Ferro", "577.326,90.129,463.919,5.137,1.474,5.297,2.4232"),
];

/// Shift of Pulkovo 1942(58) in Romania: Pulkovo 1942(58) to WGS 84 (19), with the signs of position vectors. The
/// registry has those of coordinate frames.
const STEREO_70: (&str, &str) = (
    "+towgs84=2.329,-147.042,-92.08,0.309,-0.325,-0.497,5.69",
    "+towgs84=2.329,-147.042,-92.08,-0.309,0.325,0.497,5.69",
);

/// Returns the code that replaced a withdrawn one.
pub(super) fn replacement(code: u16) -> Option<u16> {
    WITHDRAWN.iter().find(|(known, _)| *known == code).map(|(_, other)| *other)
}

/// Fails if a code was withdrawn because it was wrong.
pub(super) fn refuse_withdrawn(code: u16) -> Result<()> {
    let Some(other) = replacement(code) else { return Ok(()) };
    let message = format!(
        "EPSG withdrew the coordinate system EPSG:{code} because it was wrong, and programs disagree about it"
    );
    Err(Error::data(message).help(format!(
        "specify the system of the coordinates: EPSG:{other} replaced it, {{ crs = {other} }}; if they have another unit or origin, specify that system"
    )))
}

/// Returns the corrected PROJ definition of the system with this code, definition and well-known text.
pub(super) fn correct_definition(code: u16, definition: String, text: &str) -> String {
    let mut found = Cow::from(definition);
    for (_, wrong, right) in REPLACED.iter().filter(|(known, ..)| *known == code) {
        found = found.replace(wrong, right).into();
    }
    let name = datum_name(text);
    if let Some((_, shift)) = SHIFTS.iter().find(|(known, _)| Some(*known) == name) {
        let parts: Vec<&str> = found
            .split_whitespace()
            .filter(|part| !part.starts_with("+towgs84=") && *part != "+no_defs")
            .collect();
        return format!("{} +towgs84={shift} +no_defs", parts.join(" "));
    }
    found.replace(STEREO_70.0, STEREO_70.1)
}

/// Returns the name of the datum in well-known text.
pub(super) fn datum_name(text: &str) -> Option<&str> {
    text.split_once("DATUM[\"")?.1.split('"').next()
}

/// Returns true if no shift to WGS 84 is known for a PROJ definition: it has an ellipsoid of an old survey and no shift,
/// or one that needs a grid of another file. Systems on the ellipsoids of satellite navigation are within metres.
pub(super) fn lacks_shift(definition: &str) -> bool {
    let value = |key: &str| definition.split_whitespace().find_map(|part| part.strip_prefix(key));
    match (value("+nadgrids="), value("+datum=")) {
        (Some("@null"), _) => return false,
        (Some(_), _) | (None, Some("NAD27")) => return true,
        _ => {}
    }
    let is_modern = matches!(value("+ellps="), Some("GRS80" | "WGS84" | "WGS72"));
    let is_sphere = value("+R=").is_some() || value("+a=").is_some_and(|a| value("+b=") == Some(a));
    value("+towgs84=").is_none() && value("+datum=").is_none() && !is_modern && !is_sphere
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crs::{Crs, ReferenceFrame};

    /// Returns longitude and latitude of a point in a coordinate system.
    fn degrees(code: u32, at: [f64; 2]) -> [f64; 2] {
        let frame = ReferenceFrame::around(&Crs::epsg(code).unwrap(), at, "a").unwrap();
        let place = frame.passage(&Crs::epsg(code).unwrap()).unwrap().enter(at);
        frame.passage(&Crs::epsg(4326).unwrap()).unwrap().leave(place)
    }

    #[test]
    fn corrected_systems_are_where_proj_puts_them() {
        // Places by PROJ 9.6 with the shifts of EPSG, to a tenth of a metre; the axes of four systems are south and west.
        for (code, at, [longitude, latitude]) in PLACES {
            let [x, y] = degrees(code, at);
            let off = ((x - longitude) * latitude.to_radians().cos()).hypot(y - latitude) * 111_320.0;
            assert!(off < 0.3, "{code}: {off} m");
        }
    }

    /// Codes, coordinates, and longitude and latitude (WGS 84).
    const PLACES: [(u32, [f64; 2], [f64; 2]); 13] = [
        (3303, [757397.767, 8838225.626], [-138.65, -10.5]),
        (24048, [70263.526, 1661849.680], [101.0, 15.0]),
        (24306, [195096.019, 2657179.365], [90.0, 24.0]),
        (3844, [500120.367, 500031.315], [25.0, 46.0]),
        (5682, [2570239.329, 5652122.842], [7.0, 51.0]),
        (5174, [199930.276, 444198.852], [127.0, 37.5]),
        (5514, [-703017.436, -1058153.576], [15.0, 50.0]),
        (2082, [2500215.543, 4850380.456], [-69.0, -46.5]),
        (31285, [447544.233, 5262356.955], [13.3, 47.5]),
        (5513, [1058153.576, 703017.436], [15.0, 50.0]),
        (3167, [23785.101, 19245.522], [102.3, 3.5]),
        (2062, [598929.425, 644362.681], [-3.7, 40.4]),
        (8352, [1231650.500, 428770.021], [19.0, 48.7]),
    ];

    #[test]
    fn south_and_west_axes_are_turned() {
        for code in [2065, 5513, 8044, 8045, 8352] {
            let crs = Crs::epsg(code).unwrap();
            let frame = ReferenceFrame::around(&crs, [1_144_000.0, 544_000.0], "a").unwrap();
            let passage = frame.passage(&crs).unwrap();
            let [a, b] = [[1_144_000.0, 544_000.0], [1_145_000.0, 544_002.0]].map(|at| passage.enter(at));
            let way = [b[0] - a[0], b[1] - a[1]];
            assert!((way[0] + 2.0).abs() < 1e-6 && (way[1] + 1000.0).abs() < 1e-6, "{code}: {way:?}");
        }
    }

    #[test]
    fn withdrawn_codes_are_refused_with_the_one_that_replaced_them() {
        for (code, other) in WITHDRAWN {
            let error = Crs::epsg(code.into()).unwrap_err();
            assert!(error.message().contains("EPSG withdrew"), "{error}");
            assert!(error.remedy().unwrap().contains(&format!("crs = {other}")), "{error}");
            assert!(Crs::epsg(other.into()).is_ok(), "{other}");
        }
    }
}
