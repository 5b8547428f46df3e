//! Checks the arguments of calls against the declarations: their number, their types, and the fields of tables.

use std::borrow::Cow;

use full_moon::ast::{Expression, Field, FunctionArgs, TableConstructor};
use full_moon::tokenizer::TokenReference;

use super::calls::{CallCheck, expressions_of};
use super::inference::Inference;
use super::syntax::{is_open, text_of};
use crate::{ArgumentList, CallForm, Literal, LuauType, NameKind, SYSTEM, names};
use burgeon_base::error::Error;
use burgeon_kit::{Argument, Field as KindField, Kind};

impl CallCheck<'_, '_> {
    /// Checks a call against its signatures. `is_luau` marks functions of Luau, which accept a string of digits as a
    /// number.
    pub(super) fn hold_call(
        &mut self,
        word: &TokenReference,
        name: &str,
        forms: &[ArgumentList],
        args: &FunctionArgs,
        given: &[Inference],
        is_luau: bool,
    ) {
        let written = expressions_of(args);
        let open = written.last().is_some_and(|last| is_open(last));
        let fits = |form: &ArgumentList| {
            let few = given.len() < form.least() && !open;
            let many = form.most().is_some_and(|most| given.len() > most + usize::from(open));
            !few && !many
        };
        let of_count: Vec<ArgumentList> = forms.iter().copied().filter(fits).collect();
        let Some(form) = of_count.first() else {
            let Some(form) = forms.first() else { return };
            let message = format!("{name} takes {}, not {}", count(forms), given.len());
            return self.problem(word, Error::argument(message).help(format!("write {name}{form}")));
        };
        // With several signatures, a value is only wrong if none of them accepts it.
        let is_wrong = |argument: &Argument, value: &Inference| {
            !self.may_be(value, &argument.luau, &argument.fields, is_luau)
        };
        for (index, value) in given.iter().enumerate() {
            let of_form = |form: &ArgumentList| form.argument(index).is_some_and(|it| is_wrong(it, value));
            if of_count.iter().all(of_form)
                && let Some(argument) = form.argument(index)
            {
                let message = wrong_value(name, &argument.name, &argument.luau, value);
                let error = Error::argument(message).help(format!("write {name}{form}"));
                return match written.get(index) {
                    Some(written) => self.problem_of(*written, error),
                    None => self.problem(word, error),
                };
            }
        }
        if of_count.len() == 1 {
            if let (FunctionArgs::TableConstructor(table), Some(argument)) = (args, form.argument(0)) {
                self.hold_table(name, table, &argument.luau, &argument.fields);
            }
            for (index, written) in written.iter().enumerate() {
                if let (Expression::TableConstructor(table), Some(argument)) = (written, form.argument(index))
                {
                    self.hold_table(name, table, &argument.luau, &argument.fields);
                }
            }
        }
    }

    /// Checks the literals among the arguments of a local function against the types that the script declares for them.
    pub(super) fn hold_local(
        &mut self,
        path: &str,
        form: &CallForm,
        args: &FunctionArgs,
        given: &[Inference],
    ) {
        let written = expressions_of(args);
        for ((argument, value), written) in form.arguments.iter().zip(given).zip(written) {
            if argument.name != "..." && self.contradicts(value, &argument.luau) {
                let message = wrong_value(path, &argument.name, &argument.luau, value);
                let help = format!("the script declares {path}{form}: change the type or the value");
                self.problem_of(written, Error::argument(message).help(help));
            }
        }
    }

    /// Checks the literal with which a local variable begins against the type that the script declares for it.
    pub(super) fn hold_declared(
        &mut self,
        name: &TokenReference,
        luau: &str,
        value: &Expression,
        known: &Inference,
    ) {
        if self.contradicts(known, luau) {
            let text = text_of(name);
            let message = wrong_value("local variable", &text, luau, known);
            self.problem_of(
                value,
                Error::argument(message)
                    .help(format!("the script declares {text}: {luau}: change the type or the value")),
            );
        }
    }

    /// Returns true if a literal does not have the type `luau` that the script declares. Types of the script's own are not known.
    fn contradicts(&self, value: &Inference, luau: &str) -> bool {
        let is_own = luau
            .split(|letter: char| !letter.is_alphanumeric() && letter != '_')
            .any(|name| self.own_types.contains(name));
        matches!(value, Inference::Value(_)) && !is_own && !self.may_be(value, luau, &[], false)
    }

