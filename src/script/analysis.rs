//! Reads a script before it runs: finds mistakes that can be seen without running it, and prepares its rules.
//!
//! Three things are changed in the text, and no line break is: a rule's `return A(x), { B(y) }` becomes one call
//! with all parameters, since its modules and brackets, its shape, can be seen from the text; its other
//! returns are told apart into nothing, nil and lists; and an assignment in a function to a variable from
//! outside it is preceded by a check that no rule is running.

use std::sync::mpsc::channel;
use std::time::Duration;

use full_moon::ast::luau::{ElseIfExpression, IfExpression};
use full_moon::ast::punctuated::Punctuated;
use full_moon::ast::{
    Ast, Block, Call, Expression, Field, FunctionArgs, FunctionBody, FunctionCall, Index, LastStmt,
    Parameter, Prefix, Stmt, Suffix, TableConstructor, Var,
};
use full_moon::node::Node;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use full_moon::tokenizer::{Position, TokenReference, TokenType};
use mlua::chunk::Compiler;
use rustc_hash::FxHashMap;

use crate::error::{Error, Place, nearest};
use crate::rules::Signature;

/// The most parameters that a prepared return can have.
const MOST_EMITTED: usize = 64;

/// Added to the number of a shape, so that it cannot be taken for a count of modules.
const SHAPE: usize = 1 << 30;

/// What a script may use without declaring it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Globals {
    /// The names of values.
    pub names: Vec<String>,
    /// The modules among them.
    pub modules: FxHashMap<String, Signature>,
    /// Counts the shapes of the run's rules.
    pub shapes: Arc<AtomicUsize>,
}

/// What reading a script gives.
#[derive(Debug, Clone, Default)]
pub(crate) struct Analysis {
    /// The text to run, with as many lines as the script.
    pub text: String,
    /// What is wrong, by line.
    pub problems: Vec<Error>,
    /// Whether the script names `random`.
    pub random: bool,
}

/// The stack (bytes) for reading a script: enough for the deepest nesting that Luau compiles.
const STACK: usize = 256 << 20;

/// How long reading a script may take. The parser's time doubles with each level of nested strings.
const PATIENCE: Duration = Duration::from_secs(30);

/// Reads `text`, the content of `file`. What Luau does not compile is left as it stands, for it to tell.
pub(crate) fn analyse(file: &str, text: &str, globals: &Globals) -> Analysis {
    // Luau bounds the nesting of what it compiles; the parser used here does not, so it comes second.
    if Compiler::new().compile(text).is_err() {
        return unread(text, Vec::new());
    }
    let (sender, receiver) = channel();
    let (name, source, known) = (file.to_owned(), text.to_owned(), globals.clone());
    // The receiver may have given up.
    let read = move || drop(sender.send(analyse_compiled(&name, &source, &known)));
    let started = std::thread::Builder::new().stack_size(STACK).spawn(read).is_ok();
    match receiver.recv_timeout(PATIENCE) {
        Ok(analysis) if started => analysis,
        _ => {
            let error = Error::new(format!("reading {file} takes too long"))
                .help("nest strings such as `a {`b`}` less deeply, or divide the file");
            unread(text, vec![error])
        }
    }
}

/// The analysis of a script that is not to be run.
fn unread(text: &str, problems: Vec<Error>) -> Analysis {
    Analysis { text: text.to_owned(), problems, random: true }
}

