//! Blocks that no `end` closes.

use super::code::names_of;

/// Keyword that opens a block, with its line (from 1) and its indentation.
pub(super) struct Opener {
    pub(super) keyword: String,
    pub(super) line: usize,
    indentation: usize,
}

/// Returns the block that lacks its `end`, if the lines are indented by their blocks: the first whose `end` is indented less
/// than its beginning, or the last that stays open.
pub(super) fn find_unclosed(lines: &[String]) -> Option<Opener> {
    let mut open: Vec<Opener> = Vec::new();
    for (number, line) in (1..).zip(lines) {
        let indentation = line.len() - line.trim_start().len();
        let names = names_of(line);
        for (place, (column, name)) in names.iter().enumerate() {
            let opens = match *name {
                "function" | "repeat" | "for" | "while" => true,
                // In `x = if a then b else c` there is no block.
                "if" => is_statement(line, *column),
                // The `do` of a loop belongs to the loop.
                "do" => !names[..place].iter().any(|(_, name)| matches!(*name, "for" | "while")),
                _ => false,
            };
            if opens {
                open.push(Opener { keyword: (*name).to_owned(), line: number, indentation });
            }
            if matches!(*name, "end" | "until") {
                let closed = open.pop()?;
                if *column == indentation && indentation < closed.indentation {
                    return Some(closed);
                }
            }
        }
    }
    open.pop()
}

/// Returns true if the `if` at `column` begins a statement, and not an expression.
fn is_statement(line: &str, column: usize) -> bool {
    let before = line[..column].trim_end();
    let is_value = before.contains('=') || before.trim_start().starts_with("return");
    let last = names_of(before).last().map_or("", |(begin, _)| &before[*begin..]);
    before.is_empty() || before.ends_with([';', ')']) || !is_value && matches!(last, "then" | "do" | "else")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Option<(String, usize)> {
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        find_unclosed(&lines).map(|opener| (opener.keyword, opener.line))
    }

    #[test]
    fn the_block_whose_end_is_missing_is_the_one_that_is_indented_more() {
        let text = "f(function()\n  if a then\n    return 1\nend)\ng(function()\nend)";
        assert_eq!(found(text), Some(("if".to_owned(), 2)));
        let text = "local function f()\n  for i = 1, 2 do\n    g(if a then b else c)\nend\n";
        assert_eq!(found(text), Some(("for".to_owned(), 2)));
        let text = "for i = 1, 2 do\n  while a do b() end\n  repeat c() until d\n";
        assert_eq!(found(text), Some(("for".to_owned(), 1)));
        assert_eq!(found("do\n  local x = if a then 1 else 2\nend\n"), None);
    }
}
