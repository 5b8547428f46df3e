//! Table "CFF" of a font: letters and subroutines.
//!
//! Format: Adobe Technical Note 5176, "The Compact Font Format Specification", 2003.

use std::ops::Range;

/// Operators of dictionaries; those of two bytes have 1200 added.
mod operator {
    pub(super) const CHARSET: u16 = 15;
    pub(super) const LETTERS: u16 = 17;
    pub(super) const PRIVATE: u16 = 18;
    pub(super) const SUBROUTINES: u16 = 19;
    pub(super) const REGISTRY: u16 = 1230;
    pub(super) const FONTS: u16 = 1236;
    pub(super) const FONT_SELECT: u16 = 1237;
}

/// A list of byte strings.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct CffIndex<'a> {
    offsets: &'a [u8],
    size: usize,
    content: &'a [u8],
}

impl<'a> CffIndex<'a> {
    /// Reads the list at a position; also returns the position after it.
    fn read(data: &'a [u8], at: usize) -> Option<(Self, usize)> {
        let count = usize::from(number_at(data, at)?);
        if count == 0 {
            return Some((Self::default(), at + 2));
        }
        let size = usize::from(*data.get(at + 2)?);
        if !(1..=4).contains(&size) {
            return None;
        }
        let start = at + 3 + (count + 1) * size;
        let mut index = Self { offsets: data.get(at + 3..start)?, size, content: &[] };
        let Some(length) = index.offset(count) else { return Some((Self::default(), start)) };
        index.content = data.get(start..start.checked_add(length)?)?;
        Some((index, start + length))
    }

    /// Returns the number of strings.
    pub(super) fn len(&self) -> usize {
        self.offsets.len().checked_div(self.size).unwrap_or(0).saturating_sub(1)
    }

    fn offset(&self, number: usize) -> Option<usize> {
        let bytes = self.offsets.get(number * self.size..(number + 1) * self.size)?;
        bytes.iter().fold(0, |sum, byte| sum << 8 | usize::from(*byte)).checked_sub(1)
    }

    /// Returns a string.
    pub(super) fn get(&self, number: usize) -> Option<&'a [u8]> {
        self.content.get(self.offset(number)?..self.offset(number + 1)?)
    }
}

/// The table.
#[derive(Debug, Clone, Default)]
pub(super) struct CffTable<'a> {
    data: &'a [u8],
    /// Programs of the letters.
    pub letters: CffIndex<'a>,
    /// Subroutines of all letters.
    pub global: CffIndex<'a>,
    /// Subroutines of the only font.
    local: Option<CffIndex<'a>>,
    /// Position of the names of the letters, or the number of a predefined list.
    charset: usize,
    /// Dictionaries of several fonts, and the position of the list that selects one for each letter.
    fonts: Option<(CffIndex<'a>, usize)>,
}

impl<'a> CffTable<'a> {
    /// Reads the table; `None` if it is damaged.
    pub(super) fn read(data: &'a [u8]) -> Option<Self> {
        let names = usize::from(*data.get(2)?).max(4);
        let (_, at) = CffIndex::read(data, names)?;
        let (tops, at) = CffIndex::read(data, at)?;
        let (_, at) = CffIndex::read(data, at)?;
        let (global, _) = CffIndex::read(data, at)?;
        let mut table = Self { data, global, ..Self::default() };
        let (mut private, mut fonts, mut select, mut is_registered) = (None, None, None, false);
        let mut letters = None;
        for (operator, operands) in entries(tops.get(0)?) {
            match operator {
                operator::CHARSET => table.charset = offset(&operands).unwrap_or(0),
                operator::LETTERS => letters = offset(&operands),
                operator::PRIVATE => private = range(&operands),
                operator::REGISTRY => is_registered = true,
                operator::FONTS => fonts = offset(&operands),
                operator::FONT_SELECT => select = offset(&operands),
                _ => {}
            }
        }
        (table.letters, _) = CffIndex::read(data, letters?)?;
        if is_registered {
            table.fonts = Some((CffIndex::read(data, fonts?)?.0, select?));
        } else if let Some(private) = private {
            table.local = Some(table.subroutines(private).unwrap_or_default());
        } else {
            table.local = Some(CffIndex::default());
        }
        Some(table)
    }

