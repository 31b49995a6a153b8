"""The commands and the window as actions on a project: their words, what they claim to have done, and how they may
end."""

import re
from pathlib import Path

from cases import Failure, judge
from project_facts import facts

READERS = ("info", "export", "evaluate", "report", "event-report")
WRITERS = ("run", "sweep", "import", "merge", "window")
OF_PROJECT = ("window", "run", "sweep", "import", "export", "info", "evaluate", "report", "merge")

DONE, USAGE, INPUT, OUTPUT, PROJECT = 0, 2, 3, 4, 5
HOLDER = re.compile(r"process \d+.*since", re.DOTALL)


class Action:
    """A command on a project, or the window. `mark` names all that it adds, so that it is found again."""

    terminal = False  # shows its progress only on one
    attempt = ""  # told from others in the names of its outputs, which nothing replaces

    def __init__(self, world, folder, project, exists, mark, random):
        self.world, self.folder, self.project, self.exists, self.mark = world, Path(folder), project, exists, mark
        self.random = random
        self.output = None

    def line(self):
        return [self.world.cli, *self.words()]

    def words(self):
        raise NotImplementedError

    def claims(self, result):
        """What the program has told to be done, as project_facts names it."""
        return self.done() if result.code == 0 else {}

    def done(self):
        """What is in the project when it has ended with 0."""
        return {}

    def again(self):
        """The same once more, with outputs of its own."""
        following = type(self)(
            self.world, self.folder, self.project, Path(self.project).exists(), self.mark, self.random
        )
        following.attempt = self.attempt + "-again"
        return following

    def going_on(self, held):
        """What a user does after it was killed; `held` is what project_facts tells then."""
        return self.again()

    def check_output(self, result):
        """Raises Failure when a file that it wrote is there and not whole."""
        if not self.output or not self.output.exists():
            if self.output and result.code == 0:
                raise Failure(f"{self.output.name} is missing: {result}")
            return
        text = self.output.read_text(errors="replace")
        if not self.is_whole(text):
            raise Failure(f"{self.output.name} is not whole ({len(text)} bytes): {result}")

    def is_whole(self, text):
        lines = text.splitlines()
        return text.endswith("\n") and len({line.count(",") for line in lines if '"' not in line}) == 1

    def out(self, ending):
        self.output = self.folder / f"{self.mark}{self.attempt}{ending}"
        return self.output


class Run(Action):
    terminal = True

    def words(self):
        return ["run", self.world.clip, "--project", self.project, "--gsd", "0.2", "--name", self.mark]

    def done(self):
        return {f"finished {self.mark}": 1, f"frames {self.mark}": self.world.frames}

    def claims(self, result):
        shown = [int(n) for n in re.findall(r"(\d+)/\d+ frames", result.err)]
        return {f"frames {self.mark}": max(shown, default=0), **super().claims(result)}

    def going_on(self, held):
        begun = f"frames {self.mark}" in held and not held.get(f"finished {self.mark}")
        if begun and self.random.random() < 0.7:
            return ResumedRun(self.world, self.folder, self.project, True, self.mark, self.random)
        return self.again()


class ResumedRun(Run):
    def words(self):
        return ["run", "--resume", "--project", self.project]


class RunWithTracks(Run):
    def words(self):
        return [*super().words(), "--tracks", self.out("-tracks.csv")]


class RunWithVideo(Run):
    def words(self):
        return [*super().words(), "--annotated", self.out("-drawn.mp4")]

    def check_output(self, result):
        if self.output.exists():
            # The index of a video stands at its end or beginning; without it nothing can be read.
            data = self.output.read_bytes()
            if b"moov" not in data:
                raise Failure(f"{self.output.name} is not whole: {result}")


class Sweep(Action):
    """A sweep over images and their truth, or over the run of the project."""

    terminal = True

    def axis(self):
        return "gradient.quantile=" + {"A": "0.1,0.4", "B": "0.15,0.45"}.get(self.mark, "0.25,0.35,0.55")

    def words(self):
        return [*self.world.sweep_words([self.axis()]), "--out", self.project, "--resume"]

    def done(self):
        return {f"sweep {self.axis()}": self.axis().count(",") + 1, f"complete {self.axis()}": 1}

    def claims(self, result):
        shown = [int(n) for n in re.findall(r"(\d+)/\d+ points", result.err)]
        return {f"sweep {self.axis()}": max(shown, default=0), **super().claims(result)}


class SweepOfRun(Sweep):
    def words(self):
        return [
            "sweep", "--project", self.project, "--run", "1", "--ground-truth", self.world.truth,
            "--parameter", self.axis(), "--resume",
        ]  # fmt: skip


class Import(Action):
    def words(self):
        video = [] if self.exists else ["--video", self.world.clip]
        return ["import", self.world.labels(self.mark), "--project", self.project, *video]

    def done(self):
        return {f"labels {self.mark}": 2}

    def going_on(self, held):
        following = self.again()
        following.exists = self.exists  # the same words: killed early it leaves a project without a video
        return following


