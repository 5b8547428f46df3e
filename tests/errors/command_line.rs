//! Commands and their flags.

use burgeon::export::heights::HEIGHT_FORMATS;
use burgeon::export::{FORMATS, extension_list};
use insta::assert_snapshot;

use crate::support::{Folder, HEAD, assert_decent};

const SCRIPT: &str = r#"s:rule("A(x)", function(this, x) return A(x + random()), A(x) end)
s:interpret("A(x)", function(this, x) this:forward(x):turn(30) end)
s:derive(3)
"#;

fn folder() -> Folder {
    Folder::new().with("s.lua", format!("{HEAD}{SCRIPT}"))
}

/// Replaces the lists of all formats, so that snapshots stay when a table of formats grows.
fn without_formats(text: &str) -> String {
    let lists = [
        (extension_list(&FORMATS, "or"), extension_list(&FORMATS, "and"), "FORMATS"),
        (extension_list(&HEIGHT_FORMATS, "or"), extension_list(&HEIGHT_FORMATS, "and"), "HEIGHT FORMATS"),
    ];
    lists.iter().fold(text.to_owned(), |text, (one, all, name)| text.replace(one, name).replace(all, name))
}

/// Returns the error message for a wrong command line.
fn wrong(arguments: &[&str]) -> String {
    let folder = folder();
    let before = folder.files();
    let said = folder.burgeon(arguments);
    assert_eq!((said.status, said.stdout.as_str()), (2, ""), "{}", said.stderr);
    assert_decent(&said.stderr);
    assert_eq!(folder.files(), before);
    let machine = folder.burgeon(&[arguments, &["--json"]].concat());
    assert_eq!((machine.status, machine.stderr.as_str()), (2, ""));
    assert_eq!(machine.json()["ok"], false);
    said.stderr
}

#[test]
fn run_writes_every_format_and_the_chain() {
    let folder = folder();
    let said = folder
        .burgeon(&[
            "run",
            "s.lua",
            "-o",
            "a.glb",
            "-o",
            "a.gltf",
            "-o",
            "a.obj",
            "-o",
            "a.svg",
            "-o",
            "a.png",
            "-o",
            "a.x3d",
            "-o",
            "a.city.json",
            "--size",
            "64x48",
            "--chain",
            "a.txt",
        ])
        .done();
    assert_eq!(said.stdout, "");
    assert!(said.stderr.starts_with("8 modules in 1 chain, 3 steps\n"), "{}", said.stderr);
    let files: Vec<String> = folder.files().into_keys().collect();
    assert_eq!(
        files,
        [
            "a.bin",
            "a.city.json",
            "a.glb",
            "a.gltf",
            "a.mtl",
            "a.obj",
            "a.png",
            "a.svg",
            "a.txt",
            "a.x3d",
            "s.lua"
        ]
    );
    assert_eq!(folder.read("a.txt").matches("A(").count(), 8);
    let before = folder.files();
    folder.burgeon(&["run", "s.lua", "-o", "a.glb", "--chain", "a.txt"]).done();
    assert_eq!(folder.files(), before);
}

#[test]
fn the_chain_goes_to_standard_output_alone() {
    let said = folder().burgeon(&["run", "s.lua", "--chain", "-"]).done();
    assert_eq!(said.stdout.lines().count(), 1);
    assert!(said.stdout.ends_with(" A(1)\n") && said.stderr.starts_with("8 modules"), "{}", said.stdout);
}

#[test]
fn json_is_one_document_with_the_chain_in_it_where_asked() {
    let document = folder().burgeon(&["run", "s.lua", "--json", "--chain", "-", "-o", "a.glb"]).done();
    assert_eq!(document.stderr, "");
    let document = document.json();
    assert_eq!(
        (&document["ok"], &document["modules"], &document["chains"]),
        (&true.into(), &8.into(), &1.into())
    );
    assert_eq!(document["steps"].to_string(), "[3]");
    assert!(
        document["triangles"].as_u64().unwrap() > 0 && document["seconds"]["total"].as_f64().unwrap() > 0.0
    );
    assert_eq!(document["chain"].as_array().unwrap().len(), 1);
}

