"""Every writing command and the window on a disk with little or no room: they say so, name the file and end with 4;
nothing old is lost; when there is room again the same command works."""

from actions import MAKERS, action
from cases import Failure, Part, judge
from programs import Program
from project_facts import compare, facts
from small_disk import SmallDisk, can_mount

WRITERS = (
    "run", "sweep", "import", "merge", "window", "compare", "run-tracks", "sweep-run", "export", "run-video", "report",
    "evaluate", "import-file", "train", "render",
)  # fmt: skip


class FullDisk(Part):
    name = "full-disk"
    goal = 40 * len(WRITERS)
    weight = 1.5

    def prepare(self):
        self._mount = can_mount()

    def case(self, number, random, folder):
        name = WRITERS[number % len(WRITERS)]
        exists = name not in MAKERS or random.random() < 0.6
        # Nothing at all, a page or two, or anything up to enough.
        free = random.choice((0, 4096, 8192, int(4096 * 2 ** random.uniform(0, 10)), random.randrange(2_000_000)))
        disk = SmallDisk(folder, self._mount)
        try:
            return self._on(disk, name, exists, free, random, folder)
        finally:
            disk.close()

    def _on(self, disk, name, exists, free, random, folder):
        project = disk.path / "p.eyrie"
        if exists:
            self.world.base_in(disk.path)
        before = facts(project, folder)
        environment = self.world.environment(folder / "home")
        one = action(name, self.world, disk.path, project, exists, "A", random)
        line = one.line()
        disk.fill(free)
        result = Program(disk.line(line), folder, "writer", environment, one.terminal).wait()
        said = result.out + result.err
        if name == "window":
            judge(result, {0, 3})
        else:
            judge(result, {0, 4})
        if result.code != 0 and not any(part.name in said for part in (project, one.output, disk.path / "rendered") if part):
            raise Failure(f"with {free} bytes free the message names no file: {result}")
        held = facts(project, folder)
        compare(before, held, "was there before")
        compare(one.claims(result), held, f"{name} told to be done with {free} bytes free: {result}")
        one.check_output(result)

        disk.release()
        following = one.again()
        again = Program(following.line(), folder, "again", environment, following.terminal).wait()
        judge(again, {0})
        held = facts(project, folder)
        compare(before, held, "was there before")
        compare(following.claims(again), held, "was told to be done when there was room again")
        return "refused" if result.code else "enough room"

    def rest(self):
        return "on a small tmpfs" if getattr(self, "_mount", False) else "file sizes limited: no right to mount"
