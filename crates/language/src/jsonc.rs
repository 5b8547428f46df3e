//! JSON with comments, the format of editor settings. Edits change the text in place, so comments and order are kept.

use std::borrow::Cow;
use std::ops::Range;

use serde_json::{Map, Value};

/// Maximum nesting depth of objects and lists.
const DEEPEST: usize = 64;

/// A value with its range in the text.
struct JsonNode {
    range: Range<usize>,
    content: NodeContent,
}

enum NodeContent {
    /// Members with their names.
    Object(Vec<(String, JsonNode)>),
    List(Vec<JsonNode>),
    Other(Value),
}

impl JsonNode {
    /// Returns the last member called `name`, which takes precedence over earlier ones.
    fn member(&self, name: &str) -> Option<&Self> {
        let NodeContent::Object(members) = &self.content else { return None };
        members.iter().rev().find(|(known, _)| known == name).map(|(_, node)| node)
    }

    /// Returns true if the value is `other`, apart from comments.
    fn is_equal(&self, other: &Value) -> bool {
        match (&self.content, other) {
            (NodeContent::Object(members), Value::Object(others)) => {
                members.iter().all(|(name, _)| others.contains_key(name))
                    && others
                        .iter()
                        .all(|(name, value)| self.member(name).is_some_and(|it| it.is_equal(value)))
            }
            (NodeContent::List(items), Value::Array(others)) => {
                items.len() == others.len()
                    && items.iter().zip(others).all(|(item, value)| item.is_equal(value))
            }
            (NodeContent::Other(value), other) => value == other,
            _ => false,
        }
    }
}

/// Adds the parts of `wanted` that the object in `text` lacks: members, members of nested objects, and items of lists.
/// The existing text is kept with its comments and spaces. `None` if nothing is missing.
///
/// Fails if `text` is not a JSON object. Comments and commas after the last member are allowed.
pub(crate) fn add_missing(text: &str, wanted: &Map<String, Value>) -> Result<Option<String>, String> {
    let mut edited = Cow::Borrowed(text);
    let mut root = read(&edited)?;
    if !matches!(root.content, NodeContent::Object(_)) {
        return Err("it is not an object".to_owned());
    }
    let mut add = |root: &mut JsonNode, path: Option<&str>, name: Option<&str>, value: &Value| {
        let into = path.map_or(Some(&*root), |path| root.member(path));
        let is_there = into.is_none_or(|into| match (name, &into.content) {
            (Some(name), _) => into.member(name).is_some(),
            (None, NodeContent::List(items)) => items.iter().any(|item| item.is_equal(value)),
            (None, _) => true,
        });
        if let (Some(into), false) = (into, is_there) {
            edited = Cow::Owned(with_entry(&edited, into, name, value));
            *root = read(&edited)?;
        }
        Ok::<(), String>(())
    };
    for (name, value) in wanted {
        match (root.member(name).map(|known| &known.content), value) {
            (None, value) => add(&mut root, None, Some(name), value)?,
            (Some(NodeContent::Object(_)), Value::Object(more)) => {
                more.iter().try_for_each(|(inner, value)| add(&mut root, Some(name), Some(inner), value))?;
            }
            (Some(NodeContent::List(_)), Value::Array(more)) => {
                more.iter().try_for_each(|value| add(&mut root, Some(name), None, value))?;
            }
            // Existing values are kept.
            _ => {}
        }
    }
    Ok((edited != text).then(|| edited.into_owned()))
}

/// Returns true if `text` contains only comments and spaces.
pub(crate) fn is_comments(text: &str) -> bool {
    let text = text.trim_start_matches('\u{feff}');
    space_length(text) == text.len()
}

