"""The clips of ../shared/data and the rendered scenes that tests/accuracy, tests/made_over and tests/learn_track_score run, and what
their runs are worth by ground truth. Needs the programs of build/release (./tests/run builds them)."""

import csv
import json
import math
import sqlite3
import subprocess
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
# Heading as the scripts reckon with it, all else as people are told it: the table itself leaves out what follows from others.
STATES = """SELECT track AS track_id, frame, x, y, length_px AS length, width_px AS width,
    heading_deg / 57.29577951308232 AS heading_rad, origin, score FROM v_track_states ORDER BY frame"""
DATA = ROOT.parent / "shared" / "data"
CLI = ROOT / "build" / "release" / "bin" / "eyrie-cli"


class Clip(NamedTuple):
    """In CLIPS the names of its files below DATA; from prepared() on their paths."""

    frames: str | Path  # a folder of pictures
    truth: str | Path | None  # none: all boxes are counted, of which hardly any is right
    gsd: float | None  # m/px; none: nobody knows it
    rate: float  # Hz
    upright_truth: bool  # boxes are upright, not turned with the vehicles


CLIPS = {
    "uavdt_m1303": Clip("uavdt_m1303/img1", "uavdt_m1303/ground_truth.csv", 0.08, 30, True),
    "uavdt_m1003": Clip("uavdt_m1003/img1", "uavdt_m1003/ground_truth.csv", 0.2, 30, True),
    "city_nadir": Clip("city_nadir/frames", "city_nadir/ground_truth.csv", 0.32, 25, False),
    "collage_day": Clip("collage_day/frames", "collage_day/ground_truth.csv", 0.2, 25, False),
    "collage_small": Clip("collage_small/frames", "collage_small/ground_truth.csv", 0.28, 25, False),
    "houses": Clip("houses/frames", None, None, 24, False),
    "uav123_building4": Clip("uav123_building4", None, None, 10, False),
    "uav123_car16": Clip("uav123_car16/frames", None, None, 10, False),
    "uav123_truck2": Clip("uav123_truck2/img", None, None, 10, False),
    "uavdt_s1606": Clip("uavdt_s1606/frames", None, None, 30, False),
    "kit_ais_crossroad": Clip("kit_ais_crossroad/img", "kit_ais_crossroad/gt_boxes.csv", 0.13, 2, True),
    "cmu_sequence1": Clip("cmu_sequence1", None, None, 15, False),
}
# name: seed and number of frames; with all they know given. Seeds from 100 on are for training.
SCENES = {
    "seq1": (1, None),
    "seq2": (1, None),
    "egtest01": (1, None),
    "road_flight": (11, 60),
    "road_flight_haze": (11, 60),
    "road_flight_dusk": (11, 60),
    "road_flight_night": (11, 60),
    "estate": (11, 60),
    "orbit": (11, 70),
    "city_high": (11, 30),
    "thermal": (11, 60),
    "low_rate": (11, 24),
    "motorway": (11, 60),
}
COLUMNS = ("f .3", "f .5", "MOTA", "N-MODP", "false/frame", "registered")  # of figures_of()


