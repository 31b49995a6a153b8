"""What a part of the campaign is: numbered cases, each with a seed of its own, and how they are judged."""

import random


class Failure(Exception):
    """What a user would not forgive; the text says what was done and what was seen."""


class Skipped(Exception):
    """The part cannot be done on this machine; the text says why."""


class Part:
    """A part of the campaign. `goal` cases make a full one; `weight` is its share of the time."""

    name = ""
    goal = 0
    weight = 1.0
    alone = False  # its cases are not done side by side

    def __init__(self, world):
        self.world = world

    def prepare(self):
        """Done once before the first case. Raises Skipped."""

    def case(self, number, random, folder):
        """Does one case in an empty folder; raises Failure. Answers a word for the count, or nothing."""
        raise NotImplementedError

    def rest(self):
        """What the table says besides the counts."""
        return ""


def random_of(seed, part, number):
    """The dice of one case: the same for the same seed, part and number, whatever was done before."""
    return random.Random(f"{seed}/{part}/{number}")


def judge(result, allowed):
    """Raises Failure where a program crashed, hung, ended with a code outside `allowed`, or refused without a word."""
    if result.hung:
        raise Failure(f"hung: {result}")
    if result.killed:
        return
    if result.code < 0:
        raise Failure(f"crashed with signal {-result.code}: {result}")
    if result.code not in allowed:
        raise Failure(f"exit code {result.code}, expected one of {sorted(allowed)}: {result}")
    if result.code != 0 and not result.told():
        raise Failure(f"refused without a word: {result}")
