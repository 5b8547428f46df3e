//! Tall features, which inner tiles contain so that they are seen from afar.

use std::fmt;
use std::str::FromStr;

use burgeon_base::error::{Error, Result};
use burgeon_data::{Attribute, Feature};
use serde::{Deserialize, Serialize};

/// Rule for tall features: those whose attribute is at least a number.
///
/// ```
/// use burgeon_tiles::plan::TallRule;
///
/// let rule: TallRule = "height:50".parse()?;
/// assert_eq!((rule.attribute.as_str(), rule.least), ("height", 50.0));
/// assert!("height".parse::<TallRule>().is_err());
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TallRule {
    /// Name of the attribute.
    pub attribute: String,
    /// Smallest number of a tall feature.
    pub least: f64,
}

impl TallRule {
    /// Returns true if a feature, whose attributes are called `names`, is tall. Features without the attribute are not.
    pub fn holds(&self, names: &[String], feature: &Feature) -> bool {
        let value = feature.attributes.iter().find(|(number, _)| names.get(*number) == Some(&self.attribute));
        value.and_then(|(_, value)| Attribute::number(value)).is_some_and(|number| number >= self.least)
    }
}

impl FromStr for TallRule {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let parts = text.rsplit_once(':').map(|(name, least)| (name.trim(), least.trim().parse::<f64>()));
        match parts {
            Some((name, Ok(least))) if !name.is_empty() && least.is_finite() => {
                Ok(Self { attribute: name.to_owned(), least })
            }
            _ => Err(Error::argument(format!(
                "invalid rule {text:?}: write an attribute and its smallest number, such as height:50"
            ))),
        }
    }
}

impl fmt::Display for TallRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.attribute, self.least)
    }
}
