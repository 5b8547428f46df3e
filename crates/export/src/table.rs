//! Table of the numbers that a script reports, as comma-separated values (RFC 4180).

use std::borrow::Cow;
use std::io::Write as _;
use std::path::Path;

use burgeon_base::error::Result;
use burgeon_spatial::{Attribute, RecordTable};

use crate::Export;
use crate::files::Files;

/// Writes the reports of all systems to `path`: a row for each chain with reports, with its system, counted from 1, and the id
/// of its feature. Equal names of several systems are one column.
pub(crate) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let tables = export.facts.reports;
    let mut columns: Vec<&str> = Vec::new();
    for name in tables.iter().flat_map(|(_, table)| &table.columns) {
        if !columns.contains(&name.as_str()) {
            columns.push(name);
        }
    }
    files.write(path, |out| {
        let names = ["system", "feature"].into_iter().chain(columns.iter().copied());
        writeln!(out, "{}", names.map(field).collect::<Vec<_>>().join(","))?;
        for (system, table) in tables {
            let places: Vec<Option<usize>> = columns.iter().map(|name| column(table, name)).collect();
            for record in &table.records {
                write!(out, "{},{}", system + 1, field(&record.id))?;
                for place in &places {
                    let value = place.and_then(|place| record.value(place)).map(Attribute::text);
                    write!(out, ",{}", field(&value.unwrap_or_default()))?;
                }
                writeln!(out)?;
            }
        }
        Ok(())
    })
}

fn column(table: &RecordTable, name: &str) -> Option<usize> {
    table.columns.iter().position(|column| column == name)
}

/// Returns a text as a field, in quotation marks if it needs them.
fn field(text: &str) -> Cow<'_, str> {
    let is_plain = !text.contains([',', '"', '\n', '\r']) && text.trim() == text;
    if is_plain { Cow::Borrowed(text) } else { Cow::Owned(format!("\"{}\"", text.replace('"', "\"\""))) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SceneFacts;
    use burgeon_picture::Picture;
    use burgeon_scene::Scene;
    use burgeon_spatial::Record;

    fn table(columns: &[&str], rows: &[(&str, &[(usize, f64)])]) -> RecordTable {
        let record = |(id, values): &(&str, &[(usize, f64)])| Record {
            id: (*id).to_owned(),
            geometry: None,
            values: values.iter().map(|(column, value)| (*column, Attribute::Number(*value))).collect(),
        };
        RecordTable {
            name: String::new(),
            columns: columns.iter().map(|name| (*name).to_owned()).collect(),
            records: rows.iter().map(record).collect(),
        }
    }

    #[test]
    fn a_table_has_a_row_for_each_feature_and_names_of_any_kind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let reports = [
            (
                0,
                table(
                    &["area", "\"a\", b\n</script>"],
                    &[("x\u{1f331}", &[(0, 1.5)]), (" y,", &[(0, 2.0), (1, -3.0)])],
                ),
            ),
            (2, table(&["windows", "area"], &[("", &[(1, 1e21)])])),
        ];
        let facts = SceneFacts { reports: &reports, ..SceneFacts::default() };
        let mut files = Files::default();
        files
            .export(&Export { scene: &Scene::default(), picture: &Picture::default(), facts }, &path)
            .unwrap();
        files.publish().unwrap();
        assert_eq!(
            std::fs::read_to_string(path).unwrap(),
            "system,feature,area,\"\"\"a\"\", b\n</script>\",windows\n1,x\u{1f331},1.5,,\n1,\" y,\",2,-3,\n3,,1000000000000000000000,,\n"
        );
    }
}
