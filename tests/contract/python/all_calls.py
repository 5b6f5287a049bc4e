"""A controller whose calls a suite in the same process chooses: `AllCalls.in_step` is called in each control cycle."""
import baraka


class AllCalls(baraka.Controller):
    runs_on = ["robot", "mote"]
    optional_channels = ["battery", "infrared", "odometry", "scan", "imu", "bumper", "pose", "localisation"]
    watched = ["every"]
    neighbours = True
    names = True
    parameters = {"number": baraka.Parameter(0.5, "m/s", 0, 2, "A number."),
                  "text": baraka.Parameter("near", meaning="A text.", choices=["near", "far"])}
    states = ["RUNNING", "WAITING"]
    records = {"now": ("s", "The time.")}
    in_step = staticmethod(lambda controller: None)
    heard = []

    def step(self):
        AllCalls.in_step(self)

    def receive(self, message):
        AllCalls.heard[:] = [message]

    def notice(self, id, fate):
        AllCalls.heard[:] = [id, fate]

    def timer(self, id):
        AllCalls.heard[:] = [id]
