"""Parameters fitted to measured values and curves."""
from __future__ import annotations

import dataclasses
import numbers
import pathlib
from typing import Any, Callable, Iterable, Sequence

import numpy as np

from .case import Case
from .errors import InputError, need
from .evaluations import (BudgetSpent, Evaluations, Fitted, Ranges,
                          fitted_parameters)
from .run import Run
from .table import Table
from .targets import Target, require_finite


@dataclasses.dataclass
class Calibration:
    """What a calibration has found."""

    values: dict[str, float]       #: parameters by Section/key
    #: Standard error of the mean over the seeds, in the unit of the parameter
    uncertainty: dict[str, float]
    #: The parameter that each seed alone would have, linearised
    per_seed: dict[str, np.ndarray]
    #: Root mean square of (computed - measured) / deviation [1]
    residual: float
    measured: np.ndarray           #: in the units of the targets
    computed: np.ndarray           #: mean over the seeds
    seed_deviation: np.ndarray     #: standard deviation over the seeds
    case: Case                     #: with the parameters
    runs: list[Run]                #: one for each seed
    table: Table                   #: all parameter sets
    message: str                   #: how the search ended

    def __str__(self) -> str:
        n = len(self.runs)
        lines = [f"{name} = {value:.4g} ± {self.uncertainty[name]:.2g} "
                 f"{_unit(self.case, name)}".rstrip()
                 for name, value in self.values.items()]
        lines.append(f"residual {self.residual:.4g}, {self.table.n_rows} "
                     f"parameter sets of {n} seed{'s' if n > 1 else ''}, "
                     f"{self.message}")
        return "\n".join(lines)


def _unit(case: Case, name: str) -> str:
    unit = case.unit(name)
    return "" if unit == "-" else unit


def calibrate(case: Case, targets: Target | Sequence[Target],
              parameters: Ranges, *, seeds: Sequence[int] = (1, 2, 3),
              folder: str | pathlib.Path = "calibration",
              method: str = "least_squares", step: float = 0.1,
              tolerance: float = 0.02, max_sets: int = 40, jobs: int = 1,
              threads: int = 1, ranks: int = 1,
              progress: Callable[[str], object] | None = None) -> Calibration:
    """Fits parameters of a case to measured values (needs scipy).

    ``parameters`` maps Section/key to (lower, upper) or (lower, start, upper);
    a tuple of keys gets one value. ``targets`` are ``Curve`` and ``Value``.
    The outcome of a parameter set is the mean over ``seeds``, the same ones
    for every set, so that the scatter of specimens cancels in differences.

    Two methods: "least_squares", a trust region with derivatives by
    differences over ``step`` (a share of the range, wide enough to exceed the
    scatter), and "nelder_mead", a simplex that takes no derivatives. Both end
    when the parameters move by less than ``tolerance`` (a share of the range)
    or after ``max_sets`` sets.

    The uncertainty is over the seeds: the sensitivity at the optimum turns
    what each seed deviates from the mean into the parameter that this seed
    alone would have. It is nan for one seed.

    Every run has its folder in ``folder``. A call with the same folder takes
    what is there, so that a stopped calibration goes on. ``jobs`` seeds run at
    the same time.
    """
    need("scipy.optimize", "calibrate")
    aims: list[Target] = list(targets) if isinstance(targets, Sequence) \
        else [targets]
    _check(case, aims, method)
    _check_numbers(seeds, {"step": step, "tolerance": tolerance},
                   {"max_sets": max_sets, "jobs": jobs, "threads": threads,
                    "ranks": ranks})
    fitted = fitted_parameters(case, parameters)
    sets = Evaluations(case, aims, fitted, seeds, pathlib.Path(folder),
                       max_sets=max_sets, jobs=jobs, progress=progress,
                       threads=threads, ranks=ranks)
    start = np.array([one.share() for one in fitted])
    sets.outcomes(start)
    try:
        message = _METHODS[method](sets, start, step, tolerance)
    except BudgetSpent:
        message = f"stopped after {max_sets} sets"
    return _result(sets, fitted, step, message)


def _check(case: Case, targets: Sequence[Target], method: str) -> None:
    if not isinstance(case, Case):
        raise InputError(f"calibrate: case = {case!r}: must be a spall.Case")
    if not targets:
        raise InputError("calibrate: no target was given")
    for one in targets:
        if not isinstance(one, Target):
            raise InputError(f"calibrate: target {one!r}: must be a "
                             "spall.Curve or a spall.Value")
    if method not in _METHODS:
        raise InputError(f"calibrate: method = {method}: must be one of "
                         f"{', '.join(_METHODS)}")
    if not case.seed_key:
        raise InputError(f"calibrate: a case of kind {case.kind} has no seed")


