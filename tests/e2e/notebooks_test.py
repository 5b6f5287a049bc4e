#!/usr/bin/env python3
"""The notebooks of docs/notebooks run from the first cell to the last; what they claim they assert themselves."""
import importlib.util
import os
import sys
import tempfile
import unittest

from baraka import BIN, ROOT

MISSING = [name for name in ("nbclient", "nbformat", "ipykernel", "pandas", "matplotlib") if importlib.util.find_spec(name) is None]
if not (BIN / "libbaraka_python.so").exists():
    MISSING.append("a build with Python's headers and pybind11")


class Notebooks(unittest.TestCase):
    def run_notebook(self, name):
        import nbformat
        from nbclient import NotebookClient
        os.environ.update(PATH=f"{BIN}:{os.environ['PATH']}", PYTHONPATH=str(BIN / "python"), MPLBACKEND="agg",
                          BARAKA_CONTROLLER_PATH=str(BIN))
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


if __name__ == "__main__":
    if MISSING:
        print(f"skipped: needs {', '.join(MISSING)}")
        sys.exit(77)
    unittest.main()
