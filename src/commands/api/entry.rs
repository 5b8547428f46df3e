//! What there is to tell of a name that scripts can use.

use burgeon::kit::{Construct, Deprecation, Field, Kind, Method, Registry};
use burgeon::script::{Name, NameKind, NameMember};
use serde_json::{Value, json};

/// A name that scripts can use.
pub(super) struct Entry {
    pub name: String,
    pub group: EntryGroup,
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
pub(super) enum EntryGroup {
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
    pub what: MemberKind,
    /// The type of a field, or of what a method returns.
    pub luau: String,
    pub arguments: Vec<EntryArgument>,
    /// The value of a field that is left out.
    pub default: String,
    pub unit: Option<String>,
    pub doc: String,
    /// What the table may have that it is or takes.
    pub fields: Vec<Member>,
}

/// What a member is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum MemberKind {
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
pub(super) struct EntryArgument {
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
        let mut members: Vec<Member> = fields.chain(kind.methods.iter().map(Member::of_method)).collect();
        for member in &mut members {
            member.doc += &deprecation(kind.deprecation(&member.name));
        }
        let (name, doc) =
            (kind.name.to_string(), format!("{}{}", kind.doc, deprecation(kind.deprecation(""))));
        Self { name, group: EntryGroup::Type, usage, doc, members, example: kind.example.to_string() }
    }

    /// A name that every script has; a module does what the method of a type of object does.
    pub(super) fn of_name(name: &Name, registry: &Registry) -> Self {
        let group = match name.sort {
            NameKind::Global => EntryGroup::Global,
            NameKind::Module { .. } => EntryGroup::Module,
            NameKind::Given => EntryGroup::Given,
            NameKind::Luau => EntryGroup::Luau,
        };
        let usage = match &*name.luau {
            _ if group == EntryGroup::Given => String::new(),
            call if call.starts_with('(') => format!("{}{call}", name.name),
            luau => format!("{}: {luau}", name.name),
        };
        let mut doc = name.doc.to_string();
        if let NameKind::Module { kind, method } = name.sort
            && let Some(method) = registry.get(kind).and_then(|kind| kind.method(method))
        {
            doc = format!("{} {doc}", method.doc);
        }
        doc += &deprecation(name.deprecated.as_ref());
        let members = name.parts.iter().map(Member::of_part).collect();
        Self { name: name.name.to_string(), group, usage, doc, members, example: String::new() }
    }

    /// Those of its members that are `what`.
    pub(super) fn members(&self, what: MemberKind) -> impl Iterator<Item = &Member> {
        self.members.iter().filter(move |member| member.what == what)
    }

    pub(super) fn to_json(&self) -> Value {
        let fields: Vec<_> = self.members(MemberKind::Field).map(|field| field.to_json(&self.name)).collect();
        let methods: Vec<_> = self.members.iter().filter(|member| member.what != MemberKind::Field).collect();
        let methods: Vec<_> = methods.into_iter().map(|method| method.to_json(&self.name)).collect();
        let what = match self.group {
            EntryGroup::Type => "type",
            EntryGroup::Global if self.usage.contains('(') => "function",
            EntryGroup::Global => "value",
            EntryGroup::Module => "module",
            EntryGroup::Given => "given",
            EntryGroup::Luau => "luau",
        };
        json!({
            "name": self.name, "what": what, "usage": self.usage, "doc": self.doc,
            "fields": fields, "methods": methods, "example": self.example,
        })
    }
}

/// What is told of a name that will go, behind what it does.
fn deprecation(found: Option<&Deprecation>) -> String {
    found.map_or_else(String::new, |it| format!(" Deprecated since {}: use {}.", it.since, it.instead))
}

impl Member {
    fn of_field(field: &Field) -> Self {
        Self {
            name: field.name.to_string(),
            what: MemberKind::Field,
            luau: field.luau.clone(),
            arguments: Vec::new(),
            default: field.default.clone(),
            unit: field.unit.as_ref().map(ToString::to_string),
            doc: field.doc.to_string(),
            fields: field.fields.iter().map(Self::of_field).collect(),
        }
    }

    fn of_part(part: &NameMember) -> Self {
        Self {
            name: part.name.to_owned(),
            what: if part.is_method { MemberKind::Declares } else { MemberKind::Field },
            luau: part.luau.to_owned(),
            arguments: Vec::new(),
            default: part.default.to_owned(),
            unit: part.unit.map(str::to_owned),
            doc: part.doc.to_owned(),
            fields: Vec::new(),
        }
    }

    fn of_method(method: &Method) -> Self {
        let arguments = method.arguments.iter().map(|argument| EntryArgument {
            name: argument.name.to_string(),
            luau: argument.luau.clone(),
            unit: argument.unit.as_ref().map(ToString::to_string),
        });
        Self {
            name: method.name.to_string(),
            what: if method.call.changes() { MemberKind::Changes } else { MemberKind::Reads },
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
        let separator = if self.what == MemberKind::Field { '.' } else { ':' };
        format!("{owner}{separator}{}", self.name)
    }

    /// How it is written, without the owner.
    pub(super) fn usage(&self) -> String {
        let Self { name, luau, default, .. } = self;
        match self.what {
            MemberKind::Field if default == "nil" || default.is_empty() => format!("{name}: {luau}"),
            MemberKind::Field => format!("{name}: {luau} = {default}"),
            MemberKind::Declares => format!("{name}{luau}"),
            MemberKind::Reads | MemberKind::Changes => {
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
        if self.what == MemberKind::Field {
            return json!({
                "name": self.name, "what": "field", "of": owner, "type": self.luau, "unit": self.unit,
                "default": self.default, "doc": self.doc, "fields": fields,
            });
        }
        if self.what == MemberKind::Declares {
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
            "name": self.name, "what": "method", "of": owner, "changes": self.what == MemberKind::Changes,
            "arguments": arguments, "returns": self.luau, "doc": self.doc, "fields": fields,
        })
    }
}
