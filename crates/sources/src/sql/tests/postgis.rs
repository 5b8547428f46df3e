//! The same statements give the same rows here and on a server, if `BURGEON_POSTGIS` names a server to which data may
//! be written.

use super::postgis_connections::{check_encryption, check_lost_connection};
use super::*;
use crate::sql::postgis::{Server, ServerAddress};

/// Returns the server's address, or `None` without a server for tests.
fn address() -> Option<ServerAddress> {
    let found = std::env::var("BURGEON_POSTGIS").ok();
    if found.is_none() {
        eprintln!("left out: BURGEON_POSTGIS names no PostGIS server");
    }
    found.map(|address| ServerAddress::parse(&address).unwrap())
}

/// Returns a connection that may write.
pub(super) fn writer() -> postgres::Client {
    postgres::Client::connect(&std::env::var("BURGEON_POSTGIS").unwrap(), postgres::NoTls).unwrap()
}

/// Writes the tables of a GeoPackage into a schema of the server.
fn fill(path: &Path, schema: &str, layers: &[(&str, &str)]) {
    let source = rusqlite::Connection::open(path).unwrap();
    let mut client = writer();
    client.batch_execute(&format!("DROP SCHEMA IF EXISTS {schema} CASCADE; CREATE SCHEMA {schema}")).unwrap();
    for (layer, columns) in layers {
        client.batch_execute(&format!("CREATE TABLE {schema}.{layer} (fid int PRIMARY KEY, geom geometry(Geometry, 3067), {columns})")).unwrap();
        let mut statement = source.prepare(&format!("SELECT * FROM {layer} ORDER BY fid")).unwrap();
        let mut rows = statement.query([]).unwrap();
        let mut batch = String::new();
        while let Some(row) = rows.next().unwrap() {
            let values: Vec<String> = (0..columns.split(',').count() + 2)
                .map(|index| match row.get_ref(index).unwrap() {
                    rusqlite::types::ValueRef::Null => "NULL".to_owned(),
                    rusqlite::types::ValueRef::Integer(value)
                        if columns
                            .split(',')
                            .nth(index.wrapping_sub(2))
                            .is_some_and(|it| it.contains("bool")) =>
                    {
                        (value != 0).to_string()
                    }
                    rusqlite::types::ValueRef::Integer(value) => value.to_string(),
                    rusqlite::types::ValueRef::Real(value) => format!("{value:?}"),
                    rusqlite::types::ValueRef::Text(text) => format!("'{}'", String::from_utf8_lossy(text)),
                    rusqlite::types::ValueRef::Blob(bytes) => {
                        let geometry = blob::read(bytes, &Budget::default()).unwrap();
                        format!("ST_GeomFromText('{}', 3067)", geometry.to_wkt())
                    }
                })
                .collect();
            batch += &format!("INSERT INTO {schema}.{layer} VALUES ({});", values.join(", "));
        }
        client.batch_execute(&batch).unwrap();
        client
            .batch_execute(&format!(
                "CREATE INDEX ON {schema}.{layer} USING gist (geom); ANALYZE {schema}.{layer}"
            ))
            .unwrap();
    }
    client
        .batch_execute(&format!("ALTER DATABASE {} SET search_path = {schema}, public", database_name()))
        .unwrap();
}

fn database_name() -> String {
    address().unwrap().database
}

const LAYERS: [(&str, &str); 3] = [
    ("houses", "name text, height float8, levels int, part bool"),
    ("roads", "kind text"),
    ("lamps", "lit bool"),
];

