#!/usr/bin/env python3
"""The packages of cpack -G DEB install and work on a fresh Debian 12.

    debian_packages.py BUILD_FOLDER

Root, mmdebstrap and a mirror of Debian are needed; without them the test is
skipped. A minimal system is unpacked into a folder, and apt installs the
packages there, one after the other, with what they depend on. What runs then
runs as a user in the folder of this user. The minimal system and the packages
of Debian are kept in SPALL_DEBIAN_CACHE (by default ~/.cache/spall/debian),
some 3 GB; DEBIAN_MIRROR names another mirror than deb.debian.org.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

MIRROR = os.environ.get("DEBIAN_MIRROR", "http://deb.debian.org/debian")
SUITE = "bookworm"
CACHE = pathlib.Path(os.environ.get(
    "SPALL_DEBIAN_CACHE", pathlib.Path.home() / ".cache/spall/debian"))
SKIPPED = 77
DATA = "/usr/share/spall/data"
# Where files of each package may be, besides /usr/share/doc/PACKAGE.
ALLOWED = {
    "spall": ("/usr/bin/spall", DATA, "/usr/share/man/man1/spall.1.gz",
              "/usr/share/bash-completion/completions/spall",
              "/usr/share/zsh/vendor-completions/_spall"),
    "libspall-dev": ("/usr/include/spall", "/usr/lib/cmake/Spall",
                     "/usr/lib/libspall_"),
    "python3-spall": ("/usr/lib/python3/dist-packages/spall",),
}
REQUIRED = {
    "spall": ("/usr/share/man/man1/spall.1.gz", f"{DATA}/shapes/LICENSE-nist",
              "/usr/share/doc/spall/README.md"),
    "libspall-dev": ("/usr/include/spall/dem/engine.h",
                     "/usr/lib/cmake/Spall/SpallConfig.cmake"),
    "python3-spall": ("/usr/lib/python3/dist-packages/spall/py.typed",),
}
IN_PYTHON = """
import numpy, spall, spall.engine
assert str(spall.find_program()) == "/usr/bin/spall", spall.find_program()
case = spall.Case.from_template("single_particle")
scene = spall.engine.Engine(spall.engine.Parameters())
scene.add_sphere(0.01, [0., 0., 0.05])
scene.advance(1e-5, 10)
assert scene.position.shape == (1, 3), scene.position
print("python3-spall", spall.version(), case.kind, numpy.__version__)
"""


def why_skipped():
    """The first thing that is missing here, or None."""
    if os.geteuid() != 0:
        return "it needs root (chroot, mount)"
    for program, package in (("mmdebstrap", "mmdebstrap"), ("cpack", "cmake"),
                             ("dpkg-deb", "dpkg"), ("unshare", "util-linux")):
        if not shutil.which(program):
            return f"there is no {program} (apt install {package})"
    if subprocess.run(["unshare", "--mount", "true"], check=False,
                      capture_output=True).returncode != 0:
        return "mounts are not allowed here"
    try:
        with urllib.request.urlopen(f"{MIRROR}/dists/{SUITE}/Release",
                                    timeout=30) as page:
            page.read(1)
    except (urllib.error.URLError, OSError) as error:
        return f"{MIRROR} is not reached: {error}"
    return None


def go(*words, **keys):
    """Output of a command that must not fail."""
    ended = subprocess.run([str(word) for word in words], check=False,
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                           text=True, **keys)
    if ended.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, words))}: status "
                         f"{ended.returncode}\n{ended.stdout[-6000:]}")
    return ended.stdout


class System:
    """A fresh Debian in a folder; its mounts end with this process."""

    def __init__(self, folder):
        self.root = folder / "root"
        self.root.mkdir()
        base = CACHE / f"{SUITE}.tar"
        archives = CACHE / "archives"
        (archives / "partial").mkdir(parents=True, exist_ok=True)
        if not base.exists():
            go("mmdebstrap", "--variant=minbase", SUITE, folder / base.name,
               MIRROR)
            shutil.move(folder / base.name, base)
        go("tar", "-C", self.root, "-xf", base)
        go("mount", "-t", "proc", "proc", self.root / "proc")
        go("mount", "--bind", archives, self.root / "var/cache/apt/archives")
        (self.root / "usr/sbin/policy-rc.d").write_text("#!/bin/sh\nexit 101\n")
        (self.root / "usr/sbin/policy-rc.d").chmod(0o755)
        shutil.copy("/etc/resolv.conf", self.root / "etc/resolv.conf")
        self.as_root("useradd", "--create-home", "--uid", "1000", "user")
        self.apt("update")

    def as_root(self, *words):
        return go("chroot", self.root, "env", "-i", "LC_ALL=C.UTF-8",
                  "HOME=/root", "DEBIAN_FRONTEND=noninteractive",
                  "PATH=/usr/sbin:/usr/bin:/sbin:/bin", *words)

    def as_user(self, *words):
        """In the home folder of a user."""
        return go("chroot", "--userspec=1000:1000", self.root, "env", "-i",
                  "--chdir=/home/user", "HOME=/home/user", "LC_ALL=C.UTF-8",
                  "OMP_WAIT_POLICY=passive", "PATH=/usr/bin:/bin", *words)

    def apt(self, *words):
        return self.as_root("apt-get", "-y", "-q",
                            "-o", "APT::Keep-Downloaded-Packages=true",
                            "-o", "Acquire::Retries=3", *words)

    def install(self, *packages):
        begin, before = time.time(), self.size()
        self.apt("install", *packages)
        names = " ".join(pathlib.Path(one).name for one in packages)
        print(f"{names}: installed in {time.time() - begin:.0f} s, with what "
              f"they need {(self.size() - before) / 1e6:.0f} MB", flush=True)

    def size(self):
        """Of what is installed [byte]."""
        listed = self.as_root("dpkg-query", "-W", "-f=${Installed-Size}\n")
        return 1024 * sum(map(int, listed.split()))

    def home(self, path):
        return self.root / "home/user" / path


def make_packages(build, folder):
    """Name of a package to its file, as apt in the system sees it."""
    go("cpack", "-G", "DEB", "--config", build / "CPackConfig.cmake", "-B",
       folder)
    packages = {}
    for file in sorted(folder.glob("*.deb")):
        name = go("dpkg-deb", "-f", file, "Package").strip()
        packages[name] = file
        size = int(go("dpkg-deb", "-f", file, "Installed-Size"))
        print(f"{file.name}: {file.stat().st_size / 1e6:.2f} MB, installed "
              f"{size / 1e3:.1f} MB", flush=True)
    return packages


def check_files(system, name):
    """Files of an installed package are where they belong."""
    listed = system.as_root("dpkg", "-L", name).splitlines()
    files = [path for path in listed
             if (system.root / path.lstrip("/")).is_file()]
    places = (*ALLOWED[name], f"/usr/share/doc/{name}/",
              f"/usr/share/lintian/overrides/{name}")
    stray = [path for path in files if not path.startswith(places)
             or "__pycache__" in path or path.endswith((".pyc", ".in"))]
    if stray:
        raise SystemExit(f"{name}: stray files {stray[:10]}")
    wanted = (*REQUIRED[name], *(f"/usr/share/doc/{name}/{file}" for file in (
        "copyright", "changelog.gz", "changelog.Debian.gz")))
    missing = [path for path in wanted if path not in files]
    if missing:
        raise SystemExit(f"{name}: no {missing}")


def check_program(system):
    """Version, a template, a short run and its report."""
    print(system.as_user("spall", "--version").splitlines()[0], flush=True)
    case = system.as_user("spall", "template", "dynamic_triaxial")
    if "subsection Loading" not in case:
        raise SystemExit(f"spall template printed {case[:200]}")
    system.as_user("spall", "run", f"{DATA}/cases/dynamic_triaxial_quick.prm",
                   "--set", "Loading/cycles=1", "--out", "run")
    summary = json.loads(system.home("run/summary.json").read_text())
    if not summary["is_complete"] or summary["n_particles"] < 100:
        raise SystemExit(f"spall run: {summary}")
    system.as_user("spall", "report", "run")
    page = system.home("run/report.html").read_text()
    if "data:image/png" not in page and "built without pictures" not in page:
        raise SystemExit("spall report: no picture")
    system.as_user("mpirun", "-n", "2", "--oversubscribe", "spall", "check",
                   f"{DATA}/cases/los_angeles_quick.prm")


def check_examples(system):
    """They build with the package alone, and run."""
    for name, words in (("engine", ["build_engine/settle"]),
                        ("own_law", ["build_own_law/own_law", "run",
                                     "own_law/triaxial.prm", "--out",
                                     "run_own_law"])):
        begin = time.time()
        system.as_user("cp", "-r", f"{DATA}/examples/{name}", name)
        system.as_user("cmake", "-S", name, "-B", f"build_{name}")
        system.as_user("cmake", "--build", f"build_{name}", "--parallel", "2")
        system.as_user(*words)
        print(f"{name}: built and run in {time.time() - begin:.0f} s",
              flush=True)
    summary = json.loads(system.home("run_own_law/summary.json").read_text())
    if not summary["is_complete"]:
        raise SystemExit(f"own_law: {summary}")
    # The program of a user finds the data of the package, too.
    system.as_user("build_own_law/own_law", "check",
                   f"{DATA}/cases/dynamic_triaxial_quick.prm")


def check_removed(system, names):
    """Nothing of the packages stays."""
    system.as_root("apt-get", "-y", "purge", *names)
    left = [path for path in (
        "usr/share/spall", "usr/share/doc/spall", "usr/include/spall",
        "usr/lib/python3/dist-packages/spall", "usr/lib/cmake/Spall",
        "usr/bin/spall") if (system.root / path).exists()]
    if left:
        raise SystemExit(f"purge leaves {left}")


def check_lintian(system, files):
    """No error; warnings are printed."""
    system.install("--no-install-recommends", "lintian")
    ended = system.as_user("lintian", "--fail-on", "error", "--info",
                           "--tag-display-limit", "0", *files)
    for line in ended.splitlines():
        if line.startswith(("E:", "W:")):
            print(line, flush=True)


def main():
    reason = why_skipped()
    if reason:
        print(f"skipped: {reason}")
        return SKIPPED
    if "SPALL_MOUNTS_ARE_OWN" not in os.environ:
        os.environ["SPALL_MOUNTS_ARE_OWN"] = "1"
        os.execvp("unshare", ["unshare", "--mount", sys.executable, "-B",
                              *sys.argv])
    build = pathlib.Path(sys.argv[1]).resolve()
    CACHE.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=CACHE) as name:
        packages = make_packages(build, pathlib.Path(name) / "packages")
        # Unmounted before the folder is removed.
        try:
            system = System(pathlib.Path(name))
            run_checks(system, packages)
        finally:
            for mount in ("proc", "var/cache/apt/archives"):
                subprocess.run(["umount", f"{name}/root/{mount}"], check=False,
                               stderr=subprocess.DEVNULL)
    print("passed")
    return 0


def run_checks(system, packages):
    home = {}
    for name, file in packages.items():
        shutil.copy(file, system.home(file.name))
        home[name] = f"/home/user/{file.name}"
    for name, check in (
            ("spall", check_program),
            ("python3-spall", lambda it: print(
                it.as_user("python3", "-c", IN_PYTHON), end="")),
            ("libspall-dev", check_examples)):
        if name not in packages:
            continue
        tools = ["cmake", "g++", "make"] if name == "libspall-dev" else []
        system.install(home[name], *tools)
        check_files(system, name)
        begin = time.time()
        check(system)
        print(f"{name}: checked in {time.time() - begin:.0f} s", flush=True)
    check_removed(system, list(packages))
    check_lintian(system, list(home.values()))


if __name__ == "__main__":
    sys.exit(main())
