//! A server: its connections and queries.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Duration;

use tokio_postgres::Config;

use super::ServerAddress;
use super::connection::{AskedStatement, CellFault, ServerAnswer, ServerConnection, ServerFailure};
use super::encryption;
use super::errors::{is_lost, server_error};
use super::tables::{self, ServerTables};
use crate::sql::cell::{Cell, sort_rows};
use crate::sql::errors;
use crate::sql::place::Move;
use crate::sql::rewrite::{self, Catalogue, ChosenRows, Dialect, find_word};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::text::shown;
use burgeon_kit::QueryRows;
use burgeon_spatial::{Crs, ReferenceFrame};

/// Maximum silence of a server before the connection is considered dead.
const SILENCE: Duration = Duration::from_secs(30);

/// Maximum number of idle connections that are kept.
const MOST_IDLE: usize = 16;

/// A server that can be queried.
pub struct Server {
    address: ServerAddress,
    config: Config,
    idle: Mutex<Vec<ServerConnection>>,
    known: OnceLock<ServerTables>,
    /// Visible part of each table that was read, by lower-case name: statements, or `None` for the whole table.
    seen: Mutex<BTreeMap<String, BTreeSet<Option<String>>>>,
}

impl fmt::Debug for Server {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Server({})", self.address)
    }
}

impl Server {
    /// Creates the server at an address. The first query connects to it. No query takes longer than `most`.
    pub fn new(address: &ServerAddress, most: Option<Duration>) -> Self {
        let mut config = Config::new();
        config
            .host(&address.host)
            .port(address.port)
            .dbname(&address.database)
            .application_name("burgeon")
            .connect_timeout(address.connect_timeout)
            .ssl_mode(encryption::mode(address.encryption))
            .tcp_user_timeout(SILENCE)
            .keepalives_idle(SILENCE);
        if !address.user.is_empty() {
            config.user(&address.user);
        }
        if let Some(password) = address.password() {
            config.password(password);
        }
        let limit = address.answer_timeout.into_iter().chain(most).min().map_or(0, |most| most.as_millis());
        let mut options = format!(
            "-c statement_timeout={limit} -c default_transaction_read_only=on -c extra_float_digits=3"
        );
        if !address.search_path.is_empty() {
            options += &format!(" -c search_path={}", address.search_path.join(","));
        }
        config.options(&options);
        Self {
            address: address.clone(),
            config,
            idle: Mutex::default(),
            known: OnceLock::new(),
            seen: Mutex::default(),
        }
    }

    /// Returns the address.
    pub fn address(&self) -> &ServerAddress {
        &self.address
    }

    /// Returns the names of the tables, in alphabetical order.
    pub fn tables(&self, budget: &Arc<Budget>) -> Result<Vec<String>> {
        let tables = self.server_tables(budget)?.catalogue.values().filter(|table| !table.is_alias);
        Ok(tables.map(|table| table.name.clone()).collect())
    }

    /// Returns the rows of a statement, as [`Database::query`](crate::sql::Database::query) does, with geometries in metres
    /// of `frame`.
    pub fn query(
        &self,
        sql: &str,
        parameters: &[(&str, Cell)],
        frame: Option<&ReferenceFrame>,
        budget: &Arc<Budget>,
    ) -> Result<QueryRows<Cell>> {
        budget.check()?;
        errors::check_length(sql)?;
        let known = self.server_tables(budget)?;
        rewrite::check(sql, &known.catalogue)?;
        let srid = known.system(sql);
        let crs = Crs::epsg(srid);
        let place = match frame {
            // Geometries without a reference system are not transformed.
            Some(_) if srid == 0 => Move::identity(),
            Some(frame) => {
                Move::between(frame, &crs.map_err(|error| error.about(&self.address.to_string()))?)?
            }
            None => Move::identity(),
        };
        let chosen = self.chosen_rows(sql)?;
        let rewritten = rewrite::rewrite(sql, &known.catalogue, &chosen, Dialect::Postgis)?;
        let (asked, ordered) = rewritten.as_ref().map_or((sql, false), |it| (&*it.sql, it.ordered));
        let given = |name: &str| errors::parameter(sql, Some(&format!("${name}")), parameters).cloned();
        let ServerAnswer { rows: mut answer, faults } =
            self.run_statement(asked, srid, &given, &place, budget).map_err(|failure| {
                budget.check().err().unwrap_or_else(|| match failure {
                    ServerFailure::Told(error) => error,
                    ServerFailure::Server(error, asked) => {
                        server_error(&self.address, &error, (sql, &asked), &known.catalogue)
                    }
                })
            })?;
        if let Some(CellFault { row, column, why }) = faults.first() {
            let plain = |cell: &Cell| matches!(cell, Cell::Number(_) | Cell::Text(_));
            let named = answer.id().or_else(|| answer.row(*row).iter().position(plain));
            let with = named.map_or_else(
                || format!("row {}", row + 1),
                |named| format!("the row with {} {}", answer.names[named], answer.row(*row)[named]),
            );
            let column = &answer.names[*column];
            return Err(Error::data(format!("SQL: the column {column} has a geometry that {why} ({with})"))
                .help("repair it, or leave its row out: WHERE ..."));
        }
        if !ordered {
            sort_rows(&mut answer);
        }
        Ok(answer)
    }

