//! Palette of a frame.
//!
//! Method: Wu, "Color quantization by dynamic programming and principal analysis", 1992, in its greedy form: the box of
//! colours with the largest error is divided where the errors of its two parts are least. Each colour then takes the
//! nearest of the means, and the means are computed once more.

/// Number of bits of a channel that distinguish colours.
const BITS: u32 = 6;
/// Number of bins of colours.
const BINS: usize = 1 << (3 * BITS);

/// Palette of at most 256 colours, with the index for each colour that it was made from.
pub(super) struct FramePalette {
    /// Colours: red, green and blue.
    pub(super) colors: Vec<[u8; 3]>,
    /// Index into `colors` by bin.
    indices: Vec<u8>,
}

/// Colours that differ only in their lowest bits.
#[derive(Clone, Copy)]
struct ColorBin {
    bin: usize,
    count: f64,
    /// Sums of the channels.
    sums: [f64; 3],
}

/// Number, sums and sum of squares of the colours of a box.
#[derive(Clone, Copy, Default)]
struct ColorSums {
    count: f64,
    sums: [f64; 3],
}

/// Range of bins, and the best division of it.
struct ColorBox {
    begin: usize,
    end: usize,
    /// Reduction of the error by the division, its channel, and the number of bins before it.
    division: Option<(f64, usize, usize)>,
}

impl ColorBin {
    fn mean(&self, channel: usize) -> f64 {
        self.sums[channel] / self.count
    }
}

impl ColorSums {
    fn add(&mut self, bin: &ColorBin) {
        self.count += bin.count;
        (0..3).for_each(|channel| self.sums[channel] += bin.sums[channel]);
    }

    /// Returns the part of the sum of squares that the mean explains.
    fn explained(&self) -> f64 {
        if self.count > 0.0 { self.sums.iter().map(|sum| sum * sum).sum::<f64>() / self.count } else { 0.0 }
    }

    fn without(&self, part: &Self) -> Self {
        let sums = std::array::from_fn(|channel| self.sums[channel] - part.sums[channel]);
        Self { count: self.count - part.count, sums }
    }

    fn color(&self) -> [u8; 3] {
        self.sums.map(|sum| (sum / self.count.max(1.0)).round().clamp(0.0, 255.0) as u8)
    }
}

impl FramePalette {
    /// Creates a palette of at most `most` colours, from 1 to 256, for pixels of these `colors`.
    pub(super) fn of(colors: impl Iterator<Item = [u8; 3]>, most: usize) -> Self {
        let mut bins = collect_bins(colors);
        let mut boxes = vec![ColorBox::new(&mut bins, 0, usize::MAX)];
        while boxes.len() < most {
            let best = boxes.iter().enumerate().filter_map(|(number, it)| Some((it.division?, number)));
            let best = best.max_by(|(a, first), (b, second)| a.0.total_cmp(&b.0).then(second.cmp(first)));
            let Some(((_, channel, before), number)) = best else { break };
            let ColorBox { begin, end, .. } = boxes[number];
            sort(&mut bins[begin..end], channel);
            boxes[number] = ColorBox::new(&mut bins, begin, begin + before);
            boxes.push(ColorBox::new(&mut bins, begin + before, end));
        }
        let mean = |it: &ColorBox| {
            let mut sums = ColorSums::default();
            bins[it.begin..it.end].iter().for_each(|bin| sums.add(bin));
            sums.color()
        };
        let mut colors: Vec<[u8; 3]> = boxes.iter().filter(|it| it.begin < it.end).map(mean).collect();
        let mut sums = vec![ColorSums::default(); colors.len()];
        bins.iter().for_each(|bin| sums[nearest(&colors, bin)].add(bin));
        for (color, sums) in colors.iter_mut().zip(&sums).filter(|(_, sums)| sums.count > 0.0) {
            *color = sums.color();
        }
        let mut indices = vec![0; BINS];
        bins.iter().for_each(|bin| indices[bin.bin] = nearest(&colors, bin) as u8);
        Self { colors, indices }
    }

    /// Returns the index of the palette's colour for `color`.
    pub(super) fn index(&self, color: [u8; 3]) -> u8 {
        self.indices[bin_of(color)]
    }
}

