"""Laws of propagation beside their closed forms, computed here once more."""
import math
import statistics

import peer
from chart import GREY, Chart, Panel, axis
from document import Row, within

NAME = "propagation"
TITLE = "Propagation"
TEXT = """The library's propagation models (`tests/validation/radio_probe.cpp`) compared with the closed forms, which are computed here
independently: two-ray ground (Rappaport 2002, 4.6; heights 1.5 m, 2.412 GHz), also compared with figures of ns-3.37
(`tests/analytic/radio/two_ray_ns3.csv`; three pairs of heights), log-distance, log-normal shadowing (sigma 6 dB, cut at 3 sigma: 0.9975 sigma;
Gudmundson's correlation, 20 m), moments of the power of fading links, and the rate at which Rayleigh fading crosses a
level (Rice; Jakes 1974, 1.3-35), per wavelength travelled. Statistics are those of 20,000 links, rates those of 150
links of 12 wavelengths; each tolerance is 4 standard errors or more."""
COLUMNS = ["what", "ours", "closed form", "tolerance"]
WAVELENGTH = 299792458 / 2.412e9  # m
LINKS = 20_000


def cases(short):
    del short
    return [two_ray, two_ray_of_the_peer, log_distance, shadowing_sigma, *[correlation(d) for d in (5, 10, 20, 40)],
            *[moments(*one) for one in (("rayleigh", 0, 2, 0.12), ("rician", 2, 1 + 5 / 9, 0.08),
                                        ("rician", 10, 1 + 21 / 121, 0.08), ("nakagami", 3, 1 + 1 / 3, 0.08),
                                        ("nakagami", 0.75, 1 + 1 / 0.75, 0.14))],
            *[crossings(level) for level in (0.1, 0.5, 1.0)]]


def measure(runs, case):
    what, found, expected, tolerance, data = case(runs)
    return Row([what, f"{found:.4f}", f"{expected:.4f}", f"{tolerance:g}"],
               within(found, expected, absolute=tolerance, what=what), data)


def two_ray(runs):
    distances = [1, 5, 20, 50, 100, 200, 227, 228, 300, 500, 1000, 5000]
    ours = runs.ask([("two_ray", d, 1.5, 1.5) for d in distances])
    closed = [20 * math.log10(WAVELENGTH / (4 * math.pi * d)) if d < 4 * math.pi * 2.25 / WAVELENGTH
              else 20 * math.log10(2.25) - 40 * math.log10(d) for d in distances]
    worst = max(abs(a - b) for a, b in zip(ours, closed))
    return ("two-ray ground, largest error at 12 distances, dB", worst, 0, 1e-9, ("two_ray", distances, ours, closed))


def two_ray_of_the_peer(runs):
    rows = peer.rows("two_ray_ns3.csv")
    ours = runs.ask([("two_ray", row["distance_m"], row["from_m"], row["to_m"]) for row in rows])
    worst = max(abs(gain - float(row["gain_db"])) for gain, row in zip(ours, rows))
    return (f"two-ray ground, largest difference from ns-3's at {len(rows)} places, dB", worst, 0, 1e-6, None)


def log_distance(runs):
    distances = [1, 2, 5, 10, 20, 51.3, 100, 192.4, 500, 1000]
    ours = runs.ask([("log_distance", d) for d in distances])
    closed = [-46.6777 - 30 * math.log10(d) for d in distances]
    worst = max(abs(a - b) for a, b in zip(ours, closed))
    return ("log-distance, largest error at 10 distances, dB", worst, 0, 1e-9, ("log_distance", distances, ours, closed))


def shadows(runs, moved):
    return runs.ask([("shadowing", link, 70 + moved) for link in range(LINKS)])


def shadowing_sigma(runs):
    found = shadows(runs, 0)
    return ("shadowing, standard deviation over sigma 6 dB", statistics.pstdev(found) / 6, 0.9975, 0.02, None)


def correlation(moved):
    def case(runs):
        here, there = shadows(runs, 0), shadows(runs, moved)
        found = sum(a * b for a, b in zip(here, there)) / (0.5 * sum(a * a + b * b for a, b in zip(here, there)))
        return (f"shadowing, correlation after {moved} m", found, math.exp(-moved / 20), 0.03,
                ("correlation", moved, found))
    return case


def moments(kind, parameter, expected, tolerance):
    def case(runs):
        gains = runs.ask([(kind, parameter, link, 0) for link in range(LINKS)])
        name = {"rayleigh": "Rayleigh", "rician": f"Rician, K = {parameter}", "nakagami": f"Nakagami, m = {parameter}"}
        return (f"{name[kind]}: mean square of the power", statistics.fmean(g * g for g in gains), expected, tolerance,
                None)
    return case


def crossings(level):
    def case(runs):
        links, wavelengths, looks = 150, 12, 64
        count = 0
        gains = runs.ask([("rayleigh", 0, link, i * WAVELENGTH / looks) for link in range(links)
                          for i in range(wavelengths * looks + 1)])
        for link in range(links):
            way = gains[link * (wavelengths * looks + 1):(link + 1) * (wavelengths * looks + 1)]
            count += sum(before <= level < after for before, after in zip(way, way[1:]))
        expected = math.sqrt(2 * math.pi * level) * math.exp(-level)
        return (f"Rayleigh: crossings of {level} times the mean power, per wavelength", count / links / wavelengths,
                expected, round(0.12 * expected, 3), ("crossings", level, count / links / wavelengths))
    return case


def draw(rows):
    data = [row.data for row in rows if row.data]
    gain = Panel("gain", axis("distance, m", log=True), axis("dB"))
    for curve, (kind, distances, ours, closed) in enumerate(one for one in data if one[0] in ("two_ray", "log_distance")):
        gain.line(distances, closed, curve=curve, label=kind.replace("_", " "))
        gain.marks(distances, ours, "cross", curve=curve)
    gain.marks([], [], "cross", curve=GREY, label="ours")
    shadowing = Panel("correlation of shadowing", axis("way of one end, m"))
    ways = range(45)
    shadowing.line(ways, [math.exp(-one / 20) for one in ways])
    correlated = [(0, 1), *(one[1:3] for one in data if one[0] == "correlation")]
    shadowing.marks(*zip(*correlated), "cross")
    fading = Panel("crossings per wavelength", axis("power over its mean", log=True))
    levels = [0.01 * 1.08 ** i for i in range(75)]
    fading.line(levels, [math.sqrt(2 * math.pi * one) * math.exp(-one) for one in levels])
    fading.marks(*zip(*(one[1:3] for one in data if one[0] == "crossings")), "cross")
    return Chart(gain, shadowing, fading, title=TITLE, columns=3, size=(800, 320))
