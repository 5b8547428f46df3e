//! Requests of pages: parameters, seed and steps; and pending requests during saves.

use std::time::Duration;

use serde_json::{Value, json};

use crate::support::{Page, Server, script};

fn set(page: &mut Page, value: Value) -> Value {
    page.model_of(json!({ "type": "set", "params": { "length": value } }))
}

#[test]
fn values_are_set_shared_kept_across_saves_and_put_back() {
    let server = Server::new(Some(&script(3)));
    let (mut page, mut other) = (server.page(), server.page());
    let first = page.next("model");
    other.next("model");
    let control = json!({ "type": "number", "min": 1.0, "max": 9.0, "step": 1.0 });
    assert_eq!(first["params"][0]["control"], control);
    let model = set(&mut page, json!("5"));
    let param = &model["params"][0];
    assert_eq!(
        (&param["value"], &param["default"], &param["changed"]),
        (&json!(5.0), &json!(1.0), &json!(true))
    );
    assert_eq!((&model["cause"], &model["url"]), (&json!("parameters"), &other.next("model")["url"]));
    assert_ne!(model["url"], first["url"]);
    server.write("s.lua", script(4));
    assert_eq!(page.next("model")["params"][0]["value"], 5.0);
    server.write("s.lua", script(4).replace("default = 1", "default = 2"));
    let param = &page.next("model")["params"][0];
    assert_eq!(
        (&param["value"], &param["default"], &param["old_default"]),
        (&json!(5.0), &json!(2.0), &json!(1.0))
    );
    let param = &set(&mut page, Value::Null)["params"][0];
    assert_eq!(
        (&param["value"], &param["changed"], &param["old_default"]),
        (&json!(2.0), &json!(false), &Value::Null)
    );
    set(&mut page, json!("3"));
    assert_eq!(page.model_of(json!({ "type": "reset" }))["params"][0]["value"], 2.0);
    // A request without a change gets an answer, sent only to this page.
    assert_eq!(set(&mut page, Value::Null)["params"][0]["value"], 2.0);
    for _ in 0..5 {
        other.next("model");
    }
    other.is_quiet(Duration::from_millis(50));
}

/// Script that never ends if `count` is 6, and fails if it is 7.
const HEAVY: &str = r#"local count = param("count", { default = 3, min = 1, max = 9, step = 1 })
local tiny = param("tiny", { default = 1 })
local A, S = module("A", "n"), module("S")
local s = lsystem({ object = turtle() })
s:axiom(A(count))
s:rule("A(n)", function(this, n)
  if n == 7 then error("too many") end
  if n == 6 then return A(n) end
  if n > 0 then return S(), A(n - 1) end
  return nil
end)
s:interpret("S", function(this) this:forward(tiny) end)
s:derive()
"#;

#[test]
fn what_a_page_cancels_does_not_come_with_the_next_change() {
    let server = Server::new(Some(HEAVY));
    let mut page = server.page();
    let first = page.next("model");
    page.say(&json!({ "type": "seed", "seed": "5" }));
    page.next("model");
    page.say(&json!({ "type": "set", "params": { "count": 6 } }));
    page.until("progress");
    page.say(&json!({ "type": "cancel" }));
    let back = page.until("model");
    assert_eq!((&back["params"], &back["seed"]), (&first["params"], &json!("5")));
    assert_eq!(page.next("cancelled")["stale"], false);
    let mut late = server.page();
    assert_eq!(late.next("model")["params"], first["params"]);
    late.is_quiet(Duration::from_millis(50));
    let next = page.model_of(json!({ "type": "set", "params": { "tiny": 2 } }));
    assert_eq!((&next["params"][0], &next["params"][1]["value"]), (&first["params"][0], &json!(2.0)));
    // The script was saved meanwhile, so there is no older model to return to, but the values remain.
    server.write("s.lua", format!("{HEAVY}-- saved"));
    page.next("model");
    page.say(&json!({ "type": "set", "params": { "count": 6 } }));
    page.until("progress");
    server.write("s.lua", format!("{HEAVY}-- saved again"));
    page.until("cancelled");
    page.until("progress");
    page.say(&json!({ "type": "cancel" }));
    assert_eq!(page.until("model")["params"][0]["value"], 3.0);
    assert_eq!(page.next("cancelled")["stale"], true);
}

