"""The window plays, seeks, switches runs and runs again for the whole time: its memory and the number of its threads
stay flat."""

import time

from cases import Failure, Part, judge
from programs import Program

MOST_GROWTH_MB = 10  # over the second half, by a line through the samples
MOST_GROWTH_SHARE = 0.03  # or this share of the mean, whichever is more
MOST_NEW_THREADS = 2


class Soak(Part):
    name = "soak"
    goal = 1
    alone = True

    def __init__(self, world):
        super().__init__(world)
        self._told = ""

    def case(self, number, random, folder):
        project = self.world.base_in(folder)
        seconds = max(5.0, self.end - time.monotonic() - 5)
        line = [self.world.driver, "open", project, "soak", f"{seconds:.0f}"]
        window = Program(line, folder, "window", self.world.environment(folder / "home"))
        samples = []
        begin = time.monotonic()
        while window.running() and time.monotonic() - begin < seconds + 90 and not self.world.stopped.is_set():
            sample = status_of(window.pid)
            if sample:
                samples.append((time.monotonic() - begin, *sample))
            time.sleep(min(1.0, seconds / 40))
        stopped = self.world.stopped.is_set()
        result = window.wait(kill_after=0 if stopped else None, limit=10)
        judge(result, {0})
        rounds = result.out.count("done round")
        if len(samples) < 4:
            return None
        self._judge(samples[len(samples) // 2 :], samples[: len(samples) // 2], rounds)
        return None

    def _judge(self, late, early, rounds):
        mean = sum(memory for _, memory, _ in late) / len(late)
        growth = slope([(at, memory) for at, memory, _ in late]) * (late[-1][0] - late[0][0])
        threads = max(count for *_, count in late) - max(count for *_, count in early)
        self._told = (
            f"{rounds} rounds, {mean:.0f} MB, {growth:+.1f} MB and {threads:+d} threads over the second half of "
            f"{late[-1][0]:.0f} s"
        )
        # A window that has just begun still fills its caches.
        if rounds >= 20 and growth > max(MOST_GROWTH_MB, MOST_GROWTH_SHARE * mean):
            raise Failure(f"memory grows: {self._told}")
        if threads > MOST_NEW_THREADS:
            raise Failure(f"threads become more: {self._told}")

    def rest(self):
        return self._told


def status_of(pid):
    """Resident memory in MB and number of threads, or nothing when the program has ended."""
    try:
        with open(f"/proc/{pid}/status", encoding="ascii", errors="replace") as file:
            fields = dict(line.split(":", 1) for line in file if ":" in line)
        return int(fields["VmRSS"].split()[0]) / 1024, int(fields["Threads"])
    except (OSError, KeyError, ValueError):
        return None


def slope(points):
    """Of the line through points by least squares."""
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    across = sum((x - mean_x) ** 2 for x, _ in points)
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / across if across else 0.0
