//! Reactions to changed files.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::support::{SLOW, Server, script, triangles};

#[test]
fn every_way_to_save_shows_the_new_model_and_one_that_changes_nothing_does_not() {
    let server = Server::new(Some(&script(3)));
    let mut page = server.page();
    page.next("model");
    let part = |name: &str| server.path(name);
    let shows = |page: &mut crate::support::Page, count: usize| {
        let model = page.next("model");
        assert_eq!(
            (&model["cause"], model["triangles"].as_u64()),
            (&json!("save"), Some(triangles(count) as u64))
        );
    };
    server.write("s.lua", script(4));
    shows(&mut page, 4);
    server.write("s.lua.tmp", script(5));
    fs::rename(part("s.lua.tmp"), part("s.lua")).unwrap();
    shows(&mut page, 5);
    fs::rename(part("s.lua"), part("s.lua~")).unwrap();
    server.write("s.lua", script(6));
    shows(&mut page, 6);
    fs::remove_file(part("s.lua")).unwrap();
    std::thread::sleep(Duration::from_millis(30));
    server.write("s.lua", script(7));
    shows(&mut page, 7);
    server.write("s.lua", "");
    std::thread::sleep(Duration::from_millis(30));
    server.write("s.lua", script(8));
    shows(&mut page, 8);
    server.write("s.lua", script(8));
    server.write("other.lua", "x");
    page.is_quiet(Duration::from_millis(300));
}

#[test]
fn an_error_leaves_the_model_and_the_repaired_script_shows_a_new_one() {
    let server = Server::new(Some("local = = 1"));
    let mut page = server.page();
    let error = page.next("error");
    assert_eq!((&error["errors"][0]["file"], &error["errors"][0]["line"]), (&json!("s.lua"), &json!(1)));
    assert!(error["text"].as_str().unwrap().starts_with("s.lua:1: "), "{error}");
    server.write("s.lua", script(3));
    let model = page.next("model");
    server.write("s.lua", script(3).replace("return S()", "return s()"));
    page.next("error");
    let mut second = server.page();
    assert_eq!(second.next("model")["url"], model["url"]);
    second.next("error");
    server.write("s.lua", [0xff, 0xfe, 0x00]);
    assert!(page.next("error")["text"].as_str().unwrap().contains("is not a text file"));
    server.write("s.lua", script(3));
    assert_eq!(page.next("model")["url"], model["url"]);
}

#[test]
fn a_script_that_is_missing_is_waited_for() {
    let server = Server::new(None);
    let mut page = server.page();
    assert!(page.next("waiting")["text"].as_str().unwrap().contains("s.lua"));
    server.write("s.lua", script(3));
    page.next("model");
    fs::remove_file(server.path("s.lua")).unwrap();
    page.next("waiting");
    fs::create_dir(server.path("s.lua")).unwrap();
    assert!(page.next("error")["text"].as_str().unwrap().contains("folder"));
    fs::remove_dir(server.path("s.lua")).unwrap();
    page.next("waiting");
    server.write("s.lua", script(4));
    page.next("model");
}

#[test]
fn required_files_textures_and_the_standard_library_are_watched_even_where_they_are_missing() {
    let library = include_str!("../../stdlib.lua");
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("std.lua"), library).unwrap();
    let text = format!(
        "local parts = require(\"sub/parts\")\n{}",
        script(3).replace("this:forward(length)", "this:material(parts.stone):forward(length)")
    );
    fs::write(folder.path().join("s.lua"), text).unwrap();
    let server = Server::start(folder, &["--stdlib", "std.lua"]);
    let mut page = server.page();
    assert!(page.next("error")["text"].as_str().unwrap().contains("sub/parts.lua"));
    fs::create_dir(server.path("sub")).unwrap();
    server.write("sub/parts.lua", "return { stone = { texture = \"wall.png\", texture_size = { 1, 1 } } }");
    assert!(page.next("error")["text"].as_str().unwrap().contains("wall.png"));
    image::RgbImage::new(2, 2).save(server.path("wall.png")).unwrap();
    let model = page.next("model");
    assert_eq!(model["files"], json!(["s.lua", "std.lua", "sub/parts.lua", "wall.png"]));
    image::RgbImage::from_pixel(2, 2, image::Rgb([9, 9, 9])).save(server.path("wall.png")).unwrap();
    let other = page.next("model");
    assert_ne!(other["url"], model["url"]);
    server.write("std.lua", format!("{library}\nnonsense nonsense"));
    let error = page.next("error");
    assert!(error["text"].as_str().unwrap().starts_with("std.lua:"), "{error}");
    server.write("std.lua", "return 7");
    assert!(page.next("error")["text"].as_str().unwrap().contains("std.lua does not return a table"));
    server.write("std.lua", library);
    assert_eq!(page.next("model")["url"], other["url"]);
    fs::remove_dir_all(server.path("sub")).unwrap();
    page.next("error");
    fs::create_dir(server.path("sub")).unwrap();
    server.write("sub/parts.lua", "return { stone = {} }");
    page.next("model");
}

