"""Scenarios as environments of reinforcement learning, with the interfaces of Gymnasium and PettingZoo.

Neither package is needed: spaces have what theirs have in common (shape, dtype, low, high, sample, contains, seed).
"""
import atexit
import os
import pathlib
import weakref

import numpy

from ._simulator import Episode


def _look_in(variable, *places):
    """Adds folders that exist to a list of the environment: beside what the user names, where this package's files are."""
    there = [str(place) for place in places if place.is_dir()]
    named = [one for one in os.environ.get(variable, "").split(":") if one]
    os.environ[variable] = ":".join([*named, *(one for one in there if one not in named)])


# A build has bin/python/baraka and share/; an installation lib/python3/dist-packages/baraka, lib/baraka and share/.
_HERE = pathlib.Path(__file__).resolve().parents
_look_in("BARAKA_CONFIG_PATH", _HERE[3] / "share/baraka", _HERE[4] / "share/baraka")
_look_in("BARAKA_CONTROLLER_PATH", _HERE[2], _HERE[3] / "baraka")

LARGEST_SEED = 2**53
_BEGUN = weakref.WeakSet()


@atexit.register
def _end_all():
    """Before Python ends: a run's thread that calls a controller in Python later would end in the middle of the call."""
    for episode in list(_BEGUN):
        episode.end()


class Box:
    """A space of arrays of floats between low and high, as gymnasium.spaces.Box."""

    def __init__(self, low, high):
        self.low, self.high = numpy.asarray(low, float), numpy.asarray(high, float)
        self.shape, self.dtype = self.low.shape, numpy.dtype(float)
        self.seed(0)

    def seed(self, seed):
        """Begins the random numbers of sample() anew."""
        self._random = numpy.random.Generator(numpy.random.PCG64(seed))

    def sample(self):
        """A random element, evenly distributed; normal where a bound is infinite."""
        finite = numpy.isfinite(self.low) & numpy.isfinite(self.high)
        low, high = numpy.where(finite, self.low, 0), numpy.where(finite, self.high, 0)
        return numpy.where(finite, self._random.uniform(low, high), self._random.standard_normal(self.shape))

    def contains(self, x):
        """Whether x is an element."""
        x = numpy.asarray(x, float)
        return x.shape == self.shape and bool(numpy.all(x >= self.low) and numpy.all(x <= self.high))

    __contains__ = contains

    def __repr__(self):
        return f"Box({self.low.tolist()}, {self.high.tolist()})"


