//! Names that Burgeon adds to Luau in Rust, and the types of their results.

use std::sync::LazyLock;

use burgeon_kit::{Argument, Field};

use super::name::{Name, Operator, field, options};
use super::shapes::shape_functions;
use super::systems::{DERIVE, DERIVED, LSYSTEM, NOW, RULE, SYSTEM};
use crate::form::argument;

/// Returns all names of this file.
pub(super) fn names() -> Vec<Name> {
    let shared = [
        &*PARAM, &CAMERA, &OBJECT, &EXTEND, &LSYSTEM, &SYSTEM, &RULE, &DERIVE, &DERIVED, &NOW, &SOURCE,
        &LAYER, &QUERY, &FRAGMENT, &VECTOR,
    ];
    let mut names: Vec<Name> = shared.into_iter().cloned().collect();
    names.extend([
        Name::global(
            "module",
            "Declares a module and returns its constructor. A parameter whose name ends with ? is optional.",
        )
        .form([argument("name", "string"), argument("...", "string")], "(...any) -> Module"),
        Name::global(
            "random",
            "Returns a random number between `a` (0 unless given) and `b` (1 unless given), which depends on the seed and the current module. Pass both bounds or none.",
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
        distribution(
            "normal",
            "Returns a random number with a normal distribution, by its mean and standard deviation.",
            &[("mean", "number"), ("deviation", "number")],
            "number",
        ),
        distribution(
            "poisson",
            "Returns a random count with a Poisson distribution, by its mean: the number of independent events.",
            &[("mean", "number")],
            "number",
        ),
        distribution(
            "binomial",
            "Returns a random count with a binomial distribution: the number of successes in `n` trials with probability `p`.",
            &[("n", "number"), ("p", "number")],
            "number",
        ),
        distribution(
            "beta",
            "Returns a random number between 0 and 1 with a beta distribution, by its shapes: the mean is a / (a + b).",
            &[("a", "number"), ("b", "number")],
            "number",
        ),
        distribution(
            "choose",
            "Returns a random value of a list. All values are equally likely, unless a list has the weight of each value.",
            &[("list", "{ any }"), ("weights", "({ number } | ((number?, number?) -> number))?")],
            "any",
        ),
        Name::global(
            "step",
            "Returns the number of the derivation step that is running, from 1; in an interpretation, the number of the step \
             that made the chain, and 0 for the axiom. A derivation whose functions call it needs a number of steps, and makes \
             all of them.",
        )
        .form([], "number")
        .pure(),
        Name::global(
            "time",
            "Returns the time of the event that is happening, in a rule with a propensity; in an interpretation, the time of the \
             chain.",
        )
        .form([], "number")
        .pure(),
        Name::global(
            "stop",
            "Ends the derivation after the step that is running. Rules, interpretations and hooks can call it.",
        )
        .form([], "()"),
        Name::global(
            "report",
            "Adds a number to the sum of `name` for the feature of the chain, such as a floor area (m²), in an interpretation. The \
             sums of the last drawing are written to .csv files, to the JSON document of a run and to its summary.",
        )
        .form([argument("name", "string"), argument("value", "number")], "()"),
        Name::global(
            "use_group",
            "Chooses the group of rules for the next steps, in a hook; without a name, only rules without a group apply.",
        )
        .form([argument("name", "string?")], "()"),
        Name::global(
            "variables",
            "Declares variables of a system with their first values, for lsystem({ variables = ... }). Hooks and interpretations \
             assign them, such as clock.time += 1; rules and guards read them as the step began. Each derivation begins with the \
             first values; after it, they are in derived.variables.",
        )
        .form([argument("values", "T")], "T"),
        Name::global(
            "warn",
            "Adds a warning to the run, with the problem and its remedy. Only the top level of a script, its functions and hooks can warn, not rules.",
        )
        .form([argument("text", "string"), argument("help", "string?")], "()"),
        Name::global(
            "sequence",
            "Returns the modules of a list, for a successor, an interpretation or an axiom: a table alone is a branch. The list \
             may have any length.",
        )
        .form([argument("list", "{ any }")], "Module")
        .pure(),
        Name::global(
            "expect",
            "Checks a known result of the script, such as a number of modules: the run fails if `actual` and `expected` differ, \
             numbers by more than `tolerance` (0 unless given). It checks only runs with the script's own values: with another \
             seed, number of steps or parameter value, it does nothing.",
        )
        .form([argument("actual", "any"), argument("expected", "any"), argument("tolerance", "number?")], "()"),
        Name::global("require", "Returns the result of another file of the script or of a package: require(\"@castle/towers\"). Each file runs once.")
            .form([argument("name", "string")], "any"),
        Name::global(
            "api",
            "The version of the script API, and a test for its names.",
        )
        .fields([Field::new("version", "string", "The version of the script API, such as \"1.1.0\".")])
        .functions([Name::function(
            "has",
            "Tests whether a name exists, such as \"terrain\" or \"extruder.bend\", or a package, such as \"@castle\".",
        )
        .form([argument("name", "string")], "boolean")
        .pure()])
        .pure(),
        Name::global(
            "lod",
            "The level of detail of the run: 0 footprints, 1 blocks, 2 roofs, 3 full detail.",
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
            "A feature of a data file: its attributes by name, and these fields, which override attributes of the same name.",
        )
        .fields([
            Field::new("id", "string", "The unique id."),
            Field::new(
                "geometry",
                "Geometry",
                "The geometry; see `geometry`.",
            ),
            Field::new("layer", "string", "The name of the layer."),
            Field::new("[string]", "any", "The attributes, by name."),
        ]),
        Name::global(
            "geometry",
            "Creates a geometry from well-known text such as \"POLYGON ((0 0, 4 0, 4 3, 0 0))\", a feature, or a table with rings or points; see the type geometry.",
        )
        .form([argument("text", "string | Geometry | { any }")], "Geometry")
        .pure(),
        Name::global("point", "Creates a point from its coordinates: east `x` (m), north `y` (m) and height `z` (m); or from a vector.")
            .form([argument("x", "number"), argument("y", "number"), argument("z", "number?")], "Geometry")
            .form([argument("place", "Vector | Geometry")], "Geometry")
            .pure(),
        Name::global("line", "Creates a line through points (m), given as a list or as separate arguments.")
            .form([argument("points", "{ any }")], "Geometry")
            .form([argument("...", "Vector | Geometry")], "Geometry")
            .pure(),
        Name::global(
            "polygon",
            "Creates a polygon from the points of its outer ring (m), or from a list of rings: the outer ring and the holes.",
        )
        .form([argument("rings", "{ any } | Geometry")], "Geometry")
        .form([argument("...", "Vector | Geometry")], "Geometry")
        .pure(),
    ]);
    names.extend(shape_functions());
    names
}

/// Creates a random distribution with these arguments, and a random stream as the last argument.
fn distribution(
    name: &'static str,
    doc: &'static str,
    arguments: &[(&'static str, &str)],
    returns: &str,
) -> Name {
    let stream = ("r", "((number?, number?) -> number)?");
    let arguments = arguments.iter().chain([&stream]).map(|(name, luau)| argument(name, luau));
    let doc = format!(
        "{doc} The numbers come from the current module, as those of `random` do, or from the random stream `r`."
    );
    let name = Name::global(name, "").form(arguments.collect::<Vec<_>>(), returns).pure();
    Name { doc: doc.into(), ..name }
}

fn metres(name: &'static str, luau: &str, doc: &'static str) -> Field {
    Field { unit: Some("m".into()), ..Field::new(name, luau, doc) }
}

fn degrees(field: Field) -> Field {
    Field { unit: Some("deg".into()), ..field }
}

/// Declaration of a script parameter.
pub static PARAM: LazyLock<Name> = LazyLock::new(|| {
    Name::global("param", "Declares a script parameter and returns its value for this run.").form(
        [
            argument("name", "string"),
            options(
                "{ ... }",
                [
                    field(
                        "default",
                        "number | boolean | string | Ramp | Curve | Surface",
                        "",
                        "Default value; required. Functions and curves are drawn in the live page.",
                    ),
                    field("min", "number?", "nil", "Minimum value."),
                    field("max", "number?", "nil", "Maximum value."),
                    field("step", "number?", "nil", "Step between values, from the minimum."),
                    field("choices", "{ string }?", "nil", "Allowed strings."),
                    field(
                        "group",
                        "string",
                        "\"\"",
                        "Heading in the live page, shared with other parameters. Parameters without one come first.",
                    ),
                    field("unit", "string", "\"\"", "Display unit."),
                    field("doc", "string", "\"\"", "Description for users.").renamed_from("text", "1.1"),
                ],
            ),
        ],
        "any",
    )
});

/// Fields of a camera that give its direction: the angle from north, and the angle above the horizon.
pub const CAMERA_ANGLES: [&str; 2] = ["azimuth", "elevation"];

/// Declaration of a camera.
pub static CAMERA: LazyLock<Name> = LazyLock::new(|| {
    Name::global(
        "camera",
        "Adds a camera to the model, for pictures and glTF files. The first camera is that of pictures; \
         `--camera NAME` selects another.",
    )
    .form(
        [options(
            "{ ... }",
            [
                field("name", "string", "\"camera\"", "Name, unique in the script."),
                field(
                    "from",
                    "Vector?",
                    "nil",
                    "Position of the camera (m): x, y and z. Required unless angles or `view` fit the camera to the model.",
                ),
                field("to", "Vector?", "nil", "Point in the middle of the picture (m): x, y and z."),
                degrees(field("azimuth", "number?", "nil", "Direction from which the camera sees the model, instead of `from`: 0 is north, 90 east. The camera is as far away as shows the whole model, or the sphere of `to` and `radius`. Without it, the model's shape determines it. Also for the view \"eye\".")),
                degrees(field("elevation", "number?", "nil", "Height above the horizon from which the camera sees the model, -90 to 90, with or instead of `azimuth`.")),
                metres("radius", "number?", "Radius around `to` that a camera by angles shows. Without both, it shows the whole model."),
                degrees(field("fov", "number", "40", "Vertical field of view, 1 to 120.")),
                field(
                    "view",
                    "(\"perspective\" | \"orthographic\" | \"plan\" | \"eye\")?",
                    "\"perspective\"",
                    "Projection: \"perspective\"; \"orthographic\", in which parallel lines stay parallel; \"plan\", from above \
                     with north at the top; or \"eye\", from the height of a standing person's eyes. \"plan\" and \"eye\" are \
                     fitted to the model.",
                ),
                metres("height", "number?", "Height that an orthographic picture shows. Without it, the picture shows the whole model."),
            ],
        )],
        "()",
    )
});

/// Declaration of an object type.
pub static OBJECT: LazyLock<Name> = LazyLock::new(|| {
    let functions = "{ [string]: (self: any, ...any) -> any }?";
    let hook = "((self: any) -> ())?";
    let fields = [
        field("doc", "string?", "nil", "Description; the first line is a summary."),
        field(
            "extends",
            "((...any) -> any)?",
            "nil",
            "Constructor of the base type, whose fields, methods and drawing are inherited.",
        ),
        field(
            "fields",
            "{ [string]: any }?",
            "nil",
            "Fields of the constructor, each as { default =, type =, min =, max =, choices =, unit =, doc = }.",
        ),
        field(
            "state",
            "{ [string]: any }?",
            "nil",
            "State variables that write methods can assign, with their values at the beginning of every pass; child objects draw into the drawing.",
        ),
        field("reads", functions, "nil", "Read methods, which rules can call."),
        field(
            "changes",
            functions,
            "nil",
            "Write methods, which only interpretations can call; without a result they return the object.",
        ),
        field("begin", hook, "nil", "Runs before a chain is interpreted."),
        field("push", hook, "nil", "Runs when a branch opens."),
        field("pop", hook, "nil", "Runs when a branch closes."),
        field("finish", hook, "nil", "Runs after a chain is interpreted."),
    ];
    let declaration = Argument { fields: fields.into(), ..argument("declaration", "{ ... }") };
    Name::global("object", "Declares an object type and returns its constructor.")
        .form([argument("name", "string"), declaration], "(fields: { ... }?) -> any")
});

/// Extension of an object type.
pub static EXTEND: LazyLock<Name> = LazyLock::new(|| {
    let functions = "{ [string]: (self: any, ...any) -> any }?";
    let fields = [
        field("reads", functions, "nil", "Read methods, which rules can call."),
        field("changes", functions, "nil", "Write methods, which only interpretations can call."),
    ];
    let declaration = Argument { fields: fields.into(), ..argument("declaration", "{ ... }") };
    Name::global("extend", "Adds methods to an object type for this run.")
        .form([argument("constructor", "(...any) -> any"), declaration], "()")
});

/// Loading of features, with the options that select them.
pub static SOURCE: LazyLock<Name> = LazyLock::new(|| {
    Name::global("source", "Loads the features of a data file, or of a list; see `layer`.")
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
                            "OpenStreetMap tags: true for any value except no, \"*\" for any value, false for a missing tag, a string, or a list of strings. All tags must match; of a list of such tables, one must match.",
                        ),
                        field(
                            "within",
                            "{ number }?",
                            "nil",
                            "West, south, east and north of a box that features touch, in the coordinates of the file.",
                        ),
                        field("limit", "number?", "nil", "Maximum number of features."),
                        field("id", "string?", "nil", "Name of the id attribute."),
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
                            "The EPSG code of the coordinates, instead of the file's.",
                        ),
                        field(
                            "layer",
                            "string?",
                            "nil",
                            "The layer, if its name does not follow a colon.",
                        ),
                        field(
                            "table",
                            "string?",
                            "nil",
                            "Name of the table in query, instead of the layer's name.",
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
        "Features, returned by source: for index, feature in it do, and #it.",
    )
    .items("Feature")
    .fields([
        Field::new("features", "{ Feature }", "The features as a list."),
        metres("bounds", "{ min: { number }, max: { number } }?", "The corners of the box around them (m)."),
        Field::new("layer", "string?", "The name of the layer."),
        Field::new("crs", "string?", "The coordinate system of the file."),
        metres("origin", "{ number }?", "The position of the run's origin in its projection (m)."),
    ])
});

/// SQL query.
static QUERY: LazyLock<Name> = LazyLock::new(|| {
    let sql = || argument("sql", "string");
    let values = || argument("values", "{ [string]: any }?");
    Name::global(
        "query",
        "Runs an SQL query; each source is a table named after its layer, and the modules of chains are tables named after the module. The name of a table alone selects all its rows. With a module constructor, query returns a placeholder, which is replaced by a module for each row, with the columns as parameters, before the next step begins; otherwise it returns the rows. $name in the text is the value of that name, or otherwise the parameter of the rule with that name.",
    )
    .form([sql(), argument("module", "(...any) -> Module"), values()], "Module")
    .form([sql(), values()], "{ { [string]: any } }")
    .pure()
});

/// Module for the parts of a geometry.
static FRAGMENT: LazyLock<Name> = LazyLock::new(|| {
    Name::global(
        "fragment",
        "Returns a placeholder, which is replaced by a module for each part of the module to its left, with its parameters, before the next step begins: a collection's geometries, a polygon's rings, a line's segments, a segment's points. The module to the left is removed.",
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
        "Three constant numbers, created by vec: +, - and * with vectors and lists, * and / with numbers.",
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
        metres("x", "number", "East coordinate (m)."),
        metres("y", "number", "North coordinate (m)."),
        metres("z", "number", "Height (m)."),
    ])
    .functions([
        Name::function("dot", "Returns the dot product with another vector.").form([other()], "number"),
        Name::function("cross", "Returns the cross product with another vector.").form([other()], "Vector"),
        Name::function("length", "Returns the length (m).").form([], "number"),
        Name::function("unit", "Returns the vector with length 1; a zero vector stays unchanged.")
            .form([], "Vector"),
        Name::function("distance", "Returns the distance to another vector (m).").form([other()], "number"),
        Name::function("lerp", "Interpolates linearly to another vector as t goes from 0 to 1.")
            .form([other(), argument("t", "number")], "Vector"),
    ])
});
