//! Values of a parameter over the frames of a film, and their notation: `0:10:0.1`, `age=0:10:0.1`.

use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::grouped;
use burgeon_engine::script::Setting;

/// Maximum number of frames unless a caller allows more.
pub const MOST_FRAMES: u32 = 10_000;

/// Name of the parameter if the notation names none.
const TIME: &str = "time";

/// Notation of an axis.
const FORM: &str = "write FIRST:LAST:STEP, such as 0:10:0.1, or NAME=FIRST:LAST:STEP";

/// Parameter of a script and its values, one for each frame.
///
/// ```
/// use burgeon_live::films::FrameAxis;
///
/// let axis: FrameAxis = "age=0:2:0.5".parse()?;
/// assert_eq!((axis.name(), axis.count()?), ("age", 5));
/// assert_eq!((axis.value(3), axis.text(3)), (1.5, "1.5".to_owned()));
/// assert!("0:10:-1".parse::<FrameAxis>().is_err());
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FrameAxis {
    name: String,
    first: f64,
    last: f64,
    step: f64,
}

impl FrameAxis {
    /// Returns the name of the parameter.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the number of frames. Fails if it does not fit into 32 bits.
    pub fn count(&self) -> Result<u32> {
        self.count_within(u32::MAX)
    }

    /// Returns the number of frames. Fails if there are more than `most`.
    pub fn count_within(&self, most: u32) -> Result<u32> {
        // Includes the last value even if a rounding error exceeds the range.
        let count = ((self.last - self.first) / self.step + 1e-9).floor() + 1.0;
        if count <= f64::from(most) {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded before")]
            return Ok(count as u32);
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded before")]
        let many = (count < 1e15).then(|| grouped(count as usize));
        let many = many.as_deref().unwrap_or("so many");
        let message = format!("{many} frames exceed the maximum of {}", grouped(most as usize));
        Err(Error::limit(Limit::Size, message)
            .help("use a larger step, FIRST:LAST:STEP, or raise the limit: --frame-limit N"))
    }

    /// Returns the value of frame `number`, which counts from 0.
    pub fn value(&self, number: u32) -> f64 {
        let value = self.first + f64::from(number) * self.step;
        // Removes the error of adding decimal fractions.
        format!("{value:.12e}").parse().unwrap_or(value)
    }

    /// Returns the value of frame `number` as text that parses to the same value.
    pub fn text(&self, number: u32) -> String {
        self.value(number).to_string()
    }

    /// Returns a label for frame `number`, such as `frame 3, time 1.5`.
    pub fn label(&self, number: u32) -> String {
        format!("frame {number}, {} {}", self.name, Setting::Number(self.value(number)))
    }
}

impl std::str::FromStr for FrameAxis {
    type Err = Error;

    /// Parses `FIRST:LAST:STEP` or `NAME=FIRST:LAST:STEP`, an inclusive range. Without a step, frames are 1 apart.
    /// Without a name, the parameter is `time`.
    fn from_str(text: &str) -> Result<Self> {
        let (name, range) = match text.split_once('=') {
            Some((name, range)) => (name.trim(), range),
            None => (TIME, text),
        };
        if name.is_empty() {
            return Err(Error::argument("the parameter has no name").help(FORM));
        }
        let parts: Vec<&str> = range.split(':').collect();
        let (first, last, step) = match parts.as_slice() {
            [first, last] => (number(first, "first value")?, number(last, "last value")?, None),
            [first, last, step] => {
                (number(first, "first value")?, number(last, "last value")?, Some(number(step, "step")?))
            }
            _ => return Err(Error::argument(format!("{range:?} is not a range")).help(FORM)),
        };
        let step = step.unwrap_or(if last < first { -1.0 } else { 1.0 });
        if step == 0.0 || (last - first) * step < 0.0 {
            let right = if last < first { -1.0 } else { 1.0 } * if step == 0.0 { 1.0 } else { step.abs() };
            return Err(Error::argument(format!("the step {step} cannot reach {last} from {first}"))
                .help(format!("write {first}:{last}:{right}")));
        }
        Ok(Self { name: name.to_owned(), first, last, step })
    }
}

/// Parses a number of a range.
fn number(text: &str, what: &str) -> Result<f64> {
    match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(Error::argument(format!("{:?} is not a number for the {what}", text.trim())).help(FORM)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        let axis: FrameAxis = text.parse().unwrap();
        (0..axis.count().unwrap()).map(|number| axis.text(number)).collect()
    }

    #[test]
    fn a_range_contains_both_ends_and_decimal_fractions_without_errors() {
        assert_eq!(values("0:0.5:0.1"), ["0", "0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(values("0:1:0.4"), ["0", "0.4", "0.8"]);
        assert_eq!(values(" n = 3:1"), ["3", "2", "1"]);
        assert_eq!(values("1:0:-0.5"), ["1", "0.5", "0"]);
        assert_eq!(values("7:7:-2"), ["7"]);
        assert_eq!(values("0:10:0.1").len(), 101);
        assert_eq!("0:1".parse::<FrameAxis>().unwrap().label(1), "frame 1, time 1");
    }

    #[test]
    fn text_that_is_no_range_is_refused_with_what_to_write() {
        let refused = |text: &str| text.parse::<FrameAxis>().unwrap_err().to_string();
        insta::assert_snapshot!(refused("0:10:0"), @r"
        the step 0 cannot reach 10 from 0
          help: write 0:10:1
        ");
        insta::assert_snapshot!(refused("0:10:-0.1"), @r"
        the step -0.1 cannot reach 10 from 0
          help: write 0:10:0.1
        ");
        insta::assert_snapshot!(refused("10:0:0.1"), @r"
        the step 0.1 cannot reach 0 from 10
          help: write 10:0:-0.1
        ");
        insta::assert_snapshot!(refused("0:nan:1"), @r#"
        "nan" is not a number for the last value
          help: write FIRST:LAST:STEP, such as 0:10:0.1, or NAME=FIRST:LAST:STEP
        "#);
        insta::assert_snapshot!(refused("0:10:inf"), @r#"
        "inf" is not a number for the step
          help: write FIRST:LAST:STEP, such as 0:10:0.1, or NAME=FIRST:LAST:STEP
        "#);
        insta::assert_snapshot!(refused("10"), @r#"
        "10" is not a range
          help: write FIRST:LAST:STEP, such as 0:10:0.1, or NAME=FIRST:LAST:STEP
        "#);
        insta::assert_snapshot!(refused("=0:1"), @r"
        the parameter has no name
          help: write FIRST:LAST:STEP, such as 0:10:0.1, or NAME=FIRST:LAST:STEP
        ");
        let count = |text: &str| text.parse::<FrameAxis>().unwrap().count_within(MOST_FRAMES).unwrap_err();
        insta::assert_snapshot!(count("0:10:0.0001"), @r"
        100,001 frames exceed the maximum of 10,000
          help: use a larger step, FIRST:LAST:STEP, or raise the limit: --frame-limit N
        ");
        insta::assert_snapshot!(count("0:1e300:1e-300"), @r"
        so many frames exceed the maximum of 10,000
          help: use a larger step, FIRST:LAST:STEP, or raise the limit: --frame-limit N
        ");
    }
}
