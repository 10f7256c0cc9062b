"""Calls of `spall bench`, and tables of what they measure."""
import csv
import json
import os
import pathlib
import statistics
import subprocess
import tempfile


def bench(spall, packing, *words, threads=1, ranks=1):
    """What `spall bench --json` says, as a dictionary."""
    several = ["mpirun", "--allow-run-as-root", "--bind-to", "none", "-np",
               str(ranks)] if ranks > 1 else []
    with tempfile.TemporaryDirectory() as folder:
        result = pathlib.Path(folder) / "bench.json"
        subprocess.run(
            [*several, str(spall), "bench", "--packing", str(packing),
             "--threads", str(threads), "--json", str(result),
             *map(str, words)],
            check=True, stdout=subprocess.DEVNULL,
            env={**os.environ, "OMP_NUM_THREADS": str(threads)})
        return json.loads(result.read_text())


def spread(values):
    """Half the range over the median [-]."""
    return 0.5 * (max(values) - min(values)) / statistics.median(values)


def table(header, rows):
    """A Markdown table."""
    lines = ["| " + " | ".join(header) + " |",
             "|" + "---|" * len(header)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |"
              for row in rows]
    return "\n".join(lines)


def write_csv(path, header, rows):
    """The same table as a file: numbers without unit or typographic signs."""
    plain = str.maketrans({"−": "-", "±": None, "%": None})
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([str(cell).translate(plain).strip() for cell in row]
                         for row in rows)


def csv_option(words):
    """Takes `--csv FILE` off the end of the words; the file, or nothing."""
    if len(words) > 2 and words[-2] == "--csv":
        path = words[-1]
        del words[-2:]
        return path
    return None


def group(rows, *keys):
    """Rows by the values of these keys, in order of first appearance."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups
