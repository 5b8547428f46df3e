//! The columns that an expression can refer to, with their types.

use sqlparser::ast::ObjectName;

use crate::sql::rewrite::Catalogue;
use crate::sql::rewrite::scope::table;
use crate::sql::rewrite::types::{ColumnTypes, SqlType};

/// A relation after FROM with its columns.
pub(super) struct TypedRelation {
    pub(super) alias: Option<String>,
    pub(super) columns: ColumnTypes,
}

/// The relations that an expression can refer to.
pub(super) struct TypeScope<'a> {
    pub(super) relations: Vec<TypedRelation>,
    pub(super) outer: Option<&'a TypeScope<'a>>,
}

impl TypeScope<'_> {
    /// Returns the type of the column `name`, of the relation `owner` if given.
    pub(super) fn column(&self, owner: Option<&str>, name: &str) -> SqlType {
        let mut open = Some(self);
        while let Some(scope) = open {
            for relation in &scope.relations {
                let meant = match (owner, &relation.alias) {
                    (Some(owner), Some(alias)) => alias.eq_ignore_ascii_case(owner),
                    (Some(_), None) => false,
                    (None, _) => true,
                };
                match &relation.columns {
                    Some(columns) if meant => {
                        let found = columns.iter().find(|(known, _)| known.eq_ignore_ascii_case(name));
                        match found {
                            Some((_, kind)) => return *kind,
                            None if owner.is_some() => return SqlType::Unknown,
                            None => {}
                        }
                    }
                    // The column may belong to this relation.
                    None if meant => return SqlType::Unknown,
                    _ => {}
                }
            }
            open = scope.outer;
        }
        SqlType::Unknown
    }
}

/// The typing of a statement, which rewrites expressions by their types.
pub(super) struct Typing<'a> {
    pub(super) tables: &'a Catalogue,
    /// Tables that the statement declares, in order.
    pub(super) declared: Vec<(String, ColumnTypes)>,
}

impl Typing<'_> {
    /// Returns the columns of a table that the statement names.
    pub(super) fn columns_of(&self, name: &ObjectName) -> ColumnTypes {
        if let [part] = name.0.as_slice() {
            let own = part.as_ident()?.value.to_ascii_lowercase();
            if let Some((_, columns)) = self.declared.iter().rev().find(|(known, _)| *known == own) {
                return columns.clone();
            }
        }
        let known = table(name, self.tables)?;
        let kinds = known.kinds.iter().copied().chain(std::iter::repeat(SqlType::Unknown));
        Some(
            known
                .columns
                .iter()
                .zip(kinds)
                .map(|(name, kind)| {
                    let kind = if known.geometry(name).is_some() { SqlType::Geometry } else { kind };
                    (name.clone(), kind)
                })
                .collect(),
        )
    }
}
