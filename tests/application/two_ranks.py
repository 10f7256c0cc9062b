#!/usr/bin/env python3
"""Two MPI ranks are refused with one clear line.

    two_ranks.py SPALL        77: no mpirun on this machine
"""
import os
import shutil
import subprocess
import sys


def main():
    mpirun = shutil.which("mpirun")
    if not mpirun:
        print("no mpirun on this machine: skipped")
        return 77
    # Root in a container, and fewer cores than ranks, are fine for this.
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1",
                   "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    ended = subprocess.run(
        [mpirun, "--oversubscribe", "-n", "2", sys.argv[1], "check", "x.prm"],
        env=environment, capture_output=True, text=True, check=False)
    lines = [line for line in ended.stderr.splitlines()
             if line.startswith("spall: ")]
    print(*lines, sep="\n")
    is_refused = (ended.returncode == 1 and len(lines) == 1 and
                  "2 MPI ranks" in lines[0] and "--threads" in lines[0])
    if not is_refused:
        print(f"status {ended.returncode}\n{ended.stderr}")
    return 0 if is_refused else 1


if __name__ == "__main__":
    sys.exit(main())
