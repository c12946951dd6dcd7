#!/usr/bin/env python3
"""Compares the speed of puck-bench-read with that of Python libraries that read the same recordings.

    python3 -m venv build/peers
    build/peers/bin/pip install aedat expelliarmus evlib faery h5py hdf5plugin
    tools/build.sh puck-convert puck-bench-read
    build/peers/bin/python tests/bench/read/peers.py RECORDING [--repetitions N] [--folder DIR]

RECORDING, of 20 million events or more, is first converted into every format. All readers then take turns, in
random order; the table has the median, in millions of events a second of CPU time, of each reader that gives
all events. expelliarmus reads a file whole or in chunks: the faster counts.
"""
import argparse
import os
import random
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# A library's threads would add to its CPU time.
os.environ["POLARS_MAX_THREADS"] = os.environ["RAYON_NUM_THREADS"] = "1"

BIN = Path(__file__).resolve().parents[3] / "build" / "release" / "bin"
FORMATS = {
    "evt2": "evt2.raw",
    "evt21": "evt21.raw",
    "evt3": "evt3.raw",
    "dat": "dat.dat",
    "es": "es.es",
    "text": "text.txt",
    "csv": "csv.csv",
    "aedat4": "aedat4.aedat4",
    "hdf5": "hdf5.hdf5",
    "hdf5-ecf": "ecf.hdf5",
}


def expelliarmus(path, encoding):
    from expelliarmus import Wizard

    return len(Wizard(encoding=encoding, fpath=path).read())


def expelliarmus_chunks(path, encoding):
    from expelliarmus import Wizard

    wizard = Wizard(encoding=encoding, fpath=path, chunk_size=65536, buff_size=65536)
    return sum(len(chunk) for chunk in wizard.read_chunk())


def without_lines(path, count):
    """A copy without its first lines, which the library cannot read; made once, before it is timed."""
    if count == 0:
        return path
    copy = Path(f"{path}.short{Path(path).suffix}")
    if not copy.exists():
        with open(path, "rb") as whole, open(copy, "wb") as rest:
            for _ in range(count):
                whole.readline()
            shutil.copyfileobj(whole, rest)
    return str(copy)


def faery(path, _):
    import faery as library

    return sum(len(chunk) for chunk in library.events_stream_from_file(path))


def evlib(path, _):
    import evlib as library

    return library.load_events(path, sort=False).collect().height


def aedat(path, _):
    import aedat as library

    return sum(len(packet["events"]) for packet in library.Decoder(path) if "events" in packet)


def h5py(path, _):
    import h5py as library
    import hdf5plugin  # noqa: F401

    with library.File(path) as file:
        return len(file["CD/events"][:])


READERS = {
    "expelliarmus": (expelliarmus, {"evt2", "evt3", "dat"}),
    "expelliarmus ": (expelliarmus_chunks, {"evt2", "evt3", "dat"}),
    "faery": (faery, {"evt2", "evt3", "dat", "es", "csv", "aedat4"}),
    "aedat": (aedat, {"aedat4"}),
    "evlib": (evlib, {"evt2", "evt21", "evt3", "text", "aedat4", "hdf5"}),
    "h5py": (h5py, {"hdf5"}),
}

# The sensor's size, and the names of the columns.
UNREAD_LINES = {("faery", "csv"): 1, ("evlib", "text"): 2}


def puck(path):
    events, seconds = subprocess.run(
        [BIN / "puck-bench-read", path], check=True, capture_output=True, text=True
    ).stdout.split()
    return int(events), float(seconds)


def timed(reader, path, encoding):
    begin = time.process_time()
    events = reader(path, encoding)
    return events, time.process_time() - begin


def measure(encoding, path, repetitions):
    """Of each reader, its median speed; those that are far slower are asked only once."""
    speeds = {name: [] for name, (_, formats) in READERS.items() if encoding in formats}
    speeds["PUCK"] = []
    left_out = set()
    wanted, _ = puck(path)
    for _ in range(repetitions):
        for name in random.sample(sorted(speeds), len(speeds)):
            if name in left_out:
                continue
            try:
                if name == "PUCK":
                    events, seconds = puck(path)
                else:
                    readable = without_lines(path, UNREAD_LINES.get((name, encoding), 0))
                    events, seconds = timed(READERS[name][0], readable, encoding)
            except Exception as error:  # Of any kind: it is another project's.
                print(f"{encoding}: {name}: {str(error)[:100]}", file=sys.stderr)
                left_out.add(name)
                continue
            if events != wanted:
                print(f"{encoding}: {name}: {events} events, expected {wanted}", file=sys.stderr)
                left_out.add(name)
                continue
            speeds[name].append(events / seconds * 1e-6)
            if seconds > 5:
                left_out.add(name)
    medians = {}
    for name, values in speeds.items():
        if values:
            medians[name.strip()] = max(medians.get(name.strip(), 0), statistics.median(values))
    return medians


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording")
    parser.add_argument("--repetitions", type=int, default=7)
    parser.add_argument("--folder", help="keeps the converted files there")
    parser.add_argument("--formats", nargs="*", default=list(FORMATS), choices=list(FORMATS))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(options.folder or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        print("| format | PUCK | others | PUCK, times the fastest |\n|---|---:|---|---:|")
        for encoding in options.formats:
            path = str(folder / FORMATS[encoding])
            if not Path(path).exists():
                command = [BIN / "puck-convert", options.recording, path, "--to", encoding]
                subprocess.run(command, check=True, capture_output=True)
            medians = measure(encoding, path, options.repetitions)
            own = medians.pop("PUCK")
            others = sorted(medians.items(), key=lambda item: -item[1])
            ratio = f"{own / others[0][1]:.2f}" if others else ""
            listed = ", ".join(f"{name} {speed:.0f}" for name, speed in others)
            print(f"| {encoding} | {own:.0f} | {listed} | {ratio} |", flush=True)


if __name__ == "__main__":
    main()
