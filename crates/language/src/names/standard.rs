//! Names of the standard library, read from its source file. The `---` lines above a declaration are its description.

use burgeon_kit::Argument;

use super::name::{Name, NameKind};
use crate::form::{CallForm, argument};

/// Source text of the standard library.
const TEXT: &str = include_str!("../../../../stdlib.lua");

/// Returns the names that the library exports, in the order of the file.
pub(super) fn names() -> Vec<Name> {
    let lines: Vec<&'static str> = TEXT.lines().collect();
    let mut names = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        if let Some(module) = module(line).or_else(|| plain_module(line, &lines[..at])) {
            names.push(module);
        } else if let Some((name, form)) = function(line)
            && is_given(name)
        {
            let doc = doc(&lines[..at]);
            let name = Name { doc: doc.into(), ..Name::global(name, "") };
            let name = name.form(form.arguments, &form.returns);
            names.push(comment_above(&lines[..at]).into_iter().fold(name, Name::read).pure());
        } else if let Some(name) = line.strip_prefix("local ").and_then(|rest| rest.strip_suffix(" = {"))
            && is_given(name)
        {
            let doc = doc(&lines[..at]).into();
            names.push(Name { doc, ..Name::global(name, "") }.functions(curves(&lines[at + 1..])).pure());
        }
    }
    names
}

/// Returns the functions of a table of curves, each declared in its own line.
fn curves(lines: &[&'static str]) -> Vec<Name> {
    let within = lines.iter().take_while(|line| **line != "}");
    let names = within.filter_map(|line| line.strip_prefix("  ")?.split_once(" = curve(\""));
    let names = names.filter_map(|(_, rest)| Some(rest.split_once('"')?.0));
    let curve = |name| {
        let function =
            Name::function(name, "Returns the value of an easing curve from 0 to 1, as t goes from 0 to 1.");
        function.form([argument("t", "number")], "number").pure()
    };
    names.map(curve).collect()
}

/// Returns the lines of description before a declaration.
fn comment_above<'a>(before: &[&'a str]) -> Vec<&'a str> {
    let lines = before.iter().rev().map_while(|line| line.strip_prefix("---"));
    let mut lines: Vec<&str> = lines.map(str::trim).collect();
    lines.reverse();
    lines
}

/// Returns the description before a declaration. Lines with types in it are additional signatures and are skipped.
fn doc(before: &[&str]) -> String {
    let mut lines = comment_above(before);
    lines.retain(|line| !line.starts_with('('));
    lines.join(" ")
}

/// Parses the name and signature of a local function.
fn function(line: &'static str) -> Option<(&'static str, CallForm)> {
    let (name, _) = line.strip_prefix("local function ")?.split_once('(')?;
    let (parameters, returns) = line.split_once('(')?.1.rsplit_once(')')?;
    let returns = returns.strip_prefix(": ").unwrap_or("any");
    Some((name, CallForm::read(&format!("({parameters}) -> {returns}"))?))
}

/// Returns true if the library exports a value of this name.
fn is_given(name: &str) -> bool {
    TEXT.lines()
        .any(|line| line.strip_prefix("names.").and_then(|rest| rest.split_once(" = ")) == Some((name, name)))
}

/// Parses a module that a method of an object type interprets.
fn module(line: &'static str) -> Option<Name> {
    let mut texts = line.split('"').skip(1).step_by(2);
    // The first word of the helper's name is the object type.
    let helper = line.split_once("_module(").map(|(kind, _)| kind);
    let helper = helper.filter(|kind| kind.bytes().all(|byte| byte.is_ascii_lowercase()));
    let (name, kind, method, parameters) = if let Some(kind) = helper {
        let (name, method) = (texts.next()?, texts.next()?);
        (name, kind, method, texts.next())
    } else if line.starts_with("__interpretation(") {
        let (kind, name, method) = (texts.next()?, texts.next()?, texts.next()?);
        // Later lines are for other object types, which interpret the module alike.
        let is_of =
            |other: &&str| other.starts_with("__interpretation(") && other.split('"').nth(3) == Some(name);
        if TEXT.lines().find(is_of) != Some(line) {
            return None;
        }
        (name, kind, method, None)
    } else {
        return None;
    };
    // A separate line declares a module with more than one parameter.
    let declared =
        TEXT.lines().find_map(|line| line.strip_prefix(&format!("names.{name} = module(\"{name}\", ")));
    let parameters: Vec<&str> = match declared {
        Some(declared) => declared.split('"').skip(1).step_by(2).collect(),
        None => parameters.into_iter().collect(),
    };
    let parameters: Vec<Argument> = parameters.into_iter().map(parameter_argument).collect();
    let doc = format!("Interpreted as a call of {kind}:{method}.");
    let name = Name::new(name, NameKind::Module { kind, method }, "").form(parameters, "Module");
    Some(Name { doc: doc.into(), ..name })
}

/// Parses a module without parameters and without an interpretation, which has a description.
fn plain_module(line: &'static str, before: &[&str]) -> Option<Name> {
    let (name, declared) = line.strip_prefix("names.")?.split_once(" = ")?;
    let doc = doc(before);
    if doc.is_empty() || declared != format!("module(\"{name}\")") {
        return None;
    }
    let name = Name { doc: doc.into(), ..Name::global(name, "") };
    Some(name.form([], "Module").pure())
}

/// Creates the argument for a module parameter; a name that ends with `?` makes it optional.
fn parameter_argument(parameter: &'static str) -> Argument {
    match parameter.strip_suffix('?') {
        Some(name) => argument(name, "any?"),
        None => argument(parameter, "any"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_library_says_what_its_names_are() {
        let told = |name: &str| {
            let names = names();
            let found = names.iter().find(|known| known.name == name);
            found.map(|name| format!("{}: {}", name.forms[0], name.doc))
        };
        let expected = "(hue: number, saturation: number, value: number) -> { number }: Creates a colour from `hue` (degrees), \
                        `saturation` and `value` (0 to 1).";
        assert_eq!(told("hsv").as_deref(), Some(expected));
        let expected = "(...any) -> Vector: Creates a vector from three numbers, or from a list of them; omitted numbers at the end are 0.";
        assert_eq!(told("vec").as_deref(), Some(expected));
        let expected = "(length: any?) -> Module: Interpreted as a call of turtle:forward.";
        assert_eq!(told("F").as_deref(), Some(expected));
        let expected = "(model: any, scale: any?) -> Module: Interpreted as a call of turtle:place.";
        assert_eq!(told("Place").as_deref(), Some(expected));
        let expected = "() -> Module: Creates a module that erases itself and everything that follows it in its branch, at the \
                        beginning of the next step. Until then, the modules are drawn.";
        assert_eq!(told("Cut").as_deref(), Some(expected));
        for inner in ["made", "vectors", "smooth", "curve", "hash", "turtle_module", "names"] {
            assert_eq!(told(inner), None);
        }
    }
}
