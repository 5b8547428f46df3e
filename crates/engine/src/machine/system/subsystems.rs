//! Sub-systems: systems whose rules apply in regions of the chains of another system.
//!
//! A derivation of a system begins by adding the rules and interpretations of its sub-systems, and of theirs, to its own, with
//! the number of their region. The system itself is region 0.

use std::borrow::Cow;
use std::sync::Arc;

use mlua::Value as LuaValue;

use super::SystemDeclaration;
use super::handle::in_axiom;
use super::ignored::IgnoredModules;
use crate::machine::library::Library;
use burgeon_base::MemoryOwner;
use burgeon_base::error::{Error, Limit, Result, SourcePlace};
use burgeon_base::text::grouped;
use burgeon_kit::{Object, Rescale};
use burgeon_rewriting::{MOST_RULES, NameScope, Region, Rule, Symbol};

/// Name of the parameter of a module that scales the region which the module opens.
const SCALE: &str = "scale";

/// Approximate memory (bytes) of a symbol in a region: its candidates, and its interpretations.
const PAIR: usize = 64;

/// Module that opens a region, as a script declares it.
#[derive(Debug, Clone)]
pub(super) struct DeclaredSubsystem {
    opener: Symbol,
    /// Number of the module's parameter `scale`, if it has one.
    scale: Option<usize>,
    /// Index of the sub-system in the script.
    system: usize,
    place: Option<SourcePlace>,
}

/// Module that opens a region in a derivation.
#[derive(Debug, Clone)]
pub(crate) struct RegionOpener {
    pub symbol: Symbol,
    pub region: Region,
    /// Number of the module's parameter `scale`, if it has one.
    pub scale: Option<usize>,
    /// Location of the declaration.
    pub place: Option<SourcePlace>,
}

/// Sub-systems whose rules a system has while it is derived.
#[derive(Default)]
pub(crate) struct LinkedSubsystems {
    pub openers: Vec<RegionOpener>,
    /// Modules that contexts skip, by region from 1.
    ignored: Vec<IgnoredModules>,
    /// Number of the system's own rules and interpretations.
    own: (usize, usize),
}

impl SystemDeclaration {
    /// Adds the sub-system that a script declares with `arguments`: the name of a module, and a system, whose index is
    /// `system`.
    pub(super) fn add_subsystem(
        &mut self,
        library: &Library,
        scope: &NameScope,
        arguments: &[LuaValue],
        system: Option<usize>,
        place: Option<SourcePlace>,
    ) -> Result<()> {
        const USAGE: &str = "write system:subsystem(\"Leaf\", leaf), with a module and a system";
        let ([LuaValue::String(name), _], Some(system)) = (arguments, system) else {
            return Err(Error::argument("subsystem takes the name of a module and a system").help(USAGE));
        };
        let name = name.to_string_lossy();
        let symbols = library.symbols.borrow();
        let opener = symbols.find_in(&name, scope)?;
        if symbols.is_standard(opener) {
            return Err(Error::argument(format!("{name} is a module of the standard library")).help(
                "declare a module that begins the sub-system: local InLeaf = module(\"InLeaf\", \"scale\")",
            ));
        }
        if let Some(known) = self.subsystems.iter().find(|known| known.opener == opener) {
            let line = known.place.as_ref().map_or_else(String::new, |place| format!(" in {place}"));
            return Err(Error::argument(format!("{name} already begins a sub-system{line}"))
                .help("declare another module for the other sub-system"));
        }
        let scale = symbols.signature(opener).parameters.iter().position(|parameter| parameter == SCALE);
        self.subsystems.push(DeclaredSubsystem { opener, scale, system, place });
        Ok(())
    }

    /// Removes the rules and interpretations of sub-systems.
    pub(super) fn unlink(&mut self) {
        if let Some(linked) = self.linked.take() {
            self.rules.truncate(linked.own.0);
            self.interpretations.truncate(linked.own.1);
        }
    }

    /// Returns the modules that contexts skip in a region.
    pub(super) fn ignored_in(&self, region: Region) -> &IgnoredModules {
        let linked = usize::from(region).checked_sub(1).zip(self.linked.as_ref());
        linked.and_then(|(place, linked)| linked.ignored.get(place)).unwrap_or(&self.ignored)
    }

