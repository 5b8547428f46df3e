//! Checks the calls of a script against the declarations: unknown methods and fields, too many arguments or arguments
//! of wrong types, and changes of an object in a rule.
//!
//! The check reports only certain errors: it considers variables that are set once, literals, and declared results.
//! `burgeon check` runs it; a normal run does not.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use full_moon::ast::punctuated::Punctuated;
use full_moon::ast::{
    Ast, Block, Call, Expression, Field, FunctionArgs, FunctionBody, FunctionCall, Index, LastStmt,
    NumericFor, Parameter, Prefix, Stmt, Suffix, TableConstructor, UnOp, Var,
};
use full_moon::node::Node;
use full_moon::tokenizer::TokenReference;

use super::blocks::ScopeWalk;
use super::inference::Inference;
use super::prepare::signature;
use super::syntax::{columns_between, is_function_option, string_of, text_of};
use super::walk::FunctionRole;
use crate::Literal;
use burgeon_base::error::Error;
use burgeon_kit::{Kind, Registry};

/// Walk that checks the calls of a script.
pub(super) struct CallCheck<'a, 'f> {
    file: &'a str,
    pub(super) registry: &'a Registry,
    /// Variables in scope.
    pub(super) scope: Vec<(String, Inference<'a>)>,
    /// Names of variables that are assigned after their declaration.
    assigned: BTreeSet<String>,
    /// Names of the types that the file declares.
    pub(super) own_types: BTreeSet<String>,
    /// Package of the file; `None` for the script.
    pub(super) package: Option<&'a str>,
    /// Functions that the file adds to types: the type's name, if known, and the function's name.
    pub(super) added: BTreeSet<(Option<&'a str>, String)>,
    /// Role of the current function.
    pub(super) role: FunctionRole,
    /// Current rule, as errors name it.
    rule: Option<String>,
    /// Function that infers the value that another file returns, from the name in `require`.
    pub(super) required: Option<&'f dyn Fn(&str) -> Inference<'a>>,
    pub(super) problems: Vec<Error>,
}

/// Collects the names of all assigned variables, and of all declared types.
fn collect_assigned(ast: &Ast, names: &mut BTreeSet<String>, types: &mut BTreeSet<String>) {
    use full_moon::visitors::Visitor;
    struct AssignmentNames<'a>(&'a mut BTreeSet<String>, &'a mut BTreeSet<String>);
    impl Visitor for AssignmentNames<'_> {
        fn visit_type_declaration(&mut self, declaration: &full_moon::ast::luau::TypeDeclaration) {
            self.1.insert(text_of(declaration.type_name()));
        }

        fn visit_assignment(&mut self, assignment: &full_moon::ast::Assignment) {
            for variable in assignment.variables() {
                if let Var::Name(name) = variable {
                    self.0.insert(text_of(name));
                }
            }
        }

        fn visit_compound_assignment(&mut self, assignment: &full_moon::ast::CompoundAssignment) {
            if let Var::Name(name) = assignment.lhs() {
                self.0.insert(text_of(name));
            }
        }
    }
    AssignmentNames(names, types).visit_ast(ast);
}

impl ScopeWalk for CallCheck<'_, '_> {
    fn in_scope(&self) -> usize {
        self.scope.len()
    }

    fn leave(&mut self, outside: usize) {
        self.scope.truncate(outside);
    }

    fn term(&mut self, expression: &Expression) {
        self.expression(expression);
    }

    fn counter(&mut self, numeric: &NumericFor) {
        self.declare(numeric.index_variable(), Inference::Value(Literal::Number));
    }

    fn open_block(&mut self, block: &Block) {
        for statement in block.stmts() {
            self.statement(statement);
        }
        if let Some(LastStmt::Return(last)) = block.last_stmt() {
            self.expressions(last.returns());
        }
    }
}

impl<'a, 'f> CallCheck<'a, 'f> {
    pub(super) fn new(
        file: &'a str,
        ast: &Ast,
        registry: &'a Registry,
        required: Option<&'f dyn Fn(&str) -> Inference<'a>>,
    ) -> Self {
        let (mut assigned, mut own_types) = (BTreeSet::new(), BTreeSet::new());
        collect_assigned(ast, &mut assigned, &mut own_types);
        let (role, rule) = (FunctionRole::Script, None);
        let added = BTreeSet::new();
        Self {
            added,
            package: None,
            file,
            registry,
            scope: Vec::new(),
            assigned,
            own_types,
            role,
            rule,
            required,
            problems: Vec::new(),
        }
    }

