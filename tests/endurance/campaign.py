"""The campaign: does the cases of every part in turn, several side by side, shows how far it is, and ends with a table.
Called by tests/campaign."""

import argparse
import concurrent.futures
import os
import random as dice
import shutil
import signal
import sys
import tempfile
import threading
import time
import traceback
from pathlib import Path

from cases import Failure, Skipped, random_of
from damage import Damage
from full_disk import FullDisk
from fuzzing import Fuzzing
from kills import Kills
from locales import Locales
from pairs import Pairs, QuickPairs
from soak import Soak
from world import World

PARTS = (Kills, Pairs, FullDisk, Damage, Fuzzing, Locales, Soak)
WHEN_NAMED = (QuickPairs,)  # only then


class Tally:
    """How a part has gone so far."""

    def __init__(self, part, seed):
        self.part, self.seed = part, seed
        self.tried = 0
        self.failures = []  # (number, text)
        self.words = {}
        self.skipped = ""
        self.ended = ""
        self._lock = threading.Lock()

    def count(self, number, word, failure):
        with self._lock:
            self.tried += 1
            if word:
                self.words[word] = self.words.get(word, 0) + 1
            if failure:
                self.failures.append((number, failure))

    def line(self):
        if self.skipped:
            return f"{self.part.name:<10} skipped: {self.skipped}"
        rest = "; ".join(text for text in (self.part.rest(), *(f"{n} {w}" for w, n in sorted(self.words.items())))
                         if text)  # fmt: skip
        seeds = " ".join(str(number) for number, _ in sorted(self.failures)[:20])
        more = " …" if len(self.failures) > 20 else ""
        failed = f"--seed {self.seed} --part {self.part.name} --only {seeds}{more}" if seeds else ""
        return f"{self.part.name:<10} {self.tried:>7} {len(self.failures):>7}  {failed or '–'}  ({rest})"


def table(tallies):
    return "\n".join([f"{'part':<10} {'tried':>7} {'failed':>7}  failures", *(tally.line() for tally in tallies)])


class Campaign:
    def __init__(self, options):
        self.options = options
        self.folder = Path(tempfile.mkdtemp(prefix="eyrie-campaign-"))
        self.world = World(options.binaries, options.fuzzers, self.folder, options.frames)
        self.stopped = self.world.stopped
        self.tallies = []
        self.kept = 0
        self._screen = threading.Lock()

    def _say(self, text):
        with self._screen:
            print(text, flush=True)

    def work(self):
        signal.signal(signal.SIGINT, lambda *_: self.stopped.set())
        signal.signal(signal.SIGTERM, lambda *_: self.stopped.set())
        options = self.options
        chosen = [part for part in PARTS + WHEN_NAMED if part.name in options.part] or PARTS
        self._say(f"seed {options.seed}, {options.minutes:g} minutes, {options.jobs} cases side by side, {self.folder}")
        self.world.prepare()
        self.tallies = [Tally(part(self.world), options.seed) for part in chosen]
        beside = [tally for tally in self.tallies if tally.part.alone]
        others = [tally for tally in self.tallies if not tally.part.alone]
        end = time.monotonic() + options.minutes * 60
        threads = [threading.Thread(target=self._part, args=(tally, end, 1)) for tally in beside]
        for thread in threads:
            thread.start()
        for at, tally in enumerate(others):
            weights = sum(later.part.weight for later in others[at:])
            share = max(0.0, end - time.monotonic()) * tally.part.weight / weights
            self._part(tally, time.monotonic() + share, options.jobs)
        for thread in threads:
            thread.join()

    def _part(self, tally, end, jobs):
        part = tally.part
        try:
            part.prepare()
        except Skipped as reason:
            tally.skipped = str(reason)
            self._say(tally.line())
            return
        except Exception as failed:  # the other parts go on
            text = str(failed) if isinstance(failed, Failure) else traceback.format_exc()
            self._say(f"FAILED {part.name}, before the first case: {text}")
            tally.count(0, None, text)
            return
        numbers = iter(self.options.only or range(part.goal))
        lock = threading.Lock()
        last = [time.monotonic()]

        def worker():
            while not self.stopped.is_set():
                with lock:
                    # The first case is always done, so that a short campaign tries every part.
                    if tally.tried and time.monotonic() > end:
                        return
                    number = next(numbers, None)
                if number is None:
                    return
                self._case(tally, number, end)
                with lock:
                    if time.monotonic() - last[0] > 20:
                        last[0] = time.monotonic()
                        self._say(tally.line())

        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            for future in [pool.submit(worker) for _ in range(jobs)]:
                future.result()
        self._say(tally.line())

    def _case(self, tally, number, end):
        part = tally.part
        folder = self.folder / f"{part.name}-{number}"
        folder.mkdir()
        part.end = end
        failure, word = "", None
        try:
            word = part.case(number, random_of(self.options.seed, part.name, number), folder)
        except Failure as failed:
            failure = str(failed)
        except Exception:  # a defect of the campaign must not end it, nor be overlooked
            failure = "the campaign itself failed:\n" + traceback.format_exc()
        if failure:
            self._say(f"FAILED {part.name} {number}: {failure}\n    kept in {folder}")
            self.kept += 1
        else:
            shutil.rmtree(folder, ignore_errors=True)
        tally.count(number, word, failure)

    def tidy(self):
        if self.kept == 0:
            shutil.rmtree(self.folder, ignore_errors=True)
        else:
            print(f"{self.kept} folders of failed cases are kept in {self.folder}")


def arguments():
    parser = argparse.ArgumentParser(
        prog="tests/campaign",
        description="Kills, crowds, starves, damages and tires Eyrie for as long as you like, and tells what broke.",
    )
    parser.add_argument("minutes", nargs="?", type=float, default=10.0, help="how long to try (10)")
    parser.add_argument("--seed", type=int, default=None, help="chooses everything that is random (default: random)")
    parser.add_argument("--part", action="append", default=[], choices=[part.name for part in PARTS + WHEN_NAMED], help="only this part; again for more")
    parser.add_argument("--only", type=int, nargs="+", default=[], help="only the cases with these numbers, with --part")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="cases side by side (one for each core)")
    parser.add_argument("--frames", type=int, default=26, help="length of the clip (26)")
    parser.add_argument("--binaries", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--fuzzers", default="", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.only and len(options.part) != 1:
        parser.error("--only needs one --part")
    if options.seed is None:
        options.seed = dice.SystemRandom().randrange(1, 1_000_000)
    return options


def main():
    campaign = Campaign(arguments())
    try:
        campaign.work()
    finally:
        print("\n" + table(campaign.tallies), flush=True)
        campaign.tidy()
    return 1 if any(tally.failures for tally in campaign.tallies) else 0


if __name__ == "__main__":
    sys.exit(main())