/// Returns the text with another entry at the end of the object or list `of`.
fn with_entry(text: &str, of: &JsonNode, name: Option<&str>, value: &Value) -> String {
    let newline = if text.contains("\r\n") { "\r\n" } else { "\n" };
    let ranges: Vec<&Range<usize>> = match &of.content {
        NodeContent::Object(members) => members.iter().map(|(_, node)| &node.range).collect(),
        NodeContent::List(items) => items.iter().map(|node| &node.range).collect(),
        NodeContent::Other(_) => Vec::new(),
    };
    let close = of.range.end - 1;
    let indent_of = |at: usize| -> &str {
        let line = text[..at].rfind('\n').map_or(0, |end| end + 1);
        let rest = &text[line..];
        &rest[..rest.len() - rest.trim_start_matches([' ', '\t']).len()]
    };
    let outer = indent_of(of.range.start);
    let is_one_line = !text[of.range.start..of.range.end].contains('\n') && !ranges.is_empty();
    let indent = match ranges.first() {
        Some(first) if !is_one_line => Cow::Borrowed(indent_of(first.start)),
        _ => Cow::Owned(format!("{outer}  ")),
    };
    let value = match is_one_line {
        true => value.to_string(),
        false => format!("{value:#}").replace('\n', &format!("{newline}{indent}")),
    };
    let entry = match name {
        Some(name) => format!("{}: {value}", Value::from(name)),
        None => value,
    };
    let mut edited = text.to_owned();
    let Some(last) = ranges.last().map(|last| last.end) else {
        // The object or list can contain comments.
        let end = of.range.start + text[of.range.start..close].trim_end().len();
        edited.replace_range(end..close, &format!("{newline}{indent}{entry}{newline}{outer}"));
        return edited;
    };
    let after = last + space_length(&text[last..close]);
    let comma = text[after..].starts_with(',').then_some(after);
    let from = comma.map_or(last, |comma| comma + 1);
    if is_one_line {
        edited.insert_str(from, &if comma.is_some() { format!(" {entry}") } else { format!(", {entry}") });
        return edited;
    }
    let line_end = text[from..close].find('\n').map_or(close, |end| from + end);
    let at = end_of_comments(text, from, line_end);
    let trailing = if comma.is_some() { "," } else { "" };
    let closing = if line_end == close { format!("{newline}{outer}") } else { String::new() };
    edited.insert_str(at, &format!("{newline}{indent}{entry}{trailing}{closing}"));
    if comma.is_none() {
        edited.insert(last, ',');
    }
    edited
}

/// Returns the end of the comments that begin after `from` and end before `line_end`, which belong to the preceding
/// entry.
fn end_of_comments(text: &str, from: usize, line_end: usize) -> usize {
    let mut end = from;
    loop {
        let rest = &text[end..line_end];
        let inner = rest.trim_start();
        let begin = end + rest.len() - inner.len();
        if inner.starts_with("//") {
            return begin + inner.trim_end().len();
        }
        match inner.strip_prefix("/*").and_then(|inner| inner.find("*/")) {
            Some(length) => end = begin + length + 4,
            None => return end,
        }
    }
}

/// Parses the whole of `text` as a value.
fn read(text: &str) -> Result<JsonNode, String> {
    let mut reader = JsoncReader { text, at: 0 };
    if text.starts_with('\u{feff}') {
        reader.at = '\u{feff}'.len_utf8();
    }
    let node = reader.value(0).ok_or_else(|| reader.complaint())?;
    reader.skip();
    if reader.at < text.len() { Err(reader.complaint()) } else { Ok(node) }
}

/// Returns the length of the leading spaces and comments of `text`.
fn space_length(text: &str) -> usize {
    let mut reader = JsoncReader { text, at: 0 };
    reader.skip();
    reader.at
}

