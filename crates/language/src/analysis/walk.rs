//! Walks a script: variables and their scopes, names, and all other static checks.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use full_moon::ast::punctuated::Punctuated;
use full_moon::ast::{Ast, Block, Call, Expression, FunctionBody, LastStmt, NumericFor, Stmt, Suffix, Var};
use full_moon::node::Node;
use full_moon::tokenizer::TokenReference;

use super::blocks::ScopeWalk;
use super::globals::Globals;
use super::syntax::{
    columns_of, declared_module, end_of, first_position, instead_of, stream_argument, text_of,
};
use crate::CallForm;
use crate::slips::remedy_of_name;
use burgeon_base::error::Error;
use burgeon_rewriting::Signature;

/// Facts that the first walk collects about variables, in the order of declaration.
#[derive(Default)]
pub(super) struct Facts {
    pub(super) variables: Vec<Fact>,
}

#[derive(Default, Clone, Copy)]
pub(super) struct Fact {
    pub(super) assigned: bool,
    pub(super) assigned_inside: bool,
    /// Set for a pure function.
    pub(super) pure: bool,
}

/// Read methods that return a part of the place of an object that moves along its chain.
const PLACE_METHODS: [&str; 4] = ["position", "heading", "left", "up"];

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FunctionRole {
    Script,
    Rule,
    Guard,
    Interpretation,
    Hook,
    /// Read method of an object type, which rules and interpretations can call.
    Reading,
    /// Write method of an object type, which interpretations can call.
    Changing,
    Other,
}

pub(super) struct Function {
    pub(super) role: FunctionRole,
    /// Rule of the function, as errors name it.
    pub(super) rule: Option<String>,
    /// Shapes of the prepared returns, as Lua tables.
    pub(super) shapes: Vec<Cow<'static, str>>,
    /// Set as long as no side effect was found.
    pub(super) pure: bool,
    /// Set if the function reads its first parameter.
    pub(super) asks: bool,
    /// Set if the function reads its first parameter other than by the methods that return a place.
    pub(super) asks_more: bool,
    /// Numbers of the parameters that the function reads; the first has the number 0.
    pub(super) reads: BTreeSet<usize>,
    /// Set if the function reads more arguments than it names.
    pub(super) is_variadic: bool,
    /// Line of the first return of nothing but a table that the function has filled.
    pub(super) filled: Option<usize>,
    /// Detected queries.
    pub(super) queries: Vec<QueryCall>,
}

impl Function {
    pub(super) fn new(role: FunctionRole, rule: Option<String>) -> Self {
        Self {
            role,
            rule,
            shapes: Vec::new(),
            pure: true,
            asks: false,
            asks_more: false,
            reads: BTreeSet::new(),
            is_variadic: false,
            filled: None,
            queries: Vec::new(),
        }
    }
}

/// A call of `query` in a function of a rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct QueryCall {
    /// Line of the call.
    pub line: usize,
    /// SQL text, or the name of a table.
    pub sql: String,
    /// Parameters of the text for which the call itself passes no value.
    pub open: Vec<String>,
}

pub(super) struct Variable {
    pub(super) name: Cow<'static, str>,
    pub(super) id: usize,
    pub(super) function: usize,
    pub(super) module: Option<Signature>,
    /// Set if the initial value is a new table.
    pub(super) fresh: bool,
    /// Set if the initial value is a new random stream.
    pub(super) stream: bool,
    /// Set for the argument of an axiom's function.
    pub(super) feature: bool,
    /// Set for the first parameter of its function.
    pub(super) receiver: bool,
    /// Number of the parameter of its function, if it is one.
    pub(super) parameter: Option<usize>,
}

pub(super) struct TextEdit {
    pub(super) begin: usize,
    pub(super) end: usize,
    pub(super) text: Cow<'static, str>,
    pub(super) order: usize,
}

