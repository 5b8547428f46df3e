//! Filters of tags, by which features of OpenStreetMap are chosen.

use std::sync::Arc;

/// What the tag of a key has to be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TagTest {
    /// Any value but `no`.
    Set,
    /// Any value.
    Any,
    /// Not there, or `no`.
    Unset,
    /// One of these values.
    OneOf(Vec<Arc<str>>),
}

#[cfg(feature = "data")]
impl TagTest {
    /// Whether it holds for the value of a tag, or for none.
    pub(crate) fn holds(&self, value: Option<&[u8]>) -> bool {
        match (self, value) {
            (Self::Set, Some(value)) => value != b"no",
            (Self::Any, value) => value.is_some(),
            (Self::Unset, value) => value.is_none_or(|value| value == b"no"),
            (Self::OneOf(known), Some(value)) => known.iter().any(|known| known.as_bytes() == value),
            (_, None) => false,
        }
    }

    /// Whether it can hold only where there is a tag.
    fn needs(&self) -> bool {
        !matches!(self, Self::Unset)
    }
}

/// Chooses features by their tags: all tests of one of the alternatives hold.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TagFilter {
    /// The alternatives, each a list of keys and of what their tags have to be.
    pub alternatives: Vec<Vec<(Arc<str>, TagTest)>>,
}

#[cfg(feature = "data")]
impl TagFilter {
    /// The first alternative that holds for the values of keys.
    pub(crate) fn chosen<'v>(&self, value: impl Fn(&str) -> Option<&'v [u8]>) -> Option<usize> {
        let holds = |tests: &Vec<(Arc<str>, TagTest)>| tests.iter().all(|(key, test)| test.holds(value(key)));
        self.alternatives.iter().position(holds)
    }

    /// The keys of which a feature must have one; none if features without any tag may be meant.
    pub(crate) fn needed(&self) -> Option<Vec<&str>> {
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
        let chosen = |tags: &[(&str, &'static str)]| {
            filter.chosen(|key| tags.iter().find(|tag| tag.0 == key).map(|tag| tag.1.as_bytes()))
        };
        assert_eq!(chosen(&[("building", "yes"), ("height", "no")]), Some(0));
        assert_eq!(chosen(&[("building", "no"), ("height", "3")]), None);
        assert_eq!(chosen(&[("building", "yes")]), None);
        assert_eq!(chosen(&[("natural", "wood")]), Some(1));
        assert_eq!(chosen(&[("natural", "wood"), ("leisure", "no")]), Some(1));
        assert_eq!(chosen(&[("natural", "wood"), ("leisure", "park")]), None);
        assert_eq!(filter.needed(), Some(vec!["building", "natural"]));
        let none = TagFilter { alternatives: vec![vec![("building".into(), TagTest::Unset)]] };
        assert_eq!((none.needed(), none.chosen(|_| None)), (None, Some(0)));
    }
}
