//! A rewritten statement gives the same rows as the original.

use super::*;

/// Returns the rows of a statement that is not rewritten.
fn plain_rows(database: &Database, sql: &str, parameters: &[(&str, Cell)]) -> Vec<Vec<Cell>> {
    let mut rows = lists(&database.query_plainly(sql, parameters, &budget()).unwrap());
    rows.sort_by(|a, b| {
        a.iter().zip(b).map(|(a, b)| a.order(b)).find(|it| it.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    });
    rows
}

fn both(database: &Database, sql: &str, parameters: &[(&str, Cell)]) -> usize {
    let mut rewritten = lists(&database.query(sql, parameters, &budget()).unwrap());
    // Booleans are recognized only if the statement was parsed.
    for cell in rewritten.iter_mut().flatten() {
        if let Cell::Boolean(value) = cell {
            *cell = Cell::Number(f64::from(u8::from(*value)));
        }
    }
    rewritten.sort_by(|a, b| {
        a.iter().zip(b).map(|(a, b)| a.order(b)).find(|it| it.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut plain = plain_rows(database, sql, parameters);
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
        "(ST_Touches({a}, {b}) OR ST_DWithin({b}, {a}, 2))",
        "(ST_Intersects({a}, {b}) AND a.fid < b.fid OR b.fid = a.fid + 1 OR ST_Distance({a}, {b}) < 1)",
    ];
    let tables = [("houses", "houses"), ("houses", "roads"), ("lamps", "houses"), ("roads", "roads")];
    let (mut count, mut rows) = (0, 0);
    for predicate in predicates {
        let on = predicate.replace("{a}", "a.geom").replace("{b}", "b.geom");
        for (a, b) in tables {
            // Predicates without an index are slow.
            if predicate.contains(" OR ") && a != "lamps" {
                continue;
            }
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
                // Predicates without an index are slow.
                if predicate.contains(" OR a.fid") || predicate.contains("NOT") {
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
        // The single nearest row is found without SQLite computing any distance.
        let sql = format!(
            "SELECT a.fid, (SELECT b.fid FROM {b} b ORDER BY b.geom <-> a.geom LIMIT 1) AS n FROM {a} a WHERE a.geom IS NOT NULL"
        );
        let written = format!(
            "SELECT a.fid, (SELECT b.fid FROM {b} b WHERE b.geom IS NOT NULL ORDER BY ST_Distance(b.geom, a.geom), b.fid LIMIT 1) AS n FROM {a} a WHERE a.geom IS NOT NULL"
        );
        let fast = database.query(&sql, &[], &budget()).unwrap();
        assert_eq!(lists(&fast), plain_rows(&database, &written, &[]), "{sql}");
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
        answer.iter().map(|row| row[0].to_string()).collect()
    };
    assert_eq!(fids("SELECT levels FROM houses LIMIT 7"), ["1", "2", "3", "4", "5", "1", "2"]);
    assert_eq!(fids("SELECT fid FROM houses ORDER BY levels LIMIT 4"), ["1", "6", "11", "16"]);
    // Nulls come last, and first in descending order.
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
    let pairs: Vec<String> = joined.iter().map(|row| format!("{}{}", row[0], row[1])).collect();
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
            // The placeholders of the form are replaced first, because conditions contain placeholders as well.
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

#[test]
fn subqueries_laterals_and_least_distances_give_the_rows_of_plain_statements() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 90);
    let pairs = [
        (
            "SELECT x.fid, y.fid AS other FROM (SELECT * FROM houses WHERE levels > 2) x JOIN (SELECT fid, geom FROM houses WHERE fid % 2 = 0) y ON ST_DWithin(x.geom, y.geom, 5)",
            "SELECT a.fid, b.fid AS other FROM houses a JOIN houses b ON ST_Distance(a.geom, b.geom) + 0 <= 5 WHERE a.levels > 2 AND b.fid % 2 = 0",
        ),
        (
            "SELECT x.fid, count(y.fid) AS n FROM (SELECT * FROM houses) x LEFT JOIN (SELECT * FROM lamps WHERE fid > $k) y ON ST_DWithin(x.geom, y.geom, 9) GROUP BY x.fid",
            "SELECT a.fid, count(b.fid) AS n FROM houses a LEFT JOIN lamps b ON ST_Distance(a.geom, b.geom) + 0 <= 9 AND b.fid > $k GROUP BY a.fid",
        ),
        (
            "WITH a AS (SELECT fid, ST_Buffer(geom, 2) AS around FROM houses), b AS (SELECT fid, ST_Buffer(geom, 1) AS around FROM lamps) SELECT a.fid, b.fid AS lamp FROM a, b WHERE ST_Intersects(a.around, b.around)",
            "SELECT a.fid, b.fid AS lamp FROM houses a, lamps b WHERE CASE WHEN ST_Intersects(ST_Buffer(a.geom, 2), ST_Buffer(b.geom, 1)) THEN 1 END = 1",
        ),
        (
            "SELECT * FROM (SELECT fid, geom FROM lamps) x JOIN (SELECT fid AS house, geom AS place FROM houses) y ON ST_Intersects(x.geom, y.place)",
            "SELECT a.fid, a.geom, b.fid AS house, b.geom AS place FROM lamps a JOIN houses b ON CASE WHEN ST_Intersects(a.geom, b.geom) THEN 1 END = 1",
        ),
        (
            "SELECT h.fid, min(ST_Distance(h.geom, r.geom)) AS far FROM houses h, roads r GROUP BY h.fid",
            "SELECT h.fid, (SELECT min(0 + ST_Distance(h.geom, r.geom)) FROM roads r) AS far FROM houses h",
        ),
        (
            "SELECT h.fid, max(h.levels) AS levels, min(ST_Distance(o.geom, h.geom)) AS far FROM houses h JOIN houses o ON h.fid <> o.fid AND o.levels = 3 WHERE h.levels < 4 GROUP BY h.fid HAVING min(ST_Distance(o.geom, h.geom)) < 20",
            "SELECT h.fid, h.levels AS levels, (SELECT min(0 + ST_Distance(h.geom, o.geom)) FROM houses o WHERE o.levels = 3 AND o.fid <> h.fid) AS far FROM houses h WHERE h.levels < 4 AND (SELECT min(0 + ST_Distance(h.geom, o.geom)) FROM houses o WHERE o.levels = 3 AND o.fid <> h.fid) < 20",
        ),
        (
            "SELECT h.levels, min(ST_Distance(h.geom, r.geom)) AS far FROM houses h LEFT JOIN roads r ON r.fid < 0 GROUP BY h.levels",
            "SELECT DISTINCT levels, NULL AS far FROM houses",
        ),
        (
            "SELECT h.fid, near.fid AS road, near.far FROM houses h CROSS JOIN LATERAL (SELECT r.fid, r.geom <-> h.geom AS far FROM roads r ORDER BY far, r.fid LIMIT 2) near WHERE h.geom IS NOT NULL",
            "SELECT fid, road, far FROM (SELECT h.fid, r.fid AS road, 0 + ST_Distance(r.geom, h.geom) AS far, row_number() OVER (PARTITION BY h.fid ORDER BY 0 + ST_Distance(r.geom, h.geom), r.fid) AS n FROM houses h, roads r WHERE h.geom IS NOT NULL) WHERE n < 3",
        ),
        (
            "SELECT h.fid, s.n, s.least FROM houses h LEFT JOIN LATERAL (SELECT count(*) AS n, min(l.fid) AS least FROM lamps l WHERE ST_DWithin(l.geom, h.geom, 12)) s ON true",
            "SELECT h.fid, (SELECT count(*) FROM lamps l WHERE 0 + ST_Distance(l.geom, h.geom) <= 12) AS n, (SELECT min(l.fid) FROM lamps l WHERE 0 + ST_Distance(l.geom, h.geom) <= 12) AS least FROM houses h",
        ),
        (
            "SELECT h.fid, t.twice + 1 AS more FROM houses h, LATERAL (SELECT h.levels * 2 AS twice) t",
            "SELECT fid, levels * 2 + 1 AS more FROM houses",
        ),
        (
            "SELECT DISTINCT ON (levels) levels, fid, name FROM houses ORDER BY levels, height DESC",
            "SELECT levels, fid, name FROM (SELECT levels, fid, name, row_number() OVER (PARTITION BY levels ORDER BY height DESC NULLS FIRST, fid) AS n FROM houses) WHERE n = 1",
        ),
        (
            "SELECT fid FROM houses WHERE levels = 4 AND fid <> 7 ORDER BY geom <-> $g LIMIT 6",
            "SELECT fid FROM (SELECT fid, row_number() OVER (ORDER BY 0 + ST_Distance(geom, $g) NULLS LAST, fid) AS n FROM houses WHERE levels = 4 AND fid <> 7) WHERE n <= 6",
        ),
    ];
    let parameters = [
        ("g", Cell::Geometry(Arc::new(Geometry::from_wkt("POINT(385050 6672050)").unwrap()))),
        ("k", Cell::Number(20.0)),
    ];
    let (mut count, mut total) = (0, 0);
    for (written, plain) in pairs {
        // Runs twice, because materialized subqueries may be kept.
        for _ in 0..2 {
            let answer = database.query(written, &parameters, &budget());
            let answer = answer.unwrap_or_else(|error| panic!("{written}: {error}"));
            let mut rows = lists(&answer);
            rows.sort_by(|a, b| {
                a.iter()
                    .zip(b)
                    .map(|(a, b)| a.order(b))
                    .find(|it| it.is_ne())
                    .unwrap_or(std::cmp::Ordering::Equal)
            });
            assert_eq!(rows, plain_rows(&database, plain, &parameters), "{written}");
            total += rows.len();
        }
        count += 1;
    }
    assert!(count == 12 && total > 1000, "{count} {total}");
}
