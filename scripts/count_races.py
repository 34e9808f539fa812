#!/usr/bin/python3
"""Counts what ThreadSanitizer has reported, and says whose it is.

usage: count_races.py FOLDER [ROOT]    the reports in FOLDER (log_path), of a project whose sources are in ROOT (this one)
       count_races.py --self-test

The libraries of ROS are not built with it, so that it does not see what they order by means of their own, and reports that. A
report is ours when an access, or a lock, that it is about was made by our sources: the innermost line of a stack that is
neither the sanitizer's own nor that of a template of a library. Ours are printed, and end it with 1.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
STACK = re.compile(r"^ {2}(?=\S)", re.M)
LINE = re.compile(r"^ +#\d+ (.*)$", re.M)
CREATED = re.compile(r"^(Thread|Location|As if|Mutex M\d+ \(0x[0-9a-f]+\) created)")


def innermost(stack):
    """The line that made the access; "" when there is none."""
    lines = [line for line in LINE.findall(stack) if "libsanitizer" not in line and " /usr/include/" not in line]
    return lines[0] if lines else ""


def accesses(report):
    """The innermost lines of what a report is about; not where threads and memory come from."""
    return [innermost(stack) for stack in STACK.split(report) if not CREATED.match(stack)]


def isOurs(report, root):
    return any(f" {root}/" in line for line in accesses(report))


def reportsIn(folder):
    for path in sorted(pathlib.Path(folder).iterdir()):
        yield from path.read_text(errors="replace").split("WARNING: ThreadSanitizer: ")[1:]


def selfTest():
    race = ("data race (pid=1)\n  Write of size 8 at 0x7b by main thread:\n    #0 memcpy /x/libsanitizer/a.inc:8 (libtsan.so.2+0x5)\n"
            "    #1 {} (+0x1)\n\n  Previous read of size 8 at 0x7b by thread T1:\n    #0 {}\n\n"
            "  Thread T1 (tid=2, running) created by main thread at:\n    #0 main /w/src/node/main.cpp:9 (nord_driver_node+0x7)\n")
    theirs, ours = "ros::poll() <null> (libroscpp.so.4d+0x2)", "nord_driver::f() /w/src/f.cpp:3 (libnord_driver.so+0x4)"
    template = "boost::release() /usr/include/boost/shared_ptr.hpp:4 (nord_driver_node+0x5)\n    #2 "
    assert not isOurs(race.format(theirs, theirs), "/w"), "who created the thread is not what made the access"
    assert isOurs(race.format(theirs, ours), "/w")
    assert isOurs(race.format(ours, theirs), "/w")
    assert isOurs(race.format(template + ours, theirs), "/w")
    assert not isOurs(race.format(template + theirs, theirs), "/w"), "a template that a library calls is the library's"
    print("self-test: passed")
    return 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return selfTest()
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    root = sys.argv[2] if len(sys.argv) == 3 else str(ROOT)
    reports = list(reportsIn(sys.argv[1]))
    ours = [report for report in reports if isOurs(report, root)]
    for report in ours:
        print("ThreadSanitizer: " + report)
    print(f"{len(reports)} reports of ThreadSanitizer, {len(ours)} of them about code of this project")
    return 1 if ours else 0


if __name__ == "__main__":
    sys.exit(main())
