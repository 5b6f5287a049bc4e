#!/usr/bin/env python3
"""A TMC200 triple motor controller (Fraunhofer AiS) on a pseudo-terminal, with a robot on its motors.

Lines as libtmc200ctrl sends them: a command, its arguments, a blank, a line feed. Set commands are
answered "OK"; SV by the measured speeds, in 1/1024 of the full scale that SENCO gave. The motors
stop when no SV came for the cut-off time of SMZNM. What is malformed is answered "ERROR" (the words
of the real one for that are not known) and counted.

Prints "device: PATH", and then works until it is killed. A control file with one word makes it
misbehave as long as it says so: silent, garbage, flood, error.
"""
import argparse
import errno
import math
import os
import pathlib
import select
import time
import tty

import body

FULL_SCALE = 1024


class Rejected(Exception):
    pass


def whole(text, low, high):
    if not (text.lstrip("-").isascii() and text.lstrip("-").isdigit()):
        raise Rejected(f"'{text}' is not a whole number")
    value = int(text)
    if not low <= value <= high:
        raise Rejected(f"{value} is not in {low} .. {high}")
    return value


def motor(text):
    if text not in ("M1", "M2", "M3"):
        raise Rejected(f"no motor '{text}'")
    return int(text[1]) - 1


class Controller:
    """The commands, by name: a method gets the arguments and gives the answer."""

    def __init__(self, options, log):
        self.gear = options.gear
        self.sign = -1 if options.inverted else 1
        self.rows = body.wheel_rows([math.radians(b) for b in options.bearings], options.distance,
                                    options.radius)
        self.body = body.Body(options.pose, 1.0, log)
        self.log = log
        self.mode = 0
        self.verbosity = 0
        self.encoders = [None, None, None]  # (steps, full scale in rpm, way per step)
        self.rejected = 0
        self.speeds = [0, 0, 0]

    def answer(self, line):
        try:
            if not line.endswith(" "):
                raise Rejected("no blank at the end")
            name, *arguments = line[:-1].split(" ")
            method = getattr(self, "on_" + name, None)
            if method is None:
                raise Rejected(f"no command '{name}'")
            return method(*arguments)
        except (Rejected, TypeError) as error:
            if line:
                self.rejected += 1
                self.log.write(time.monotonic(), "rejected", line=line, why=str(error))
            return "ERROR"

    def on_GVERS(self):
        return "VERS TMC200 emulator"

    def on_SMODE(self, mode):
        self.mode = whole(mode, 0, 2)
        return "OK"

    def on_GMODE(self):
        return f"MODE {self.mode}"

    def on_SSEND(self, verbosity):
        self.verbosity = whole(verbosity, 0, 2)
        return "OK"

    def on_SMZNM(self, ticks):
        self.body.silence = whole(ticks, 1, 255) * 0.01
        return "OK"

    def on_SENCO(self, which, steps, rpm, way):
        self.encoders[motor(which)] = (whole(steps, 1, 50000), whole(rpm, 1, 20000),
                                       whole(way, 0, 1000))
        return "OK"

    def on_GENCO(self, which):
        constants = self.encoders[motor(which)]
        if constants is None:
            raise Rejected("not set")
        return f"ENCO {which} {constants[0]} {constants[1]} {constants[2]}"

    def on_SV(self, *speeds):
        if len(speeds) != 3:
            raise Rejected(f"{len(speeds)} speeds")
        if None in self.encoders or self.mode == 0:
            raise Rejected("speeds mean nothing before SENCO M1 … M3 and SMODE 1 or 2")
        new = [whole(s, -FULL_SCALE, FULL_SCALE) for s in speeds]
        self.body.advance()
        measured = self.speeds if self.body.moving() else [0, 0, 0]
        self.speeds = new
        self.body.command(self.velocity(new))
        if self.verbosity == 0:
            return "OK"
        answer = "V {} {} {} ".format(*measured)
        return answer if self.verbosity == 1 else answer + "\t C 0 0 0 "

    def wheels(self, speeds):
        """rad/s"""
        return [self.sign * s / FULL_SCALE * e[1] * 2 * math.pi / 60 / self.gear
                for s, e in zip(speeds, self.encoders)]

    def velocity(self, speeds):
        if not any(speeds):
            return [0.0, 0.0, 0.0]
        return body.body_velocity(self.rows, self.wheels(speeds))

    def state(self):
        state = self.body.state()
        return {**state, "wheel_speeds": body.wheel_speeds(self.rows, state["velocity"]),
                "rejected": self.rejected, "mode": self.mode, "cut_off": self.body.silence,
                "encoders": self.encoders}


class Line:
    """The controller's end of the pseudo-terminal."""

    def __init__(self, link):
        self.master, slave = os.openpty()
        tty.setraw(slave)
        self.path = os.ttyname(slave)
        self.slave = slave  # kept open: without it the master fails while nobody is there
        if link:
            link = pathlib.Path(link)
            link.unlink(missing_ok=True)
            link.symlink_to(self.path)
            self.path = str(link)
        os.set_blocking(self.master, False)
        self.received = b""

    def lines(self, wait):
        readable, _, _ = select.select([self.master], [], [], wait)
        if not readable:
            return []
        try:
            self.received += os.read(self.master, 4096)
        except OSError as error:
            if error.errno not in (errno.EIO, errno.EAGAIN):
                raise
        *lines, self.received = self.received.split(b"\n")
        return [line.decode("ascii", "replace") for line in lines]

    def send(self, text):
        try:
            os.write(self.master, text)
        except BlockingIOError:
            pass  # nobody reads


def misbehaviour(control):
    try:
        return pathlib.Path(control).read_text().strip() if control else ""
    except OSError:
        return ""


def serve(line, controller, control):
    while True:
        kind = misbehaviour(control)
        if kind == "flood":
            line.send(b"x" * 200 + b"\n" + b"y" * 300)
        for text in line.lines(0.002 if kind == "flood" else 0.05):
            if kind == "silent":
                continue
            answer = controller.answer(text)
            if kind == "garbage":
                answer = "V 1 2 x" + chr(1)
            if kind == "error":
                answer = "ERROR"
            line.send(answer.encode() + b"\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--link", help="symbolic link to make to the device")
    parser.add_argument("--gear", type=float, default=16)
    parser.add_argument("--inverted", action="store_true", help="motors wired the other way round")
    parser.add_argument("--radius", type=float, default=0.04, help="of the wheels, m")
    parser.add_argument("--distance", type=float, default=0.132, help="of the wheels, m")
    parser.add_argument("--bearings", type=float, nargs=3, default=[60, 180, 300], help="deg")
    parser.add_argument("--pose", type=float, nargs=3, default=[0, 0, 0], metavar=("X", "Y", "YAW"))
    parser.add_argument("--log", help="JSON lines of what happened")
    parser.add_argument("--state", help="file with the truth, written again and again")
    parser.add_argument("--control", help="file whose word makes it misbehave")
    options = parser.parse_args()
    controller = Controller(options, body.Log(options.log))
    line = Line(options.link)
    body.keep_state_file(options.state, controller.state)
    print(f"device: {line.path}", flush=True)
    serve(line, controller, options.control)


if __name__ == "__main__":
    main()
