//! Axis of variations, and its notation: `1..16`, `twist=0..90:10`, `kind=a,b`.

use burgeon_base::error::{Error, Limit, Result};
use burgeon_engine::script::Setting;

/// Maximum number of variations.
pub const MOST: usize = 256;

/// Property that changes from one variation to the next.
#[derive(Debug, Clone, PartialEq)]
pub enum VariationAxis {
    /// Seed of all random numbers.
    Seeds(Vec<u64>),
    /// Parameter of the script.
    Param {
        /// Name of the parameter.
        name: String,
        /// Values as text. If empty, all choices of the parameter, or both values of a boolean.
        values: Vec<String>,
    },
}

impl VariationAxis {
    /// Parses seeds: numbers and inclusive ranges such as `1..16`, separated by commas.
    ///
    /// ```
    /// use burgeon_live::variations::VariationAxis;
    ///
    /// assert_eq!(VariationAxis::seeds("1..3, 12")?, VariationAxis::Seeds(vec![1, 2, 3, 12]));
    /// assert!(VariationAxis::seeds("3..1").is_err());
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn seeds(text: &str) -> Result<Self> {
        let help = "write a range such as 1..16, or numbers such as 3,7,12";
        let number = |text: &str| {
            let parsed = text.trim().parse::<u64>();
            parsed.map_err(|_| Error::argument(format!("invalid seed {:?}", text.trim())).help(help))
        };
        let mut seeds = Vec::new();
        for item in text.split(',') {
            let (from, to) = match item.split_once("..") {
                Some((from, to)) => (number(from)?, number(to)?),
                None => (number(item)?, number(item)?),
            };
            if from > to {
                return Err(Error::argument(format!("the range {from}..{to} is empty"))
                    .help(format!("write {to}..{from}")));
            }
            check_count((to - from).saturating_add(1) as f64 + seeds.len() as f64, "use fewer seeds")?;
            seeds.extend(from..=to);
        }
        Ok(Self::Seeds(seeds))
    }

    /// Parses a parameter and its values: `NAME=LOW..HIGH:STEP`, an inclusive range, `NAME=A,B,C`, or `NAME` for every
    /// choice. The default step is 1.
    ///
    /// ```
    /// use burgeon_live::variations::VariationAxis;
    ///
    /// let values = |text: &str| match VariationAxis::sweep(text) {
    ///     Ok(VariationAxis::Param { values, .. }) => values.join(" "),
    ///     other => format!("{other:?}"),
    /// };
    /// assert_eq!(values("twist=0..90:30"), "0 30 60 90");
    /// assert_eq!(values("kind=hip, flat"), "hip flat");
    /// assert_eq!(VariationAxis::seeds("1..3,7")?, VariationAxis::Seeds(vec![1, 2, 3, 7]));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn sweep(text: &str) -> Result<Self> {
        let (name, values) = match text.split_once('=') {
            Some((name, values)) => (name.trim(), Some(values.trim())),
            None => (text.trim(), None),
        };
        let form = "write NAME=LOW..HIGH:STEP, such as twist=0..90:10, or NAME=A,B,C";
        if name.is_empty() {
            return Err(Error::argument("the parameter has no name").help(form));
        }
        let values = match values {
            None => Vec::new(),
            Some("") => return Err(Error::argument(format!("{name} has no values")).help(form)),
            Some(values) => match values.split_once("..") {
                Some((low, high)) if !values.contains(',') && (is_number(low) || is_number(high)) => {
                    range(low, high)?
                }
                _ => list(values, form)?,
            },
        };
        Ok(Self::Param { name: name.to_owned(), values })
    }
}

fn list(text: &str, form: &str) -> Result<Vec<String>> {
    let values: Vec<String> = text.split(',').map(|value| value.trim().to_owned()).collect();
    check_count(values.len() as f64, "use fewer values")?;
    if values.iter().any(String::is_empty) {
        return Err(Error::argument(format!("{text:?} has an empty value")).help(form));
    }
    Ok(values)
}

fn is_number(text: &str) -> bool {
    let text = text.split(':').next().unwrap_or_default();
    text.trim().parse::<f64>().is_ok_and(f64::is_finite)
}

/// Returns the numbers from `low` to `high`; `high` also contains the step after a colon.
fn range(low: &str, high: &str) -> Result<Vec<String>> {
    let (high, step) = high.split_once(':').unwrap_or((high, "1"));
    let number = |text: &str, what: &str| match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(Error::argument(format!("{:?} is not a number for the {what} of a range", text.trim()))
            .help("write LOW..HIGH:STEP, such as 0..90:10")),
    };
    let (low, high, step) = (number(low, "beginning")?, number(high, "end")?, number(step, "step")?);
    if step <= 0.0 {
        return Err(Error::argument(format!("the step {step} cannot reach {high} from {low}"))
            .help("give a step above 0"));
    }
    if low > high {
        return Err(
            Error::argument(format!("the range {low}..{high} is empty")).help(format!("write {high}..{low}"))
        );
    }
    // Include the last value even if a rounding error exceeds the range.
    let count = ((high - low) / step + 1e-9).floor() + 1.0;
    check_count(count, "use a larger step: LOW..HIGH:STEP")?;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 256")]
    let count = count as usize;
    Ok((0..count).map(|i| Setting::Number(rounded(low + i as f64 * step)).to_string()).collect())
}

