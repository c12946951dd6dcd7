#!/usr/bin/env python3
"""What puck-view costs and delivers at 1 and 10 Mev/s, and what it costs the tracker.

  tests/bench/view/measure.py RECORDING [--seconds S] [--rates 1,10] [--backdrop events] [--json FILE]

Replays a recording at a steady rate through puck-camera and puck-tracker on this machine, and looks at it
with puck-view as a browser of 1280x720 does: the camera's picture, the table and ten states a second. The
latencies of the tracker, with puck-view and without, are of alternating runs, as the machine's other work
changes. Build the target puck_programs before.
"""

import argparse
import http.client
import json
import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "browser"))
from game import PROGRAMS, Child, View, free_bus  # noqa: E402

PICTURES = {"camera": "view=camera&width=880&height=620", "table": "view=table&width=400&height=230"}


class Viewer:
    """Asks for pictures as the page does: the next one after each reply."""

    def __init__(self, port, backdrop):
        self.port = port
        self.pictures = {name: 0 for name in PICTURES}
        self.bytes = 0
        self.ends = False
        self.threads = [threading.Thread(target=self._look, args=(name, f"{query}&backdrop={backdrop}"))
                        for name, query in PICTURES.items()]
        self.threads.append(threading.Thread(target=self._ask_state))
        for thread in self.threads:
            thread.start()

    @staticmethod
    def _yield():
        """A viewer is on another machine, or has its own core: here it must not disturb the tracker."""
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), 15)

    def _get(self, line, path):
        line.request("GET", path)
        reply = line.getresponse()
        body = reply.read()
        self.bytes += len(body)
        return reply

    def _look(self, name, query):
        self._yield()
        line = http.client.HTTPConnection("127.0.0.1", self.port)
        seen = "0"
        while not self.ends:
            reply = self._get(line, f"/picture?{query}&seen={seen}")
            if reply.status == 200:
                seen = reply.headers["Puck-Version"]
                self.pictures[name] += 1

    def _ask_state(self):
        self._yield()
        line = http.client.HTTPConnection("127.0.0.1", self.port)
        since, run = 0, -1
        while not self.ends:
            line.request("GET", f"/state?since_us={since}&run={run}")
            body = line.getresponse().read()
            self.bytes += len(body)
            state = json.loads(body)
            since, run = state["time_us"], state["run"]
            time.sleep(0.1)

    def end(self):
        self.ends = True
        for thread in self.threads:
            thread.join()


def cpu_s(child):
    fields = Path(f"/proc/{child.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def latency(bus):
    report = json.loads(subprocess.run(
        [PROGRAMS / "puck-spy", "--lcm-url", bus, "--once", "--json", "--seconds", "0.3"],
        capture_output=True, check=True).stdout)
    tracker = next(one for one in report["services"] if one["service"] == "puck-tracker")
    return [tracker[f"latency_packet_to_estimate_{p}_us"] for p in ("p50", "p99")]


def run_once(recording, rate, seconds, looks, backdrop):
    """One run of all services; `looks`: None without puck-view, else whether somebody looks."""
    with tempfile.TemporaryDirectory() as folder:
        bus = free_bus()
        log = lambda name: f"{folder}/{name}.log"  # noqa: E731
        start = lambda name, *options: Child(  # noqa: E731
            f"puck-{name}", "--lcm-url", bus, "--config", f"config/{name}.toml", *options, log=log(name))
        children = {"tracker": start("tracker")}
        if looks is not None:
            children["view"] = View("--lcm-url", bus, log=log("view"))
        children["camera"] = start(
            "camera", "--set", "camera.source=file", "--set", f"camera.file={recording}",
            "--set", "camera.loop=true", "--set", f"camera.rate_mev_s={float(rate)}")
        time.sleep(2)
        viewer = Viewer(children["view"].port, backdrop) if looks else None
        time.sleep(2)
        before = {name: cpu_s(child) for name, child in children.items()}
        pictures = dict(viewer.pictures) if viewer else {}
        received = viewer.bytes if viewer else 0
        begin = time.monotonic()
        time.sleep(seconds)
        elapsed = time.monotonic() - begin
        figures = {f"cpu_{name}_percent": 100 * (cpu_s(child) - before[name]) / elapsed
                   for name, child in children.items()}
        if viewer:
            for name, count in viewer.pictures.items():
                figures[f"{name}_pictures_per_s"] = (count - pictures[name]) / elapsed
            figures["bytes_per_s"] = (viewer.bytes - received) / elapsed
        figures["p50_us"], figures["p99_us"] = latency(bus)
        if viewer:
            viewer.end()
        for child in reversed(children.values()):
            child.stop()
        return figures


def measure(recording, rate, seconds, rounds, backdrop):
    alone, watched = [], []
    for _ in range(rounds):
        alone.append(run_once(recording, rate, seconds, None, backdrop))
        watched.append(run_once(recording, rate, seconds, True, backdrop))
    unwatched = run_once(recording, rate, seconds, False, backdrop)
    median = lambda runs, key: statistics.median(run[key] for run in runs)  # noqa: E731
    figures = {key: round(median(watched, key), 1) for key in watched[0] if not key.endswith("_us")}
    figures["cpu_view_unwatched_percent"] = round(unwatched["cpu_view_percent"], 2)
    for key in ("p50_us", "p99_us"):
        figures[f"packet_to_estimate_{key}_alone"] = median(alone, key)
        figures[f"packet_to_estimate_{key}_watched"] = median(watched, key)
    return {"rate_mev_s": rate, **figures}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", type=Path)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--rates", default="1,10")
    parser.add_argument("--backdrop", default="events", choices=["events", "surface", "heat"])
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    recording = options.recording.resolve()
    if not recording.exists():
        sys.exit(f"measure.py: {recording} does not exist; puck-simulate --output game makes game.raw")
    results = []
    for rate in options.rates.split(","):
        figures = measure(recording, float(rate), options.seconds, options.rounds, options.backdrop)
        results.append(figures)
        print(f"at {rate} Mev/s, {options.backdrop}")
        for key, value in figures.items():
            print(f"  {key:38} {value:12}")
    if options.json:
        options.json.write_text(json.dumps(results, indent=2) + "\n")


if __name__ == "__main__":
    main()
