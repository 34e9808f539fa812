"""Survivors that a reader judged: an edit after which the program does the same. Each has a reason.

The file is YAML of one form, read here without a YAML library: a list of entries with the keys file, code, edit, occurrence
(1 when left out) and reason, each on a line of its own, values plain or in single quotes. `code` is the line of the source without
its indentation: an entry goes on holding when lines move, and ends when the line itself changes.
"""
import re

from yaml_line import valueOf

KEYS = ("file", "code", "edit", "occurrence", "reason")


def readEquivalents(path):
    """{key of the edit: reason}."""
    entries = []
    with open(path) as file:
        for number, line in enumerate(file, 1):
            if not line.strip() or line.lstrip().startswith("#"):
                continue
            match = re.fullmatch(r"(- |  )(\w+): (.+)", line.rstrip("\n"))
            if not match or match.group(2) not in KEYS:
                raise ValueError(f"{path}:{number}: '{line.strip()}': expected '- file: ...' or one of {', '.join(KEYS)}")
            if match.group(1) == "- ":
                entries.append({"line": number})
            if not entries:
                raise ValueError(f"{path}:{number}: the first entry has to begin with '- file: ...'")
            entries[-1][match.group(2)] = valueOf(match.group(3).strip(), f"{path}:{number}")
    found = {}
    for entry in entries:
        missing = [key for key in ("file", "code", "edit", "reason") if not entry.get(key)]
        if missing:
            raise ValueError(f"{path}:{entry['line']}: this entry has no {', '.join(missing)}")
        key = "|".join([entry["file"], entry["code"], entry["edit"], entry.get("occurrence", "1")])
        if key in found:
            raise ValueError(f"{path}:{entry['line']}: this entry stands there twice")
        found[key] = entry["reason"]
    return found


def entryOf(edit):
    """The lines to paste into the file for an edit, its reason left to the reader."""
    def quoted(value):
        return "'" + value.replace("'", "''") + "'"
    lines = [f"- file: {edit.path}", f"  code: {quoted(edit.code)}", f"  edit: {quoted(edit.what)}"]
    if edit.occurrence != 1:
        lines.append(f"  occurrence: {edit.occurrence}")
    return "\n".join(lines)
