"""Slices of a specimen: polygons against the numbers of the summary."""
import collections

from triaxial_runs import rows, summary

HEIGHTS = [0.25, 0.5, 0.75]


def area(points):
    return 0.5 * sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in
                     zip(points, points[1:] + points[:1]))


def polygons(folder, name):
    """Areas by height, particle and sort [m^2]."""
    points = collections.defaultdict(list)
    for row in rows(folder, name)[1]:
        points[row["height_share_1"], row["particle_1"], row["spalled_1"],
               row["loop_1"]].append((row["x_m"], row["y_m"]))
    sums = collections.defaultdict(float)
    for (height, particle, spalled, _), corners in points.items():
        sums[height, particle, spalled] += area(corners)
    return sums


def slice_faults(folder):
    found = summary(folder).get("slices", [])
    if [one["height_share_1"] for one in found] != HEIGHTS:
        return [f"slices {found}"]
    faults = []
    first, last = (polygons(folder, f"slices_{when}.csv")
                   for when in ("start", "end"))
    if any(spalled for _, _, spalled in first):
        faults.append("slices_start.csv: something has spalled")
    for one in found:
        height = one["height_share_1"]

        def total(sums, spalled):
            return sum(found for (at, particle, sort), found in sums.items()
                       if at == height and particle >= 0 and sort == spalled)

        # Outlines are simplified to 2e-3 of the radius: less than 1 %.
        now, space = one["particle_area_m2"], one["section_m2"]
        if not 0.99 < total(last, 0) / now < 1.001 or \
                not abs(last[height, -1, 0] / space - 1.) < 1e-4:
            faults.append(f"slice {height}: outlines have {total(last, 0)} "
                          f"m^2, {last[height, -1, 0]} m^2 of {one}")
        # Loose, as a plate that tilts leaves a few particles under it.
        if not 0.35 < now / space < 0.85:
            faults.append(f"slice {height}: {now} of {space} m^2 are solid")
        # What the series gains beside an event is no region.
        lost = one["spalled_area_m2"]
        if not abs(lost) < 0.02 * now or lost > 1.5 * total(last, 1) + 1e-3 * now:
            faults.append(f"slice {height}: spalled regions have "
                          f"{total(last, 1)} m^2 of {lost} m^2")
        faults += [f"slice {height}: particle {particle} has lost {lost} m^2"
                   for (at, particle, sort), lost in last.items()
                   if at == height and sort == 1 and lost <= 0.]
        if (one["n_spalled"] > 0) != (total(last, 1) > 0.):
            faults.append(f"slice {height}: {one['n_spalled']} spalled")
    return faults
