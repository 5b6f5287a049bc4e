#!/usr/bin/env python3
"""What agents' programs have for themselves, and what they cannot reach: as root and as an ordinary user."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import textwrap
import unittest

import wire
from baraka import BIN, Case, wait_for
from wire import PYTHON, Wire

REFUSED = wire.why_not()
REFUSED_TO_USER = REFUSED or wire.why_not(wire.as_user([]))
OWN_FOLDERS = ("/tmp", "/run", "/dev/shm")
# Users beside its own that a user may have inside: what `usermod --add-subuids` writes, for this test alone.
SUBORDINATE = ('echo {user}:300000:65536 > /dev/net/ids && mount --bind /dev/net/ids /etc/subuid && '
               'mount --bind /dev/net/ids /etc/subgid').format(user=wire.USER)


def needs(program):
    return unittest.skipUnless(shutil.which(program, path=wire.PATH), f"needs {program}")


LISTENER = textwrap.dedent("""\
    import socket, sys, time
    for path in sys.argv[1:]:
        s = socket.socket(socket.AF_UNIX)
        s.bind(path)
        s.listen()
        globals()[path] = s
    print("listens", flush=True)
    time.sleep(1000)
    """)

# Whatever can be written where the kernel as a whole is told something; nothing is. What nobody may write opens for
# root all the same, but a write of no octets is refused where the kernel takes none.
WRITABLE = textwrap.dedent("""\
    import os, stat
    def is_of_process(path): return path.split("/")[2][:1].isdigit() or path.split("/")[2] in ("self", "thread-self", "net")
    def takes(path, mode):
        try: file = os.open(path, os.O_WRONLY | os.O_NONBLOCK)
        except OSError: return False
        try: return mode & 0o222 or os.write(file, b"") == 0
        except OSError: return False
        finally: os.close(file)
    for top in ("/proc", "/sys"):
        for folder, folders, files in os.walk(top):
            if folder == "/proc":
                folders[:] = [one for one in folders if not is_of_process("/proc/" + one)]
            if folder == "/proc/sys": folders.remove("net")
            for name in files:
                path = os.path.join(folder, name)
                mode = os.lstat(path).st_mode
                if stat.S_ISLNK(mode) or stat.S_ISCHR(mode): continue  # /dev/null in its place
                if takes(path, mode): print(path)
    """)

# All that descriptors of all processes there lead to, until it has seen enough.
LOOK_ON = textwrap.dedent("""\
    import glob, os, time
    seen, end = set(), time.monotonic() + 20
    print("looks on", flush=True)
    while time.monotonic() < end and not os.path.exists("/tmp/enough"):
        for link in glob.glob("/proc/[0-9]*/fd/*"):
            try: seen.add((link.split("/")[2], os.readlink(link)))
            except OSError: continue
    for process, what in sorted(seen): print(process, what)
    """)

UNMOUNT = textwrap.dedent("""\
    import ctypes, os
    c = ctypes.CDLL(None, use_errno=True)
    DETACH, BIND, REMOUNT = 2, 4096, 32
    for path in (b"/proc", b"/proc/sys", b"/sys", b"/tmp", b"/run", b"/dev/shm"):
        print(path.decode(), c.umount2(path, DETACH))
    for path in (b"/proc/sys", b"/sys"):
        print("remount", path.decode(), c.mount(None, path, None, BIND | REMOUNT, None))
    print("processes", *sorted(int(one) for one in os.listdir("/proc") if one.isdigit()))
    """)


@unittest.skipIf(REFUSED, REFUSED)
class AsRoot(unittest.TestCase):
    user = False

    def wire(self, *arguments, **options):
        return Wire(self, *arguments, user=self.user, **options)

    def test_a_socket_or_file_of_one_name_is_another_one_in_each_agent(self):
        run = self.wire()
        paths = [f"{folder}/apart-{os.getpid()}.sock" for folder in OWN_FOLDERS]
        for agent in range(3):
            run.start(agent, PYTHON, "-c", LISTENER, *paths).says("listens")
        for path in paths:
            self.assertFalse(pathlib.Path(path).exists(), path)

    def test_the_folders_are_as_everywhere_and_bounded(self):
        run = self.wire()
        said = run.run(0, "stat", "-f", "-c", "%n %T %b %S", *OWN_FOLDERS).splitlines()
        for line in said:
            name, kind, blocks, size = line.split()
            self.assertEqual(kind, "tmpfs", line)
            self.assertEqual(int(blocks) * int(size), (256 if name == "/run" else 1024) << 20, line)
        self.assertEqual(run.run(0, "stat", "-c", "%a", *OWN_FOLDERS).split(), ["1777", "755", "1777"])

    def test_an_agent_sees_its_own_processes_only(self):
        run = self.wire()
        for agent in range(3):
            run.start(agent, "sleep", "1000")
        numbers = [run.run(agent, "pidof", "sleep").split() for agent in range(3)]
        self.assertEqual([len(one) for one in numbers], [1, 1, 1])
        self.assertEqual(len(set(sum(numbers, []))), 3, "DDS makes identities of them")
        names = run.run(1, "sh", "-c", "cat /proc/[0-9]*/comm").split()
        self.assertEqual(sorted(set(names) - {"sh", "cat"}), ["baraka-agent", "sleep"])
        self.assertLessEqual(len(names), 4, names)

    def test_nothing_can_be_unmounted_or_made_writable(self):
        run = self.wire()
        run.start(1, "sleep", "1000")
        said = run.run(0, PYTHON, "-c", UNMOUNT).splitlines()
        for line in said[:-1]:
            self.assertTrue(line.endswith(" -1"), line)
        self.assertEqual(len(said[-1].split()), 3, "process 1, and this one: " + said[-1])
        self.assertNotEqual(run.start(0, "mount", "-t", "proc", "proc", "/mnt").status(), 0)

    def test_the_kernel_is_told_nothing_but_of_the_agents_own_network(self):
        run = self.wire()
        self.assertEqual(run.run(0, PYTHON, "-c", WRITABLE), "")
        forward = "/proc/sys/net/ipv4/ip_forward"
        run.run(0, "sh", "-c", f"echo 1 > {forward}")
        self.assertEqual([run.run(agent, "cat", forward).strip() for agent in (0, 1)], ["1", "0"])

    def test_no_descriptor_leads_to_another_agent_while_programs_start(self):
        run = self.wire()
        looker = run.start(0, PYTHON, "-c", LOOK_ON)
        looker.says("looks on")
        for i in range(60):
            run.start(i % 2, "true")
        run.run(0, "touch", "/tmp/enough")
        seen = [line.split(" ", 1) for line in looker.output().splitlines()[1:]]
        self.assertGreater(len({process for process, _ in seen}), 2, "it saw none start")
        for process, what in seen:
            self.assertFalse(what.startswith(("net:", "mnt:", "user:", "pid:", "uts:", "ipc:", "/dev/net/tun")),
                             f"{process}: {what}")
        self.assertEqual({what for process, what in seen if process == "1"},
                         {"/dev/null", "/memfd:baraka-room (deleted)"})

    def test_what_has_lost_its_parent_is_reaped_and_ends_with_the_run(self):
        run = self.wire()
        mark = f"1000.{os.getpid()}"
        run.run(0, "sh", "-c", f"setsid sleep {mark} & for i in 1 2 3 4 5; do (true & true) & done; exit 0")
        wait_for(lambda: " Z " not in run.run(0, "ps", "-eo", "pid,stat,comm").replace("Z+", "Z "))
        self.assertEqual(run.run(0, "ps", "-o", "ppid=", "-C", "sleep").split(), ["1"])
        trap = run.start(1, "sh", "-c", "trap 'sleep 0.3; echo asked; exit 0' TERM; echo set; while :; do sleep 0.1; done")
        trap.says("set")
        run.close()
        self.assertIn("asked", trap.text(), "programs have time to end")
        found = [one for one in pathlib.Path("/proc").glob("[0-9]*/cmdline") if mark in self.text_of(one)]
        self.assertEqual(found, [])

    @staticmethod
    def text_of(path):
        try:
            return path.read_text(errors="replace")
        except OSError:
            return ""

    def exec(self, run, *command):
        as_user = ["setpriv", "--reuid", str(wire.USER), "--regid", str(wire.USER), "--clear-groups"]
        done = subprocess.run([*(as_user if self.user and os.geteuid() == 0 else []), BIN / "baraka", "exec", "r1",
                               "--run", run.folder, "--", *command],
                              capture_output=True, text=True, timeout=60, check=False, cwd=run.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_who_goes_inside_later_is_as_apart(self):
        run = self.wire()
        run.start(0, "sleep", "1000")
        run.start(1, "sh", "-c", "echo mine > /tmp/mark; exec sleep 1000")
        wait_for(lambda: self.exec(run, "ls", "/tmp/mark"))
        self.assertEqual(len(self.exec(run, "pidof", "sleep").split()), 1)
        self.assertEqual(self.exec(run, "pwd").strip(), str(run.folder), "where it was called is shown")
        found = self.exec(run, "sh", "-c", "ls -l /proc/self/fd")
        self.assertNotRegex(found, r"(net|mnt|user|pid):\[")

    def daemon(self, run, *command):
        """Starts it in all agents; it has to stay."""
        started = [run.start(agent, *command) for agent in range(5)]
        run.run(0, "sleep", "1.5")
        for one in started:
            self.assertNotIn(one.number, run.ended, one.text())
        return started

    @needs("babeld")
    def test_five_babelds(self):
        run = self.wire(agents=5)
        self.daemon(run, "babeld", "-S", "/tmp/babel-state", "wlan0")
        self.assertIn("babeld.pid", run.run(3, "ls", "/run"))


@unittest.skipIf(REFUSED_TO_USER, REFUSED_TO_USER)
class AsUser(AsRoot):
    user = True

    def test_without_users_of_its_own_a_run_says_so_before_it_begins(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="baraka-apart-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        folder.chmod(0o777)
        (folder / "scenario.yaml").write_text(scenario({"a": []}))
        command = [str(BIN / "baraka"), "run", str(folder / "scenario.yaml"), "--overwrite", "--out", str(folder / "out")]
        alone = ["unshare", "--user", "--map-root-user"]  # where it is root that has no other users
        for way, said in (([], "/etc/subuid has no line of this user"), (alone, "no other where it was started")):
            with self.subTest(said):
                done = subprocess.run(wire.as_user(way + command), capture_output=True, text=True, timeout=120, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                if os.geteuid() == 0 or way:
                    self.assertRegex(done.stderr, "hint: programs have no user but 0.*" + said)


@unittest.skipIf(REFUSED, REFUSED)
@unittest.skipUnless(os.geteuid() == 0, "needs root")
class Users(unittest.TestCase):
    """Programs that become other users."""
    options = {}

    def wire(self, *arguments):
        return Wire(self, *arguments, **self.options)

    def test_programs_become_other_users(self):
        run = self.wire()
        said = run.run(0, "setpriv", "--reuid", "33", "--regid", "33", "--clear-groups", "sh", "-c",
                       "id -u; echo x > /tmp/mine; stat -c %u /tmp/mine")
        self.assertEqual(said.split(), ["33", "33"])
        self.assertEqual(run.run(1, "runuser", "-u", "nobody", "--", "id", "-u"), "65534\n")
        self.assertEqual(run.run(1, "ls", "-A", "/tmp").split(), [run.folder.name])

    @needs("mosquitto")
    def test_mosquitto(self):
        run = self.wire(5)
        for one in AsRoot.daemon(self, run, "mosquitto", "-p", "1883"):
            self.assertIn("mosquitto version", one.text())

    @needs("nginx")
    def test_nginx(self):
        run = self.wire(5)
        paths = "".join(f"{name}_temp_path /tmp/{name};" for name in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi"))
        file = run.folder / "nginx.conf"
        file.write_text("daemon off; user www-data; pid /run/nginx.pid; error_log stderr;\nevents {}\n"
                        f"http {{ access_log off; {paths} server {{ listen 8080; return 200 ok; }} }}\n")
        AsRoot.daemon(self, run, "nginx", "-c", file, "-e", "stderr")
        get = "import urllib.request; print(urllib.request.urlopen('http://r1:8080/').read().decode())"
        self.assertEqual(run.run(0, PYTHON, "-c", get), "ok\n")


@needs("newuidmap")
@unittest.skipIf(REFUSED_TO_USER, REFUSED_TO_USER)
class UsersOfAUser(Users):
    """The same with what /etc/subuid gives an ordinary user."""
    options = {"user": True}

    def wire(self, *arguments):
        return Wire(self, *arguments, user=True, prepare=SUBORDINATE)


def scenario(programs):
    """Of stations with a network, by name, and their programs."""
    agents = "".join(f"  {name}:\n    name: {name}\n    station: {{}}\n    poses: [{{x: {i} m, y: 0 m}}]\n"
                     f"    network: {{}}\n    programs: {json.dumps(its)}\n"
                     for i, (name, its) in enumerate(programs.items()))
    return ("version: 1\nrouting: none\nradio: {include: radios/ieee80211b.yaml}\nagents:\n" + agents
            + "end: [{at: 3 s, result: timeout}]\n")


@unittest.skipIf(REFUSED, REFUSED)
class Shown(Case):
    def test_what_of_the_computers_tmp_a_program_sees(self):
        """Its own folder, that of the scenario, that of the results, and what `shown` names."""
        elsewhere = pathlib.Path(tempfile.mkdtemp(prefix="baraka-shown-"))
        self.addCleanup(shutil.rmtree, elsewhere, ignore_errors=True)
        for name in ("hidden", "shown"):
            (elsewhere / name).mkdir()
            (elsewhere / name / "file").write_text(name)
        tool = elsewhere / "tools" / "tool"
        tool.parent.mkdir()
        tool.write_text('#! /bin/sh\nfor path; do test -e "$path" && echo "$path"; done; echo done > "$RESULTS/mark"\n')
        tool.chmod(0o755)
        link = elsewhere / "links" / "tool"
        link.parent.mkdir()
        link.symlink_to(tool)
        file = self.folder / "scenario.yaml"
        paths = [str(one) for one in (elsewhere / "hidden/file", elsewhere / "shown/file", tool, file)]
        program = {"name": "tool", "command": [str(link), *paths], "environment": {"RESULTS": "{results}"},
                   "shown": [str(elsewhere / "shown")], "on_exit": "end"}
        file.write_text(scenario({"a": [program]}))
        finished = self.run_baraka(file)
        self.assertEqual(finished["result"], "tool", str(finished))
        self.assertEqual((self.out / "a.tool.log").read_text().split(), paths[1:])
        self.assertEqual((self.out / "mark").read_text(), "done\n")


if __name__ == "__main__":
    unittest.main()
