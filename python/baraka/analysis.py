"""Results of runs and campaigns as pandas frames and figures, with the numbers of `baraka report`.

    import baraka
    run = baraka.results("results/two_motes")
    run.table("messages")                              # a table of run.sqlite; attrs["units"]: column -> unit
    study = baraka.campaign("results/phases")
    figure = study.figure("messages.delay.p95", versus="control_phase")
    figure.frame, figure.differences, figure.plot()
"""
import contextlib
import json
import os
import pathlib
import shutil
import sqlite3
import subprocess
import tempfile


class AnalysisError(Exception):
    """What `baraka` says of results that it cannot read, or of a figure that it cannot make."""


def results(folder):
    """The result of one run: a folder with run.sqlite."""
    return Results(folder)


def campaign(folder):
    """The results of a campaign: a folder with campaign.sqlite."""
    return Campaign(folder)


def _program():
    """`baraka`: of the build that this package is in, or of the installation, or on the path."""
    here = pathlib.Path(__file__).resolve().parent
    for place in (here.parents[1] / "baraka", here.parents[3] / "bin/baraka"):
        if place.is_file() and os.access(place, os.X_OK):
            return str(place)
    found = shutil.which("baraka")
    if not found:
        raise AnalysisError("the program baraka is not on the path")
    return found


