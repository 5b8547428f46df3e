//! Entry point of the analysis of a script.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use super::doubtful::doubtful_calls;
use super::endings::forgotten_returns;
use super::globals::Globals;
use super::truncated::truncated_calls;
use super::walk::{Facts, QueryCall, Walk};
use crate::CallForm;
use burgeon_base::error::{Error, Limit, SourcePlace};
use burgeon_base::{MemoryOwner, Warning};
use full_moon::ast::Ast;
use full_moon::node::Node;
use full_moon::tokenizer::TokenType;

/// Function that compiles text to bytecode. Returns `None` if Luau refuses the text; running the text then reports the
/// error.
pub type Compile = fn(&str) -> Option<Vec<u8>>;

/// Result of the analysis.
#[derive(Debug, Clone, Default)]
pub struct Analysis {
    /// Text to run, with as many lines as the script.
    pub text: String,
    /// Bytecode, if the text is a file that Luau compiles.
    pub code: Option<Vec<u8>>,
    /// Errors, sorted by line.
    pub problems: Vec<Error>,
    /// Set if the script uses the name `random`, the global `stream` or a distribution.
    pub random: bool,
    /// Set if the script uses the global `step`.
    pub reads_step: bool,
    /// Set if a function that is not written as the argument of a hook may end a derivation.
    pub stops: bool,
    /// Lines on which pure functions begin.
    pub pure: Vec<usize>,
    /// Lines on which functions begin that do not read their first parameter, a rule's `this`.
    pub blind: Vec<usize>,
    /// Lines on which functions begin that read their first parameter only to ask for its place.
    pub asks_place: Vec<usize>,
    /// Lines on which functions begin that do nothing but divide a shape into modules, by `split` or `components`.
    pub divides: Vec<usize>,
    /// Numbers of the parameters that the functions that begin on a line read, by the line. Lines with a variadic function are
    /// omitted.
    pub reads: BTreeMap<usize, BTreeSet<usize>>,
    /// Text of a rule's guard without comments and line breaks, by the line on which the guard begins. Lines with
    /// guards of different texts are omitted.
    pub guards: BTreeMap<usize, String>,
    /// Line on which a rule returns only a table that it has filled, by the line on which its function begins.
    pub filled: BTreeMap<usize, usize>,
    /// Detected queries of a rule's function, by the line on which the function begins.
    pub queries: BTreeMap<usize, Vec<QueryCall>>,
    /// Deprecated names that the script uses, with their lines.
    pub deprecated: Vec<(String, usize)>,
    /// Signature of a function, by the line on which the function begins.
    pub signatures: BTreeMap<usize, CallForm>,
    /// Syntax tree, if calls are to be checked.
    pub ast: Option<Arc<Ast>>,
    /// Warnings about calls that are probably not intended, and about calls whose values are lost.
    pub doubtful: Vec<Warning>,
    /// String literals that may name files of packages, with their lines.
    pub packages: Vec<(String, usize)>,
}

/// Returns the prefix of a string successor, which contains the line on which the successor begins.
pub(super) fn line_prefix(line: usize) -> String {
    format!("@{line};")
}

/// Splits a string successor into its line, which the analysis has added, and its text. Other strings have no line.
///
/// ```
/// use burgeon_language::analysis::split_line;
///
/// assert_eq!(split_line("@12;F [ L ] F"), (Some(12), "F [ L ] F"));
/// assert_eq!(split_line("F F"), (None, "F F"));
/// ```
pub fn split_line(text: &str) -> (Option<usize>, &str) {
    let parts = text.strip_prefix('@').and_then(|rest| rest.split_once(';'));
    match parts.and_then(|(line, rest)| Some((line.parse().ok()?, rest))) {
        Some((line, rest)) => (Some(line), rest),
        None => (None, text),
    }
}

/// Stack size (bytes) for the analysis, enough for the deepest nesting that Luau compiles.
pub(super) const STACK: usize = 256 << 20;

/// Time limit of the analysis. The parser's time doubles with each level of nested strings.
const PATIENCE: Duration = Duration::from_secs(30);

/// Analyses `text`, the content of `file`. Text that Luau does not compile is kept as it is, so Luau reports the error.
///
/// ```
/// use burgeon_language::analysis::{Globals, analyse};
///
/// let globals = Globals { names: vec!["print".into()], ..Globals::default() };
/// let analysis = analyse("hello.lua", "local greeting = 'hello'\nprint(greting)\n", |_| Some(Vec::new()), &globals);
/// let place = analysis.problems[0].place().expect("a location");
/// assert_eq!((analysis.problems.len(), place.line), (1, 2));
/// ```
pub fn analyse(file: &str, text: &str, compile: Compile, globals: &Globals) -> Analysis {
    ScriptReader::begin(file, text, compile).finish(globals)
}

/// A script that is analysed in another thread, which waits for the names that the script can use.
pub struct ScriptReader {
    /// File and content, which the thread reads too.
    source: Arc<(String, String)>,
    globals: Sender<Globals>,
    /// Channel for the result, which stays empty if the thread could not start.
    analysis: Receiver<Analysis>,
}

