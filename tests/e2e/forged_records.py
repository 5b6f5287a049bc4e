"""Results as nobody would write them: copies of real ones with cells, tables or bytes changed. Seeded: the
same changes every time."""
import contextlib
import os
import pathlib
import random
import shutil
import sqlite3

INTEGERS = [-1, 0, 1, 65533, 65536, 2**31, 2**40, 2**53 + 1, 2**62, 2**63 - 1, -2**63, 5 * 10**18]
REALS = [-1.0, 0.5, 1e300, -1e300, 1.7e308, float("inf"), float("-inf"), 5e-324]
TEXTS = ["", "abc", "12abc", "1e308", "inf", "nan", "-1", "9" * 30, "\x1b[2J\x1b]0;owned\x07", "\u009b31m",
         "a\nb\rc", "=1+1", "+1", "-2+3", "@SUM(A1)", "<script>alert(1)</script>", "x" * 100_000, "%s%n{}",
         "../../../etc/passwd", "\u202eabc", "'; DROP TABLE run; --", "0 s", "1 h", "1e30 s"]
BLOBS = [b"", b"\xff\xfe\x00\x80", b"\x1b[31m\x9b", b"x" * 2_000_000]
KEYS = ["ended_ns", "simulated_s", "seed", "control_period_s", "result", "warnings", "exit_status", "wall_s", "scenario",
        "profile", "fingerprint", "run_id", "error", "pace"]


def all_values(rng):
    """A value of any type; None is a null."""
    return rng.choice([rng.choice(INTEGERS), rng.choice(INTEGERS), rng.choice(REALS), rng.choice(TEXTS),
                       rng.choice(TEXTS), rng.choice(BLOBS), None])


def without_constraints(file, change):
    """Lets `change` write what the tables do not allow; they look afterwards as if they had."""
    with contextlib.closing(sqlite3.connect(file)) as database:
        before = database.execute("SELECT name, sql FROM sqlite_schema WHERE type = 'table'").fetchall()
        database.execute("PRAGMA writable_schema = ON")
        database.execute("UPDATE sqlite_schema SET sql = replace(replace(replace(sql, ' NOT NULL', ''),"
                         " ' INTEGER,', ','), ' REAL,', ',') WHERE type = 'table'")
        database.commit()
    with contextlib.closing(sqlite3.connect(file)) as database:
        try:
            change(database)
            database.commit()
        except sqlite3.DatabaseError:
            database.rollback()  # keys stay keys
        database.execute("PRAGMA writable_schema = ON")
        database.executemany("UPDATE sqlite_schema SET sql = ?2 WHERE name = ?1", before)
        database.commit()


def filled_tables(file):
    with contextlib.closing(sqlite3.connect(file)) as database:
        names = [name for name, in database.execute("SELECT name FROM sqlite_schema WHERE type = 'table'"
                                                    " AND name NOT LIKE 'sqlite_%' ORDER BY 1")]
        return [name for name in names if database.execute(f"SELECT 1 FROM {name} LIMIT 1").fetchone()]


def columns_of(database, table):
    return [row[1] for row in database.execute(f"PRAGMA table_info({table})")]


def change_cell(file, rng):
    """One cell, or one column of all rows."""
    table = rng.choice(filled_tables(file))
    value, everywhere = all_values(rng), rng.random() < 0.2

    def change(database):
        column = rng.choice(columns_of(database, table))
        rows = database.execute(f"SELECT COUNT(*) FROM {table}").fetchone()[0]
        key = columns_of(database, table)[0]
        where = "" if everywhere else (f" WHERE {key} = (SELECT {key} FROM {table} LIMIT 1 OFFSET {rng.randrange(rows)})")
        database.execute(f"UPDATE OR IGNORE {table} SET {column} = ?{where}", (value,))

    without_constraints(file, change)


def change_key(file, rng):
    """A value of the table run."""
    key, value = rng.choice(KEYS), all_values(rng)
    without_constraints(file, lambda database: database.execute(
        "INSERT OR REPLACE INTO run VALUES (?, ?)", (key, value)))


def change_times(file, rng):
    """Times of one table: all far off, negative or in no order."""
    how = rng.choice(["9223372036854775807", "-1", "9e999", "abs(random() % 1000000000000)", "at_ns * 1000000000",
                      "abs(random())"])
    with contextlib.closing(sqlite3.connect(file)) as database:
        timed = [table for table in filled_tables(file) if "at_ns" in columns_of(database, table)]
    table = rng.choice(timed)
    without_constraints(file, lambda database: database.execute(f"UPDATE OR IGNORE {table} SET at_ns = {how}"))


