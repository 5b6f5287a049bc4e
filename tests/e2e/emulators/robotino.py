#!/usr/bin/env python3
"""A Festo Robotino as its REST interface shows it, after the vendor's description
(wiki.openrobotino.org/Rest_api.html):

  PUT or POST /data/omnidrive             [vx, vy, omega]       m/s, m/s, rad/s
  GET         /data/odometry              [x, y, rot, vx, vy, omega, seq]
  GET         /data/distancesensorarray   nine numbers, sensor i at i * 40 deg, m, 0.41 at most
  GET         /data/bumper                {"value": false}

The wheels stop when no velocity came for 200 ms. A malformed request gets status 400, 404 or 405
and is counted. For tests, not part of the robot:

  GET  /emulator/state     the truth: pose, velocity, wheel speeds, counts
  POST /emulator/fault     {"path": "odometry", "kind": KIND}; KIND: none, status_500, bad_json,
                           short, truncated, huge, stall, trickle, frozen

So may a file of faults: {"odometry": KIND}.

Prints "listening: ADDRESS:PORT", and then works until it is killed.
"""
import argparse
import http.server
import json
import math
import pathlib
import socket
import socketserver
import time

import body

SILENCE = 0.2  # s
SENSORS = 9
RANGE = 0.41   # m
# Robotino 3: wheels of 60 mm at 175 mm from the middle; the body's radius is 225 mm.
ROWS = body.wheel_rows([math.radians(b) for b in (60, 180, 300)], 0.175, 0.06)
BODY_RADIUS = 0.225
KINDS = ("none", "status_500", "bad_json", "short", "truncated", "huge", "stall", "trickle",
         "frozen")


class Robot:
    def __init__(self, options):
        self.log = body.Log(options.log)
        self.body = body.Body(options.pose, SILENCE, self.log)
        self.start = list(options.pose)
        self.world = body.World(options.world)
        self.rejected = 0
        self.posted_faults = {}
        self.faults_file = options.faults and pathlib.Path(options.faults)
        self.requests = {}
        self.sequence = 0

    def fault(self, name):
        """The KIND of what goes wrong."""
        in_file = {}
        if self.faults_file and self.faults_file.exists():
            in_file = json.loads(self.faults_file.read_text())
        return in_file.get(name, self.posted_faults.get(name, "none"))

    def odometry(self):
        state = self.body.state()
        x, y, theta = self.start
        dx, dy = state["pose"][0] - x, state["pose"][1] - y
        turned = state["pose"][2] - theta
        if self.fault("odometry") != "frozen":
            self.sequence += 1
        return [dx * math.cos(theta) + dy * math.sin(theta),
                dy * math.cos(theta) - dx * math.sin(theta),
                math.atan2(math.sin(turned), math.cos(turned)), *state["velocity"], self.sequence]

    def distances(self):
        pose = self.body.state()["pose"]
        headings = [2 * math.pi * i / SENSORS for i in range(SENSORS)]
        return [min(RANGE, d) for d in self.world.ranges(pose, BODY_RADIUS, headings)]

    def state(self):
        state = self.body.state()
        return {**state, "wheel_speeds": body.wheel_speeds(ROWS, state["velocity"]),
                "rejected": self.rejected, "requests": self.requests}


