#!/usr/bin/python3
"""Small edits in the driver's source, one at a time: does a test notice each of them?

Every drawn edit is put behind a switch (NORD_MUTANT=number) and all are built once: the whole project with them, copied to
build/mutants/tree; or, with --build FOLDER, only the changed sources, in a library loaded before the driver's own, and the test
programs are those built there. Every test program is run once without a mutant to learn which test reaches which. Then each mutant is on in turn while the tests that
reach it run: those of its folder first, the system tests last. Found is what a test fails on, crashes by, or never ends with. Prints
a score for each folder, and the survivors. What was found stays in build/mutants/results.jsonl: a run that was ended goes on.

Ends with 0 when every folder has its goal, 1 when one has not, 2 when nothing could be run.
"""
import argparse
import concurrent.futures
import os
import pathlib
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from mutant_run.draw import drawn, editsBelow  # noqa: E402
from mutant_run.equivalents import entryOf, readEquivalents  # noqa: E402
from mutant_run.folders import FOLDERS, GOALS, programsOf  # noqa: E402
from mutant_run.preloaded import PreloadedSources  # noqa: E402
from mutant_run.programs import Program  # noqa: E402
from mutant_run.refusals import BuildFailed  # noqa: E402
from mutant_run.results import Results  # noqa: E402
from mutant_run.switched_tree import SwitchedTree  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
EQUIVALENTS = ROOT / "test" / "mutants" / "equivalent.yaml"
BUILD_OPTIONS = ["-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g0 -fpch-preprocess", "-DNORD_DRIVER_TEST_OPTIONS=-O0"]
ROUNDS = 8


