//! Straight skeletons: time for each building of a real town and for a comb with 400 teeth, growth of time with the
//! number of edges, and the number of noisy regular plans without a skeleton or with a roof that is not closed.
//!
//! `cargo bench --bench skeleton [-- PLANS [SEED]]`: the number of plans of each type, 10,000 by default, and their
//! seed.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use burgeon::kit::{Call, Parameter, Table, TableKey, Value};
use burgeon::objects::Footprint;
use burgeon_data::{Layer, Source, SourceOptions};
use burgeon_geometry::skeleton::{Pace, Skeleton};
use burgeon_geometry::{Plan, Polygon, Rings, solid};
use burgeon_spatial::{PolygonArgument, rings};
use glam::{DVec2, Vec3};

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../crates/geometry/src/skeleton/samples.rs"]
mod samples;

use samples::{FAMILIES, Family, Random, still};

fn main() {
    // Cargo adds the argument `--bench`.
    let mut numbers = std::env::args().skip(1).filter_map(|argument| argument.parse::<u64>().ok());
    let (count, seed) = (numbers.next().unwrap_or(10_000), numbers.next().unwrap_or(1));
    for family in &FAMILIES {
        regular(family, count, seed);
    }
    match town() {
        Some(plans) => each(&plans),
        None => println!("skipped: there is no ../shared/data/france_buildings.gpkg"),
    }
    let comb = best(&comb(400), 10);
    println!("a comb of 400 teeth: {:.1} ms (asked: less than 50 ms)", comb * 1e3);
    for (name, make) in [("combs", comb_of as fn(u32) -> Polygon), ("stars", star)] {
        let sizes = [10, 30, 100, 300, 1000, 2000, 4000];
        let times: Vec<(f64, f64)> = sizes
            .iter()
            .map(|&size| {
                let plan = make(size);
                let edges = plan.size();
                let time = best(&plan, if edges < 1000 { 50 } else { 5 });
                println!("{name}: {edges} edges {:.3} ms", time * 1e3);
                (f64::from(size), time)
            })
            .collect();
        let [from, to] = [times[2], times[times.len() - 1]];
        let exponent = (to.1 / from.1).ln() / (to.0 / from.0).ln();
        println!(
            "{name}: time grows as n^{exponent:.2} from 100 to 4000 edges (asked: no worse than n^2 log n)"
        );
    }
}

/// Reads the buildings of a real town, if its file is next to the repository.
fn town() -> Option<Vec<Polygon>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/france_buildings.gpkg");
    let wanted = SourceOptions { layer: Some("buildings".into()), ..SourceOptions::default() };
    let table = Source::open(&path, "france").ok()?.read("france", &wanted).ok()?;
    let layer = Layer::new(table, &mut None).ok()?;
    let plan = |feature: &burgeon_data::Feature| Some(Plan::new(rings(&feature.geometry)?).ok()?.flat());
    Some(layer.features.iter().filter_map(plan).collect())
}

fn each(plans: &[Polygon]) {
    let mut times = Vec::with_capacity(plans.len());
    let mut failed = 0;
    for plan in plans {
        let paces = vec![Pace::default(); plan.size()];
        let begin = Instant::now();
        let found = Skeleton::new(plan, &paces);
        times.push(begin.elapsed().as_secs_f64() * 1e6);
        failed += u32::from(found.is_err());
    }
    times.sort_by(f64::total_cmp);
    let (median, p99) = (times[times.len() / 2], times[times.len() * 99 / 100]);
    println!(
        "{} buildings: median {median:.1} us (asked: less than 20 us), 99th percentile {p99:.1} us",
        plans.len()
    );
    println!("without a skeleton: {failed}");
}

/// Prints the failures of the skeletons and hip roofs of `count` plans of a family: unscaled, 1 m wide, 1 km wide, and
/// far from the origin.
fn regular(family: &Family, count: u64, seed: u64) {
    let (mut random, mut chance) = (Random(seed), Random(seed + 2));
    let (mut failed, mut open, mut stuck, mut times) = ([0; 4], 0, 0, Vec::new());
    for _ in 0..count {
        let rings = (family.make)(&mut random);
        let size = rings.iter().flatten().map(|at| at.abs().max_element()).fold(0.0, f64::max);
        let far = DVec2::new(1e6, -1.37e6);
        for (variant, failed) in failed.iter_mut().enumerate() {
            let scale = [1.0, 1.0 / size, 1000.0 / size, 1.0][variant];
            let offset = if variant == 3 { far } else { DVec2::ZERO };
            let place = |at: &DVec2| (*at * scale + offset).extend(0.0);
            let rings: Rings = rings.iter().map(|ring| ring.iter().map(place).collect()).collect();
            let Ok(plan) = Plan::new(&rings) else { continue };
            let (walls, paces) = (plan.flat(), vec![Pace::default(); plan.polygon().size()]);
            let begin = Instant::now();
            let found = Skeleton::new(&walls, &paces);
            if variant == 0 {
                times.push(begin.elapsed().as_secs_f64() * 1e6);
                open += usize::from(!is_closed(&rings));
                let paces = still(&mut chance).into_iter().map(|[speed, rest]| Pace { speed, rest });
                let paces: Vec<Pace> = paces.take(walls.size()).collect();
                stuck += usize::from(Skeleton::new(&walls, &paces).is_err());
            }
            *failed += usize::from(found.is_err());
        }
    }
    times.sort_by(f64::total_cmp);
    println!(
        "{}: {} plans, median {:.0} us; without a skeleton {}, 1 m wide {}, 1 km wide {}, 1,000 km away {}, \
         with edges that rest or stand still {stuck}; open {open}",
        family.name,
        times.len(),
        times[times.len() / 2],
        failed[0],
        failed[1],
        failed[2],
        failed[3],
    );
}

