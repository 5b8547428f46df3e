//! Dependency order of packages: each after its dependencies, and otherwise by name.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use super::manifest::Dependency;
use super::package::Package;

/// Cycle of packages that depend on each other, from one of them back to itself.
pub(crate) type DependencyCircle = Vec<String>;

/// Sorts `packages`, each after its required dependencies and its available optional ones.
///
/// Optional dependencies within a group of packages that depend on each other are ignored, so such packages may name
/// one another. Packages in cycles of required dependencies come last, by name, and so do the packages that require
/// them.
pub(crate) fn sort(mut packages: Vec<Package>) -> (Vec<Package>, Vec<DependencyCircle>) {
    packages.sort_by(|a, b| a.manifest.name.cmp(&b.manifest.name));
    let graph = DependencyGraph::new(&packages);
    let (order, waiting) = graph.order();
    let circles = graph.circles(&waiting, &packages);
    let mut taken: Vec<Option<Package>> = packages.into_iter().map(Some).collect();
    let sorted = order.into_iter().chain(waiting).filter_map(|place| taken[place].take()).collect();
    (sorted, circles)
}

/// Dependency graph of packages, indexed by the order of their names.
struct DependencyGraph {
    /// Required dependencies.
    needed: Vec<Vec<usize>>,
    /// Required and optional dependencies.
    wanted: Vec<Vec<usize>>,
}

impl DependencyGraph {
    fn new(packages: &[Package]) -> Self {
        let places: BTreeMap<&str, usize> =
            packages.iter().enumerate().map(|(place, it)| (it.manifest.name.as_str(), place)).collect();
        let of = |list: &[Dependency]| -> Vec<usize> {
            list.iter().filter_map(|one| places.get(one.name.as_str()).copied()).collect()
        };
        let needed: Vec<Vec<usize>> = packages.iter().map(|it| of(&it.manifest.depends)).collect();
        let wanted = packages.iter().zip(&needed).map(|(it, needed)| {
            let optional = of(&it.manifest.optional);
            needed.iter().copied().chain(optional).collect()
        });
        Self { wanted: wanted.collect(), needed }
    }

    /// Returns the sorted indices, and the indices of packages in cycles or with dependencies in cycles, by name.
    fn order(&self) -> (Vec<usize>, Vec<usize>) {
        // An optional dependency that has no order itself is ignored.
        let needed = self.needed.iter().map(|needed| needed.iter().copied().collect());
        let (_, lost) = sort_topologically(&needed.collect::<Vec<_>>());
        let lost: BTreeSet<usize> = lost.into_iter().collect();
        let group = groups(&self.wanted);
        let before = (0..self.needed.len()).map(|place| {
            let counts = |other: &&usize| group[**other] != group[place] && !lost.contains(other);
            let optional = self.wanted[place].iter().filter(counts);
            self.needed[place].iter().chain(optional).copied().collect()
        });
        sort_topologically(&before.collect::<Vec<_>>())
    }

    /// Returns the shortest cycle of each group of `waiting` packages that require each other.
    fn circles(&self, waiting: &[usize], packages: &[Package]) -> Vec<DependencyCircle> {
        let group = groups(&self.needed);
        let mut known = BTreeSet::new();
        let name = |place: &usize| packages[*place].manifest.name.clone();
        let mut circles = Vec::new();
        for start in waiting {
            if known.contains(&group[*start]) {
                continue;
            }
            if let Some(circle) = self.circle(*start) {
                known.insert(group[*start]);
                circles.push(circle.iter().map(name).collect());
            }
        }
        circles
    }

    /// Returns the shortest path from `start` back to `start`.
    fn circle(&self, start: usize) -> Option<Vec<usize>> {
        let mut from: BTreeMap<usize, usize> = BTreeMap::new();
        let mut next = VecDeque::from([start]);
        while let Some(place) = next.pop_front() {
            for other in &self.needed[place] {
                if *other == start {
                    let mut way = vec![start, place];
                    let mut at = place;
                    while at != start {
                        at = from[&at];
                        way.push(at);
                    }
                    way.reverse();
                    // A package that requires itself occurs twice in succession.
                    way.dedup();
                    if way.len() == 1 {
                        way.push(start);
                    }
                    return Some(way);
                }
                if !from.contains_key(other) {
                    from.insert(*other, place);
                    next.push_back(*other);
                }
            }
        }
        None
    }
}

/// Sorts the indices topologically, each after those `before` it and otherwise by number. Also returns the indices in
/// cycles and those that depend on them.
fn sort_topologically(before: &[BTreeSet<usize>]) -> (Vec<usize>, Vec<usize>) {
    let mut waits: Vec<usize> = before.iter().map(BTreeSet::len).collect();
    let mut followers: Vec<Vec<usize>> = vec![Vec::new(); before.len()];
    for (place, before) in before.iter().enumerate() {
        before.iter().for_each(|other| followers[*other].push(place));
    }
    let mut ready: BTreeSet<usize> = (0..before.len()).filter(|place| waits[*place] == 0).collect();
    let mut order = Vec::with_capacity(before.len());
    while let Some(place) = ready.pop_first() {
        order.push(place);
        for follower in &followers[place] {
            waits[*follower] -= 1;
            if waits[*follower] == 0 {
                ready.insert(*follower);
            }
        }
    }
    (order, (0..before.len()).filter(|place| waits[*place] > 0).collect())
}

/// Computes the strongly connected component of each index.
///
/// Method: R. Tarjan, "Depth-first search and linear graph algorithms", 1972, without recursion.
fn groups(edges: &[Vec<usize>]) -> Vec<usize> {
    const NONE: usize = usize::MAX;
    let count = edges.len();
    let (mut index, mut low, mut group) = (vec![NONE; count], vec![0; count], vec![NONE; count]);
    let (mut stack, mut numbered, mut found) = (Vec::new(), 0, 0);
    for root in 0..count {
        if index[root] != NONE {
            continue;
        }
        let mut open = vec![(root, 0)];
        while let Some((place, at)) = open.last().copied() {
            if at == 0 {
                index[place] = numbered;
                low[place] = numbered;
                numbered += 1;
                stack.push(place);
            }
            if let Some(&other) = edges[place].get(at) {
                if let Some(top) = open.last_mut() {
                    top.1 += 1;
                }
                if index[other] == NONE {
                    open.push((other, 0));
                } else if group[other] == NONE {
                    low[place] = low[place].min(index[other]);
                }
                continue;
            }
            open.pop();
            if let Some((above, _)) = open.last() {
                low[*above] = low[*above].min(low[place]);
            }
            if low[place] == index[place] {
                while let Some(member) = stack.pop() {
                    group[member] = found;
                    if member == place {
                        break;
                    }
                }
                found += 1;
            }
        }
    }
    group
}