#[test]
fn json_tells_a_failure_as_the_text_does() {
    for rules in [
        "local x = = 3",
        "print(flors, B)\nn = 1",
        "s:rule(\"A((x)\", function() end)\ns:rule(\"C\", function() end)",
        "s:rule(\"A(x)\", function(this, x) return x end)",
        "s:rule(\"A(x)\", function(this, x) error(\"two\\nlines\") end)",
        "s:interpret(\"A(x)\", function(this, x) this:forward(0 / 0) end)",
        "local t = turtle({ wdth = 3 })",
        "s:derive(-1)",
        "error({})",
    ] {
        Folder::new().with("s.lua", format!("{HEAD}{rules}\ns:derive(1)\n")).refuses(&["run", "s.lua"]);
    }
    let folder =
        Folder::new().with("s.lua", format!("{HEAD}s:rule(\"A(x)\", function() return 3 end) s:derive(1)"));
    let error = &folder.burgeon(&["run", "s.lua", "--json"]).json()["errors"][0];
    let parts = ["file", "line", "rule", "module", "step"].map(|name| error[name].to_string());
    assert_eq!(parts, ["\"s.lua\"", "3", "\"A(x)\"", "\"A(1)\"", "1"]);
}

#[test]
fn steps_are_at_most_as_many_as_asked() {
    let modules = |steps: &str| {
        folder().burgeon(&["run", "s.lua", "--json", "--steps", steps]).done().json()["modules"].as_u64()
    };
    assert_eq!([modules("0"), modules("2"), modules("9")], [Some(1), Some(4), Some(8)]);
}

#[test]
fn the_seed_decides_and_threads_do_not() {
    let text =
        |flags: &[&str]| folder().burgeon(&[&["run", "s.lua", "--chain", "-"], flags].concat()).done().stdout;
    let plain = text(&[]);
    assert_eq!(text(&["--seed", "0"]), plain);
    assert_ne!(text(&["--seed", "1"]), plain);
    for threads in ["1", "2", "7"] {
        assert_eq!(text(&["--threads", threads, "--batch", "2"]), plain);
    }
}

