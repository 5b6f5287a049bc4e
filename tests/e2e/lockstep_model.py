"""What a program of random steps (lockstep/random_program.c) has to log in lock-step: a simulation of its threads, pipes,
locks and timers by discrete events. Nothing here is shared with the library or the run.

Rules: computing takes no time; one thread of an agent runs until it waits; of those that want to go on the one with the
lowest slot is next. A slot is taken by each thread, process and timer, the lowest that is free, and given back at its end.
Threads that wait for one object go on in the order in which they came. At one instant frames come in first, then waits end
whose time has come, then timers expire, in the order of their slots; a handler runs at once, in a thread that waits."""
import errno
import heapq
import itertools
import math
import signal

NEVER = None
MOMENT = 1000  # ns: what a wait for a time that has passed takes
PIPES, STREAM, DATAGRAMS, EVENTS, LOOPBACK, AIR, TIMERS = (0, 1, 2), 3, 4, (5, 6), 7, 8, (9, 10)
SMALL_PIPE, SEMAPHORE_EVENT = 2, 6
PAGE = 4096
MOST_DATAGRAMS = 10  # net.unix.max_dgram_qlen: one more is taken
OBJECTS = 2
LOCK = OBJECTS  # its bit among those that a thread holds
BY_THREAD, BY_DEADLINE, BY_SIGNAL = "thread", "deadline", "signal"
RESTARTING = (signal.SIGUSR2,)  # with SA_RESTART: calls without a time-out go on
LOOK_ONCE, UNLESS_INTERRUPTED = 1, 2  # ways to wait for a child
DRIVER, CHILD = -1, -2  # the thread that starts one plan after the other; a child with no steps of a plan


class Wait:
    """What a thread waits for. parked: for an object; otherwise in the kernel, for descriptors, a child or a signal."""

    def __init__(self, deadline=NEVER, parked=None, reads=(), writes=(), child=None, takes=None):
        self.deadline, self.parked, self.child, self.takes = deadline, parked, child, takes
        self.reads, self.writes = frozenset(reads), frozenset(writes)
        self.ticket = None


class Thread:
    def __init__(self, number, process, slot):
        self.number, self.process, self.slot = number, process, slot
        self.wait, self.how, self.held = None, None, set()
        self.body = None
        self.is_live = False  # from its first turn to the end of its steps
        self.has_ended = False
        self.has_handled = False
        self.is_interrupted = False  # by a handler after which calls do not go on


class Process:
    """The objects that each process has of its own."""

    def __init__(self, number, parent):
        self.number, self.parent = number, parent
        self.threads, self.children, self.timers = [], {}, {}
        self.owners = [None] * OBJECTS
        self.values = [0] * OBJECTS
        self.owners_of_values = [None] * OBJECTS
        self.semaphores = [0] * OBJECTS
        self.readers, self.writer = set(), None
        self.arrived = self.round = self.word = 0
        self.by_number = {}
        self.alarm = None
        self.blocked, self.pending = {signal.SIGALRM, signal.SIGUSR1}, set()  # until its first turn
        self.status = None  # once it has ended


class Timer:
    def __init__(self, slot, process, descriptor):
        self.slot, self.process, self.descriptor = slot, process, descriptor
        self.deadline, self.interval, self.count = NEVER, 0, 0