struct JsoncReader<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> JsoncReader<'a> {
    fn complaint(&self) -> String {
        let line = 1 + self.text[..self.at.min(self.text.len())].matches('\n').count();
        format!("line {line} is not JSON")
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn skip(&mut self) {
        loop {
            let rest = self.rest();
            let trimmed = rest.trim_start();
            self.at += rest.len() - trimmed.len();
            let comment = match trimmed {
                _ if trimmed.starts_with("//") => trimmed.find('\n').unwrap_or(trimmed.len()),
                _ if trimmed.starts_with("/*") => match trimmed.find("*/") {
                    Some(end) => end + 2,
                    None => return,
                },
                _ => return,
            };
            self.at += comment;
        }
    }

    fn take(&mut self, what: char) -> bool {
        self.skip();
        let found = self.rest().starts_with(what);
        self.at += if found { what.len_utf8() } else { 0 };
        found
    }

    fn value(&mut self, depth: usize) -> Option<JsonNode> {
        self.skip();
        let start = self.at;
        if depth > DEEPEST {
            return None;
        }
        let content = match self.rest().chars().next()? {
            '{' => self.object(depth)?,
            '[' => self.list(depth)?,
            '"' => NodeContent::Other(Value::from(self.string()?)),
            _ => {
                let end = self.rest().find(|c: char| !(c.is_alphanumeric() || "+-.".contains(c)));
                let word = &self.rest()[..end.unwrap_or(self.rest().len())];
                let value = serde_json::from_str(word).ok()?;
                self.at += word.len();
                NodeContent::Other(value)
            }
        };
        Some(JsonNode { range: start..self.at, content })
    }

    fn object(&mut self, depth: usize) -> Option<NodeContent> {
        self.take('{');
        let mut members = Vec::new();
        while !self.take('}') {
            self.skip();
            let name = self.string()?;
            if !self.take(':') {
                return None;
            }
            members.push((name, self.value(depth + 1)?));
            if !self.take(',') {
                self.skip();
                if !self.rest().starts_with('}') {
                    return None;
                }
            }
        }
        Some(NodeContent::Object(members))
    }

    fn list(&mut self, depth: usize) -> Option<NodeContent> {
        self.take('[');
        let mut items = Vec::new();
        while !self.take(']') {
            items.push(self.value(depth + 1)?);
            if !self.take(',') {
                self.skip();
                if !self.rest().starts_with(']') {
                    return None;
                }
            }
        }
        Some(NodeContent::List(items))
    }

    fn string(&mut self) -> Option<String> {
        let rest = self.rest();
        let inner = rest.strip_prefix('"')?;
        let mut escaped = false;
        let end = inner.find(|c| {
            let is_end = c == '"' && !escaped;
            escaped = c == '\\' && !escaped;
            is_end
        })?;
        let text = &rest[..end + 2];
        let value = serde_json::from_str(text).ok()?;
        self.at += text.len();
        Some(value)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use serde_json::json;

    use super::*;

    fn wanted_entries(value: Value) -> Map<String, Value> {
        let Value::Object(map) = value else { panic!("no object") };
        map
    }

    fn merge_value(text: &str, more: Value) -> String {
        add_missing(text, &wanted_entries(more)).unwrap().unwrap_or_else(|| text.to_owned())
    }

    #[test]
    fn comments_and_order_stay() {
        let text = "// mine\n{\n\t\"b\": 1, // one\n\t/* two */\n\t\"a\": { \"x\": \"// no comment\" }, // last\n\t\"c\": [\n\t\t1,\n\t\t2 // two\n\t],\n\t// end\n}\n";
        let more = json!({ "a": { "x": 3, "y": [true] }, "b": 9, "c": [2, 3], "d": { "z": 1 } });
        assert_eq!(
            merge_value(text, more),
            "// mine\n{\n\t\"b\": 1, // one\n\t/* two */\n\t\"a\": { \"x\": \"// no comment\", \"y\": [true] }, // last\n\t\"c\": [\n\t\t1,\n\t\t2, // two\n\t\t3\n\t],\n\t\"d\": {\n\t  \"z\": 1\n\t},\n\t// end\n}\n"
        );
    }

    #[test]
    fn empty_objects_and_single_lines_are_filled() {
        assert_eq!(merge_value("{}", json!({ "a": 1 })), "{\n  \"a\": 1\n}");
        assert_eq!(merge_value("{ // mine\n}", json!({ "a": 1 })), "{ // mine\n  \"a\": 1\n}");
        assert_eq!(merge_value("{ \"b\": 2 }", json!({ "a": 1 })), "{ \"b\": 2, \"a\": 1 }");
        assert_eq!(merge_value("{ \"b\": 2, }", json!({ "a": 1 })), "{ \"b\": 2, \"a\": 1 }");
        assert_eq!(
            merge_value("{\r\n  \"b\": 2\r\n}", json!({ "a": 1 })),
            "{\r\n  \"b\": 2,\r\n  \"a\": 1\r\n}"
        );
        assert_eq!(merge_value("{\n  \"b\": 2 }", json!({ "a": 1 })), "{\n  \"b\": 2,\n  \"a\": 1\n }");
        assert_eq!(add_missing("{ \"a\": 1 }", &wanted_entries(json!({ "a": 2 }))).unwrap(), None);
        for broken in ["[1]", "{ \"a\" 1 }", "{", "{ \"a\": 1 } x", "3", "{ \"a\": tru }", "{ /* \"a\": 1 }"]
        {
            assert!(add_missing(broken, &wanted_entries(json!({ "a": 2 }))).is_err(), "{broken}");
        }
    }

    /// Returns the value without comments.
    fn plain(node: &JsonNode) -> Value {
        match &node.content {
            NodeContent::Object(members) => {
                members.iter().map(|(name, node)| (name.clone(), plain(node))).collect()
            }
            NodeContent::List(items) => items.iter().map(plain).collect(),
            NodeContent::Other(value) => value.clone(),
        }
    }

    fn values() -> impl Strategy<Value = Value> {
        let leaf = prop_oneof![
            Just(Value::Null),
            any::<bool>().prop_map(Value::from),
            (-9..9_i64).prop_map(Value::from),
            "[a-c\"/* ]{0,4}".prop_map(Value::from),
        ];
        leaf.prop_recursive(3, 20, 4, |inner| {
            prop_oneof![
                prop::collection::vec(inner.clone(), 0..4).prop_map(Value::from),
                prop::collection::btree_map("[a-d]", inner, 0..4)
                    .prop_map(|map| Value::Object(map.into_iter().collect())),
            ]
        })
    }

    /// Formats `value` as a user may write it: with comments, trailing commas, and one or several lines.
    fn untidy(value: &Value, style: &mut impl Iterator<Item = u8>) -> String {
        let mut next = || style.next().unwrap_or(0);
        let gap = ["", " ", "\n  ", " // c }\n", "/* [ */", "\n\n\t"][usize::from(next()) % 6];
        let comma = if next() % 3 == 0 { "," } else { "" };
        let entries: Vec<String> = match value {
            Value::Object(map) => map
                .iter()
                .map(|(name, value)| format!("{gap}{}:{gap}{}", json!(name), untidy(value, style)))
                .collect(),
            Value::Array(list) => list.iter().map(|value| format!("{gap}{}", untidy(value, style))).collect(),
            other => return other.to_string(),
        };
        let (open, close) = if value.is_object() { ("{", "}") } else { ("[", "]") };
        let comma = if entries.is_empty() { "" } else { comma };
        format!("{open}{}{comma}{gap}{close}", entries.join(","))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn what_was_there_stays_and_what_is_wanted_is_there(
            there in values(), more in values(), style in prop::collection::vec(any::<u8>(), 0..60),
        ) {
            let (Value::Object(there), Value::Object(more)) = (there, more) else { return Ok(()) };
            let text = untidy(&Value::Object(there.clone()), &mut style.into_iter());
            let edited = add_missing(&text, &more).unwrap().unwrap_or_else(|| text.clone());
            let found = read(&edited).unwrap();
            let Value::Object(found) = plain(&found) else { panic!() };
            prop_assert!(read(&edited).unwrap().is_equal(&Value::Object(found.clone())));
            for (name, value) in &more {
                match (there.get(name), value) {
                    (None, value) => prop_assert_eq!(&found[name], value),
                    (Some(Value::Object(known)), Value::Object(more)) => {
                        let mut all = more.clone();
                        all.extend(known.clone());
                        prop_assert_eq!(&found[name], &Value::Object(all));
                    }
                    (Some(Value::Array(known)), Value::Array(more)) => {
                        let Value::Array(found) = &found[name] else { panic!() };
                        prop_assert_eq!(&found[..known.len()], &known[..]);
                        prop_assert!(more.iter().all(|it| found.contains(it)));
                    }
                    (Some(known), _) => prop_assert_eq!(&found[name], known),
                }
            }
            for (name, value) in &there {
                if !more.contains_key(name) {
                    prop_assert_eq!(&found[name], value);
                }
            }
            let comments = |text: &str| (text.matches("// c }").count(), text.matches("/* [ */").count());
            prop_assert_eq!(comments(&edited), comments(&text));
            prop_assert_eq!(add_missing(&edited, &more).unwrap(), None);
        }
    }
}
