//! Thousands of geometries: intersecting footprints of a region, their union, hulls and buffers, and the nearest road
//! of every building of a town. `cargo bench --bench spatial`; it requires the data files next to the repository.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]
#![allow(clippy::unwrap_used, reason = "a bench stops at what is wrong")]

use std::path::{Path, PathBuf};
use std::time::Instant;

use burgeon_data::{Layer, Source, SourceOptions};
use burgeon_spatial::{BufferOptions, Geometry, union_all};
use rstar::primitives::{GeomWithData, Line, Rectangle};
use rstar::{AABB, RTree};

fn shared(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    if !path.exists() {
        println!("{name} is not there: left out");
        return None;
    }
    Some(path)
}

fn layer(path: &Path, name: &str) -> Layer {
    let wanted = SourceOptions { layer: Some(name.to_owned()), ..SourceOptions::default() };
    let table = Source::open(path, name).and_then(|source| source.read(name, &wanted)).unwrap();
    Layer::new(table, &mut None).unwrap()
}

fn timed<T>(what: &str, work: impl FnOnce() -> T, told: impl FnOnce(&T) -> String) -> T {
    let begin = Instant::now();
    let made = work();
    println!("{what:42} {:9.1} ms   {}", begin.elapsed().as_secs_f64() * 1e3, told(&made));
    made
}

fn main() {
    region();
    town();
}

/// Measures operations on the footprints of a region.
fn region() {
    let Some(path) = shared("france_buildings.gpkg") else { return };
    let layer = layer(&path, "buildings");
    let shapes: Vec<&Geometry> = layer.features.iter().map(|feature| &feature.geometry).collect();
    println!("{} footprints", shapes.len());
    let boxes = shapes.iter().enumerate().filter_map(|(index, shape)| {
        let [low, high] = shape.bounds()?;
        Some(GeomWithData::new(Rectangle::from_corners(low.to_array(), high.to_array()), index))
    });
    let boxes: Vec<_> = boxes.collect();
    let tree =
        timed("R-tree of their boxes", || RTree::bulk_load(boxes), |tree| format!("{} boxes", tree.size()));
    let pairs = timed(
        "pairs whose boxes meet",
        || {
            let mut pairs = Vec::new();
            for (index, shape) in shapes.iter().enumerate() {
                let Some([low, high]) = shape.bounds() else { continue };
                let around = AABB::from_corners(low.to_array(), high.to_array());
                let near = tree.locate_in_envelope_intersecting(&around).map(|other| other.data);
                pairs.extend(near.filter(|other| *other > index).map(|other| (index, other)));
            }
            pairs
        },
        |pairs| format!("{} pairs", pairs.len()),
    );
    let count = |what: &str, holds: fn(&Geometry, &Geometry) -> bool| {
        let work = || pairs.iter().filter(|(a, b)| holds(shapes[*a], shapes[*b])).count();
        timed(what, work, |count| format!("{count} of them"));
    };
    count("intersects", Geometry::intersects);
    count("touches", Geometry::touches);
    count("contains", Geometry::contains);
    let sum = |what: &str, make: fn(&Geometry, &Geometry) -> Geometry| {
        let work = || pairs.iter().map(|(a, b)| make(shapes[*a], shapes[*b])).collect::<Vec<_>>();
        timed(what, work, |made| {
            let area: f64 = made.iter().map(Geometry::area).sum();
            let length: f64 = made.iter().map(Geometry::length).sum();
            format!("{area:.1} m2 and {length:.1} m")
        });
    };
    sum("intersection", Geometry::intersection);
    sum("difference", Geometry::difference);
    sum("union", Geometry::union);
    timed("union of all", || union_all(shapes.iter().copied()), |made| format!("{:.1} m2", made.area()));
    let each = |what: &str, make: &dyn Fn(&Geometry) -> Geometry| {
        let work = || shapes.iter().map(|shape| make(shape).area()).sum::<f64>();
        timed(what, work, |area| format!("{area:.1} m2"));
    };
    each("convex hulls", &Geometry::convex_hull);
    each("oriented envelopes", &Geometry::oriented_envelope);
    each("round buffers of 3 m", &|shape| shape.buffer(3.0, &BufferOptions::default()).unwrap());
    each("simplified by 0.5 m", &|shape| shape.simplify(0.5));
    timed(
        "validity",
        || shapes.iter().filter(|shape| !shape.is_valid()).count(),
        |count| format!("{count} are not valid"),
    );
    timed(
        "well-known binary and back",
        || {
            shapes
                .iter()
                .filter(|shape| Geometry::from_wkb(&shape.to_wkb()).ok().as_ref() == Some(**shape))
                .count()
        },
        |count| format!("{count} the same"),
    );
}

/// Finds the nearest road of every building, by the segments of the roads.
fn town() {
    let Some(path) = shared("helsinki.gpkg") else { return };
    let source = Source::open(&path, "helsinki").unwrap();
    let names = source.layers();
    println!("helsinki: {}", names.join(", "));
    let Some(roads) = names.iter().find(|name| name.contains("road") || name.contains("street")) else {
        return;
    };
    let Some(buildings) = names.iter().find(|name| name.contains("building")) else { return };
    let (roads, buildings) = (layer(&path, roads), layer(&path, buildings));
    let tree = timed(
        "R-tree of the segments of roads",
        || {
            let segments = roads.features.iter().enumerate().flat_map(|(index, road)| {
                let ends = |segment: Geometry| {
                    let points: Vec<[f64; 2]> = segment.points().map(|at| at.truncate().to_array()).collect();
                    GeomWithData::new(Line::new(points[0], points[1]), index)
                };
                road.geometry.segments().into_iter().map(ends).collect::<Vec<_>>()
            });
            RTree::bulk_load(segments.collect())
        },
        |tree| format!("{} segments", tree.size()),
    );
    let centres: Vec<[f64; 2]> = buildings
        .features
        .iter()
        .filter_map(|it| it.geometry.centroid().points().next().map(|at| at.truncate().to_array()))
        .collect();
    let found = timed(
        "nearest road of every building",
        || {
            centres
                .iter()
                .filter_map(|at| tree.nearest_neighbor(at).map(|road| road.data))
                .collect::<Vec<_>>()
        },
        |found| format!("{} buildings", found.len()),
    );
    let sample: Vec<usize> = (0..found.len()).step_by(50).collect();
    let nearer = sample.iter().filter(|&&index| {
        let place = Geometry::point([centres[index][0], centres[index][1], 0.0]);
        let far = |road: usize| roads.features[road].geometry.distance(&place).unwrap();
        let best = (0..roads.features.len()).map(far).fold(f64::INFINITY, f64::min);
        far(found[index]) > best + 1e-9
    });
    assert_eq!(nearer.count(), 0, "a road is nearer than the one that was found");
}