def _check_numbers(seeds: Sequence[int], shares: dict[str, float],
                   counts: dict[str, int]) -> None:
    are_whole = isinstance(seeds, Iterable) and all(map(_is_whole, seeds))
    if not are_whole or not seeds or len(set(seeds)) != len(seeds):
        raise InputError(f"calibrate: seeds = {seeds}: must be different "
                         "whole numbers")
    for name, share in shares.items():
        require_finite(f"calibrate: {name}", share)
        if not 0 < share <= 0.5:
            raise InputError(f"calibrate: {name} = {share}: must be above 0 "
                             "and at most 0.5")
    for name, count in counts.items():
        if not _is_whole(count) or count < 1:
            raise InputError(f"calibrate: {name} = {count!r}: must be a whole "
                             "number from 1 up")


def _is_whole(number: Any) -> bool:
    return isinstance(number, numbers.Integral) and \
        not isinstance(number, bool)


def _least_squares(sets: Evaluations, start: np.ndarray, step: float,
                   tolerance: float) -> str:
    from scipy import optimize

    # A start on a limit is moved inside by the method: once, here.
    inside = np.clip(start, 1e-3, 1 - 1e-3)
    found = optimize.least_squares(
        sets.residuals, inside, bounds=(0, 1),
        jac=lambda shares: sets.jacobian(shares, step),
        xtol=tolerance, ftol=1e-3, gtol=1e-6)
    return str(found.message).rstrip(".").replace("`", "")


def _nelder_mead(sets: Evaluations, start: np.ndarray, step: float,
                 tolerance: float) -> str:
    from scipy import optimize

    simplex = [start]
    for k in range(len(start)):
        corner = start.copy()
        corner[k] += 2 * step if corner[k] + 2 * step <= 1 else -2 * step
        simplex.append(corner)
    found = optimize.minimize(
        lambda shares: float(np.sum(sets.residuals(shares)**2)), start,
        method="Nelder-Mead", bounds=[(0, 1)] * len(start),
        options={"initial_simplex": np.array(simplex), "xatol": tolerance,
                 "fatol": np.inf})
    return str(found.message).rstrip(".")


_METHODS: dict[str, Callable[..., str]] = {
    "least_squares": _least_squares, "nelder_mead": _nelder_mead}


def _result(sets: Evaluations, fitted: Sequence[Fitted], step: float,
            message: str) -> Calibration:
    best = sets.best()
    shares = np.array([(value - one.lower) / (one.upper - one.lower)
                       for one, value in zip(fitted, best)])
    outcomes = sets.done[best]
    sets.max_sets += 2 * len(fitted)  # for the derivatives at the optimum
    offsets = _seed_offsets(sets, shares, step)
    values, uncertainty, per_seed = {}, {}, {}
    for k, one in enumerate(fitted):
        width = one.upper - one.lower
        values[one.name] = best[k]
        per_seed[one.name] = best[k] + width * offsets[:, k]
        uncertainty[one.name] = width * _standard_error(offsets[:, k])
    spread: Any = outcomes.std(axis=0, ddof=1) if len(outcomes) > 1 \
        else np.full(len(sets.measured), np.nan)
    return Calibration(values, uncertainty, per_seed, sets.cost(best),
                       sets.measured, outcomes.mean(axis=0), spread,
                       sets.case_of(best), sets.runs(best), sets.table(),
                       message)


def _standard_error(values: np.ndarray) -> float:
    """Of the mean; nan for one value, infinite where one is."""
    if len(values) < 2:
        return float("nan")
    if np.any(np.isinf(values)):
        return float("inf")
    return float(values.std(ddof=1) / np.sqrt(len(values)))


def _seed_offsets(sets: Evaluations, shares: np.ndarray,
                  step: float) -> np.ndarray:
    """(n_seeds, n_parameters): how far the optimum of each seed alone is from
    the common one, as shares of the ranges. Infinite for a parameter that
    changes nothing."""
    slope = sets.jacobian(shares, step)
    outcomes = sets.outcomes(shares)
    deviation = (outcomes - outcomes.mean(axis=0)) / sets.deviations
    offsets = -deviation @ np.linalg.pinv(slope).T
    offsets[:, np.all(slope == 0, axis=0)] = np.inf
    return offsets
