//! Names of systems: their constructor, methods, rules and results.

use std::sync::LazyLock;

use burgeon_kit::{Argument, Field};

use super::name::{Name, field, options};
use crate::form::argument;

/// Constructor of systems.
pub static LSYSTEM: LazyLock<Name> = LazyLock::new(|| {
    Name::global("lsystem", "Creates a system; see `system`.").form(
        [options(
            "{ ... }?",
            [
                field("object", "any", "nil", "The object that the chains draw with, or its constructor."),
                field(
                    "interpret",
                    "\"last\"?",
                    "nil",
                    "With \"last\", only the last chain is interpreted instead of the chain of every step.",
                ),
                field("max_depth", "number?", "100", "Maximum depth of decompositions and of interpretations that return modules: the number of times that their rules apply one after another."),
                field(
                    "city",
                    "string?",
                    "nil",
                    "CityJSON class of the chains, such as \"Road\"; buildings have a class by default.",
                ),
                field("seed", "number?", "nil", "Seed of the random numbers, instead of the run's seed."),
                field(
                    "environment",
                    "any",
                    "nil",
                    "Environments that all chains share, one or a list: interpretations change them, and rules read them.",
                ),
                field("ring", "boolean?", "false", "Makes the first and the last module of a chain neighbours in contexts."),
                field("variables", "any", "nil", "Variables that hooks and interpretations assign; see `variables`."),
            ],
        )],
        "System<T>",
    )
});

/// Methods of a system.
pub static SYSTEM: LazyLock<Name> = LazyLock::new(|| {
    let pattern = || argument("pattern", "string");
    let successor = || argument("successor", "((this: T, ...any) -> ...Module) | string");
    let draw = || argument("draw", "(this: T, ...any) -> ...any");
    let hook =
        |name, doc| Name::function(name, doc).form([argument("hook", "(now: Now) -> ...any")], "System<T>");
    Name::return_value(
        "system",
        "System<T>",
        "A system of rules, created by lsystem; T is the type of its object.",
    )
    .functions([
        Name::function(
            "axiom",
            "Sets the initial chain, as modules or as a string such as \"F-F-F-F\", or the function that returns the chain of each \
             feature of a source. The chains of a derived system continue its derivation with the rules of this system.",
        )
        .form([argument("...", "Module")], "System<T>")
        .form([argument("modules", "string")], "System<T>")
        .form(
            [argument("source", "Layer"), argument("chain", "(feature: Feature) -> ...Module")],
            "System<T>",
        )
        .form([argument("derived", "Derived")], "System<T>"),
        Name::function("rule", "Adds a rule: the successor of a module that matches the pattern. A string with the word return is the body of a Lua function; others are modules such as \"F[+F]F(x / 2)\".")
            .form([pattern(), successor()], "System<T>")
            .form([pattern(), rule_options(&[]), successor()], "System<T>"),
        Name::function(
            "decompose",
            "Adds a decomposition rule, which applies repeatedly after the axiom and after each step.",
        )
        .form([pattern(), successor()], "System<T>")
        .form([pattern(), rule_options(&["propensity"]), successor()], "System<T>"),
        Name::function(
            "interpret",
            "Adds an interpretation: the function that draws a module. It calls methods of `this`, and may return modules, which \
             are interpreted in its place; the chain does not change. Interpretations of one module are chosen as rules are: by \
             contexts in the chain, and with the options of a rule before the function, by guards and weights.",
        )
        .form([pattern(), draw()], "System<T>")
        .form([pattern(), rule_options(&["propensity", "group"]), draw()], "System<T>"),
        hook("at_start", "Adds a hook: a function that runs before the axiom is decomposed and interpreted."),
        hook(
            "before_step",
            "Adds a hook: a function that runs before the rules of each step. Hooks read the state of the derivation, assign \
             variables, and call stop() and use_group(name). If it returns modules, they replace the chain.",
        ),
        hook("after_step", "Adds a hook: a function that runs after each step and its interpretation."),
        hook("at_end", "Adds a hook: a function that runs after the last step and its interpretation."),
        Name::function("ignore", "Sets modules that context matching ignores.")
            .form([argument("...", "string")], "System<T>"),
        Name::function("consider", "Sets the only modules that context matching considers.")
            .form([argument("...", "string")], "System<T>"),
        Name::function(
            "subsystem",
            "Makes a module begin a sub-system: what follows it in its branch is rewritten by the rules of `system` in the same steps, \
             and drawn by its interpretations. A parameter `scale` of the module scales lengths and widths.",
        )
        .form([argument("module", "string"), argument("system", "System<T>")], "System<T>"),
        Name::function(
            "derive",
            "Applies the rules step by step; without a number of steps, until no rule applies, and it fails after 200,000 \
             steps. With a group, the rules of this group and those without a group apply.",
        )
        .form([argument("steps", "number?"), argument("group", "string?")], "Derived")
        .form([options("{ ... }", DERIVE.fields.clone())], "Derived"),
    ])
});

