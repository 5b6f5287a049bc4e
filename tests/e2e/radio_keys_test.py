#!/usr/bin/env python3
"""Each key of a radio has an effect that can be seen from a scenario file: two values of it, all else equal, and
what must differ and how. The last test finds a key that is missing here."""
import json
import math
import re
import unittest

from baraka import ROOT, Case

LOG_DISTANCE = "propagation: [{model: log_distance}]"


def chain(model, law="friis"):
    return f"propagation: [{{model: {law}}}, {model}]"


class Run:
    """What a run of stations that send to each other shows. Stations are named a, b, c, …, on the x axis."""

    def __init__(self, query):
        self.query = query

    def one(self, sql):
        return self.query(sql)[0][0]

    def airtime(self, kind="unicast"):
        """us, of the longest frame of a class."""
        return self.one(f"SELECT max(airtime_ns) FROM frames WHERE class = '{kind}'") / 1e3

    def frames(self, kind="unicast", sender="a"):
        return self.one("SELECT count(*) FROM frames JOIN agents ON agent = transmitter "
                        f"WHERE class = '{kind}' AND name = '{sender}'")

    def bits(self):
        return self.one("SELECT max(bits) FROM frames WHERE class = 'unicast'")

    def received(self, at="b"):
        return self.one("SELECT coalesce(sum(count), 0) FROM packets JOIN agents USING (agent) "
                        f"WHERE name = '{at}'")

    def verdicts(self, verdict, at="b"):
        return self.one("SELECT coalesce(sum(count), 0) FROM receptions JOIN agents USING (agent) "
                        f"WHERE name = '{at}' AND verdict = '{verdict}'")

    def ended(self, verdict):
        return self.one(f"SELECT coalesce(sum(count), 0) FROM requests WHERE verdict = '{verdict}'")

    def rssi(self, at="b"):
        """dBm of the first frame there."""
        return self.one("SELECT rssi_dbm FROM frame_ends JOIN agents USING (agent) "
                        f"WHERE name = '{at}' ORDER BY at_ns LIMIT 1")

    def rssis(self, at="b"):
        return [row[0] for row in self.query("SELECT rssi_dbm FROM frame_ends JOIN agents USING (agent) "
                                             f"WHERE name = '{at}' ORDER BY at_ns")]

    def spread(self, at="b"):
        """dB, standard deviation."""
        levels = self.rssis(at)
        mean = sum(levels) / len(levels)
        return math.sqrt(sum((level - mean) ** 2 for level in levels) / len(levels))

    def fades(self):
        """Share of the frames that came in 10 dB or more below the mean power."""
        powers = [10 ** (level / 10) for level in self.rssis()]
        mean = sum(powers) / len(powers)
        return sum(power < mean / 10 for power in powers) / len(powers)

    def changes(self):
        """How often the power differs from that of the frame before."""
        levels = self.rssis()
        return sum(abs(x - y) > 1e-9 for x, y in zip(levels, levels[1:]))

    def delay(self):
        """us from the start of the first frame to its end at b, beyond its airtime."""
        return self.one("SELECT min(e.at_ns - f.at_ns - f.airtime_ns) FROM frames f JOIN frame_ends e "
                        "USING (frame) JOIN agents a ON a.agent = e.agent WHERE a.name = 'b'") / 1e3

    def gap(self, after, before):
        """us, the shortest from the end of a frame of one class to the start of the next one, of another."""
        rows = self.query("SELECT at_ns, airtime_ns, class FROM frames ORDER BY at_ns")
        return min(later[0] - earlier[0] - earlier[1] for earlier, later in zip(rows, rows[1:])
                   if (earlier[2], later[2]) == (after, before)) / 1e3

    def mean_gap(self, kind="broadcast"):
        """us, the mean from the start of a frame to that of the next one."""
        starts = [row[0] for row in self.query(f"SELECT at_ns FROM frames WHERE class = '{kind}' ORDER BY at_ns")]
        return (starts[-1] - starts[0]) / (len(starts) - 1) / 1e3

    def rates(self):
        """Different airtimes of data frames: rates, as all are of one length."""
        return self.one("SELECT count(DISTINCT airtime_ns) FROM frames WHERE class = 'unicast'")

    def faint(self):
        return self.one("SELECT coalesce(sum(count), 0) FROM faint")

    def together(self):
        """How often a frame begins while one of another station is on the air."""
        count, on_air = 0, []
        for at, airtime, who in self.query("SELECT at_ns, airtime_ns, transmitter FROM frames WHERE class <> 'ack' "
                                           "ORDER BY at_ns"):
            on_air = [(begin, end, other) for begin, end, other in on_air if at < end]
            count += sum(begin < at and other != who for begin, _, other in on_air)
            on_air.append((at, at + airtime, who))
        return count


