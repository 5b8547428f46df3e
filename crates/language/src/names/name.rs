//! Description of a name in scripts, and the list of all names.

use std::borrow::Cow;

use burgeon_kit::{Argument, Deprecation, Field};

use crate::form::{CallForm, argument};

/// Text that is static or derived from static text.
type Text = Cow<'static, str>;

/// A name that every script has, or a type that such a name returns.
#[derive(Debug, Clone)]
pub struct Name {
    /// The name, or the display name of a type.
    pub name: Text,
    /// Kind of the name.
    pub sort: NameKind,
    /// Signatures; empty if the name is not a function.
    pub forms: Vec<CallForm>,
    /// Luau type, if the name is not a function.
    pub luau: Text,
    /// Luau type that is accepted instead of this type; empty if none is.
    pub instead: Text,
    /// Luau name of the base type; empty if there is none.
    pub extends: Text,
    /// Description.
    pub doc: Text,
    /// Fields, if values are tables of named fields.
    pub fields: Vec<Field>,
    /// Methods, or functions of a library.
    pub functions: Vec<Name>,
    /// Operators.
    pub operators: Vec<Operator>,
    /// Type of the items if the value is indexed by numbers, as a list is; otherwise empty.
    pub items: Text,
    /// Effect of a call.
    pub effect: Effect,
    /// Deprecation with the replacement, if the name is deprecated.
    pub deprecated: Option<Deprecation>,
}

/// An operator of a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Operator {
    /// Luau name without the underscores: `add`.
    pub name: &'static str,
    /// Type of the second operand; empty for unary operators.
    pub other: &'static str,
    /// Type of the result.
    pub returns: &'static str,
}

/// Kind of a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NameKind {
    /// A global function or value.
    Global,
    /// A function or a library of Luau.
    Luau,
    /// A constructor of modules that the standard library interprets by a method.
    Module {
        /// Object type of the method.
        kind: &'static str,
        /// Name of the method.
        method: &'static str,
    },
    /// A type of values that other names return. Scripts cannot use this name.
    Given,
    /// A method, or a function of a library.
    Function,
}

/// Effect of a call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// No effect except for the use of random numbers. The function calls none of its arguments.
    Pure,
    /// A change of the table that is the first argument, and nothing else.
    ChangesFirst,
    /// Other or unknown effects.
    Other,
}

impl Name {
    pub(super) fn new(name: &'static str, sort: NameKind, doc: &'static str) -> Self {
        let (name, doc) = (Cow::Borrowed(name), Cow::Borrowed(doc));
        let (luau, instead, extends) = (Text::default(), Text::default(), Text::default());
        let (forms, fields, functions) = (Vec::new(), Vec::new(), Vec::new());
        Self {
            name,
            sort,
            forms,
            luau,
            instead,
            extends,
            doc,
            fields,
            functions,
            operators: Vec::new(),
            items: Text::default(),
            effect: Effect::Other,
            deprecated: None,
        }
    }

    /// Creates a global function or value.
    pub(super) fn global(name: &'static str, doc: &'static str) -> Self {
        Self::new(name, NameKind::Global, doc)
    }

    /// Creates a type of returned values, with its Luau type.
    pub(super) fn return_value(name: &'static str, luau: &'static str, doc: &'static str) -> Self {
        Self::new(name, NameKind::Given, doc).luau(luau)
    }

    /// Creates a method, or a function of a library.
    pub(super) fn function(name: &'static str, doc: &'static str) -> Self {
        Self::new(name, NameKind::Function, doc)
    }

    pub(super) fn luau(self, luau: &'static str) -> Self {
        Self { luau: luau.into(), ..self }
    }

    pub(super) fn instead(self, instead: &'static str) -> Self {
        Self { instead: instead.into(), ..self }
    }

    pub(super) fn extends(self, extends: &'static str) -> Self {
        Self { extends: extends.into(), ..self }
    }

    /// Adds a signature with these arguments and a result of type `returns`.
    pub(super) fn form(self, arguments: impl Into<Vec<Argument>>, returns: &str) -> Self {
        self.with_form(CallForm::new(arguments.into(), returns))
    }

    /// Adds a signature in Luau syntax. Text that is not a function type is ignored.
    pub(super) fn read(self, luau: &str) -> Self {
        match CallForm::read(luau) {
            Some(form) => self.with_form(form),
            None => self,
        }
    }

    /// Adds a signature, with the units and defaults from the description.
    fn with_form(mut self, form: CallForm) -> Self {
        let arguments = form.arguments.into_iter().map(|argument| argument.described(&self.doc)).collect();
        self.forms.push(CallForm { arguments, ..form });
        self
    }

    pub(super) fn pure(self) -> Self {
        Self { effect: Effect::Pure, ..self }
    }

    pub(super) fn fields(self, fields: impl Into<Vec<Field>>) -> Self {
        Self { fields: fields.into(), ..self }
    }

    pub(super) fn functions(self, functions: impl Into<Vec<Name>>) -> Self {
        Self { functions: functions.into(), ..self }
    }

    pub(super) fn operators(self, operators: impl Into<Vec<Operator>>) -> Self {
        Self { operators: operators.into(), ..self }
    }

    pub(super) fn items(self, items: &'static str) -> Self {
        Self { items: items.into(), ..self }
    }

    /// Returns true if the Luau type has a parameter, like `System<T>`.
    pub fn is_generic(&self) -> bool {
        self.luau.ends_with("<T>")
    }

    /// Returns the fields of the options table of the last signature.
    pub fn options(&self) -> impl Iterator<Item = &Field> {
        self.forms.last().into_iter().flat_map(|form| &form.arguments).flat_map(|argument| &argument.fields)
    }

    /// Returns the names of the options, fields and functions.
    pub fn part_names(&self) -> Vec<&str> {
        let fields = self.options().chain(&self.fields).map(|field| &*field.name);
        fields.chain(self.functions.iter().map(|function| &*function.name)).collect()
    }

    /// Returns the method or function called `name`.
    pub fn find(&self, name: &str) -> Option<&Self> {
        self.functions.iter().find(|function| function.name == name)
    }
}

/// Returns the argument for a table of options.
pub(super) fn options(luau: &str, fields: impl Into<Vec<Field>>) -> Argument {
    Argument { fields: fields.into(), ..argument("options", luau) }
}

/// Creates an optional field with a default.
pub(super) fn field(name: &'static str, luau: &str, default: &str, doc: &'static str) -> Field {
    Field { default: default.to_owned(), ..Field::new(name, luau, doc) }
}
