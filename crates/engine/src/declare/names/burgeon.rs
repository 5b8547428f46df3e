//! The names that Burgeon adds to Luau in Rust, and what they give.

use super::{Name, NameKind, NameMember};

/// All of them.
pub(super) static NAMES: &[&Name] = &[
    &API, &EXTEND, &LOD, &LSYSTEM, &MODULE, &OBJECT, &PARAM, &RANDOM, &REQUIRE, &SOURCE, &DERIVED, &FEATURE,
    &GEOMETRY, &LAYER, &RULE, &SYSTEM,
];

static API: Name = Name::new(
    "api",
    NameKind::Global,
    "{ version: string, has: (name: string) -> boolean }",
    "What scripts can rely on: the version of these names, and whether a name is among them.",
)
.parts(&[
    NameMember::new("version", "string", "The version of the script API, such as \"1.0.0\"."),
    NameMember::new(
        "has",
        "(name: string) -> boolean",
        "Whether there is such a name, such as \"terrain\" or \"extruder.bend\", or such a package, as \"@castle\".",
    ),
])
.pure();

static MODULE: Name = Name::new(
    "module",
    NameKind::Global,
    "(name: string, ...string) -> (...any) -> Module",
    "Declares modules with this name and these parameters, and gives the function that makes them. A parameter whose \
     name ends with ? may be left out.",
);

static RANDOM: Name = Name::new(
    "random",
    NameKind::Global,
    "(a: number?, b: number?) -> number",
    "A random number of the module that is rewritten or drawn: from 0 to 1, or between a and b.",
)
.pure();

static REQUIRE: Name = Name::new(
    "require",
    NameKind::Global,
    "(name: string) -> any",
    "What another file of the script returns, or of a package: require(\"@castle/towers\"). Each is run once.",
);

static LOD: Name = Name::new(
    "lod",
    NameKind::Global,
    "number",
    "The level of detail of the run: 0 ground plans, 1 blocks, 2 roofs, 3 everything.",
);

/// What a script's parameters are declared with.
pub(crate) static PARAM: Name = Name::new(
    "param",
    NameKind::Global,
    "(name: string, options: { ... }) -> any",
    "Declares a value that people may change without editing the script, and gives the one that it has in this run.",
)
.parts(&[
    NameMember::new("default", "number | boolean | string", "The value if nobody says another; it must be given."),
    NameMember::new("min", "number?", "The least value.").or("nil"),
    NameMember::new("max", "number?", "The greatest value.").or("nil"),
    NameMember::new("step", "number?", "How far values are from one another, counted from the least one.").or("nil"),
    NameMember::new("choices", "{ string }?", "The texts to choose from.").or("nil"),
    NameMember::new("unit", "string", "The unit, for people.").or("\"\""),
    NameMember::new("text", "string", "What it does, for people.").or("\"\""),
]);

/// What a system is made with.
pub(crate) static LSYSTEM: Name = Name::new(
    "lsystem",
    NameKind::Global,
    "(options: { ... }?) -> System",
    "Makes a system of rules; what it has is told of under system.",
)
.parts(&[
    NameMember::new("object", "any", "What the chains draw with: an object, or the constructor of one.")
        .or("nil"),
    NameMember::new(
        "interpret",
        "\"last\"?",
        "With \"last\", only the last chain is interpreted, and not that of every step.",
    )
    .or("nil"),
    NameMember::new("seed", "number?", "What its random numbers come from, in place of the run's seed.")
        .or("nil"),
]);

/// What a type of object is declared with.
pub(crate) static OBJECT: Name = Name::new(
    "object",
    NameKind::Global,
    "(name: string, declaration: { ... }) -> (fields: { ... }?) -> any",
    "Declares a type of object, and gives the function that makes objects of it.",
)
.parts(&[
    NameMember::new("doc", "string?", "What it is; the first line is a summary.").or("nil"),
    NameMember::new(
        "extends",
        "((...any) -> any)?",
        "The constructor of the type whose fields, methods and drawing it has, too.",
    )
    .or("nil"),
    NameMember::new(
        "fields",
        "{ [string]: any }?",
        "What its constructor takes, each as { default =, type =, min =, max =, choices =, unit =, doc = }.",
    )
    .or("nil"),
    NameMember::new(
        "state",
        "{ [string]: any }?",
        "What its functions may assign, with the values that every pass begins with; objects draw into its drawing.",
    )
    .or("nil"),
    NameMember::new("reads", "{ [string]: (self, ...any) -> any }?", "Functions that rules may call, too.").or("nil"),
    NameMember::new(
        "changes",
        "{ [string]: (self, ...any) -> any }?",
        "Functions that only interpretations may call; without a result they give the object.",
    )
    .or("nil"),
    NameMember::new("begin", "((self) -> ())?", "Runs before a chain is interpreted.").or("nil"),
    NameMember::new("push", "((self) -> ())?", "Runs where a branch opens.").or("nil"),
    NameMember::new("pop", "((self) -> ())?", "Runs where a branch closes.").or("nil"),
    NameMember::new("finish", "((self) -> ())?", "Runs after a chain was interpreted.").or("nil"),
]);