#[test]
fn an_error_tells_the_values_that_led_to_it_and_a_cancelled_change_of_them_leads_back_to_the_model() {
    let server = Server::new(Some(HEAVY));
    let mut page = server.page();
    page.next("model");
    page.say(&json!({ "type": "set", "params": { "count": 7 } }));
    let error = page.next("error");
    let count = &error["params"][0];
    assert_eq!((&count["value"], &count["changed"]), (&json!(7.0), &json!(true)), "{error}");
    let mut late = server.page();
    late.next("model");
    assert_eq!(late.next("error")["params"], error["params"]);
    page.say(&json!({ "type": "set", "params": { "count": 6 } }));
    page.until("progress");
    page.say(&json!({ "type": "cancel" }));
    assert_eq!(page.until("model")["params"][0]["value"], 3.0);
    assert_eq!(page.next("cancelled")["stale"], false);
    let mut late = server.page();
    late.next("model");
    late.is_quiet(Duration::from_millis(50));
}

#[test]
fn values_that_a_new_script_does_not_take_are_told_once_left_out_and_used_again_later() {
    let server = Server::with(Some(&script(3)), &["--set", "length=7"]);
    let mut page = server.page();
    assert_eq!(page.next("model")["params"][0]["value"], 7.0);
    server.write("s.lua", script(3).replace("max = 9", "max = 4"));
    let model = page.next("model");
    assert_eq!((&model["params"][0]["value"], &model["params"][0]["changed"]), (&json!(1.0), &json!(false)));
    assert!(page.next("note")["text"].as_str().unwrap().contains("length is 7"));
    server.write("s.lua", script(2).replace("max = 9", "max = 4"));
    page.next("model");
    server.write("s.lua", script(2).replace("\"length\"", "\"size\""));
    page.next("model");
    assert!(page.next("note")["text"].as_str().unwrap().contains("unknown parameter `length`"));
    server.write("s.lua", script(3));
    assert_eq!(page.next("model")["params"][0]["value"], 7.0);
}

#[test]
fn the_seed_and_the_steps_are_wished_and_the_last_step_is_known() {
    let server = Server::with(Some(&script(5)), &["--seed", "7"]);
    let mut page = server.page();
    let first = page.next("model");
    assert_eq!((&first["seed"], &first["steps"], &first["last_step"]), (&json!("7"), &json!(6), &json!(6)));
    let seeded = page.model_of(json!({ "type": "seed", "seed": "18446744073709551615" }));
    assert_eq!(seeded["seed"], "18446744073709551615");
    assert_ne!(seeded["url"], first["url"]);
    let limited = page.model_of(json!({ "type": "steps", "steps": 2 }));
    assert_eq!(
        (&limited["steps"], &limited["last_step"], &limited["step_limit"]),
        (&json!(2), &json!(6), &json!(2))
    );
    let whole = page.model_of(json!({ "type": "steps", "steps": null }));
    assert_eq!((&whole["url"], &whole["step_limit"]), (&seeded["url"], &Value::Null));
    page.model_of(json!({ "type": "steps", "steps": 0 }));
    // The number is unknown for the new script, so the server finds it while it is idle.
    server.write("s.lua", script(9));
    let guess = page.next("model");
    let found = page.next("model");
    assert_eq!((&found["url"], &found["steps"], &found["last_step"]), (&guess["url"], &json!(0), &json!(10)));
    page.is_quiet(Duration::from_millis(50));
}

