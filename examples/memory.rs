//! A program that keeps its scripts in memory. It gives them a function of its own, sets parameters by their types, and
//! receives printed texts, warnings and the progress as values.
//!
//! `cargo run --release --example memory`

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use burgeon::kit::{Constructor, Kind, Value};
use burgeon::script::{Control, FileLoader, Print, RunInputs, RunOptions, RunReports, Session};
use burgeon::{Error, Result, Run};

/// Script of the program. `storey_height` is a function of the program.
const HOUSE: &str = r#"
    local storeys = param("storeys", { default = 2, min = 1, max = 5, step = 1, doc = "Number of storeys" })
    local use = param("use", { default = "home", choices = { "home", "shop" } })
    local sides = require("parts/sides")
    local Storey = module("Storey", "height")
    local house = lsystem({ object = extruder({ sides = sides }) })
    house:axiom(Storey(storey_height(use)))
    house:rule("Storey(height)", function(this, height)
        return Storey(height), Storey(height)
    end)
    house:interpret("Storey(height)", function(this, height) this:extrude(height) end)
    house:derive(storeys)
    print("a " .. use .. " of " .. storeys .. " doublings")
"#;

/// Event of a run, for the rest of the program.
#[derive(Debug, PartialEq)]
enum RunEvent {
    /// A text that the script has printed.
    Printed(String),
    /// Last step, maximum number of steps and number of modules.
    Progress(usize, Option<usize>, usize),
    /// A warning, as text.
    Warned(String),
}

/// Returns the height (m) of a storey for a use: a function for scripts.
fn storey_height(arguments: &[Value]) -> Result<Value> {
    match arguments {
        [Value::Text(using)] if &**using == "shop" => Ok(Value::Number(4.5)),
        [Value::Text(_)] => Ok(Value::Number(3.0)),
        _ => Err(Error::argument("storey_height needs a use").help("write storey_height(\"shop\")")),
    }
}

/// Returns the options for the scripts of this program.
fn options() -> Result<RunOptions> {
    let files = [("house.lua", HOUSE), ("parts/sides.lua", "return 6")];
    let files: BTreeMap<String, Vec<u8>> =
        files.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec())).into();
    let mut options = burgeon::options();
    options.inputs = RunInputs { loader: Some(FileLoader::of_files(files)), ..RunInputs::default() };
    let functions = [Constructor { name: "storey_height", make: storey_height }];
    options.registry.add(Kind::new("host", "Functions of the program.").functions(functions))?;
    Ok(options)
}

/// Returns the parameters of the script with their allowed values, for controls of a user interface.
fn controls() -> Result<Vec<(String, Control)>> {
    let checked = burgeon::check(Path::new("house.lua"), options()?)?;
    Ok(checked.params.into_iter().map(|param| (param.name, param.control)).collect())
}

/// Runs the script with these parameters (`name=value`). Events arrive at the receiver, also during the run.
fn house(set: &[(&str, &str)]) -> Result<(Run, Receiver<RunEvent>)> {
    let (sender, events) = channel();
    // Scripts print from any thread.
    let printed = Mutex::new(sender.clone());
    let print = Print::new(move |text| {
        if let Ok(sender) = printed.lock() {
            // The receiver may have stopped listening.
            let _ = sender.send(RunEvent::Printed(text.to_owned()));
        }
    });
    let params: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    let reports = RunReports { print: Some(print), ..RunReports::default() };
    let session =
        Session::new(Path::new("house.lua"), RunOptions { params: params.into(), reports, ..options()? })?;
    let running = Arc::clone(&session);
    let run = std::thread::spawn(move || burgeon::run_session(&running));
    loop {
        let is_over = run.is_finished();
        let (step, steps, modules) = session.progress.counts();
        let _ = sender.send(RunEvent::Progress(step, steps, modules));
        if is_over {
            break;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let run = run.join().unwrap_or_else(|_| Err(Error::internal("the run panicked")))?;
    for warning in &run.warnings {
        let _ = sender.send(RunEvent::Warned(warning.to_string()));
    }
    Ok((run, events))
}

fn main() -> Result<()> {
    for (name, control) in controls()? {
        eprintln!("{name}: {control:?}");
    }
    let (run, events) = house(&[("storeys", "3"), ("use", "shop")])?;
    events.try_iter().for_each(|event| eprintln!("{event:?}"));
    eprintln!("{} triangles", run.scene.triangles());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn height(set: &[(&str, &str)]) -> f64 {
        let (run, _) = house(set).expect("the house stands");
        let (low, high) = run.scene.bounds().expect("it has walls");
        high.z - low.z
    }

    #[test]
    fn the_function_of_the_program_decides_the_height() {
        assert!((height(&[]) - 12.0).abs() < 1e-6);
        assert!((height(&[("use", "shop"), ("storeys", "3")]) - 36.0).abs() < 1e-6);
    }

    #[test]
    fn events_are_values_and_parameters_have_types() {
        let (_, events) = house(&[("storeys", "3")]).expect("the house stands");
        let events: Vec<RunEvent> = events.try_iter().collect();
        assert!(events.contains(&RunEvent::Printed("a home of 3 doublings".to_owned())), "{events:?}");
        let is_last = |event: &RunEvent| matches!(event, RunEvent::Progress(3, Some(3), 8..));
        assert!(events.iter().any(is_last), "{events:?}");
        let controls = controls().expect("the script is right");
        assert_eq!(controls[0].1, Control::Number { min: Some(1.0), max: Some(5.0), step: Some(1.0) });
        assert_eq!(controls[1].1, Control::Choice(vec!["home".to_owned(), "shop".to_owned()]));
    }

    #[test]
    fn a_wrong_value_names_the_file_in_memory() {
        let Err(error) = house(&[("use", "mill")]) else { panic!("there is no mill") };
        assert_eq!(error.place().map(|place| place.file.as_str()), Some("house.lua"), "{error}");
    }
}
