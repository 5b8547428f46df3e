//! Addresses of servers.

use std::fmt;
use std::path::PathBuf;
use std::time::Duration;

use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;

/// Schemes of addresses.
const SCHEMES: [&str; 2] = ["postgres://", "postgresql://"];

/// Default port of a server.
const PORT: u16 = 5432;

/// Default connection timeout.
const CONNECT: Duration = Duration::from_secs(10);

/// Options that may follow the question mark.
const OPTIONS: [&str; 5] = ["sslmode", "sslrootcert", "connect_timeout", "answer_timeout", "search_path"];

/// The modes of encryption and server verification, named as in libpq.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum EncryptionMode {
    /// No encryption.
    Disable,
    /// Encryption if the server offers it, without verification.
    #[default]
    Prefer,
    /// Encryption without verification.
    Require,
    /// Encryption, with a certificate that a known authority has signed.
    VerifyCa,
    /// Encryption, with a certificate that a known authority has signed and that is issued to the host.
    VerifyFull,
}

impl EncryptionMode {
    const ALL: [(&'static str, Self); 5] = [
        ("disable", Self::Disable),
        ("prefer", Self::Prefer),
        ("require", Self::Require),
        ("verify-ca", Self::VerifyCa),
        ("verify-full", Self::VerifyFull),
    ];
}

/// The address of a database, with the user. Its password is never displayed.
#[derive(Clone, PartialEq, Eq)]
pub struct ServerAddress {
    /// Name of the user. If empty, any user.
    pub user: String,
    /// Host name.
    pub host: String,
    /// Port.
    pub port: u16,
    /// Name of the database.
    pub database: String,
    /// Encryption of connections.
    pub encryption: EncryptionMode,
    /// File with the certificates of authorities. If omitted, those of the system.
    pub authorities: Option<PathBuf>,
    /// Connection timeout.
    pub connect_timeout: Duration,
    /// Time limit of a statement. If omitted, the time limit of the run.
    pub answer_timeout: Option<Duration>,
    /// Schemas in which tables are found by unqualified names. If empty, the server's setting.
    pub search_path: Vec<String>,
    password: Option<String>,
}

impl fmt::Display for ServerAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { user, host, port, database, .. } = self;
        f.write_str(SCHEMES[0])?;
        if !user.is_empty() {
            write!(f, "{user}@")?;
        }
        match host.contains(':') {
            true => write!(f, "[{host}]")?,
            false => f.write_str(host)?,
        }
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
    /// Returns true if a string is the address of a server, and not a file name.
    pub fn is_address(text: &str) -> bool {
        SCHEMES.iter().any(|scheme| text.starts_with(scheme))
    }

    /// Parses `postgres://user:password@host:port/database?option=value`. User, password, port and options are
    /// optional.
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

    /// Parses an address, and the layer after a colon that may follow the database.
    pub fn split(text: &str) -> Result<(Self, Option<String>)> {
        // Messages never contain the password.
        let wrong = |why: &str| {
            Error::argument(format!("the address of a database {why}"))
                .help("write postgres://user@host/database, and a layer behind a colon")
        };
        let scheme = SCHEMES.iter().find_map(|scheme| text.strip_prefix(scheme));
        let rest = scheme.ok_or_else(|| wrong("begins with postgres://"))?;
        let (place, path) = rest.split_once('/').ok_or_else(|| wrong("names a database behind a slash"))?;
        let (path, options) = path.split_once('?').map_or((path, None), |(path, rest)| (path, Some(rest)));
        let (database, layer) = match path.split_once(':') {
            Some((database, layer)) => (database, Some(layer.to_owned())),
            None => (path, None),
        };
        let (user, host) = place.rsplit_once('@').unwrap_or(("", place));
        let (user, password) = match user.split_once(':') {
            Some((user, password)) => (user, Some(decode(password))),
            None => (user, None),
        };
        // An IPv6 address contains colons.
        let bracketed = host.strip_prefix('[').and_then(|host| host.split_once(']'));
        let (host, port) = match bracketed {
            Some((host, port)) => (host, port.strip_prefix(':')),
            None => host.rsplit_once(':').map_or((host, None), |(host, port)| (host, Some(port))),
        };
        let port = match port {
            Some(port) => port.parse().map_err(|_| wrong("has a port that is no number"))?,
            None => PORT,
        };
        if host.is_empty() || database.is_empty() || database.contains('/') {
            return Err(wrong("names a host and a database, and nothing more"));
        }
        let mut address = Self {
            user: decode(user),
            host: decode(host),
            port,
            database: decode(database),
            encryption: EncryptionMode::default(),
            authorities: None,
            connect_timeout: CONNECT,
            answer_timeout: None,
            search_path: Vec::new(),
            password,
        };
        for option in options.into_iter().flat_map(|options| options.split('&')) {
            let (name, value) =
                option.split_once('=').ok_or_else(|| wrong("has an option without a value"))?;
            address.set(name, &decode(value))?;
        }
        Ok((address, layer))
    }

