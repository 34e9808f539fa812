#include "tools/image_command.h"

#include <cstdio>

#include "tools/tool_config.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + '"';
}

/// "status word: ready to switch on"; "-" for nobody's.
std::string meaningOf(const ImageWord& word) {
  if (word.drive.empty()) return "-";
  return word.meaning + (word.text.empty() ? "" : ": " + word.text);
}

std::string wordJson(const ImageWord& word) {
  return "\"word\": " + std::to_string(word.word) + ", \"register\": " + std::to_string(word.register_at) +
         ", \"value\": " + std::to_string(word.value) + ", \"hex\": \"" + toHexWord(word.value) +
         "\", \"drive\": " + (word.drive.empty() ? "null" : quoted(word.drive)) +
         ", \"meaning\": " + (word.drive.empty() ? "null" : quoted(meaningOf(word)));
}

std::string timeText(double time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", time);
  return text;
}

bool isMarked(const std::vector<bool>& changed, std::size_t i) {
  return i < changed.size() && changed[i];
}

/// Cycles on a transport that writes nothing.
class Looker {
 public:
  Looker(const ToolConfig& config, Transport& transport)
      : transport_(transport),
        period_(seconds(1.0 / config.cycle.cycle_rate)),
        outputs_(config.drives.size()),
        inputs_(config.drives.size()) {}
  ~Looker() { transport_.close(); }
  Looker(const Looker&) = delete;
  Looker& operator=(const Looker&) = delete;

  void cycle() {
    const Instant begin = transport_.now();
    transport_.exchange(outputs_, inputs_);
    transport_.sleepUntil(begin + period_);
  }
  Instant now() const { return transport_.now(); }

 private:
  Transport& transport_;
  Duration period_;
  std::vector<profile::ProcessOutput> outputs_;  // never written
  std::vector<DriveExchange> inputs_;
};

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

/// Each word that changes, until `end_asked`; which ones did.
std::vector<bool> follow(Looker& looker, const ImageView& view, const ImageOptions& options,
                         const std::atomic<bool>& end_asked) {
  std::vector<ImageWord> before = view.image();
  std::vector<bool> changed(before.size());
  const Instant begin = looker.now();
  while (!end_asked) {
    looker.cycle();
    const std::vector<ImageWord> now = view.image();
    for (std::size_t i = 0; i < now.size() && i < before.size(); ++i) {
      if (now[i].value == before[i].value) continue;
      changed[i] = true;
      const double time = toSeconds(looker.now() - begin);
      print(options.json ? changeJson(time, now[i], before[i].value) : changeLine(time, now[i], before[i].value));
    }
    before = now;
  }
  return changed;
}

}  // namespace

std::string imageTable(const std::string& where, const std::vector<ImageWord>& words,
                       const std::vector<bool>& changed) {
  std::string text =
      "Inputs of " + where + "; nothing is written\n" + "  word  register  value  drive         meaning\n";
  for (std::size_t i = 0; i < words.size(); ++i) {
    char line[160];
    std::snprintf(line, sizeof line, "%c %4zu  %8u  %4s   %-12s  %s\n", isMarked(changed, i) ? '*' : ' ', words[i].word,
                  words[i].register_at, toHexWord(words[i].value).c_str(),
                  words[i].drive.empty() ? "-" : words[i].drive.c_str(), meaningOf(words[i]).c_str());
    text += line;
  }
  return text;
}

std::string imageJson(const std::string& where, const std::vector<ImageWord>& words, const std::vector<bool>& changed) {
  std::string text = "{\"inputs\": " + quoted(where) + ", \"words\": [";
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "{" : ", {") + wordJson(words[i]) +
            ", \"changed\": " + (isMarked(changed, i) ? "true" : "false") + "}";
  }
  return text + "]}\n";
}

std::string changeLine(double time, const ImageWord& word, Word before) {
  const std::string owner = word.drive.empty() ? "" : ", " + word.drive + ", " + meaningOf(word);
  char line[200];
  std::snprintf(line, sizeof line, "%9s s  word %zu, register %u%s: %s -> %s\n", timeText(time).c_str(), word.word,
                word.register_at, owner.c_str(), toHexWord(before).c_str(), toHexWord(word.value).c_str());
  return line;
}

std::string changeJson(double time, const ImageWord& word, Word before) {
  return "{\"time\": " + timeText(time) + ", \"before\": " + std::to_string(before) + ", " + wordJson(word) + "}\n";
}

bool showImage(const YAML::Node& file, Transport& transport, const ImageOptions& options,
               const std::atomic<bool>& end_asked) {
  auto* view = dynamic_cast<ImageView*>(&transport);
  if (view == nullptr || !transport.serveParametersOnly()) {
    throw UsageError("image: the transport " + transportOf(file) +
                     " has no image of all drives' words, expected nord_driver/interbus");
  }
  view->showWords(options.words);
  const ToolConfig config = readToolConfig(file, transport.endPoint());
  transport.configure(*config.bus, config.drives, config.cycle.cycle_rate);
  Looker looker{config, transport};
  const Instant until = looker.now() + options.patience;
  while (view->image().empty() && !end_asked && looker.now() < until) looker.cycle();
  const std::vector<ImageWord> words = view->image();
  if (words.empty()) {
    std::fprintf(stderr, "nord_param: no inputs: %s\n", transport.busText().c_str());
    return false;
  }
  const auto show = [&](const std::vector<bool>& changed) {
    print(options.json ? imageJson(view->imageText(), view->image(), changed)
                       : imageTable(view->imageText(), view->image(), changed));
  };
  show({});
  if (options.once) return true;
  if (!options.json) print("Words that change, until Ctrl-C:\n");
  show(follow(looker, *view, options, end_asked));
  return true;
}

}  // namespace nord_driver::tools
