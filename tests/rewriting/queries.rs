//! Modules for the rows of a query, and queries of functions while rules run.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use burgeon::kit::QueryRows;
use burgeon::kit::Value;
use burgeon::script::{RowSource, RunOptions, SqlQuery};

use super::scripts::{all_chains, divided, lines, run_with, try_run};

/// Row source of these tests: `fid` and `n` of items, selected by the text after `where`.
#[derive(Default)]
struct Items {
    more: Option<f64>,
    asked: AtomicUsize,
}

impl RowSource for Items {
    fn rows(&self, question: &SqlQuery, _: usize) -> burgeon::Result<QueryRows> {
        self.asked.fetch_add(1, Ordering::Relaxed);
        let n = question.values()?.into_iter().find(|(name, _)| *name == "n").map(|(_, value)| value);
        let limit = match n {
            Some(Value::Number(n)) => n,
            Some(Value::Nil) | None => 0.0,
            Some(other) => panic!("{other}"),
        };
        let items = [1.0, 2.0, 3.0, 4.0].into_iter().chain(self.more);
        let (fields, condition) = question.sql().split_once(" where ").unwrap_or((question.sql(), ""));
        let kept = items.filter(|item| match condition {
            "" => true,
            "n < $n" => *item < limit,
            "n <> $n" => (*item - limit).abs() > 0.5,
            "false" => false,
            other => panic!("{other}"),
        });
        let fields: Vec<&str> = fields.split(", ").collect();
        let row = |item: f64| {
            let value = |field: &&str| match field.split(" as ").next().unwrap_or_default() {
                "fid" | "n" => Value::Number(item),
                "name" => Value::Text(format!("item {item}").into()),
                "odd" => Value::Boolean(item % 2.0 != 0.0),
                "half" if item % 2.0 == 0.0 => Value::Number(item / 2.0),
                "half" => Value::Nil,
                other => panic!("{other}"),
            };
            fields.iter().map(value).collect::<Vec<_>>()
        };
        let values: Vec<Value> = kept.flat_map(row).collect();
        let name = |field: &&str| Arc::from(field.rsplit(" as ").next().unwrap_or_default());
        Ok(QueryRows::new(fields.iter().map(name).collect::<Vec<_>>(), values))
    }
}

const HEAD: &str = r#"
    local A, B = module("A", "n"), module("B", "n")
    local Item, Named = module("Item", "n"), module("Named", "name", "odd", "half?")
    local s = lsystem({})
"#;

fn asking(rows: Arc<dyn RowSource>, mut options: RunOptions) -> RunOptions {
    options.inputs.rows = Some(rows);
    options
}

fn options() -> RunOptions {
    asking(Arc::new(Items::default()), burgeon::options())
}

/// Returns the chains of a script after [`HEAD`].
fn chains(script: &str) -> Vec<String> {
    lines(&run_with(&format!("{HEAD}{script}"), options()))
}

fn refused_with(script: &str, options: RunOptions) -> burgeon::Error {
    match try_run(&format!("{HEAD}{script}"), options) {
        Err(error) => error,
        Ok(run) => panic!("this should fail, but it makes {}\n{script}", all_chains(&run)),
    }
}

fn refused(script: &str) -> burgeon::Error {
    refused_with(script, options())
}

