//! What there is to tell of a name that scripts can use.

use burgeon::kit::{Construct, Field, Kind, Method, Registry};
use burgeon::script::{Name, Part, Sort};
use serde_json::{Value, json};

/// A name that scripts can use.
pub(super) struct Entry {
    pub name: String,
    pub group: Group,
    /// How it is written; empty where scripts cannot make it.
    pub usage: String,
    pub doc: String,
    /// Its fields, then its methods.
    pub members: Vec<Member>,
    /// A script that uses it.
    pub example: String,
}

/// What a name is, in the order in which people are told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Group {
    /// A type of object.
    Type,
    /// A function or a value.
    Global,
    /// The constructor of modules.
    Module,
    /// What others give.
    Given,
    /// A function or a library of Luau itself.
    Luau,
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
    /// What the table may have that it is or takes.
    pub fields: Vec<Member>,
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
    /// A method of what is no object, for the top level of a script.
    Declares,
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
        Self { name, group: Group::Type, usage, doc, members, example: kind.example.to_string() }
    }

    /// A name that every script has; a module does what the method of a type of object does.
    pub(super) fn of_name(name: &Name, registry: &Registry) -> Self {
        let group = match name.sort {
            Sort::Global => Group::Global,
            Sort::Module { .. } => Group::Module,
            Sort::Given => Group::Given,
            Sort::Luau => Group::Luau,
        };
        let usage = match &*name.luau {
            _ if group == Group::Given => String::new(),
            call if call.starts_with('(') => format!("{}{call}", name.name),
            luau => format!("{}: {luau}", name.name),
        };
        let mut doc = name.doc.to_string();
        if let Sort::Module { kind, method } = name.sort
            && let Some(method) = registry.get(kind).and_then(|kind| kind.method(method))
        {
            doc = format!("{} {doc}", method.doc);
        }
        let members = name.parts.iter().map(Member::of_part).collect();
        Self { name: name.name.to_string(), group, usage, doc, members, example: String::new() }
    }

    /// Those of its members that are `what`.
    pub(super) fn members(&self, what: What) -> impl Iterator<Item = &Member> {
        self.members.iter().filter(move |member| member.what == what)
    }

    pub(super) fn to_json(&self) -> Value {
        let fields: Vec<_> = self.members(What::Field).map(|field| field.to_json(&self.name)).collect();
        let methods: Vec<_> = self.members.iter().filter(|member| member.what != What::Field).collect();
        let methods: Vec<_> = methods.into_iter().map(|method| method.to_json(&self.name)).collect();
        let what = match self.group {
            Group::Type => "type",
            Group::Global if self.usage.contains('(') => "function",
            Group::Global => "value",
            Group::Module => "module",
            Group::Given => "given",
            Group::Luau => "luau",
        };
        json!({
            "name": self.name, "what": what, "usage": self.usage, "doc": self.doc,
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
            fields: field.fields.iter().map(Self::of_field).collect(),
        }
    }

    fn of_part(part: &Part) -> Self {
        Self {
            name: part.name.to_owned(),
            what: if part.is_method { What::Declares } else { What::Field },
            luau: part.luau.to_owned(),
            arguments: Vec::new(),
            default: part.default.to_owned(),
            unit: part.unit.map(str::to_owned),
            doc: part.doc.to_owned(),
            fields: Vec::new(),
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
            what: if method.call.changes() { What::Changes } else { What::Reads },
            luau: method.returns.clone(),
            arguments: arguments.collect(),
            default: String::new(),
            unit: None,
            doc: method.doc.to_string(),
            fields: method.arguments.iter().flat_map(|it| &it.fields).map(Self::of_field).collect(),
        }
    }

    /// Its name after that of its `owner`, as `burgeon api` takes it.
    pub(super) fn full_name(&self, owner: &str) -> String {
        let separator = if self.what == What::Field { '.' } else { ':' };
        format!("{owner}{separator}{}", self.name)
    }

    /// How it is written, without the owner.
    pub(super) fn usage(&self) -> String {
        let Self { name, luau, default, .. } = self;
        match self.what {
            What::Field if default == "nil" || default.is_empty() => format!("{name}: {luau}"),
            What::Field => format!("{name}: {luau} = {default}"),
            What::Declares => format!("{name}{luau}"),
            What::Reads | What::Changes => {
                let arguments: Vec<String> =
                    self.arguments.iter().map(|it| format!("{}: {}", it.name, it.luau)).collect();
                let returns = if luau.is_empty() { String::new() } else { format!(" -> {luau}") };
                format!("{name}({}){returns}", arguments.join(", "))
            }
        }
    }

    /// What machines are told; `owner` is what has it.
    pub(super) fn to_json(&self, owner: &str) -> Value {
        let fields: Vec<_> = self.fields.iter().map(|field| field.to_json(&self.full_name(owner))).collect();
        if self.what == What::Field {
            return json!({
                "name": self.name, "what": "field", "of": owner, "type": self.luau, "unit": self.unit,
                "default": self.default, "doc": self.doc, "fields": fields,
            });
        }
        if self.what == What::Declares {
            return json!({
                "name": self.name, "what": "method", "of": owner, "type": self.luau, "doc": self.doc,
            });
        }
        let arguments: Vec<_> = self
            .arguments
            .iter()
            .map(|argument| json!({ "name": argument.name, "type": argument.luau, "unit": argument.unit }))
            .collect();
        json!({
            "name": self.name, "what": "method", "of": owner, "changes": self.what == What::Changes,
            "arguments": arguments, "returns": self.luau, "doc": self.doc, "fields": fields,
        })
    }
}
