//! Secret part of the address. It is random, or stored so that an open page finds the next server on its port.
//!
//! A page that searches for its server reveals the token only after the listener has proved that it knows the token
//! ([`Token::proof`]): while the server is not running, another user's program may have taken its port.

use std::fmt;
use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use hmac::{Hmac, Mac};
use sha2::Sha256;

use burgeon_base::error::{Error, Result};

/// Number of random bytes of a token.
const LENGTH: usize = 16;

/// Allowed number of digits of a token.
const DIGITS: std::ops::RangeInclusive<usize> = LENGTH * 2..=LENGTH * 16;

/// Time for which a token is stored after its server has started or stopped.
const KEPT: Duration = Duration::from_secs(24 * 60 * 60);

/// Random secret that is known only to recipients of the address.
///
/// ```
/// use burgeon_live::Token;
///
/// let token = Token::random()?;
/// assert!(token.is(token.as_str()) && !token.is("") && token.as_str().len() == 32);
/// assert_eq!(Token::from_text(&"0f".repeat(16))?.as_str(), "0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f");
/// assert!(Token::from_text("secret").is_err());
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Token(String);

impl Token {
    /// Creates a token of 128 random bits. Fails if the system does not provide random numbers.
    pub fn random() -> Result<Self> {
        let mut bytes = [0; LENGTH];
        getrandom::fill(&mut bytes).map_err(|error| {
            Error::system(format!("the operating system provides no random numbers: {error}"))
        })?;
        Ok(Self(hexadecimal(&bytes)))
    }

    /// Parses an existing token: 32 to 256 digits from 0 to 9 and a to f.
    pub fn from_text(text: &str) -> Result<Self> {
        if !DIGITS.contains(&text.len()) || !is_hexadecimal(text) {
            return Err(Error::usage("a token has 32 to 256 digits from 0 to 9 and a to f"));
        }
        Ok(Self(text.to_owned()))
    }

    /// Returns the digits.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Compares `given` with the token in constant time.
    pub fn is(&self, given: &str) -> bool {
        let same = self.0.bytes().zip(given.bytes()).fold(0, |seen, (a, b)| seen | (a ^ b)) == 0;
        same && self.0.len() == given.len()
    }

    /// Returns a proof of knowledge of the token: the HMAC-SHA-256 of `question` with the token as key, as hexadecimal
    /// digits. Returns `None` unless the question has 32 to 128 hexadecimal digits.
    ///
    /// Method: Krawczyk, Bellare and Canetti, "HMAC: Keyed-Hashing for Message Authentication", RFC 2104, 1997.
    pub(super) fn proof(&self, question: &str) -> Option<String> {
        if !(32..=128).contains(&question.len()) || !is_hexadecimal(question) {
            return None;
        }
        let mut mac = Hmac::<Sha256>::new_from_slice(self.0.as_bytes()).ok()?;
        mac.update(b"burgeon live ");
        mac.update(question.as_bytes());
        Some(hexadecimal(&mac.finalize().into_bytes()))
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token")
    }
}

