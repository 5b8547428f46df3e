//! `burgeon variations`: renders a contact sheet of many runs.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use burgeon::export::{self, Format, PNG};
use burgeon::scene::image;
use burgeon::variations::{Framing, SheetLayout, Variation, VariationAxis, Variations, sheet};
use burgeon::{Error, Result, Warning, WarningKind};
use clap::{ArgGroup, Args, ValueEnum};
use serde_json::json;

use super::picture_flags::PictureFlags;
use super::progress::ProgressDisplay;
use super::report;
use super::shared::{ScriptFlags, end_on_interrupt, size};

/// Seeds, unless given.
const SEEDS: &str = "1..9";

/// Runs a script many times, with other seeds or other values of a parameter, and shows them side by side
#[derive(Args)]
#[command(group = ArgGroup::new("over"))]
pub(crate) struct VariationsCommand {
    #[command(flatten)]
    script: ScriptFlags,

    /// Seeds: 1..16, or 3,7,12 [default without --sweep: 1..9]
    #[arg(long, value_name = "SEEDS", value_parser = seeds, group = "over", allow_hyphen_values = true)]
    seeds: Option<VariationAxis>,

    /// Parameter and its values: twist=0..90:10 in steps of 10, kind=a,b,c, or kind for every choice
    #[arg(long, value_name = "NAME=VALUES", value_parser = sweep, group = "over")]
    sweep: Option<VariationAxis>,

    /// File of the contact sheet
    #[arg(short, long, value_name = "FILE", value_parser = output, required = true, help = output_help())]
    output: PathBuf,

    /// Number of variations in a row [default: automatic]
    #[arg(long, value_name = "N", value_parser = columns, allow_negative_numbers = true)]
    columns: Option<usize>,

    /// Camera of the cells
    #[arg(long, value_enum, default_value_t = FramingFlag::Each, help_heading = "Pictures")]
    fit: FramingFlag,

    /// Width and height of a cell (pixels)
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size, default_value = "320x320", help_heading = "Pictures")]
    size: (u32, u32),

    #[command(flatten)]
    picture: PictureFlags,
}

#[derive(Clone, Copy, ValueEnum)]
enum FramingFlag {
    /// Common camera of all cells, so that sizes can be compared
    All,
    /// Separate cameras: each model fills its cell
    Each,
}

impl VariationsCommand {
    pub(crate) fn json(&self) -> bool {
        self.script.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let begin = Instant::now();
        end_on_interrupt()?;
        export::check_files([self.output.as_path()])?;
        let options = self.script.options()?;
        let default = VariationAxis::seeds(SEEDS)?;
        let over = self.seeds.as_ref().or(self.sweep.as_ref()).unwrap_or(&default);
        if let VariationAxis::Param { name, .. } = over
            && options.params.set.iter().any(|(known, _)| known == name)
        {
            return Err(Error::usage(format!("--set and --sweep both use `{name}`; remove one"))
                .help(format!("remove --set {name} or --sweep {name}")));
        }
        let variations = Arc::new(Variations::new(&self.script.script, options, over)?);
        let picture = self.picture.picture(self.size);
        let layout = SheetLayout::new(variations.len(), self.columns, &picture)?;
        let framing = match self.fit {
            FramingFlag::All => Framing::Together,
            FramingFlag::Each => Framing::Each,
        };
        let mut cells: Vec<Variation> = Vec::new();
        {
            let of = variations.len();
            let watched = Arc::clone(&variations);
            let message = move || format!("{} of {of} variations", watched.ran());
            let _progress = ProgressDisplay::saying(message, !self.script.json);
            variations.make(&picture, framing, |cell| cells.push(cell))?;
            refuse_if_all_failed(&cells)?;
            let texts: Vec<String> = cells.iter().map(failure_text).collect();
            let content = cells.iter().zip(&texts).map(|(cell, told)| {
                (cell.label.as_str(), cell.made.as_ref().map(|made| &made.picture).map_err(|_| told.as_str()))
            });
            let png = image::encode(&sheet(&layout, picture.background, content))?;
            export::write_file(&self.output, |out| std::io::Write::write_all(out, &png))?;
        }
        if self.script.json {
            let seconds = begin.elapsed().as_secs_f64();
            let told: Vec<_> = cells.iter().map(cell_json).collect();
            let document = json!({
                "ok": true,
                "columns": layout.columns,
                "rows": layout.rows,
                "size": layout.size,
                "cells": told,
                "warnings": report::warnings_json(equal_pictures(&cells).as_slice()),
                "seconds": { "total": seconds },
            });
            report::print(&format!("{document}\n"))?;
        } else {
            self.tell(&cells, &layout, begin);
        }
        Ok(())
    }