def velocity_of(text):
    """The velocity in a request's body; ValueError says what is wrong."""
    values = json.loads(text, parse_constant=lambda name: (_ for _ in ()).throw(ValueError(name)))
    if not isinstance(values, list) or len(values) != 3:
        raise ValueError("not an array of 3")
    if any(isinstance(v, bool) or not isinstance(v, (int, float)) for v in values):
        raise ValueError("not numbers")
    if not all(math.isfinite(v) for v in values):
        raise ValueError("not finite")
    return [float(v) for v in values]


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    timeout = 30  # of an idle connection, s
    disable_nagle_algorithm = True

    def log_message(self, *_):
        pass

    @property
    def robot(self):
        return self.server.robot

    def do_GET(self):
        self.read_body()
        path = self.path.split("?")[0]
        answers = {"/data/odometry": self.robot.odometry,
                   "/data/distancesensorarray": self.robot.distances,
                   "/data/bumper": lambda: {"value": False},
                   "/emulator/state": self.robot.state}
        if path == "/data/omnidrive":
            self.reject(405, "omnidrive is written, not read")
        elif path in answers:
            self.answer(path, answers[path]())
        else:
            self.reject(404, "no such thing")

    def do_PUT(self):
        text = self.read_body()
        path = self.path.split("?")[0]
        if path == "/emulator/fault":
            fault = json.loads(text)
            assert fault["kind"] in KINDS, fault
            self.robot.posted_faults[fault["path"]] = fault["kind"]
            self.send(200, b"{}")
        elif path != "/data/omnidrive":
            self.reject(404 if not path.startswith("/data/") else 405, "not for writing")
        else:
            self.drive(path, text)

    do_POST = do_PUT

    def drive(self, path, text):
        try:
            velocity = velocity_of(text)
        except ValueError as error:
            self.reject(400, str(error))
            return
        if self.robot.fault("omnidrive") == "none":
            self.robot.body.command(velocity)
        self.answer(path, {})

    def read_body(self):
        size = self.headers.get("Content-Length", "0")
        return self.rfile.read(int(size) if size.isdigit() else 0).decode("utf-8", "replace")

    def answer(self, path, value):
        name = path.rsplit("/", 1)[1]
        self.robot.requests[name] = self.robot.requests.get(name, 0) + 1
        text = json.dumps(value).encode()
        kind = self.robot.fault(name)
        if kind in ("none", "frozen"):
            self.send(200, text)
        else:
            self.fail(kind, text)

    def fail(self, kind, text):
        if kind == "status_500":
            self.send(500, b"internal error")
        elif kind == "bad_json":
            self.send(200, b'[1, 2, "three", nan')
        elif kind == "short":
            self.send(200, b"[1, 2]")
        elif kind == "huge":
            self.send(200, b"[" + b"1," * 500_000 + b"1]")
        elif kind == "truncated":
            self.send(200, text[:len(text) // 2], length=len(text))
            self.close_connection = True
        elif kind == "stall":
            time.sleep(3)
            self.close_connection = True
        elif kind == "trickle":
            self.send(200, b"", length=100_000)
            for _ in range(100):
                self.wfile.write(b" ")
                time.sleep(0.05)
            self.close_connection = True

    def reject(self, status, why):
        self.robot.rejected += 1
        self.robot.log.write(time.monotonic(), "rejected", status=status, why=why,
                             request=f"{self.command} {self.path}")
        self.send(status, why.encode())

    def send(self, status, text, length=None):
        self.send_response(status)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(text) if length is None else length))
        self.end_headers()
        self.wfile.write(text)


class Server(socketserver.ThreadingMixIn, http.server.HTTPServer):
    daemon_threads = True
    request_queue_size = 32

    def server_bind(self):
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        socketserver.TCPServer.server_bind(self)  # without HTTPServer's look-up of a name
        self.server_name, self.server_port = self.server_address

    def handle_error(self, request, client_address):
        pass  # a client that is gone


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--address", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=0, help="0: any free one")
    parser.add_argument("--pose", type=float, nargs=3, default=[0, 0, 0], metavar=("X", "Y", "YAW"))
    parser.add_argument("--world", help="JSON file with walls and cylinders")
    parser.add_argument("--log", help="JSON lines of what happened")
    parser.add_argument("--faults", help="file of faults; may change, as a whole")
    parser.add_argument("--state", help="file with /emulator/state, written again and again")
    options = parser.parse_args()
    robot = Robot(options)
    server = Server((options.address, options.port), Handler)
    server.robot = robot
    body.keep_state_file(options.state, robot.state)
    print(f"listening: {options.address}:{server.server_port}", flush=True)
    server.serve_forever()


if __name__ == "__main__":
    main()