#[test]
fn a_save_during_a_long_run_stops_it_and_so_does_a_page() {
    let server = Server::new(Some(SLOW));
    let mut page = server.page();
    let run = page.until("progress")["run"].clone();
    let begin = Instant::now();
    server.write("s.lua", script(3));
    assert_eq!(page.next("cancelled")["run"], run);
    page.next("model");
    assert!(begin.elapsed() < Duration::from_secs(2), "{:?}", begin.elapsed());
    server.write("s.lua", SLOW);
    page.until("progress");
    page.say(&json!({ "type": "cancel" }));
    assert_eq!(page.until("cancelled")["stale"], true);
    // A cancelled run is repeated only after a change.
    page.is_quiet(Duration::from_millis(100));
    let mut late = server.page();
    late.next("model");
    assert_eq!(late.next("cancelled")["stale"], true);
    server.write("s.lua", script(4));
    assert_eq!(page.next("model")["triangles"], triangles(4));
}

#[cfg(unix)]
#[test]
fn a_script_behind_a_link_and_a_folder_that_is_made_again_are_followed() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("real")).unwrap();
    fs::write(folder.path().join("real/tree.lua"), script(3)).unwrap();
    std::os::unix::fs::symlink("real/tree.lua", folder.path().join("s.lua")).unwrap();
    let server = Server::start(folder, &[]);
    let mut page = server.page();
    page.next("model");
    server.write("real/tree.lua", script(4));
    assert_eq!(page.next("model")["triangles"], triangles(4));
    fs::remove_dir_all(server.path("real")).unwrap();
    page.next("waiting");
    fs::create_dir(server.path("real")).unwrap();
    server.write("real/tree.lua", script(5));
    assert_eq!(page.next("model")["triangles"], triangles(5));
    server.write("real/tree.lua", script(6));
    assert_eq!(page.next("model")["triangles"], triangles(6));
}

#[test]
fn data_and_models_are_followed_even_where_they_are_missing() {
    let folder = tempfile::tempdir().unwrap();
    let town = |width: f64| {
        let ring = json!([[0.0, 0.0], [width, 0.0], [width, 1e-4], [0.0, 1e-4], [0.0, 0.0]]);
        let geometry = json!({ "type": "Polygon", "coordinates": [ring] });
        json!({ "type": "FeatureCollection", "features": [
            { "type": "Feature", "id": "a", "properties": {}, "geometry": geometry }
        ] })
        .to_string()
    };
    // Builds a model from a separate script.
    let model = |count: usize, to: &Path| {
        let other = tempfile::tempdir().unwrap();
        fs::write(other.path().join("s.lua"), script(count)).unwrap();
        let run = burgeon::run(&other.path().join("s.lua"), burgeon::options()).unwrap();
        burgeon::export::write(&run.scene, to, &burgeon::picture::Picture::default()).unwrap();
    };
    let text = r#"
local post = model("post.glb")
local Plot = module("Plot")
local plots = lsystem({ object = footprint })
plots:axiom(source("town.geojson"), function(feature)
  return footprint(feature.geometry), Plot()
end)
plots:interpret("Plot", function(this)
  this:walls({ height = 3 }):roof({ kind = "gable", details = { { model = post, on = "ridge" } } })
end)
plots:derive()
"#;
    fs::write(folder.path().join("s.lua"), text).unwrap();
    let server = Server::start(folder, &[]);
    let mut page = server.page();
    assert!(page.next("error")["text"].as_str().unwrap().contains("post.glb"));
    model(3, &server.path("post.glb"));
    assert!(page.next("error")["text"].as_str().unwrap().contains("town.geojson"));
    server.write("town.geojson", town(1e-4));
    let first = page.next("model");
    server.write("town.geojson", town(2e-4));
    let wider = page.next("model");
    assert_ne!(wider["url"], first["url"]);
    model(6, &server.path("post.glb"));
    let taller = page.next("model");
    assert_ne!(taller["url"], wider["url"]);
    server.write("town.geojson", "{");
    assert!(page.next("error")["text"].as_str().unwrap().contains("town.geojson"));
    server.write("town.geojson", town(2e-4));
    assert_eq!(page.next("model")["url"], taller["url"]);
}

