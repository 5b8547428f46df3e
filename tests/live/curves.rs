//! Drawn functions, curves and surfaces: outlines, saves, and changes of their file.

use std::time::Duration;

use serde_json::{Value, json};

use crate::support::Server;

const SCRIPT: &str = r#"local taper = param("taper", { default = ramp({ { 0, 1 }, { 1, 0.5 } }, { kind = "linear" }) })
local A = module("A")
local s = lsystem({ object = turtle() })
s:axiom(A())
s:interpret("A", function(this) this:width(taper:at(0)):forward(taper:at(1)) end)
s:derive()
"#;

fn set(points: &Value) -> Value {
    json!({ "type": "set", "params": { "taper": points.to_string() } })
}

#[test]
fn a_drawn_function_is_described_outlined_and_refused_with_its_point() {
    let server = Server::new(Some(SCRIPT));
    let mut page = server.page();
    let param = page.next("model")["params"][0].clone();
    let line = |a: [f64; 2], b: [f64; 2]| {
        let at = |t: f64| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, 0.0];
        [at(0.0), at(1.0 / 3.0), at(2.0 / 3.0), at(1.0)]
    };
    let near = |pieces: &Value, expected: &[[[f64; 3]; 4]]| {
        let pieces: Vec<[[f64; 3]; 4]> = serde_json::from_value(pieces.clone()).unwrap();
        let (found, wanted) = (pieces.iter().flatten().flatten(), expected.iter().flatten().flatten());
        assert_eq!(pieces.len(), expected.len());
        assert!(found.zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{pieces:?}");
    };
    let control = &param["control"];
    assert_eq!(
        (&control["type"], &control["space"], &control["kind"], &control["closed"]),
        (&json!("points"), &json!("function"), &json!("linear"), &json!(false))
    );
    near(&control["pieces"], &[line([0.0, 1.0], [1.0, 0.5])]);
    assert_eq!(param["value"], json!([[0, 1], [1, 0.5]]));
    page.say(&json!({ "type": "outline", "id": 4, "param": "taper", "points": [[0, 2], [2, 2], [4, 0]] }));
    let outline = page.next("outline");
    assert_eq!(outline["id"], 4);
    near(&outline["pieces"], &[line([0.0, 2.0], [2.0, 2.0]), line([2.0, 2.0], [4.0, 0.0])]);
    for (points, why) in [
        (json!([[0, 1], [0, 2]]), "the x of point 2 is 0"),
        (json!([[0, 1]]), "at least 2 points"),
        (json!([[0, 1], [1]]), "point 2 has 1 number, not 2"),
        (json!("x"), "not a list of points"),
    ] {
        page.say(&json!({ "type": "outline", "id": 5, "param": "taper", "points": points }));
        let refused = page.next("refused");
        assert_eq!(refused["id"], 5);
        assert!(refused["text"].as_str().unwrap().contains(why), "{refused}");
    }
}

#[test]
fn a_surface_is_described_with_its_net_and_keeps_the_number_of_points() {
    let script = r#"local row = function(y) return { vec(0, y, 0), vec(1, y, 0), vec(2, y, 0) } end
local leaf = param("leaf", { default = surface({ points = { row(0), row(2) }, kind = "b-spline", degree = 1 }) })
local A = module("A")
local s = lsystem({ object = turtle() })
s:axiom(A())
s:interpret("A", function(this) this:surface(leaf) end)
s:derive()
"#;
    let server = Server::new(Some(script));
    let mut page = server.page();
    let param = page.next("model")["params"][0].clone();
    let control = &param["control"];
    assert_eq!(
        (&control["space"], &control["kind"], &control["columns"]),
        (&json!("space"), &json!("b-spline"), &json!(3))
    );
    let mut points = json!([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 2, 0], [1, 2, 0], [2, 2, 0]]);
    assert_eq!(param["value"], points);
    // Lines of constant v at five places, each with two pieces, and lines of constant u at five places.
    assert_eq!(control["pieces"].as_array().unwrap().len(), 5 * 2 + 5);
    points[4][2] = json!(0.5);
    page.say(&json!({ "type": "outline", "id": 4, "param": "leaf", "points": points }));
    let outline = page.next("outline");
    let last = outline["pieces"].as_array().unwrap().iter().flat_map(|piece| piece.as_array().unwrap());
    assert!(last.into_iter().any(|point| *point == json!([1.0, 2.0, 0.5])), "{outline}");
    let command = json!({ "type": "set", "params": { "leaf": points.to_string() } });
    assert_eq!(page.model_of(command)["params"][0]["value"], points);
    page.say(&json!({ "type": "outline", "id": 5, "param": "leaf", "points": [[0, 0, 0], [1, 0, 0]] }));
    let refused = page.next("refused");
    let text = refused["text"].as_str().unwrap();
    assert!(text.contains("2 points do not make a surface of 2 rows of 3 points"), "{refused}");
}

