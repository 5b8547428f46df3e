//! Lines of a script without their texts and comments.

/// Replaces the contents of strings, and comments, by spaces, so that what is left is code.
///
/// Strings keep their quotes. Long strings and long comments are blanked over several lines.
pub(super) fn code_lines(text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    // Number of equals signs of the long bracket that is open, if one is.
    let mut open: Option<usize> = None;
    for line in text.lines() {
        let letters: Vec<char> = line.chars().collect();
        let mut code = String::new();
        let mut at = 0;
        while at < letters.len() {
            if let Some(level) = open {
                let end = long_bracket(&letters[at..], ']').filter(|found| *found == level);
                let width = end.map_or(1, |level| level + 2);
                open = if end.is_some() { None } else { open };
                code.extend(std::iter::repeat_n(' ', width));
                at += width;
                continue;
            }
            let letter = letters[at];
            let is_comment = letter == '-' && letters.get(at + 1) == Some(&'-');
            let bracket = if is_comment { at + 2 } else { at };
            if let Some(level) = letters.get(bracket..).and_then(|rest| long_bracket(rest, '[')) {
                open = Some(level);
                code.extend(std::iter::repeat_n(' ', bracket + level + 2 - at));
                at = bracket + level + 2;
                continue;
            }
            if is_comment {
                break;
            }
            code.push(letter);
            at += 1;
            if matches!(letter, '"' | '\'' | '`') {
                while at < letters.len() && letters[at] != letter {
                    let width = if letters[at] == '\\' { 2 } else { 1 };
                    code.extend(std::iter::repeat_n(' ', width));
                    at += width;
                }
                if at < letters.len() {
                    code.push(letter);
                    at += 1;
                }
            }
        }
        lines.push(code);
    }
    lines
}

/// Returns the number of equals signs of the long bracket with which `letters` begin.
fn long_bracket(letters: &[char], bracket: char) -> Option<usize> {
    let (first, rest) = letters.split_first()?;
    let level = rest.iter().take_while(|letter| **letter == '=').count();
    (*first == bracket && rest.get(level) == Some(&bracket)).then_some(level)
}

/// Returns the names and keywords of a line of code, with the column at which each begins.
pub(super) fn names_of(code: &str) -> Vec<(usize, &str)> {
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
    let mut names = Vec::new();
    let mut from = 0;
    while let Some(found) = code[from..].find(is_part) {
        let begin = from + found;
        let end = code[begin..].find(|letter| !is_part(letter)).map_or(code.len(), |length| begin + length);
        if !code[begin..].starts_with(|letter: char| letter.is_ascii_digit()) {
            names.push((begin, &code[begin..end]));
        }
        from = end;
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_comments_are_blank() {
        let text =
            "local a = \"x -- [\\\"\" -- [1]\nlocal b = [[ !=\n** ]] .. 'y' --[==[ #\n]] ]==] c = `z{1}`";
        assert_eq!(
            code_lines(text),
            ["local a = \"        \" ", "local b =      ", "      .. ' '         ", "        c = `    `"]
                .map(str::to_owned)
        );
    }

    #[test]
    fn names_have_their_columns() {
        assert_eq!(names_of("if n2 > 3e4 then _x"), [(0, "if"), (3, "n2"), (12, "then"), (17, "_x")]);
    }
}
