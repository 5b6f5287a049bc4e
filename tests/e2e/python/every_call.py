"""Every call of hal/api, as tests/controllers/every_call makes them in C++; the logs of both are equal."""
import baraka
from baraka import Parameter

SHAPES = ["arrow", "box", "sphere", "cylinder"]
ERRORS = [baraka.InvalidArgument, baraka.NotAvailable]


def line(*values):
    """Numbers with 17 digits, as {:.17g} of fmt prints them."""
    return " ".join(f"{one:.17g}" if isinstance(one, float) else str(int(one) if isinstance(one, bool) else one)
                    for one in values)


def listed(values):
    return f"[{line(*values)}]"


class EveryCall(baraka.Controller):
    runs_on = ["robot", "mote"]
    optional_channels = ["battery", "infrared", "odometry", "scan", "imu", "bumper", "pose", "localisation"]
    watched = ["every"]
    neighbours = True
    names = True
    parameters = {"number": Parameter(0.5, "m/s", 0, 2, "A number."),
                  "flag": Parameter(False, meaning="A flag."),
                  "text": Parameter("near", meaning="A text.", choices=["near", "far"]),
                  "numbers": Parameter([], "m", -100, 100, "Numbers."),
                  "texts": Parameter([], meaning="Texts.")}
    states = ["RUNNING"]
    records = {"now": ("s", "The time.")}

    def __init__(self, agent, parameters):
        super().__init__(agent, parameters)
        self.parameters, self.steps = parameters, 0

    def say(self, *values):
        self.agent.log("info", line(*values))

    def check(self, call, *arguments):
        try:
            return call(*arguments)
        except baraka.Error as error:
            self.say("error", ERRORS.index(type(error)), error)
            return None

    def start(self):
        agent, p = self.agent, self.parameters
        self.say("start", agent.id(), agent.name(), agent.control_period(), f"'{agent.air_interface()}'")
        self.say("parameters", p["number"], p["flag"], p["text"], listed(p["numbers"]), listed(p["texts"]),
                 p.is_given("number"), p.is_given("flag"))
        self.say("names", agent.address_of("m0"), agent.name_of(1), agent.address_of("nobody") is not None)
        for c in agent.channels():
            self.say("channel", c.id, c.name, c.kind, c.unit, c.length, c.period, c.frame, listed(map(float, c.headings)),
                     c.low, c.high, *c.position, c.heading)
        self.check(agent.set_timer, 7, agent.now() + 0.25)
        self.check(agent.set_timer, 8, 0)
        if isinstance(agent, baraka.Robot):
            self.say_body(agent.body())
        agent.state("RUNNING")

    def step(self):
        agent, random = self.agent, self.agent.random()
        self.say("step", agent.now_ns(), agent.now(), random.next(), random.below(6), random.uniform(), random.normal())
        agent.record("now", agent.now())
        self.say_power()
        self.say_network()
        if isinstance(agent, baraka.Robot):
            self.say_robot()
        self.steps += 1
        if self.steps in (12, 14):
            agent.set_radio(self.steps == 14)

    def receive(self, m):
        self.say("receive", m.source, m.destination, m.id, m.topic, listed(m.payload), m.priority)

    def timer(self, id):
        self.say("timer", id, self.agent.now_ns())
        self.check(self.agent.network().invalidate, "every", 2)
        self.check(self.agent.network().invalidate, "", 2)

    def notice(self, id, fate):
        self.say("notice", id, fate.value)

    def stop(self):
        self.say("stop", self.agent.now_ns())

    def say_body(self, body):
        self.say("body", body.model)
        for s in body.solids:
            self.say("solid", SHAPES.index(s.shape), *s.size, *s.centre, s.yaw)
        for w in body.wheels:
            self.say("wheel", w.is_driven, *w.position, w.axle_heading, w.roller_angle, w.radius, w.max_speed,
                     w.max_torque)

    def say_result(self, what, call, *arguments):
        result = self.check(call, *arguments)
        if result is not None:
            self.say(what, *(result if isinstance(result, tuple) else (result, )))

    def say_power(self):
        self.say_result("battery", self.agent.battery)
        self.say_result("energy", self.agent.battery_energy)
        self.say_result("capacity", self.agent.battery_capacity)
        values = self.check(self.agent.reading, "battery")
        if values is not None:
            self.say("reading", listed(values.tolist()))
        self.check(self.agent.reading, "nothing")
        self.say_result("place", self.agent.relative_position, 2)

    def say_network(self):
        agent, to = self.agent, 2 if self.agent.id() == 1 else 1
        for destination in (to, baraka.EVERYONE, baraka.NEIGHBOURS, agent.id()):
            self.say_result("sent", agent.send, destination, "every", bytes([0, 255, 7]), baraka.Priority.VIDEO)
        routes = agent.network().routes("every", to)
        for r in routes:
            self.say("route", *r)
        if routes:
            self.say("drawn", baraka.draw_route(routes, baraka.PathMetric("delay", 0), 2, agent.random()))
        for n in agent.network().neighbours():
            self.say("neighbour", *n)

    def say_robot(self):
        if self.steps % 4 == 3:
            self.check(self.agent.set_wheel_speeds, [1, 1])
            self.check(self.agent.set_wheel_speeds, [1000, 1])
            self.check(self.agent.set_wheel_speeds, [1])
        else:
            drive = self.check(self.agent.set_body_velocity, 3, 0.1, 0.2)
            if drive is not None:
                self.say("drive", *drive.applied, drive.saturated, drive.restricted)
        self.say_sensors()

    def say_sensors(self):
        agent, steps = self.agent, float(self.steps)
        for reading in self.check(agent.infrared) or []:
            self.say("infrared", *reading)
        odometry = self.check(agent.odometry)
        if odometry:
            self.say("odometry", *odometry.pose, *odometry.twist)
        scan = self.check(agent.scan)
        if scan:
            self.say("scan", listed(scan.headings.tolist()), listed(scan.ranges.tolist()))
        imu = self.check(agent.imu)
        if imu:
            self.say("imu", *imu.angular_velocity, *imu.specific_force)
        self.say_result("bumped", agent.bumped)
        self.say_result("pose", agent.pose)
        self.say("math", baraka.math.sin(steps), baraka.math.atan2(steps, 3), baraka.math.wrap_angle(steps))