/// Returns true if walls and a hip roof over a footprint form a closed solid, in which no edge has more than two faces.
fn is_closed(rings: &Rings) -> bool {
    let table = |entries: &[(&str, Value)]| Table {
        class: None,
        entries: entries
            .iter()
            .map(|(name, value)| (TableKey::Name((*name).into()), value.clone()))
            .collect(),
    };
    let geometry = PolygonArgument(rings.clone()).into_value();
    let Ok(mut house) = Footprint::kind().make(&table(&[("geometry", geometry)])) else { return false };
    house.begin();
    // A self-crossing ring has been untangled; the test is whether it gets its roof.
    let untangled = house.notes().len();
    for (method, argument) in [
        ("groundwork", Value::Text("extruded".into())),
        ("walls", Value::Table(Arc::new(table(&[("height", Value::Number(3.0))])))),
        ("roof", Value::Table(Arc::new(table(&[("kind", Value::Text("hip".into()))])))),
    ] {
        let Some(Call::Write { values, .. }) = house.kind().method(method).map(|method| method.call.clone())
        else {
            return false;
        };
        if values(&mut *house, &[argument]).is_err() {
            return false;
        }
    }
    let replaced = house.notes().len() > untangled;
    let Some(drawing) = house.drawing_mut() else { return false };
    let mut uses: HashMap<[[u32; 3]; 2], u32> = HashMap::new();
    for part in drawing.parts() {
        let key = |corner: u32| (part.positions[corner as usize] + Vec3::ZERO).to_array().map(f32::to_bits);
        for triangle in part.triangles.iter() {
            for side in 0..3 {
                let [a, b] = [triangle[side], triangle[(side + 1) % 3]].map(key);
                *uses.entry([a.min(b), a.max(b)]).or_default() += 1;
            }
        }
    }
    !replaced && solid::check(drawing.parts()).is_solid() && uses.values().all(|uses| *uses == 2)
}

/// Returns the minimum of several times (s).
fn best(plan: &Polygon, rounds: u32) -> f64 {
    let paces = vec![Pace::default(); plan.size()];
    let time = |_| {
        let begin = Instant::now();
        assert!(Skeleton::new(plan, &paces).is_ok());
        begin.elapsed().as_secs_f64()
    };
    (0..rounds).map(time).fold(f64::INFINITY, f64::min)
}

fn comb(teeth: u32) -> Polygon {
    let mut ring = Vec::new();
    for tooth in 0..teeth {
        let x = 2.0 * f64::from(tooth);
        ring.extend([(x, 0.0), (x, -5.0), (x + 1.0, -5.0), (x + 1.0, 0.0)]);
    }
    ring.extend([(2.0 * f64::from(teeth) - 1.0, 5.0), (0.0, 5.0)]);
    // The first and the last tooth extend into the back.
    ring.remove(ring.len() - 3);
    ring.remove(0);
    around(ring.into_iter().map(DVec2::from).collect())
}

/// Returns a comb with about this number of edges.
fn comb_of(edges: u32) -> Polygon {
    comb(edges / 4)
}

/// Returns a star with random corners.
fn star(edges: u32) -> Polygon {
    let mut stream = burgeon::random::Stream::new(7);
    let mut corner = |index: u32| {
        let random = stream.uniform();
        let angle = std::f64::consts::TAU * f64::from(index) / f64::from(edges);
        DVec2::from_angle(angle) * (10.0 + 0.05 * f64::from(edges)) * (0.6 + 0.4 * random)
    };
    around((0..edges).map(&mut corner).collect())
}

fn around(ring: Vec<DVec2>) -> Polygon {
    Polygon::turned(vec![ring]).expect("a polygon")
}