/// Returns the argument for the options of a rule, without those named in `left_out`.
fn rule_options(left_out: &[&str]) -> Argument {
    let fields = RULE.fields.iter().filter(|field| !left_out.contains(&&*field.name));
    options("{ ... }", fields.cloned().collect::<Vec<Field>>())
}

/// Options of a rule.
pub static RULE: LazyLock<Name> = LazyLock::new(|| {
    Name::return_value(
        "rule",
        "{ ... }",
        "Options of system:rule and system:decompose, between pattern and successor, and of system:interpret.",
    )
    .fields([
        field(
            "weight",
            "number?",
            "nil",
            "Relative probability among the rules that apply; never chosen if 0.",
        ),
        field(
            "when",
            "((this: T, ...any) -> boolean)?",
            "nil",
            "The guard: the rule applies only if this function returns true.",
        ),
        field(
            "propensity",
            "any",
            "nil",
            "The rate of the rule at each module (events per unit of time), a number or a function of `this` and the arguments: \
             each step then applies one rule to one module, drawn in proportion to the propensities of all.",
        ),
        field(
            "group",
            "string?",
            "nil",
            "The group of a rule, which applies only while its group is chosen by derive or use_group.",
        ),
        field(
            "ignore",
            "(string | { string })?",
            "nil",
            "Modules that the contexts of this rule ignore, instead of those of the system; none with {}.",
        ),
        field(
            "consider",
            "(string | { string })?",
            "nil",
            "The only modules that the contexts of this rule consider, instead of those of the system.",
        ),
    ])
});

/// Options of `system:derive`.
pub static DERIVE: LazyLock<Name> = LazyLock::new(|| {
    Name::return_value("derive", "{ ... }", "Options of system:derive.").fields([
        field("steps", "number?", "nil", "Maximum number of steps."),
        field("time", "number?", "nil", "Time at which a derivation of rules with propensities ends."),
        field("group", "string?", "nil", "Group of rules with which the derivation begins."),
    ])
});

/// Fields of a derived system.
pub static DERIVED: LazyLock<Name> = LazyLock::new(|| {
    Name::return_value(
        "derived",
        "Derived",
        "A derived system, returned by system:derive, which is also a model.",
    )
    .extends("Model")
    .fields([
        Field::new("objects", "{ any }", "The objects that the chains drew with."),
        Field::new("chains", "{ string }", "The chains as text."),
        Field::new("steps", "number", "Number of steps."),
        Field::new("time", "number", "Time of the last event of rules with propensities, the latest of all chains."),
        Field::new("modules", "number", "Number of modules in the chains."),
        Field::new(
            "counts",
            "{ [string]: number }",
            "Number of modules of each name in the chains, such as derived.counts.F.",
        ),
        Field::new("variables", "{ [string]: any }", "The variables of the system after the last step."),
    ])
    .functions([Name::function(
        "chain",
        "Returns a chain, the first unless given, as a list of modules, in which each branch is a list. A module has its name and \
         its parameters: module.name, module.length. Changed lists are axioms: system:axiom(sequence(list)).",
    )
    .form([argument("number", "number?")], "{ any }")])
});

/// State of a derivation in a hook.
pub static NOW: LazyLock<Name> = LazyLock::new(|| {
    Name::return_value("now", "Now", "The state of a derivation, which a hook gets.").fields([
        Field::new("step", "number", "Number of the step, from 1; 0 in at_start."),
        Field::new(
            "time",
            "number",
            "Time of the last event of rules with propensities, the latest of all chains.",
        ),
        Field::new("modules", "number", "Number of modules in the chains."),
        Field::new("counts", "{ [string]: number }", "Number of modules of each name in the chains."),
        Field::new(
            "chain",
            "{ any }",
            "The chain as a list of modules, in which each branch is a list; only of one chain.",
        ),
    ])
});
