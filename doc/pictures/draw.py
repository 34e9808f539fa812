#!/usr/bin/python3
"""Draws doc/pictures/*.svg, each from the Python file of the same name beside it.

--check: writes nothing, and ends with 1 when a file is not what its source draws, has no source, or no document shows it.
"""
import argparse
import importlib
import pathlib
import sys

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
HELPERS = ("draw", "svg")


def names():
    return sorted(path.stem for path in HERE.glob("*.py") if path.stem not in HELPERS)


def unlike(name, drawn):
    """What is wrong with the file of this picture; empty when nothing is."""
    path = HERE / f"{name}.svg"
    if not path.is_file():
        return f"{path.name} is missing: scripts/draw_pictures.sh draws it"
    if path.read_text(encoding="utf-8") != drawn:
        return f"{path.name} is not what {name}.py draws: scripts/draw_pictures.sh draws it anew"
    return ""


def not_shown():
    """Pictures that no document shows."""
    root = HERE.parent.parent
    documents = "".join(path.read_text(encoding="utf-8") for path in [root / "README.md", *sorted((root / "doc").glob("*.md"))])
    for path in sorted(HERE.iterdir()):
        if path.suffix in (".svg", ".png") and f"pictures/{path.name}" not in documents:
            yield f"{path.name}: no document shows it"


def of_a_run(path):
    """Drawn by nord_param scope from the values beside it; a test of the tools compares these two."""
    return path.with_suffix(".csv").is_file()


def check(drawn):
    wrong = [unlike(name, text) for name, text in drawn.items()]
    wrong += [f"{path.name} has no source {path.stem}.py" for path in sorted(HERE.glob("*.svg"))
              if path.stem not in drawn and not of_a_run(path)]
    return [one for one in wrong if one] + list(not_shown())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    options = parser.parse_args()
    sys.path.insert(0, str(HERE))
    problem = importlib.import_module("svg").Problem
    drawn, wrong = {}, []
    for name in names():
        try:
            drawn[name] = importlib.import_module(name).draw().svg()
        except problem as error:
            wrong.append(str(error))
    if options.check:
        wrong += check(drawn)
    else:
        for name, text in drawn.items():
            (HERE / f"{name}.svg").write_text(text, encoding="utf-8")
    for line in wrong:
        print(line)
    print(f"{len(drawn)} pictures{' compared' if options.check else ' drawn'}, {len(wrong)} problems")
    return 1 if wrong or not drawn else 0


if __name__ == "__main__":
    sys.exit(main())
