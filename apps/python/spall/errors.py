"""Errors of the package, and packages that only some functions need."""
from __future__ import annotations

import importlib
from types import ModuleType


class SpallError(Exception):
    """Base of all errors that the package raises on purpose."""


class InputError(SpallError, ValueError):
    """Bad input: a key, a value, a file. The program ends with status 1."""


class UnknownKey(InputError, KeyError):
    """A name that a case, a table or a record does not have."""

    def __str__(self) -> str:
        return str(self.args[0])


class RunError(SpallError, RuntimeError):
    """A run failed. The program ends with status 2 or by a signal.

    ``status`` is the exit status of the program.
    """

    def __init__(self, message: str, status: int = 2) -> None:
        super().__init__(message)
        self.status = status


class MissingPackage(SpallError, ImportError):
    """A function needs a Python package that is not installed."""


_DEBIAN = {"pandas": "python3-pandas", "matplotlib": "python3-matplotlib",
           "scipy": "python3-scipy", "vtkmodules": "python3-vtk9",
           "h5py": "python3-h5py"}


def need(module: str, what: str) -> ModuleType:
    """The module, or MissingPackage that names the package of Debian."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        name = module.split(".", maxsplit=1)[0]
        raise MissingPackage(
            f"{what} needs {name}: apt install "
            f"{_DEBIAN.get(name, name)}") from error
