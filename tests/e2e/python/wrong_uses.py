"""Sixty wrong uses of the HAL: each raises what it is said to, and the robot drives on."""
import math
import threading

import baraka

NAN, INF = math.nan, math.inf
I, T, N, C = baraka.InvalidArgument, TypeError, baraka.NotAvailable, baraka.CallError
SURROGATE = "\ud800"


class NoNumber:
    def __float__(self):
        raise ZeroDivisionError("no number")


def uses(a):
    """(what, exception) of robot r0 with the channels odometry; it is address 1, the other robot 2."""
    other_thread = lambda call: in_thread(call)
    return [
        (lambda: a.send(2, "t", "text"), T), (lambda: a.send(2, "t", 5), T), (lambda: a.send(2, "t", None), T),
        (lambda: a.send(2, "t", bytes(2049)), I), (lambda: a.send(2, "", b""), I), (lambda: a.send(2, "t" * 33, b""), I),
        (lambda: a.send(1, "t", b""), I), (lambda: a.send(-1, "t", b""), I), (lambda: a.send(65536, "t", b""), I),
        (lambda: a.send(10**30, "t", b""), I), (lambda: a.send("m0", "t", b""), T), (lambda: a.send(2.0, "t", b""), T),
        (lambda: a.send(True, "t", b""), T), (lambda: a.send(2, 7, b""), T), (lambda: a.send(2, SURROGATE, b""), I),
        (lambda: a.send(2, "t", b"", 8), I), (lambda: a.send(2, "t", b"", -1), I), (lambda: a.send(2, "t", b"", "high"), T),
        (lambda: a.send(), T), (lambda: a.send(2, "t", b"", prio=1), T), (lambda: a.send(2, "t", memoryview(b"abc")[::2]), T),
        (lambda: a.set_timer(1, -1), I), (lambda: a.set_timer(1, NAN), I), (lambda: a.set_timer(1, INF), I),
        (lambda: a.set_timer(-1, 5), I), (lambda: a.set_timer(2**32, 5), I), (lambda: a.set_timer("x", 5), T),
        (lambda: a.set_timer(1, "soon"), T), (lambda: a.set_timer(1.5, 5), T), (lambda: a.set_timer(1, 1e300), I),
        (lambda: a.reading("nothing"), N), (lambda: a.reading(5), T), (lambda: a.reading(None), T),
        (lambda: a.infrared(), N), (lambda: a.scan(), N), (lambda: a.imu(), N), (lambda: a.bumped(), N),
        (lambda: a.pose(), N), (lambda: a.battery(), N), (lambda: a.relative_position(2), N),
        (lambda: a.relative_position("m0"), T), (lambda: a.set_body_velocity(NAN), I), (lambda: a.set_body_velocity(0, INF), I),
        (lambda: a.set_body_velocity("fast"), T), (lambda: a.set_body_velocity((1, 0, 0)), T),
        (lambda: a.set_body_velocity(NoNumber()), T), (lambda: a.set_wheel_speeds([1]), I), (lambda: a.set_wheel_speeds(1), T),
        (lambda: a.set_wheel_speeds("12"), T), (lambda: a.set_wheel_speeds([NAN, 1, 1]), I),
        (lambda: a.set_wheel_speeds([1e9, 1, 1]), I), (lambda: a.set_wheel_speeds({1: 2}), T), (lambda: a.set_radio(1), T),
        (lambda: a.state(5), T), (lambda: a.record("x", "y"), T), (lambda: a.record(None, 1), T),
        (lambda: a.log("loud", "text"), I), (lambda: a.log("info", b"text"), T), (lambda: a.random().below(0), I),
        (lambda: a.random().below(-5), I), (lambda: a.random().below(2**32), I), (lambda: a.random().below(1.5), T),
        (lambda: a.network().routes(5, 2), T), (lambda: a.network().invalidate("", 2), I), (lambda: a.nonsense(), AttributeError),
        (lambda: baraka.draw_route([], baraka.PathMetric(), 2, a.random()), I),
        (lambda: baraka.draw_route([1], baraka.PathMetric(), 2, a.random()), T),
        (lambda: baraka.draw_route(route(), baraka.PathMetric(), 0.5, a.random()), I), (lambda: baraka.PathMetric("smell"), I),
        (lambda: baraka.PathMetric("hops", -1), I), (lambda: baraka.math.sin("x"), T), (lambda: baraka.math.wrap_angle(INF), I),
        (lambda: baraka.Robot(), T), (lambda: baraka.Network(), T), (lambda: type(a)(), T),
        (lambda: other_thread(a.now), C), (lambda: other_thread(lambda: a.set_body_velocity(1)), C),
        (lambda: other_thread(lambda: a.send(2, "t", b"")), C), (lambda: other_thread(a.random().uniform), C),
    ]


def route():
    return [baraka.Route("t", 2, 2, 1, 0.1, 10.0, 0.1)]


def in_thread(call):
    raised = []

    def run():
        try:
            call()
        except Exception as error:
            raised.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    if raised:
        raise raised[0]


class WrongUses(baraka.Controller):
    channels = ["odometry"]
    kept = []  # agents of all controllers of this process, also of one that was killed

    def __init__(self, robot, parameters):
        self.agent = robot
        self.made = len(WrongUses.kept)
        WrongUses.kept.append(robot)
        self.steps = 0

    def expect(self, number, call, wanted):
        try:
            result = call()
        except Exception as error:
            verdict = "right" if type(error) is wanted else "WRONG"
            self.agent.log("info", f"{verdict} {number}: {type(error).__name__}: {error}")
        else:
            self.agent.log("info", f"WRONG {number}: gave {result!r}")

    def step(self):
        self.steps += 1
        if self.made == 0 and self.steps == 2:
            all_uses = uses(self.agent)
            for number, (call, wanted) in enumerate(all_uses):
                self.expect(number, call, wanted)
            self.expect(len(all_uses), lambda: WrongUses.kept[1].now(), C)  # the other's, which is not in a callback
            self.agent.log("info", f"{len(all_uses) + 1} wrong uses")
        if self.made == 2 and self.steps == 2:  # after the restart of r0
            self.expect("after the end", lambda: WrongUses.kept[0].now(), C)
            self.expect("after the end: random", lambda: WrongUses.kept[0].random().next(), C)
            self.expect("after the end: repr", lambda: {}[repr(WrongUses.kept[0])], KeyError)
        self.agent.set_body_velocity(0.1)
