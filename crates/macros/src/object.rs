//! `#[object]`: implements the kind and the trait `Object` for a struct.

use proc_macro2::{Ident, TokenStream};
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Error, Fields, ItemStruct, Result, Type, Visibility};

use crate::attribute::collect;
use crate::fields::{Declaration, default, reader, strip_defaults};
use crate::object_arguments::{Hook, Making, ObjectArguments};
use crate::{doc, draw};

/// Returns the struct with the code that makes it an object type. On failure, returns the struct and an error.
pub(crate) fn expand(
    declared: &ObjectArguments,
    item: TokenStream,
) -> std::result::Result<TokenStream, (TokenStream, Error)> {
    let mut object: ItemStruct = match syn::parse2(item.clone()) {
        Ok(object) => object,
        Err(error) => return Err((item, error)),
    };
    let implementation = implementation(declared, &object);
    strip_defaults(&mut object);
    match implementation {
        Ok(implementation) => Ok(quote! {
            #[derive(Clone)]
            #object
            #implementation
        }),
        Err(error) => Err((quote! { #object }, error)),
    }
}

fn implementation(declared: &ObjectArguments, object: &ItemStruct) -> Result<TokenStream> {
    let kit = &declared.own.kit;
    let name = &object.ident;
    if !object.generics.params.is_empty() {
        return Err(Error::new(object.generics.span(), "a type that scripts see has no type parameters"));
    }
    let Some(doc) = doc::text(&object.attrs) else {
        return Err(Error::new(
            name.span(),
            format!("{name} has no doc comment, which is its help in scripts"),
        ));
    };
    let state = match declared.making {
        Making::Fields => Some(State::read(object)?),
        _ => None,
    };
    let reader = state.as_ref().map(|state| reader(&declared.own, name, &state.given, &state.others));
    let draw = declared.draws.is_some().then(|| draw::implementation(kit, object)).transpose()?;
    let kind = kind(declared, name, &doc::first_paragraph(&doc));
    let hooks = hooks(declared, name, state.as_ref())?;
    Ok(quote! {
        #reader
        #draw

        impl #name {
            /// Returns the type for scripts.
            pub fn kind() -> &'static ::std::sync::Arc<#kit::Kind> {
                static KIND: ::std::sync::LazyLock<::std::sync::Arc<#kit::Kind>> =
                    ::std::sync::LazyLock::new(|| ::std::sync::Arc::new(#kind));
                &KIND
            }
        }

        impl #kit::Object for #name {
            fn kind(&self) -> &::std::sync::Arc<#kit::Kind> {
                Self::kind()
            }

            fn boxed(&self) -> ::std::boxed::Box<dyn #kit::Object> {
                ::std::boxed::Box::new(::std::clone::Clone::clone(self))
            }

            #hooks
        }
    })
}

