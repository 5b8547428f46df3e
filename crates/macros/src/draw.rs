//! Implementation of `Draw` for objects that draw.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Error, Field, ItemStruct, Path, Result, Type};

/// Implements `Draw` for a struct with one field of type `Drawing`.
pub(crate) fn implementation(kit: &Path, item: &ItemStruct) -> Result<TokenStream> {
    let name = &item.ident;
    let mut drawings = item.fields.members().zip(&item.fields).filter(|(_, field)| is_drawing(field));
    let (Some((field, _)), None) = (drawings.next(), drawings.next()) else {
        return Err(Error::new_spanned(name, "an object that draws has one field of type Drawing"));
    };
    Ok(quote! {
        impl #kit::Draw for #name {
            fn drawing(&self) -> &#kit::Drawing {
                &self.#field
            }

            fn drawing_mut(&mut self) -> &mut #kit::Drawing {
                &mut self.#field
            }
        }
    })
}

/// Returns true if the type of a field is called `Drawing`, with or without a path.
pub(crate) fn is_drawing(field: &Field) -> bool {
    let Type::Path(of) = &field.ty else { return false };
    of.path.segments.last().is_some_and(|last| last.ident == "Drawing" && last.arguments.is_empty())
}

#[cfg(test)]
mod tests {
    use syn::parse_str;

    use super::*;

    #[test]
    fn the_field_with_the_drawing_is_found_whatever_it_is_called() {
        let item = parse_str("struct Beads { radius: f64, strung: kit::Drawing }").unwrap();
        let kit = parse_str("burgeon::kit").unwrap();
        let text = implementation(&kit, &item).unwrap().to_string();
        assert!(text.contains("impl burgeon :: kit :: Draw for Beads"), "{text}");
        assert!(text.contains("& mut self . strung"), "{text}");
    }

    #[test]
    fn what_has_no_drawing_or_two_is_refused() {
        let kit = parse_str("burgeon::kit").unwrap();
        for text in [
            "struct Beads { radius: f64 }",
            "struct Beads { a: Drawing, b: Drawing }",
            "struct Beads(Drawing, Drawing);",
        ] {
            assert!(implementation(&kit, &parse_str(text).unwrap()).is_err(), "{text}");
        }
    }
}
