//! Names of other languages and programs, and what stands for them here.

/// Returns the remedy for a name that scripts do not have, if it is known from another language or program.
///
/// ```
/// use burgeon_language::slips::remedy_of_name;
///
/// assert_eq!(remedy_of_name("None"), Some("write nil"));
/// assert_eq!(remedy_of_name("trunk"), None);
/// ```
pub fn remedy_of_name(name: &str) -> Option<&'static str> {
    Some(match name {
        "None" | "null" | "NULL" | "undefined" | "Nil" => "write nil",
        "True" | "TRUE" => "write true",
        "False" | "FALSE" => "write false",
        "sqrt" => "write math.sqrt(x)",
        "sin" | "cos" | "tan" | "asin" | "acos" | "atan" | "atan2" => {
            "write math.sin(x) and so on; angles of Lua's functions are in radians: math.sin(math.rad(30))"
        }
        "floor" | "ceil" | "round" | "abs" | "exp" | "log" | "max" | "min" | "sign" => {
            "write math.floor(x) and so on"
        }
        "pow" => "write powers with ^: x ^ 2",
        "radians" => "write math.rad(x)",
        "degrees" => "write math.deg(x)",
        "pi" | "PI" => "write math.pi",
        "len" | "length" | "size" => "write #list",
        "range" | "xrange" => "write for i = 1, 5 do ... end",
        "enumerate" => "write for index, value in list do ... end",
        "str" => "write tostring(x), or put x in a text: `n is {x}`",
        "int" => "write math.floor(x)",
        "float" | "parseFloat" | "parseInt" => "write tonumber(x)",
        "append" | "push" | "push_back" => "write table.insert(list, value)",
        "concat" | "join" => "write table.concat(list, \", \")",
        "console" | "echo" | "printf" | "puts" | "println" | "log_info" => "write print(x)",
        "format" => "write string.format(\"%d\", x), or put x in a text: `n is {x}`",
        "f" => "write texts with values between backticks: `n is {n}`",
        "Vector3" | "Vector2" | "Vector" | "vec2" | "vec3" | "Vec3" | "float3" | "float2" | "V3"
        | "PVector" | "CFrame" => "write vec(x, y, z)",
        "Color3" | "Color" | "color" => "write rgb(\"#ff8000\") or { 1, 0.5, 0 }",
        "rand" | "rands" | "randint" | "uniform" | "Random" | "ran" | "rnd" => {
            "write random() or random(low, high), which depend on the seed and the module"
        }
        "noise3" | "perlin" | "Perlin" => "write noise(x, y, z)",
        "self" | "me" => "write this: the first parameter of a rule's or interpretation's function",
        "wait" | "sleep" | "delay" | "task" => "leave it out: a script makes a model and does not wait",
        "game" | "workspace" | "Instance" | "script" | "Enum" => {
            "make the model with systems and objects, and export it: burgeon run script.lua -o model.glb"
        }
        "box" | "cube" | "Box" | "Cube" => {
            "write cuboid(x, y, z), which is a shape, and draw it in an interpretation: this:shape(solid)"
        }
        "save" | "export" | "write" | "render" | "show" | "draw" => {
            "leave it out: the command writes the model, burgeon run script.lua -o model.glb"
        }
        "translate" | "rotate" | "union" | "difference" | "intersection" | "hull" | "linear_extrude"
        | "children" | "minkowski" => {
            "draw in an interpretation by methods of its object: this:shift(1, 0):extrude(2) of an extruder"
        }
        "material" => {
            "write it as a method of an object, in an interpretation: this:material({ texture = \"brick.png\" })"
        }
        "Axiom" | "axiom" => "write system:axiom(F(1))",
        "produce" | "nproduce" => "return the modules: return F(1), { Turn(30), F(1) }",
        "Lsystem" | "LSystem" | "lstring" | "derivation" => "write local s = lsystem({ object = turtle() })",
        "nF" => "write F(1)",
        "input" | "open" | "read" | "File" => "read data with source(\"file\"), text with require",
        "np" | "numpy" => "write math and table functions; lists are tables: { 1, 2 }",
        "new" => "call the constructor without new: turtle({ width = 0.1 })",
        "this" => "give the function the parameter this: function(this, x)",
        _ => return None,
    })
}

/// Returns the remedy for a method or field that a system, its options or a derived system do not have: what to write for a name of
/// another program, or the `known` names.
///
/// ```
/// use burgeon_language::slips::remedy_of_system_method;
///
/// assert_eq!(remedy_of_system_method("iterate", &["axiom"]), "write system:derive(5)");
/// assert_eq!(remedy_of_system_method("abc", &["axiom", "rule"]), "it has axiom, rule");
/// ```
pub fn remedy_of_system_method(name: &str, known: &[&str]) -> String {
    let remedy = match name {
        "save" | "export" | "write" | "render" | "draw" | "show" | "plot" | "display" | "view" => {
            "leave it out: the command writes the model of what is derived, burgeon run script.lua -o model.glb"
        }
        "iterate" | "iterations" | "step" | "steps" | "run" | "evolve" | "generate" | "grow" | "expand"
        | "rewrite" | "execute" | "n" | "depth" | "derivation_length" => "write system:derive(5)",
        "axiom" | "start" | "seed_axiom" | "initial" | "begin" | "word" => "write system:axiom(F(1))",
        "rule" | "rules" | "add_rule" | "addRule" | "production" | "productions" | "replace" | "on" => {
            "write system:rule(\"A(n)\", function(this, n) return ... end)"
        }
        "homomorphism" | "interpretation" | "turtle" | "visualize" => {
            "write system:interpret(\"A(n)\", function(this, n) ... end)"
        }
        "angle" | "length" | "width" | "delta" => {
            "give it to the object: lsystem({ object = turtle({ angle = 25 }) })"
        }
        _ => return format!("it has {}", known.join(", ")),
    };
    remedy.to_owned()
}
