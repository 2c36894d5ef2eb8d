#!/usr/bin/env python3
"""coverage.py BUILD SOURCE [LINES BRANCHES]: how much of SOURCE/src the runs since the build reached.

Reads what gcov says of every object of the library in BUILD and prints, for each file and for all,
the part of lines and of branches that were taken; with two percentages, fails below them. What was
not reached goes line by line into BUILD/coverage.txt (- a line, ? a branch of a line).
"""

import json
import os
import subprocess
import sys


def reports(build):
    folder = os.path.join(build, "CMakeFiles", "wireskin.dir")
    for path, _, names in os.walk(folder):
        for name in sorted(names):
            if not name.endswith(".gcda"):
                continue
            command = ["gcov", "--json-format", "--stdout", "--branch-probabilities", name]
            text = subprocess.run(command, cwd=path, capture_output=True, check=True).stdout
            for line in text.splitlines():
                yield json.loads(line)


def collect(build, source):
    """For each file its lines {number: reached} and branches {(number, which): reached}."""
    files = {}
    root = os.path.realpath(os.path.join(source, "src")) + os.sep
    for report in reports(build):
        for file in report["files"]:
            full = os.path.join(report["current_working_directory"], file["file"])
            name = os.path.realpath(full)
            if not name.startswith(root):
                continue
            lines, branches = files.setdefault(name[len(root) :], ({}, {}))
            for line in file["lines"]:
                number = line["line_number"]
                lines[number] = lines.get(number, False) or line["count"] > 0
                for i, branch in enumerate(b for b in line["branches"] if not b["throw"]):
                    branches[number, i] = branches.get((number, i), False) or branch["count"] > 0
    return files


def percent(reached):
    return 100.0 * sum(reached) / len(reached) if reached else 100.0


def write_unreached(files, source, path):
    with open(path, "w", encoding="utf-8") as out:
        for name in sorted(files):
            lines, branches = files[name]
            half = {number for (number, _), reached in branches.items() if not reached}
            text = open(os.path.join(source, "src", name), encoding="utf-8").read().splitlines()
            for number in sorted(half | {n for n, reached in lines.items() if not reached}):
                mark = "?" if lines.get(number, True) else "-"
                out.write("%s:%d:%s %s\n" % (name, number, mark, text[number - 1]))


def main():
    build, source = sys.argv[1:3]
    least = [float(x) for x in sys.argv[3:5]] or [0.0, 0.0]
    files = collect(build, source)
    if not files:
        sys.exit("no counts: build with --coverage and run the tests first")
    write_unreached(files, source, os.path.join(build, "coverage.txt"))
    print(" lines branch   not reached")
    for name in sorted(files):
        lines, branches = (list(part.values()) for part in files[name])
        open_ends = len(lines) - sum(lines), len(branches) - sum(branches)
        print("%6.1f %6.1f %5d %5d  %s" % (percent(lines), percent(branches), *open_ends, name))
    total = [[x for file in files.values() for x in file[part].values()] for part in (0, 1)]
    reached = [percent(part) for part in total]
    print("%6.1f %6.1f              src: lines %d, branches %d" % (*reached, len(total[0]), len(total[1])))
    if any(r < l for r, l in zip(reached, least)):
        sys.exit("less than %.0f %% of lines or %.0f %% of branches" % tuple(least))


main()
