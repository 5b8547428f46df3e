//! Names that Burgeon adds to Luau in Rust, and the types of their results.

use std::sync::LazyLock;

use burgeon_kit::{Argument, Field};

use super::name::{Name, Operator, field};
use crate::form::argument;

/// Returns all names of this file.
pub(super) fn names() -> Vec<Name> {
    let shared = [
        &*PARAM, &OBJECT, &EXTEND, &LSYSTEM, &SYSTEM, &RULE, &DERIVED, &SOURCE, &LAYER, &QUERY, &FRAGMENT,
        &VECTOR,
    ];
    let mut names: Vec<Name> = shared.into_iter().cloned().collect();
    names.extend([
        Name::global(
            "module",
            "Declares modules with this name and these parameters, and gives the function that makes them. A parameter \
             whose name ends with ? may be left out.",
        )
        .form([argument("name", "string"), argument("...", "string")], "(...any) -> Module"),
        Name::global(
            "random",
            "A random number of the module that is rewritten or drawn: between `a` (0 unless given) and `b` (1 unless given), \
             which are given together.",
        )
        .form([argument("a", "number?"), argument("b", "number?")], "number")
        .pure(),
        Name::global(
            "stream",
            "Creates a named stream of random numbers: a function that is called as `random` is. The numbers depend only on \
             `name`, on the further keys (numbers, strings and booleans), and on the module that is rewritten or drawn, or at \
             the top level on the seed of the run. They do not depend on other random numbers, and do not change them.",
        )
        .form(
            [argument("name", "string"), argument("...", "number | string | boolean")],
            "(number?, number?) -> number",
        )
        .pure(),
        Name::global(
            "step",
            "Returns the number of the derivation step that is running, from 1; in an interpretation, the number of the step \
             that made the chain, and 0 for the axiom. A derivation whose functions call it needs a number of steps, and makes \
             all of them.",
        )
        .form([], "number")
        .pure(),
        Name::global(
            "warn",
            "Adds a warning to the run: what is wrong, and what to do about it. Only the top level of a script and its functions \
             can warn, not rules.",
        )
        .form([argument("text", "string"), argument("help", "string?")], "()"),
        Name::global("require", "What another file of the script returns, or of a package: require(\"@castle/towers\"). Each is run once.")
            .form([argument("name", "string")], "any"),
        Name::global(
            "api",
            "What scripts can rely on: the version of these names, and whether a name is among them.",
        )
        .fields([Field::new("version", "string", "The version of the script API, such as \"1.0.0\".")])
        .functions([Name::function(
            "has",
            "Whether there is such a name, such as \"terrain\" or \"extruder.bend\", or such a package, as \"@castle\".",
        )
        .form([argument("name", "string")], "boolean")
        .pure()])
        .pure(),
        Name::global(
            "lod",
            "The level of detail of the run: 0 ground plans, 1 blocks, 2 roofs, 3 everything.",
        )
        .luau("number"),
        Name::return_value(
            "color",
            "string | { number }",
            "A colour: \"#rrggbb\", a name such as \"lightblue\", or { red, green, blue } from 0 to 1.",
        ),
        Name::return_value(
            "feature",
            "Feature",
            "A feature of a data file: its attributes by name, and these, which win over attributes.",
        )
        .fields([
            Field::new("id", "string", "What tells it from all others."),
            Field::new(
                "geometry",
                "Geometry",
                "Where it is; what a geometry has is told of under geometry.",
            ),
            Field::new("layer", "string", "The name of its layer."),
            Field::new("[string]", "any", "Its attributes, by name."),
        ]),
        Name::global(
            "geometry",
            "The geometry of a well-known text such as \"POLYGON ((0 0, 4 0, 4 3, 0 0))\", of a feature, or of a table \
             with rings or points; what it has is told of under the type geometry.",
        )
        .form([argument("text", "string | Geometry | { any }")], "Geometry")
        .pure(),
        Name::global("point", "A point: where it is to the east, `x` (m), and to the north, `y` (m), and its height `z` (m); or a vector.")
            .form([argument("x", "number"), argument("y", "number"), argument("z", "number?")], "Geometry")
            .form([argument("place", "Vector | Geometry")], "Geometry")
            .pure(),
        Name::global("line", "A line through points (m): a list of them, or one after the other.")
            .form([argument("points", "{ any }")], "Geometry")
            .form([argument("...", "Vector | Geometry")], "Geometry")
            .pure(),
        Name::global(
            "polygon",
            "A polygon: the points of its outer ring (m), or a list of rings, of which the others are holes.",
        )
        .form([argument("rings", "{ any } | Geometry")], "Geometry")
        .form([argument("...", "Vector | Geometry")], "Geometry")
        .pure(),
    ]);
    names
}

