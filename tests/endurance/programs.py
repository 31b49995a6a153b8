"""Starts programs, kills them at a moment, and tells what they said."""

import os
import signal
import subprocess
import threading
import time
from dataclasses import dataclass
from pathlib import Path

HANG_SECONDS = 60


@dataclass
class Result:
    """What a program that has ended said."""

    line: list
    code: int  # negative: the signal that ended it
    out: str
    err: str
    killed: bool  # by us, before it ended
    hung: bool
    seconds: float
    memory_mb: float

    def told(self):
        """The last words, for reports."""
        refusals = [line for line in self.out.splitlines() if line.startswith("refused")]  # of the window's driver
        words = refusals or (self.err.strip() or self.out.strip()).splitlines()
        return words[-1][:300] if words else ""

    def __str__(self):
        state = "hung" if self.hung else "killed" if self.killed else f"ended with {self.code}"
        return f"{' '.join(map(str, self.line))}\n    {state} after {self.seconds:.2f} s: {self.told()}"


class Program:
    """A program at work, out of the reach of our Ctrl-C. Its standard output goes to a file; so does its error output,
    or through a terminal that makes it show its progress."""

    def __init__(self, line, folder, tag, environment=None, terminal=False):
        self.line = [str(word) for word in line]
        self._out = Path(folder) / f".{tag}.out"
        self._err = Path(folder) / f".{tag}.err"
        self._killed = False
        self._ended = threading.Event()
        self._lock = threading.Lock()
        self._started = time.monotonic()
        error_file = open(self._err, "wb")
        drain, slave = None, error_file
        if terminal:
            master, slave = os.openpty()
            drain = threading.Thread(target=_copy, args=(master, error_file), daemon=True)
        with open(self._out, "wb") as output:
            self._process = subprocess.Popen(
                self.line, stdin=subprocess.DEVNULL, stdout=output, stderr=slave, env=environment, cwd=folder,
                process_group=0,
            )  # fmt: skip
        if terminal:
            os.close(slave)
            drain.start()
        else:
            error_file.close()
        self._drain = drain
        threading.Thread(target=self._await, daemon=True).start()

    @property
    def pid(self):
        return self._process.pid

    def _await(self):
        _, status, usage = os.wait4(self._process.pid, 0)
        with self._lock:
            self._process.returncode = os.waitstatus_to_exitcode(status)
            self._memory_mb = usage.ru_maxrss / 1024
            self._seconds = time.monotonic() - self._started
            self._ended.set()

    def kill(self):
        """Kills it unless it has ended."""
        with self._lock:
            if not self._ended.is_set():
                self._killed = True
                os.kill(self._process.pid, signal.SIGKILL)

    def running(self):
        return not self._ended.is_set()

    def wait(self, kill_after=None, limit=HANG_SECONDS):
        """Until it ends; kills it after `kill_after` seconds if given, and after `limit`, which counts as hanging."""
        hung = False
        if kill_after is not None and not self._ended.wait(max(0, kill_after)):
            self.kill()
        if not self._ended.wait(limit):
            hung = True
            self.kill()
            self._ended.wait()
        if self._drain:
            self._drain.join()
        return Result(
            self.line,
            self._process.returncode,
            self._out.read_text(errors="replace"),
            self._err.read_text(errors="replace"),
            self._killed and self._process.returncode == -signal.SIGKILL and not hung,
            hung,
            self._seconds,
            self._memory_mb,
        )


def _copy(master, file):
    with file:
        while True:
            try:
                data = os.read(master, 65536)
            except OSError:  # the other end was closed
                break
            if not data:
                break
            file.write(data)
            file.flush()
    os.close(master)


def run(line, folder, tag="program", **options):
    limit = options.pop("limit", HANG_SECONDS)
    return Program(line, folder, tag, **options).wait(limit=limit)
