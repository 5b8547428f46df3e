//! Whether a script could tell a table that is made later from one that is there.

/// The functions with which a script sees a table as it is.
const PEEKING: [&str; 6] = ["pairs", "next", "rawget", "getmetatable", "clone", "foreach"];

/// Whether a script could tell a table that is made later from one that is there.
pub(crate) fn peeks(text: &str) -> bool {
    let apart = |letter: Option<char>| letter.is_none_or(|it| !it.is_alphanumeric() && it != '_');
    PEEKING.iter().any(|name| {
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
        assert!(peeks("for k in pairs(t) do") && peeks("table.clone(x)") && peeks("next"));
        assert!(!peeks("for k in ipairs(t) do") && !peeks("next_door = 1") && !peeks("f.geometry"));
    }
}