#[test]
fn of_many_values_in_a_row_the_last_is_shown_in_the_end() {
    let server = Server::new(Some(&script(200)));
    let mut page = server.page();
    page.next("model");
    for value in (1..=9).cycle().take(200) {
        page.say(&json!({ "type": "set", "params": { "length": value } }));
    }
    page.say(&json!({ "type": "set", "params": { "length": 4 } }));
    let mut last = Value::Null;
    while let Some(message) = page.within(Duration::from_millis(500)) {
        if message["type"] == "model" {
            last = message;
        }
    }
    assert_eq!(last["params"][0]["value"], 4.0);
    assert!(last["run"].as_u64().unwrap() < 200);
}

#[test]
fn a_line_is_opened_in_the_editor_if_the_file_is_one_of_the_script() {
    let server = Server::with(
        Some(&script(3)),
        &[
            "--editor",
            "sh -c 'printf %s:%s \"$1\" \"$2\" > opened.part; mv opened.part opened' sh {file} {line}",
        ],
    );
    let mut page = server.page();
    page.next("model");
    server.write("secret.lua", "x");
    for file in ["/etc/passwd", "secret.lua", "../s.lua", "", "s.lua; touch x"] {
        page.say(&json!({ "type": "open", "file": file, "line": 3 }));
        assert_eq!(page.any()["type"], "refused", "{file}");
    }
    page.say(&json!({ "type": "open", "file": "s.lua", "line": 3 }));
    for _ in 0..200 {
        if server.path("opened").exists() {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    let opened = std::fs::read_to_string(server.path("opened")).unwrap();
    assert!(opened.ends_with("s.lua:3"), "{opened}");
    let plain = Server::new(Some(&script(3)));
    let mut page = plain.page();
    page.next("model");
    page.say(&json!({ "type": "open", "file": "s.lua", "line": 3 }));
    assert!(page.any()["text"].as_str().unwrap().contains("--editor"));
}

#[test]
fn a_preset_is_saved_loaded_and_deleted_for_all_pages() {
    let server = Server::with(Some(&script(3)), &["--seed", "5"]);
    let (mut page, mut other) = (server.page(), server.page());
    page.next("model");
    other.next("model");
    set(&mut page, json!("4"));
    page.say(&json!({ "type": "preset", "action": "save", "name": "long" }));
    let said = page.next("presets");
    assert_eq!((&said["names"], &said["chosen"]), (&json!(["long"]), &json!("long")));
    other.next("model");
    assert_eq!(other.next("presets")["names"], json!(["long"]));
    let file: Value = serde_json::from_slice(&std::fs::read(server.path("s.presets.json")).unwrap()).unwrap();
    assert_eq!(file, json!({ "long": { "seed": 5, "params": { "length": 4 } } }));
    assert_eq!(server.page().next("model")["preset"], "long");
    page.say(&json!({ "type": "preset", "action": "save", "name": "long" }));
    assert!(page.any()["text"].as_str().unwrap().contains("preset `long` already exists"));
    assert_eq!(page.model_of(json!({ "type": "reset" }))["preset"], Value::Null);
    page.model_of(json!({ "type": "seed", "seed": "6" }));
    page.say(&json!({ "type": "preset", "action": "save", "name": "long", "replace": true }));
    assert_eq!(page.next("presets")["chosen"], "long");
    page.model_of(json!({ "type": "seed", "seed": "5" }));
    set(&mut page, json!("4"));
    page.say(&json!({ "type": "preset", "action": "save", "name": "long", "replace": true }));
    assert_eq!(page.next("presets")["chosen"], "long");
    assert_eq!(page.model_of(json!({ "type": "reset" }))["preset"], Value::Null);
    page.model_of(json!({ "type": "seed", "seed": "6" }));
    let loaded = page.model_of(json!({ "type": "preset", "action": "load", "name": "long" }));
    assert_eq!(
        (&loaded["cause"], &loaded["seed"], &loaded["params"][0]["value"]),
        (&json!("preset"), &json!("5"), &json!(4.0))
    );
    assert_eq!(loaded["preset"], "long");
    for (action, name) in
        [("load", "lang"), ("delete", "none"), ("save", ""), ("save", "a\nb"), ("fly", "long")]
    {
        page.say(&json!({ "type": "preset", "action": action, "name": name }));
        assert_eq!(page.any()["type"], "refused", "{action} {name}");
    }
    page.say(&json!({ "type": "preset", "action": "delete", "name": "long" }));
    let said = page.next("presets");
    assert_eq!((&said["names"], &said["chosen"]), (&json!([]), &Value::Null));
    server.write("s.presets.json", "{ \"by hand\": { \"seed\": 3 } }");
    assert_eq!(page.next("presets")["names"], json!(["by hand"]));
    server.write("s.presets.json", "{ nonsense");
    page.say(&json!({ "type": "preset", "action": "load", "name": "long" }));
    assert!(page.any()["text"].as_str().unwrap().contains("s.presets.json:1"));
    let again = Server::with(Some(&script(3)), &["--set", "length=3"]);
    assert_eq!(again.page().next("model")["params"][0]["value"], 3.0);
}

#[test]
fn variations_come_as_pictures_to_the_page_that_asked() {
    let server = Server::new(Some(&script(3)));
    let (mut page, mut other) = (server.page(), server.page());
    page.next("model");
    other.next("model");
    set(&mut page, json!(2));
    other.next("model");
    page.say(&json!({ "type": "variations", "id": 7, "seeds": ["1", "18446744073709551615"] }));
    for (index, seed) in ["1", "18446744073709551615"].iter().enumerate() {
        let made = page.next("variation");
        assert_eq!((&made["id"], &made["index"], &made["of"]), (&json!(7), &json!(index), &json!(2)));
        assert_eq!((&made["seed"], &made["params"]), (&json!(seed), &json!({ "length": 2.0 })));
        let picture = server.get(made["url"].as_str().unwrap());
        assert!(picture.status == 200 && picture.body.starts_with(b"\x89PNG"));
    }
    page.say(&json!({ "type": "variations", "id": 8, "param": "length", "values": ["1", "9"] }));
    // All variations have the same camera, so a longer model fills more of its image.
    let seen = [1.0, 9.0].map(|length| {
        let made = page.next("variation");
        assert_eq!(made["params"]["length"], length);
        let picture = image::load_from_memory(&server.get(made["url"].as_str().unwrap()).body).unwrap();
        picture.to_rgba8().pixels().filter(|pixel| pixel[3] > 99).count()
    });
    assert!(seen[0] > 0 && seen[1] > 4 * seen[0], "{seen:?}");
    for wrong in [
        json!({ "param": "length", "values": ["99"] }),
        json!({ "param": "none", "values": ["1"] }),
        json!({ "seeds": ["x"] }),
        json!({ "seeds": [] }),
        json!({ "seeds": vec!["1"; 999] }),
        json!({}),
    ] {
        let mut message = wrong;
        message["type"] = "variations".into();
        message["id"] = 9.into();
        page.say(&message);
        let answer = page.next("refused");
        assert_eq!(answer["id"], json!(9), "{message}");
    }
    other.is_quiet(Duration::from_millis(50));
}

#[test]
fn the_scripts_own_parameters_come_before_those_of_files_that_it_requires() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("parts.lua"), "return { fine = param(\"fine\", { default = 2 }) }\n")
        .unwrap();
    let text = format!("local parts = require(\"parts\")\n{}", script(3));
    std::fs::write(folder.path().join("s.lua"), text).unwrap();
    let server = Server::start(folder, &[]);
    let model = server.page().next("model");
    let names: Vec<&Value> = model["params"].as_array().unwrap().iter().map(|param| &param["name"]).collect();
    assert_eq!(names, ["length", "fine"]);
}