def _baraka(*arguments):
    done = subprocess.run([_program(), *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AnalysisError(done.stderr.strip().removeprefix("error: ") or f"baraka {arguments[0]} failed")
    return done.stdout


class _Folder:
    """What results of a run and of a campaign have in common."""

    database = ""
    _described = []  # whose tables are described: those of every run are the same

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.file = self.folder / self.database
        if not self.file.is_file():
            raise AnalysisError(f"{self.folder}: has no {self.database}")

    def sql(self, query, parameters=()):
        """A query of the database, which is opened for reading, as a frame."""
        import pandas
        with contextlib.closing(sqlite3.connect(f"{self.file.resolve().as_uri()}?mode=ro", uri=True)) as database:
            try:
                return pandas.read_sql_query(query, database, params=parameters)
            except (pandas.errors.DatabaseError, sqlite3.Error) as error:
                raise AnalysisError(f"{self.file}: {error}") from None

    def tables(self):
        """Names of the tables."""
        return list(self.sql("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY rowid")["name"])

    def table(self, name):
        """A whole table; attrs["units"] has the unit of each column that has one."""
        if name not in self.tables():
            raise AnalysisError(f"{self.file}: has no table '{name}'; it has {', '.join(self.tables())}")
        frame = self.sql(f'SELECT * FROM "{name}"')
        frame.attrs["units"] = self.units().get(name, {})
        return frame

    def units(self):
        """table -> column -> unit, as `baraka export --describe` gives them."""
        units, table = {}, None
        for line in _baraka("export", *self._described, "--describe").splitlines():
            if line.startswith("#"):
                table = line.strip("# ")
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            if table and line.startswith("| `") and len(cells) >= 4 and cells[2] != "-":
                units.setdefault(table, {})[cells[0].strip("`")] = cells[2]
        return units

    def figure(self, quantity, versus=None, by=None, agent=None, kind=None, interval=None):
        """One quantity of `baraka describe observables` over the runs: a Figure.

        versus, by: keys of the settings along the axis and of the curves. kind: points, histogram, time or table.
        interval: student or bootstrap.
        """
        return figure([self.folder], quantity, versus, by, agent, kind, interval)


class Results(_Folder):
    """The result of one run."""

    database = "run.sqlite"

    def values(self):
        """The table `run` as a dict: result, fingerprint, seed, simulated_s, …"""
        return dict(zip(*(self.sql("SELECT key, value FROM run")[column] for column in ("key", "value"))))


class Campaign(_Folder):
    """The results of a campaign."""

    database = "campaign.sqlite"

    @property
    def _described(self):
        return [self.folder]

    def runs(self):
        """One row for each run: label of its setting, replication, seed, state, result, fingerprint, …"""
        return self.sql("SELECT label, runs.* FROM runs JOIN points USING (point) ORDER BY point, replication")

    def values(self, quantity):
        """One row for each run that has the quantity of the run itself: label, replication, seed, value."""
        frame = self.sql("SELECT label, replication, seed, value FROM measurements JOIN observables USING (observable) "
                         "JOIN runs USING (run) JOIN points USING (point) WHERE name = ? ORDER BY point, replication",
                         (quantity, ))
        if frame.empty:
            raise AnalysisError(f"{self.file}: no run has the quantity '{quantity}'")
        return frame


def figure(folders, quantity, versus=None, by=None, agent=None, kind=None, interval=None):
    """A Figure of several folders of results, as `baraka report DIR... --figure` makes it."""
    options = (("--versus", versus), ("--by", by), ("--agent", agent), ("--as", kind), ("--interval", interval))
    words = [word for option, value in options if value is not None for word in (option, value)]
    with tempfile.TemporaryDirectory(prefix="baraka-figure-") as folder:
        file = pathlib.Path(folder) / "figure.json"
        _baraka("report", *folders, "--figure", quantity, "-o", file, *words)
        return Figure(json.loads(file.read_text()))


class Figure:
    """A figure's data: means with intervals as the report has them, and paired differences."""

    def __init__(self, data):
        self.data = data
        self.title, self.notes, self.interval, self.first = (data[key] for key in ("title", "notes", "interval", "first"))

    @property
    def frame(self):
        """One row for each mark: curve, x, setting, mean, low, high, sd, runs; a histogram: curve, from, to, count."""
        import pandas
        rows = [{"curve": curve["label"], **mark} for curve in self.data["curves"] for mark in curve["marks"]]
        frame = pandas.DataFrame(rows, columns=["curve", "x", "setting", "y", "low", "high", "sd", "count", "width"])
        if self.data["kind"] == "histogram":
            frame["from"], frame["to"] = frame["x"] - frame["width"] / 2, frame["x"] + frame["width"] / 2
            frame = frame[["curve", "from", "to", "count"]]
        else:
            frame = frame.rename(columns={"y": "mean", "count": "runs"}).drop(columns="width")
        frame.attrs.update(title=self.title, x=self.data["x_label"], y=self.data["y_label"], interval=self.interval,
                           level=self.data["level"], notes=self.notes)
        return frame

    @property
    def differences(self):
        """Each setting less the first, over runs of equal seeds: setting, pairs, difference, low, high, p, correlation."""
        import pandas
        frame = pandas.DataFrame(self.data["differences"], columns=["setting", "pairs", "difference", "low", "high", "p",
                                                                    "correlation"])
        frame.attrs.update(first=self.first, level=self.data["level"], y=self.data["y_label"])
        return frame

    def plot(self, axes=None):
        """Draws it by matplotlib, into `axes` or a new figure; returns the axes."""
        from matplotlib import pyplot
        axes = axes or pyplot.figure().add_subplot()
        for curve in self.data["curves"]:
            self._draw(axes, curve)
        axes.set(title=self.title, xlabel=self.data["x_label"], ylabel=self.data["y_label"])
        if len(self.data["curves"]) > 1:
            axes.legend(title=self.data["curves_are"])
        return axes

    def _draw(self, axes, curve):
        marks = curve["marks"]
        x, y = [mark["x"] for mark in marks], [mark["y"] for mark in marks]
        label = curve["label"] or None
        if self.data["kind"] == "histogram":
            axes.bar(x, [mark["count"] for mark in marks], [mark["width"] for mark in marks], label=label, alpha=0.6)
            return
        # An interval need not hold its mean in the middle, and one run has none.
        bars = [[mark["y"] - mark["low"] if mark["low"] is not None else 0 for mark in marks],
                [mark["high"] - mark["y"] if mark["high"] is not None else 0 for mark in marks]]
        if self.data["kind"] == "time":
            axes.plot(x, y, label=label)
            axes.fill_between(x, [a - b for a, b in zip(y, bars[0])], [a + b for a, b in zip(y, bars[1])], alpha=0.2)
            return
        axes.errorbar(x, y, bars, label=label, marker="o", capsize=3)
        if marks and all(mark["setting"] is not None for mark in marks):
            axes.set_xticks(x, [mark["setting"] for mark in marks])
