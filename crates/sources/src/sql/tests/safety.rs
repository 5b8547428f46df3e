//! Forbidden statements, and the errors of invalid ones.

use super::*;
use std::time::{Duration, Instant};

fn error(database: &Database, sql: &str) -> String {
    match database.query(sql, &[], &budget()) {
        Ok(answer) => panic!("{sql}: {answer}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_statement_may_only_read() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 30);
    let before = std::fs::read(folder.path().join("town.gpkg")).unwrap();
    let target = folder.path().join("stolen.db");
    let target = target.display();
    let refused = [
        format!("ATTACH '{target}' AS other"),
        "DETACH file1".into(),
        "PRAGMA case_sensitive_like = 0".into(),
        "PRAGMA automatic_index".into(),
        "PRAGMA journal_mode = WAL".into(),
        format!("VACUUM INTO '{target}'"),
        "VACUUM".into(),
        "INSERT INTO houses (name) VALUES ('x')".into(),
        "UPDATE houses SET name = 'x'".into(),
        "DELETE FROM houses".into(),
        "DROP TABLE houses".into(),
        "CREATE TABLE other (a)".into(),
        "CREATE TEMP TABLE other (a)".into(),
        "CREATE TEMP VIEW other AS SELECT 1".into(),
        "CREATE VIRTUAL TABLE other USING rtree(id, a, b)".into(),
        "ALTER TABLE houses RENAME TO other".into(),
        "BEGIN".into(),
        "SAVEPOINT a".into(),
        "ANALYZE".into(),
        "REINDEX".into(),
        "SELECT load_extension('x')".into(),
        "SELECT random()".into(),
        "SELECT randomblob(10)".into(),
        "SELECT readfile('/etc/passwd')".into(),
        "SELECT zeroblob(1000000000)".into(),
        "SELECT sqlite_source_id()".into(),
        "SELECT datetime('now')".into(),
        "SELECT CURRENT_TIMESTAMP".into(),
        "SELECT * FROM pragma_database_list".into(),
        "WITH a AS (SELECT 1) INSERT INTO houses (name) SELECT * FROM a".into(),
        "SELECT 1; DELETE FROM houses".into(),
    ];
    for sql in &refused {
        let told = error(&database, sql);
        assert!(!told.contains("internal"), "{sql}: {told}");
    }
    assert_eq!(refused.len(), 31);
    assert!(!folder.path().join("stolen.db").exists());
    assert_eq!(std::fs::read(folder.path().join("town.gpkg")).unwrap(), before);
    assert_eq!(
        database.query("SELECT count(*) FROM houses", &[], &budget()).unwrap().values,
        [Cell::Number(30.0)]
    );
}

#[test]
fn what_is_handed_over_is_never_part_of_the_statement() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 30);
    let evil = "x' OR 1 = 1; DROP TABLE houses; --";
    let parameters = [("name", Cell::Text(evil.into()))];
    let answer = database.query("SELECT fid FROM houses WHERE name = $name", &parameters, &budget()).unwrap();
    assert!(answer.is_empty());
    let answer = database.query("SELECT $name AS name", &parameters, &budget()).unwrap();
    assert_eq!(answer.values, [Cell::Text(evil.into())]);
}

#[test]
fn a_question_that_never_ends_is_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 300);
    for sql in [
        "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT count(*) FROM n",
        "SELECT count(*) FROM houses a, houses b, houses c, houses d WHERE ST_Disjoint(a.geom, d.geom)",
        "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i FROM n",
    ] {
        let begin = Instant::now();
        let error =
            database.query(sql, &[], &Budget::within(Duration::from_millis(300), 500_000_000)).unwrap_err();
        assert!(begin.elapsed() < Duration::from_secs(5), "{sql}");
        assert_eq!(error.kind().code(), "limit.time", "{sql}: {error}");
    }
    // The connection remains usable.
    assert_eq!(database.query("SELECT 1 AS one", &[], &budget()).unwrap().values, [Cell::Number(1.0)]);
}

#[test]
fn rows_and_values_take_no_more_memory_than_there_is() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 30);
    let small = || Budget::within(Duration::from_secs(60), 2_000_000);
    let sql = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i FROM n";
    assert_eq!(database.query(sql, &[], &small()).unwrap_err().kind().code(), "limit.memory");
    let sql = "SELECT hex(hex(hex(printf('%.*c', 100000000, 'x')))) AS long";
    assert!(matches!(
        database.query(sql, &[], &small()).unwrap_err().kind().code(),
        "limit.size" | "limit.memory"
    ));
    let deep = format!("SELECT {}1{}", "(".repeat(5000), ")".repeat(5000));
    assert!(database.query(&deep, &[], &small()).is_err());
    let long = format!("SELECT 1{}", " + 1".repeat(20_000));
    assert!(database.query(&long, &[], &small()).is_err());
    let many = format!("SELECT {}", "'x',".repeat(100_000));
    assert!(database.query(&many, &[], &small()).is_err());
    // The memory of the rows is released with them.
    let budget = budget();
    let answer = database.query("SELECT * FROM houses", &[], &budget).unwrap();
    assert!(budget.used_bytes() > 1000);
    drop(answer);
    assert_eq!(budget.used_bytes(), 0);
}

