//! Texts that the runs of a film print, passed on frame by frame.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use super::axis::FrameAxis;
use burgeon_base::error::SourcePlace;
use burgeon_base::locks::LockRecovery;
use burgeon_base::text::grouped;
use burgeon_engine::script::Print;

/// Maximum number of texts that wait for their frames.
const MOST: usize = 10_000;

/// Length (bytes) at which a text that waits ends.
const LONGEST: usize = 2_000;

/// Receiver of the texts of a film, and the texts of frames that have not been passed on.
pub(super) struct FilmPrints {
    receiver: Print,
    waiting: Arc<Mutex<WaitingPrints>>,
}

#[derive(Default)]
struct WaitingPrints {
    frames: BTreeMap<u32, FramePrints>,
    /// Number of texts of all frames.
    count: usize,
}

#[derive(Default)]
struct FramePrints {
    texts: Vec<(String, Option<SourcePlace>)>,
    /// Number of texts for which there was no room.
    left_out: usize,
}

impl FilmPrints {
    pub(super) fn new(receiver: Print) -> Self {
        Self { receiver, waiting: Arc::default() }
    }

    /// Returns the receiver of a run of frame `number`, whose texts replace those of an earlier run of it.
    pub(super) fn of_frame(&self, number: u32) -> Print {
        let mut waiting = self.waiting.lock().recover();
        waiting.remove(number);
        waiting.frames.insert(number, FramePrints::default());
        let waiting = Arc::clone(&self.waiting);
        Print::with_places(move |text, place| waiting.lock().recover().add(number, text, place))
    }

    /// Passes on the texts of the frames up to and with `number`, after the frame's label.
    pub(super) fn pass(&self, axis: &FrameAxis, number: u32) {
        loop {
            let frame = {
                let mut waiting = self.waiting.lock().recover();
                let next = waiting.frames.first_key_value().map(|(next, _)| *next);
                next.filter(|next| *next <= number).and_then(|next| Some((next, waiting.remove(next)?)))
            };
            let Some((number, frame)) = frame else { return };
            let label = axis.label(number);
            for (text, place) in frame.texts {
                self.receiver.take(&format!("{label}: {text}"), || place);
            }
            if frame.left_out > 0 {
                let text = format!("{label}: {} more texts are left out", grouped(frame.left_out));
                self.receiver.take(&text, || None);
            }
        }
    }
}

impl WaitingPrints {
    fn add(&mut self, number: u32, text: &str, place: Option<SourcePlace>) {
        let has_room = self.count < MOST;
        let Some(frame) = self.frames.get_mut(&number) else { return };
        if has_room {
            frame.texts.push((shorten(text), place));
            self.count += 1;
        } else {
            frame.left_out += 1;
        }
    }

    fn remove(&mut self, number: u32) -> Option<FramePrints> {
        let frame = self.frames.remove(&number)?;
        self.count -= frame.texts.len();
        Some(frame)
    }
}

/// Returns the beginning of a text that is too long, and the number of bytes that are left out.
fn shorten(text: &str) -> String {
    let end = (0..=text.len().min(LONGEST)).rev().find(|end| text.is_char_boundary(*end)).unwrap_or(0);
    let left_out = text.len() - end;
    if left_out == 0 { text.to_owned() } else { format!("{}… ({left_out} bytes more)", &text[..end]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_come_in_the_order_of_frames_and_say_what_is_left_out() {
        let got: Arc<Mutex<Vec<String>>> = Arc::default();
        let into = Arc::clone(&got);
        let prints = FilmPrints::new(Print::new(move |text| into.lock().unwrap().push(text.to_owned())));
        let axis: FrameAxis = "0:2".parse().unwrap();
        let second = prints.of_frame(1);
        second.take("b", || None);
        // The first run of frame 0 failed, and its texts come again.
        prints.of_frame(0).take("a", || None);
        prints.of_frame(0).take("a", || None);
        prints.pass(&axis, 0);
        assert_eq!(*got.lock().unwrap(), ["frame 0, time 0: a"]);
        (0..MOST).for_each(|_| second.take("c", || None));
        prints.pass(&axis, 1);
        let got = got.lock().unwrap();
        assert_eq!((got.len(), got[1].as_str()), (2 + MOST, "frame 1, time 1: b"));
        assert_eq!(got.last().unwrap(), "frame 1, time 1: 1 more texts are left out");
    }
}
