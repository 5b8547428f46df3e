//! Draws short texts in an image with the strokes of a pen.
//!
//! The glyphs are the simplex sans of the Hershey fonts, which Dr. A. V. Hershey digitized at the U.S. National Bureau
//! of Standards and which may be used freely with this acknowledgement ("Calligraphy for computers", 1967; in the
//! format that James Hurt made for the Usenet Font Consortium).

use std::borrow::Cow;

use burgeon_scene::image::Image;

/// Distance from the top of the capitals to the bottom of descenders, in units of the capitals' height.
pub(super) const LINE: f32 = 28.0 / CAPITAL;
/// Height of capitals in the glyphs' units.
const CAPITAL: f32 = 21.0;
/// Top of the capitals in the glyphs' units.
const TOP: f32 = -12.0;
/// Thickness of the pen in units of the capitals' height.
const PEN: f32 = 0.105;

/// Returns the width (pixels) of `text` with capitals of `height` (pixels).
pub(super) fn width(text: &str, height: f32) -> f32 {
    text.chars().map(|letter| advance(glyph(letter))).sum::<f32>() * height / CAPITAL
}

/// Shortens `text` to fit into `room` (pixels), with an ellipsis if characters are removed.
pub(super) fn fitted(text: &str, height: f32, room: f32) -> Cow<'_, str> {
    if width(text, height) <= room {
        return Cow::Borrowed(text);
    }
    let mut letters: Vec<char> = text.chars().collect();
    loop {
        letters.pop();
        let mut shorter: String = letters.iter().collect();
        shorter.truncate(shorter.trim_end().len());
        shorter.push_str("...");
        if letters.is_empty() || width(&shorter, height) <= room {
            return Cow::Owned(shorter);
        }
    }
}

/// Breaks `text` at spaces into lines that fit into `room` (pixels). A longer word is not broken.
pub(super) fn wrapped(text: &str, height: f32, room: f32) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.len() - 1;
        if lines[line].is_empty() {
            lines[line].push_str(word);
            continue;
        }
        let longer = format!("{} {word}", lines[line]);
        if width(&longer, height) <= room {
            lines[line] = longer;
        } else {
            lines.push(word.to_owned());
        }
    }
    lines.into_iter().map(|line| fitted(&line, height, room).into_owned()).collect()
}

/// Draws `text` with the upper left corner of its first capital at `place` (pixels).
pub(super) fn draw(image: &mut Image, text: &str, place: [f32; 2], height: f32, color: [u8; 3]) {
    let scale = height / CAPITAL;
    let mut x = place[0];
    for letter in text.chars() {
        let glyph = glyph(letter);
        let left = coordinate(glyph.as_bytes()[0]);
        let put = |point: [f32; 2]| [x + (point[0] - left) * scale, place[1] + (point[1] - TOP) * scale];
        let strokes: Vec<[[f32; 2]; 2]> = strokes(glyph).map(|stroke| stroke.map(put)).collect();
        ink(image, &strokes, (PEN * height).max(1.1) / 2.0, color);
        x += advance(glyph) * scale;
    }
}

/// Colours the pixels within the distance `reach` (pixels) of a stroke.
fn ink(image: &mut Image, strokes: &[[[f32; 2]; 2]], reach: f32, color: [u8; 3]) {
    let ends = || strokes.iter().flatten();
    let low = |axis: usize| ends().map(|end| end[axis]).fold(f32::INFINITY, f32::min) - reach - 1.0;
    let high = |axis: usize| ends().map(|end| end[axis]).fold(f32::NEG_INFINITY, f32::max) + reach + 1.0;
    let range = |axis: usize, size: u32| {
        let end = |x: f32| x.clamp(0.0, size as f32) as u32;
        end(low(axis).floor())..end(high(axis).ceil())
    };
    if strokes.is_empty() {
        return;
    }
    let (columns, rows) = (range(0, image.width()), range(1, image.height()));
    for y in rows {
        for x in columns.start..columns.end {
            let center = [x as f32 + 0.5, y as f32 + 0.5];
            let distance =
                strokes.iter().map(|stroke| distance(center, *stroke)).fold(f32::INFINITY, f32::min);
            let cover = (reach + 0.5 - distance).clamp(0.0, 1.0);
            if cover > 0.0 {
                let pixel = &mut image.row_mut(y)[x as usize];
                *pixel = over(*pixel, color, cover);
            }
        }
    }
}

/// Blends `color` over `pixel` with the opacity `cover`.
fn over(pixel: [u8; 4], color: [u8; 3], cover: f32) -> [u8; 4] {
    let below = f32::from(pixel[3]) / 255.0;
    let opacity = cover + below * (1.0 - cover);
    let mix = |i: usize| {
        let sum = f32::from(color[i]) * cover + f32::from(pixel[i]) * below * (1.0 - cover);
        (sum / opacity).round() as u8
    };
    [mix(0), mix(1), mix(2), (opacity * 255.0).round() as u8]
}