#[test]
fn files_beside_data_are_followed_even_where_they_are_missing() {
    let folder = tempfile::tempdir().unwrap();
    let grid = "ncols 2\nnrows 2\nxllcorner 385000\nyllcorner 6672000\ncellsize 2\n20 20\n20 20\n";
    fs::write(folder.path().join("hills.asc"), grid).unwrap();
    let hills = "local hills = elevation(\"hills.asc\")\nlocal low, high = hills:low(), hills:high()\n\
                 local count = math.round(hills:height({ (low.x + high.x) / 2, (low.y + high.y) / 2 }))\n";
    let text = format!("{hills}{}", script(0).replace("s:axiom(A(0))", "s:axiom(A(count))"));
    fs::write(folder.path().join("s.lua"), text).unwrap();
    let server = Server::start(folder, &[]);
    let mut page = server.page();
    assert!(page.next("error")["text"].as_str().unwrap().contains("has no coordinate system"));
    let metres = "PROJCS[\"a\",AUTHORITY[\"EPSG\",\"3067\"]]";
    server.write("hills.PRJ", metres);
    assert_eq!(page.next("model")["triangles"], triangles(20));
    fs::remove_file(server.path("hills.PRJ")).unwrap();
    assert!(page.next("error")["text"].as_str().unwrap().contains("has no coordinate system"));
    server.write("hills.prj", metres);
    assert_eq!(page.next("model")["triangles"], triangles(20));
    server.write("hills.prj", format!("COMPD_CS[\"a\",{metres},VERT_CS[\"b\",UNIT[\"foot\",0.3048]]]"));
    assert_eq!(page.next("model")["triangles"], triangles(6));
}

/// Writes a file in place, in two parts with a pause between. Returns whether the second part came in time: a machine
/// that is busy may make the pause so long that what is there has to be believed.
fn write_slowly(server: &Server, name: &str, text: &str, closed: bool) -> bool {
    let (first, rest) = text.split_at(text.len() / 2);
    let begin = Instant::now();
    let mut file = fs::File::create(server.path(name)).unwrap();
    file.write_all(first.as_bytes()).unwrap();
    if closed {
        drop(file);
        std::thread::sleep(Duration::from_millis(60));
        file = fs::File::options().append(true).open(server.path(name)).unwrap();
    } else {
        std::thread::sleep(Duration::from_millis(250));
    }
    file.write_all(rest.as_bytes()).unwrap();
    drop(file);
    begin.elapsed() < Duration::from_millis(if closed { 100 } else { 700 })
}

#[test]
fn a_file_that_is_seen_half_written_is_read_again_before_anyone_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let text = |count: usize| format!("require(\"parts\")\n{}", script(count));
    let parts = |number: usize| format!("return {{ {} }}\n", "1, ".repeat(number));
    fs::write(folder.path().join("parts.lua"), parts(1)).unwrap();
    fs::write(folder.path().join("s.lua"), text(3)).unwrap();
    let server = Server::start(folder, &[]);
    let mut page = server.page();
    page.next("model");
    let presets =
        |number: usize| format!("{:#}\n", json!({ format!("preset {number}"): { "seed": number } }));
    // Returns all messages up to one that satisfies `wanted`.
    let until = |page: &mut crate::support::Page, wanted: &dyn Fn(&Value) -> bool| {
        let mut told = Vec::new();
        while told.last().is_none_or(|last| !wanted(last)) {
            told.push(page.any());
        }
        told
    };
    let (mut checked, mut length) = ([0; 2], 3);
    // Only some systems report whether a file is still open between its parts.
    for closed in [true, !cfg!(target_os = "linux")].repeat(10) {
        if checked[usize::from(closed)] >= 9 {
            continue;
        }
        length += 1;
        let mut check = |in_time: bool, told: Vec<Value>, kinds: &[&str]| {
            let unwanted = told.iter().find(|it| kinds.iter().any(|kind| it["type"] == **kind));
            assert!(!in_time || unwanted.is_none(), "{told:?}");
            checked[usize::from(closed)] += usize::from(in_time);
        };
        let in_time = write_slowly(&server, "s.lua", &text(length), closed);
        let told = until(&mut page, &|it| it["triangles"] == triangles(length));
        check(in_time, told, &["error", "refused"]);
        let in_time = write_slowly(&server, "parts.lua", &parts(length), closed);
        let told = until(&mut page, &|it| it["type"] == "model" && it["cause"] == "save");
        check(in_time, told, &["error", "refused"]);
        while page.within(Duration::from_millis(300)).is_some() {}
        let in_time = write_slowly(&server, "s.presets.json", &presets(length), closed);
        let told = until(&mut page, &|it| it["names"] == json!([format!("preset {length}")]));
        check(in_time, told, &["error", "refused"]);
    }
    assert!(checked.iter().all(|count| *count > 0), "{checked:?}");
}

