#!/usr/bin/env python3
"""No call of the HAL, right or wrong, and no episode keeps memory or a reference, or gives back one too many."""
import ctypes
import sys
import unittest

import world

# Under the sanitizers a call costs twenty times as much.
CALLS, WARM, WINDOWS = 200 if world.SANITIZED else 1000, 3, 5  # calls that are counted; control cycles before that; how often it is counted at most
CYCLES = 10  # control cycles in which they are
SMALLEST = 8 if world.SANITIZED else 0.5  # of what can be left by a call: bytes, or blocks


def every_call(a, baraka):
    """name -> call, of an agent with all sensors; the arguments are kept, so that their references can be counted."""
    kept = {"payload": bytes(range(7)), "topic": "every", "speeds": [1.0, 1.5], "name": "a name that is not in the scenario",
            "route": baraka.Route("every", 2, 2, 1, 0.1, 10.0, 0.1), "metric": baraka.PathMetric("delay", 0),
            "array": bytearray(b"abc"), "number": 0.25, "line": "a text", "angle": 12345.678, "state": "RUNNING"}
    kept["routes"] = [kept["route"]]
    network, random = a.network(), a.random()
    calls = {
        "id": a.id, "name": a.name, "now": a.now, "now_ns": a.now_ns, "control_period": a.control_period,
        "air_interface": a.air_interface, "address_of": lambda: (a.address_of("m0"), a.address_of(kept["name"])),
        "name_of": lambda: (a.name_of(1), a.name_of(9)), "state": lambda: a.state(kept["state"]),
        "record": lambda: a.record("now", kept["number"]), "log": lambda: a.log("debug", kept["line"]),
        "battery": a.battery, "battery_energy": a.battery_energy, "battery_capacity": a.battery_capacity,
        "set_radio": lambda: a.set_radio(True), "set_timer": lambda: a.set_timer(7, a.now() + kept["number"]),
        "channels": a.channels, "reading": lambda: a.reading("scan"),
        "relative_position": lambda: a.relative_position(2), "network": a.network,
        "routes": lambda: network.routes(kept["topic"], 2), "neighbours": network.neighbours,
        "invalidate": lambda: network.invalidate(kept["topic"], 2),
        "send": lambda: a.send(2, kept["topic"], kept["payload"], baraka.Priority.VIDEO),
        "send a bytearray": lambda: a.send(baraka.EVERYONE, kept["topic"], kept["array"]),
        "random": a.random, "next": random.next, "below": lambda: random.below(6), "uniform": random.uniform,
        "normal": random.normal, "draw_route": lambda: baraka.draw_route(kept["routes"], kept["metric"], 2, random),
        "PathMetric": lambda: baraka.PathMetric("energy", kept["number"]), "body": a.body,
        "set_body_velocity": lambda: a.set_body_velocity(kept["number"], 0, 0),
        "set_wheel_speeds": lambda: a.set_wheel_speeds(kept["speeds"]), "infrared": a.infrared, "odometry": a.odometry,
        "scan": a.scan, "imu": a.imu, "bumped": a.bumped, "pose": a.pose, "repr": lambda: repr(a),
        "sin": lambda: baraka.math.sin(kept["angle"]), "atan2": lambda: baraka.math.atan2(kept["angle"], 1),
        "wrap_angle": lambda: baraka.math.wrap_angle(kept["angle"]), "pow": lambda: baraka.math.pow(2, kept["number"])}
    return calls, kept


def caught(call, wanted):
    """A wrong use, whose exception is dropped."""
    def use():
        try:
            call()
        except wanted:
            return
        raise AssertionError("nothing was raised")
    return use


def left_by(references, memory):
    """What a thousand calls have left, if each has left something: references, and memory."""
    kept = {name: n for name, n in references.items() if abs(n) > CALLS / 2}
    return (kept, memory) if kept or memory > SMALLEST * CALLS else None


