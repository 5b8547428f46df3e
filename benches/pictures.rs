//! Measures pictures: a tower and a landscape of 1280 by 960 pixels, and a Menger sponge of 640 by 480.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench prints and stops at what is wrong")]

use std::path::Path;
use std::time::Instant;

use burgeon::picture::{Picture, Quality, render};
use cpu_time::ProcessTime;

/// Scripts and the sizes of their pictures.
const PICTURES: [(&str, u32, u32); 3] = [
    ("scripts/tower.lua", 1280, 960),
    ("tests/clients/menger.lua", 640, 480),
    ("scripts/landscape.lua", 1280, 960),
];

fn main() {
    let is_bench = std::env::args().any(|argument| argument == "--bench");
    for (script, width, height) in PICTURES {
        let begin = Instant::now();
        let run = burgeon::run(Path::new(script), burgeon::options()).unwrap();
        let running = begin.elapsed().as_secs_f64();
        for quality in [Quality::Draft, Quality::Fine, Quality::Best] {
            let (width, height) = if is_bench { (width, height) } else { (width / 16, height / 16) };
            let picture = Picture { width, height, quality, ..Picture::default() };
            let (begin, cpu) = (Instant::now(), ProcessTime::now());
            let image = render(&run.scene, &picture).unwrap();
            assert_eq!(image.width(), width);
            println!(
                "{script}, {quality:?}: {:.2} s, {:.2} s of CPU, after a run of {running:.2} s",
                begin.elapsed().as_secs_f64(),
                cpu.elapsed().as_secs_f64()
            );
            if !is_bench {
                break;
            }
        }
    }
}
