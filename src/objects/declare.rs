//! How an object type says what scripts can do with it: said once, in the type's own file.

use super::{Boxed, Object, Table, Value};
use crate::error::{Error, Result};

/// A type of object.
pub struct Kind {
    /// Its name in scripts, which is also its constructor's.
    pub name: &'static str,
    /// What it is; the first line is a summary.
    pub doc: &'static str,
    /// What its constructor takes.
    pub fields: &'static [Field],
    /// The field that may be given before the table, as `geometry` in `footprint(geometry, { ... })`.
    pub first: Option<&'static str>,
    /// What scripts may call.
    pub methods: &'static [Method],
    /// Makes one from the constructor's table.
    pub construct: fn(&Table) -> Result<Box<dyn Object>>,
}

/// A field of a constructor's table.
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// What it means, with the unit.
    pub doc: &'static str,
    /// Its type in Luau.
    pub luau: fn() -> String,
    /// The value where it is left out, as one would write it.
    pub default: fn() -> String,
}

/// A method that scripts may call.
pub struct Method {
    /// Its name.
    pub name: &'static str,
    /// What it does; the first sentence is its help.
    pub doc: &'static str,
    /// Its arguments, `self` not counted.
    pub arguments: &'static [Argument],
    /// The type of its result in Luau; empty where it returns the object itself.
    pub returns: fn() -> String,
    /// The function.
    pub call: Call,
}

/// An argument of a method.
pub struct Argument {
    /// Its name.
    pub name: &'static str,
    /// Its type in Luau.
    pub luau: fn() -> String,
}

/// Calls a method by itself.
pub type Read = fn(&dyn Object, &[Value]) -> Result<Value>;
/// Calls a method that changes the object.
pub type Write = fn(&mut dyn Object, &[Value]) -> Result<Value>;
/// Calls a method that changes the object and takes only numbers.
pub type WriteNumbers = fn(&mut dyn Object, &[f64]) -> Result<()>;

/// How a method is called.
pub enum Call {
    /// It only reads, so rules may call it.
    Read(Read),
    /// It changes the object, so only interpretation rules may call it.
    Write {
        /// With any values.
        values: Write,
        /// With numbers only, where all its arguments are numbers: the fast way.
        numbers: Option<WriteNumbers>,
    },
}

impl std::fmt::Debug for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Kind").field(&self.name).finish()
    }
}

impl Kind {
    /// The method called `name`.
    pub fn method(&self, name: &str) -> Option<&'static Method> {
        self.methods.iter().find(|method| method.name == name)
    }

    /// The error for a name that is no method, with the nearest one that is.
    pub fn unknown_method(&self, name: &str) -> Error {
        let names: Vec<&str> = self.methods.iter().map(|method| method.name).collect();
        let message = format!("{} has no method or field called {name}", self.name);
        Error::not_found("method", name, names.iter().copied(), message)
            .help(format!("it has {}", names.join(", ")))
    }
}

/// Refuses entries of `table` that `fields` does not name.
pub fn refuse_unknown(kind: &str, fields: &[Field], table: &Table) -> Result<()> {
    for (key, value) in &table.entries {
        let super::Key::Name(name) = key else {
            return Err(Error::argument(format!(
                "{kind} takes named fields, but was given {value} without a name"
            ))
            .help(format!("write {kind} {{ {} = {value} }}", fields.first().map_or("name", |f| f.name)))
            .of_script());
        };
        if !fields.iter().any(|field| field.name == &**name) {
            let names: Vec<&str> = fields.iter().map(|field| field.name).collect();
            let message = format!("{kind} has no field called {name}");
            return Err(Error::not_found("field", name, names.iter().copied(), message)
                .help(format!("it has {}", names.join(", ")))
                .of_script());
        }
    }
    Ok(())
}