class Agent:
    """The programs of one agent. @param arrivals  when answers come in over the air, ns, in their order"""

    def __init__(self, plans, begin, arrivals=(), limit=NEVER):
        self.now, self.plans, self.log, self.limit = begin, plans, [], limit
        self.arrivals = list(arrivals)
        self.slots, self.ready = [], []  # slots: taken; ready: threads that want to go on
        self.tickets = itertools.count()
        self.threads, self.timers = {}, set()
        self.pipes = {}
        self.air, self.requests, self.sent = [], 0, []
        self.driver = self.start_thread(DRIVER, Process(DRIVER, None), self.drive())
        self.logs, self.ended_at = [], []

    # ---- slots and turns
    def take_slot(self):
        slot = next(i for i in itertools.count() if i not in self.slots)
        self.slots.append(slot)
        return slot

    def start_thread(self, number, process, body):
        thread = Thread(number, process, self.take_slot())
        thread.body = body if not callable(body) else body(thread)
        process.threads.append(thread)
        process.by_number[number] = thread
        self.threads[thread] = None
        self.want(thread)
        return thread

    def want(self, thread):
        heapq.heappush(self.ready, (thread.slot, id(thread), thread))

    def wake(self, thread, how):
        thread.wait, thread.how = None, how
        self.want(thread)

    def settle(self):
        while self.ready:
            _, _, thread = heapq.heappop(self.ready)
            if thread.has_ended:
                continue
            self.running = thread
            try:
                wait = thread.body.send(thread.how)
            except StopIteration:
                self.end_thread(thread)
                continue
            if thread.has_ended:
                continue
            if wait is None:  # it gives its turn away
                self.want(thread)
                continue
            if wait.deadline is not NEVER and wait.deadline <= self.now:
                wait.deadline = self.now + MOMENT
            wait.ticket, thread.wait, thread.how = next(self.tickets), wait, None

    def run(self):
        while True:
            self.settle()
            times = [one.wait.deadline for one in self.threads if one.wait and one.wait.deadline is not NEVER]
            times += [timer.deadline for timer in self.timers if timer.deadline is not NEVER]
            if self.requests and self.arrivals:
                times.append(max(self.now, self.arrivals[0]))
            if not times or (self.limit is not NEVER and min(times) > self.limit):
                return self
            self.now = min(times)
            while self.arrivals and self.arrivals[0] <= self.now:
                self.arrivals.pop(0)
                self.air.append(self.sent.pop(0))
                self.changed(AIR)
            self.expire()

    def expire(self):
        for thread in sorted(self.threads, key=lambda one: one.slot):
            if thread.wait and thread.wait.deadline is not NEVER and thread.wait.deadline <= self.now:
                self.wake(thread, BY_DEADLINE)
        for timer in sorted(self.timers, key=lambda one: one.slot):
            if timer.deadline is NEVER or timer.deadline > self.now or timer not in self.timers:
                continue
            timer.deadline = timer.deadline + timer.interval if timer.interval else NEVER
            if timer.descriptor is None:
                self.signal_process(timer.process, signal.SIGALRM)
            else:
                timer.count += 1
                self.changed(timer.descriptor, timer.process)

    def blocked(self):
        """Threads that wait, and will for ever."""
        return [one for one in self.threads if one.wait and one is not self.driver]

    # ---- objects
    def park(self, thread, name, deadline=NEVER):
        return (yield Wait(deadline, parked=(thread.process.number, name)))

    def wake_parked(self, process, name, most):
        waiting = sorted((one for one in self.threads if one.wait and one.wait.parked == (process.number, name)),
                         key=lambda one: one.wait.ticket)
        for thread in waiting[:most]:
            self.wake(thread, BY_THREAD)
        return len(waiting[:most])

    def changed(self, descriptor, process=None, is_written=True):
        """Whoever waits for the descriptor looks again. Timers are those of one process."""
        for thread in list(self.threads):
            if thread.wait is None or (process is not None and thread.process is not process):
                continue
            if descriptor in (thread.wait.reads if is_written else thread.wait.writes):
                self.wake(thread, BY_THREAD)

    # ---- signals
    def handle(self, thread, number):
        self.log_record(thread.number, -1, int(number))
        thread.has_handled = True
        thread.is_interrupted = thread.is_interrupted or number not in RESTARTING
        if thread.wait is not None:
            self.wake(thread, BY_SIGNAL)

    def signal_process(self, process, number):
        """To its first thread: the others block it."""
        if process.status is not None:
            return
        first = process.threads[0]
        if number not in process.blocked:
            self.handle(first, number)
        elif first.wait is not None and first.wait.takes == number:
            self.wake(first, BY_THREAD)
        else:
            process.pending.add(number)

    def unblock(self, thread):
        """Of its process."""
        process = thread.process
        process.blocked = set()
        for number in sorted(process.pending):
            self.handle(thread, number)
        process.pending = set()

    # ---- ends
    def end_thread(self, thread):
        process = thread.process
        thread.has_ended = True
        if thread is process.threads[0]:
            if thread is not self.driver and process.status is None:
                self.end_process(process, process.number + 10)
            return
        self.forget(thread)
        self.wake_parked(process, ("end", thread.number), None)

    def forget(self, thread):
        thread.has_ended, thread.wait = True, None
        if thread in self.threads:
            del self.threads[thread]
            self.slots.remove(thread.slot)

    def end_process(self, process, status):
        process.status = status
        for thread in process.threads:
            self.forget(thread)
        for timer in [one for one in self.timers if one.process is process]:
            self.timers.remove(timer)
            self.slots.remove(timer.slot)
        for thread in list(self.threads):
            if thread.wait is not None and thread.wait.child is process:
                self.wake(thread, BY_THREAD)

    # ---- what threads do
    def log_record(self, thread, step, result):
        self.log.append((self.now, thread, step, result))

    def drive(self):
        for plan in self.plans:
            self.plan, self.log = plan, []
            self.pipes = {one: [] for one in (*PIPES, STREAM, DATAGRAMS, LOOPBACK)}
            self.events = dict.fromkeys(EVENTS, 0)
            root = self.start_process(0, self.driver.process, 0)
            while root.status is None:
                yield Wait(child=root)
            self.logs.append((root.status << 8, self.log))
            self.ended_at.append(self.now)

    def start_process(self, number, parent, thread):
        process = Process(number, parent)
        self.start_thread(thread, process, lambda one: self.first_of_process(one, process))
        return process

    def first_of_process(self, thread, process):
        for descriptor in TIMERS:
            process.timers[descriptor] = Timer(self.take_slot(), process, descriptor)
            self.timers.add(process.timers[descriptor])
        self.unblock(thread)
        yield from self.carry_out(thread)

    def carry_out(self, thread):
        thread.is_live = True
        for i, (name, *arguments) in enumerate(self.plan["threads"][thread.number]["steps"]):
            thread.step = i
            result = yield from getattr(self, f"do_{name}")(thread, *arguments)
            self.log_record(thread.number, i, result)
        thread.is_live = False

    def until(self, time):
        return self.now + time if time else NEVER

    def do_sleep(self, thread, time):
        how = yield from self.park(thread, "sleep", self.now + time)
        return 0 if how == BY_DEADLINE else -errno.EINTR

    do_sleep_until = do_sleep

    def lock_until(self, thread, name, attempt, deadline):
        while not attempt():
            if (yield from self.park(thread, name, deadline)) == BY_DEADLINE:
                return 0 if attempt() else -errno.ETIMEDOUT
        return 0

    @staticmethod
    def owned(owners, which, thread):
        if owners[which] is not None:
            return False
        owners[which] = thread
        return True

    def do_lock(self, thread, which, time=0):
        if which in thread.held:
            return 1
        result = yield from self.lock_until(thread, ("mutex", which),
                                            lambda: self.owned(thread.process.owners, which, thread), self.until(time))
        if result == 0:
            thread.held.add(which)
        return result

    def do_unlock(self, thread, which):
        if which not in thread.held:
            return 1
        thread.held.remove(which)
        thread.process.owners[which] = None
        self.wake_parked(thread.process, ("mutex", which), 1)
        return 0
        yield

    def take_lock(self, thread, attempt, time):
        if LOCK in thread.held:
            return 1
        result = yield from self.lock_until(thread, "lock", attempt, self.until(time))
        if result == 0:
            thread.held.add(LOCK)
        return result

    def do_read_lock(self, thread, time=0):
        def attempt():
            if thread.process.writer is None:
                thread.process.readers.add(thread)
            return thread.process.writer is None
        return (yield from self.take_lock(thread, attempt, time))

    def do_write_lock(self, thread, time=0):
        def attempt():
            if thread.process.readers or thread.process.writer:
                return False
            thread.process.writer = thread
            return True
        return (yield from self.take_lock(thread, attempt, time))

    def do_release(self, thread):
        if LOCK not in thread.held:
            return 1
        thread.held.remove(LOCK)
        thread.process.readers.discard(thread)
        if thread.process.writer is thread:
            thread.process.writer = None
        self.wake_parked(thread.process, "lock", None)
        return 0
        yield

    def lock_value(self, thread, which):
        yield from self.lock_until(thread, ("mutex of value", which),
                                   lambda: self.owned(thread.process.owners_of_values, which, thread), NEVER)

    def unlock_value(self, thread, which):
        thread.process.owners_of_values[which] = None
        self.wake_parked(thread.process, ("mutex of value", which), 1)

    def do_take(self, thread, which, time=0):
        process, until, result = thread.process, self.until(time), 0
        yield from self.lock_value(thread, which)
        while process.values[which] == 0 and result == 0:
            self.unlock_value(thread, which)
            how = yield from self.park(thread, ("value", which), until)
            yield from self.lock_value(thread, which)
            result = -errno.ETIMEDOUT if how == BY_DEADLINE else 0
        if result == 0:
            process.values[which] -= 1
        self.unlock_value(thread, which)
        return result

    def do_give(self, thread, which, count):
        yield from self.lock_value(thread, which)
        thread.process.values[which] += count
        self.wake_parked(thread.process, ("value", which), 1 if count == 1 else None)
        self.unlock_value(thread, which)
        return count

    def do_down(self, thread, which, time=0):
        process, until = thread.process, self.until(time)
        thread.is_interrupted = False
        while process.semaphores[which] == 0:
            how = yield from self.park(thread, ("semaphore", which), until)
            if how == BY_SIGNAL and (time or thread.is_interrupted):
                return -errno.EINTR
            if how == BY_DEADLINE and process.semaphores[which] == 0:
                return -errno.ETIMEDOUT
        process.semaphores[which] -= 1
        return 0

    def do_up(self, thread, which):
        thread.process.semaphores[which] += 1
        self.wake_parked(thread.process, ("semaphore", which), 1)
        return 0
        yield

    def do_barrier(self, thread):
        process = thread.process
        process.arrived += 1
        if process.arrived == 2:
            process.arrived = 0
            process.round += 1
            self.wake_parked(process, "barrier", None)
            return 1
        entered = process.round
        while process.round == entered:
            yield from self.park(thread, "barrier")
        return 0

    def do_futex_wait(self, thread, time=0):
        until, word = self.until(time), thread.process.word
        thread.is_interrupted = False
        while word == thread.process.word:
            how = yield from self.park(thread, "word", until)
            if how != BY_SIGNAL or time or thread.is_interrupted:
                return {BY_THREAD: 0, BY_DEADLINE: -errno.ETIMEDOUT, BY_SIGNAL: -errno.EINTR}[how]
        return -errno.EAGAIN

    def do_futex_wake(self, thread, count):
        thread.process.word += 1
        return self.wake_parked(thread.process, "word", count)
        yield

    # ---- descriptors
    def is_readable(self, thread, descriptor):
        if descriptor in self.events:
            return self.events[descriptor] > 0
        if descriptor in TIMERS:
            return thread.process.timers[descriptor].count > 0
        return bool(self.air if descriptor == AIR else self.pipes[descriptor])

    def is_writable(self, descriptor):
        if descriptor == SMALL_PIPE:
            return not self.pipes[descriptor]
        return descriptor != DATAGRAMS or len(self.pipes[descriptor]) <= MOST_DATAGRAMS

    def wait_for(self, thread, is_ready, wait, deadline):
        """@return whether it was ready; or BY_SIGNAL: if a handler has run, also after the wait was over, and it is not ready
        any more."""
        thread.is_interrupted = thread.has_handled = False
        while not is_ready():
            if deadline is not NEVER and deadline <= self.now:
                return False
            if thread.is_interrupted or (thread.has_handled and deadline is not NEVER):
                return BY_SIGNAL
            yield wait()
        return True

    def wait_to_read(self, thread, descriptors, deadline=NEVER):
        return (yield from self.wait_for(thread, lambda: any(self.is_readable(thread, one) for one in descriptors),
                                         lambda: Wait(deadline, reads=descriptors), deadline))

    def put(self, descriptor, size):
        if descriptor in (*PIPES, STREAM) and self.pipes[descriptor]:
            self.pipes[descriptor][0] += size
        else:
            self.pipes[descriptor].append(size)
        self.changed(descriptor)

    def do_write(self, thread, descriptor, size):
        if descriptor in EVENTS:
            self.events[descriptor] += size
            self.changed(descriptor)
            return 8
        if descriptor == AIR:
            self.requests += 1
            self.sent.append(size)
            return size
        left = size
        while left > 0:
            ready = yield from self.wait_for(thread, lambda: self.is_writable(descriptor),
                                             lambda: Wait(writes=(descriptor,)), NEVER)
            if ready is BY_SIGNAL:
                return size - left if left < size else -errno.EINTR
            part = min(left, PAGE) if descriptor in PIPES else left
            self.put(descriptor, part)
            left -= part
        return size

    do_send = do_write

    def get(self, thread, descriptor, most):
        if descriptor in TIMERS:
            timer = thread.process.timers[descriptor]
            count, timer.count = timer.count, 0
            return count
        if descriptor in EVENTS:
            count = 1 if descriptor == SEMAPHORE_EVENT else self.events[descriptor]
            self.events[descriptor] -= count
            return count
        queue = self.air if descriptor == AIR else self.pipes[descriptor]
        got = min(queue[0], most)
        if descriptor in (*PIPES, STREAM) and got < queue[0]:
            queue[0] -= got
            return got
        queue.pop(0)
        self.changed(descriptor, is_written=False)
        return got

    def do_read(self, thread, descriptor, most=8):
        ready = yield from self.wait_to_read(thread, (descriptor,))
        return self.get(thread, descriptor, most) if ready is True else -errno.EINTR

    def do_receive(self, thread, descriptor, most, microseconds=0):
        ready = yield from self.wait_to_read(thread, (descriptor,), self.until(microseconds * 1000))
        if ready is BY_SIGNAL:
            return -errno.EINTR
        return self.get(thread, descriptor, most) if ready else -errno.EAGAIN

    def do_wait(self, thread, kind, mask, time):
        del kind
        descriptors = [one for one in range(TIMERS[-1] + 1) if mask >> one & 1]
        if (yield from self.wait_to_read(thread, descriptors, self.now + time)) is BY_SIGNAL:
            return -errno.EINTR
        return sum(1 << one for one in descriptors if self.is_readable(thread, one))

    # ---- timers and signals
    def do_set_timer(self, thread, descriptor, first, interval):
        timer = thread.process.timers[descriptor]
        timer.count, timer.interval = 0, interval
        timer.deadline = self.until(first)
        return 0
        yield

    def do_close_timer(self, thread, time):
        # The slot of the timer is free again.
        until = self.now + 3 * time
        while (yield from self.park(thread, "sleep", until)) != BY_DEADLINE:
            pass
        return -errno.EAGAIN

    def do_set_alarm(self, thread, first, interval):
        process = thread.process
        if process.alarm is None and first > 0:
            process.alarm = Timer(self.take_slot(), process, None)
            self.timers.add(process.alarm)
        if process.alarm is not None:
            process.alarm.deadline, process.alarm.interval = self.until(first), interval
        return 0
        yield

    def do_wait_for_signal(self, thread, time):
        thread.process.blocked = {signal.SIGALRM}
        how = yield Wait(self.until(time), takes=signal.SIGALRM)
        self.unblock(thread)
        return {BY_THREAD: int(signal.SIGALRM), BY_DEADLINE: -errno.EAGAIN, BY_SIGNAL: -errno.EINTR}[how]

    def do_tell_thread(self, thread, number):
        other = thread.process.by_number.get(number)
        if other is None or not other.is_live:
            return -errno.ESRCH
        self.handle(other, signal.SIGUSR2)
        yield None
        return 0

    def do_tell_process(self, thread, number):
        child = thread.process if number < 0 else thread.process.children.get(number)
        if child is None:
            return -errno.ESRCH
        self.signal_process(child, signal.SIGUSR1)
        yield None
        return 0

    def do_kill(self, thread, number):
        child = thread.process.children.get(number)
        if child is None:
            return -errno.ESRCH
        if child.status is None:
            self.end_process(child, 100 + signal.SIGKILL)
        yield None
        return 0

    # ---- threads and processes
    def do_create(self, thread, number):
        self.start_thread(number, thread.process, self.carry_out)
        return 0
        yield

    def do_join(self, thread, number):
        other = thread.process.by_number[number]
        while not other.has_ended:
            yield from self.park(thread, ("end", number))
        return 0

    def do_fork(self, thread, number, first):
        thread.process.children[number] = self.start_process(number, thread.process, first)
        return 0
        yield

    def do_wait_for_child(self, thread, number, how=0):
        child = thread.process.children.get(number)
        if child is None:
            return -errno.ECHILD
        thread.is_interrupted = False
        while child.status is None:
            if how == LOOK_ONCE:
                return 1000
            if (yield Wait(child=child)) == BY_SIGNAL and how == UNLESS_INTERRUPTED and thread.is_interrupted:
                return -errno.EINTR
        del thread.process.children[number]
        return child.status

    def do_spawn(self, thread, microseconds):
        # The program takes it as a fraction of a second.
        time = math.ceil(float(f"0.{microseconds:06}") * 1e9)
        return (yield from self.run_child(thread, lambda one: self.park(one, "sleep", self.now + time), 0))

    def do_leave(self, thread, count):
        del count  # the slots of its threads are free again before anybody else takes some
        return (yield from self.run_child(thread, lambda one: iter(()), 1))

    def run_child(self, thread, steps, status):
        process = Process(f"of {thread.number}", thread.process)

        def body(one):
            yield from steps(one)
            self.end_process(process, status)
        self.start_thread(CHILD, process, body)
        while process.status is None:
            yield Wait(child=process)
        return status
