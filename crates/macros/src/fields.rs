//! `#[fields]`: implements reading a struct from a script's table.

use proc_macro2::TokenStream;
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Attribute, Error, Expr, Field, Fields, Ident, ItemStruct, Result, Type, Visibility};

use crate::attribute::{AttributeArguments, collect};
use crate::doc;
use crate::methods::at;

/// Returns the struct with the code that reads it. On failure, returns the struct and an error for fields that scripts
/// cannot set.
pub(crate) fn expand(
    declared: &AttributeArguments,
    item: TokenStream,
) -> std::result::Result<TokenStream, (TokenStream, Error)> {
    let mut table: ItemStruct = match syn::parse2(item.clone()) {
        Ok(table) => table,
        Err(error) => return Err((item, error)),
    };
    match reading(declared, &table) {
        Ok(reading) => {
            strip_defaults(&mut table);
            Ok(quote! {
                #[derive(Debug, Clone)]
                #table
                #reading
            })
        }
        Err(error) => {
            strip_defaults(&mut table);
            Err((quote! { #table }, error))
        }
    }
}

/// Removes the attributes that only this macro knows.
pub(crate) fn strip_defaults(table: &mut ItemStruct) {
    table.fields.iter_mut().for_each(|field| field.attrs.retain(|attribute| !is_default(attribute)));
}

fn is_default(attribute: &Attribute) -> bool {
    attribute.path().is_ident("default")
}

fn reading(declared: &AttributeArguments, table: &ItemStruct) -> Result<TokenStream> {
    let kit = &declared.kit;
    let options = &table.ident;
    if !table.generics.params.is_empty() {
        return Err(Error::new(table.generics.span(), "a table of fields has no type parameters"));
    }
    let Fields::Named(named) = &table.fields else {
        return Err(Error::new(options.span(), "scripts give fields by name: write pub struct Name { ... }"));
    };
    if doc::text(&table.attrs).is_none() {
        return Err(Error::new(options.span(), format!("{options} has no doc comment")));
    }
    let fields = collect(named.named.iter().map(Declaration::read))?;
    let reader = reader(declared, options, &fields, &[]);
    Ok(quote! {
        #reader

        impl #kit::Fields for #options {
            fn list() -> ::std::vec::Vec<#kit::Field> {
                Self::fields()
            }

            fn read(table: &#kit::Table) -> #kit::Result<Self> {
                Self::from_table(table)
            }
        }
    })
}

/// Generates `Default`, `fields` and `from_table` for the struct `options`. Scripts can set its `fields`, but not its
/// `others`, which always begin with their defaults.
pub(crate) fn reader(
    declared: &AttributeArguments,
    options: &Ident,
    fields: &[Declaration<'_>],
    others: &[(&Ident, TokenStream)],
) -> TokenStream {
    let AttributeArguments { name: kind, kit } = declared;
    let others = others.iter().map(|(name, default)| quote! { #name: #default });
    let defaults = fields.iter().map(|Declaration { name, default, .. }| quote! { #name: #default });
    let described = fields.iter().map(|field| field.describe(declared));
    let texts: Vec<&String> = fields.iter().map(|field| &field.text).collect();
    let reads = fields.iter().map(|Declaration { name, text, of, .. }| {
        let read = quote_spanned! { at(of) => <#of as #kit::Parameter>::read_value };
        quote! {
            if let ::std::option::Option::Some(value) = table.get(#text) {
                options.#name =
                    #read(value).map_err(|expected| expected.refuse(#kind, #text, value))?;
            }
        }
    });
    quote! {
        impl ::std::default::Default for #options {
            fn default() -> Self {
                Self { #(#defaults,)* #(#others,)* }
            }
        }

        impl #options {
            /// Returns the fields, for documentation.
            pub fn fields() -> ::std::vec::Vec<#kit::Field> {
                ::std::vec![#(#described),*]
            }

            /// Reads a script's table. Fails for unknown names and wrong types.
            pub fn from_table(table: &#kit::Table) -> #kit::Result<Self> {
                #kit::declare::refuse_unknown(#kind, &[#(#texts),*], table)?;
                let mut options = <Self as ::std::default::Default>::default();
                #(#reads)*
                ::std::result::Result::Ok(options)
            }
        }
    }
}

/// Returns the expression of a field's default.
pub(crate) fn default(field: &Field) -> Result<TokenStream> {
    let of = &field.ty;
    let mut given = field.attrs.iter().filter(|attribute| is_default(attribute));
    match (given.next(), given.next()) {
        (_, Some(second)) => {
            let name = field.ident.as_ref().map_or("it".to_owned(), Ident::to_string);
            Err(Error::new(second.span(), format!("{name} has a default already")))
        }
        (Some(attribute), None) => {
            let value: Expr = attribute.parse_args().map_err(|error| {
                Error::new(error.span(), "write the value in round brackets: #[default(0.5)]")
            })?;
            Ok(quote! { #value })
        }
        (None, None) => Ok(quote_spanned! { at(of) => <#of as ::std::default::Default>::default() }),
    }
}

/// Source of a field.
pub(crate) struct Declaration<'a> {
    name: &'a Ident,
    /// Name in scripts.
    text: String,
    doc: String,
    of: &'a Type,
    default: TokenStream,
}

impl<'a> Declaration<'a> {
    pub(crate) fn read(field: &'a Field) -> Result<Self> {
        let Some(name) = &field.ident else {
            return Err(Error::new(field.span(), "scripts give fields by name"));
        };
        if !matches!(field.vis, Visibility::Public(_)) {
            return Err(Error::new(
                name.span(),
                format!("scripts give every field of the table: write pub {name}"),
            ));
        }
        let Some(doc) = doc::text(&field.attrs) else {
            return Err(Error::new(name.span(), format!("{name} has no doc comment")));
        };
        let (of, default) = (&field.ty, default(field)?);
        let text = name.to_string().trim_start_matches("r#").to_owned();
        Ok(Self { name, text, doc, of, default })
    }

    /// Returns the expression of the field's description for scripts.
    fn describe(&self, declared: &AttributeArguments) -> TokenStream {
        let kit = &declared.kit;
        let Self { text, doc, of, default, .. } = self;
        let luau = quote_spanned! { at(of) => <#of as #kit::Parameter>::luau() };
        quote! {
            #kit::Field {
                name: #text.into(),
                doc: #doc.into(),
                luau: #luau,
                unit: #kit::declare::unit(#doc).map(::std::convert::Into::into),
                fields: <#of as #kit::Parameter>::fields(),
                default: {
                    let value: #of = #default;
                    #kit::Parameter::written(value)
                },
                former: ::std::vec::Vec::new(),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use syn::parse_str;

    use super::*;

    #[test]
    fn what_scripts_cannot_give_is_refused() {
        for (text, message) in [
            ("/// It.\nstruct Tower(f64);", "scripts give fields by name: write pub struct Name { ... }"),
            ("struct Tower {}", "Tower has no doc comment"),
            (
                "/// It.\nstruct Tower<T> {\n /// Its height.\n pub height: T }",
                "a table of fields has no type parameters",
            ),
            (
                "/// It.\nstruct Tower {\n /// Its height.\n height: f64 }",
                "scripts give every field of the table: write pub height",
            ),
            ("/// It.\nstruct Tower { pub height: f64 }", "height has no doc comment"),
            (
                "/// It.\nstruct Tower {\n /// Its height.\n #[default]\n pub height: f64 }",
                "write the value in round brackets: #[default(0.5)]",
            ),
            (
                "/// It.\nstruct Tower {\n /// Its height.\n #[default(1)] #[default(2)]\n pub height: f64 }",
                "height has a default already",
            ),
        ] {
            let declared: AttributeArguments = parse_str("\"tower\"").unwrap();
            let (kept, error) = expand(&declared, text.parse().unwrap()).expect_err(text);
            assert_eq!(error.to_string(), message, "{text}");
            assert!(kept.to_string().contains("Tower") && !kept.to_string().contains("[default"), "{kept}");
        }
    }

    #[test]
    fn an_attribute_names_what_it_is_for_and_the_contract() {
        let kit = |text: &str| {
            parse_str::<AttributeArguments>(text).map(|declared| {
                let kit = declared.kit;
                quote! { #kit }.to_string()
            })
        };
        assert_eq!(kit("\"tower\"").unwrap(), ":: burgeon_kit");
        assert_eq!(kit("\"tower\", crate = burgeon::kit").unwrap(), "burgeon :: kit");
        assert_eq!(kit("\"tower\", crate = crate").unwrap(), "crate");
        for text in ["", "tower", "\"tower\" crate = a", "\"tower\", kit = a", "\"tower\", crate"] {
            assert!(kit(text).is_err(), "{text}");
        }
    }
}