pub(super) struct Walk<'a> {
    pub(super) file: &'a str,
    pub(super) globals: &'a Globals,
    pub(super) known: Facts,
    pub(super) facts: Facts,
    pub(super) functions: Vec<Function>,
    pub(super) variables: Vec<Variable>,
    pub(super) edits: Vec<TextEdit>,
    pub(super) problems: Vec<Error>,
    pub(super) random: bool,
    pub(super) reads_step: bool,
    pub(super) stops: bool,
    /// Rule whose functions are being walked.
    pub(super) rule: Option<String>,
    /// Set if the next function belongs to an axiom.
    pub(super) axiom: bool,
    /// Purity of all functions that begin on a line, by line.
    pub(super) pure: BTreeMap<usize, bool>,
    /// Entry by line: true if no function that begins on the line reads its first parameter.
    pub(super) blind: BTreeMap<usize, bool>,
    /// Entry by line: true if the functions that begin on the line read their first parameters for a place only.
    pub(super) asks_place: BTreeMap<usize, bool>,
    /// Entry by line: true if the functions that begin on the line only divide a shape into modules.
    pub(super) divides: BTreeMap<usize, bool>,
    /// Numbers of the parameters that the functions that begin on a line read, by line; `None` if one is variadic.
    pub(super) reads: BTreeMap<usize, Option<BTreeSet<usize>>>,
    /// Text of the guard that begins on a line, by line; `None` if guards on the line differ.
    pub(super) guards: BTreeMap<usize, Option<String>>,
    /// Line on which a rule returns only a table that it has filled, by the line on which its function begins.
    pub(super) filled: BTreeMap<usize, usize>,
    /// Signature of the function that begins on a line, by line; `None` if signatures on the line differ.
    pub(super) signatures: BTreeMap<usize, Option<CallForm>>,
    /// Queries of a rule's function, by the line on which the function begins.
    pub(super) queries: BTreeMap<usize, Vec<QueryCall>>,
    /// Byte positions of the parameter lists of functions.
    pub(super) begins: Vec<usize>,
    /// Deprecated names that are used, with their lines.
    pub(super) deprecated: Vec<(String, usize)>,
}

impl ScopeWalk for Walk<'_> {
    fn in_scope(&self) -> usize {
        self.variables.len()
    }

    fn leave(&mut self, outside: usize) {
        self.variables.truncate(outside);
    }

    fn term(&mut self, expression: &Expression) {
        self.expression(expression);
    }

    fn counter(&mut self, numeric: &NumericFor) {
        self.declare(numeric.index_variable(), first_position(numeric.block(), numeric.end_token()));
    }

    fn open_block(&mut self, block: &Block) {
        for statement in block.stmts() {
            self.statement(statement);
        }
        if let Some(LastStmt::Return(statement)) = block.last_stmt() {
            self.returns(statement.token(), statement.returns());
        }
    }
}

impl<'a> Walk<'a> {
    pub(super) fn new(file: &'a str, globals: &'a Globals, known: Facts) -> Self {
        Self {
            file,
            globals,
            known,
            facts: Facts::default(),
            functions: vec![Function { pure: false, ..Function::new(FunctionRole::Script, None) }],
            variables: Vec::new(),
            edits: Vec::new(),
            problems: Vec::new(),
            random: false,
            reads_step: false,
            stops: false,
            rule: None,
            axiom: false,
            pure: BTreeMap::new(),
            blind: BTreeMap::new(),
            asks_place: BTreeMap::new(),
            divides: BTreeMap::new(),
            reads: BTreeMap::new(),
            guards: BTreeMap::new(),
            filled: BTreeMap::new(),
            signatures: BTreeMap::new(),
            queries: BTreeMap::new(),
            begins: Vec::new(),
            deprecated: Vec::new(),
        }
    }

    pub(super) fn run(&mut self, ast: &Ast) {
        self.block(ast.nodes());
    }

    pub(super) fn statement(&mut self, statement: &Stmt) {
        match statement {
            Stmt::Assignment(assignment) => {
                self.expressions(assignment.expressions());
                for variable in assignment.variables() {
                    self.assign(variable, statement);
                }
                self.check_state(assignment);
            }
            Stmt::CompoundAssignment(assignment) => {
                self.expression(assignment.rhs());
                if let Var::Name(name) = assignment.lhs()
                    && self.find(&text_of(name)).is_some()
                {
                    self.read(name);
                }
                self.assign(assignment.lhs(), statement);
            }
            Stmt::FunctionCall(call) => self.call(call),
            Stmt::FunctionDeclaration(declaration) => {
                let names = declaration.name().names();
                if let Some(first) = names.first() {
                    if names.len() == 1 && declaration.name().method_name().is_none() {
                        self.assign_name(first.value(), statement);
                    } else {
                        self.impure_from(1);
                        self.read(first.value());
                    }
                }
                self.function(
                    declaration.body(),
                    FunctionRole::Other,
                    declaration.name().method_name().is_some(),
                );
            }
            Stmt::LocalFunction(function) => self.local_function(function.name(), function.body(), statement),
            Stmt::ConstFunction(function) => self.local_function(function.name(), function.body(), statement),
            Stmt::LocalAssignment(local) => self.local(local.names(), local.expressions(), statement),
            Stmt::ConstAssignment(local) => self.local(local.names(), local.expressions(), statement),
            Stmt::GenericFor(generic) => {
                self.expressions(generic.expressions());
                self.record_iteration(generic.expressions());
                self.check_keys(generic.expressions());
                let outside = self.variables.len();
                for name in generic.names() {
                    self.declare(name, first_position(generic.block(), generic.end_token()));
                }
                self.block(generic.block());
                self.variables.truncate(outside);
            }
            other => self.walk_nested(other),
        }
    }

