//! Plans of a source's polygons, computed ahead while a script processes earlier features.
//!
//! A script's function creates the footprints of a source one by one, on one thread, and most of the work is computing
//! their plans. So another thread computes the plans of the next features. If a plan is not ready in time, the script's
//! thread computes it. The result is the same on either thread.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard};

use glam::DVec3;

use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_geometry::{Plan, Rings};
use burgeon_kit::{Object, Prefetch};
use burgeon_spatial::{GeometryList, rings};

/// Maximum number of plans that are kept ready before the thread pauses.
const READY: usize = 256;
/// Number of plans that are computed at a time, so that the threads rarely wait for each other.
const BATCH: usize = 16;

/// A plan near its own origin.
#[derive(Debug, Clone)]
pub(super) struct LocalPlan {
    pub plan: Arc<Plan>,
    /// Position of the origin (m): whole metres near the plan.
    pub origin: DVec3,
}

impl LocalPlan {
    /// Computes the plan of `rings`, or an empty plan if there are no rings.
    pub(super) fn new(rings: &Rings) -> Result<Self> {
        if rings.is_empty() {
            return Ok(Self { plan: Arc::default(), origin: DVec3::ZERO });
        }
        let plan = Plan::new(rings).map_err(Error::of_data)?;
        let [low, high] = plan.polygon().bounds().unwrap_or_default();
        let origin = low.midpoint(high).extend(plan.ground().0).floor();
        Ok(Self { plan: Arc::new(plan.moved(-origin)), origin })
    }
}

/// Plans of a layer's polygons, computed ahead.
pub(super) struct PlanPrefetch {
    features: Arc<dyn Object>,
    state: Mutex<PrefetchState>,
    changed: Condvar,
}

#[derive(Default)]
struct PrefetchState {
    /// Feature whose plan was requested last, if any.
    asked: Option<usize>,
    /// Plans by feature, in the order of the features.
    made: VecDeque<(usize, Result<LocalPlan>)>,
    /// Set while a thread waits to continue.
    waits: bool,
    /// Set once no more plans will be requested.
    over: bool,
}

impl PlanPrefetch {
    /// Prepares the plans of `features`, if they are a list of geometries.
    pub(super) fn new(features: &Arc<dyn Object>) -> Option<Self> {
        features.capability::<dyn GeometryList>()?;
        Some(Self { features: Arc::clone(features), state: Mutex::default(), changed: Condvar::new() })
    }

    /// Takes the plan of the feature with this number, if it has been computed.
    pub(super) fn take(&self, number: usize) -> Option<Result<LocalPlan>> {
        let mut state = self.state();
        state.asked = Some(number);
        while state.made.front().is_some_and(|(made, _)| *made < number) {
            state.made.pop_front();
        }
        // Waking a thread takes longer than checking that one waits.
        if state.waits && state.made.len() < READY / 2 {
            self.changed.notify_one();
        }
        let there = state.made.front().is_some_and(|(made, _)| *made == number);
        if there { state.made.pop_front().map(|(_, plan)| plan) } else { None }
    }

    fn state(&self) -> MutexGuard<'_, PrefetchState> {
        self.state.lock().recover()
    }
}

impl Prefetch for PlanPrefetch {
    fn work(&self) {
        let Some(features) = self.features.capability::<dyn GeometryList>() else { return };
        let mut next = 0;
        let mut state = self.state();
        loop {
            while !state.over && (state.asked.is_none() || state.made.len() >= READY) {
                state.waits = true;
                state = self.changed.wait(state).recover();
                state.waits = false;
            }
            next = next.max(state.asked.map_or(0, |asked| asked + 1));
            if state.over || next >= features.count() {
                return;
            }
            drop(state);
            let numbers = next..features.count().min(next + BATCH);
            next = numbers.end;
            let plan = |number: usize| Some((number, LocalPlan::new(rings(features.geometry(number)?)?)));
            let made: Vec<_> = numbers.filter_map(plan).collect();
            state = self.state();
            state.made.extend(made);
        }
    }

    fn end(&self) {
        self.state().over = true;
        self.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_data::{Feature, Features, Layer};
    use burgeon_geometry::{Polygon, Rings};
    use burgeon_spatial::Geometry;

    /// Returns squares on a line, every seventh of which has no area.
    fn squares(count: u32) -> Arc<Layer> {
        let square = |number: u32| {
            let (x, size) = (10.0 * f64::from(number), if number.is_multiple_of(7) { 0.0 } else { 4.0 });
            let ring = [[x, 0.0, 1.0], [x + 4.0, 0.0, 1.0], [x + 4.0, size, 1.0], [x, size, 1.0]];
            let geometry = Geometry::Polygon(Rings(vec![ring.map(DVec3::from).to_vec()]));
            Feature { id: number.to_string().as_str().into(), geometry, attributes: Arc::default() }
        };
        Arc::new(Layer {
            name: String::new(),
            shown: String::new(),
            crs: String::new(),
            origin: [0.0; 2],
            names: Vec::new(),
            features: (0..count).map(square).collect(),
            bounds: [[0.0; 3]; 2],
            empty: 0,
            collapsed: 0,
            refused: Vec::new(),
            notes: Vec::new(),
            derived: 0,
        })
    }

    fn prefetch(layer: &Arc<Layer>) -> PlanPrefetch {
        let features: Arc<dyn Object> = Arc::new(Features(Arc::clone(layer)));
        PlanPrefetch::new(&features).expect("features have geometries")
    }

    fn told(plan: Result<LocalPlan>) -> Result<(Polygon<DVec3>, DVec3), String> {
        plan.map(|made| (made.plan.polygon().clone(), made.origin)).map_err(|error| error.to_string())
    }

    #[test]
    fn what_is_made_ahead_is_what_would_be_made_in_its_place() {
        let layer = squares(1000);
        let ahead = prefetch(&layer);
        let mut ready = 0;
        std::thread::scope(|scope| {
            scope.spawn(|| ahead.work());
            // The numbers skip some features and repeat others, as a script may.
            for number in (0..1000).filter(|number| number % 5 != 0).chain([9, 8]) {
                let Some(plan) = ahead.take(number) else {
                    std::thread::sleep(std::time::Duration::from_millis(1));
                    continue;
                };
                ready += 1;
                let here = LocalPlan::new(rings(&layer.features[number].geometry).unwrap());
                assert_eq!(told(plan), told(here), "{number}");
                assert!(ahead.state().made.len() < READY + BATCH);
            }
            ahead.end();
        });
        assert!(ready > 0);
    }

    #[test]
    fn nothing_is_made_that_nobody_asks_for() {
        let ahead = prefetch(&squares(20));
        std::thread::scope(|scope| {
            let working = scope.spawn(|| ahead.work());
            std::thread::sleep(std::time::Duration::from_millis(5));
            assert!(ahead.state().made.is_empty() && !working.is_finished());
            ahead.end();
        });
    }
}
