"""Drives the same way in every control cycle, as environment_test.py does from outside."""
import baraka


class Steady(baraka.Controller):
    optional_channels = ["odometry", "infrared", "infrared_volts", "localisation"]

    def step(self):
        self.agent.set_body_velocity(0.2, 0, 0.3)
