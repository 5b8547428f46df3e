//! A plant without a script: its rules are closures, and the program draws the chain.
//!
//! `cargo run --release --example plant > plant.svg` writes the drawing; a number behind `--` sets the seed.

use std::fmt::Write as _;

use burgeon::Result;
use burgeon_rewriting::{CLOSE, Chain, ClosureSystem, OPEN, Symbol};

/// Number of derivation steps.
const STEPS: usize = 9;

/// Symbols of the modules that are drawn.
struct Plant {
    system: ClosureSystem,
    shoot: Symbol,
    turn: Symbol,
    bud: Symbol,
}

impl Plant {
    fn new(seed: u64) -> Result<Self> {
        let mut system = ClosureSystem::new(seed);
        let bud = system.module("Bud", &["length", "width"])?;
        let shoot = system.module("Shoot", &["length", "width"])?;
        let turn = system.module("Turn", &["angle"])?;
        system.rule_when(
            "Bud(l, w)",
            |module| module.arguments[1] > 0.4,
            move |module, out| {
                let &[length, width] = module.arguments else { return };
                out.push(shoot, &[length, width]);
                for side in [-1.0, 1.0] {
                    out.open();
                    out.push(turn, &[side * (18.0 + 20.0 * module.random())]);
                    out.push(bud, &[length * (0.7 + 0.25 * module.random()), width * 0.7]);
                    out.close();
                }
            },
        )?;
        Ok(Self { system, shoot, turn, bud })
    }

    fn grow(&self) -> Result<Chain> {
        let first = self.system.chain(|out| out.push(self.bud, &[90.0, 9.0]))?;
        self.system.derive(first, STEPS)
    }

    /// Draws shoots as lines and buds as leaves; the plant begins at (0, 0) and grows upwards.
    fn draw(&self, chain: &Chain) -> String {
        let (mut place, mut angle, mut branches) = ([0.0, 0.0], 90.0_f64, Vec::new());
        let (mut lines, mut leaves) = (String::new(), String::new());
        let mut params = chain.params.iter().copied();
        let mut next = || params.next().unwrap_or_default();
        for symbol in &chain.symbols {
            match *symbol {
                OPEN => branches.push((place, angle)),
                CLOSE => (place, angle) = branches.pop().unwrap_or((place, angle)),
                symbol if symbol == self.turn => angle += next(),
                symbol if symbol == self.shoot => {
                    let (length, width) = (next(), next());
                    let (sin, cos) = angle.to_radians().sin_cos();
                    let end = [place[0] + cos * length, place[1] - sin * length];
                    let [from, to] = [place, end].map(|[x, y]| format!("{x:.1} {y:.1}"));
                    // Writing into a string cannot fail.
                    let _ = writeln!(lines, r#"<path d="M{from}L{to}" stroke-width="{width:.1}"/>"#);
                    place = end;
                }
                symbol if symbol == self.bud => {
                    let _ = (next(), next());
                    let _ = writeln!(leaves, r#"<circle cx="{:.1}" cy="{:.1}" r="5"/>"#, place[0], place[1]);
                }
                _ => {}
            }
        }
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-400 -480 800 500\">\n\
             <g stroke=\"#5b4636\" stroke-linecap=\"round\">\n{lines}</g>\n\
             <g fill=\"#6f9a3c\" fill-opacity=\"0.8\">\n{leaves}</g>\n</svg>"
        )
    }
}

#[allow(clippy::print_stdout, reason = "the drawing goes to standard output")]
fn main() -> Result<()> {
    let seed = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(5);
    let plant = Plant::new(seed)?;
    println!("{}", plant.draw(&plant.grow()?));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plant_forks_until_its_shoots_are_thin() {
        let plant = Plant::new(1).expect("a plant");
        let chain = plant.grow().expect("it grows");
        let shoots = chain.symbols.iter().filter(|symbol| **symbol == plant.shoot).count();
        // Widths are 9 m times 0.7 to the power of the step: nine steps, each of which doubles the buds.
        assert_eq!(shoots, (1 << STEPS) - 1);
        assert_eq!(plant.draw(&chain).matches("<circle").count(), 1 << STEPS);
    }
}
