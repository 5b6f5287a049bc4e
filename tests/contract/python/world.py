"""What the suites beside this file have in common: the package of the build, and what Python and its extensions have allocated.

In a build with the address sanitizer, BARAKA_SANITIZED is set, the sanitizer is preloaded, and Python allocates by malloc().
"""
import ctypes
import gc
import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
BIN = pathlib.Path(os.environ["BARAKA_BIN"])
PROGRAMS = ROOT / "tests/e2e/python"
HERE = pathlib.Path(__file__).resolve().parent
EVERY_CALL = PROGRAMS / "every_call.yaml"
SANITIZED = "BARAKA_SANITIZED" in os.environ

os.environ["BARAKA_CONTROLLER_PATH"] = f"{HERE}:{PROGRAMS}"
sys.path[:0] = [str(BIN / "python"), str(PROGRAMS)]


def allocated():
    """In a build with the sanitizer the bytes that malloc() has given and not got back; else Python's blocks of memory."""
    gc.collect()
    if not SANITIZED:
        return sys.getallocatedblocks()
    count = ctypes.CDLL(None).__sanitizer_get_current_allocated_bytes
    count.restype = ctypes.c_size_t
    return count()


def missing():
    """What a suite needs and this build or machine lacks."""
    try:
        import numpy  # noqa: F401
    except ImportError:
        return "numpy"
    return None if (BIN / "libbaraka_python.so").exists() else "a build with Python's headers and pybind11"


def main():
    lacks = missing()
    if lacks:
        print(f"skipped: needs {lacks}")
        sys.exit(77)
    import unittest
    unittest.main(module="__main__")
