//! Luau types, as far as literal values in a script can be checked against them.

use std::borrow::Cow;

/// Type of an argument or a field, which borrows names from the text of the type.
#[derive(Debug, Clone, PartialEq)]
pub enum LuauType<'a> {
    /// Any value.
    Any,
    /// The type of `nil`.
    Nil,
    /// `number`, `string`, `boolean`, or the name of a type that is declared elsewhere.
    Named(Cow<'a, str>),
    /// The type of a single string.
    Text(&'a str),
    /// A union of types.
    Union(Vec<Self>),
    /// A list with items of a type.
    List(Box<Self>),
    /// A table with keys other than names.
    Map,
    /// A table with these fields.
    Table(Vec<(&'a str, Self)>),
    /// A function type, as text.
    Function(&'a str),
}

/// A value in the source text of a script, known without running it.
#[derive(Debug, Clone, PartialEq)]
pub enum Literal {
    /// `nil`.
    Nil,
    /// `true` or `false`.
    Boolean,
    /// A number.
    Number,
    /// A string with its content.
    Text(String),
    /// A table constructor.
    Table,
    /// A function expression.
    Function,
    /// An object, with the Luau name of its type.
    Object(Cow<'static, str>),
}

impl<'a> LuauType<'a> {
    /// Parses a type. Unsupported syntax results in [`LuauType::Any`].
    pub fn read(text: &'a str) -> Self {
        let mut reader = Reader { rest: text };
        let found = reader.union();
        if reader.rest.trim().is_empty() { found.unwrap_or(Self::Any) } else { Self::Any }
    }

    /// Returns true if `literal` can be a value of this type. `known` resolves a named type: an object type resolves to
    /// itself. An unknown name resolves to `None` and accepts any value.
    ///
    /// ```
    /// use burgeon_language::{Literal, LuauType};
    ///
    /// let side = LuauType::read("number | \"left\" | \"right\"");
    /// let accepts = |literal| side.accepts(&literal, &|_| None);
    /// assert!(accepts(Literal::Number) && accepts(Literal::Text("left".into())));
    /// assert!(!accepts(Literal::Text("top".into())) && !accepts(Literal::Nil));
    /// ```
    pub fn accepts(&self, literal: &Literal, known: &dyn Fn(&str) -> Option<LuauType<'_>>) -> bool {
        match self {
            Self::Any => true,
            Self::Nil => *literal == Literal::Nil,
            Self::Text(text) => matches!(literal, Literal::Text(given) if given == text),
            Self::Union(of) => of.iter().any(|of| of.accepts(literal, known)),
            Self::List(_) | Self::Map | Self::Table(_) => *literal == Literal::Table,
            Self::Function(_) => matches!(literal, Literal::Function | Literal::Object(_)),
            Self::Named(name) => match (&**name, literal) {
                ("number", _) => *literal == Literal::Number,
                ("boolean", _) => *literal == Literal::Boolean,
                ("string", _) => matches!(literal, Literal::Text(_)),
                // A literal cannot be a buffer.
                ("buffer", _) => false,
                (name, Literal::Object(given)) if name == given => true,
                (name, _) => known(name).is_none_or(|stands_for| {
                    !matches!(&stands_for, LuauType::Named(same) if same == name)
                        && stands_for.accepts(literal, known)
                }),
            },
        }
    }

    /// Returns the type of the items, if the type is a list or a union with a list.
    ///
    /// ```
    /// use burgeon_language::LuauType;
    ///
    /// let places = LuauType::read("{ { x: number, y: number } }?");
    /// let fields = places.item().and_then(LuauType::fields).expect("a list of tables");
    /// assert_eq!(fields[1], ("y".into(), LuauType::Named("number".into())));
    /// ```
    pub fn item(&self) -> Option<&Self> {
        match self {
            Self::List(item) => Some(item),
            Self::Union(of) => of.iter().find_map(Self::item),
            _ => None,
        }
    }

    /// Returns the fields, if the type is a table or a union with a table.
    pub fn fields(&self) -> Option<&[(&'a str, Self)]> {
        match self {
            Self::Table(fields) => Some(fields),
            Self::Union(of) => of.iter().find_map(Self::fields),
            _ => None,
        }
    }
}

struct Reader<'a> {
    rest: &'a str,
}

impl<'a> Reader<'a> {
    fn take(&mut self, what: &str) -> bool {
        let rest = self.rest.trim_start();
        let found = rest.strip_prefix(what);
        self.rest = found.unwrap_or(rest);
        found.is_some()
    }

    fn name(&mut self) -> Option<&'a str> {
        let rest = self.rest.trim_start();
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
        let (name, rest) = rest.split_at(end);
        self.rest = rest;
        (!name.is_empty()).then_some(name)
    }

    fn union(&mut self) -> Option<LuauType<'a>> {
        let mut of = vec![self.optional()?];
        while self.take("|") {
            of.push(self.optional()?);
        }
        Some(if of.len() == 1 { of.remove(0) } else { LuauType::Union(of) })
    }

    fn optional(&mut self) -> Option<LuauType<'a>> {
        let mut found = self.single()?;
        while self.take("?") {
            found = LuauType::Union(vec![found, LuauType::Nil]);
        }
        Some(found)
    }

    fn single(&mut self) -> Option<LuauType<'a>> {
        let begin = self.rest.trim_start();
        if self.take("(") {
            return self.bracket(begin);
        }
        if self.take("{") {
            return self.table();
        }
        if self.take("\"") {
            let (text, rest) = self.rest.split_once('"')?;
            self.rest = rest;
            return Some(LuauType::Text(text));
        }
        let name = self.name()?;
        if self.take("<") {
            self.union()?;
            return self.take(">").then_some(LuauType::Any);
        }
        Some(match name {
            "any" | "unknown" => LuauType::Any,
            "nil" => LuauType::Nil,
            // `T` is the type of a system's object.
            "T" => LuauType::Any,
            _ => LuauType::Named(Cow::Borrowed(name)),
        })
    }

    /// Parses a function type or a type in brackets, after the opening bracket, with which `begin` starts.
    fn bracket(&mut self, begin: &'a str) -> Option<LuauType<'a>> {
        let mut inner = Vec::new();
        while !self.take(")") {
            let before = self.rest;
            let named = self.name().is_some() && self.take(":");
            if !named {
                self.rest = before;
            }
            self.take("...");
            inner.push(self.union()?);
            self.take(",");
        }
        if self.take("->") {
            self.take("...");
            self.union()?;
            let text = &begin[..begin.len() - self.rest.len()];
            return Some(LuauType::Function(text.trim_end()));
        }
        if inner.len() == 1 { inner.pop() } else { Some(LuauType::Any) }
    }

    fn table(&mut self) -> Option<LuauType<'a>> {
        if self.take("[") {
            self.union()?;
            if !self.take("]") || !self.take(":") {
                return None;
            }
            self.union()?;
            return self.take("}").then_some(LuauType::Map);
        }
        if self.take("...") {
            return self.take("}").then_some(LuauType::Map);
        }
        let mut fields = Vec::new();
        while !self.take("}") {
            let before = self.rest;
            if let Some(name) = self.name()
                && self.take(":")
            {
                fields.push((name, self.union()?));
                self.take(",");
                continue;
            }
            self.rest = before;
            let item = self.union()?;
            return self.take("}").then(|| LuauType::List(Box::new(item)));
        }
        Some(LuauType::Table(fields))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_held_against_types() {
        let text = |text: &str| Literal::Text(text.to_owned());
        fn known(name: &str) -> Option<LuauType<'_>> {
            match name {
                "Color" => Some(LuauType::read("string | { number }")),
                "Model" => Some(LuauType::Named(Cow::Borrowed("Model"))),
                _ => None,
            }
        }
        let accepts = |luau: &str, literal: &Literal| LuauType::read(luau).accepts(literal, &known);
        for (luau, literal) in [
            ("number", Literal::Number),
            ("number?", Literal::Nil),
            ("number | { number }", Literal::Table),
            ("{ level: number?, color: Color? }", Literal::Table),
            ("{ [number]: { string } }", Literal::Table),
            ("Color", text("red")),
            ("Color?", Literal::Table),
            ("\"last\"?", text("last")),
            ("any", Literal::Function),
            ("((this: T, ...any) -> boolean)?", Literal::Function),
            ("Unheard", Literal::Number),
            ("Model", Literal::Object(Cow::Borrowed("Model"))),
            ("System<T>", Literal::Table),
        ] {
            assert!(accepts(luau, &literal), "{luau}: {literal:?}");
        }
        for (luau, literal) in [
            ("number", text("3")),
            ("number", Literal::Nil),
            ("number | { number }", text("wide")),
            ("Color", Literal::Number),
            ("\"last\"?", text("first")),
            ("Model?", Literal::Table),
            ("Model?", Literal::Object(Cow::Borrowed("Template"))),
            ("(a: number) -> number", Literal::Number),
            ("boolean", Literal::Number),
        ] {
            assert!(!accepts(luau, &literal), "{luau}: {literal:?}");
        }
    }

    #[test]
    fn a_type_tells_its_parts() {
        let list = LuauType::read("{ { number } }?");
        assert_eq!(list.item(), Some(&LuauType::read("{ number }")));
        let table = LuauType::read("number | { level: number?, color: Color? }?");
        assert_eq!(table.fields().map(<[_]>::len), Some(2));
    }
}
