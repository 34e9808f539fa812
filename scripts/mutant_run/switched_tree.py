"""A copy of the whole project in which each drawn mutant stands behind a switch, and the build of it."""
import pathlib
import shutil
import subprocess

from .refusals import BuildFailed, refusedBy
from .switch import HEADER, SOURCE, applied


class SwitchedTree:
    """The copy in `folder`/tree, built in tree/build/dev: as deep below its root as a build of the project is, for ccache."""

    def __init__(self, root, folder):
        self._root, self.tree = pathlib.Path(root), pathlib.Path(folder) / "tree"
        self.build = self.tree / "build" / "dev"

    def names(self):
        """The files of the project, those not yet committed included."""
        names = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=self._root, check=True,
                               capture_output=True, text=True).stdout.split("\n")
        return [name for name in names if name and (self._root / name).is_file()]

    def write(self, numbered):
        """The project's files, those with mutants changed. Files that stay the same keep their time."""
        names = self.names()
        by_path = {}
        for number, edit in numbered:
            by_path.setdefault(edit.path, []).append((number, edit))
        for name in names:
            content = (self._root / name).read_bytes()
            if name in by_path:
                content = applied(content.decode(), by_path[name]).encode()
            if name == "src/core/CMakeLists.txt":
                content += b"\ntarget_sources(nord_driver PRIVATE ${PROJECT_SOURCE_DIR}/src/nord_mutant.cpp)\n"
            self._put(name, content, (self._root / name).stat().st_mode)
        self._put("src/nord_mutant.h", HEADER.encode(), 0o644)
        self._put("src/nord_mutant.cpp", SOURCE.encode(), 0o644)
        self._removeOthers(set(names))

    def _put(self, name, content, mode):
        path = self.tree / name
        if path.is_file() and path.read_bytes() == content:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        path.chmod(mode)

    def _removeOthers(self, names):
        for part in ("src", "test"):
            for path in (self.tree / part).rglob("*"):
                name = str(path.relative_to(self.tree))
                if path.is_file() and name not in names and not name.startswith("src/nord_mutant."):
                    path.unlink()

    def configure(self, options):
        """CMake, once."""
        self.build.mkdir(parents=True, exist_ok=True)
        if (self.build / "build.ninja").exists() or (self.build / "Makefile").exists():
            return
        command = ["cmake", "-S", str(self.tree), "-B", str(self.build), "-DPYTHON_EXECUTABLE=/usr/bin/python3",
                   "-DNORD_DRIVER_PRECOMPILE=ON"] + options
        if shutil.which("ninja"):
            command += ["-G", "Ninja"]
        if shutil.which("ccache"):
            command.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise BuildFailed(done.stdout[-3000:] + done.stderr[-3000:])

    def make(self, targets, jobs, environment):
        """Builds; the output of the compiler when it failed, otherwise None."""
        goes_on = ["-k", "0"] if (self.build / "build.ninja").exists() else ["-k"]
        done = subprocess.run(["cmake", "--build", str(self.build), "-j", str(jobs), "--target"] + targets + ["--"] + goes_on,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
        (self.build.parent / "build.log").write_text(done.stdout)
        return done.stdout if done.returncode else None

    def refused(self, output, numbered):
        """The numbers of the mutants that the compiler refuses, by its output."""
        return refusedBy(output, numbered, self.build, self.tree)