fn metres(name: &'static str, luau: &str, doc: &'static str) -> Field {
    Field { unit: Some("m".into()), ..Field::new(name, luau, doc) }
}

fn options(luau: &str, fields: impl Into<Vec<Field>>) -> Argument {
    Argument { fields: fields.into(), ..argument("options", luau) }
}

/// Declaration of a script parameter.
pub static PARAM: LazyLock<Name> = LazyLock::new(|| {
    Name::global(
        "param",
        "Declares a value that people may change without editing the script, and gives the one that it has in this run.",
    )
    .form(
        [
            argument("name", "string"),
            options(
                "{ ... }",
                [
                    field(
                        "default",
                        "number | boolean | string",
                        "",
                        "The value if nobody says another; it must be given.",
                    ),
                    field("min", "number?", "nil", "The least value."),
                    field("max", "number?", "nil", "The greatest value."),
                    field(
                        "step",
                        "number?",
                        "nil",
                        "How far values are from one another, counted from the least one.",
                    ),
                    field("choices", "{ string }?", "nil", "The texts to choose from."),
                    field("unit", "string", "\"\"", "The unit, for people."),
                    field("text", "string", "\"\"", "What it does, for people."),
                ],
            ),
        ],
        "any",
    )
});

/// Constructor of systems.
pub static LSYSTEM: LazyLock<Name> = LazyLock::new(|| {
    Name::global("lsystem", "Makes a system of rules; what it has is told of under system.").form(
        [options(
            "{ ... }?",
            [
                field(
                    "object",
                    "any",
                    "nil",
                    "What the chains draw with: an object, or the constructor of one.",
                ),
                field(
                    "interpret",
                    "\"last\"?",
                    "nil",
                    "With \"last\", only the last chain is interpreted, and not that of every step.",
                ),
                field(
                    "city",
                    "string?",
                    "nil",
                    "What its chains are in a city model, such as \"Road\"; houses are known without.",
                ),
                field(
                    "seed",
                    "number?",
                    "nil",
                    "What its random numbers come from, in place of the run's seed.",
                ),
            ],
        )],
        "System<T>",
    )
});

/// Declaration of an object type.
pub static OBJECT: LazyLock<Name> = LazyLock::new(|| {
    let functions = "{ [string]: (self: any, ...any) -> any }?";
    let hook = "((self: any) -> ())?";
    let fields = [
        field("doc", "string?", "nil", "What it is; the first line is a summary."),
        field(
            "extends",
            "((...any) -> any)?",
            "nil",
            "The constructor of the type whose fields, methods and drawing it has, too.",
        ),
        field(
            "fields",
            "{ [string]: any }?",
            "nil",
            "What its constructor takes, each as { default =, type =, min =, max =, choices =, unit =, doc = }.",
        ),
        field(
            "state",
            "{ [string]: any }?",
            "nil",
            "What its functions may assign, with the values that every pass begins with; objects draw into its drawing.",
        ),
        field("reads", functions, "nil", "Functions that rules may call, too."),
        field(
            "changes",
            functions,
            "nil",
            "Functions that only interpretations may call; without a result they give the object.",
        ),
        field("begin", hook, "nil", "Runs before a chain is interpreted."),
        field("push", hook, "nil", "Runs where a branch opens."),
        field("pop", hook, "nil", "Runs where a branch closes."),
        field("finish", hook, "nil", "Runs after a chain was interpreted."),
    ];
    let declaration = Argument { fields: fields.into(), ..argument("declaration", "{ ... }") };
    Name::global("object", "Declares a type of object, and gives the function that makes objects of it.")
        .form([argument("name", "string"), declaration], "(fields: { ... }?) -> any")
});