fn analyse_compiled(file: &str, text: &str, globals: &Globals) -> Analysis {
    let refuse = |line: usize| {
        let place = Place { file: file.to_owned(), line };
        let error = Error::new("this part of Luau's syntax is not known to Burgeon")
            .help("write it in another way; attributes in brackets, such as @[native], are not needed");
        unread(text, vec![error.at(Some(place))])
    };
    let ast = match full_moon::parse(text) {
        Ok(ast) => ast,
        Err(errors) => return refuse(errors.first().map_or(1, |error| error.range().0.line())),
    };
    // The first walk learns which variables are assigned and which functions make no modules; the second uses it.
    let mut first = Walk::new(file, globals, Facts::default());
    first.run(&ast);
    let mut second = Walk::new(file, globals, std::mem::take(&mut first.facts));
    second.run(&ast);
    let Walk { mut edits, mut problems, random, .. } = second;
    problems.sort_by(|a, b| a.place().cmp(&b.place()));
    // What is put before a token comes before what replaces it.
    edits.sort_by_key(|edit| (edit.begin, edit.end > edit.begin, edit.order));
    let mut out = String::with_capacity(text.len() + 64 * edits.len());
    let mut at = 0;
    for edit in &edits {
        if edit.begin < at {
            return refuse(text[..edit.begin].matches('\n').count() + 1);
        }
        out.push_str(&text[at..edit.begin]);
        out.push_str(&edit.text);
        at = edit.end;
    }
    out.push_str(&text[at..]);
    Analysis { text: out, problems, random }
}

/// What the first walk learned about the variables, in the order of their declaration.
#[derive(Default)]
struct Facts {
    variables: Vec<Fact>,
}

#[derive(Default, Clone)]
struct Fact {
    assigned: bool,
    assigned_inside: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Script,
    Rule,
    Guard,
    Interpretation,
    Other,
}

struct Function {
    role: Role,
    /// The rule that it belongs to, as errors name it.
    rule: Option<String>,
    /// What its prepared returns make, as Lua tables.
    shapes: Vec<String>,
}

struct Variable {
    name: String,
    id: usize,
    function: usize,
    module: Option<Signature>,
}

/// What a return makes, as far as its text tells: symbols and brackets, and where the parameters stand.
#[derive(Default)]
struct Shape {
    items: Vec<String>,
    arguments: Vec<Argument>,
}

enum Argument {
    /// From one place to another; open if it may have any number of values, of which one is taken.
    At(usize, usize, bool),
    /// Left out, before this place.
    Missing(usize),
}

struct Edit {
    begin: usize,
    end: usize,
    text: String,
    order: usize,
}

struct Walk<'a> {
    file: &'a str,
    globals: &'a Globals,
    known: Facts,
    facts: Facts,
    functions: Vec<Function>,
    variables: Vec<Variable>,
    edits: Vec<Edit>,
    problems: Vec<Error>,
    random: bool,
    /// The rule whose functions are being walked.
    rule: Option<String>,
}

impl<'a> Walk<'a> {
    fn new(file: &'a str, globals: &'a Globals, known: Facts) -> Self {
        Self {
            file,
            globals,
            known,
            facts: Facts::default(),
            functions: vec![Function { role: Role::Script, rule: None, shapes: Vec::new() }],
            variables: Vec::new(),
            edits: Vec::new(),
            problems: Vec::new(),
            random: false,
            rule: None,
        }
    }

    fn run(&mut self, ast: &Ast) {
        self.block(ast.nodes());
    }

    fn block(&mut self, block: &Block) {
        let outside = self.variables.len();
        self.open_block(block);
        self.variables.truncate(outside);
    }

    /// Walks a block and leaves its variables in scope.
    fn open_block(&mut self, block: &Block) {
        for statement in block.stmts() {
            self.statement(statement);
        }
        if let Some(LastStmt::Return(statement)) = block.last_stmt() {
            self.returns(statement.token(), statement.returns());
        }
    }

