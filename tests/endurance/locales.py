"""Other languages and scripts change no number: the same commands write the same bytes in every locale."""

import shutil
import sqlite3

from cases import Failure, Part, Skipped, judge
from programs import run

LOCALES = {"de_DE.UTF-8": ("de_DE", "UTF-8"), "ar_EG.UTF-8": ("ar_EG", "UTF-8"), "fa_IR.UTF-8": ("fa_IR", "UTF-8"),
           "tr_TR.UTF-8": ("tr_TR", "UTF-8"), "fr_CH.UTF-8": ("fr_CH", "UTF-8")}  # fmt: skip


class Locales(Part):
    name = "locales"
    goal = len(LOCALES)
    weight = 0.5

    def prepare(self):
        if not shutil.which("localedef"):
            raise Skipped("localedef is missing")
        self._compiled = self.world.folder / "locales"
        self._compiled.mkdir()
        for name, (source, charset) in LOCALES.items():
            made = run(["localedef", "-i", source, "-f", charset, self._compiled / name], self.world.folder, "localedef")
            if not (self._compiled / name / "LC_NUMERIC").exists():
                raise Skipped(f"the locale {name} cannot be made (install the package locales): {made.told()}")
        home = self.world.folder / "plain"
        home.mkdir()
        self._expected = self._written(home, "C")
        if self._written_twice_differs(home):
            raise Skipped("two calls in one locale differ, so that nothing can be compared")

    def _written_twice_differs(self, home):
        again = home / "again"
        again.mkdir()
        return self._written(again, "C") != self._expected

    def case(self, number, random, folder):
        name = list(LOCALES)[number]
        written = self._written(folder, name)
        for what, expected in self._expected.items():
            if written.get(what) != expected:
                raise Failure(f"{what} differs in {name}")
        return None

    def _written(self, folder, locale):
        """All that the commands write and print, by name."""
        environment = self.world.environment(folder / "home", LC_ALL=locale, LANG=locale, LOCPATH=str(self._compiled))
        project, world = folder / "p.eyrie", self.world
        truth = ["--ground-truth", world.truth]
        calls = {
            "run": ["run", world.clip, "--project", project, "--gsd", "0.2", "--quiet", "--tracks", folder / "t.csv",
                    "--detections", folder / "d.csv"],
            "params": ["params"],
            "import": ["import", world.truth, "--project", project],
            "evaluate": ["evaluate", "--project", project, *truth, "--json", "--errors", folder / "e.csv"],
            "sweep": ["sweep", "--project", project, "--run", "1", *truth, "--quiet", "--parameter",
                      "gradient.quantile=0.1,0.45", "--csv", folder / "s.csv", "--save-preset", folder / "b.json"],
            "params of the preset": ["params", "--preset", folder / "b.json"],
        }  # fmt: skip
        for format_name in ("native", "cvat", "coco", "kw18"):
            calls[f"export {format_name}"] = [
                "export", "--project", project, "--labels", "--format", format_name, "--name", "clip", "--out",
                folder / f"x-{format_name}",
            ]  # fmt: skip
        printed = ("params", "params of the preset", "evaluate")
        written = {}
        for name, words in calls.items():
            result = run([world.cli, *words], folder, "call", environment=environment)
            judge(result, {0})
            if name in printed:
                written[f"output of {name}"] = result.out.replace(str(folder), "")
        window = [world.driver, "video", world.clip, folder / "w.eyrie", "label", "3", "A", "run", "A"]
        judge(run(window, folder, "window", environment=environment), {0})
        for path in sorted(folder.glob("*.*")) + sorted(folder.glob("x-*")):
            if path.is_file() and path.suffix in (".csv", ".json", "") and not path.name.startswith("."):
                # Times of day and durations are their own.
                written[path.name] = b"\n".join(
                    line for line in path.read_bytes().splitlines() if not any(w in line for w in (b"<dumped>", b"date", b"created", b"updated"))
                )
        for database in (project, folder / "w.eyrie"):
            written[f"tracks in {database.name}"] = rows(database)
        return written

    def rest(self):
        return ", ".join(LOCALES)


def rows(project):
    database = sqlite3.connect(project)
    try:
        states = database.execute("SELECT * FROM track_state ORDER BY run_id, frame, track_id").fetchall()
        labels = database.execute("SELECT class, keyframes FROM labelled_object ORDER BY id").fetchall()
        return states, labels
    finally:
        database.close()
