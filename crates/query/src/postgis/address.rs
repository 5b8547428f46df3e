//! Addresses of servers.

use std::fmt;

use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;

/// What addresses begin with.
const SCHEMES: [&str; 2] = ["postgres://", "postgresql://"];

/// The port of a server whose address names none.
const PORT: u16 = 5432;

/// Where a database is, and who asks. It never shows its password.
#[derive(Clone, PartialEq, Eq)]
pub struct ServerAddress {
    /// Who asks; nobody in particular if it is empty.
    pub user: String,
    /// The machine.
    pub host: String,
    /// Its port.
    pub port: u16,
    /// The database.
    pub database: String,
    password: Option<String>,
}

impl fmt::Display for ServerAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { user, host, port, database, .. } = self;
        f.write_str(SCHEMES[0])?;
        if !user.is_empty() {
            write!(f, "{user}@")?;
        }
        f.write_str(host)?;
        if *port != PORT {
            write!(f, ":{port}")?;
        }
        write!(f, "/{database}")
    }
}

impl fmt::Debug for ServerAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl ServerAddress {
    /// Whether a text is the address of a server, and not the name of a file.
    pub fn is_address(text: &str) -> bool {
        SCHEMES.iter().any(|scheme| text.starts_with(scheme))
    }

    /// Reads `postgres://user:password@host:port/database`, of which user, password and port may be left out.
    pub fn parse(text: &str) -> Result<Self> {
        let (address, layer) = Self::split(text)?;
        match layer {
            None => Ok(address),
            Some(layer) => {
                Err(Error::argument(format!("{address} has a layer behind it: {}", shown(&layer)))
                    .help("name the database alone: postgres://user@host/database"))
            }
        }
    }

    /// Reads an address and the layer behind the colon that may follow it.
    pub fn split(text: &str) -> Result<(Self, Option<String>)> {
        // Whatever is wrong, a password is not part of what is said.
        let wrong = |why: &str| {
            Error::argument(format!("the address of a database {why}"))
                .help("write postgres://user@host/database, and a layer behind a colon")
        };
        let scheme = SCHEMES.iter().find_map(|scheme| text.strip_prefix(scheme));
        let rest = scheme.ok_or_else(|| wrong("begins with postgres://"))?;
        let (place, path) = rest.split_once('/').ok_or_else(|| wrong("names a database behind a slash"))?;
        let (database, layer) = match path.split_once(':') {
            Some((database, layer)) => (database, Some(layer.to_owned())),
            None => (path, None),
        };
        let (user, host) = place.rsplit_once('@').unwrap_or(("", place));
        let (user, password) = match user.split_once(':') {
            Some((user, password)) => (user, Some(decoded(password))),
            None => (user, None),
        };
        let (host, port) = match host.rsplit_once(':') {
            Some((host, port)) => (host, port.parse().map_err(|_| wrong("has a port that is no number"))?),
            None => (host, PORT),
        };
        if host.is_empty() || database.is_empty() || database.contains(['?', '/']) {
            return Err(wrong("names a host and a database, and nothing more"));
        }
        let address =
            Self { user: decoded(user), host: decoded(host), port, database: decoded(database), password };
        Ok((address, layer))
    }

    /// The address among `allowed` that this one means: that of the same database, with the user and the password that
    /// were allowed. Fails with the remedy if there is none.
    pub fn allowed<'a>(&self, allowed: &'a [Self]) -> Result<&'a Self> {
        let same = |other: &&'a Self| {
            (&other.host, other.port, &other.database) == (&self.host, self.port, &self.database)
                && (self.user.is_empty() || self.user == other.user)
        };
        allowed.iter().find(same).ok_or_else(|| {
            Error::scope(format!("the script asks {self}, which is not allowed"))
                .help(format!("scripts reach only what you name: --database {self}"))
        })
    }

    /// The password, if there is one.
    pub(super) fn password(&self) -> Option<&str> {
        self.password.as_deref()
    }
}

/// Text with `%41` and the like as what they stand for.
fn decoded(text: &str) -> String {
    let bytes = text.as_bytes();
    let (mut made, mut at) = (Vec::with_capacity(bytes.len()), 0);
    while let Some(byte) = bytes.get(at) {
        let code = bytes.get(at + 1..at + 3).and_then(|code| std::str::from_utf8(code).ok());
        match code.filter(|_| *byte == b'%').and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(code) => {
                made.push(code);
                at += 3;
            }
            None => {
                made.push(*byte);
                at += 1;
            }
        }
    }
    String::from_utf8_lossy(&made).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_is_read_and_shown_without_its_password() {
        let (address, layer) =
            ServerAddress::split("postgres://me:se%40cret@db.example:5433/town:houses").unwrap();
        assert_eq!((address.password(), layer.as_deref()), (Some("se@cret"), Some("houses")));
        assert_eq!(address.to_string(), "postgres://me@db.example:5433/town");
        assert_eq!(format!("{address:?}"), "postgres://me@db.example:5433/town");
        assert_eq!(ServerAddress::parse("postgresql://host/db").unwrap().to_string(), "postgres://host/db");
        for wrong in [
            "postgres://host",
            "postgres:///db",
            "postgres://me:pass@host:port/db",
            "mysql://a/b",
            "postgres://a/b?c",
        ] {
            let error = ServerAddress::parse(wrong).unwrap_err().to_string();
            assert!(!error.contains("pass"), "{error}");
        }
    }

    #[test]
    fn a_script_reaches_only_what_is_allowed() {
        let allowed = [ServerAddress::parse("postgres://me:secret@host/db").unwrap()];
        let asked = |text: &str| ServerAddress::parse(text).unwrap().allowed(&allowed).cloned();
        assert_eq!(asked("postgres://host/db").unwrap().password(), Some("secret"));
        assert_eq!(asked("postgres://me@host:5432/db").unwrap(), allowed[0]);
        insta::assert_snapshot!(asked("postgres://root:x@host/db").unwrap_err(), @r"
        the script asks postgres://root@host/db, which is not allowed
          help: scripts reach only what you name: --database postgres://root@host/db
        ");
        assert!(asked("postgres://host/other").is_err() && asked("postgres://host:1/db").is_err());
    }
}