#[test]
fn a_long_message_is_cut_and_an_error_shows_its_lines() {
    let server = Server::new(Some("local A = module(\"A\")\n\nerror(string.rep(\"x\", 2e7))\n-- the end\n"));
    let mut page = server.page();
    let error = page.next("error");
    assert!(error.to_string().len() < 100_000, "{}", error.to_string().len());
    let lines = json!([
        { "line": 1, "text": "local A = module(\"A\")" },
        { "line": 2, "text": "" },
        { "line": 3, "text": "error(string.rep(\"x\", 2e7))" },
        { "line": 4, "text": "-- the end" },
    ]);
    assert_eq!((&error["errors"][0]["line"], &error["errors"][0]["excerpt"]), (&json!(3), &lines));
    let wrong = "x.y = 1\n".repeat(500);
    server.write("s.lua", format!("--!strict\n{wrong}"));
    let error = page.next("error");
    let (told, number) = (error["errors"].as_array().unwrap().len(), error["number"].as_u64().unwrap());
    assert!(told as u64 <= number && told <= 50, "{told} of {number}");
}

#[test]
fn a_model_of_nothing_says_why() {
    let server = Server::new(Some("local s = 1\n"));
    let mut page = server.page();
    let says = |page: &mut crate::support::Page, text: &str| {
        let model = page.until("model");
        let nothing = model["nothing"].as_str().unwrap_or_default();
        assert!(nothing.contains(text), "{text}: {nothing}");
    };
    says(&mut page, "derives no system");
    let empty = |rest: &str| {
        format!(
            "local A, B = module(\"A\"), module(\"B\")\nlocal s = lsystem({{ object = turtle() }})\ns:axiom(A())\n{rest}s:derive()\n"
        )
    };
    server.write("s.lua", empty("s:rule(\"A\", function() return nil end)\n"));
    says(&mut page, "the chain is empty");
    server.write("s.lua", empty("s:rule(\"A\", function() return B(), B() end)\n"));
    says(&mut page, "system:interpret(\"B\"");
    // An interpreted module gets no advice to add an interpretation.
    server
        .write("s.lua", empty("s:interpret(\"A\", function(this) if false then this:forward(1) end end)\n"));
    says(&mut page, "its interpretations draw nothing");
    server.write("s.lua", script(3));
    assert_eq!(page.until("model")["nothing"], json!(null));
    page.say(&json!({ "type": "steps", "steps": 0 }));
    says(&mut page, "after 0 steps");
}