    fn statement(&mut self, statement: &Stmt) {
        match statement {
            Stmt::Assignment(assignment) => {
                self.expressions(assignment.expressions());
                for variable in assignment.variables() {
                    self.assign(variable, statement);
                }
            }
            Stmt::CompoundAssignment(assignment) => {
                self.expression(assignment.rhs());
                self.assign(assignment.lhs(), statement);
            }
            Stmt::Do(inner) => self.block(inner.block()),
            Stmt::FunctionCall(call) => self.call(call),
            Stmt::FunctionDeclaration(declaration) => {
                let names = declaration.name().names();
                if let Some(first) = names.first() {
                    if names.len() == 1 && declaration.name().method_name().is_none() {
                        self.assign_name(first.value(), statement);
                    } else {
                        self.read(first.value());
                    }
                }
                self.function(declaration.body(), Role::Other, declaration.name().method_name().is_some());
            }
            Stmt::LocalFunction(function) => self.local_function(function.name(), function.body(), statement),
            Stmt::ConstFunction(function) => self.local_function(function.name(), function.body(), statement),
            Stmt::LocalAssignment(local) => self.local(local.names(), local.expressions(), statement),
            Stmt::ConstAssignment(local) => self.local(local.names(), local.expressions(), statement),
            Stmt::GenericFor(generic) => {
                self.expressions(generic.expressions());
                let outside = self.variables.len();
                for name in generic.names() {
                    self.declare(name, first_position(generic.block(), generic.end_token()));
                }
                self.block(generic.block());
                self.variables.truncate(outside);
            }
            Stmt::NumericFor(numeric) => {
                self.expression(numeric.start());
                self.expression(numeric.end());
                if let Some(step) = numeric.step() {
                    self.expression(step);
                }
                let outside = self.variables.len();
                self.declare(numeric.index_variable(), first_position(numeric.block(), numeric.end_token()));
                self.block(numeric.block());
                self.variables.truncate(outside);
            }
            Stmt::If(branches) => {
                self.expression(branches.condition());
                self.block(branches.block());
                for branch in branches.else_if().into_iter().flatten() {
                    self.expression(branch.condition());
                    self.block(branch.block());
                }
                if let Some(block) = branches.else_block() {
                    self.block(block);
                }
            }
            Stmt::Repeat(repeat) => {
                let outside = self.variables.len();
                self.open_block(repeat.block());
                self.expression(repeat.until());
                self.variables.truncate(outside);
            }
            Stmt::While(repeat) => {
                self.expression(repeat.condition());
                self.block(repeat.block());
            }
            _ => {}
        }
    }

    fn local_function(&mut self, name: &TokenReference, body: &FunctionBody, statement: &Stmt) {
        self.declare(name, end_of(statement).map(|end| end.bytes()));
        self.function(body, Role::Other, false);
    }

    fn local(
        &mut self,
        names: &Punctuated<TokenReference>,
        values: &Punctuated<Expression>,
        statement: &Stmt,
    ) {
        self.expressions(values);
        let values: Vec<&Expression> = values.iter().collect();
        for (index, name) in names.iter().enumerate() {
            let id = self.declare(name, end_of(statement).map(|end| end.bytes()));
            let module = values.get(index).and_then(|value| declared_module(value));
            if let Some(variable) = self.variables.last_mut().filter(|variable| variable.id == id) {
                variable.module = module;
            }
        }
    }

    /// Puts a variable into scope. `behind` is where a statement may follow its declaration.
    fn declare(&mut self, name: &TokenReference, behind: Option<usize>) -> usize {
        let id = self.facts.variables.len();
        self.facts.variables.push(Fact::default());
        let function = self.functions.len() - 1;
        let text = text_of(name);
        if text.starts_with("__") {
            let error = Error::new(format!("a variable cannot be called {text}"));
            self.problem(name, error.help("names that begin with two underscores are Burgeon's own"));
        }
        self.variables.push(Variable { name: text, id, function, module: None });
        if function > 0
            && self.fact(id).assigned_inside
            && let Some(at) = behind
        {
            self.edit(at, at, format!(" local __epoch_{id} = __epoch();"));
        }
        id
    }

    fn fact(&self, id: usize) -> Fact {
        self.known.variables.get(id).cloned().unwrap_or_default()
    }

    fn find(&self, name: &str) -> Option<&Variable> {
        self.variables.iter().rev().find(|variable| variable.name == name)
    }

    fn assign(&mut self, variable: &Var, statement: &Stmt) {
        match variable {
            Var::Name(name) => self.assign_name(name, statement),
            Var::Expression(expression) => {
                self.prefix(expression.prefix());
                for suffix in expression.suffixes() {
                    self.suffix(suffix);
                }
            }
            _ => {}
        }
    }