#[test]
fn a_check_finds_what_only_a_run_meets_and_a_quick_one_derives_nothing() {
    let folder = Folder::new().with(
        "s.lua",
        format!("local n = param(\"n\", {{ default = 3, unit = \"m\", doc = \"how far\" }})\n{HEAD}s:rule(\"A(x)\", function(this, x) error(\"ran\") end)\ns:derive(n)\n"),
    );
    assert_eq!(folder.refuses(&["check", "s.lua"]), folder.refuses(&["run", "s.lua"]));
    let said = folder.burgeon(&["check", "s.lua", "--quick"]).done();
    assert_snapshot!(said.stderr, @r"
    s.lua: no problems
      n = 3 m  how far
    ");
    let document = folder.burgeon(&["check", "s.lua", "--quick", "--json", "--set", "n=4"]).done().json();
    assert_eq!(
        document.to_string(),
        r#"{"ok":true,"params":[{"name":"n","package":null,"value":4.0,"default":3.0,"group":"","unit":"m","text":"how far","type":"number"}],"warnings":[]}"#
    );
    assert_eq!(folder.files().len(), 1);
}

#[test]
fn new_makes_a_script_that_runs_and_never_overwrites_one() {
    let folder = Folder::new();
    let said = folder.burgeon(&["new", "tree"]).done();
    assert_eq!(
        said.stderr,
        "created tree.lua\nto see it: burgeon live tree.lua\nto write it: burgeon run tree.lua -o tree.glb\n"
    );
    folder.burgeon(&["check", "tree.lua"]).done();
    folder.burgeon(&["run", "tree.lua", "-o", "model.glb"]).done();
    assert!(folder.files()["model.glb"] > 10_000);
    assert_snapshot!(folder.refuses(&["new", "tree"]), @r"
    error: tree.lua already exists
      help: choose another name or folder
    ");
    assert_snapshot!(folder.refuses(&["new", "tree.lua"]), @r"
    error: tree.lua already exists
      help: choose another name or folder
    ");
    assert_snapshot!(folder.refuses(&["new", "no/tree"]), @r"
    error: cannot create no/tree.lua: folder not found: no
      help: create the folder first
    ");
    let said = folder.burgeon(&["new", "--json", "bush.lua"]).done();
    assert_eq!(said.stdout, "{\"ok\":true,\"path\":\"bush.lua\",\"files\":[\"bush.lua\"]}\n");
}

#[test]
fn every_starting_point_is_a_script_that_runs_without_a_warning() {
    let folder = Folder::new();
    for from in ["plant", "building", "tower", "terrain", "town", "empty"] {
        let said = folder.burgeon(&["new", "--from", from, from]).done();
        assert!(said.stderr.contains(&format!("\nto see it: burgeon live {from}.lua\n")), "{}", said.stderr);
        folder.burgeon(&["run", &format!("{from}.lua"), "--strict", "-o", "model.glb"]).done();
    }
    let said = folder.burgeon(&["new", "second", "--from", "town"]).done();
    assert!(said.stderr.starts_with("created second.lua\n"), "the data is there: {}", said.stderr);
    let wrong = folder.burgeon(&["new", "third", "--from", "castle"]);
    assert_eq!(wrong.status, 2);
    assert!(wrong.stderr.contains("[possible values: plant, building,"), "{}", wrong.stderr);
}

#[test]
fn a_starting_point_never_overwrites_data_and_its_name_is_quoted() {
    let folder = Folder::new().with("town.geojson", "mine");
    assert_snapshot!(folder.refuses(&["new", "--from", "town", "village"]), @r"
    error: town.geojson already exists
      help: choose another name or folder
    ");
    assert_eq!(folder.read("town.geojson"), "mine");
    let said = folder.burgeon(&["new", "my tree's"]).done();
    assert!(said.stderr.contains("\nto see it: burgeon live 'my tree'\\''s.lua'\n"), "{}", said.stderr);
}

#[test]
fn examples_are_written_into_a_new_folder_and_run_there() {
    let folder = Folder::new();
    let said = folder.burgeon(&["examples", "all"]).done();
    assert!(said.stderr.ends_with("; now: burgeon live all/examples/course/01_box.lua\n"), "{}", said.stderr);
    let count = folder.files().len();
    assert!(count > 250, "{count} files");
    assert!(said.stderr.starts_with(&format!("wrote {count} files to all")), "{}", said.stderr);
    let box_script = include_str!("../../examples/course/01_box.lua");
    assert_eq!(folder.read("all/examples/course/01_box.lua"), box_script);
    folder.burgeon(&["run", "all/examples/course/08_street.lua", "--strict", "-o", "street.glb"]).done();
    folder.burgeon(&["check", "all/scripts/town.lua", "--data", "all/examples/data"]).done();
    folder.burgeon(&["check", "all/examples/castle.lua"]).done();
    assert_snapshot!(folder.refuses(&["examples", "all"]), @r"
    error: all is not empty
      help: name a new folder: burgeon examples burgeon-examples
    ");
    assert_snapshot!(folder.refuses(&["examples", "street.glb"]), @r"
    error: street.glb is not a folder
      help: name a new folder: burgeon examples burgeon-examples
    ");
    let paths = folder.burgeon(&["examples", "more", "--json"]).done().json();
    assert_eq!(paths["files"].as_array().unwrap().len(), count);
}

#[test]
fn completions_are_scripts_for_the_shell() {
    for shell in ["bash", "zsh", "fish"] {
        let said = Folder::new().burgeon(&["completions", shell]).done();
        assert_eq!(said.stderr, "");
        for word in ["completions", "memory-limit", "chain"] {
            assert!(said.stdout.contains(word), "{shell} lacks {word}");
        }
        let told = Folder::new().burgeon(&["completions", shell, "--json"]).done().json();
        assert_eq!((&told["ok"], told["script"].as_str()), (&true.into(), Some(said.stdout.as_str())));
    }
}

#[test]
fn a_wrong_command_line_is_status_2_and_says_what_is_right() {
    assert_snapshot!(wrong(&["run"]), @r"
    error: the following required arguments were not provided:
      <SCRIPT>

    Usage: burgeon run <SCRIPT>

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["rnu", "s.lua"]), @r"
    error: unrecognized subcommand 'rnu'

      tip: a similar subcommand exists: 'run'

    Usage: burgeon <COMMAND>

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["run", "s.lua", "--thread", "2"]), @r"
    error: unexpected argument '--thread' found

      tip: a similar argument exists: '--threads'

    Usage: burgeon run --threads <N> <SCRIPT>

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["run", "s.lua", "--threads", "0"]), @r"
    error: invalid value '0' for '--threads <N>': write an integer from 1 to 1024

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["run", "s.lua", "--steps", "-1"]), @r"
    error: invalid value '-1' for '--steps <N>': write an integer of at least 0

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["run", "s.lua", "--seed", "1.5"]), @r"
    error: invalid value '1.5' for '--seed <N>': write an integer of at least 0

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["run", "s.lua", "--set", "n"]), @r"
    error: invalid value 'n' for '--set <NAME=VALUE>': write NAME=VALUE

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["run", "s.lua", "--time-limit", "0"]), @r"
    error: invalid value '0' for '--time-limit <SECONDS>': write a number of seconds above 0

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["run", "s.lua", "--memory-limit", "1"]), @r"
    error: invalid value '1' for '--memory-limit <MEGABYTES>': write an integer number of megabytes of at least 16

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["run", "s.lua", "--size", "3"]), @r"
    error: invalid value '3' for '--size <WIDTHxHEIGHT>': write WIDTHxHEIGHT, such as 1280x960, each from 1 to 16384

    For more information, try '--help'.
    ");
    assert_snapshot!(without_formats(&wrong(&["run", "s.lua", "-o", "model.xyz"])), @r"
    error: invalid value 'model.xyz' for '--output <FILE>': cannot write model.xyz: unknown file extension .xyz
      help: supported formats are FORMATS

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["run", "s.lua", "-o", "model.gtlf"]), @r"
    error: invalid value 'model.gtlf' for '--output <FILE>': cannot write model.gtlf: unknown file extension .gtlf
      help: did you mean .gltf?

    For more information, try '--help'.
    ");
    assert_snapshot!(without_formats(&wrong(&["run", "s.lua", "-o", "model"])), @r"
    error: invalid value 'model' for '--output <FILE>': cannot write model: missing file extension
      help: supported formats are FORMATS

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["run", "s.lua", "--heights", "a.tof"]), @r"
    error: invalid value 'a.tof' for '--heights <FILE>': cannot write a.tof: unknown file extension .tof
      help: did you mean .tif?

    For more information, try '--help'.
    ");
    assert_snapshot!(without_formats(&wrong(&["run", "s.lua", "--heights", "a.glb"])), @r"
    error: invalid value 'a.glb' for '--heights <FILE>': cannot write a.glb: unknown file extension .glb
      help: supported formats are HEIGHT FORMATS

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["completions", "tcsh"]), @r"
    error: invalid value 'tcsh' for '<SHELL>'
      [possible values: bash, elvish, fish, powershell, zsh]

      tip: a similar value exists: 'zsh'

    For more information, try '--help'.
    ");
}