/// Statements that both accept.
const STATEMENTS: [&str; 36] = [
    "SELECT * FROM houses",
    "SELECT fid, name, height, levels, part FROM houses WHERE levels > 2",
    "SELECT a.fid, b.fid AS other FROM houses a JOIN houses b ON ST_Intersects(a.geom, b.geom) AND a.fid < b.fid",
    "SELECT a.fid, b.fid AS other FROM houses a, houses b WHERE a.fid < b.fid AND ST_Overlaps(a.geom, b.geom)",
    "SELECT h.fid, l.fid AS lamp FROM houses h, lamps l WHERE ST_Contains(h.geom, l.geom)",
    "SELECT l.fid, h.fid AS house FROM lamps l LEFT JOIN houses h ON ST_Within(l.geom, h.geom)",
    "SELECT h.fid, r.fid AS road FROM roads r JOIN houses h ON ST_Crosses(r.geom, h.geom)",
    "SELECT fid FROM houses a WHERE NOT EXISTS (SELECT 1 FROM houses b WHERE a.fid <> b.fid AND ST_Intersects(a.geom, b.geom))",
    "SELECT fid FROM houses a WHERE NOT EXISTS (SELECT 1 FROM roads r WHERE ST_DWithin(a.geom, r.geom, 3))",
    "SELECT fid FROM houses WHERE ST_DWithin(geom, $g, $d)",
    "SELECT fid FROM houses WHERE ST_Intersects(geom, ST_Buffer($g, $d))",
    "SELECT fid FROM houses ORDER BY ST_Distance(geom, $g) LIMIT 5",
    "SELECT fid FROM houses WHERE levels = $n ORDER BY geom <-> $g LIMIT 3",
    "SELECT l.fid, (SELECT r.fid FROM roads r ORDER BY r.geom <-> l.geom LIMIT 1) AS road FROM lamps l",
    "SELECT fid, ST_Area(geom) AS area, ST_Perimeter(geom) AS perimeter, ST_NPoints(geom) AS n FROM houses",
    "SELECT fid, ST_Length(geom) AS length, ST_NumPoints(geom) AS n, ST_X(ST_StartPoint(geom)) AS x FROM roads",
    "SELECT fid, ST_XMin(geom) AS w, ST_YMin(geom) AS s, ST_XMax(geom) AS e, ST_YMax(geom) AS n FROM houses",
    "SELECT fid, ST_Centroid(geom) AS c, ST_Envelope(geom) AS e FROM houses",
    "SELECT fid, ST_LineInterpolatePoint(geom, 0.5) AS middle, ST_EndPoint(geom) AS last FROM roads",
    "SELECT fid, ST_Azimuth(geom, $g) AS way, ST_Distance(geom, $g) AS far FROM lamps",
    "SELECT l.fid, ST_ClosestPoint(r.geom, l.geom) AS at FROM lamps l JOIN roads r ON ST_DWithin(l.geom, r.geom, 9)",
    "SELECT levels, count(*) AS n, avg(height) AS height, max(name) AS name FROM houses GROUP BY levels ORDER BY n DESC, levels",
    "SELECT kind, count(*) AS n FROM roads GROUP BY kind HAVING count(*) > 2",
    "SELECT DISTINCT levels FROM houses",
    "SELECT levels AS n FROM houses WHERE fid < 5 UNION ALL SELECT fid FROM lamps WHERE fid < 4",
    "WITH tall AS (SELECT * FROM houses WHERE levels > 3) SELECT t.fid, r.fid AS road FROM tall t JOIN roads r ON ST_Intersects(t.geom, r.geom)",
    "SELECT fid, name FROM houses ORDER BY name LIMIT 6",
    "SELECT fid, name FROM houses ORDER BY name DESC LIMIT 6",
    "SELECT fid, name IS NULL AS none, part, NOT part AS whole FROM houses WHERE name LIKE 'house 1%' OR name IS NULL",
    "SELECT fid, round(ST_Length(ST_OffsetCurve(geom, 0.5, 'join=mitre'))) AS left, ST_Distance(ST_OffsetCurve(geom, -2), geom) AS far FROM roads",
    "SELECT fid, ST_IsValid(geom) AS valid, round(ST_Area(ST_MakeValid(ST_GeomFromText('POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))')))) AS area FROM houses LIMIT 3",
    "SELECT fid FROM houses WHERE name = $t",
    "SELECT fid FROM houses WHERE fid <> $id AND levels = $n",
    "SELECT fid, coalesce(name, 'nobody') AS name, round(height + 0.1) AS height, upper(name) AS loud FROM houses",
    "SELECT fid, CASE WHEN levels > $n THEN 'high' ELSE 'low' END AS kind FROM houses LIMIT 9",
    "SELECT fid FROM houses WHERE levels IN (1, 3) AND height BETWEEN 3 AND 10 LIMIT 7 OFFSET 4",
];

