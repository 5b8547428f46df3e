//! Spatial queries in common notations use an index, as SQLite's plan shows.

use super::*;

/// Statements, and the table whose rows are found by key.
const FORMS: [(&str, &str); 32] = [
    ("SELECT a.fid, b.fid FROM houses a JOIN houses b ON ST_Intersects(a.geom, b.geom)", "b"),
    ("SELECT a.fid, b.fid FROM houses a, houses b WHERE ST_Intersects(a.geom, b.geom)", "b"),
    (
        "SELECT a.fid, b.fid FROM houses a, houses b WHERE a.fid < b.fid AND ST_Intersects(a.geom, b.geom)",
        "b",
    ),
    (
        "SELECT a.fid FROM houses a INNER JOIN houses AS b ON a.fid < b.fid AND ST_Intersects(a.geom, b.geom)",
        "b",
    ),
    (
        "SELECT a.fid, b.fid FROM houses a LEFT JOIN houses b ON ST_Intersects(a.geom, b.geom) AND a.fid <> b.fid",
        "b",
    ),
    (
        "SELECT fid FROM houses a WHERE NOT EXISTS (SELECT 1 FROM houses b WHERE a.fid <> b.fid AND ST_Intersects(a.geom, b.geom))",
        "b",
    ),
    (
        "SELECT fid FROM houses a WHERE NOT EXISTS (SELECT * FROM roads WHERE ST_DWithin(a.geom, roads.geom, 3))",
        "roads",
    ),
    (
        "SELECT fid FROM houses a WHERE EXISTS (SELECT 1 FROM houses b WHERE b.name = 'x' AND ST_Touches(b.geom, a.geom))",
        "b",
    ),
    ("SELECT fid FROM houses WHERE ST_Intersects(geom, $g)", "houses"),
    ("SELECT fid FROM houses WHERE ST_Intersects($g, geom) AND levels > 2", "houses"),
    ("SELECT fid FROM houses WHERE ST_DWithin(geom, $g, $d) ORDER BY height DESC", "houses"),
    ("SELECT count(*) FROM houses WHERE ST_Distance(geom, ST_MakePoint(385010, 6672010)) <= 20", "houses"),
    ("SELECT h.fid, l.fid FROM lamps l JOIN houses h ON ST_Contains(h.geom, l.geom)", "h"),
    ("SELECT h.fid, l.fid FROM lamps l, houses h WHERE ST_Within(l.geom, h.geom) AND h.levels = 3", "l"),
    ("SELECT h.fid, r.fid FROM houses h JOIN roads r ON ST_Crosses(r.geom, h.geom)", "h"),
    ("SELECT h.fid, r.fid FROM houses h JOIN roads r ON ST_Covers(h.geom, r.geom) WHERE h.fid = 4", "r"),
    (
        "SELECT a.fid FROM houses a JOIN houses b ON ST_Overlaps(a.geom, b.geom) JOIN lamps c ON ST_DWithin(b.geom, c.geom, 5)",
        "c",
    ),
    ("SELECT a.fid FROM houses a JOIN roads b ON ST_Intersects(ST_Buffer(a.geom, 3), b.geom)", "b"),
    ("SELECT a.fid FROM houses a JOIN roads b ON a.geom && b.geom", "a"),
    (
        "SELECT fid, (SELECT count(*) FROM lamps WHERE ST_DWithin(lamps.geom, h.geom, 10)) FROM houses h",
        "lamps",
    ),
    ("SELECT fid FROM roads ORDER BY ST_Distance(geom, $g) LIMIT 1", "roads"),
    ("SELECT h.fid, (SELECT r.fid FROM roads r ORDER BY h.geom <-> r.geom LIMIT 1) FROM houses h", "r"),
    (
        "WITH tall AS (SELECT * FROM houses WHERE levels > 3) SELECT r.fid FROM tall t JOIN roads r ON ST_Intersects(t.geom, r.geom)",
        "r",
    ),
    ("SELECT fid, geom <-> $g AS far FROM roads ORDER BY far LIMIT 3", "roads"),
    ("SELECT fid FROM houses WHERE levels = 3 AND name LIKE 'house%' ORDER BY geom <-> $g LIMIT 2", "houses"),
    ("SELECT fid FROM houses WHERE ST_Intersects(geom, $g) OR ST_DWithin(geom, $h, 5)", "houses"),
    (
        "SELECT a.fid, b.fid FROM houses a JOIN houses b ON ST_Touches(a.geom, b.geom) OR a.levels = 2 AND ST_DWithin(a.geom, b.geom, 1) OR b.fid = a.fid",
        "b",
    ),
    (
        "SELECT x.fid, y.fid FROM (SELECT * FROM houses WHERE levels > 2) x JOIN (SELECT fid, geom FROM roads WHERE kind = 'path') y ON ST_Intersects(x.geom, y.geom)",
        "y",
    ),
    (
        "SELECT x.fid, y.fid FROM (SELECT fid, ST_Buffer(geom, 2) AS around FROM houses) x, (SELECT fid, ST_Buffer(geom, 1) AS around FROM lamps) y WHERE ST_Intersects(x.around, y.around)",
        "y",
    ),
    (
        "WITH a AS (SELECT fid, geom FROM houses), b AS (SELECT fid, geom FROM lamps) SELECT a.fid, b.fid FROM a JOIN b ON ST_DWithin(a.geom, b.geom, 4)",
        "b",
    ),
    ("SELECT h.fid, min(ST_Distance(h.geom, r.geom)) AS far FROM houses h, roads r GROUP BY h.fid", "r"),
    (
        "SELECT h.fid, near.fid FROM houses h CROSS JOIN LATERAL (SELECT r.fid FROM roads r ORDER BY r.geom <-> h.geom LIMIT 2) near",
        "r",
    ),
];

#[test]
fn spatial_questions_as_people_write_them_look_rows_up_by_an_index() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 300);
    let mut count = 0;
    for (sql, looked_up) in FORMS {
        let plan = database.plan(sql, &budget()).unwrap();
        let search = format!("SEARCH {looked_up} ");
        let found = plan
            .lines()
            .any(|line| line.starts_with(&search) && line.contains("USING INTEGER PRIMARY KEY (rowid=?)"));
        assert!(found, "{sql}\n{plan}");
        assert!(!plan.contains("AUTOMATIC"), "{sql}\n{plan}");
        count += 1;
    }
    assert_eq!(count, FORMS.len());
}

#[test]
fn plans_are_told_after_the_rewriting() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 300);
    insta::assert_snapshot!(database.plan(FORMS[0].0, &budget()).unwrap(), @r"
    SCAN a
    SEARCH b USING INTEGER PRIMARY KEY (rowid=?)
    CORRELATED LIST SUBQUERY 1
    SCAN rarray VIRTUAL TABLE INDEX 1:
    ");
    insta::assert_snapshot!(database.plan(FORMS[5].0, &budget()).unwrap(), @r"
    SCAN a
    CORRELATED SCALAR SUBQUERY 2
    SEARCH b USING INTEGER PRIMARY KEY (rowid=?)
    CORRELATED LIST SUBQUERY 1
    SCAN rarray VIRTUAL TABLE INDEX 1:
    ");
}
