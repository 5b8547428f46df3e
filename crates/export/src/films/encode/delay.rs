//! Times for which formats show a frame.

use crate::film_settings::FilmSettings;

/// Returns the time (1/100 s) for which frame `number` is shown. Rounding errors do not add up over the film.
pub(super) fn centiseconds(settings: &FilmSettings, number: u32) -> u16 {
    let begin = |number: u32| (settings.time_of(number) * 100.0).round();
    (begin(number + 1) - begin(number)).clamp(1.0, f64::from(u16::MAX)) as u16
}

/// Returns the time (s) for which a frame is shown, as a fraction.
pub(super) fn fraction(settings: &FilmSettings) -> (u16, u16) {
    let shown = |scale: f64| (scale, (scale * settings.fps).round());
    let fits = |(_, below): &(f64, f64)| *below <= f64::from(u16::MAX);
    let (above, below) = [1000.0, 100.0, 10.0, 1.0].map(shown).into_iter().find(fits).unwrap_or((1.0, 1.0));
    let divisor = greatest_common_divisor(above as u16, below.max(1.0) as u16);
    (above as u16 / divisor, below.max(1.0) as u16 / divisor)
}

fn greatest_common_divisor(a: u16, b: u16) -> u16 {
    if b == 0 { a.max(1) } else { greatest_common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film(fps: f64) -> FilmSettings {
        FilmSettings { frames: 90, fps, size: (8, 8), transparent: false }
    }

    #[test]
    fn delays_in_centiseconds_add_up_to_the_length_of_the_film() {
        for fps in [1.0, 12.5, 24.0, 25.0, 30.0, 50.0] {
            let sum: u32 = (0..90).map(|number| u32::from(centiseconds(&film(fps), number))).sum();
            assert!((f64::from(sum) / 100.0 - 90.0 / fps).abs() < 0.01, "{sum} at {fps}");
        }
        assert_eq!((0..3).map(|number| centiseconds(&film(30.0), number)).collect::<Vec<_>>(), [3, 4, 3]);
    }

    #[test]
    fn delays_as_fractions_are_exact() {
        assert_eq!(fraction(&film(25.0)), (1, 25));
        assert_eq!(fraction(&film(12.5)), (2, 25));
        assert_eq!(fraction(&film(0.1)), (10, 1));
        assert_eq!(fraction(&film(100.0)), (1, 100));
    }
}
