//! Part of the features of a run.

use std::ops::Range;
use std::str::FromStr;

use burgeon_base::error::{Error, Result};
use burgeon_kit::Attribute;
use burgeon_spatial::{BoundingBox, representative_point};

/// Part of the features of each system: one of `count` ranges of about the same size, in the order of the source, or the
/// features in a cell.
///
/// A run over a part gives for its features the bytes of the whole run, if a feature depends only on others within
/// `reach`. The features of a system whose axiom is not a source, such as a terrain, belong to the first range, and to no
/// cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeaturePart {
    /// Number of the part, from 1.
    pub number: usize,
    /// Number of parts.
    pub count: usize,
    /// Distance (m) within which features of other parts are derived too, but not shown.
    pub reach: f64,
    /// West, south, east and north (m) of a cell, relative to the origin of the run. If it is set, the part consists of the
    /// features whose [representative point](burgeon_spatial::representative_point) is in it; points on its west and south sides are in
    /// it, points on the other sides are not.
    pub cell: Option<[f64; 4]>,
}

impl FeaturePart {
    /// Returns the indices of the part among `features` features.
    pub fn range(&self, features: usize) -> Range<usize> {
        let at = |part: usize| features * part / self.count.max(1);
        at(self.number.saturating_sub(1))..at(self.number)
    }

    /// Returns true if feature number `index` of `features`, from 0, with these bounds belongs to the part.
    pub fn contains(&self, index: usize, features: usize, bounds: Option<BoundingBox>) -> bool {
        let Some([west, south, east, north]) = self.cell else {
            return self.range(features).contains(&index);
        };
        bounds.is_some_and(|bounds| {
            let [x, y] = representative_point(bounds);
            (west..east).contains(&x) && (south..north).contains(&y)
        })
    }

    /// Returns true if systems without features belong to the part.
    pub fn has_featureless(&self) -> bool {
        self.cell.is_none() && self.number == 1
    }

    /// Returns the report entry about a part that draws nothing.
    pub fn empty_note(&self) -> String {
        if self.cell.is_some() {
            return "the tile is empty: its features draw nothing".to_owned();
        }
        format!(
            "part {} of {} is empty: it has no features, or its features draw nothing; systems without features, such as a terrain, are in part 1",
            self.number, self.count
        )
    }
}

/// Choice among the features of a part by the number of an attribute. Features without the number count as less.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureChoice {
    /// Name of the attribute.
    pub attribute: String,
    /// Number that chosen features reach, or do not reach.
    pub least: f64,
    /// Set to choose the features that reach the number.
    pub is_reached: bool,
}

impl FeatureChoice {
    /// Returns true if the choice contains a feature with these attributes, which are called `names`.
    pub fn contains(&self, names: &[String], attributes: &[(usize, Attribute)]) -> bool {
        let value = attributes.iter().find(|(number, _)| names.get(*number) == Some(&self.attribute));
        let number = value.and_then(|(_, value)| value.number());
        number.is_some_and(|number| number >= self.least) == self.is_reached
    }
}

impl FromStr for FeaturePart {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let numbers = text.split_once('/').and_then(|(number, count)| {
            Some((number.trim().parse::<usize>().ok()?, count.trim().parse::<usize>().ok()?))
        });
        match numbers {
            Some((number, count)) if (1..=count).contains(&number) && count <= 1_000_000 => {
                Ok(Self { number, count, reach: 0.0, cell: None })
            }
            _ => Err(Error::argument(format!(
                "invalid part {text:?}: write the number of the part and the number of parts, such as 2/4"
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_contain_each_feature_once() {
        for (features, count) in [(10, 4), (3, 5), (0, 2), (1000, 7)] {
            let parts = (1..=count)
                .map(|number| FeaturePart { number, count, reach: 0.0, cell: None }.range(features));
            let all: Vec<usize> = parts.flatten().collect();
            assert_eq!(all, (0..features).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_point_on_the_side_of_two_cells_belongs_to_the_eastern_and_northern_one() {
        let of = |cell| FeaturePart { number: 1, count: 1, reach: 0.0, cell: Some(cell) };
        let bounds = |x: f64, y: f64| Some([[x - 1.0, y - 2.0].into(), [x + 1.0, y + 2.0].into()]);
        let (west, east) = (of([0.0, 0.0, 8.0, 8.0]), of([8.0, 0.0, 16.0, 8.0]));
        assert!(!west.contains(0, 9, bounds(8.0, 3.0)) && east.contains(0, 9, bounds(8.0, 3.0)));
        assert!(west.contains(0, 9, bounds(0.0, 0.0)) && !west.contains(0, 9, bounds(3.0, 8.0)));
        assert!(!west.contains(0, 9, None) && !west.has_featureless());
    }

    #[test]
    fn a_part_is_a_number_of_parts() {
        let part = "2/4".parse::<FeaturePart>().unwrap();
        assert_eq!((part.number, part.count), (2, 4));
        for text in ["0/4", "5/4", "2", "a/b", "1/0", "-1/2", "1/2/3"] {
            assert!(text.parse::<FeaturePart>().is_err(), "{text}");
        }
    }
}
