//! Text of doc comments.

use syn::{Attribute, Expr, ExprLit, Lit, Meta};

/// Returns the text of a doc comment, or `None` if there is none.
pub(crate) fn text(attributes: &[Attribute]) -> Option<String> {
    let lines: Vec<String> = attributes.iter().filter_map(line).collect();
    let text = lines.join("\n");
    (!text.trim().is_empty()).then_some(text)
}

/// Returns the first paragraph of a doc on one line.
pub(crate) fn first_paragraph(doc: &str) -> String {
    let lines = doc.trim().lines().map(str::trim).take_while(|line| !line.is_empty());
    lines.collect::<Vec<_>>().join(" ")
}

fn line(attribute: &Attribute) -> Option<String> {
    let Meta::NameValue(meta) = &attribute.meta else { return None };
    let Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) = &meta.value else { return None };
    let text = text.value();
    meta.path.is_ident("doc").then(|| text.strip_prefix(' ').unwrap_or(&text).trim_end().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_first_paragraph_ends_at_an_empty_line() {
        assert_eq!(first_paragraph("\nA tower\n  of bricks.\n\nMore."), "A tower of bricks.");
        assert_eq!(first_paragraph(""), "");
    }

    #[test]
    fn a_doc_keeps_its_lines() {
        let item: syn::ItemStruct = syn::parse_quote! {
            /// Raises it,
            ///   and more.
            #[derive(Clone)]
            struct Tower;
        };
        assert_eq!(text(&item.attrs).as_deref(), Some("Raises it,\n  and more."));
        let item: syn::ItemStruct = syn::parse_quote! {
            ///
            struct Slab;
        };
        assert_eq!(text(&item.attrs), None);
    }
}
