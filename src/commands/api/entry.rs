//! What there is to tell of a name that scripts can use.

use burgeon::kit::{Call, Construct, Field, Kind, Method};
use serde_json::{Value, json};

/// A name that scripts can use.
pub(super) struct Entry {
    pub name: String,
    /// How it is written; empty where scripts cannot make it.
    pub usage: String,
    pub doc: String,
    /// Its fields, then its methods.
    pub members: Vec<Member>,
    /// A script that uses it.
    pub example: String,
}

/// A field or a method.
pub(super) struct Member {
    pub name: String,
    pub what: What,
    /// The type of a field, or of what a method returns.
    pub luau: String,
    pub arguments: Vec<Argument>,
    /// The value of a field that is left out.
    pub default: String,
    pub unit: Option<String>,
    pub doc: String,
}

/// What a member is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum What {
    /// A field of the table that its owner is made of.
    Field,
    /// A method that only reads.
    Reads,
    /// A method that changes its owner.
    Changes,
}

/// An argument of a method.
pub(super) struct Argument {
    pub name: String,
    pub luau: String,
    pub unit: Option<String>,
}

impl Entry {
    /// A type of object.
    pub(super) fn of_kind(kind: &Kind) -> Self {
        let usage = match (&kind.construct, &kind.first) {
            (Construct::Fields(_), Some(first)) => format!("{}({first}, {{ ... }})", kind.name),
            (Construct::Fields(_), None) => format!("{} {{ ... }}", kind.name),
            (Construct::File(_), _) if kind.fields.is_empty() => format!("{}(file)", kind.name),
            (Construct::File(_), _) => format!("{}(file, {{ ... }})", kind.name),
            (Construct::Given, _) => String::new(),
        };
        let fields = kind.fields.iter().map(Member::of_field);
        let members = fields.chain(kind.methods.iter().map(Member::of_method)).collect();
        let (name, doc) = (kind.name.to_string(), kind.doc.to_string());
        Self { name, usage, doc, members, example: kind.example.to_string() }
    }

    /// Those of its members that are `what`.
    pub(super) fn members(&self, what: What) -> impl Iterator<Item = &Member> {
        self.members.iter().filter(move |member| member.what == what)
    }

    pub(super) fn to_json(&self) -> Value {
        let fields: Vec<_> = self.members(What::Field).map(|field| field.to_json(self)).collect();
        let methods: Vec<_> = self.members.iter().filter(|member| member.what != What::Field).collect();
        let methods: Vec<_> = methods.into_iter().map(|method| method.to_json(self)).collect();
        json!({
            "name": self.name, "what": "type", "usage": self.usage, "doc": self.doc,
            "fields": fields, "methods": methods, "example": self.example,
        })
    }
}

impl Member {
    fn of_field(field: &Field) -> Self {
        Self {
            name: field.name.to_string(),
            what: What::Field,
            luau: field.luau.clone(),
            arguments: Vec::new(),
            default: field.default.clone(),
            unit: field.unit.as_ref().map(ToString::to_string),
            doc: field.doc.to_string(),
        }
    }

    fn of_method(method: &Method) -> Self {
        let arguments = method.arguments.iter().map(|argument| Argument {
            name: argument.name.to_string(),
            luau: argument.luau.clone(),
            unit: argument.unit.as_ref().map(ToString::to_string),
        });
        Self {
            name: method.name.to_string(),
            what: if matches!(method.call, Call::Read(_)) { What::Reads } else { What::Changes },
            luau: method.returns.clone(),
            arguments: arguments.collect(),
            default: String::new(),
            unit: None,
            doc: method.doc.to_string(),
        }
    }

    /// Its name with that of its owner, as `burgeon api` takes it.
    pub(super) fn full_name(&self, owner: &Entry) -> String {
        let separator = if self.what == What::Field { '.' } else { ':' };
        format!("{}{separator}{}", owner.name, self.name)
    }

    /// How it is written, without the owner.
    pub(super) fn usage(&self) -> String {
        let Self { name, luau, default, .. } = self;
        match self.what {
            What::Field if default == "nil" || default.is_empty() => format!("{name}: {luau}"),
            What::Field => format!("{name}: {luau} = {default}"),
            What::Reads | What::Changes => {
                let arguments: Vec<String> =
                    self.arguments.iter().map(|it| format!("{}: {}", it.name, it.luau)).collect();
                let returns = if luau.is_empty() { String::new() } else { format!(": {luau}") };
                format!("{name}({}){returns}", arguments.join(", "))
            }
        }
    }

    pub(super) fn to_json(&self, owner: &Entry) -> Value {
        if self.what == What::Field {
            return json!({
                "name": self.name, "what": "field", "of": owner.name, "type": self.luau, "unit": self.unit,
                "default": self.default, "doc": self.doc,
            });
        }
        let arguments: Vec<_> = self
            .arguments
            .iter()
            .map(|argument| json!({ "name": argument.name, "type": argument.luau, "unit": argument.unit }))
            .collect();
        json!({
            "name": self.name, "what": "method", "of": owner.name, "changes": self.what == What::Changes,
            "arguments": arguments, "returns": self.luau, "doc": self.doc,
        })
    }
}
