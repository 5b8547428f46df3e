//! Access control: the checks of every request in addition to its [token](super::Token).
//!
//! Any web page that the user visits can send requests to this machine's ports. A request must therefore contain the
//! token, and its host must be a name of this machine (otherwise another site could rebind its own name to it). If the
//! browser sends the origin, the origin must be a page of this server.

/// Returns true if a request to `host` from a page of `origin` may be answered.
pub(super) fn admits(host: Option<&str>, origin: Option<&str>) -> bool {
    let Some(host) = host.filter(|host| is_this_machine(host)) else { return false };
    origin.is_none_or(|origin| {
        origin.strip_prefix("http://").is_some_and(|origin| origin.eq_ignore_ascii_case(host))
    })
}

/// Returns true if `host` is a name of this machine only. Any port is allowed, because requests may pass through a
/// tunnel.
fn is_this_machine(host: &str) -> bool {
    let (name, port) = match host.find(']').filter(|_| host.starts_with('[')) {
        Some(end) => {
            let (name, rest) = host.split_at(end + 1);
            (name, rest.strip_prefix(':').or(rest.is_empty().then_some("0")))
        }
        None => match host.split_once(':') {
            Some((name, port)) => (name, Some(port)),
            None => (host, Some("0")),
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