def say(text):
    print(text, flush=True)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seed", default="1", help="which mutants are drawn (1)")
    parser.add_argument("--count", type=int, default=280, help="how many in all, the same number in each folder (280)")
    parser.add_argument("--folder", action="append", choices=sorted(FOLDERS), help="only this one below src/; may be given again")
    parser.add_argument("--only", action="append", metavar="ID", help="only this mutant, drawn or not, and not by what is known of it")
    parser.add_argument("--units", action="store_true", help="ask the unit tests only")
    parser.add_argument("--program", action="append", metavar="NAME", help="ask only this test program; may be given again")
    parser.add_argument("--build", metavar="FOLDER", help="use the test programs built there, and draw from the .cpp files only")
    parser.add_argument("--seconds", type=float, default=60, help="most seconds of tests, as measured, of a program for a mutant (60)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="mutants at a time (one for each processor)")
    parser.add_argument("--list", action="store_true", help="print what would be drawn, and end")
    parser.add_argument("--fresh", action="store_true", help="forget what earlier runs found")
    parser.add_argument("--configure", action="append", default=[], metavar="OPTION", help="an option for CMake, after the script's own")
    parser.add_argument("--self-test", action="store_true", help="is a mutant that must be found found, and one that cannot be not?")
    return parser.parse_args()


def choose(asked, folders):
    """[(folder, edit)]"""
    chosen = []
    for folder in folders:
        edits = editsBelow(ROOT, folder, (".cpp",) if asked.build else (".cpp", ".h"))
        if asked.only:
            chosen += [(folder, edit) for edit in edits if edit.id in asked.only]
        else:
            chosen += [(folder, edit) for edit in drawn(edits, asked.count // len(FOLDERS), asked.seed, folder)]
    return chosen


def built(tree, chosen, targets, asked):
    """[(number, folder, edit)] of those the compiler takes; says which it refuses."""
    numbered = [(number, folder, edit) for number, (folder, edit) in enumerate(chosen, 1)]
    for _ in range(ROUNDS):
        pairs = [(number, edit) for number, _, edit in numbered]
        tree.write(pairs)
        tree.configure(BUILD_OPTIONS + asked.configure)
        output = tree.make(targets, asked.jobs, dict(os.environ, CCACHE_BASEDIR=str(tree.tree), CCACHE_NOHASHDIR="1"))
        if output is None:
            return numbered
        refused = tree.refused(output, pairs)
        if not refused:
            raise BuildFailed(output[-5000:])
        for number, folder, edit in numbered:
            if number in refused:
                say(f"  not compilable, left out: {edit.id} {edit.path}:{edit.line}: {edit.what}: {edit.code[:90]}")
        numbered = [entry for entry in numbered if entry[0] not in refused]
    raise BuildFailed(f"still refused by the compiler after {ROUNDS} rounds: {output[-3000:]}")


def measured(tree, names, folder):
    programs = {}
    for name in names:
        started = time.monotonic()
        library = getattr(tree, "library", None)
        program = Program(str(tree.build / "devel" / "lib" / "nord_driver" / name), str(library) if library else None)
        program.measure(folder)
        programs[name] = program
        say(f"  {name}: {len(program.times)} tests, {time.monotonic() - started:.1f} s without a mutant" +
            (f"; left out, they fail without one: {', '.join(program.left_out)}" if program.left_out else ""))
    return programs


class Run:
    """The mutants, several at a time; each says how it ended."""

    def __init__(self, asked, programs, results):
        self._asked, self._programs, self._results = asked, programs, results
        self._lock = threading.Lock()
        self.shortened = 0

    def question(self, folder):
        return f"{' '.join(self._names(folder))} {self._asked.seconds}"

    def _names(self, folder):
        units, systems = FOLDERS[folder]
        return [name for name in (units if self._asked.units else units + systems) if name in self._programs]

    def one(self, number, folder, edit):
        """How it was found, "" when it was not."""
        question = self.question(folder)
        known = None if self._asked.only else self._results.of(edit, question)
        if known is not None:
            return known
        reached = False
        for name in self._names(folder):
            tests, left_out = self._programs[name].testsFor(number, self._asked.seconds)
            reached = reached or bool(tests)
            self.shortened += 1 if left_out else 0
            found = self._programs[name].tells(number, tests) if tests else None
            if found:
                break
        else:
            found = ""
        with self._lock:
            self._results.keep(edit, question, found)
            where = f"{edit.id} {edit.path}:{edit.line}: {edit.what}: {edit.code[:90]}"
            say(f"  found     {where}  [{found}]" if found else
                f"  SURVIVED  {where}{'' if reached else '  [no test reaches it]'}")
        return found


def table(numbered, found, equivalents, refused, folders):
    """Prints the scores and the survivors; True when every goal is met."""
    met = True
    say(f"\n{'folder':12} {'drawn':>6} {'refused':>8} {'equivalent':>11} {'found':>6} {'survived':>9} {'score':>7} {'goal':>6}")
    survivors = []
    for folder in folders:
        own = [edit for _, where, edit in numbered if where == folder]
        same = [edit for edit in own if not found[edit.id] and edit.key in equivalents]
        left = [edit for edit in own if not found[edit.id] and edit.key not in equivalents]
        kills = len(own) - len(same) - len(left)
        score = 100.0 * kills / (kills + len(left)) if kills + len(left) else 0.0  # none judged shows nothing
        met = met and score >= GOALS[folder]
        survivors += left
        say(f"{folder:12} {len(own) + refused[folder]:6} {refused[folder]:8} {len(same):11} {kills:6} {len(left):9} {score:6.1f}%"
            f" {GOALS[folder]:5}%")
        for edit in own:
            if found[edit.id] and edit.key in equivalents:
                say(f"  named equivalent, and found all the same: {edit.id} {edit.path}:{edit.line} [{found[edit.id]}]")
    if survivors:
        say("\nSurvivors, as test/mutants/equivalent.yaml names them:")
    for edit in survivors:
        say(f"# {edit.id} {edit.path}:{edit.line}: {edit.inWords()}")
        say(entryOf(edit))
    return met


def main():
    asked = arguments()
    os.environ["PATH"] = "/usr/bin:/bin:/usr/sbin:/sbin:" + os.environ.get("PATH", "")
    if asked.self_test:
        from mutant_run.self_test import selfTest
        return selfTest(say)
    folders = [folder for folder in FOLDERS if not asked.folder or folder in asked.folder]
    chosen = choose(asked, folders)
    if asked.only:
        folders = [folder for folder in folders if any(where == folder for where, _ in chosen)]
    unknown = [name for name in asked.only or [] if all(edit.id != name for _, edit in chosen)]
    if unknown or not chosen:
        say(f"no mutant with the id {' or '.join(unknown)}" if unknown else "no mutants")
        return 2
    if asked.list:
        for folder, edit in chosen:
            say(f"{edit.id} {edit.path}:{edit.line} {edit.kind}: {edit.inWords()}")
        return 0
    equivalents = readEquivalents(EQUIVALENTS)
    out = ROOT / "build" / "mutants"
    out.mkdir(parents=True, exist_ok=True)
    if asked.fresh and (out / "results.jsonl").exists():
        (out / "results.jsonl").unlink()
    started = time.monotonic()
    tree = PreloadedSources(ROOT, out, pathlib.Path(asked.build).resolve()) if asked.build else SwitchedTree(ROOT, out)
    names = [name for name in programsOf(folders, asked.units) if not asked.program or name in asked.program]
    say(f"{len(chosen)} mutants of seed {asked.seed}, {len(folders)} folders, {len(names)} test programs")
    try:
        numbered = built(tree, chosen, names, asked)
    except BuildFailed as failure:
        say(f"the copy does not build: {failure}")
        return 2
    say(f"built after {time.monotonic() - started:.0f} s")
    with tempfile.TemporaryDirectory() as folder:
        programs = measured(tree, names, folder)
    results = Results(str(out / "results.jsonl"), ROOT, tree.names())
    run = Run(asked, programs, results)
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        answers = list(pool.map(lambda entry: run.one(*entry), numbered))
    found = {entry[2].id: answer for entry, answer in zip(numbered, answers)}
    refused = {folder: sum(where == folder for where, _ in chosen) - sum(where == folder for _, where, _ in numbered) for folder in folders}
    met = table(numbered, found, equivalents, refused, folders)
    if run.shortened:
        say(f"\n{run.shortened} times not all tests of a program that reach a mutant were run: --seconds {asked.seconds:.0f}")
    say(f"{time.monotonic() - started:.0f} s in all")
    return 0 if met else 1


if __name__ == "__main__":
    sys.exit(main())
