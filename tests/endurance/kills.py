"""Kills every writing command and the window at random moments: what was told as done is there afterwards, the project
is whole, nothing is left lying about, and the same command goes on."""

import threading

from actions import MAKERS, WITHOUT_PROJECT, action
from cases import Failure, Part, judge
from programs import Program, run
from project_facts import compare, facts

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
        environment = self.world.environment(folder / "home")
        victim = action(name, self.world, folder, project, exists, "A", random)
        usual = self._usual.get(name) or self._measure(name, random, folder)
        moment = random.uniform(0, 1.1) * usual
        line = victim.line()
        result = Program(line, folder, "victim", environment, victim.terminal).wait(kill_after=moment)
        judge(result, {0})
        self._note(name, result)

        held = facts(project, folder)
        compare(before, held, "was there before")
        compare(victim.claims(result), held, f"{name} told to be done before it was killed after {moment:.3f} s")
        victim.check_output(result)
        if project.exists():
            judge(run([self.world.cli, "info", project], folder, "info", environment=environment), {0})
        self._again(victim, project, folder, environment)
        held = facts(project, folder)
        compare(before, held, "was there before")
        self._nothing_left(folder, project)
        return "killed" if result.killed else "ended before"

    @staticmethod
    def _again(victim, project, folder, environment):
        """The next command, which is the same, works."""
        following = victim.again()
        result = Program(following.line(), folder, "again", environment, following.terminal).wait()
        judge(result, {0})
        compare(following.claims(result), facts(project, folder), "the next command told to be done")
        following.check_output(result)

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
            if ".new-" in path.name or path.name.endswith((".part", ".tmp", "-journal"))
        ]
        if left:
            raise Failure(f"left lying about beside {project.name}: {', '.join(sorted(left))}")
