#!/usr/bin/env python3
"""What one interface sends and gets, as RTPS: `rtps_capture.py INTERFACE FILE` writes raw frames until it is killed;
datagrams(FILE) reads them. As much of the OMG's DDSI-RTPS 2.5 as tests ask for, apart from hal/rtps, which they may
contradict."""
import dataclasses
import socket
import struct
import sys
import time

KINDS = {0x06: "ACKNACK", 0x07: "HEARTBEAT", 0x08: "GAP", 0x09: "INFO_TS", 0x0c: "INFO_SRC", 0x0e: "INFO_DST",
         0x12: "NACK_FRAG", 0x13: "HEARTBEAT_FRAG", 0x15: "DATA", 0x16: "DATA_FRAG"}
WRITER_AT = {"ACKNACK": 4, "HEARTBEAT": 4, "GAP": 4, "NACK_FRAG": 4, "HEARTBEAT_FRAG": 4, "DATA": 8, "DATA_FRAG": 8}
SPDP_WRITER = 0x000100c2


@dataclasses.dataclass
class Submessage:
    kind: str
    writer: int  # entity id, 0 where there is none

    @property
    def is_of_user(self):
        """Of an endpoint of the program, not of discovery (9.3.1.2)."""
        return self.writer != 0 and self.writer >> 6 & 3 == 0


@dataclasses.dataclass
class Datagram:
    """Of UDP, or a later fragment of one (port 0, no submessages)."""
    at: float  # s, CLOCK_REALTIME
    source: str
    destination: str
    port: int
    length: int  # of the IP packet
    is_fragment: bool
    submessages: list

    @property
    def is_multicast(self):
        return 224 <= int(self.destination.split(".")[0]) < 240


def capture(interface, file):
    with socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(0x0003)) as ear, open(file, "wb") as out:
        ear.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 26)
        ear.bind((interface, 0))
        print("ready", flush=True)
        while True:
            frame = ear.recv(1 << 17)
            out.write(struct.pack("<dI", time.time(), len(frame)) + frame)
            out.flush()


def submessages(payload):
    if payload[:4] != b"RTPS":
        return []
    found, at = [], 20
    while at + 4 <= len(payload):
        kind, flags = KINDS.get(payload[at], f"0x{payload[at]:02x}"), payload[at + 1]
        length, = struct.unpack_from("<H" if flags & 1 else ">H", payload, at + 2)
        body = payload[at + 4:at + 4 + length] if length or kind == "INFO_TS" else payload[at + 4:]
        offset = WRITER_AT.get(kind)
        has_writer = offset is not None and len(body) >= offset + 4
        found.append(Submessage(kind, struct.unpack_from(">I", body, offset)[0] if has_writer else 0))
        if length == 0 and kind != "INFO_TS":
            break
        at += 4 + length
    return found


def datagram(at, frame):
    """None unless it is IPv4's UDP."""
    if frame[12:14] != b"\x08\x00" or frame[23] != 17:
        return None
    length, _, fragment = struct.unpack_from(">HHH", frame, 16)
    start = 14 + 4 * (frame[14] & 15)
    first = fragment & 0x1fff == 0
    port = struct.unpack_from(">H", frame, start + 2)[0] if first else 0
    source, destination = (".".join(map(str, frame[i:i + 4])) for i in (26, 30))
    return Datagram(at, source, destination, port, length, fragment & 0x3fff != 0,
                    submessages(frame[start + 8:14 + length]) if first else [])


def datagrams(file):
    with open(file, "rb") as frames:
        content = frames.read()
    found, at = [], 0
    while at + 12 <= len(content):
        when, length = struct.unpack_from("<dI", content, at)
        one = datagram(when, content[at + 12:at + 12 + length])
        at += 12 + length
        if one is not None:
            found.append(one)
    return found


if __name__ == "__main__":
    capture(*sys.argv[1:])
