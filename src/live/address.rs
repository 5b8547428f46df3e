//! Who may ask: the address that only this machine's user knows, and the checks of every request.
//!
//! Any web page that the user visits can send requests to this machine's ports. So a request needs the token,
//! must have been sent to this machine by name (or another site could rebind its own name to it), and, where a
//! browser tells the origin, must come from a page of this server.

use std::fmt;

use crate::error::{Error, Result};

/// Bytes of a token.
const LENGTH: usize = 16;

/// A random name that is known to those whom the address was told.
#[derive(Clone, PartialEq, Eq)]
pub struct Token(String);

impl Token {
    /// A new one, of 128 random bits. Fails if the system has no random numbers.
    pub fn random() -> Result<Self> {
        let mut bytes = [0; LENGTH];
        getrandom::fill(&mut bytes)
            .map_err(|error| Error::new(format!("the system gives no random numbers: {error}")))?;
        Ok(Self(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
    }

    /// One that was made before: at least 32 digits from 0 to 9 and a to f.
    pub fn from_text(text: &str) -> Result<Self> {
        let hexadecimal = |digit: u8| digit.is_ascii_digit() || (b'a'..=b'f').contains(&digit);
        if !(LENGTH * 2..=LENGTH * 16).contains(&text.len()) || !text.bytes().all(hexadecimal) {
            return Err(Error::new("a token has 32 to 256 digits from 0 to 9 and a to f"));
        }
        Ok(Self(text.to_owned()))
    }

    /// The digits.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether `given` is it, in a time that does not tell how much of it is right.
    pub fn is(&self, given: &str) -> bool {
        let same = self.0.bytes().zip(given.bytes()).fold(0, |seen, (a, b)| seen | (a ^ b)) == 0;
        same && self.0.len() == given.len()
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token")
    }
}

/// Whether a request to `host` from a page of `origin` may be answered.
pub(super) fn admits(host: Option<&str>, origin: Option<&str>) -> bool {
    let Some(host) = host.filter(|host| is_this_machine(host)) else { return false };
    origin.is_none_or(|origin| {
        origin.strip_prefix("http://").is_some_and(|origin| origin.eq_ignore_ascii_case(host))
    })
}

/// Whether `host` is a name of this machine alone, with any port, since a tunnel may lead to it.
fn is_this_machine(host: &str) -> bool {
    let (name, port) = match host.strip_prefix('[').and_then(|rest| rest.split_once(']')) {
        Some((inner, rest)) => {
            (format!("[{inner}]"), rest.strip_prefix(':').or(rest.is_empty().then_some("0")))
        }
        None => match host.split_once(':') {
            Some((name, port)) => (name.to_owned(), Some(port)),
            None => (host.to_owned(), Some("0")),
        },
    };
    let number =
        port.is_some_and(|port| port.bytes().all(|it| it.is_ascii_digit()) && port.parse::<u16>().is_ok());
    number && ["127.0.0.1", "localhost", "[::1]"].iter().any(|known| name.eq_ignore_ascii_case(known))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_are_random_and_compared_whole() {
        let (one, two) = (Token::random().unwrap(), Token::random().unwrap());
        assert_ne!(one, two);
        assert_eq!(one.as_str().len(), 32);
        assert!(one.is(one.as_str()) && !one.is(two.as_str()));
        assert!(!one.is("") && !one.is(&one.as_str()[..31]) && !one.is(&format!("{}0", one.as_str())));
        assert!(Token::from_text(one.as_str()).is_ok());
        for wrong in ["", "abc", &"A".repeat(32), &"../".repeat(16), &"0".repeat(300)] {
            assert!(Token::from_text(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn only_names_of_this_machine_are_hosts() {
        for host in ["127.0.0.1:4747", "localhost", "LOCALHOST:1", "[::1]:65535", "[::1]"] {
            assert!(admits(Some(host), None), "{host}");
            assert!(admits(Some(host), Some(&format!("http://{host}"))), "{host}");
        }
        let foreign = [
            "example.org",
            "example.org:4747",
            "127.0.0.1.example.org",
            "localhost.example.org:4747",
            "0.0.0.0:4747",
            "127.0.0.1:99999",
            "127.0.0.1:",
            "127.0.0.1:4747:1",
            "[::1",
            "[::1]x",
            "::1",
            "",
            " localhost",
            "localhost:+1",
            "user@localhost",
        ];
        for host in foreign {
            assert!(!admits(Some(host), None), "{host}");
        }
        assert!(!admits(None, None));
    }

    #[test]
    fn a_page_of_another_origin_is_refused() {
        let host = Some("127.0.0.1:4747");
        for origin in
            ["http://localhost:4747", "http://127.0.0.1:80", "https://127.0.0.1:4747", "null", "", "file://"]
        {
            assert!(!admits(host, Some(origin)), "{origin}");
        }
    }
}