    /// Returns the modules that the contexts of a rule skip, if they are not those of this system. `own` are those that the
    /// rule declares.
    pub(super) fn ignored_by<'a>(
        &'a self,
        rule: &Rule,
        own: &'a Option<IgnoredModules>,
    ) -> Option<&'a IgnoredModules> {
        let has_contexts = rule.has_contexts() || rule.has_new_contexts();
        own.as_ref().or_else(|| (rule.region() > 0 && has_contexts).then(|| self.ignored_in(rule.region())))
    }

    /// Returns the modules that open regions; empty unless the system is linked.
    pub(crate) fn openers(&self) -> &[RegionOpener] {
        self.linked.as_ref().map_or(&[], |linked| &linked.openers)
    }

    /// Returns true if modules with this symbol begin a sub-system of this system, or of one of its sub-systems.
    pub(super) fn begins_subsystem(&self, symbol: Symbol) -> bool {
        self.subsystems.iter().any(|known| known.opener == symbol)
            || self.openers().iter().any(|opener| opener.symbol == symbol)
    }

    /// Returns the number of regions, with that of the system itself.
    pub(super) fn regions(&self) -> usize {
        1 + self.linked.as_ref().map_or(0, |linked| linked.ignored.len())
    }

    /// Returns the name of the type of the system's object.
    fn kind_name(&self) -> Option<&str> {
        self.object.as_ref().map(|object| &*object.kind().name)
    }

    /// Returns the reason why the system cannot be a sub-system of `outer`, and the remedy.
    fn unfit_within(&self, outer: &Self) -> Option<(Cow<'static, str>, &'static str)> {
        let named = |system: &Self| match system.kind_name() {
            Some(name) => Cow::Owned(format!("the object {name}")),
            None => Cow::Borrowed("no object"),
        };
        let is_shared = |environment: &Arc<dyn Object>| {
            outer.environments.iter().any(|known| Arc::ptr_eq(known, environment))
        };
        if self.kind_name() != outer.kind_name() {
            let text = format!("the sub-system has {}, but this system has {}", named(self), named(outer));
            return Some((text.into(), "give both systems the same type of object"));
        }
        if let Some(hook) = self.hooks.first() {
            let line = hook.run.1.as_ref().map_or_else(String::new, |place| format!(" in {place}"));
            let text =
                format!("the sub-system has a hook, {}{line}, which would not run", hook.moment.method());
            return Some((text.into(), "declare the hook in the system that is derived"));
        }
        if self.ring {
            let text = "the sub-system has rings, but its modules are parts of other chains";
            return Some((text.into(), "set ring = true only in the system that is derived"));
        }
        if self.variables.is_some() && self.variables != outer.variables {
            let text = "the sub-system has other variables than this system";
            return Some((text.into(), "give both systems the same variables"));
        }
        if !self.environments.iter().all(is_shared) {
            let text = "the sub-system has other environments than this system";
            return Some((text.into(), "give both systems the same environments"));
        }
        None
    }
}

/// A system and its sub-systems.
struct RegionMembers {
    /// Index in the script and the line that declares the sub-system, by region.
    systems: Vec<(usize, Option<SourcePlace>)>,
    openers: Vec<RegionOpener>,
}