def command(*words):
    done = subprocess.run([CLI, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"eyrie-cli {' '.join(map(str, words))}\n    {done.stderr.strip()[-400:]}")
    return done.stdout


def prepared(name, folder, other_seed=None):
    """A clip or scene with its files, some of which are made in `folder`. `other_seed`: of a scene, in place of its own."""
    if name in CLIPS:
        clip = CLIPS[name]
        truth = clip.truth and DATA / clip.truth
        if truth and truth.name == "gt_boxes.csv":
            truth = truth_of_boxes(truth, folder / f"{name}-truth.csv")
        return clip._replace(frames=DATA / clip.frames, truth=truth)
    seed, frames = SCENES[name]
    seed = other_seed or seed
    place = folder / f"{name}-scene"
    count = ("--frames", frames) if frames else ()
    command("render", name, "--seed", seed, *count, "--out", place, "--quiet")
    scene = json.loads((place / "scene.json").read_text())
    truth = place / "ground_truth.csv"
    known = truth.read_text().count("\n") > 1
    return Clip(place / "frames", truth if known else None, scene["gsd"], scene["fps"], upright_truth=False)


def truth_of_boxes(boxes, place):
    """Corners and sizes without ids, frames from 1 on, as ground truth of which each box is a vehicle of its own."""
    with open(boxes, newline="") as lines, open(place, "w", newline="") as truth:
        writer = csv.writer(truth)
        writer.writerow(("frame", "id", "x", "y", "length", "width", "heading", "class", "ignore"))
        for number, row in enumerate(csv.DictReader(lines)):
            left, top, wide, high = (float(row[key]) for key in ("left", "top", "width", "height"))
            middle = (left + wide / 2, top + high / 2)
            writer.writerow((int(row["frame"]) - 1, number, *middle, wide, high, 0, "car", 1 - int(row["derived_moving"])))
    return place


def upright(x, y, length, width, heading):
    across = (abs(length * math.cos(heading)) + abs(width * math.sin(heading))) / 2
    down = (abs(length * math.sin(heading)) + abs(width * math.cos(heading))) / 2
    return x - across, y - down, x + across, y + down


def truth_boxes(file, factor=1):
    """By frame: upright boxes, and whether they count neither way."""
    truth = {}
    with open(file, newline="") as lines:
        for row in csv.DictReader(lines):
            sides = (float(row[key]) * factor for key in ("x", "y", "length", "width"))
            box = upright(*sides, math.radians(float(row["heading"])))
            truth.setdefault(int(row["frame"]), []).append((box, row.get("ignore") == "1"))
    return truth


def confirmed(states, truth):
    """By ground truth: 1 when at least half of a track's boxes that count lie on vehicles, None when few count."""
    hits = left_out = 0
    for state in states:
        a = upright(state["x"], state["y"], state["length"], state["width"], state["heading_rad"])
        best, ignored, touched = 0, False, False
        for b, ignore in truth.get(state["frame"], ()):
            wide, high = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
            if wide <= 0 or high <= 0:
                continue
            touched |= ignore
            both = (a[2] - a[0]) * (a[3] - a[1]) + (b[2] - b[0]) * (b[3] - b[1]) - wide * high
            if wide * high / both > best:
                best, ignored = wide * high / both, ignore
        hits += best >= 0.3 and not ignored
        left_out += not (best >= 0.3 and not ignored) and touched
    if left_out >= 0.6 * len(states):
        return None
    return int(hits > 0 and hits >= 0.5 * (len(states) - left_out))


def opened(project):
    database = sqlite3.connect(f"file:{project}?mode=ro", uri=True)
    database.row_factory = sqlite3.Row
    return database


def registered(database):
    (count,) = database.execute("SELECT count(*) FROM frame").fetchone()
    (lost,) = database.execute("SELECT count(*) FROM frame WHERE registration_state = 'failed'").fetchone()
    return 1 - lost / count


def figures_of(project, truth, upright_truth):
    """Figures of a run, and the score of each of its tracks with whether it is a vehicle by ground truth."""
    tracks = {}
    with opened(project) as database:
        figures = {"registered": registered(database)}
        (count,) = database.execute("SELECT count(*) FROM frame").fetchone()
        for row in database.execute(STATES):
            tracks.setdefault(row["track_id"], []).append(row)
    figures["false/frame"] = sum(map(len, tracks.values())) / count
    if not truth:
        return figures, []
    options = ("--upright", "--border", 3) if upright_truth else ("--vehicles",)
    told = command("evaluate", "--ground-truth", truth, "--project", project, "--overlap", 0.3, 0.5, "--json", *options)
    low, high = json.loads(told)["measures"]
    figures |= {
        "f .3": low["f_score"], "f .5": high["f_score"], "MOTA": low["mota"], "N-MODP": low["n_modp"],
        "false/frame": low["fp"] / count,
    }  # fmt: skip
    boxes = truth_boxes(truth)
    scores = [(states[0]["score"], confirmed(states, boxes)) for states in tracks.values()]
    return figures, [pair for pair in scores if pair[1] is not None]
