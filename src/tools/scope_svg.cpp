#include "tools/scope_svg.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "profile/scaling.h"
#include "profile/status_word.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace {

using profile::DriveState;

// In px.
constexpr double kWidth = 1000, kHeight = 470;
constexpr double kLeft = 84, kRight = 916, kTop = 78, kBottom = 330;
constexpr double kBandTop = 392, kBandHeight = 30;
constexpr double kLetter = 7.5;  // an upper estimate, 14 px sans-serif

constexpr char kInk[] = "#1b2733", kMuted[] = "#4a5866", kGrid[] = "#dde3ea", kPage[] = "#fbfcfe", kEdge[] = "#c5ced8";

struct Point {
  double time;
  double value;
};

struct Curve {
  std::string label;
  const char* colour;
  const char* dash;                       // of the line; empty: solid
  bool right;                             // axis
  std::vector<std::vector<Point>> parts;  // between gaps
};

struct Axis {
  double low = 0.0, high = 1.0, step = 1.0;
};

// 1, 2 or 5 times a power of ten.
double niceStep(double span, int wanted) {
  const double rough = span / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (rough <= factor * power * 1.0001) return factor * power;
  }
  return 10.0 * power;
}

Axis axisOf(double low, double high, int wanted) {
  if (!(high > low)) {
    low -= 1.0;
    high += 1.0;
  }
  Axis axis;
  axis.step = niceStep(high - low, wanted);
  axis.low = std::floor(low / axis.step + 1e-9) * axis.step;
  axis.high = std::ceil(high / axis.step - 1e-9) * axis.step;
  return axis;
}

std::string format(const char* pattern, double a, double b = 0, double c = 0, double d = 0) {
  char text[200];
  std::snprintf(text, sizeof text, pattern, a, b, c, d);
  return text;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '&') {
      result += "&amp;";
    } else if (letter == '<') {
      result += "&lt;";
    } else {
      result += letter;
    }
  }
  return result;
}

std::string label(double x, double y, const std::string& text, const char* anchor, const char* colour = kInk,
                  const char* more = "") {
  return format("<text x=\"%.1f\" y=\"%.1f\"", x, y) + " font-family=\"sans-serif\" font-size=\"14\" text-anchor=\"" +
         anchor + "\" fill=\"" + colour + "\"" + more + ">" + escaped(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* colour, double width = 1.0) {
  return format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"", x1, y1, x2, y2) + " stroke=\"" + colour +
         "\"" + format(" stroke-width=\"%.1f\"/>\n", width);
}

std::string rectangle(double x, double y, double width, double height, const char* fill, const char* edge) {
  return format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"", x, y, width, height) + " fill=\"" + fill +
         "\" stroke=\"" + edge + "\"/>\n";
}

// As many decimals as the step has.
std::string tickText(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(value) < step * 1e-6 ? 0.0 : value);
  return text;
}

const char* colourOf(DriveState state) {
  switch (state) {
    case DriveState::kNotReadyToSwitchOn:
      return "#d5dbe2";
    case DriveState::kSwitchOnDisabled:
      return "#c3ccd6";
    case DriveState::kReadyToSwitchOn:
      return "#cfe0f5";
    case DriveState::kSwitchedOn:
      return "#d8efd9";
    case DriveState::kOperationEnabled:
      return "#8fd19e";
    case DriveState::kQuickStopActive:
      return "#f6c76a";
    case DriveState::kFaultReactionActive:
    case DriveState::kFault:
      return "#f08a8a";
    case DriveState::kUnknown:
      break;
  }
  return "#ffffff";
}

class Drawing {
 public:
  explicit Drawing(const ScopeRecord& record) : record_(record) {
    const std::vector<ScopeSample>& samples = record.samples;
    start_ = samples.front().time;
    span_ = samples.back().time - start_;
    const std::size_t intervals = samples.size() - 1;
    gap_ = 5.0 * span_ / static_cast<double>(intervals);
  }

