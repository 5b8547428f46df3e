//! A program that runs scripts. It sets their parameters, shows the progress of a run, cancels a run that takes too
//! long, gets the model as buffers without a file, and runs the script again when it or its input files change.
//!
//! `cargo run --release --example embed -- scripts/tower.lua floors=9` ends after one run; with `--watch` it continues.

use std::path::{Path, PathBuf};
use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};

use burgeon::scene::Scene;
use burgeon::script::{RunOptions, Session};
use burgeon::watch::Watch;
use burgeon::{Error, Result};
use glam::Mat4;

/// Time limit of a run.
const PATIENCE: Duration = Duration::from_secs(60);

/// Input of a renderer: the corners of a part, three numbers each, its triangles, and the transforms of its instances.
struct DrawCall {
    positions: Vec<f32>,
    normals: Vec<f32>,
    indices: Vec<u32>,
    color: [f32; 4],
    transforms: Vec<Mat4>,
}

/// Converts the model to buffers; a mesh with several instances is converted once.
fn draw_calls(scene: &Scene) -> Vec<DrawCall> {
    let mut calls = Vec::new();
    for (number, mesh) in scene.meshes.iter().enumerate() {
        let seen = scene.instances.iter().filter(|instance| instance.mesh == number);
        let transforms: Vec<Mat4> = seen.map(|instance| instance.transform.as_affine3a().into()).collect();
        for part in mesh.parts.iter().filter(|_| !transforms.is_empty()) {
            calls.push(DrawCall {
                positions: part.positions.iter().flat_map(|point| point.to_array()).collect(),
                normals: part.normals.iter().flat_map(|normal| normal.vector().to_array()).collect(),
                indices: part.triangles.iter().flatten().collect(),
                color: scene.materials[part.material].base_color,
                transforms: transforms.clone(),
            });
        }
    }
    calls
}

/// Runs the script with these parameters (`name=value`). Returns the model, and the files that it depends on.
fn model(script: &Path, set: &[(String, String)]) -> (Result<Vec<DrawCall>>, Vec<PathBuf>) {
    let options = RunOptions { params: set.to_vec().into(), ..burgeon::options() };
    let session = match Session::new(script, options) {
        Ok(session) => session,
        Err(error) => return (Err(error), vec![script.to_owned()]),
    };
    let (done, over) = mpsc::channel();
    let running = Arc::clone(&session);
    let run = std::thread::spawn(move || {
        let run = burgeon::run_session(&running);
        // The receiver may have stopped waiting.
        let _ = done.send(());
        run
    });
    let begin = Instant::now();
    while over.recv_timeout(Duration::from_millis(200)) == Err(mpsc::RecvTimeoutError::Timeout) {
        eprintln!("{}", session.progress.message(begin.elapsed()));
        if begin.elapsed() > PATIENCE {
            session.stop.stop(Error::cancellation("nobody waits so long"));
        }
    }
    let run = run.join().unwrap_or_else(|_| Err(Error::internal("the run panicked")));
    (run.map(|run| draw_calls(&run.scene)), session.files())
}

/// Prints a model or its error. A real program would pass the buffers to its renderer here.
fn show(model: &Result<Vec<DrawCall>>) {
    match model {
        Err(error) => eprintln!("{error}"),
        Ok(calls) => {
            for call in calls {
                let (corners, normals, triangles) =
                    (call.positions.len() / 3, call.normals.len() / 3, call.indices.len() / 3);
                let (color, times) = (call.color, call.transforms.len());
                eprintln!(
                    "{corners} corners, {normals} normals, {triangles} triangles in {color:?}, seen {times} times"
                );
            }
        }
    }
}

fn main() -> Result<()> {
    let (mut set, mut watches, mut script) = (Vec::new(), false, PathBuf::from("scripts/tower.lua"));
    for argument in std::env::args().skip(1) {
        match argument.split_once('=') {
            Some((name, value)) => set.push((name.to_owned(), value.to_owned())),
            None if argument == "--watch" => watches = true,
            None => script = PathBuf::from(argument),
        }
    }
    let (first, files) = model(&script, &set);
    show(&first);
    if !watches {
        return first.map(|_| ());
    }
    let (changed, changes) = mpsc::channel();
    let tell = move |_| {
        // The program may be about to exit.
        let _ = changed.send(());
    };
    let watch = Watch::new(files, tell, |why| eprintln!("{why}"))?;
    while changes.recv().is_ok() {
        let since = std::time::SystemTime::now();
        let (next, files) = model(&script, &set);
        show(&next);
        watch.follow(files.into_iter().map(|file| (file.clone(), file.is_file())).collect(), since);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tower() -> PathBuf {
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scripts/tower.lua")
    }

    #[test]
    fn a_parameter_changes_the_buffers() {
        let corners = |floors: &str| {
            let (calls, files) = model(&tower(), &[("floors".to_owned(), floors.to_owned())]);
            assert!(files.iter().any(|file| file.ends_with("tower.lua")), "{files:?}");
            let calls = calls.expect("the tower stands");
            for call in &calls {
                assert_eq!(call.positions.len(), call.normals.len());
                let corners = u32::try_from(call.positions.len() / 3).expect("there are few");
                assert!(call.indices.iter().all(|index| *index < corners));
            }
            calls.iter().map(|call| call.positions.len() / 3).sum::<usize>()
        };
        let (few, many) = (corners("3"), corners("12"));
        assert!(few > 20 && many > few, "{few} and {many}");
    }

    #[test]
    fn a_wrong_parameter_is_told_and_a_broken_script_is_still_followed() {
        let (wrong, _) = model(&tower(), &[("floors".to_owned(), "many".to_owned())]);
        assert!(wrong.is_err_and(|error| error.to_string().contains("floors")));
        let folder = std::env::temp_dir().join(format!("burgeon embed {}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("the temporary folder can be written to");
        let script = folder.join("s.lua");
        std::fs::write(&script, "local x =").expect("the temporary folder can be written to");
        let (broken, files) = model(&script, &[]);
        std::fs::remove_dir_all(&folder).ok();
        assert!(broken.is_err() && files.iter().any(|file| file.ends_with("s.lua")), "{files:?}");
    }
}
