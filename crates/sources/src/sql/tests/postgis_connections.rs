//! Tests of connections to a PostGIS server: encryption, and connections that are lost.

use super::budget;
use super::postgis::writer;
use crate::sql::postgis::{Server, ServerAddress};

/// Checks that connections are encrypted as the address specifies, if `BURGEON_POSTGIS_CA` names the certificate of the
/// server's authority.
pub(super) fn check_encryption(address: &ServerAddress) {
    let Ok(authority) = std::env::var("BURGEON_POSTGIS_CA") else {
        eprintln!("left out: BURGEON_POSTGIS_CA names no certificate");
        return;
    };
    let encrypted = "SELECT count(*) AS n FROM houses";
    let asked = |host: &str, options: &str| {
        let text =
            format!("postgres://{}@{host}:{}/{}?{options}", address.user, address.port, address.database);
        Server::new(&ServerAddress::parse(&text).unwrap(), None).query(encrypted, &[], None, &budget())
    };
    for (host, options) in [
        ("127.0.0.1", "sslmode=disable".to_owned()),
        ("127.0.0.1", "sslmode=prefer".to_owned()),
        ("127.0.0.1", "sslmode=require".to_owned()),
        ("127.0.0.1", format!("sslmode=verify-ca&sslrootcert={authority}")),
        ("localhost", format!("sslmode=verify-full&sslrootcert={authority}")),
    ] {
        asked(host, &options).unwrap_or_else(|error| panic!("{host} {options}: {error}"));
    }
    for (host, options, why) in [
        ("127.0.0.1", format!("sslmode=verify-full&sslrootcert={authority}"), "certificate"),
        ("localhost", "sslmode=verify-full".to_owned(), "certificate"),
        (
            "localhost",
            "sslmode=verify-ca&sslrootcert=/no/such/file".to_owned(),
            "cannot read the certificates",
        ),
    ] {
        let error = asked(host, &options).unwrap_err();
        assert!(error.message().contains(why) && error.remedy().is_some(), "{host} {options}: {error}");
    }
}

/// Checks that a lost connection is reopened once, and that an unreachable server is reported.
pub(super) fn check_lost_connection(server: &Server) {
    server.query("SELECT fid FROM lamps", &[], None, &budget()).unwrap();
    writer()
        .batch_execute(
            "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'burgeon'",
        )
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(200));
    assert!(!server.query("SELECT fid FROM lamps", &[], None, &budget()).unwrap().is_empty());
    let nobody = ServerAddress::parse("postgres://me:secret@127.0.0.1:1/nothing").unwrap();
    let error = Server::new(&nobody, None).query("SELECT 1", &[], None, &budget()).unwrap_err();
    assert_eq!(error.kind().code(), "unavailable");
    assert!(
        !error.to_string().contains("secret")
            && error.to_string().contains("postgres://me@127.0.0.1:1/nothing"),
        "{error}"
    );
    // The connection is lost during a query, which is repeated.
    let sql = "SELECT count(*) AS n FROM houses a, houses b WHERE a.fid < 60 AND ST_Distance(ST_Buffer(a.geom, 3), ST_Buffer(b.geom, 2)) > 1";
    let known = server.query(sql, &[], None, &budget()).unwrap();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let end = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'burgeon' AND state = 'active' AND query LIKE '%ST_Buffer%'";
            let mut client = writer();
            let gone = (0..200).any(|_| {
                std::thread::sleep(std::time::Duration::from_millis(5));
                !client.query(end, &[]).unwrap().is_empty()
            });
            assert!(gone, "no query was active");
        });
        assert_eq!(server.query(sql, &[], None, &budget()).unwrap().values, known.values);
    });
}
