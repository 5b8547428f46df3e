//! A connection to a server. Every wait for the server ends at the run's limits and at its own timeouts.

use std::future::{Future, poll_fn};
use std::pin::pin;
use std::sync::Arc;
use std::time::{Duration, Instant};

use futures_core::Stream;
use rustc_hash::FxHashMap;
use tokio::runtime::Runtime;
use tokio_postgres::{Client, Config, Statement};

use super::ServerAddress;
use super::cells::{BoundCell, ServerCell};
use super::encryption::Encryption;
use super::errors::{late, unreachable};
use super::numbered::{NumberedStatement, ParameterTypes, number_parameters};
use crate::sql::cell::{Cell, push_row};
use crate::sql::place::Move;
use burgeon_base::budget::{Budget, BudgetCharge};
use burgeon_base::error::{Error, Result};
use burgeon_kit::QueryRows;

/// Interval between two checks of the budget.
const PERIOD: Duration = Duration::from_millis(20);

/// Maximum time for a server to receive a cancellation.
const GRACE: Duration = Duration::from_millis(300);

/// Maximum time for a server to end a transaction.
const ENDING: Duration = Duration::from_secs(2);

/// Maximum number of prepared statements that a connection keeps.
const MOST_STATEMENTS: usize = 200;

/// A statement, the values of its parameters, and the transformation of geometries.
pub(super) struct AskedStatement<'a> {
    pub(super) sql: &'a str,
    /// Reference system of geometry parameters.
    pub(super) srid: u32,
    pub(super) given: &'a dyn Fn(&str) -> Result<Cell>,
    pub(super) place: &'a Move<'a>,
}

/// The rows of a result, and the cells that cannot be read, which are null in the rows.
pub(super) struct ServerAnswer {
    pub(super) rows: QueryRows<Cell>,
    pub(super) faults: Vec<CellFault>,
}

/// A geometry that cannot be read: its row and column, from 0, and the reason.
pub(super) struct CellFault {
    pub(super) row: usize,
    pub(super) column: usize,
    pub(super) why: String,
}

/// The reason for a failed query.
pub(super) enum ServerFailure {
    /// Error of Burgeon.
    Told(Error),
    /// Error of the server, and the statement that was sent.
    Server(tokio_postgres::Error, String),
}

impl From<Error> for ServerFailure {
    fn from(error: Error) -> Self {
        Self::Told(error)
    }
}

/// A connection, the runtime that drives it, and its prepared statements.
pub(super) struct ServerConnection {
    client: Client,
    statements: FxHashMap<String, Statement>,
    encryption: Encryption,
    address: ServerAddress,
    /// Runtime, present until the connection is dropped.
    runtime: Option<Runtime>,
}

impl Drop for ServerConnection {
    fn drop(&mut self) {
        // Does not wait for a pending name lookup.
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_background();
        }
    }
}

/// The reason why work on a connection did not finish.
enum WaitFailure {
    /// Limit of the run.
    Over(Error),
    /// Timeout of the connection.
    Late,
}

/// Drives a runtime until the work finishes, the budget is exceeded, or the time `most` has passed.
fn wait<T>(
    runtime: &Runtime,
    budget: Option<&Budget>,
    most: Duration,
    work: impl Future<Output = T>,
) -> std::result::Result<T, WaitFailure> {
    runtime.block_on(async {
        let begin = Instant::now();
        let mut work = pin!(work);
        loop {
            let left = most.saturating_sub(begin.elapsed());
            if let Ok(done) = tokio::time::timeout(PERIOD.min(left), work.as_mut()).await {
                return Ok(done);
            }
            budget.map_or(Ok(()), Budget::check).map_err(WaitFailure::Over)?;
            if begin.elapsed() >= most {
                return Err(WaitFailure::Late);
            }
        }
    })
}

impl ServerConnection {
    /// Connects within the time that the address and the budget allow.
    pub(super) fn new(
        config: &Config,
        address: &ServerAddress,
        budget: &Budget,
    ) -> std::result::Result<Self, ServerFailure> {
        let encryption = Encryption::new(address)?;
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()
            .map_err(|error| Error::system(format!("cannot wait for a server: {error}")))?;
        let most = address.connect_timeout;
        let connected = wait(&runtime, Some(budget), most, config.connect(encryption.clone()));
        let result = match connected {
            Ok(Ok((client, connection))) => {
                // An error that ends the connection is reported to the next query.
                runtime.spawn(async move { drop(connection.await) });
                return Ok(Self {
                    client,
                    statements: FxHashMap::default(),
                    encryption,
                    address: address.clone(),
                    runtime: Some(runtime),
                });
            }
            Ok(Err(error)) => unreachable(address, &error),
            Err(WaitFailure::Over(over)) => over.noting(&format!("waiting for {address}")),
            Err(WaitFailure::Late) => late(address, most, "connect_timeout"),
        };
        runtime.shutdown_background();
        Err(result.into())
    }