class RadioKeys(Case):
    seen = set()

    def play(self, radio, stations, *, time="300 ms", more=""):
        """@param stations: [(x in m, what it sends or None, what its radio has of its own[, keys of its body]), …]"""
        groups = []
        for name, (x, traffic, own, *body) in zip("abcdefgh", stations):
            sends = (f"program: traffic_source, parameters: {{topic: t, {traffic}}}" if traffic
                     else "program: traffic_sink, parameters: {topic: t}")
            groups.append(f"  {name}: {{name: {name}, station: {{{''.join(body)}}}, poses: [{{x: {x} m, y: 0 m}}],\n"
                          f"    radio: {{{own}}}, controller: {{{sends}}}}}")
        keys = "\n".join("  " + key for key in radio)
        text = (f"version: 1\nname: key\nseed: 3\ncontroller_latency: 0 s\ncontrol_phase: aligned\n"
                f"routing: none\nrecord: {{frames: all}}\n{more}\nradio:\n{keys}\nagents:\n" +
                "\n".join(groups) + f"\nend: [{{at: {time}, result: done}}]\n")
        file = self.folder / f"key{self.runs}.yaml"
        file.write_text(text)
        finished = self.run_baraka(file, "--controllers", "in-process")
        self.assertEqual(finished["result"], "done")
        out = self.out
        return Run(lambda sql: self.query(sql, out))

    def compare(self, key, values, what, radio=("profile: ieee80211b",), stations=None, **options):
        """@param key: with {} where its value goes, or its name. @return what was seen, of each value."""
        template = key if "{}" in key else key + ": {}"
        RadioKeys.seen.update(re.findall(r"[a-z_0-9]+(?=:)", template))
        found = []
        for value in values:
            with self.subTest(key=key, value=value):
                line = template.replace("{}", str(value), 1)
                own = [key for key in radio if key.split(":")[0] != line.split(":")[0]]
                found.append(what(self.play([*own, line], stations or PAIR, **options)))
        return found

    def rises(self, *arguments, **options):
        found = self.compare(*arguments, **options)
        self.assertEqual(found, sorted(set(found)), f"{arguments[0]}: must rise")

    def falls(self, *arguments, **options):
        found = self.compare(*arguments, **options)
        self.assertEqual(found, sorted(set(found), reverse=True), f"{arguments[0]}: must fall")

    def is_each(self, expected, *arguments, delta=1e-6, **options):
        found = self.compare(*arguments, **options)
        for one, value in zip(found, expected):
            self.assertAlmostEqual(one, value, delta=delta, msg=f"{arguments[0]}: {found}")

    # From antenna to antenna.

    def test_powers_gains_and_laws_of_distance(self):
        friis = 10 * math.log10(40) + 20 * math.log10(299792458 / 2.412e9 / (4 * math.pi * 100))
        self.is_each([friis, friis + 10 * math.log10(2)], "tx_power", ["40 mW", "80 mW"], Run.rssi)
        self.is_each([friis, friis + 6], "antenna_gain", ["0 dB", "3 dB"], Run.rssi)
        self.is_each([friis, friis + 20 * math.log10(2412 / 2472)], "channel", [1, 13], Run.rssi)
        self.is_each([friis, friis - 20 * math.log10(2)], "wavelength",
                     ["12.429206384742952 cm", "6.214603192371476 cm"], Run.rssi)
        self.is_each([friis, friis - 10], "path_loss_exponent", [2, 2.5], Run.rssi)
        self.is_each([friis, friis], "propagation: [{model: {}}]", ["friis", "power_law"], Run.rssi)
        sent = 10 * math.log10(40)
        self.is_each([sent - 46.6777 - 60, sent - 50 - 60],
                     "propagation: [{model: log_distance, reference_loss: {}}]", ["46.6777 dB", "50 dB"],
                     Run.rssi, radio=LOUD)
        self.is_each([sent - 46.6777 - 60, sent - 46.6777 - 30],
                     "propagation: [{model: log_distance, reference_distance: {}}]", ["1 m", "10 m"], Run.rssi,
                     radio=LOUD)
        self.is_each([sent - 46.6777 - 60, sent - 46.6777 - 40], "propagation: [{model: log_distance, exponent: {}}]",
                     [3, 2], Run.rssi, radio=LOUD)
        # Two rays, beyond the crossover: ht^2 hr^2 / d^4.
        self.is_each([sent + 40 * math.log10(h) - 120 for h in (0.5, 1)], "antenna_height",
                     ["0.5 m", "1 m"], Run.rssi, radio=(*LOUD, "propagation: [{model: two_ray_ground}]"),
                     stations=[(0, TO_ALL, ""), (1000, None, "")], delta=1e-4)
        # With the antennas on the ground both rays are equally long: (1 + R) of the field.
        self.is_each([friis + 20 * math.log10(1 + r) for r in (-0.6, 0, 1)],
                     "propagation: [{model: two_ray_interference, reflection: {}}]", [-0.6, 0, 1], Run.rssi,
                     radio=(*LOUD, "antenna_height: 0 m"))

    def test_antennas_by_direction(self):
        # Antenna a looks at b with its front, b at a with its back.
        friis = 10 * math.log10(40) + 20 * math.log10(299792458 / 2.412e9 / (4 * math.pi * 100))

        def is_each(losses, key, values):
            self.is_each([friis - loss for loss in losses], f"antenna: {{{key}}}", values, Run.rssi, radio=LOUD,
                         delta=1e-3)

        is_each([0, -4.302], "pattern: {}", ["omni", "dipole"])
        is_each([20, 9], "pattern: beam, back: {}", ["20 dB", "9 dB"])
        is_each([20, 23], "pattern: beam, width: 20 deg, azimuth: {}", ["180 deg", "170 deg"])
        is_each([23, 20.75], "pattern: beam, azimuth: 170 deg, width: {}", ["20 deg", "40 deg"])
        is_each([20, 23], "pattern: beam, azimuth: 180 deg, height: 20 deg, elevation: {}", ["0 deg", "10 deg"])
        is_each([23, 20.75], "pattern: beam, azimuth: 180 deg, elevation: 10 deg, height: {}", ["20 deg", "40 deg"])
        is_each([-6, 4], "pattern: table, rows: {}", ["['0,0,3']", "['0,0,3', '180,0,-7']"])
        for name, gain in (("one.csv", 3), ("two.csv", -2)):
            (self.folder / name).write_text(f"azimuth_deg,elevation_deg,gain_dbi\n0,0,{gain}\n")
        is_each([-6, 4], "pattern: table, file: {}", ["one.csv", "two.csv"])
        own = [self.play(("profile: ieee80211b",), [(0, TO_B, key), (100, None, "")]).rssi()
               for key in ("", "antenna: {pattern: dipole}")]
        self.assertAlmostEqual(own[1] - own[0], 2.151, delta=1e-3)

    def test_measured_losses(self):
        sent = 10 * math.log10(40)
        self.is_each([sent - 80, sent - 90], "propagation: [{model: measured, rows: {}}]", ["['a,b,80']", "['b,a,90']"],
                     Run.rssi, radio=LOUD)
        for name, level in (("one.csv", -70), ("two.csv", -75)):
            (self.folder / name).write_text(f"from,to,rssi_dbm\na,b,{level}\n")
        self.is_each([sent - 90, sent - 95], "propagation: [{model: measured, file: {}, tx_power: 20 dBm}]",
                     ["one.csv", "two.csv"], Run.rssi, radio=LOUD)
        ramp = "propagation: [{model: measured, rows: ['a,b,0,80', 'a,b,0.3,110'], between: {}}]"
        found = self.compare(ramp, ["hold", "linear"], Run.changes, radio=LOUD)
        self.assertEqual(found[0], 0)
        self.assertGreater(found[1], 10)
        gap = "propagation: [{model: measured, rows: ['a,b,0,80', 'a,b,0.2,80'], silence: {}}]"
        self.falls(gap, ["none", "0.15 s"], Run.received, radio=LOUD)
        friis = sent + 20 * math.log10(299792458 / 2.412e9 / (4 * math.pi * 100))
        self.is_each([friis, sent - 46.6777 - 60],
                     "propagation: [{model: measured, rows: ['a,c,80'], otherwise: {model: {}}}]",
                     ["friis", "log_distance"], Run.rssi, radio=LOUD,
                     stations=[(0, TO_ALL, ""), (100, None, ""), (200, None, "")])

    def test_shadowing(self):
        links = [(0, TO_ALL, ""), *[(60 + 40 * i, None, "") for i in range(7)]]

        def away(run):
            """dB, the mean difference of links from the law of distance."""
            return sum(abs(run.rssi(at) - run_without.rssi(at)) for at in "bcdefgh")

        run_without = self.play([*LOUD, "propagation: [{model: friis}]"], links)
        self.rises(chain("{model: shadowing, sigma: {}}"), ["1 dB", "3 dB", "6 dB"], away, radio=LOUD, stations=links)

        # b walks away at 10 m/s: from one frame to the next, 10 cm later.
        walk = [(0, TO_ALL, ""), (100, None, "", "path: {line: {speed: 10 m/s}}")]

        def steps(run):
            levels = run.rssis()
            return sum(abs(x - y) for x, y in zip(levels, levels[1:]))

        self.falls(chain("{model: shadowing, decorrelation_distance: {}}"), ["1 m", "10 m", "1000 m"], steps,
                   radio=LOUD, stations=walk, time="2 s")

    def test_fading(self):
        for model in ("rayleigh", "rician", "nakagami"):
            found = self.compare(chain(f"{{model: {model}, scatterer_speed: {{}}}}"), ["0 m/s", "10 m/s"],
                                 Run.changes, radio=LOUD)
            self.assertEqual(found[0], 0, model)
            self.assertGreater(found[1], 10, model)
        options = dict(radio=LOUD, time="2 s")
        self.falls(chain("{model: rician, scatterer_speed: 10 m/s, k: {}}"), ["-10 dB", "6 dB", "15 dB"], Run.spread,
                   **options)
        # b is 100 m away: near below 200 m, in the middle, and far.
        for m, bounds in (("m_near", "middle_from: 200 m, far_from: 300 m"),
                          ("m_middle", "middle_from: 50 m, far_from: 300 m"),
                          ("m_far", "middle_from: 50 m, far_from: 60 m")):
            self.falls(chain(f"{{model: nakagami, scatterer_speed: 10 m/s, {bounds}, {m}: {{}}}}"), [0.5, 2, 20],
                       Run.spread, **options)
        shapes = "m_near: 50, m_middle: 2, m_far: 0.5"
        self.rises(chain(f"{{model: nakagami, scatterer_speed: 10 m/s, far_from: 300 m, {shapes}, "
                         "middle_from: {}}"), ["200 m", "50 m"], Run.spread, **options)
        self.rises(chain(f"{{model: nakagami, scatterer_speed: 10 m/s, middle_from: 0 m, {shapes}, "
                         "far_from: {}}"), ["200 m", "50 m"], Run.spread, **options)

    def test_delays_and_walls(self):
        self.is_each([0, 100 / 299.792458], "propagation_delay", ["false", "true"], Run.delay, delta=1e-3)
        wall = ("world: {walls: [{name: w, size: [1 m, 9 m, 9 m], position: [50 m, 0 m], "
                "radio_loss: {per_crossing: 7 dB, per_metre: 3 dB/m}}]}")
        clear, blocked = self.compare("obstacles", ["false", "true"], Run.rssi, more=wall)
        self.assertAlmostEqual(clear - blocked, 7 + 3, delta=1e-6)

    # What a receiver notices.

    def test_thresholds(self):
        # -76.1 dBm at 1000 m, free space.
        far = [(0, TO_ALL, ""), (500, None, "")]
        self.falls("sensitivity", ["-82 dBm", "-72 dBm", ], Run.received, stations=far,
                   radio=("profile: ieee80211b", "wavelength: 10 cm"))
        self.falls("interference_floor", ["-101 dBm", "-82 dBm"], Run.faint,
                   stations=[(0, TO_ALL, ""), (2000, None, "")])
        self.falls("noise_floor", ["-94 dBm", "-60 dBm"], Run.received)
        self.falls("min_sinr", ["4 dB", "40 dB"], Run.received, radio=("profile: ieee80211b",
                                                                     "noise_floor: -80 dBm"))
        # Two senders 100 m apart, -64 dBm: do they notice each other?
        both = [(0, SATURATED_TO_ALL, ""), (50, None, ""), (100, SATURATED_TO_ALL, "")]
        deaf = ("profile: ieee80211b", "sensitivity: -60 dBm", "min_sinr: 50 dB")
        self.rises("cca_threshold", ["-82 dBm", "-50 dBm"], Run.together, stations=both,
                   radio=(*deaf, "energy_detection: 0 dBm"))
        self.rises("energy_detection", ["-82 dBm", "-50 dBm"], Run.together, stations=both,
                   radio=(*deaf, "cca_threshold: 0 dBm"))

    def test_capture(self):
        # c does not hear a; at b it is 30 dB stronger.
        three = [(0, SATURATED_TO_ALL, ""), (630, None, ""), (830, "pattern: periodic, rate: 400 Hz, to: everyone", "")]
        radio = ("profile: ieee80211b", "broadcast_rate: 2 Mb/s")

        def from_c(run):
            return run.one("SELECT coalesce(sum(count), 0) FROM packets p JOIN agents a USING (agent) JOIN agents s "
                           "ON s.agent = p.peer WHERE a.name = 'b' AND s.name = 'c'")

        self.falls("capture_margin", ["3 dB", "none"], from_c, radio=(*radio, "capture_window: 1 ms"), stations=three)
        self.rises("capture_window", ["1 us", "2 ms"], from_c, radio=(*radio, "capture_margin: 3 dB"), stations=three)
        # The weaker one comes 2 us before the stronger one: without a window it is the first that is taken.
        self.rises("preamble_window", ["0 us", "4 us"], from_c, radio=(*radio, "capture_margin: none"),
                   stations=[(0, AT_ONCE_TO_ALL, ""), (650, None, ""), (1900, AT_ONCE_TO_ALL, "tx_power: 4000 mW")])

    # How long frames are.

    def test_rates_and_lengths(self):
        self.is_each([192 + 1102, 192 + 551], "data_rate", ["8 Mb/s".replace("8", "1"), "2 Mb/s"], Run.airtime,
                     stations=[(0, "pattern: periodic, rate: 20 Hz, to: b, size: 94", ""), (100, None, "")],
                     delta=60)
        self.is_each([352, 272], "control_rate", ["1 Mb/s", "2 Mb/s"], lambda run: run.airtime("rts"),
                     radio=("profile: ieee80211b", "rts_threshold: 0"))
        self.falls("broadcast_rate", ["1 Mb/s", "11 Mb/s"], lambda run: run.airtime("broadcast"),
                   stations=[(0, TO_ALL, ""), (100, None, "")])
        self.is_each([304, 248], "basic_rates", ["[1 Mb/s]", "[1 Mb/s, 2 Mb/s]"], lambda run: run.airtime("ack"))
        self.is_each([192 - 96], "preamble", ["long", "short"], lambda run: run.airtime(), delta=1e9)
        long, short = self.compare("preamble", ["long", "short"], Run.airtime)
        self.assertAlmostEqual(long - short, 96)
        exact, rounded = self.compare("rounding", ["exact", "microsecond"], Run.airtime)
        self.assertTrue(exact < rounded < exact + 1 and rounded == int(rounded), (exact, rounded))
        self.is_each([272 + 64, 272 + 640], "fixed_payload_bits", [64, 640], Run.bits, radio=FIXED)
        self.is_each([100 + 64, 300 + 64], "fixed_header_bits", [100, 300], Run.bits,
                     radio=(*FIXED, "fixed_payload_bits: 64"))
        fixed, real = self.compare("lengths", ["fixed", "bytes"], Run.bits)
        self.assertEqual(fixed, 272)
        self.assertGreater(real, 1000)

    # Who may send, and how often.

    def test_intervals(self):
        self.is_each([10, 25], "sifs", ["10 us", "25 us"], lambda run: run.gap("unicast", "ack"),
                     radio=("profile: ieee80211b", "propagation_delay: false"), stations=SATURATED)
        # DIFS is SIFS and two slots; some of the backoffs are of no slot.
        self.is_each([10 + 2 * 20, 10 + 2 * 30], "slot", ["20 us", "30 us"], lambda run: run.gap("ack", "unicast"),
                     radio=("profile: ieee80211b", "propagation_delay: false"), stations=SATURATED, time="2 s")
        alone = [(0, SATURATED_TO_ALL, "")]
        self.rises("cw_min", [7, 31, 127], Run.mean_gap, stations=alone)
        # Nobody answers: the window doubles, up to its maximum.
        nobody = [(0, "pattern: saturated, to: b, size: 100", ""), (1e5, None, "")]
        self.rises("cw_max", [31, 1023], lambda run: run.mean_gap("unicast"), stations=nobody, time="1 s")
        self.rises("cw_broadcast", [7, 127], Run.mean_gap, radio=("profile: mobility_framework",),
                   stations=[(0, SATURATED_TO_ALL, ""), (10, SATURATED_TO_ALL, "")])
        # What begins within it before a slot boundary is not noticed there.
        # Slots are 2 us apart at the two, so that a frame of one begins 16 us before a boundary of the other.
        two = [(0, SATURATED_TO_ALL, ""), (600, SATURATED_TO_ALL, "")]
        self.rises("cca_time", ["10 us", "19 us"], Run.together, time="2 s",
                   radio=("profile: ieee80211b", "cw_min: 3", "broadcast_rate: 11 Mb/s"), stations=two)

    def test_eifs(self):
        """Four saturated links in a row; c hears b and d, which do not hear each other."""
        row = [(40 * i, f"pattern: saturated, backlog: 2, to: {to}, size: 993" if to else None, "")
               for i, to in enumerate(("b", "c", "d", "e", None))]
        options = dict(radio=("profile: ieee80211g", "data_rate: 12 Mb/s", "slot: 9 us", LOG_DISTANCE),
                       stations=row, time="2 s")
        self.rises("eifs_start", ["medium_idle", "frame_end"], lambda run: run.received("d"), **options)
        self.rises("header_error", ["eifs", "forgotten"], lambda run: run.frames(sender="c"), **options)

    def test_retries_and_queues(self):
        nobody = [(0, "pattern: periodic, rate: 10 Hz, phase: 0 s, to: b, size: 100", ""), (1e5, None, "")]
        self.is_each([5, 7], "short_retry_limit", [5, 7], Run.frames, stations=nobody, time="90 ms")
        # RTS get through to b, 20 dB above the noise; data at 11 Mb/s do not.
        deaf = [(0, "pattern: periodic, rate: 5 Hz, phase: 0 s, to: b, size: 1400", ""), (100, None, "")]
        self.is_each([2, 4], "long_retry_limit", [2, 4], Run.frames, stations=deaf, time="190 ms",
                     radio=("profile: ieee80211b", "rts_threshold: 0", "noise_floor: -68.3 dBm"))
        found = self.compare("rts_threshold", [0, 2347], lambda run: run.frames("rts"))
        self.assertGreater(found[0], 0)
        self.assertEqual(found[1], 0)
        burst = [(0, "pattern: bursts, burst: 30, rate: 1 Hz, phase: 0 s, to: b", ""), (100, None, "")]
        self.falls("queue_limit", [5, 20], lambda run: run.ended("queue full"), stations=burst)
        self.rises("msdu_lifetime", ["none", "10 ms"], lambda run: run.ended("expired"), stations=burst)

    def test_error_table(self):
        station = [(0, "pattern: periodic, rate: 50 Hz, phase: 0 s, to: b, size: 500", ""), (10, None, "")]
        rows = '["HT7,500,0,1", "HT7,500,1,{}"]'.format
        self.rises("error_table", [rows(0), rows(0.5), rows(1)], Run.frames, stations=station,
                   radio=("profile: ieee80211n", "aggregation: {max_ampdu: 0}"))

    def test_queues(self):
        radio = ("profile: ieee80211b", "queues: {per: station}")
        self.rises("queues: {per: {}}", ["radio", "station"],
                   lambda run: run.one("SELECT count(*) FROM station_queues"), radio=radio)
        burst = [(0, "pattern: bursts, burst: 30, rate: 1 Hz, phase: 0 s, to: b, size: 500", ""), (100, None, "")]
        full = dict(what=lambda run: run.ended("queue full"), radio=radio, stations=burst)
        self.falls("queues: {per: station, limit: {}}", [5, 20], **full)
        self.falls("queues: {per: station, limit_bytes: {}}", [2000, 5000], **full)
        self.is_each([5, 10], "queues: {per: station, discipline: fq_codel, limit: {}}", [5, 10],
                     lambda run: run.one("SELECT max(most) FROM station_queues"), radio=radio, stations=burst)
        delay = dict(what=lambda run: run.ended("queue delay"), radio=radio, time="1 s",
                     stations=[(0, "pattern: saturated, backlog: 50, to: b, size: 1000", ""), (100, None, "")])
        codel = "queues: {{per: station, discipline: fq_codel, limit: 100, {}: {{}}}}".format
        self.rises("queues: {per: station, limit: 100, discipline: {}}", ["fifo", "fq_codel"], **delay)
        self.falls(codel("target"), ["5 ms", "99 ms"], **delay)
        self.falls(codel("interval"), ["50 ms", "400 ms"], **delay)

    def test_queues_of_access_points(self):
        radio = ("profile: ieee80211b", "bss: {access_point: a}")

        def sends(to, size):
            return f"pattern: saturated, backlog: 2, to: {to}, size: {size}"

        def relayed(source):
            return lambda run: run.one("SELECT coalesce(sum(count), 0) FROM relays r JOIN agents s ON s.agent = source "
                                       f"WHERE s.name = '{source}' AND verdict = 'delivered'")

        def turns(run):
            """How often the access point sends to another receiver than before."""
            receivers = [row[0] for row in run.query(
                "SELECT receiver FROM frames JOIN agents ON agent = transmitter "
                "WHERE class = 'unicast' AND name = 'a' ORDER BY at_ns")]
            return sum(one != other for one, other in zip(receivers, receivers[1:]))

        # b and d send to c: one flow fills the queue, the other loses nothing by it if it has a queue of its own.
        thin = [(0, None, ""), (20, sends("c", 1000), ""), (40, None, ""),
                (60, "pattern: periodic, rate: 30 Hz, to: c, size: 100", "")]
        self.rises("queues: {per: station, discipline: fq_codel, limit: 20, target: 90 ms, flows: {}}", [1, 1024],
                   relayed("d"), radio=radio, stations=thin, time="2 s")
        # Long frames to d and short ones to e.
        two = [(0, None, ""), (20, sends("d", 1400), ""), (40, sends("e", 100), ""), (60, None, ""), (80, None, "")]
        two = dict(radio=radio, stations=two, time="2 s")
        self.rises("queues: {per: station, airtime_fairness: {}}", ["false", "true"], relayed("c"), **two)
        self.falls("queues: {per: station, airtime_fairness: true, airtime_quantum: {}}", ["300 us", "50 ms"], turns,
                   **two)

    def test_error_models(self):
        # 7 dB over the noise 11 Mb/s gets through by the standard's curves, not by the paper's.
        weak = ("profile: ieee80211b", "noise_floor: -71.1 dBm")
        found = self.compare("error_model", ["mobility_framework", "dsss"], lambda run: run.received(), radio=weak)
        self.assertNotEqual(found[0], found[1])

    def test_loss(self):
        self.rises("loss: {probability: {}}", [0, 0.5], lambda run: run.verdicts("random loss"))
        self.rises("loss: {links: [{from: a, to: b, probability: {}}]}", [0, 0.5],
                   lambda run: run.verdicts("random loss"))
        self.rises("loss: {links: [{from: {}, to: b, probability: 0.5}]}", ["b", "a"],
                   lambda run: run.verdicts("random loss"))
        self.rises("loss: {links: [{from: a, to: {}, probability: 0.5}]}", ["a", "b"],
                   lambda run: run.verdicts("random loss"))

    # Choosing rates.

    def test_rate_control(self):
        options = dict(radio=("profile: ieee80211g",), stations=SATURATED)
        found = self.compare("rate_control", ["fixed", "aarf", "minstrel"], Run.rates, **options)
        self.assertEqual(found[0], 1)
        self.assertTrue(found[1] > 5 and found[2] > 1, found)
        aarf = dict(radio=("profile: ieee80211g", "rate_control: aarf", "loss: {probability: 0.02}"),
                    stations=SATURATED)
        self.falls("aarf_threshold", [2, 40], Run.rates, **{**aarf, "time": "100 ms"})
        # At 300 m 54 Mb/s fails: the larger the threshold becomes, the less often it is probed.
        out_of_reach = dict(radio=("profile: ieee80211g", "rate_control: aarf", "noise_floor: -86 dBm"),
                            stations=[(0, "pattern: saturated, to: b, size: 1000", ""), (100, None, "")],
                            time="2 s")
        self.falls("aarf_max_threshold", [10, 100], lambda run: run.verdicts("noise"), **out_of_reach)
        self.falls("aarf_timeout", [11, 100000], lambda run: run.rates(),
                   **{**aarf, "time": "400 ms", "radio": ("profile: ieee80211g", "rate_control: aarf",
                                                          "loss: {probability: 0.15}")})
        minstrel = dict(radio=("profile: ieee80211g", "rate_control: minstrel"), stations=SATURATED)
        self.rises("minstrel_sampling", [0, 0.1], Run.rates, **minstrel)
        self.falls("minstrel_interval", ["10 ms", "150 ms"], lambda run: run.received(), **minstrel)
        lossy = dict(radio=("profile: ieee80211g", "rate_control: minstrel", "loss: {probability: 0.3}",
                            "minstrel_interval: 5 ms"), stations=SATURATED, time="1 s")
        found = self.compare("minstrel_past", [0, 0.9], lambda run: run.received(), **lossy)
        self.assertNotEqual(found[0], found[1])

    def test_rate_control_of_mcs(self):
        radio = ("profile: ieee80211n", "aggregation: {max_ampdu: 0}")
        found = self.compare("rate_control", ["fixed", "ideal", "minstrel_ht"], Run.rates, radio=radio,
                             stations=SATURATED, time="1 s")
        # ideal begins with the slowest and then knows the SINR.
        self.assertEqual(found[:2], [1, 2])
        self.assertGreater(found[2], 4)
        self.falls("minstrel_ht_wait", [0, 100000], Run.rates, radio=(*radio, "rate_control: minstrel_ht"),
                   stations=SATURATED, time="1 s")
        self.falls("ideal_loss", [1e-6, 0.9],
                   lambda run: run.one("SELECT min(airtime_ns) FROM frames WHERE class = 'unicast'"),
                   radio=(*radio, "rate_control: ideal", "noise_floor: -65 dBm"), stations=SATURATED)

    # Access points: a is one.

    def test_access_points(self):
        bss = "bss: {access_point: a, %s}"
        radio = ("profile: ieee80211b", "propagation: [{model: log_distance}]", "propagation_delay: false")

        def at(run, who="b", gone=False):
            """When a station was associated, or alone again, ms."""
            return run.one("SELECT min(at_ns) FROM associations s JOIN agents a ON a.agent = s.station "
                           f"WHERE a.name = '{who}' AND access_point IS {'' if gone else 'NOT'} NULL") / 1e6

        still = dict(radio=radio, stations=[(0, None, ""), (10, TO_B.replace("to: b", "to: c"), ""), (5, None, "")],
                     time="1 s")
        self.rises("bss: {access_point: {}}", ["c", "a"], lambda run: run.frames("beacon"), **still)
        self.falls(bss % "beacon_interval: {}", ["51.2 ms", "102.4 ms"], lambda run: run.frames("beacon"), **still)
        self.rises(bss % "ssid: {}", ["ab", "abcdef"], lambda run: run.airtime("beacon"), **still)
        self.rises(bss % "scan_time: {}", ["150 ms", "400 ms"], at, **still)
        leaving = dict(radio=radio, stations=[(0, None, ""), (40, None, "", "path: {line: {speed: 20 m/s}}")],
                       time="6 s")
        self.rises(bss % "beacon_loss: {}", [3, 20], lambda run: at(run, gone=True), **leaving)
        # a is busy with frames of 16 ms to c while b comes in: its answers take as long.
        coming = dict(radio=(*radio, "data_rate: 1 Mb/s"), time="4 s", stations=[
            (0, "pattern: saturated, backlog: 2, to: c, size: 2000, start: 500 ms", ""),
            (-60, None, "", "path: {line: {speed: 10 m/s}}"), (5, None, "")])
        self.falls(bss % "answer_timeout: {}", ["5 ms", "500 ms"],
                   lambda run: run.frames("management", "b"), **coming)

    # Agents with radios of their own.

    def test_mixed_cells(self):
        mixed = [(0, TO_B, ""), (100, None, ""), (10, None, "standard: ieee80211b")]
        radio = ("profile: ieee80211g", "control_rate: 6 Mb/s")
        self.rises("protection", ["none", "cts_to_self"], lambda run: run.frames("cts"), radio=radio, stations=mixed)
        self.rises("protection", ["none", "auto"], lambda run: run.frames("cts"), radio=radio, stations=mixed)
        self.rises("protection", ["cts_to_self", "rts_cts"], lambda run: run.frames("rts"), radio=radio,
                   stations=mixed)
        self.is_each([304, 248], "protection_rate", ["1 Mb/s", "2 Mb/s"], lambda run: run.airtime("cts"), radio=radio,
                     stations=mixed)
        found = [self.play(radio, [(0, TO_B, ""), (100, None, own)]).airtime()
                 for own in ("", "standard: ieee80211b")]
        self.assertGreater(found[1], found[0] + 100)

    # Modes with MCSs.

    def test_modes_with_an_mcs(self):
        n, ac, ax = ("profile: ieee80211n",), ("profile: ieee80211ac",), ("profile: ieee80211ax",)
        near = [(0, TO_B, ""), (10, None, "")]
        options = dict(stations=near)
        self.falls("mcs", [0, 3, 7], Run.airtime, radio=n, **options)
        self.falls("mcs", [0, 3, 9], Run.airtime, radio=ac, **options)
        self.falls("mcs", [0, 3, 11], Run.airtime, radio=ax, **options)
        self.falls("streams", [1, 2], Run.airtime, radio=(*n, "mcs: 0"), **options)
        self.falls("width", ["20 MHz", "40 MHz"], Run.airtime, radio=(*n, "mcs: 0"), **options)
        self.falls("width", ["20 MHz", "40 MHz", "80 MHz"], Run.airtime, radio=(*ax, "mcs: 0"), **options)
        self.rises("guard_interval", ["400 ns", "800 ns"], Run.airtime, radio=(*n, "mcs: 0"), **options)
        self.rises("guard_interval", ["800 ns", "1600 ns", "3200 ns"], Run.airtime, radio=(*ax, "mcs: 0"), **options)
        # VHT-SIG-B.
        found = self.compare("ppdu_times", ["standard", "ns3"], Run.airtime, radio=ac, **options)
        self.assertAlmostEqual(found[0] - found[1], 4)
        # In 5 GHz there is no signal extension of 6 us, and SIFS is 6 us longer.
        found = self.compare("channel", [1, 36], Run.airtime, radio=n, **options)
        self.assertAlmostEqual(found[0] - found[1], 6)
        self.is_each([10, 16], "channel", [1, 36], lambda run: run.gap("unicast", "ack"),
                     radio=(*n, "propagation_delay: false"), **options)
        narrow = dict(radio=(*n, "width: 40 MHz"), stations=[*near, (5, None, "width: 20 MHz")])
        self.rises("wide_protection", ["false", "true"], lambda run: run.frames("cts"), **narrow)
        beacons = dict(radio=(*n, "bss: {access_point: a}"), stations=[(0, None, ""), (5, None, "")], time="1 s")
        self.falls("beacon_rate", ["1 Mb/s", "6 Mb/s"], lambda run: run.airtime("beacon"), **beacons)

    def test_qos(self):
        g, n = ("profile: ieee80211g",), ("profile: ieee80211n",)
        found = self.compare("qos", ["false", "true"], Run.bits, radio=g)
        self.assertEqual(found[1] - found[0], 16)  # the QoS Control field
        radio = (*g, "qos: true", "propagation_delay: false")
        best_effort = "edca: {{best_effort: {{cw_min: 0, cw_max: 0, {}}}}}".format
        gap = dict(what=lambda run: run.gap("ack", "unicast"), radio=radio, stations=SATURATED)
        slot = 20  # us
        found = self.compare(best_effort("aifsn: {}"), [2, 10], **gap)
        self.assertAlmostEqual(found[1] - found[0], 8 * slot)
        found = self.compare(best_effort("txop_limit: {}"), ["0 s", "10 ms"], **gap)
        self.assertAlmostEqual(found[1], 10)  # SIFS: no backoff within a TXOP
        self.assertAlmostEqual(found[0], 10 + 3 * slot)
        announced = "bss: {{access_point: b, edca: {{best_effort: {{cw_min: 0, cw_max: 0, {}}}}}}}".format
        found = self.compare(announced("aifsn: {}"), [2, 10], **gap, time="500 ms")
        self.assertAlmostEqual(found[1] - found[0], 8 * slot)
        burst = [(0, "pattern: bursts, burst: 30, rate: 1 Hz, phase: 0 s, to: b", ""), (100, None, "")]
        self.rises("edca: {best_effort: {msdu_lifetime: {}}}", ["none", "5 ms"], lambda run: run.ended("expired"),
                   radio=radio, stations=burst)
        many = [(0, "pattern: saturated, backlog: 100, to: b, size: 500", ""), (10, None, "")]
        options = dict(radio=n, stations=many)
        received = self.compare("aggregation: {max_ampdu: {}}", [0, 65535], Run.received, **options)
        self.assertGreater(received[1], 2 * received[0])
        received = self.compare("aggregation: {block_ack_window: {}}", [2, 64], Run.received, **options)
        self.assertGreater(received[1], 2 * received[0])
        bits = self.compare("aggregation: {max_ampdu: 0, max_amsdu: {}}", [0, 3839], Run.bits, **options)
        self.assertGreater(bits[1], 6 * bits[0])

    def test_mixed_cells_with_an_mcs(self):
        radio = ("profile: ieee80211n", "width: 40 MHz", "streams: 2", "mcs: 0")

        def to(own):
            return self.play(radio, [(0, TO_B, ""), (10, None, own)]).airtime()

        best = to("")
        for own in ("width: 20 MHz", "streams: 1", "standard: ieee80211g", "standard: ieee80211b"):
            self.assertGreater(to(own), best, own)
        self.assertGreater(self.play(radio, [(0, TO_B, ""), (10, None, ""), (5, None, "standard: ieee80211g")])
                           .frames("cts"), 0)

    def test_radios_of_stations(self):
        radio = ("profile: ieee80211b",)

        def pair(own):
            return self.play(radio, [(0, TO_B, own), (100, None, "")])

        plain = pair("")
        self.assertAlmostEqual(pair("tx_power: 80 mW").rssi() - plain.rssi(), 10 * math.log10(2), delta=1e-6)
        self.assertAlmostEqual(pair("antenna_gain: 7 dB").rssi() - plain.rssi(), 7, delta=1e-6)
        higher = pair("antenna_height: 100.1 m").rssi()
        self.assertAlmostEqual(higher - plain.rssi(), -10 * math.log10(2), delta=1e-3)
        self.assertEqual(pair("channel: 6").received(), 0)
        self.assertGreater(plain.received(), 0)
        self.assertGreater(pair("data_rate: 1 Mb/s").airtime(), 5 * plain.airtime() / 2)
        broadcasts = [self.play(radio, [(0, TO_ALL, own), (100, None, "")]).airtime("broadcast")
                      for own in ("", "broadcast_rate: 11 Mb/s")]
        self.assertGreater(broadcasts[0], broadcasts[1])
        rts = [self.play((*radio, "rts_threshold: 0"), [(0, TO_B, own), (100, None, "")]).airtime("rts")
               for own in ("", "control_rate: 2 Mb/s")]
        self.assertEqual(rts, [352, 272])
        some = self.play(radio, [(0, TO_B, "overrides: [{agents: a, tx_power: 80 mW}]"), (100, None, "")])
        self.assertAlmostEqual(some.rssi() - plain.rssi(), 10 * math.log10(2), delta=1e-6)


