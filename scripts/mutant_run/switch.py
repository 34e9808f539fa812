"""The switch before each mutant, in C++, and a source with its mutants behind it."""
import re

HEADER = """\
// Which mutant is on: the number in NORD_MUTANT, read once. 0: none. -1: none, but which test reaches which is written down.
#pragma once

// An edit may well look wrong to the compiler.
#pragma GCC diagnostic ignored "-Waddress"
#pragma GCC diagnostic ignored "-Warray-bounds"
#pragma GCC diagnostic ignored "-Wbool-compare"
#pragma GCC diagnostic ignored "-Wbool-operation"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wdiv-by-zero"
#pragma GCC diagnostic ignored "-Wenum-compare"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wimplicit-fallthrough"
#pragma GCC diagnostic ignored "-Wint-in-bool-context"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wnarrowing"
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wreturn-type"
#pragma GCC diagnostic ignored "-Wshift-count-overflow"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wtautological-compare"
#pragma GCC diagnostic ignored "-Wtype-limits"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-value"
#pragma GCC diagnostic ignored "-Wunused-variable"

extern int nord_mutant_on;
bool nord_mutant_reached(int id) noexcept;

inline bool nord_mutant(int id) noexcept {
  return nord_mutant_on == id || (nord_mutant_on < 0 && nord_mutant_reached(id));
}

// For functions that the compiler may call: what it computes itself is what the source says.
constexpr bool nord_mutant_constexpr(int id) noexcept {
  return !__builtin_is_constant_evaluated() && nord_mutant(id);
}
"""

SOURCE = """\
#include "nord_mutant.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>

namespace {

int opened(const char* variable, int flags) {
  const char* path = std::getenv(variable);
  return path ? open(path, flags, 0644) : -1;
}

int output = -1, reached = -1;
char test[256] = "*";
off_t seen_size = -1;
constexpr int kMost = 20000;
bool seen[kMost];

// Before the objects of every other source: their initialisers may hold mutants.
struct First {
  First() {
    const char* number = std::getenv("NORD_MUTANT");
    nord_mutant_on = number ? std::atoi(number) : 0;
    output = opened("NORD_MUTANT_OUTPUT", O_RDONLY);
    reached = opened("NORD_MUTANT_REACHED", O_WRONLY | O_CREAT | O_APPEND);
  }
} first __attribute__((init_priority(101)));

// GoogleTest writes out which test begins before it begins: the last such line names the test that runs.
void findTest() {
  struct stat file;
  if (output < 0 || fstat(output, &file) != 0 || file.st_size == seen_size) return;
  static char tail[1 << 16];
  const off_t from = file.st_size > off_t(sizeof tail) ? file.st_size - off_t(sizeof tail) : 0;
  const ssize_t length = pread(output, tail, sizeof tail, from);
  seen_size = file.st_size;
  static const char kRun[] = "[ RUN      ] ";
  for (ssize_t i = length - ssize_t(sizeof kRun); i >= 0; --i) {
    if (std::memcmp(tail + i, kRun, sizeof kRun - 1) != 0) continue;
    char name[256];
    std::size_t size = 0;
    for (ssize_t k = i + ssize_t(sizeof kRun) - 1; k < length && tail[k] > ' ' && size < sizeof name - 1; ++k) name[size++] = tail[k];
    name[size] = 0;
    if (std::strcmp(name, test) == 0) return;
    std::memcpy(test, name, size + 1);
    std::memset(seen, 0, sizeof seen);
    return;
  }
}

}  // namespace

int nord_mutant_on = 0;

bool nord_mutant_reached(int id) noexcept {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  findTest();
  if (id < 0 || id >= kMost || seen[id]) return false;
  seen[id] = true;
  char line[300];
  const int length = std::snprintf(line, sizeof line, "%d %s\\n", id, test);
  if (reached >= 0 && length > 0) (void)!write(reached, line, static_cast<std::size_t>(length));
  return false;
}
"""


def _commentsOut(text):
    return re.sub(r"\s*\n\s*", " ", re.sub(r"//[^\n]*", "", text))


def switched(edit, number):
    """The text that stands in place of the edit's original."""
    call = f"nord_mutant({number})"
    if edit.form.endswith("constexpr"):
        call = f"nord_mutant_constexpr({number})"
    if edit.form.startswith("statement"):
        return f"{{ if (!{call}) {edit.original} }}"
    return f"({call} ? ({_commentsOut(edit.mutated)}) : ({edit.original}))"


def applied(text, numbered):
    """The source with (number, edit) pairs behind switches, the header of the switch included in line 1."""
    for number, edit in sorted(numbered, key=lambda pair: -pair[1].start):
        text = text[:edit.start] + switched(edit, number) + text[edit.end:]
        if edit.form == "constant":
            begin = max(0, *(text.rfind(mark, 0, edit.start) for mark in (";", "{", "}")))
            head = text[begin:edit.start].replace("constexpr", "const    ", 1)
            text = text[:begin] + head + text[edit.start:]
    return '#include "nord_mutant.h"\n' + text
