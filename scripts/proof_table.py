#!/usr/bin/python3
"""Makes one table of the logs that scripts/prove.sh has left; called by it.

usage: proof_table.py LOGS PART...     prints the table of all parts that have run, and writes it as Markdown to LOGS/table.md
       proof_table.py --commit         prints the commit, and whether the tree has changes
       proof_table.py --ended LOGS PART quick|long STATUS SECONDS COMMIT     notes that a part has run, which began at COMMIT
       proof_table.py --self-test      reads lines as the parts print them

The first ends with 0 when each PART has run, has passed and has printed its figures. A part without figures has shown nothing: it
failed.
"""
import datetime
import json
import os
import pathlib
import platform
import re
import subprocess
import sys

sys.dont_write_bytecode = True
from count_coverage import BRANCHES, LINES  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
NOT_RUN, LEFT_OUT = 125, 126
BESIDE = "beside a failure"
MISSING = {126, 127}  # of the shell: no such program; 126 is told apart by what the part says


def campaign(text):
    """Rows of test_campaign's table: a line for each bus."""
    row = re.compile(r"^(\w+) +(\d+) +(\d+) +\d+ +\d+ +\d+ +([\d.]+) s / ([\d.]+) s \(\S+\) +([\d.]+) s", re.M)
    return [(f"fault campaign, {bus}", f"{scenarios} scenarios, {violations} violations, worst stop {stop} s of {bound} s allowed, "
             f"worst recovery {recovery} s") for bus, scenarios, violations, stop, bound, recovery in row.findall(text)]


def processes(text):
    """A line for each bus."""
    found = re.findall(r"^processes: (\w+) (\d+) scenarios, (\d+) failed$", text, re.M)
    return [(f"campaign with real processes, {bus}", f"{count} scenarios, {failed} failed") for bus, count, failed in found]


def mutants(text):
    """Rows of mutants.py's table: a line for each folder."""
    row = re.compile(r"^(\w[\w/]*) +(\d+) +(\d+) +(\d+) +(\d+) +(\d+) +([\d.]+)% +(\d+)%$", re.M)
    return [(f"mutants, {folder}", f"{found} of {int(found) + int(survived)} found: {score} % (goal {goal} %); {same} equivalent, "
             f"{refused} not compilable") for folder, _, refused, same, found, survived, score, goal in row.findall(text)]


def explored(text):
    found = re.findall(r"^explored (.+?): (\d+) states, (\d+) transitions", text, re.M)
    return [(f"every order of events, {what}", f"{states} states, {transitions} transitions") for what, states, transitions in found]


def tests(text):
    """The last line of test.sh."""
    found = re.findall(r"^(\d+) passed, (\d+) failed, (\d+) skipped$", text, re.M)
    return "{} passed, {} failed, {} skipped".format(*found[-1]) if found else ""


def address(text):
    return [("AddressSanitizer, UndefinedBehaviorSanitizer", tests(text))] if tests(text) else []


def thread(text):
    return [("ThreadSanitizer", tests(text))] if tests(text) else []


def fuzz(text):
    found = re.findall(r"^(fuzz_\w+): (\d+) executions in (\d+) s$", text, re.M)
    return [(f"fuzzing, {name}", f"{int(count):,} executions in {seconds} s, no crash") for name, count, seconds in found]


def soak(text):
    return [("soak, " + line.split(" ", 1)[0], line.split(" ", 1)[1]) for line in re.findall(r"^soak: (.+)$", text, re.M)]


def coverage(text):
    row = re.compile(r"^([a-z][\w/]*) +\d+/ *\d+ +([\d.]+)% +\d+/ *\d+ +([\d.]+)%", re.M)
    return [(f"coverage, {folder}", f"{lines} % of lines, {branches} % of branches") for folder, lines, branches in row.findall(text)]


FIGURES = {"campaign": campaign, "processes": processes, "mutants": mutants, "explored": explored, "address": address, "thread": thread, "fuzz": fuzz,
           "soak": soak, "coverage": coverage}