/// What is added to a type of object.
pub(crate) static EXTEND: Name = Name::new(
    "extend",
    NameKind::Global,
    "(constructor: (...any) -> any, declaration: { ... }) -> ()",
    "Adds functions to a type of object, for the scripts of this run.",
)
.parts(&[
    NameMember::new("reads", "{ [string]: (self, ...any) -> any }?", "Functions that rules may call, too.")
        .or("nil"),
    NameMember::new(
        "changes",
        "{ [string]: (self, ...any) -> any }?",
        "Functions that only interpretations may call.",
    )
    .or("nil"),
]);

/// What a system has.
pub(crate) static SYSTEM: Name =
    Name::new("system", NameKind::Given, "System", "A system of rules, as lsystem gives it.").parts(&[
        NameMember::method(
            "axiom",
            "(...Module | source, (feature) -> (...Module)) -> System",
            "Sets what the chain begins as, or the function that makes the chain of each feature of a source.",
        ),
        NameMember::method(
            "rule",
            "(pattern: string, options: { ... }?, successor: (this, ...any) -> (...Module) | string) -> System",
            "Adds a rule: what replaces a module that the pattern describes. What its options are is told of under rule.",
        ),
        NameMember::method(
            "interpret",
            "(pattern: string, (this, ...any) -> ()) -> System",
            "Adds an interpretation: what is drawn for a module.",
        ),
        NameMember::method("ignore", "(...string) -> System", "Names modules that matching of contexts passes over."),
        NameMember::method("consider", "(...string) -> System", "Names the only modules that matching of contexts sees."),
        NameMember::method(
            "derive",
            "(steps: number?) -> Derived",
            "Applies the rules step by step, to the end where no number of steps is given.",
        ),
    ]);

/// What a rule may be told.
pub(crate) static RULE: Name = Name::new(
    "rule",
    NameKind::Given,
    "{ ... }",
    "The options of system:rule, between its pattern and its successor.",
)
.parts(&[
    NameMember::new(
        "weight",
        "number?",
        "How often it is drawn, to the weights of the other rules that apply; never, if it is 0.",
    )
    .or("nil"),
    NameMember::new(
        "when",
        "((this, ...any) -> boolean)?",
        "The guard: the rule applies only where this function returns true.",
    )
    .or("nil"),
]);

/// What a derived system has.
pub(crate) static DERIVED: Name = Name::new(
    "derived",
    NameKind::Given,
    "Derived",
    "A derived system, as system:derive gives it, which is also a model.",
)
.parts(&[
    NameMember::new("objects", "{ any }", "The objects that the chains have drawn with."),
    NameMember::new("chains", "{ string }", "The chains as text."),
    NameMember::new("steps", "number", "How many steps there were."),
    NameMember::new("modules", "number", "How many modules the chains have."),
]);

/// What a source is chosen by.
pub(crate) static SOURCE: Name = Name::new(
    "source",
    NameKind::Global,
    "(what: string | { any }, options: { ... }?) -> Layer",
    "The features of a data file, or of a list; what it has is told of under layer.",
)
.parts(&[
    NameMember::new("where", "string?", "An SQL condition, for GeoPackages.").or("nil"),
    NameMember::new("limit", "number?", "At most as many features.").or("nil"),
    NameMember::new("id", "string?", "The attribute that tells features apart.").or("nil"),
    NameMember::new("kind", "string?", "Only features with a \"point\", a \"line\" or a \"polygon\".")
        .or("nil"),
    NameMember::new("crs", "number?", "The EPSG code of the coordinates, in place of the file's.").or("nil"),
    NameMember::new("layer", "string?", "The layer, if its name does not stand behind a colon.").or("nil"),
]);

/// What a source has.
pub(crate) static LAYER: Name = Name::new(
    "layer",
    NameKind::Given,
    "Layer",
    "Features, as source gives them: for index, feature in it do, and #it.",
)
.parts(&[
    NameMember::new("features", "{ Feature }", "The features as a list."),
    NameMember::new(
        "bounds",
        "{ min: { number }, max: { number } }?",
        "The corners of the box around them (m).",
    )
    .unit("m"),
    NameMember::new("layer", "string?", "The name of the layer."),
    NameMember::new("crs", "string?", "The coordinate system of the file."),
    NameMember::new("origin", "{ number }?", "Where the run's origin is in its projection (m).").unit("m"),
]);

static FEATURE: Name = Name::new(
    "feature",
    NameKind::Given,
    "Feature",
    "A feature of a data file: its attributes by name, and these, which win over attributes.",
)
.parts(&[
    NameMember::new("id", "string", "What tells it from all others."),
    NameMember::new("geometry", "Geometry", "Where it is; what a geometry has is told of under geometry."),
    NameMember::new("layer", "string", "The name of its layer."),
]);

static GEOMETRY: Name =
    Name::new("geometry", NameKind::Given, "Geometry", "Where a feature of a data file is.").parts(&[
        NameMember::new("kind", "string", "What it is: \"point\", \"line\" or \"polygon\"."),
        NameMember::new(
            "rings",
            "{ { { number } } }?",
            "Of a polygon, the outer ring, which turns left, and its holes: points { x, y, z } (m).",
        )
        .unit("m"),
        NameMember::new("points", "{ { number } }?", "Of a line or a point, its points { x, y, z } (m).")
            .unit("m"),
    ]);
