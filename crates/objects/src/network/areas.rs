//! The areas that streets do not cross, as scripts specify them.

use super::options::NetworkOptions;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::{Plan, Polygon, Rings};
use burgeon_streets::Obstacle;

/// The areas of a network, and the warnings about them.
pub(super) struct NetworkAreas {
    /// All areas.
    pub(super) areas: Vec<Obstacle>,
    /// Areas that bridges may cross.
    pub(super) waters: Vec<Polygon>,
    /// Warnings about areas that were skipped or that count only in part.
    pub(super) warnings: Vec<Warning>,
}

impl NetworkAreas {
    pub(super) fn new(options: &NetworkOptions) -> Self {
        let mut made = Self { areas: Vec::new(), waters: Vec::new(), warnings: Vec::new() };
        for (name, areas) in [("obstacles", &options.obstacles), ("water", &options.water)] {
            areas.iter().for_each(|polygon| made.add(name, &polygon.0));
        }
        options.limit.iter().for_each(|polygon| made.add("limit", &polygon.0));
        made
    }

    fn add(&mut self, name: &str, rings: &Rings) {
        let plan = match Plan::new(rings) {
            Ok(plan) => plan,
            Err(error) => {
                let text =
                    format!("network: {name}: skipped an area that is not a polygon: {}", error.message());
                let warning = Warning::new(WarningKind::Data, text);
                self.warnings.push(warning.help("repair it, or remove it"));
                return;
            }
        };
        if let (repairs @ [_, ..], trouble) = plan.repairs() {
            let text = format!(
                "network: {name}: an area is not a simple polygon ({trouble}), so only a part of it is used: {}",
                repairs.join(", ")
            );
            let warning = Warning::new(WarningKind::Data, text);
            self.warnings.push(warning.help("repair it to use the whole area"));
        }
        let can_be_bridged = name == "water";
        if can_be_bridged {
            self.waters.push(plan.flat());
        }
        self.areas.push(Obstacle { area: plan.flat(), is_limit: name == "limit", can_be_bridged });
    }
}