#[test]
fn the_long_help_lists_the_formats_with_their_titles() {
    let help = Folder::new().burgeon(&["run", "--help"]).done().stdout;
    let models = FORMATS.iter().map(|format| &format.file);
    for format in models.chain(HEIGHT_FORMATS.iter().map(|format| &format.file)) {
        let line = format!("  {:<11} {}\n", format!(".{}", format.extension()), format.title);
        assert!(help.contains(&line), "{line}{help}");
    }
}

#[test]
fn help_reads_well() {
    assert_snapshot!(Folder::new().burgeon(&["--help"]).done().stdout, @r"
    Procedural modelling by rewriting: rules in Lua, geometry in Rust.

    Usage: burgeon <COMMAND>

    Commands:
      run          Runs a script and writes its model
      live         Shows the model of a script in the browser, and updates it on every save; also shows a folder of tiles
      check        Checks a script and its required files as far as a run goes, and reports all problems
      api          Shows the scripting API: types of objects with their fields and methods, functions and modules
      variations   Runs a script many times, with other seeds or other values of a parameter, and shows them side by side
      fit          Searches for a rule table whose terrain is like a height map
      mods         Lists the packages that scripts can use, and what they replace; checks, explains, makes, adds and disables them
      new          Creates a starter script
      open         Shows a model live again: writes the script of its recipe to a new folder, and says what is missing
      examples     Writes the example scripts into a folder: the course, the cookbook, the gallery, the published models, and their data
      setup        Writes into a folder what Visual Studio Code with luau-lsp needs to complete and check scripts, with the types of objects that they declare
      sources      Lists the layers of data files and databases, with their attributes, coordinate systems and extents
      tiles        Makes 3D Tiles of the features of a country, with any number of processes
      completions  Prints a script that completes the command line in a shell
      man          Prints the manual page of the program, or of a command
      help         Print this message or the help of the given subcommand(s)

    Options:
      -h, --help     Print help
      -V, --version  Print version

    Getting started:
      burgeon new tree
      burgeon live tree.lua
      burgeon run tree.lua -o tree.glb

    burgeon tree.lua runs a script and shows its model; burgeon COMMAND --help has examples.
    ");
    assert_snapshot!(without_formats(&Folder::new().burgeon(&["run", "-h"]).done().stdout), @r"
    Runs a script and writes its model

    Usage: burgeon run [OPTIONS] <SCRIPT>

    Arguments:
      <SCRIPT>  Script, a Lua file; - is standard input

    Options:
          --set <NAME=VALUE>      Sets a parameter of the script
          --preset <NAME>         Loads parameters and seed from a preset; --set and --seed override it
          --data <FOLDER>         Allows the script to read data files in this folder and its subfolders; may be repeated
          --database <ADDRESS>    Allows the script to query this database, postgres://USER:PASSWORD@HOST/NAME; may be repeated
          --mods <FOLDER>         Adds a folder of packages, or one package; may be repeated
          --strict                Treats warnings as errors, and stops at the first unusable feature
          --seed <N>              Seed of all random numbers [default: 0]
          --steps <N>             Derives at most N steps
          --part <K/N>            Builds one of several parts of the features, such as 2/4
          --reach <METRES>        Distance (m) within which features of other parts are derived too, but not written [default: 0]
          --lod <N>               Level of detail: 0 footprints, 1 blocks, 2 roofs, 3 full detail [default: 3]
          --threads <N>           Number of threads; does not affect the result [default: number of cores]
          --stdlib <FILE>         Replaces the built-in standard library by this file
          --json                  Prints machine-readable JSON instead of text
      -o, --output <FILE>         Writes the model to this file; the extension selects the format: FORMATS. May be repeated
          --format <EXTENSION>    Format of the model on standard output, -o -
          --metadata[=<NAMES>]    Includes ids and attributes of features in .glb, .gltf and .html files: the attributes that the script names, or =NAMES, or all with ='*'
          --instances <KIND>      Storage of repeated models in .glb and .gltf files [default: nodes up to 1000 instances, else extension] [possible values: nodes, extension, expanded]
          --no-recipe             Leaves the recipe out of models: the script, its values, and the hashes of its packages and data
          --compress              Compresses the arrays of .glb files, for viewers with EXT_meshopt_compression
          --quantize              Writes the arrays of .glb and .gltf files as integers, for programs with KHR_mesh_quantization
          --chain <FILE>          Writes the final chains as text, one per line; - is standard output, or the JSON document with --json
          --heights <FILE>        Writes the heights of the terrain as a height map: HEIGHT FORMATS
          --edits <FILE>          Writes the terrain edits, for edits(FILE) in a script
          --tiles <FOLDER>        Writes a .glb file for each tile of the terrain to this folder
          --report <FILE>         Writes a JSON report of skipped and simplified features; - is standard output
          --parts <N>             Writes the model in N parts, one after another: FILE-1 to FILE-N. Memory is that of one part
          --watch                 Runs and writes again on every save, until interrupted
          --places                Prints file and line before each text that the script prints; of a film, also the frame
          --levels <LODS>         Writes several levels of detail, from the finest on, such as 3,2,1
          --level-storage <KIND>  Storage of the levels [default: names] [possible values: names, extension, files]
          --save-preset <NAME>    Saves the seed and the given values as a preset, if the run succeeds
      -h, --help                  Print help (see more with '--help')

    Limits:
          --time-limit <SECONDS>      Stops after this time [default: 300]
          --memory-limit <MEGABYTES>  Memory limit of a run [default: 4096]
          --module-limit <N>          Maximum number of modules of a system's chains [default: 50000000]
          --triangle-limit <N>        Maximum number of triangles of a system [default: 50000000]
          --frame-limit <N>           Maximum number of frames of a film [default: 10000]

    Films:
          --frames <[NAME=]FIRST:LAST:STEP>
              Writes a film, one run for each value of the parameter time, or of NAME, to a .gif, .apng or .glb file, or to a file for each frame by a pattern such as frames/%04d.png; steps is the number of steps
          --turntable <N>
              Writes a film of N frames in which the camera goes once around the model
          --fps <N>
              Frames per second of a film [default: 25]

    Pictures:
          --size <WIDTHxHEIGHT>
              Width and height of a render (pixels); 800x600 for films [default: 1280x960]
          --azimuth <DEGREES>
              Azimuth of the camera: 0 is north, 90 east (degrees) [default: from the model]
          --elevation <DEGREES>
              Elevation of the camera above the horizon (degrees) [default: from the model]
          --look <X,Y,Z,M>
              Frames the sphere with this centre and radius (m) [default: the whole model]
          --camera <NAME>
              Camera of the script, or plan, from above, or eye, at the height of a person's eyes [default: the script's first]
          --from <X,Y,Z>
              Position of the camera (m)
          --to <X,Y,Z>
              Point in the middle of the render (m)
          --fov <DEGREES>
              Vertical field of view of the camera at --from (degrees) [default: 40]
          --orthographic[=<METRES>]
              Parallel projection of the camera at --from; =METRES is the height that the render shows [default: the whole model]
          --quality <QUALITY>
              Quality of the render; films have one of their own [default: draft] [possible values: draft, fine, best]
          --sun <AZIMUTH,ELEVATION|HH:MM[,LATITUDE]>
              Sun, by its azimuth and elevation (degrees), or by the solar time of a day in June and the latitude [default: behind the viewer's left shoulder]
          --haze <METRES>
              Haze that hides two thirds of what is this far away (m)
          --background <BACKGROUND>
              Background of the render [default: light] [possible values: light, dark, sky, clear]
          --no-floor
              Leaves out the ground and the shadow on it
    ");
    assert_snapshot!(Folder::new().burgeon(&["check", "-h"]).done().stdout, @r"
    Checks a script and its required files as far as a run goes, and reports all problems

    Usage: burgeon check [OPTIONS] <SCRIPT> [SCRIPTS]...

    Arguments:
      <SCRIPT>      Script, a Lua file; - is standard input
      [SCRIPTS]...  Further scripts to check

    Options:
          --quick               Loads the script and compiles every rule, without deriving anything
          --set <NAME=VALUE>    Sets a parameter of the script
          --preset <NAME>       Loads parameters and seed from a preset; --set and --seed override it
          --data <FOLDER>       Allows the script to read data files in this folder and its subfolders; may be repeated
          --database <ADDRESS>  Allows the script to query this database, postgres://USER:PASSWORD@HOST/NAME; may be repeated
          --mods <FOLDER>       Adds a folder of packages, or one package; may be repeated
          --strict              Treats warnings as errors, and stops at the first unusable feature
          --seed <N>            Seed of all random numbers [default: 0]
          --steps <N>           Derives at most N steps
          --part <K/N>          Builds one of several parts of the features, such as 2/4
          --reach <METRES>      Distance (m) within which features of other parts are derived too, but not written [default: 0]
          --lod <N>             Level of detail: 0 footprints, 1 blocks, 2 roofs, 3 full detail [default: 3]
          --threads <N>         Number of threads; does not affect the result [default: number of cores]
          --stdlib <FILE>       Replaces the built-in standard library by this file
          --json                Prints machine-readable JSON instead of text
      -h, --help                Print help (see more with '--help')

    Limits:
          --time-limit <SECONDS>      Stops after this time [default: 300]
          --memory-limit <MEGABYTES>  Memory limit of a run [default: 4096]
          --module-limit <N>          Maximum number of modules of a system's chains [default: 50000000]
          --triangle-limit <N>        Maximum number of triangles of a system [default: 50000000]
    ");
}

#[test]
fn a_program_without_a_command_says_how_it_is_used_and_which_version_it_is() {
    let said = Folder::new().burgeon(&[]);
    assert_eq!((said.status, said.stdout.as_str()), (2, ""));
    let version = Folder::new().burgeon(&["--version"]).done().stdout;
    assert_eq!(version, format!("burgeon {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let script = format!("{HEAD}s:axiom(table.create(200000, A(1)))\ns:derive(0)\n");
    let folder = Folder::new().with("s.lua", script);
    let binary = env!("CARGO_BIN_EXE_burgeon");
    let out = std::process::Command::new("sh")
        .args(["-c", &format!("'{binary}' run s.lua --chain - | head -c 5")])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert_eq!(out.stdout, b"[ A(1");
    assert!(!String::from_utf8_lossy(&out.stderr).contains("error"));
}

#[test]
fn no_message_shows_the_password_of_an_address() {
    let script = "local houses = lsystem { object = footprint }\nhouses:axiom(source \"ADDRESS\", function(f) return f end)\n";
    for address in [
        "postgres://me:s3cret@127.0.0.1:1/town",
        "postgres://me:s3cret@127.0.0.1:1/town:houses",
        "postgres://me:s3cret@127.0.0.1:x/town",
        "postgres://me:s3cret@127.0.0.1:1/town?sslmode=never",
        "postgre://me:s3cret@127.0.0.1:1/town",
    ] {
        let folder = Folder::new().with("s.lua", script.replace("ADDRESS", address));
        for arguments in [
            vec!["sources", address],
            vec!["run", "s.lua", "-o", "a.glb"],
            vec!["run", "s.lua", "-o", "a.glb", "--database", address],
            vec!["run", "s.lua", "-o", "a.glb", "--data", address],
            vec!["check", "s.lua", "--database", address],
        ] {
            for more in [&[][..], &["--json"]] {
                let said = folder.burgeon(&[&arguments, more].concat());
                let text = format!("{}{}", said.stdout, said.stderr);
                assert!(!text.contains("s3cret"), "{arguments:?}: {text}");
            }
        }
    }
}
