"""What earlier runs found, so that a run that was ended goes on, and a run after a change asks only what may have changed."""
import hashlib
import json
import os


class Results:
    """Kept in a file, a line for each mutant that was run; of two lines about one mutant the later one holds.

    A mutant that was found stays found as long as its source file stays as it is; a survivor stays one as long as nothing below
    src/ and test/ changes.
    """

    def __init__(self, path, root, names):
        self._path, self._root, self._known = path, root, {}
        self._hashes = {}
        whole = hashlib.sha1()
        for name in sorted(names):
            if name.startswith(("src/", "test/", "include/")):
                whole.update(self._hash(name).encode())
        self._state = whole.hexdigest()
        if os.path.exists(path):
            with open(path) as file:
                for line in file:
                    if line.endswith("\n"):
                        entry = json.loads(line)
                        self._known[entry["key"]] = entry

    def _hash(self, name):
        if name not in self._hashes:
            with open(os.path.join(self._root, name), "rb") as file:
                self._hashes[name] = hashlib.sha1(file.read()).hexdigest()
        return self._hashes[name]

    def of(self, edit, question):
        """What is known: "" for a survivor, otherwise how it was found; None when it has to be run."""
        entry = self._known.get(edit.key)
        if entry is None or entry["source"] != self._hash(edit.path):
            return None
        if entry["found"]:
            return entry["found"]
        return "" if entry["state"] == self._state and entry["question"] == question else None

    def keep(self, edit, question, found):
        entry = {"key": edit.key, "source": self._hash(edit.path), "state": self._state, "question": question, "found": found or ""}
        self._known[edit.key] = entry
        with open(self._path, "a") as file:
            file.write(json.dumps(entry) + "\n")