    /// Walks the whole file. Returns the inference for its return value.
    pub(super) fn file(&mut self, ast: &Ast) -> Inference<'a> {
        for statement in ast.nodes().stmts() {
            self.statement(statement);
        }
        match ast.nodes().last_stmt() {
            Some(LastStmt::Return(last)) => {
                let found: Vec<Inference<'a>> =
                    last.returns().iter().map(|value| self.expression(value)).collect();
                found.into_iter().next().unwrap_or(Inference::Unknown)
            }
            _ => Inference::Unknown,
        }
    }

    fn statement(&mut self, statement: &Stmt) {
        match statement {
            Stmt::Assignment(assignment) => {
                let found: Vec<Inference<'a>> =
                    assignment.expressions().iter().map(|value| self.expression(value)).collect();
                let found = found.into_iter().chain(std::iter::repeat(Inference::Unknown));
                for (variable, value) in assignment.variables().iter().zip(found) {
                    self.assigned_to(variable, &value);
                    self.remember(variable, value);
                }
            }
            Stmt::CompoundAssignment(assignment) => {
                self.expression(assignment.rhs());
                self.assigned_to(assignment.lhs(), &Inference::Unknown);
            }
            Stmt::FunctionCall(call) => {
                self.call(call);
            }
            Stmt::FunctionDeclaration(declaration) => self.function(declaration.body(), None),
            Stmt::LocalFunction(function) => {
                self.declare(function.name(), Inference::Local(Arc::new(signature(function.body()))));
                self.function(function.body(), None);
            }
            Stmt::ConstFunction(function) => {
                self.declare(function.name(), Inference::Unknown);
                self.function(function.body(), None);
            }
            Stmt::LocalAssignment(local) => {
                let types =
                    local.type_specifiers().map(|of| Some(of?.type_info().to_string().trim().to_owned()));
                self.local(local.names(), local.expressions(), &types.collect::<Vec<_>>());
            }
            Stmt::ConstAssignment(local) => self.local(local.names(), local.expressions(), &[]),
            Stmt::GenericFor(generic) => {
                self.expressions(generic.expressions());
                let outside = self.scope.len();
                for name in generic.names() {
                    self.declare(name, Inference::Unknown);
                }
                self.block(generic.block());
                self.scope.truncate(outside);
            }
            other => self.walk_nested(other),
        }
    }

    fn local(
        &mut self,
        names: &Punctuated<TokenReference>,
        values: &Punctuated<Expression>,
        types: &[Option<String>],
    ) {
        let found: Vec<Inference<'a>> = values.iter().map(|value| self.expression(value)).collect();
        for (((name, luau), value), known) in names.iter().zip(types).zip(values).zip(&found) {
            if let Some(luau) = luau {
                self.hold_declared(name, luau, value, known);
            }
        }
        let mut found = found.into_iter();
        for name in names {
            let known = found.next().unwrap_or(Inference::Unknown);
            self.declare(name, known);
        }
    }

    fn declare(&mut self, name: &TokenReference, known: Inference<'a>) {
        let name = text_of(name);
        let known = if self.assigned.contains(&name) { Inference::Unknown } else { known };
        self.scope.push((name, known));
    }

    /// Walks a function; `this` is the type of its first parameter, if known.
    pub(super) fn function(&mut self, body: &FunctionBody, this: Option<&'a Kind>) {
        let outside = self.scope.len();
        for (index, parameter) in body.parameters().iter().enumerate() {
            if let Parameter::Name(name) = parameter {
                let this = this.filter(|_| index == 0);
                self.declare(name, this.map_or(Inference::Unknown, Inference::Object));
            }
        }
        self.block(body.block());
        self.scope.truncate(outside);
    }