    fn tell(&self, cells: &[Variation], layout: &SheetLayout, begin: Instant) {
        for cell in cells {
            if let Err(error) = &cell.made {
                report::eprint(&format!("{} failed\n", cell.label));
                report::error(error, false);
            }
        }
        // Most cells have the same warnings.
        let mut warnings: Vec<&Warning> = Vec::new();
        for warning in cells.iter().filter_map(|cell| cell.made.as_ref().ok()).flat_map(|made| &made.warnings)
        {
            if !warnings.iter().any(|known| known.is_same(warning)) {
                warnings.push(warning);
            }
        }
        report::eprint(&report::warnings(warnings.into_iter().chain(&equal_pictures(cells))));
        let failed = cells.iter().filter(|cell| cell.made.is_err()).count();
        let failed = if failed > 0 { format!(", {failed} of them failed") } else { String::new() };
        report::eprint(&format!(
            "{} variations{failed}, {} in a row; {} in all\n",
            cells.len(),
            layout.columns,
            report::time(begin.elapsed())
        ));
    }
}

/// Combines the errors into one if all variations failed.
fn refuse_if_all_failed(cells: &[Variation]) -> Result<()> {
    let mut errors: Vec<(&Error, String)> = Vec::new();
    for cell in cells {
        let Err(error) = &cell.made else { return Ok(()) };
        let text = error.to_string();
        if errors.iter().all(|(_, known)| *known != text) {
            errors.push((error, text));
        }
    }
    // Many runs fail in the same way, with different numbers in the message.
    errors.truncate(5);
    Err(Error::several(
        errors
            .into_iter()
            .flat_map(|(error, _)| error.problems().map(Error::without_others).collect::<Vec<_>>())
            .collect(),
    ))
}

/// Returns the warning for several variations with equal pictures, although their seeds differ.
fn equal_pictures(cells: &[Variation]) -> Option<Warning> {
    let made: Vec<_> = cells.iter().filter_map(|cell| cell.made.as_ref().ok()).collect();
    let (first, others) = made.split_first()?;
    let are_equal = others.iter().all(|other| other.picture == first.picture);
    if !are_equal || others.is_empty() || cells.iter().any(|cell| cell.set.is_some()) {
        return None;
    }
    let equal = format!("the {} pictures are equal", made.len());
    Some(match first.seeded.first() {
        Some(place) => Warning::new(WarningKind::NoEffect, format!("{equal}: lsystem has its own `seed`"))
            .at_place(Some(place))
            .help("remove `seed` from lsystem, so that each run has another"),
        None => Warning::new(WarningKind::NoEffect, equal).help("draw random numbers with random()"),
    })
}

/// Returns the text of a cell without a render.
fn failure_text(cell: &Variation) -> String {
    match &cell.made {
        Ok(_) => String::new(),
        Err(error) => {
            let place = error.place().map(|place| {
                let file = Path::new(&place.file).file_name().unwrap_or_default().to_string_lossy();
                format!("{file}:{}: ", place.line)
            });
            format!("{}{}", place.unwrap_or_default(), error.message())
        }
    }
}

fn cell_json(cell: &Variation) -> serde_json::Value {
    let mut object = json!({ "label": cell.label, "seed": cell.seed });
    if let Some((name, value)) = &cell.set {
        object["set"] = json!({ name: value });
    }
    match &cell.made {
        Ok(made) => {
            object["params"] = report::params_json(&made.params);
            object["modules"] = made.modules.into();
            object["triangles"] = made.triangles.into();
            object["warnings"] = report::warnings_json(&made.warnings);
        }
        Err(error) => object["errors"] = error.problems().map(Error::to_json).collect(),
    }
    object
}

fn seeds(text: &str) -> Result<VariationAxis, String> {
    VariationAxis::seeds(text).map_err(|error| error.to_string())
}

fn sweep(text: &str) -> Result<VariationAxis, String> {
    VariationAxis::sweep(text).map_err(|error| error.to_string())
}

fn output_help() -> String {
    format!("Contact sheet, a .{} file", PNG.extension())
}

fn output(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if Format::of(&path).is_ok_and(|format| *format == PNG) {
        return Ok(path);
    }
    Err(format!("a contact sheet is an image: specify a .{} file", PNG.extension()))
}

fn columns(text: &str) -> Result<usize, &'static str> {
    match text.parse() {
        Ok(columns) if columns > 0 => Ok(columns),
        _ => Err("write an integer of at least 1"),
    }
}