    /// Refuses a call of a method with a dot that does not pass the object itself, such as `this.forward(1)`.
    pub(super) fn refuse_dot(
        &mut self,
        of: &Inference,
        path: &str,
        name: &TokenReference,
        args: &FunctionArgs,
    ) {
        let text = text_of(name);
        let owner = match of {
            Inference::Object(kind) if kind.method(&text).is_some() => kind.name.to_string(),
            Inference::System(_) if SYSTEM.find(&text).is_some() => "system".to_owned(),
            Inference::Given(given) if given.find(&text).is_some() => given.name.to_string(),
            _ => return,
        };
        let passes_itself = match args {
            FunctionArgs::Parentheses { arguments, .. } => {
                // An object that is not a literal may be the right one.
                arguments.iter().next().is_some_and(|first| matches!(first, Expression::Var(_)))
            }
            _ => false,
        };
        if !passes_itself {
            let path = if path.is_empty() { "object" } else { path };
            let message = format!("{owner}:{text} is a method, and a dot calls it without its object");
            self.problem(name, Error::argument(message).help(format!("write a colon: {path}:{text}(...)")));
        }
    }

    /// Checks the arguments of a constructor against its fields.
    pub(super) fn hold_constructor(
        &mut self,
        kind: &Kind,
        word: &TokenReference,
        args: &FunctionArgs,
        given: &[Inference],
    ) {
        let written = expressions_of(args);
        let most = 1 + usize::from(
            kind.first.is_some() || matches!(kind.construct, burgeon_kit::Construct::File(_)),
        );
        if given.len() > most {
            let counts = if most == 1 { "one table of fields" } else { "2 arguments" };
            let message = format!("{} takes {counts}, not {} arguments", kind.name, given.len());
            return self.problem(word, Error::argument(message));
        }
        let first = kind.first.as_deref();
        let table = match args {
            FunctionArgs::TableConstructor(table) => Some(table),
            _ => match written.last() {
                Some(Expression::TableConstructor(table)) => Some(table),
                _ => None,
            },
        };
        let Some(table) = table else { return };
        let names_a_field = table.fields().iter().any(|field| match field {
            Field::NameKey { key, .. } => kind.fields.iter().any(|known| known.is_called(&text_of(key))),
            _ => false,
        });
        // A single table may be the value of the first field.
        if first.is_none() || given.len() == most || names_a_field {
            self.hold_fields(&kind.name, table, &kind.fields);
        }
    }

    /// Checks the fields of a table constructor, or the fields of its items if it is a list.
    fn hold_table(&mut self, owner: &str, table: &TableConstructor, luau: &str, fields: &[KindField]) {
        if fields.is_empty() {
            return;
        }
        let of = LuauType::read(luau);
        match of.item() {
            Some(_) => {
                for field in table.fields() {
                    if let Field::NoKey(Expression::TableConstructor(item)) = field {
                        self.hold_fields(owner, item, fields);
                    }
                }
            }
            None => self.hold_fields(owner, table, fields),
        }
    }

    fn hold_fields(&mut self, owner: &str, table: &TableConstructor, fields: &[KindField]) {
        for field in table.fields() {
            let Field::NameKey { key, value, .. } = field else { continue };
            let name = text_of(key);
            let Some(known) = fields.iter().find(|known| known.is_called(&name)) else {
                let names: Vec<&str> = fields.iter().map(|known| &*known.name).collect();
                let message = format!("unknown field `{name}` in {owner}");
                let error = Error::not_found("field", &name, names.iter().copied(), message);
                self.problem(key, error.help(format!("it has {}", names.join(", "))));
                continue;
            };
            let outer = std::mem::take(&mut self.problems);
            let found = self.expression(value);
            self.problems = outer;
            // An omitted field can also be written as nil.
            let is_nil = matches!(&found, Inference::Value(Literal::Nil));
            if !is_nil && !self.may_be(&found, &known.luau, &known.fields, false) {
                let error = Error::argument(wrong_value(owner, &name, &known.luau, &found));
                self.problem_of(&**value, error.help(known.usage()));
            } else if let Expression::TableConstructor(inner) = &**value {
                self.hold_table(&format!("{owner}.{name}"), inner, &known.luau, &known.fields);
            }
        }
    }

    /// Returns true if a value can be passed for an argument or a field of type `luau`, a table if it has `fields`.
    fn may_be(&self, known: &Inference, luau: &str, fields: &[KindField], is_luau: bool) -> bool {
        let object;
        let literal = match known {
            Inference::Value(Literal::Text(text)) if is_luau && text.trim().parse::<f64>().is_ok() => {
                return true;
            }
            Inference::Value(literal) => literal,
            Inference::Object(kind) => {
                object = Literal::Object(Cow::Owned(kind.luau()));
                &object
            }
            Inference::Table(_) => &Literal::Table,
            Inference::Given(name) if name.luau == "Vector" => &Literal::Object(Cow::Borrowed("Vector")),
            Inference::Name(name) if !name.forms.is_empty() => &Literal::Function,
            Inference::Unknown
            | Inference::Constructor(_)
            | Inference::System(_)
            | Inference::Given(_)
            | Inference::Local(_)
            | Inference::Name(_) => {
                return true;
            }
        };
        let name = luau.trim_end_matches('?');
        // The type is a named table of fields.
        if !fields.is_empty() && LuauType::read(name) == LuauType::Named(Cow::Borrowed(name)) {
            return *literal == Literal::Table || *literal == Literal::Nil && luau.ends_with('?');
        }
        LuauType::read(luau).accepts(literal, &|name| self.stands_for(name))
    }

