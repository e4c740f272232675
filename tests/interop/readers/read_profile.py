"""read_profile.py FILE: computes with scipy what a study's runs amount to. Prints
  s SOLVER TAU SHARE           of its performance profile
  i KIND METHOD SCHEME SETTING LOWER UPPER   the interval of a median
For how, see profile_test.cpp."""
import collections
import csv
import itertools
import math
import statistics
import sys

from scipy import stats

runs = collections.defaultdict(dict)  # by scene, kind, method, scheme and setting: quantity and number to value
with open(sys.argv[1], newline="", encoding="utf-8") as file:
    for row in csv.DictReader(file):
        key = row["scene"], row["kind"], row["method"], row["scheme"], row["setting"]
        runs[key].setdefault(row["quantity"], []).append((int(row["run"] or 0), row["value"]))


def values(key, quantity):
    return [float(value) for _, value in sorted(runs[key].get(quantity, []))]


times = collections.defaultdict(lambda: math.inf)  # by solver and problem
problems = set()
for key in runs:
    scene, kind, method, scheme, setting = key
    if kind not in ("fixed", "asked"):
        continue
    for target in (1e-3, 1e-4):
        if values((scene, "scene", "", "", ""), "step_gained")[0] >= target:
            continue
        problems.add((scene, target))
        steps = values(key, "steps")[0]
        # Includes its share of the set-up.
        cost = [
            of_step + before / steps
            for of_step, before in itertools.zip_longest(
                values(key, "microseconds_per_step"), values(key, "setup_microseconds"), fillvalue=0
            )
        ]
        if not cost or not values(key, "error_max")[0] < target:
            continue
        solver = method + ("-sdirk2" if scheme == "sdirk2" else "")
        time = statistics.median(cost) / values(key, "step")[0]
        times[solver, scene, target] = min(times[solver, scene, target], time)

solvers = sorted({solver for solver, _, _ in times})
best = {p: min(times[solver, *p] for solver in solvers) for p in problems}
ratios = {s: [times[s, *p] / best[p] if math.isfinite(times[s, *p]) else math.inf for p in problems] for s in solvers}
for solver in solvers:
    for tau in (1, 1.5, 2, 4, 10, 1e9):
        # Rounding must not decide: takes the share slightly above.
        share = stats.percentileofscore(ratios[solver], tau * (1 + 1e-12), kind="weak") / 100
        print("s", solver, repr(float(tau)), repr(float(share)))

for key in runs:
    cost = sorted(values(key, "microseconds_per_step"))
    if len(cost) < 6:
        continue
    first = int(stats.binom.ppf(0.025, len(cost), 0.5))  # the largest l with P(B < l) ≤ 1/40
    print("i", *(part or "-" for part in key[1:]), repr(cost[first - 1]), repr(cost[-first]))
