//! Conversion of tags to attributes for scripts: numeric heights and storeys, roof shapes and colours, under plain
//! names.
//!
//! Source: OpenStreetMap wiki, "Simple 3D Buildings" and "Map features/Units".

/// Type of a tag value.
#[derive(Clone, Copy, PartialEq)]
enum TagMeaning {
    /// Length (m).
    Length,
    /// Number.
    Count,
    /// Direction (degrees clockwise from north), or a word that is kept.
    Bearing,
    /// Text.
    Text,
}

/// Attribute names, the keys that provide their values (the first key present is used), and the value types.
const NAMES: [(&str, &[&str], TagMeaning); 20] = [
    ("height", &["height", "building:height", "est_height"], TagMeaning::Length),
    ("min_height", &["min_height", "building:min_height"], TagMeaning::Length),
    ("levels", &["building:levels", "levels"], TagMeaning::Count),
    ("min_level", &["building:min_level", "min_level"], TagMeaning::Count),
    ("roof_shape", &["roof:shape", "building:roof:shape"], TagMeaning::Text),
    ("roof_height", &["roof:height", "building:roof:height"], TagMeaning::Length),
    ("roof_levels", &["roof:levels", "building:roof:levels"], TagMeaning::Count),
    ("roof_angle", &["roof:angle"], TagMeaning::Count),
    ("roof_direction", &["roof:direction"], TagMeaning::Bearing),
    ("roof_orientation", &["roof:orientation"], TagMeaning::Text),
    ("roof_colour", &["roof:colour", "roof:color", "building:roof:colour"], TagMeaning::Text),
    ("roof_material", &["roof:material", "building:roof:material"], TagMeaning::Text),
    (
        "colour",
        &["building:colour", "building:color", "building:facade:colour", "colour", "color"],
        TagMeaning::Text,
    ),
    ("material", &["building:material", "building:facade:material", "material"], TagMeaning::Text),
    ("width", &["width", "est_width"], TagMeaning::Length),
    ("lanes", &["lanes"], TagMeaning::Count),
    ("circumference", &["circumference"], TagMeaning::Length),
    ("diameter_crown", &["diameter_crown"], TagMeaning::Length),
    ("depth", &["depth"], TagMeaning::Length),
    ("direction", &["direction"], TagMeaning::Bearing),
];

/// Converted value of a tag.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum TagValue<'v> {
    /// Number.
    Number(f64),
    /// Text.
    Text(&'v str),
    /// Text that is not a number although one is required.
    Unread(&'v str),
}

/// Converts tags to attributes, name by name; `value` returns the value of a key.
pub(super) fn meanings<'v>(
    value: impl Fn(&str) -> Option<&'v str>,
) -> impl Iterator<Item = (&'static str, TagValue<'v>)> {
    NAMES.iter().filter_map(move |(name, keys, meaning)| {
        let text = keys.iter().find_map(|key| value(key))?;
        let number = match meaning {
            TagMeaning::Text => return Some((*name, TagValue::Text(text))),
            TagMeaning::Length => length(text),
            TagMeaning::Count => count(text),
            TagMeaning::Bearing => bearing(text),
        };
        Some(match number {
            Some(number) => (*name, TagValue::Number(number)),
            None if *meaning == TagMeaning::Bearing => (*name, TagValue::Text(text)),
            None => (*name, TagValue::Unread(text)),
        })
    })
}

/// Maximum plausible number.
const GREATEST: f64 = 100_000.0;

/// Returns the first value in a semicolon-separated list.
fn first(text: &str) -> &str {
    text.split(';').map(str::trim).find(|part| !part.is_empty()).unwrap_or_default()
}

/// Returns the number, with a decimal point or comma, at the start of a text, and the rest.
fn leading_number(text: &str) -> Option<(f64, &str)> {
    let text = text.trim_start();
    let signed = text.strip_prefix(['-', '+']).unwrap_or(text);
    let digits =
        |text: &str| text.len() - text.trim_start_matches(|letter: char| letter.is_ascii_digit()).len();
    let whole = digits(signed);
    let behind = &signed[whole..];
    let part = behind.strip_prefix(['.', ',']).map_or(0, digits);
    if whole == 0 && part == 0 {
        return None;
    }
    let end = text.len() - signed.len() + whole + if part > 0 { part + 1 } else { 0 };
    let number: f64 = text[..end].replace(',', ".").parse().ok()?;
    (number.abs() <= GREATEST).then_some((number, text[end..].trim_start()))
}

