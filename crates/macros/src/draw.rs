//! `#[derive(Draw)]`: where an object has its drawing.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Error, ItemStruct, Path, Result, Type, parse_quote};

/// `Draw` for a struct with one field of type `Drawing`.
pub(crate) fn expand(item: TokenStream) -> Result<TokenStream> {
    let item: ItemStruct = syn::parse2(item)?;
    let mut kit: Path = parse_quote!(::burgeon_kit);
    for attribute in item.attrs.iter().filter(|attribute| attribute.path().is_ident("draw")) {
        attribute.parse_nested_meta(|meta| {
            if !meta.path.is_ident("crate") {
                return Err(meta.error("only the path of the contract: draw(crate = burgeon::kit)"));
            }
            kit = meta.value()?.call(Path::parse_mod_style)?;
            Ok(())
        })?;
    }
    let name = &item.ident;
    let mut drawings = item.fields.members().zip(&item.fields).filter(|(_, field)| is_drawing(&field.ty));
    let (Some((field, _)), None) = (drawings.next(), drawings.next()) else {
        return Err(Error::new_spanned(name, "an object that draws has one field of type Drawing"));
    };
    let (impl_generics, type_generics, conditions) = item.generics.split_for_impl();
    Ok(quote! {
        impl #impl_generics #kit::Draw for #name #type_generics #conditions {
            fn drawing(&self) -> &#kit::Drawing {
                &self.#field
            }

            fn drawing_mut(&mut self) -> &mut #kit::Drawing {
                &mut self.#field
            }
        }
    })
}

/// Whether a field's type is called `Drawing`, with or without a path.
fn is_drawing(of: &Type) -> bool {
    let Type::Path(of) = of else { return false };
    of.path.segments.last().is_some_and(|last| last.ident == "Drawing" && last.arguments.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_field_with_the_drawing_is_found_whatever_it_is_called() {
        let item = quote! {
            #[draw(crate = burgeon::kit)]
            struct Beads { radius: f64, strung: kit::Drawing }
        };
        let text = expand(item).unwrap().to_string();
        assert!(text.contains("impl burgeon :: kit :: Draw for Beads"), "{text}");
        assert!(text.contains("& mut self . strung"), "{text}");
    }

    #[test]
    fn what_has_no_drawing_or_two_is_refused() {
        for item in [
            quote!(
                struct Beads {
                    radius: f64,
                }
            ),
            quote!(
                struct Beads {
                    a: Drawing,
                    b: Drawing,
                }
            ),
            quote!(
                struct Beads(Drawing, Drawing);
            ),
            quote!(
                enum Beads {}
            ),
            quote!(
                #[draw(path = a)]
                struct Beads {
                    drawing: Drawing,
                }
            ),
        ] {
            let text = item.to_string();
            assert!(expand(item).is_err(), "{text}");
        }
    }
}