    /// Runs a statement and returns the rows. After a failure that is not caused by the statement, the connection is
    /// unusable.
    pub(super) fn ask(
        &mut self,
        asked: &AskedStatement<'_>,
        budget: &Arc<Budget>,
    ) -> std::result::Result<ServerAnswer, ServerFailure> {
        let Some(runtime) = self.runtime.take() else { return Err(closed_error().into()) };
        let most = self.address.answer_timeout.unwrap_or(Duration::MAX);
        let done = wait(&runtime, Some(&**budget), most, self.answer(asked, budget));
        let result = match done {
            Ok(done) => {
                if budget.check().is_err() {
                    self.cancel(&runtime);
                }
                done
            }
            Err(unfinished) => {
                self.cancel(&runtime);
                Err(match unfinished {
                    WaitFailure::Over(over) => over.noting(&format!("waiting for {}", self.address)),
                    WaitFailure::Late => late(&self.address, most, "answer_timeout"),
                }
                .into())
            }
        };
        self.runtime = Some(runtime);
        result
    }

    /// Asks the server to cancel the statement.
    fn cancel(&self, runtime: &Runtime) {
        let token = self.client.cancel_token();
        // The result does not matter: the connection is not used again.
        let _ = wait(runtime, None, GRACE, token.cancel_query(self.encryption.clone()));
    }

    /// Ends the transaction of a query. Returns true if the connection can be used again.
    pub(super) fn end(&mut self, done: bool, budget: &Budget) -> bool {
        let Some(runtime) = &self.runtime else { return false };
        let sql = if done { "COMMIT" } else { "ROLLBACK" };
        matches!(wait(runtime, Some(budget), ENDING, self.client.batch_execute(sql)), Ok(Ok(())))
    }

    async fn answer(
        &mut self,
        asked: &AskedStatement<'_>,
        budget: &Arc<Budget>,
    ) -> std::result::Result<ServerAnswer, ServerFailure> {
        let AskedStatement { sql, srid, given, place } = *asked;
        // The mode of a transaction can be changed until its first query.
        let failed = |error, sql: &str| ServerFailure::Server(error, sql.to_owned());
        let begin = "BEGIN READ ONLY; SELECT 1";
        self.client.batch_execute(begin).await.map_err(|error| failed(error, ""))?;
        let value = |name: &str| given(name).ok();
        let inferred = number_parameters(sql, ParameterTypes::Inferred, srid, value);
        let cells = |names: &[String]| -> Result<Vec<BoundCell>> {
            names.iter().map(|name| Ok(BoundCell(place.bring_out(given(name)?)))).collect()
        };
        let bound = cells(&inferred.names)?;
        let prepared = self.prepare(&inferred).await;
        // If the server cannot infer the types, or infers types that do not fit the values, they are specified
        // explicitly.
        let fits =
            |statement: &Statement| statement.params().iter().zip(&bound).all(|(kind, cell)| cell.fits(kind));
        let (statement, written) = match prepared {
            Ok(statement) if fits(&statement) => (statement, inferred),
            other => {
                if other.is_err() {
                    let again = "ROLLBACK; BEGIN READ ONLY; SELECT 1";
                    self.client.batch_execute(again).await.map_err(|error| failed(error, ""))?;
                }
                let explicit = number_parameters(sql, ParameterTypes::Told, srid, value);
                match (self.prepare(&explicit).await, other) {
                    (Ok(statement), _) => (statement, explicit),
                    (Err(_), Err(first)) => return Err(failed(first, &inferred.sql)),
                    (Err(error), _) => return Err(failed(error, &explicit.sql)),
                }
            }
        };
        let names: Vec<Arc<str>> = statement.columns().iter().map(|column| column.name().into()).collect();
        let width = names.len();
        let mut answer = ServerAnswer { rows: QueryRows::new(names, []), faults: Vec::new() };
        answer.rows.charge = BudgetCharge::new(budget);
        let rows = self.client.query_raw(&statement, bound.iter()).await;
        let mut rows = pin!(rows.map_err(|error| failed(error, &written.sql))?);
        while let Some(row) = poll_fn(|context| rows.as_mut().poll_next(context)).await {
            let row = row.map_err(|error| failed(error, &written.sql))?;
            let number = answer.rows.len();
            let cell = |index: usize| {
                let cell: ServerCell = row.try_get(index).map_err(|error| {
                    use std::error::Error as _;
                    let why = error.source().map_or_else(|| error.to_string(), ToString::to_string);
                    let column = row.columns().get(index).map_or("", |column| column.name());
                    Error::data(format!("SQL: the column {column} {why}"))
                        .help("ask for numbers, texts, true or false, geometries, or lists of them")
                })?;
                Ok(match cell {
                    ServerCell::Cell(cell) => place.bring_in(cell),
                    ServerCell::Unreadable(why) => {
                        budget.take(64 + why.len())?;
                        answer.faults.push(CellFault { row: number, column: index, why });
                        Cell::Null
                    }
                })
            };
            let cells = (0..width).map(cell).collect::<Result<_>>()?;
            push_row(&mut answer.rows, cells)?;
        }
        Ok(answer)
    }

    async fn prepare(
        &mut self,
        statement: &NumberedStatement,
    ) -> std::result::Result<Statement, tokio_postgres::Error> {
        if let Some(known) = self.statements.get(&statement.sql) {
            return Ok(known.clone());
        }
        let prepared = self.client.prepare(&statement.sql).await?;
        if self.statements.len() >= MOST_STATEMENTS {
            self.statements.clear();
        }
        self.statements.insert(statement.sql.clone(), prepared.clone());
        Ok(prepared)
    }
}

fn closed_error() -> Error {
    Error::internal("the connection to the database has ended")
}
