"""Damaged and tampered projects, videos and pictures in every command that reads them and in the window: no crash, no
exit 1, no hang, and no more than 1 GB of memory."""

import shutil

from cases import Failure, Part, judge
from damage_kinds import FILE_DAMAGES, TAMPERINGS, damage_file, tamper
from programs import run

MOST_MEMORY_MB = 1000
MOST_SECONDS = 40
PICTURES = ("png", "jpg", "tif", "bmp", "pgm")


def project_words(world, project, folder):
    truth = ["--ground-truth", world.truth]
    return {
        "info": ["info", project],
        "export": ["export", "--project", project, "--format", "native", "--out", folder / "x.csv"],
        "export-labels": ["export", "--project", project, "--labels", "--format", "native", "--out", folder / "x.csv"],
        "evaluate": ["evaluate", "--project", project, *truth],
        "report": ["report", "--project", project, *truth, "--chips", "2", "--out", folder / "x.html"],
        "run": ["run", world.clip, "--project", project, "--gsd", "0.2", "--quiet"],
        "import": ["import", world.labels("A"), "--project", project],
        "sweep": ["sweep", "--project", project, "--run", "1", *truth, "--quiet", "--parameter",
                  "gradient.quantile=0.3"],
        "merge": ["merge", project, "--out", folder / "merged.eyrie"],
        "check": ["check", project],
        "window": None,
    }  # fmt: skip


class Damage(Part):
    name = "damage"
    goal = 1200
    weight = 1.5

    def prepare(self):
        help_text = run([self.world.cli, "--help"], self.world.folder, "help").out
        self._has_check = "\n  check" in help_text

    def case(self, number, random, folder):
        sort = random.choice(("damaged project", "tampered project", "tampered project", "video", "pictures"))
        environment = self.world.environment(folder / "home")
        if sort in ("video", "pictures"):
            harmed, what = self._harmed_input(sort, random, folder)
            command = random.choice(("info", "run", "window"))
            words = ["run", harmed, "--project", folder / "p.eyrie", "--gsd", "0.2", "--quiet"]
            line = [self.world.cli, *(words if command == "run" else ["info", harmed])]
            if command == "window":
                line = [self.world.driver, "video", harmed, folder / "p.eyrie", "show"]
        else:
            harmed = self.world.base_in(folder)
            what = damage_file(harmed, random) if sort == "damaged project" else tamper(harmed, random)
            commands = project_words(self.world, harmed, folder)
            if not self._has_check:
                del commands["check"]
            command = random.choice(list(commands))
            line = [self.world.cli, *commands[command]] if command != "window" else [
                self.world.driver, "open", harmed, "show", "label", "1", "A"]  # fmt: skip
        result = run(line, folder, "reader", environment=environment)
        self._judge(result, command, harmed, what)
        return sort

    def _harmed_input(self, sort, random, folder):
        if sort == "video":
            name = random.choice(("clip.mp4", "clip.ts"))
            shutil.copy(self.world.inputs / name, folder / name)
            return folder / name, damage_file(folder / name, random)
        kind = random.choice(PICTURES)
        pictures = folder / kind
        shutil.copytree(self.world.inputs / "pictures" / kind, pictures)
        harmed = pictures / f"{random.randrange(4)}.{kind}"
        # Most of it in the header, which is what programs believe.
        return pictures, damage_file(harmed, random, first=64 if random.random() < 0.7 else None)

    def _judge(self, result, command, harmed, what):
        try:
            judge(result, {0, 2, 3, 4, 5} if command != "window" else {0, 3})
        except Failure as failure:
            raise Failure(f"{what}: {failure}") from failure
        # A project may name another file as its video, or nonsense of some length.
        said = result.out + result.err
        if result.code != 0 and harmed.name not in said and "/" not in said and "xxxx" not in said:
            raise Failure(f"{what}: the message names no file: {result}")
        if result.memory_mb > MOST_MEMORY_MB:
            raise Failure(f"{what}: {result.memory_mb:.0f} MB of memory: {result}")
        if result.seconds > MOST_SECONDS:
            raise Failure(f"{what}: slow: {result}")

    def rest(self):
        return f"{len(FILE_DAMAGES)} kinds of damage, {len(TAMPERINGS)} of tampering"
