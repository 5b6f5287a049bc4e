"""Marks of what has passed as it is, in the user's cache."""
import hashlib
import os
import pathlib
import time

KEPT = 30 * 86400  # s, of a mark that nobody asked for


class Marks:
    """Those of one kind of check."""

    def __init__(self, kind):
        cache = os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache"
        self.folder = pathlib.Path(cache) / "baraka" / kind
        self.folder.mkdir(parents=True, exist_ok=True)
        for mark in self.folder.iterdir():
            if time.time() - mark.stat().st_mtime > KEPT:
                mark.unlink(missing_ok=True)

    @staticmethod
    def of(*inputs):
        """The name of a mark, from the bytes of all that could change the outcome."""
        digest = hashlib.sha256()
        for one in inputs:
            digest.update(len(one).to_bytes(8, "big") + one)
        return digest.hexdigest()

    def has(self, mark):
        """Whether it is there; it is then kept for longer."""
        there = (self.folder / mark).exists()
        if there:
            self.set(mark)
        return there

    def set(self, mark):
        (self.folder / mark).touch()
