//! Functions that create shapes.

use burgeon_kit::{Argument, Field};

use super::name::{Name, field, options};
use crate::form::argument;

/// Returns the functions that create shapes.
pub(super) fn shape_functions() -> [Name; 9] {
    let length = |name: &'static str| argument(name, "number");
    let sides = || argument("sides", "number?");
    [
        Name::global(
            "shape",
            "Creates a shape: a face of a polygon at a `height` (m, 0 unless given) or in an upright plane, the shape of a model, \
             a mesh of { points = { vec(...) }, faces = { { 1, 2, 3 } } }, or one shape of a list of shapes; see the type shape.",
        )
        .form([argument("from", "any"), argument("height", "number?")], "Shape")
        .pure(),
        Name::global("cuboid", "Creates a solid box with a corner at the origin, of size `x` (m), `y` (m) and `z` (m).")
            .form([length("x"), length("y"), length("z")], "Shape")
            .pure(),
        Name::global("rectangle", "Creates a face that looks upwards, with a corner at the origin, of size `x` (m) and `y` (m).")
            .form([length("x"), length("y")], "Shape")
            .pure(),
        Name::global("disk", "Creates a face that looks upwards: a regular polygon with `radius` (m) and `sides`, 32 unless given.")
            .form([length("radius"), sides()], "Shape")
            .pure(),
        Name::global("cylinder", "Creates an upright solid cylinder with `radius` (m), `height` (m) and `sides`, 32 unless given.")
            .form([length("radius"), length("height"), sides()], "Shape")
            .pure(),
        Name::global("cone", "Creates an upright solid cone with `radius` (m), `height` (m) and `sides`, 32 unless given.")
            .form([length("radius"), length("height"), sides()], "Shape")
            .pure(),
        Name::global("ball", "Creates a solid ball around the origin with `radius` (m) and `sides`, 32 unless given.")
            .form([length("radius"), sides()], "Shape")
            .pure(),
        Name::global(
            "revolve",
            "Creates the solid that an outline sweeps around an axis through the origin: x of its points (m) is the distance from the \
             axis, y the position along it. Texture coordinates run around the axis and along the outline. Faces have the tags \
             \"revolve.side\", \"revolve.start\" and \"revolve.end\".",
        )
        .form([argument("outline", "{ Vector } | Geometry"), revolve_options()], "Shape")
        .pure(),
        Name::global(
            "text",
            "Creates the letters of a text as faces that look upwards, x along the line and the first line on the x axis. Faces \
             have the tags \"text.1\", \"text.2\" and so on, by their letter. Lines are separated by \"\\n\".",
        )
        .form([argument("letters", "string"), text_options()], "Shape")
        .pure(),
    ]
}

/// Returns the options of `revolve`.
fn revolve_options() -> Argument {
    let with = |unit: &'static str, field: Field| Field { unit: Some(unit.into()), ..field };
    let fields = [
        field("axis", "Vector", "vec(0, 0, 1)", "Direction of the axis through the origin."),
        with("degrees", field("angle", "number", "360", "Angle of the turn (degrees), up to 360.")),
        field("sides", "number", "32", "Number of flat sides of the turn."),
        with("m", field("tile", "number", "1", "Size of a tile of the texture (m).")),
    ];
    Argument { luau: "{ ... }?".into(), ..options("{ ... }?", fields) }
}

/// Returns the options of `text`.
fn text_options() -> Argument {
    let length = |name: &'static str, luau: &str, default: &str, doc: &'static str| Field {
        unit: Some("m".into()),
        ..field(name, luau, default, doc)
    };
    let fields = [
        length("size", "number", "1", "Height of capital letters (m)."),
        field("font", "Font?", "nil", "Font of a file: font(\"sign.ttf\"); Noto Sans unless given."),
        field(
            "align",
            "string",
            "\"left\"",
            "Part of a line that is at x = 0: \"left\", \"center\" or \"right\".",
        ),
        length("spacing", "number", "0", "Distance added between letters (m)."),
        length("line_height", "number?", "nil", "Distance between lines (m); that of the font unless given."),
        length(
            "tolerance",
            "number?",
            "nil",
            "Maximum distance of curves from their lines (m); a five hundredth of the size unless given.",
        ),
    ];
    Argument { luau: "{ ... }?".into(), ..options("{ ... }?", fields) }
}
