//! Arguments of `#[object]`.

use proc_macro2::{Ident, TokenStream};
use quote::ToTokens;
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Error, Expr, Path, Result, Token, Type, parenthesized, parse_quote};

use crate::attribute::AttributeArguments;

/// The verbs of a kind that take a value.
const VALUES: [&str; 6] = ["example", "first", "functions", "gathers", "has", "prefetches"];
/// Everything, for messages.
const ALL: &str = "begins_empty, can, crate, deprecates, draws, example, first, functions, gathers, given, has, loader, make, options, prefetches, renames";

/// Arguments of the attribute.
pub(crate) struct ObjectArguments {
    /// Name for scripts, and path of the contract.
    pub own: AttributeArguments,
    /// Construction of objects.
    pub making: Making,
    /// Function of the type that makes an object from a table.
    pub make: Option<Ident>,
    /// Location of the argument `begins_empty`, if it is set.
    pub begins_empty: Option<Ident>,
    /// Set if it draws with the field of type `Drawing`.
    pub draws: Option<Ident>,
    /// Traits that the engine may use it as: `can(Warn, Report)`.
    pub capabilities: Vec<Path>,
    /// Other arguments of the kind, as names of methods of `Kind` with their values.
    pub values: Vec<(Ident, TokenStream)>,
    /// Arguments of `renames`, one for each former name.
    pub renames: Vec<(Ident, TokenStream)>,
    /// Hooks with the methods of the type that implement them.
    pub hooks: Vec<(Hook, Ident)>,
}

/// Construction of objects.
pub(crate) enum Making {
    /// From the public fields of the struct.
    Fields,
    /// From the fields of another struct.
    Options(Type),
    /// From a file that a loader reads, and optionally the fields of another struct.
    File(Expr, Option<Type>),
    /// By another object or function.
    Given,
}

/// Hook that the engine calls.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Hook {
    Begin,
    Push,
    Pop,
    End,
    Seed,
}

impl Hook {
    const ALL: [(&str, Self); 5] = [
        ("begin", Self::Begin),
        ("push", Self::Push),
        ("pop", Self::Pop),
        ("end", Self::End),
        ("seed", Self::Seed),
    ];

    fn named(name: &Ident) -> Option<Self> {
        Self::ALL.into_iter().find(|(known, _)| name == known).map(|(_, hook)| hook)
    }
}

impl Parse for ObjectArguments {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let own = AttributeArguments { name: input.parse()?, kit: parse_quote!(::burgeon_kit) };
        let mut declared = Self {
            own,
            making: Making::Fields,
            make: None,
            begins_empty: None,
            draws: None,
            capabilities: Vec::new(),
            values: Vec::new(),
            renames: Vec::new(),
            hooks: Vec::new(),
        };
        let (mut known, mut options, mut loader, mut given) = (Vec::<Ident>::new(), None, None, false);
        while !input.is_empty() {
            input.parse::<Token![,]>()?;
            if input.is_empty() {
                break;
            }
            let name = input.call(Ident::parse_any)?;
            if name == "deprecates" || name == "renames" {
                let given;
                parenthesized!(given in input);
                let list = if name == "renames" { &mut declared.renames } else { &mut declared.values };
                list.push((name, given.parse()?));
                continue;
            }
            if known.contains(&name) {
                return Err(Error::new(name.span(), format!("{name} stands here already")));
            }
            known.push(name.clone());
            if name == "can" {
                let traits;
                parenthesized!(traits in input);
                let traits = traits.parse_terminated(Path::parse_mod_style, Token![,])?;
                declared.capabilities.extend(traits);
                continue;
            }
            let text = name.to_string();
            match text.as_str() {
                "begins_empty" => declared.begins_empty = Some(name),
                "draws" => declared.draws = Some(name),
                "given" => given = true,
                "crate" => declared.own.kit = value(input, Path::parse_mod_style)?,
                "options" => options = Some(value(input, Type::parse)?),
                "make" => declared.make = Some(value(input, Ident::parse)?),
                "loader" => loader = Some(value(input, Expr::parse)?),
                verb if VALUES.contains(&verb) => {
                    let value = value(input, Expr::parse)?;
                    declared.values.push((name, value.into_token_stream()));
                }
                _ => {
                    let Some(hook) = Hook::named(&name) else { return Err(unknown(&name)) };
                    let method = value(input, Ident::parse)?;
                    // If the type lacks a method of this name, the call would resolve to the trait's method and recurse
                    // endlessly.
                    if Hook::named(&method).is_some() {
                        let text = "is what the engine calls: give the method of the type another name";
                        return Err(Error::new(method.span(), format!("{method} {text}")));
                    }
                    declared.hooks.push((hook, method));
                }
            }
        }
        if let (Some(make), true) = (&declared.make, given || loader.is_some()) {
            return Err(Error::new(
                make.span(),
                if given {
                    "what something else gives is not made by scripts"
                } else {
                    "what a file is read for is made by its loader"
                },
            ));
        }
        declared.making = match (given, loader, options) {
            (true, ..) => Making::Given,
            (false, Some(loader), options) => Making::File(loader, options),
            (false, None, Some(options)) => Making::Options(options),
            (false, None, None) => Making::Fields,
        };
        Ok(declared)
    }
}

fn value<T>(input: ParseStream<'_>, read: fn(ParseStream<'_>) -> Result<T>) -> Result<T> {
    input.parse::<Token![=]>()?;
    input.call(read)
}

fn unknown(name: &Ident) -> Error {
    let hooks = Hook::ALL.map(|(name, _)| name).join(", ");
    Error::new(
        name.span(),
        format!("object takes no {name}: it takes {ALL}, and of what the engine calls {hooks}"),
    )
}
