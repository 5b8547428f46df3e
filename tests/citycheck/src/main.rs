//! Reports which of the given CityJSON files and sequences (`.jsonl`) are invalid, with the reasons. It is not a member of the
//! workspace, because the validator needs a hundred additional crates; the gate builds it separately.

use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use cjval::CJValidator;
use serde_json::{Map, Value, json};

// Half of the time of the validator is allocation.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Number of features at the beginning of a sequence that are validated one by one.
const ALONE: usize = 16;
/// Number of further features that are validated as one: the validator compiles its schemas for each.
const BATCH: usize = 64;

/// One document, or a feature of a sequence with the first line of the sequence.
struct Part {
    file: usize,
    head: Arc<str>,
    feature: Option<String>,
}

fn main() -> ExitCode {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let next = AtomicUsize::new(0);
    let failed = Mutex::new(vec![false; files.len()]);
    let parts: Vec<Part> = files.iter().enumerate().flat_map(|(index, file)| read_parts(index, file, &failed)).collect();
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(part) = parts.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if !is_valid(&files[part.file], part) {
                        set_failed(&failed, part.file);
                    }
                }
            });
        }
    });
    let failed = failed.lock().map_or(files.len(), |failed| failed.iter().filter(|failed| **failed).count());
    println!("{} passed, {failed} failed", files.len() - failed);
    if failed > 0 || files.is_empty() { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Reads a file as parts that can be validated at the same time.
fn read_parts(index: usize, file: &str, failed: &Mutex<Vec<bool>>) -> Vec<Part> {
    let text = match std::fs::read_to_string(file) {
        Ok(text) => text,
        Err(error) => {
            println!("{file}: {error}");
            set_failed(failed, index);
            return Vec::new();
        }
    };
    if !file.ends_with(".jsonl") {
        return vec![Part { file: index, head: text.into(), feature: None }];
    }
    // The first line of a sequence has what its features share.
    let mut lines = text.lines();
    let head: Arc<str> = lines.next().unwrap_or_default().into();
    let lines: Vec<&str> = lines.collect();
    let (alone, rest) = lines.split_at(lines.len().min(ALONE));
    let mut features: Vec<String> = alone.iter().map(|line| (*line).to_owned()).collect();
    for batch in rest.chunks(BATCH) {
        match merge(batch) {
            Ok(merged) => features.push(merged),
            Err(reason) => {
                println!("{file}: {reason}");
                set_failed(failed, index);
            }
        }
    }
    let part = |feature| Part { file: index, head: Arc::clone(&head), feature };
    std::iter::once(None).chain(features.into_iter().map(Some)).map(part).collect()
}

/// Returns one feature with the objects and vertices of several. Fails if a line is no feature, or if an object is in two of them.
fn merge(lines: &[&str]) -> Result<String, String> {
    let (mut objects, mut vertices, mut first) = (Map::new(), Vec::new(), Value::Null);
    for line in lines {
        let mut feature: Map<String, Value> = serde_json::from_str(line).map_err(|error| error.to_string())?;
        let id = feature.remove("id").filter(Value::is_string).ok_or("a feature has no id")?;
        let own = match feature.remove("CityObjects") {
            Some(Value::Object(own)) if own.contains_key(id.as_str().unwrap_or_default()) => own,
            _ => return Err(format!("the feature {id} does not contain its object")),
        };
        let Some(Value::Array(places)) = feature.remove("vertices") else {
            return Err(format!("the feature {id} has no vertices"));
        };
        if feature.remove("type") != Some("CityJSONFeature".into()) || !feature.is_empty() {
            return Err(format!("the feature {id} has another type or further members: {:?}", feature.keys()));
        }
        for (name, mut object) in own {
            let geometries = object.get_mut("geometry").and_then(Value::as_array_mut);
            for geometry in geometries.into_iter().flatten() {
                if let Some(boundaries) = geometry.get_mut("boundaries") {
                    shift(boundaries, vertices.len(), places.len())?;
                }
            }
            if objects.insert(name.clone(), object).is_some() {
                return Err(format!("two features contain the object {name}"));
            }
        }
        vertices.extend(places);
        if first.is_null() {
            first = id;
        }
    }
    let merged = json!({ "type": "CityJSONFeature", "id": first, "CityObjects": objects, "vertices": vertices });
    Ok(merged.to_string())
}

/// Adds `by` to the numbers of vertices. Fails if a number is not below `count`.
fn shift(value: &mut Value, by: usize, count: usize) -> Result<(), String> {
    if let Value::Array(items) = value {
        return items.iter_mut().try_for_each(|item| shift(item, by, count));
    }
    match value.as_u64().and_then(|number| usize::try_from(number).ok()).filter(|number| *number < count) {
        Some(number) => *value = (number + by).into(),
        None => return Err(format!("{value} is not the number of a vertex")),
    }
    Ok(())
}

/// Marks a file as invalid.
fn set_failed(failed: &Mutex<Vec<bool>>, file: usize) {
    if let Ok(mut failed) = failed.lock() {
        failed[file] = true;
    }
}

/// Returns true if a part is valid; prints the reasons otherwise.
fn is_valid(file: &str, part: &Part) -> bool {
    let mut validator = CJValidator::from_str(&part.head);
    if let Some(feature) = &part.feature
        && let Err(error) = validator.from_str_cjfeature(feature)
    {
        println!("{file}: {error}");
        return false;
    }
    report(file, &validator)
}

/// Prints the errors of a validator, and returns true if there are none.
fn report(file: &str, validator: &CJValidator) -> bool {
    for (criterion, found) in validator.validate() {
        for error in found.get_errors().iter().take(5) {
            println!("{file}: {criterion}: {error}");
        }
    }
    validator.is_valid()
}
