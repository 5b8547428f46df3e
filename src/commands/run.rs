//! `burgeon run`: from a script to files.

use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use burgeon::derive::Derived;
use burgeon::export;
use burgeon::picture::{Background, Picture};
use burgeon::script::Session;
use burgeon::{Error, Result};
use clap::{Args, ValueEnum};

use super::progress::Progress;
use super::report;
use super::shared::ScriptFlags;

/// Runs a script and writes what it makes
#[derive(Args)]
pub(crate) struct Run {
    #[command(flatten)]
    script: ScriptFlags,

    /// Writes the model; the extension picks the format: .glb, .gltf, .obj, .png or .svg. May be repeated
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,

    /// Writes the final chains as text, a line for each; - is standard output
    #[arg(long, value_name = "FILE")]
    chain: Option<PathBuf>,

    /// Width and height of a picture in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size, default_value = "1280x960", help_heading = "Pictures")]
    size: (u32, u32),

    /// Where the camera stands: 0 is north, 90 east (degrees) [default: by the model]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, help_heading = "Pictures")]
    azimuth: Option<f64>,

    /// How high the camera stands above the horizon (degrees) [default: by the model]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, help_heading = "Pictures")]
    elevation: Option<f64>,

    /// What is behind the model
    #[arg(long, value_enum, default_value_t = Behind::Light, help_heading = "Pictures")]
    background: Behind,
}

#[derive(Clone, Copy, ValueEnum)]
enum Behind {
    Light,
    Dark,
    /// Transparent
    Clear,
}

impl Run {
    pub(crate) fn json(&self) -> bool {
        self.script.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let begin = Instant::now();
        for output in &self.output {
            export::check_writable(output)?;
        }
        let session = Session::new(&self.script.script, self.script.options())?;
        let (run, writing) = {
            let _progress = Progress::show(&session, !self.script.json);
            let run = burgeon::run_session(&session)?;
            let writing = Instant::now();
            for output in &self.output {
                export::write(&run.scene, output, &self.picture())?;
            }
            if let Some(path) = &self.chain {
                write_chains(path, &run.systems)?;
            }
            (run, writing.elapsed())
        };
        let to_stdout = self.chain.as_deref() == Some(Path::new("-"));
        match (self.script.json, to_stdout) {
            (true, false) => {
                report::print(&format!("{}\n", report::summary_json(&run, writing, begin.elapsed())));
            }
            (true, true) => {
                report::eprint(&format!("{}\n", report::summary_json(&run, writing, begin.elapsed())));
            }
            (false, _) => report::eprint(&report::summary(&run, writing, begin.elapsed())),
        }
        Ok(())
    }

    fn picture(&self) -> Picture {
        Picture {
            width: self.size.0,
            height: self.size.1,
            azimuth: self.azimuth,
            elevation: self.elevation,
            background: match self.background {
                Behind::Light => Background::Light,
                Behind::Dark => Background::Dark,
                Behind::Clear => Background::Clear,
            },
            ..Picture::default()
        }
    }
}

/// Writes the chains of all systems, in the order in which they were derived.
fn write_chains(path: &Path, systems: &[std::sync::Arc<Derived>]) -> Result<()> {
    let failed = |error: std::io::Error| {
        Error::new(format!("cannot write the chains to {}: {error}", path.display()))
            .help("check that the folder exists and may be written to")
    };
    if path == Path::new("-") {
        let mut out = BufWriter::new(std::io::stdout().lock());
        let written =
            systems.iter().try_for_each(|system| system.write_chains(&mut out)).and_then(|()| out.flush());
        return match written {
            // A reader that has gone away wants no more.
            Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(failed(error)),
            _ => Ok(()),
        };
    }
    export::write_file(path, |out| systems.iter().try_for_each(|system| system.write_chains(out)))
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let parts = text
        .split_once(['x', 'X'])
        .and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    match parts {
        Some((width, height))
            if (1..=Picture::LARGEST).contains(&width) && (1..=Picture::LARGEST).contains(&height) =>
        {
            Ok((width, height))
        }
        _ => Err(format!("write WIDTHxHEIGHT, such as 1280x960, each from 1 to {}", Picture::LARGEST)),
    }
}
