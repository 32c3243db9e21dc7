#!/usr/bin/python3
"""What a sweep's runs say of those that nobody has made: a Gaussian process for each measure.

Usage: emulator.py TABLE PARAMETERS DIR [SUGGEST]

TABLE is sweep.csv; PARAMETERS is JSON, {"parameters": [[name, least, greatest], ...], "measures": [...]}; DIR
gets emulator.csv and emulator.png: for each measure the error of predictions of points that were left out with
all their seeds, how many of these lie within the bands of 90 %, Sobol's indices, and whether the emulator may be
used.  SUGGEST is a number of points that would tell most.  What is to be said, with these as tables of a plan,
goes into said.txt beside PARAMETERS.  Files are written under temporary names and then renamed.  On bad input:
one line on stderr, exit status 2.

The process (Rasmussen and Williams 2006) has Matern's covariance of 5/2 with a length per parameter, and noise,
which is that of seeds.  Errors of left-out points and seeds are exact for its fitted lengths; bands are widened or narrowed
to hold 90 % of them (as in conformal prediction).  Indices are those of Saltelli et al. 2010 (first) and Jansen
1999 (total).
"""
import csv
import io
import os
import sys
import warnings
from dataclasses import dataclass

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import FAINT, INK, STYLE, matplotlib, new_figure, np, read_json, read_rows, run, save, without_frame
from script import InputError, library

library("sklearn.gaussian_process")
from scipy.stats import qmc
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

LEAST_POINTS, POINTS_PER_PARAMETER = 20, 8
BAND = 0.9
LEAST_SHARE = 0.3     # of the spread between points that is explained
MOST_KURTOSIS = 6.0   # of errors over their deviations, 3 where they are normal; where a measure jumps it is more, and
LARGE_ERROR = 0.3     # the largest is so large a part of the measure's range
SAMPLES = 2**12       # of Sobol's indices, a power of 2
MOST_SUGGESTED, CANDIDATES = 100, 2**11


