//! Cameras, and the list of the model's parts.

use serde_json::{Value, json};

use crate::support::{Page, Server, script};

#[track_caller]
fn ask(page: &mut Page, message: &Value) -> Value {
    page.say(message);
    page.any()
}

/// Returns the number of triangles in the ranges of an answer.
fn count(answer: &Value) -> u64 {
    let ranges = answer["ranges"].as_array().unwrap_or_else(|| panic!("{answer}"));
    ranges.iter().map(|range| range["count"].as_u64().unwrap()).sum()
}

#[test]
fn cameras_of_the_script_and_fitted_views_have_places() {
    let text = format!(
        "camera({{ name = \"street\", from = {{ 9, -7, 2 }}, to = {{ 0, 0, 1 }}, fov = 50 }})\n{}",
        script(3)
    );
    let server = Server::new(Some(&text));
    let mut page = server.page();
    let model = page.next("model");
    assert_eq!(
        model["cameras"],
        json!([{ "name": "street", "view": "perspective", "file": "s.lua", "line": 1 }])
    );
    let street = ask(&mut page, &json!({ "type": "camera", "id": 1, "name": "street", "aspect": 1.5 }));
    assert_eq!(
        (&street["eye"], &street["target"], &street["parallel"]),
        (&json!([9.0, -7.0, 2.0]), &json!([0.0, 0.0, 1.0]), &json!(false))
    );
    assert!((street["shown"].as_f64().unwrap() - 50.0).abs() < 1e-3, "{street}");
    let plan = ask(&mut page, &json!({ "type": "camera", "id": 2, "view": "plan", "aspect": 1.5 }));
    assert_eq!(plan["parallel"], true);
    assert!(plan["eye"][2].as_f64() > plan["target"][2].as_f64(), "{plan}");
    let eye = json!({ "type": "camera", "id": 3, "view": "eye", "azimuth": 90, "aspect": 1.5 });
    let eye = ask(&mut page, &eye);
    assert!(eye["eye"][0].as_f64() > eye["target"][0].as_f64(), "it stands in the east: {eye}");
    for wrong in [
        json!({ "type": "camera", "id": 4, "name": "stret", "aspect": 1 }),
        json!({ "type": "camera", "id": 4, "view": "bird", "aspect": 1 }),
        json!({ "type": "camera", "id": 4, "aspect": 1 }),
        json!({ "type": "camera", "id": 4, "view": "plan", "aspect": 0 }),
        json!({ "type": "camera", "id": 4, "view": "eye", "azimuth": "north", "aspect": 1 }),
    ] {
        assert_eq!(ask(&mut page, &wrong)["type"], "refused", "{wrong}");
    }
}

/// Script with a chain for each of three features.
const HOUSES: &str = r#"local House, Yard = module("House", "n"), module("Yard")
local houses = lsystem({ object = turtle() })
houses:axiom(source({ { id = "north" }, { id = "south gate" }, { id = "west" } }), function(feature)
  return turtle(), House(#feature.id), Yard()
end)
houses:interpret("House(n)", function(this, n) this:forward(n) end)
houses:interpret("Yard", function(this) this:forward(1) end)
houses:derive()
"#;

#[test]
fn chains_are_found_by_the_words_of_their_features() {
    let server = Server::new(Some(HOUSES));
    let mut page = server.page();
    page.next("model");
    let search =
        |page: &mut Page, words: &str| ask(page, &json!({ "type": "parts", "id": 1, "search": words }));
    let all = search(&mut page, "");
    assert_eq!((&all["matching"], all["parts"].as_array().unwrap().len()), (&json!(3), 3));
    let south = search(&mut page, "GATE sou");
    assert_eq!(south["parts"], json!([{ "system": 0, "chain": 1, "feature": "south gate" }]));
    assert_eq!(search(&mut page, "east")["matching"], 0);
}

#[test]
fn a_part_has_the_triangles_of_its_system_chain_or_symbol() {
    let server = Server::new(Some(HOUSES));
    let mut page = server.page();
    let whole = page.next("model")["triangles"].as_u64().unwrap();
    let part = |page: &mut Page, chain: Value, symbol: Value| {
        ask(page, &json!({ "type": "part", "id": 1, "system": 0, "chain": chain, "symbol": symbol }))
    };
    let none = Value::Null;
    assert_eq!(count(&part(&mut page, none.clone(), none.clone())), whole);
    let chains: Vec<u64> = (0..3).map(|chain| count(&part(&mut page, json!(chain), none.clone()))).collect();
    assert_eq!(chains.iter().sum::<u64>(), whole);
    let [house, yard] = ["House", "Yard"].map(|symbol| part(&mut page, none.clone(), json!(symbol)));
    assert_eq!((&house["modules"], &yard["modules"]), (&json!(3), &json!(3)));
    assert_eq!(count(&house) + count(&yard), whole);
    for (chain, symbol) in
        [(json!(3), none.clone()), (json!(0), json!("House")), (none.clone(), json!("Hous"))]
    {
        assert_eq!(part(&mut page, chain, symbol)["type"], "refused");
    }
    let far = ask(&mut page, &json!({ "type": "part", "id": 1, "system": 7 }));
    assert_eq!(far["type"], "refused");
}

#[test]
fn parts_and_cameras_of_an_empty_model_are_refused_or_empty() {
    let server = Server::new(Some("local one = 1\n"));
    let mut page = server.page();
    page.next("model");
    assert_eq!(ask(&mut page, &json!({ "type": "parts", "id": 1, "search": "" }))["matching"], 0);
    let plan = json!({ "type": "camera", "id": 1, "view": "plan", "aspect": 1 });
    assert_eq!(ask(&mut page, &plan)["type"], "refused");
}
