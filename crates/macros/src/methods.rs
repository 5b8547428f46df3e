//! `#[methods]`: lists the methods of an `impl` block for scripts.

use proc_macro2::{Span, TokenStream};
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{
    Error, FnArg, Ident, ImplItem, ImplItemFn, ItemImpl, Pat, PatType, Receiver, Result, ReturnType,
    Signature, Type, Visibility,
};

use crate::attribute::{AttributeArguments, collect};
use crate::doc;

/// Advice for items that are not methods for scripts.
const ELSEWHERE: &str = "put helpers into a second impl block, without #[methods]";

/// Returns the block with the list of its methods. On failure, returns the block and an error for items that scripts
/// cannot call.
pub(crate) fn expand(
    declared: &AttributeArguments,
    item: TokenStream,
) -> std::result::Result<TokenStream, (TokenStream, Error)> {
    match syn::parse2(item.clone()).and_then(|block| list(declared, &block)) {
        Ok(list) => Ok(quote! { #item #list }),
        Err(error) => Err((item, error)),
    }
}

fn list(declared: &AttributeArguments, block: &ItemImpl) -> Result<TokenStream> {
    if let Some((_, of, _)) = &block.trait_ {
        return Err(Error::new(of.span(), "scripts call a type's own methods: write impl Type { ... }"));
    }
    if !block.generics.params.is_empty() {
        return Err(Error::new(block.generics.span(), "a type that scripts see has no type parameters"));
    }
    let object = &block.self_ty;
    let kit = &declared.kit;
    let methods = collect(block.items.iter().map(MethodSource::read))?;
    let methods = methods.iter().map(|method| method.describe(declared, object));
    Ok(quote! {
        impl #object {
            /// Returns the methods that scripts can call.
            pub fn methods() -> ::std::vec::Vec<#kit::Method> {
                ::std::vec![#(#methods),*]
            }
        }
    })
}

/// Source of a method.
struct MethodSource<'a> {
    name: &'a Ident,
    doc: String,
    /// Set if the method changes the object.
    changes: bool,
    arguments: Vec<(&'a Ident, &'a Type)>,
    returns: Option<&'a Type>,
}

impl<'a> MethodSource<'a> {
    fn read(item: &'a ImplItem) -> Result<Self> {
        let ImplItem::Fn(function) = item else {
            return Err(Error::new(item.span(), format!("only methods can stand here: {ELSEWHERE}")));
        };
        let ImplItemFn { attrs, vis, sig, .. } = function;
        if !matches!(vis, Visibility::Public(_)) {
            let text = format!("scripts can only call public methods: write pub fn, or {ELSEWHERE}");
            return Err(Error::new(sig.ident.span(), text));
        }
        let Some(FnArg::Receiver(receiver)) = sig.inputs.first() else {
            let text = format!("scripts call methods of an object, with &self or &mut self: {ELSEWHERE}");
            return Err(Error::new(sig.ident.span(), text));
        };
        let changes = changes(receiver)?;
        refuse_unusual(sig)?;
        let Some(doc) = doc::text(attrs) else {
            let text = format!("{} has no doc comment, which is its help in scripts", sig.ident);
            return Err(Error::new(sig.ident.span(), text));
        };
        let arguments = sig.inputs.iter().filter_map(|input| match input {
            FnArg::Receiver(_) => None,
            FnArg::Typed(argument) => Some(argument),
        });
        let arguments = arguments.map(named).collect::<Result<_>>()?;
        let returns = match &sig.output {
            ReturnType::Default => None,
            ReturnType::Type(_, returns) => Some(&**returns),
        };
        Ok(Self { name: &sig.ident, doc, changes, arguments, returns })
    }

