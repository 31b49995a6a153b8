"""Looks into a project with another program's eyes (Python's SQLite): whether it is whole, and what it holds."""

import contextlib
import json
import shutil
import sqlite3
from pathlib import Path

from cases import Failure

COMPANIONS = ("", "-wal", "-journal")


def copy_project(source, target):
    """A copy of a project that no program has open, with what stands in its log."""
    for ending in COMPANIONS:
        if Path(f"{source}{ending}").exists():
            shutil.copy(f"{source}{ending}", f"{target}{ending}")
    return target


def facts(project, folder):
    """What a project holds, as names and numbers that never shrink while programs only add; {} when there is none.
    Raises Failure when it is not whole. Looks at a copy in `folder`, so that the project stays as it was left."""
    if not Path(project).exists():
        return {}
    with _opened(project, folder) as database:
        return _whole(database)


def finished_tracks(project, folder):
    """The track states of every finished run, by the run's id: its name and what was found."""
    found = {}
    with _opened(project, folder) as database:
        for run, name in database.execute("SELECT id, name FROM run WHERE state = 'finished'").fetchall():
            rows = database.execute(
                "SELECT frame, track_id, x, y, length, width, heading_rad, status, origin FROM track_state "
                "WHERE run_id = ? ORDER BY frame, track_id",
                (run,),
            )
            found[run] = (name, rows.fetchall())
    return found


@contextlib.contextmanager
def _opened(project, folder):
    copy = Path(folder) / ".facts.eyrie"
    _remove(copy)
    copy_project(project, copy)
    try:
        with contextlib.closing(sqlite3.connect(copy)) as database:
            yield database
    except sqlite3.DatabaseError as error:
        raise Failure(f"{project} is damaged: {error}") from error
    finally:
        _remove(copy)


def _remove(project):
    for ending in (*COMPANIONS, "-shm"):
        Path(f"{project}{ending}").unlink(missing_ok=True)


def _whole(database):
    integrity = database.execute("PRAGMA integrity_check").fetchall()
    if integrity != [("ok",)]:
        raise Failure(f"integrity_check: {integrity[:3]}")
    foreign = database.execute("PRAGMA foreign_key_check").fetchall()
    if foreign:
        raise Failure(f"foreign_key_check: {foreign[:3]}")
    tables = {name for (name,) in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
    if "run" not in tables:
        return {}  # being made when its maker was killed; programs say so
    held = {}

    def at_least(key, number):
        held[key] = max(held.get(key, 0), number)

    for run, name, preset, state, frames in database.execute(
        "SELECT id, name, preset, state, (SELECT count(*) FROM frame WHERE run_id = run.id) FROM run"
    ):
        for key in {name, preset} - {""}:
            at_least(f"frames {key}", frames)
            at_least(f"finished {key}", int(state == "finished"))
        if state == "finished":
            at_least("states " + (name or preset), _count(database, "track_state", run))
    for name, objects in database.execute("SELECT class, count(*) FROM labelled_object GROUP BY class"):
        at_least(f"labels {name}", objects)
    for plan, points, done in database.execute(
        "SELECT plan, point_count, (SELECT count(*) FROM sweep_point WHERE sweep_id = sweep.id) FROM sweep"
    ):
        axes = json.loads(plan)["parameters"]
        key = ";".join(f"{axis['name']}={','.join(axis['values'])}" for axis in axes)
        at_least(f"sweep {key}", done)
        at_least(f"complete {key}", int(done == points))
    at_least("comparisons", database.execute("SELECT count(*) FROM comparison").fetchone()[0])
    return held


def _count(database, table, run):
    return database.execute(f"SELECT count(*) FROM {table} WHERE run_id = ?", (run,)).fetchone()[0]


def compare(claims, held, who):
    """Raises Failure when the project holds less than was claimed."""
    lost = {key: (number, held.get(key, 0)) for key, number in claims.items() if held.get(key, 0) < number}
    if lost:
        text = ", ".join(f"{key}: {stored} instead of {number}" for key, (number, stored) in sorted(lost.items()))
        raise Failure(f"lost what {who}: {text}")
