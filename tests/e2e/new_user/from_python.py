"""from_python.py FOLDER: results, figures and an environment, as docs/python.md has them, of the controller project FOLDER."""
import pathlib
import sys

import baraka

folder = pathlib.Path(sys.argv[1])
run = baraka.results(folder / "results" / folder.name)
states = run.table("states")
assert list(states["state"]) == ["DRIVING", "ARRIVED"], states
assert states.attrs["units"]["at_ns"] == "ns", states.attrs
study = baraka.campaign(folder / "results/speeds")
assert len(study.runs()) == 30
differences = study.figure("states.ARRIVED.first", versus="speed").differences
assert list(differences["pairs"]) == [10, 10] and (differences["high"] < 0).all(), differences
print(differences)

env = baraka.Environment("wanderer", "r0", until=60, channels=["infrared"],
                         reward=lambda before, action, after, info: info["clearance"])
first, info = env.reset(seed=1)
observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
again, info = env.reset(seed=1)
assert (first == again).all() or str(first) == str(again)
print("reward", reward)
