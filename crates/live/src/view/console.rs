//! Console: the texts that the scripts of a run print, each with its line; the first and the last of very many.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};

use super::message::{Event, PrintMessage};
use super::state::ServerState;
use burgeon_base::error::SourcePlace;
use burgeon_base::locks::LockRecovery;
use burgeon_engine::script::Print;

/// Number of first texts that are kept.
const FIRST: usize = 300;

/// Number of last texts that are kept.
const LAST: usize = 200;

/// Length (bytes) at which the text of a print ends.
const LONGEST: usize = 2_000;

/// Texts that a run has printed.
#[derive(Default)]
pub(super) struct Console(Mutex<PrintedTexts>);

#[derive(Default)]
struct PrintedTexts {
    first: Vec<PrintedText>,
    last: VecDeque<PrintedText>,
    left_out: u64,
    /// Set if there are texts that pages have not received.
    is_new: bool,
}

struct PrintedText {
    text: String,
    place: Option<SourcePlace>,
    count: u64,
}

impl Console {
    /// Returns a receiver that adds to `console` and passes each text on to `next`.
    pub(super) fn receiver(console: &Arc<Self>, next: Option<Print>) -> Print {
        let console = Arc::clone(console);
        Print::with_places(move |text, place| {
            if let Some(next) = &next {
                next.take(text, || place.clone());
            }
            console.0.lock().recover().add(text, place);
        })
    }

    /// Returns true if nothing has been printed.
    pub(super) fn is_empty(&self) -> bool {
        self.0.lock().recover().first.is_empty()
    }

    /// Returns the message to pages, if there are texts that they have not received.
    pub(super) fn news(&self, state: &ServerState, run: u64) -> Option<Event> {
        let is_new = std::mem::take(&mut self.0.lock().recover().is_new);
        is_new.then(|| self.message(state, run))
    }

    /// Returns the message to pages.
    pub(super) fn message(&self, state: &ServerState, run: u64) -> Event {
        let mut texts = self.0.lock().recover();
        texts.is_new = false;
        let message = |printed: &PrintedText| {
            let place = printed.place.as_ref();
            PrintMessage {
                text: printed.text.clone(),
                file: place.map_or_else(String::new, |place| state.short(&place.file)),
                line: place.map_or(0, |place| place.line),
                count: printed.count,
            }
        };
        let lines = texts.first.iter().chain(&texts.last).map(message).collect();
        Event::Printed { run, lines, gap: texts.first.len(), left_out: texts.left_out }
    }
}

impl PrintedTexts {
    fn add(&mut self, text: &str, place: Option<SourcePlace>) {
        self.is_new = true;
        let before = self.last.back_mut().or(self.first.last_mut());
        if let Some(before) = before
            && before.place == place
            && before.is(text)
        {
            before.count += 1;
            return;
        }
        if self.first.len() < FIRST {
            self.first.push(PrintedText::new(String::new(), text, place));
            return;
        }
        let mut storage = String::new();
        if self.last.len() == LAST
            && let Some(oldest) = self.last.pop_front()
        {
            self.left_out += oldest.count;
            storage = oldest.text;
        }
        self.last.push_back(PrintedText::new(storage, text, place));
    }
}

impl PrintedText {
    /// Creates an entry for `text` that reuses `storage`.
    fn new(mut storage: String, text: &str, place: Option<SourcePlace>) -> Self {
        storage.clear();
        let most = text.len().min(LONGEST);
        let end = (0..=most).rev().find(|end| text.is_char_boundary(*end)).unwrap_or(0);
        storage.push_str(&text[..end]);
        if end < text.len() {
            storage.push_str(&format!("… ({} bytes more)", text.len() - end));
        }
        Self { text: storage, place, count: 1 }
    }

    /// Returns true if `text` is the printed text. The ends of long texts are not known, so they never are.
    fn is(&self, text: &str) -> bool {
        text.len() <= LONGEST && self.text == text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(line: usize) -> Option<SourcePlace> {
        Some(SourcePlace { file: "a.lua".into(), line })
    }

    #[test]
    fn texts_in_a_row_are_counted_if_the_same_line_prints_them() {
        let mut texts = PrintedTexts::default();
        for (text, line) in [("a", 1), ("a", 1), ("a", 2), ("b", 2), ("a", 1)] {
            texts.add(text, place(line));
        }
        let counts: Vec<(&str, u64)> =
            texts.first.iter().map(|printed| (printed.text.as_str(), printed.count)).collect();
        assert_eq!(counts, [("a", 2), ("a", 1), ("b", 1), ("a", 1)]);
    }

    #[test]
    fn of_very_many_texts_the_first_and_the_last_are_kept() {
        let mut texts = PrintedTexts::default();
        for number in 0..100_000 {
            texts.add(&number.to_string(), place(1));
        }
        assert_eq!((texts.first.len(), texts.last.len()), (FIRST, LAST));
        assert_eq!(texts.left_out as usize, 100_000 - FIRST - LAST);
        assert_eq!(texts.last.back().unwrap().text, "99999");
        assert_eq!(texts.first[FIRST - 1].text, (FIRST - 1).to_string());
    }

    #[test]
    fn a_long_text_is_cut_between_letters() {
        let mut texts = PrintedTexts::default();
        let long = format!("{}€", "x".repeat(LONGEST - 1));
        texts.add(&long, None);
        texts.add(&long, None);
        assert_eq!(texts.first.len(), 2);
        assert_eq!(texts.first[0].text, format!("{}… (3 bytes more)", "x".repeat(LONGEST - 1)));
    }
}
