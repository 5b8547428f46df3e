//! Sites in a chain at which placeholder modules are replaced.

use crate::placeholders::{FRAGMENT, QUERY};
use burgeon_base::error::{Error, Result};
use burgeon_rewriting::{CLOSE, Chain, END, Mark, OPEN};

/// Site in a chain at which modules are replaced.
#[derive(Debug)]
pub(super) struct PendingSite {
    /// Position of the query, or of the module that is split into parts.
    pub at: Mark,
    /// Positions of the fragment modules, in the order in which they are applied.
    pub fragments: Vec<Mark>,
}

/// Returns the sites of `chain`, in order. `arities` has the number of parameters by symbol.
///
/// A fragment module belongs to the module or query to its left on the same branch; closed branches and other
/// fragment modules in between are ignored. Fails with the position of a fragment module without a module to
/// its left.
pub(super) fn sites(chain: &Chain, arities: &[u8]) -> Result<Vec<PendingSite>, (Mark, Error)> {
    let mut sites: Vec<PendingSite> = Vec::new();
    // For each open branch, its last module or query, and the index of its site if there is one.
    let mut branches: Vec<Option<(Mark, Option<usize>)>> = Vec::new();
    let mut last: Option<(Mark, Option<usize>)> = None;
    let mut here = Mark::default();
    for (module, symbol) in chain.symbols.iter().enumerate() {
        here.module = module;
        match *symbol {
            OPEN => branches.push(last.take()),
            CLOSE => last = branches.pop().flatten(),
            END => {
                last = None;
                here.chain += 1;
            }
            FRAGMENT => {
                let Some((left, number)) = &mut last else {
                    let error = Error::argument("fragment needs a module to its left on its branch")
                        .help("write fragment(Part) directly after the module that it divides: return Outline(ring), fragment(Part)");
                    return Err((here, error));
                };
                let site = *number.get_or_insert_with(|| {
                    sites.push(PendingSite { at: *left, fragments: Vec::new() });
                    sites.len() - 1
                });
                sites[site].fragments.push(here);
            }
            QUERY => {
                last = Some((here, Some(sites.len())));
                sites.push(PendingSite { at: here, fragments: Vec::new() });
            }
            _ => last = Some((here, None)),
        }
        here.param += usize::from(arities[usize::from(*symbol)]);
    }
    sites.sort_by_key(|site| site.at.module);
    Ok(sites)
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_rewriting::FIRST_SYMBOL;

    /// Returns the sites of a chain as text: `a` to `z` modules, `?` a query, `%` a fragment module, `;` an
    /// end.
    fn found(text: &str) -> Result<String, usize> {
        let symbol = |c: char| match c {
            '[' => OPEN,
            ']' => CLOSE,
            ';' => END,
            '?' => QUERY,
            '%' => FRAGMENT,
            _ => FIRST_SYMBOL,
        };
        let mut arities = crate::placeholders::symbols().arities();
        arities.push(1);
        let chain = Chain { symbols: text.chars().map(symbol).collect(), ..Chain::default() };
        let sites = sites(&chain, &arities).map_err(|(at, _)| at.module)?;
        let shown = sites.iter().map(|site| {
            let param: usize =
                chain.symbols[..site.at.module].iter().map(|it| usize::from(arities[usize::from(*it)])).sum();
            assert_eq!(site.at.param, param);
            assert_eq!(site.at.chain, text[..site.at.module].matches(';').count());
            let fragments: Vec<usize> = site.fragments.iter().map(|at| at.module).collect();
            format!("{}{fragments:?}", site.at.module)
        });
        Ok(shown.collect::<Vec<_>>().join(" "))
    }

    #[test]
    fn a_fragmentation_belongs_to_what_is_to_its_left_on_its_own_branch() {
        for (text, expected) in [
            ("abc;", ""),
            ("a%;", "0[1]"),
            ("a%%b%;", "0[1, 2] 3[4]"),
            ("?;", "0[]"),
            ("?%;", "0[1]"),
            ("a[b%]%;", "0[5] 2[3]"),
            ("a[?][b[c]]%?;", "0[10] 2[] 11[]"),
            ("a;b%;", "2[3]"),
        ] {
            assert_eq!(found(text).as_deref(), Ok(expected), "{text}");
        }
        for (text, at) in [("%;", 0), ("a[%];", 2), ("a;%;", 2), ("[a]%;", 3)] {
            assert_eq!(found(text), Err(at), "{text}");
        }
    }
}