/// Declares the table that a constructor takes: a struct with documented, defaulted fields.
///
/// Gives the struct, its `Default`, `FIELDS` and `from_table`, which refuses unknown names and wrong types.
#[macro_export]
macro_rules! fields {
    (
        $(#[doc = $doc:literal])+
        pub struct $options:ident for $kind:literal {
            $( $(#[doc = $field_doc:literal])+ pub $field:ident: $type:ty = $default:expr, )*
        }
    ) => {
        $(#[doc = $doc])+
        #[derive(Debug, Clone)]
        pub struct $options {
            $( $(#[doc = $field_doc])+ pub $field: $type, )*
        }

        impl Default for $options {
            fn default() -> Self {
                Self { $( $field: $default, )* }
            }
        }

        impl $options {
            /// The fields, for documentation.
            pub const FIELDS: &'static [$crate::objects::Field] = &[$(
                $crate::objects::Field {
                    name: stringify!($field),
                    doc: concat!($($field_doc, "\n"),+),
                    luau: <$type as $crate::objects::Parameter>::luau,
                    default: || {
                        let value: $type = $default;
                        $crate::objects::Parameter::into_value(value).to_string()
                    },
                },
            )*];

            /// Reads a constructor's table.
            pub fn from_table(table: &$crate::objects::Table) -> $crate::error::Result<Self> {
                $crate::objects::declare::refuse_unknown($kind, Self::FIELDS, table)?;
                let mut options = Self::default();
                $(
                    if let Some(value) = table.get(stringify!($field)) {
                        options.$field = $crate::objects::Parameter::from_value(value.clone())
                            .map_err(|expected| expected.refuse($kind, stringify!($field), value))?;
                    }
                )*
                Ok(options)
            }
        }
    };
}

/// Declares the methods of an object type: an `impl` block whose methods scripts can call.
///
/// Gives the methods and `METHODS`. `&self` methods may be called while rewriting, `&mut self` ones while
/// interpreting.
#[macro_export]
macro_rules! methods {
    ($object:ident = $kind:literal { $($body:tt)* }) => {
        $crate::methods!(@next $object $kind [] $($body)*);
    };
    (@next $object:ident $kind:literal [$($info:expr,)*]) => {
        impl $object {
            /// The methods that scripts can call.
            pub const METHODS: &'static [$crate::objects::Method] = &[$($info,)*];
        }
    };
    (
        @next $object:ident $kind:literal [$($info:expr,)*]
        $(#[doc = $doc:literal])+
        pub fn $method:ident(&mut $this:ident $(, $argument:ident: $type:ty)* $(,)?) $(-> $answer:ty)? $body:block
        $($rest:tt)*
    ) => {
        impl $object {
            $(#[doc = $doc])+
            pub fn $method(&mut $this $(, $argument: $type)*) $(-> $answer)? $body
        }
        $crate::methods!(@next $object $kind [$($info,)* $crate::objects::Method {
            name: stringify!($method),
            doc: concat!($($doc, "\n"),+),
            arguments: &[$(
                $crate::objects::Argument {
                    name: stringify!($argument),
                    luau: <$type as $crate::objects::Parameter>::luau,
                },
            )*],
            returns: <$crate::methods!(@answer $($answer)?) as $crate::objects::Answer>::luau,
            call: $crate::objects::Call::Write {
                values: |object, arguments| {
                    let object = $crate::objects::declare::downcast_mut::<$object>(object)?;
                    #[allow(unused_mut, reason = "a method may take no arguments")]
                    let mut arguments = $crate::objects::declare::Arguments::new($kind, stringify!($method), arguments);
                    $( let $argument: $type = arguments.next(stringify!($argument))?; )*
                    arguments.end()?;
                    $crate::objects::Answer::answer(object.$method($($argument),*))
                },
                numbers: if true $(&& <$type as $crate::objects::Parameter>::IS_NUMBER)* {
                    Some(|object, numbers| {
                        let object = $crate::objects::declare::downcast_mut::<$object>(object)?;
                        #[allow(unused_mut, reason = "a method may take no arguments")]
                        let mut numbers = $crate::objects::declare::Numbers::new($kind, stringify!($method), numbers);
                        $( let $argument: $type = numbers.next(stringify!($argument))?; )*
                        numbers.end();
                        $crate::objects::Answer::answer(object.$method($($argument),*)).map(|_| ())
                    })
                } else {
                    None
                },
            },
        },] $($rest)*);
    };
    (
        @next $object:ident $kind:literal [$($info:expr,)*]
        $(#[doc = $doc:literal])+
        pub fn $method:ident(&$this:ident $(, $argument:ident: $type:ty)* $(,)?) $(-> $answer:ty)? $body:block
        $($rest:tt)*
    ) => {
        impl $object {
            $(#[doc = $doc])+
            pub fn $method(&$this $(, $argument: $type)*) $(-> $answer)? $body
        }
        $crate::methods!(@next $object $kind [$($info,)* $crate::objects::Method {
            name: stringify!($method),
            doc: concat!($($doc, "\n"),+),
            arguments: &[$(
                $crate::objects::Argument {
                    name: stringify!($argument),
                    luau: <$type as $crate::objects::Parameter>::luau,
                },
            )*],
            returns: <$crate::methods!(@answer $($answer)?) as $crate::objects::Answer>::luau,
            call: $crate::objects::Call::Read(|object, arguments| {
                let object = $crate::objects::declare::downcast_ref::<$object>(object)?;
                #[allow(unused_mut, reason = "a method may take no arguments")]
                let mut arguments = $crate::objects::declare::Arguments::new($kind, stringify!($method), arguments);
                $( let $argument: $type = arguments.next(stringify!($argument))?; )*
                arguments.end()?;
                $crate::objects::Answer::answer(object.$method($($argument),*))
            }),
        },] $($rest)*);
    };
    (@answer) => { () };
    (@answer $answer:ty) => { $answer };
}

/// The arguments of a call, taken one after the other. For [`methods!`](crate::methods).
pub struct Arguments<'a> {
    kind: &'static str,
    method: &'static str,
    values: &'a [Value],
    taken: usize,
}

impl<'a> Arguments<'a> {
    pub fn new(kind: &'static str, method: &'static str, values: &'a [Value]) -> Self {
        Self { kind, method, values, taken: 0 }
    }

    pub fn next<T: super::Parameter>(&mut self, name: &str) -> Result<T> {
        let value = self.values.get(self.taken).cloned().unwrap_or(Value::Nil);
        self.taken += 1;
        T::from_value(value.clone())
            .map_err(|expected| expected.refuse(&format!("{}:{}", self.kind, self.method), name, &value))
    }

    pub fn end(&self) -> Result<()> {
        if self.values.len() > self.taken {
            return Err(Error::argument(format!(
                "{}:{} takes {} arguments, not {}",
                self.kind,
                self.method,
                self.taken,
                self.values.len()
            ))
            .of_script());
        }
        Ok(())
    }
}

/// The arguments of a call that takes only numbers.
pub struct Numbers<'a> {
    kind: &'static str,
    method: &'static str,
    numbers: &'a [f64],
    taken: usize,
}

impl<'a> Numbers<'a> {
    pub fn new(kind: &'static str, method: &'static str, numbers: &'a [f64]) -> Self {
        Self { kind, method, numbers, taken: 0 }
    }

    #[inline]
    pub fn next<T: super::Parameter>(&mut self, name: &str) -> Result<T> {
        let number = self.numbers.get(self.taken).copied().unwrap_or(f64::NAN);
        self.taken += 1;
        match T::from_number(number) {
            Some(value) => Ok(value),
            None => self.refuse::<T>(name, number),
        }
    }

    #[cold]
    fn refuse<T: super::Parameter>(&self, name: &str, number: f64) -> Result<T> {
        let value = match Boxed::unpack(number) {
            Boxed::Number(number) => Value::Number(number),
            Boxed::Boolean(value) => Value::Boolean(value),
            Boxed::Nil => Value::Nil,
            Boxed::Handle(_) => Value::Table(std::sync::Arc::default()),
        };
        T::from_value(value.clone())
            .map_err(|expected| expected.refuse(&format!("{}:{}", self.kind, self.method), name, &value))
    }

    /// Ends the reading of arguments; their number was checked before.
    #[allow(clippy::unused_self, reason = "mirrors Arguments::end")]
    pub fn end(&self) {}
}

pub fn downcast_ref<T: Object>(object: &dyn Object) -> Result<&T> {
    let any: &dyn std::any::Any = object;
    any.downcast_ref().ok_or_else(wrong_type)
}

#[inline]
pub fn downcast_mut<T: Object>(object: &mut dyn Object) -> Result<&mut T> {
    let any: &mut dyn std::any::Any = object;
    any.downcast_mut().ok_or_else(wrong_type)
}

#[cold]
fn wrong_type() -> Error {
    Error::script("the method belongs to another type of object")
        .help("call it with a colon: this:method()")
        .of_script()
}
