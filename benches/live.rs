//! Time from saving a script to the encoded model for the page, and the effect of 500 reloads on the server's memory.
//! `cargo bench --bench live`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]
#![allow(clippy::unwrap_used, reason = "a bench has nobody to tell but its reader")]

use std::io::{BufRead, BufReader};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Instant;

use serde_json::Value;
use tungstenite::{Message, WebSocket};

const TOWER: &str = include_str!("../scripts/tower.lua");

/// Wall of bricks: a million triangles from one axiom.
const MILLION: &str = r#"local Row, Brick = module("Row", "n"), module("Brick", "x")
local wall = lsystem({ object = extruder({ sides = 4, smooth = false }), interpret = "last" })
local rows = {}
for n = 1, 300 do table.insert(rows, { Row(n) }) end
wall:axiom(table.unpack(rows))
wall:rule("Row(n)", function(this, n)
  local bricks = {}
  for x = 1, 278 do table.insert(bricks, { Brick(x) }) end
  return table.unpack(bricks)
end)
wall:interpret("Brick(x)", function(this, x) this:jump({ x, 0, 0 }):extrude(0.5 + SALT) end)
wall:derive()
"#;

fn main() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("s.lua");
    let tower = |salt: usize| TOWER.replace("default = 24", &format!("default = {}", 14 + salt % 6));
    std::fs::write(&script, tower(0)).unwrap();
    let (mut server, mut page) = start(folder.path());
    next(&mut page);
    measure("tower.lua", &script, &mut page, 41, tower);
    measure("a million triangles", &script, &mut page, 9, |salt| {
        MILLION.replace("SALT", &format!("0.0{}", salt + 1))
    });
    for round in 1..=500 {
        std::fs::write(&script, tower(round)).unwrap();
        next(&mut page);
        if round == 20 || round % 100 == 0 {
            println!("after {round} reloads of tower.lua: {:.1} MB resident", resident(&server));
        }
    }
    server.kill().unwrap();
    server.wait().unwrap();
}

/// Starts a server with the real binary, and connects a page.
fn start(folder: &Path) -> (Child, WebSocket<TcpStream>) {
    let mut server = Command::new(env!("CARGO_BIN_EXE_burgeon"))
        .args(["live", "s.lua", "--json", "--no-open", "--port", "0"])
        .current_dir(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(server.stdout.take().unwrap()).read_line(&mut line).unwrap();
    let said: Value = serde_json::from_str(&line).unwrap();
    let stream =
        TcpStream::connect(("127.0.0.1", u16::try_from(said["port"].as_u64().unwrap()).unwrap())).unwrap();
    stream.set_nodelay(true).unwrap();
    let address = said["address"].as_str().unwrap().replace("http://", "ws://") + "socket";
    (server, tungstenite::client(address, stream).unwrap().0)
}

/// Returns the next model.
fn next(page: &mut WebSocket<TcpStream>) -> Value {
    loop {
        if let Message::Text(text) = page.read().unwrap() {
            let message: Value = serde_json::from_str(&text).unwrap();
            assert!(message["type"] != "error", "{message}");
            if message["type"] == "model" {
                return message;
            }
        }
    }
}

/// Saves a sequence of different scripts and prints medians.
fn measure(
    name: &str,
    script: &Path,
    page: &mut WebSocket<TcpStream>,
    rounds: usize,
    text: impl Fn(usize) -> String,
) {
    let mut taken = Vec::new();
    let mut times: Vec<Value> = Vec::new();
    let mut triangles = 0;
    for round in 0..rounds {
        let begin = Instant::now();
        std::fs::write(script, text(round + 1)).unwrap();
        let model = next(page);
        taken.push(begin.elapsed().as_secs_f64() * 1e3);
        times.push(model["times"].clone());
        triangles = model["triangles"].as_u64().unwrap();
    }
    let median = |mut numbers: Vec<f64>| {
        numbers.sort_by(f64::total_cmp);
        numbers[numbers.len() / 2]
    };
    println!("{name}, {triangles} triangles: {:.0} ms from the save to the model, of which", median(taken));
    for part in ["script", "rewriting", "interpretation", "scene", "encode", "total"] {
        let part_times = times.iter().map(|times| times[part].as_f64().unwrap()).collect();
        println!("  {part}: {:.1} ms", median(part_times));
    }
}

/// Returns the server's resident memory (MB), or 0 if the system does not report it.
fn resident(server: &Child) -> f64 {
    let status = std::fs::read_to_string(format!("/proc/{}/status", server.id())).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap_or("0");
    line.split_whitespace().next().and_then(|it| it.parse::<f64>().ok()).unwrap_or(0.0) / 1024.0
}
