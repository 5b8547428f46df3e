//! Detection of SQL queries in the functions of rules, so that parameters without a value are reported before a rule
//! runs.

use full_moon::ast::{Call, Expression, Field, FunctionArgs, FunctionCall, Prefix, Suffix};
use full_moon::node::Node;

use super::parameters::sql_parameters;
use super::syntax::{string_of, text_of};
use super::walk::{QueryCall, Walk};

impl Walk<'_> {
    /// Records a call of `query` if the syntax shows all its arguments.
    pub(super) fn query_called(&mut self, call: &FunctionCall) {
        let suffixes: Vec<&Suffix> = call.suffixes().collect();
        let (Prefix::Name(name), [Suffix::Call(Call::AnonymousCall(arguments))]) =
            (call.prefix(), suffixes.as_slice())
        else {
            return;
        };
        if text_of(name) != "query" || self.find("query").is_some() {
            return;
        }
        let (FunctionArgs::Parentheses { arguments, .. }, Some(begin)) =
            (&**arguments, name.start_position())
        else {
            return;
        };
        let arguments: Vec<&Expression> = arguments.iter().collect();
        let Some((Expression::String(sql), rest)) = arguments.split_first() else { return };
        let is_module = |value: &Expression| matches!(value, Expression::Var(full_moon::ast::Var::Name(name)) if self.module(name).is_some());
        let given = match rest {
            [] => Some(Vec::new()),
            [only] if is_module(only) => Some(Vec::new()),
            [Expression::TableConstructor(table)] => names_of(table),
            [module, Expression::TableConstructor(table)] if is_module(module) => names_of(table),
            _ => None,
        };
        let sql = string_of(sql).unwrap_or_default();
        if let (Some(given), Ok(names), Some(function)) =
            (given, sql_parameters(&sql), self.functions.last_mut())
        {
            let open = names.into_iter().filter(|name| !given.iter().any(|given| given == name));
            let open = open.map(str::to_owned).collect();
            function.queries.push(QueryCall { line: begin.line(), open, sql });
        }
    }
}

/// Returns the names of a table's fields; `None` if some keys are not names.
fn names_of(table: &full_moon::ast::TableConstructor) -> Option<Vec<String>> {
    let name = |field: &Field| match field {
        Field::NameKey { key, .. } => Some(text_of(key)),
        _ => None,
    };
    table.fields().iter().map(name).collect()
}

#[cfg(test)]
mod tests {
    use crate::analysis::{Globals, analyse};

    #[test]
    fn the_open_parameters_of_questions_are_known_by_the_functions_of_rules() {
        let names = ["lsystem", "module", "query"].map(str::to_owned).to_vec();
        let globals = Globals { names, ..Globals::default() };
        let open = |call: &str| -> Option<Vec<String>> {
            let script = format!(
                "local s, A, t = lsystem(), module(\"A\", \"x\"), {{}}\nlocal A = module(\"A\", \"x\")\ns:rule(\"A(x)\", function(this, x)\nlocal function f() return {call} end return f() end)"
            );
            let queries = analyse("s.lua", &script, |_| Some(Vec::new()), &globals).queries;
            let call = queries.get(&3)?.first()?;
            assert_eq!(call.line, 4);
            Some(call.open.clone())
        };
        let of = |names: &[&str]| Some(names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>());
        assert_eq!(open("query(\"select $a, $b\")"), of(&["a", "b"]));
        assert_eq!(open("query(\"select $a, $b\", A)"), of(&["a", "b"]));
        assert_eq!(open("query(\"select $a, $b\", A, { a = x })"), of(&["b"]));
        assert_eq!(open("query('select $a', { b = 1 })"), of(&["a"]));
        assert_eq!(open("query(\"select 1\")"), of(&[]));
        for unknown in
            ["query(\"$a\", t)", "query(\"$a\", A, t)", "query(t)", "query(\"$a\", { [t] = 1 })", "A(1)"]
        {
            assert_eq!(open(unknown), None, "{unknown}");
        }
    }
}