    fn assign_name(&mut self, token: &TokenReference, statement: &Stmt) {
        let name = text_of(token);
        let here = self.functions.len() - 1;
        let rule = self
            .functions
            .iter()
            .rposition(|function| matches!(function.role, Role::Rule | Role::Guard | Role::Interpretation));
        let found = self.find(&name).map(|variable| (variable.id, variable.function));
        let Some((id, owner)) = found else {
            if self.globals.names.contains(&name) {
                let error = Error::new(format!("{name} is Burgeon's own and cannot be assigned"));
                self.problem(token, error.help("choose another name: local ..."));
                return;
            }
            let error = Error::new(format!("{name} is assigned, but it is no local variable"));
            self.problem(token, match rule {
                Some(_) => error.help("a rule writes only its own locals; declare it inside: local ..., or use an interpretation rule to change the object"),
                None => error.help(format!("scripts have no globals of their own; write: local {name} = ...")),
            });
            return;
        };
        let fact = &mut self.facts.variables[id];
        fact.assigned = true;
        fact.assigned_inside |= owner < here;
        if let Some(rule) = rule {
            if owner < rule {
                let what = match self.functions[rule].role {
                    Role::Guard => "a guard",
                    Role::Interpretation => "an interpretation rule",
                    _ => "a rule",
                };
                let help = match self.functions[rule].role {
                    Role::Interpretation => {
                        "it changes only this; keep what must be remembered in a parameter of a module"
                    }
                    _ => {
                        "carry it in a parameter of a module; to change the object, use an interpretation rule"
                    }
                };
                self.problem(
                    token,
                    Error::new(format!("{what} assigns {name}, a variable from outside it")).help(help),
                );
            }
            return;
        }
        if owner < here
            && let Some(begin) = statement.start_position()
        {
            let epoch = if owner == 0 { "0".to_owned() } else { format!("__epoch_{id}") };
            self.edit(begin.bytes(), begin.bytes(), format!("__guard(\"{name}\", {epoch}); "));
        }
    }

    fn read(&mut self, token: &TokenReference) {
        let name = text_of(token);
        self.random |= name == "random";
        if self.find(&name).is_some() || self.globals.names.contains(&name) {
            return;
        }
        let locals = self.variables.iter().rev().map(|variable| variable.name.as_str());
        let near = nearest(&name, locals.chain(self.globals.names.iter().map(String::as_str)));
        let error = Error::new(format!("unknown name {name}"));
        if let Some(instead) = instead_of(&name) {
            return self.problem(token, error.help(instead));
        }
        let error = match (near, name.starts_with(|c: char| c.is_ascii_uppercase())) {
            (Some(near), _) => error.help(format!("did you mean {near}?")),
            (None, true) => error.help(format!("declare it as a module: local {name} = module(\"{name}\")")),
            (None, false) => error.help(format!("declare it: local {name} = ...")),
        };
        self.problem(token, error);
    }

    fn expressions(&mut self, expressions: &Punctuated<Expression>) {
        for expression in expressions {
            self.expression(expression);
        }
    }

    fn expression(&mut self, expression: &Expression) {
        match expression {
            Expression::BinaryOperator { lhs, rhs, .. } => {
                self.expression(lhs);
                self.expression(rhs);
            }
            Expression::Parentheses { expression, .. }
            | Expression::UnaryOperator { expression, .. }
            | Expression::TypeAssertion { expression, .. } => self.expression(expression),
            Expression::Function(function) => {
                self.function(function.body(), Role::Other, false);
            }
            Expression::FunctionCall(call) => self.call(call),
            Expression::IfExpression(branches) => self.if_expression(branches),
            Expression::InterpolatedString(string) => {
                for inner in string.expressions() {
                    self.expression(inner);
                }
            }
            Expression::TableConstructor(table) => self.table(table),
            Expression::Var(variable) => match variable {
                Var::Name(name) => {
                    self.read(name);
                }
                Var::Expression(expression) => {
                    self.library_field(expression.prefix(), expression.suffixes().next());
                    self.prefix(expression.prefix());
                    for suffix in expression.suffixes() {
                        self.suffix(suffix);
                    }
                }
                _ => {}
            },
            _ => {}
        }
    }

