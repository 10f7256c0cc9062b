#!/usr/bin/env python3
"""docs/parameters/ is what the program prints.

    parameters_page.py SPALL PAGE            compares
    parameters_page.py SPALL PAGE --write    makes the page anew
"""
import pathlib
import subprocess
import sys


def main():
    page = pathlib.Path(sys.argv[2])
    printed = subprocess.run([sys.argv[1], "template", "parameters"],
                             capture_output=True, text=True,
                             check=True).stdout
    if "--write" in sys.argv:
        page.write_text(printed)
    elif page.read_text() != printed:
        print(f"{page} is not up to date: run\n  spall template parameters "
              f"> {page}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
