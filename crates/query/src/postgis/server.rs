//! A server: its connections, its tables, and what is asked of it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Duration;

use postgres::fallible_iterator::FallibleIterator;
use postgres::{Client, Config, NoTls, Statement};
use rustc_hash::FxHashMap;

use super::ServerAddress;
use super::cells::{BoundCell, COME_AS_THEY_ARE, ServerCell};
use super::errors::{is_lost, server_error, unreachable};
use super::numbered::{NumberedStatement, ParameterTypes, numbered};
use crate::cell::{Cell, QueryAnswer};
use crate::errors;
use crate::place::Move;
use crate::rewrite::{self, Catalogue, ChosenRows, Dialect, TableInfo, find_word};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::text::shown;
use burgeon_data::{Crs, ReferenceFrame};

/// How long a connection may take to come about.
const PATIENCE: Duration = Duration::from_secs(10);

/// How long a server may be silent behind a line that is dead.
const SILENCE: Duration = Duration::from_secs(30);

/// How often is looked whether a question is to end.
const PERIOD: Duration = Duration::from_millis(20);

/// How many connections are kept.
const MOST_IDLE: usize = 16;

/// How many prepared statements a connection keeps.
const MOST_STATEMENTS: usize = 200;

/// The tables of the server that its user sees without naming a schema: columns, keys and how many rows there may be.
const TABLES: &str = "SELECT c.oid::int8, c.relname::text, a.attname::text, coalesce(b.typname, t.typname)::text, greatest(c.reltuples, 0)::float8, \
    EXISTS (SELECT 1 FROM pg_index i WHERE i.indrelid = c.oid AND i.indisprimary AND i.indnatts = 1 AND a.attnum = ANY (i.indkey)), \
    CASE WHEN t.typname = 'geometry' THEN postgis_typmod_srid(a.atttypmod) END, t.typtype = 'e' \
    FROM pg_class c JOIN pg_attribute a ON a.attrelid = c.oid JOIN pg_type t ON t.oid = a.atttypid \
    LEFT JOIN pg_type b ON t.typtype = 'd' AND b.oid = t.typbasetype \
    JOIN pg_namespace n ON n.oid = c.relnamespace \
    WHERE c.relkind IN ('r', 'v', 'm', 'p', 'f') AND a.attnum > 0 AND NOT a.attisdropped AND pg_table_is_visible(c.oid) \
    AND n.nspname NOT LIKE 'pg\\_%' AND n.nspname <> 'information_schema' \
    AND has_table_privilege(c.oid, 'SELECT') ORDER BY c.relname, a.attnum";

/// A server that questions are put to.
pub struct Server {
    address: ServerAddress,
    config: Config,
    idle: Mutex<Vec<ServerConnection>>,
    known: OnceLock<ServerTables>,
    /// What is seen of tables that were read, by their names in small letters: statements, or nothing where it is all.
    seen: Mutex<BTreeMap<String, BTreeSet<Option<String>>>>,
}

/// A connection and the statements that it has prepared.
struct ServerConnection {
    client: Client,
    statements: FxHashMap<String, Statement>,
}

/// What the server has.
pub(super) struct ServerTables {
    pub(super) catalogue: Catalogue,
    /// The reference system of each table.
    pub(super) systems: BTreeMap<String, u32>,
    /// The tables and columns whose values have to be made text.
    pub(super) foreign: BTreeSet<(String, String)>,
}

/// The rows of an answer, and what of them cannot be read, which stands as null.
pub(super) struct ServerAnswer {
    pub(super) rows: QueryAnswer,
    pub(super) faults: Vec<CellFault>,
}

/// A geometry that cannot be read: its row and column, from 0, and why.
pub(super) struct CellFault {
    pub(super) row: usize,
    pub(super) column: usize,
    pub(super) why: String,
}

impl fmt::Debug for Server {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Server({})", self.address)
    }
}

/// Why there are no rows.
pub(super) enum ServerFailure {
    /// For a reason of ours.
    Told(Error),
    /// For one of the server's, which was asked this.
    Server(postgres::Error, String),
}

impl From<Error> for ServerFailure {
    fn from(error: Error) -> Self {
        Self::Told(error)
    }
}

