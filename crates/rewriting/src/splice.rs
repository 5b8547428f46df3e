//! Splicing of the successors of a piece's modules into the next chain.

use crate::batch::{Active, Batch, ChainPiece, NO_RULE, Scratch, extend_few, narrow, narrow_rule};
use crate::chain::{Chain, END, Symbol};
use crate::output::Output;
use crate::successors::Successor;
use crate::uses::Use;
use burgeon_base::ModuleKey;

impl Batch<'_> {
    /// Returns the part of the next chain that replaces `piece`.
    pub(crate) fn splice(&self, piece: ChainPiece, scratch: &mut Scratch, output: Output) -> Output {
        match (self.plan.grammar.has_runs(), self.new_chain.borrow().is_used()) {
            (true, _) => self.splice_pieces::<true, false>(piece, scratch, output),
            (false, false) => self.splice_pieces::<false, false>(piece, scratch, output),
            (false, true) => self.splice_pieces::<false, true>(piece, scratch, output),
        }
    }

    /// Splices the successors of single modules, and of several modules at once if `RUNS` is set. If `NEW` is set, the successors
    /// are in the new chain.
    fn splice_pieces<const RUNS: bool, const NEW: bool>(
        &self,
        piece: ChainPiece,
        scratch: &mut Scratch,
        mut output: Output,
    ) -> Output {
        let grammar = &self.plan.grammar;
        let random = grammar.draws_random();
        let out = &mut output.chain;
        out.symbols.reserve(2 * (piece.end - piece.begin.module));
        out.params.reserve(2 * (piece.end - piece.begin.module));
        let (mut module, mut param) = (piece.begin.module, piece.begin.param);
        let keep = |out: &mut Chain, modules: std::ops::Range<usize>, params: std::ops::Range<usize>| {
            if modules.is_empty() {
                return;
            }
            out.symbols.extend_from_slice(&self.chain.symbols[modules.clone()]);
            out.params.extend_from_slice(&self.chain.params[params]);
            if random {
                out.keys.extend_from_slice(&self.chain.keys[modules]);
            }
        };
        let new = self.new_chain.borrow();
        for (index, active) in scratch.active.iter().enumerate() {
            if active.rule == NO_RULE {
                continue;
            }
            let group = &mut scratch.groups[usize::from(active.rule)];
            let written = if NEW { new.written(index) } else { None };
            let made = match NEW {
                true if written.is_some() => Successor::Written,
                true => Successor::Keep,
                false => Successor::read(group.ends[group.next]),
            };
            group.next += 1;
            if matches!(made, Successor::Keep) {
                if random {
                    let here = active.module as usize;
                    let params = active.param as usize;
                    keep(out, module..here, param..params);
                    let arity = usize::from(grammar.arities()[usize::from(self.chain.symbols[here])]);
                    keep(out, here..here + 1, params..params + arity);
                    if let Some(key) = out.keys.last_mut() {
                        *key = key.advance();
                    }
                    (module, param) = (here + 1, params + arity);
                }
                continue;
            }
            output.changed = true;
            let here = active.module as usize;
            keep(out, module..here, param..active.param as usize);
            let (symbols, params) = match made {
                Successor::Keep => continue,
                Successor::Written => written.unwrap_or_default(),
                Successor::Shape(number) => {
                    let shape = &group.shapes[number];
                    (shape.symbols.as_slice(), &group.params[group.param_at..group.param_at + shape.params])
                }
                Successor::Ordered(end) => {
                    group.arrange(end, grammar.arities(), &mut scratch.arranged, &mut out.params);
                    (scratch.arranged.symbols.as_slice(), &[][..])
                }
                Successor::UpTo(end) => {
                    let symbols = &group.symbols[group.symbol_at..end];
                    group.symbol_at = end;
                    let arity = |symbol: &Symbol| usize::from(grammar.arities()[usize::from(*symbol)]);
                    let params: usize = symbols.iter().map(arity).sum();
                    (symbols, &group.params[group.param_at..group.param_at + params])
                }
            };
            group.made += symbols.len();
            extend_few(&mut out.symbols, symbols);
            extend_few(&mut out.params, params);
            group.param_at += params.len();
            if random {
                let (parent, names) = (self.chain.keys[here], grammar.name_hashes());
                scratch.ordinals.clear();
                out.keys.extend(symbols.iter().map(|symbol| match *symbol > END {
                    true => parent.successor(names[usize::from(*symbol)], scratch.ordinals.next(*symbol)),
                    false => ModuleKey::default(),
                }));
            }
            let length = if RUNS { grammar.rules()[usize::from(active.rule)].run_length() } else { 1 };
            module = here + length;
            param = active.param as usize
                + match RUNS {
                    true => self.run_params(here, length),
                    false => usize::from(grammar.arities()[usize::from(self.chain.symbols[here])]),
                };
        }
        let rest = piece.end - module;
        let rest_params: usize = self.chain.symbols[module..module + rest]
            .iter()
            .map(|symbol| usize::from(grammar.arities()[usize::from(*symbol)]))
            .sum();
        keep(out, module..piece.end, param..param + rest_params);
        for (rule, group) in scratch.groups.iter().enumerate() {
            if !group.members.is_empty() {
                output.ran = true;
                let done = Use { applied: group.members.len(), made: group.made, time: group.time };
                output.uses.push((narrow_rule(rule), done));
            }
        }
        output.chain.mark(self.plan.batch, grammar.arities());
        output
    }

    /// Returns for each symbol of `piece` the rule that ran and the number of its successors.
    pub(crate) fn applied_rules(&self, piece: ChainPiece, scratch: &Scratch) -> Vec<(u16, u32)> {
        let mut applied = vec![(NO_RULE, 1); piece.end - piece.begin.module];
        let mut read = vec![(0, 0, 0); scratch.groups.len()];
        let new = self.new_chain.borrow();
        let is_ruled = |(_, active): &(usize, &Active)| active.rule != NO_RULE;
        for (index, active) in scratch.active.iter().enumerate().filter(is_ruled) {
            let (next, from, item) = &mut read[usize::from(active.rule)];
            let group = &scratch.groups[usize::from(active.rule)];
            let written = if new.is_used() { new.written(index) } else { None };
            let made = match new.is_used() {
                true if written.is_some() => Successor::Written,
                true => Successor::Keep,
                false => Successor::read(group.ends[*next]),
            };
            *next += 1;
            let count = match made {
                Successor::Keep => 1,
                Successor::Written => written.map_or(0, |(symbols, _)| symbols.len()),
                Successor::Shape(number) => group.shapes[number].symbols.len(),
                Successor::Ordered(end) => {
                    *from = end;
                    let count = group.order[*item] as usize;
                    *item += 1 + count;
                    count
                }
                Successor::UpTo(end) => end - std::mem::replace(from, end),
            };
            let module = active.module as usize - piece.begin.module;
            if !matches!(made, Successor::Keep) {
                let length = self.plan.grammar.rules()[usize::from(active.rule)].run_length();
                applied[module..module + length].fill((active.rule, 0));
            }
            applied[module] = (active.rule, narrow(count));
        }
        applied
    }
}