#[test]
fn a_save_writes_the_file_and_the_value_of_the_script_removes_it() {
    let server = Server::new(Some(SCRIPT));
    let (mut page, mut other) = (server.page(), server.page());
    page.next("model");
    other.next("model");
    let drawn = json!([[0, 0.3], [0.5, 1.5], [1, 2]]);
    let param = &page.model_of(set(&drawn))["params"][0];
    assert_eq!((&param["value"], &param["changed"]), (&drawn, &json!(true)));
    page.say(&json!({ "type": "store", "id": 7, "param": "taper", "points": drawn }));
    let stored = page.next("stored");
    assert_eq!((&stored["id"], &stored["file"]), (&json!(7), &json!("s.curves.json")));
    let text = std::fs::read_to_string(server.path("s.curves.json")).unwrap();
    assert_eq!(text, "{\n  \"taper\": [\n    [0, 0.3],\n    [0.5, 1.5],\n    [1, 2]\n  ]\n}\n");
    let param = &page.until("model")["params"][0];
    assert_eq!((&param["value"], &param["default"], &param["changed"]), (&drawn, &drawn, &json!(false)));
    assert_eq!(param["script_default"], json!([[0, 1], [1, 0.5]]));
    // The server's own save is no change of a file.
    page.is_quiet(Duration::from_millis(600));
    let own = json!([[0, 1], [1, 0.5]]);
    page.model_of(set(&own));
    page.say(&json!({ "type": "store", "id": 8, "param": "taper", "points": own }));
    page.next("stored");
    assert!(!server.path("s.curves.json").exists());
    let param = &page.until("model")["params"][0];
    assert_eq!(
        (&param["value"], &param["script_default"], &param["changed"]),
        (&own, &Value::Null, &json!(false))
    );
    page.say(&json!({ "type": "store", "id": 9, "param": "taper", "points": [[0, 0], [0, 1]] }));
    assert_eq!(page.next("refused")["id"], 9);
    assert!(!server.path("s.curves.json").exists());
}

#[test]
fn a_change_of_the_file_makes_a_new_model_and_an_invalid_file_an_error_with_its_line() {
    let server = Server::new(Some(SCRIPT));
    let mut page = server.page();
    page.next("model");
    server.write("s.curves.json", "{ \"taper\": [[0, 2], [1, 3]] }");
    let model = page.until("model");
    assert_eq!((&model["cause"], &model["params"][0]["value"]), (&json!("save"), &json!([[0, 2], [1, 3]])));
    server.write("s.curves.json", "{\n  \"taper\": [[0, 2],\n [0, 3]] }");
    let error = &page.until("error")["errors"][0];
    assert_eq!((&error["file"], &error["line"]), (&json!("s.curves.json"), &json!(3)));
    server.write("s.curves.json", "{\n  \"taper\": [[0, 2], [1, 4]] }");
    assert_eq!(page.until("model")["params"][0]["value"], json!([[0, 2], [1, 4]]));
    std::fs::remove_file(server.path("s.curves.json")).unwrap();
    assert_eq!(page.until("model")["params"][0]["value"], json!([[0, 1], [1, 0.5]]));
}