#[test]
fn a_query_in_a_successor_becomes_a_module_for_each_row_before_the_next_step() {
    for (script, expected) in [
        (
            r#"s:axiom(A(3)) s:rule("A(n)", function(this, n) return B(n), query("n where n < $n", Item) end) s:derive()"#,
            "B(3) Item(1) Item(2)",
        ),
        // A query in a branch, and two side by side.
        (
            r#"s:axiom(A(2)) s:rule("A(n)", function(this, n) return { query("n where n < $n", Item), B(0) }, B(n) end) s:derive()"#,
            "[ Item(1) B(0) ] B(2)",
        ),
        (
            r#"s:axiom(A(2)) s:rule("A(n)", function(this, n) return query("n where n < $n", Item), query("n where n <> $n", Item) end) s:derive()"#,
            "Item(1) Item(1) Item(3) Item(4)",
        ),
        // Without rows, the placeholder disappears.
        (
            r#"s:axiom(A(1)) s:rule("A(n)", function(this, n) return query("n where n < $n", Item), { query("n where false", Item) }, B(n) end) s:derive()"#,
            "[ ] B(1)",
        ),
        // A query in an axiom.
        (
            r#"s:axiom(B(0), { query("n where n < $n", Item, { n = 2 }) }, query("n", Item)) s:derive()"#,
            "B(0) [ Item(1) ] Item(1) Item(2) Item(3) Item(4)",
        ),
        // Rules see the resulting modules, and contexts match across the border.
        (
            r#"s:axiom(A(3)) s:rule("A(n)", function(this, n) return B(n), query("n where n < $n", Item) end)
            s:rule("B(m) < Item(n)", function(this, m, n) return Item(10 * m + n) end)
            s:rule("Item(a) < Item(n)", function(this, a, n) return Item(100 * a + n) end) s:derive(2)"#,
            "B(3) Item(31) Item(102)",
        ),
        // Placeholders of the last step are resolved too.
        (
            r#"s:axiom(A(3)) s:rule("A(n)", function(this, n) return query("n where n < $n", Item) end) s:derive(1)"#,
            "Item(1) Item(2)",
        ),
        (r#"s:axiom(query("n where n < $n", Item, { n = 3 })) s:derive(0)"#, "Item(1) Item(2)"),
        // Columns are assigned to parameters by name; NULL is nil, and unused columns are ignored.
        (
            r#"s:axiom(query("odd, half, n, name where n < $n", Named, { n = 3 })) s:derive()"#,
            r#"Named("item 1",true) Named("item 2",false,1)"#,
        ),
        // A query that makes modules with the same query.
        (
            r#"s:axiom(A(3)) s:rule("A(n)", function(this, n) return B(n), { query("n where n < $n", A) } end) s:derive()"#,
            "B(3) [ B(1) [ ] B(2) [ B(1) [ ] ] ]",
        ),
        // The successor as a string, and in a local variable before the return.
        (
            r#"s:axiom(A(3)) s:rule("A(n)", [[ return query("n where n < $n", Item), B(n) ]]) s:derive()"#,
            "Item(1) Item(2) B(3)",
        ),
        (
            r#"s:axiom(A(3)) s:rule("A(n)", function(this, n) local q = query("n where n < $n", Item) return B(1), q end) s:derive()"#,
            "B(1) Item(1) Item(2)",
        ),
    ] {
        assert_eq!(chains(script), [expected], "{script}");
    }
}

#[test]
fn values_come_from_the_call_the_pattern_and_the_names_of_the_modules_parameters() {
    for (script, expected) in [
        // The formal parameter has another name than the module's parameter: both work.
        (
            r#"s:axiom(A(2)) s:rule("A(x)", function(this, x) return query("n where n < $n", Item) end) s:derive()"#,
            "Item(1)",
        ),
        // Values in the call take precedence.
        (
            r#"s:axiom(A(2)) s:rule("A(n)", function(this, n) return query("n where n < $n", Item, { n = n + 2 }) end) s:derive()"#,
            "Item(1) Item(2) Item(3)",
        ),
        // A formal parameter of a context.
        (
            r#"s:axiom(B(3), A(1)) s:rule("B(n) < A(x)", function(this, n, x) return query("n where n < $n", Item) end) s:derive()"#,
            "B(3) Item(1) Item(2)",
        ),
        // Many modules at once, each with its own values.
        (
            r#"s:axiom(A(1), A(2), A(3)) s:rule("A(n)", function(this, n) return { query("n where n < $n", Item) } end) s:derive()"#,
            "[ ] [ Item(1) ] [ Item(1) Item(2) ]",
        ),
        // Queries in guards, with or without rows.
        (
            r#"s:axiom(A(1), A(2), A(3))
            s:rule("A(n)", { when = function(this, n) return #query("n where n < $n") == 1 end }, function(this, n) return B(n) end) s:derive()"#,
            "A(1) B(2) A(3)",
        ),
        // The rows in a successor.
        (
            r#"s:axiom(A(4)) s:rule("A(n)", function(this, n)
              local sum = 0
              for _, row in query("fid, n, half where n < $n") do sum += row.n + (row.half or 100) end
              return B(sum)
            end) s:derive()"#,
            "B(207)",
        ),
        // A query at the top level.
        (
            r#"local rows = query("n where n < $n", { n = 3 }) s:axiom(A(#rows), A(rows[2].n)) s:derive()"#,
            "A(2) A(2)",
        ),
    ] {
        assert_eq!(chains(script), [expected], "{script}");
    }
}

#[test]
fn interpretations_ask_with_the_parameters_of_their_module() {
    let script = r#"
        local s = lsystem({ object = turtle({ width = 0.1 }) })
        s:axiom(B(1), A(3), B(2), A(2))
        s:interpret("B(x)", function(this, x) this:forward(#query("n where n <> $n")) end)
        s:interpret("A(n)", function(this, n)
          for _, row in query("n where n < $n") do this:forward(row.n) end
          assert(#query("n where n < $n", { n = 5 }) == 4)
        end)
        s:derive()
        "#;
    let run = run_with(&format!("{HEAD}{script}"), options());
    let [instance] = run.scene.instances.as_slice() else { panic!("one mesh") };
    let top =
        run.scene.meshes[instance.mesh].parts[0].positions.iter().map(|point| point.z).fold(0.0, f32::max);
    assert!((top - (3.0 + 3.0 + 3.0 + 1.0)).abs() < 1e-4, "{top}");
}

const SOWN: &str = r#"
    s:axiom(A(0))
    s:rule("A(n)", function(this, n) return query("fid, n", B), Item(0), query("n", Item) end)
    s:rule("B(n)", function(this, n) return Named(`{n}`, true, random()) end)
    s:rule("Item(n)", function(this, n) return Named("item", true, random()) end)
    s:derive()
"#;

#[test]
fn one_more_row_changes_the_random_numbers_of_no_other() {
    let chain = |more: Option<f64>| {
        let rows = Arc::new(Items { more, ..Items::default() });
        let chains = lines(&run_with(&format!("{HEAD}{SOWN}"), asking(rows, burgeon::options())));
        chains[0].split(' ').map(str::to_owned).collect::<Vec<_>>()
    };
    let (before, after) = (chain(None), chain(Some(2.5)));
    assert_eq!((before.len(), after.len()), (9, 11));
    let mut distinct = before.clone();
    distinct.sort();
    distinct.dedup();
    assert_eq!(distinct.len(), 9, "{before:?}");
    assert!(before.iter().all(|module| after.contains(module)), "{before:?} {after:?}");
}

#[test]
fn threads_and_batches_change_nothing_and_the_same_question_is_asked_once() {
    let script = format!(
        r#"{HEAD}
        local modules = {{}}
        for n = 1, 600 do modules[n] = {{ A(n % 5) }} end
        s:axiom(B(0), table.unpack(modules))
        s:rule("A(n)", {{ when = function(this, n) return #query("n where n <> $n") == 3 end }}, function(this, n)
          return B(random()), query("fid, n where n < $n", A), {{ query("fid, n where n < $n", Item) }}
        end)
        s:rule("Item(n)", {{ weight = 1 }}, function(this, n) return Item(random()) end)
        s:rule("Item(n)", {{ weight = 1 }}, function(this, n) return nil end)
        s:derive(7)
        "#
    );
    let chains = |threads: usize, batch: usize| {
        let items = Arc::new(Items::default());
        let rows: Arc<dyn RowSource> = Arc::clone(&items) as _;
        let run = run_with(&script, asking(rows, divided(threads, batch)));
        (all_chains(&run), items.asked.load(Ordering::Relaxed))
    };
    let (first, asked) = chains(1, 4096);
    // The queries of the guard with 0 to 4, and of the successors with 1 to 4.
    assert_eq!(asked, 5 + 4);
    assert!(first.len() > 20_000, "{}", first.len());
    for (threads, batch) in [(1, 7), (2, 64), (7, 16)] {
        assert!(chains(threads, batch) == (first.clone(), asked), "{threads} threads, batches of {batch}");
    }
}

#[test]
fn what_is_wrong_is_told_with_the_line_and_the_remedy() {
    let rule = |body: &str| {
        format!("s:axiom(A(2)) s:rule(\"A(n)\", function(this, n)\n return {body} end) s:derive()")
    };
    for (script, message, help) in [
        (rule(r#"query("n where n < $m", Item)"#), "$m of the query has no value", "add it there"),
        (rule(r#"query("n where n < $n", Item, { m = 1 })"#), "the query has no $m", "it has $n"),
        (
            rule(r#"query("n where n < $n", Item, { n = 0 / 0 })"#),
            "$n of the query is not a number",
            "division by 0",
        ),
        (
            rule(r#"query("n where n < $n", Item, { n = {} })"#),
            "$n of the query cannot be a table",
            "geometries",
        ),
        (
            rule(r#"query("n where n < $n", Item(1))"#),
            "takes what makes modules, and not a module",
            "without brackets",
        ),
        (
            rule(r#"query("n where n < $n", "Item")"#),
            "takes what makes modules, and not the string",
            "local Building = module",
        ),
        (rule(r#"query(7, Item)"#), "takes a text of SQL, and not the number 7", "select * from"),
        (
            rule(r#"query("n", Named)"#),
            "the rows have no column for parameter name and odd of Named(name, odd, half?)",
            "the columns are n",
        ),
        (
            rule(r#"query("half", Item)"#),
            "the rows have no column for parameter n of Item(n)",
            "select ... as n",
        ),
        (rule(r#"query("select $1", Item)"#), "$1 in a query has no name", "$id"),
        (rule("fragment(Item)"), "fragment needs a module to its left on its branch", "directly after"),
        (
            rule("B(1), { fragment(Item) }"),
            "fragment needs a module to its left on its branch",
            "directly after",
        ),
        (
            rule("B(1), fragment(Item)"),
            "B(1) to its left has no geometry to divide",
            "pass a geometry to the module to its left",
        ),
    ] {
        let error = refused(&script);
        assert!(error.message().contains(message), "{error}");
        assert!(error.remedy().unwrap_or_default().contains(help), "{error}");
        assert_eq!(error.place().map(|place| place.line), Some(6), "{error}");
    }
    let guard = r#"s:axiom(A(1)) s:rule("A(n)", { when = function(this, n) return query("n", Item) end }, function() return nil end) s:derive()"#;
    assert!(refused(guard).to_string().contains("a guard makes no modules"));
    let null = refused(r#"s:axiom(query("half as n", Item)) s:derive()"#);
    assert_eq!(null.message(), "n is NULL in row 1, but Item requires it");
}

#[test]
fn a_chain_that_grows_without_end_by_queries_is_stopped() {
    let script = r#"s:axiom(A(9)) s:rule("A(n)", function(this, n) return query("fid, n where n <> $n", A) end) s:derive()"#;
    let mut options = options();
    options.limits.modules = 10_000;
    let error = refused_with(script, options);
    assert!(error.to_string().contains("the chain exceeds 10,000 modules"), "{error}");
    assert!(error.to_string().contains("query("), "{error}");
}

/// Returns the lineage of the first module that is drawn.
fn picked(script: &str) -> Vec<burgeon::results::Ancestor> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("main.lua");
    std::fs::write(&path, format!("{HEAD}{script}")).expect("a file");
    let run = burgeon::run(&path, options()).expect("it runs");
    let asked = burgeon::trace::Pick { instance: 0, part: 0, triangle: 0 };
    let picked = burgeon::trace::pick(&path, &options(), &run.scene, asked).expect("it is known");
    picked.drawn.expect("a module drew it").path
}

#[test]
fn a_picked_module_tells_the_question_its_values_and_the_number_of_rows() {
    let script = r#"
        local s = lsystem({ object = extruder({ sides = 6, smooth = false }) })
        s:axiom(A(3))
        s:rule("A(n)", function(this, n)
          return query("fid, n where n < $n", Item)
        end)
        s:rule("Item(n)", function(this, n) return B(n) end)
        s:interpret("B(n)", function(this, n) this:extrude(n) end)
        s:derive()
        "#;
    let path = picked(script);
    let told: Vec<_> = path
        .iter()
        .map(|ancestor| {
            let text = |rule: &Option<burgeon::results::RuleName>| {
                rule.as_ref()
                    .map(|rule| (rule.text.clone(), rule.place.as_ref().map_or(0, |place| place.line)))
            };
            (ancestor.step, ancestor.module.text.clone(), text(&ancestor.rule), text(&ancestor.answer))
        })
        .collect();
    let by = |rule: &str, line: usize| Some((rule.to_owned(), line));
    let item = path[1].module.text.clone();
    assert_eq!(
        told,
        [
            (0, "A(3)".to_owned(), None, None),
            (
                1,
                item.clone(),
                by("A(n)", 8),
                by("query(\"fid, n where n < $n\", Item) with $n = 3: 2 rows", 9)
            ),
            (2, item.replace("Item", "B"), by("Item(n)", 11), None),
        ]
    );
}

#[test]
fn a_picked_module_tells_what_guards_and_successors_asked() {
    let script = r#"
        local s = lsystem({ object = extruder({ sides = 6, smooth = false }) })
        s:axiom(A(3))
        s:rule("A(n)", { when = function(this, n) return #query("fid, n where n < $n") > 2 end }, function() return nil end)
        s:rule("A(n)", { when = function(this, n) return #query("fid, n where n < $n") == 2 end }, function(this, n)
          return B(#query("fid, n where n < $n", { n = 2 }))
        end)
        s:interpret("B(n)", function(this, n) this:extrude(n) end)
        s:derive()
        "#;
    let asked: Vec<_> =
        picked(script).into_iter().map(|ancestor| (ancestor.module.text, ancestor.asked)).collect();
    let questions = ["fid, n where n < $n with $n = 3: 2 rows", "fid, n where n < $n with $n = 2: 1 row"];
    assert_eq!(
        asked,
        [("A(3)".to_owned(), Vec::new()), ("B(1)".to_owned(), questions.map(str::to_owned).to_vec()),]
    );
}

#[test]
fn a_picked_module_tells_what_guards_asked_of_geometries() {
    let script = r#"
        local Tree = module("Tree", "at")
        local lawn = polygon({ { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 } })
        local s = lsystem({ object = extruder({ sides = 6, smooth = false }) })
        s:axiom(Tree(point(3, 2)))
        s:rule("Tree(at)", { when = function(this, at) return lawn:contains(at) and at:distance(point(0, 2)) > 2 end },
          function(this, at) return B(at:x()) end)
        s:interpret("B(n)", function(this, n) this:extrude(n) end)
        s:derive()
        "#;
    let asked: Vec<_> = picked(script).into_iter().map(|ancestor| ancestor.asked).collect();
    let answers = [
        "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0)):contains(POINT (3 2)): true",
        "POINT (3 2):distance(POINT (0 2)): 3",
    ];
    assert_eq!(asked, [Vec::new(), answers.map(str::to_owned).to_vec()]);
}
