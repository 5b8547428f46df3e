//! Formulas of numbers, which need no call of a function.

/// Maximum number of values that an evaluation holds at once.
const DEEPEST: usize = 8;

/// Number of rows of arguments that are evaluated together.
pub(crate) const ROWS: usize = 64;

/// A formula of the arguments of a rule: a number, or a truth value of comparisons.
///
/// ```
/// use burgeon_rewriting::{FormulaColumns, RuleFormula};
///
/// let rows = [[3.0, 4.0], [9.0, 4.0]];
/// let fill = |argument: usize, column: &mut [f64]| (0..2).for_each(|row| column[row] = rows[row][argument]);
/// let mut columns = FormulaColumns::default();
/// let sum = RuleFormula::read("a0 a1 + o0 *", &[10.0]).expect("a formula");
/// assert_eq!(sum.evaluate(2, &mut columns, fill), Some(&[70.0, 130.0][..]));
/// let condition = RuleFormula::read("a0 a1 + 10 < a1 0 > and", &[]).expect("a formula");
/// assert_eq!(condition.evaluate(2, &mut columns, fill), Some(&[1.0, 0.0][..]));
/// assert!(condition.is_truth() && condition.evaluate(1, &mut columns, |_, column| column[0] = f64::NAN).is_none());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RuleFormula {
    steps: Vec<FormulaStep>,
    is_truth: bool,
}

/// Memory of evaluations: columns of values.
#[derive(Debug)]
pub struct FormulaColumns([[f64; ROWS]; DEEPEST]);

impl Default for FormulaColumns {
    fn default() -> Self {
        Self([[0.0; ROWS]; DEEPEST])
    }
}

/// Step of an evaluation, on the last values. Truth values are 1 and 0.
#[derive(Debug, Clone, Copy, PartialEq)]
enum FormulaStep {
    Number(f64),
    Argument(usize),
    Negate,
    Not,
    Two(FormulaOperator),
}

/// Operator of two values.
#[derive(Debug, Clone, Copy, PartialEq)]
enum FormulaOperator {
    Add,
    Subtract,
    Multiply,
    Divide,
    DivideDown,
    Modulo,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Equal,
    Unequal,
    And,
    Or,
}

impl RuleFormula {
    /// Reads a formula in postfix notation: numbers, arguments `a0`, `a1` ... , the numbers `outer` as `o0`, `o1` ... , and
    /// the operators of Lua, with `neg` for the negative number. Returns `None` for anything else.
    pub fn read(code: &str, outer: &[f64]) -> Option<Self> {
        let mut steps = Vec::new();
        // Set for truth values.
        let mut types: Vec<bool> = Vec::new();
        for word in code.split(' ') {
            let (step, taken, is_truth) = match word {
                "true" | "false" => (FormulaStep::Number(f64::from(word == "true")), &[][..], true),
                "neg" => (FormulaStep::Negate, &[false][..], false),
                "not" => (FormulaStep::Not, &[true][..], true),
                _ => match FormulaOperator::read(word) {
                    Some((operator, of, gives)) => (
                        FormulaStep::Two(operator),
                        if of { &[true, true][..] } else { &[false, false] },
                        gives,
                    ),
                    None => (FormulaStep::operand(word, outer)?, &[][..], false),
                },
            };
            let rest = types.len().checked_sub(taken.len())?;
            if types.drain(rest..).as_slice() != taken {
                return None;
            }
            types.push(is_truth);
            steps.push(step);
            if types.len() > DEEPEST {
                return None;
            }
        }
        let [is_truth] = *types.as_slice() else { return None };
        Some(Self { steps, is_truth })
    }

    /// Returns true if the values are truth values, 1 or 0.
    pub fn is_truth(&self) -> bool {
        self.is_truth
    }

    /// Returns the value for each of at most 64 rows of arguments. `fill` writes the values of an argument to a column.
    ///
    /// Returns `None` if a value is not a number, or NaN.
    #[inline]
    pub fn evaluate<'c>(
        &self,
        rows: usize,
        columns: &'c mut FormulaColumns,
        mut fill: impl FnMut(usize, &mut [f64]),
    ) -> Option<&'c [f64]> {
        let rows = rows.min(ROWS);
        let FormulaColumns(columns) = columns;
        let mut count = 0;
        for step in &self.steps {
            match *step {
                FormulaStep::Number(number) => {
                    columns[count] = [number; ROWS];
                    count += 1;
                }
                FormulaStep::Argument(index) => {
                    let column = &mut columns[count][..rows];
                    fill(index, column);
                    if column.iter().any(|value| value.is_nan()) {
                        return None;
                    }
                    count += 1;
                }
                FormulaStep::Negate => columns[count - 1].iter_mut().for_each(|value| *value = -*value),
                FormulaStep::Not => columns[count - 1].iter_mut().for_each(|value| *value = 1.0 - *value),
                FormulaStep::Two(operator) => {
                    count -= 1;
                    let (lower, upper) = columns.split_at_mut(count);
                    operator.apply(&mut lower[count - 1], &upper[0]);
                }
            }
        }
        let column = &columns[0][..rows];
        column.iter().all(|value| !value.is_nan()).then_some(column)
    }

    /// Returns the indices of the arguments that the formula reads.
    pub fn arguments(&self) -> impl Iterator<Item = usize> {
        self.steps.iter().filter_map(|step| match step {
            FormulaStep::Argument(index) => Some(*index),
            _ => None,
        })
    }
}

