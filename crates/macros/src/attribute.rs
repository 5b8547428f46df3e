//! Arguments of the attributes, and the expansion of refused items.

use proc_macro2::TokenStream;
use syn::parse::{Parse, ParseStream};
use syn::{LitStr, Path, Result, Token, parse_quote};

/// Arguments of an attribute: the declared name, and the crate with the contract of objects.
pub(crate) struct AttributeArguments {
    /// Name for scripts and messages.
    pub name: LitStr,
    /// Path of the contract.
    pub kit: Path,
}

impl Parse for AttributeArguments {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let name = input.parse()?;
        let mut kit = parse_quote!(::burgeon_kit);
        if input.parse::<Option<Token![,]>>()?.is_some() && !input.is_empty() {
            input.parse::<Token![crate]>()?;
            input.parse::<Token![=]>()?;
            kit = input.call(Path::parse_mod_style)?;
        }
        Ok(Self { name, kit })
    }
}

/// Expands an item with `expand`. If it fails, returns the item unchanged with the error, so editors still know the
/// members of the item.
pub(crate) fn expand<A: Parse>(
    arguments: TokenStream,
    item: TokenStream,
    expand: impl Fn(&A, TokenStream) -> std::result::Result<TokenStream, (TokenStream, syn::Error)>,
) -> TokenStream {
    let expanded = match syn::parse2(arguments) {
        Ok(declared) => expand(&declared, item),
        Err(error) => Err((item, error)),
    };
    expanded.unwrap_or_else(|(mut item, error)| {
        item.extend(error.into_compile_error());
        item
    })
}

/// Returns all of `results`, or all errors among them combined into one.
pub(crate) fn collect<T>(results: impl Iterator<Item = Result<T>>) -> Result<Vec<T>> {
    let mut all = Vec::new();
    let mut errors: Option<syn::Error> = None;
    for result in results {
        match (result, &mut errors) {
            (Ok(one), _) => all.push(one),
            (Err(error), Some(errors)) => errors.combine(error),
            (Err(error), None) => errors = Some(error),
        }
    }
    errors.map_or(Ok(all), Err)
}
