//! Tag filters that select OpenStreetMap features.

use std::sync::Arc;

/// Test on the tag of a key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TagTest {
    /// Any value except `no`.
    Set,
    /// Any value.
    Any,
    /// Absent, or `no`.
    Unset,
    /// Any value in this list.
    OneOf(Vec<Arc<str>>),
}

#[cfg(feature = "data")]
impl TagTest {
    /// Returns true if the test matches the value of a tag, or its absence.
    pub(crate) fn holds(&self, value: Option<&[u8]>) -> bool {
        match (self, value) {
            (Self::Set, Some(value)) => value != b"no",
            (Self::Any, value) => value.is_some(),
            (Self::Unset, value) => value.is_none_or(|value| value == b"no"),
            (Self::OneOf(known), Some(value)) => known.iter().any(|known| known.as_bytes() == value),
            (_, None) => false,
        }
    }

    /// Returns true if the test can match only if the tag is present.
    fn needs(&self) -> bool {
        !matches!(self, Self::Unset)
    }
}

/// Filter of features by tags: all tests of at least one alternative must match.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TagFilter {
    /// Alternatives, each a list of keys and tests.
    pub alternatives: Vec<Vec<(Arc<str>, TagTest)>>,
}

#[cfg(feature = "data")]
impl TagFilter {
    /// Returns the first alternative that matches the values of keys.
    pub(crate) fn alternative<'v>(&self, value: impl Fn(&str) -> Option<&'v [u8]>) -> Option<usize> {
        let holds = |tests: &Vec<(Arc<str>, TagTest)>| tests.iter().all(|(key, test)| test.holds(value(key)));
        self.alternatives.iter().position(holds)
    }

    /// Returns keys of which a feature must have one; `None` if features without any tag may match.
    pub(crate) fn needed_keys(&self) -> Option<Vec<&str>> {
        let first = |tests: &Vec<(Arc<str>, TagTest)>| tests.iter().position(|(_, test)| test.needs());
        let needed = self.alternatives.iter().map(|tests| first(tests).map(|at| &*tests[at].0));
        needed.collect()
    }
}

#[cfg(all(test, feature = "data"))]
mod tests {
    use super::*;

    #[test]
    fn all_tests_of_an_alternative_hold_or_another_does() {
        let one = |values: &[&str]| TagTest::OneOf(values.iter().map(|value| Arc::from(*value)).collect());
        let filter = TagFilter {
            alternatives: vec![
                vec![("building".into(), TagTest::Set), ("height".into(), TagTest::Any)],
                vec![("natural".into(), one(&["tree", "wood"])), ("leisure".into(), TagTest::Unset)],
            ],
        };
        let alternative = |tags: &[(&str, &'static str)]| {
            filter.alternative(|key| tags.iter().find(|tag| tag.0 == key).map(|tag| tag.1.as_bytes()))
        };
        assert_eq!(alternative(&[("building", "yes"), ("height", "no")]), Some(0));
        assert_eq!(alternative(&[("building", "no"), ("height", "3")]), None);
        assert_eq!(alternative(&[("building", "yes")]), None);
        assert_eq!(alternative(&[("natural", "wood")]), Some(1));
        assert_eq!(alternative(&[("natural", "wood"), ("leisure", "no")]), Some(1));
        assert_eq!(alternative(&[("natural", "wood"), ("leisure", "park")]), None);
        assert_eq!(filter.needed_keys(), Some(vec!["building", "natural"]));
        let none = TagFilter { alternatives: vec![vec![("building".into(), TagTest::Unset)]] };
        assert_eq!((none.needed_keys(), none.alternative(|_| None)), (None, Some(0)));
    }
}