impl ScriptReader {
    /// Returns the content of the file.
    pub fn text(&self) -> &str {
        &self.source.1
    }

    /// Starts the analysis of `text`, the content of `file`.
    pub fn begin(file: &str, text: &str, compile: Compile) -> Self {
        let (sender, analysis) = channel();
        let (globals, known) = channel();
        let source = Arc::new((file.to_owned(), text.to_owned()));
        let shared = Arc::clone(&source);
        // Sending fails if the receiver has timed out.
        let owner = MemoryOwner::current();
        let read = move || {
            let _charged = owner.enter();
            let (file, text) = &*shared;
            drop(sender.send(read(file, text, compile, &known)));
        };
        if std::thread::Builder::new().stack_size(STACK).spawn(read).is_err() {
            return Self { source, globals, analysis: channel().1 };
        }
        Self { source, globals, analysis }
    }

    /// Returns the analysis, given the names that the script can use.
    pub fn finish(self, globals: &Globals) -> Analysis {
        // A thread that has already ended needs no globals.
        let _ = self.globals.send(globals.clone());
        self.analysis.recv_timeout(PATIENCE).unwrap_or_else(|_| {
            let (file, text) = &*self.source;
            let error = Error::limit(Limit::Time, format!("analysing {file} takes too long"))
                .help("nest strings such as `a {`b`}` less deeply, or split the file");
            unread(text, vec![error])
        })
    }
}

/// Returns the analysis of a script that must not run.
fn unread(text: &str, problems: Vec<Error>) -> Analysis {
    Analysis {
        text: text.to_owned(),
        problems,
        random: true,
        reads_step: true,
        stops: true,
        ..Analysis::default()
    }
}

fn read(file: &str, text: &str, compile: Compile, globals: &Receiver<Globals>) -> Analysis {
    // Luau limits the nesting depth, but the parser does not, so Luau compiles the text first.
    let Some(code) = compile(text) else { return unread(text, Vec::new()) };
    let refuse = |line: usize| {
        let place = SourcePlace::new(file, line);
        let error = Error::syntax("Burgeon does not support this Luau syntax")
            .help("write it differently; attributes in brackets, such as @[native], are not needed");
        unread(text, vec![error.at(Some(place))])
    };
    let ast = match full_moon::parse(text) {
        Ok(ast) => ast,
        Err(errors) => return refuse(errors.first().map_or(1, |error| error.range().0.line())),
    };
    // If the sender is gone, the result is not needed.
    let Ok(globals) = &globals.recv() else { return unread(text, Vec::new()) };
    // The first walk collects assigned variables and pure functions; the second walk uses them.
    let mut first = Walk::new(file, globals, Facts::default());
    first.run(&ast);
    let mut second = Walk::new(file, globals, std::mem::take(&mut first.facts));
    second.run(&ast);
    let Walk {
        mut edits,
        mut problems,
        random,
        reads_step,
        stops,
        pure,
        mut blind,
        mut asks_place,
        mut divides,
        mut reads,
        guards,
        filled,
        queries,
        signatures,
        begins,
        deprecated,
        ..
    } = second;
    // Luau identifies a function by the line of its keyword, which is an earlier line if the bracket begins a line.
    let is_apart =
        |begin: &usize| text[..*begin].rsplit('\n').next().is_some_and(|head| head.trim().is_empty());
    if begins.iter().any(is_apart) {
        blind.clear();
        asks_place.clear();
        divides.clear();
        reads.clear();
    }
    let asks_place = asks_place.into_iter().filter_map(|(line, place)| place.then_some(line)).collect();
    let divides = divides.into_iter().filter_map(|(line, divides)| divides.then_some(line)).collect();
    let reads = reads.into_iter().filter_map(|(line, reads)| Some((line, reads?))).collect();
    let pure = pure.into_iter().filter_map(|(line, pure)| pure.then_some(line)).collect();
    let blind = blind.into_iter().filter_map(|(line, blind)| blind.then_some(line)).collect();
    problems.sort_by(|a, b| a.place().cmp(&b.place()));
    // Text inserted before a token comes before the replacement of the token.
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
    let packages = package_names(&ast);
    let mut doubtful = doubtful_calls(file, text, &ast);
    doubtful.extend(truncated_calls(file, text, &ast));
    doubtful.extend(forgotten_returns(file, text, &ast));
    let guards = guards.into_iter().filter_map(|(line, text)| Some((line, text?))).collect();
    let signatures = signatures.into_iter().filter_map(|(line, form)| Some((line, form?))).collect();
    let ast = globals.checks_calls.then(|| Arc::new(ast));
    let code = if edits.is_empty() { Some(code) } else { compile(&out) };
    Analysis {
        text: out,
        code,
        problems,
        random,
        reads_step,
        stops,
        pure,
        blind,
        asks_place,
        divides,
        reads,
        guards,
        filled,
        queries,
        signatures,
        ast,
        deprecated,
        doubtful,
        packages,
    }
}

