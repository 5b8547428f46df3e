//! Reads a script before it runs.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::AtomicUsize;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use super::queries::QueryCall;
use super::walk::{Facts, Walk};
use burgeon_base::MemoryOwner;
use burgeon_base::error::{Error, Limit, SourcePlace};
use burgeon_kit::Deprecation;
use burgeon_language::CallForm;
use burgeon_packages::FileName;
use burgeon_rewriting::Signature;
use full_moon::ast::Ast;
use full_moon::node::Node;
use full_moon::tokenizer::TokenType;
use rustc_hash::{FxHashMap, FxHashSet};

/// Makes bytecode of a text; none where Luau refuses it, which tells why when it is asked to run it.
pub type Compile = fn(&str) -> Option<Vec<u8>>;

/// What a script may use without declaring it.
#[derive(Debug, Clone, Default)]
pub struct Globals {
    /// The names of values.
    pub names: Vec<String>,
    /// The modules among them.
    pub modules: FxHashMap<String, Signature>,
    /// The constructors of objects among them.
    pub kinds: Vec<String>,
    /// Methods of objects that never change, such as geometries.
    pub value_methods: FxHashSet<String>,
    /// Those that will go.
    pub deprecated: Arc<BTreeMap<String, Deprecation>>,
    /// Counts the shapes of the run's rules.
    pub shapes: Arc<AtomicUsize>,
    /// Whether calls are to be held against what is declared.
    pub checks_calls: bool,
}

/// What reading a script gives.
#[derive(Debug, Clone, Default)]
pub struct Analysis {
    /// The text to run, with as many lines as the script.
    pub text: String,
    /// Its bytecode, if it is a file's and Luau compiles it.
    pub code: Option<Vec<u8>>,
    /// What is wrong, by line.
    pub problems: Vec<Error>,
    /// Whether the script names `random`.
    pub random: bool,
    /// The lines on which functions begin that leave nothing behind.
    pub pure: Vec<usize>,
    /// The lines on which functions begin that do not look at their first parameter, a rule's `this`.
    pub blind: Vec<usize>,
    /// By the line on which a rule's guard begins: its text without comments and line breaks. Guards of different texts on one
    /// line are left out.
    pub guards: BTreeMap<usize, String>,
    /// By the line on which an interpretation begins: where it returns modules.
    pub lost: BTreeMap<usize, usize>,
    /// By the line on which a function of a rule begins: what it asks of data, as far as that can be seen.
    pub queries: BTreeMap<usize, Vec<QueryCall>>,
    /// The names that will go, and the lines on which they stand.
    pub deprecated: Vec<(String, usize)>,
    /// By line: how the function is called that begins there.
    pub signatures: BTreeMap<usize, CallForm>,
    /// What stands in it, if its calls are to be checked.
    pub ast: Option<Arc<Ast>>,
    /// The texts that may name files of packages, and their lines.
    pub packages: Vec<(String, usize)>,
}

/// What stands before a successor that is given as text: the line on which it begins.
pub(super) fn marked(line: usize) -> String {
    format!("@{line};")
}

/// Takes apart a successor that is given as text, before which the analysis has put its line: the line and the text
/// itself. A text that comes from elsewhere has no line.
pub fn unmarked(text: &str) -> (Option<usize>, &str) {
    let parts = text.strip_prefix('@').and_then(|rest| rest.split_once(';'));
    match parts.and_then(|(line, rest)| Some((line.parse().ok()?, rest))) {
        Some((line, rest)) => (Some(line), rest),
        None => (None, text),
    }
}

/// The stack (bytes) for reading a script: enough for the deepest nesting that Luau compiles.
pub(super) const STACK: usize = 256 << 20;

/// How long reading a script may take. The parser's time doubles with each level of nested strings.
const PATIENCE: Duration = Duration::from_secs(30);

/// Reads `text`, the content of `file`. What Luau does not compile is left as it stands, for it to tell.
pub fn analyse(file: &str, text: &str, compile: Compile, globals: &Globals) -> Analysis {
    ScriptReader::begin(file, text, compile).finish(globals)
}

/// A script that is being read in a thread of its own, which waits for what the script may use.
pub struct ScriptReader {
    file: String,
    text: String,
    globals: Sender<Globals>,
    /// Nothing comes of a thread that could not be started.
    analysis: Receiver<Analysis>,
}