#[test]
fn a_type_of_object_in_a_file_of_its_own_is_changed_while_the_page_looks_on() {
    let post = |segments: usize, more: &str| {
        format!(
            "return object(\"post\", {{ extends = extruder, state = {{ n = 0 }}, changes = {{ raise = function(self)\n\
             for _ = 1, {segments} do self:extrude(1):roll(5) end\n\
             self.n += 1 {more}\nend }} }})\n"
        )
    };
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("post.lua"), post(1, "")).unwrap();
    let text = "local post = require(\"post\")\nlocal A = module(\"A\")\n\
                local s = lsystem({ object = post({ sides = 4 }) })\ns:axiom(A())\n\
                s:interpret(\"A\", function(this) this:raise() end)\ns:derive(0)\n";
    fs::write(folder.path().join("s.lua"), text).unwrap();
    let server = Server::start(folder, &[]);
    let mut page = server.page();
    let first = page.next("model");
    server.write("post.lua", post(3, ""));
    let mut second = page.next("model");
    // A file that was written just before the first run is read again, and gives the same model.
    if second["url"] == first["url"] {
        second = page.next("model");
    }
    assert!(second["triangles"].as_u64() > first["triangles"].as_u64(), "{first} {second}");
    server.write("post.lua", post(3, "self.m = 3"));
    let error = page.next("error");
    assert_eq!((&error["errors"][0]["file"], &error["errors"][0]["line"]), (&json!("post.lua"), &json!(3)));
    assert!(error["text"].as_str().unwrap().contains("post: unknown state variable `m`"), "{error}");
    let mut late = server.page();
    assert_eq!(late.next("model")["url"], second["url"]);
    fs::remove_file(server.path("post.lua")).unwrap();
    assert!(page.next("error")["text"].as_str().unwrap().contains("post.lua"));
    server.write("post.lua", post(3, ""));
    assert_eq!(page.next("model")["url"], second["url"]);
}

#[test]
fn files_of_packages_are_followed_and_one_that_goes_leaves_the_last_model_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    let about = "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n";
    write("given/castle/mod.toml", about);
    write("given/castle/size.lua", "return 3");
    write(
        "s.lua",
        "local size = require(\"@castle/size\")\nlocal A = module(\"A\")\n\
         local s = lsystem({ object = extruder({ sides = 4, smooth = false }) })\ns:axiom(A())\n\
         s:interpret(\"A\", function(this) for _ = 1, size do this:extrude(1):advance(1) end end)\ns:derive()\n",
    );
    let server = Server::start(folder, &["--mods", "given"]);
    let mut page = server.page();
    let first = page.next("model");
    server.write("given/castle/size.lua", "return 5");
    let model = page.next("model");
    assert!(model["triangles"].as_u64() > first["triangles"].as_u64());
    fs::remove_file(server.path("given/castle/size.lua")).unwrap();
    let error = page.next("error");
    assert!(error["text"].as_str().unwrap().contains("the package castle has no file size.lua"), "{error}");
    // A new page gets the last good model, and the error of the newer one.
    let mut second = server.page();
    assert_eq!(second.next("model")["url"], model["url"]);
    second.next("error");
    server.write("given/castle/size.lua", "return 4");
    page.next("model");
    server.write("given/castle/mod.toml", about.replace("castle", "Castle"));
    let error = page.next("error");
    assert!(error["text"].as_str().unwrap().contains("invalid package name"), "{error}");
    server.write("given/castle/mod.toml", about);
    page.next("model");
}

#[test]
fn a_package_that_is_missing_is_waited_for() {
    let server = Server::new(Some(&script(3).replacen("local", "require(\"@castle/size\")\nlocal", 1)));
    let mut page = server.page();
    let error = page.next("error");
    assert!(error["text"].as_str().unwrap().contains("unknown package `castle`"), "{error}");
    let staged = server.path("mods.new/castle");
    fs::create_dir_all(&staged).unwrap();
    fs::write(staged.join("mod.toml"), "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"\n").unwrap();
    fs::write(staged.join("size.lua"), "return 3").unwrap();
    fs::rename(server.path("mods.new"), server.path("mods")).unwrap();
    page.next("model");
}

#[test]
fn what_is_told_names_files_from_the_scripts_folder_on_and_how_long_a_model_has_been_stale() {
    let server = Server::new(Some(&script(3)));
    let mut page = server.page();
    page.next("model");
    server.write("none.png", "junk");
    let texture = "this:material({ texture = \"none.png\", texture_size = { 1, 1 } }):forward(length)";
    server.write("s.lua", script(3).replace("this:forward(length)", texture));
    let error = page.next("error");
    let folder = server.path("").canonicalize().unwrap();
    for text in [&error["text"], &error["errors"][0]["message"]] {
        let text = text.as_str().unwrap();
        assert!(text.contains("none.png") && !text.contains(&*folder.to_string_lossy()), "{text}");
    }
    std::thread::sleep(Duration::from_millis(200));
    assert!(server.hello()["stale"].as_f64().unwrap() >= 0.2);
    server.write("s.lua", script(4));
    page.next("model");
    assert_eq!(server.hello()["stale"], json!(null));
}
