"""Kills every writing command and the window at random moments: what was told as done is there afterwards, the project
is whole, nothing is left lying about, and the same command goes on."""

import threading

from actions import MAKERS, WITHOUT_PROJECT, action
from cases import Failure, Part, judge
from programs import Program, run
from project_facts import compare, facts, finished_tracks

VICTIMS = (
    "run", "sweep", "import", "merge", "window", "compare", "run-tracks", "sweep-run", "export", "run-video", "report",
    "evaluate", "import-file", "train", "window", "render",
)  # fmt: skip


class Kills(Part):
    name = "kills"
    goal = 1100  # a tenth ends before it is killed
    weight = 3.0

    def __init__(self, world):
        super().__init__(world)
        self._lock = threading.Lock()
        self._usual = {}  # seconds that a victim takes here and now

    def case(self, number, random, folder):
        name = VICTIMS[number % len(VICTIMS)]
        exists = name not in MAKERS or random.random() < 0.6
        project = folder / "p.eyrie"
        if exists:
            self.world.base_in(folder)
        before = facts(project, folder)
        usual = self._usual.get(name) or self._measure(name, random, folder)
        victim = action(name, self.world, folder, project, exists, "A", random)
        kills = 0
        for _ in range(random.choice((1, 1, 1, 2, 3))):
            moment = random.uniform(0, 1.1) * usual
            result = self._do(victim, folder, kill_after=moment)
            kills += result.killed
            self._note(name, result)
            held = facts(project, folder)
            compare(before, held, "was there before")
            told = f"{name} told to be done before it was killed after {moment:.3f} s"
            compare(victim.claims(result), held, told)
            victim.check_output(result)
            if project.exists():
                judge(run([self.world.cli, "info", project], folder, "info", environment=self._environment(folder)), {0})
            before = {key: max(number, before.get(key, 0)) for key, number in held.items()}
            victim = victim.going_on(held)

        result = self._do(victim, folder)
        held = facts(project, folder)
        compare(before, held, "was there before")
        compare(victim.claims(result), held, "was told to be done at last")
        victim.check_output(result)
        self._same_as_in_peace(project, folder)
        self._nothing_left(folder, project)
        return "killed once" if kills == 1 else f"killed {kills} times"

    def _do(self, victim, folder, kill_after=None):
        program = Program(victim.line(), folder, "victim", self._environment(folder), victim.terminal)
        result = program.wait(kill_after=kill_after)
        judge(result, {0})
        return result

    def _environment(self, folder):
        return self.world.environment(folder / "home")

    @staticmethod
    def _same_as_in_peace(project, folder):
        """However often it was killed and gone on with, a run finds what one finds that nobody disturbed."""
        if not project.exists():
            return
        runs = finished_tracks(project, folder)
        undisturbed = [tracks for name, tracks in runs.values() if name == "old"]
        for number, (name, tracks) in runs.items():
            if undisturbed and name == "A" and tracks != undisturbed[0]:
                raise Failure(f"run {number} of {project} found other tracks than one that was never killed")

    def _measure(self, name, random, folder):
        aside = folder / "measured"
        aside.mkdir()
        project = aside / "p.eyrie"
        if name not in WITHOUT_PROJECT:
            self.world.base_in(aside)
        victim = action(name, self.world, aside, project, True, "A", random)
        result = run(victim.line(), aside, "measured", environment=self.world.environment(folder / "home"))
        judge(result, {0})
        with self._lock:
            return self._usual.setdefault(name, result.seconds)

    def _note(self, name, result):
        if not result.killed:  # the machine may be busier or idler than before
            with self._lock:
                self._usual[name] = (self._usual[name] + result.seconds) / 2

    @staticmethod
    def _nothing_left(folder, project):
        left = [
            path.name
            for path in folder.iterdir()
            # The unfinished part of a video that was killed stays, under its own name, until that video is written anew.
            if ".new-" in path.name or path.name.endswith((".tmp", "-journal"))
        ]
        if left:
            raise Failure(f"left lying about beside {project.name}: {', '.join(sorted(left))}")