    pub(super) fn local_function(&mut self, name: &TokenReference, body: &FunctionBody, statement: &Stmt) {
        let id = self.declare(name, end_of(statement).map(|end| end.bytes()));
        self.facts.variables[id].pure = self.walk_function(body, FunctionRole::Other, false).pure;
    }

    pub(super) fn local(
        &mut self,
        names: &Punctuated<TokenReference>,
        values: &Punctuated<Expression>,
        statement: &Stmt,
    ) {
        self.expressions(values);
        let values: Vec<&Expression> = values.iter().collect();
        let streams: Vec<bool> = values.iter().map(|value| self.is_new_stream(value)).collect();
        for (index, name) in names.iter().enumerate() {
            let id = self.declare(name, end_of(statement).map(|end| end.bytes()));
            let module = values.get(index).and_then(|value| declared_module(value));
            if let Some(variable) = self.variables.last_mut().filter(|variable| variable.id == id) {
                variable.module = module;
                variable.fresh = matches!(values.get(index), Some(Expression::TableConstructor(_)));
                variable.stream = streams.get(index).copied().unwrap_or_default();
            }
        }
    }

    /// Adds a variable to the scope. `behind` is the position where a statement can follow its declaration.
    pub(super) fn declare(&mut self, name: &TokenReference, behind: Option<usize>) -> usize {
        let id = self.facts.variables.len();
        self.facts.variables.push(Fact::default());
        let function = self.functions.len() - 1;
        let text = text_of(name);
        if text.starts_with("__") {
            let error = Error::script(format!("a variable cannot be named {text}"));
            self.problem(name, error.help("names that begin with two underscores are reserved"));
        }
        self.variables.push(Variable {
            name: Cow::Owned(text),
            id,
            function,
            module: None,
            fresh: false,
            stream: false,
            feature: false,
            receiver: false,
            parameter: None,
        });
        if function > 0
            && self.fact(id).assigned_inside
            && let Some(at) = behind
        {
            self.edit(at, at, format!(" local __epoch_{id} = __epoch();"));
        }
        id
    }

    pub(super) fn fact(&self, id: usize) -> Fact {
        self.known.variables.get(id).copied().unwrap_or_default()
    }

    pub(super) fn find(&self, name: &str) -> Option<&Variable> {
        self.variables.iter().rev().find(|variable| variable.name == name)
    }

    pub(super) fn assign(&mut self, variable: &Var, statement: &Stmt) {
        match variable {
            Var::Name(name) => self.assign_name(name, statement),
            Var::Expression(expression) => {
                self.field_assigned(expression.prefix());
                self.prefix(expression.prefix(), None);
                for suffix in expression.suffixes() {
                    self.suffix(suffix);
                }
            }
            _ => {}
        }
    }

