//! Flags that several commands have.

use std::path::PathBuf;
use std::time::Duration;

use burgeon::script::{Limits, Options};
use clap::Args;

/// How a script is run.
#[derive(Args)]
pub(crate) struct ScriptFlags {
    /// The script, a Lua file
    pub script: PathBuf,

    /// Sets a parameter of the script
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting)]
    set: Vec<(String, String)>,

    /// The seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,

    /// Derives at most N steps
    #[arg(long, value_name = "N")]
    steps: Option<usize>,

    /// Works with N threads; the result does not depend on it [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Stops after this time
    #[arg(long, value_name = "SECONDS", default_value_t = 300.0, value_parser = seconds, help_heading = "Limits")]
    time_limit: f64,

    /// Memory that each virtual machine may use
    #[arg(long, value_name = "MEGABYTES", default_value_t = 2048, help_heading = "Limits",
          value_parser = clap::value_parser!(u32).range(16..))]
    memory_limit: u32,

    /// Modules that a system's chains may have
    #[arg(long, value_name = "N", default_value_t = 50_000_000, help_heading = "Limits")]
    module_limit: u32,

    /// Triangles that a system may draw
    #[arg(long, value_name = "N", default_value_t = 50_000_000, help_heading = "Limits")]
    triangle_limit: u32,

    /// Modules that a thread takes at a time; the result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 4096, hide = true)]
    batch: u32,

    /// Prints for machines
    #[arg(long)]
    pub json: bool,
}

impl ScriptFlags {
    pub(crate) fn options(&self) -> Options {
        Options {
            set: self.set.clone(),
            seed: self.seed,
            steps: self.steps,
            threads: self.threads.map(usize::from),
            batch: self.batch as usize,
            limits: Limits {
                time: Duration::from_secs_f64(self.time_limit),
                memory: self.memory_limit as usize * 1_000_000,
                modules: self.module_limit as usize,
                triangles: self.triangle_limit as usize,
            },
            check: false,
        }
    }
}

fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => Ok((name.trim().to_owned(), value.to_owned())),
        _ => Err("write NAME=VALUE".to_owned()),
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds < 1e9 => Ok(seconds),
        _ => Err("write a number of seconds above 0".to_owned()),
    }
}
