//! The renaming of tables in statements.

use std::borrow::Cow;

use sqlparser::ast::{Ident, ObjectName, TableAlias, TableFactor};

use super::parse::{parse, with_stack};
use super::scope::declared_names;
use super::walk::{StatementPartMut, walk_mut};
use burgeon_base::error::{Error, Result};

/// Replaces the first name of each pair, which may have a schema, with the second. Columns can still be qualified with
/// the first name. Tables that the statement declares take precedence.
pub(crate) fn rename_tables(sql: &str, names: &[(&str, Cow<'_, str>)]) -> Result<String> {
    let done = with_stack(|| {
        let mut query = parse(sql).map_err(|error| error.message)?.query;
        let declared = declared_names(&query);
        walk_mut(&mut query, |part| {
            if let StatementPartMut::TableFactor(TableFactor::Table { name, alias, args: None, .. }) = part
                && let Some((own, written)) = name_parts(name)
                && !declared.contains(&written.to_ascii_lowercase())
                && let Some((_, table)) = names.iter().find(|(word, _)| *word == written)
            {
                *name = ObjectName::from(vec![Ident::with_quote('"', table.as_ref())]);
                alias.get_or_insert(TableAlias {
                    explicit: true,
                    name: Ident::with_quote('"', own),
                    columns: Vec::new(),
                    at: None,
                });
            }
        });
        Ok::<_, String>(query.to_string())
    });
    done.unwrap_or_else(|| Err("it nests too deep".to_owned())).map_err(|message| {
        let names: Vec<&str> = names.iter().map(|(_, table)| table.as_ref()).collect();
        Error::argument(format!("the query of {} cannot be read: {message}", names.join(" and ")))
            .help("ask in the words that SQLite and PostgreSQL share")
    })
}

/// Returns the last part of a name, and the whole name.
fn name_parts(name: &ObjectName) -> Option<(String, String)> {
    let parts = name.0.iter().map(|part| Some(part.as_ident()?.value.as_str()));
    let parts: Vec<&str> = parts.collect::<Option<_>>()?;
    Some(((*parts.last()?).to_owned(), parts.join(".")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_another_name_are_read_and_columns_found_as_before() {
        let names = [("Wall", "castle.Wall".into()), ("gate.Wall", "gate.Wall".into())];
        let renamed = |sql: &str| rename_tables(sql, &names).unwrap();
        for (sql, other) in [
            ("select Wall.w from Wall", r#"SELECT Wall.w FROM "castle.Wall" AS "Wall""#),
            ("select a.w from Wall a, b", r#"SELECT a.w FROM "castle.Wall" a, b"#),
            ("select * from gate.Wall", r#"SELECT * FROM "gate.Wall" AS "Wall""#),
            ("select Wall from (select 1 as Wall)", "SELECT Wall FROM (SELECT 1 AS Wall)"),
            ("with Wall as (select 1) select * from Wall", "WITH Wall AS (SELECT 1) SELECT * FROM Wall"),
        ] {
            assert_eq!(renamed(sql), other);
        }
        let error = rename_tables("select from Wall where", &names[..1]).unwrap_err();
        assert!(error.message().starts_with("the query of castle.Wall cannot be read: "), "{error}");
    }
}