    pub(super) fn assign_name(&mut self, token: &TokenReference, statement: &Stmt) {
        let name = text_of(token);
        let here = self.functions.len() - 1;
        let rule = self.functions.iter().rposition(|function| {
            use FunctionRole::{Guard, Hook, Interpretation, Rule};
            matches!(function.role, Rule | Guard | Interpretation | Hook)
        });
        let found = self.find(&name).map(|variable| (variable.id, variable.function));
        let Some((id, owner)) = found else {
            if self.globals.names.contains(&name) {
                let error = Error::scope(format!("cannot assign {name}: it is built in"));
                self.problem(token, error.help("choose another name: local ..."));
                return;
            }
            let error = Error::scope(format!("cannot assign {name}: it is not a local variable"));
            self.problem(token, match rule {
                Some(_) => error.help("a rule can assign only its own locals; declare it inside: local ..., or use an interpretation rule to change the object"),
                None => error.help(format!("scripts cannot define globals; write local {name} = ...")),
            });
            return;
        };
        self.impure_from(owner + 1);
        let fact = &mut self.facts.variables[id];
        fact.assigned = true;
        fact.assigned_inside |= owner < here;
        if let Some(rule) = rule {
            if owner < rule {
                let what = match self.functions[rule].role {
                    FunctionRole::Guard => "a guard",
                    FunctionRole::Interpretation => "an interpretation rule",
                    FunctionRole::Hook => "a hook",
                    _ => "a rule",
                };
                let help = match self.functions[rule].role {
                    FunctionRole::Interpretation => {
                        "it can change only `this`; keep values in a parameter of a module"
                    }
                    FunctionRole::Hook => "declare it with variables({ ... }), and pass these to the system",
                    _ => {
                        "pass it in a parameter of a module; to change the object, use an interpretation rule"
                    }
                };
                self.problem(
                    token,
                    Error::scope(format!("{what} assigns {name}, a variable declared outside")).help(help),
                );
            }
            return;
        }
        if owner < here
            && let Some(begin) = statement.start_position()
        {
            let epoch = (owner > 0).then(|| format!("__epoch_{id}"));
            let epoch = epoch.as_deref().unwrap_or("0");
            self.edit(begin.bytes(), begin.bytes(), format!("__guard(\"{name}\", {epoch}); "));
        }
    }

    /// Reads the prefix of a call, which can be `this` in a question for a place.
    pub(super) fn read_receiver(&mut self, token: &TokenReference, first: Option<&Suffix>) {
        if let Some(Suffix::Call(Call::MethodCall(method))) = first
            && PLACE_METHODS.contains(&text_of(method.name()).as_str())
            && let Some(variable) = self.find(&text_of(token)).filter(|variable| variable.receiver)
        {
            let function = variable.function;
            self.functions[function].asks = true;
            return;
        }
        self.read(token);
    }

    pub(super) fn read(&mut self, token: &TokenReference) {
        let name = text_of(token);
        self.random |= name == "random";
        if let Some(variable) = self.find(&name) {
            let (function, receiver, parameter) = (variable.function, variable.receiver, variable.parameter);
            self.functions[function].reads.extend(parameter);
            if receiver {
                self.functions[function].asks = true;
                self.functions[function].asks_more = true;
            }
            return;
        }
        self.random |= name == "stream" || stream_argument(&name).is_some();
        self.reads_step |= name == "step";
        self.stops |= name == "stop";
        if self.globals.names.contains(&name) {
            if self.globals.deprecated.contains_key(&name) {
                let line = token.start_position().map_or(1, |position| position.line());
                self.deprecated.push((name, line));
            }
            return;
        }
        let message = format!("unknown name {name}");
        if let Some(instead) = instead_of(&name).or_else(|| remedy_of_name(&name)) {
            return self.problem(token, Error::not_found("name", &name, [], message).help(instead));
        }
        let locals = self.variables.iter().rev().map(|variable| &*variable.name);
        let known = locals.chain(self.globals.names.iter().map(String::as_str));
        let error = Error::not_found("name", &name, known, message);
        let error = match name.starts_with(|c: char| c.is_ascii_uppercase()) {
            true => error.help(format!("declare it as a module: local {name} = module(\"{name}\")")),
            false => error.help(format!("declare it: local {name} = ...")),
        };
        self.problem(token, error);
    }

    /// Returns the signature of the module whose constructor is called `name`.
    pub(super) fn module(&self, name: &TokenReference) -> Option<&Signature> {
        let text = text_of(name);
        match self.find(&text) {
            Some(variable) if self.fact(variable.id).assigned => None,
            Some(variable) => variable.module.as_ref(),
            None => self.globals.modules.get(&text),
        }
    }

    pub(super) fn edit(&mut self, begin: usize, end: usize, text: impl Into<Cow<'static, str>>) {
        let order = self.edits.len();
        self.edits.push(TextEdit { begin, end, text: text.into(), order });
    }

    pub(super) fn problem(&mut self, token: &TokenReference, error: Error) {
        let line = token.start_position().map_or(1, |position| position.line());
        let error = error.at_line(self.file, line);
        let error = columns_of(token).into_iter().fold(error, Error::in_columns);
        let rule = self.functions.iter().rev().find_map(|function| function.rule.as_ref());
        self.problems.push(match rule {
            Some(rule) => error.rule(rule),
            None => error,
        });
    }
}
