#include "tools/terminal_question.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace nord_driver::tools {

bool canAsk() {
  return ::isatty(STDIN_FILENO) != 0;
}

bool askYesOrNo(const std::string& question, const std::function<void()>& meanwhile,
                const std::atomic<bool>& end_asked) {
  std::fprintf(stderr, "%s [y/N] ", question.c_str());
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (::poll(&input, 1, 0) <= 0 || input.revents == 0) {
    meanwhile();
    if (!end_asked) continue;
    std::fputs("\n", stderr);
    return false;
  }
  char line[64];
  const ssize_t length = ::read(STDIN_FILENO, line, sizeof line);
  if (length <= 0) return false;
  std::string answer(line, static_cast<std::size_t>(length));
  answer.erase(std::remove_if(answer.begin(), answer.end(), [](unsigned char c) { return std::isspace(c) != 0; }),
               answer.end());
  std::transform(answer.begin(), answer.end(), answer.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return answer == "y" || answer == "yes";
}

}  // namespace nord_driver::tools
