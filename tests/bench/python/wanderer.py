"""controllers/wanderer in Python, as docs/python.md has it."""
import baraka
from baraka.math import cos


class Wanderer(baraka.Controller):
    channels = ["infrared"]
    parameters = {"speed": baraka.Parameter(0.3, "m/s", 0, 1, "Speed ahead.")}

    def __init__(self, robot, parameters):
        self.robot, self.speed = robot, parameters["speed"]

    def step(self):
        try:
            infrared = self.robot.infrared()
        except baraka.NotAvailable:
            return  # not sampled yet
        near = any(cos(r.heading) > 0.4 and r.range < 0.4 for r in infrared)  # NaN: nothing within range
        self.robot.set_body_velocity(0 if near else self.speed, 0, 1 if near else 0)


if __name__ == "__main__":
    baraka.main(Wanderer)