impl ScriptReader {
    /// Begins to read `text`, the content of `file`.
    pub fn begin(file: &str, text: &str, compile: Compile) -> Self {
        let (sender, analysis) = channel();
        let (globals, known) = channel();
        let (file, text) = (file.to_owned(), text.to_owned());
        let (name, source) = (file.clone(), text.clone());
        // Whoever asked may have given up.
        let owner = MemoryOwner::current();
        let read = move || {
            let _charged = owner.enter();
            drop(sender.send(read(&name, &source, compile, &known)));
        };
        if std::thread::Builder::new().stack_size(STACK).spawn(read).is_err() {
            return Self { file, text, globals, analysis: channel().1 };
        }
        Self { file, text, globals, analysis }
    }

    /// What the script is found to be, given what it may use.
    pub fn finish(self, globals: &Globals) -> Analysis {
        // A thread that has ended already needs no globals.
        let _ = self.globals.send(globals.clone());
        self.analysis.recv_timeout(PATIENCE).unwrap_or_else(|_| {
            let error = Error::limit(Limit::Time, format!("reading {} takes too long", self.file))
                .help("nest strings such as `a {`b`}` less deeply, or divide the file");
            unread(&self.text, vec![error])
        })
    }
}

/// The analysis of a script that is not to be run.
fn unread(text: &str, problems: Vec<Error>) -> Analysis {
    Analysis { text: text.to_owned(), problems, random: true, ..Analysis::default() }
}

fn read(file: &str, text: &str, compile: Compile, globals: &Receiver<Globals>) -> Analysis {
    // Luau bounds the nesting of what it compiles; the parser used here does not, so it comes second.
    let Some(code) = compile(text) else { return unread(text, Vec::new()) };
    let refuse = |line: usize| {
        let place = SourcePlace { file: file.to_owned(), line };
        let error = Error::syntax("this part of Luau's syntax is not known to Burgeon")
            .help("write it in another way; attributes in brackets, such as @[native], are not needed");
        unread(text, vec![error.at(Some(place))])
    };
    let ast = match full_moon::parse(text) {
        Ok(ast) => ast,
        Err(errors) => return refuse(errors.first().map_or(1, |error| error.range().0.line())),
    };
    // Nobody waits for the analysis if none come.
    let Ok(globals) = &globals.recv() else { return unread(text, Vec::new()) };
    // The first walk learns which variables are assigned and which functions make no modules; the second uses it.
    let mut first = Walk::new(file, globals, Facts::default());
    first.run(&ast);
    let mut second = Walk::new(file, globals, std::mem::take(&mut first.facts));
    second.run(&ast);
    let Walk {
        mut edits,
        mut problems,
        random,
        pure,
        mut blind,
        guards,
        lost,
        queries,
        signatures,
        begins,
        deprecated,
        ..
    } = second;
    // Luau knows functions by the line of their first word, which is then another.
    let is_apart =
        |begin: &usize| text[..*begin].rsplit('\n').next().is_some_and(|head| head.trim().is_empty());
    if begins.iter().any(is_apart) {
        blind.clear();
    }
    let pure = pure.into_iter().filter_map(|(line, pure)| pure.then_some(line)).collect();
    let blind = blind.into_iter().filter_map(|(line, blind)| blind.then_some(line)).collect();
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
    let packages = package_names(&ast);
    let guards = guards.into_iter().filter_map(|(line, text)| Some((line, text?))).collect();
    let signatures = signatures.into_iter().filter_map(|(line, form)| Some((line, form?))).collect();
    let ast = globals.checks_calls.then(|| Arc::new(ast));
    let code = if edits.is_empty() { Some(code) } else { compile(&out) };
    Analysis {
        text: out,
        code,
        problems,
        random,
        pure,
        blind,
        guards,
        lost,
        queries,
        signatures,
        ast,
        deprecated,
        packages,
    }
}

/// The texts of a script that begin as the names of packages' files do, and their lines.
fn package_names(ast: &Ast) -> Vec<(String, usize)> {
    let texts = ast.nodes().tokens().filter_map(|token| match token.token_type() {
        TokenType::StringLiteral { literal, .. } if FileName::is_meant(literal) => {
            Some((literal.to_string(), token.start_position()?.line()))
        }
        _ => None,
    });
    texts.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
