// A yes or no from whoever sits at the terminal.
#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace nord_driver::tools {

/// Whether somebody can be asked: stdin is a terminal.
bool canAsk();

/// `question` on stderr, until a line or the end of the input has come, or `end_asked`; `meanwhile` is called over and
/// over, and waits a little each time. True: "y" or "yes" in any case.
bool askYesOrNo(const std::string& question, const std::function<void()>& meanwhile,
                const std::atomic<bool>& end_asked);

}  // namespace nord_driver::tools
