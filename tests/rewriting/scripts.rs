//! Runs scripts from text.

use burgeon::Run;
use burgeon::script::RunOptions;

use super::naive::Pattern;
pub(crate) use super::naive::words;

/// Runs a script as `main.lua` in a temporary folder.
pub(crate) fn try_run(script: &str, options: RunOptions) -> burgeon::Result<Run> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("main.lua");
    std::fs::write(&path, script).expect("a file");
    burgeon::run(&path, options)
}

pub(crate) fn run_with(script: &str, options: RunOptions) -> Run {
    try_run(script, options).unwrap_or_else(|error| {
        let shown: Vec<&str> = script.lines().take(30).collect();
        panic!("{error}\nin the script\n{}", shown.join("\n"))
    })
}

pub(crate) fn run(script: &str) -> Run {
    run_with(script, burgeon::options())
}

/// Returns options with this number of threads, and of modules in a batch.
pub(crate) fn divided(threads: usize, batch: usize) -> RunOptions {
    RunOptions { threads: Some(threads), batch, ..burgeon::options() }
}

/// Returns the chains of all systems, with one line per chain.
pub(crate) fn all_chains(run: &Run) -> String {
    run.systems.iter().map(|system| system.chain_text()).collect()
}

/// Returns the chains of the system that was derived last.
pub(crate) fn chains(script: &str) -> Vec<String> {
    lines(&run(script))
}

pub(crate) fn lines(run: &Run) -> Vec<String> {
    run.systems.last().expect("a derived system").chain_text().lines().map(str::to_owned).collect()
}

/// Returns the only chain of each system, in the order of derivation.
pub(crate) fn chain_of_each(script: &str) -> Vec<String> {
    run(script).systems.iter().map(|system| system.chain_text().trim_end_matches('\n').to_owned()).collect()
}

/// Returns the only chain of the system that was derived last.
pub(crate) fn chain(script: &str) -> String {
    let chains = chains(script);
    assert_eq!(chains.len(), 1, "one chain");
    chains.into_iter().next().unwrap_or_default()
}

/// Returns the error message for a script.
pub(crate) fn error(script: &str) -> String {
    match try_run(script, burgeon::options()) {
        Err(error) => error.to_string(),
        Ok(run) => panic!("this script should fail, but it makes {}\n{script}", all_chains(&run)),
    }
}

/// Declares modules without parameters, in one line.
pub(crate) fn declare(names: &str) -> String {
    names.split_whitespace().map(|name| format!("local {name} = module(\"{name}\"); ")).collect()
}

/// Declares modules with one parameter.
pub(crate) fn declare_with<'a>(names: impl IntoIterator<Item = &'a str>, parameter: &str) -> String {
    let declared =
        names.into_iter().map(|name| format!("local {name} = module(\"{name}\", \"{parameter}\"); "));
    declared.collect::<String>() + "\n"
}

/// Converts a chain to Lua: `A [ B ] C` to `A(), { B() }, C()`.
pub(crate) fn as_lua(chain: &str) -> String {
    let spaced = chain.replace('[', " [ ").replace(']', " ] ");
    let mut out = String::new();
    for token in spaced.split_whitespace() {
        match token {
            "[" => out.push_str("{ "),
            "]" => out.push_str("}, "),
            name if name.ends_with(')') => out.push_str(&format!("{name}, ")),
            name => out.push_str(&format!("{name}(), ")),
        }
    }
    out.trim_end_matches([',', ' ']).to_owned()
}

/// System without parameters: `rules` are lines such as `A < B > C -> D [ E ]`; an empty successor erases. Decompositions
/// have the arrow `=>`.
pub(crate) struct Plain<'a> {
    pub ignore: &'a str,
    pub axiom: &'a str,
    pub rules: &'a str,
}

