//! Rules that cannot be applied in the same step.

use crate::grammar::Grammar;
use crate::rule::Rule;
use burgeon_base::error::{Error, Result};

impl Grammar {
    /// Returns the grammar if its candidates can be applied in one step.
    ///
    /// Fails if some have left contexts in the new chain and others right contexts, if some rewrite several modules at
    /// once and others have contexts in the new chain, if some have propensities and others not, or if modules open regions
    /// and rules have propensities.
    ///
    /// ```
    /// use burgeon_rewriting::ClosureSystem;
    ///
    /// let mut system = ClosureSystem::new(0);
    /// let (a, b) = (system.module("A", &[])?, system.module("B", &[])?);
    /// system.rule("A << B", move |_, out| out.push(a, &[]))?;
    /// let chain = |system: &ClosureSystem| system.chain(|out| [a, b, b].iter().for_each(|it| out.push(*it, &[])));
    /// assert_eq!(system.text(&system.derive(chain(&system)?, 1)?), "A A A\n");
    /// system.rule("A >> B", move |_, out| out.push(a, &[]))?;
    /// let error = system.derive(chain(&system)?, 1).expect_err("two directions");
    /// assert!(error.message().contains("A >> B"), "{error}");
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn with_compatible_rules(self) -> Result<Self> {
        let rules = || self.candidates().map(|number| &self.rules()[usize::from(number)]);
        let left = rules().find(|rule| rule.pattern.has_new_left());
        let right = rules().find(|rule| rule.pattern.has_new_right());
        let run = rules().find(|rule| rule.pattern.has_run());
        let event = rules().find(|rule| rule.propensity().is_some());
        let plain = rules().find(|rule| rule.propensity().is_none());
        let events = "has a propensity, so only one module is rewritten in each step";
        let conflict = match (left, right, run, event, plain) {
            (Some(left), Some(right), ..) => {
                (left, right, "sees the new chain before it", "the new chain after it")
            }
            (Some(new), None, _, Some(event), _) | (None, Some(new), _, Some(event), _) => {
                (event, new, events, "sees the new chain of the step")
            }
            (Some(new), None, Some(run), ..) | (None, Some(new), Some(run), ..) => {
                (new, run, "sees the new chain", "rewrites several modules at once")
            }
            (.., Some(event), Some(plain)) => (event, plain, events, "has no propensity"),
            (.., Some(event), None) if !self.region_openers().is_empty() => {
                let text = format!("the rule \"{}\" {events}, but modules open regions", event.pattern.text);
                let error = Error::argument(text).at_place(event.place.as_ref()).rule(&event.pattern.text);
                return Err(error.help("use rules without propensities, or rules of one system"));
            }
            _ => return Ok(self),
        };
        Err(conflict_error(conflict))
    }
}

/// Returns the error for two rules, of which the first does one thing and the second another.
fn conflict_error((first, second, what, other): (&Rule, &Rule, &str, &str)) -> Error {
    let text = match std::ptr::eq(first, second) {
        true => format!("the rule \"{}\" {what}, and {other}", first.pattern.text),
        false => format!(
            "the rule \"{}\" {what}, and \"{}\" {other}, in the same step",
            first.pattern.text, second.pattern.text
        ),
    };
    let error = Error::argument(text).at_place(second.place.as_ref()).rule(&second.pattern.text);
    error.help(match first.propensity() {
        None => "put the rules in groups that are derived in turn: s:rule(pattern, { group = \"up\" }, f)",
        Some(_) if second.propensity().is_some() => "write < and > instead of << and >>",
        Some(_) => {
            "give all rules of the step a propensity, or put the rules in groups that are derived in turn: \
             s:rule(pattern, { group = \"grow\" }, f)"
        }
    })
}
