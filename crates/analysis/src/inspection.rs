//! Whether a script could tell a table that is made later from one that is there.

/// The functions with which a script sees a table as it is.
const INSPECTORS: [&str; 6] = ["pairs", "next", "rawget", "getmetatable", "clone", "foreach"];

/// Whether a script could tell a table that is made later from one that is there.
pub fn inspects_tables(text: &str) -> bool {
    let apart = |letter: Option<char>| letter.is_none_or(|it| !it.is_alphanumeric() && it != '_');
    INSPECTORS.iter().any(|name| {
        text.match_indices(name).any(|(at, _)| {
            apart(text[..at].chars().next_back()) && apart(text[at + name.len()..].chars().next())
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_whole_names_of_functions_count() {
        assert!(
            inspects_tables("for k in pairs(t) do")
                && inspects_tables("table.clone(x)")
                && inspects_tables("next")
        );
        assert!(
            !inspects_tables("for k in ipairs(t) do")
                && !inspects_tables("next_door = 1")
                && !inspects_tables("f.geometry")
        );
    }
}