impl ColorBox {
    /// Creates the box of the bins from `begin` to `end`, at most all, whose order changes.
    fn new(bins: &mut [ColorBin], begin: usize, end: usize) -> Self {
        let end = end.min(bins.len());
        let inner = &mut bins[begin..end];
        let mut all = ColorSums::default();
        inner.iter().for_each(|bin| all.add(bin));
        let mut division: Option<(f64, usize, usize)> = None;
        for channel in 0..3 {
            sort(inner, channel);
            let mut part = ColorSums::default();
            for (number, pair) in inner.windows(2).enumerate() {
                part.add(&pair[0]);
                let gain = part.explained() + all.without(&part).explained() - all.explained();
                if gain > division.map_or(1e-6, |(gain, ..)| gain) {
                    division = Some((gain, channel, number + 1));
                }
            }
        }
        Self { begin, end, division }
    }
}

/// Sorts bins by a channel; the order does not depend on the previous one.
fn sort(bins: &mut [ColorBin], channel: usize) {
    bins.sort_unstable_by(|a, b| a.mean(channel).total_cmp(&b.mean(channel)).then(a.bin.cmp(&b.bin)));
}

/// Returns the index of the colour that is nearest to the mean of `bin`; the first of several.
fn nearest(colors: &[[u8; 3]], bin: &ColorBin) -> usize {
    let mean: [f32; 3] = std::array::from_fn(|channel| bin.mean(channel) as f32);
    let mut best = (f32::INFINITY, 0);
    for (index, color) in colors.iter().enumerate() {
        let [red, green, blue]: [f32; 3] =
            std::array::from_fn(|channel| f32::from(color[channel]) - mean[channel]);
        let distance = red * red + green * green + blue * blue;
        if distance < best.0 {
            best = (distance, index);
        }
    }
    best.1
}

fn bin_of(color: [u8; 3]) -> usize {
    color.iter().fold(0, |bin, channel| bin << BITS | usize::from(channel >> (8 - BITS)))
}

/// Returns the bins that contain a colour, in order.
fn collect_bins(colors: impl Iterator<Item = [u8; 3]>) -> Vec<ColorBin> {
    let mut sums = vec![[0_u32; 4]; BINS];
    for color in colors {
        let [count, red, green, blue] = &mut sums[bin_of(color)];
        *count += 1;
        *red += u32::from(color[0] & 3);
        *green += u32::from(color[1] & 3);
        *blue += u32::from(color[2] & 3);
    }
    let mut bins = Vec::new();
    for (bin, [count, rest @ ..]) in sums.into_iter().enumerate().filter(|(_, sums)| sums[0] > 0) {
        let high = [bin >> (2 * BITS), bin >> BITS, bin].map(|high| (high & ((1 << BITS) - 1)) << (8 - BITS));
        let count = f64::from(count);
        let sums = std::array::from_fn(|channel| high[channel] as f64 * count + f64::from(rest[channel]));
        bins.push(ColorBin { bin, count, sums });
    }
    bins
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_exactly() {
        let colors: Vec<[u8; 3]> = (0..200_u8).map(|i| [i, 255 - i, (i % 8) * 30]).collect();
        let few: Vec<[u8; 3]> = colors.iter().step_by(5).copied().collect();
        let palette = FramePalette::of(few.iter().copied(), 255);
        for color in few {
            assert_eq!(palette.colors[usize::from(palette.index(color))], color);
        }
        assert!(FramePalette::of(std::iter::empty(), 255).colors.is_empty());
    }

    #[test]
    fn many_colours_are_approximated_and_the_result_does_not_depend_on_their_order() {
        let colors: Vec<[u8; 3]> =
            (0..64 * 64_u32).map(|i| [(i % 64 * 4) as u8, (i / 64 * 4) as u8, (i % 7) as u8 * 9]).collect();
        let palette = FramePalette::of(colors.iter().copied(), 255);
        assert_eq!(palette.colors.len(), 255);
        let squares: f64 = colors
            .iter()
            .map(|color| {
                let found = palette.colors[usize::from(palette.index(*color))];
                (0..3).map(|channel| f64::from(color[channel].abs_diff(found[channel])).powi(2)).sum::<f64>()
            })
            .sum();
        let error = (squares / colors.len() as f64).sqrt();
        assert!(error < 20.0, "{error}");
        let turned = FramePalette::of(colors.iter().rev().copied(), 255);
        assert_eq!(palette.colors, turned.colors);
        assert_eq!(FramePalette::of(colors.iter().copied(), 1).colors.len(), 1);
    }
}
