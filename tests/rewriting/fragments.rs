//! Fragment modules, which are replaced by the parts of a geometry, and queries about loaded sources.

use burgeon::script::RunOptions;
use burgeon::{Error, Run};

use super::scripts::{all_chains, divided};

/// Layer of a square with a hole, a bent line, a point, and a triangle next to the square.
const PLAN: &str = r#"{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:25832"}},"features":[
{"type":"Feature","id":1,"properties":{"name":"square","floors":3},"geometry":{"type":"Polygon","coordinates":[
  [[500000,5000000],[500020,5000000],[500020,5000020],[500000,5000020],[500000,5000000]],
  [[500005,5000005],[500005,5000010],[500010,5000010],[500005,5000005]]]}},
{"type":"Feature","id":2,"properties":{"name":"way"},"geometry":{"type":"LineString","coordinates":[[500000,5000030],[500010,5000030],[500010,5000040],[500010,5000050]]}},
{"type":"Feature","id":3,"properties":{"name":"well"},"geometry":{"type":"Point","coordinates":[500015,5000015]}},
{"type":"Feature","id":4,"properties":{"name":"triangle","floors":1},"geometry":{"type":"Polygon","coordinates":[[[500020,5000000],[500030,5000000],[500020,5000020],[500020,5000000]]]}}
]}"#;

const HEAD: &str = r#"
    local Shape, Ring, Wall = module("Shape", "geom", "name?"), module("Ring", "line", "name?"), module("Wall", "line", "name?")
    local Corner, Count, End = module("Corner", "place", "name?"), module("Count", "n"), module("End")
    local plan = source("plan.geojson")
    local s = lsystem({})
"#;

fn try_run(script: &str, options: RunOptions) -> burgeon::Result<Run> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("main.lua");
    std::fs::write(folder.path().join("plan.geojson"), PLAN).expect("a file");
    std::fs::write(&path, format!("{HEAD}{script}")).expect("a file");
    burgeon::run(&path, options)
}

/// Returns the chain of a script after [`HEAD`], without geometries.
fn chain(script: &str) -> String {
    match try_run(script, burgeon::options()) {
        Ok(run) => without_geometries(all_chains(&run).trim_end()).replace('"', ""),
        Err(error) => panic!("{error}\n{script}"),
    }
}

/// Returns a chain without the geometry parameter of its modules, up to its comma.
fn without_geometries(chain: &str) -> String {
    let mut text = String::new();
    let mut rest = chain;
    while let Some(at) =
        ["(POINT (", "(LINESTRING (", "(POLYGON ("].iter().filter_map(|kind| rest.find(kind)).min()
    {
        text.push_str(&rest[..=at]);
        let end = rest[at..].find(",\"").expect("a name follows");
        rest = &rest[at + end + 1..];
    }
    text + rest
}

fn refused(script: &str) -> Error {
    match try_run(script, burgeon::options()) {
        Err(error) => error,
        Ok(run) => panic!("this should fail, but it makes {}\n{script}", all_chains(&run)),
    }
}

