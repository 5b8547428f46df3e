//! Doc comments: their text, and the units that it tells.

use syn::{Attribute, Expr, ExprLit, Lit, Meta};

/// The units that a doc gives in round brackets.
const UNITS: [&str; 9] = ["m", "m²", "m³", "1/m", "m/m", "degrees", "s", "bytes", "light years"];

/// The text of a doc comment, or `None` where there is none.
pub(crate) fn text(attributes: &[Attribute]) -> Option<String> {
    let lines: Vec<String> = attributes.iter().filter_map(line).collect();
    let text = lines.join("\n");
    (!text.trim().is_empty()).then_some(text)
}

/// The first paragraph of a doc, on one line.
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

/// The first unit of a doc: `m` of "Its height (m)." and of "Its height (m, 5 unless given)."
pub(crate) fn unit(doc: &str) -> Option<&'static str> {
    doc.match_indices('(').find_map(|(at, _)| bracketed(&doc[at..]))
}

/// The unit of an argument: the one right after its name.
pub(crate) fn unit_of(doc: &str, argument: &str) -> Option<&'static str> {
    let name = format!("`{argument}` ");
    doc.match_indices(&name).find_map(|(at, name)| bracketed(&doc[at + name.len()..]))
}

/// The unit in the round brackets that `text` begins with.
fn bracketed(text: &str) -> Option<&'static str> {
    let inner = text.strip_prefix('(')?.split([')', ',']).next()?;
    let inner = inner.split(" from ").next()?;
    UNITS.into_iter().find(|unit| *unit == inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_stands_in_round_brackets() {
        for (doc, expected) in [
            ("Its height (m).", Some("m")),
            ("Its area (m²) without the holes.", Some("m²")),
            ("Height (m): preferred, or { least, greatest }.", Some("m")),
            ("How far it reaches (m, 5 unless given).", Some("m")),
            ("Where it stands (m from the star).", Some("m")),
            ("As `footprint(geometry)` takes it, how far it turns (degrees).", Some("degrees")),
            ("How rough it is (0 to 1).", None),
            ("Turns by more than a little (8 degrees).", None),
            ("It has m and (no end", None),
        ] {
            assert_eq!(unit(doc), expected, "{doc}");
        }
    }

    #[test]
    fn an_arguments_unit_follows_its_name() {
        let doc = "Raises it by `height` (m) within `time` (s), turned by `angle`, all in all (bytes).";
        assert_eq!(unit_of(doc, "height"), Some("m"));
        assert_eq!(unit_of(doc, "time"), Some("s"));
        assert_eq!(unit_of(doc, "angle"), None);
    }

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