#[test]
fn a_server_gives_the_same_rows() {
    let Some(address) = address() else { return };
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 400);
    fill(&folder.path().join("town.gpkg"), "burgeon_same", &LAYERS);
    let server = Server::new(&address, Some(std::time::Duration::from_secs(60)));
    let at = Geometry::from_wkt("POINT(385100 6672100)").unwrap();
    let parameters = [
        ("g", Cell::Geometry(Arc::new(at))),
        ("d", Cell::Number(25.5)),
        ("n", Cell::Number(3.0)),
        ("id", Cell::Text("12".into())),
        ("t", Cell::Text("house 7".into())),
    ];
    let (mut count, mut total) = (0, 0);
    for sql in STATEMENTS {
        let here = database.query(sql, &parameters, &budget()).unwrap();
        let there = server.query(sql, &parameters, None, &budget()).unwrap();
        assert_eq!(here.names, there.names, "{sql}");
        assert_eq!(here.len(), there.len(), "{sql}");
        for (a, b) in here.iter().zip(there.iter()) {
            for (a, b) in a.iter().zip(b) {
                assert!(is_same(a, b), "{sql}: {a} here, {b} there");
            }
        }
        count += 1;
        total += here.len();
    }
    assert!(count >= 25 && total > 3000, "{count} statements, {total} rows");
    let other = tempfile::tempdir().unwrap();
    meaning(other.path(), &server);
    schemas(&address);
    check_encryption(&address);
    safety(&server);
    check_lost_connection(&server);
    layers(&server);
    odd(&address);
}

/// Expressions with a different result here, as the book documents: GeoJSON names the run's projection also for
/// geometries that a statement creates, and boxes run counter-clockwise.
const DIFFERENT: [&str; 6] = [
    "ST_AsGeoJSON(geom)",
    "ST_AsGeoJSON(ST_MakePoint(1.0 / 3, 2, 3))",
    "ST_AsGeoJSON('POLYGON((0 0,1 0,1 1,0 0))'::geometry, 2)",
    "ST_AsGeoJSON('GEOMETRYCOLLECTION(POINT(1 1),LINESTRING(0 0,1 1))'::geometry)",
    "ST_AsGeoJSON('POINT EMPTY'::geometry)",
    "ST_AsText(ST_Envelope(geom))",
];

/// Checks that expressions and statements have the same meaning here and on the server, except those in [`DIFFERENT`],
/// and that those refused by the server are refused here.
fn meaning(folder: &Path, server: &Server) {
    let (database, frame) = meaning::town_in_frame(folder, 400);
    let mut different = String::new();
    let expressions = meaning::EXPRESSIONS.map(|expression| (meaning::statement(expression), expression));
    let statements = meaning::STATEMENTS.map(|sql| (sql.to_owned(), sql));
    for (sql, shown) in expressions.into_iter().chain(statements) {
        let (here, there) =
            (database.query(&sql, &[], &budget()), server.query(&sql, &[], Some(&frame), &budget()));
        let same = match (&here, &there) {
            (Ok(here), Ok(there)) => {
                here.names == there.names
                    && here.len() == there.len()
                    && here.values.iter().zip(there.values.iter()).all(|(a, b)| is_same(a, b))
            }
            (Err(_), Err(_)) => true,
            _ => false,
        };
        if same == DIFFERENT.contains(&shown) {
            let shown_of = |answer: Result<QueryRows<Cell>, burgeon_base::error::Error>| match answer {
                Ok(answer) => answer.to_string().chars().take(600).collect(),
                Err(error) => error.to_string(),
            };
            different += &format!("{shown}\n  here: {}\n  there: {}\n", shown_of(here), shown_of(there));
        }
    }
    assert!(different.is_empty(), "{different}");
}

