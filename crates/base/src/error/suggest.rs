//! Suggestions for misspelt names ("did you mean").

/// Maximum length of a misspelt name (bytes). Longer text is not a name, and comparing it takes long.
const LONGEST_NEAR: usize = 100;

/// Returns the remedy that suggests a name.
pub fn did_you_mean(near: &str) -> String {
    format!("did you mean {near}?")
}

/// Returns the name in `known` that is nearest to a misspelt `name`, if one is similar enough.
///
/// ```
/// use burgeon_base::error::nearest;
///
/// assert_eq!(nearest("lenght", ["height", "length"]), Some("length"));
/// assert_eq!(nearest("window", ["height", "length"]), None);
/// ```
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > LONGEST_NEAR {
        return None;
    }
    let lower = name.to_lowercase();
    // Names of one letter all differ by one letter, so no suggestion is useful.
    let limit = match name.chars().count() {
        0 | 1 => 0,
        length => (length / 3).max(1),
    };
    known
        .into_iter()
        .map(|candidate| (strsim::osa_distance(&lower, &candidate.to_lowercase()), candidate))
        .filter(|(distance, _)| *distance <= limit)
        .min_by_key(|(distance, candidate)| (*distance, candidate.len()))
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_found_and_a_far_one_is_not() {
        assert_eq!(nearest("Flor", ["Floor", "Slab"]), Some("Floor"));
        assert_eq!(nearest("smoth", ["sides", "smooth"]), Some("smooth"));
        assert_eq!(nearest("window", ["sides", "smooth"]), None);
        assert_eq!(nearest("m", ["n", "max"]), None);
        assert_eq!(nearest("nothing", ["string"]), None);
        assert_eq!(nearest("a", ["A"]), Some("A"));
        assert_eq!(nearest("lenght", ["length", "height"]), Some("length"));
    }
}
