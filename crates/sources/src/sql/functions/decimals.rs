//! Decimal notation of numbers: formatted as PostgreSQL and PostGIS do, and rounded half away from zero.

/// The digits of a number, without trailing zeros, and the power of ten of the first digit.
struct Digits {
    negative: bool,
    digits: Vec<u8>,
    exponent: i32,
}

impl Digits {
    /// Returns the fewest digits that identify a finite number.
    fn shortest(number: f64) -> Self {
        let text = format!("{:e}", number.abs());
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let digits: Vec<u8> = mantissa.bytes().filter(u8::is_ascii_digit).map(|digit| digit - b'0').collect();
        Self { negative: number.is_sign_negative(), digits, exponent: exponent.parse().unwrap_or(0) }
    }

    /// Rounds to `decimals` digits after the point, which may be negative; halves are rounded away from zero.
    fn round(&mut self, decimals: i32) {
        let count = i64::from(self.exponent) + 1 + i64::from(decimals);
        let Ok(count) = usize::try_from(count) else {
            self.digits = vec![0];
            self.exponent = 0;
            return;
        };
        if count >= self.digits.len() {
            return;
        }
        let up = self.digits[count] >= 5;
        self.digits.truncate(count);
        if up {
            let mut at = count;
            loop {
                if at == 0 {
                    self.digits.insert(0, 1);
                    self.exponent += 1;
                    break;
                }
                at -= 1;
                if self.digits[at] < 9 {
                    self.digits[at] += 1;
                    break;
                }
                self.digits[at] = 0;
            }
        }
        while self.digits.len() > 1 && self.digits.last() == Some(&0) {
            self.digits.pop();
        }
        if self.digits.iter().all(|digit| *digit == 0) {
            self.digits = vec![0];
            self.exponent = 0;
        }
    }

    fn is_zero(&self) -> bool {
        self.digits.iter().all(|digit| *digit == 0)
    }

    /// Writes the number without an exponent.
    fn plain(&self) -> String {
        let mut text = String::new();
        let digit = |index: i32| {
            let digit = usize::try_from(index).ok().and_then(|index| self.digits.get(index));
            char::from(b'0' + digit.copied().unwrap_or(0))
        };
        if self.exponent < 0 {
            text.push('0');
        }
        for index in 0..=self.exponent {
            text.push(digit(index));
        }
        let last = i32::try_from(self.digits.len()).unwrap_or(0) - 1;
        if last > self.exponent {
            text.push('.');
            for index in (self.exponent + 1)..=last {
                text.push(digit(index));
            }
        }
        text
    }

    /// Writes the number with an exponent of at least `width` digits.
    fn scientific(&self, width: usize) -> String {
        let mut text = String::new();
        for (index, digit) in self.digits.iter().enumerate() {
            if index == 1 {
                text.push('.');
            }
            text.push(char::from(b'0' + digit));
        }
        let sign = if self.exponent < 0 { '-' } else { '+' };
        format!("{text}e{sign}{:0width$}", self.exponent.abs())
    }
}

/// Formats a number like a `double precision` of PostgreSQL.
pub(super) fn float_text(number: f64) -> String {
    if number.is_nan() {
        return "NaN".into();
    }
    if number.is_infinite() {
        return if number > 0.0 { "Infinity" } else { "-Infinity" }.into();
    }
    let digits = Digits::shortest(number);
    let text = match digits.exponent {
        _ if digits.is_zero() => "0".into(),
        -4..15 => digits.plain(),
        _ => digits.scientific(2),
    };
    if digits.negative { format!("-{text}") } else { text }
}

/// Formats a coordinate like PostGIS, with at most `decimals` digits after the point.
pub(super) fn coordinate_text(number: f64, decimals: i32) -> String {
    let mut digits = Digits::shortest(number);
    let large = number.abs() <= 1e-8 || number.abs() >= 1e15;
    if digits.is_zero() {
        return "0".into();
    }
    let text = if large {
        // In this notation, `decimals` applies to the mantissa.
        let exponent = std::mem::take(&mut digits.exponent);
        digits.round(decimals);
        digits.exponent += exponent;
        digits.scientific(1)
    } else {
        digits.round(decimals);
        digits.plain()
    };
    if digits.negative && !digits.is_zero() { format!("-{text}") } else { text }
}

/// Rounds a number to `decimals` digits after the point like a `numeric`: halves are rounded away from zero.
pub(super) fn round_decimal(number: f64, decimals: i32) -> f64 {
    if !number.is_finite() {
        return number;
    }
    let mut digits = Digits::shortest(number);
    digits.round(decimals.clamp(-400, 400));
    let rounded = digits.scientific(1).parse().unwrap_or(number);
    if digits.negative && rounded != 0.0 { -rounded } else { rounded }
}

/// Converts a `double precision` to `numeric`, which keeps 15 digits.
pub(super) fn as_numeric(number: f64) -> f64 {
    if number.is_finite() { format!("{number:.14e}").parse().unwrap_or(number) } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_postgresql_and_postgis_write_them() {
        let floats = [
            (1.0, "1"),
            (-0.0, "-0"),
            (1e20, "1e+20"),
            (1e15, "1e+15"),
            (1e14, "100000000000000"),
            (123_456_789_012_345_678.0, "1.2345678901234568e+17"),
            (0.1, "0.1"),
            (1e-5, "1e-05"),
            (1e-4, "0.0001"),
            (-2.5e-7, "-2.5e-07"),
        ];
        for (number, text) in floats {
            assert_eq!(float_text(number), text);
        }
        let coordinates = [
            (1.0, 15, "1"),
            (-0.0, 15, "0"),
            (1.0 / 3.0, 15, "0.333333333333333"),
            (2.0 / 3.0, 15, "0.666666666666667"),
            (1.0 / 3.0, 3, "0.333"),
            (-1e-5, 3, "0"),
            (1e-9, 15, "1e-9"),
            (1e15, 15, "1e+15"),
            (1.5e-8, 15, "0.000000015"),
            (1.234_567_890_123_45e-7, 15, "0.000000123456789"),
            (6_672_000.123_456_789, 15, "6672000.123456789"),
            (99.999, 2, "100"),
            (-7.5, 0, "-8"),
        ];
        for (number, decimals, text) in coordinates {
            assert_eq!(coordinate_text(number, decimals), text);
        }
        for (number, decimals, rounded) in
            [(2.675, 2, 2.68), (-2.5, 0, -3.0), (1234.5, -2, 1200.0), (0.4, 0, 0.0), (999.9, 0, 1000.0)]
        {
            assert_eq!(round_decimal(number, decimals).to_bits(), f64::to_bits(rounded));
        }
    }
}