/// Rounds `number` to 13 significant digits, which removes the error of adding decimal fractions.
fn rounded(number: f64) -> f64 {
    format!("{number:.12e}").parse().unwrap_or(number)
}

/// Fails if there are no variations, or too many.
pub(super) fn check_count(count: f64, help: &str) -> Result<()> {
    if count > MOST as f64 {
        let many = (count < 1e9).then(|| count.to_string());
        let many = many.as_deref().unwrap_or("so many");
        let message = format!("{many} variations exceed the maximum of {MOST}");
        return Err(Error::limit(Limit::Size, message).help(help));
    }
    if count < 1.0 {
        return Err(Error::argument("nothing to vary").help("give a seed or a value"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        match VariationAxis::sweep(text).unwrap() {
            VariationAxis::Param { values, .. } => values,
            VariationAxis::Seeds(_) => panic!("seeds"),
        }
    }

    #[test]
    fn ranges_hold_both_ends_and_lists_their_values() {
        assert_eq!(VariationAxis::seeds("1..3").unwrap(), VariationAxis::Seeds(vec![1, 2, 3]));
        assert_eq!(
            VariationAxis::seeds("9, 2..3,18446744073709551615").unwrap(),
            VariationAxis::Seeds(vec![9, 2, 3, u64::MAX])
        );
        assert_eq!(values("twist=0..90:30"), ["0", "30", "60", "90"]);
        assert_eq!(values(" twist = -1..1 "), ["-1", "0", "1"]);
        assert_eq!(values("x=0.1..0.5:0.1"), ["0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(values("x=0..1:0.4"), ["0", "0.4", "0.8"]);
        assert_eq!(values("kind=a, b,c=d"), ["a", "b", "c=d"]);
        assert_eq!(values("file=../a"), ["../a"]);
        assert!(values("kind").is_empty());
    }

    #[test]
    fn what_is_no_range_is_refused_with_what_to_write() {
        let said = |over: Result<VariationAxis>| over.unwrap_err().to_string();
        insta::assert_snapshot!(said(VariationAxis::seeds("16..1")), @r"
        the range 16..1 is empty
          help: write 1..16
        ");
        insta::assert_snapshot!(said(VariationAxis::seeds("1..")), @r#"
        invalid seed ""
          help: write a range such as 1..16, or numbers such as 3,7,12
        "#);
        insta::assert_snapshot!(said(VariationAxis::seeds("-3")), @r#"
        invalid seed "-3"
          help: write a range such as 1..16, or numbers such as 3,7,12
        "#);
        insta::assert_snapshot!(said(VariationAxis::seeds("1..257")), @r"
        257 variations exceed the maximum of 256
          help: use fewer seeds
        ");
        insta::assert_snapshot!(said(VariationAxis::seeds("0..18446744073709551615")), @r"
        so many variations exceed the maximum of 256
          help: use fewer seeds
        ");
        insta::assert_snapshot!(said(VariationAxis::sweep("x=9..1")), @r"
        the range 9..1 is empty
          help: write 1..9
        ");
        insta::assert_snapshot!(said(VariationAxis::sweep("x=1..9:0")), @r"
        the step 0 cannot reach 9 from 1
          help: give a step above 0
        ");
        insta::assert_snapshot!(said(VariationAxis::sweep("x=1..9:-1")), @r"
        the step -1 cannot reach 9 from 1
          help: give a step above 0
        ");
        insta::assert_snapshot!(said(VariationAxis::sweep("x=1..")), @r#"
        "" is not a number for the end of a range
          help: write LOW..HIGH:STEP, such as 0..90:10
        "#);
        insta::assert_snapshot!(said(VariationAxis::sweep("x=..5")), @r#"
        "" is not a number for the beginning of a range
          help: write LOW..HIGH:STEP, such as 0..90:10
        "#);
        insta::assert_snapshot!(said(VariationAxis::sweep("x=0..1e9")), @r"
        so many variations exceed the maximum of 256
          help: use a larger step: LOW..HIGH:STEP
        ");
        insta::assert_snapshot!(said(VariationAxis::sweep("x=0..nan")), @r#"
        "nan" is not a number for the end of a range
          help: write LOW..HIGH:STEP, such as 0..90:10
        "#);
        insta::assert_snapshot!(said(VariationAxis::sweep("x=")), @r"
        x has no values
          help: write NAME=LOW..HIGH:STEP, such as twist=0..90:10, or NAME=A,B,C
        ");
        insta::assert_snapshot!(said(VariationAxis::sweep("x=a,,b")), @r#"
        "a,,b" has an empty value
          help: write NAME=LOW..HIGH:STEP, such as twist=0..90:10, or NAME=A,B,C
        "#);
        insta::assert_snapshot!(said(VariationAxis::sweep("=1,2")), @r"
        the parameter has no name
          help: write NAME=LOW..HIGH:STEP, such as twist=0..90:10, or NAME=A,B,C
        ");
    }
}