impl Library {
    /// Adds the rules and interpretations of the sub-systems of system `index` to its own. Fails if they cannot be derived
    /// together.
    pub(crate) fn link_subsystems(&self, index: usize) -> Result<()> {
        let Ok(mut systems) = self.systems.try_borrow_mut() else {
            let has_none = self.systems.borrow().get(index).is_none_or(|system| system.subsystems.is_empty());
            return if has_none { Ok(()) } else { Err(in_axiom("derive of a system with sub-systems")) };
        };
        let Some(system) = systems.get_mut(index) else { return Ok(()) };
        system.unlink();
        if system.subsystems.is_empty() {
            return Ok(());
        }
        let RegionMembers { systems: members, openers } = self.region_members(&systems, index)?;
        let outer = &systems[index];
        let (mut rules, mut interpretations) = (Vec::new(), Vec::new());
        let mut linked = LinkedSubsystems {
            openers,
            own: (outer.rules.len(), outer.interpretations.len()),
            ..Default::default()
        };
        for (region, (member, place)) in (0u16..).zip(&members).skip(1) {
            let system = &systems[*member];
            if let Some((text, help)) = system.unfit_within(outer) {
                return Err(Error::argument(text).at_place(place.as_ref()).help(help));
            }
            let own = system
                .linked
                .as_ref()
                .map_or((system.rules.len(), system.interpretations.len()), |it| it.own);
            rules.extend(system.rules[..own.0].iter().map(|declared| declared.in_region(region)));
            interpretations
                .extend(system.interpretations[..own.1].iter().map(|known| known.in_region(region)));
            linked.ignored.push(system.ignored.clone());
        }
        let scales = |object: &Arc<dyn Object>| object.kind().has_capability::<dyn Rescale>();
        if let Some(object) = outer.object.as_ref().filter(|object| !scales(object))
            && let Some(opener) = linked.openers.iter().find(|opener| opener.scale.is_some())
        {
            let symbols = self.symbols.borrow();
            let name = symbols.display_name(opener.symbol);
            let error = Error::argument(format!("an object of the type {} has no scale", object.kind().name));
            return Err(error
                .at_place(opener.place.as_ref())
                .help(format!("declare {name} without a parameter {SCALE}")));
        }
        let event = outer.rules.iter().chain(&rules).find(|declared| declared.rule.propensity().is_some());
        if let Some(event) = event {
            let error = Error::argument("it has a propensity, but rules of sub-systems apply in every step");
            let error = error.at_place(event.rule.place.as_ref()).rule(&event.rule.pattern.text);
            return Err(error.help("use guards or weights, or place a derived system: Place(model)"));
        }
        if outer.rules.len() + rules.len() > MOST_RULES
            || outer.interpretations.len() + interpretations.len() > MOST_RULES / 2
        {
            let text = format!("a system and its sub-systems have more than {} rules", grouped(MOST_RULES));
            return Err(Error::limit(Limit::Size, text)
                .at_place(outer.place.as_ref())
                .help("join rules into one, and distinguish the cases by a parameter"));
        }
        let pairs = members.len().saturating_mul(self.symbols.borrow().arities().len());
        MemoryOwner::ensure_room(pairs.saturating_mul(PAIR))?;
        let outer = &mut systems[index];
        outer.rules.extend(rules);
        outer.interpretations.extend(interpretations);
        outer.linked = Some(linked);
        Ok(())
    }

    /// Returns system `index`, its sub-systems and theirs, each once.
    fn region_members(&self, systems: &[SystemDeclaration], index: usize) -> Result<RegionMembers> {
        let mut members: Vec<(usize, Option<SourcePlace>)> = vec![(index, None)];
        let mut openers: Vec<RegionOpener> = Vec::new();
        let mut next = 0;
        while let Some((member, _)) = members.get(next) {
            next += 1;
            for DeclaredSubsystem { opener, scale, system, place } in &systems[*member].subsystems {
                let known = members.iter().position(|(known, _)| known == system);
                let number = known.unwrap_or_else(|| {
                    members.push((*system, place.clone()));
                    members.len() - 1
                });
                let region = Region::try_from(number).unwrap_or(Region::MAX);
                match openers.iter().find(|known| known.symbol == *opener) {
                    Some(known) if known.region != region => {
                        let line =
                            known.place.as_ref().map_or_else(String::new, |place| format!(" in {place}"));
                        let symbols = self.symbols.borrow();
                        let name = symbols.display_name(*opener);
                        let error = Error::argument(format!("{name} begins another sub-system{line}"));
                        return Err(error
                            .at_place(place.as_ref())
                            .help("use a module of its own for each sub-system"));
                    }
                    Some(_) => {}
                    None => {
                        openers.push(RegionOpener {
                            symbol: *opener,
                            region,
                            scale: *scale,
                            place: place.clone(),
                        });
                    }
                }
            }
        }
        Ok(RegionMembers { systems: members, openers })
    }
}
