"""The program for hundreds of short commands (tests/support/forked_program.cc).
"""
import pathlib
import subprocess
import tempfile


class ForkedProgram:
    """Runs commands as the program would, without its start."""

    def __init__(self, path):
        self.process = subprocess.Popen(
            [path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()

    def run(self, words, folder):
        """The CompletedProcess of a command in a folder. A command that does
        not end within 100 s is ended by SIGALRM."""
        with tempfile.TemporaryDirectory() as name:
            out, err = pathlib.Path(name, "out"), pathlib.Path(name, "err")
            self.process.stdin.write(
                "\x1f".join([str(folder), str(out), str(err), *words]) + "\x1e")
            self.process.stdin.flush()
            status = int(self.process.stdout.readline())
            return subprocess.CompletedProcess(
                words, status, out.read_text(errors="replace"),
                err.read_text(errors="replace"))
