"""A controller that a suite in the same process stops in its step(): in the run's thread, while a thread of the suite waits."""
import baraka


class Waits(baraka.Controller):
    in_step = staticmethod(lambda controller: None)

    def step(self):
        Waits.in_step(self)
        self.agent.set_body_velocity(0.1)
