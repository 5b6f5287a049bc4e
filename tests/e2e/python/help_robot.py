"""controllers/help_robot in Python: equal seeds give the runs of the one in C++, bit for bit."""
import struct

import baraka
from baraka import Parameter
from baraka.math import hypot
from travel import Travel, ns

HELP, ASK, GIVE_UP, GRANT, REFUSE, ARRIVED = range(1, 7)


class HelpRobot(baraka.Controller):
    channels, watched = ["infrared", "localisation"], ["help"]
    parameters = {
        **Travel.parameters,
        "keep_alive": Parameter(15, "s", 1, 3600, "Time between two messages to the mote."),
        "hop_timeout": Parameter(300, "s", 1, 3600, "Time for one hop before it gives up."),
        "reply_timeout": Parameter(30, "s", 1, 3600, "Time for an answer before it asks again."),
        "max_repeats": Parameter(3, "1", 0, 1000, "Questions after the first one."),
        "near": Parameter(10, "m", 0.5, 1000, "Asks for the next hop, or has arrived, below this."),
        "reached": Parameter(4, "m", 0.5, 1000, "A hop has been reached below this."),
        "metric": Parameter("hops", meaning="Of a path.", choices=["hops", "delay", "min_snr", "energy"]),
        "direct_weight": Parameter(1e6, "1", 0, 1e12, "Metric of a hop that is the mote itself."),
        "beta": Parameter(2, "1", 1, 20, "Exponent of the metric.")}
    states = ["IDLE", "SELECT_DESTINATION", "REQUEST_ASSIGNMENT", "FIND_NEXT_HOP", "REQUEST_NEXT_HOP",
              "GO_TO_NEXT_HOP", "GO_TO_DESTINATION", "GIVE_UP", "ARRIVED"]

    def __init__(self, robot, p):
        self.robot, self.p, self.travel, self.calls = robot, p, Travel(robot, p), set()
        self.metric = baraka.PathMetric(p["metric"], p["direct_weight"])

    def start(self):
        self.enter("IDLE")

    def stop(self):
        self.robot.set_body_velocity()

    def step(self):
        if self.at == "IDLE" and self.calls:
            mote = sorted(self.calls)[self.robot.random().below(len(self.calls))]
            self.calls.remove(mote)
            self.enter("SELECT_DESTINATION")
            self.mote, self.passed = mote, None
            self.request("REQUEST_ASSIGNMENT")
        elif self.at.startswith("REQUEST"):
            self.wait()
        elif self.at.startswith("GO"):
            self.go()

    def receive(self, message):
        word = message.payload[0] if message.topic == "help" and len(message.payload) == 5 else 0
        ours = self.at != "IDLE" and message.source == self.mote
        asks = self.at == "REQUEST_ASSIGNMENT" or self.at == "REQUEST_NEXT_HOP" and self.routes()
        if word == HELP and not ours:
            self.calls.add(message.source)
        elif word == GRANT and ours and asks:
            self.find()
        elif word == REFUSE and ours:
            self.stop()
            self.enter("IDLE")

    def enter(self, state):
        self.at = state
        self.robot.state(state)

    def say(self, word):
        self.robot.send(self.mote, "help", struct.pack(">BI", word, ns(self.p["hop_timeout"]) // 10**6))

    def after(self, name):
        return self.robot.now_ns() + ns(self.p[name])

    def request(self, state):
        self.stop()
        self.repeats, self.deadline = 0, self.after("reply_timeout")
        self.say(ASK)
        self.enter(state)

    def wait(self):
        if self.at == "REQUEST_NEXT_HOP" and self.routes():
            self.find()
        elif self.robot.now_ns() >= self.deadline and self.repeats == int(self.p["max_repeats"]):
            self.give_up()
        elif self.robot.now_ns() >= self.deadline:
            self.repeats, self.deadline = self.repeats + 1, self.after("reply_timeout")
            self.robot.network().invalidate("help", self.mote)
            self.say(ASK)

    def routes(self):
        routes = self.robot.network().routes("help", self.mote)
        return [route for route in routes if route.next_hop == self.mote or route.next_hop != self.passed]

    def find(self):
        self.enter("FIND_NEXT_HOP")
        routes = self.routes()
        if not routes:
            self.robot.network().invalidate("help", self.mote)
            return self.request("REQUEST_NEXT_HOP")
        self.hop = routes[baraka.draw_route(routes, self.metric, self.p["beta"], self.robot.random())].next_hop
        self.deadline, self.alive_at, self.asked = self.after("hop_timeout"), self.after("keep_alive"), False
        self.travel.aim_anew()
        return self.enter("GO_TO_DESTINATION" if self.hop == self.mote else "GO_TO_NEXT_HOP")

    def go(self):
        now, to_hop = self.robot.now_ns(), self.at == "GO_TO_NEXT_HOP"
        if now >= self.deadline:
            return self.give_up()
        try:
            to = complex(*self.robot.relative_position(self.hop))
        except baraka.NotAvailable:
            return self.stop()
        distance = hypot(to.real, to.imag)
        if not to_hop and distance < self.p["near"]:
            self.stop()
            self.say(ARRIVED)
            self.enter("ARRIVED")
            return self.enter("IDLE")
        if to_hop and distance < self.p["reached"]:
            self.passed = self.hop
            return self.find()
        near = to_hop and not self.asked and distance < self.p["near"]
        if near or now >= self.alive_at:
            self.asked, self.alive_at = self.asked or near, self.after("keep_alive")
            if to_hop:
                self.robot.network().invalidate("help", self.mote)
            self.say(ASK)
        return self.travel.drive(to, distance)

    def give_up(self):
        self.stop()
        self.enter("GIVE_UP")
        self.say(GIVE_UP)
        self.enter("IDLE")
