//! Matching of contexts along the tree with links that are found once per step: O(1) per context module.

use smallvec::SmallVec;

use super::chain::{CLOSE, Chain, END, OPEN};
use super::context::ContextElement;
use super::grammar::Grammar;
use super::ignored::IgnoredSet;
use super::links::{Links, NONE, TreeLinks};

/// Indices of the context modules that a pattern matched, in the order in which the pattern names them.
pub type Bindings = SmallVec<[u32; 8]>;

/// Matcher of a grammar's contexts around the modules of a chain.
///
/// ```
/// use std::sync::Arc;
///
/// use burgeon_rewriting::{
///     CLOSE, Chain, ContextMatcher, END, Grammar, Links, OPEN, Pattern, Rule, Signature, Symbols,
/// };
///
/// // P. Prusinkiewicz and A. Lindenmayer, "The Algorithmic Beauty of Plants", 1990, page 32.
/// let mut symbols = Symbols::default();
/// for name in "ABCDEGHIJKLMNOS".chars() {
///     symbols.declare(Signature::new(&name.to_string(), &[])?)?;
/// }
/// let text = "ABC[DE][SG[HI[JK]L]MNO]";
/// let symbol = |letter: char| match letter {
///     '[' => Ok(OPEN),
///     ']' => Ok(CLOSE),
///     _ => symbols.find(&letter.to_string()),
/// };
/// let mut chain = Chain::default();
/// for letter in text.chars() {
///     chain.symbols.push(symbol(letter)?);
/// }
/// chain.symbols.push(END);
///
/// let rule = Rule::new(Pattern::parse("B C < S > G [H] M", &symbols)?, None, false, None);
/// let grammar = Grammar::new(Arc::new(symbols), vec![rule], &[], false);
/// let mut links = Links::default();
/// links.build(&chain, &grammar);
/// let matcher = ContextMatcher { chain: &chain, links: &links, grammar: &grammar };
/// let place = text.find('S').expect("it is there");
/// assert!(matcher.matches(0, place));
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct ContextMatcher<'a> {
    /// The chain.
    pub chain: &'a Chain,
    /// Links that [`Links::build`] created for the chain and the grammar.
    pub links: &'a Links,
    /// Rules.
    pub grammar: &'a Grammar,
}

/// Position at which a right context continues.
#[derive(Clone, Copy)]
enum ContextPosition {
    /// After a module, whose next neighbour is linked.
    Module(usize),
    /// At this symbol, of any kind.
    At(usize),
}

/// Matcher of the contexts of one rule, with the neighbours in the tree without the symbols that the rule ignores.
#[derive(Clone, Copy)]
struct TreeMatcher<'a> {
    chain: &'a Chain,
    links: &'a Links,
    tree: &'a TreeLinks,
    grammar: &'a Grammar,
    ignored: &'a IgnoredSet,
}

impl<'a> ContextMatcher<'a> {
    /// Returns true if the contexts of rule number `rule` match around the module at `index`, or around the modules
    /// from `index` on that the rule rewrites at once.
    #[inline(always)]
    pub fn matches(self, rule: u16, index: usize) -> bool {
        let declared = &self.grammar.rules()[usize::from(rule)];
        if !declared.has_contexts() {
            return true;
        }
        let matcher = self.tree_matcher(rule);
        let left = self.grammar.left_of(rule);
        if !left.is_empty() && !matcher.matches_left(left, matcher.tree.left[index]) {
            return false;
        }
        let right = self.grammar.right_of(rule);
        let last = index + declared.run_length() - 1;
        right.is_empty() || matcher.match_right(right, ContextPosition::Module(last), None)
    }

    #[inline]
    fn tree_matcher(self, rule: u16) -> TreeMatcher<'a> {
        let set = self.grammar.ignored_set(rule);
        TreeMatcher {
            chain: self.chain,
            links: self.links,
            tree: self.links.tree(set),
            grammar: self.grammar,
            ignored: &self.grammar.ignored_sets()[set],
        }
    }

    /// Returns true if the module at `index`, whose parameters begin at `param`, has the values that rule number `rule`
    /// requires, and if all modules that the rule rewrites at once follow it.
    #[inline(never)]
    pub fn matches_predecessors(self, rule: u16, index: usize, param: usize) -> bool {
        let mut begin = param;
        self.grammar.predecessors_of(rule).iter().zip(index..).all(|(element, index)| {
            let Some(symbol) = self.chain.symbols.get(index) else { return false };
            let params = self.chain.params.get(begin..).unwrap_or_default();
            begin += usize::from(self.grammar.arities()[usize::from(*symbol)]);
            match element {
                ContextElement::Module(wanted) => wanted == symbol,
                ContextElement::Test(number) => {
                    let test = self.grammar.patterns().test(*number);
                    test.admits(*symbol) && test.holds(params, &self.links.constants)
                }
                ContextElement::Branch(_) | ContextElement::End => false,
            }
        })
    }

    /// Returns the contexts of rule number `rule`, to bind them at many modules.
    pub fn of_rule(self, rule: u16) -> RuleContexts<'a> {
        let declared = &self.grammar.rules()[usize::from(rule)];
        let right = self.grammar.right_of(rule);
        RuleContexts {
            matcher: self.tree_matcher(rule),
            left: declared.pattern.left.len(),
            right,
            is_straight: right.iter().all(|element| matches!(element, ContextElement::Module(_))),
            run_length: declared.run_length(),
        }
    }
}

/// Contexts of one rule, from [`ContextMatcher::of_rule`].
#[derive(Clone, Copy)]
pub struct RuleContexts<'a> {
    matcher: TreeMatcher<'a>,
    /// Number of modules to the left.
    left: usize,
    right: &'a [ContextElement],
    /// Set if the right context has no branches, values or ends.
    is_straight: bool,
    run_length: usize,
}