class ImportToFile(Import):
    def words(self):
        return ["import", self.world.labels(self.mark), "--out", self.out("-labels.csv")]

    def done(self):
        return {}


class Merge(Action):
    def words(self):
        return ["merge", *self.world.parts, "--out", self.project, "--add"]

    def done(self):
        return {"complete gradient.quantile=0.2,0.3": 1}


class Compare(Action):
    def words(self):
        return [
            "compare", "--sequence", self.world.clip, "--gsd", "0.2", "--ground-truth", self.world.truth, "--methods",
            "clusters", "gradient", "--stacking", "off", "--quiet", "--project", self.project, "--csv", self.out("-compare.csv"),
        ]  # fmt: skip

    def done(self):
        return {"comparisons": 1}


class Export(Action):
    def words(self):
        labels = [] if self.exists and self.random.random() < 0.5 else ["--labels"]
        return ["export", "--project", self.project, *labels, "--format", "native", "--out", self.out("-export.csv")]


class Info(Action):
    def words(self):
        return ["info", self.project]


class Evaluate(Action):
    def words(self):
        return ["evaluate", "--project", self.project, "--ground-truth", self.world.truth, "--errors",
                self.out("-errors.csv")]  # fmt: skip


class Report(Action):
    def words(self):
        return ["report", "--project", self.project, "--ground-truth", self.world.truth, "--chips", "4", "--out",
                self.out("-report.html")]  # fmt: skip

    def is_whole(self, text):
        return text.rstrip().endswith("</html>")


class EventReport(Report):
    def words(self):
        return ["report", "--project", self.project, "--events", "--verdict", "all", "--out", self.out("-events.html")]


class Train(Action):
    """Needs no project; the model is compared with one made in peace."""

    def words(self):
        return [
            "train", "--images", self.world.clip, "--ground-truth", self.world.truth, "--trees", "10",
            "--hard-negative-rounds", "0", "--quiet", "--out", self.out(".eyriemodel"),
        ]  # fmt: skip

    def is_whole(self, text):
        return len(text) > 1000


class Render(Action):
    def words(self):
        return ["render", "demo", "--frames", "2", "--quiet", "--out", self.folder / f"rendered{self.attempt}"]


class Window(Action):
    """Labels, then runs (or the other way round)."""

    LABELS = 12

    def line(self):
        begin = ["open", self.project] if self.exists else ["video", self.world.clip, self.project]
        label, run = ["label", str(self.LABELS), self.mark], ["run", self.mark]
        return [self.world.driver, *begin, *(label + run if self.random.random() < 0.7 else run + label)]

    def again(self):
        following = super().again()
        # A project that was made, but in which nothing was stored yet, is nothing that the window could open.
        following.exists = any(facts(self.project, self.folder).values())
        return following

    def done(self):
        return {f"labels {self.mark}": self.LABELS, f"finished {self.mark}": 1, f"frames {self.mark}": self.world.frames}

    def claims(self, result):
        claimed = {}
        for kind, key in (("label", "labels"), ("frame", "frames")):
            shown = [int(n) for n in re.findall(rf"^done {kind} {self.mark} (\d+)$", result.out, re.MULTILINE)]
            if shown:
                claimed[f"{key} {self.mark}"] = max(shown)
        if re.search(rf"^done run {self.mark}$", result.out, re.MULTILINE):
            claimed[f"finished {self.mark}"] = 1
        return {**claimed, **super().claims(result)}


CLASSES = {
    "run": Run, "run-tracks": RunWithTracks, "run-video": RunWithVideo, "sweep": Sweep, "sweep-run": SweepOfRun,
    "import": Import, "import-file": ImportToFile, "merge": Merge, "compare": Compare, "export": Export, "info": Info,
    "evaluate": Evaluate, "report": Report, "event-report": EventReport, "train": Train, "render": Render, "window": Window,
}  # fmt: skip
WITHOUT_PROJECT = ("import-file", "train", "render")
MAKERS = ("run", "run-tracks", "run-video", "sweep", "import", "merge", "compare", "window")  # of a project


def action(name, world, folder, project, exists, mark, random):
    return CLASSES[name](world, folder, project, exists, mark, random)


def judge_end(name, result, shared, may_be_absent):
    """Whether an action on a sound project ended as it may: done; or refused since another program holds the project,
    which it names; or, where the project does not exist yet, since there is nothing to read."""
    if name == "window":
        judge(result, {DONE, INPUT})
        if result.code == INPUT and not result.killed and not shared and not HOLDER.search(result.out):
            raise Failure(f"refused: {result}")
    else:
        judge(result, {DONE, OUTPUT, PROJECT} if shared or may_be_absent else {DONE})
    if result.killed or result.code == DONE or may_be_absent:
        return
    if not HOLDER.search(result.out + result.err):
        raise Failure(f"the refusal does not say who holds the project since when: {result}")
