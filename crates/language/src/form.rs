//! Signatures of functions: their arguments and results.

use burgeon_kit::Argument;

/// A signature of a function. Some functions have several with different arguments.
#[derive(Debug, Clone, Default)]
pub struct CallForm {
    /// Arguments. If the last one is called `...`, any number of arguments of its type can follow.
    pub arguments: Vec<Argument>,
    /// Luau type of the result; `()` if there is none.
    pub returns: String,
}

/// A view of the arguments of a signature.
#[derive(Debug, Clone, Copy)]
pub struct ArgumentList<'a>(pub &'a [Argument]);

impl<'a> ArgumentList<'a> {
    /// Returns the arguments of each signature.
    pub fn of_all(forms: &'a [CallForm]) -> Vec<Self> {
        forms.iter().map(|form| ArgumentList(&form.arguments)).collect()
    }

    /// Returns the argument at a position, counted from 0.
    pub fn argument(self, place: usize) -> Option<&'a Argument> {
        match self.0.get(place) {
            Some(argument) => Some(argument),
            None => self.0.last().filter(|last| last.name == "..."),
        }
    }

    /// Returns the minimum number of arguments.
    pub fn least(&self) -> usize {
        let must = |argument: &&Argument| argument.name != "..." && !may_be_left_out(&argument.luau);
        self.0.iter().rposition(|argument| must(&argument)).map_or(0, |last| last + 1)
    }

    /// Returns the maximum number of arguments; `None` for any number.
    pub fn most(&self) -> Option<usize> {
        (self.0.last().is_none_or(|last| last.name != "...")).then_some(self.0.len())
    }
}

impl std::fmt::Display for ArgumentList<'_> {
    /// Writes the arguments of a function type in Luau syntax, with their defaults.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("(")?;
        for (index, Argument { name, luau, default, .. }) in self.0.iter().enumerate() {
            f.write_str(if index > 0 { ", " } else { "" })?;
            match &**name {
                "..." => write!(f, "...{luau}")?,
                name => write!(f, "{name}: {luau}")?,
            }
            if !default.is_empty() && default != "nil" {
                write!(f, " = {default}")?;
            }
        }
        f.write_str(")")
    }
}

/// Creates an argument called `name` of type `luau`; a type that ends with `?` makes it optional.
pub fn argument(name: &'static str, luau: &str) -> Argument {
    Argument::typed(name, luau)
}

impl CallForm {
    /// Creates a signature with these arguments and a result of type `returns`.
    pub fn new(arguments: Vec<Argument>, returns: &str) -> Self {
        Self { arguments, returns: returns.to_owned() }
    }

    /// Parses a function type in Luau syntax: `(a: number, b: number?) -> number`. `None` if the text is not a function
    /// type.
    ///
    /// ```
    /// use burgeon_language::CallForm;
    ///
    /// let form = CallForm::read("(text: string, width: number?) -> string").expect("a function type");
    /// assert_eq!((form.least(), form.most(), &*form.returns), (1, Some(2), "string"));
    /// assert_eq!(form.argument(1).map(|argument| &*argument.name), Some("width"));
    /// assert!(CallForm::read("number").is_none());
    /// ```
    pub fn read(text: &str) -> Option<Self> {
        let inner = text.trim().strip_prefix('(')?;
        let end = closing(inner)?;
        let returns = inner[end + 1..].trim().strip_prefix("->").map_or("any", str::trim);
        let arguments = parts(&inner[..end]).into_iter().map(|part| {
            let (name, luau) = match part.split_once(':') {
                Some((name, luau)) if is_name(name.trim()) => (name.trim(), luau.trim()),
                _ if part == "..." => ("...", "any"),
                _ => ("...", part.trim_start_matches("...")),
            };
            Argument::typed(name.to_owned(), luau)
        });
        Some(Self::new(arguments.collect(), returns))
    }

    /// Returns the argument at a position, counted from 0.
    pub fn argument(&self, place: usize) -> Option<&Argument> {
        ArgumentList(&self.arguments).argument(place)
    }

    /// Returns the minimum number of arguments.
    pub fn least(&self) -> usize {
        ArgumentList(&self.arguments).least()
    }

    /// Returns the maximum number of arguments; `None` for any number.
    pub fn most(&self) -> Option<usize> {
        ArgumentList(&self.arguments).most()
    }
}

impl std::fmt::Display for CallForm {
    /// Writes a function type in Luau syntax, with the defaults of the arguments.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", ArgumentList(&self.arguments))?;
        if self.returns.is_empty() { Ok(()) } else { write!(f, " -> {}", self.returns) }
    }
}

/// Returns true if a value of this type is optional.
pub(crate) fn may_be_left_out(luau: &str) -> bool {
    luau.ends_with('?') || luau == "any"
}

/// Returns true if `text` is a valid name or `...`.
pub(crate) fn is_name(text: &str) -> bool {
    text == "..."
        || text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Returns the position of the bracket that closes one opened before `text`.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0;
    text.char_indices().find_map(|(at, letter)| {
        depth += match letter {
            '(' | '{' => 1,
            ')' | '}' => -1,
            _ => 0,
        };
        (depth < 0).then_some(at)
    })
}

/// Splits `text` at the commas outside of brackets.
fn parts(text: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let (mut depth, mut begin) = (0, 0);
    for (at, letter) in text.char_indices() {
        match letter {
            '(' | '{' => depth += 1,
            ')' | '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(text[begin..at].trim());
                begin = at + 1;
            }
            _ => {}
        }
    }
    parts.push(text[begin..].trim());
    parts.retain(|part| !part.is_empty());
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_form_is_read_as_it_is_written() {
        for text in [
            "() -> number",
            "(a: number, b: number?) -> number",
            "(list: { any }, compare: ((a: any, b: any) -> boolean)?) -> ()",
            "(name: string, ...string) -> (...any) -> Module",
            "(call: (...any) -> ...any, ...any) -> (boolean, ...any)",
        ] {
            let form = CallForm::read(text).expect(text);
            assert_eq!(form.to_string(), text);
        }
        assert!(CallForm::read("number").is_none() && CallForm::read("(a: number").is_none());
    }

    #[test]
    fn a_form_tells_how_many_arguments_it_takes() {
        let counts = |text: &str| {
            let form = CallForm::read(text).expect(text);
            (form.least(), form.most())
        };
        assert_eq!(counts("() -> ()"), (0, Some(0)));
        assert_eq!(counts("(a: number, b: number?) -> ()"), (1, Some(2)));
        assert_eq!(counts("(a: number?, b: number) -> ()"), (2, Some(2)));
        assert_eq!(counts("(a: string, ...string) -> ()"), (1, None));
    }
}
