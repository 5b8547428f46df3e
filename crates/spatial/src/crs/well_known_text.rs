//! Parser of coordinate systems in well-known text.

/// Maximum nesting depth of brackets.
const DEEPEST: usize = 20;

/// Keyword of well-known text with its bracketed content.
#[derive(Default)]
pub(super) struct TextNode {
    pub(super) word: String,
    pub(super) texts: Vec<String>,
    pub(super) numbers: Vec<f64>,
    pub(super) nodes: Vec<TextNode>,
}

impl TextNode {
    /// Reads the first keyword of a text; `None` if its brackets are not closed.
    pub(super) fn read(text: &str) -> Option<Self> {
        Self::begin(&mut text.trim(), 0)
    }

    /// Reads all keywords of a text, up to the first whose brackets are not closed. ESRI's programs write a vertical
    /// system after the horizontal one.
    pub(super) fn read_all(text: &str) -> Vec<Self> {
        let mut rest = text.trim();
        let next = || {
            let node = Self::begin(&mut rest, 0)?;
            rest = rest.trim_start_matches(|letter: char| letter == ',' || letter.is_whitespace());
            Some(node)
        };
        std::iter::from_fn(next).collect()
    }

    fn begin(text: &mut &str, depth: usize) -> Option<Self> {
        if depth > DEEPEST {
            return None;
        }
        let end = text.find(['[', '('])?;
        let mut node = Self { word: text[..end].trim().to_ascii_uppercase(), ..Self::default() };
        *text = &text[end + 1..];
        loop {
            *text = text.trim_start();
            match text.chars().next()? {
                ']' | ')' => {
                    *text = &text[1..];
                    return Some(node);
                }
                ',' => *text = &text[1..],
                '"' => {
                    let (inner, rest) = text[1..].split_once('"')?;
                    node.texts.push(inner.to_owned());
                    *text = rest;
                }
                _ => {
                    let end = text.find([',', ']', ')', '[', '('])?;
                    if matches!(text.as_bytes()[end], b'[' | b'(') {
                        node.nodes.push(Self::begin(text, depth + 1)?);
                        continue;
                    }
                    let word = text[..end].trim();
                    match word.parse() {
                        Ok(number) => node.numbers.push(number),
                        Err(_) => node.texts.push(word.to_owned()),
                    }
                    *text = &text[end..];
                }
            }
        }
    }

    pub(super) fn name(&self) -> &str {
        self.texts.first().map_or("", String::as_str)
    }

    pub(super) fn child(&self, words: &[&str]) -> Option<&Self> {
        self.nodes.iter().find(|node| words.contains(&node.word.as_str()))
    }

    /// Returns the EPSG code in the text, if any.
    pub(super) fn code(&self) -> Option<u32> {
        let node = self.child(&["AUTHORITY", "ID"])?;
        let is_epsg = node.name().eq_ignore_ascii_case("EPSG");
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
        let number =
            node.numbers.first().filter(|number| (1.0..1e6).contains(*number)).map(|number| *number as u32);
        let code = number.or_else(|| node.texts.get(1)?.parse().ok());
        code.filter(|_| is_epsg)
    }
}