/// Checks that tables of other schemas are layers, and are found by their qualified names or by the search path.
fn schemas(address: &ServerAddress) {
    writer()
        .batch_execute(
            "CREATE SCHEMA burgeon_other; CREATE TABLE burgeon_other.houses (fid int PRIMARY KEY, geom geometry(Geometry, 3067), wing text);
             INSERT INTO burgeon_other.houses SELECT n, ST_SetSRID(ST_MakePoint(385000 + n, 6672000), 3067), 'w' FROM generate_series(1, 7) n;
             CREATE TABLE burgeon_other.wells (fid int PRIMARY KEY, geom geometry(Point, 3067));
             INSERT INTO burgeon_other.wells SELECT fid, geom FROM burgeon_other.houses",
        )
        .unwrap();
    let server = Server::new(address, None);
    let read = |server: &Server, layer: &str| {
        let wanted = burgeon_data::SourceOptions {
            layer: Some(layer.to_owned()),
            ..burgeon_data::SourceOptions::default()
        };
        server.read(&wanted).map(|table| table.features.len())
    };
    assert_eq!(read(&server, "burgeon_other.houses").unwrap(), 7);
    assert_eq!(read(&server, "houses").unwrap(), 396);
    assert!(read(&server, "wells").is_err());
    let count = |server: &Server, sql: &str| {
        server.query(sql, &[], None, &budget()).map(|answer| answer.row(0)[0].clone())
    };
    assert_eq!(
        count(
            &server,
            "SELECT count(*) FROM burgeon_other.houses h JOIN burgeon_other.wells w ON h.fid = w.fid"
        )
        .unwrap(),
        Cell::Number(7.0)
    );
    assert!(count(&server, "SELECT count(*) FROM wells").is_err());
    assert!(count(&server, "SELECT count(*) FROM pg_catalog.pg_authid").is_err());
    let text = format!("{}?search_path=burgeon_other,public", std::env::var("BURGEON_POSTGIS").unwrap());
    let other = Server::new(&ServerAddress::parse(&text).unwrap(), None);
    assert_eq!(count(&other, "SELECT count(*) FROM wells").unwrap(), Cell::Number(7.0));
    assert_eq!(read(&other, "houses").unwrap(), 7);
    let listing = server.listing(&budget()).unwrap();
    let names: Vec<&str> = listing.layers.iter().map(|layer| layer.name.as_str()).collect();
    assert_eq!(names, ["burgeon_other.houses", "burgeon_other.wells", "houses", "lamps", "roads"]);
    assert_eq!(listing.layers[2].records, 396);
    writer().batch_execute("DROP SCHEMA burgeon_other CASCADE").unwrap();
}

/// Reports whether two values are equal, except for rounding differences between engines.
fn is_same(a: &Cell, b: &Cell) -> bool {
    match (a, b) {
        (Cell::Number(a), Cell::Number(b)) => (a - b).abs() <= 1e-6 * (1.0 + a.abs().min(1e3)),
        (Cell::Geometry(a), Cell::Geometry(b)) => {
            let near = a.points().zip(b.points()).all(|(a, b)| a.distance(*b) < 1e-6);
            near && a.points().count() == b.points().count()
                || a.bounds().zip(b.bounds()).is_some_and(|(a, b)| {
                    a[0].distance(b[0]) < 1e-6 && a[1].distance(b[1]) < 1e-6 && a[0] != a[1]
                })
        }
        (a, b) => a == b,
    }
}