    fn if_expression(&mut self, branches: &IfExpression) {
        self.expression(branches.condition());
        self.expression(branches.if_expression());
        for branch in branches.else_if_expressions().into_iter().flatten() {
            let branch: &ElseIfExpression = branch;
            self.expression(branch.condition());
            self.expression(branch.expression());
        }
        self.expression(branches.else_expression());
    }

    fn table(&mut self, table: &TableConstructor) {
        for field in table.fields() {
            match field {
                Field::ExpressionKey { key, value, .. } => {
                    self.expression(key);
                    self.expression(value);
                }
                Field::NameKey { value, .. } => self.expression(value),
                Field::NoKey(value) => self.expression(value),
                _ => {}
            }
        }
    }

    fn prefix(&mut self, prefix: &Prefix) {
        match prefix {
            Prefix::Expression(expression) => self.expression(expression),
            Prefix::Name(name) => {
                self.read(name);
            }
            _ => {}
        }
    }

    fn suffix(&mut self, suffix: &Suffix) {
        match suffix {
            Suffix::Call(Call::AnonymousCall(arguments)) => self.arguments(arguments),
            Suffix::Call(Call::MethodCall(method)) => self.arguments(method.args()),
            Suffix::Index(Index::Brackets { expression, .. }) => self.expression(expression),
            _ => {}
        }
    }

    fn arguments(&mut self, arguments: &FunctionArgs) {
        match arguments {
            FunctionArgs::Parentheses { arguments, .. } => self.expressions(arguments),
            FunctionArgs::TableConstructor(table) => self.table(table),
            _ => {}
        }
    }

    /// Refuses the fields of Luau's tables that scripts do not have.
    fn library_field(&mut self, prefix: &Prefix, suffix: Option<&Suffix>) {
        if let (Prefix::Name(table), Some(Suffix::Index(Index::Dot { name, .. }))) = (prefix, suffix)
            && self.find(&text_of(table)).is_none()
        {
            let name = format!("{}.{}", text_of(table), text_of(name));
            if let Some(instead) = instead_of(&name) {
                self.problem(table, Error::new(format!("unknown name {name}")).help(instead));
            }
        }
    }

    fn call(&mut self, call: &FunctionCall) {
        let suffixes: Vec<&Suffix> = call.suffixes().collect();
        self.library_field(call.prefix(), suffixes.first().copied());
        if let (Prefix::Name(name), [Suffix::Call(Call::AnonymousCall(arguments))]) =
            (call.prefix(), suffixes.as_slice())
            && let Some(signature) = self.module(name)
        {
            self.check_arity(name, &signature, arguments);
        }
        match call.prefix() {
            Prefix::Name(name) => self.read(name),
            prefix => self.prefix(prefix),
        }
        for suffix in suffixes {
            match suffix {
                Suffix::Call(Call::MethodCall(method)) => match text_of(method.name()).as_str() {
                    "rule" => self.rule(method.args(), Role::Rule),
                    "interpret" => self.rule(method.args(), Role::Interpretation),
                    _ => self.suffix(suffix),
                },
                _ => self.suffix(suffix),
            }
        }
    }

    fn check_arity(&mut self, name: &TokenReference, signature: &Signature, arguments: &FunctionArgs) {
        let FunctionArgs::Parentheses { arguments, .. } = arguments else { return };
        let open = matches!(arguments.iter().last(), Some(Expression::FunctionCall(_)))
            || matches!(arguments.iter().last(), Some(Expression::Symbol(symbol)) if text_of(symbol) == "...");
        let given = arguments.len();
        let few = given < signature.required && !open;
        let many = given > signature.arity() + usize::from(open);
        if few || many {
            self.problem(
                name,
                Error::new(format!("{} has {}, not {given}", signature.name, signature.count()))
                    .help(format!("it was declared as {}", signature.usage())),
            );
        }
    }

    /// The signature of the module whose constructor `name` is.
    fn module(&self, name: &TokenReference) -> Option<Signature> {
        let text = text_of(name);
        match self.find(&text) {
            Some(variable) if self.fact(variable.id).assigned => None,
            Some(variable) => variable.module.clone(),
            None => self.globals.modules.get(&text).cloned(),
        }
    }

