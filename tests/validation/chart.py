"""Figures as data: a Chart has Panels, a Panel what was drawn to it, in that order. The program draw_chart.cpp draws the JSON
of it, whose keys are the members of results::report::Chart (results/report/chart.h)."""
import json
import math

GREY, BLACK = -1, 6  # curves of these colours; 0 to 7 are all that there are


def axis(label="", log=False, limits=(None, None), ticks=(), names=()):
    """@param limits  None: as the data have it. @param names  of the places 0, 1, 2 ..., in place of numbers."""
    return {"label": label, "is_log": log, "low": limits[0], "high": limits[1], "ticks": list(ticks), "names": list(names)}


def numbers(values):
    return [float(one) if math.isfinite(one) else None for one in values]


def ends(pairs):
    """Of intervals, (low, high) of each value; None: there are none."""
    low, high = zip(*pairs) if pairs else ((), ())
    return {"low": numbers(low), "high": numbers(high)}


def around(values, halves):
    """Symmetric intervals: [(low, high)]."""
    return [(value - half, value + half) for value, half in zip(values, halves)]


def series(label, y, curve, intervals=None, texts=()):
    """For Panel.bars(). @param texts  above the bars"""
    return {"label": label, "curve": curve, "y": numbers(y), **ends(intervals), "texts": list(texts)}


class Panel:
    """`style` of what is drawn: label (in the legend), curve (number of the colour), dash (solid, dashed, dotted), stroke (px),
    opacity."""

    def __init__(self, title="", x=None, y=None):
        """@param x, y  what axis() gives"""
        self.title, self.x, self.y, self.layers = title, x or axis(), y or axis(), []

    def line(self, x, y, stepped=False, **style):
        """@param stepped  each y holds until the next x"""
        self.layers.append({"kind": "line", "x": numbers(x), "y": numbers(y), "is_stepped": stepped, **style})

    def marks(self, x, y, shape="circle", intervals=None, scale=1, **style):
        """@param shape  circle, cross or plus. @param intervals  [(low, high)] of y"""
        self.layers.append({"kind": "marks", "x": numbers(x), "y": numbers(y), "shape": shape, "scale": scale,
                            **ends(intervals), **style})

    def line_and_marks(self, x, y, **style):
        self.line(x, y, **style)
        self.marks(x, y, **style)

    def bars(self, at, *given, width=0.8, stacked=False):
        """@param given  what series() gives, side by side or stacked. @param width  of those at one place together"""
        self.layers.append({"kind": "bars", "at": numbers(at), "series": list(given), "width": width, "is_stacked": stacked})

    def vertical(self, x, **style):
        self.layers.append({"kind": "reference", "at": x, "curve": GREY, **style})

    def horizontal(self, y, **style):
        self.layers.append({"kind": "reference", "at": y, "is_upright": False, "curve": GREY, **style})

    def span(self, low, high, **style):
        """Shades a range of x."""
        self.layers.append({"kind": "span", "from": low, "to": high, "curve": GREY, **style})

    def text(self, x, y, text, **style):
        """Read upwards; ends at y, to the right of x."""
        self.layers.append({"kind": "text", "x": x, "y": y, "text": text, "curve": GREY, **style})


class Chart:
    def __init__(self, *panels, title="", columns=1, size=(640, 340), shares=""):
        """@param size  width and height, px. @param shares  "x", "y" or "xy": axes whose limits are the same in all panels"""
        self.members = {"title": title, "columns": columns, "width": size[0], "height": size[1], "shares_x": "x" in shares,
                        "shares_y": "y" in shares}
        self.panels = panels

    def json(self):
        return json.dumps({**self.members, "panels": [vars(panel) for panel in self.panels]}, allow_nan=False)
