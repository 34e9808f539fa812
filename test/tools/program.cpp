#include "tools/program.h"

#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

namespace nord_driver::test {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLookAgain{5};

std::string contentsOf(int file) {
  std::string text(1 << 16, '\0');
  const ssize_t count = ::pread(file, text.data(), text.size(), 0);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}

}  // namespace

Program::Program(const std::vector<std::string>& command)
    : output_(::memfd_create("stdout", MFD_CLOEXEC)), errors_(::memfd_create("stderr", MFD_CLOEXEC)) {
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_adddup2(&streams, output_, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&streams, errors_, STDERR_FILENO);
  const int result = ::posix_spawn(&pid_, argv[0], &streams, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  if (result != 0) throw std::runtime_error("cannot start " + command[0]);
}

Program::~Program() {
  if (pid_ > 0) {
    signal(SIGKILL);
    wait(std::chrono::seconds{10});
  }
  ::close(output_);
  ::close(errors_);
}

void Program::signal(int number) const {
  if (pid_ > 0) ::kill(pid_, number);
}

int Program::wait(std::chrono::seconds limit) {
  const auto end = Clock::now() + limit;
  int status = 0;
  while (::waitpid(pid_, &status, WNOHANG) == 0) {
    if (Clock::now() >= end) return -2;
    std::this_thread::sleep_for(kLookAgain);
  }
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool Program::saysSomething(std::chrono::seconds limit) const {
  const auto end = Clock::now() + limit;
  while (output().find('\n') == std::string::npos) {
    if (Clock::now() >= end) return false;
    std::this_thread::sleep_for(kLookAgain);
  }
  return true;
}

std::string Program::output() const {
  return contentsOf(output_);
}

std::string Program::errors() const {
  return contentsOf(errors_);
}

Ended runProgram(const std::vector<std::string>& command, std::chrono::seconds limit) {
  Program program(command);
  Ended ended;
  ended.code = program.wait(limit);
  ended.output = program.output();
  ended.errors = program.errors();
  return ended;
}

}  // namespace nord_driver::test
