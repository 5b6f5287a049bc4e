"""Random plans for lockstep/random_program.c, each by its seed, and what has to come of them (lockstep_model.py)."""
import math
import random

from lockstep_model import (AIR, DATAGRAMS, EVENTS, LOOPBACK, OBJECTS, PIPES, SMALL_PIPE, STREAM, TIMERS, Agent)

GRID = 250_000  # ns: so that many waits end at one instant
LONGEST = 2_000_000_000  # ns: nothing takes as long
MOST_PROCESSES, MOST_THREADS = 4, 8
BEGIN = 1_000_000_000  # ns, when the first plan of a program begins


class Draw:
    """The steps of one plan. is_open: answers over the air come when nobody knows, so nothing waits without end."""

    def __init__(self, seed):
        self.random = random.Random(f"plan {seed}")
        self.is_open = self.random.random() < 0.2
        self.threads = []
        self.processes = [None]  # the thread that starts each
        self.starts = []  # (thread, the thread that starts it, its process or nothing)

    def time(self):
        if self.random.random() < 0.1:
            return self.random.randint(1, 2_000_000)
        return GRID * self.random.randint(1, 8)

    def grid(self):
        return GRID * self.random.randint(1, 8)

    def limit(self):
        """Of a wait; 0: none."""
        return self.time() if self.is_open or self.random.random() < 0.6 else 0

    def plan(self):
        for thread in range(self.random.randint(2, MOST_THREADS)):
            self.add_thread(thread)
        for thread in self.threads:
            thread["steps"] = [self.step(thread) for _ in range(self.random.randint(3, 9))]
            self.hold(thread)
        for start in self.starts:
            self.add_start(*start)
        for thread in self.threads:
            thread["steps"] += [("wait_for_child", process, 0) for process in thread["children"]]
        return {"threads": self.threads, "is_open": self.is_open}

    def add_thread(self, number):
        process = 0
        if number > 0:
            starter = self.random.randrange(number)
            is_process = self.random.random() < 0.3 and len(self.processes) < MOST_PROCESSES
            process = len(self.processes) if is_process else self.threads[starter]["process"]
            if is_process:
                self.processes.append(starter)
            self.starts.append((number, starter, is_process))
        self.threads.append({"number": number, "process": process, "steps": [], "children": [],
                             "is_first": number == 0 or self.starts[-1][2]})

    def leaves_nothing(self, number):
        """Whether the thread starts neither threads nor processes."""
        return all(starter != number for _, starter, _ in self.starts)

    def add_start(self, number, starter, is_process):
        steps, thread = self.threads[starter]["steps"], self.threads[number]
        at = self.random.randrange(len(steps) // 2 + 1)
        end = self.random.randint(at + 1, len(steps) + 1)
        if not is_process:
            if not self.leaves_nothing(number) or self.random.random() < 0.85:
                steps.insert(end - 1, ("join", number))
            steps.insert(at, ("create", number))
            return
        process = thread["process"]
        self.threads[starter]["children"].append(process)
        if self.random.random() < 0.5:
            steps.insert(end - 1, ("wait_for_child", process, self.random.choice((1, 2))))
        is_alone = all(self.leaves_nothing(one["number"]) for one in self.threads if one["process"] == process)
        if is_alone and self.random.random() < 0.3:
            steps.insert(end - 1, ("kill", process))
        elif self.random.random() < 0.4:
            steps.insert(end - 1, ("tell_process", process))
        steps.insert(at, ("fork", process, number))

    def hold(self, thread):
        """A lock for some of the steps."""
        steps = thread["steps"]
        for _ in range(self.random.choice((0, 0, 1, 1, 2))):
            which = self.random.randrange(OBJECTS + 1)
            begin = self.random.randrange(len(steps))
            end = self.random.randint(begin, len(steps))
            time = self.limit()
            if which == OBJECTS:
                steps.insert(end, ("release",))
                steps.insert(begin, (self.random.choice(("read_lock", "write_lock")), time))
            else:
                steps.insert(end, ("unlock", which))
                steps.insert(begin, ("lock", which, time))

    def step(self, thread):
        kinds = {"sleep": 5, "leave": 0.3, "close_timer": 0.5, "sleep_until": 1, "take": 3, "give": 4, "down": 2, "up": 3, "futex_wait": 1,
                 "futex_wake": 2, "write": 5, "receive": 4, "wait": 6, "set_timer": 3, "tell_thread": 1,
                 "tell_process": 0.5}
        if thread["is_first"]:
            kinds |= {"set_alarm": 1, "wait_for_signal": 0.7}
        if not self.is_open:
            kinds |= {"read": 4, "barrier": 1, "spawn": 0.15}
        name = self.random.choices(list(kinds), kinds.values())[0]
        return (name, *getattr(self, name, self.one_object)(thread))

    def one_object(self, thread):
        return (self.random.randrange(OBJECTS),)

    def sleep(self, thread):
        return (self.time(),)

    sleep_until = wait_for_signal = sleep

    def take(self, thread):
        return (self.random.randrange(OBJECTS), self.limit())

    down = take

    def give(self, thread):
        return (self.random.randrange(OBJECTS), self.random.choice((1, 1, 1, 2)))

    def leave(self, thread):
        return (self.random.randint(1, 4),)

    def barrier(self, thread):
        return ()

    def futex_wait(self, thread):
        return (self.limit(),)

    def futex_wake(self, thread):
        return (self.random.choice((1, 1, 2)),)

    def write(self, thread):
        if self.is_open and self.random.random() < 0.6:
            return (AIR, self.random.randint(200, 600))
        which = self.random.choice((*PIPES[:2], STREAM, *EVENTS, LOOPBACK, *(() if self.is_open else (SMALL_PIPE, DATAGRAMS))))
        if which in EVENTS:
            return (which, self.random.randint(1, 3))
        if which == SMALL_PIPE and self.random.random() < 0.3:
            return (which, self.random.randint(4097, 13000))
        return (which, self.random.randint(1, 300))

    def read(self, thread):
        which = self.random.choice((*PIPES, *PIPES, *EVENTS, *TIMERS))
        return (which, 8 if which in (*EVENTS, *TIMERS) else self.random.randint(1, 600))

    def receive(self, thread):
        which = self.random.choice((AIR, AIR, LOOPBACK) if self.is_open else (STREAM, DATAGRAMS, LOOPBACK))
        microseconds = self.grid() // 1000 if self.is_open or self.random.random() < 0.6 else 0
        return (which, self.random.randint(1, 300), microseconds)

    def wait(self, thread):
        kind = self.random.randrange(6)
        mask = sum(1 << one for one in self.random.sample((*PIPES, STREAM, DATAGRAMS, *EVENTS, LOOPBACK, *TIMERS),
                                                          self.random.randint(1, 3)))
        if self.is_open and self.random.random() < 0.5:
            mask |= 1 << AIR
        # poll() and epoll_wait() take milliseconds, select() microseconds.
        time = {0: 1_000_000 * self.random.randint(1, 2), 4: 1_000_000 * self.random.randint(1, 2), 2: self.grid()}
        return (kind, mask, time.get(kind) or self.time())

    def set_timer(self, thread):
        first = self.random.choice((0, 1, 1, 1)) * self.time()
        return (self.random.choice(TIMERS), first, self.random.choice((0, 0, 1)) * self.grid())

    def set_alarm(self, thread):
        return (self.random.choice((0, 1, 1, 1)) * self.grid(), self.random.choice((0, 0, 1)) * self.grid())

    def close_timer(self, thread):
        return (self.grid(),)

    def others(self, thread):
        return [one["number"] for one in self.threads if one["process"] == thread["process"]]

    def tell_thread(self, thread):
        return (self.random.choice(self.others(thread)),)

    def tell_process(self, thread):
        return (-1,)

    def spawn(self, thread):
        return (self.random.randint(1, 8) * 250,)


NEVER_ENDING = ("lock", "read_lock", "write_lock", "take", "down", "futex_wait", "read", "receive", "write", "barrier")


def make_plan(seed):
    """With waits that would never end replaced by sleeps."""
    plan = Draw(seed).plan()
    while True:
        agent = Agent([plan], BEGIN, limit=BEGIN + LONGEST).run()
        if agent.logs:
            return plan
        stuck = [one for one in agent.blocked() if plan["threads"][one.number]["steps"][one.step][0] in NEVER_ENDING]
        if not stuck:
            raise AssertionError(f"plan {seed} does not end")
        for thread in stuck:
            plan["threads"][thread.number]["steps"][thread.step] = ("sleep", GRID)


def text_of(seed, plan):
    lines = [f"plan {seed}"]
    for i, thread in enumerate(plan["threads"]):
        lines.append(f"thread {i} {thread['process']}")
        lines += [" ".join(map(str, step)) for step in thread["steps"]]
    return "\n".join(lines) + "\n"


def foreseen(seeds, plans, arrivals):
    """The whole output of a program of these plans. @param arrivals  of answers over the air after the first, ns"""
    agent = Agent(plans, BEGIN, arrivals).run()
    lines = []
    for seed, (status, log) in zip(seeds, agent.logs):
        lines.append(f"plan {seed} {status}")
        lines += [" ".join(map(str, record)) for record in log]
    return [*lines, "done"]
