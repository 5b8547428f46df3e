//! Vertical coordinate systems: the unit of their heights.

use super::well_known_text::TextNode;

/// Keywords of vertical coordinate systems in well-known text.
pub(super) const KEYWORDS: [&str; 4] = ["VERT_CS", "VERTCS", "VERTCRS", "VERTICALCRS"];

/// Returns the length (m) of the unit of a vertical system; `None` if the text has none.
pub(super) fn unit(system: &TextNode) -> Option<f64> {
    let unit = |node: &TextNode| node.child(&["UNIT", "LENGTHUNIT"])?.numbers.first().copied();
    let found = unit(system).or_else(|| unit(system.child(&["AXIS"])?));
    let found = found.or_else(|| u16::try_from(system.code()?).ok().map(unit_of_system));
    found.filter(|length| length.is_finite() && *length > 0.0)
}

/// Returns the length (m) of the unit of a vertical coordinate system with an EPSG code. Most are in metres.
pub fn unit_of_system(code: u16) -> f64 {
    match code {
        // NGVD29, NAVD88 and mean sea level in US survey feet.
        5702 | 6360 | 8052 => 1200.0 / 3937.0,
        // The Cayman Islands' three datums, mean sea level, and NAVD88 in international feet.
        6130..=6132 | 8050 | 8228 => 0.3048,
        // Poolbeg in British feet of 1936.
        5754 => 0.304_800_749_1,
        _ => 1.0,
    }
}
