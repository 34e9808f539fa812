"""The script tried on a program of a few lines: a mutant a test must find, and one no test can, and what it reads and writes."""
import pathlib
import subprocess
import tempfile

from .cpp_tokens import tokens
from .draw import drawn
from .edits import editsOf
from .equivalents import entryOf, readEquivalents
from .preloaded import PreloadedSources, commandsBySource
from .programs import Program
from .switch import HEADER, SOURCE, applied

LIMIT = """\
// Judges a temperature: `n < 7` in a comment is no code.
#include "limit.h"

constexpr int kHighest = 80;

bool tooHot(int degrees) {
  if (degrees > kHighest) return true;
  for (int i = 0; i != degrees; ++i) {
    if (i > 1000) return true;
  }
  return false;
}

int waits(int seconds) {
  while (seconds > 0) seconds -= 1;
  return seconds;
}

template <typename T, int Size = 3>
T larger(T a, T b) {
  const char* text = "a < b";
  return a < b && text != nullptr ? b : a;
}

int nobodyCalls(int a) { return larger(a, 1 + a); }
"""

TESTS = """\
#include "limit.h"

#include <gtest/gtest.h>

TEST(Limit, IsEighty) {
  EXPECT_FALSE(tooHot(80));
  EXPECT_TRUE(tooHot(81));
}
TEST(Limit, EndsWaiting) { EXPECT_EQ(0, waits(3)); }
TEST(Limit, FailsAlways) { EXPECT_TRUE(false); }
"""


class _Check:
    def __init__(self, say):
        self._say, self.wrong = say, 0

    def that(self, holds, what):
        self.wrong += not holds
        self._say(f"  {'ok    ' if holds else 'WRONG '} {what}")


def selfTest(say):
    """0 when all holds, otherwise 1."""
    check = _Check(say)
    edits = editsOf("src/limit.cpp", LIMIT)
    _edits(check, edits)
    _equivalents(check, edits)
    _draw(check, edits)
    _objects(check)
    _commands(check)
    _run(check, edits)
    return 1 if check.wrong else 0


def _one(edits, code, what):
    found = [edit for edit in edits if code in edit.code and edit.what == what]
    assert len(found) == 1, f"{len(found)} edits '{what}' of '{code}'"
    return found[0]


def _edits(check, edits):
    hot = _one(edits, "if (degrees > kHighest)", "> -> >=")
    check.that((hot.original, hot.mutated) == ("degrees > kHighest", "degrees >= kHighest"), "a comparison with its operands")
    check.that(hot.line == 7, "its line")
    both = _one(edits, "return a < b &&", "&& -> ||")
    check.that(both.original == "a < b && text != nullptr", "the operands of && end at ?")
    check.that(_one(edits, "constexpr int kHighest", "80 -> 81").form == "constant", "a constant's value")
    check.that(not any("in a comment" in edit.code or "Size = 3" in edit.code for edit in edits),
               "nothing in comments and templates' parameters")
    check.that(not any('"' in edit.original for edit in edits if edit.kind == "compare"), "nothing in strings")
    moved = editsOf("src/limit.cpp", "\n\n" + LIMIT)
    check.that([edit.id for edit in moved] == [edit.id for edit in edits], "ids stay when lines move")
    parens = [token for token in tokens("int f(int a) { return g(a, [a] { return a > 1; }); }") if token.text == ">"]
    check.that(parens[0].scope.kind == "block", "the body of a lambda is code")


def _equivalents(check, edits):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "equivalent.yaml")
        edit = _one(edits, "if (degrees > kHighest)", "> -> >=")
        path.write_text("# why\n" + entryOf(edit) + "\n  reason: it's ''quoted''\n")
        check.that(readEquivalents(path) == {edit.key: "it's ''quoted''"}, "the file of equivalents is read as it is written")
        path.write_text(entryOf(edit) + "\n")
        try:
            readEquivalents(path)
            check.that(False, "an entry without a reason is refused")
        except ValueError as error:
            check.that("reason" in str(error), "an entry without a reason is refused")


