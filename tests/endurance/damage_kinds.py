"""What goes wrong with files: bits, pages and ends, and projects that somebody else has written."""

import sqlite3

PAGE = 8192


def _flip(data, random, end):
    for _ in range(random.randint(1, 20)):
        data[random.randrange(end)] ^= 1 << random.randrange(8)


def _overwrite(data, random, end):
    length = min(end, 2 ** random.randrange(12))
    at = random.randrange(end - length + 1)
    data[at : at + length] = random.randbytes(length)


def _cut(data, random, end):
    del data[random.randrange(end) :]


def _zero_page(data, random, end):
    at = random.randrange(end) // PAGE * PAGE
    data[at : at + PAGE] = bytes(min(PAGE, len(data) - at))


def _swap_pages(data, random, end):
    pages = max(1, len(data) // PAGE)
    one, other = random.randrange(pages) * PAGE, random.randrange(pages) * PAGE
    data[one : one + PAGE], data[other : other + PAGE] = data[other : other + PAGE], data[one : one + PAGE]


def _double(data, random, end):
    at = random.randrange(end)
    data[at:at] = data[at : at + random.randrange(1, 4096)]


def _huge_number(data, random, end):
    at = random.randrange(max(1, end - 4))
    data[at : at + 4] = random.choice((b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\0"))


FILE_DAMAGES = (_flip, _overwrite, _cut, _zero_page, _swap_pages, _double, _huge_number)


def damage_file(path, random, first=None):
    """Damages a file, in its first bytes only if `first` says so; answers what was done."""
    data = bytearray(path.read_bytes())
    kind = random.choice(FILE_DAMAGES)
    kind(data, random, min(len(data), first or len(data)))
    path.write_bytes(data)
    return f"{path.name} {kind.__name__.strip('_').replace('_', ' ')}"


NUMBERS = (0, -1, 1, 2147483647, -2147483648, 2**62, 1e308, -1e308, 5e-324, "nan", "", None)


def _edited_value(database, random):
    table = random.choice(_tables(database))
    column = random.choice([row[1] for row in database.execute(f"PRAGMA table_info({table})")])
    value = random.choice(NUMBERS)
    some = random.choice(("", " WHERE rowid % 3 = 0")) if _has_rowid(database, table) else ""
    database.execute(f"UPDATE OR REPLACE {table} SET {column} = ?{some}", (value,))
    return f"{table}.{column} = {value!r}{some}"


def _known_trap(database, random):
    statement = random.choice(
        (
            "UPDATE run SET gsd_m_per_px = 0",
            "UPDATE run SET gsd_m_per_px = 1e-300",
            "UPDATE sequence SET frame_count = 2147483647",
            "UPDATE sequence SET frame_count = 2147483647, path = '/nowhere.mp4'",
            "UPDATE run SET last_frame = 2147483647",
            "UPDATE run SET first_frame = -2147483648",
            "UPDATE sequence SET width = 2147483647, height = 2147483647",
            "UPDATE sequence SET width = 0, height = 0",
            "UPDATE sequence SET frame_rate_hz = 0",
            "UPDATE frame SET frame = frame + 2147483000",
            "UPDATE track SET last_frame = 2147483647",
            "UPDATE track_state SET length = 1e300, width = 1e300",
            "UPDATE labelled_object SET last_frame = 2147483647",
            "UPDATE labelled_object SET id = 2147483647 WHERE id = (SELECT max(id) FROM labelled_object)",
            "UPDATE label_counter SET value = 2147483647",
            "UPDATE verdict SET last_frame = 2147483647",
            "UPDATE correction SET frame = 2147483647",
            "UPDATE seen SET first_frame = 2147483647",
            "UPDATE sweep SET point_count = 2147483647",
            "PRAGMA user_version = 0",
            "PRAGMA user_version = 2147483647",
            "PRAGMA user_version = 1",
        )
    )
    database.execute(statement)
    return statement


def _view_for_table(database, random):
    table = random.choice(_tables(database))
    database.execute("PRAGMA legacy_alter_table = ON")
    database.execute(f"ALTER TABLE {table} RENAME TO hidden_{table}")
    database.execute(f"CREATE VIEW {table} AS SELECT * FROM hidden_{table}")
    return f"{table} is a view"


def _endless_view(database, random):
    table = random.choice(_tables(database))
    columns = ", ".join(f"n AS {row[1]}" for row in database.execute(f"PRAGMA table_info({table})"))
    database.execute(f"DROP TABLE {table}")
    database.execute(
        f"CREATE VIEW {table} AS WITH RECURSIVE all_n(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM all_n) "
        f"SELECT {columns} FROM all_n"
    )
    return f"{table} is a view without end"


def _missing_table(database, random):
    table = random.choice(_tables(database))
    database.execute(f"DROP TABLE {table}")
    return f"{table} is missing"


def _missing_column(database, random):
    table = random.choice(_tables(database))
    columns = [row[1] for row in database.execute(f"PRAGMA table_info({table})")]
    gone = random.choice(columns)
    kept = [column for column in columns if column != gone] or ["x"]
    database.execute(f"DROP TABLE {table}")
    database.execute(f"CREATE TABLE {table} ({', '.join(kept)})")
    return f"{table} has only {', '.join(kept)}"


def _trigger(database, random):
    table, other = random.choice(_tables(database)), random.choice(_tables(database))
    moment = random.choice(("INSERT", "UPDATE", "DELETE"))
    database.execute(f"CREATE TRIGGER mischief AFTER {moment} ON {table} BEGIN DELETE FROM {other}; END")
    return f"a trigger on {table} that empties {other}"


def _huge_text(database, random):
    table, column = random.choice(
        (
            ("labelled_object", "class"), ("labelled_object", "notes"), ("run", "name"), ("run", "message"),
            ("sequence", "path"), ("sweep", "plan"), ("comparison", "report"), ("frame", "reason"),
        )  # fmt: skip
    )
    size = random.choice((10_000, 1_000_000, 5_000_000))
    value = "x" * size if random.random() < 0.7 else "[" * size
    database.execute(f"UPDATE {table} SET {column} = ?", (value,))
    return f"{size} bytes in {table}.{column}"


def _random_blob(database, random):
    table, column = random.choice(
        (
            ("motion_vectors", "data"), ("stationary_corners", "data"), ("motion_cluster", "members"),
            ("detection", "vectors"), ("labelled_object", "keyframes"), ("edit_journal", "data"),
        )  # fmt: skip
    )
    value = random.choice((b"", None, b"\xff" * 64, random.randbytes(200), b"\xff" * 100_000, "text"))
    database.execute(f"UPDATE {table} SET {column} = ?", (value,))
    return f"other bytes in {table}.{column}"


TAMPERINGS = (
    _edited_value, _edited_value, _known_trap, _known_trap, _view_for_table, _endless_view, _missing_table,
    _missing_column, _trigger, _huge_text, _random_blob,
)  # fmt: skip


def tamper(path, random):
    """Changes a project as another program could; answers what was done."""
    kind = random.choice(TAMPERINGS)
    database = sqlite3.connect(path, isolation_level=None)
    try:
        return kind(database, random)
    except sqlite3.Error as error:  # a constraint forbade it
        return f"{kind.__name__.strip('_')} in vain ({error})"
    finally:
        database.close()


def _tables(database):
    names = database.execute("SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite_%'")
    return sorted(name for (name,) in names)


def _has_rowid(database, table):
    (text,) = database.execute("SELECT sql FROM sqlite_master WHERE name = ?", (table,)).fetchone()
    return "WITHOUT ROWID" not in text.upper()