def fuzzTargets():
    listed = re.search(r"^foreach\(part ([^)]*)\)", (ROOT / "fuzz" / "CMakeLists.txt").read_text(), re.M)
    return len(listed.group(1).split())


# As many rows a part prints at least: one whose line is missing has not passed.
LEAST = {"campaign": 4, "processes": 4, "explored": 14, "mutants": 8, "fuzz": fuzzTargets(), "soak": 5, "coverage": 13}


def failedByItself(what, words):
    """Whether the figures of a row say that it has failed, by whatever else its part has."""
    numbers = {"fault campaign": r"(?<!\d)[1-9]\d* violations", "campaign with real processes": r"(?<!\d)[1-9]\d* failed"}
    kind = what.split(",")[0]
    if kind in numbers:
        return re.search(numbers[kind], words) is not None
    score = re.search(r": ([\d.]+) % \(goal (\d+) %\)", words)
    if score:
        return float(score.group(1)) < float(score.group(2))
    covered = re.match(r"([\d.]+) % of lines, ([\d.]+) % of branches$", words)
    if covered:
        return float(covered.group(1)) < LINES or float(covered.group(2)) < BRANCHES
    return words.endswith("FAILED")


def rows_of(part, status, text):
    """[(what, figures, verdict)] of one part."""
    last = text.strip().splitlines()[-1] if text.strip() else "it said nothing"
    if status == LEFT_OUT and last == "--quick":
        return [(part, "", "left out (--quick)")]
    if status in MISSING or status == NOT_RUN:
        return [(part, last, "COULD NOT BE RUN")]
    figures = FIGURES[part](text)
    if not figures:
        return [(part, f"ended with {status} and no figures: {last}", "FAILED")]
    missing = []
    if len(figures) < LEAST.get(part, 1):
        missing = [(part, f"{len(figures)} rows where {LEAST[part]} or more were expected", "FAILED")]
    if status == 0 and not missing:
        return [(what, words, "passed") for what, words in figures]
    own = [failedByItself(what, words) for what, words in figures]
    # Where no row tells what failed, the log does.
    return [(what, words, "FAILED" if bad or not any(own) else BESIDE) for (what, words), bad in zip(figures, own)] + missing


def commit():
    """Of the project, and whether the tree is that: a new file that git does not know yet is a change, too."""
    def git(*words):
        return subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, text=True, check=False).stdout.strip()
    return (git("rev-parse", "--short=12", "HEAD") or "unknown") + (" with changes" if git("status", "--porcelain") else "")


