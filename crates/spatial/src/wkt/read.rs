//! Reader of well-known text.
//!
//! The reader is implemented here because it must be bounded: deeply nested texts overflow the stacks of
//! other readers.

use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use glam::DVec3;
use std::borrow::Cow;

use crate::geometry::opened;
use crate::wkb::{NEAR, add_arc};
use crate::{DEEPEST, FARTHEST, Geometry};

impl Geometry {
    /// Reads a geometry from well-known text.
    ///
    /// Z, M or both are supported; M is skipped, and so is a leading `SRID=...;`. Curves become lines within
    /// a centimetre of them if the unit is a metre.
    ///
    /// Fails with the location in the text and the expected content.
    ///
    /// Source: OGC 06-103r4, Simple Feature Access, clause 7; ISO/IEC 13249-3 for curves.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let lawn = Geometry::from_wkt("SRID=3763;POLYGON((0 0, 10 0, 10 6, 0 6, 0 0))")?;
    /// assert_eq!(lawn.area(), 60.0);
    /// assert!(Geometry::from_wkt("MULTIPOINT EMPTY")?.is_empty());
    /// let error = Geometry::from_wkt("POINT (1)").expect_err("no point");
    /// assert_eq!(error.message(), "invalid well-known text: expected a number at character 9, found \")\"");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn from_wkt(text: &str) -> Result<Self> {
        Self::from_wkt_within(text, &Budget::default())
    }

    /// Reads a geometry from well-known text, if it does not exceed the budget.
    pub fn from_wkt_within(text: &str, budget: &Budget) -> Result<Self> {
        let mut reader = WktReader { text, at: 0, budget };
        reader.skip_reference();
        let geometry = reader.geometry(0)?;
        if reader.peek().is_some() {
            return Err(reader.expected("the end"));
        }
        // An arc may extend beyond its defining points.
        geometry.check()?;
        Ok(geometry)
    }
}

/// Additional ordinates of the points of a geometry, as far as its name defines them.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ordinates {
    Any,
    Z,
    M,
    Zm,
}

struct WktReader<'a> {
    text: &'a str,
    at: usize,
    budget: &'a Budget,
}

