//! The names that Burgeon adds to Luau in Rust, and what they give.

use super::{Name, Part, Sort};

/// All of them.
pub(super) static NAMES: &[&Name] = &[
    &API, &LOD, &LSYSTEM, &MODULE, &PARAM, &RANDOM, &REQUIRE, &SOURCE, &DERIVED, &FEATURE, &GEOMETRY, &LAYER,
    &RULE, &SYSTEM,
];

static API: Name = Name::new(
    "api",
    Sort::Global,
    "{ version: string, has: (name: string) -> boolean }",
    "What scripts can rely on: the version of these names, and whether a name is among them.",
)
.parts(&[
    Part::new("version", "string", "The version of the script API, such as \"1.0.0\"."),
    Part::new(
        "has",
        "(name: string) -> boolean",
        "Whether there is such a name, such as \"terrain\" or \"extruder.bend\", or such a package, as \"@castle\".",
    ),
])
.pure();

static MODULE: Name = Name::new(
    "module",
    Sort::Global,
    "(name: string, ...string) -> (...any) -> Module",
    "Declares modules with this name and these parameters, and gives the function that makes them. A parameter whose \
     name ends with ? may be left out.",
);

static RANDOM: Name = Name::new(
    "random",
    Sort::Global,
    "(a: number?, b: number?) -> number",
    "A random number of the module that is rewritten or drawn: from 0 to 1, or between a and b.",
)
.pure();

static REQUIRE: Name = Name::new(
    "require",
    Sort::Global,
    "(name: string) -> any",
    "What another file of the script returns, or of a package: require(\"@castle/towers\"). Each is run once.",
);

static LOD: Name = Name::new(
    "lod",
    Sort::Global,
    "number",
    "The level of detail of the run: 0 ground plans, 1 blocks, 2 roofs, 3 everything.",
);

/// What a script's parameters are declared with.
pub(crate) static PARAM: Name = Name::new(
    "param",
    Sort::Global,
    "(name: string, options: { ... }) -> any",
    "Declares a value that people may change without editing the script, and gives the one that it has in this run.",
)
.parts(&[
    Part::new("default", "number | boolean | string", "The value if nobody says another; it must be given."),
    Part::new("min", "number?", "The least value.").or("nil"),
    Part::new("max", "number?", "The greatest value.").or("nil"),
    Part::new("step", "number?", "How far values are from one another, counted from the least one.").or("nil"),
    Part::new("choices", "{ string }?", "The texts to choose from.").or("nil"),
    Part::new("unit", "string", "The unit, for people.").or("\"\""),
    Part::new("text", "string", "What it does, for people.").or("\"\""),
]);

/// What a system is made with.
pub(crate) static LSYSTEM: Name = Name::new(
    "lsystem",
    Sort::Global,
    "(options: { ... }?) -> System",
    "Makes a system of rules; what it has is told of under system.",
)
.parts(&[
    Part::new("object", "any", "What the chains draw with: an object, or the constructor of one.").or("nil"),
    Part::new(
        "interpret",
        "\"last\"?",
        "With \"last\", only the last chain is interpreted, and not that of every step.",
    )
    .or("nil"),
    Part::new("seed", "number?", "What its random numbers come from, in place of the run's seed.").or("nil"),
]);

/// What a system has.
pub(crate) static SYSTEM: Name =
    Name::new("system", Sort::Given, "System", "A system of rules, as lsystem gives it.").parts(&[
        Part::method(
            "axiom",
            "(...Module | source, (feature) -> (...Module)) -> System",
            "Sets what the chain begins as, or the function that makes the chain of each feature of a source.",
        ),
        Part::method(
            "rule",
            "(pattern: string, options: { ... }?, successor: (this, ...any) -> (...Module) | string) -> System",
            "Adds a rule: what replaces a module that the pattern describes. What its options are is told of under rule.",
        ),
        Part::method(
            "interpret",
            "(pattern: string, (this, ...any) -> ()) -> System",
            "Adds an interpretation: what is drawn for a module.",
        ),
        Part::method("ignore", "(...string) -> System", "Names modules that matching of contexts passes over."),
        Part::method("consider", "(...string) -> System", "Names the only modules that matching of contexts sees."),
        Part::method(
            "derive",
            "(steps: number?) -> Derived",
            "Applies the rules step by step, to the end where no number of steps is given.",
        ),
    ]);