def change_schema(file, rng):
    """Tables away, renamed, replaced or beside others that do harm."""
    table = rng.choice(filled_tables(file))
    endless = "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT"
    statements = [
        [f"DROP TABLE {table}"],
        [f"ALTER TABLE {table} RENAME TO elsewhere"],
        [f"DELETE FROM {table}"],
        ["DELETE FROM agents"],
        ["DELETE FROM run"],
        ["PRAGMA user_version = 99"],
        ["PRAGMA user_version = -1"],
        ["DROP VIEW verdict_sums", f"CREATE VIEW verdict_sums AS {endless} 'ack' AS class, 1 AS addressed,"
         " 'delivered' AS verdict, x AS count FROM c"],
        ["DROP VIEW message_ends", f"CREATE VIEW message_ends AS {endless} 1 AS sender, 2 AS destination,"
         " 'x' || x AS topic, 'delivered' AS verdict, x AS count, x AS bytes FROM c"],
        [f"DROP TABLE {table}", f"CREATE VIEW {table} AS {endless} x FROM c"],
        [f"ALTER TABLE {table} ADD COLUMN more GENERATED ALWAYS AS (hex(zeroblob(100000000))) VIRTUAL"],
        ["CREATE TRIGGER t BEFORE INSERT ON run BEGIN DELETE FROM agents; END"],
        [f"CREATE TABLE twice AS SELECT * FROM {table}", f"DROP TABLE {table}", f"ALTER TABLE twice RENAME TO {table}"],
        ["UPDATE OR REPLACE agents SET agent = 7"],
        ["UPDATE agents SET agent = agent + 1000"],
        ["UPDATE agents SET name = 'a'"],
        ["CREATE INDEX helpful ON agents (name)"],
        ["PRAGMA journal_mode = WAL"],
    ]
    with contextlib.closing(sqlite3.connect(file)) as database:
        for statement in rng.choice(statements):
            with contextlib.suppress(sqlite3.DatabaseError):
                database.execute(statement)
        database.commit()


def change_rows(file, rng):
    """Rows many times over."""
    table = rng.choice(filled_tables(file))
    with contextlib.closing(sqlite3.connect(file)) as database:
        for _ in range(rng.choice([1, 3, 6])):
            database.execute(f"INSERT OR IGNORE INTO {table} SELECT * FROM {table} LIMIT 20000")
        database.commit()


def change_bytes(file, rng):
    """As a disk, or an editor of bytes."""
    content = bytearray(file.read_bytes())
    what = rng.randrange(4)
    if what == 0:
        del content[rng.randrange(len(content)):]
    elif what == 1:  # of the header, or of the schema
        for _ in range(rng.choice([1, 3])):
            content[rng.randrange(100 if rng.random() < 0.5 else 4096)] = rng.randrange(256)
    elif what == 2:
        page = rng.randrange(len(content) // 4096)
        content[page * 4096:(page + 1) * 4096] = rng.choice([bytes(4096), rng.randbytes(4096)])
    else:
        for _ in range(rng.choice([1, 5, 50, 500])):
            content[rng.randrange(len(content))] = rng.randrange(256)
    file.write_bytes(content)


def change_remains(file, rng):
    """Files beside it that tell SQLite of work to be done, or the scenario."""
    folder = file.parent
    what = rng.randrange(4)
    if what == 0:
        (folder / (file.name + "-wal")).write_bytes(rng.randbytes(4096 * 3 + 32))
    elif what == 1:
        (folder / (file.name + "-journal")).write_bytes(
            bytes.fromhex("d9d505f920a163d7") + rng.randbytes(4096 * 2))
    elif what == 2:
        scenario = folder / "scenario.resolved.yaml"
        if scenario.exists():
            lines = scenario.read_text().splitlines(keepends=True)
            lines[rng.randrange(len(lines))] = rng.choice(["\x1b[31m: 1\n", "a: &a [*a]\n", "x: 1e308\n", "", "count: 1e9\n"])
            scenario.write_text("".join(lines))
    else:
        (folder / "run.log").write_bytes(rng.choice([b"[9223372036.000000000] info \x1b[31m: x\n" * 100,
                                                     rng.randbytes(100_000), b"[" + b"9" * 100_000]))


KINDS = [change_cell] * 9 + [change_key] * 3 + [change_times] * 2 + [change_schema] * 3 + [change_rows] + \
    [change_bytes] * 4 + [change_remains]


def forge(original, folder, seed):
    """A copy of a result or of a campaign, changed. @return what was done, for people."""
    rng = random.Random(seed)
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(original, folder)
    is_campaign = (folder / "campaign.sqlite").exists()
    file = folder / ("campaign.sqlite" if is_campaign else "run.sqlite")
    kinds = KINDS if not is_campaign else [change_cell] * 5 + [change_schema] * 2 + [change_bytes] * 2
    done = []
    for _ in range(rng.choice([1, 1, 1, 2])):
        kind = rng.choice(kinds)
        done.append(kind.__name__)
        try:
            kind(file, rng)
        except (sqlite3.DatabaseError, ValueError, IndexError, UnicodeError) as error:
            done[-1] += f" ({error})"  # after another change there may be nothing left to change
    return ", ".join(done)
