#!/usr/bin/env python3
"""The notebooks of docs/notebooks run from the first cell to the last; what they claim they assert themselves."""
import contextlib
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest

from baraka import BIN, ROOT

MISSING = [name for name in ("nbclient", "nbformat", "ipykernel", "pandas", "matplotlib") if importlib.util.find_spec(name) is None]
if not (BIN / "libbaraka_python.so").exists():
    MISSING.append("a build with Python's headers and pybind11")
SIZES = "GENERATIONS, POPULATION, ELITE = 8, 12, 3\n"
SHOW = """
import hashlib
axes.figure.canvas.draw()
print(curves.shape, curves.tobytes().hex(), mean.tobytes().hex(), half.tobytes().hex(),
      hashlib.sha256(axes.figure.canvas.buffer_rgba()).hexdigest(), (half > 0).all(), len(set(curves.flat)) > 5, sep="\\n")
"""


@contextlib.contextmanager
def busy_loops(count):
    """So many processes that compute without end."""
    loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
        assert all(loop.poll() is None for loop in loops)
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


class Notebooks(unittest.TestCase):
    def setUp(self):
        environment = dict(os.environ)
        self.addCleanup(os.environ.update, environment)
        os.environ.update(PATH=f"{BIN}:{os.environ['PATH']}", PYTHONPATH=str(BIN / "python"), MPLBACKEND="agg",
                          BARAKA_CONTROLLER_PATH=str(BIN))

    def run_notebook(self, name):
        import nbformat
        from nbclient import NotebookClient
        notebook = nbformat.read(ROOT / f"docs/notebooks/{name}.ipynb", 4)
        self.assertFalse([cell for cell in notebook.cells if cell.get("outputs")])  # they are made anew
        with tempfile.TemporaryDirectory() as folder:
            NotebookClient(notebook, timeout=900, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
        return "".join(str(output.get("text", output.get("data", ""))) for cell in notebook.cells
                       for output in cell.get("outputs", []))

    def test_first_results(self):
        self.assertIn("fingerprint: ", self.run_notebook("first_results"))

    def test_campaign_figure(self):
        self.assertIn("finished: 12", self.run_notebook("campaign_figure"))

    def test_learning(self):
        self.assertIn("learned: ", self.run_notebook("learning"))

    def learned_curve(self):
        """The five seeds' curves, their mean, its intervals and the figure of the notebook's own cells, with smaller searches."""
        notebook = json.loads((ROOT / "docs/notebooks/learning.ipynb").read_text())
        cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
        code = "\n".join(cells[:2])
        self.assertEqual(code.count(SIZES), 1)
        code = code.replace(SIZES, "GENERATIONS, POPULATION, ELITE = 3, 4, 2\n")
        done = subprocess.run([sys.executable, "-c", code + SHOW], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_learning_gives_the_same_curve_beside_busy_loops(self):
        alone = self.learned_curve()
        with busy_loops(os.cpu_count()):
            self.assertEqual(self.learned_curve(), alone)
        self.assertIn("(5, 3)", alone)
        self.assertEqual(alone.split()[-2:], ["True", "True"])  # it has intervals, and is not the same everywhere


if __name__ == "__main__":
    if MISSING:
        print(f"skipped: needs {', '.join(MISSING)}")
        sys.exit(77)
    unittest.main()