impl Server {
    /// The server at an address, which is reached when it is first asked. No question takes longer than `most`.
    pub fn new(address: &ServerAddress, most: Option<Duration>) -> Self {
        let mut config = Config::new();
        config
            .host(&address.host)
            .port(address.port)
            .dbname(&address.database)
            .application_name("burgeon")
            .connect_timeout(PATIENCE)
            .tcp_user_timeout(SILENCE)
            .keepalives_idle(SILENCE);
        if !address.user.is_empty() {
            config.user(&address.user);
        }
        if let Some(password) = address.password() {
            config.password(password);
        }
        let limit = most.map_or(0, |most| most.as_millis());
        config.options(&format!(
            "-c statement_timeout={limit} -c default_transaction_read_only=on -c extra_float_digits=3"
        ));
        Self {
            address: address.clone(),
            config,
            idle: Mutex::default(),
            known: OnceLock::new(),
            seen: Mutex::default(),
        }
    }

    /// Its address.
    pub fn address(&self) -> &ServerAddress {
        &self.address
    }

    /// The names of its tables, in the order of the alphabet.
    pub fn tables(&self, budget: &Arc<Budget>) -> Result<Vec<String>> {
        Ok(self.known(budget)?.catalogue.values().map(|table| table.name.clone()).collect())
    }

    /// The rows that a statement asks for, as [`Database::query`](crate::Database::query) gives them, with geometries in
    /// metres of `frame`.
    pub fn query(
        &self,
        sql: &str,
        parameters: &[(&str, Cell)],
        frame: Option<&ReferenceFrame>,
        budget: &Arc<Budget>,
    ) -> Result<Arc<QueryAnswer>> {
        budget.check()?;
        errors::check_length(sql)?;
        let known = self.known(budget)?;
        rewrite::check(sql, &known.catalogue)?;
        let srid = known.system(sql);
        let crs = Crs::epsg(srid);
        let place = match frame {
            // What has no reference system is as it is.
            Some(_) if srid == 0 => Move::nowhere(),
            Some(frame) => {
                Move::between(frame, &crs.map_err(|error| error.about(&self.address.to_string()))?)?
            }
            None => Move::nowhere(),
        };
        let chosen = self.chosen(sql)?;
        let rewritten = rewrite::rewrite(sql, &known.catalogue, &chosen, Dialect::Postgis);
        let (asked, ordered) = rewritten.map_or((sql.to_owned(), false), |it| (it.sql, it.ordered));
        let given = |name: &str| errors::parameter(sql, Some(&format!("${name}")), parameters).cloned();
        let ServerAnswer { rows: mut answer, faults } =
            self.asked(&asked, srid, &given, &place, budget).map_err(|failure| {
                budget.check().err().unwrap_or_else(|| match failure {
                    ServerFailure::Told(error) => error,
                    ServerFailure::Server(error, asked) => {
                        server_error(&self.address, &error, (sql, &asked), &known.catalogue)
                    }
                })
            })?;
        if let Some(CellFault { row, column, why }) = faults.first() {
            let plain = |cell: &Cell| matches!(cell, Cell::Number(_) | Cell::Text(_));
            let named = answer.id().or_else(|| answer.rows[*row].iter().position(plain));
            let with = named.map_or_else(
                || format!("row {}", row + 1),
                |named| format!("the row with {} {}", answer.names[named], answer.rows[*row][named]),
            );
            let column = &answer.names[*column];
            return Err(Error::data(format!("SQL: the column {column} has a geometry that {why} ({with})"))
                .help("repair it, or leave its row out: WHERE ..."));
        }
        if !ordered {
            answer.sort();
        }
        Ok(Arc::new(answer))
    }

    /// Lets statements see no more of a table than what was read of it.
    pub(super) fn see(&self, table: &str, select: Option<String>) {
        let mut seen = self.seen.lock().recover();
        seen.entry(table.to_ascii_lowercase()).or_default().insert(select);
    }

    /// What a statement sees of the tables that it names. Fails if several parts of one were read.
    fn chosen(&self, sql: &str) -> Result<ChosenRows> {
        let seen = self.seen.lock().recover();
        let mut chosen = ChosenRows::new();
        for (table, parts) in seen.iter().filter(|(table, _)| find_word(sql, table).is_some()) {
            let mut parts = parts.iter();
            if let (Some(select), None) = (parts.next(), parts.next()) {
                chosen.extend(select.clone().map(|select| (table.clone(), select)));
            } else {
                return Err(Error::argument(format!("there are two tables called {}", shown(table)))
                    .help("read the table once: say which rows are wanted in the query"));
            }
        }
        Ok(chosen)
    }