    /// Limits the visible part of a table to the part that was read.
    pub(super) fn see(&self, table: &str, select: Option<String>) {
        let mut seen = self.seen.lock().recover();
        seen.entry(table.to_ascii_lowercase()).or_default().insert(select);
    }

    /// Returns the visible part of each table that a statement names. Fails if several parts of a table were read.
    fn chosen_rows(&self, sql: &str) -> Result<ChosenRows> {
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

    /// Returns the server's tables, which are queried once.
    pub(super) fn server_tables(&self, budget: &Arc<Budget>) -> Result<&ServerTables> {
        if let Some(known) = self.known.get() {
            return Ok(known);
        }
        let none = |_: &str| Ok(Cell::Null);
        let read = |sql: &str| {
            self.run_statement(sql, 0, &none, &Move::identity(), budget).map_err(|failure| match failure {
                ServerFailure::Told(error) => error,
                ServerFailure::Server(error, asked) => {
                    server_error(&self.address, &error, ("", &asked), &Catalogue::new())
                }
            })
        };
        let answer = read(tables::POSTGIS)?;
        if answer.rows.is_empty() {
            return Err(Error::unavailable(format!("the database {} has no PostGIS", self.address))
                .help("run there: CREATE EXTENSION postgis"));
        }
        let schema = answer.rows.row(0).first().map_or_else(String::new, |cell| match cell {
            Cell::Text(schema) => schema.to_string(),
            _ => String::new(),
        });
        let answer = read(&tables::query(&schema))?;
        Ok(self.known.get_or_init(|| ServerTables::read(&answer.rows)))
    }

    /// Runs a statement on a connection. If a reused connection is lost before there are rows, retries once on a new
    /// one.
    pub(super) fn run_statement(
        &self,
        sql: &str,
        srid: u32,
        given: &dyn Fn(&str) -> Result<Cell>,
        place: &Move<'_>,
        budget: &Arc<Budget>,
    ) -> Result<ServerAnswer, ServerFailure> {
        let statement = AskedStatement { sql, srid, given, place };
        let kept = self.idle.lock().recover().pop();
        let again = kept.is_some();
        let mut connection = match kept {
            Some(kept) => kept,
            None => self.connect(budget)?,
        };
        let mut done = connection.ask(&statement, budget);
        // Statements only read, so they can be repeated.
        if again && matches!(&done, Err(ServerFailure::Server(error, _)) if is_lost(error)) {
            connection = self.connect(budget)?;
            done = connection.ask(&statement, budget);
        }
        // A connection that did not answer in time still has a pending answer, so it is not reused.
        let told = matches!(&done, Err(ServerFailure::Told(_)));
        if !told && connection.end(done.is_ok(), budget) {
            let mut idle = self.idle.lock().recover();
            if idle.len() < MOST_IDLE {
                idle.push(connection);
            }
        }
        done
    }

    fn connect(&self, budget: &Budget) -> Result<ServerConnection, ServerFailure> {
        ServerConnection::new(&self.config, &self.address, budget)
    }
}