    /// Walks the arguments of `:rule` or `:interpret`; the functions among them have a role.
    fn rule(&mut self, arguments: &FunctionArgs, role: Role) {
        let FunctionArgs::Parentheses { arguments, .. } = arguments else { return self.arguments(arguments) };
        let last = arguments.len().saturating_sub(1);
        let outer = self.rule.take();
        if let Some(Expression::String(text)) = arguments.iter().next() {
            let pattern = string_of(text).filter(|pattern| !pattern.is_empty());
            self.rule = pattern.map(|pattern| match role {
                Role::Interpretation => format!("{pattern} (interpretation)"),
                _ => pattern,
            });
        }
        for (index, argument) in arguments.iter().enumerate() {
            match argument {
                Expression::Function(function) if index == last && index > 0 => {
                    if role == Role::Rule {
                        self.prepared(argument, function.body(), role);
                    } else {
                        self.function(function.body(), role, false);
                    }
                }
                Expression::TableConstructor(table) if role == Role::Rule => {
                    for field in table.fields() {
                        match field {
                            Field::NameKey { key, value, .. } => match &**value {
                                Expression::Function(function) if text_of(key) == "when" => {
                                    self.prepared(value, function.body(), Role::Guard);
                                }
                                value => self.expression(value),
                            },
                            Field::NoKey(value) => self.expression(value),
                            _ => {}
                        }
                    }
                }
                other => self.expression(other),
            }
        }
        self.rule = outer;
    }

    /// Walks a function of a rule, and lets the script say that it has been seen.
    fn prepared(&mut self, value: &Expression, body: &FunctionBody, role: Role) {
        if let (Some(begin), Some(end)) = (value.start_position(), end_of(value)) {
            self.edit(begin.bytes(), begin.bytes(), "__prepared(".to_owned());
            let shapes = self.function(body, role, false);
            let shapes: String = shapes.iter().map(|shape| format!(", {shape}")).collect();
            self.edit(end.bytes(), end.bytes(), format!("{shapes})"));
        }
    }

    /// Walks a function, which has a `self` if it `is_method`; gives the shapes of its returns.
    fn function(&mut self, body: &FunctionBody, role: Role, is_method: bool) -> Vec<String> {
        let outside = self.variables.len();
        let start = first_position(body.block(), body.end_token());
        let mut parameters = body.parameters().iter();
        let rule = if role == Role::Other { None } else { self.rule.clone() };
        self.functions.push(Function { role, rule, shapes: Vec::new() });
        if is_method {
            let id = self.facts.variables.len();
            self.facts.variables.push(Fact::default());
            self.variables.push(Variable {
                name: "self".to_owned(),
                id,
                function: self.functions.len() - 1,
                module: None,
            });
        }
        for parameter in parameters.by_ref() {
            if let Parameter::Name(name) = parameter {
                self.declare(name, start);
            }
        }
        self.block(body.block());
        self.variables.truncate(outside);
        self.functions.pop().map(|function| function.shapes).unwrap_or_default()
    }

    fn returns(&mut self, token: &TokenReference, values: &Punctuated<Expression>) {
        if self.functions.last().is_none_or(|function| function.role != Role::Rule) {
            return self.expressions(values);
        }
        self.expressions(values);
        let (Some(begin), Some(end)) = (token.end_position(), values.iter().last().and_then(end_of)) else {
            return;
        };
        let mut shape = Shape::default();
        if values.iter().all(|value| self.shape(value, &mut shape)) && shape.arguments.len() <= MOST_EMITTED {
            self.emit(begin.bytes(), end.bytes(), values, &shape);
        } else if values.len() == 1
            && matches!(values.iter().next(), Some(Expression::Symbol(symbol)) if text_of(symbol) == "nil")
        {
            self.edit(begin.bytes(), end.bytes(), " __erased".to_owned());
        } else {
            self.edit(begin.bytes(), begin.bytes(), " __list(".to_owned());
            self.edit(end.bytes(), end.bytes(), ")".to_owned());
        }
    }

