#!/usr/bin/python3
"""Counts the test cases in a folder of result files (JUnit XML, as GoogleTest and rostest write them).

Prints one line "PASSED FAILED SKIPPED SECOND_TRIES" to stdout, and the failed and skipped cases by name to stderr, those
with second tries as well. A file that cannot be read counts as one failed case: a test that died while writing has not
passed. A second try is one that a test was granted because the machine stood still (test/support/second_try.h).
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


def second_tries_of(case):
    """How many a <testcase> was granted, or outside of all cases a <testsuite>; GoogleTest before 1.10 writes attributes."""
    properties = [child for child in case.findall("properties/property") if child.get("name") == "second_tries"]
    return sum(int(child.get("value")) for child in properties) + int(case.get("second_tries", 0))


def second_tries_in(path):
    """(class name, name, count) of every case, and every suite, in one file that was granted any."""
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, OSError):
        return []
    found = [(case.get("classname"), case.get("name"), second_tries_of(case)) for case in root.iter("testcase")]
    found += [(suite.get("name"), "(all)", second_tries_of(suite)) for suite in root.iter("testsuite")]
    return [one for one in found if one[2]]


def cases_in(path):
    """(class name, name, outcome) of every case in one file."""
    try:
        cases = [
            (case.get("classname"), case.get("name"), outcome(case))
            for case in ElementTree.parse(path).getroot().iter("testcase")
        ]
    except (ElementTree.ParseError, OSError) as error:
        return [(path.name, str(error), "failed")]
    # A result file without a case says that nothing passed; left out, it would vanish silently.
    return cases or [(path.name, "no test case in it", "failed")]


def only_sums_up(path, classname, name, result):
    """rostest adds one case per <test> tag to those the test program wrote itself (rosunit-NAME.xml).

    It says something of its own only when the program failed without saying why: died, ran out of time.
    """
    if classname != "rostest.runner.RosTest":
        return False
    details = path.with_name(f"rosunit-{name[len('test'):]}.xml")
    return result == "passed" or (details.exists() and any(case[2] == "failed" for case in cases_in(details)))


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: count_results.py FOLDER")
    count = {"passed": 0, "failed": 0, "skipped": 0}
    second_tries = 0
    for path in sorted(pathlib.Path(sys.argv[1]).rglob("*.xml")):
        for classname, name, tries in second_tries_in(path):
            second_tries += tries
            print(f"{tries} second tries: {path.stem}: {classname}.{name}", file=sys.stderr)
        for classname, name, result in cases_in(path):
            if only_sums_up(path, classname, name, result):
                continue
            count[result] += 1
            if result != "passed":
                print(f"{result}: {path.stem}: {classname}.{name}", file=sys.stderr)
    print(count["passed"], count["failed"], count["skipped"], second_tries)


if __name__ == "__main__":
    main()