/// What a rule may be told.
pub(crate) static RULE: Name = Name::new(
    "rule",
    Sort::Given,
    "{ ... }",
    "The options of system:rule, between its pattern and its successor.",
)
.parts(&[
    Part::new(
        "weight",
        "number?",
        "How often it is drawn, to the weights of the other rules that apply; never, if it is 0.",
    )
    .or("nil"),
    Part::new(
        "when",
        "((this, ...any) -> boolean)?",
        "The guard: the rule applies only where this function returns true.",
    )
    .or("nil"),
]);

/// What a derived system has.
pub(crate) static DERIVED: Name = Name::new(
    "derived",
    Sort::Given,
    "Derived",
    "A derived system, as system:derive gives it, which is also a model.",
)
.parts(&[
    Part::new("objects", "{ any }", "The objects that the chains have drawn with."),
    Part::new("chains", "{ string }", "The chains as text."),
    Part::new("steps", "number", "How many steps there were."),
    Part::new("modules", "number", "How many modules the chains have."),
]);

/// What a source is chosen by.
pub(crate) static SOURCE: Name = Name::new(
    "source",
    Sort::Global,
    "(what: string | { any }, options: { ... }?) -> Layer",
    "The features of a data file, or of a list; what it has is told of under layer.",
)
.parts(&[
    Part::new("where", "string?", "An SQL condition, for GeoPackages.").or("nil"),
    Part::new("limit", "number?", "At most as many features.").or("nil"),
    Part::new("id", "string?", "The attribute that tells features apart.").or("nil"),
    Part::new("kind", "string?", "Only features with a \"point\", a \"line\" or a \"polygon\".").or("nil"),
    Part::new("crs", "number?", "The EPSG code of the coordinates, in place of the file's.").or("nil"),
    Part::new("layer", "string?", "The layer, if its name does not stand behind a colon.").or("nil"),
]);

/// What a source has.
pub(crate) static LAYER: Name = Name::new(
    "layer",
    Sort::Given,
    "Layer",
    "Features, as source gives them: for index, feature in it do, and #it.",
)
.parts(&[
    Part::new("features", "{ Feature }", "The features as a list."),
    Part::new("bounds", "{ min: { number }, max: { number } }?", "The corners of the box around them (m).")
        .unit("m"),
    Part::new("layer", "string?", "The name of the layer."),
    Part::new("crs", "string?", "The coordinate system of the file."),
    Part::new("origin", "{ number }?", "Where the run's origin is in its projection (m).").unit("m"),
]);

static FEATURE: Name = Name::new(
    "feature",
    Sort::Given,
    "Feature",
    "A feature of a data file: its attributes by name, and these, which win over attributes.",
)
.parts(&[
    Part::new("id", "string", "What tells it from all others."),
    Part::new("geometry", "Geometry", "Where it is; what a geometry has is told of under geometry."),
    Part::new("layer", "string", "The name of its layer."),
]);

static GEOMETRY: Name = Name::new("geometry", Sort::Given, "Geometry", "Where a feature of a data file is.")
    .parts(&[
        Part::new("kind", "string", "What it is: \"point\", \"line\" or \"polygon\"."),
        Part::new(
            "rings",
            "{ { { number } } }?",
            "Of a polygon, the outer ring, which turns left, and its holes: points { x, y, z } (m).",
        )
        .unit("m"),
        Part::new("points", "{ { number } }?", "Of a line or a point, its points { x, y, z } (m).").unit("m"),
    ]);
