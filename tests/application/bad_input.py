#!/usr/bin/env python3
"""Bad input: one clear line on stderr, exit status 1, nothing written.

    bad_input.py FORKED_PROGRAM [NAME ...]

Every case of bad_cases.py runs in a folder of its own with what it needs.
A case is the words after `spall` and the words that its message must have, in
which {case} stands for a sound case of spheres.
"""
import pathlib
import signal
import sys
import tempfile

from bad_cases import CASES, GRADATION, merged, prm
from bad_meshes import MESH_FILES
from bad_paths import PATHS
from bad_studies import STUDIES
from bad_subgrades import SUBGRADES
from forked import ForkedProgram


def listing(folder):
    return {str(path.relative_to(folder)): path.stat().st_size
            for path in folder.rglob("*")}


def faults_of(program, bad):
    """What is wrong with the answer to this input."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = {"g.csv": GRADATION, "case.prm": prm(merged(bad.case)),
                 **bad.files}
        for path, text in files.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_bytes(text if isinstance(text, bytes)
                                        else text.encode())
        before = listing(folder)
        words = [word.replace("{case}", "case.prm") for word in bad.words]
        ended = program.run(words, folder)
        if ended.returncode == -signal.SIGALRM:
            return ["does not end"]
        after = listing(folder)
    return answer_faults(bad, ended) + (
        [] if before == after else
        [f"written: {sorted(set(after.items()) ^ set(before.items()))}"])


def answer_faults(bad, ended):
    faults = []
    lines = ended.stderr.splitlines()
    if ended.returncode != 1:
        faults.append(f"status {ended.returncode}, expected 1")
    if bad.name == "no_command":
        return faults + ([] if lines and lines[0].startswith("usage: spall")
                         else ["no usage"])
    if len(lines) != 1:
        faults.append(f"{len(lines)} lines on stderr, expected 1")
    if not ended.stderr.startswith("spall: "):
        faults.append("does not start with spall:")
    missing = [part for part in bad.message if part not in ended.stderr]
    if missing:
        faults.append(f"does not say {missing}")
    if faults:
        faults.append(f"stderr was: {ended.stderr.strip()[:500]}")
    return faults


def main():
    names = sys.argv[2:]
    cases = [bad for bad in CASES + STUDIES + MESH_FILES + SUBGRADES + PATHS
             if not names or bad.name in names]
    with ForkedProgram(sys.argv[1]) as program:
        results = [faults_of(program, bad) for bad in cases]
    n_failed = 0
    for bad, faults in zip(cases, results):
        if faults:
            n_failed += 1
            print(f"{bad.name}: {'; '.join(faults)}")
    print(f"bad input: {len(cases) - n_failed} of {len(cases)} refused well")
    return 1 if n_failed or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
