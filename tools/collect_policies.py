#!/usr/bin/env python3
"""Takes the policies of finished training runs into policies/: every seed, the best of each algorithm, curves.

usage: tools/collect_policies.py [RUNS]      (default: out/train, the folder of `linewright train`)

The best is the one with the smallest mean makespan in its own evaluations, never one chosen by hand.
"""
import json
import pathlib
import re
import shutil
import struct
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
POLICIES = ROOT / "policies"


def metadata(file):
    with open(file, "rb") as stream:
        (length,) = struct.unpack("<Q", stream.read(8))
        return json.loads(stream.read(length))["__metadata__"]


def runs_of(folder):
    """{algorithm: [(seed, folder)]}, by name and number."""
    runs = {}
    for run in sorted(pathlib.Path(folder).iterdir()):
        match = re.fullmatch(r"(.+)-s(\d+)", run.name)
        if match and (run / "best.safetensors").exists() and (run / "final.safetensors").exists():
            runs.setdefault(match[1], []).append((int(match[2]), run))
    return {name: sorted(found) for name, found in sorted(runs.items())}


def thinned(source, target):
    """Every fifth line and the last, and of the clock the seconds since the first line."""
    header, *lines = source.read_text().splitlines()
    columns = header.split(",")
    clock = columns.index("wall_time_s")
    start = float(lines[0].split(",")[clock])
    kept = [line for i, line in enumerate(lines) if i % 5 == 0 or i == len(lines) - 1]
    rows = []
    for line in kept:
        values = [f"{float(value):.7g}" for value in line.split(",")]
        values[clock] = f"{float(line.split(',')[clock]) - start:.1f}"
        rows.append(",".join(values))
    target.write_text("\n".join([header, *rows]) + "\n")


def collect(name, runs):
    seeds = POLICIES / "seeds" / name
    seeds.mkdir(parents=True, exist_ok=True)
    (POLICIES / "curves").mkdir(exist_ok=True)
    best = None
    for seed, run in runs:
        policy = run / "best.safetensors"
        shutil.copyfile(policy, seeds / f"{seed}.safetensors")
        shutil.copyfile(run / "evaluations.csv", POLICIES / "curves" / f"{name}-s{seed}.csv")
        thinned(run / "progress.csv", POLICIES / "curves" / f"{name}-s{seed}.progress.csv")
        makespan = float(metadata(policy)["evaluation_makespan"])
        print(f"{name} seed {seed}: {makespan:.1f}")
        if best is None or makespan < best[0]:
            best = (makespan, seed, policy)
    shutil.copyfile(best[2], POLICIES / f"{name}.safetensors")
    print(f"{name}: seed {best[1]} is kept")


def main():
    runs = runs_of(sys.argv[1] if len(sys.argv) > 1 else ROOT / "out" / "train")
    if not runs:
        sys.exit("no folder ALGORITHM-sSEED with a best.safetensors there: run `linewright train` first")
    for name, found in runs.items():
        collect(name, found)


if __name__ == "__main__":
    main()