class Environment:
    """Robots of a scenario, driven a control cycle at a time; other agents have their controllers.

    agents    the name of a robot: reset() and step() are those of gymnasium.Env; or a list of names: those of
              pettingzoo.ParallelEnv, with dicts by name
    reward    (observation, action, next observation, info) -> number, for each robot
    terminal  the same arguments -> whether the episode ends for this robot; default: never
    channels  names of the channels that are observed, in this order; default: all of fixed length
    until     s of simulated time, after which an episode is truncated; default: the scenario's end conditions
    set       "dotted.path=value", as of `baraka run --set`

    An action is (vx, vy, omega) without the directions that the wheels cannot drive in: m/s, m/s, rad/s. A range is the
    largest one where nothing is within range, and the least one where something is nearer; before its first sample a
    channel is NaN. info has "now" [s], the true "pose" (x, y, heading), "clearance" [m] to the nearest wall, "readings",
    and at the end "result" and "fingerprint". Control cycles of all robots are at the same times.
    """

    metadata = {"render_modes": []}

    def __init__(self, scenario, agents, reward, *, terminal=None, channels=None, until=None, set=()):
        self._is_single = isinstance(agents, str)
        self.possible_agents = [agents] if self._is_single else list(agents)
        self.agents = list(self.possible_agents)
        self._file, self._set, self._until = str(scenario), [str(one) for one in set], until
        self._reward, self._terminal = reward, terminal or (lambda *_: False)
        self._episode, self._seed, self._last = None, 0, None
        self._robots = Episode(self._file, self._set, self.possible_agents, until).robots()
        self._channels = [self._chosen(robot, channels) for robot in self._robots]
        self._directions = [[i for i in range(3) if robot["largest"][i] > 0] for robot in self._robots]
        self._action_spaces = [self._action_space(*both) for both in zip(self._robots, self._directions)]
        self._observation_spaces = [self._observation_space(channels) for channels in self._channels]
        if self._is_single:
            (self.action_space,), (self.observation_space,) = self._action_spaces, self._observation_spaces
        else:
            self.action_spaces = dict(zip(self.possible_agents, self._action_spaces))
            self.observation_spaces = dict(zip(self.possible_agents, self._observation_spaces))

    @staticmethod
    def _chosen(robot, names):
        known = {channel[0]: channel for channel in robot["channels"]}
        if names is None:
            return [channel for channel in robot["channels"] if channel[3] > 0]
        for name in names:
            if name not in known:
                raise ValueError(f"channels: robot {robot['name']} has no channel '{name}'; it has {', '.join(known)}")
            if known[name][3] == 0:
                raise ValueError(f"channels: '{name}' has readings of varying length")
        return [known[name] for name in names]

    @staticmethod
    def _action_space(robot, directions):
        largest = [robot["largest"][i] for i in directions]
        return Box([-one for one in largest], largest)

    @staticmethod
    def _observation_space(channels):
        low, high = [], []
        for _, _, _, length, least, most in channels:
            bounded = least < most
            low += [least if bounded else -numpy.inf] * length
            high += [most if bounded else numpy.inf] * length
        return Box(low, high)

    def reset(self, seed=None, options=None):
        """Begins an episode: observation, info. Without a seed: the next one after that of the episode before."""
        if seed is not None and not (isinstance(seed, (int, numpy.integer)) and 0 <= seed < LARGEST_SEED):
            raise ValueError(f"seed: {seed!r} is no whole number from 0 to {LARGEST_SEED - 1}")
        self._seed = int(seed) if seed is not None else self._seed + 1
        self._episode = None  # ends the one before
        episode = Episode(self._file, [*self._set, f"seed={self._seed}"], self.possible_agents, self._until)
        _BEGUN.add(episode)
        self._episode = episode
        self.agents = list(self.possible_agents)
        self._last = self._seen(episode.begin())
        observations, infos = self._last
        return (observations[0], infos[0]) if self._is_single else (self._by_name(observations), self._by_name(infos))

    def step(self, action):
        """Drives for a control cycle: observation, reward, terminated, truncated, info; dicts of them for several robots."""
        episode = self._episode
        if episode is None:
            raise RuntimeError("step: call reset() first")
        actions = [action] if self._is_single else self._in_order(action)
        drives = [self._drive(i, one) for i, one in enumerate(actions)]
        situation = episode.advance(drives)
        before, (observations, infos) = self._last, self._seen(situation)
        self._last = observations, infos
        each = [(before[0][i], actions[i], observations[i], infos[i]) for i in range(len(actions))]
        rewards = [float(self._reward(*one)) for one in each]
        terminated = [bool(self._terminal(*one)) for one in each]
        truncated = [situation["ended"]] * len(actions)
        if situation["ended"] or any(terminated):
            self._episode = None
            self.agents = []
        if self._is_single:
            return observations[0], rewards[0], terminated[0], truncated[0], infos[0]
        return tuple(self._by_name(one) for one in (observations, rewards, terminated, truncated, infos))

    def close(self):
        """Ends the episode, from any thread: a step() that waits in another one raises RuntimeError."""
        episode, self._episode = self._episode, None
        if episode is not None:
            episode.end()

    def _drive(self, i, action):
        space, directions = self._action_spaces[i], self._directions[i]
        values = numpy.asarray(action, float)
        if values.shape != space.shape:
            raise ValueError(f"action of {self.possible_agents[i]}: has shape {values.shape}, not {space.shape}")
        if not numpy.all(numpy.isfinite(values)):
            raise ValueError(f"action of {self.possible_agents[i]}: {values.tolist()} is not finite")
        drive = [0.0, 0.0, 0.0]
        for direction, value in zip(directions, values):
            drive[direction] = float(value)
        return drive

    def _seen(self, situation):
        observations, infos = [], []
        for channels, space, view in zip(self._channels, self._observation_spaces, situation["agents"]):
            observations.append(self._observed(channels, space, view["readings"]))
            info = {"now": situation["now"], "pose": view["pose"], "clearance": view["clearance"],
                    "readings": view["readings"]}
            if situation["ended"]:
                info.update(result=situation["result"], fingerprint=situation["fingerprint"])
            infos.append(info)
        return observations, infos

    @staticmethod
    def _observed(channels, space, readings):
        parts = []
        for name, kind, _, length, least, most in channels:
            values = readings.get(name)
            if values is None:
                values = numpy.full(length, numpy.nan)
            elif least < most and kind in ("range", "scan", "sonar"):
                values = numpy.where(numpy.isnan(values), most, numpy.clip(values, least, most))
            parts.append(values)
        return numpy.concatenate(parts) if parts else numpy.zeros(0)

    def _in_order(self, actions):
        missing = [name for name in self.possible_agents if name not in actions]
        if missing:
            raise ValueError(f"actions: none for {', '.join(missing)}")
        return [actions[name] for name in self.possible_agents]

    def _by_name(self, values):
        return dict(zip(self.possible_agents, values))
