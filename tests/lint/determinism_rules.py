#!/usr/bin/env python3
"""Fails when code that a run depends on uses something that differs between runs or machines.

Usage: determinism_rules.py ROOT
"""
import pathlib
import re
import sys

FOLDERS = ["hal/types", "hal/node", "hal/files/description", "gateway/runtime", "controllers", "sim", "results"]
FUNCTIONS = ("sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|"
             "pow|hypot|cbrt|erf|erfc|tgamma|lgamma|fma")
RULES = [
    (rf"\bstd::(?:{FUNCTIONS})\s*\(", "differs between processors; use hal::math"),
    (r"\bstd::random_device\b|\bstd::mt19937", "use hal::RandomStream"),
    (r"\bstd::\w+_distribution\b", "differs between standard libraries; use hal::RandomStream"),
    (r"\b(?:s?rand|[dlm]rand48)\s*\(", "use hal::RandomStream"),
    (r"\bstd::unordered_(?:map|set|multimap|multiset)\b", "iterates in no fixed order"),
    (r"\bstd::hash\b", "differs between standard libraries"),
    (r"\b(?:system|steady|high_resolution)_clock\b|\bgettimeofday\b|\bclock_gettime\b"
     r"|\bstd::time\s*\(|(?<![\w:.>])time\s*\(\s*(?:NULL|nullptr|0)\s*\)",
     "reads the wall clock; time is handed in"),
    (r"\bstd::(?:map|set)\s*<\s*(?:const\s+)?\w+(?:::\w+)*\s*\*", "orders by address"),
    (r"\breinterpret_cast<\s*(?:std::)?u?intptr_t", "a number made of an address"),
]
# File -> why it may break a rule.
EXCEPT = {
    "hal/types/math.cpp": "is where the deterministic functions come from",
    "controllers/ros_base/ros_node.cpp": "stamps messages as any node does that does not know the run",
}


def code_only(text):
    """Comments and strings blanked, line breaks kept."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group(0))
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', blank, text, flags=re.S)


def check(root):
    for folder in FOLDERS:
        for file in sorted((root / folder).rglob("*")):
            name = file.relative_to(root).as_posix()
            if file.suffix not in (".h", ".cpp") or name in EXCEPT:
                continue
            lines = code_only(file.read_text()).splitlines()
            for number, line in enumerate(lines, 1):
                for pattern, why in RULES:
                    match = re.search(pattern, line)
                    if match:
                        yield f"{name}:{number}: '{match.group(0).strip()}' {why}"


if __name__ == "__main__":
    found = list(check(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "determinism rules: ok")
    sys.exit(1 if found else 0)
