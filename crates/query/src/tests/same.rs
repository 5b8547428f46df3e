//! A rewritten statement gives the rows that it gives as it was written.

use super::*;

/// The rows of a statement that was not rewritten.
fn plainly(database: &Database, sql: &str, parameters: &[(&str, Cell)]) -> Vec<Vec<Cell>> {
    let mut rows = database.query_plainly(sql, parameters, &budget()).unwrap().rows.clone();
    rows.sort_by(|a, b| {
        a.iter().zip(b).map(|(a, b)| a.order(b)).find(|it| it.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    });
    rows
}

fn both(database: &Database, sql: &str, parameters: &[(&str, Cell)]) -> usize {
    let mut rewritten = database.query(sql, parameters, &budget()).unwrap().rows.clone();
    // True and false are known as such only where the statement was read.
    for cell in rewritten.iter_mut().flatten() {
        if let Cell::Boolean(value) = cell {
            *cell = Cell::Number(f64::from(u8::from(*value)));
        }
    }
    rewritten.sort_by(|a, b| {
        a.iter().zip(b).map(|(a, b)| a.order(b)).find(|it| it.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut plain = plainly(database, sql, parameters);
    for cell in plain.iter_mut().flatten() {
        if let Cell::Boolean(value) = cell {
            *cell = Cell::Number(f64::from(u8::from(*value)));
        }
    }
    assert_eq!(rewritten, plain, "{sql}");
    plain.len()
}

#[test]
fn statements_give_the_same_rows_with_and_without_an_index() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 110);
    let predicates = [
        "ST_Intersects({a}, {b})",
        "ST_Contains({a}, {b})",
        "ST_Within({a}, {b})",
        "ST_Covers({a}, {b})",
        "ST_CoveredBy({b}, {a})",
        "ST_Touches({a}, {b})",
        "ST_Overlaps({a}, {b})",
        "ST_Crosses({a}, {b})",
        "ST_Equals({a}, {b})",
        "ST_DWithin({a}, {b}, 6)",
        "ST_Distance({a}, {b}) < 5",
        "7 >= ST_Distance({b}, {a})",
        "ST_Intersects(ST_Buffer({a}, 3), {b})",
        "(ST_Intersects({a}, {b})) = 1",
        "ST_Intersects({a}, {b}) AND a.fid <> b.fid",
        "a.fid < b.fid AND ST_DWithin({a}, {b}, 2)",
        "ST_Intersects({a}, {b}) OR a.fid = b.fid",
        "NOT ST_Disjoint({a}, {b})",
    ];
    let tables = [("houses", "houses"), ("houses", "roads"), ("lamps", "houses"), ("roads", "roads")];
    let (mut count, mut rows) = (0, 0);
    for predicate in predicates {
        let on = predicate.replace("{a}", "a.geom").replace("{b}", "b.geom");
        for (a, b) in tables {
            for sql in [
                format!("SELECT a.fid, b.fid FROM {a} a JOIN {b} b ON {on}"),
                format!("SELECT a.fid, b.fid FROM {a} AS a, {b} AS b WHERE ({on}) AND a.fid % 3 = 0"),
                format!("SELECT a.fid, b.fid, b.fid IS NULL FROM {a} a LEFT JOIN {b} b ON {on}"),
                format!("SELECT a.fid FROM {a} a WHERE NOT EXISTS (SELECT 1 FROM {b} b WHERE {on})"),
                format!("SELECT a.fid, (SELECT count(*) FROM {b} b WHERE {on}) AS n FROM {a} a"),
                format!(
                    "SELECT count(*), ST_AsText(ST_Envelope(ST_Collect(b.geom))) FROM {a} a CROSS JOIN {b} b WHERE {on} AND b.fid = 7"
                ),
            ] {
                // What no index answers takes long.
                if predicate.contains(" OR ") || predicate.contains("NOT") {
                    continue;
                }
                rows += both(&database, &sql, &[]);
                count += 1;
            }
        }
    }
    assert!(count > 300 && rows > 10_000, "{count} {rows}");
}

#[test]
fn the_nearest_are_those_of_all_distances() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 200);
    let mut count = 0;
    for (a, b) in [("houses", "roads"), ("lamps", "houses"), ("roads", "lamps"), ("houses", "houses")] {
        for sql in [
            format!(
                "SELECT a.fid, (SELECT b.fid FROM {b} b ORDER BY ST_Distance(a.geom, b.geom) NULLS LAST, b.fid LIMIT 1) AS n FROM {a} a WHERE a.geom IS NOT NULL"
            ),
            format!(
                "SELECT a.fid, (SELECT round(ST_Distance(b.geom, a.geom), 6) FROM {b} b WHERE b.geom IS NOT NULL ORDER BY ST_Distance(b.geom, a.geom) LIMIT 1 OFFSET 2) AS n FROM {a} a WHERE a.geom IS NOT NULL"
            ),
            format!(
                "SELECT a.fid, (SELECT b.fid FROM {b} b WHERE b.fid % 40 = 3 AND b.fid <> a.fid ORDER BY ST_Distance(b.geom, a.geom) NULLS LAST, b.fid LIMIT 1) AS n FROM {a} a WHERE a.geom IS NOT NULL"
            ),
        ] {
            both(&database, &sql, &[]);
            count += 1;
        }
        // The nearest alone is found without any distance of SQLite's.
        let sql = format!(
            "SELECT a.fid, (SELECT b.fid FROM {b} b ORDER BY b.geom <-> a.geom LIMIT 1) AS n FROM {a} a WHERE a.geom IS NOT NULL"
        );
        let written = format!(
            "SELECT a.fid, (SELECT b.fid FROM {b} b WHERE b.geom IS NOT NULL ORDER BY ST_Distance(b.geom, a.geom), b.fid LIMIT 1) AS n FROM {a} a WHERE a.geom IS NOT NULL"
        );
        let fast = database.query(&sql, &[], &budget()).unwrap();
        assert_eq!(fast.rows, plainly(&database, &written, &[]), "{sql}");
    }
    assert_eq!(count, 12);
    let at = [
        ("g", Cell::Geometry(Arc::new(Geometry::from_wkt("POINT(385050 6672050)").unwrap()))),
        ("k", Cell::Number(5.0)),
    ];
    both(
        &database,
        "SELECT fid FROM houses WHERE geom IS NOT NULL ORDER BY ST_Distance(geom, $g), fid LIMIT $k",
        &at,
    );
    assert_eq!(both(&database, "SELECT fid FROM houses WHERE ST_DWithin($g, geom, 30)", &at), 26);
}