fn distance(point: [f32; 2], [from, to]: [[f32; 2]; 2]) -> f32 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let gap = [point[0] - from[0], point[1] - from[1]];
    let length = along[0] * along[0] + along[1] * along[1];
    let share =
        if length > 0.0 { ((gap[0] * along[0] + gap[1] * along[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    (gap[0] - share * along[0]).hypot(gap[1] - share * along[1])
}

/// Returns the glyph of `letter`, or a box if there is none.
fn glyph(letter: char) -> &'static str {
    const BOX: &str = "I[KFYFY[K[KF";
    let index = (letter as usize).checked_sub(' ' as usize);
    index.and_then(|index| GLYPHS.get(index)).copied().unwrap_or(BOX)
}

fn advance(glyph: &str) -> f32 {
    coordinate(glyph.as_bytes()[1]) - coordinate(glyph.as_bytes()[0])
}

/// Returns the line segments of a glyph, in its units.
fn strokes(glyph: &str) -> impl Iterator<Item = [[f32; 2]; 2]> {
    glyph[2..].split(' ').flat_map(|stroke| {
        let points: Vec<[f32; 2]> = stroke
            .as_bytes()
            .chunks_exact(2)
            .map(|point| [coordinate(point[0]), coordinate(point[1])])
            .collect();
        points.windows(2).map(|ends| [ends[0], ends[1]]).collect::<Vec<_>>()
    })
}

fn coordinate(byte: u8) -> f32 {
    f32::from(byte) - f32::from(b'R')
}

/// Glyphs of the characters from the space to the tilde: left and right side, then strokes separated by spaces. Each
/// point is two characters, x and y downwards, coded as the distance from R in the alphabet.
#[rustfmt::skip]
const GLYPHS: [&str; 95] = [
    r"JZ", r"MWRFRT RYQZR[SZRY", r"JZNFNM VFVM", r"H]SBLb YBRb LOZO KUYU",
    r"H\PBP_ TBT_ YIWGTFPFMGKIKKLMMNOOUQWRXSYUYXWZT[P[MZKX",
    r"F^[FI[ NFPHPJOLMMKMIKIIJGLFNFPGSHVHYG[F WTUUTWTYV[X[ZZ[X[VYTWT",
    r"E_\O\N[MZMYNXPVUTXRZP[L[JZIYHWHUISJRQNRMSKSIRGPFNGMIMKNNPQUXWZY[[[\Z\Y", r"MWRHQGRFSGSIRKQL",
    r"KYVBTDRGPKOPOTPYR]T`Vb", r"KYNBPDRGTKUPUTTYR]P`Nb", r"JZRLRX MOWU WOMU", r"E_RIR[ IR[R",
    r"NVSWRXQWRVSWSYQ[", r"E_IR[R", r"NVRVQWRXSWRV", r"G][BIb", r"H\QFNGLJKOKRLWNZQ[S[VZXWYRYOXJVGSFQF",
    r"H\NJPISFS[", r"H\LKLJMHNGPFTFVGWHXJXLWNUQK[Y[", r"H\MFXFRNUNWOXPYSYUXXVZS[P[MZLYKW",
    r"H\UFKTZT UFU[", r"H\WFMFLOMNPMSMVNXPYSYUXXVZS[P[MZLYKW",
    r"H\XIWGTFRFOGMJLOLTMXOZR[S[VZXXYUYTXQVOSNRNOOMQLT", r"H\YFO[ KFYF",
    r"H\PFMGLILKMMONSOVPXRYTYWXYWZT[P[MZLYKWKTLRNPQOUNWMXKXIWGTFPF",
    r"H\XMWPURRSQSNRLPKMKLLINGQFRFUGWIXMXRWWUZR[P[MZLX", r"NVROQPRQSPRO RVQWRXSWRV",
    r"NVROQPRQSPRO SWRXQWRVSWSYQ[", r"F^ZIJRZ[", r"E_IO[O IU[U", r"F^JIZRJ[",
    r"I[LKLJMHNGPFTFVGWHXJXLWNVORQRT RYQZR[SZRY",
    r"E`WNVLTKQKOLNMMPMSNUPVSVUUVS QKOMNPNSOUPV WKVSVUXVZV\T]Q]O\L[JYHWGTFQFNGLHJJILHOHRIUJWLYNZQ[T[WZYYZX XKWSWUXV",
    r"I[RFJ[ RFZ[ MTWT", r"G\KFK[ KFTFWGXHYJYLXNWOTP KPTPWQXRYTYWXYWZT[K[",
    r"H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZV", r"G\KFK[ KFRFUGWIXKYNYSXVWXUZR[K[",
    r"H[LFL[ LFYF LPTP L[Y[", r"HZLFL[ LFYF LPTP", r"H]ZKYIWGUFQFOGMILKKNKSLVMXOZQ[U[WZYXZVZS USZS",
    r"G]KFK[ YFY[ KPYP", r"NVRFR[", r"JZVFVVUYTZR[P[NZMYLVLT", r"G\KFK[ YFKT POY[", r"HYLFL[ L[X[",
    r"F^JFJ[ JFR[ ZFR[ ZFZ[", r"G]KFK[ KFY[ YFY[", r"G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF",
    r"G\KFK[ KFTFWGXHYJYMXOWPTQKQ", r"G]PFNGLIKKJNJSKVLXNZP[T[VZXXYVZSZNYKXIVGTFPF SWY]",
    r"G\KFK[ KFTFWGXHYJYLXNWOTPKP RPY[", r"H\YIWGTFPFMGKIKKLMMNOOUQWRXSYUYXWZT[P[MZKX", r"JZRFR[ KFYF",
    r"G]KFKULXNZQ[S[VZXXYUYF", r"I[JFR[ ZFR[", r"F^HFM[ RFM[ RFW[ \FW[", r"H\KFY[ YFK[", r"I[JFRPR[ ZFRP",
    r"H\YFK[ KFYF K[Y[", r"KYOBOb PBPb OBVB ObVb", r"KYKFY^", r"KYTBTb UBUb NBUB NbUb", r"JZRDJR RDZR",
    r"I[Ib[b", r"NVSKQMQORPSORNQO", r"I\XMX[ XPVNTMQMONMPLSLUMXOZQ[T[VZXX",
    r"H[LFL[ LPNNPMSMUNWPXSXUWXUZS[P[NZLX", r"I[XPVNTMQMONMPLSLUMXOZQ[T[VZXX",
    r"I\XFX[ XPVNTMQMONMPLSLUMXOZQ[T[VZXX", r"I[LSXSXQWOVNTMQMONMPLSLUMXOZQ[T[VZXX", r"MYWFUFSGRJR[ OMVM",
    r"I\XMX]W`VaTbQbOa XPVNTMQMONMPLSLUMXOZQ[T[VZXX", r"I\MFM[ MQPNRMUMWNXQX[", r"NVQFRGSFREQF RMR[",
    r"MWRFSGTFSERF SMS^RaPbNb", r"IZMFM[ WMMW QSX[", r"NVRFR[", r"CaGMG[ GQJNLMOMQNRQR[ RQUNWMZM\N]Q][",
    r"I\MMM[ MQPNRMUMWNXQX[", r"I\QMONMPLSLUMXOZQ[T[VZXXYUYSXPVNTMQM",
    r"H[LMLb LPNNPMSMUNWPXSXUWXUZS[P[NZLX", r"I\XMXb XPVNTMQMONMPLSLUMXOZQ[T[VZXX", r"KXOMO[ OSPPRNTMWM",
    r"J[XPWNTMQMNNMPNRPSUTWUXWXXWZT[Q[NZMX", r"MYRFRWSZU[W[ OMVM", r"I\MMMWNZP[S[UZXW XMX[",
    r"JZLMR[ XMR[", r"G]JMN[ RMN[ RMV[ ZMV[", r"J[MMX[ XMM[", r"JZLMR[ XMR[P_NaLbKb", r"J[XMM[ MMXM M[X[",
    r"KYTBRCQDPFPHQJRKSMSOQQ RCQEQGRISJTLTNSPORSTTVTXSZR[Q]Q_Ra QSSUSWRYQZP\P^Q`RaTb", r"NVRBRb",
    r"KYPBRCSDTFTHSJRKQMQOSQ RCSESGRIQJPLPNQPURQTPVPXQZR[S]S_Ra SSQUQWRYSZT\T^S`RaPb",
    r"F^IUISJPLONOPPTSVTXTZS[Q ISJQLPNPPQTTVUXUZT[Q[O",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_has_a_width_and_whole_strokes() {
        for letter in ' '..='~' {
            let glyph = glyph(letter);
            assert!(advance(glyph) > 4.0, "{letter}");
            assert!(glyph[2..].split(' ').all(|stroke| stroke.len() % 2 == 0), "{letter}");
            assert_eq!(strokes(glyph).count() > 0, letter != ' ', "{letter}");
        }
        assert!(strokes(glyph('ü')).count() > 0);
    }

    #[test]
    fn a_text_stays_within_its_width_and_height() {
        let mut image = Image::filled(200, 60, [0; 4]);
        draw(&mut image, "Egy 7", [10.0, 10.0], 20.0, [9, 8, 7]);
        let places = (0..60).flat_map(|y| (0..200).map(move |x| (x, y)));
        let (xs, ys): (Vec<u32>, Vec<u32>) = places.filter(|(x, y)| image.pixel(*x, *y)[3] > 0).unzip();
        let right = 10.0 + width("Egy 7", 20.0);
        assert!(xs.iter().all(|x| *x >= 9 && (*x as f32) < right) && xs.len() > 300);
        assert!(ys.iter().all(|y| *y >= 8 && (*y as f32) < 10.0 + 20.0 * LINE + 1.0));
    }

    #[test]
    fn what_does_not_fit_is_shortened_or_wrapped() {
        assert_eq!(fitted("seed 7", 10.0, 100.0), "seed 7");
        let short = fitted("a very long name of a parameter", 10.0, 100.0);
        assert!(short.ends_with("...") && width(&short, 10.0) <= 100.0, "{short}");
        assert!(wrapped("one two three four five six", 10.0, 60.0).len() > 2);
        assert_eq!(wrapped("", 10.0, 60.0), [""]);
    }
}