def machine():
    model = re.search(r"^model name\s*: (.+)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M)
    memory = re.search(r"^MemTotal: +(\d+)", pathlib.Path("/proc/meminfo").read_text(), re.M)
    return f"{os.cpu_count()} processors ({model.group(1) if model else platform.machine()}), " \
           f"{int(memory.group(1)) // 1048576 if memory else '?'} GiB, Linux {platform.release()}"


def while_it_ran(before, after):
    """What a part ran on, which has been built when it began."""
    return before if before == after else f"{before}, changed to {after} while it ran"


def ended(logs, part, form, status, seconds, before):
    run = {"status": int(status), "seconds": int(seconds), "form": form, "commit": while_it_ran(before, commit()),
           "date": f"{datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d}"}
    (logs / f"{part}.status").write_text(json.dumps(run) + "\n")
    return 0


def selfTest():
    assert campaign("profibus         5000           0     9000   12000    20000  0.310 s / 0.350 s (17)    1.213 s (4)\n") == [
        ("fault campaign, profibus", "5000 scenarios, 0 violations, worst stop 0.310 s of 0.350 s allowed, worst recovery 1.213 s")]
    assert mutants("drive            40        1           2     36         1   97.3%    95%\n")[0][1].startswith("36 of 37 found: 97.3 %")
    assert explored("explored Drive: 12 states, 40 transitions\nexplored PKW: 30 states, 9 transitions\n") == [
        ("every order of events, Drive", "12 states, 40 transitions"), ("every order of events, PKW", "30 states, 9 transitions")]
    assert processes("processes: canopen 12 scenarios, 0 failed\n") == [("campaign with real processes, canopen", "12 scenarios, 0 failed")]
    assert address("1 passed, 0 failed, 1 skipped\n710 passed, 2 failed, 30 skipped\n")[0][1] == "710 passed, 2 failed, 30 skipped"
    assert fuzz("fuzz_sdo: 1200345 executions in 31 s\n") == [("fuzzing, fuzz_sdo", "1,200,345 executions in 31 s, no crash")]
    assert soak("soak: pty 10 s at 500 Hz, 0 allocations\n") == [("soak, pty", "10 s at 500 Hz, 0 allocations")]
    assert coverage("drive                   900/   910   98.9%    400/   420   95.2%\n") == [("coverage, drive", "98.9 % of lines, 95.2 % of branches")]
    assert rows_of("mutants", 126, "--quick\n")[0][2] == "left out (--quick)"
    assert rows_of("mutants", 127, "no such file\n")[0][2] == "COULD NOT BE RUN"
    assert rows_of("explored", 0, "")[0][2] == "FAILED", "without figures nothing is shown"
    assert all(verdict == "passed" for _, _, verdict in rows_of("explored", 0, "explored Drive: 12 states, 40 transitions\n" * 14))
    assert rows_of("explored", 1, "explored Drive: 12 states, 40 transitions\n")[0][2] == "FAILED"
    two = "soak: pty 10 s, FAILED\nsoak: Canopen 1 h\nsoak: a 1\nsoak: b 1\nsoak: c 1\n"
    assert [verdict for _, _, verdict in rows_of("soak", 1, two)][:2] == ["FAILED", BESIDE]
    assert failedByItself("fault campaign, canopen", "10 scenarios, 10 violations, worst stop 1 s")
    assert not failedByItself("fault campaign, canopen", "10 scenarios, 0 violations, worst stop 1 s")
    assert failedByItself("mutants, cycle", "21 of 25 found: 84.0 % (goal 95 %)")
    assert not failedByItself("mutants, drive", "25 of 25 found: 100.0 % (goal 95 %)")
    assert failedByItself("coverage, can", "97.8 % of lines, 84.5 % of branches")
    assert not failedByItself("coverage, drive", "98.0 % of lines, 96.0 % of branches")
    assert rows_of("fuzz", 0, "fuzz_sdo: 1200345 executions in 31 s\n")[-1][2] == "FAILED", "the other targets are missing"
    assert while_it_ran("abc", "abc") == "abc"
    assert while_it_ran("abc", "abd with changes") == "abc, changed to abd with changes while it ran"
    print("self-test: passed")
    return 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return selfTest()
    if sys.argv[1:] == ["--commit"]:
        print(commit())
        return 0
    if sys.argv[1:2] == ["--ended"] and len(sys.argv) == 8:
        return ended(pathlib.Path(sys.argv[2]), *sys.argv[3:])
    if len(sys.argv) < 3 or sys.argv[1].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    logs, asked = pathlib.Path(sys.argv[1]), sys.argv[2:]
    rows, good = [], True
    for part in [name for name in FIGURES if (logs / f"{name}.status").exists() or name in asked]:
        run = json.loads((logs / f"{part}.status").read_text())
        of_part = rows_of(part, run["status"], (logs / f"{part}.log").read_text(errors="replace"))
        rows += [(*row, f"{run['date']}, {run['commit']}, {run['form']}, {run['seconds'] / 60:.0f} min") for row in of_part]
        good = good and (part not in asked or all(verdict == "passed" or verdict.startswith("left out") for _, _, verdict in of_part))
    width = max(len(what) for what, *_ in rows)
    print(machine())
    for what, words, verdict, run in rows:
        print(f"{what:{width}}  {verdict:18}  {words}  ({run})")
    table = [machine(), "", "| What | Figures | Verdict | Day, commit, form, time of its part |", "|---|---|---|---|"]
    table += [f"| {what} | {words.replace('|', '/')} | {verdict} | {run} |" for what, words, verdict, run in rows]
    (logs / "table.md").write_text("\n".join(table) + "\n")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
