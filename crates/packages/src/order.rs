//! The order of packages: each after those that it depends on, and else by name.

use super::find::Package;

/// Packages that depend on each other in a circle, from one of them back to it.
pub(crate) type DependencyCircle = Vec<String>;

/// Sorts `packages`. Those of circles come last, by name.
pub(crate) fn sort(mut packages: Vec<Package>) -> (Vec<Package>, Vec<DependencyCircle>) {
    packages.sort_by(|a, b| a.manifest.name.cmp(&b.manifest.name));
    let mut sorted: Vec<Package> = Vec::with_capacity(packages.len());
    loop {
        let waits = |package: &Package| {
            let mut wanted = package.manifest.wanted();
            wanted.any(|wanted| packages.iter().any(|other| other.manifest.name == wanted.name))
        };
        // The first by name of those that wait for nobody.
        match packages.iter().position(|package| !waits(package)) {
            Some(next) => sorted.push(packages.remove(next)),
            None => break,
        }
    }
    let circles = circles(&packages);
    sorted.append(&mut packages);
    (sorted, circles)
}

/// A circle for each of `packages`, all of which wait for one another, that is in one; each circle once.
fn circles(packages: &[Package]) -> Vec<DependencyCircle> {
    let mut circles: Vec<DependencyCircle> = Vec::new();
    for package in packages {
        let start = &package.manifest.name;
        if circles.iter().any(|circle| circle.contains(start)) {
            continue;
        }
        // Breadth first, so that the circle is as short as can be.
        let mut ways = vec![vec![start.clone()]];
        let mut seen: Vec<&str> = Vec::new();
        let mut at = 0;
        'search: while at < ways.len() {
            let way = ways[at].clone();
            at += 1;
            let last = packages.iter().find(|known| Some(&known.manifest.name) == way.last());
            for wanted in last.into_iter().flat_map(|last| last.manifest.wanted()) {
                let next = || way.iter().cloned().chain([wanted.name.clone()]).collect::<Vec<_>>();
                if wanted.name == *start {
                    circles.push(next());
                    break 'search;
                }
                if !seen.contains(&&*wanted.name) {
                    seen.push(&wanted.name);
                    ways.push(next());
                }
            }
        }
    }
    circles
}