    /// Returns the type that a name in a type refers to.
    fn stands_for<'n>(&self, name: &'n str) -> Option<LuauType<'n>> {
        let itself = || LuauType::Named(Cow::Borrowed(name));
        let family: Vec<LuauType> = self
            .registry
            .kinds()
            .filter(|kind| kind.family.as_deref() == Some(name))
            .map(|kind| LuauType::Named(Cow::Owned(kind.luau())))
            .collect();
        if !family.is_empty() {
            return Some(LuauType::Union(family));
        }
        if self.registry.kinds().any(|kind| kind.luau() == name) {
            return Some(itself());
        }
        let given = names().iter().find(|known| {
            known.sort == NameKind::Given && (known.luau == name || known.name == name.to_lowercase())
        })?;
        match (&*given.instead, &*given.luau) {
            ("", luau) if luau == name => None,
            ("", luau) => Some(LuauType::read(luau)),
            // An object of that type is accepted by its name.
            (instead, _) => Some(LuauType::read(instead)),
        }
    }
}

/// Formats the number of arguments that a function accepts.
fn count(forms: &[ArgumentList]) -> Cow<'static, str> {
    let least = forms.iter().map(ArgumentList::least).min().unwrap_or(0);
    let most: Option<usize> =
        forms.iter().map(ArgumentList::most).try_fold(0, |most, of| Some(most.max(of?)));
    let arguments = |count: usize| if count == 1 { "argument" } else { "arguments" };
    Cow::Owned(match most {
        Some(0) => return Cow::Borrowed("no arguments"),
        Some(most) if most == least => format!("{most} {}", arguments(most)),
        Some(most) => format!("{least} to {most} arguments"),
        None => format!("at least {least} {}", arguments(least)),
    })
}