    /// What the server has, asked once.
    pub(super) fn known(&self, budget: &Arc<Budget>) -> Result<&ServerTables> {
        if let Some(known) = self.known.get() {
            return Ok(known);
        }
        let none = |_: &str| Ok(Cell::Null);
        let answer =
            self.asked(TABLES, 0, &none, &Move::nowhere(), budget).map_err(|failure| match failure {
                ServerFailure::Told(error) => error,
                ServerFailure::Server(error, _)
                    if error.as_db_error().is_some_and(|told| told.message().contains("postgis")) =>
                {
                    Error::unavailable(format!("the database {} has no PostGIS", self.address))
                        .help("run there: CREATE EXTENSION postgis")
                }
                ServerFailure::Server(error, asked) => {
                    server_error(&self.address, &error, ("", &asked), &Catalogue::new())
                }
            })?;
        Ok(self.known.get_or_init(|| ServerTables::read(&answer.rows)))
    }

    /// Asks on one connection, and once more on a new one where that was lost before there were rows.
    pub(super) fn asked(
        &self,
        sql: &str,
        srid: u32,
        given: &dyn Fn(&str) -> Result<Cell>,
        place: &Move<'_>,
        budget: &Arc<Budget>,
    ) -> Result<ServerAnswer, ServerFailure> {
        let kept = self.idle.lock().recover().pop();
        let again = kept.is_some();
        let mut connection = match kept {
            Some(kept) => kept,
            None => self.connect()?,
        };
        let mut done = connection.ask(sql, srid, given, place, budget);
        // Reading once more changes nothing.
        if again && matches!(&done, Err(ServerFailure::Server(error, _)) if is_lost(error)) {
            connection = self.connect()?;
            done = connection.ask(sql, srid, given, place, budget);
        }
        let clean = connection.client.batch_execute(if done.is_ok() { "COMMIT" } else { "ROLLBACK" }).is_ok();
        let mut idle = self.idle.lock().recover();
        if clean && idle.len() < MOST_IDLE {
            idle.push(connection);
        }
        done
    }

    fn connect(&self) -> Result<ServerConnection, ServerFailure> {
        let client = self.config.connect(NoTls);
        let client = client.map_err(|error| ServerFailure::Told(unreachable(&self.address, &error)))?;
        Ok(ServerConnection { client, statements: FxHashMap::default() })
    }
}