impl RuleContexts<'_> {
    /// Fills `bindings` with the context modules of the module at `index`, at which the rule matches.
    #[inline]
    pub fn bind(&self, index: usize, bindings: &mut Bindings) {
        let tree = self.matcher.tree;
        bindings.clear();
        let mut here = index;
        for _ in 0..self.left {
            let nearest = tree.left[here];
            bindings.push(nearest);
            here = nearest as usize;
        }
        if self.left > 1 {
            bindings.reverse();
        }
        let mut last = index + self.run_length - 1;
        if !self.is_straight {
            self.matcher.match_right(self.right, ContextPosition::Module(last), Some(bindings));
            return;
        }
        for _ in self.right {
            let next = tree.right[last];
            bindings.push(next);
            last = next as usize;
        }
    }
}

impl TreeMatcher<'_> {
    /// Returns true if the module at `index` passes a test. Most patterns have none.
    #[inline(never)]
    fn passes(self, number: u32, index: u32) -> bool {
        let test = self.grammar.patterns().test(number);
        let begin = self.links.param[index as usize] as usize;
        test.admits(self.chain.symbols[index as usize])
            && test.holds(self.chain.params.get(begin..).unwrap_or_default(), &self.links.constants)
    }

    /// Returns true if `contexts`, the nearest first, match the path that begins with the module `nearest`.
    #[inline]
    fn matches_left(self, contexts: &[ContextElement], mut nearest: u32) -> bool {
        for element in contexts {
            let is_found = match *element {
                ContextElement::Module(symbol) => {
                    nearest != NONE && self.chain.symbols[nearest as usize] == symbol
                }
                ContextElement::Test(number) => nearest != NONE && self.passes(number, nearest),
                ContextElement::End => return nearest == NONE,
                ContextElement::Branch(_) => false,
            };
            if !is_found {
                return false;
            }
            nearest = self.tree.left[nearest as usize];
        }
        true
    }

    /// Returns true if `contexts` match from a position on. Modules within branches are only traversed if `bindings`
    /// are requested.
    fn match_right(
        self,
        contexts: &[ContextElement],
        from: ContextPosition,
        mut bindings: Option<&mut Bindings>,
    ) -> bool {
        let mut here = from;
        for context in contexts {
            here = match context {
                ContextElement::End => return self.next(here) == NONE,
                ContextElement::Module(symbol) => {
                    let found = self.next(here);
                    if found == NONE || self.chain.symbols[found as usize] != *symbol {
                        return false;
                    }
                    if let Some(bindings) = &mut bindings {
                        bindings.push(found);
                    }
                    ContextPosition::Module(found as usize)
                }
                ContextElement::Test(number) => {
                    let found = self.next(here);
                    if found == NONE || !self.passes(*number, found) {
                        return false;
                    }
                    if let Some(bindings) = &mut bindings {
                        bindings.push(found);
                    }
                    ContextPosition::Module(found as usize)
                }
                ContextElement::Branch(number) => {
                    let next = match here {
                        ContextPosition::Module(index) => index + 1,
                        ContextPosition::At(index) => index,
                    };
                    let found = self.first_branch(*number, self.tree.branch[next]);
                    if found == NONE {
                        return false;
                    }
                    if let Some(bindings) = &mut bindings {
                        let inner = self.grammar.patterns().branch(*number);
                        self.match_right(inner, ContextPosition::At(found as usize + 1), Some(bindings));
                    }
                    ContextPosition::At(self.tree.right[found as usize] as usize + 1)
                }
            };
        }
        true
    }

    /// Returns the next module on the main path that is not ignored.
    #[inline]
    fn next(self, here: ContextPosition) -> u32 {
        match here {
            ContextPosition::Module(index) => self.tree.right[index],
            ContextPosition::At(index) => self.next_module(index),
        }
    }

    /// Returns the first module at or after `index` on its own branch that is not ignored.
    fn next_module(self, index: usize) -> u32 {
        let right = &self.tree.right;
        match self.chain.symbols[index] {
            CLOSE => NONE,
            // The first module of a ring.
            END => right[index],
            OPEN => right[right[index] as usize],
            symbol if self.ignored.contains(symbol) => right[index],
            _ => u32::try_from(index).unwrap_or(NONE),
        }
    }

    /// Returns the first branch that begins like the named branch: `open` itself or one that is reachable from it.
    ///
    /// If the result is not `open` itself, it is cached for every branch that was passed, so that all searches of a
    /// step together test each branch once.
    fn first_branch(self, number: u32, open: u32) -> u32 {
        if open == NONE || self.begins_so(number, open) {
            return open;
        }
        let second = self.branch_behind(open);
        if second == NONE {
            return NONE;
        }
        let known = self.tree.branch_searches(number);
        let (mut here, mut count) = (second, 0);
        let found = loop {
            if here == NONE {
                break NONE;
            }
            if let Some(found) = known.get(here) {
                break found;
            }
            if self.begins_so(number, here) {
                break here;
            }
            here = self.branch_behind(here);
            count += 1;
            // All modules of the main axis of a ring can be ignored.
            if here == second {
                break NONE;
            }
        };
        let mut passed = second;
        for _ in 0..count {
            known.note(passed, found);
            passed = self.branch_behind(passed);
        }
        found
    }

    /// Returns the next branch after the one that begins at `open`, with only ignored modules in between.
    fn branch_behind(self, open: u32) -> u32 {
        self.tree.branch[self.tree.right[open as usize] as usize + 1]
    }

    fn begins_so(self, number: u32, open: u32) -> bool {
        self.match_right(self.grammar.patterns().branch(number), ContextPosition::At(open as usize + 1), None)
    }
}