impl Plain<'_> {
    /// Returns the chain after each of the numbers of steps.
    pub(crate) fn derive<const N: usize>(&self, steps: [usize; N]) -> [String; N] {
        let mut chains = self.derive_each(&steps).into_iter();
        steps.map(|_| chains.next().unwrap_or_default())
    }

    /// Returns the chain after each of the numbers of steps.
    pub(crate) fn derive_each(&self, steps: &[usize]) -> Vec<String> {
        let run = run(&self.script(steps));
        run.systems.iter().map(|system| system.chain_text().trim_end().to_owned()).collect()
    }

    /// Returns the chain after 0, 1, 2, ... steps, `count` chains in total.
    pub(crate) fn first(&self, count: usize) -> Vec<String> {
        self.derive_each(&(0..count).collect::<Vec<_>>())
    }

    fn script(&self, steps: &[usize]) -> String {
        let mut names: Vec<String> = words(&format!("{} {} {}", self.ignore, self.axiom, self.rules))
            .into_iter()
            .filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic()))
            .collect();
        names.sort();
        names.dedup();
        let mut script = declare(&names.join(" "));
        script.push_str("\nlocal function derive(steps: number)\nlocal s = lsystem {}\n");
        if !self.ignore.is_empty() {
            script.push_str(&format!("s:ignore(\"{}\")\n", self.ignore));
        }
        script.push_str(&format!("s:axiom({})\n", as_lua(self.axiom)));
        for rule in self.rules.lines().map(str::trim).filter(|rule| !rule.is_empty()) {
            let (method, arrow) = if rule.contains("=>") { ("decompose", "=>") } else { ("rule", "->") };
            let (pattern, successor) = rule.split_once(arrow).expect("an arrow in each rule");
            let successor = match as_lua(successor) {
                empty if empty.is_empty() => "nil".to_owned(),
                made => made,
            };
            script.push_str(&format!(
                "s:{method}(\"{}\", function() return {successor} end)\n",
                pattern.trim()
            ));
        }
        script.push_str("s:derive(steps)\nend\n");
        for steps in steps {
            script.push_str(&format!("derive({steps})\n"));
        }
        script
    }
}

/// Symbols that contexts skip.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Passing<'a> {
    Nothing,
    Ignore(&'a str),
    Consider(&'a str),
}

/// Pattern of a rule, and the chains of its system.
#[derive(Debug, Clone)]
pub(crate) struct Case<'a> {
    pub passing: Passing<'a>,
    /// Chains; if use several, each comes from a feature.
    pub chains: Vec<String>,
    pub pattern: Pattern,
}

/// Returns for each case the modules that the engine matches, numbered from 0 through all its chains.
pub(crate) fn matched(cases: &[Case], options: RunOptions) -> Vec<Vec<usize>> {
    let mut names: Vec<String> = Vec::new();
    for case in cases {
        names.extend(words(&case.chains.join(" ")));
        names.extend(words(&case.pattern.text()));
        if let Passing::Ignore(more) | Passing::Consider(more) = case.passing {
            names.extend(words(more));
        }
    }
    names.retain(|name| name.starts_with(|c: char| c.is_ascii_alphabetic()));
    names.sort();
    names.dedup();
    names.push("Hit".to_owned());
    let mut script = declare_with(names.iter().map(String::as_str), "n");
    for case in cases {
        script.push_str(&case.script());
    }
    run_with(&script, options)
        .systems
        .iter()
        .map(|system| {
            let text = system.chain_text();
            text.split_whitespace()
                .filter_map(|word| word.strip_prefix("Hit(")?.strip_suffix(')')?.parse().ok())
                .collect()
        })
        .collect()
}

impl Case<'_> {
    /// Returns a system in which every module that matches becomes a `Hit` with its number.
    fn script(&self) -> String {
        let mut number = 0;
        let mut numbered = |chain: &String| {
            let words = words(chain).into_iter().map(|word| {
                if word == "[" || word == "]" {
                    return word;
                }
                number += 1;
                format!("{word}({})", number - 1)
            });
            as_lua(&words.collect::<Vec<_>>().join(" "))
        };
        let chains: Vec<String> = self.chains.iter().map(&mut numbered).collect();
        let passing = match self.passing {
            Passing::Nothing => String::new(),
            Passing::Ignore(names) => format!("s:ignore(\"{names}\")"),
            Passing::Consider(names) => format!("s:consider(\"{names}\")"),
        };
        let axiom = match chains.as_slice() {
            [one] => format!("s:axiom({one})"),
            many => {
                let features: Vec<String> = many.iter().map(|chain| format!("{{ {chain} }}")).collect();
                let features = features.join(", ");
                format!("s:axiom(source {{ {features} }}, function(chain) return table.unpack(chain) end)")
            }
        };
        let numbered =
            Pattern { predecessor: format!("{}(n)", self.pattern.predecessor), ..self.pattern.clone() };
        let pattern = numbered.text();
        format!(
            "do local s = lsystem {{}} {passing} {axiom}
            s:rule(\"{pattern}\", function(this, n) return Hit(n) end)
            s:derive(1) end\n"
        )
    }
}