class Counter:
    """Makes the calls one after the other, each in control cycles of its own, and counts at the first and after the last.

    What grows is counted again, for the simulated world and Python have memory of their own that grows now and then.
    """

    def __init__(self, make_calls, baraka):
        self.make_calls, self.baraka = make_calls, baraka
        self.calls, self.watched, self.grown, self.error = None, {}, {}, None

    def watch(self, agent, kept):
        values = vars(sys.modules["baraka.values"])
        classes = [one for one in [*vars(self.baraka).values(), *values.values()] if isinstance(one, type)]
        self.watched = {"None": None, "True": True, "False": False, "agent": agent, "ValueError": ValueError, "TypeError": TypeError,
                        "float": float, "str": str, **{one.__name__: one for one in classes}, **kept}

    def references(self):
        return {name: sys.getrefcount(one) for name, one in self.watched.items()}

    def begin(self, agent):
        calls, kept = self.make_calls(agent, self.baraka)
        self.watch(agent, kept)
        self.calls = list(calls.items())
        self.go_on()

    def go_on(self):
        self.name, self.call = self.calls.pop(0) if self.calls else (None, None)
        self.cycle, self.windows = 0, WINDOWS

    def in_step(self, controller):
        if not isinstance(controller.agent, self.baraka.Robot) or self.is_done:
            return
        try:
            if self.calls is None:
                self.begin(controller.agent)
            self.count()
        except BaseException as error:
            self.error = error

    def count(self):
        if self.cycle == WARM:
            self.before = self.references(), world.allocated()
        if self.cycle == WARM + CYCLES:
            references, memory = self.references(), world.allocated()
            grown = {name: n - self.before[0][name] for name, n in references.items()}, memory - self.before[1]
            self.grown[self.name] = grown
            self.windows -= 1
            if self.windows and left_by(*grown):
                self.before, self.cycle = (references, memory), WARM
            else:
                self.go_on()
        self.cycle += 1
        for _ in range(CALLS // CYCLES if self.call else 0):
            self.call()

    @property
    def is_done(self):
        return self.error is not None or (self.calls == [] and self.call is None)


class References(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        import baraka
        cls.baraka = baraka

    def environment(self, program="all_calls.py", **keywords):
        """r1 is driven from here; r0, with all sensors, and m0 have the controller."""
        return self.baraka.Environment(
            world.EVERY_CALL, "r1", lambda *_: 0, channels=[], **keywords,
            set=[f"agents.robots.controller={{program: {program}}}", f"agents.motes.controller={{program: {program}}}",
                 "end.0.at=1 h", "agents.robots.name=r{}", "agents.robots.poses=[{x: 0 m, y: 0 m}, {x: 0 m, y: -2 m}]"])

    def grown(self, make_calls):
        """The growth of each call, by its name: references of each object, and memory."""
        environment = self.environment()
        counter = Counter(make_calls, self.baraka)
        sys.modules["all_calls"].AllCalls.in_step = counter.in_step
        environment.reset(seed=1)
        while not counter.is_done:
            environment.step([0, 0])
        environment.close()
        if counter.error:
            raise counter.error
        return counter.grown

    def leaks(self, grown):
        return {name: left for name, growth in grown.items() if (left := left_by(*growth))}

    def test_every_call(self):
        grown = self.grown(every_call)
        self.assertEqual(len(grown), 46)
        if world.SANITIZED:  # the simulated network remembers for a while what was sent
            for name in ("send", "send a bytearray"):
                grown[name] = grown[name][0], 0
        self.assertEqual(self.leaks(grown), {})

    def test_every_wrong_use(self):
        import wrong_uses

        def make_calls(agent, _):
            # Not those of another thread, which the other suite has, and of sensors that the robot has not.
            all_of = [one for one in wrong_uses.uses(agent) if one[1] not in (self.baraka.CallError, self.baraka.NotAvailable)]
            calls = {f"{i}: {wanted.__name__}": caught(call, wanted) for i, (call, wanted) in enumerate(all_of)}
            calls["reading of nothing"] = caught(lambda: agent.reading("nothing"), self.baraka.NotAvailable)
            return calls, {"NotAvailable": self.baraka.NotAvailable}

        grown = self.grown(make_calls)
        self.assertGreater(len(grown), 60)
        self.assertEqual(self.leaks(grown), {})

    def test_what_is_left_on_purpose_is_found(self):
        """So that this suite can fail."""
        kept = "a text that is kept"
        keep = ctypes.pythonapi.Py_IncRef
        keep.argtypes = [ctypes.py_object]
        grown = self.grown(lambda *_: ({"a reference": lambda: keep(kept), "memory": lambda: keep(3.14 * len(kept)),
                                        "nothing": lambda: len(kept)}, {"kept": kept}))
        leaks = self.leaks(grown)
        self.assertEqual(set(leaks), {"a reference", "memory"})
        self.assertEqual(leaks["a reference"][0], {"kept": CALLS})

    def check_repeated(self, call, count=100):
        """Memory grows by less than the smallest object each in one of eight hundreds of calls: what leaks does so in all.

        What Python and the libraries keep for the next time is theirs in the first ones.
        """
        grown = []
        while len(grown) < 8:
            before = world.allocated()
            for _ in range(count):
                call()
            grown.append(world.allocated() - before)
            if grown[-1] < SMALLEST * count:
                return
        self.fail(f"memory grows by {grown} in {count} calls each")

    def test_resets(self):
        environment = self.environment(until=5)

        def reset():
            environment.reset(seed=1)
            environment.step([0.1, 0])

        self.check_repeated(reset)

    def test_episodes_that_fail(self):
        """Each callback of a controller that raises, its constructor, too, and scenarios with mistakes."""
        self.environment("fails.py")
        Fails = sys.modules["fails"].Fails

        def fail(method):
            Fails.method = None
            environment = self.environment("fails.py", until=1)
            Fails.method = method
            with self.assertRaisesRegex(RuntimeError, f"ZeroDivisionError: {method}"):
                environment.reset(seed=1)
                for _ in range(9):
                    environment.step([0, 0])

        for method in ("__init__", "start", "step", "receive", "timer", "notice"):
            with self.subTest(method):
                self.check_repeated(lambda method=method: fail(method))

        def mistake():
            with self.assertRaisesRegex(RuntimeError, "nowhere"):
                self.environment("nowhere.py")
            with self.assertRaisesRegex(ValueError, "until"):
                self.environment(until=float("nan"))

        self.check_repeated(mistake)

    def test_classes_that_are_no_controllers(self):
        baraka = self.baraka
        wrong = [{"channels": "infrared"}, {"channels": [5]}, {"runs_on": ["bird"]}, {"runs_on": []}, {"parameters": {"a": 5}},
                 {"parameters": {"a": baraka.Parameter(5, "m", "x")}}, {"records": {"x": "m"}}, {"names": 1},
                 {"parameters": {5: baraka.Parameter(1)}}, {"states": 3}]
        classes = [type("Wrong", (baraka.Controller, ), attributes) for attributes in wrong]

        def refuse():
            for one in classes:
                with self.assertRaises((TypeError, baraka.InvalidArgument)):
                    baraka.kind_of(one, "wrong.py")

        self.check_repeated(refuse)


if __name__ == "__main__":
    world.main()