    /// Returns the subroutines of a dictionary at a position.
    fn subroutines(&self, private: Range<usize>) -> Option<CffIndex<'a>> {
        let start = private.start;
        let entries = entries(self.data.get(private)?);
        let operands = entries.into_iter().rev().find(|(operator, _)| *operator == operator::SUBROUTINES)?.1;
        Some(CffIndex::read(self.data, start.checked_add(offset(&operands)?)?)?.0)
    }

    /// Returns the subroutines of the font that a letter belongs to.
    pub(super) fn local(&self, letter: usize) -> Option<CffIndex<'a>> {
        let Some((fonts, select)) = &self.fonts else { return self.local };
        let font = fonts.get(self.font_of(*select, letter)?)?;
        let private = entries(font).into_iter().find(|(operator, _)| *operator == operator::PRIVATE)?;
        self.subroutines(range(&private.1)?)
    }

    /// Returns the number of a letter's font.
    fn font_of(&self, select: usize, letter: usize) -> Option<usize> {
        if *self.data.get(select)? == 0 {
            return self.data.get(select + 1 + letter).map(|font| usize::from(*font));
        }
        let count = usize::from(number_at(self.data, select + 1)?);
        let first = |range: usize| number_at(self.data, select + 3 + 3 * range).map(usize::from);
        let range = (0..count).find(|range| {
            let ends = (first(*range), first(*range + 1));
            matches!(ends, (Some(from), Some(to)) if (from..to).contains(&letter))
        })?;
        self.data.get(select + 5 + 3 * range).map(|font| usize::from(*font))
    }

    /// Returns the letter with a code of the standard encoding.
    pub(super) fn letter_of(&self, code: u8) -> Option<usize> {
        let name = standard_name(code);
        if self.charset == 0 {
            return (code <= 228).then_some(name);
        }
        if self.charset <= 2 {
            return None;
        }
        if name == 0 {
            return Some(0);
        }
        let format = *self.data.get(self.charset)?;
        let (mut at, mut letter) = (self.charset + 1, 1);
        while letter < self.letters.len() {
            let first = usize::from(number_at(self.data, at)?);
            let more = match format {
                0 => 0,
                1 => usize::from(*self.data.get(at + 2)?),
                2 => usize::from(number_at(self.data, at + 2)?),
                _ => return None,
            };
            if (first..=first + more).contains(&name) {
                return Some(letter + name - first);
            }
            letter += more + 1;
            at += 2 + usize::from(format);
        }
        None
    }
}

/// Returns the number of the standard name of a code of the standard encoding; 0 if there is none.
fn standard_name(code: u8) -> usize {
    const RUNS: [(u8, u8, usize); 13] = [
        (32, 126, 1),
        (161, 175, 96),
        (177, 180, 111),
        (182, 189, 115),
        (191, 191, 123),
        (193, 200, 124),
        (202, 203, 132),
        (205, 208, 134),
        (225, 225, 138),
        (227, 227, 139),
        (232, 235, 140),
        (241, 241, 144),
        (245, 245, 145),
    ];
    let mut runs = RUNS.into_iter().chain([(248, 251, 146)]);
    let run = runs.find(|(first, last, _)| (*first..=*last).contains(&code));
    run.map_or(0, |(first, _, name)| name + usize::from(code - first))
}

/// Returns the operators of a dictionary with their operands.
fn entries(data: &[u8]) -> Vec<(u16, Vec<f64>)> {
    let (mut all, mut operands, mut at) = (Vec::new(), Vec::new(), 0);
    while let Some(&byte) = data.get(at) {
        at += 1;
        let next = data.get(at).copied().map(f64::from);
        match byte {
            0..=27 | 31 | 255 => {
                let mut operator = u16::from(byte);
                if byte == 12 {
                    let Some(&second) = data.get(at) else { break };
                    operator = 1200 + u16::from(second);
                    at += 1;
                }
                all.push((operator, std::mem::take(&mut operands)));
                continue;
            }
            28 => {
                let Some(bytes) = data.get(at..at + 2) else { break };
                operands.push(f64::from(i16::from_be_bytes([bytes[0], bytes[1]])));
                at += 2;
            }
            29 => {
                let Some(bytes) = data.get(at..at + 4) else { break };
                operands.push(f64::from(i32::from_be_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])));
                at += 4;
            }
            30 => operands.push(real(data, &mut at)),
            32..=246 => operands.push(f64::from(byte) - 139.0),
            247..=254 => {
                let Some(next) = next else { break };
                at += 1;
                operands.push(if byte < 251 {
                    (f64::from(byte) - 247.0) * 256.0 + next + 108.0
                } else {
                    -(f64::from(byte) - 251.0) * 256.0 - next - 108.0
                });
            }
        }
    }
    all
}

/// Reads a real number, whose digits are half bytes.
fn real(data: &[u8], at: &mut usize) -> f64 {
    let mut text = String::new();
    while let Some(&byte) = data.get(*at) {
        *at += 1;
        for half in [byte >> 4, byte & 15] {
            match half {
                0..=9 => text.push(char::from(b'0' + half)),
                10 => text.push('.'),
                11 => text.push('E'),
                12 => text.push_str("E-"),
                14 => text.push('-'),
                _ => return text.parse().unwrap_or(0.0),
            }
        }
    }
    text.parse().unwrap_or(0.0)
}

/// Returns the only operand as a position.
fn offset(operands: &[f64]) -> Option<usize> {
    let [only] = operands else { return None };
    position(*only)
}

/// Returns two operands, a length and a position, as a range.
fn range(operands: &[f64]) -> Option<Range<usize>> {
    let [length, start] = operands else { return None };
    let start = position(*start)?;
    Some(start..start.checked_add(position(*length)?)?)
}

#[allow(clippy::cast_possible_truncation, reason = "saturates, as positions are below 2^31")]
fn position(number: f64) -> Option<usize> {
    usize::try_from(number as i32).ok()
}

/// Returns the 16-bit number at a position; `None` beyond the end.
fn number_at(content: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_be_bytes(content.get(at..at + 2)?.try_into().ok()?))
}
