//! Straight skeletons: time for each building of a real town, for a comb of 400 teeth, and how time grows with the
//! number of edges. `cargo bench --bench skeleton`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::path::Path;
use std::time::Instant;

use burgeon::geometry::Plan;
use burgeon::geometry::skeleton::{Pace, Skeleton};
use burgeon::sources::{Geometry, Layer, Source, Wanted};
use glam::{DVec2, DVec3};

type Rings = Vec<Vec<DVec2>>;

fn main() {
    match town() {
        Some(plans) => each(&plans),
        None => println!("skipped: there is no ../shared/data/france_buildings.gpkg"),
    }
    let comb = best(&comb(400), 10);
    println!("a comb of 400 teeth: {:.1} ms (asked: less than 50 ms)", comb * 1e3);
    for (name, make) in [("combs", comb_of as fn(u32) -> Rings), ("stars", star)] {
        let sizes = [10, 30, 100, 300, 1000, 2000, 4000];
        let times: Vec<(f64, f64)> = sizes
            .iter()
            .map(|&size| {
                let rings = make(size);
                let edges = rings[0].len();
                let time = best(&rings, if edges < 1000 { 50 } else { 5 });
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

/// The buildings of a real town, if its file is beside the repository.
fn town() -> Option<Vec<Rings>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/france_buildings.gpkg");
    let wanted = Wanted { layer: Some("buildings".into()), ..Wanted::default() };
    let table = Source::open(&path, "france").ok()?.read("france", &wanted).ok()?;
    let layer = Layer::new(table, &mut None).ok()?;
    let plan = |feature: &burgeon::sources::Feature| {
        let Geometry::Polygon(rings) = &feature.geometry else { return None };
        let rings: Vec<Vec<DVec3>> =
            rings.iter().map(|ring| ring.iter().map(|&at| DVec3::from(at)).collect()).collect();
        Some(Plan::new(&rings).ok()?.flat())
    };
    Some(layer.features.iter().filter_map(plan).collect())
}

fn each(plans: &[Rings]) {
    let mut times = Vec::with_capacity(plans.len());
    let (mut moved, mut failed) = (0, 0);
    for rings in plans {
        let paces = vec![Pace::default(); rings.iter().map(Vec::len).sum()];
        let begin = Instant::now();
        let found = Skeleton::new(rings, &paces);
        times.push(begin.elapsed().as_secs_f64() * 1e6);
        moved += u32::from(found.as_ref().is_ok_and(|skeleton| skeleton.moved));
        failed += u32::from(found.is_err());
    }
    times.sort_by(f64::total_cmp);
    let (median, p99) = (times[times.len() / 2], times[times.len() * 99 / 100]);
    println!(
        "{} buildings: median {median:.1} us (asked: less than 20 us), 99th percentile {p99:.1} us",
        plans.len()
    );
    println!("moved by up to 5 mm: {moved}, without a skeleton: {failed}");
}

/// The shortest of several times (s).
fn best(rings: &Rings, rounds: u32) -> f64 {
    let paces = vec![Pace::default(); rings[0].len()];
    let time = |_| {
        let begin = Instant::now();
        assert!(Skeleton::new(rings, &paces).is_ok());
        begin.elapsed().as_secs_f64()
    };
    (0..rounds).map(time).fold(f64::INFINITY, f64::min)
}

fn comb(teeth: u32) -> Rings {
    let mut ring = Vec::new();
    for tooth in 0..teeth {
        let x = 2.0 * f64::from(tooth);
        ring.extend([(x, 0.0), (x, -5.0), (x + 1.0, -5.0), (x + 1.0, 0.0)]);
    }
    ring.extend([(2.0 * f64::from(teeth) - 1.0, 5.0), (0.0, 5.0)]);
    // The first and the last tooth go on into the back.
    ring.remove(ring.len() - 3);
    ring.remove(0);
    vec![ring.into_iter().map(DVec2::from).collect()]
}

/// A comb of about so many edges.
fn comb_of(edges: u32) -> Rings {
    comb(edges / 4)
}

/// A star whose corners are anywhere.
fn star(edges: u32) -> Rings {
    let mut state = 7u64;
    let mut corner = |index: u32| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[allow(clippy::cast_precision_loss, reason = "a random number needs no more")]
        let random = (state >> 33) as f64 / (1u64 << 31) as f64;
        let angle = std::f64::consts::TAU * f64::from(index) / f64::from(edges);
        DVec2::from_angle(angle) * (10.0 + 0.05 * f64::from(edges)) * (0.6 + 0.4 * random)
    };
    vec![(0..edges).map(&mut corner).collect()]
}
