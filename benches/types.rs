//! Cost of an object type in Lua compared with one in Rust: a method with a number as argument, per call, and ten
//! thousand objects on as many features, per run. `cargo bench --bench types`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::path::Path;
use std::sync::Arc;

use burgeon::kit::{Drawing, methods, object};
use burgeon::scene::Material;
use burgeon::script::RunOptions;
use burgeon_geometry::sphere;
use cpu_time::ProcessTime;
use glam::DVec3;

/// Balls stacked on each other.
#[object("pearls", draws, begins_empty, crate = burgeon::kit)]
pub struct Pearls {
    /// Radius of a pearl (m).
    #[default(0.5)]
    pub radius: f64,
    height: f64,
    size: f64,
    drawing: Drawing,
}

#[methods("pearls", crate = burgeon::kit)]
impl Pearls {
    /// Adds a pearl on top.
    pub fn add(&mut self) -> burgeon::Result<()> {
        let radius = self.radius;
        let part = self.drawing.material(&Material::default());
        sphere(self.drawing.part(part), DVec3::Z * (self.height + radius), radius, 12)?;
        self.height += 2.0 * radius;
        Ok(())
    }

    /// Adds `by` to a number that is not drawn.
    pub fn grow(&mut self, by: f64) {
        self.size += by;
    }

    /// Returns the sum of all numbers that were added.
    pub fn size(&self) -> f64 {
        self.size
    }
}

const IN_LUA: &str = r#"
local pearls = object("lua_pearls", {
  extends = turtle,
  fields = { radius = 0.5 },
  state = { high = 0, grown = 0 },
  changes = {
    add = function(self)
      self:jump({ 0, 0, self.high + self.radius }):sphere(self.radius)
      self.high += 2 * self.radius
    end,
    grow = function(self, by) self.grown += by end,
  },
})
"#;

/// Returns a script with a million modules in one chain and this `interpretation` of each.
fn calls(interpretation: &str) -> String {
    format!(
        r#"
local A = module("A", "n")
local s = lsystem({{ object = pearls(), interpret = "last" }})
s:axiom(A(20))
s:rule("A(n)", function(this, n) if n > 0 then return A(n - 1), A(n - 1) end end)
s:interpret("A(n)", function(this, n) {interpretation} end)
s:derive(20)
"#
    )
}

const FEATURES: &str = r#"
local A = module("A", "n")
local s = lsystem({ object = pearls() })
s:axiom(source("points.geojson"), function(feature) return pearls({ radius = 0.4 }), A(3) end)
s:rule("A(n)", function(this, n) if n > 1 then return A(1), A(n - 1) end end)
s:interpret("A(n)", function(this, n) this:add() end)
s:derive(3)
"#;

/// Returns the CPU time (s) of the fastest of `rounds` runs of `script`.
fn time(folder: &Path, rounds: usize, script: &str) -> f64 {
    let path = folder.join("bench.lua");
    std::fs::write(&path, script).expect("the temporary folder can be written to");
    let once = || {
        let mut registry = burgeon::registry();
        registry.add(Arc::clone(Pearls::kind())).expect("the name is free");
        let options = RunOptions { threads: Some(1), registry, ..burgeon::options() };
        let begin = ProcessTime::now();
        burgeon::run(&path, options).expect("the script runs");
        begin.elapsed().as_secs_f64()
    };
    (0..rounds).map(|_| once()).fold(f64::INFINITY, f64::min)
}

fn main() {
    let folder = std::env::temp_dir().join(format!("burgeon bench types {}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the temporary folder can be written to");
    let points = (0..10_000).map(|number| {
        let (east, north) = (2.0 + f64::from(number % 100) * 1e-4, 48.0 + f64::from(number / 100) * 1e-4);
        format!(
            r#"{{"type":"Feature","id":{number},"properties":{{}},"geometry":{{"type":"Point","coordinates":[{east},{north}]}}}}"#
        )
    });
    let points = points.collect::<Vec<_>>().join(",");
    let points = format!(r#"{{"type":"FeatureCollection","features":[{points}]}}"#);
    std::fs::write(folder.join("points.geojson"), points).expect("the temporary folder can be written to");
    let both = |script: &str| [time(&folder, 5, script), time(&folder, 5, &format!("{IN_LUA}{script}"))];
    let [base, lua_base] = both(&calls(""));
    let [rust, lua] = both(&calls("this:grow(n):grow(n):grow(n):grow(n)"));
    let each = |with: f64, without: f64| (with - without) / (4.0 * f64::from(1 << 20)) * 1e9;
    let (rust, lua) = (each(rust, base), each(lua, lua_base));
    println!(
        "a method that takes a number: {rust:.0} ns a call in Rust, {lua:.0} ns in Lua, {:.2} times",
        lua / rust
    );
    let [rust, lua] = both(FEATURES);
    println!(
        "10,000 objects on as many features: {rust:.2} s in Rust, {lua:.2} s in Lua, {:.2} times",
        lua / rust
    );
    std::fs::remove_dir_all(&folder).ok();
}