/// Parses a number such as `3`, `3.5` or `3;4`.
fn count(text: &str) -> Option<f64> {
    leading_number(first(text)).and_then(|(number, rest)| rest.is_empty().then_some(number))
}

/// Parses a length (m) such as `12`, `12 m`, `12,5m`, `40'`, `5'6"`, `40 ft` or `3;4`.
pub(super) fn length(text: &str) -> Option<f64> {
    let (number, unit) = leading_number(first(text))?;
    // Feet and inches are written with various characters.
    let feet = ["'", "\u{2032}", "\u{2019}", "ft", "feet", "foot"];
    if let Some(rest) = feet.iter().find_map(|mark| unit.strip_prefix(mark)) {
        let inches = match rest.trim_matches(['.', ' ']) {
            "" => 0.0,
            rest => leading_number(rest).filter(|(_, mark)| is_inch(mark)).map(|(inches, _)| inches)?,
        };
        return Some(number * 0.3048 + inches * 0.0254);
    }
    let metres = match unit.trim_end_matches('.').to_ascii_lowercase().as_str() {
        "" | "m" | "metre" | "metres" | "meter" | "meters" => 1.0,
        "dm" => 0.1,
        "cm" => 0.01,
        "mm" => 0.001,
        "km" => 1000.0,
        "mi" => 1609.344,
        unit if is_inch(unit) => 0.0254,
        _ => return None,
    };
    Some(number * metres)
}

fn is_inch(mark: &str) -> bool {
    matches!(mark, "\"" | "\u{2033}" | "\u{201d}" | "''" | "in" | "inch" | "inches")
}

/// Parses a direction (degrees) such as `90`, `90°` or `NNE`.
fn bearing(text: &str) -> Option<f64> {
    const POINTS: [&str; 16] =
        ["N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"];
    const WORDS: [(&str, f64); 4] = [("north", 0.0), ("east", 90.0), ("south", 180.0), ("west", 270.0)];
    let text = first(text);
    if let Some((number, rest)) = leading_number(text) {
        return matches!(rest, "" | "°" | "deg").then_some(number.rem_euclid(360.0));
    }
    let mut points = POINTS.iter().zip(0u8..);
    let point = points.find(|(point, _)| point.eq_ignore_ascii_case(text));
    point
        .map(|(_, number)| f64::from(number) * 22.5)
        .or_else(|| WORDS.iter().find(|(word, _)| word.eq_ignore_ascii_case(text)).map(|(_, angle)| *angle))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_read_as_mappers_write_them() {
        let near = |text: &str, expected: f64| {
            let read = length(text);
            assert!(read.is_some_and(|read| (read - expected).abs() < 1e-9), "{text}: {read:?}");
        };
        for (text, metres) in [
            ("12", 12.0),
            ("12 m", 12.0),
            ("12m", 12.0),
            ("12.5 metres", 12.5),
            ("12,5", 12.5),
            (" .5", 0.5),
            ("3;4", 3.0),
            (";3", 3.0),
            ("-2", -2.0),
            ("40'", 12.192),
            ("40 ft", 12.192),
            ("5'6\"", 1.6764),
            ("5 ft 6 in", 1.6764),
            ("6\"", 0.1524),
            ("250 cm", 2.5),
            ("1.2 km", 1200.0),
        ] {
            near(text, metres);
        }
        for text in ["", "tall", "12-15", "~12", "1e999", "12 fathoms", "5'x", "999999999", "12.5.1", "-"] {
            assert_eq!(length(text), None, "{text}");
        }
    }

    #[test]
    fn directions_are_degrees_or_points_of_the_compass() {
        let read = ["90", "450", "-90", "NNE", "w", "South", "30°", "forward", "N-S", ""].map(bearing);
        let some = [90.0, 90.0, 270.0, 22.5, 270.0, 180.0, 30.0].map(Some);
        assert_eq!(read[..7], some);
        assert_eq!(read[7..], [None, None, None]);
    }

    #[test]
    fn tags_mean_something_under_plain_names() {
        let tags = [
            ("building:levels", "3;4"),
            ("height", "tall"),
            ("building:colour", "red"),
            ("colour", "blue"),
            ("roof:shape", "gabled"),
            ("direction", "forward"),
        ];
        let told: Vec<_> = meanings(|key| tags.iter().find(|tag| tag.0 == key).map(|tag| tag.1)).collect();
        let expected = [
            ("height", TagValue::Unread("tall")),
            ("levels", TagValue::Number(3.0)),
            ("roof_shape", TagValue::Text("gabled")),
            ("colour", TagValue::Text("red")),
            ("direction", TagValue::Text("forward")),
        ];
        assert_eq!(told, expected);
    }
}
