//! The state that the functions of a connection share: the budget of the statement, the spatial indexes, and geometries
//! that were read recently.

use std::collections::BTreeMap;
use std::hash::BuildHasher as _;
use std::panic::{RefUnwindSafe, UnwindSafe};
use std::sync::{Arc, Mutex, RwLock};

use rustc_hash::FxBuildHasher;

use super::argument::GeometryArgument;
use crate::sql::index::SpatialIndex;
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_base::locks::LockRecovery;
use burgeon_spatial::ReferenceFrame;

/// The spatial indexes of all tables, by table and column.
pub(crate) type Indexes = RwLock<BTreeMap<String, Arc<SpatialIndex>>>;

/// The state that the functions of a connection share.
pub(crate) struct ConnectionState {
    /// Budget of the running statement.
    budget: Mutex<Arc<Budget>>,
    /// Indexes of the tables.
    pub indexes: Arc<Indexes>,
    /// Indexes of materialized subqueries.
    pub own_indexes: Mutex<BTreeMap<String, Arc<SpatialIndex>>>,
    /// Geometries that were read recently: an outer loop requests the same geometries repeatedly, and so do their
    /// neighbours.
    recent: Mutex<RecentGeometries>,
    /// Last blob that is not a geometry.
    unreadable: Mutex<Option<Vec<u8>>>,
    /// Set while Burgeon runs its own statements.
    pub trusted: Mutex<bool>,
    /// Projection of the run, in whose coordinates the tables are.
    pub frame: Option<ReferenceFrame>,
    /// Clusters that the statement has computed so far, by row of a partition.
    pub clusters: Mutex<Vec<Vec<Option<u32>>>>,
}

impl UnwindSafe for ConnectionState {}
impl RefUnwindSafe for ConnectionState {}

/// Number of small geometries that are cached, each at an index hashed from its bytes.
const SMALL_GEOMETRIES: usize = 256;

/// Maximum length (bytes) of a small geometry's blob.
const LONGEST_SMALL: usize = 2048;

/// A blob and the geometry read from it.
type KeptGeometry = Option<(Vec<u8>, Arc<GeometryArgument>)>;

#[derive(Default)]
struct RecentGeometries {
    /// Last two large geometries.
    large: [KeptGeometry; 2],
    next: usize,
    small: Vec<KeptGeometry>,
}

impl RecentGeometries {
    /// Returns the cache entry for a blob.
    fn place(&mut self, bytes: &[u8]) -> &mut KeptGeometry {
        if bytes.len() <= LONGEST_SMALL {
            self.small.resize(SMALL_GEOMETRIES, None);
            let hash = FxBuildHasher.hash_one(bytes);
            #[allow(clippy::cast_possible_truncation, reason = "any of its bits will do")]
            return &mut self.small[hash as usize % SMALL_GEOMETRIES];
        }
        let known = self.large.iter().position(|it| it.as_ref().is_some_and(|(known, _)| known == bytes));
        let place = known.unwrap_or_else(|| {
            self.next = (self.next + 1) % self.large.len();
            self.next
        });
        &mut self.large[place]
    }
}

impl ConnectionState {
    /// Creates the state of a connection that uses these indexes.
    pub(crate) fn new(indexes: &Arc<Indexes>, frame: Option<&ReferenceFrame>) -> Self {
        Self {
            budget: Mutex::default(),
            indexes: Arc::clone(indexes),
            own_indexes: Mutex::default(),
            recent: Mutex::default(),
            unreadable: Mutex::default(),
            trusted: Mutex::new(false),
            frame: frame.cloned(),
            clusters: Mutex::default(),
        }
    }

    /// Returns the budget of the running statement.
    pub(crate) fn budget(&self) -> Arc<Budget> {
        Arc::clone(&self.budget.lock().recover())
    }

    /// Sets the budget of the next statement.
    pub(crate) fn give(&self, budget: &Arc<Budget>) {
        *self.budget.lock().recover() = Arc::clone(budget);
        self.clusters.lock().recover().clear();
    }

    /// Returns the geometry in a blob. Fails with the reason.
    pub(crate) fn geometry(&self, bytes: &[u8]) -> Result<Arc<GeometryArgument>, String> {
        let mut recent = self.recent.lock().recover();
        let (_, parsed) = match recent.place(bytes) {
            Some(known) if known.0 == bytes => known,
            place => {
                let read = GeometryArgument::read(bytes, &self.budget());
                let parsed = read.inspect_err(|_| self.keep_unreadable(bytes))?;
                place.insert((bytes.to_vec(), Arc::new(parsed)))
            }
        };
        Ok(Arc::clone(parsed))
    }

    /// Stores a blob that is not a geometry, so that an error can name its row, if there is memory for it.
    pub(crate) fn keep_unreadable(&self, bytes: &[u8]) {
        if self.budget().hold(bytes.len()).is_err() {
            return;
        }
        *self.unreadable.lock().recover() = Some(bytes.to_vec());
    }

    /// Takes the last blob that is not a geometry.
    pub(crate) fn take_unreadable(&self) -> Option<Vec<u8>> {
        self.unreadable.lock().recover().take()
    }
}
