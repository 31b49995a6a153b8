"""A small disk that can be filled to the last bytes: a tmpfs, or where that cannot be mounted a limit on the size of
files."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

SIZE_MB = 48


class SmallDisk:
    def __init__(self, folder, mount):
        self.path = Path(folder) / "disk"
        self.path.mkdir()
        self.mounted = False
        self._limit = None
        if mount:
            options = ["-o", f"size={SIZE_MB}m", "tmpfs"]
            subprocess.run(["mount", "-t", "tmpfs", *options, self.path], check=True, capture_output=True)
            self.mounted = True

    def fill(self, free):
        """Leaves `free` bytes, in whole pages."""
        if not self.mounted:
            self._limit = max(1, free // 1024)
            return
        here = os.statvfs(self.path)
        pages = here.f_bavail - free // here.f_frsize
        with open(self.path / "filler", "wb") as file:
            if pages > 0:
                os.posix_fallocate(file.fileno(), 0, pages * here.f_frsize)

    def release(self):
        """Frees the space again."""
        self._limit = None
        (self.path / "filler").unlink(missing_ok=True)

    def line(self, words):
        """The line that runs a program under the limit, where a limit stands for the disk."""
        if self._limit is None:
            return words
        return ["/bin/bash", "-c", f"trap '' XFSZ; ulimit -f {self._limit}; exec \"$0\" \"$@\"", *words]

    def close(self):
        """Keeps what is on it in the folder `kept` beside it."""
        if self.mounted:
            (self.path / "filler").unlink(missing_ok=True)
            shutil.copytree(self.path, self.path.parent / "kept")
            subprocess.run(["umount", "-l", self.path], check=False, capture_output=True)


def can_mount():
    """Whether a tmpfs can be mounted here: tried, since being root is not enough in a container."""
    if os.geteuid() != 0 or shutil.which("mount") is None:
        return False
    folder = Path(tempfile.mkdtemp(prefix="eyrie-mount-"))
    done = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", folder], capture_output=True, check=False)
    if done.returncode == 0:
        subprocess.run(["umount", folder], check=False)
    folder.rmdir()
    return done.returncode == 0