#[test]
fn geometries_come_apart_level_by_level_with_their_parameters() {
    let times = |count: usize, module: &str| vec![module; count].join(" ");
    for (script, expected) in [
        (r#"query("select * from plan where id = '1'", Shape), fragment(Ring)"#, times(2, "Ring(square)")),
        (
            r#"query("select * from plan where id = '1'", Shape), fragment(Ring), fragment(Wall)"#,
            times(7, "Wall(square)"),
        ),
        (
            r#"query("select * from plan where id = '1'", Shape), fragment(Ring), fragment(Wall), fragment(Corner)"#,
            times(14, "Corner(square)"),
        ),
        // All rows of a query are split, each with its own attributes; modules next to them are unchanged.
        (
            r#"End(), query("select * from plan where id in ('2', '4')", Shape), fragment(Ring), End()"#,
            "End Ring(way) Ring(way) Ring(way) Ring(triangle) End".to_owned(),
        ),
        // In branches, with a branch in between, and after a query without rows.
        (
            r#"{ query("select * from plan where id = '4'", Shape), { End() }, fragment(Ring), fragment(Wall) }, End()"#,
            "[ Wall(triangle) Wall(triangle) Wall(triangle) [ End ] ] End".to_owned(),
        ),
        (r#"query("select * from plan where false", Shape), fragment(Ring), End()"#, "End".to_owned()),
        // A collection that the database has united.
        (
            r#"query("select ST_Collect(geom) as geom, 'all' as name from plan where id in ('1', '4')", Shape), fragment(Shape), fragment(Ring)"#,
            times(3, "Ring(all)"),
        ),
    ] {
        assert_eq!(chain(&format!("s:axiom({script}) s:derive()")), expected, "{script}");
    }
}

#[test]
fn a_module_of_a_rule_comes_apart_and_its_parts_are_rewritten_in_the_next_step() {
    let script = r#"
        s:axiom(query("select * from plan where id = '4'", Shape))
        s:rule("Shape(geom, name)", function(this, geom, name) return Ring(geom, name), fragment(Ring), fragment(Wall), End() end)
        s:rule("Wall(line, name) > Wall(other, _)", function(this, line, name, other) return Corner(line, name), fragment(Corner) end)
        s:derive(2)
        "#;
    assert_eq!(
        chain(script),
        "Corner(triangle) Corner(triangle) Corner(triangle) Corner(triangle) Wall(triangle) End"
    );
}

#[test]
fn geometries_are_values_of_questions() {
    for (script, expected) in [
        (
            r#"s:axiom(query("select * from plan where id = '3'", Shape))
               s:rule("Shape(geom, _)", function(this, geom)
                 return query("select name, geom from plan where id <> '3' and ST_Intersects(geom, $geom)", Ring)
               end) s:derive()"#,
            "Ring(square)",
        ),
        // Walls within 3 m of another building: the square and the triangle share one.
        (
            r#"s:axiom(query("select * from plan where floors > 0", Shape), fragment(Ring), fragment(Wall))
               s:rule("Wall(line, name)", { when = function(this, line, name)
                 return #query("select id from plan where name <> $name and floors > 0 and ST_DWithin(geom, $line, 0.1)") == 0
               end }, function(this, line, name) return End() end) s:derive()"#,
            "Wall(square) Wall(square) Wall(square) End End End End Wall(triangle) Wall(triangle) Wall(triangle)",
        ),
        (
            r#"local rows = query("select geom, name from plan where floors > $least", { least = 2 })
               s:axiom(Count(#rows), Shape(rows[1].geom, rows[1].name), fragment(Ring)) s:derive()"#,
            "Count(1) Ring(square) Ring(square)",
        ),
        (
            r#"local also = source("plan.geojson", { table = "houses", kind = "polygon" })
               s:axiom(Count(query("select count(*) as n from houses")[1].n), Count(#also), Count(#query("select 1 from plan"))) s:derive()"#,
            "Count(2) Count(2) Count(4)",
        ),
    ] {
        assert_eq!(chain(script), expected, "{script}");
    }
}

#[test]
fn parts_have_random_numbers_of_their_own_for_any_number_of_threads() {
    let script = r#"
        s:axiom(query("select * from plan where floors > 0 order by id", Shape), fragment(Ring), fragment(Wall))
        s:rule("Wall(line, _)", function(this, line) return Count(random()), Corner(line), fragment(Corner) end)
        s:rule("Corner", function() return Count(random()) end)
        s:derive()
        "#;
    let chains = |threads, batch| all_chains(&try_run(script, divided(threads, batch)).expect("it runs"));
    let first = chains(1, 4096);
    let mut modules: Vec<&str> = first.split_whitespace().collect();
    assert_eq!(modules.len(), 3 * 10, "{first}");
    modules.sort_unstable();
    modules.dedup();
    assert_eq!(modules.len(), 3 * 10, "{first}");
    for (threads, batch) in [(1, 3), (2, 1), (7, 2)] {
        assert_eq!(chains(threads, batch), first);
    }
    // Skipped features do not change the others.
    let fewer = script.replace("floors > 0", "floors > 1");
    let fewer = all_chains(&try_run(&fewer, burgeon::options()).expect("it runs"));
    assert!(first.starts_with(fewer.trim_end()), "{fewer}\n{first}");
}

#[test]
fn what_cannot_come_apart_or_be_asked_is_told_with_its_line() {
    for (script, message, help) in [
        (
            "s:axiom(fragment(Wall))\ns:derive()",
            "fragment needs a module to its left",
            "directly after the module",
        ),
        (
            "s:axiom(Count(1), fragment(Wall))\ns:derive()",
            "Count(1) to its left has no geometry to divide",
            "pass a geometry to the module to its left",
        ),
        (
            "s:axiom(query(\"select geom from plan where id = '4'\", Shape), fragment(Count))\ns:derive()",
            "",
            "",
        ),
        ("s:axiom(query(\"select * from plann\", Shape))\ns:derive()", "plann", "plan"),
        ("s:axiom(query(\"select * from plan wher id = 1\", Shape))\ns:derive()", "", ""),
        (
            "s:axiom(query(\"select id from plan\", Shape))\ns:derive()",
            "the rows have no column for parameter geom",
            "the columns are id",
        ),
        (
            "s:axiom(query(\"select null as geom\", Shape))\ns:derive()",
            "geom is NULL in row 1",
            "exclude such rows",
        ),
        ("s:axiom(Count(query(\"delete from plan\")[1].n))\ns:derive()", "", ""),
    ] {
        if message.is_empty() && !script.contains("wher ") && !script.contains("delete") {
            continue;
        }
        let error = refused(script);
        println!("{error}");
        assert!(error.message().contains(message), "{error}");
        assert!(error.remedy().unwrap_or_default().contains(help), "{error}");
        assert_eq!(error.place().map(|place| place.line), Some(6), "{error}");
    }
}

#[test]
fn a_point_has_no_parts_and_stays_which_is_told() {
    let run = try_run(
        "s:axiom(query(\"select * from plan where id = '3'\", Shape), fragment(Corner))\ns:derive()",
        burgeon::options(),
    );
    let run = run.expect("it runs");
    assert_eq!(without_geometries(&all_chains(&run)), "Corner(\"well\")\n");
    assert!(
        run.warnings[0].to_string().contains("a point has no parts, so it stays unchanged"),
        "{}",
        run.warnings[0]
    );
}

#[test]
fn a_list_that_the_script_made_is_a_table_like_a_file() {
    let script = r#"
        local lots = {}
        for n = 1, 3 do lots[n] = { n = n, name = `lot {n}`, geometry = polygon({ { n * 10, 0 }, { n * 10 + 10, 0 }, { n * 10 + 10, 10 }, { n * 10, 10 } }) } end
        source(lots, { table = "lots" })
        s:axiom(query("select a.n, a.name from lots a, lots b where b.n = 1 and a.n <> 1 and ST_Intersects(a.geom, b.geom)", Count))
        s:rule("Count(n)", function(this, n) return query("select geom, name from lots where n = $n", Ring), fragment(Wall) end)
        s:derive()
        "#;
    assert_eq!(chain(script), "Wall(lot 2)");
    let error = refused("source({ { id = 1 } }, { table = \"lots\" })");
    assert!(error.message().contains("feature 1 of the list has no geometry"), "{error}");
    let error = refused("source({}, { limit = 3 })");
    assert!(error.message().contains("a list of features takes no option but table"), "{error}");
}

#[test]
fn fewer_steps_show_what_the_queries_so_far_stand_for() {
    let script = r#"
        s:axiom(query("select * from plan where id = '4'", Shape))
        s:rule("Shape(geom, name)", function(this, geom, name) return Ring(geom, name), fragment(Ring), fragment(Wall) end)
        s:rule("Wall(line, name)", function(this, line, name) return Corner(line, name), fragment(Corner) end)
        s:derive()
        "#;
    for (steps, module, count) in
        [(0, "Shape(triangle)", 1), (1, "Wall(triangle)", 3), (2, "Corner(triangle)", 6)]
    {
        let options = RunOptions { steps: Some(steps), ..burgeon::options() };
        let run = try_run(script, options).expect("it runs");
        let text = without_geometries(all_chains(&run).trim_end()).replace('"', "");
        assert_eq!(text, vec![module; count].join(" "), "{steps} steps");
    }
}