/// Returns the string literals that have the form of a package file name, with their lines.
fn package_names(ast: &Ast) -> Vec<(String, usize)> {
    let texts = ast.nodes().tokens().filter_map(|token| match token.token_type() {
        TokenType::StringLiteral { literal, .. } if literal.starts_with('@') => {
            Some((literal.to_string(), token.start_position()?.line()))
        }
        _ => None,
    });
    texts.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_kit::Deprecation;

    #[test]
    fn a_name_that_will_go_is_found_with_its_lines() {
        let names = ["oldest", "newest"].map(str::to_owned).to_vec();
        let deprecation = Deprecation { name: "".into(), since: "1.1".into(), instead: "newest".into() };
        let deprecated = Arc::new(BTreeMap::from([("oldest".to_owned(), deprecation)]));
        let globals = Globals { names, deprecated, ..Globals::default() };
        let script = "local a = oldest(1)\nlocal b = newest(2)\ndo\n  local oldest = 3\n  b = oldest\nend\nprint(oldest)";
        let found = analyse("s.lua", script, |_| Some(Vec::new()), &globals).deprecated;
        assert_eq!(found, [("oldest".to_owned(), 1), ("oldest".to_owned(), 7)]);
    }

    #[test]
    fn a_function_is_blind_if_it_never_reads_its_first_parameter() {
        let names = ["select"].map(str::to_owned).to_vec();
        let globals = Globals { names, ..Globals::default() };
        let blind = |function: &str| {
            let script = format!("local function other(x)\n  return x\nend\nlocal f = {function}");
            analyse("s.lua", &script, |_| Some(Vec::new()), &globals).blind.contains(&4)
        };
        for function in [
            "function() return 1 end",
            "function(this, n) return n end",
            "function(_, this) return this end",
            "function(this) local this = 3 return this end",
            "function(this) for this = 1, 3 do other(this) end end",
            "function(this, n) this = n end",
            "function(this, ...) return select(1, ...) end",
            "function(this) return ({ this = 1 }).this end",
        ] {
            assert!(blind(function), "{function}");
        }
        for function in [
            "function(this) return this end",
            "function(this, n) return other(this) end",
            "function(o) return o:position() end",
            "function(this) return function() return this.x end end",
            "function(this) return `{this}` end",
            "function(this) return if this then 1 else 2 end",
            "function(this) local t = { this } return t end",
            "function(this) for k in this do other(k) end end",
            "function(this) repeat local x = 1 until this end",
            "function(this, n) n[this] = 1 end",
            "function(...) return select(1, ...) end",
            "function(this) return (this :: any).x end",
            "function(this) this.x = 1 end",
            "function(this) this += 1 end",
            "function\n(this, n) return n end",
        ] {
            assert!(!blind(function), "{function}");
        }
    }

    #[test]
    fn parameters_that_a_function_reads_are_known_unless_it_is_variadic() {
        let globals = Globals { names: vec!["select".to_owned()], ..Globals::default() };
        let reads = |function: &str| {
            let script = format!("local f = {function}");
            let found = analyse("s.lua", &script, |_| Some(Vec::new()), &globals).reads;
            found.get(&1).map(|reads| reads.iter().copied().collect::<Vec<_>>())
        };
        assert_eq!(reads("function(this, a, b, c) return c + 1 end"), Some(vec![3]));
        assert_eq!(reads("function(this, a, b) b = 2 end"), Some(vec![]));
        assert_eq!(reads("function(this, a, b) b += 2 end"), Some(vec![2]));
        assert_eq!(reads("function(this, a, b) return function(x) return a[1] end end"), Some(vec![1]));
        assert_eq!(reads("function(this, a, b) local a = b return a end"), Some(vec![2]));
        assert_eq!(reads("function(this, a, b) return `{this:position()} {b}` end"), Some(vec![2]));
        assert_eq!(
            reads("function(this, a) return a end local g = function(x, y, z) return z end"),
            Some(vec![1, 2])
        );
        assert_eq!(reads("function(this, a, ...) return select(1, ...) end"), None);
    }

    #[test]
    fn a_function_asks_for_a_place_only_if_it_does_nothing_else_with_its_first_parameter() {
        let names = ["select"].map(str::to_owned).to_vec();
        let globals = Globals { names, ..Globals::default() };
        let asks_place = |function: &str| {
            let script = format!("local function other(x)\n  return x\nend\nlocal f = {function}");
            analyse("s.lua", &script, |_| Some(Vec::new()), &globals).asks_place.contains(&4)
        };
        for function in [
            "function(this, n) return n end",
            "function(this) return this:position().z end",
            "function(o) return o:up().x + o:left().y + o:heading().z end",
            "function(this) return function() return this:position() end end",
        ] {
            assert!(asks_place(function), "{function}");
        }
        for function in [
            "function(this) return this:distance() end",
            "function(this) return this.position(this) end",
            "function(this) return other(this):position() end",
            "function(this) return this:position(this) end",
            "function(this) local it = this return it:position() end",
            "function(this) return this:position().z < 0 or this.x end",
            "function(...) return select(1, ...) end",
            "function\n(this) return this:position() end",
        ] {
            assert!(!asks_place(function), "{function}");
        }
    }
}
