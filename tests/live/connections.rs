//! Idle connections, and a server that restarts on the same port.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use crate::support::{PATIENCE, Server, script};

#[cfg(target_os = "linux")]
#[test]
fn hundreds_of_half_open_connections_leave_files_and_answers_to_others() {
    let server = Server::with_few_files(&script(3), 128);
    let mut page = server.page();
    page.next("model");
    let before = server.open_files();
    let half: Vec<TcpStream> = (0..600)
        .map(|i| {
            let mut stream = TcpStream::connect(("127.0.0.1", server.port)).unwrap();
            let head = ["", "GET", "GET / HTTP/1.1\r\n", "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"][i % 4];
            // The server may already have closed the connection.
            let _ = stream.write_all(head.as_bytes());
            stream
        })
        .collect();
    assert_eq!(server.get("").status, 200);
    assert_eq!(server.page().next("model")["type"], "model");
    server.write("s.lua", script(4));
    page.next("model");
    assert!(server.open_files() < before + 40, "{} files, {before} before", server.open_files());
    drop(half);
}

#[test]
fn who_does_not_finish_a_request_is_given_up_and_a_page_that_is_silent_is_not() {
    let server = Server::new(Some(&script(3)));
    let mut page = server.page();
    page.next("model");
    let begin = Instant::now();
    let mut half: Vec<TcpStream> = ["", "GET /", "GET / HTTP/1.1\r\nHost: localhost\r\n"]
        .into_iter()
        .map(|head| {
            let mut stream = TcpStream::connect(("127.0.0.1", server.port)).unwrap();
            stream.write_all(head.as_bytes()).unwrap();
            stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
            stream
        })
        .collect();
    for stream in &mut half {
        let mut rest = Vec::new();
        // The server closes the connection, with or without an answer.
        stream.read_to_end(&mut rest).unwrap();
    }
    assert!(begin.elapsed() > Duration::from_secs(4));
    page.is_quiet(Duration::from_millis(50));
}

#[test]
fn the_next_server_of_a_port_has_the_same_address_and_proves_that_it_knows_it() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.lua"), script(3)).unwrap();
    // The port is likely to remain free for a moment.
    let port =
        std::net::TcpListener::bind(("127.0.0.1", 0)).unwrap().local_addr().unwrap().port().to_string();
    let first = Server::start(folder, &["--port", &port]);
    let (token, question) = (first.token.clone(), "0123456789abcdef".repeat(2));
    let ask = |server: &Server, question: &str, host: &str| {
        server.request(&format!("GET /proof/{question} HTTP/1.1\r\nHost: {host}\r\n"))
    };
    let proof = ask(&first, &question, "127.0.0.1");
    assert_eq!((proof.status, proof.body.len()), (200, 64));
    let second = Server::start(first.end(), &["--port", &port]);
    assert_eq!(second.token, token);
    assert_eq!(ask(&second, &question, "localhost").body, proof.body);
    assert_ne!(ask(&second, &question.replace('0', "1"), "localhost").body, proof.body);
    assert_eq!(ask(&second, &question, "example.org").status, 403);
    for wrong in ["", "0", "../x", "%30"] {
        assert_eq!(ask(&second, wrong, "localhost").status, 404, "{wrong}");
    }
    let folder = second.end();
    std::fs::remove_dir_all(folder.path().join("burgeon")).unwrap();
    let third = Server::start(folder, &["--port", &port]);
    assert_ne!(third.token, token);
    let bare = format!("GET /{token}/ HTTP/1.1\r\nHost: localhost\r\n");
    assert_eq!(third.request(&bare).status, 403);
    let any = Server::new(None);
    assert_ne!(Server::start(any.end(), &[]).token, third.token);
}

#[test]
fn an_export_that_its_page_gave_up_ends_and_the_next_one_has_its_turn() {
    let server = Server::new(Some(&script(300)));
    server.page().next("model");
    let begin = Instant::now();
    let mut page = TcpStream::connect(("127.0.0.1", server.port)).unwrap();
    let path = format!("/{}/export/a.png?width=8192&height=8192", server.token);
    write!(page, "GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n").unwrap();
    std::thread::sleep(Duration::from_millis(500));
    // The run takes much longer than this timeout.
    page.set_read_timeout(Some(Duration::from_millis(1))).unwrap();
    assert!(page.read(&mut [0; 1]).is_err());
    drop(page);
    assert_eq!(server.get("export/a.glb").status, 200);
    assert!(begin.elapsed() < PATIENCE / 2, "{:?}", begin.elapsed());
}
