#!/usr/bin/env python3
"""Speed of one and of several threads, on the machine as it is and beside a
competing load.

    tests/benchmark/busy_machine.py build/apps/spall [--load 2] [--seconds 8]
        [--rounds 3] [--threads 2] [--case FILE] [--spin COUNT ...]

Runs the preparation of a case for some seconds on one thread and on --threads
threads in turn, without a load and beside --load busy loops, and prints the
steps per second. The exit status is 1 if several threads beside the load reach
less than 0.7 of one thread. --spin adds rows with other values of
GOMP_SPINCOUNT. Other programs on the machine count as load too: the table
gives the load average.
"""
import argparse
import os
import pathlib
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
LEAST = 0.7  # of one thread


def steps_per_second(spall, case, threads, seconds, spin):
    """Of a run that is stopped after some seconds."""
    environment = dict(os.environ)
    if spin is not None:
        environment["GOMP_SPINCOUNT"] = str(spin)
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.Popen(
            [spall, "run", case, "--out", folder + "/run", "--threads",
             str(threads)], env=environment, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        for line in run.stdout:
            if "time step" in line:
                break
        started = time.monotonic()
        time.sleep(seconds)
        spent = time.monotonic() - started
        run.send_signal(signal.SIGTERM)
        text = run.communicate()[0]
    stopped = re.search(r"stopped at step (\d+)", text)
    if not stopped:
        sys.exit(f"{case}: did not run for {seconds} s:\n{text}")
    return int(stopped.group(1)) / spent


def busy_loops(number):
    return [subprocess.Popen([sys.executable, "-c", "while True: pass"])
            for _ in range(number)]


def measure(options, load, spin):
    """Medians of the speeds on one and on several threads, run in turn."""
    speeds = {1: [], options.threads: []}
    loops = busy_loops(load)
    try:
        for _ in range(options.rounds):
            for threads, found in speeds.items():
                found.append(steps_per_second(options.spall, options.case,
                                              threads, options.seconds, spin))
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()
    return [statistics.median(found) for found in speeds.values()]


def read_options():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("spall")
    parser.add_argument("--load", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=8.)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--case", default=str(
        ROOT / "data/cases/dynamic_triaxial_quick.prm"))
    parser.add_argument("--spin", type=int, nargs="*", default=[])
    return parser.parse_args()


def main():
    options = read_options()
    print("| busy loops | GOMP_SPINCOUNT | load average | 1 thread, steps/s "
          f"| {options.threads} threads, steps/s | ratio |")
    print("|---|---|---|---|---|---|")
    worst = float("inf")
    for spin in [None, *options.spin]:
        for load in (0, options.load):
            one, several = measure(options, load, spin)
            print(f"| {load} | {'of the program' if spin is None else spin} "
                  f"| {os.getloadavg()[0]:.1f} | {one:.0f} | {several:.0f} "
                  f"| {several / one:.2f} |", flush=True)
            if load > 0 and spin is None:
                worst = several / one
    if worst < LEAST:
        sys.exit(f"several threads beside the load reach {worst:.2f} of one, "
                 f"asked are {LEAST}")


if __name__ == "__main__":
    main()
