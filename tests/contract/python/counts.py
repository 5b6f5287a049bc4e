"""A controller with a thread that counts, which it can only where what waits for the next callback lets go of the interpreter."""
import os
import sys
import threading
import time

import baraka

sys.setswitchinterval(600)  # s: nothing but waiting gives the interpreter to another thread
says = "COUNTS_SAYS" in os.environ


class Counts(baraka.Controller):
    def start(self):
        self.count, self.is_over = 0, False
        self.thread = threading.Thread(target=self.count_on)
        self.thread.start()

    def count_on(self):
        while not self.is_over:
            self.count += 1
            time.sleep(0)

    def step(self):
        self.before = self.count
        sum(range(10_000))
        assert self.count == self.before, "the interpreter was taken away within a callback"

    def stop(self):
        self.agent.log("info", f"counted {self.count}")
        self.is_over = True
        self.thread.join()


def say():
    while True:
        print("goes on", flush=True)
        time.sleep(0.05)


if says:
    threading.Thread(target=say, daemon=True).start()
