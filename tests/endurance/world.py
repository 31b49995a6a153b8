"""What the campaign works on: the programs of a build, a tiny clip with its truth, and a project with results."""

import os
import shutil
import subprocess
import threading
from pathlib import Path

from programs import run

SWEEP_SETTINGS = ["--gsd", "0.2", "--set", "detection.method=gradient"]


class World:
    """`stopped` is set when a person ends the campaign."""

    def __init__(self, binaries, fuzzers, folder, frames):
        self.stopped = threading.Event()
        self.fuzzers = fuzzers
        self.frames = frames
        self.cli = Path(binaries) / "eyrie-cli"
        self.driver = Path(binaries) / "window_driver"
        self.clip_maker = Path(binaries) / "clip_maker"
        self.folder = Path(folder)
        self.inputs = self.folder / "inputs"
        self.clip = self.inputs / "clip"
        self.truth = self.inputs / "truth.csv"
        self.base = self.inputs / "base.eyrie"  # a run "old", labels of class "old" and a sweep
        self.parts = [self.inputs / "part1.eyrie", self.inputs / "part2.eyrie"]

    def environment(self, home, **more):
        """A user's home of its own, no screen, and nothing of the language of this machine."""
        home = Path(home)
        home.mkdir(parents=True, exist_ok=True)
        environment = dict(
            os.environ,
            XDG_CACHE_HOME=str(home / "cache"),
            XDG_CONFIG_HOME=str(home / "config"),
            XDG_DATA_HOME=str(home / "data"),
            QT_QPA_PLATFORM="offscreen",
            LC_ALL="C.UTF-8",
        )
        environment.update(more)
        return environment

    def prepare(self):
        self.inputs.mkdir(parents=True)
        subprocess.run([self.clip_maker, self.inputs, str(self.frames)], check=True)
        self._do("run", self.clip, "--project", self.base, "--gsd", "0.2", "--quiet", "--name", "old")
        self._do("import", self.labels("old"), "--project", self.base)
        self._do(*self.sweep_words(["gradient.quantile=0.05"]), "--out", self.base)
        for number, part in enumerate(self.parts, 1):
            self._do(*self.sweep_words(["gradient.quantile=0.2,0.3"]), "--out", part, "--shard", f"{number}/2")

    def sweep_words(self, axes):
        words = ["sweep", "--sequence", self.clip, "--ground-truth", self.truth, *SWEEP_SETTINGS]
        for axis in axes:
            words += ["--parameter", axis]
        return words

    def labels(self, name):
        """The truth as labels whose class is `name`; a little off for each name, since import leaves out doubles."""
        path = self.inputs / f"labels-{name}.csv"
        if not path.exists():
            aside = path.with_suffix(f".{os.getpid()}")
            off = {"old": 0, "A": 5, "B": 10}.get(name, 15)
            lines = self.truth.read_text().splitlines()
            moved = [line.split(",") for line in lines[1:]]
            for fields in moved:
                fields[2], fields[7] = f"{float(fields[2]) + off:.4f}", name
            aside.write_text("\n".join([lines[0], *map(",".join, moved)]) + "\n")
            aside.rename(path)
        return path

    def base_in(self, folder):
        """A copy of the project to work on."""
        project = Path(folder) / "p.eyrie"
        shutil.copy(self.base, project)
        return project

    def _do(self, *words):
        result = run([self.cli, *words], self.inputs, "prepare", environment=self.environment(self.folder / "home"))
        if result.code != 0:
            raise RuntimeError(f"cannot prepare: {result}")
