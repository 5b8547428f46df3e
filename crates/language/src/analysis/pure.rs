//! Detection of functions without side effects, so that one call in one machine has the same effect as a call in each
//! machine.
//!
//! A function is pure if it assigns only its own variables and tables that it created, and calls only modules,
//! constructors, library functions known to be pure, and pure functions of the same file. A function is not pure if the
//! analysis cannot decide this. A pure function may use random numbers, because their state is easily passed to other
//! machines.

use full_moon::ast::punctuated::Punctuated;
use full_moon::ast::{Call, Expression, FunctionArgs, FunctionCall, Index, Prefix, Suffix, Var};
use full_moon::tokenizer::TokenReference;

use super::syntax::{stream_argument, text_of};
use super::walk::Walk;
use crate::{Effect, is_pure_function, library_effect};

/// Returns true if a script sets metatables, so that even reading a table may have side effects.
pub fn has_metatables(text: &str) -> bool {
    text.contains("setmetatable")
}

impl Walk<'_> {
    /// Marks the functions from this nesting depth on as impure.
    pub(super) fn impure_from(&mut self, depth: usize) {
        self.functions.iter_mut().skip(depth).for_each(|function| function.pure = false);
    }

    /// Records an assignment to a field of `prefix`.
    pub(super) fn field_assigned(&mut self, prefix: &Prefix) {
        let owner = match prefix {
            Prefix::Name(name) => self.own_table(name),
            _ => None,
        };
        self.impure_from(owner.map_or(1, |owner| owner + 1));
    }

    /// Returns the function that created the table in a variable, if the variable always contains that table.
    fn own_table(&self, name: &TokenReference) -> Option<usize> {
        let variable = self.find(&text_of(name))?;
        (variable.fresh && !self.fact(variable.id).assigned).then_some(variable.function)
    }

    /// Returns true if `name` is the function that creates random streams.
    fn is_stream(&self, name: &TokenReference) -> bool {
        let text = text_of(name);
        text == "stream" && self.find(&text).is_none()
    }

    /// Returns true if an expression creates a random stream.
    pub(super) fn is_new_stream(&self, expression: &Expression) -> bool {
        let Expression::FunctionCall(call) = expression else { return false };
        let Prefix::Name(name) = call.prefix() else { return false };
        let suffixes: Vec<&Suffix> = call.suffixes().collect();
        matches!(suffixes.as_slice(), [Suffix::Call(Call::AnonymousCall(_))]) && self.is_stream(name)
    }

    /// Returns the function that created the random stream in a variable, if the variable always contains that stream.
    /// A number of the stream changes the stream.
    fn own_stream(&self, name: &TokenReference) -> Option<usize> {
        let variable = self.find(&text_of(name))?;
        (variable.stream && !self.fact(variable.id).assigned).then_some(variable.function)
    }

    /// Records a function call.
    pub(super) fn record_call(&mut self, call: &FunctionCall) {
        let suffixes: Vec<&Suffix> = call.suffixes().collect();
        let Prefix::Name(name) = call.prefix() else { return self.impure_from(1) };
        match suffixes.as_slice() {
            [Suffix::Call(Call::AnonymousCall(arguments))] if self.is_pure(name) => {
                self.record_streams(&text_of(name), arguments);
            }
            [Suffix::Call(Call::AnonymousCall(_))] => {
                self.impure_from(self.own_stream(name).map_or(1, |owner| owner + 1));
            }
            [Suffix::Call(Call::AnonymousCall(_)), Suffix::Call(Call::AnonymousCall(_))]
                if self.is_stream(name) => {}
            [Suffix::Index(Index::Dot { name: field, .. }), Suffix::Call(Call::AnonymousCall(arguments))]
                if self.find(&text_of(name)).is_none() =>
            {
                self.library_called(&text_of(name), &text_of(field), arguments);
            }
            [fields @ .., Suffix::Call(Call::MethodCall(method))]
                if self.is_pure_method(&text_of(method.name()))
                    && fields.iter().all(|field| matches!(field, Suffix::Index(_)))
                    && self.find(&text_of(name)).is_some_and(|variable| variable.feature) => {}
            _ => self.impure_from(1),
        }
    }

    /// Records the random streams from which a distribution draws.
    fn record_streams(&mut self, name: &str, arguments: &FunctionArgs) {
        let Some(first) = stream_argument(name) else { return };
        let FunctionArgs::Parentheses { arguments, .. } = arguments else { return };
        for (index, argument) in arguments.iter().enumerate() {
            match argument {
                Expression::FunctionCall(_) if self.is_new_stream(argument) => {}
                // The results of the last call can include a stream.
                Expression::FunctionCall(_) if index < first && index + 1 < arguments.len() => {}
                Expression::FunctionCall(_) => self.impure_from(1),
                Expression::Var(Var::Name(name)) if index >= first => {
                    self.impure_from(self.own_stream(name).map_or(1, |owner| owner + 1));
                }
                Expression::TableConstructor(_) => {}
                Expression::Symbol(symbol) if text_of(symbol) != "..." => {}
                _ if index >= first => self.impure_from(1),
                Expression::Symbol(_) => self.impure_from(1),
                _ => {}
            }
        }
    }

    fn is_pure(&self, name: &TokenReference) -> bool {
        let text = text_of(name);
        match self.find(&text) {
            Some(variable) => {
                let pure = self.facts.variables.get(variable.id).is_some_and(|fact| fact.pure);
                (pure || variable.module.is_some()) && !self.fact(variable.id).assigned
            }
            None => {
                is_pure_function(&text)
                    || self.globals.modules.contains_key(&text)
                    || self.globals.kinds.contains(&text)
            }
        }
    }

    /// Returns true if a method of a value of a feature is pure: one of strings, or of objects that never change.
    fn is_pure_method(&self, name: &str) -> bool {
        library_effect("string", name) == Effect::Pure || self.globals.value_methods.contains(name)
    }

    fn library_called(&mut self, library: &str, function: &str, arguments: &FunctionArgs) {
        let effect = library_effect(library, function);
        if effect == Effect::Pure {
            return;
        }
        let FunctionArgs::Parentheses { arguments, .. } = arguments else { return self.impure_from(1) };
        match arguments.iter().next() {
            Some(Expression::Var(Var::Name(name))) if effect == Effect::ChangesFirst => {
                let owner = self.own_table(name);
                self.impure_from(owner.map_or(1, |owner| owner + 1));
            }
            _ => self.impure_from(1),
        }
    }

    /// Records the expressions of a generic loop, which may contain a function that the loop calls.
    pub(super) fn record_iteration(&mut self, expressions: &Punctuated<Expression>) {
        let known = |expression: &Expression| match expression {
            Expression::FunctionCall(_) => true,
            Expression::Var(Var::Name(name)) => {
                self.own_table(name).is_some()
                    || self.find(&text_of(name)).is_some_and(|variable| variable.feature)
            }
            Expression::Var(Var::Expression(inner)) => match inner.prefix() {
                Prefix::Name(name) => self.find(&text_of(name)).is_some_and(|variable| variable.feature),
                _ => false,
            },
            _ => false,
        };
        if !expressions.iter().all(known) {
            self.impure_from(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::analysis::{Globals, analyse};

    /// Returns true if the function in the last line is pure.
    fn pure(script: &str) -> bool {
        let names = [
            "math",
            "table",
            "string",
            "random",
            "footprint",
            "pairs",
            "source",
            "param",
            "pcall",
            "stream",
            "normal",
            "poisson",
            "choose",
        ];
        let names = names.map(str::to_owned).to_vec();
        let value_methods = std::iter::once("area".to_owned()).collect();
        let globals =
            Globals { names, kinds: vec!["footprint".to_owned()], value_methods, ..Globals::default() };
        let analysis = analyse("s.lua", script, |_| Some(Vec::new()), &globals);
        analysis.pure.contains(&script.lines().count())
    }

    #[test]
    fn a_function_that_only_makes_something_is_pure() {
        for body in [
            "return footprint(f.geometry, { height = f.height or 3 })",
            "local t = {} for k, v in pairs(f) do t[k] = v end return t",
            "local t = { 1 } table.insert(t, math.max(f.a, 2)) return table.concat(t)",
            "local h = 3 if f.a then h = 4 end return h",
            "return f.name:lower()",
            "return f.geometry:area()",
            "return half(f.height)",
            "return random()",
            "return stream(\"a\", f.id)()",
            "local r = stream(\"a\", f.id) return r() + r(1, 2)",
            "return normal(f.mean, 2)",
            "local r = stream(\"a\", f.id) return normal(0, 1, r) + poisson(3, r)",
            "return choose({ 1, 2 }, { 3, 4 }, stream(\"a\")) + choose({ 1 }, nil)",
        ] {
            let script = format!(
                "local s = source({{}})\nlocal function half(x) return x / 2 end\ns:axiom(s, function(f) {body} end)"
            );
            assert!(pure(&script), "{body}");
        }
    }

    #[test]
    fn a_function_that_leaves_something_behind_or_may_is_not_pure() {
        for body in [
            "count = count + 1 return f",
            "count += 1",
            "list[1] = f",
            "table.insert(list, f)",
            "local t = list t.x = 1",
            "local t = {} t = list t.x = 1",
            "f.call()",
            "helper(f)",
            "list:add(f)",
            "pcall(function() count = 1 end)",
            "for x in helper do return x end",
            "table.sort(list)",
            "return string.gsub(f.name, \"a\", helper)",
            "local function inner() count = 1 end",
            "local g = helper g()",
            "param(\"x\", {})",
            "function list.x() end",
            "return shared()",
            "local r = stream(\"a\") r = shared return r()",
            "local stream = helper return stream(\"a\")()",
            "return stream(\"a\", f.id)()()",
            "return normal(0, 1, shared)",
            "return poisson(1, shared)",
            "return choose({ 1, 2 }, shared)",
            "return choose({ 1, 2 }, { 1, 2 }, shared)",
            "return normal(0, helper(1))",
            "return normal(0, 1, list.stream)",
        ] {
            let script = format!(
                "local s, count, list, shared = source({{}}), 0, {{}}, stream(\"shared\")\nlocal function helper(x) count = x end\ns:axiom(s, function(f) {body} end)"
            );
            assert!(!pure(&script), "{body}");
        }
    }
}
