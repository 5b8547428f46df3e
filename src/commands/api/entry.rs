//! Descriptions of the names that scripts can use.

use burgeon::kit::{Construct, Deprecation, Field, Kind, Method, Registry, ScriptExample};
use burgeon::language::{self, CallForm, Name, NameKind, module_form};
use burgeon::objects;
use serde_json::{Value, json};

/// Name that scripts can use.
pub(super) struct Entry {
    pub name: String,
    pub group: EntryGroup,
    /// Notation, one form per line; empty if scripts cannot create it.
    pub usage: String,
    /// Signatures, if it is a function of the language.
    pub forms: Vec<CallForm>,
    pub doc: String,
    /// Fields, followed by methods.
    pub members: Vec<Member>,
    /// Example script.
    pub example: String,
}

/// Group of a name, in the order of the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum EntryGroup {
    /// Object type.
    Type,
    /// Function or value.
    Global,
    /// Constructor of modules.
    Module,
    /// Type of values that other functions return.
    Given,
    /// Function or library of Luau itself.
    Luau,
}

/// Field or method.
pub(super) struct Member {
    pub name: String,
    pub what: MemberKind,
    /// Type of a field or value that cannot be called.
    pub luau: String,
    /// Signatures.
    pub forms: Vec<CallForm>,
    /// Default value of a field.
    pub default: String,
    pub unit: Option<String>,
    pub doc: String,
    /// Fields of its table type or table argument.
    pub fields: Vec<Member>,
    /// Example script; empty if there is none.
    pub example: String,
}

/// Type of a member.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum MemberKind {
    /// Field of the table that creates its owner.
    Field,
    /// Read method.
    Reads,
    /// Write method.
    Changes,
    /// Method of a value that is not an object.
    Declares,
    /// Function of a library, or a value.
    Function,
}

impl Entry {
    /// Describes an object type.
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
            member.example = example_of_member(kind, member);
        }
        let (name, doc) =
            (kind.name.to_string(), format!("{}{}", kind.doc, deprecation(kind.deprecation(""))));
        Self {
            name,
            group: EntryGroup::Type,
            usage,
            forms: Vec::new(),
            doc,
            members,
            example: kind.example.to_string(),
        }
    }

    /// Describes a name that every script has. The description of a module is that of the corresponding method of an
    /// object type.
    pub(super) fn of_name(name: &Name, registry: &Registry) -> Self {
        let group = match name.sort {
            NameKind::Global => EntryGroup::Global,
            NameKind::Module { .. } => EntryGroup::Module,
            NameKind::Given | NameKind::Function => EntryGroup::Given,
            NameKind::Luau => EntryGroup::Luau,
        };
        let (mut doc, mut forms) = (name.doc.to_string(), name.forms.clone());
        if let NameKind::Module { kind, method } = name.sort {
            let method = registry.get(kind).and_then(|kind| kind.method(method));
            doc = method.map_or(String::new(), |method| format!("{} ", method.doc)) + &doc;
            forms = vec![module_form(name, method)];
        }
        let usage = match &*name.luau {
            _ if group == EntryGroup::Given => String::new(),
            "" if forms.is_empty() => name.name.to_string(),
            "" => written(&name.name, &forms),
            luau => format!("{}: {luau}", name.name),
        };
        doc += &deprecation(name.deprecated.as_ref());
        let fields = name.options().chain(&name.fields).map(Member::of_field);
        let what = if group == EntryGroup::Given { MemberKind::Declares } else { MemberKind::Function };
        let functions = name.functions.iter().map(|function| Member::of_function(function, what));
        let mut members: Vec<Member> = fields.chain(functions).collect();
        for member in &mut members {
            member.example = example_in(language::EXAMPLES, &member.full_name(&name.name));
        }
        let example = example_in(language::EXAMPLES, &name.name);
        Self { name: name.name.to_string(), group, usage, forms, doc, members, example }
    }

    /// Returns the members of type `what`.
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
            "name": self.name, "what": what, "usage": self.usage, "forms": forms_json(&self.forms), "doc": self.doc,
            "fields": fields, "methods": methods, "example": self.example,
        })
    }
}

/// Returns the script in a list that shows `name`; empty if there is none.
fn example_in(list: &[ScriptExample], name: &str) -> String {
    let found = list.iter().find(|example| example.shows.contains(&name));
    found.map_or_else(String::new, |example| example.script.to_owned())
}

/// Returns the script that shows a field or a method of a type: its own, or the type's if it calls the method. A former
/// name has the script of the present name.
fn example_of_member(kind: &Kind, member: &Member) -> String {
    let example = |name: &str| {
        let lists = [objects::EXAMPLES, objects::PLAIN_EXAMPLES];
        let full = format!("{}{}{name}", kind.name, member.what.separator());
        let own = lists.into_iter().map(|list| example_in(list, &full)).find(|found| !found.is_empty());
        let calls = member.what != MemberKind::Field && kind.example.contains(&format!(":{name}("));
        own.or_else(|| calls.then(|| kind.example.to_string()))
    };
    // The replacement is qualified by the type: network:grow_to.
    let of_present = || example(kind.deprecation(&member.name)?.instead.rsplit([':', '.']).next()?);
    example(&member.name).or_else(of_present).unwrap_or_default()
}

