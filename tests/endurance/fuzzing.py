"""Fuzz targets under the sanitizers: bytes that grow out of good files, for every label format and whatever else is
read from files."""

import os
import re
import shutil
from pathlib import Path

from cases import Failure, Part, Skipped
from programs import Program, run

DICTIONARY = Path(__file__).parent.parent / "fuzz" / "dictionaries" / "labels.dict"
INPUTS = 1_000_000  # of a target in a full campaign
SLICE = 50_000  # inputs that a case tries, so that what was found is known early


class Target:
    """A fuzz target with its options, and the folder of good files that it begins with."""

    def __init__(self, name, program, options=(), seeds=None, inputs=SLICE, max_len=4096):
        self.name, self.program, self.options = name, program, list(options)
        self.seeds, self.runs, self.max_len = seeds or name, inputs, max_len
        self.slices = INPUTS // inputs  # cases


class Fuzzing(Part):
    name = "fuzz"
    weight = 4.0

    def prepare(self):
        if not self.world.fuzzers:
            raise Skipped("the fuzz targets were not built (clang is missing, or --without-fuzzers)")
        self._folder = Path(self.world.fuzzers)
        self._corpus = self.world.folder / "corpus"
        seeds = run([self._folder / "fuzz_seeds", self._corpus], self.world.folder, "seeds", limit=300)
        if seeds.code != 0:
            raise Skipped(f"no seeds: {seeds}")
        for name in ("index-cache", "packed", "project", "video", "auto"):
            (self._corpus / name).mkdir(exist_ok=True)
        for name in ("corner.mp4", "corner.ts"):
            shutil.copy(self.world.inputs / name, self._corpus / "video" / name)
        self._dictionaries = self.world.folder / "dictionary"
        formats = [line for line in seeds.out.splitlines() if line]
        for number, name in enumerate(formats):
            for seed in (self._corpus / name).iterdir():
                shutil.copy(seed, self._corpus / "auto" / f"{number}-{seed.name}")
        self._targets = [
            *(Target(name, "labels_fuzz", [f"--format={name}"]) for name in [*formats, "auto"]),
            *(
                Target(name, "tables_fuzz", [f"--table={name}"])
                for name in ("boxes", "homographies", "parts", "template")
            ),
            Target("preset", "preset_fuzz"),
            Target("index-cache", "index_cache_fuzz"),
            Target("packed", "packed_fuzz"),
            Target("metadata", "metadata_fuzz"),
            Target("project", "project_fuzz", [f"--project={self.world.base}"], max_len=120),
            Target("video", "video_fuzz", inputs=10_000, max_len=12_000),
        ]
        # Round by round, so that a short campaign tries each.
        rounds = max(target.slices for target in self._targets)
        self._order = [target for at in range(rounds) for target in self._targets if at < target.slices]
        self.goal = len(self._order)
        self._done = {target.name: 0 for target in self._targets}

    def case(self, number, random, folder):
        target = self._order[number]
        found = folder / "found"
        corpus = folder / "corpus"  # of the case alone, so that its seed repeats it
        found.mkdir()
        corpus.mkdir()
        line = [
            self._folder / target.program, *target.options, f"-runs={target.runs}", f"-seed={random.randrange(1, 2**31)}",
            f"-max_len={target.max_len}", f"-dict={DICTIONARY}", "-timeout=60", "-rss_limit_mb=1500", "-verbosity=0",
            "-print_final_stats=1", "-detect_leaks=0", f"-artifact_prefix={found}/", corpus, self._corpus / target.seeds,
        ]  # fmt: skip
        environment = dict(os.environ, UBSAN_OPTIONS="print_stacktrace=1", TMPDIR=str(folder))
        result = Program(line, folder, "fuzzer", environment).wait(limit=1800)
        tried = re.search(r"stat::number_of_executed_units: (\d+)", result.err)
        self._done[target.name] += int(tried.group(1)) if tried else 0
        if result.code != 0 or result.hung:
            inputs = ", ".join(str(path) for path in found.iterdir()) or "none"
            problem = re.search(r"(ERROR: .*|.*runtime error: .*|internal error.*|terminate called.*)", result.err)
            what = problem.group(1) if problem else result.told()
            raise Failure(f"{target.name}: {what}\n    input: {inputs}; see {folder}/.fuzzer.err")
        return None

    def rest(self):
        if not getattr(self, "_done", None):
            return ""
        least = min(self._done, key=self._done.get)
        counts = ", ".join(f"{name} {count:,}" for name, count in self._done.items())
        return f"{sum(self._done.values()):,} inputs, fewest {least}: {counts}"
