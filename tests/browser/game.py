"""The project's programs as child processes: a simulated game, and puck-view."""

import os
import random
import re
import signal
import subprocess
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
PROGRAMS = Path(os.environ.get("PUCK_BIN_DIR", SOURCE / "build/release/bin"))


class Child:
    """A program that is ended with the test."""

    def __init__(self, name, *options, log):
        self.log = log
        with open(log, "wb") as file:
            self.process = subprocess.Popen([PROGRAMS / name, *map(str, options)], cwd=SOURCE,
                                            stdout=file, stderr=subprocess.STDOUT)

    def text(self):
        return Path(self.log).read_text(errors="replace")

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        try:
            return self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise

    def resident_mb(self):
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"VmRSS:\s+(\d+) kB", status)[1]) / 1024


class View(Child):
    """puck-view on a free port; `url` is what it prints."""

    def __init__(self, *options, log):
        super().__init__("puck-view", *options, "--listen", "127.0.0.1:0", log=log)
        end = time.monotonic() + 20
        while not (found := re.search(r"open (http://\S+)", self.text())):
            if self.process.poll() is not None or time.monotonic() > end:
                raise AssertionError("puck-view does not serve: " + self.text())
            time.sleep(0.02)
        self.url = found[1]
        self.port = int(re.search(r":(\d+)/", self.url)[1])


def free_bus():
    """The URL of a bus on this machine that nobody else is on, most likely."""
    port = random.randrange(20000, 32000)
    return f"udpm://239.255.76.67:{port}?ttl=0&recv_buf_size=4194304"


class Game:
    """A game through all services on a bus of its own, recorded. Use it in a `with` statement."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.bus = free_bus()
        self.log = self.folder / "game.lcm"

    def __enter__(self):
        self.services = []
        self._start("logger", "--set", f"logger.path={self.log}")
        for name in ("tracker", "bridge", "arm"):
            self._start(name)
        self._start("camera", "--set", "simulation.world.seed=7")
        time.sleep(1)
        for service in self.services:
            if service.process.poll() is not None:
                raise AssertionError(service.text())
        return self

    def _start(self, name, *options):
        self.services.append(Child(f"puck-{name}", "--lcm-url", self.bus, "--config",
                                   f"config/{name}.toml", *options, log=self.folder / f"{name}.log"))

    def __exit__(self, *_):
        for service in reversed(self.services):
            service.stop()