/// Extension of an object type.
pub static EXTEND: LazyLock<Name> = LazyLock::new(|| {
    let functions = "{ [string]: (self: any, ...any) -> any }?";
    let fields = [
        field("reads", functions, "nil", "Functions that rules may call, too."),
        field("changes", functions, "nil", "Functions that only interpretations may call."),
    ];
    let declaration = Argument { fields: fields.into(), ..argument("declaration", "{ ... }") };
    Name::global("extend", "Adds functions to a type of object, for the scripts of this run.")
        .form([argument("constructor", "(...any) -> any"), declaration], "()")
});

/// Methods of a system.
pub static SYSTEM: LazyLock<Name> = LazyLock::new(|| {
    let pattern = || argument("pattern", "string");
    let successor = || argument("successor", "((this: T, ...any) -> ...Module) | string");
    Name::return_value("system", "System<T>", "A system of rules, as lsystem gives it; T is the type of its object.")
        .functions([
            Name::function(
                "axiom",
                "Sets what the chain begins as, or the function that makes the chain of each feature of a source.",
            )
            .form([argument("...", "Module")], "System<T>")
            .form(
                [argument("source", "Layer"), argument("chain", "(feature: Feature) -> ...Module")],
                "System<T>",
            ),
            Name::function(
                "rule",
                "Adds a rule: what replaces a module that the pattern describes.",
            )
            .form([pattern(), successor()], "System<T>")
            .form([pattern(), options("{ ... }", RULE.fields.clone()), successor()], "System<T>"),
            Name::function("interpret", "Adds an interpretation: what is drawn for a module.")
                .form([pattern(), argument("draw", "(this: T, ...any) -> ...any")], "System<T>"),
            Name::function("ignore", "Names modules that matching of contexts passes over.")
                .form([argument("...", "string")], "System<T>"),
            Name::function("consider", "Names the only modules that matching of contexts sees.")
                .form([argument("...", "string")], "System<T>"),
            Name::function(
                "derive",
                "Applies the rules step by step, to the end where no number of steps is given.",
            )
            .form([argument("steps", "number?")], "Derived"),
        ])
});

/// Options of a rule.
pub static RULE: LazyLock<Name> = LazyLock::new(|| {
    Name::return_value(
        "rule",
        "{ ... }",
        "The options of system:rule, between its pattern and its successor.",
    )
    .fields([
        field(
            "weight",
            "number?",
            "nil",
            "How often it is drawn, to the weights of the other rules that apply; never, if it is 0.",
        ),
        field(
            "when",
            "((this: T, ...any) -> boolean)?",
            "nil",
            "The guard: the rule applies only where this function returns true.",
        ),
    ])
});

/// Fields of a derived system.
pub static DERIVED: LazyLock<Name> = LazyLock::new(|| {
    Name::return_value(
        "derived",
        "Derived",
        "A derived system, as system:derive gives it, which is also a model.",
    )
    .extends("Model")
    .fields([
        Field::new("objects", "{ any }", "The objects that the chains have drawn with."),
        Field::new("chains", "{ string }", "The chains as text."),
        Field::new("steps", "number", "How many steps there were."),
        Field::new("modules", "number", "How many modules the chains have."),
    ])
});

