//! Type detection for attributes stored as text: attributes whose values are all numbers, or all `true` or `false`, are
//! converted.

use std::sync::Arc;

use crate::features::table::FeatureTable;
use burgeon_base::error::Result;
use burgeon_kit::Attribute;

/// Types that fit all texts of an attribute so far.
#[derive(Clone, Copy)]
struct ValueKinds {
    numbers: bool,
    booleans: bool,
}

/// Possible types of all attributes.
#[derive(Default)]
pub(in crate::formats) struct TextTypes {
    kinds: Vec<ValueKinds>,
}

impl TextTypes {
    /// Returns the attribute called `name` with the text `value`, and updates the possible types.
    pub(in crate::formats) fn attribute(
        &mut self,
        table: &mut FeatureTable,
        name: &str,
        value: &str,
    ) -> (usize, Attribute) {
        let number = table.name(name);
        let kind = self.kind(number);
        kind.numbers &= as_number(value).is_some();
        kind.booleans &= matches!(value, "true" | "false");
        (number, table.text(value))
    }

    /// Returns an attribute whose values are declared to be texts.
    pub(in crate::formats) fn text(
        &mut self,
        table: &mut FeatureTable,
        name: &str,
        value: &str,
    ) -> (usize, Attribute) {
        let number = table.name(name);
        *self.kind(number) = ValueKinds { numbers: false, booleans: false };
        (number, table.text(value))
    }

    fn kind(&mut self, number: usize) -> &mut ValueKinds {
        if self.kinds.len() <= number {
            self.kinds.resize(number + 1, ValueKinds { numbers: true, booleans: true });
        }
        &mut self.kinds[number]
    }

    /// Converts texts to numbers and booleans, for attributes with only such values.
    pub(in crate::formats) fn finish(self, table: &mut FeatureTable) -> Result<()> {
        if !self.kinds.iter().any(|kind| kind.numbers || kind.booleans) {
            return Ok(());
        }
        let FeatureTable { budget, features, .. } = table;
        for feature in features {
            budget.tick()?;
            for (number, value) in Arc::make_mut(&mut feature.attributes) {
                let (Attribute::Text(text), Some(kind)) = (&*value, self.kinds.get(*number)) else {
                    continue;
                };
                if kind.booleans {
                    *value = Attribute::Boolean(&**text == "true");
                } else if let (true, Some(number)) = (kind.numbers, as_number(text)) {
                    *value = Attribute::Number(number);
                }
            }
        }
        Ok(())
    }
}

/// Longest whole number after a plus sign that is not a telephone number.
const LONGEST_POSITIVE: usize = 6;

/// Returns the number in a text if it has no other meaning; a number with a leading zero is a code, and a long one with a
/// plus sign is a telephone number.
pub(in crate::formats) fn as_number(text: &str) -> Option<f64> {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    let is_code = digits.starts_with('0') && digits[1..].starts_with(|letter: char| letter.is_ascii_digit());
    let begins = digits.starts_with(|letter: char| letter.is_ascii_digit() || letter == '.');
    let is_telephone = text.starts_with('+') && digits.len() > LONGEST_POSITIVE && !digits.contains('.');
    if is_code || is_telephone || !begins || digits.len() > 25 {
        return None;
    }
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::as_number;

    #[test]
    fn numbers_may_begin_or_end_with_a_point_or_have_a_sign() {
        let found = [".5", "5.", "+5", "-.5", "+2.25", "1e3", "0"].map(as_number);
        assert_eq!(found, [0.5, 5.0, 5.0, -0.5, 2.25, 1000.0, 0.0].map(Some));
        for text in ["007", "+358401234567", "+", ".", "", "inf", "+-5", "-+5", "5 m"] {
            assert_eq!(as_number(text), None, "{text}");
        }
    }
}
