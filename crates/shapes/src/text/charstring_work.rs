//! Work of the programs of letters in the table "CFF" of a font.
//!
//! Format: Adobe Technical Note 5177, "The Type 2 Charstring Format", 2000.

use burgeon_base::Stop;
use burgeon_base::error::{Error, Limit, Result};
use ttf_parser::{Face, GlyphId, Tag};

use super::cff_table::{CffIndex, CffTable};

/// Maximum number of steps of a letter.
const MOST_STEPS: usize = 1_000_000;
/// Number of steps between two checks for cancellation.
const STRETCH: usize = 1 << 16;
/// Maximum depth of calls, and maximum number of operands, as of the crate that reads fonts.
const MOST_CALLS: usize = 10;
const MOST_OPERANDS: usize = 48;

/// Fails if the program of a letter takes more steps than any letter needs, such as by subroutines that call each other many
/// times.
///
/// Runs the program without drawing. It ends where the crate that reads fonts ends, or later.
pub(super) fn check_charstring(face: &Face<'_>, glyph: GlyphId) -> Result<()> {
    let Some(data) = face.raw_face().table(Tag::from_bytes(b"CFF ")) else { return Ok(()) };
    if face.tables().glyf.is_some() || face.tables().cff.is_none() {
        return Ok(());
    }
    let damaged = |what: &str| {
        let message = format!("letter {} of the font {what}", glyph.0);
        Error::limit(Limit::Size, message).help("use another font: this one is damaged")
    };
    let Some(table) = CffTable::read(data) else { return Err(damaged("has an outline that cannot be read")) };
    let letter = usize::from(glyph.0);
    let Some(program) = table.letters.get(letter) else { return Ok(()) };
    let mut run = ProgramRun {
        local: table.local(letter),
        table: &table,
        operands: Vec::with_capacity(MOST_OPERANDS),
        stems: 0,
        has_width: false,
        has_ended: false,
        is_composite: false,
        steps: 0,
    };
    match run.run(program, 0) {
        Err(ProgramEnd::TooLong) => Err(damaged(&format!("takes more than {MOST_STEPS} steps to draw"))),
        Err(ProgramEnd::Stopped(error)) => Err(error),
        Ok(()) | Err(ProgramEnd::Invalid) => Ok(()),
    }
}

/// Cause of the end of a run.
enum ProgramEnd {
    /// The program is not valid, so nothing is drawn.
    Invalid,
    TooLong,
    Stopped(Error),
}

/// State of a run.
struct ProgramRun<'a> {
    table: &'a CffTable<'a>,
    local: Option<CffIndex<'a>>,
    operands: Vec<f32>,
    /// Number of hints, each of which has a bit in masks.
    stems: usize,
    has_width: bool,
    has_ended: bool,
    /// Set if the letter consists of two others.
    is_composite: bool,
    steps: usize,
}

impl<'a> ProgramRun<'a> {
    /// Runs the program of a letter or a subroutine.
    fn run(&mut self, program: &'a [u8], depth: usize) -> Result<(), ProgramEnd> {
        let mut at = 0;
        while let Some(&code) = program.get(at) {
            at += 1;
            self.steps += 1;
            if self.steps > MOST_STEPS {
                return Err(ProgramEnd::TooLong);
            }
            if self.steps.is_multiple_of(STRETCH) {
                Stop::check_current().map_err(ProgramEnd::Stopped)?;
            }
            let bytes = |count: usize| program.get(at..at + count).ok_or(ProgramEnd::Invalid);
            match code {
                0 | 2 | 9 | 13 | 15..=17 => return Err(ProgramEnd::Invalid),
                1 | 3 | 18 | 23 => {
                    self.read_width(self.operands.len() % 2 == 1);
                    self.stems += self.operands.len() / 2;
                    self.operands.clear();
                }
                4 | 22 => {
                    self.read_width(self.operands.len() == 2);
                    self.operands.clear();
                }
                21 => {
                    self.read_width(self.operands.len() == 3);
                    self.operands.clear();
                }
                19 | 20 => {
                    self.read_width(self.operands.len() % 2 == 1);
                    self.stems += self.operands.len() / 2;
                    self.operands.clear();
                    at += self.stems.div_ceil(8);
                }
                10 | 29 => {
                    let number = self.operands.pop().ok_or(ProgramEnd::Invalid)?;
                    let all = if code == 29 { Some(self.table.global) } else { self.local };
                    let called = all.and_then(|all| all.get(subroutine(number, all.len())?));
                    self.call(called, depth)?;
                    if self.has_ended && !self.is_composite {
                        break;
                    }
                }
                11 => break,
                14 => {
                    self.end(depth)?;
                    break;
                }
                12 => {
                    bytes(1)?;
                    at += 1;
                    self.operands.clear();
                }
                28 => {
                    let number = bytes(2)?;
                    self.push(f32::from(i16::from_be_bytes([number[0], number[1]])))?;
                    at += 2;
                }
                5..=8 | 24..=27 | 30 | 31 => self.operands.clear(),
                32..=246 => self.push(f32::from(code) - 139.0)?,
                247..=254 => {
                    let low = f32::from(bytes(1)?[0]) + 108.0;
                    at += 1;
                    let high = f32::from(code);
                    self.push(if code < 251 {
                        (high - 247.0) * 256.0 + low
                    } else {
                        -(high - 251.0) * 256.0 - low
                    })?;
                }
                255 => {
                    let number = bytes(4)?;
                    let whole = i16::from_be_bytes([number[0], number[1]]);
                    let part = u16::from_be_bytes([number[2], number[3]]);
                    self.push(f32::from(whole) + f32::from(part) / 65536.0)?;
                    at += 4;
                }
            }
        }
        Ok(())
    }