    /// Writes `return A(x), { B(y) }` as one call with the shape's number and the parameters in order.
    fn emit(&mut self, begin: usize, end: usize, values: &Punctuated<Expression>, shape: &Shape) {
        let number = self.globals.shapes.fetch_add(1, Ordering::Relaxed);
        self.edit(begin, begin, format!(" __emit{}({}", shape.arguments.len(), SHAPE + number));
        self.blank_items(values);
        for argument in &shape.arguments {
            match argument {
                Argument::At(from, to, open) => {
                    self.edit(*from, *from, if *open { ", (" } else { ", " }.to_owned());
                    self.edit(*to, *to, if *open { ")" } else { "" }.to_owned());
                }
                Argument::Missing(at) => self.edit(*at, *at, ", nil".to_owned()),
            }
        }
        self.edit(end, end, ")".to_owned());
        if let Some(function) = self.functions.last_mut() {
            function.shapes.push(format!("{{ {}, {} }}", SHAPE + number, shape.items.join(", ")));
        }
    }

    /// Adds what `value` makes to `shape`; `false` if that cannot be seen from its text.
    fn shape(&self, value: &Expression, shape: &mut Shape) -> bool {
        match value {
            Expression::FunctionCall(call) => {
                let suffixes: Vec<&Suffix> = call.suffixes().collect();
                let (Prefix::Name(name), [Suffix::Call(Call::AnonymousCall(arguments))]) =
                    (call.prefix(), suffixes.as_slice())
                else {
                    return false;
                };
                let FunctionArgs::Parentheses { parentheses, arguments } = &**arguments else { return false };
                let (Some(signature), Some(close)) =
                    (self.module(name), parentheses.tokens().1.start_position())
                else {
                    return false;
                };
                // The shape is made outside of the rule's function, where the module must mean the same.
                let inside =
                    self.find(&text_of(name)).is_some_and(|known| known.function + 1 >= self.functions.len());
                let given = arguments.len();
                if inside || given < signature.required || given > signature.arity() {
                    return false;
                }
                shape.items.push(text_of(name));
                for (index, argument) in arguments.iter().enumerate() {
                    let open = is_open(argument) && index + 1 == given;
                    if open && given < signature.arity() {
                        return false;
                    }
                    let (Some(from), Some(to)) = (argument.start_position(), end_of(argument)) else {
                        return false;
                    };
                    shape.arguments.push(Argument::At(from.bytes(), to.bytes(), open));
                }
                shape.arguments.extend((given..signature.arity()).map(|_| Argument::Missing(close.bytes())));
                true
            }
            Expression::TableConstructor(table) => {
                shape.items.push("0".to_owned());
                let known = table.fields().iter().all(|field| match field {
                    Field::NoKey(value) => self.shape(value, shape),
                    _ => false,
                });
                shape.items.push("1".to_owned());
                known
            }
            _ => false,
        }
    }

    /// Takes away everything of a list of items but the arguments.
    fn blank_items(&mut self, values: &Punctuated<Expression>) {
        for pair in values.pairs() {
            self.blank_item(pair.value());
            if let Some(comma) = pair.punctuation() {
                self.blank(comma, "");
            }
        }
    }

    fn blank_item(&mut self, value: &Expression) {
        match value {
            Expression::FunctionCall(call) => {
                if let Prefix::Name(name) = call.prefix() {
                    self.blank(name, "");
                }
                for suffix in call.suffixes() {
                    if let Suffix::Call(Call::AnonymousCall(arguments)) = suffix
                        && let FunctionArgs::Parentheses { parentheses, arguments } = &**arguments
                    {
                        let (open, close) = parentheses.tokens();
                        self.blank(open, "");
                        for comma in arguments.pairs().filter_map(|pair| pair.punctuation()) {
                            self.blank(comma, "");
                        }
                        self.blank(close, "");
                    }
                }
            }
            Expression::TableConstructor(table) => {
                let (open, close) = table.braces().tokens();
                self.blank(open, "");
                for pair in table.fields().pairs() {
                    if let Field::NoKey(value) = pair.value() {
                        self.blank_item(value);
                    }
                    if let Some(separator) = pair.punctuation() {
                        self.blank(separator, "");
                    }
                }
                self.blank(close, "");
            }
            _ => {}
        }
    }