fn is_hexadecimal(text: &str) -> bool {
    text.bytes().all(|digit| digit.is_ascii_digit() || (b'a'..=b'f').contains(&digit))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// File that stores the token of a port, in a private folder.
#[derive(Debug)]
pub(super) struct Keep(PathBuf);

impl Keep {
    /// Returns the store of `port`, in the folder of this user's session. Returns `None` if there is no such folder.
    pub(super) fn of(port: u16) -> Option<Self> {
        let name = format!("live-{port}.token");
        folders().find_map(|folder| private(&folder).then(|| Self(folder.join(&name))))
    }

    /// Returns the stored token, or creates and stores a new one. Fails if the system does not provide random numbers.
    pub(super) fn token(&self) -> Result<Token> {
        let token = self.read().map_or_else(Token::random, Ok)?;
        self.write(&token);
        Ok(token)
    }

    /// Extends the storage time if the token is still the stored one.
    pub(super) fn renew(&self, token: &Token) {
        if self.read().is_some_and(|kept| kept == *token) {
            self.write(token);
        }
    }

    fn read(&self) -> Option<Token> {
        let metadata = fs::symlink_metadata(&self.0).ok()?;
        let age = metadata.modified().ok()?.elapsed().unwrap_or(Duration::ZERO);
        if !metadata.is_file() || !is_private(&metadata) || age > KEPT {
            return None;
        }
        let mut text = String::new();
        fs::File::open(&self.0).ok()?.take(*DIGITS.end() as u64 + 2).read_to_string(&mut text).ok()?;
        Token::from_text(text.trim_end()).ok()
    }

    /// Writes the token. An error is ignored: without a stored token, pages only learn that the address has changed.
    fn write(&self, token: &Token) {
        let Some(folder) = self.0.parent() else { return };
        let made = tempfile::Builder::new().prefix(".token").tempfile_in(folder);
        let Ok(mut file) = made else { return };
        if writeln!(file, "{}", token.as_str()).is_ok() {
            let _ = file.persist(&self.0);
        }
    }
}

/// Lists folders that belong to this user only, the folder with the lifetime of the session first.
fn folders() -> impl Iterator<Item = PathBuf> {
    let set = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let home = || set("HOME").map(|home| home.join(".local/state"));
    let lasting = if cfg!(windows) { set("LOCALAPPDATA") } else { set("XDG_STATE_HOME").or_else(home) };
    set("XDG_RUNTIME_DIR").into_iter().chain(lasting).map(|folder| folder.join("burgeon"))
}

/// Creates `folder` if it does not exist. Returns true if only this user has access to it.
fn private(folder: &Path) -> bool {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    if builder.create(folder).is_err() {
        return false;
    }
    let Ok(metadata) = fs::symlink_metadata(folder) else { return false };
    // A user that can write to a folder with access for its owner only is the owner.
    metadata.is_dir() && is_private(&metadata) && tempfile::tempfile_in(folder).is_ok()
}

#[cfg(unix)]
fn is_private(metadata: &fs::Metadata) -> bool {
    use std::os::unix::fs::PermissionsExt;
    metadata.permissions().mode() & 0o077 == 0
}

/// Returns true: on other systems, a user's own folders are private by default.
#[cfg(not(unix))]
fn is_private(_: &fs::Metadata) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use std::time::SystemTime;

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
    fn a_proof_depends_on_the_token_and_on_the_question() {
        let token = |digit: &str| Token::from_text(&digit.repeat(32)).unwrap();
        let question = "5".repeat(32);
        // Value computed by an independent implementation.
        assert_eq!(
            token("0").proof(&question).as_deref(),
            Some("a0f41c624afc1463089e878e22f1ac32ef205e3e3db151851875c4e08b62a5a1")
        );
        assert_ne!(token("0").proof(&question), token("1").proof(&question));
        assert_ne!(token("0").proof(&question), token("0").proof(&"6".repeat(32)));
        for wrong in ["", &"0".repeat(31), &"0".repeat(129), &"x".repeat(32), &"A".repeat(32)] {
            assert_eq!(token("0").proof(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn a_token_is_kept_for_its_port_and_only_if_nobody_else_could_have_put_it_there() {
        let folder = tempfile::tempdir().unwrap();
        let keep = Keep(folder.path().join("live-1.token"));
        let token = keep.token().unwrap();
        assert_eq!(keep.token().unwrap(), token);
        assert_ne!(Keep(folder.path().join("live-2.token")).token().unwrap(), token);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            assert!(is_private(&fs::metadata(&keep.0).unwrap()));
            fs::set_permissions(&keep.0, fs::Permissions::from_mode(0o644)).unwrap();
            let other = keep.token().unwrap();
            assert_ne!(other, token);
            fs::rename(&keep.0, folder.path().join("elsewhere")).unwrap();
            std::os::unix::fs::symlink("elsewhere", &keep.0).unwrap();
            assert_ne!(keep.token().unwrap(), other);
        }
        let kept = keep.token().unwrap();
        keep.renew(&Token::random().unwrap());
        assert_eq!(keep.token().unwrap(), kept);
        fs::write(&keep.0, "0123").unwrap();
        assert_ne!(keep.token().unwrap(), kept);
        let kept = keep.token().unwrap();
        fs::File::options()
            .write(true)
            .open(&keep.0)
            .unwrap()
            .set_modified(SystemTime::now() - KEPT * 2)
            .unwrap();
        assert_ne!(keep.token().unwrap(), kept);
    }
}
