#!/usr/bin/python3
"""Compares what this project uses with what scripts/install_deps.sh installs.

Every Python import, find_package and find_library of CMake, #include <...>, node of a launch file and program called by a
script or shown in README is looked up on this machine. The Debian package it is from has to be one that install_deps.sh
lists, one those depend on (Recommends do not count), or one every Debian has. So this fails where a fresh machine would,
although this one happens to have more. What only scripts/test.sh and its like need may come from --list --test.

Ends with 0 when all is brought, otherwise with 1 and a line for each thing that is not.
"""
import argparse
import ast
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
OWN = "nord_driver"

# What only a machine that tests needs: these files may use what --test adds.
FOR_TESTS = (".ci/", "bench/", "fuzz/", "scripts/bench.sh", "scripts/build_deb.sh", "scripts/can_machine", "scripts/check_",
             "scripts/common.sh", "scripts/count_results.py", "scripts/fresh_debian.sh", "scripts/fuzz.sh", "scripts/mutant", "scripts/test",
             "test/link/modbus/pymodbus_server.py", "test/system/pymodbus_client.py")
# What a user is told to install himself.
LEFT_TO_THE_USER = {"node rviz/rviz", "program import"}
# Used where it is found; Debian has no package of it.
OPTIONAL = {"find_package(control_msgs)", "#include <control_msgs/JointTrajectoryControllerState.h>"}

# What stands before a command in a shell script, and may stand between.
BEFORE_A_COMMAND = r"(?:^|[;&|({`]|\$\(|\b(?:then|do|else|elif|if|while|until|exec|nice -n \d+|setsid|env -i|command -v|!)\s)"
ASSIGNMENTS = r"(?:\w+=(?:\"[^\"]*\"|'[^']*'|[^\s\"'(]*)\s+)*"
PROGRAM = r"([a-z_][\w.+-]*)(?=[\s;|&)\"'`]|$)"


class Use:
    """Something of another package, by the path it has on this machine (None: this machine has it not)."""

    def __init__(self, what, file, path):
        self.what, self.file, self.path = what, file, path
        self.for_tests = file.startswith(FOR_TESTS)