#[test]
fn rows_come_in_one_order_whatever_is_left_open() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 120);
    let fids = |sql: &str| -> Vec<String> {
        let answer = database.query(sql, &[], &budget()).unwrap();
        answer.rows.iter().map(|row| row[0].to_string()).collect()
    };
    assert_eq!(fids("SELECT levels FROM houses LIMIT 7"), ["1", "2", "3", "4", "5", "1", "2"]);
    assert_eq!(fids("SELECT fid FROM houses ORDER BY levels LIMIT 4"), ["1", "6", "11", "16"]);
    // What is not known comes last, and first where the order is turned round.
    assert_eq!(fids("SELECT fid FROM houses ORDER BY name LIMIT 2"), ["2", "11"]);
    assert_eq!(fids("SELECT fid FROM houses ORDER BY name DESC LIMIT 2"), ["1", "4"]);
    assert_eq!(fids("SELECT DISTINCT levels FROM houses"), ["1", "2", "3", "4", "5"]);
    assert_eq!(
        fids("SELECT levels, count(*) FROM houses GROUP BY levels ORDER BY count(*) DESC LIMIT 2"),
        ["1", "2"]
    );
    let joined = database
        .query("SELECT b.fid, a.fid FROM houses a, lamps b WHERE a.fid < 3 AND b.fid < 3", &[], &budget())
        .unwrap();
    let pairs: Vec<String> = joined.rows.iter().map(|row| format!("{}{}", row[0], row[1])).collect();
    assert_eq!(pairs, ["11", "12", "21", "22"]);
}

#[test]
fn statements_of_any_form_give_the_same_rows() {
    use proptest::prelude::*;
    use proptest::test_runner::{Config, TestRunner};
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 60);
    let table = || prop_oneof![Just("houses"), Just("roads"), Just("lamps")];
    let spatial = || {
        prop_oneof![
            Just("ST_Intersects(X, Y)"),
            Just("ST_DWithin(X, Y, 7)"),
            Just("ST_Distance(Y, X) < 9"),
            Just("ST_Covers(X, Y)"),
            Just("geometry_overlaps(X, Y)"),
            Just("ST_Intersects(ST_Buffer(X, 4), Y)"),
        ]
    };
    let plain = || {
        prop_oneof![
            Just("1 = 1"),
            Just("a.fid <> b.fid"),
            Just("a.fid < b.fid"),
            Just("b.fid % 3 = 1"),
            Just("a.fid = 7"),
            Just("(a.fid < 9 OR b.fid > 30)"),
            Just("b.geom IS NOT NULL"),
        ]
    };
    let forms = prop_oneof![
        Just("SELECT a.fid, b.fid, c.fid FROM A a JOIN B b ON P JOIN C c ON Q WHERE R"),
        Just("SELECT a.fid, b.fid, c.fid FROM A a, B b, C c WHERE P AND Q AND R"),
        Just("SELECT a.fid, b.fid, c.fid FROM A a LEFT JOIN B b ON P AND R JOIN C c ON Q"),
        Just("SELECT a.fid, b.fid, c.fid FROM A a JOIN B b ON P AND R LEFT JOIN C c ON Q"),
        Just("SELECT a.fid, b.fid FROM A a JOIN B b ON P WHERE R AND NOT EXISTS (SELECT 1 FROM C c WHERE Q)"),
        Just("SELECT a.fid, (SELECT count(*) FROM C c WHERE Q) FROM A a, B b WHERE R AND P"),
        Just(
            "WITH n AS (SELECT * FROM C WHERE fid % 2 = 0) SELECT a.fid, b.fid, c.fid FROM A a JOIN B b ON P JOIN n c ON Q WHERE R"
        ),
        Just("SELECT a.fid, b.fid FROM A a JOIN (SELECT * FROM B) b ON P WHERE R"),
    ];
    let statement = (forms, [table(), table(), table()], spatial(), spatial(), plain());
    let mut runner = TestRunner::new(Config { cases: 300, failure_persistence: None, ..Config::default() });
    runner
        .run(&statement, |(form, [a, b, c], p, q, r)| {
            let p = p.replace('X', "a.geom").replace('Y', "b.geom");
            let q = q.replace('X', "b.geom").replace('Y', "c.geom");
            // The form's own letters go first, as conditions have letters, too.
            let words = form.split(' ').map(|word| match word.trim_matches(['(', ')', ',']) {
                "A" => word.replace('A', a),
                "B" => word.replace('B', b),
                "C" => word.replace('C', c),
                "P" => word.replace('P', &p),
                "Q" => word.replace('Q', &q),
                "R" => word.replace('R', r),
                _ => word.to_owned(),
            });
            both(&database, &words.collect::<Vec<_>>().join(" "), &[]);
            Ok(())
        })
        .unwrap();
}
