#!/usr/bin/python3
"""Counts what ThreadSanitizer has reported, and says whose it is.

usage: count_races.py FOLDER [ROOT]    the reports in FOLDER (log_path), of a project whose sources are in ROOT (this one)
       count_races.py --self-test

The libraries of ROS are not built with it, so that it does not see what they order by means of their own, and reports that. A
report is ours when an access, or a lock, that it is about was made by our sources: the innermost line of a stack that is
neither the sanitizer's own nor that of a template of a library. Below functions of the C and C++ library, as those of a string
are, lines of ROS are often missing: there the driver's sources count, and the tests, which call ROS everywhere, do not. A crash
is ours. Ours are printed, and end it with 1.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
STACK = re.compile(r"^ {2}(?=\S)", re.M)
NOBODYS = ("libsanitizer", " /usr/include/")
STANDARD = ("(libstdc++.so", "(libc.so")
LINE = re.compile(r"^ +#\d+ (.*)$", re.M)
CREATED = re.compile(r"^(Thread|Location|As if|Mutex M\d+ \(0x[0-9a-f]+\) created)")


def madeByUs(stack, root):
    lines = [line for line in LINE.findall(stack) if not any(word in line for word in NOBODYS)]
    if lines and not any(word in lines[0] for word in STANDARD):
        return f" {root}/" in lines[0]
    callers = [line for line in lines if not any(word in line for word in STANDARD)]
    return bool(callers) and (f" {root}/src/" in callers[0] or f" {root}/include/" in callers[0])


def isOurs(report, root):
    """By what it is about; not by where threads and memory come from."""
    stacks = [stack for stack in STACK.split(report) if not CREATED.match(stack)]
    return report.startswith("crash") or any(madeByUs(stack, root) for stack in stacks)


def reportsIn(folder):
    for path in sorted(pathlib.Path(folder).iterdir()):
        text = path.read_text(errors="replace")
        yield from text.split("WARNING: ThreadSanitizer: ")[1:]
        for crash in re.split(r"(?:ERROR|FATAL): ThreadSanitizer: ", text)[1:]:
            yield "crash: " + crash


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
    text = "std::string::_M_assign(std::string const&) <null> (libstdc++.so.6+0x1)\n    #2 "
    assert isOurs(race.format(text + ours, theirs), "/w"), "a string of ours"
    assert not isOurs(race.format(text + theirs, text + theirs), "/w")
    assert isOurs("crash: SEGV on unknown address", "/w")
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