/// Returns the expression of the kind.
fn kind(declared: &ObjectArguments, object: &Ident, doc: &str) -> TokenStream {
    let kit = &declared.own.kit;
    let name = &declared.own.name;
    let fields = |of: &Type| quote_spanned! { of.span() => <#of>::fields() };
    let made = match &declared.making {
        Making::Given => None,
        Making::Fields => {
            let make = declared.make.as_ref().map_or_else(
                || quote! { #object::from_table },
                |make| quote_spanned! { make.span() => #object::#make },
            );
            Some(quote! { .made_of(#object::fields(), #make) })
        }
        Making::Options(options) => {
            let fields = fields(options);
            let make = declared.make.as_ref().map_or_else(
                || quote_spanned! { options.span() => |table| #object::new(<#options>::from_table(table)?) },
                |make| quote_spanned! { make.span() => #object::#make },
            );
            Some(quote! { .made_of(#fields, #make) })
        }
        Making::File(loader, options) => {
            let fields = options.as_ref().map_or_else(|| quote! { ::std::vec::Vec::new() }, fields);
            Some(quote! { .loaded(#fields, #loader) })
        }
    };
    let calls = |list: &[(Ident, TokenStream)]| -> Vec<TokenStream> {
        list.iter().map(|(verb, value)| quote_spanned! { verb.span() => .#verb(#value) }).collect()
    };
    let (values, renames) = (calls(&declared.values), calls(&declared.renames));
    let draws = declared.draws.as_ref().map(|verb| quote_spanned! { verb.span() => .#verb::<#object>() });
    let capabilities = declared
        .capabilities
        .iter()
        .map(|of| quote_spanned! { of.span() => .can(#kit::capability!(#object: #of)) });
    let begins_empty = declared.begins_empty.as_ref().map(|_| quote! { .begins_empty() });
    quote! {
        #kit::Kind::new(#name, #doc) #made #(#values)* .methods(#object::methods()) #(#renames)* #begins_empty #draws #(#capabilities)*
    }
}

/// Generates the hooks that the engine calls: the named methods, and `begin` for an object that begins empty.
fn hooks(declared: &ObjectArguments, object: &Ident, state: Option<&State<'_>>) -> Result<TokenStream> {
    let kit = &declared.own.kit;
    let named = declared.hooks.iter().map(|(hook, method)| {
        let call = quote_spanned! { method.span() => #object::#method };
        match hook {
            Hook::Begin => quote! { fn begin(&mut self) { #call(self); } },
            Hook::Push => quote! { fn push(&mut self) { #call(self); } },
            Hook::Pop => quote! { fn pop(&mut self) -> #kit::Result<()> { #call(self) } },
            Hook::End => quote! { fn end(&mut self) -> #kit::Result<()> { #call(self) } },
            Hook::Seed => quote! { fn seed(&mut self, seed: u64) { #call(self, seed); } },
        }
    });
    let begins = declared.hooks.iter().any(|(hook, _)| *hook == Hook::Begin);
    let empty = match (&declared.begins_empty, state) {
        (Some(_), Some(state)) if !begins => {
            let empty = &state.empty;
            Some(quote! { fn begin(&mut self) { #(#empty)* } })
        }
        (Some(flag), None) if !begins => {
            return Err(Error::new(flag.span(), "name the method that empties it: begin = restart"));
        }
        _ => None,
    };
    Ok(quote! { #(#named)* #empty })
}

/// Fields of an object that is constructed from its own public fields.
struct State<'a> {
    /// Public fields, which scripts can set.
    given: Vec<Declaration<'a>>,
    /// Other fields with their defaults.
    others: Vec<(&'a Ident, TokenStream)>,
    /// Statements that reset the other fields to their defaults; a drawing keeps its memory.
    empty: Vec<TokenStream>,
}

impl<'a> State<'a> {
    fn read(object: &'a ItemStruct) -> Result<Self> {
        let Fields::Named(named) = &object.fields else {
            let text = "scripts give fields by name: write pub struct Name { ... }, or options = NameOptions";
            return Err(Error::new(object.ident.span(), text));
        };
        let (given, others): (Vec<_>, Vec<_>) =
            named.named.iter().partition(|field| matches!(field.vis, Visibility::Public(_)));
        let given = collect(given.into_iter().map(Declaration::read))?;
        let mut state = Self { given, others: Vec::new(), empty: Vec::new() };
        for field in others {
            let Some(name) = &field.ident else { continue };
            let value = default(field)?;
            state.empty.push(if draw::is_drawing(field) {
                quote! { self.#name.clear(); }
            } else {
                quote! { self.#name = #value; }
            });
            state.others.push((name, value));
        }
        Ok(state)
    }
}

#[cfg(test)]
mod tests {
    use syn::parse_str;

    use super::*;

    /// Returns the error message for `text` with these arguments.
    fn error(arguments: &str, text: &str) -> String {
        let error = match parse_str::<ObjectArguments>(arguments) {
            Ok(declared) => expand(&declared, text.parse().unwrap()).expect_err(text).1,
            Err(error) => error,
        };
        error.to_string()
    }

    #[test]
    fn what_is_no_type_of_object_is_refused() {
        let tower = "/// It.\nstruct Tower { height: f64 }";
        for (arguments, text, message) in [
            ("\"tower\"", "struct Tower {}", "Tower has no doc comment, which is its help in scripts"),
            (
                "\"tower\"",
                "/// It.\nstruct Tower<T> { of: T }",
                "a type that scripts see has no type parameters",
            ),
            (
                "\"tower\"",
                "/// It.\nstruct Tower(f64);",
                "scripts give fields by name: write pub struct Name { ... }, or options = NameOptions",
            ),
            ("\"tower\"", "/// It.\nstruct Tower { pub height: f64 }", "height has no doc comment"),
            ("\"tower\", draws", tower, "an object that draws has one field of type Drawing"),
            (
                "\"tower\", options = TowerOptions, begins_empty",
                tower,
                "name the method that empties it: begin = restart",
            ),
            (
                "\"tower\", shines",
                tower,
                "object takes no shines: it takes begins_empty, can, crate, deprecates, draws, example, first, functions, gathers, given, has, loader, \
                 make, options, prefetches, renames, and of what the engine calls begin, push, pop, end, seed",
            ),
            ("\"tower\", draws, draws", tower, "draws stands here already"),
            (
                "\"tower\", push = pop",
                tower,
                "pop is what the engine calls: give the method of the type another name",
            ),
            ("\"tower\", given, make = new", tower, "what something else gives is not made by scripts"),
            (
                "\"tower\", make = new, loader = LOADER",
                tower,
                "what a file is read for is made by its loader",
            ),
            ("draws", tower, "expected string literal"),
        ] {
            assert_eq!(error(arguments, text), message, "{arguments} {text}");
        }
    }

    #[test]
    fn a_struct_stays_but_for_its_defaults() {
        let text = "/// It.\npub struct Tower { /// Its height (m).\n #[default(3.0)] pub height: f64, floors: u32 }";
        let declared: ObjectArguments = parse_str("\"tower\", begins_empty, crate = burgeon::kit").unwrap();
        let expanded = expand(&declared, text.parse().unwrap()).unwrap().to_string();
        assert!(!expanded.contains("# [default"), "{expanded}");
        assert!(expanded.contains("impl burgeon :: kit :: Object for Tower"), "{expanded}");
        assert!(!expanded.contains("self . height ="), "what scripts gave stays: {expanded}");
        assert!(expanded.contains("self . floors = < u32 as"), "{expanded}");
        // On failure the struct is kept as well, so editors can complete its fields.
        let expanded =
            crate::attribute::expand("\"tower\", shines".parse().unwrap(), text.parse().unwrap(), expand);
        let expanded = expanded.to_string();
        assert!(expanded.contains("pub height : f64") && expanded.contains("compile_error"), "{expanded}");
    }
}