def _draw(check, edits):
    few, many = drawn(edits, 5, "1", "x"), drawn(edits, 8, "1", "x")
    check.that(len(few) == 5 and [edit.id for edit in many[:5]] == [edit.id for edit in few], "a larger draw begins as a smaller one")
    overlap = [(a, b) for a in many for b in many if a is not b and a.start < b.end and b.start < a.end]
    check.that(not overlap, "none is drawn within another")


def _objects(check):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        header, made = root / "include" / "limit.h", root / "out" / "sources" / "limit.cpp.o"
        for file in (header, made):
            file.parent.mkdir(parents=True)
            file.write_text("")
        objects = PreloadedSources(root, root / "out", root)
        objects.configureFor({})
        objects.forgetOthers()
        check.that(not made.is_file(), "objects of headers that nobody has noted are made anew")
        made.write_text("")
        objects.forgetOthers()
        check.that(made.is_file(), "those of the same headers are kept")
        header.write_text("struct Larger {};")
        objects.forgetOthers()
        check.that(not made.is_file(), "those of other headers are made anew: they are of another driver than the tests")
        made.write_text("")
        objects.configureFor({"limit.cpp": {"command": "g++ -O2"}})
        objects.forgetOthers()
        check.that(not made.is_file(), "those of another command, too")


def _commands(check):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        merged = root / "out" / "Unity" / "unity_0_cxx.cxx"
        merged.parent.mkdir(parents=True)
        merged.write_text(f'#include "{root}/src/a.cpp"\n\n#include "{root}/src/b.cpp"\n')
        entries = [{"file": str(merged), "command": "merged"}, {"file": f"{root}/src/c.cpp", "command": "alone"},
                   {"file": f"{root}/test/c.cpp", "command": "a test"}]
        commands = {path: entry["command"] for path, entry in commandsBySource(entries, root).items()}
        check.that(commands == {"src/a.cpp": "merged", "src/b.cpp": "merged", "src/c.cpp": "alone"},
                   "sources are found alone and merged with others, tests are not")


def _run(check, edits):
    chosen = [(1, _one(edits, "if (degrees > kHighest)", "> -> >=")),
              (2, _one(edits, "if (i > 1000)", "> -> >=")),
              (3, _one(edits, "while (seconds > 0)", "dropped")),
              (4, _one(edits, "int nobodyCalls", "+ -> -")),
              (5, _one(edits, "constexpr int kHighest", "80 -> 81"))]
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        files = {"limit.h": "#pragma once\nbool tooHot(int degrees);\nint waits(int seconds);\n", "tests.cpp": TESTS,
                 "limit.cpp": applied(LIMIT, chosen), "nord_mutant.h": HEADER, "nord_mutant.cpp": SOURCE}
        for name, text in files.items():
            (root / name).write_text(text)
        subprocess.run(["g++", "-std=c++17", "-o", "test_limit", "limit.cpp", "tests.cpp", "nord_mutant.cpp",
                        "-lgtest", "-lgtest_main", "-pthread"], cwd=root, check=True)
        program = Program(str(root / "test_limit"))
        program.measure(folder)
        check.that(program.left_out == ["Limit.FailsAlways"], "a test that fails without a mutant is left out")

        def told(number):
            tests, _ = program.testsFor(number, 60)
            return program.tells(number, tests) if tests else None
        check.that(told(1) == "test_limit: Limit.IsEighty", "a mutant a test must find is found, by that test")
        check.that(told(5) == "test_limit: Limit.IsEighty", "a changed constant too")
        check.that(program.testsFor(2, 60)[0] == ["Limit.IsEighty"] and told(2) is None, "a mutant nobody can see survives")
        check.that(told(3) == "test_limit: does not end", "a program that does not end has found its mutant")
        check.that(program.testsFor(4, 60)[0] == [], "no test reaches what nobody calls")