    /// Replaces a token by `text`.
    fn blank(&mut self, token: &TokenReference, text: &str) {
        if let (Some(begin), Some(end)) = (token.start_position(), token.end_position()) {
            self.edit(begin.bytes(), end.bytes(), text.to_owned());
        }
    }

    fn edit(&mut self, begin: usize, end: usize, text: String) {
        let order = self.edits.len();
        self.edits.push(Edit { begin, end, text, order });
    }

    fn problem(&mut self, token: &TokenReference, error: Error) {
        let line = token.start_position().map_or(1, |position| position.line());
        let error = error.at(Some(Place { file: self.file.to_owned(), line }));
        let rule = self.functions.iter().rev().find_map(|function| function.rule.as_ref());
        self.problems.push(match rule {
            Some(rule) => error.rule(rule),
            None => error,
        });
    }
}

/// What to write in place of a name of Lua that scripts do not have.
fn instead_of(name: &str) -> Option<&'static str> {
    Some(match name {
        "io" | "os" | "package" | "dofile" | "loadfile" => {
            "scripts reach no files, clock or programs; other scripts in the folder come in with require"
        }
        "loadstring" | "load" => "scripts do not compile text; a successor may be given as a string",
        "_G" | "getfenv" | "setfenv" | "shared" => {
            "there are no globals to change; pass values on as parameters or with require"
        }
        "debug" | "newproxy" | "collectgarbage" | "gcinfo" => "a script does without it",
        "math.random" => "write random() or random(low, high), which follow the seed and the module",
        "math.randomseed" => "give the seed with --seed, or a system its own: lsystem { seed = 7 }",
        "math.noise" => "write noise(x, y, z)",
        _ => return None,
    })
}

/// Whether an expression may have any number of values.
fn is_open(expression: &Expression) -> bool {
    match expression {
        Expression::FunctionCall(_) => true,
        Expression::Symbol(symbol) => text_of(symbol) == "...",
        _ => false,
    }
}

fn text_of(token: &TokenReference) -> String {
    token.token().to_string()
}

/// Where a piece of the script ends. The parser's own answer is the place before a closing bracket.
fn end_of(piece: &impl Node) -> Option<Position> {
    piece.tokens().filter_map(|token| token.end_position()).max_by_key(|position| position.bytes())
}

fn first_position(block: &Block, end: &TokenReference) -> Option<usize> {
    let first =
        block.stmts().next().and_then(Node::start_position).or_else(|| block.last_stmt()?.start_position());
    first.or_else(|| end.start_position()).map(|position| position.bytes())
}

/// The signature, where `value` is `module("Name", "parameter", ...)`.
fn declared_module(value: &Expression) -> Option<Signature> {
    let Expression::FunctionCall(call) = value else { return None };
    let suffixes: Vec<&Suffix> = call.suffixes().collect();
    let (Prefix::Name(name), [Suffix::Call(Call::AnonymousCall(arguments))]) =
        (call.prefix(), suffixes.as_slice())
    else {
        return None;
    };
    if text_of(name) != "module" {
        return None;
    }
    let texts: Vec<String> = match &**arguments {
        FunctionArgs::String(text) => vec![string_of(text)?],
        FunctionArgs::Parentheses { arguments, .. } => arguments
            .iter()
            .map(|argument| match argument {
                Expression::String(text) => string_of(text),
                _ => None,
            })
            .collect::<Option<_>>()?,
        _ => return None,
    };
    let (name, parameters) = texts.split_first()?;
    Signature::new(name, parameters).ok()
}

fn string_of(token: &TokenReference) -> Option<String> {
    match token.token_type() {
        TokenType::StringLiteral { literal, .. } => Some(literal.to_string()),
        _ => None,
    }
}