#[test]
fn errors_tell_the_place_and_what_there_is() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 30);
    let mut told = String::new();
    for sql in [
        "SELECT fid\nFROM house",
        "SELECT heigth FROM houses",
        "SELECT h.nme FROM houses h JOIN lamps l ON ST_Intersects(h.geom, l.geom)",
        "SELECT ST_Aera(geom) FROM houses",
        "SELECT ST_Buffer(geom) FROM houses",
        "SELECT fid FROM houses WHERE",
        "SELECT fid FROM houses WHERE height > > 3",
        "SELECT fid FROM houses WHERE name = 'x",
        "SELECT fid FROM houses WHERE fid = $house",
        "SELECT fid FROM houses WHERE fid = ?",
        "SELECT fid FROM houses a, houses b",
        "SELECT ST_GeomFromText('POINT(1') AS g",
        "SELECT ST_X(geom) FROM houses",
        "SELECT ST_Area(name) FROM houses WHERE name IS NOT NULL",
        "SELECT ST_Intersects(geom, 3) FROM houses",
        "SELECT geom::geography FROM houses",
        "SELECT name FROM dbstat",
        "SELECT random()",
        "DELETE FROM houses",
        "SELECT 1; SELECT 2",
        "  ",
    ] {
        told += &format!("{sql}\n-> {}\n\n", error(&database, sql));
    }
    insta::assert_snapshot!(told, @r#"
    SELECT fid
    FROM house
    -> SQL, line 2, column 6: no table called house
      help: did you mean houses?

    SELECT heigth FROM houses
    -> SQL, line 1, column 8: no column called heigth
      help: did you mean height?

    SELECT h.nme FROM houses h JOIN lamps l ON ST_Intersects(h.geom, l.geom)
    -> SQL, line 1, column 8: no column called h.nme
      help: did you mean name?

    SELECT ST_Aera(geom) FROM houses
    -> SQL, line 1, column 8: no function called ST_Aera
      help: did you mean ST_Area?

    SELECT ST_Buffer(geom) FROM houses
    -> SQL, line 1, column 8: wrong number of arguments to function ST_Buffer()
      help: it takes ST_Buffer(geometry, distance [, options])

    SELECT fid FROM houses WHERE
    -> SQL, line 1, column 29: incomplete input
      help: write SQL as SQLite takes it: SELECT ... FROM ... WHERE ...

    SELECT fid FROM houses WHERE height > > 3
    -> SQL, line 1, column 39: near ">": syntax error
      help: write SQL as SQLite takes it: SELECT ... FROM ... WHERE ...

    SELECT fid FROM houses WHERE name = 'x
    -> SQL, line 1, column 37: unrecognized token: "'x"
      help: write SQL as SQLite takes it: SELECT ... FROM ... WHERE ...

    SELECT fid FROM houses WHERE fid = $house
    -> SQL, line 1, column 36: $house has no value
      help: hand one over: query(sql, { house = ... })

    SELECT fid FROM houses WHERE fid = ?
    -> SQL: the parameter ? has no name that a value could be found by
      help: write $name

    SELECT fid FROM houses a, houses b
    -> SQL, line 1, column 8: ambiguous column name: fid
      help: check the statement; the book's page on SQL tells what functions take

    SELECT ST_GeomFromText('POINT(1') AS g
    -> SQL, line 1, column 8: ST_GeomFromText: invalid well-known text: expected a number at character 8, found its end
      help: check the statement; the book's page on SQL tells what functions take

    SELECT ST_X(geom) FROM houses
    -> SQL, line 1, column 8: ST_X: argument 1 must be a point, not a polygon
      help: check the statement; the book's page on SQL tells what functions take

    SELECT ST_Area(name) FROM houses WHERE name IS NOT NULL
    -> SQL, line 1, column 8: ST_Area: invalid well-known text: expected a geometry type at character 1, found "house"
      help: check the statement; the book's page on SQL tells what functions take

    SELECT ST_Intersects(geom, 3) FROM houses
    -> SQL, line 1, column 8: ST_Intersects: argument 2 must be a geometry, not a number: ST_Intersects(geometry, geometry)
      help: check the statement; the book's page on SQL tells what functions take

    SELECT geom::geography FROM houses
    -> SQL, line 1, column 8: the type geography is not supported here
      help: geometries are in metres here: leave the cast out

    SELECT name FROM dbstat
    -> SQL, line 1, column 18: the table dbstat may not be read
      help: a table is what source(file) has read, or a module

    SELECT random()
    -> SQL, line 1, column 8: the function random may not be called
      help: questions give the same each time, and reach nothing but tables; the book's page on SQL lists what there is

    DELETE FROM houses
    -> SQL: a question may only read: SELECT, WITH and VALUES are allowed
      help: layers are written with exports, not with SQL

    SELECT 1; SELECT 2
    -> SQL, line 1, column 11: there is more than one statement
      help: ask one question at a time; values are handed over as parameters: $name

      
    -> the statement is empty
      help: write query("SELECT ... FROM ...")
    "#);
    let given = [("hose", Cell::Number(1.0)), ("other", Cell::Null)];
    let error = database.query("SELECT fid FROM houses WHERE fid = $house", &given, &budget()).unwrap_err();
    insta::assert_snapshot!(error, @r"
    SQL, line 1, column 36: $house has no value
      help: did you mean hose?
    ");
}
