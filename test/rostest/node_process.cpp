#include "rostest/node_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <sstream>
#include <stdexcept>

namespace nord_driver::test {

const char* const kDriverProgram = NORD_DRIVER_NODE_PROGRAM;
const char* const kSimulatorProgram = NORD_SIM_NODE_PROGRAM;

NodeProcess::NodeProcess(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  int ends[2];
  errors_ = ::memfd_create("stderr", MFD_CLOEXEC);
  if (errors_ < 0 || ::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no descriptors for " + program);

  pid_ = ::fork();
  if (pid_ == 0) {  // other threads may hold any lock: system calls only
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(errors_, STDERR_FILENO);
    ::fcntl(ends[1], F_SETFD, 0);
    ::execv(program.c_str(), argv.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  alive_ = ends[0];
  if (pid_ < 0) throw std::runtime_error("cannot start " + program);
}

NodeProcess::~NodeProcess() {
  if (!end_) {
    signal(SIGKILL);
    waitEnd(kPatience);
  }
  ::close(alive_);
  ::close(errors_);
}

void NodeProcess::signal(int number) {
  if (!end_) ::kill(pid_, number);
}

std::optional<NodeProcess::End> NodeProcess::waitEnd(Seconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  while (!end_) {
    const Seconds left = deadline - std::chrono::steady_clock::now();
    pollfd descriptor{alive_, POLLIN, 0};
    const int ready = ::poll(&descriptor, 1, left > Seconds::zero() ? static_cast<int>(left.count() * 1e3) + 1 : 0);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) break;
    int status = 0;
    if (::waitpid(pid_, &status, 0) != pid_) throw std::runtime_error("the child process is lost");
    end_.emplace();
    if (WIFEXITED(status)) end_->exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) end_->signal = WTERMSIG(status);
  }
  return end_;
}

std::string NodeProcess::errorText() const {
  std::string text;
  char buffer[4096];
  for (ssize_t count = 0; (count = ::pread(errors_, buffer, sizeof buffer, static_cast<off_t>(text.size()))) > 0;) {
    text.append(buffer, static_cast<std::size_t>(count));
  }
  return text;
}

std::vector<std::string> NodeProcess::errorLines() const {
  std::vector<std::string> lines;
  std::istringstream text(errorText());
  for (std::string line; std::getline(text, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

}  // namespace nord_driver::test