impl WktReader<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    /// Returns the next character that is not white space.
    fn peek(&mut self) -> Option<char> {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
        self.rest().chars().next()
    }

    fn take(&mut self, letter: char) -> bool {
        let there = self.peek() == Some(letter);
        self.at += if there { letter.len_utf8() } else { 0 };
        there
    }

    /// Reads the next word, in capitals; empty if no word follows.
    fn word(&mut self) -> String {
        self.peek();
        let length = self.rest().bytes().take_while(u8::is_ascii_alphabetic).count();
        let word = self.rest()[..length].to_ascii_uppercase();
        self.at += length;
        word
    }

    fn skip_reference(&mut self) {
        self.peek();
        let head = self.rest().get(..5).unwrap_or_default();
        if head.eq_ignore_ascii_case("SRID=")
            && let Some(end) = self.rest().find(';')
            && self.rest()[5..end].trim().parse::<i64>().is_ok()
        {
            self.at += end + 1;
        }
    }

    fn expected(&mut self, what: &str) -> Error {
        let there = match self.peek() {
            None => Cow::Borrowed("its end"),
            Some(_) => {
                let end = self.rest().find([' ', ',', '(', ')']).unwrap_or(self.rest().len()).max(1);
                let word: String = self.rest().chars().take(end.min(20)).collect();
                format!("\"{}\"", shown(&word)).into()
            }
        };
        let letter = self.text[..self.at].chars().count() + 1;
        Error::argument(format!(
            "invalid well-known text: expected {what} at character {letter}, found {there}"
        ))
        .help("write POINT (1 2), LINESTRING (0 0, 5 0) or POLYGON ((0 0, 4 0, 4 3, 0 0))")
    }

    /// Opens a list; returns false if it is empty.
    fn open(&mut self) -> Result<bool> {
        if self.take('(') {
            return Ok(true);
        }
        let from = self.at;
        if self.word() == "EMPTY" {
            return Ok(false);
        }
        self.at = from;
        Err(self.expected("\"(\" or EMPTY"))
    }

    /// Reads the items of a list up to its end.
    fn list<T>(&mut self, mut item: impl FnMut(&mut Self) -> Result<T>) -> Result<Vec<T>> {
        let mut items = Vec::new();
        if !self.open()? {
            return Ok(items);
        }
        loop {
            self.budget.tick()?;
            items.push(item(self)?);
            if self.take(')') {
                return Ok(items);
            }
            if !self.take(',') {
                return Err(self.expected("\",\" or \")\""));
            }
        }
    }

    fn number(&mut self) -> Result<f64> {
        self.peek();
        let length = self
            .rest()
            .bytes()
            .take_while(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'+' | b'-' | b'.'))
            .count();
        match self.rest()[..length].parse::<f64>() {
            Ok(number) if number.abs() <= FARTHEST => {
                self.at += length;
                Ok(number)
            }
            Ok(_) => Err(self.expected("a finite number of at most 1e9")),
            Err(_) => Err(self.expected("a number")),
        }
    }

    fn point(&mut self, ordinates: Ordinates) -> Result<DVec3> {
        let (x, y) = (self.number()?, self.number()?);
        let mut others = [None; 2];
        for other in &mut others {
            if !matches!(self.peek(), None | Some(',' | ')' | '(')) {
                *other = Some(self.number()?);
            }
        }
        let needed = match ordinates {
            Ordinates::Any => others.iter().flatten().count(),
            Ordinates::Z | Ordinates::M => 1,
            Ordinates::Zm => 2,
        };
        if others.iter().flatten().count() != needed {
            return Err(self.expected(&format!("a point of {} numbers", needed + 2)));
        }
        let z = if ordinates == Ordinates::M { None } else { others[0] };
        Ok(DVec3::new(x, y, z.unwrap_or(0.0)))
    }

    fn points(&mut self, ordinates: Ordinates) -> Result<Vec<DVec3>> {
        self.list(|reader| reader.point(ordinates))
    }

    /// Reads the points of a line: none or at least two.
    fn line(&mut self, ordinates: Ordinates) -> Result<Vec<DVec3>> {
        let points = self.points(ordinates)?;
        if points.len() == 1 {
            Err(self.expected("a second point in the line before this"))
        } else {
            Ok(points)
        }
    }

    fn rings(&mut self, ordinates: Ordinates) -> Result<Vec<Vec<DVec3>>> {
        self.list(|reader| reader.points(ordinates))
    }

    /// Creates a polygon from rings that may repeat their first point.
    fn polygon(&mut self, rings: Vec<Vec<DVec3>>) -> Result<burgeon_geometry::Rings> {
        if rings.iter().all(Vec::is_empty) {
            return Ok(burgeon_geometry::Rings::default());
        }
        opened(rings.into()).ok_or_else(|| self.expected("a third point in the ring before this"))
    }

    /// Reads a name and its ordinates.
    fn head(&mut self) -> Result<(String, Ordinates)> {
        let from = self.at;
        let mut name = self.word();
        // The suffix may follow without a space, as in POINTZ.
        for (end, ordinates) in [("ZM", Ordinates::Zm), ("Z", Ordinates::Z), ("M", Ordinates::M)] {
            if let Some(short) = name.strip_suffix(end)
                && is_known(short)
            {
                name.truncate(short.len());
                return Ok((name, ordinates));
            }
        }
        if !is_known(&name) {
            self.at = from;
            return Err(self.expected("a geometry type"));
        }
        let from = self.at;
        let ordinates = match self.word().as_str() {
            "Z" => Ordinates::Z,
            "M" => Ordinates::M,
            "ZM" => Ordinates::Zm,
            _ => {
                self.at = from;
                Ordinates::Any
            }
        };
        Ok((name, ordinates))
    }

    fn geometry(&mut self, depth: usize) -> Result<Geometry> {
        if depth > DEEPEST {
            return Err(Error::argument(format!("invalid well-known text: nested more than {DEEPEST} deep"))
                .help("flatten the collections"));
        }
        let (name, ordinates) = self.head()?;
        Ok(match name.as_str() {
            "POINT" => {
                let open = self.open()?;
                let point = open.then(|| self.point(ordinates)).transpose()?;
                if open && !self.take(')') {
                    return Err(self.expected("\")\""));
                }
                Geometry::Point(point)
            }
            "LINESTRING" | "LINEARRING" => Geometry::Line(self.line(ordinates)?),
            "CIRCULARSTRING" | "COMPOUNDCURVE" => Geometry::Line(self.curve_of(&name, ordinates)?),
            "POLYGON" | "TRIANGLE" => {
                let rings = self.rings(ordinates)?;
                Geometry::Polygon(self.polygon(rings)?)
            }
            "CURVEPOLYGON" => {
                let rings = self.list(|reader| reader.curve(ordinates))?;
                Geometry::Polygon(self.polygon(rings)?)
            }
            "MULTIPOINT" => {
                let points = self.list(|reader| match reader.peek() {
                    Some('(' | 'E' | 'e') => reader.points(ordinates),
                    _ => Ok(vec![reader.point(ordinates)?]),
                })?;
                Geometry::MultiPoint(points.concat())
            }
            "MULTILINESTRING" => lines(self.list(|reader| reader.line(ordinates))?),
            "MULTICURVE" => lines(self.list(|reader| reader.curve(ordinates))?),
            "MULTIPOLYGON" | "POLYHEDRALSURFACE" | "TIN" => polygons(self.list(|reader| {
                let rings = reader.rings(ordinates)?;
                reader.polygon(rings)
            })?),
            "MULTISURFACE" => polygons(self.list(|reader| {
                if matches!(reader.peek(), Some('(')) {
                    let rings = reader.rings(ordinates)?;
                    return reader.polygon(rings);
                }
                match reader.geometry(depth + 1)? {
                    Geometry::Polygon(rings) => Ok(rings),
                    _ => Err(reader.expected("a polygon before this")),
                }
            })?),
            _ => Geometry::Collection(self.list(|reader| reader.geometry(depth + 1))?),
        })
    }

    /// Reads a member of a compound curve, a curve polygon or a multi-curve: a line without its name, or a
    /// named curve.
    fn curve(&mut self, ordinates: Ordinates) -> Result<Vec<DVec3>> {
        let from = self.at;
        if matches!(self.peek(), Some('(')) {
            return self.line(ordinates);
        }
        if self.word() == "EMPTY" {
            return Ok(Vec::new());
        }
        self.at = from;
        let (name, own) = self.head()?;
        let ordinates = if own == Ordinates::Any { ordinates } else { own };
        match name.as_str() {
            "LINESTRING" => self.line(ordinates),
            "CIRCULARSTRING" | "COMPOUNDCURVE" => self.curve_of(&name, ordinates),
            _ => {
                self.at = from;
                Err(self.expected("a curve"))
            }
        }
    }

    /// Reads the points of a curve after its name.
    fn curve_of(&mut self, name: &str, ordinates: Ordinates) -> Result<Vec<DVec3>> {
        if name == "CIRCULARSTRING" {
            let given = self.points(ordinates)?;
            if given.is_empty() {
                return Ok(given);
            }
            if given.len() < 3 || given.len().is_multiple_of(2) {
                return Err(self.expected("3, 5, 7 or more points in the circular string before this"));
            }
            let mut points = vec![given[0]];
            for from in (0..given.len() - 2).step_by(2) {
                let arc = [given[from], given[from + 1], given[from + 2]];
                add_arc(&mut points, arc, NEAR, |count| self.budget.take(count * 24))?;
                self.budget.tick()?;
            }
            return Ok(points);
        }
        let mut points: Vec<DVec3> = Vec::new();
        let parts = self.list(|reader| {
            let from = reader.at;
            if reader.peek() != Some('(') && reader.word() == "COMPOUNDCURVE" {
                reader.at = from;
                return Err(reader.expected("a line or a circular string"));
            }
            reader.at = from;
            reader.curve(ordinates)
        })?;
        for part in parts {
            // Each part begins at the end of the previous one.
            let same = points.last().is_some_and(|last| part.first() == Some(last));
            points.extend(part.into_iter().skip(usize::from(same)));
        }
        Ok(points)
    }
}

/// Returns the lines that are not empty.
fn lines(mut lines: Vec<Vec<DVec3>>) -> Geometry {
    lines.retain(|line| !line.is_empty());
    Geometry::MultiLine(lines)
}

/// Returns the polygons that are not empty.
fn polygons(mut polygons: Vec<burgeon_geometry::Rings>) -> Geometry {
    polygons.retain(|rings| !rings.is_empty());
    Geometry::MultiPolygon(polygons)
}

fn is_known(name: &str) -> bool {
    matches!(
        name,
        "POINT"
            | "LINESTRING"
            | "LINEARRING"
            | "POLYGON"
            | "TRIANGLE"
            | "MULTIPOINT"
            | "MULTILINESTRING"
            | "MULTIPOLYGON"
            | "POLYHEDRALSURFACE"
            | "TIN"
            | "GEOMETRYCOLLECTION"
            | "CIRCULARSTRING"
            | "COMPOUNDCURVE"
            | "CURVEPOLYGON"
            | "MULTICURVE"
            | "MULTISURFACE"
    )
}
