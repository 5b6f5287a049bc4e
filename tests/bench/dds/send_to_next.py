"""Sends datagrams to one other station at a rate, and receives what comes: ADDRESS SIZE RATE."""
import selectors
import socket
import sys
import time

PORT = 7000


def main():
    address, size, rate = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
    own = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    own.bind(("", PORT))
    ready = selectors.DefaultSelector()
    ready.register(own, selectors.EVENT_READ)
    message, due = bytes(size), time.monotonic()
    while True:
        own.sendto(message, (address, PORT))
        due += 1 / rate
        while (left := due - time.monotonic()) > 0:
            for _ in ready.select(left):
                own.recv(65536)


main()
