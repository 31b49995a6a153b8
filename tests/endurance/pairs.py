"""Every pair of programs at once on one project, and on one that does not exist yet, half of them with a kill of
either: what was told as done is there, refusals say who holds the project, and the project is whole."""

import itertools
import time

from actions import OF_PROJECT, action, judge_end
from cases import Part
from programs import Program, run
from project_facts import compare, facts


def kinds_of(names):
    """Every pair, on one project and on one that does not exist yet."""
    pairs = itertools.combinations_with_replacement(names, 2)
    return [(pair, exists) for pair in pairs for exists in (True, False)]


KINDS = kinds_of(OF_PROJECT)
QUICK_KINDS = kinds_of([name for name in OF_PROJECT if name != "window"])


class Pairs(Part):
    name = "pairs"
    goal = 25 * len(KINDS)  # every pair 50 times
    weight = 4.0
    kinds = KINDS

    def case(self, number, random, folder):
        pair, exists = self.kinds[number % len(self.kinds)]
        with_kill = number // len(self.kinds) % 2 == 1
        names = pair if random.random() < 0.5 else pair[::-1]
        project = folder / "p.eyrie"
        if exists:
            self.world.base_in(folder)
        before = facts(project, folder)
        marks = ("A", "A") if names[0] == names[1] == "sweep" and random.random() < 0.5 else ("A", "B")
        actions = [
            action(name, self.world, folder, project, exists, mark, random) for name, mark in zip(names, marks)
        ]
        results = self._together(actions, folder, random, with_kill)
        for name, result in zip(names, results):
            judge_end(name, result, exists, may_be_absent=not exists)

        held = facts(project, folder)
        compare(before, held, "was there before")
        for name, one, result in zip(names, actions, results):
            compare(one.claims(result), held, f"{name} told to be done beside {' and '.join(names)}: {result}")
            one.check_output(result)
        if project.exists():
            environment = self.world.environment(folder / "home")
            judge_end("info", run([self.world.cli, "info", project], folder, "info", environment=environment), 0, 0)
        return "with a kill" if any(result.killed for result in results) else "in peace"

    def _together(self, actions, folder, random, with_kill):
        """Begins both, one a little later, and kills one of them if asked to."""
        later = random.choice((0, 0, random.uniform(0, 0.6)))
        moment = random.uniform(0, 1.5)
        victim = random.randrange(2)
        programs = []
        for slot, one in enumerate(actions):
            environment = self.world.environment(folder / f"home{slot}")
            programs.append(Program(one.line(), folder, f"slot{slot}", environment, one.terminal))
            if slot == 0 and later:
                time.sleep(later)
        if not with_kill:
            return [program.wait() for program in programs]
        results = [None, None]
        results[victim] = programs[victim].wait(kill_after=moment)
        results[1 - victim] = programs[1 - victim].wait()
        return results

    def rest(self):
        return f"{len(self.kinds)} kinds: a pair, on one project or on none yet"


class QuickPairs(Pairs):
    """Every pair of commands once, and some with a kill; for every build, so without the window."""

    name = "quick-pairs"
    kinds = QUICK_KINDS
    goal = len(QUICK_KINDS) + 8