@dataclass
class Emulator:
    """Of one measure, over parameters from 0 to 1."""
    process: GaussianProcessRegressor
    errors: np.ndarray      # of left-out runs, in the measure's unit
    deviations: np.ndarray  # that were expected of them
    width: float            # of a band of 90 %, in deviations
    explained: float        # share of the variance of points' means
    kurtosis: float
    largest: float          # error, over the measure's range

    def predict(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Mean and half the band in which a run lies with 90 %."""
        mean, deviation = self.process.predict(x, return_std=True)
        return mean, self.width * deviation

    @property
    def rms(self) -> float:
        return float(np.sqrt((self.errors**2).mean()))

    @property
    def verdict(self) -> str:
        if self.explained < LEAST_SHARE:
            return f"no: explains {100.0 * max(0.0, self.explained):.0f} % between points"
        if self.kurtosis > MOST_KURTOSIS and self.largest > LARGE_ERROR:
            return "no: it jumps somewhere"
        return "yes"


def covariance(process: GaussianProcessRegressor, x: np.ndarray) -> np.ndarray:
    return process.kernel_(x)


def left_out(process: GaussianProcessRegressor, x: np.ndarray, y: np.ndarray, point: np.ndarray,
             seed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Errors and deviations of each run, predicted without the runs of its point (Rasmussen and Williams 2006,
    5.12, by blocks) and without those of its seed, whose packing all points share."""
    scale, middle = float(process._y_train_std), float(process._y_train_mean)
    inverse = np.linalg.inv(covariance(process, x))
    weighted = inverse @ ((y - middle) / scale)
    errors, deviations = np.empty(len(y)), np.empty(len(y))
    several = len(np.unique(seed)) > 1
    for run_ in range(len(y)):
        rows = np.flatnonzero((point == point[run_]) | (several & (seed == seed[run_])))
        block = np.linalg.inv(inverse[np.ix_(rows, rows)])
        at = np.searchsorted(rows, run_)
        errors[run_] = -scale * (block[at] @ weighted[rows])   # prediction less truth
        deviations[run_] = scale * np.sqrt(block[at, at])
    return errors, deviations


def fit(x: np.ndarray, y: np.ndarray, point: np.ndarray, seed: np.ndarray) -> Emulator:
    """x: runs by parameters, from 0 to 1; point, seed: number of the design point and seed, by run."""
    kernel = (ConstantKernel(1.0, (1e-3, 1e3)) * Matern(np.full(x.shape[1], 0.4), (0.05, 50.0), nu=2.5)
              + WhiteKernel(1e-3, (1e-8, 10.0)))
    process = GaussianProcessRegressor(kernel, normalize_y=True, n_restarts_optimizer=3, random_state=0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")   # a length at its bound: the parameter does nothing
        process.fit(x, y)
    errors, deviations = left_out(process, x, y, point, seed)
    ratio = np.abs(errors) / deviations
    rank = min(len(ratio), int(np.ceil(BAND * (len(ratio) + 1))))
    means = np.array([[y[point == p].mean(), errors[point == p].mean()] for p in np.unique(point)])
    spread = means[:, 0].var()
    z = errors / deviations
    return Emulator(process, errors, deviations, float(np.sort(ratio)[rank - 1]),
                    float(1.0 - (means[:, 1]**2).mean() / spread) if spread > 0.0 else 0.0,
                    float((z**4).mean() / (z**2).mean()**2), float(np.abs(errors).max() / (np.ptp(y) or 1.0)))


def sobol(emulator: Emulator, parameters: int) -> tuple[np.ndarray, np.ndarray]:
    """First and total indices by parameter."""
    both = qmc.Sobol(2 * parameters, seed=0).random(SAMPLES)
    a, b = both[:, :parameters], both[:, parameters:]
    of_a, of_b = emulator.process.predict(a), emulator.process.predict(b)
    variance = np.concatenate([of_a, of_b]).var() or 1.0
    first, total = np.empty(parameters), np.empty(parameters)
    for k in range(parameters):
        mixed = a.copy()
        mixed[:, k] = b[:, k]
        of_mixed = emulator.process.predict(mixed)
        first[k] = (of_b * (of_mixed - of_a)).mean() / variance
        total[k] = 0.5 * ((of_a - of_mixed)**2).mean() / variance
    return first, total


def suggestions(emulators: list[Emulator], x: np.ndarray, number: int) -> np.ndarray:
    """Points at which, one after the other, the measures together are least known."""
    candidates = qmc.Sobol(x.shape[1], seed=1).random(CANDIDATES)
    known, chosen = np.unique(x, axis=0), []
    for _ in range(number):
        unknown = np.zeros(len(candidates))
        unknown[[c in chosen for c in range(len(candidates))]] = -np.inf   # a plan has no point twice
        for emulator in emulators:
            kernel = emulator.process.kernel_
            inverse = np.linalg.inv(kernel(known))
            across = kernel(candidates, known)   # without noise
            unknown += 1.0 - np.einsum("ij,jk,ik->i", across, inverse, across) / kernel.diag(candidates)
        best = int(np.argmax(unknown))
        chosen.append(best)
        known = np.vstack([known, candidates[best]])
    return candidates[chosen]


def plan_of(points: np.ndarray, parameters: list) -> list[str]:
    """Points as the lines of a plan."""
    lines = ['design = "list"']
    for k, (name, low, high) in enumerate(parameters):
        values = ", ".join(f"{low + share * (high - low):.4g}" for share in points[:, k])
        lines += ["[[vary]]", f'parameter = "{name}"', f"values = [{values}]"]
    return lines


def load(path: str, parameters: list) -> tuple[list[dict], np.ndarray, np.ndarray, np.ndarray]:
    """Finished rows, their parameters from 0 to 1, their points and seeds."""
    rows = [row for row in read_rows(path) if row.get("outcome") == "finished"]
    try:
        x = np.array([[(float(row[name]) - low) / (high - low) for name, low, high in parameters] for row in rows])
        return rows, x, *(np.array([int(row[name]) for row in rows]) for name in ("run", "seed"))
    except (KeyError, ValueError) as failure:
        raise InputError(f"{path}: not a sweep's table of these parameters ({failure!r})") from failure


def require_enough(path: str, points: int, parameters: int) -> None:
    least = max(LEAST_POINTS, POINTS_PER_PARAMETER * parameters)
    if points < least:
        raise InputError(f"{path}: {points} finished points; an emulator of {parameters} parameters needs {least} or "
                         "more: samples of a Latin hypercube")


def draw(path: str, found: dict, names: list[str], truth: dict):
    figure = new_figure(9.0, 0.5 + 2.6 * len(found), 130)
    grid = figure.subplots(len(found), 2, squeeze=False)
    place = np.arange(len(names))
    for (left, right), (measure, (emulator, first, total)) in zip(grid, found.items()):
        left.errorbar(truth[measure], truth[measure] + emulator.errors, yerr=emulator.width * emulator.deviations,
                      fmt="o", ms=2.5, lw=0.5, color="#1f6fb4", ecolor="#b9cfe3")
        ends = [truth[measure].min(), truth[measure].max()]
        left.plot(ends, ends, color=INK, lw=0.8)
        left.set_xlabel("computed")
        left.set_ylabel("predicted without it")
        left.set_title(f"{measure}: {emulator.verdict}", loc="left", fontsize=9.5, weight="semibold")
        right.barh(place - 0.18, np.maximum(first, 0.0), 0.34, color="#1f6fb4", label="alone")
        right.barh(place + 0.18, total, 0.34, color="#b9cfe3", label="with others")
        right.set_yticks(place, names, fontsize=7.5)
        right.invert_yaxis()
        right.set_xlim(0.0, 1.0)
        right.set_xlabel("share of the variance")
        right.legend(frameon=False, fontsize=7.5)
        without_frame(left, right)
    figure.text(0.01, 0.005, "bands: 90 %, of a single run with an unknown seed", fontsize=7.5, color=FAINT)
    figure.tight_layout(rect=(0.0, 0.02, 1.0, 1.0))
    save(figure, path, "emulator")


def main(table: str, order: str, folder: str, suggest: str = "0") -> None:
    words = read_json(order)
    parameters, measures = words["parameters"], words["measures"]
    rows, x, point, seed = load(table, parameters)
    require_enough(table, len(np.unique(point)), len(parameters))
    names = [name for name, _, _ in parameters]
    found, truth = {}, {}
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow(["measure", "use", "points", "rms_error", "deviation", "within_90"]
                 + [f"{kind}_{name}" for name in names for kind in ("first", "total")])
    for measure in measures:
        has = np.array([bool(row.get(measure)) for row in rows])
        if len(np.unique(point[has])) < len(np.unique(point)):
            out.writerow([measure, "no: runs lack it", len(np.unique(point[has]))] + [""] * (3 + 2 * len(names)))
            continue
        y = np.array([float(row[measure]) for row in rows])
        emulator = fit(x, y, point, seed)
        first, total = sobol(emulator, len(names)) if emulator.verdict == "yes" else np.full((2, len(names)), np.nan)
        found[measure], truth[measure] = (emulator, first, total), y
        within = (np.abs(emulator.errors) <= emulator.width * emulator.deviations).mean()
        indices = [f"{value:.3f}" if np.isfinite(value) else "" for pair in zip(first, total) for value in pair]
        out.writerow([measure, emulator.verdict, len(np.unique(point)), f"{emulator.rms:.4g}", f"{y.std():.4g}",
                      f"{within:.3f}"] + indices)
    if not found:
        raise InputError(f"{table}: no measure that all points have")
    temporary = os.path.join(folder, f".emulator-{os.getpid()}.part")
    with open(temporary, "w", encoding="utf-8") as file:
        file.write(text.getvalue())
    os.replace(temporary, os.path.join(folder, "emulator.csv"))
    with matplotlib.rc_context(STYLE):
        draw(folder, found, names, truth)
    said = []
    if len(np.unique(seed)) == 1:
        said.append("one seed: its packing is shared by all points, and bands hold runs of other seeds less often than "
                    "they say; give more seeds")
    for measure, (emulator, _, total) in found.items():
        largest = sorted(zip(total, names), reverse=True)[:3]
        shares = "".join(f"; {name} {100.0 * share:.0f} %" for share, name in largest if emulator.verdict == "yes")
        said.append(f"{measure}: {emulator.verdict}; a run's error {emulator.rms:.3g} of a spread of "
                    f"{truth[measure].std():.3g}{shares}")
    if int(suggest):
        emulators = [emulator for emulator, _, _ in found.values()]
        good = [emulator for emulator in emulators if emulator.verdict == "yes"] or emulators
        said += plan_of(suggestions(good, x, min(int(suggest), MOST_SUGGESTED)), parameters)
    with open(os.path.join(os.path.dirname(order), "said.txt"), "w", encoding="utf-8") as file:
        file.write("".join(f"{line}\n" for line in said))


if __name__ == "__main__":
    run(main, "emulator.py TABLE PARAMETERS DIR [SUGGEST]")
