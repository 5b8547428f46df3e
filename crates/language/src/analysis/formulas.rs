//! Functions of rules that only calculate with numbers: guards that compare them, and successors whose parameters are formulas.

use full_moon::ast::{BinOp, Call, Expression, Field, FunctionArgs, FunctionBody, LastStmt, LocalAssignment};
use full_moon::ast::{Parameter, Prefix, Stmt, Suffix, UnOp, Var};

use super::syntax::text_of;

/// Maximum number of operands and operators of a formula.
const MOST: usize = 64;

/// Formulas of a function, which the program evaluates without a call of the function.
pub(super) struct FormulaText {
    /// Operands and operators in postfix notation, as [`RuleFormula::read`](burgeon_rewriting::RuleFormula::read) takes them; several
    /// formulas with a semicolon in between.
    pub code: String,
    /// Names of the variables outside of the function, in the order of their numbers.
    pub outer: Vec<String>,
}

/// Type of an expression.
#[derive(Clone, Copy, PartialEq)]
enum ValueType {
    Number,
    Boolean,
}

/// Returns the condition that a function does nothing but return: comparisons of sums, products and quotients of its parameters
/// after the first, numbers, variables and its own locals.
pub(super) fn condition_of(body: &FunctionBody) -> Option<FormulaText> {
    let (mut writer, returned) = FormulaWriter::begin(body)?;
    let [value] = returned.as_slice() else { return None };
    writer.formula(value, ValueType::Boolean)?;
    writer.end()
}

/// Returns the parameters of the modules that a function does nothing but return, if they are sums, products and quotients of its
/// parameters after the first, numbers, variables and its own locals.
pub(super) fn production_of(body: &FunctionBody) -> Option<FormulaText> {
    let (mut writer, returned) = FormulaWriter::begin(body)?;
    returned.into_iter().try_for_each(|value| writer.module(value))?;
    writer.end()
}

/// Local variable of a function, which no statement assigns again. A formula contains its value instead of its name.
struct FormulaLocal {
    name: String,
    /// Its value in postfix notation.
    words: Vec<String>,
    of: ValueType,
    is_read: bool,
}

/// Writer of the formulas of a function.
struct FormulaWriter {
    /// Parameters of the function, with `this`.
    parameters: Vec<String>,
    /// Local variables so far, of which the last one with a name hides the others.
    locals: Vec<FormulaLocal>,
    /// Formulas so far.
    formulas: Vec<String>,
    /// Words of the present formula.
    words: Vec<String>,
    /// Names of variables outside of the function.
    outer: Vec<String>,
}

impl FormulaWriter {
    /// Creates the writer for a function, and returns what the function returns; `None` if it does anything else.
    fn begin(body: &FunctionBody) -> Option<(Self, Vec<&Expression>)> {
        let mut parameters = Vec::new();
        for parameter in body.parameters() {
            let Parameter::Name(name) = parameter else { return None };
            parameters.push(text_of(name));
        }
        let Some(LastStmt::Return(last)) = body.block().last_stmt() else { return None };
        let (locals, formulas, words, outer) = Default::default();
        let mut writer = Self { parameters, locals, formulas, words, outer };
        for statement in body.block().stmts() {
            let Stmt::LocalAssignment(assignment) = statement else { return None };
            writer.assign(assignment)?;
        }
        Some((writer, last.returns().iter().collect()))
    }

    /// Returns the formulas; `None` if they do not read a local variable, whose value can be an error in Lua.
    fn end(self) -> Option<FormulaText> {
        let is_complete = self.locals.iter().all(|local| local.is_read);
        is_complete.then(|| FormulaText { code: self.formulas.join(";"), outer: self.outer })
    }

    /// Adds local variables; `None` if they have others than numbers and comparisons, or too few or too many.
    fn assign(&mut self, assignment: &LocalAssignment) -> Option<()> {
        let (names, values) = (assignment.names(), assignment.expressions());
        if names.len() != values.len() {
            return None;
        }
        let mut locals = Vec::with_capacity(names.len());
        for (name, value) in names.iter().zip(values) {
            let of = self.write(value)?;
            let words = std::mem::take(&mut self.words);
            locals.push(FormulaLocal { name: text_of(name), words, of, is_read: false });
        }
        // The values do not see the names.
        self.locals.append(&mut locals);
        Some(())
    }

    /// Writes the parameters of a module, or of those in a branch.
    fn module(&mut self, value: &Expression) -> Option<()> {
        match value {
            Expression::FunctionCall(call) => {
                let mut suffixes = call.suffixes();
                let (Some(Suffix::Call(Call::AnonymousCall(arguments))), None) =
                    (suffixes.next(), suffixes.next())
                else {
                    return None;
                };
                let FunctionArgs::Parentheses { arguments, .. } = &**arguments else { return None };
                let Prefix::Name(name) = call.prefix() else { return None };
                let name = text_of(name);
                if self.locals.iter().any(|local| local.name == name) {
                    return None;
                }
                arguments.iter().try_for_each(|argument| self.formula(argument, ValueType::Number))
            }
            Expression::TableConstructor(table) => table.fields().iter().try_for_each(|field| match field {
                Field::NoKey(value) => self.module(value),
                _ => None,
            }),
            _ => None,
        }
    }