    /// Runs another program.
    fn call(&mut self, program: Option<&'a [u8]>, depth: usize) -> Result<(), ProgramEnd> {
        let program = program.filter(|_| depth < MOST_CALLS).ok_or(ProgramEnd::Invalid)?;
        self.run(program, depth + 1)
    }

    /// Ends a letter: with four operands, it consists of two other letters.
    fn end(&mut self, depth: usize) -> Result<(), ProgramEnd> {
        let count = self.operands.len();
        if count == 4 || (count == 5 && !self.has_width) {
            let mut letter = || {
                let code = self.operands.pop().filter(|code| (0.0..256.0).contains(code))?;
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
                self.table.letter_of(code as u8)
            };
            let accent = letter().ok_or(ProgramEnd::Invalid)?;
            let base = letter().ok_or(ProgramEnd::Invalid)?;
            self.operands.truncate(count - 4);
            self.read_width(!self.operands.is_empty());
            self.operands.clear();
            self.is_composite = true;
            self.call(self.table.letters.get(base), depth)?;
            self.call(self.table.letters.get(accent), depth)?;
        } else if count == 1 && !self.has_width {
            self.operands.clear();
            self.has_width = true;
        }
        self.has_ended = true;
        Ok(())
    }

    fn read_width(&mut self, is_present: bool) {
        self.has_width |= is_present;
    }

    fn push(&mut self, number: f32) -> Result<(), ProgramEnd> {
        if self.operands.len() == MOST_OPERANDS {
            return Err(ProgramEnd::Invalid);
        }
        self.operands.push(number);
        Ok(())
    }
}

