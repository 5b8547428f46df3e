//! Parameters of SQL text, written as `$name`.

use burgeon_base::error::{Error, Result};

/// Returns the names of the parameters in `sql`, each once, in the order of first use: `$name` outside of strings,
/// quoted names and comments. Fails if a `$` has no name.
///
/// ```
/// use burgeon_language::analysis::sql_parameters;
///
/// let sql = "select * from houses where id = $id and name <> '$name' -- $comment";
/// assert_eq!(sql_parameters(sql)?, ["id"]);
/// assert!(sql_parameters("select $").is_err());
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn sql_parameters(sql: &str) -> Result<Vec<&str>> {
    let mut names: Vec<&str> = Vec::new();
    let mut rest = sql;
    while let Some(at) = rest.find(['\'', '"', '`', '-', '/', '$']) {
        let (first, found) = (rest.as_bytes()[at], &rest[at..]);
        let skip = match first {
            b'-' if found.starts_with("--") => found.find('\n').unwrap_or(found.len()),
            b'/' if found.starts_with("/*") => closed_length(&found[2..], "*/") + 2,
            b'\'' | b'"' | b'`' => closed_length(&found[1..], &found[..1]) + 1,
            b'$' => {
                let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
                let name = &found[1..];
                let name = &name[..name.find(|c| !is_word(c)).unwrap_or(name.len())];
                let quote = &found[..1 + name.len()];
                if found[quote.len()..].starts_with('$') && !name.starts_with(|c: char| c.is_ascii_digit()) {
                    // PostgreSQL strings have the form $$ ... $$ or $word$ ... $word$.
                    let quote = &found[..quote.len() + 1];
                    quote.len() + closed_length(&found[quote.len()..], quote)
                } else if name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
                    if !names.contains(&name) {
                        names.push(name);
                    }
                    quote.len()
                } else {
                    return Err(Error::argument(format!("{quote} in a query has no name")).help(
                        "a parameter is $ and a name, such as $id; its value is the value of the module's parameter",
                    ));
                }
            }
            _ => 1,
        };
        rest = &found[skip..];
    }
    Ok(names)
}

/// Returns the length of `text` up to and including `end`, or the whole length if `end` is missing.
fn closed_length(text: &str, end: &str) -> usize {
    text.find(end).map_or(text.len(), |at| at + end.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_are_found_once_and_not_in_strings_names_and_comments() {
        for (sql, names) in [
            ("select * from b where id <> $id", &["id"][..]),
            ("select $b, $a, $b", &["b", "a"]),
            ("select '$a', 'it''s $b', \"$c\", `$d`, $e", &["e"]),
            ("select 1 -- $a\n + $b /* $c */ - $d -- $e", &["b", "d"]),
            ("select $$ $a $$, $tag$ $b $tag$, $c", &["c"]),
            ("select a-b/c-$_x9", &["_x9"]),
            ("select '$a", &[]),
            ("select \"é$a\", $é_", &[]),
            ("", &[]),
        ] {
            match sql_parameters(sql) {
                Ok(found) => assert_eq!(found, names, "{sql}"),
                Err(error) => assert!(sql.contains("$é"), "{sql}: {error}"),
            }
        }
        for sql in ["select $1", "select $", "select $ id", "select 1$"] {
            assert!(sql_parameters(sql).is_err(), "{sql}");
        }
    }
}
