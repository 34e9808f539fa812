#!/usr/bin/python3
"""Counts the test cases in a folder of result files (JUnit XML, as GoogleTest and rostest write them).

Prints one line "PASSED FAILED SKIPPED" to stdout, and the failed and skipped cases by name to stderr. A file that cannot
be read counts as one failed case: a test that died while writing has not passed.
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def outcome(case):
    """'failed', 'skipped' or 'passed' of one <testcase>."""
    children = {child.tag for child in case}
    if children & {"failure", "error"}:
        return "failed"
    if "skipped" in children or case.get("status") == "notrun" or case.get("result") == "skipped":
        return "skipped"
    return "passed"


def cases_of(path):
    """(name, outcome) of every case in one file."""
    try:
        tree = ElementTree.parse(path)
    except (ElementTree.ParseError, OSError) as error:
        return [(f"{path.name}: {error}", "failed")]
    cases = []
    for case in tree.getroot().iter("testcase"):
        cases.append((f"{path.stem}: {case.get('classname')}.{case.get('name')}", outcome(case)))
    if cases:
        return cases
    # A result file without a case says nothing passed; with nothing counted as failed it would vanish silently.
    return [(f"{path.name}: no test case in it", "failed")]


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: count_results.py FOLDER")
    count = {"passed": 0, "failed": 0, "skipped": 0}
    for path in sorted(pathlib.Path(sys.argv[1]).rglob("*.xml")):
        for name, result in cases_of(path):
            count[result] += 1
            if result != "passed":
                print(f"{result}: {name}", file=sys.stderr)
    print(count["passed"], count["failed"], count["skipped"])


if __name__ == "__main__":
    main()
