//! `burgeon api`: the documentation of names in scripts.

use std::path::Path;

use insta::assert_snapshot;

use super::support::Folder;

fn api(arguments: &[&str]) -> String {
    let arguments: Vec<&str> = ["api"].into_iter().chain(arguments.iter().copied()).collect();
    Folder::new().burgeon(&arguments).done().stdout
}

#[test]
fn a_type_is_told_with_its_fields_and_methods_and_an_example() {
    assert_snapshot!(api(&["universe"]), @r"
    universe { ... }
      Galaxies, stars and planets, generated on demand from the seed. The same position always gives the
      same result.

    Fields
      seed: number | string = 0
          Seed of the whole universe: a number or a string.

    Read methods: rules and interpretations can call them
      galaxy(x: number, y: number, z: number) -> any
          Returns the galaxy in a cube of space, by its column, row and layer: a table with `position`
          and `radius` (light years), `kind`, `color`, `seed`, and `stars`, the number of its stars.
      star(galaxy: { kind: string, seed: string, radius: number, stars: number }, index: number) -> any
          Returns star number `index` of a galaxy, from 1: a table with `position` (light years from the
          galaxy's centre), `radius` (m), `kind`, `color`, `seed`, and `planets`, the number of its
          planets.
      planet(star: { kind: string, seed: string, radius: number, planets: number }, index: number) -> any
          Returns planet number `index` of a star, from 1, in order of distance: a table with `position`
          (m from the star), `radius` (m), `kind`, `color`, `seed`, and `light`, relative to the light
          that the Earth receives. Pass `radius` and `seed` to `planet`.

    Example
      local all = universe({ seed = 7 })
      local galaxy = all:galaxy(0, 0, 0)
      local star = all:star(galaxy, 1)
      print(galaxy.kind, star.kind, star.planets)
    ");
    assert_snapshot!(api(&["system"]), @r#"
    system
      A system of rules, created by lsystem; T is the type of its object.

    Methods
      axiom(...Module) -> System<T>
      axiom(modules: string) -> System<T>
      axiom(source: Layer, chain: (feature: Feature) -> ...Module) -> System<T>
      axiom(derived: Derived) -> System<T>
          Sets the initial chain, as modules or as a string such as "F-F-F-F", or the function that
          returns the chain of each feature of a source. The chains of a derived system continue its
          derivation with the rules of this system.
      rule(pattern: string, successor: ((this: T, ...any) -> ...Module) | string) -> System<T>
      rule(pattern: string, options: { ... }, successor: ((this: T, ...any) -> ...Module) | string) -> System<T>
          Adds a rule: the successor of a module that matches the pattern. A string with the word return
          is the body of a Lua function; others are modules such as "F[+F]F(x / 2)".
          Its fields: burgeon api system:rule
      decompose(pattern: string, successor: ((this: T, ...any) -> ...Module) | string) -> System<T>
      decompose(pattern: string, options: { ... }, successor: ((this: T, ...any) -> ...Module) | string) -> System<T>
          Adds a decomposition rule, which applies repeatedly after the axiom and after each step.
          Its fields: burgeon api system:decompose
      interpret(pattern: string, draw: (this: T, ...any) -> ...any) -> System<T>
      interpret(pattern: string, options: { ... }, draw: (this: T, ...any) -> ...any) -> System<T>
          Adds an interpretation: the function that draws a module. It calls methods of `this`, and may
          return modules, which are interpreted in its place; the chain does not change. Interpretations
          of one module are chosen as rules are: by contexts in the chain, and with the options of a
          rule before the function, by guards and weights.
          Its fields: burgeon api system:interpret
      at_start(hook: (now: Now) -> ...any) -> System<T>
          Adds a hook: a function that runs before the axiom is decomposed and interpreted.
      before_step(hook: (now: Now) -> ...any) -> System<T>
          Adds a hook: a function that runs before the rules of each step. Hooks read the state of the
          derivation, assign variables, and call stop() and use_group(name). If it returns modules, they
          replace the chain.
      after_step(hook: (now: Now) -> ...any) -> System<T>
          Adds a hook: a function that runs after each step and its interpretation.
      at_end(hook: (now: Now) -> ...any) -> System<T>
          Adds a hook: a function that runs after the last step and its interpretation.
      ignore(...string) -> System<T>
          Sets modules that context matching ignores.
      consider(...string) -> System<T>
          Sets the only modules that context matching considers.
      subsystem(module: string, system: System<T>) -> System<T>
          Makes a module begin a sub-system: what follows it in its branch is rewritten by the rules of
          `system` in the same steps, and drawn by its interpretations. A parameter `scale` of the
          module scales lengths and widths.
      derive(steps: number?, group: string?) -> Derived
      derive(options: { ... }) -> Derived
          Applies the rules step by step; without a number of steps, until no rule applies, and it fails
          after 200,000 steps. With a group, the rules of this group and those without a group apply.
          Its fields: burgeon api system:derive

    Example
      -- All methods of a system, with context-sensitive rules.
      local Signal, Wait = module("Signal"), module("Wait")
      local row = lsystem({ object = turtle() })
      row:axiom(Signal(), Turn(5), Wait(), Turn(5), Wait())
      row:ignore("Turn")
      row:rule("Signal < Wait", function()
        return Signal()
      end)
      row:interpret("Signal", function(this)
        this:forward(1)
      end)
      row:derive(2)
    "#);
    assert_snapshot!(api(&["source"]), @r#"
    source(what: string | { any }, options: { ... }?) -> Layer
      Loads the features of a data file, or of a list; see `layer`.

    Fields
      where: string?
          An SQL condition on attributes.
      tags: { [string]: any }?
          OpenStreetMap tags: true for any value except no, "*" for any value, false for a missing tag,
          a string, or a list of strings. All tags must match; of a list of such tables, one must match.
      within: { number }?
          West, south, east and north of a box that features touch, in the coordinates of the file.
      limit: number?
          Maximum number of features.
      id: string?
          Name of the id attribute.
      kind: string?
          Only features with a "point", a "line" or a "polygon".
      crs: number?
          The EPSG code of the coordinates, instead of the file's.
      layer: string?
          The layer, if its name does not follow a colon.
      table: string?
          Name of the table in query, instead of the layer's name.

    Example
      -- A house for each feature of a list; a file source is source("town.gpkg:buildings").
      local houses = source({
        { id = "inn", geometry = polygon({ 0, 0 }, { 10, 0 }, { 10, 8 }, { 0, 8 }), height = 6 },
        { id = "barn", geometry = polygon({ 14, 0 }, { 30, 0 }, { 30, 8 }, { 14, 8 }), height = 4 },
      })
      local House = module("House", "height")
      local village = lsystem({ object = footprint })
      village:axiom(houses, function(feature)
        return footprint(feature.geometry), House(feature.height)
      end)
      village:interpret("House(height)", function(this, height)
        this:walls({ height = height })
      end)
      village:derive()
    "#);
}

#[test]
fn a_field_or_a_method_is_told_by_itself() {
    assert_snapshot!(api(&["extruder:bend"]), @r##"
    extruder:bend(angle: number, toward: number? = 0)
      Bends each following segment by `angle` (degrees), towards the side at `toward` (degrees, 0 unless
      given), where 0 is left.
      Write method: only interpretations can call it.

    Example
      -- Bends of 90 degrees: toward 0 is grey, 90 orange, 180 green, 270 purple. The extruder faces up, and its own up is along x.
      local Part = module("Part")
      local parts = lsystem({ object = extruder({ sides = 8 }) })
      parts:axiom(Part())
      parts:interpret("Part", function(this)
        for number, color in { "#8a9aa8", "orange", "#7fa650", "#b0568a" } do
          local toward = 90 * (number - 1)
          this:color(color):jump({ 0, 0, 0 }):direction({ 0, 0, 1 }, { -1, 0, 0 }):scale(0.12)
          this:bend(0):extrude(1):bend(90, toward):extrude(1.6)
        end
      end)
      parts:derive()
    "##);
    assert_snapshot!(api(&["footprint:area"]), @r#"
    footprint:area() -> number
      Returns the area (m²) without the holes.
      Read method: rules and interpretations can call it.

    Example
      -- The shape measures of a footprint, and the height of its ground.
      local plan = footprint({ { 0, 0 }, { 10, 0 }, { 10, 8 }, { 0, 8 } }, { height = 6 })
      print(plan:area(), plan:perimeter(), plan:convexity(), plan:height())
      print(plan:lowest(), plan:highest())
    "#);
    assert_snapshot!(api(&["extruder.heading"]), @r"
    extruder.heading: Vector = vec(0, 0, 1)
      Initial direction of extrusion.
    ");
    assert_snapshot!(api(&["terrain.water"]), @r##"
    terrain.water: number | { level: number?, color: Color?, shallow: Color?, clarity: number? }?
      Standing water: its level (m), or a table of fields.

    Fields of its table
      level: number = 0
          Height (m) of the surface.
      color: Color = "#163c4d"
          Colour of deep water.
      shallow: Color = "#4b7373"
          Colour at the shore.
      clarity: number = 8
          Visibility depth (m).
    "##);
    assert_snapshot!(api(&["footprint:roof.details.every"]), @r"
    footprint:roof.details.every: number?
      Distance between models along the line (m). If omitted, one model is placed in the middle.
    ");
    assert_snapshot!(api(&["lerp"]), @r#"
    lerp(a: number, b: number, t: number) -> number
    lerp(a: Vector, b: Vector, t: number) -> Vector
      Interpolates linearly from `a` (`t` = 0) to `b` (`t` = 1): numbers or vectors.

    Example
      -- Halfway between two numbers, and between two vectors.
      print(lerp(2, 6, 0.5))
      print(lerp(vec(0, 0, 0), vec(4, 2, 0), 0.5))
    "#);
    assert_snapshot!(api(&["F"]), @r"
    F(length: number? = turtle.step) -> Module
      Moves forward by `length` (m, turtle.step unless given) and draws a branch. Within a polygon, only
      moves. Interpreted as a call of turtle:forward.

    Example
      -- A line, a gap, and another line.
      local line = lsystem({ object = turtle({ step = 2 }) })
      line:axiom(F(), G(0.5), F(1))
      line:derive()
    ");
}

#[test]
fn a_name_that_there_is_not_is_likely_another() {
    let failed = |name: &str| Folder::new().burgeon(&["api", name]).failed();
    assert_snapshot!(failed("extuder"), @r"
    error: unknown name `extuder`
      help: did you mean extruder?
    ");
    assert_snapshot!(failed("extruder:extrud"), @r"
    error: unknown field or method `extrud` of extruder
      help: did you mean extrude?
    ");
    assert_snapshot!(failed("extruder:window"), @r"
    error: unknown field or method `window` of extruder
      help: it has advance, along, around, bend, caps, color, direction, distance, extrude, heading, jump, material, mesh, metallic, open_edges, pitch, place, polygon, position, rectangle, regular, resolution, roll, roughness, scale, shape, shift, sides, smooth, star, taper, turn, twist
    ");
    assert_snapshot!(failed("footprint:roof.detail"), @r"
    error: unknown field or method `detail` of footprint:roof
      help: did you mean details?
    ");
    assert_snapshot!(failed("roof"), @r"
    error: unknown name `roof`
      help: there is footprint:roof, shape:roof
    ");
    assert_snapshot!(failed("window"), @r"
    error: unknown name `window`
      help: run burgeon api to list all names
    ");
}

#[test]
fn all_names_are_listed() {
    let text = api(&[]);
    for name in ["extruder", "lsystem", "lerp", "F", "feature", "math"] {
        assert!(text.lines().any(|line| line.starts_with(&format!("  {name} "))), "{name}: {text}");
    }
    assert!(text.lines().all(|line| line.trim_end() == line), "{text}");
}

#[test]
fn machines_get_the_same_as_people() {
    let said = Folder::new().burgeon(&["api", "extruder", "--json"]).done().json();
    let extruder = &said["entries"][0];
    assert_eq!(extruder["what"], "type");
    let fields = extruder["fields"].as_array().unwrap();
    let position = fields.iter().find(|field| field["name"] == "position").unwrap();
    assert_eq!((&position["unit"], &position["default"]), (&"m".into(), &"vec(0, 0, 0)".into()));
    let methods = extruder["methods"].as_array().unwrap();
    let bend = methods.iter().find(|method| method["name"] == "bend").unwrap();
    assert_eq!(bend["changes"], true);
    assert_eq!(bend["arguments"][0]["unit"], "degrees");
    assert_eq!(
        (&bend["arguments"][0]["default"], &bend["arguments"][1]["default"]),
        (&"".into(), &"0".into())
    );
    assert!(bend["example"].as_str().unwrap().contains("this:bend(0)"));
    let all = Folder::new().burgeon(&["api", "--json"]).done().json();
    assert!(all["entries"].as_array().unwrap().len() > 80);
    let said = Folder::new().burgeon(&["api", "extuder", "--json"]);
    assert_eq!((said.status, &said.json()["errors"][0]["help"]), (1, &"did you mean extruder?".into()));
}

#[test]
fn what_the_language_gives_is_told_with_its_arguments() {
    let said = Folder::new().burgeon(&["api", "system:rule", "--json"]).done().json();
    let forms = said["entries"][0]["forms"].as_array().unwrap();
    assert_eq!(forms.len(), 2);
    assert_eq!(
        forms[1]["arguments"][0],
        serde_json::json!({
            "name": "pattern", "type": "string", "unit": null, "default": "",
        })
    );
    assert_eq!(said["entries"][0]["fields"][0]["name"], "weight");
    let said = Folder::new().burgeon(&["api", "hsv", "--json"]).done().json();
    assert_eq!(said["entries"][0]["forms"][0]["arguments"][0]["unit"], "degrees");
    assert_snapshot!(api(&["math.clamp"]), @r"
    math.clamp(x: number, low: number, high: number) -> number
      Limits a number to a range.
    ");
}

#[test]
fn editors_are_given_definitions() {
    let text = api(&["--luau"]);
    for part in [
        "declare class Extruder extends Object",
        "  function extrude(self, length: number): Extruder",
        "declare function extruder(options: ExtruderOptions?): Extruder",
        "export type System<T> = {",
        "declare function module(name: string, ...: string): ((...any) -> Module)",
        "declare class Vector extends Object",
        "declare function F(length: number?): Module",
    ] {
        assert!(text.contains(part), "{part}");
    }
}

#[test]
fn every_example_runs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = vec![root.join("crates/objects/scripts"), root.join("crates/language/scripts")];
    let mut count = 0;
    // The files that the scripts refer to are next to them.
    let beside = Folder::new()
        .with("window.lua", "local W = module(\"W\") local s = lsystem({ object = extruder }) s:axiom(W()) s:interpret(\"W\", function(this) this:extrude(1) end) s:derive()");
    beside.burgeon(&["run", "window.lua", "-o", "window.glb"]).done();
    let window = std::fs::read(beside.path().join("window.glb")).unwrap();
    let ground = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n0 1\n1 2\n";
    while let Some(folder) = folders.pop() {
        for file in std::fs::read_dir(folder).unwrap() {
            let path = file.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let script = std::fs::read_to_string(&path).unwrap();
            let folder = Folder::new().with("example.lua", script).with("window.glb", &window);
            let folder = folder.with("ground.asc", ground).with("towers.lua", "return { height = 24 }");
            let said = folder.burgeon(&["run", "example.lua", "--strict"]);
            assert_eq!(said.status, 0, "{}: {}", path.display(), said.stderr);
            count += 1;
        }
    }
    assert!(count >= 130, "{count}");
}
