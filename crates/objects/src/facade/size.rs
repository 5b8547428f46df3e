//! The permitted sizes and counts of walls, as scripts specify them.

use burgeon_geometry::{SAME, Sizes};
use burgeon_kit::{Expectation, Parameter, Value};

/// A preferred length (m), or a minimum and a maximum, or a minimum, a preferred length and a maximum.
///
/// ```
/// use burgeon_kit::{Parameter, Value};
/// use burgeon_objects::facade::size::Size;
///
/// let read = |numbers: &[f64]| Size::from_value(numbers.to_vec().into_value());
/// let width = read(&[1.0, 1.5, 3.0]).expect("a minimum, a preferred and a maximum length");
/// assert_eq!((width.sizes().low(), width.target(), width.sizes().high()), (1.0, Some(1.5), 3.0));
/// assert!(read(&[3.0, 1.0]).is_err(), "the minimum exceeds the maximum");
/// assert_eq!(Size::from_value(Value::Number(2.0)).ok().and_then(|size| size.target()), Some(2.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    low: f64,
    high: f64,
    target: Option<f64>,
}

impl Default for Size {
    /// Returns a size that permits any length.
    fn default() -> Self {
        Self { low: 0.0, high: f64::INFINITY, target: None }
    }
}

impl Parameter for Size {
    fn luau() -> String {
        "number | { number }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || Expectation::new("a preferred length (m), { min, max } or { min, preferred, max }");
        let numbers = match &value {
            Value::Number(number) => vec![*number],
            _ => Vec::<f64>::from_value(value).map_err(|_| what())?,
        };
        let size = match numbers.as_slice() {
            [target] => Self { target: Some(*target), ..Self::default() },
            [low, high] => Self { low: *low, high: *high, target: None },
            [low, target, high] => Self { low: *low, high: *high, target: Some(*target) },
            _ => return Err(what()),
        };
        let rises = [size.low, size.target.unwrap_or(size.low), size.high].is_sorted();
        if rises && size.low >= 0.0 && size.high > 0.0 { Ok(size) } else { Err(what()) }
    }

    fn into_value(self) -> Value {
        match (self.target, self.low == 0.0 && self.high.is_infinite()) {
            (Some(target), true) => target.into_value(),
            (None, true) => Value::Nil,
            (None, false) => vec![self.low, self.high].into_value(),
            (Some(target), false) => vec![self.low, target, self.high].into_value(),
        }
    }
}

impl Size {
    /// Returns the permitted lengths.
    pub fn sizes(&self) -> Sizes {
        Sizes::between(self.low, self.high)
    }

    /// Returns the preferred length (m).
    pub fn target(&self) -> Option<f64> {
        self.target
    }
}

/// A margin: its size (m), which is the minimum, the maximum or the only permitted size.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Margin {
    /// Size (m).
    pub size: f64,
    /// Permitted deviation from the size.
    pub policy: Policy,
}

/// The permitted deviation of a margin from its size.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Policy {
    /// Minimum: the margin may be larger.
    #[default]
    Min,
    /// Maximum: the margin may be smaller.
    Max,
    /// Fixed: the margin has exactly this size.
    Fixed,
}

impl Parameter for Margin {
    fn luau() -> String {
        "number | { any }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what =
            || Expectation::new("a size (m), or a size and \"min\", \"max\" or \"fixed\": { 0.5, \"max\" }");
        let (size, policy) = match &value {
            Value::Number(size) => (*size, Policy::Min),
            Value::Table(table) => match table.list().as_slice() {
                [Value::Number(size), Value::Text(policy)] => {
                    let policy = match &**policy {
                        "min" => Policy::Min,
                        "max" => Policy::Max,
                        "fixed" => Policy::Fixed,
                        _ => return Err(what()),
                    };
                    (*size, policy)
                }
                _ => return Err(what()),
            },
            _ => return Err(what()),
        };
        if size >= 0.0 && size.is_finite() { Ok(Self { size, policy }) } else { Err(what()) }
    }

    fn into_value(self) -> Value {
        self.size.into_value()
    }
}

impl Margin {
    /// Returns the permitted sizes.
    pub fn sizes(&self) -> Sizes {
        match self.policy {
            // An omitted margin stays omitted: it does not grow.
            Policy::Min if self.size <= SAME => Sizes::between(0.0, 0.0),
            Policy::Min => Sizes::between(self.size, f64::INFINITY),
            Policy::Max => Sizes::between(0.0, self.size),
            Policy::Fixed => Sizes::between(self.size, self.size),
        }
    }
}

/// The number of repetitions: a number, or a minimum and a maximum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Count {
    /// Minimum number.
    pub low: u32,
    /// Maximum number.
    pub high: u32,
}

/// Maximum number of repetitions.
const MOST: u32 = 1000;

impl Default for Count {
    fn default() -> Self {
        Self { low: 1, high: MOST }
    }
}

impl Parameter for Count {
    fn luau() -> String {
        "number | { number }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || Expectation::new(format!("an integer from 1 to {MOST}, or {{ min, max }}"));
        let numbers = match &value {
            Value::Number(_) => vec![u32::from_value(value).map_err(|_| what())?],
            _ => Vec::<u32>::from_value(value).map_err(|_| what())?,
        };
        let (low, high) = match numbers.as_slice() {
            [count] => (*count, *count),
            [low, high] => (*low, *high),
            _ => return Err(what()),
        };
        if (1..=high).contains(&low) && high <= MOST { Ok(Self { low, high }) } else { Err(what()) }
    }

    fn into_value(self) -> Value {
        vec![self.low, self.high].into_value()
    }
}
