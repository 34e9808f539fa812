"""Which mutants the compiler refuses, by what it says."""
import pathlib
import re


class BuildFailed(Exception):
    """The tree does not build, and no mutant is the cause."""


def refusedBy(output, numbered, build, tree):
    """The numbers of the mutants in the lines of `output`; all of a file in which no line can be told. `build`: where it ran."""
    places = {}
    for number, edit in numbered:
        last = edit.line + edit.original.count("\n")
        for line in range(edit.line, last + 1):
            places.setdefault((edit.path, line + 1), []).append(number)  # + 1: the #include in line 1
    wrong, said = set(), set()
    for match in re.finditer(r"^(\S+?):(\d+):(?:\d+:)? (.*)$", output, re.M):
        path = pathlib.Path(build, match.group(1)).resolve()
        try:
            name = str(path.relative_to(pathlib.Path(tree).resolve()))
        except ValueError:
            continue
        said.add(name)
        if "warning:" not in match.group(3):
            wrong.update(places.get((name, int(match.group(2))), []))
    if not wrong:
        wrong.update(number for number, edit in numbered if edit.path in said)
    return wrong
