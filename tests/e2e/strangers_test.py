#!/usr/bin/env python3
"""Another user of the computer ends no run and holds no robot, whatever host it says to be of; who it is
is told, and a run goes on to the fingerprint that it has without. BARAKA_TRUST lets it in."""
import os
import re
import subprocess
import time
import unittest

from baraka import BIN, CASE_STUDY, ROOT, Case, Finished, loopback, wait_for
from real_agents import Place, Process, RealAgents

USURPER = BIN.parent / "tests/usurper"
# In user namespaces of their own, as in a container that shares the network: others have no number.
IN_CONTAINER = ("unshare", "--user", "--map-root-user")
OWNER, OTHER, NOBODY, ROOT_USER, SERVICE = 1001, 1002, 65534, 0, 997
UNTIL = 8  # simulated s, at twice that of the wall
TRIALS = int(os.environ.get("BARAKA_TRIALS", "1"))  # of each kind
MODES = ("refuse", "grant", "step", "hello")
VERSION = re.search(r"kProtocolVersion = (\d+)", (ROOT / "hal/node/exchange/session.h").read_text()).group(1)


def as_user(user, *command):
    if user == os.geteuid():
        return [*map(str, command)]
    return ["setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups", *map(str, command)]


@unittest.skipUnless(os.geteuid() == 0, "becoming other users needs root")
class Runs(Case):
    def setUp(self):
        super().setUp()
        self.folder.chmod(0o755)

    def command(self, user, prefix=()):
        """A run of a user, into a folder of its own."""
        self.runs += 1
        home = self.folder / f"home{self.runs}"
        home.mkdir(mode=0o755)
        os.chown(home, user, user)
        self.out = home / "run"
        return as_user(user, *prefix, BIN / "baraka", "run", CASE_STUDY, "--until", UNTIL, "--max-speed", 2,
                       "--out", self.out)

    def run_as(self, user, stranger=None, mode=None, trust="", prefix=()):
        """@return how it ended, and what the stranger got."""
        environment = {**os.environ, "HOME": str(self.folder), "BARAKA_TRUST": trust}
        run = subprocess.Popen(self.command(user, prefix), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True, env=environment)
        heard = ""
        if stranger is not None:
            domain = re.match(r"domain: (\d+)", run.stderr.readline()).group(1)
            usurper = subprocess.Popen(as_user(stranger, USURPER, domain, mode, VERSION), text=True,
                                       stdout=subprocess.PIPE)
            self.assertEqual(usurper.stdout.readline(), "ready\n")
        out, err = run.communicate(timeout=120)
        if stranger is not None:
            usurper.terminate()
            heard = usurper.communicate()[0]
        return Finished(run.returncode, out, err), heard

    def log(self):
        """Of a run that began."""
        file = self.out / "run.log"
        return file.read_text() if file.exists() else ""

    def check_undisturbed(self, user, stranger):
        expected, _ = self.run_as(user)
        self.assertEqual(expected.status, 0, str(expected))
        self.assertNotIn("not heard", expected.err)
        outcomes = []
        for mode in MODES * TRIALS:
            finished, heard = self.run_as(user, stranger, mode)
            is_same = finished.status == 0 and finished["fingerprint"] == expected["fingerprint"]
            is_named = all(re.search(rf"user {stranger} \(.*is not heard", text)
                           for text in (finished.err, self.log()))
            outcomes.append((mode, is_same, is_named, heard == ""))
            print(f"user {stranger} against {user}: {mode}: status {finished.status}, "
                  f"{'undisturbed' if is_same else 'DISTURBED'}, {'named' if is_named else 'NOT NAMED'}, "
                  f"{'heard nothing' if heard == '' else 'HEARD ' + ', '.join(sorted(set(heard.split(chr(10)))))}",
                  flush=True)
            if not (is_same and is_named):
                print(finished, flush=True)
        self.assertTrue(all(all(one[1:]) for one in outcomes), str(outcomes))

    def test_another_person_ends_no_run_and_is_named(self):
        self.check_undisturbed(OWNER, OTHER)

    def test_nobody_ends_no_run_of_root_and_is_named(self):
        self.check_undisturbed(ROOT_USER, NOBODY)

    def test_who_is_trusted_is_heard(self):
        finished, heard = self.run_as(OWNER, OTHER, "hello", trust=str(OTHER))
        self.assertIn("refused", heard, f"all agents of a run have controllers\n{finished}")
        self.assertEqual(finished.status, 0, str(finished))
        self.assertNotIn("not heard", finished.err)

    def test_root_is_heard(self):
        finished, heard = self.run_as(OWNER, ROOT_USER, "hello")
        self.assertIn("refused", heard, str(finished))
        self.assertNotIn("not heard", finished.err)

    def test_who_cannot_be_told_is_heard_only_where_the_unverified_are(self):
        if subprocess.run(as_user(OWNER, *IN_CONTAINER, "true"), capture_output=True).returncode != 0:
            self.skipTest("no right to make user namespaces")
        finished, heard = self.run_as(OWNER, OTHER, "hello", prefix=IN_CONTAINER)
        self.assertEqual((finished.status, heard), (0, ""), str(finished))
        self.assertRegex(finished.err, r"somebody \(127\.0\.0\.1:\d+\) is not heard.*without a number here")
        finished, heard = self.run_as(OWNER, OTHER, "hello", trust="unverified", prefix=IN_CONTAINER)
        self.assertIn("refused", heard, str(finished))
        self.assertNotIn("not heard", finished.err)

    def test_a_user_that_is_not_there_is_a_mistake(self):
        finished, _ = self.run_as(OWNER, trust="nobody-of-that-name")
        self.assertEqual(finished.status, 2, str(finished))
        self.assertIn("BARAKA_TRUST: 'nobody-of-that-name' is not a user of this computer", finished.err)


