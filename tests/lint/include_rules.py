#!/usr/bin/env python3
"""Fails when a file includes something its folder may not: the table of folders in README.md.

Usage: include_rules.py ROOT
"""
import pathlib
import re
import sys

# Folder -> project folders it may include, besides itself.
MAY_INCLUDE = {
    "hal/types": [],
    "hal/config": ["hal/types"],
    "hal/devices": ["hal/types"],
    "hal/api": ["hal/types"],
    "hal/exchange": ["hal/types"],
    "hal/runtime": ["hal/exchange", "hal/api", "hal/types", "hal/config"],
    "hal/routing": ["hal/types"],
    "hal/agent": ["hal/exchange", "hal/routing", "hal/devices", "hal/types"],
    "hal/description": ["hal/config", "hal/devices", "hal/routing", "hal/types"],
    "hal/hardware/platform": ["hal/routing", "hal/types"],
    "hal/hardware/radio": ["hal/hardware/platform", "hal/agent", "hal/routing", "hal/types"],
    "hal/hardware/drivers": ["hal/hardware/platform", "hal/exchange", "hal/devices", "hal/config", "hal/types"],
    "hal/hardware": ["hal/hardware/drivers", "hal/hardware/radio", "hal/hardware/platform", "hal/agent",
                     "hal/description", "hal/exchange", "hal/routing", "hal/devices", "hal/config", "hal/types"],
    "hal/rtps": ["hal/types"],
    "hal/dds": ["hal/rtps", "hal/types"],
    "hal/dds/exchange": ["hal/dds", "hal/exchange", "hal/runtime", "hal/rtps", "hal/types", "idl"],
    "hal/dds/inspection": ["hal/dds", "hal/types", "idl"],
    "controllers": ["hal/api", "hal/types"],
    "controllers/ros": ["idl"],
    "controllers/ros_base": ["controllers/ros", "hal/api", "hal/types", "idl"],
    "controllers/ros_operator": ["controllers/ros", "hal/api", "hal/types", "idl"],
    "sim/core": ["hal/types"],
    "sim/physics": ["sim/core", "hal/devices", "hal/types"],
    "sim/sensing": ["sim/physics", "sim/core", "hal/devices", "hal/types"],
    "sim/radio": ["sim/core", "hal/types"],
    "sim/air": ["sim/radio", "sim/core", "hal/rtps", "hal/types"],
    "sim/agents": ["sim/core", "sim/physics", "sim/sensing", "sim/radio", "sim/air",
                   "hal/agent", "hal/exchange", "hal/routing", "hal/devices", "hal/types"],
    "sim/record": ["sim/core", "sim/physics", "sim/radio", "sim/air", "sim/agents",
                   "hal/exchange", "hal/routing", "hal/types"],
    "sim/statistics": ["hal/types"],
    "sim/campaign": ["sim/record", "hal/config", "hal/types"],
    "sim/report": ["sim/campaign", "sim/record", "sim/statistics", "hal/config", "hal/types"],
    "sim/scenario": ["sim", "hal/config", "hal/description", "hal/devices", "hal/routing",
                     "hal/exchange", "hal/types"],
    "gateway": ["hal/exchange", "hal/dds", "hal/dds/exchange", "hal/dds/inspection", "hal/devices",
                "hal/config", "hal/types"],
    "gateway/netns": ["hal/types"],
    "gateway/holder": ["gateway/netns"],
    "gateway/slurm": ["gateway", "sim/campaign", "hal/types"],
    "gateway/view": ["gateway", "hal", "sim"],
    "gateway/run": ["gateway", "gateway/netns", "gateway/view", "hal", "sim"],
    "gateway/campaign": ["gateway", "gateway/run", "gateway/slurm", "hal", "sim"],
    "gateway/commands": ["gateway", "gateway/netns", "gateway/run", "gateway/campaign", "gateway/view", "hal",
                         "sim"],
    "gateway/baraka": ["gateway", "gateway/run", "gateway/campaign", "gateway/commands", "hal", "sim"],
    "gateway/agentd": ["gateway", "hal"],
    "gateway/dilate": ["gateway/netns"],
    "tests": ["hal", "sim", "gateway", "controllers", "idl"],
}
# Third-party header -> the only folders that may name it.
ONLY_IN = {
    "tl/": ["hal/types"],
    "fmt/": ["hal", "sim", "gateway"],  # formatting is everywhere; controllers log through the HAL
    "sleef": ["hal/types"],
    "yaml-cpp/": ["hal/config"],
    "CLI/": ["hal/runtime", "gateway/baraka", "gateway/agentd"],
    "fastdds/": ["hal/dds", "controllers/ros", "controllers/ros_base", "controllers/ros_operator"],
    "fastrtps/": ["hal/dds", "controllers/ros", "controllers/ros_base", "controllers/ros_operator"],
    "fastcdr/": ["hal/dds"],
    "spdlog/": ["sim/core"],
    "ode/": ["sim/physics"],
    "fcl/": ["sim/sensing"],
    "Eigen/": ["sim/physics", "sim/sensing", "sim/agents"],
    "boost/": ["sim/statistics"],
    "sqlite3": ["sim/record"],
    "nlohmann/": ["sim/report", "gateway/view"],
    "httplib": ["hal/hardware/drivers", "gateway/view"],
}
GENERATED = re.compile(r"^\w+(PubSubTypes)?\.h$")  # of idl/: "exchange.h", "exchangePubSubTypes.h"


def inside(path, folders):
    return any(path == f or path.startswith(f + "/") for f in folders)


def folder_of(name):
    matching = [f for f in MAY_INCLUDE if inside(name, [f])]
    return max(matching, key=len, default=None)


def check_line(name, folder, target, idl_stems):
    project = [f.split("/")[0] for f in MAY_INCLUDE]
    if target.split("/")[0] in project:
        # A folder of the table is itself alone, without what lies in folders of the table of its own;
        # "hal" and "sim", which are not in it, are all below them.
        home = folder_of(target)
        allowed = [f for f in [folder] + MAY_INCLUDE[folder] if f not in MAY_INCLUDE or home == f]
        if folder != "tests" and not inside(target, allowed):
            yield f"{folder} may not include {target}"
    elif GENERATED.match(target) and re.sub(r"(PubSubTypes)?\.h$", "", target) in idl_stems:
        if not inside("idl", MAY_INCLUDE[folder]):
            yield f"{folder} may not include {target}"
    if folder != "tests":
        for prefix, homes in ONLY_IN.items():
            if target.startswith(prefix) and not inside(name, homes):
                yield f"<{target}> belongs in {', '.join(homes)} only"


def check(root):
    idl_stems = {p.stem for p in (root / "idl").glob("*.idl")}
    for top in ("hal", "sim", "gateway", "controllers", "tests", "idl"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in (".h", ".cpp"):
                continue
            name = file.relative_to(root).as_posix()
            folder = folder_of(name)
            if folder is None:
                yield f"{name}:1: the folder has no rule in tests/lint/include_rules.py"
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
                if match:
                    for error in check_line(name, folder, match.group(1), idl_stems):
                        yield f"{name}:{number}: {error}"


if __name__ == "__main__":
    found = list(check(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "include rules: ok")
    sys.exit(1 if found else 0)