/// Formats the message for a wrong value.
fn wrong_value(owner: &str, name: &str, luau: &str, found: &Inference) -> String {
    let wanted = match luau.trim_end_matches('?') {
        "number" => "a number",
        "string" => "a string",
        "boolean" => "true or false",
        "Color" => "a colour",
        "Vector" => "a vector",
        luau if luau.starts_with('{') => "a table",
        luau => luau,
    };
    let described;
    let found = match found {
        Inference::Value(Literal::Text(text)) => {
            described = format!("{text:?}");
            &described
        }
        Inference::Value(Literal::Nil) => "nothing",
        Inference::Value(Literal::Boolean) => "a boolean",
        Inference::Value(Literal::Number) => "a number",
        Inference::Value(Literal::Table) | Inference::Table(_) => "a table",
        Inference::Value(Literal::Function) | Inference::Name(_) => "a function",
        Inference::Object(kind) => {
            described = format!("an object of type {}", kind.name);
            &described
        }
        _ => "a vector",
    };
    format!("{owner}: {name} must be {wanted}, not {found}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(script: &str) -> Vec<String> {
        let ast = full_moon::parse(script).unwrap_or_else(|errors| panic!("{script}: {errors:?}"));
        let registry = burgeon_objects::registry();
        let mut check = CallCheck::new("s.lua", &ast, &registry, None);
        check.file(&ast);
        check.problems.iter().map(|problem| problem.message().to_owned()).collect()
    }

    /// Literals as they appear in a script.
    const VALUES: [(&str, Literal); 5] = [
        ("1", Literal::Number),
        ("true", Literal::Boolean),
        ("\"a b\"", Literal::Text(String::new())),
        ("{}", Literal::Table),
        ("function() end", Literal::Function),
    ];

    /// Returns a literal that fits the argument, and one that does not, if use any.
    fn values(argument: &Argument) -> (Option<&'static str>, Option<&'static str>) {
        let registry = burgeon_objects::registry();
        let ast = full_moon::parse("").expect("nothing");
        let check = CallCheck::new("s.lua", &ast, &registry, None);
        let fits = |literal: &Literal| {
            check.may_be(&Inference::Value(literal.clone()), &argument.luau, &argument.fields, false)
        };
        let find =
            |wanted: bool| VALUES.iter().find(|(_, literal)| fits(literal) == wanted).map(|(text, _)| *text);
        (find(true), find(false))
    }

    #[test]
    fn every_method_takes_what_it_is_declared_to_take_and_nothing_else() {
        let (mut right, mut wrong) = (0, 0);
        for kind in burgeon_objects::registry().kinds() {
            if !matches!(kind.construct, burgeon_kit::Construct::Fields(_)) {
                continue;
            }
            let script = |call: &str| {
                let name = &kind.name;
                format!("lsystem({{ object = {name} }}):interpret(\"A\", function(this) this:{call} end)")
            };
            assert_eq!(messages(&script("no_such_method()")).len(), 1, "{}", kind.name);
            for method in &kind.methods {
                let values: Vec<_> = method.arguments.iter().map(values).collect();
                let Some(good) = values.iter().map(|(good, _)| *good).collect::<Option<Vec<_>>>() else {
                    continue;
                };
                let call = |arguments: &[&str]| {
                    messages(&script(&format!("{}({})", method.name, arguments.join(", "))))
                };
                assert_eq!(call(&good), [""; 0], "{}:{}", kind.name, method.name);
                let more = [&good[..], &["1"]].concat();
                assert_eq!(call(&more).len(), 1, "{}:{}", kind.name, method.name);
                right += 1;
                for (index, (_, bad)) in values.iter().enumerate() {
                    let Some(bad) = bad else { continue };
                    let mut arguments = good.clone();
                    arguments[index] = bad;
                    let said = call(&arguments);
                    let begin =
                        format!("{}:{}: {} must be ", kind.name, method.name, method.arguments[index].name);
                    assert!(said.len() == 1 && said[0].starts_with(&begin), "{begin}: {said:?}");
                    wrong += 1;
                }
            }
        }
        assert!(right > 80 && wrong > 80, "{right} {wrong}");
    }

    #[test]
    fn every_field_takes_what_it_is_declared_to_take_and_nothing_else() {
        let (mut right, mut wrong) = (0, 0);
        for kind in burgeon_objects::registry().kinds() {
            if !matches!(kind.construct, burgeon_kit::Construct::Fields(_)) {
                continue;
            }
            let name = &kind.name;
            for field in &kind.fields {
                let argument = Argument {
                    luau: field.luau.clone(),
                    fields: field.fields.clone(),
                    ..Argument::new(field.name.clone())
                };
                let (good, bad) = values(&argument);
                if let Some(good) = good {
                    assert_eq!(messages(&format!("{name}({{ {} = {good} }})", field.name)), [""; 0]);
                    right += 1;
                }
                if let Some(bad) = bad {
                    let said = messages(&format!("{name} {{ {} = {bad} }}", field.name));
                    let begin = format!("{name}: {} must be ", field.name);
                    assert!(said.len() == 1 && said[0].starts_with(&begin), "{begin}: {said:?}");
                    wrong += 1;
                }
            }
            if !kind.fields.is_empty() {
                assert_eq!(
                    messages(&format!("{name}({{ no_such_field = 1, {} = nil }})", kind.fields[0].name))
                        .len(),
                    1
                );
            }
        }
        assert!(right > 80 && wrong > 60, "{right} {wrong}");
    }

    #[test]
    fn what_is_not_certain_is_not_told() {
        for script in [
            "local s = lsystem() s:interpret(\"A\", function(this) this:anything(1, 2, 3) end)",
            "local t = turtle t = extruder lsystem({ object = t }):interpret(\"A\", function(this) this:forward(1) end)",
            "local turtle = require(\"own\") turtle({ anything = 3 }):whatever()",
            "local s = lsystem({ object = turtle }) s:rule(\"A\", function(this) local this = {} this:x() end)",
            "local function draw(this) this:anything() end lsystem({ object = turtle }):interpret(\"A\", draw)",
            "print(math.max(unpack({ 1, 2 })), math.floor(\"3\"), lerp(...), select(\"#\", 1))",
            "local s = lsystem({ object = extruder }) s:axiom(F(1), { F() }) s:axiom(source(\"a\"), function(f) return F() end)",
            "lsystem({ object = turtle }):rule(\"A\", { weight = 2 }, \"return F()\"):rule(\"B\", [[ return nil ]])",
            "local v = vec(1, 2) print(v:dot({ 1, 2, 3 }), v:lerp(v, 0.5):length(), lerp(v, v, 0.5))",
            "footprint({ { 0, 0 } }, { height = 3 }) footprint({ geometry = {}, height = 3 }) panel({}) list({ 1 }, {})",
            "local p = { 1, 2 } lsystem({ object = turtle }):interpret(\"A\", function(this) this:jump(p) end)",
        ] {
            let found = messages(script);
            assert!(
                found.iter().all(|text| text.contains("unknown method or field `jump` of turtle")),
                "{script}: {found:?}"
            );
        }
    }
}