@unittest.skipUnless(os.geteuid() == 0, "becoming other users needs root")
class Daemon(RealAgents):
    def setUp(self):
        super().setUp()
        self.place = Place(None, "lo", loopback())
        self.daemon, self.robotino_ = self.robotino(self.place, "r0", 1, more="controller: {program: wanderer}")

    def stranger(self, mode):
        usurper = Process(self, self.place, *as_user(OTHER, USURPER, self.domain, mode, VERSION))
        usurper.await_text("ready")
        return usurper

    def test_a_hello_of_another_user_does_not_hold_the_robot(self):
        usurper = self.stranger("hello")
        wait_for(lambda: f"user {OTHER} (" in self.daemon.err.read_text() or "grant" in usurper.out.read_text())
        self.assertEqual(usurper.out.read_text(), "ready\n", "it has the robot")
        self.program(self.place, "wanderer", "--agents", "r0")
        self.robotino_.await_moving()
        self.assertEqual(usurper.out.read_text(), "ready\n")

    def test_sessions_and_steps_of_another_user_end_no_controller(self):
        controller = self.program(self.place, "wanderer", "--agents", "r0")
        self.robotino_.await_moving()
        self.stranger("step")
        controller.await_text(f"user {OTHER} (", "err")
        time.sleep(1)  # fifty Steps more
        self.assertIsNone(controller.process.poll(), str(controller))
        self.robotino_.await_moving()

    def test_a_controller_of_another_user_learns_why_it_gets_nothing(self):
        wanderer = BIN / "wanderer" if (BIN / "wanderer").exists() else BIN.parent / "tests/wanderer"
        other = Process(self, self.place, *as_user(OTHER, wanderer, "--agents", "r0", "--wait", "2 s"),
                        env=self.environment)
        self.assertEqual(other.finish(), 1, str(other))
        self.assertRegex(other.err.read_text(), rf"user 0 serves it, this is user {OTHER}")


@unittest.skipUnless(os.geteuid() == 0, "becoming other users needs root")
class DaemonOfAService(RealAgents):
    """As config/systemd/baraka-agentd@.service starts it: it has a user of its own, the controllers another."""

    def setUp(self):
        super().setUp()
        self.folder.chmod(0o755)
        (self.folder / "state").mkdir()
        os.chown(self.folder / "state", SERVICE, SERVICE)
        self.place = Place(None, "lo", loopback())

    def program(self, place, name, *arguments, user=SERVICE, trust=None):
        environment = {**self.environment, "BARAKA_TRUST": self.trust if trust is None else trust}
        return Process(self, place, *as_user(user, BIN / name, *arguments), env=environment)

    def serve_robot(self, trust):
        self.trust = trust
        return self.robotino(self.place, "r0", 1, more="controller: {program: wanderer}")

    def wanderer(self, user, trust):
        return self.program(self.place, "wanderer", "--agents", "r0", "--wait", "3 s", user=user, trust=trust)

    def test_hears_a_person_if_each_names_the_other(self):
        _, robotino = self.serve_robot(trust=str(OTHER))
        self.wanderer(OTHER, trust=str(SERVICE))
        robotino.await_moving()

    def test_hears_no_person_that_it_does_not_name(self):
        daemon, robotino = self.serve_robot(trust="")
        controller = self.wanderer(OTHER, trust=str(SERVICE))
        self.assertEqual(controller.finish(), 1, str(controller))
        self.assertRegex(controller.err.read_text(), rf"user {SERVICE} serves it, this is user {OTHER}")
        self.assertRegex(daemon.err.read_text(), rf"user {OTHER} \(.*is not heard.*BARAKA_TRUST={OTHER} is not set")
        self.assertFalse(robotino.state()["moving"])

    def test_is_heard_by_no_person_who_does_not_name_it(self):
        _, robotino = self.serve_robot(trust=str(OTHER))
        controller = self.wanderer(OTHER, trust="")
        self.assertEqual(controller.finish(), 1, str(controller))
        self.assertRegex(controller.err.read_text(), rf"user {SERVICE} \(.*is not heard by this process of user {OTHER}")
        self.assertFalse(robotino.state()["moving"])

    def test_hears_root_who_must_name_it(self):
        _, robotino = self.serve_robot(trust="")
        controller = self.wanderer(ROOT_USER, trust="")
        self.assertEqual(controller.finish(), 1, str(controller))
        self.assertFalse(robotino.state()["moving"])
        self.wanderer(ROOT_USER, trust=str(SERVICE))
        robotino.await_moving()


if __name__ == "__main__":
    unittest.main()