    /// Writes a formula; `None` if it is of another type.
    fn formula(&mut self, expression: &Expression, of: ValueType) -> Option<()> {
        (self.write(expression)? == of).then_some(())?;
        self.formulas.push(self.words.join(" "));
        self.words.clear();
        Some(())
    }

    /// Writes an expression in postfix notation, and returns its type; `None` for others than numbers and comparisons.
    fn write(&mut self, expression: &Expression) -> Option<ValueType> {
        use ValueType::{Boolean, Number};
        if self.words.len() >= MOST {
            return None;
        }
        match expression {
            Expression::Parentheses { expression, .. } => self.write(expression),
            Expression::Number(number) => self.word(read_number(&text_of(number))?.to_string(), Number),
            Expression::Symbol(symbol) => match text_of(symbol).as_str() {
                value @ ("true" | "false") => self.word(value.to_owned(), Boolean),
                _ => None,
            },
            Expression::Var(Var::Name(name)) => {
                let name = text_of(name);
                if let Some(local) = self.locals.iter_mut().rfind(|local| local.name == name) {
                    local.is_read = true;
                    self.words.extend_from_slice(&local.words);
                    return (self.words.len() <= MOST).then_some(local.of);
                }
                let word = match self.parameters.iter().rposition(|known| *known == name) {
                    // The first parameter is `this`.
                    Some(number) => format!("a{}", number.checked_sub(1)?),
                    None => format!("o{}", self.outer_number(name)),
                };
                self.word(word, Number)
            }
            Expression::UnaryOperator { unop, expression } => {
                let (word, of) = match unop {
                    UnOp::Minus(_) => ("neg", Number),
                    UnOp::Not(_) => ("not", Boolean),
                    _ => return None,
                };
                (self.write(expression)? == of).then_some(())?;
                self.word(word.to_owned(), of)
            }
            Expression::BinaryOperator { lhs, binop, rhs } => {
                let (word, of, gives) = match binop {
                    BinOp::Plus(_) => ("+", Number, Number),
                    BinOp::Minus(_) => ("-", Number, Number),
                    BinOp::Star(_) => ("*", Number, Number),
                    BinOp::Slash(_) => ("/", Number, Number),
                    BinOp::DoubleSlash(_) => ("//", Number, Number),
                    BinOp::Percent(_) => ("%", Number, Number),
                    BinOp::LessThan(_) => ("<", Number, Boolean),
                    BinOp::LessThanEqual(_) => ("<=", Number, Boolean),
                    BinOp::GreaterThan(_) => (">", Number, Boolean),
                    BinOp::GreaterThanEqual(_) => (">=", Number, Boolean),
                    BinOp::TwoEqual(_) => ("==", Number, Boolean),
                    BinOp::TildeEqual(_) => ("~=", Number, Boolean),
                    BinOp::And(_) => ("and", Boolean, Boolean),
                    BinOp::Or(_) => ("or", Boolean, Boolean),
                    _ => return None,
                };
                (self.write(lhs)? == of && self.write(rhs)? == of).then_some(())?;
                self.word(word.to_owned(), gives)
            }
            _ => None,
        }
    }

    fn word(&mut self, word: String, of: ValueType) -> Option<ValueType> {
        self.words.push(word);
        Some(of)
    }

    /// Returns the number of a variable outside of the function.
    fn outer_number(&mut self, name: String) -> usize {
        let known = self.outer.iter().position(|known| *known == name);
        known.unwrap_or_else(|| {
            self.outer.push(name);
            self.outer.len() - 1
        })
    }
}

