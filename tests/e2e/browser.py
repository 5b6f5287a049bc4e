"""Chromium without a window, told what to do by its DevTools protocol over a pipe (--remote-debugging-pipe)."""
import base64
import fcntl
import json
import os
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

CHROMIUM = shutil.which("chromium")
FLAGS = ["--headless", "--no-sandbox", "--no-first-run", "--hide-scrollbars", "--use-gl=angle", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--remote-debugging-pipe"]


class Browser:
    """One tab.

        browser = Browser(1280, 720); browser.open(address); browser.run("document.title")
    """

    def __init__(self, width, height):
        # Its processes write for a moment after the first of them has ended.
        self.profile = tempfile.TemporaryDirectory(prefix="baraka-chromium-", ignore_cleanup_errors=True)
        to_child, from_us = self._pipe()
        from_child, to_us = self._pipe()
        # The protocol wants descriptors 3 and 4.
        command = ["bash", "-c", f'exec "$@" 3<&{to_child} 4>&{to_us}', "bash", CHROMIUM, *FLAGS, f"--window-size={width},{height}",
                   f"--user-data-dir={self.profile.name}", "about:blank"]
        self.process = subprocess.Popen(command, pass_fds=(to_child, to_us), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_child)
        os.close(to_us)
        self.write = os.fdopen(from_us, "wb", 0)
        self.read = os.fdopen(from_child, "rb", 0)
        self.buffer, self.number, self.session, self.said = b"", 0, None, []
        [page] = [one for one in self.call("Target.getTargets")["targetInfos"] if one["type"] == "page"]
        self.session = self.call("Target.attachToTarget", targetId=page["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "HeapProfiler"):
            self.call(f"{domain}.enable")
        self.resize(width, height)

    @staticmethod
    def _pipe():
        """Descriptors that cannot be 3 or 4."""
        ends = os.pipe()
        moved = [fcntl.fcntl(end, fcntl.F_DUPFD, 20) for end in ends]
        for end in ends:
            os.close(end)
        return moved

    def _message(self):
        while b"\0" not in self.buffer:
            more = os.read(self.read.fileno(), 1 << 20)
            if not more:
                raise AssertionError("chromium has ended")
            self.buffer += more
        text, _, self.buffer = self.buffer.partition(b"\0")
        return json.loads(text)

    def call(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        text = json.dumps(message).encode() + b"\0"
        while text:
            text = text[os.write(self.write.fileno(), text):]
        while True:
            answer = self._message()
            if answer.get("method") == "Runtime.exceptionThrown":
                self.said.append(answer["params"]["exceptionDetails"].get("exception", {}).get("description", "?"))
            if answer.get("id") != self.number:
                continue
            if "error" in answer:
                raise AssertionError(f"{method}: {answer['error']}")
            return answer["result"]

    def run(self, script):
        """Value of an expression in the page; a promise is waited for."""
        result = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise AssertionError(result["exceptionDetails"].get("exception", {}).get("description", str(result)))
        return result["result"].get("value")

    def open(self, address):
        """Until the view has drawn for the first time."""
        self.call("Page.navigate", url="about:blank")
        self.call("Page.navigate", url=address)
        self.run("""new Promise((resolve, reject) => {
            const end = Date.now() + 30000;
            const look = () => (document.documentElement?.dataset.drawn && globalThis.baraka ? resolve()
              : Date.now() > end ? reject(new Error("nothing was drawn: " + document.body?.innerText)) : setTimeout(look, 20));
            look();
          })""")

    def resize(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def forget(self):
        """What it has stored and said, and the page: for another test. To start a browser for each takes twice as long."""
        self.run("try { localStorage.clear(); sessionStorage.clear(); } catch { /* of a page that may store nothing */ }")
        self.call("Page.navigate", url="about:blank")
        self.said.clear()

    def visit(self, address):
        """Any page, until it is loaded."""
        self.call("Page.navigate", url=address)
        self.wait(f"location.href === {json.dumps(address)} && document.readyState === 'complete'")

    def wait(self, script, seconds=30):
        """Until an expression in the page is true; also while the page is replaced by another."""
        end, said = time.monotonic() + seconds, ""
        while time.monotonic() < end:
            try:
                if self.run(f"!!({script})"):
                    return
            except AssertionError as error:  # what it names is not there yet, or the page was left meanwhile
                said = f"; {error}"
            time.sleep(0.02)
        raise AssertionError(f"not true within {seconds} s: {script}{said}")

    def type(self, text):
        """Keys pressed in the element that has the focus."""
        for character in text:
            self.call("Input.dispatchKeyEvent", type="keyDown", key=character, text=character)
            self.call("Input.dispatchKeyEvent", type="keyUp", key=character)

    def go(self, **state):
        """Sets the state of the view and waits until all of it is drawn."""
        self.run(f"baraka.store.set({json.dumps(state)})")
        for _ in range(20):
            if self.run("baraka.idle().then(() => baraka.source.asking)") == 0:
                return
        raise AssertionError("it is still asking")

    def heap(self):
        """Bytes of the page's objects after a collection."""
        self.call("HeapProfiler.collectGarbage")
        self.call("HeapProfiler.collectGarbage")
        return self.call("Runtime.getHeapUsage")["usedSize"]

    def screenshot(self, file=None):
        png = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if file:
            file.write_bytes(png)
        return Picture(png)

    def close(self):
        self.process.terminate()
        self.process.wait(10)
        self.read.close()
        self.write.close()
        self.profile.cleanup()


class Picture:
    """A PNG of 8 bits per channel (ISO/IEC 15948:2004, clauses 9 and 11.2)."""

    def __init__(self, png):
        assert png.startswith(b"\x89PNG\r\n\x1a\n")
        at, packed = 8, b""
        while at < len(png):
            length, kind = struct.unpack_from(">I4s", png, at)
            body = png[at + 8:at + 8 + length]
            at += 12 + length
            if kind == b"IHDR":
                self.width, self.height, depth, colours = struct.unpack_from(">IIBB", body)
                assert depth == 8 and colours in (2, 6), (depth, colours)
                self.channels = 3 if colours == 2 else 4
            elif kind == b"IDAT":
                packed += body
        self.rows = self._filtered(zlib.decompress(packed))

    def _filtered(self, data):
        stride, step = self.width * self.channels, self.channels
        rows, before = [], bytearray(stride)
        for y in range(self.height):
            start = y * (stride + 1)
            kind, line = data[start], bytearray(data[start + 1:start + 1 + stride])
            if kind == 1:
                for i in range(step, stride):
                    line[i] = (line[i] + line[i - step]) & 255
            elif kind == 2:
                line = bytearray((a + b) & 255 for a, b in zip(line, before))
            elif kind == 3:
                for i in range(stride):
                    line[i] = (line[i] + ((line[i - step] if i >= step else 0) + before[i]) // 2) & 255
            elif kind == 4:
                for i in range(stride):
                    a, b, c = (line[i - step] if i >= step else 0), before[i], (before[i - step] if i >= step else 0)
                    p, q, r = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                    line[i] = (line[i] + (a if p <= q and p <= r else b if q <= r else c)) & 255
            rows.append(line)
            before = line
        return rows

    def places(self, colour, box):
        """Pixels of exactly that colour, (r, g, b), within (x0, y0, x1, y1)."""
        wanted, step = bytes(colour), self.channels
        x0, y0, x1, y1 = box
        return [(x, y) for y in range(y0, y1) for x in range(x0, x1)
                if self.rows[y][x * step:x * step + 3] == wanted]