/// Checks that a server is only read, and that a statement can only be a query.
fn safety(server: &Server) {
    for sql in [
        "DELETE FROM houses",
        "INSERT INTO lamps VALUES (9999)",
        "SELECT 1; DROP TABLE houses",
        "WITH gone AS (DELETE FROM houses RETURNING *) SELECT * FROM gone",
        "SELECT pg_sleep(5)",
        "SELECT pg_read_file('/etc/passwd')",
        "SELECT * FROM pg_shadow",
        "SELECT * FROM pg_catalog.pg_authid",
        "SELECT * FROM pg_ls_dir('/')",
        "SELECT set_config('transaction_read_only', 'off', false)",
        "SELECT lo_import('/etc/passwd')",
        "SELECT random()",
        "SELECT now()",
        "SELECT CURRENT_TIMESTAMP",
        "SELECT CURRENT_USER",
        "SELECT dblink('a', 'b')",
        "SELECT query_to_xml('DELETE FROM houses', true, true, '')",
        "SELECT * INTO other FROM houses",
        "SELECT fid FROM houses FOR UPDATE",
        "SET TRANSACTION READ WRITE",
        "COPY houses TO '/tmp/x'",
    ] {
        let answer = server.query(sql, &[], None, &budget());
        assert!(answer.is_err(), "{sql}");
    }
    let evil = [("t", Cell::Text("x'; DROP TABLE houses; --".into()))];
    assert!(
        server
            .query("SELECT fid FROM houses WHERE name = $t", &evil, None, &budget())
            .unwrap()
            .values
            .is_empty()
    );
    let count = server.query("SELECT count(*) AS n FROM houses", &[], None, &budget()).unwrap();
    assert_eq!(count.values, [Cell::Number(400.0)]);
    let mut told = String::new();
    for sql in [
        "SELECT heigth FROM houses",
        "SELECT fid\nFROM house",
        "SELECT ST_Aera(geom) FROM houses",
        "SELECT fid FROM houses WHERE height > > 3",
        "SELECT fid FROM houses WHERE fid = $nobody",
        "SELECT levels + name FROM houses",
    ] {
        told += &format!("{sql}\n-> {}\n", server.query(sql, &[], None, &budget()).unwrap_err());
    }
    insta::assert_snapshot!(told, @r"
    SELECT heigth FROM houses
    -> SQL, line 1, column 8: no column called heigth
      help: did you mean height?
    SELECT fid
    FROM house
    -> SQL, line 2, column 6: no table called house
      help: did you mean houses?
    SELECT ST_Aera(geom) FROM houses
    -> SQL, line 1, column 8: function st_aera(geometry) does not exist
      help: did you mean ST_Area?
    SELECT fid FROM houses WHERE height > > 3
    -> SQL, line 1, column 39: expected: an expression, found: >
      help: write SQL that both SQLite and PostgreSQL take: SELECT ... FROM ... WHERE ...
    SELECT fid FROM houses WHERE fid = $nobody
    -> SQL, line 1, column 36: $nobody has no value
      help: hand one over: query(sql, { nobody = ... })
    SELECT levels + name FROM houses
    -> SQL: operator does not exist: integer + text
      help: No operator matches the given name and argument types. You might need to add exp...
    ");
    // The query is endless.
    let begin = std::time::Instant::now();
    let endless =
        "SELECT count(*) FROM houses a, houses b, houses c, houses d WHERE ST_Distance(a.geom, d.geom) > 1";
    let short = Budget::within(std::time::Duration::from_millis(400), 1_000_000_000);
    let error = server.query(endless, &[], None, &short).unwrap_err();
    assert_eq!(error.kind().code(), "limit.time", "{error}");
    assert!(begin.elapsed() < std::time::Duration::from_secs(10));
    let small = Budget::within(std::time::Duration::from_secs(60), 100_000);
    let error = server.query("SELECT a.fid FROM houses a, houses b", &[], None, &small).unwrap_err();
    assert_eq!(error.kind().code(), "limit.memory", "{error}");
}

/// Checks types that other programs also use, and geometries that cannot be read: their rows are named, and other rows
/// are returned.
fn odd(address: &ServerAddress) {
    writer()
        .batch_execute(
            "CREATE TYPE odd_kind AS ENUM ('low', 'high'); CREATE DOMAIN odd_size AS float8 CHECK (value > 0);
             CREATE TABLE odd (gid int PRIMARY KEY, geom geometry(Geometry, 3067), day date, at timestamp, marks int[],
               kind odd_kind, size odd_size, bytes bytea, price numeric(8, 2), around geometry);
             INSERT INTO odd SELECT n, ST_SetSRID(ST_MakePoint(385000 + n, 6672000), 3067), '2024-02-29',
               '2024-02-29 12:30:00', ARRAY[n, 2], 'high', n / 4.0, '\\x0102', 1.25, NULL FROM generate_series(1, 6) n;
             UPDATE odd SET geom = ST_SetSRID(ST_MakePoint(385000, 'NaN'), 3067) WHERE gid = 2;
             UPDATE odd SET geom = ST_SetSRID(ST_MakeLine(ST_MakePoint(1, 1), ST_MakePoint('Infinity', 1)), 3067) WHERE gid = 4;
             UPDATE odd SET geom = ST_GeomFromEWKT('SRID=3067;CIRCULARSTRING(0 0, 1 1, 2 0)'),
               around = ST_MakePoint('NaN', 0) WHERE gid = 5",
        )
        .unwrap();
    let server = Server::new(address, Some(std::time::Duration::from_secs(60)));
    let wanted = burgeon_data::SourceOptions {
        layer: Some("odd".to_owned()),
        ..burgeon_data::SourceOptions::default()
    };
    let table = server.read(&wanted).unwrap();
    let ids: Vec<&str> = table.features.iter().map(|feature| &*feature.id).collect();
    assert_eq!(ids, ["1", "3", "5", "6"]);
    let refused: Vec<String> = table.refused.iter().map(|(id, error)| format!("{id}: {error}")).collect();
    insta::assert_snapshot!(refused.join("\n").replace(&*table.shown, "town:odd"), @r#"
    2: the geometry of feature 2 of town:odd has a coordinate that is no finite number
      help: repair it in the database, or leave it out: where = "..."
    4: the geometry of feature 4 of town:odd has a coordinate that is no finite number
      help: repair it in the database, or leave it out: where = "..."
    "#);
    let first: Vec<String> = (table.features[1].attributes.iter())
        .map(|(name, value)| format!("{} {value:?}", table.names[*name]))
        .collect();
    insta::assert_snapshot!(first.join("\n"), @r#"
    day Text("2024-02-29")
    at Text("2024-02-29 12:30:00")
    marks Text("{3,2}")
    kind Text("high")
    size Number(0.75)
    price Number(1.25)
    "#);
    let told = |sql: &str| server.query(sql, &[], None, &budget()).unwrap_err().to_string();
    insta::assert_snapshot!(
        ["SELECT gid, geom FROM odd", "SELECT geom FROM odd WHERE gid > 3 ORDER BY gid", "SELECT day FROM odd"].map(told).join("\n"),
        @r#"
    SQL: the column geom has a geometry that has a coordinate that is no finite number (the row with gid 2)
      help: repair it, or leave its row out: WHERE ...
    SQL: the column geom has a geometry that has a coordinate that is no finite number (row 1)
      help: repair it, or leave its row out: WHERE ...
    SQL: the column day is of type date; make it text: ...::text
      help: ask for numbers, texts, true or false, geometries, or lists of them
    "#
    );
    let rows = server.query("SELECT gid, kind, size, price FROM odd WHERE gid = 3", &[], None, &budget());
    assert_eq!(
        rows.unwrap().values,
        [Cell::Number(3.0), Cell::Text("high".into()), Cell::Number(0.75), Cell::Number(1.25)]
    );
    writer().batch_execute("DROP TABLE odd; DROP TYPE odd_kind; DROP DOMAIN odd_size").unwrap();
}

/// Checks that a table is a layer.
fn layers(server: &Server) {
    let read = |layer: Option<&str>, condition: Option<&str>, limit: Option<usize>| {
        let wanted = burgeon_data::SourceOptions {
            layer: layer.map(str::to_owned),
            condition: condition.map(str::to_owned),
            limit,
            ..burgeon_data::SourceOptions::default()
        };
        server.read(&wanted)
    };
    let table = read(Some("houses"), None, None).unwrap();
    assert_eq!((table.records, table.empty), (396, 4));
    assert_eq!(table.names, ["name", "height", "levels", "part"]);
    assert_eq!(table.crs.as_ref().unwrap().name(), "EPSG:3067");
    assert_eq!(table.features[1].id, "2");
    let some = read(Some("houses"), Some("height > 10 AND part"), Some(7)).unwrap();
    assert_eq!(some.features.len(), 7);
    // Two parts of one table are ambiguous.
    let error = server.query("SELECT count(*) AS n FROM houses", &[], None, &budget()).unwrap_err();
    assert_eq!(error.message(), "there are two tables called houses");
    let server = &Server::new(&address().unwrap(), None);
    let count = |sql: &str| match server.query(sql, &[], None, &budget()).unwrap().values.as_slice() {
        [count] => count.clone(),
        counts => panic!("{counts:?}"),
    };
    let all = count("SELECT count(*) AS n FROM houses WHERE height > 10 AND part");
    let condition = Some("height > 10 AND part -- a part");
    let wanted = burgeon_data::SourceOptions {
        layer: Some("houses".into()),
        condition: condition.map(str::to_owned),
        ..burgeon_data::SourceOptions::default()
    };
    server.read(&wanted).unwrap();
    assert_eq!(count("SELECT count(*) AS n FROM houses"), all);
    assert_eq!(count("SELECT count(*) AS n FROM Houses h JOIN houses o ON h.fid = o.fid"), all);
    let counted = count("SELECT count(*) AS n FROM roads r WHERE 5 < (SELECT count(*) FROM houses)");
    assert!(matches!(counted, Cell::Number(_)), "{counted}");
    for (layer, condition) in [
        (None, None),
        (Some("house"), None),
        (Some("houses"), Some("heigth > 3")),
        (Some("houses"), Some("pg_sleep(9) IS NULL")),
    ] {
        assert!(read(layer, condition, None).is_err());
    }
}
