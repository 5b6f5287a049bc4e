"""BARAKA in Python: controllers of simulated and real robots.

    import baraka

    class Wanderer(baraka.Controller):
        def step(self):
            self.agent.set_body_velocity(0.2)

    if __name__ == "__main__":
        baraka.main(Wanderer)
"""
import pathlib
import sys

from ._hal import (EVERYONE, LAST_ADDRESS, NEIGHBOURS, CallError, ControllerFailed, Error, InvalidArgument, Mote,
                   Network, NotAvailable, NotConnected, PathMetric, ProtocolError, RandomStream, RealWorldObject,
                   Robot, Timeout, draw_route, math)
from .analysis import AnalysisError, Campaign, Figure, Results, campaign, figure, results
from .controller import Controller, Mistake, Parameter, Parameters, kind_of
from .values import (BodyWheel, Channel, Drive, Fate, Imu, InfraredReading, Message, Neighbour, Odometry, Pose2,
                     Priority, RobotBody, Route, Scan, Solid, Twist2, Vec2, Vec3)

sys.modules["baraka.math"] = math  # for `from baraka.math import sin`
for _one in (RealWorldObject, Mote, Robot, Network, RandomStream, PathMetric):
    _one.__module__ = "baraka"  # where users find them


def __getattr__(name):
    """Box and Environment, with the simulator and numpy, only when they are asked for."""
    if name in ("Box", "Environment"):
        from . import environment
        return getattr(environment, name)
    raise AttributeError(f"module 'baraka' has no attribute '{name}'")


def main(of_class, arguments=None):
    """Runs controllers of a class until the run ends, then exits: the main program of a controller.

    The options are those of every controller: --agents, --domain, --name, --stay, --wait; see --help.
    """
    from . import _process  # loads Fast DDS, which a controller in process does without
    arguments = list(sys.argv if arguments is None else arguments)
    name = pathlib.Path(arguments[0]).name
    sys.exit(_process.run(kind_of(of_class, name), arguments))
