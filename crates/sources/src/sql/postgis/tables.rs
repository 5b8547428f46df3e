//! The tables of a server.

use std::collections::{BTreeMap, BTreeSet};

use super::cells::COME_AS_THEY_ARE;
use crate::sql::cell::Cell;
use crate::sql::rewrite::{Catalogue, TableInfo, find_word};
use burgeon_kit::QueryRows;

/// Query for the schema of PostGIS, if it is installed.
pub(super) const POSTGIS: &str = "SELECT n.nspname::text FROM pg_extension e JOIN pg_namespace n ON n.oid = e.extnamespace \
    WHERE e.extname = 'postgis'";

/// Returns the query for the tables that the user may read: columns, keys and estimated numbers of rows. PostGIS is in
/// `schema`.
pub(super) fn query(schema: &str) -> String {
    let postgis = crate::sql::statement_text::quote_name(schema);
    format!(
        "SELECT c.oid::int8, n.nspname::text, c.relname::text, pg_table_is_visible(c.oid), a.attname::text, \
         coalesce(b.typname, t.typname)::text, greatest(c.reltuples, 0)::float8, \
         EXISTS (SELECT 1 FROM pg_index i WHERE i.indrelid = c.oid AND i.indisprimary AND i.indnatts = 1 \
           AND a.attnum = ANY (i.indkey)), \
         CASE WHEN t.typname = 'geometry' THEN {postgis}.postgis_typmod_srid(a.atttypmod) END, t.typtype = 'e' \
         FROM pg_class c JOIN pg_attribute a ON a.attrelid = c.oid JOIN pg_type t ON t.oid = a.atttypid \
         LEFT JOIN pg_type b ON t.typtype = 'd' AND b.oid = t.typbasetype \
         JOIN pg_namespace n ON n.oid = c.relnamespace \
         WHERE c.relkind IN ('r', 'v', 'm', 'p', 'f') AND a.attnum > 0 AND NOT a.attisdropped \
         AND n.nspname NOT LIKE 'pg\\_%' AND n.nspname <> 'information_schema' \
         AND NOT EXISTS (SELECT 1 FROM pg_depend d WHERE d.classid = 'pg_class'::regclass AND d.objid = c.oid AND d.deptype = 'e') \
         AND has_schema_privilege(n.oid, 'USAGE') AND has_table_privilege(c.oid, 'SELECT') \
         ORDER BY c.relname, n.nspname, a.attnum"
    )
}

/// The tables of a server.
pub(super) struct ServerTables {
    /// Tables by lower-case name: those of the search path with and without their schemas.
    pub(super) catalogue: Catalogue,
    /// Reference system of each table.
    pub(super) systems: BTreeMap<String, u32>,
    /// Tables and columns whose values must be cast to text.
    pub(super) foreign: BTreeMap<String, BTreeSet<String>>,
}

impl ServerTables {
    pub(super) fn read(rows: &QueryRows<Cell>) -> Self {
        let mut tables =
            Self { catalogue: Catalogue::new(), systems: BTreeMap::new(), foreign: BTreeMap::new() };
        for row in rows.iter() {
            if let [_, Cell::Text(schema), Cell::Text(table), visible, ..] = row {
                let qualified = format!("{schema}.{table}");
                let is_visible = *visible == Cell::Boolean(true);
                if is_visible {
                    tables.add(table, schema, false, row);
                }
                tables.add(&qualified, schema, is_visible, row);
            }
        }
        tables
    }

    /// Adds a column of the table that is named `called` in statements.
    fn add(&mut self, called: &str, schema: &str, is_alias: bool, row: &[Cell]) {
        let [_, _, Cell::Text(table), _, Cell::Text(column), Cell::Text(kind), rows, key, srid, is_enum] =
            row
        else {
            return;
        };
        let name = called.to_ascii_lowercase();
        let info = self.catalogue.entry(name.clone()).or_insert_with(|| TableInfo {
            name: called.to_owned(),
            place: Some((schema.to_owned(), table.to_string())),
            is_alias,
            ..TableInfo::default()
        });
        info.columns.push(column.to_string());
        if &**kind == "geometry" {
            info.geometries.push(column.to_string());
        } else if *is_enum != Cell::Boolean(true) && !COME_AS_THEY_ARE.contains(&&**kind) {
            self.foreign.entry(name.clone()).or_default().insert(column.to_string());
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
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a code, which saturates")]
        if let Cell::Number(srid) = srid {
            self.systems.entry(name).or_insert(*srid as u32);
        }
    }

    /// Returns the reference system of the first table with geometries that a statement names.
    pub(super) fn system(&self, sql: &str) -> u32 {
        let named = self.systems.iter().filter_map(|(name, srid)| {
            let schema = name.split_once('.').map(|(schema, _)| schema);
            // A table with its schema takes precedence over a table of the search path.
            let is_plain = schema.is_none();
            schema.is_none_or(|schema| find_word(sql, schema).is_some()).then_some(())?;
            Some((find_word(sql, name)?, is_plain, *srid))
        });
        named.min().map_or(0, |(_, _, srid)| srid)
    }
}
