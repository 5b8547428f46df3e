//! Examples below the help of each command.

use clap::Command;

/// Path of a command, and command lines that use it.
const EXAMPLES: [(&str, &[&str]); 27] = [
    (
        "run",
        &[
            "burgeon run tree.lua -o tree.glb",
            "burgeon run tree.lua -o tree.glb -o tree.png --set height=12 --seed 7",
            "burgeon run tower.lua --turntable 60 -o tower.gif",
            "burgeon run town.lua --data ~/maps -o town.glb --report report.json",
            "burgeon run - -o - --format glb < tree.lua > tree.glb",
        ],
    ),
    (
        "live",
        &[
            "burgeon live tree.lua",
            "burgeon live tree.lua --editor 'code -g {file}:{line}'",
            "burgeon live tiles/",
        ],
    ),
    (
        "check",
        &[
            "burgeon check tree.lua",
            "burgeon check --quick scripts/*.lua",
            "burgeon check tree.lua --json --strict",
        ],
    ),
    ("api", &["burgeon api", "burgeon api turtle", "burgeon api turtle:forward"]),
    (
        "variations",
        &[
            "burgeon variations tree.lua --seeds 1..16 -o sheet.png",
            "burgeon variations tree.lua --sweep height=2..10:2 -o sheet.png",
        ],
    ),
    ("fit", &["burgeon fit heights.tif -o island.lua"]),
    ("mods", &["burgeon mods", "burgeon mods --script town.lua", "burgeon mods check mods/castle"]),
    ("mods check", &["burgeon mods check", "burgeon mods check mods/castle"]),
    ("mods explain", &["burgeon mods explain castle"]),
    ("mods new", &["burgeon mods new castle"]),
    ("mods add", &["burgeon mods add castle.zip"]),
    ("mods disable", &["burgeon mods disable castle"]),
    ("mods enable", &["burgeon mods enable castle"]),
    ("new", &["burgeon new tree", "burgeon new house --from building", "burgeon live tree.lua"]),
    ("open", &["burgeon open tower.glb", "burgeon open tower.glb --into tower"]),
    ("examples", &["burgeon examples burgeon-examples"]),
    ("setup", &["burgeon setup", "burgeon setup scripts/"]),
    ("sources", &["burgeon sources town.gpkg", "burgeon sources postgres://me@localhost/town --json"]),
    (
        "tiles",
        &[
            "burgeon tiles plan house.lua --data maps -o tiles",
            "burgeon tiles make tiles",
            "burgeon live tiles",
        ],
    ),
    ("tiles plan", &["burgeon tiles plan house.lua --data maps -o tiles"]),
    ("tiles make", &["burgeon tiles make tiles"]),
    ("tiles join", &["burgeon tiles join tiles"]),
    ("tiles check", &["burgeon tiles check tiles"]),
    ("tiles status", &["burgeon tiles status tiles", "burgeon tiles status tiles --json"]),
    (
        "completions",
        &[
            "burgeon completions bash > ~/.local/share/bash-completion/completions/burgeon",
            "burgeon completions zsh > _burgeon",
        ],
    ),
    ("man", &["burgeon man | man -l -", "burgeon man run | man -l -", "burgeon man --folder man/man1"]),
    ("help", &[]),
];

/// Adds the examples to the long help of `command` and of its commands.
pub(super) fn with_examples(command: Command) -> Command {
    add_to(command, "")
}

/// Adds the examples to the commands below the one at `path`.
fn add_to(mut command: Command, path: &str) -> Command {
    let names: Vec<String> = command.get_subcommands().map(|inner| inner.get_name().to_owned()).collect();
    for name in names {
        let path = if path.is_empty() { name.clone() } else { format!("{path} {name}") };
        let lines = EXAMPLES.iter().find(|(known, _)| *known == path).map_or(&[][..], |(_, lines)| lines);
        command = command.mut_subcommand(name, |inner| {
            let inner = add_to(inner, &path);
            if lines.is_empty() {
                inner
            } else {
                inner.after_long_help(format!("Examples:\n  {}", lines.join("\n  ")))
            }
        });
    }
    command
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory as _;

    use crate::commands::command_line::Cli;

    /// Collects the paths of all commands.
    fn paths(command: &Command, path: &str, found: &mut Vec<String>) {
        for inner in command.get_subcommands().filter(|inner| inner.get_name() != "help") {
            let path = format!("{path} {}", inner.get_name()).trim().to_owned();
            paths(inner, &path, found);
            found.push(path);
        }
    }

    #[test]
    fn every_command_has_examples_that_the_command_line_accepts() {
        let mut known = Vec::new();
        paths(&Cli::command(), "", &mut known);
        for path in &known {
            let examples = EXAMPLES.iter().find(|(name, _)| name == path);
            let (_, lines) = examples.unwrap_or_else(|| panic!("{path} has no examples"));
            assert!(!lines.is_empty(), "{path}");
            for line in *lines {
                // Words up to a redirection or a pipe; quotes of the only quoted word are dropped.
                let line = line.split(['>', '<', '|']).next().unwrap_or_default();
                let mut words: Vec<String> = Vec::new();
                for (index, part) in line.split('\'').enumerate() {
                    match index % 2 {
                        0 => words.extend(part.split_whitespace().map(str::to_owned)),
                        _ => words.push(part.to_owned()),
                    }
                }
                if let Err(error) = Cli::command().try_get_matches_from(&words) {
                    panic!("{line}: {error}");
                }
            }
        }
        for (path, _) in EXAMPLES.iter().filter(|(path, _)| *path != "help") {
            assert!(known.iter().any(|known| known == path), "there is no command {path}");
        }
    }
}
