"""The mutated sources alone, in a library that is loaded before the driver's: every function of such a source is called in this
one, so the test programs of a build that is there already are used as they are. No mutants in headers: tests hold what those say.
"""
import concurrent.futures
import hashlib
import json
import pathlib
import re
import shlex
import subprocess

from .refusals import BuildFailed, refusedBy
from .switch import HEADER, SOURCE, applied


def commandsBySource(entries, root):
    """{path below `root`: its entry of compile_commands.json}, for what is below src/. Of a source that is merged with others
    (NORD_DRIVER_MERGE_SOURCES) it is the entry of the file that CMake made of them.
    """
    commands = {}
    for entry in entries:
        file = pathlib.Path(entry["file"])
        merged = re.findall(r'^#include "(.+\.cpp)"$', file.read_text(), re.M) if file.parent.name == "Unity" else []
        for source in map(pathlib.Path, merged or [file]):
            if root / "src" in source.parents:
                commands.setdefault(str(source.relative_to(root)), entry)
    return commands


class PreloadedSources:
    """Compiled as the build in `build` compiles them (its compile_commands.json), in `folder`/sources."""

    def __init__(self, root, folder, build):
        self._root, self.tree, self.build = pathlib.Path(root), pathlib.Path(folder) / "sources", pathlib.Path(build)
        self.library = self.tree / "libnord_mutants.so"
        self._numbered, self._changed = [], set()

    def names(self):
        """The files below src/, test/ and include/."""
        return [str(path.relative_to(self._root)) for part in ("src", "test", "include")
                for path in (self._root / part).rglob("*") if path.is_file()]

    def write(self, numbered):
        """The sources with their mutants. Those that stay the same are not compiled again."""
        by_path = {}
        for number, edit in numbered:
            by_path.setdefault(edit.path, []).append((number, edit))
        texts = {path: applied((self._root / path).read_text(), pairs) for path, pairs in by_path.items()}
        texts.update({"nord_mutant.h": HEADER, "nord_mutant.cpp": SOURCE})
        for path, text in texts.items():
            file = self.tree / path
            file.parent.mkdir(parents=True, exist_ok=True)
            if not file.is_file() or file.read_text() != text:
                file.write_text(text)
                self._changed.add(path)
        self._sources = sorted(by_path)

    def configure(self, options):
        """Reads how sources are compiled."""
        path = self.build / "compile_commands.json"
        if not path.is_file():
            raise BuildFailed(f"{path} is missing: build the tests there with -DCMAKE_EXPORT_COMPILE_COMMANDS=ON first")
        self.configureFor(commandsBySource(json.loads(path.read_text()), self._root))

    def configureFor(self, commands):
        """`commands`: entries of compile_commands.json by the source's path."""
        self._commands = commands

    def _command(self, path):
        entry = self._commands[path]
        words = shlex.split(entry["command"])
        words[words.index("-o") + 1] = str(self._object(path))
        words[words.index("-c") + 1] = str(self.tree / path)  # itself, also where it is one of several that are merged
        for flag in ("-MT", "-MF"):
            if flag in words:
                del words[words.index(flag):words.index(flag) + 2]
        return [word for word in words if word not in ("-MD", "-Werror")] + ["-I", str(self.tree)], entry["directory"]

    def _object(self, path):
        return self.tree / (path + ".o")

    def forgetOthers(self):
        """Removes objects of other headers, or of another command: they are of another driver than the test programs."""
        whole = hashlib.sha1(json.dumps(self._commands, sort_keys=True).encode())
        for name in sorted(self.names()):
            if name.endswith(".h"):
                whole.update(name.encode() + (self._root / name).read_bytes())
        stamp = self.tree / "headers.sha1"
        if not stamp.is_file() or stamp.read_text() != whole.hexdigest():
            for made in self.tree.rglob("*.o"):
                made.unlink()
            stamp.write_text(whole.hexdigest())

    def make(self, targets, jobs, environment):
        """The output of the compiler when it failed, otherwise None."""
        for name in targets:
            if not (self.build / "devel" / "lib" / "nord_driver" / name).is_file():
                raise BuildFailed(f"{name} is not built in {self.build}")

        def compiled(path):
            if self._object(path).is_file() and path not in self._changed:
                return ""
            command, directory = self._command(path)
            done = subprocess.run(command, cwd=directory, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  env=environment)
            if done.returncode:
                self._object(path).unlink(missing_ok=True)
                return done.stdout
            self._changed.discard(path)
            return ""
        self.forgetOthers()
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            output = "".join(pool.map(compiled, self._sources))
        if output:
            return output
        done = subprocess.run(["g++", "-std=c++17", "-O1", "-fPIC", "-shared", "-o", str(self.library), str(self.tree / "nord_mutant.cpp")] +
                              [str(self._object(path)) for path in self._sources], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            raise BuildFailed(done.stdout[-3000:])
        return None

    def refused(self, output, numbered):
        """The numbers of the mutants that the compiler refuses, by its output."""
        return refusedBy(output, numbered, self.build, self.tree)