impl ServerConnection {
    fn ask(
        &mut self,
        sql: &str,
        srid: u32,
        given: &dyn Fn(&str) -> Result<Cell>,
        place: &Move<'_>,
        budget: &Arc<Budget>,
    ) -> Result<ServerAnswer, ServerFailure> {
        // The mode of a transaction can be changed until its first query.
        let failed = |error, sql: &str| ServerFailure::Server(error, sql.to_owned());
        self.client.batch_execute("BEGIN READ ONLY; SELECT 1").map_err(|error| failed(error, ""))?;
        let value = |name: &str| given(name).ok();
        let inferred = numbered(sql, ParameterTypes::Inferred, srid, value);
        let cells = |names: &[String]| -> Result<Vec<BoundCell>> {
            names.iter().map(|name| Ok(BoundCell(place.bring_out(given(name)?)))).collect()
        };
        let bound = cells(&inferred.names)?;
        let prepared = self.prepare(&inferred);
        // Where the server cannot tell, or takes a value for what it is not, it is told.
        let fits =
            |statement: &Statement| statement.params().iter().zip(&bound).all(|(kind, cell)| cell.fits(kind));
        let (statement, asked) = match prepared {
            Ok(statement) if fits(&statement) => (statement, inferred),
            other => {
                if other.is_err() {
                    self.client
                        .batch_execute("ROLLBACK; BEGIN READ ONLY; SELECT 1")
                        .map_err(|error| failed(error, ""))?;
                }
                let explicit = numbered(sql, ParameterTypes::Told, srid, value);
                match (self.prepare(&explicit), other) {
                    (Ok(statement), _) => (statement, explicit),
                    (Err(_), Err(first)) => return Err(failed(first, &inferred.sql)),
                    (Err(error), _) => return Err(failed(error, &explicit.sql)),
                }
            }
        };
        let names: Vec<String> = statement.columns().iter().map(|column| column.name().to_owned()).collect();
        let width = names.len();
        let mut answer = ServerAnswer { rows: QueryAnswer::new(names.into(), budget), faults: Vec::new() };
        let cancel = self.client.cancel_token();
        let (stopped, ended) = (AtomicBool::new(false), channel::<()>());
        let (end, wait) = ended;
        let client = &mut self.client;
        std::thread::scope(|scope| {
            let watch = std::thread::Builder::new().name("postgis".into());
            let stopped = &stopped;
            let watching = watch.spawn_scoped(scope, move || {
                while wait.recv_timeout(PERIOD) == Err(RecvTimeoutError::Timeout) {
                    if budget.check().is_err() && !stopped.swap(true, Ordering::Relaxed) {
                        // What comes of it, the question says.
                        let _ = cancel.cancel_query(NoTls);
                    }
                }
            });
            watching.map_err(|error| Error::system(format!("cannot start a thread: {error}")))?;
            let mut work = || -> Result<(), ServerFailure> {
                let mut rows =
                    client.query_raw(&statement, &bound).map_err(|error| failed(error, &asked.sql))?;
                while let Some(row) = rows.next().map_err(|error| failed(error, &asked.sql))? {
                    let number = answer.rows.rows.len();
                    let cell = |index: usize| {
                        let cell: ServerCell = row.try_get(index).map_err(|error| {
                            use std::error::Error as _;
                            let why = error.source().map_or_else(|| error.to_string(), ToString::to_string);
                            let column = row.columns().get(index).map_or("", |column| column.name());
                            Error::data(format!("SQL: the column {column} {why}"))
                                .help("ask for numbers, texts, true or false, or geometries")
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
                    answer.rows.push((0..width).map(cell).collect::<Result<_>>()?)?;
                }
                Ok(())
            };
            let done = work();
            drop(end);
            done
        })?;
        Ok(answer)
    }

    fn prepare(&mut self, statement: &NumberedStatement) -> Result<Statement, postgres::Error> {
        if let Some(known) = self.statements.get(&statement.sql) {
            return Ok(known.clone());
        }
        let prepared = self.client.prepare(&statement.sql)?;
        if self.statements.len() >= MOST_STATEMENTS {
            self.statements.clear();
        }
        self.statements.insert(statement.sql.clone(), prepared.clone());
        Ok(prepared)
    }
}

impl ServerTables {
    fn read(rows: &QueryAnswer) -> Self {
        let mut tables =
            Self { catalogue: Catalogue::new(), systems: BTreeMap::new(), foreign: BTreeSet::new() };
        for row in &rows.rows {
            let [_, Cell::Text(table), Cell::Text(column), Cell::Text(kind), rows, key, srid, is_enum] =
                row.as_slice()
            else {
                continue;
            };
            let name = table.to_ascii_lowercase();
            let info = tables
                .catalogue
                .entry(name.clone())
                .or_insert_with(|| TableInfo { name: table.to_string(), ..TableInfo::default() });
            info.columns.push(column.to_string());
            if &**kind == "geometry" {
                info.geometries.push(column.to_string());
            } else if *is_enum != Cell::Boolean(true) && !COME_AS_THEY_ARE.contains(&&**kind) {
                tables.foreign.insert((name.clone(), column.to_string()));
            }
            if *key == Cell::Boolean(true) {
                info.key = Some(column.to_string());
            }
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "estimates and codes, which saturate"
            )]
            if let Cell::Number(count) = rows {
                info.rows = *count as usize;
            }
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a code, which saturates"
            )]
            if let Cell::Number(srid) = srid {
                tables.systems.entry(name).or_insert(*srid as u32);
            }
        }
        tables
    }

    /// The reference system of the first table with geometries that a statement names.
    fn system(&self, sql: &str) -> u32 {
        let named = self.systems.iter().filter_map(|(name, srid)| Some((find_word(sql, name)?, *srid)));
        named.min().map_or(0, |(_, srid)| srid)
    }
}
