"""A controller that fails in the method that a suite in the same process names."""
import baraka


class Fails(baraka.Controller):
    runs_on = ["robot", "mote"]
    method = None

    def __init__(self, agent, parameters):
        super().__init__(agent, parameters)
        self.fail_in("__init__")

    def fail_in(self, method):
        if method == Fails.method:
            raise ZeroDivisionError(method)

    def start(self):
        self.fail_in("start")

    def step(self):
        self.fail_in("step")
        self.agent.set_timer(1, self.agent.now() + 0.01)
        self.agent.send(baraka.EVERYONE, "t", b"")

    def receive(self, message):
        self.fail_in("receive")

    def timer(self, id):
        self.fail_in("timer")

    def notice(self, id, fate):
        self.fail_in("notice")
