#include <gtest/gtest.h>

#include <cmath>

#include "tools/json_text.h"

namespace nord_driver::tools {
namespace {

TEST(JsonText, IsWrittenInTheOrderItIsTold) {
  JsonText json;
  json.begin('{').key("name").text("left").key("list").begin('[').number(0.5).number(3).end(']');
  json.key("none").begin('{').end('}').key("good").boolean(true).end('}');
  EXPECT_EQ(R"({"name": "left", "list": [0.5, 3], "none": {}, "good": true})", json.str());
}

TEST(JsonText, WhatWouldEndAStringIsEscaped) {
  JsonText json;
  json.begin('[').text("say \"C:\\\"\n").number(std::nan("")).end(']');
  EXPECT_EQ(R"(["say \"C:\\\"\u000a", null])", json.str());
}

}  // namespace
}  // namespace nord_driver::tools
