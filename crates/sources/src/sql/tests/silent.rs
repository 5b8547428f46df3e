//! Servers that accept and do not answer, stop midway, or send a byte now and then: no wait exceeds the run's time
//! limit, or the timeouts of the address.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::time::{Duration, Instant};

use super::*;
use crate::sql::postgis::{Server, ServerAddress};

/// The behaviour of a server on a connection.
type Manner = fn(TcpStream) -> std::io::Result<()>;

/// Answers the encryption request: the server does not encrypt.
fn refuse_encryption(stream: &mut TcpStream) -> std::io::Result<()> {
    stream.read_exact(&mut [0; 8])?;
    stream.write_all(b"N")
}

/// Reads the startup message of a client.
fn startup(stream: &mut TcpStream) -> std::io::Result<()> {
    let mut length = [0; 4];
    stream.read_exact(&mut length)?;
    let rest = usize::try_from(u32::from_be_bytes(length)).unwrap() - 4;
    stream.read_exact(&mut vec![0; rest])
}

/// Accepts the client.
fn welcome(stream: &mut TcpStream) -> std::io::Result<()> {
    refuse_encryption(stream)?;
    startup(stream)?;
    stream.write_all(b"R\0\0\0\x08\0\0\0\0K\0\0\0\x0c\0\0\0\x01\0\0\0\x02Z\0\0\0\x05I")
}

/// Keeps a connection open without sending anything.
fn silence(mut stream: TcpStream) -> std::io::Result<()> {
    while stream.read(&mut [0; 1000])? > 0 {}
    Ok(())
}

/// Sends a byte now and then.
fn trickle(mut stream: TcpStream, bytes: &[u8]) -> std::io::Result<()> {
    for byte in bytes.iter().cycle() {
        stream.write_all(&[*byte])?;
        std::thread::sleep(Duration::from_millis(30));
    }
    Ok(())
}

const MANNERS: [(&str, Manner); 7] = [
    ("says nothing", silence),
    ("says nothing of encryption but one letter that is none", |mut stream| {
        stream.read_exact(&mut [0; 8])?;
        stream.write_all(b"N")?;
        silence(stream)
    }),
    ("begins to encrypt and stops", |mut stream| {
        stream.read_exact(&mut [0; 8])?;
        stream.write_all(b"S")?;
        stream.write_all(b"\x16\x03\x03")?;
        silence(stream)
    }),
    ("stops in the middle of its first message", |mut stream| {
        refuse_encryption(&mut stream)?;
        startup(&mut stream)?;
        stream.write_all(b"R\0\0")?;
        silence(stream)
    }),
    ("tells of its settings for ever", |mut stream| {
        refuse_encryption(&mut stream)?;
        startup(&mut stream)?;
        stream.write_all(b"R\0\0\0\x08\0\0\0\0")?;
        trickle(stream, b"S\0\0\0\x08a\0b\0")
    }),
    ("welcomes and answers no question", |mut stream| {
        welcome(&mut stream)?;
        silence(stream)
    }),
    ("welcomes and tells of its settings for ever", |mut stream| {
        welcome(&mut stream)?;
        trickle(stream, b"S\0\0\0\x08a\0b\0")
    }),
];

/// Starts a server with a behaviour, and returns its port.
fn serve(manner: Manner) -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    std::thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            std::thread::spawn(move || manner(stream));
        }
    });
    port
}

#[test]
fn a_server_that_does_not_answer_outlasts_neither_the_run_nor_its_own_limits() {
    for (name, manner) in MANNERS {
        let port = serve(manner);
        let asked = |options: &str, budget: &Arc<Budget>| {
            let text = format!("postgres://me:s3cret@127.0.0.1:{port}/town{options}");
            let server = Server::new(&ServerAddress::parse(&text).unwrap(), None);
            let begin = Instant::now();
            let error = server.query("SELECT 1 AS one", &[], None, budget).unwrap_err();
            assert!(!error.to_string().contains("s3cret"), "{name}: {error}");
            (error, begin.elapsed())
        };
        let (error, time) = asked("", &Budget::within(Duration::from_millis(400), 1_000_000));
        assert_eq!(error.kind().code(), "limit.time", "{name}: {error}");
        assert!(time < Duration::from_millis(1500), "{name}: {time:?}");
        let long = Budget::within(Duration::from_secs(60), 1_000_000);
        let (error, time) = asked("?connect_timeout=0.4&answer_timeout=0.4", &long);
        assert_eq!(error.kind().code(), "unavailable", "{name}: {error}");
        assert!(error.message().contains("has not answered for 0.4 s"), "{name}: {error}");
        assert!(time < Duration::from_millis(1500), "{name}: {time:?}");
    }
}
