//! Assignment of columns, or of another module's parameters, to the parameters of a module.

use std::borrow::Cow;

use burgeon_rewriting::Signature;

/// Common names of geometry columns.
const GEOMETRY: [&str; 5] = ["geometry", "geom", "shape", "the_geom", "wkb_geometry"];

/// Returns for each parameter of `target` the index of the name that it takes its value from. `is_geometry`
/// marks the `names` of geometries. Names without a parameter are ignored.
///
/// If no parameter has the name of the only geometry, the geometry goes to a parameter with a common geometry
/// name, or otherwise to the only required parameter without a value. Fails with the required parameters that
/// have no value.
pub(crate) fn fit<'a>(
    names: &[&str],
    is_geometry: &[bool],
    target: &'a Signature,
) -> Result<Vec<Option<usize>>, Vec<&'a str>> {
    let named = |parameter: &String| {
        let exact = names.iter().position(|name| name == parameter);
        exact.or_else(|| names.iter().position(|name| name.eq_ignore_ascii_case(parameter)))
    };
    let mut found: Vec<Option<usize>> = target.parameters.iter().map(named).collect();
    let geometries = (0..names.len()).filter(|place| is_geometry.get(*place) == Some(&true));
    let has_one = found.iter().flatten().any(|place| is_geometry.get(*place) == Some(&true));
    if let ([geometry], false) = (geometries.collect::<Vec<_>>().as_slice(), has_one) {
        let open = |parameter: usize| found[parameter].is_none();
        let common = GEOMETRY.iter().find_map(|common| {
            let known = target.parameters.iter().position(|name| name.eq_ignore_ascii_case(common));
            known.filter(|parameter| open(*parameter))
        });
        let mut required = (0..target.required).filter(|parameter| open(*parameter));
        let only = required.next().filter(|_| required.next().is_none());
        if let Some(parameter) = common.or(only) {
            found[parameter] = Some(*geometry);
        }
    }
    let missing = (0..target.required).filter(|parameter| found[*parameter].is_none());
    let missing: Vec<&str> = missing.map(|parameter| target.parameters[parameter].as_str()).collect();
    if missing.is_empty() { Ok(found) } else { Err(missing) }
}

/// Joins names in a sentence: "a", "a and b", "a, b and c".
pub(crate) fn listed(names: &[impl AsRef<str>]) -> Cow<'_, str> {
    match names {
        [] => Cow::Borrowed("none"),
        [only] => Cow::Borrowed(only.as_ref()),
        [first @ .., last] => {
            let first: Vec<&str> = first.iter().map(AsRef::as_ref).collect();
            Cow::Owned(format!("{} and {}", first.join(", "), last.as_ref()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fitted(
        names: &[&str],
        geometries: &[usize],
        parameters: &[&str],
    ) -> Result<Vec<Option<usize>>, Vec<String>> {
        let parameters: Vec<String> = parameters.iter().map(|&name| name.to_owned()).collect();
        let target = Signature::new("T", &parameters).unwrap();
        let is_geometry: Vec<bool> = (0..names.len()).map(|place| geometries.contains(&place)).collect();
        fit(names, &is_geometry, &target).map_err(|missing| missing.into_iter().map(str::to_owned).collect())
    }

    #[test]
    fn columns_go_to_parameters_by_name_and_a_geometry_to_the_one_that_is_left() {
        let missing = |names: &[&str]| Err(names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>());
        for (names, geometries, parameters, expected) in [
            (&["id", "h"][..], &[][..], &["h", "id"][..], Ok(vec![Some(1), Some(0)])),
            (&["ID", "id"], &[], &["id"], Ok(vec![Some(1)])),
            (&["Levels"], &[], &["levels"], Ok(vec![Some(0)])),
            (&["id", "more"], &[], &["id", "h?"], Ok(vec![Some(0), None])),
            (&["id"], &[], &["id", "h", "w"], missing(&["h", "w"])),
            (&["geom", "id"], &[0], &["geom", "id"], Ok(vec![Some(0), Some(1)])),
            (&["geom", "id"], &[0], &["polygon", "id"], Ok(vec![Some(0), Some(1)])),
            (&["geom", "id"], &[0], &["geometry", "id", "other"], missing(&["other"])),
            (&["geom", "id"], &[0], &["a", "b", "id"], missing(&["a", "b"])),
            (&["geom", "id"], &[0], &["id", "shape?"], Ok(vec![Some(1), Some(0)])),
            (&["geom", "id"], &[0], &["id", "other?"], Ok(vec![Some(1), None])),
            (&["geom", "way"], &[0, 1], &["way", "x"], missing(&["x"])),
            (&["geom", "way"], &[0, 1], &["line"], missing(&["line"])),
        ] {
            assert_eq!(fitted(names, geometries, parameters), expected, "{names:?} for {parameters:?}");
        }
    }

    #[test]
    fn names_are_listed_in_words() {
        assert_eq!(listed(&["a", "b", "c"]), "a, b and c");
        assert_eq!(listed(&["a", "b"]), "a and b");
        assert_eq!(listed(&[] as &[&str]), "none");
    }
}