  std::string svg() {
    addCurves();
    text_ = format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" ", kWidth,
                   kHeight, kWidth) +
            format("height=\"%.0f\">\n", kHeight);
    text_ += "<title>Drive " + escaped(record_.drive) + "</title>\n";
    text_ += rectangle(0.5, 0.5, kWidth - 1, kHeight - 1, kPage, kEdge);
    drawAxes();
    for (const Curve& curve : curves_) draw(curve);
    drawLegend();
    drawBand();
    return text_ + "</svg>\n";
  }

 private:
  double x(double time) const { return kLeft + (time - start_) / span_ * (kRight - kLeft); }
  double y(double value, bool right) const {
    const Axis& axis = right ? right_ : left_;
    return kBottom - (value - axis.low) / (axis.high - axis.low) * (kBottom - kTop);
  }

  static double scaled(std::int16_t word, const std::optional<double>& max_frequency) {
    return max_frequency.value_or(100.0) * word / profile::kHundredPercent;
  }
  std::string unit(bool is_frequency) const {
    if (!is_frequency) return "%";
    return record_.max_frequency ? "Hz" : "% of P105";
  }

  using Value = std::function<double(const ScopeSample&)>;
  Curve& add(const std::string& name, const char* colour, const char* dash, bool right, bool always,
             const Value& value) {
    Curve curve{name, colour, dash, right, {}};
    bool goes_on = false;
    double last = 0.0;
    for (const ScopeSample& sample : record_.samples) {
      const bool there = always || sample.answered;
      if (there) {
        if (!goes_on || sample.time - last > gap_) curve.parts.emplace_back();
        curve.parts.back().push_back({sample.time, value(sample)});
      }
      goes_on = there;
      last = sample.time;
    }
    curves_.push_back(curve);
    return curves_.back();
  }

  void addCurves() {
    // What is no frequency goes to the axis of the other words, where one of the two is.
    const bool setpoint = record_.setpoint_is_frequency, actual = record_.actual_value_is_frequency;
    if (record_.commands_known) {
      add("setpoint 1, " + unit(setpoint), "#a85b00", "6 4", !setpoint && actual, true,
          [this](const ScopeSample& sample) { return scaled(sample.output.setpoints[0], record_.setpointScale()); });
    }
    has_right_ = setpoint != actual;
    if (record_.words_known) addActualValues();
    left_ = range(false);
    if (has_right_) right_ = range(true);
  }

  void addActualValues() {
    const bool setpoint = record_.setpoint_is_frequency, actual = record_.actual_value_is_frequency;
    add((record_.actualValueScale() ? "frequency, " : "actual value 1, ") + unit(actual), "#1d5fa8", "",
        !actual && setpoint, false, [this](const ScopeSample& sample) {
          return scaled(sample.input.actual_values[0], record_.actualValueScale());
        });
    static constexpr const char* kColours[2] = {"#b91c1c", "#6d3fa0"};
    for (std::size_t i = 1; i < 3; ++i) {
      const bool is_current = record_.current_word == static_cast<int>(i) + 1;
      const bool there = std::any_of(record_.samples.begin(), record_.samples.end(),
                                     [i](const ScopeSample& sample) { return sample.input.actual_values[i] != 0; });
      if (!there && !is_current) continue;
      const std::string name = is_current ? "current, % of rated" : "actual value " + std::to_string(i + 1) + ", %";
      add(name, kColours[i - 1], "", true, false,
          [i](const ScopeSample& sample) { return 100.0 * sample.input.actual_values[i] / profile::kHundredPercent; });
      has_right_ = true;
    }
  }

  Axis range(bool right) const {
    double low = 0.0, high = 0.0;
    for (const Curve& curve : curves_) {
      if (curve.right != right) continue;
      for (const auto& part : curve.parts) {
        for (const Point& point : part) {
          low = std::min(low, point.value);
          high = std::max(high, point.value);
        }
      }
    }
    return axisOf(low, high, 5);
  }

  void drawAxes() {
    const double time_step = niceStep(span_, 8);
    for (double time = std::ceil(start_ / time_step - 1e-9) * time_step; time <= start_ + span_ + time_step * 1e-6;
         time += time_step) {
      text_ += line(x(time), kTop, x(time), kBottom, kGrid);
      text_ += line(x(time), kBandTop, x(time), kBandTop + kBandHeight, kGrid);
      text_ += label(x(time), kBottom + 20, tickText(time, time_step), "middle", kMuted);
    }
    drawTicks(left_, false);
    if (has_right_) drawTicks(right_, true);
    text_ += line(kLeft, y(0.0, false), kRight, y(0.0, false), kMuted);
    text_ += line(kLeft, kTop, kLeft, kBottom, kMuted) + line(kRight, kTop, kRight, kBottom, kMuted);
    text_ += label((kLeft + kRight) / 2, kBottom + 42, "time in s", "middle");
    text_ += upright(24, unit(record_.setpoint_is_frequency || record_.actual_value_is_frequency));
    if (has_right_) text_ += upright(kWidth - 14, "%");
    text_ += label(kLeft, 30, "Drive " + record_.drive, "start", kInk, " font-weight=\"bold\"");
  }

  void drawTicks(const Axis& axis, bool right) {
    for (double value = axis.low; value <= axis.high + axis.step * 1e-6; value += axis.step) {
      const double height = y(value, right);
      if (!right) text_ += line(kLeft, height, kRight, height, kGrid);
      text_ += label(right ? kRight + 8 : kLeft - 8, height + 5, tickText(value, axis.step), right ? "start" : "end",
                     kMuted);
    }
  }

  static std::string upright(double x, const std::string& text) {
    const double middle = (kTop + kBottom) / 2;
    return label(x, middle, text, "middle", kInk, format(" transform=\"rotate(-90 %.1f %.1f)\"", x, middle).c_str());
  }

  // Of the points in one column of the picture only the first, the last and the extremes can be seen.
  void draw(const Curve& curve) {
    for (const auto& part : curve.parts) {
      std::string points;
      for (std::size_t i = 0; i < part.size();) {
        const double column = std::floor(x(part[i].time));
        std::size_t low = i, high = i, last = i;
        for (; last < part.size() && std::floor(x(part[last].time)) <= column; ++last) {
          if (part[last].value < part[low].value) low = last;
          if (part[last].value > part[high].value) high = last;
        }
        std::vector<std::size_t> kept{i, std::min(low, high), std::max(low, high), last - 1};
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        for (const std::size_t k : kept) {
          points += format("%.1f,%.1f ", x(part[k].time), y(part[k].value, curve.right));
        }
        i = last;
      }
      points.pop_back();
      text_ += "<polyline points=\"" + points + "\" fill=\"none\" stroke=\"" + curve.colour + "\" stroke-width=\"2\"" +
               (*curve.dash == '\0' ? "" : " stroke-dasharray=\"" + std::string(curve.dash) + "\"") + "/>\n";
    }
  }

  void drawLegend() {
    double at = kLeft;
    for (const Curve& curve : curves_) {
      text_ += "<polyline points=\"" + format("%.1f,52 %.1f,52", at, at + 28) + "\" fill=\"none\" stroke=\"" +
               curve.colour + "\" stroke-width=\"2\"" +
               (*curve.dash == '\0' ? "" : " stroke-dasharray=\"" + std::string(curve.dash) + "\"") + "/>\n";
      text_ += label(at + 34, 57, curve.label, "start");
      at += 34 + kLetter * static_cast<double>(curve.label.size()) + 24;
    }
  }

  static DriveState stateOf(const ScopeSample& sample) {
    return sample.answered ? profile::StatusWord{sample.input.status_word}.state() : DriveState::kUnknown;
  }

  // One rectangle for each time in one state, with its name where there is room, and the names of the others below.
  void drawBand() {
    const std::vector<ScopeSample>& samples = record_.samples;
    std::vector<DriveState> unnamed;
    for (std::size_t first = 0, next; first < samples.size(); first = next) {
      const DriveState state = stateOf(samples[first]);
      next = first + 1;
      while (next < samples.size() && stateOf(samples[next]) == state) ++next;
      const double left = x(samples[first].time);
      const double right = x(samples[std::min(next, samples.size() - 1)].time);
      text_ += rectangle(left, kBandTop, std::max(right - left, 0.5), kBandHeight, colourOf(state), kMuted);
      const std::string name = nameOf(state);
      if (kLetter * static_cast<double>(name.size()) + 6 < right - left) {
        text_ += label((left + right) / 2, kBandTop + kBandHeight / 2 + 5, name, "middle");
      } else if (std::find(unnamed.begin(), unnamed.end(), state) == unnamed.end()) {
        unnamed.push_back(state);
      }
    }
    text_ += label(kLeft - 8, kBandTop + kBandHeight / 2 + 5, "state", "end", kMuted);
    double at = kLeft;
    for (const DriveState state : unnamed) {
      text_ += rectangle(at, kBandTop + kBandHeight + 10, 14, 14, colourOf(state), kMuted);
      text_ += label(at + 20, kBandTop + kBandHeight + 22, nameOf(state), "start");
      at += 20 + kLetter * static_cast<double>(nameOf(state).size()) + 20;
    }
  }

  static std::string nameOf(DriveState state) {
    return state == DriveState::kUnknown ? "no answer" : profile::toString(state);
  }

  const ScopeRecord& record_;
  double start_ = 0.0, span_ = 1.0;
  double gap_ = 0.0;  // s: longer without a sample is drawn as nothing
  std::vector<Curve> curves_;
  Axis left_, right_;
  bool has_right_ = false;
  std::string text_;
};

}  // namespace

std::string scopeSvg(const ScopeRecord& record) {
  if (record.samples.size() < 2 || !(record.samples.back().time > record.samples.front().time)) {
    throw UsageError("there is nothing to draw: " + std::to_string(record.samples.size()) +
                     " cycles, expected at least 2");
  }
  return Drawing{record}.svg();
}

}  // namespace nord_driver::tools
