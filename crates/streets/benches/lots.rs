//! Benchmark of lots and sites in networks of 1,000 to 100,000 segments, and of lots in thousands of random areas.
//!
//! `cargo bench -p burgeon-streets --bench lots`

#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a bench tells what it found, and may panic")]

mod grown;

use std::collections::HashSet;
use std::time::Instant;

use burgeon_geometry::Rings;
use burgeon_geometry::planar::twice_area;
use burgeon_streets::{
    Constraints, Lot, LotOptions, LotPattern, LotUse, Obstacles, SiteOptions, StreetBlock, StreetNetwork,
    SurfaceOptions,
};
use glam::DVec2;
use grown::{Numbers, grown};

/// Returns true if the lots fill their block: the areas add up, and each edge has a lot on both sides or is on the
/// border.
fn check(block: &StreetBlock, lots: &[Lot]) {
    let area = |rings: &Rings<DVec2>| -> f64 {
        rings.iter().map(|ring| twice_area(ring.iter().copied()) / 2.0).sum()
    };
    let whole = area(&block.rings);
    let sum: f64 = lots.iter().map(|lot| lot.area).sum();
    assert!((sum - whole).abs() <= 1e-6 * whole.max(1.0), "{sum} m² of {whole} m²");
    let bits = |at: DVec2| [at.x.to_bits(), at.y.to_bits()];
    let mut edges = HashSet::new();
    for lot in lots {
        assert!(lot.area > 0.0);
        for [a, b] in
            lot.rings.iter().flat_map(|ring| burgeon_geometry::planar::edges(ring).collect::<Vec<_>>())
        {
            assert!(edges.insert([bits(a), bits(b)]), "two lots are on one side of an edge");
        }
    }
    let lone = edges.iter().filter(|[a, b]| !edges.contains(&[*b, *a])).count();
    assert!(lone >= block.rings.iter().map(Vec::len).sum(), "the border is missing");
}

fn main() {
    for size in [1000, 10_000, 100_000] {
        let (network, _) = grown(size);
        let begin = Instant::now();
        let blocks = network.lot_blocks(SurfaceOptions::default());
        println!("{} pieces: {} blocks in {:.1?}", network.size(), blocks.len(), begin.elapsed());
        for (name, pattern) in LotPattern::ALL {
            let options = LotOptions { pattern, ..LotOptions::new(18.0, 28.0) };
            let mut random = Numbers(99);
            let begin = Instant::now();
            let lots: Vec<Vec<Lot>> =
                blocks.iter().map(|block| block.divide(&options, &mut || random.below(1.0))).collect();
            let time = begin.elapsed();
            blocks.iter().zip(&lots).for_each(|(block, lots)| check(block, lots));
            let all = || lots.iter().flatten();
            let count = all().filter(|lot| lot.purpose == LotUse::Building).count();
            let part = |purpose: LotUse| {
                let area = |lot: &Lot| if lot.purpose == purpose { lot.area } else { 0.0 };
                100.0 * all().map(area).sum::<f64>() / all().map(|lot| lot.area).sum::<f64>()
            };
            let each = time.as_secs_f64() * 1e6 / count as f64;
            println!(
                "  {name}: {count} lots in {time:.2?}, {each:.1} µs each; {:.1} % of the area, courts {:.1} %, rest {:.2} %",
                part(LotUse::Building),
                part(LotUse::Court),
                part(LotUse::Rest)
            );
        }
        let options = SiteOptions {
            sizes: vec![DVec2::new(24.0, 20.0), DVec2::new(16.0, 14.0), DVec2::new(10.0, 10.0)],
            along: 6.0,
            away: 18.0,
            distance: 24.0,
            setback: 2.0,
            gap: 3.0,
            shrink: 0.5,
        };
        let begin = Instant::now();
        let mut stream = |name: &str| -> Box<dyn FnMut() -> f64> {
            let mut own =
                Numbers(name.bytes().fold(7_u64, |sum, byte| sum.wrapping_mul(31) + u64::from(byte)) | 1);
            Box::new(move || own.below(1.0))
        };
        let found = network.sites(SurfaceOptions::default(), &options, &mut stream).unwrap();
        let each = found.looked_at as f64 / found.tried as f64;
        println!(
            "  {} sites of {} places in {:.2?}; {each:.1} edges and sites looked at for each place",
            found.sites.len(),
            found.tried,
            begin.elapsed()
        );
    }
    let empty = StreetNetwork::new(Constraints::default(), Obstacles::default()).unwrap();
    let mut random = Numbers(5);
    let begin = Instant::now();
    let (mut areas, mut count) = (0, 0);
    for number in 0..6000 {
        let corners = 3 + random.below(20.0) as usize;
        let size = [8.0, 40.0, 120.0, 500.0][number % 4];
        let ring = (0..corners).map(|corner| {
            let way = (corner as f64 + random.below(0.8)) / corners as f64 * std::f64::consts::TAU;
            DVec2::from_angle(way) * size * (0.25 + random.below(0.75))
        });
        let rings = Rings(vec![ring.collect()]);
        let Some(block) = empty.block(None, &rings, 6.0) else { continue };
        let usual = LotOptions::new(8.0 + random.below(20.0), 15.0 + random.below(30.0));
        let options = LotOptions { pattern: LotPattern::ALL[number / 4 % 3].1, ..usual };
        let lots = block.divide(&options, &mut || random.below(1.0));
        check(&block, &lots);
        areas += 1;
        count += lots.len();
    }
    println!(
        "{areas} areas at random: {count} lots in {:.2?}, all of which fill their area",
        begin.elapsed()
    );
}
