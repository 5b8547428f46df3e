//! Values and lists of attributes as text.

use std::fmt::Display;
use std::io::{self, Write};

/// Writes an attribute with a list.
pub(super) fn write_list<T: Display>(
    out: &mut impl Write,
    name: &str,
    items: impl Iterator<Item = T>,
) -> io::Result<()> {
    write_items(out, name, items)?;
    writeln!(out)
}

/// Writes an attribute with a value for each point.
pub(super) fn write_vertex_list<T: Display>(
    out: &mut impl Write,
    name: &str,
    items: impl Iterator<Item = T>,
) -> io::Result<()> {
    write_items(out, name, items)?;
    writeln!(out, " (\n            interpolation = \"vertex\"\n        )")
}

fn write_items<T: Display>(
    out: &mut impl Write,
    name: &str,
    items: impl Iterator<Item = T>,
) -> io::Result<()> {
    write!(out, "        {name} = [")?;
    for (index, item) in items.enumerate() {
        out.write_all(if index > 0 { b", " } else { b"" })?;
        write!(out, "{item}")?;
    }
    write!(out, "]")
}

/// Formats numbers in round brackets; -0 becomes 0.
pub(super) fn tuple<'a, T: Copy + Display + Default + std::ops::Add<Output = T> + 'a>(
    numbers: impl IntoIterator<Item = &'a T>,
) -> String {
    let mut text = String::from("(");
    for (index, number) in numbers.into_iter().enumerate() {
        if index > 0 {
            text.push_str(", ");
        }
        text.push_str(&(*number + T::default()).to_string());
    }
    text.push(')');
    text
}

/// Returns `text` as a string of the format. Control characters become spaces.
pub(super) fn quote(text: &str) -> String {
    let mut quote = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quote.extend(['\\', letter]),
            letter if letter.is_control() => quote.push(' '),
            letter => quote.push(letter),
        }
    }
    quote.push('"');
    quote
}