/// Returns the deprecation notice of a name, which follows its description.
fn deprecation(found: Option<&Deprecation>) -> String {
    found.map_or_else(String::new, |it| format!(" Deprecated since {}: use {}.", it.since, it.instead))
}

/// Returns the notice of the former names of a field, which follows its description.
fn former_names(field: &Field) -> String {
    field
        .former
        .iter()
        .map(|it| format!(" Former name: `{}`, deprecated since {}.", it.name, it.since))
        .collect()
}

impl Member {
    fn of_field(field: &Field) -> Self {
        Self {
            name: field.name.to_string(),
            what: MemberKind::Field,
            luau: field.luau.clone(),
            forms: Vec::new(),
            default: field.default.clone(),
            unit: field.unit.as_ref().map(ToString::to_string),
            doc: format!("{}{}", field.doc, former_names(field)),
            fields: field.fields.iter().map(Self::of_field).collect(),
            example: String::new(),
        }
    }

    fn of_function(function: &Name, what: MemberKind) -> Self {
        Self {
            name: function.name.to_string(),
            what,
            luau: function.luau.to_string(),
            forms: function.forms.clone(),
            default: String::new(),
            unit: None,
            doc: function.doc.to_string(),
            fields: function.options().map(Self::of_field).collect(),
            example: String::new(),
        }
    }

    fn of_method(method: &Method) -> Self {
        let form = CallForm::new(method.arguments.clone(), &method.returns);
        Self {
            name: method.name.to_string(),
            what: if method.call.changes() { MemberKind::Changes } else { MemberKind::Reads },
            luau: String::new(),
            forms: vec![form],
            default: String::new(),
            unit: None,
            doc: method.doc.to_string(),
            fields: method.arguments.iter().flat_map(|it| &it.fields).map(Self::of_field).collect(),
            example: String::new(),
        }
    }

    /// Returns the name qualified by its `owner`, as `burgeon api` accepts it.
    pub(super) fn full_name(&self, owner: &str) -> String {
        let separator = self.what.separator();
        format!("{owner}{separator}{}", self.name)
    }

    /// Returns the notation without the owner.
    pub(super) fn usage(&self) -> String {
        self.usage_as(&self.name)
    }

    /// Returns the notation with `name` instead of its own name.
    pub(super) fn usage_as(&self, name: &str) -> String {
        let Self { luau, default, .. } = self;
        match self.what {
            MemberKind::Field if default == "nil" || default.is_empty() => format!("{name}: {luau}"),
            MemberKind::Field => format!("{name}: {luau} = {default}"),
            _ if self.forms.is_empty() => format!("{name}: {luau}"),
            _ => written(name, &self.forms),
        }
    }

    /// Describes the member as JSON; `owner` is the name of its owner.
    pub(super) fn to_json(&self, owner: &str) -> Value {
        let fields: Vec<_> = self.fields.iter().map(|field| field.to_json(&self.full_name(owner))).collect();
        if self.what == MemberKind::Field {
            return json!({
                "name": self.name, "what": "field", "of": owner, "type": self.luau, "unit": self.unit,
                "default": self.default, "doc": self.doc, "fields": fields, "example": self.example,
            });
        }
        let kind = if self.what == MemberKind::Function { "function" } else { "method" };
        match (self.what, &self.forms[..]) {
            (MemberKind::Reads | MemberKind::Changes, [form]) => json!({
                "name": self.name, "what": kind, "of": owner, "changes": self.what == MemberKind::Changes,
                "arguments": arguments_json(form), "returns": form.returns, "doc": self.doc, "fields": fields,
                "example": self.example,
            }),
            (_, forms) => json!({
                "name": self.name, "what": kind, "of": owner, "type": self.luau, "forms": forms_json(forms),
                "doc": self.doc, "fields": fields, "example": self.example,
            }),
        }
    }
}

impl MemberKind {
    /// Returns the separator between an owner's name and a member's.
    pub(super) fn separator(self) -> char {
        if matches!(self, Self::Field | Self::Function) { '.' } else { ':' }
    }
}

/// Returns the signatures, one per line.
fn written(name: &str, forms: &[CallForm]) -> String {
    let forms: Vec<String> = forms.iter().map(|form| format!("{name}{form}")).collect();
    forms.join("\n")
}

fn forms_json(forms: &[CallForm]) -> Value {
    let form = |form: &CallForm| json!({ "arguments": arguments_json(form), "returns": form.returns });
    forms.iter().map(form).collect()
}

fn arguments_json(form: &CallForm) -> Value {
    let arguments = form.arguments.iter().map(|argument| {
        json!({
            "name": argument.name, "type": argument.luau, "unit": argument.unit, "default": argument.default,
        })
    });
    arguments.collect()
}