/// Reads a number as Luau writes it.
#[allow(clippy::cast_precision_loss, reason = "Luau rounds integers in the same way")]
fn read_number(text: &str) -> Option<f64> {
    let text = text.replace('_', "").to_ascii_lowercase();
    let in_base = |digits: &str, base: u32| u64::from_str_radix(digits, base).ok().map(|it| it as f64);
    match (text.strip_prefix("0x"), text.strip_prefix("0b")) {
        (Some(digits), _) => in_base(digits, 16),
        (_, Some(digits)) => in_base(digits, 2),
        _ => text.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use full_moon::ast::{Expression, LastStmt};

    use super::*;

    fn condition(function: &str) -> Option<String> {
        text(function, condition_of)
    }

    /// Returns the formulas of a function, and its variables.
    fn text(function: &str, of: impl Fn(&FunctionBody) -> Option<FormulaText>) -> Option<String> {
        let ast = full_moon::parse(&format!("return {function}")).expect("Lua");
        let Some(LastStmt::Return(last)) = ast.nodes().last_stmt() else { return None };
        let Some(Expression::Function(function)) = last.returns().iter().next() else { return None };
        let found = of(function.body())?;
        Some(format!("{}|{}", found.code, found.outer.join(",")))
    }

    #[test]
    fn comparisons_of_parameters_numbers_and_variables_are_conditions() {
        for (function, expected) in [
            ("function(_, n) return n > 0 end", "a0 0 >|"),
            ("function(this, a, b) return a + 2 * b <= limit end", "a0 2 a1 * + o0 <=|limit"),
            (
                "function(_, a) return not (a == -0x10 or a ~= 1_0) and true end",
                "a0 16 neg == a0 10 ~= or not true and|",
            ),
            ("function(_, a) return a % m // 2 == m / 2 end", "a0 o0 % 2 // o0 2 / ==|m"),
            ("function(_, a: number): boolean return a < 1e3 end", "a0 1000 <|"),
            ("function(_, a, a) return a < 1 end", "a1 1 <|"),
            (
                "function(_, n) local m = n + 1 return m > 0 and m < m * q end",
                "a0 1 + 0 > a0 1 + a0 1 + o0 * < and|q",
            ),
            (
                "function(_, n: number) local n: number, q = q, n local q = n / q return q > 1 end",
                "o0 a0 / 1 >|q",
            ),
            (
                "function(_, n) local is_old, this = n > 3, -n return is_old or this < 2 end",
                "a0 3 > a0 neg 2 < or|",
            ),
        ] {
            assert_eq!(condition(function).as_deref(), Some(expected), "{function}");
        }
    }

    #[test]
    fn parameters_of_returned_modules_are_formulas() {
        for (function, expected) in [
            ("function(_, n) return A(n - 1), { B(), C(n, r * n) }, D() end", Some("a0 1 -;a0;o0 a0 *|r")),
            ("function() return A(), B() end", Some("|")),
            (
                "function(_, n) local m = 2 * n local k = m - 1 return A(m), B(k, n) end",
                Some("2 a0 *;2 a0 * 1 -;a0|"),
            ),
            ("function(_, n) local m, k = n return A(m, k) end", None),
            ("function(_, n) local A = n return A(A) end", None),
            ("function(_, n) local m = n, n return A(m) end", None),
            ("function(_, n) local m = f(n) return A(m) end", None),
            ("function(_, n) local m = n > 1 return A(m) end", None),
            ("function(_, n) local m = n + 1 return A(n) end", None),
            ("function(_, n) local m = n local m = 2 return A(m) end", None),
            ("function(_, n) local m = n m = 2 return A(m) end", None),
            ("function(_, n) local m = n return A(m), f().x(m) end", None),
            ("function(_, n) return A(n > 1) end", None),
            ("function(_, n) return A(f(n)) end", None),
            ("function(_, n) return A(n), n end", None),
            ("function(_, n) return A(n):b() end", None),
            ("function(_, n) return A { n } end", None),
            ("function(_, n) return { a = A(n) } end", None),
            ("function(_, n) return nil end", None),
        ] {
            assert_eq!(text(function, production_of).as_deref(), expected, "{function}");
        }
    }

    #[test]
    fn other_functions_are_no_conditions() {
        for function in [
            "function(_, n) return n end",
            "function(_, n) return n > 0 and n end",
            "function(_, n) return this > 0 and n > #n end",
            "function(this, n) return this == n end",
            "function(_, n) return n > f(2) end",
            "function(_, n) return n > t.x end",
            "function(_, n) return n > 0, 1 end",
            "function(_, n) local m = n m += 1 return m > 0 end",
            "function(_, n) local m return n > 0 end",
            "function(this, n) local m = this return m > n end",
            "function(_, n) local m = n > 0 return m > 0 end",
            "function(_, ...) return ... > 0 end",
            "function(_, n) return n == nil end",
            "function(_, n) return n .. 1 == 'a1' end",
            "function(_, n) return n ^ 2 > 3 end",
            "function(_, n) return (n > 0) == true end",
            "function(_, n) if n > 0 then return true end end",
        ] {
            assert_eq!(condition(function), None, "{function}");
        }
        let long = format!("function(_, n) return n > 0{} end", " + n".repeat(40));
        assert_eq!(condition(&long), None);
        let doubled = |times| format!("function(_, n) {}return n > 0 end", "local n = n + n ".repeat(times));
        assert_eq!(condition(&doubled(4)).map(|code| code.split(' ').count()), Some(33));
        assert_eq!(condition(&doubled(6)), None);
        assert_eq!(condition(&doubled(5000)), None);
    }
}
