#!/usr/bin/env python3
"""The IDL files with messages of ROS 2, those of this project and that of the tests' peer, against the .msg files of Humble in
the npm package @foxglove/rosmsg-msgs-common (target mcap_reader). Its rmw_dds_common is missing: that is written out here."""
import re
import unittest

from baraka import BIN, ROOT

HUMBLE = BIN.parent / "mcap_reader/node_modules/@foxglove/rosmsg-msgs-common/msgdefs/ros2humble"
FILES = ["idl/inspect.idl", "idl/ros_nodes.idl", "tests/e2e/ros_peer/ros_messages.idl"]
BASIC = {"boolean": "bool", "octet": "uint8", "byte": "uint8", "char": "uint8", "short": "int16", "unsigned short": "uint16",
         "long": "int32", "unsigned long": "uint32", "unsigned long long": "uint64", "float": "float32", "double": "float64"}
RMW = {"rmw_dds_common/Gid": [("data", "uint8", "24")],  # rmw_dds_common/msg/*.msg, branch humble
       "rmw_dds_common/NodeEntitiesInfo": [("node_namespace", "string", None), ("node_name", "string", None),
                                           ("reader_gid_seq", "rmw_dds_common/Gid", ""),
                                           ("writer_gid_seq", "rmw_dds_common/Gid", "")],
       "rmw_dds_common/ParticipantEntitiesInfo": [("gid", "rmw_dds_common/Gid", None),
                                                  ("node_entities_info_seq", "rmw_dds_common/NodeEntitiesInfo", "")]}


def of_msg(package, text):
    """[(name, type, None: one; "": a sequence; "9": so many)] of a .msg file."""
    members = []
    for line in text.split("\n====")[0].splitlines():  # what it uses comes after such a line
        words = line.split("#")[0].split()
        if len(words) < 2 or "=" in line.split("#")[0].replace("<=", ""):
            continue  # empty, or a constant
        kind, _, count = words[0].partition("[")
        kind = re.sub(r"<=\d+$", "", kind)
        kind = BASIC.get(kind, kind)
        if kind[0].isupper():
            kind = f"{package}/{kind}"
        count = re.sub(r"<=\d+", "", count.rstrip("]")) if "[" in words[0] else None
        members.append((words[1], kind, count))
    return members


def of_idl(text):
    """Package/Name -> members as of of_msg()."""
    found = {}
    text = re.sub(r"//[^\n]*", "", text)
    for package, inside in re.findall(r"module (\w+) \{ module msg \{ module dds_ \{(.*?)\}; \}; \};", text, re.S):
        for name, body in re.findall(r"struct (\w+)_ \{(.*?)\};", inside, re.S):
            found[f"{package}/{name}"] = [member_of(package, one.strip()) for one in body.split(";") if one.strip()]
    return found


def member_of(package, text):
    kind, name, count = re.fullmatch(r"(.+?)\s+(\w+)(?:\[(\d+)\])?", text).groups()
    if sequence := re.fullmatch(r"sequence<(.+)>", kind):
        kind, count = sequence.group(1), ""
    kind = re.sub(r"<\d+>$", "", kind)
    if kind.endswith("_"):
        words = kind[:-1].split("::")
        kind = f"{words[0] if len(words) > 1 else package}/{words[-1]}"
    return name, BASIC.get(kind, kind), count


@unittest.skipUnless(HUMBLE.exists(), "the package was not fetched: ninja mcap_reader")
class Definitions(unittest.TestCase):
    def test_every_message_has_the_members_of_humble_in_their_order(self):
        checked = 0
        for file in FILES:
            for name, members in of_idl((ROOT / file).read_text(encoding="utf-8")).items():
                package, message = name.split("/")
                if package == "baraka_msgs":
                    continue
                with self.subTest(file=file, message=name):
                    path = HUMBLE / package / "msg" / f"{message}.msg"
                    expected = RMW.get(name) or of_msg(package, path.read_text(encoding="utf-8"))
                    self.assertEqual(members, expected)
                    checked += 1
        self.assertGreater(checked, 50)


if __name__ == "__main__":
    unittest.main()
