//! Deprecated names of the scripting API, and former names of fields and methods.

use std::borrow::Cow;
use std::sync::Arc;

use super::kind::SharedText;
use crate::{Field, Kind, Method, Table, TableKey};
use burgeon_base::error::{Error, Result};

/// A deprecated name, which still works and will be removed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Deprecation {
    /// Name of a field or method; empty for the type itself.
    pub name: SharedText,
    /// First version of the script API that deprecates the name.
    pub since: SharedText,
    /// Replacement.
    pub instead: SharedText,
}

impl Deprecation {
    /// Returns the warning for users; `name` is the name as the script writes it.
    pub fn message(&self, name: &str) -> String {
        format!("{name} is deprecated since version {} of the script API", self.since)
    }
}

impl Field {
    /// Adds a former name, which scripts can still use, and which is deprecated since version `since` of the script
    /// API.
    #[must_use]
    pub fn renamed_from(mut self, former: impl Into<SharedText>, since: impl Into<SharedText>) -> Self {
        self.add_former(former.into(), since.into());
        self
    }

    fn add_former(&mut self, name: SharedText, since: SharedText) {
        self.former.push(Deprecation { name, since, instead: self.name.clone() });
    }

    /// Returns true if `name` is the name of the field or one of its former names.
    pub fn is_called(&self, name: &str) -> bool {
        self.name == name || self.former.iter().any(|former| former.name == name)
    }

    /// Returns the former names in `table`.
    pub fn former_names<'a>(fields: &'a [Self], table: &'a Table) -> impl Iterator<Item = &'a Deprecation> {
        let former = fields.iter().flat_map(|field| &field.former);
        former.filter(|former| table.get(&former.name).is_some())
    }

    /// Replaces the former names in `table` by the names of the fields. Fails with the name of the `owner` of the table
    /// if a field has both names.
    pub fn replace_former_names<'a>(
        owner: &str,
        fields: &[Self],
        table: &'a Table,
    ) -> Result<Cow<'a, Table>> {
        let mut replaced = Cow::Borrowed(table);
        for Deprecation { name, instead, .. } in Self::former_names(fields, table) {
            let table = replaced.to_mut();
            if table.get(instead).is_some() {
                let message = format!("{owner}: `{instead}` and its former name `{name}` are both set");
                return Err(Error::argument(message).help(format!("remove `{name}`")).of_script());
            }
            for (key, _) in &mut table.entries {
                if matches!(key, TableKey::Name(key) if **key == **name) {
                    *key = TableKey::Name(Arc::from(&**instead));
                }
            }
            table.entries.sort_by(|a, b| a.0.cmp(&b.0));
        }
        Ok(replaced)
    }
}

impl Kind {
    /// Deprecates `name`, a field or a method, or the type itself if empty. Scripts that use it are warned to use
    /// `instead` since version `since` of the script API.
    ///
    /// ```
    /// use burgeon_kit::Kind;
    ///
    /// let lamp = Kind::new("lamp", "A lamp.").deprecates("size", "1.3", "height");
    /// let deprecation = lamp.deprecation("size").expect("a deprecated field");
    /// assert_eq!(deprecation.message("lamp.size"), "lamp.size is deprecated since version 1.3 of the script API");
    /// assert_eq!(deprecation.instead, "height");
    /// ```
    #[must_use]
    pub fn deprecates(
        mut self,
        name: impl Into<SharedText>,
        since: impl Into<SharedText>,
        instead: impl Into<SharedText>,
    ) -> Self {
        self.deprecated.push(Deprecation { name: name.into(), since: since.into(), instead: instead.into() });
        self
    }

    /// Adds the former name of the field or method `name`, which is deprecated since version `since` of the script API.
    /// Does nothing if the type has no such field or method.
    #[must_use]
    pub fn renames(
        mut self,
        former: impl Into<SharedText>,
        since: impl Into<SharedText>,
        name: &str,
    ) -> Self {
        let former = former.into();
        if let Some(at) = self.fields.iter().position(|field| field.name == name) {
            self.fields[at].add_former(former, since.into());
        } else if let Some(method) = self.method(name).cloned() {
            let instead = format!("{}:{name}", self.name);
            let doc = format!("Former name of `{instead}`.").into();
            self.methods.push(Method { name: former.clone(), doc, ..method });
            return self.deprecates(former, since, instead);
        }
        self
    }

    /// Returns the deprecation of the field or method `name`, if it is deprecated.
    pub fn deprecation(&self, name: &str) -> Option<&Deprecation> {
        self.deprecated.iter().find(|known| known.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Value;

    fn fields() -> Vec<Field> {
        vec![Field::new("height", "number", "Height (m).").renamed_from("size", "1.1")]
    }

    fn table(names: &[&str]) -> Table {
        let entry = |name: &&str| (TableKey::Name((*name).into()), Value::Number(3.0));
        Table { class: None, entries: names.iter().map(entry).collect() }
    }

    #[test]
    fn a_former_name_of_a_field_is_replaced() {
        let given = table(&["size", "width"]);
        let replaced = Field::replace_former_names("tower", &fields(), &given).unwrap();
        assert_eq!((replaced.get("height"), replaced.get("size")), (Some(&Value::Number(3.0)), None));
        assert!(replaced.get("width").is_some());
        let names: Vec<_> = fields();
        assert_eq!(Field::former_names(&names, &given).count(), 1);
    }

    #[test]
    fn both_names_of_a_field_are_refused() {
        let error = Field::replace_former_names("tower", &fields(), &table(&["height", "size"])).unwrap_err();
        assert!(error.to_string().contains("`height` and its former name `size` are both set"), "{error}");
        assert!(error.to_string().contains("remove `size`"), "{error}");
    }
}
