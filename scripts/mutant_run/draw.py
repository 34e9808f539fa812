"""Draws mutants by seed: the kinds of edit in turn, so that the few masks are drawn as well as the many comparisons."""
import pathlib
import random

from .edits import editsOf


def editsBelow(root, folder, suffixes=(".cpp", ".h")):
    """All edits of src/`folder` in files with one of the suffixes, in order of file and place."""
    found = []
    for path in sorted(pathlib.Path(root, "src", folder).rglob("*")):
        if path.suffix in suffixes:
            found += editsOf(str(path.relative_to(root)), path.read_text())
    return found


def drawn(edits, count, seed, folder):
    """`count` of them, none within another one. A larger count of the same seed begins with the same ones."""
    chance = random.Random(f"{seed} {folder}")
    by_kind = {}
    for edit in edits:
        by_kind.setdefault(edit.kind, []).append(edit)
    kinds = sorted(by_kind)
    chance.shuffle(kinds)
    for kind in kinds:
        chance.shuffle(by_kind[kind])
    taken = {}
    chosen = []
    while len(chosen) < count and any(by_kind.values()):
        for kind in kinds:
            while by_kind[kind] and len(chosen) < count:
                edit = by_kind[kind].pop()
                others = taken.setdefault(edit.path, [])
                if any(edit.start < end and start < edit.end for start, end in others):
                    continue
                others.append((edit.start, edit.end))
                chosen.append(edit)
                break
    return chosen
