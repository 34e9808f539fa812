"""A test program run with one mutant on: which tests reach it, how long each takes, and whether one of them tells."""
import json
import os
import re
import resource
import signal
import subprocess
import tempfile

MEMORY = 6 << 30


class Program:
    """One GoogleTest program. `times` is seconds of each test without a mutant, `reach` the tests that reach a mutant."""

    def __init__(self, path, preloaded=None):
        """`preloaded`: a library loaded before those of the program."""
        self.path, self.name, self._preloaded = path, os.path.basename(path), preloaded
        self.times, self.reach, self.left_out = {}, {}, []

    def measure(self, folder):
        """Every test without a mutant. A test that fails even so is left out of all that follows."""
        reached, report = os.path.join(folder, self.name + ".reached"), os.path.join(folder, self.name + ".json")
        for stale in (reached, report):
            if os.path.exists(stale):
                os.unlink(stale)
        done = self._start(-1, ["--gtest_output=json:" + report], None, {"NORD_MUTANT_REACHED": reached})
        if not os.path.exists(report):
            raise RuntimeError(f"{self.name} ended with {done.code} before its report, without a mutant: {done.text[-2000:]}")
        with open(report) as file:
            suites = json.load(file)["testsuites"]
        for suite in suites:
            for test in suite["testsuite"]:
                name = f"{test.get('classname', suite['name'])}.{test['name']}"
                if test.get("failures"):
                    self.left_out.append(name)
                elif test.get("result") == "COMPLETED" and test.get("status") == "RUN":
                    self.times[name] = float(test["time"].rstrip("s"))
        if os.path.exists(reached):
            with open(reached) as file:
                for line in file:
                    number, _, test = line.rstrip("\n").partition(" ")
                    self.reach.setdefault(int(number), set()).add(test)

    def testsFor(self, number, most_seconds):
        """(tests, left out for time): those that reach the mutant, the short ones first, as many as the time allows."""
        reached = self.reach.get(number, set())
        tests = list(self.times) if "*" in reached else [test for test in reached if test in self.times]
        tests.sort(key=lambda test: (self.times[test], test))
        taken, seconds = [], 0.0
        for test in tests:
            seconds += self.times[test] + 0.002
            if seconds > most_seconds and taken:
                break
            taken.append(test)
        return taken, len(tests) - len(taken)

    def tells(self, number, tests):
        """How the mutant was found by one of the tests, or None. The short tests are run first, in a process of their own."""
        quick, seconds = [], 0.0
        for test in tests:
            seconds += self.times[test] + 0.002
            if seconds > 1.0 and quick:
                break
            quick.append(test)
        for part in (quick, tests[len(quick):]):
            if part:
                found = self._partTells(number, part)
                if found:
                    return found
        return None

    def _partTells(self, number, tests):
        alone = sum(self.times[test] for test in tests)
        run = self._start(number, ["--gtest_fail_fast"], tests, {}, cpu=4 * alone + 3, wall=20 * alone + 60)
        if run.code == 0:
            return None
        if run.code is None:
            return f"{self.name}: does not end" if self._endsWithout(tests, alone) else None
        failed = re.findall(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)", run.text, re.M)
        if not failed:
            if not self._endsWithout(tests, alone):
                return None
            started = re.findall(r"^\[ RUN      \] (\S+)", run.text, re.M)
            how = signal.Signals(-run.code).name if run.code < 0 else f"code {run.code}"
            return f"{self.name}: {how} in {started[-1] if started else 'its start'}"
        # A test that fails without the mutant too, on this loaded machine for example, tells nothing.
        again = self._start(0, [], failed[:1], {}, cpu=4 * alone + 3, wall=20 * alone + 60)
        if again.code != 0:
            others = [test for test in tests if test not in failed]
            return self._partTells(number, others) if others else None
        return f"{self.name}: {failed[0]}"

    def _endsWithout(self, tests, alone):
        """Without the mutant they end, and pass: the machine has not made it what it was."""
        return self._start(0, [], tests, {}, cpu=4 * alone + 3, wall=20 * alone + 60).code == 0

    def _start(self, number, arguments, tests, extra, cpu=3600, wall=3600):
        environment = dict(os.environ, NORD_MUTANT=str(number), **extra)
        with tempfile.TemporaryDirectory() as home:
            output = os.path.join(home, "output")
            environment.update(ROS_HOME=home, HOME=home, NORD_MUTANT_OUTPUT=output)
            if self._preloaded:
                environment["LD_PRELOAD"] = self._preloaded
            command = [self.path] + arguments
            if tests is not None:
                flags = os.path.join(home, "flags")
                with open(flags, "w") as file:
                    file.write("--gtest_filter=" + ":".join(tests) + "\n")
                command.append("--gtest_flagfile=" + flags)

            def limits():
                resource.setrlimit(resource.RLIMIT_CPU, (int(cpu) + 1, int(cpu) + 2))
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
                resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
                os.setpgrp()  # of the same session: what the machine gives that one is shared

            with open(output, "wb") as file:
                process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT,
                                           env=environment, cwd=home, preexec_fn=limits)
            try:
                code = process.wait(timeout=wall)
                if code in (-signal.SIGXCPU, -signal.SIGKILL):
                    code = None
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                code = None
            with open(output, "rb") as file:
                text = file.read().decode(errors="replace")
        return _Run(code, text)


class _Run:
    def __init__(self, code, text):
        self.code, self.text = code, text