def run(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def files(*patterns):
    """(path below the project, text), in order."""
    found = sorted({path for pattern in patterns for path in ROOT.glob(pattern) if path.is_file()})
    return [(str(path.relative_to(ROOT)), path.read_text()) for path in found if not str(path.relative_to(ROOT)).startswith(("out", "build"))]


def first_of(patterns):
    """The first file that one of these absolute patterns finds."""
    for pattern in patterns:
        for path in sorted(pathlib.Path("/").glob(pattern.lstrip("/"))):
            if path.is_file():
                return str(path)
    return None


# --- Python ---


def module_path(name):
    """The file of a module; "" when it is a part of the interpreter."""
    if name.split(".")[0] in sys.builtin_module_names:
        return ""
    try:
        spec = importlib.util.find_spec(name)
    except ImportError:
        spec = None
    if spec is None:
        return module_path(name.rpartition(".")[0]) if "." in name else None
    if spec.origin == "frozen":
        return ""
    return spec.origin if spec.has_location else module_path(name.rpartition(".")[0]) if "." in name else None


def imports_of(source):
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module


def isBeside(file, package):
    """Whether the interpreter finds this module in the script's own folder, or in scripts as mutant_run does."""
    return any((folder / f"{package}.py").is_file() or (folder / package / "__init__.py").is_file()
               for folder in ((ROOT / file).parent, ROOT / "scripts"))


def python_uses():
    sources = files("scripts/**/*.py", "test/**/*.py", "cfg/*.cfg")
    for file, text in files("scripts/**/*.sh"):
        sources += [(file, snippet) for snippet in re.findall(r"python3 -c '([^']*)'", text)]
    for file, text in sources:
        for module in sorted(set(imports_of(text))):
            package = module.split(".")[0]
            if package == OWN or isBeside(file, package):
                continue
            path = module_path(module)
            if path != "":
                yield Use(f"import {module}", file, path)


# --- CMake and C++ ---


def config_path(package):
    """The description CMake finds the package by."""
    names = (f"{package}Config.cmake", f"{package.lower()}-config.cmake")
    folders = ("/usr/lib/*/cmake/{}*", "/usr/lib/cmake/{}*", "/usr/share/{}*/cmake", "/usr/share/cmake/{}*", "/usr/lib/*/{}*/cmake",
               "/usr/lib/{}*/cmake", "/usr/share/{}*")
    own = [f"{folder.format(package)}/{name}" for folder in folders for name in names]
    return first_of(own + [f"/usr/share/cmake-*/Modules/Find{package}.cmake"])


def cmake_uses():
    for file, text in files("CMakeLists.txt", "cmake/*.cmake", "bench/CMakeLists.txt", "fuzz/CMakeLists.txt",
                            "src/**/CMakeLists.txt", "test/**/CMakeLists.txt"):
        text = re.sub(r"#.*", "", text)
        for package, rest in re.findall(r"find_package\(\s*([\w-]+)([^)]*)\)", text):
            yield Use(f"find_package({package})", file, config_path(package))
            components = rest.partition("COMPONENTS")[2].split()
            for component in components:
                if component == "nord_driver":  # this package itself, for one that is built against it
                    continue
                name = f"boost_{component}" if package == "Boost" else component
                yield Use(f"find_package({package} {component})", file, config_path(name))
        for library in re.findall(r"find_library\(\s*\w+\s+([\w-]+)", text):
            yield Use(f"find_library({library})", file, first_of([f"/usr/lib/*/lib{library}.so", f"/usr/lib/*/lib{library}.a"]))


def include_folders():
    said = subprocess.run(["g++", "-E", "-v", "-x", "c++", "/dev/null"], check=True, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True).stderr
    listed = said.partition("#include <...> search starts here:")[2].partition("End of search list.")[0].split()
    return [folder for folder in listed if not folder.startswith("/usr/local")]


def include_uses():
    folders = include_folders()
    for file, text in files("include/**/*.h", "src/**/*.h", "src/**/*.cpp", "test/**/*.h", "test/**/*.cpp", "bench/*.*", "fuzz/*.*"):
        for header in sorted(set(re.findall(r"^\s*#\s*include\s*<([^>]+)>", text, re.M))):
            if not header.startswith(OWN + "/"):
                # A library may have a folder of its own there, and say so to CMake.
                places = [f"{folder}/{header}" for folder in folders] + [f"/usr/include/*/{header}"]
                yield Use(f"#include <{header}>", file, first_of(places))


# --- Programs ---


def commands_of(script):
    """The programs a shell script calls, as far as a glance tells."""
    script = re.sub(r"<<-?\s*'?(\w+)'?.*?^\s*\1$", "", script, flags=re.M | re.S)
    script = re.sub(r"(^|\s)#.*", "", script)
    script = re.sub(r"\w*packages=\([^)]*\)", "", script)
    found = set(re.findall(BEFORE_A_COMMAND + r"\s*" + ASSIGNMENTS + PROGRAM, script, re.M))
    found |= set(re.findall(r"\bxargs(?:\s+-\S+(?:\s+(?:\d+|\"\$\w+\"))?)*\s+" + PROGRAM, script))
    found |= set(re.findall(r"COMPILER=" + PROGRAM, script))
    found |= set(re.findall(r"\btimeout (?:--\S+ )*(?:\"[^\"]*\"|\S+) \\?\s*" + PROGRAM, script))
    for words in re.findall(r"\bfor \w+ in ([^;$]*);", script):
        found |= set(words.split())
    return {word for word in found if not re.search(rf"^\s*{re.escape(word)}\(\)", script, re.M)}


def program_path(name):
    return shutil.which(name, path="/usr/bin:/bin:/usr/sbin:/sbin")


def program_uses():
    for file, text in files("scripts/**/*.sh", ".ci/*"):
        for name in sorted(commands_of(text)):
            path = program_path(name)
            if path:  # no program here: a word of the shell, or an argument
                yield Use(f"program {name}", file, path)
    for file, text in files("scripts/**/*", ".ci/*"):
        interpreter = re.match(r"#!(?:/usr/bin/env )?(\S+)", text)
        if interpreter:
            yield Use(f"program {interpreter[1]}", file, program_path(pathlib.Path(interpreter[1]).name))
    for file, text in files("README.md"):
        for block in re.findall(r"^```\n(.*?)^```$", text, re.M | re.S):
            for name in sorted(set(re.findall(r"(?:^|&& )((?:ros|catkin_)\w*)", block, re.M))):
                yield Use(f"program {name}", file, program_path(name))


def launch_uses():
    for file, text in files("launch/*.launch", "test/**/*.launch", "test/**/*.test"):
        for element in re.findall(r"<(?:node|test)\s[^>]*>", text):
            package = re.search(r'\bpkg="([^"]+)"', element)
            kind = re.search(r'\btype="([^"]+)"', element)
            if package and kind and package[1] != OWN:
                yield Use(f"node {package[1]}/{kind[1]}", file,
                          first_of(f"{place}/{package[1]}/{kind[1]}" for place in ("/usr/lib", "/usr/share")))


# --- Debian ---


class Packages:
    """What dpkg knows of this machine."""

    def __init__(self):
        self._depends, self._providers, self._everywhere = {}, {}, set()
        form = "${Package}\t${db:Status-Status}\t${Essential}\t${Priority}\t${Provides}\t${Pre-Depends}, ${Depends}\n"
        for line in run("dpkg-query", "-W", "-f", form).splitlines():
            name, status, essential, priority, provides, depends = line.split("\t")
            if status != "installed":
                continue
            self._depends[name] = [[self._bare(one) for one in group.split("|")] for group in depends.split(",") if group.strip()]
            for provided in filter(None, provides.split(",")):
                self._providers.setdefault(self._bare(provided), set()).add(name)
            if essential == "yes" or priority == "required" or name == "apt":
                self._everywhere.add(name)

    @staticmethod
    def _bare(name):
        return re.match(r"\s*([^\s:(]+)", name)[1]

    def brought_by(self, names):
        """These packages, what they depend on, and what every Debian has."""
        brought, waiting = set(), list(names) + list(self._everywhere)
        while waiting:
            name = waiting.pop()
            if name in brought:
                continue
            brought.add(name)
            if name not in self._depends:  # virtual
                waiting += self._providers.get(name, ())
                continue
            for group in self._depends[name]:
                # apt takes the first it can have.
                waiting += [one for one in group if one in self._depends or one in self._providers][:1]
        return brought

    def owners(self, paths):
        """The packages of each of these files."""
        asked = {}
        for path in paths:
            real = str(pathlib.Path(path).resolve())
            # dpkg knows a file by the name it was packed under, /bin being a link to /usr/bin or not.
            for name in {path, real, path.replace("/usr/", "/", 1), real.replace("/usr/", "/", 1), "/usr" + path, "/usr" + real}:
                asked.setdefault(name, set()).add(path)
        said = subprocess.run(["dpkg", "-S", *asked], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                              check=False).stdout
        owners = {path: set() for path in paths}
        for line in said.splitlines():
            names, _, path = line.rpartition(": ")
            if line.startswith("diversion by"):
                continue
            for asker in asked.get(path, ()):
                owners[asker] |= {name.partition(":")[0].strip() for name in names.split(",")}
        return owners


def listed(*arguments):
    return run(str(ROOT / "scripts" / "install_deps.sh"), "--list", *arguments).split()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--without", action="append", default=[], metavar="PACKAGE", help="as if it were not listed")
    options = parser.parse_args()
    # Only what Debian's packages bring counts, and nothing of the folder this is called from.
    sys.path = [folder for folder in sys.path[1:] if folder.startswith("/usr/lib/")]
    packages = Packages()
    brought = {
        for_tests: packages.brought_by(set(listed(*(["--test"] if for_tests else []))) - set(options.without))
        for for_tests in (False, True)
    }
    uses = [use for part in (python_uses, cmake_uses, include_uses, program_uses, launch_uses) for use in part()
            if use.what not in LEFT_TO_THE_USER | OPTIONAL]
    owners = packages.owners(sorted({use.path for use in uses if use.path}))
    wrong = []
    for use in uses:
        command = "install_deps.sh --list" + (" --test" if use.for_tests else "")
        if use.path is None:
            wrong.append(f"{use.file}: {use.what}: this machine does not have it, expected a package of {command}")
        elif not owners[use.path]:
            wrong.append(f"{use.file}: {use.what}: {use.path} is of no Debian package")
        elif not owners[use.path] & brought[use.for_tests]:
            names = ", ".join(sorted(owners[use.path]))
            wrong.append(f"{use.file}: {use.what}: it is in {names}, which no package of {command} brings")
    for line in wrong:
        print(line)
    kinds = {use.what for use in uses}
    print(f"{len(kinds)} imports, packages, headers, programs and nodes in {len({use.file for use in uses})} files: "
          f"{len(wrong)} not brought by install_deps.sh")
    return 1 if wrong or not uses else 0


if __name__ == "__main__":
    sys.exit(main())
