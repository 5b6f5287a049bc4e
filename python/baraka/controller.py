"""Controllers in Python: the class to derive from, and what it declares."""
import math

from . import _hal


class Parameter:
    """A parameter of a controller, in SI units; its default decides its kind.

    Parameter(0.5, "m/s", 0, 2, "How fast.")          a number with its unit and range
    Parameter(False, meaning="Whether it patrols.")   a flag
    Parameter("near", choices=["near", "far"])        a text; names="agent" if it is one's name
    Parameter([], "m", meaning="x, y, x, y, …")       numbers;  without a unit: texts
    """

    def __init__(self, default, unit="", low=None, high=None, meaning="", *, choices=(), names="",
                 besides=(), is_used=None):
        self.default = default
        self.kind = _kind_of(default, unit)
        self.unit = unit or ("1" if self.kind in ("number", "numbers") else "")
        self.low = -math.inf if low is None else low
        self.high = math.inf if high is None else high
        self.meaning = meaning
        self.choices = choices
        self.names = names
        self.besides = besides
        self.is_used = is_used


def _kind_of(default, unit):
    if isinstance(default, bool):
        return "flag"
    if isinstance(default, str):
        return "text"
    if isinstance(default, (list, tuple)):
        has_texts = any(isinstance(one, str) for one in default) or (not default and not unit)
        return "texts" if has_texts else "numbers"
    return "number"


class Mistake:
    """A contradiction between parameters that are valid one by one, for `judge`."""

    def __init__(self, name, what, can_work=False):
        self.name = name
        self.what = what
        self.can_work = can_work


class Parameters(dict):
    """The checked parameters of one agent, in SI units, with defaults: parameters["speed"]."""

    def __init__(self, values, given):
        super().__init__(values)
        self._given = given

    def __missing__(self, name):
        raise KeyError(f"'{name}' is no parameter of this controller, which has: {', '.join(self) or 'none'}")

    def is_given(self, name):
        """Whether the scenario sets it, even to the default."""
        self[name]
        return name in self._given


class Controller:
    """The behaviour of one agent; hal/api/controller.h in Python.

    The constructor gets a Robot or a Mote and the Parameters. One callback at a time; calls of the agent are for
    callbacks only. An exception in a callback ends the run.
    """

    runs_on = ["robot"]     # "robot", "mote" or both
    channels = []           # names of channels that it requires
    optional_channels = []  # names of channels that it uses where an agent has them
    watched = []            # topics whose routes it reads
    neighbours = False      # whether it reads the list of neighbours
    names = False           # whether it uses address_of() and name_of()
    parameters = {}         # name -> Parameter
    judge = None            # a static method: Parameters -> list of Mistake
    states = []             # all names that it passes to state(); empty: any
    records = {}            # name -> (unit, meaning) of all that it passes to record(); empty: any

    def __init__(self, agent, parameters):
        self.agent = agent

    def start(self):
        """Called once, before all other calls."""

    def step(self):
        """Called once per control cycle."""

    def receive(self, message):
        """A message has arrived: a Message."""

    def timer(self, id):
        """A timer of set_timer() has expired."""

    def notice(self, id, fate):
        """The Fate of a message that this agent sent."""

    def stop(self):
        """Called once, when the run ends."""


def kind_of(of_class, name):
    """A class's description, checked: what `baraka` reads. Raises InvalidArgument, TypeError."""
    if not (isinstance(of_class, type) and issubclass(of_class, Controller)) or of_class is Controller:
        raise TypeError(f"{name}: is no class below baraka.Controller")
    return _hal.kind_of(of_class, name)