    /// Sets an option that follows the question mark.
    fn set(&mut self, name: &str, value: &str) -> Result<()> {
        let wrong = |allowed: &str| {
            // The value may belong to something else, so it is not shown.
            Error::argument(format!(
                "the option {name} of the address of a database has a value that is not known"
            ))
            .help(format!("write {name}={allowed}; a layer stands before the question mark"))
        };
        let seconds = || match value.parse::<f64>() {
            Ok(seconds) if (0.001..=1e6).contains(&seconds) => Ok(Duration::from_secs_f64(seconds)),
            _ => Err(wrong("10, in seconds")),
        };
        match name {
            "sslmode" => {
                let all = EncryptionMode::ALL;
                let known = all.iter().find(|(known, _)| *known == value);
                let names = EncryptionMode::ALL.map(|(name, _)| name).join(", ");
                self.encryption = known.ok_or_else(|| wrong(&format!("... with one of {names}")))?.1;
            }
            // In libpq, this name selects the certificates of the system.
            "sslrootcert" if value == "system" => self.authorities = None,
            "sslrootcert" if !value.is_empty() => self.authorities = Some(value.into()),
            "sslrootcert" => return Err(wrong("FILE")),
            "connect_timeout" => self.connect_timeout = seconds()?,
            "answer_timeout" => self.answer_timeout = Some(seconds()?),
            "search_path" => {
                self.search_path = value.split(',').map(|name| name.trim().to_owned()).collect();
                let plain = |name: &String| {
                    !name.is_empty() && name.chars().all(|it| it.is_alphanumeric() || it == '_')
                };
                if !self.search_path.iter().all(plain) {
                    return Err(wrong("one,public"));
                }
            }
            _ => {
                let is_name = name.chars().all(|letter| letter.is_ascii_lowercase() || letter == '_');
                // Any other name may be a part of a password.
                let name = if is_name { shown(name) } else { "that is no name".into() };
                return Err(Error::not_found(
                    "option",
                    &name,
                    OPTIONS,
                    format!("the address of a database has an option {name}"),
                )
                .help(format!("it may have {}", OPTIONS.join(", "))));
            }
        }
        Ok(())
    }

    /// Returns the address among `allowed` with the same database, and the allowed user and password. Fails with a
    /// remedy if there is none.
    pub fn find_allowed<'a>(&self, allowed: &'a [Self]) -> Result<&'a Self> {
        let same = |other: &&'a Self| {
            (&other.host, other.port, &other.database) == (&self.host, self.port, &self.database)
                && (self.user.is_empty() || self.user == other.user)
        };
        allowed.iter().find(same).ok_or_else(|| {
            Error::scope(format!("the script asks {self}, which is not allowed"))
                .help(format!("scripts reach only what you name: --database {self}"))
        })
    }

    /// Returns the password, if there is one.
    pub(super) fn password(&self) -> Option<&str> {
        self.password.as_deref()
    }
}

/// Decodes the percent-encoding of a string, such as `%41`.
fn decode(text: &str) -> String {
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
        let (address, layer) = ServerAddress::split(
            "postgres://me@[::1]:5433/db:old.houses?sslmode=verify-full&sslrootcert=%2Fa%2Fca.pem&connect_timeout=2.5&answer_timeout=60&search_path=old,public",
        )
        .unwrap();
        assert_eq!(layer.as_deref(), Some("old.houses"));
        assert_eq!(address.to_string(), "postgres://me@[::1]:5433/db");
        assert_eq!(address.encryption, EncryptionMode::VerifyFull);
        assert_eq!(address.authorities, Some("/a/ca.pem".into()));
        assert_eq!(address.connect_timeout, Duration::from_millis(2500));
        assert_eq!(address.answer_timeout, Some(Duration::from_secs(60)));
        assert_eq!(address.search_path, ["old", "public"]);
    }

    #[test]
    fn no_message_about_an_address_holds_its_password() {
        let mut told = String::new();
        for wrong in [
            "postgres://host",
            "postgres:///db",
            "postgres://me:s3cret@host:port/db",
            "postgres://me:s3cret/4@host/db",
            "postgres://me:s3cret#4@host:x/db",
            "postgres://me:pw@host/db?s3cret",
            "postgres://me:pw@host/db?s3cret=1",
            "postgres://me:pw@host/db?sslmode=s3cret",
            "postgres://me:pw@host/db?password=s3cret",
            "postgres://me:pw@host/db?search_path=s3cret;x",
            "postgres://me:pw@host/db?connect_timeout=s3cret",
            "mysql://me:s3cret@a/b",
            "postgres://me:s3cret@a/b:layer",
        ] {
            let error = ServerAddress::parse(wrong).unwrap_err();
            assert!(!format!("{error} {error:?}").contains("s3cret"), "{error}");
            told += &format!("{}\n", error.message());
        }
        insta::assert_snapshot!(told);
    }

    #[test]
    fn a_script_reaches_only_what_is_allowed() {
        let allowed = [ServerAddress::parse("postgres://me:secret@host/db").unwrap()];
        let asked = |text: &str| ServerAddress::parse(text).unwrap().find_allowed(&allowed).cloned();
        assert_eq!(asked("postgres://host/db").unwrap().password(), Some("secret"));
        assert_eq!(asked("postgres://me@host:5432/db").unwrap(), allowed[0]);
        insta::assert_snapshot!(asked("postgres://root:x@host/db").unwrap_err(), @r"
        the script asks postgres://root@host/db, which is not allowed
          help: scripts reach only what you name: --database postgres://root@host/db
        ");
        assert!(asked("postgres://host/other").is_err() && asked("postgres://host:1/db").is_err());
    }
}
