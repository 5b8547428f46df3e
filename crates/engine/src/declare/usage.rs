//! Remedies for wrong arguments of methods and wrong values of fields: their declarations.

use super::session::Session;
use burgeon_base::error::{Error, ErrorKind};
use burgeon_kit::{Call, Kind, Registry};
use burgeon_language::ArgumentList;

impl Session {
    /// Adds to each problem about an argument of a method or about a field the declaration of the method or field, unless it
    /// already has a remedy.
    pub(crate) fn with_usage(&self, error: Error) -> Error {
        let lacks = |problem: &Error| problem.remedy().is_none() && is_of_values(problem);
        if !error.problems().any(lacks) {
            return error;
        }
        let registry = self.registry_with_types();
        let explained = error.problems().map(|problem| {
            let alone = problem.without_others();
            match usage(&registry, problem.message()).filter(|_| lacks(problem)) {
                Some(usage) => alone.help(usage),
                None => alone,
            }
        });
        Error::several(explained.collect())
    }
}

/// Returns true if a problem can be that of an argument or a field.
fn is_of_values(problem: &Error) -> bool {
    matches!(problem.kind(), ErrorKind::Argument | ErrorKind::Script)
}

/// Returns the declaration of the method or field with which `message` begins: `turtle:forward takes ...` or `turtle: width
/// must be ...`.
fn usage(registry: &Registry, message: &str) -> Option<String> {
    let is_name = |letter: char| letter.is_alphanumeric() || matches!(letter, '_' | '.');
    let end = message.find(|letter: char| !is_name(letter))?;
    let kind: &Kind = registry.get(&message[..end])?;
    let rest = message[end..].strip_prefix(':')?;
    let Some(field) = rest.strip_prefix(' ') else {
        let end = rest.find(|letter: char| !is_name(letter)).unwrap_or(rest.len());
        let method = kind.method(&rest[..end])?;
        let object = if kind.methods.iter().any(|method| !matches!(method.call, Call::Read(_))) {
            "this"
        } else {
            &*kind.name
        };
        return Some(format!("write {object}:{}{}", method.name, ArgumentList(&method.arguments)));
    };
    let end = field.find(|letter: char| !is_name(letter)).unwrap_or(field.len());
    let name = &field[..end];
    Some(kind.fields.iter().find(|known| known.is_called(name))?.usage())
}