/// Loading of features, with the options that select them.
pub static SOURCE: LazyLock<Name> = LazyLock::new(|| {
    Name::global("source", "The features of a data file, or of a list; what it has is told of under layer.")
        .form(
            [
                argument("what", "string | { any }"),
                options(
                    "{ ... }?",
                    [
                        field("where", "string?", "nil", "An SQL condition on attributes."),
                        field(
                            "tags",
                            "{ [string]: any }?",
                            "nil",
                            "What tags of OpenStreetMap are: true for any value but no, \"*\" for any, false for none, a text, or a list of texts. All of them hold; of a list of such tables, one holds.",
                        ),
                        field(
                            "within",
                            "{ number }?",
                            "nil",
                            "West, south, east and north of a box that features touch, in the coordinates of the file.",
                        ),
                        field("limit", "number?", "nil", "At most as many features."),
                        field("id", "string?", "nil", "The attribute that tells features apart."),
                        field(
                            "kind",
                            "string?",
                            "nil",
                            "Only features with a \"point\", a \"line\" or a \"polygon\".",
                        ),
                        field(
                            "crs",
                            "number?",
                            "nil",
                            "The EPSG code of the coordinates, in place of the file's.",
                        ),
                        field(
                            "layer",
                            "string?",
                            "nil",
                            "The layer, if its name does not stand behind a colon.",
                        ),
                        field(
                            "table",
                            "string?",
                            "nil",
                            "What query calls it, in place of its layer's name.",
                        ),
                    ],
                ),
            ],
            "Layer",
        )
});

/// Fields of a layer, which `source` returns.
pub static LAYER: LazyLock<Name> = LazyLock::new(|| {
    Name::return_value(
        "layer",
        "Layer",
        "Features, as source gives them: for index, feature in it do, and #it.",
    )
    .items("Feature")
    .fields([
        Field::new("features", "{ Feature }", "The features as a list."),
        metres("bounds", "{ min: { number }, max: { number } }?", "The corners of the box around them (m)."),
        Field::new("layer", "string?", "The name of the layer."),
        Field::new("crs", "string?", "The coordinate system of the file."),
        metres("origin", "{ number }?", "Where the run's origin is in its projection (m)."),
    ])
});

/// SQL query.
static QUERY: LazyLock<Name> = LazyLock::new(|| {
    let sql = || argument("sql", "string");
    let values = || argument("values", "{ [string]: any }?");
    Name::global(
        "query",
        "Queries the sources that the script has loaded, as tables named as their layers, and the modules of chains, as tables \
         named as they are, in SQL; the name of a table alone asks for all its rows. With what makes a \
         module it stands for a module for each row, with the columns as parameters, which take its place before the next \
         step begins; without, it gives the rows. $name in the text is a value of that name, or else the parameter of the \
         rule that is called so.",
    )
    .form([sql(), argument("module", "(...any) -> Module"), values()], "Module")
    .form([sql(), values()], "{ { [string]: any } }")
    .pure()
});

/// Module for the parts of a geometry.
static FRAGMENT: LazyLock<Name> = LazyLock::new(|| {
    Name::global(
        "fragment",
        "Stands for a module for each part of what is to its left, whose place they take before the next step begins, \
         with its parameters: a collection's geometries, a polygon's rings, a line's segments, a segment's points.",
    )
    .form([argument("module", "(...any) -> Module")], "Module")
    .pure()
});

/// Fields, operators and methods of a vector.
pub static VECTOR: LazyLock<Name> = LazyLock::new(|| {
    let other = || argument("other", "Vector");
    Name::return_value(
        "vector",
        "Vector",
        "Three numbers that never change, as vec gives them: +, - and * with vectors and lists, * and / with numbers.",
    )
    .instead("{ number }")
    .items("number")
    .operators([
        Operator { name: "add", other: "VectorLike", returns: "Vector" },
        Operator { name: "sub", other: "VectorLike", returns: "Vector" },
        Operator { name: "mul", other: "VectorLike | number", returns: "Vector" },
        Operator { name: "div", other: "number", returns: "Vector" },
        Operator { name: "unm", other: "", returns: "Vector" },
    ])
    .fields([
        metres("x", "number", "To the east (m)."),
        metres("y", "number", "To the north (m)."),
        metres("z", "number", "Upwards (m)."),
    ])
    .functions([
        Name::function("dot", "The sum of the products of their numbers.").form([other()], "number"),
        Name::function("cross", "The vector that is upright on both.").form([other()], "Vector"),
        Name::function("length", "How long it is (m).").form([], "number"),
        Name::function("unit", "The vector with length 1; a zero vector stays.").form([], "Vector"),
        Name::function("distance", "How far they are apart (m).").form([other()], "number"),
        Name::function("lerp", "From one to the other as t goes from 0 to 1.")
            .form([other(), argument("t", "number")], "Vector"),
    ])
});