TO_B = "pattern: periodic, rate: 100 Hz, to: b, size: 200"
TO_ALL = "pattern: periodic, rate: 100 Hz, to: everyone, size: 100"
AT_ONCE_TO_ALL = "pattern: periodic, rate: 50 Hz, phase: 1 ms, to: everyone, size: 100"
SATURATED_TO_ALL = "pattern: saturated, backlog: 2, to: everyone, size: 100"
PAIR = [(0, TO_B, ""), (100, None, "")]
SATURATED = [(0, "pattern: saturated, backlog: 2, to: b, size: 1000", ""), (10, None, "")]
LOUD = ("profile: ieee80211b", "sensitivity: -120 dBm", "interference_floor: -120 dBm", "cca_threshold: -120 dBm",
        "noise_floor: -130 dBm")
FIXED = ("profile: ieee80211b", "lengths: fixed")

# Keys that other tests show.
ELSEWHERE = {
    "version": "config/invalid", "profile": "all tests here",
    "body_loss_per_crossing": "world_obstacles_test.cpp", "body_loss_per_metre": "world_obstacles_test.cpp",
    "access_point": "test_access_points", "bss": "test_access_points",
    "hysteresis": "handover_test.py", "beacon_weight": "roaming_test.cpp", "distribution_delay": "roaming_test.cpp",
    "bits_at_risk": "tests/analytic/radio/phy_mode_test.cpp, range_test.cpp",
    "range": "tests/unit/sim/radio/disk_mac_test.cpp",
    "quantum": "tests/unit/sim/radio/queue_discipline_test.cpp",
    "reorder_timeout": "tests/unit/sim/radio/recipient_agreement_test.cpp",
    **dict.fromkeys(("constant_loss", "walls", "material", "ceiling_loss", "ceiling_b", "gap"),
                    "tests/unit/sim/agents/multi_wall_test.cpp"),
    **dict.fromkeys(("background", "video", "voice"), "tests/unit/sim/radio/recipient_agreement_test.cpp, edca_test.cpp"),
}


class ZCompleteness(unittest.TestCase):
    def test_no_key_is_missing(self):
        """Runs last, by its name."""
        page = (ROOT / "docs/keys.md").read_text()
        section = page[page.index("## Radio files"):]
        section = section[:section.index("\n## ", 5)] if "\n## " in section[5:] else section
        keys = set(re.findall(r"^\| `([a-z_0-9]+)` \|", section, re.M))
        self.assertGreater(len(keys), 40)
        missing = keys - RadioKeys.seen - set(ELSEWHERE)
        self.assertEqual(missing, set(), json.dumps(sorted(missing)))


if __name__ == "__main__":
    unittest.main()