    /// Walks the arguments of a system's method; functions among them get `this` and a role.
    pub(super) fn rule(
        &mut self,
        call: &str,
        args: &[&Expression],
        kind: Option<&'a Kind>,
    ) -> Vec<Inference<'a>> {
        let outer = (self.role, self.rule.take());
        if let Some(Expression::String(text)) = args.first() {
            self.rule = string_of(text).map(|pattern| match call {
                "interpret" => format!("{pattern} (interpretation)"),
                _ => pattern,
            });
        }
        let role = if call == "interpret" { FunctionRole::Interpretation } else { FunctionRole::Rule };
        let found = args.iter().map(|arg| match arg {
            Expression::Function(function) => {
                self.role = role;
                self.function(function.body(), kind);
                self.role = outer.0;
                Inference::Value(Literal::Function)
            }
            Expression::TableConstructor(table) => {
                for field in table.fields() {
                    match field {
                        Field::NameKey { key, value, .. } => match &**value {
                            Expression::Function(function) if is_function_option(&text_of(key)) => {
                                self.role = FunctionRole::Guard;
                                self.function(function.body(), kind);
                                self.role = outer.0;
                            }
                            value => drop(self.expression(value)),
                        },
                        Field::NoKey(value) => drop(self.expression(value)),
                        _ => {}
                    }
                }
                Inference::Value(Literal::Table)
            }
            other => self.expression(other),
        });
        let found = found.collect();
        (self.role, self.rule) = outer;
        found
    }

    fn expressions(&mut self, expressions: &Punctuated<Expression>) {
        for expression in expressions {
            self.expression(expression);
        }
    }

    pub(super) fn expression(&mut self, expression: &Expression) -> Inference<'a> {
        match expression {
            Expression::BinaryOperator { lhs, rhs, .. } => {
                self.expression(lhs);
                self.expression(rhs);
                Inference::Unknown
            }
            Expression::Parentheses { expression, .. } => self.expression(expression),
            Expression::TypeAssertion { expression, .. } => {
                self.expression(expression);
                Inference::Unknown
            }
            Expression::UnaryOperator { unop, expression } => {
                let known = self.expression(expression);
                match (unop, known) {
                    (UnOp::Minus(_), Inference::Value(Literal::Number)) => Inference::Value(Literal::Number),
                    _ => Inference::Unknown,
                }
            }
            Expression::Function(function) => {
                self.function(function.body(), None);
                Inference::Value(Literal::Function)
            }
            Expression::FunctionCall(call) => self.call(call),
            Expression::IfExpression(branches) => {
                self.expression(branches.condition());
                self.expression(branches.if_expression());
                for branch in branches.else_if_expressions().into_iter().flatten() {
                    self.expression(branch.condition());
                    self.expression(branch.expression());
                }
                self.expression(branches.else_expression());
                Inference::Unknown
            }
            Expression::Number(_) => Inference::Value(Literal::Number),
            Expression::String(token) => {
                string_of(token).map_or(Inference::Unknown, |text| Inference::Value(Literal::Text(text)))
            }
            Expression::Symbol(symbol) => match text_of(symbol).as_str() {
                "nil" => Inference::Value(Literal::Nil),
                "true" | "false" => Inference::Value(Literal::Boolean),
                _ => Inference::Unknown,
            },
            Expression::TableConstructor(table) => self.table(table),
            Expression::Var(variable) => self.variable(variable),
            _ => Inference::Unknown,
        }
    }

    fn table(&mut self, table: &TableConstructor) -> Inference<'a> {
        let mut named = BTreeMap::new();
        for field in table.fields() {
            match field {
                Field::ExpressionKey { key, value, .. } => {
                    self.expression(key);
                    self.expression(value);
                }
                Field::NameKey { key, value, .. } => {
                    let found = self.expression(value);
                    if found.is_telling() {
                        named.insert(text_of(key), found);
                    }
                }
                Field::NoKey(value) => drop(self.expression(value)),
                _ => {}
            }
        }
        if named.is_empty() { Inference::Value(Literal::Table) } else { Inference::Table(Arc::new(named)) }
    }

    fn variable(&mut self, variable: &Var) -> Inference<'a> {
        match variable {
            Var::Name(name) => self.infer_name(name),
            Var::Expression(inner) => {
                let suffixes: Vec<&Suffix> = inner.suffixes().collect();
                self.suffixes(inner.prefix(), &suffixes)
            }
            _ => Inference::Unknown,
        }
    }

    fn call(&mut self, call: &FunctionCall) -> Inference<'a> {
        let suffixes: Vec<&Suffix> = call.suffixes().collect();
        self.suffixes(call.prefix(), &suffixes)
    }

    pub(super) fn suffixes(&mut self, prefix: &Prefix, suffixes: &[&Suffix]) -> Inference<'a> {
        let mut known = match prefix {
            Prefix::Name(name) => self.infer_name(name),
            Prefix::Expression(expression) => self.expression(expression),
            _ => Inference::Unknown,
        };
        let (mut word, mut path) = match prefix {
            Prefix::Name(name) => (Some(name), text_of(name)),
            _ => (None, String::new()),
        };
        let mut dotted: Option<(Inference<'a>, String)> = None;
        for suffix in suffixes {
            // Value and text before the dot of a call such as this.forward(1).
            let owner = std::mem::take(&mut dotted);
            known = match suffix {
                Suffix::Index(Index::Dot { name, .. }) => {
                    dotted = Some((known.clone(), path.clone()));
                    word = Some(name);
                    path = format!("{path}.{}", text_of(name));
                    self.field(&known, name)
                }
                Suffix::Index(Index::Brackets { expression, .. }) => {
                    self.expression(expression);
                    Inference::Unknown
                }
                Suffix::Call(Call::AnonymousCall(args)) => {
                    if let (Some((of, dotted)), Some(name)) = (&owner, word) {
                        self.refuse_dot(of, dotted, name, args);
                    }
                    self.infer_call(&known, word, &path, args)
                }
                Suffix::Call(Call::MethodCall(method)) => {
                    word = Some(method.name());
                    self.method(&known, method.name(), method.args())
                }
                _ => Inference::Unknown,
            };
        }
        known
    }

    pub(super) fn arguments(&mut self, args: &FunctionArgs) -> Vec<Inference<'a>> {
        match args {
            FunctionArgs::Parentheses { arguments, .. } => {
                arguments.iter().map(|argument| self.expression(argument)).collect()
            }
            FunctionArgs::String(token) => {
                vec![
                    string_of(token).map_or(Inference::Unknown, |text| Inference::Value(Literal::Text(text))),
                ]
            }
            FunctionArgs::TableConstructor(table) => {
                vec![self.table(table)]
            }
            _ => Vec::new(),
        }
    }

    pub(super) fn problem(&mut self, token: &TokenReference, error: Error) {
        self.problem_of(token, error);
    }

    /// Adds the problem of a syntax node, with the columns of the node.
    pub(super) fn problem_of(&mut self, piece: &impl Node, error: Error) {
        let columns = piece.start_position().zip(piece.end_position());
        let columns = columns.and_then(|(begin, end)| columns_between(begin, end));
        let error = error.at_line(self.file, line_of(piece));
        let error = columns.into_iter().fold(error, Error::in_columns);
        let error = match &self.rule {
            Some(rule) if self.role != FunctionRole::Script => error.rule(rule),
            _ => error,
        };
        self.problems.push(error);
    }
}

/// Returns the arguments of a call with brackets.
pub(super) fn expressions_of(args: &FunctionArgs) -> Vec<&Expression> {
    match args {
        FunctionArgs::Parentheses { arguments, .. } => arguments.iter().collect(),
        _ => Vec::new(),
    }
}

/// Returns the value of a field in a table constructor.
pub(super) fn field_named<'a>(table: &'a TableConstructor, name: &str) -> Option<&'a Expression> {
    table.fields().iter().find_map(|field| match field {
        Field::NameKey { key, value, .. } if text_of(key) == name => Some(&**value),
        _ => None,
    })
}

/// Returns the line on which a node begins.
pub(super) fn line_of(piece: &impl Node) -> usize {
    piece.start_position().map_or(1, |position| position.line())
}
