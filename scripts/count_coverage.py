#!/usr/bin/python3
"""Counts which lines and branches of src/ the tests of a build with --coverage have run, folder by folder, with gcov.

usage: count_coverage.py BUILD [--files] [FOLDER...]

A branch is one that the source has: those that the compiler makes for exceptions are left out, as are lines of headers outside
the project. Ends with 0 when each folder has its goal, or every file below its own share has a reason.
"""
import collections
import json
import pathlib
import subprocess
import sys

from yaml_line import valueOf

ROOT = pathlib.Path(__file__).resolve().parent.parent
REASONS = ROOT / "test" / "coverage" / "reasons.yaml"
LINES, BRANCHES = 95.0, 90.0
FOLDERS = ["profile", "profibus", "canopen", "devicenet", "interbus", "transport/profibus", "transport/canopen", "transport/devicenet",
           "transport/interbus", "transport/can", "drive", "cycle", "robot"]


def notes_of(build):
    """The .gcno files of the library's sources."""
    return sorted((build / "CMakeFiles" / "nord_driver.dir").rglob("*.gcno"))


def gcov(notes):
    """What gcov says of one file of notes, as it prints it."""
    ended = subprocess.run(["gcov", "--json-format", "--stdout", "--branch-probabilities", str(notes)],
                           capture_output=True, check=True, text=True, cwd=notes.parent)
    for line in ended.stdout.splitlines():
        if line.startswith("{"):
            yield json.loads(line)


class File:
    """Of one source: how often each line ran, and each branch of it."""

    def __init__(self):
        self.lines = collections.Counter()
        self.branches = {}

    def add(self, line):
        number = line["line_number"]
        self.lines[number] += line["count"]
        taken = [branch["count"] for branch in line["branches"] if not branch.get("throw", False)]
        if len(taken) < 2:  # the other way was an exception
            return
        known = self.branches.get(number)
        # A template and an inline function stand in several objects: what one of them has not run another may have.
        if known is None or len(known) < len(taken):
            self.branches[number] = taken
        elif len(known) == len(taken):
            self.branches[number] = [one + other for one, other in zip(known, taken)]

    def counts(self):
        """(lines run, lines, branches run, branches)"""
        ways = [count for counts in self.branches.values() for count in counts]
        return sum(count > 0 for count in self.lines.values()), len(self.lines), sum(count > 0 for count in ways), len(ways)


def read(build):
    files = collections.defaultdict(File)
    for notes in notes_of(build):
        for document in gcov(notes):
            for entry in document["files"]:
                path = pathlib.Path(document["current_working_directory"], entry["file"]).resolve()
                try:
                    name = str(path.relative_to(ROOT / "src"))
                except ValueError:
                    continue
                for line in entry["lines"]:
                    files[name].add(line)
    return files


def reasons():
    """{file: reason}: "path: reason" in each line that is not empty and no comment."""
    known = {}
    if REASONS.exists():
        for line in REASONS.read_text().splitlines():
            if line.strip() and not line.startswith("#"):
                path, _, reason = line.partition(": ")
                known[path] = valueOf(reason, REASONS)
    return known


def share(run, of):
    return 100.0 * run / of if of else 100.0


def below(counts):
    return share(counts[0], counts[1]) < LINES or share(counts[2], counts[3]) < BRANCHES


def main():
    words = [word for word in sys.argv[1:] if word != "--files"]
    every_file = "--files" in sys.argv
    if not words:
        print(__doc__, file=sys.stderr)
        return 2
    files = read(pathlib.Path(words[0]))
    if not files:
        print("coverage: nothing was counted: run scripts/coverage.sh without --count-only")
        return 2
    known = reasons()
    unexplained = 0
    print(f"{'coverage':22} {'lines':>13} {'':>7} {'branches':>13} {'':>7}")
    for folder in words[1:] or FOLDERS:
        own = {name: file.counts() for name, file in files.items() if name.rpartition("/")[0] == folder}
        total = [sum(counts[i] for counts in own.values()) for i in range(4)]
        if not total[1]:
            print(f"{folder:22} no line of it was built")
            unexplained += 1
            continue
        ok = not below(total)
        print(f"{folder:22} {total[0]:6}/{total[1]:6} {share(total[0], total[1]):6.1f}% {total[2]:6}/{total[3]:6} {share(total[2], total[3]):6.1f}%"
              + ("" if ok else "  below"))
        for name, counts in sorted(own.items()):
            if not every_file and (ok or not below(counts)):
                continue
            missing = [number for number, count in sorted(files[name].lines.items()) if count == 0]
            reason = known.get(name, "" if ok or not below(counts) else "no reason given")
            unexplained += 0 if ok or not below(counts) or known.get(name) else 1
            print(f"  {name}: {share(counts[0], counts[1]):.1f}% of {counts[1]} lines, {share(counts[2], counts[3]):.1f}% of {counts[3]} branches"
                  + (f"; {reason}" if reason else "") + (f"; never run: {missing}" if every_file and missing else ""))
    if unexplained:
        print(f"coverage: {unexplained} files or folders below {LINES:.0f} % of lines or {BRANCHES:.0f} % of branches without a reason in {REASONS.relative_to(ROOT)}")
    return 0 if unexplained == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