/// Returns the number of a subroutine among `count`.
fn subroutine(number: f32, count: usize) -> Option<usize> {
    let bias = match count {
        0..1240 => 107,
        1240..33900 => 1131,
        _ => 32768,
    };
    #[allow(clippy::cast_possible_truncation, reason = "an operand is at most 2^15")]
    usize::try_from(number as i32 + bias).ok()
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::super::Font;
    use ttf_parser::GlyphId;

    /// Returns a list of byte strings as the table has them.
    fn index(items: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = u16::try_from(items.len()).expect("few items").to_be_bytes().to_vec();
        if items.is_empty() {
            return bytes;
        }
        bytes.push(4);
        let mut at = 1_u32;
        for item in items {
            bytes.extend(at.to_be_bytes());
            at += u32::try_from(item.len()).expect("short");
        }
        bytes.extend(at.to_be_bytes());
        bytes.extend(items.iter().flatten());
        bytes
    }

    /// Returns a number of a dictionary or a program, in a length that does not depend on it.
    fn long(number: usize) -> Vec<u8> {
        let mut bytes = vec![29];
        bytes.extend(i32::try_from(number).expect("small").to_be_bytes());
        bytes
    }

    /// Returns the shipped font with these programs of letters and subroutines instead of its outlines: the table "glyf" is not
    /// found, and "CFF" is a new one. The programs repeat for all letters.
    fn font(letters: &[Vec<u8>], global: &[Vec<u8>], local: &[Vec<u8>]) -> Vec<u8> {
        let whole = ttf_noto_sans::REGULAR;
        let count = ttf_parser::Face::parse(whole, 0).expect("a font").number_of_glyphs();
        let all: Vec<Vec<u8>> = letters.iter().cloned().cycle().take(usize::from(count)).collect();
        let build = |letters_at: usize, private_at: usize| {
            let mut top = long(letters_at);
            top.push(17);
            top.extend([long(6), long(private_at)].concat());
            top.push(18);
            let mut table = vec![1, 0, 4, 4];
            table.extend(index(&[b"A".to_vec()]));
            table.extend(index(&[top]));
            table.extend(index(&[]));
            table.extend(index(global));
            table
        };
        let letters_at = build(0, 0).len();
        let programs = index(&all);
        let private_at = letters_at + programs.len();
        let mut table = build(letters_at, private_at);
        table.extend(programs);
        table.extend(long(6));
        table.push(19);
        table.extend(index(local));
        let mut content = whole.to_vec();
        let at = u32::try_from(content.len()).expect("small").to_be_bytes();
        let length = u32::try_from(table.len()).expect("small").to_be_bytes();
        // Names of tables are in alphabetical order, and "CFF " becomes the first one.
        let records = 12..12 + 16 * usize::from(u16::from_be_bytes([content[4], content[5]]));
        let mut sorted: Vec<Vec<u8>> =
            content[records.clone()].chunks_exact(16).map(<[u8]>::to_vec).collect();
        for record in &mut sorted {
            if record.starts_with(b"glyf") {
                record[..4].copy_from_slice(b"CFF ");
                record[8..12].copy_from_slice(&at);
                record[12..].copy_from_slice(&length);
            }
        }
        sorted.sort();
        content[records].copy_from_slice(&sorted.concat());
        content.extend(table);
        content
    }

    /// Returns a program of numbers and operators: numbers from -107 to 107 as they are, and operators with 1000 added.
    fn program(codes: &[i32]) -> Vec<u8> {
        let byte = |code: &i32| u8::try_from(if *code >= 1000 { code - 1000 } else { code + 139 });
        codes.iter().map(|code| byte(code).expect("a byte")).collect()
    }

    const CALL: i32 = 1010;
    const CALL_GLOBAL: i32 = 1029;
    const RETURN: i32 = 1011;
    const END: i32 = 1014;
    const MOVE: i32 = 1021;
    const LINES: i32 = 1005;

    /// Returns a triangle's program.
    fn triangle() -> Vec<u8> {
        program(&[10, 0, MOVE, 100, 0, -50, 100, LINES, END])
    }

    #[test]
    fn a_letter_of_a_font_with_programs_is_drawn() {
        let calls = program(&[-107, CALL, -107, CALL_GLOBAL, END]);
        let content = font(
            &[triangle(), calls],
            &[program(&[100, 0, -50, 100, LINES, RETURN])],
            &[program(&[10, 0, MOVE, RETURN])],
        );
        let font = Font::read(content).expect("a font");
        let sized = font.at_size(1.0, 0.01).expect("measures");
        let areas = [0, 1].map(|letter| sized.area(GlyphId(letter)).expect("a letter"));
        assert!(areas[0].len() == 1 && areas[0] == areas[1], "{areas:?}");
    }

    #[test]
    fn subroutines_that_call_each_other_many_times_are_refused_at_once() {
        let begin = Instant::now();
        // Each of ten levels calls the next one a hundred times, and none draws.
        let level = |number: i32| program(&[-106 + number, CALL].repeat(100));
        let local: Vec<Vec<u8>> = (0..9).map(level).chain([program(&[RETURN])]).collect();
        let global: Vec<Vec<u8>> = (0..9)
            .map(|number| program(&[-106 + number, CALL_GLOBAL].repeat(100)))
            .chain([vec![11]])
            .collect();
        for call in [CALL, CALL_GLOBAL] {
            let content = font(&[program(&[-107, call, END])], &global, &local);
            let font = Font::read(content).expect("a font");
            let sized = font.at_size(1.0, 0.01).expect("measures");
            let error = sized.area(GlyphId(0)).expect_err("a damaged letter");
            assert!(error.to_string().contains("more than 1000000 steps"), "{error}");
        }
        // A letter of two others, each of which is such a letter, too.
        let twice = program(&[0, 0, 32, 32, END]);
        let font = Font::read(font(&[twice], &[], &[])).expect("a font");
        let sized = font.at_size(1.0, 0.01).expect("measures");
        assert!(sized.area(GlyphId(1)).expect("an empty letter").is_empty());
        assert!(begin.elapsed().as_secs() < 2, "{:?}", begin.elapsed());
    }

    #[test]
    fn fonts_of_programs_with_other_bytes_neither_panic_nor_take_long() {
        let level = |number: i32| program(&[-106 + number, CALL].repeat(3));
        let local: Vec<Vec<u8>> = (0..9).map(level).chain([program(&[10, 0, MOVE, RETURN])]).collect();
        let masks = program(&[1, 2, 1001, 3, 4, 1019, 50, 10, 0, MOVE, 100, 0, -50, 100, LINES, END]);
        let whole = font(&[triangle(), program(&[-104, CALL, END]), masks], &[], &local);
        let start = ttf_noto_sans::REGULAR.len();
        let mut random = burgeon_base::random::Stream::new(9);
        let (mut read, mut drawn) = (0, 0);
        for round in 0..4000 {
            let mut content = whole.clone();
            // The dictionaries, the programs of some letters, or the subroutines.
            let length = content.len();
            let ranges =
                [(start, 200), (length - 600, 600), (length - 60_000, 60_000), (start, length - start)];
            for _ in 0..=random.below(30) {
                let (from, length) = ranges[random.below(ranges.len())];
                content[from + random.below(length)] = u8::try_from(random.below(256)).expect("a byte");
            }
            let begin = Instant::now();
            let Ok(font) = Font::read(content) else { continue };
            read += 1;
            let Ok(sized) = font.at_size(1.0, 0.01) else { continue };
            for letter in 0..12 {
                drawn += usize::from(sized.area(GlyphId(letter)).is_ok());
            }
            assert!(begin.elapsed().as_secs() < 3, "{round}");
        }
        assert!(read > 500 && drawn > 500, "{read} {drawn}");
    }
}
