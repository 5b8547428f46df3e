#!/usr/bin/env bash
# Runs a command with BURGEON_POSTGIS naming an empty PostGIS server on loopback, which is installed where it is missing,
# and BURGEON_POSTGIS_CA its certificate, and ends with the command: tests/postgis.sh cargo test -p burgeon-sources
set -euo pipefail

programs=/usr/lib/postgresql/15/bin
port=${BURGEON_POSTGIS_PORT:-54329}
if [ ! -x "$programs/initdb" ] || [ ! -e /usr/share/postgresql/15/extension/postgis.control ]; then
  apt-get update -q
  DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends postgresql-15-postgis-3
fi

folder=$(mktemp -d)
data=$folder/data
# The server refuses to run as root.
as=(env)
if [ "$(id -u)" -eq 0 ]; then
  chmod 755 "$folder"
  install -d -o postgres "$data"
  as=(runuser -u postgres --)
else
  mkdir "$data"
fi
stop() {
  "${as[@]}" "$programs/pg_ctl" -D "$data" -m immediate stop >/dev/null 2>&1 || true
  rm -rf "$folder"
}
trap stop EXIT

cd "$folder"
"${as[@]}" "$programs/initdb" -D "$data" -U postgres -A trust -E UTF8 --locale=C.UTF-8 -N >/dev/null
# A certificate for localhost, signed by itself.
if command -v openssl >/dev/null; then
  openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 30 -subj /CN=localhost \
    -addext subjectAltName=DNS:localhost -keyout "$folder/server.key" -out "$folder/server.crt" 2>/dev/null
  "${as[@]}" install -m 600 /dev/null "$data/server.key"
  cat "$folder/server.key" > "$data/server.key"
  cp "$folder/server.crt" "$data/server.crt"
  chmod 644 "$folder/server.crt" "$data/server.crt"
  export BURGEON_POSTGIS_CA=$folder/server.crt
  ssl="-c ssl=on -c ssl_cert_file=server.crt -c ssl_key_file=server.key"
fi
"${as[@]}" "$programs/pg_ctl" -D "$data" -w -l "$data/log" \
  -o "-c listen_addresses=127.0.0.1 -p $port -k $data -c fsync=off -c jit=off ${ssl:-}" start >/dev/null
psql=("$programs/psql" -q -h 127.0.0.1 -p "$port" -U postgres -v ON_ERROR_STOP=1)
"${psql[@]}" -d postgres -c "CREATE DATABASE town"
"${psql[@]}" -d town -c "CREATE EXTENSION postgis"
cd "$OLDPWD"
BURGEON_POSTGIS="postgres://postgres@127.0.0.1:$port/town" "$@"