impl FormulaStep {
    /// Reads a number or a variable.
    fn operand(word: &str, outer: &[f64]) -> Option<Self> {
        if let Some(index) = word.strip_prefix('a') {
            return Some(Self::Argument(index.parse().ok()?));
        }
        match word.strip_prefix('o') {
            Some(index) => Some(Self::Number(*outer.get(index.parse::<usize>().ok()?)?)),
            None => Some(Self::Number(word.parse().ok()?)),
        }
    }
}

impl FormulaOperator {
    /// Reads an operator. The flags are set if it takes and if it gives truth values.
    fn read(word: &str) -> Option<(Self, bool, bool)> {
        Some(match word {
            "+" => (Self::Add, false, false),
            "-" => (Self::Subtract, false, false),
            "*" => (Self::Multiply, false, false),
            "/" => (Self::Divide, false, false),
            "//" => (Self::DivideDown, false, false),
            "%" => (Self::Modulo, false, false),
            "<" => (Self::Less, false, true),
            "<=" => (Self::LessOrEqual, false, true),
            ">" => (Self::Greater, false, true),
            ">=" => (Self::GreaterOrEqual, false, true),
            "==" => (Self::Equal, false, true),
            "~=" => (Self::Unequal, false, true),
            "and" => (Self::And, true, true),
            "or" => (Self::Or, true, true),
            _ => return None,
        })
    }

    /// Applies the operator to each pair of values, and stores the results in `left`.
    #[allow(clippy::float_cmp, reason = "Lua compares numbers exactly")]
    fn apply(self, left: &mut [f64; ROWS], right: &[f64; ROWS]) {
        #[inline(always)]
        fn each(left: &mut [f64; ROWS], right: &[f64; ROWS], of: impl Fn(f64, f64) -> f64) {
            left.iter_mut().zip(right).for_each(|(a, b)| *a = of(*a, *b));
        }
        match self {
            Self::Add => each(left, right, |a, b| a + b),
            Self::Subtract => each(left, right, |a, b| a - b),
            Self::Multiply | Self::And => each(left, right, |a, b| a * b),
            Self::Divide => each(left, right, |a, b| a / b),
            Self::DivideDown => each(left, right, |a, b| (a / b).floor()),
            // The remainder of Luau, which has the sign of the divisor.
            Self::Modulo => each(left, right, |a, b| a - (a / b).floor() * b),
            Self::Less => each(left, right, |a, b| f64::from(a < b)),
            Self::LessOrEqual => each(left, right, |a, b| f64::from(a <= b)),
            Self::Greater => each(left, right, |a, b| f64::from(a > b)),
            Self::GreaterOrEqual => each(left, right, |a, b| f64::from(a >= b)),
            Self::Equal => each(left, right, |a, b| f64::from(a == b)),
            Self::Unequal => each(left, right, |a, b| f64::from(a != b)),
            Self::Or => each(left, right, f64::max),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_has_operands_of_its_operators() {
        let outer = [0.0];
        for code in
            ["", "a0 1", "a0 1 < 2", "<", "1 <", "a0 1 < a0 and", "a0 not", "a0 1 < neg", "o1 1 <", "x 1 <"]
        {
            assert_eq!(RuleFormula::read(code, &outer), None, "{code}");
        }
        let deep = format!("{}{}1 <", "a0 ".repeat(DEEPEST + 1), "+ ".repeat(DEEPEST));
        assert_eq!(RuleFormula::read(&deep, &outer), None);
    }

    #[test]
    fn operators_give_the_values_of_lua() {
        for (code, arguments, expected) in [
            ("a0 a1 % 2 ==", [-1.0, 3.0], true),
            ("a0 a1 % -2 ==", [1.0, -3.0], true),
            ("a0 a1 // -1 ==", [1.0, -3.0], true),
            ("a0 a1 / a1 a0 / ==", [0.0, 0.0], false),
            ("a0 a1 / a1 a0 / ~=", [0.0, 0.0], true),
            ("a0 neg a1 < not", [1.0, 0.0], false),
            ("a0 1 < a1 1 < or", [3.0, 0.0], true),
            ("a0 1 < a1 1 < and", [3.0, 0.0], false),
            ("true false and not", [0.0, 0.0], true),
        ] {
            let condition = RuleFormula::read(code, &[]).unwrap();
            let mut columns = FormulaColumns::default();
            let values = condition.evaluate(1, &mut columns, |index, column| column[0] = arguments[index]);
            assert_eq!(values, Some(&[f64::from(expected)][..]), "{code}");
        }
    }
}
