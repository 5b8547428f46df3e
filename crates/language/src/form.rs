//! How a function is called: its arguments, one after the other, and what it gives.

use burgeon_kit::Argument;

/// One form of calling a function; some have several, with arguments of other kinds.
#[derive(Debug, Clone, Default)]
pub struct CallForm {
    /// Its arguments. The name of the last one is `...` where there may be any number, each of that type.
    pub arguments: Vec<Argument>,
    /// The type of what it gives in Luau; `()` for nothing.
    pub returns: String,
}

/// An argument called `name`, of type `luau`; one whose type ends with `?` may be left out.
pub fn argument(name: &'static str, luau: &str) -> Argument {
    Argument::typed(name, luau)
}

impl CallForm {
    /// A form with these arguments, which gives a value of type `returns`.
    pub fn new(arguments: Vec<Argument>, returns: &str) -> Self {
        Self { arguments, returns: returns.to_owned() }
    }

    /// Reads a function's type as Luau writes it, `(a: number, b: number?) -> number`. `None` if it is none.
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
        Some(Self { arguments: arguments.collect(), returns: returns.to_owned() })
    }

    /// The argument at this place, counted from 0.
    pub fn argument(&self, place: usize) -> Option<&Argument> {
        match self.arguments.get(place) {
            Some(argument) => Some(argument),
            None => self.arguments.last().filter(|last| last.name == "..."),
        }
    }

    /// How many arguments must be given.
    pub fn least(&self) -> usize {
        let must = |argument: &&Argument| argument.name != "..." && !may_be_left_out(&argument.luau);
        self.arguments.iter().rposition(|argument| must(&argument)).map_or(0, |last| last + 1)
    }

    /// How many arguments may be given; `None` for any number.
    pub fn most(&self) -> Option<usize> {
        (self.arguments.last().is_none_or(|last| last.name != "...")).then_some(self.arguments.len())
    }
}

impl std::fmt::Display for CallForm {
    /// As Luau writes a function's type, with what each argument is if it is left out.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("(")?;
        for (index, Argument { name, luau, default, .. }) in self.arguments.iter().enumerate() {
            f.write_str(if index > 0 { ", " } else { "" })?;
            match &**name {
                "..." => write!(f, "...{luau}")?,
                name => write!(f, "{name}: {luau}")?,
            }
            if !default.is_empty() && default != "nil" {
                write!(f, " = {default}")?;
            }
        }
        write!(f, ")")?;
        if self.returns.is_empty() { Ok(()) } else { write!(f, " -> {}", self.returns) }
    }
}

/// Whether a value of this type may be left out.
pub(crate) fn may_be_left_out(luau: &str) -> bool {
    luau.ends_with('?') || luau == "any"
}

/// Whether `text` could be a name.
pub(crate) fn is_name(text: &str) -> bool {
    text == "..."
        || text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Where the bracket ends that was opened before `text`.
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

/// The parts of `text` between commas that stand in no brackets.
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