    /// Returns the expression of the method's description for scripts.
    fn describe(&self, declared: &AttributeArguments, object: &Type) -> TokenStream {
        let kit = &declared.kit;
        let name = self.name.to_string();
        let name = name.trim_start_matches("r#");
        let doc = &self.doc;
        let arguments = self.arguments.iter().map(|(argument, of)| {
            let name = argument.to_string();
            let luau = quote_spanned! { at(of) => <#of as #kit::Parameter>::luau() };
            quote! { #kit::Argument {
                fields: <#of as #kit::Parameter>::fields(),
                ..#kit::Argument::typed(#name, #luau).described(#doc)
            } }
        });
        let returns = match self.returns {
            Some(returns) => quote_spanned! { at(returns) => <#returns as #kit::Answer>::luau() },
            None => quote! { <() as #kit::Answer>::luau() },
        };
        let values = self.call(declared, object, name, false);
        let call = if self.changes {
            let numbers = self.call(declared, object, name, true);
            let are_numbers =
                self.arguments.iter().map(|(_, of)| quote! { && <#of as #kit::Parameter>::IS_NUMBER });
            quote! {
                #kit::Call::Write {
                    values: ::std::sync::Arc::new(#values),
                    numbers: if true #(#are_numbers)* {
                        ::std::option::Option::Some(::std::sync::Arc::new(#numbers))
                    } else {
                        ::std::option::Option::None
                    },
                }
            }
        } else {
            quote! { #kit::Call::Read(::std::sync::Arc::new(#values)) }
        };
        quote! {
            #kit::Method {
                name: #name.into(),
                doc: #doc.into(),
                arguments: ::std::vec![#(#arguments),*],
                returns: #returns,
                call: #call,
            }
        }
    }

    /// Returns the closure that calls the method with values, or only with numbers if `numbers` is set.
    fn call(&self, declared: &AttributeArguments, object: &Type, name: &str, numbers: bool) -> TokenStream {
        let AttributeArguments { name: kind, kit } = declared;
        let method = self.name;
        // Hygienic names cannot clash with the names of arguments.
        let this = Ident::new("this", Span::mixed_site());
        let given = Ident::new("given", Span::mixed_site());
        let taken: Vec<Ident> = (0..self.arguments.len())
            .map(|at| Ident::new(&format!("taken_{at}"), Span::mixed_site()))
            .collect();
        let takes = self.arguments.iter().zip(&taken).map(|((argument, of), taken)| {
            let argument = argument.to_string();
            quote! { let #taken: #of = #given.next(#argument)?; }
        });
        let mutable = (!self.arguments.is_empty()).then(|| quote! { mut });
        let answer = quote! { #kit::Answer::answer(<#object>::#method(#this #(, #taken)*)) };
        let (downcast, reference) = if self.changes {
            (quote! { downcast_mut }, quote! { &mut dyn #kit::Object })
        } else {
            (quote! { downcast_ref }, quote! { &dyn #kit::Object })
        };
        let (reader, of, end, answer) = if numbers {
            let answer = quote! { #answer.map(|_| ()) };
            (quote! { Numbers }, quote! { f64 }, quote! { #given.end(); }, answer)
        } else {
            (quote! { Arguments }, quote! { #kit::Value }, quote! { #given.end()?; }, answer)
        };
        quote! {
            |#this: #reference, #given: &[#of]| {
                let #this = #kit::declare::#downcast::<#object>(#this)?;
                let #mutable #given = #kit::declare::#reader::new(#kind, #name, #given);
                #(#takes)*
                #end
                #answer
            }
        }
    }
}

/// Returns true if a method with this receiver changes its object.
fn changes(receiver: &Receiver) -> Result<bool> {
    match (&receiver.reference, &receiver.colon_token) {
        (Some(_), None) => Ok(receiver.mutability.is_some()),
        _ => Err(Error::new(receiver.span(), "a method for scripts takes &self or &mut self")),
    }
}

/// Refuses signatures that scripts cannot call.
fn refuse_unusual(sig: &Signature) -> Result<()> {
    let refuse =
        |span: Span, what: &str| Err(Error::new(span, format!("a method for scripts {what}: {ELSEWHERE}")));
    if !sig.generics.params.is_empty() {
        return refuse(sig.generics.span(), "has no type parameters");
    }
    if let Some(word) = &sig.asyncness {
        return refuse(word.span, "is not async");
    }
    if let Some(word) = &sig.unsafety {
        return refuse(word.span, "is not unsafe");
    }
    let generic = sig
        .inputs
        .iter()
        .find(|input| matches!(input, FnArg::Typed(argument) if matches!(*argument.ty, Type::ImplTrait(_))));
    generic.map_or(Ok(()), |argument| refuse(argument.span(), "has no type parameters"))
}

/// Returns the name and the type of an argument.
fn named(argument: &PatType) -> Result<(&Ident, &Type)> {
    match &*argument.pat {
        Pat::Ident(name) if name.by_ref.is_none() && name.subpat.is_none() => Ok((&name.ident, &argument.ty)),
        pattern => Err(Error::new(pattern.span(), "an argument of a method for scripts is a plain name")),
    }
}

/// Returns the span for errors about a type in generated code.
pub(crate) fn at(of: &Type) -> Span {
    Span::mixed_site().located_at(of.span())
}

#[cfg(test)]
mod tests {
    use syn::parse_str;

    use super::*;

    /// Returns the messages of the errors for `text`.
    fn errors(text: &str) -> Vec<String> {
        let declared: AttributeArguments = parse_str("\"tower\"").unwrap();
        let (_, error) = expand(&declared, text.parse().unwrap()).expect_err(text);
        error.into_iter().map(|error| error.to_string()).collect()
    }

    #[test]
    fn what_scripts_cannot_call_is_refused() {
        let helpers = "put helpers into a second impl block, without #[methods]";
        for (method, message) in [
            (
                "/// Raises it.\n fn raise(&mut self) {}",
                format!("scripts can only call public methods: write pub fn, or {helpers}"),
            ),
            (
                "/// Raises it.\n pub(crate) fn raise(&mut self) {}",
                format!("scripts can only call public methods: write pub fn, or {helpers}"),
            ),
            (
                "pub fn raise(&mut self) {}",
                "raise has no doc comment, which is its help in scripts".to_owned(),
            ),
            (
                "/// Raises it.\n pub fn raise<T>(&mut self, by: T) {}",
                format!("a method for scripts has no type parameters: {helpers}"),
            ),
            (
                "/// Raises it.\n pub fn raise(&mut self, by: impl Copy) {}",
                format!("a method for scripts has no type parameters: {helpers}"),
            ),
            (
                "/// Makes one.\n pub fn new() -> Self { Self }",
                format!("scripts call methods of an object, with &self or &mut self: {helpers}"),
            ),
            (
                "/// Ends it.\n pub fn end(self) {}",
                "a method for scripts takes &self or &mut self".to_owned(),
            ),
            (
                "/// Raises it.\n pub async fn raise(&mut self) {}",
                format!("a method for scripts is not async: {helpers}"),
            ),
            (
                "/// Raises it.\n pub fn raise(&mut self, (a, b): Pair) {}",
                "an argument of a method for scripts is a plain name".to_owned(),
            ),
            ("const HIGHEST: f64 = 9.0;", format!("only methods can stand here: {helpers}")),
        ] {
            let found = errors(&format!("impl Tower {{\n {method}\n}}"));
            assert_eq!(found, [message], "{method}");
        }
    }

    #[test]
    fn all_that_is_wrong_with_a_block_is_told() {
        let found =
            errors("impl Tower {\n fn a(&self) {}\n /// Fine.\n pub fn b(&self) {}\n pub fn c(&self) {}\n}");
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].contains("write pub fn") && found[1].starts_with("c has no doc"), "{found:?}");
    }

    #[test]
    fn a_block_is_a_types_own() {
        for text in ["impl Object for Tower {}", "impl<T> Tower<T> {}"] {
            assert_eq!(errors(text).len(), 1, "{text}");
        }
    }

    #[test]
    fn a_block_stays_as_it_is() {
        let text = "impl Tower { /// Raises it.\n pub fn raise(&mut self, by: f64) { self.height += by; } }";
        let block: TokenStream = text.parse().unwrap();
        let declared: AttributeArguments = parse_str("\"tower\"").unwrap();
        let expanded = expand(&declared, block.clone()).unwrap();
        assert!(expanded.to_string().starts_with(&block.to_string()));
        assert!(expanded.to_string().contains(":: burgeon_kit :: Method"));
        // On failure the block is kept as well, so editors can complete its methods.
        let block: TokenStream = "impl Tower { fn raise(&self) {} }".parse().unwrap();
        let given = block.to_string();
        let expanded = crate::attribute::expand("\"tower\"".parse().unwrap(), block, expand).to_string();
        assert!(expanded.starts_with(&given) && expanded.contains("compile_error"), "{expanded}");
    }
}
