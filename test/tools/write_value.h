// A write as a service asks for it, over a link of nord_param.
#pragma once

#include <gtest/gtest.h>

#include "tools/parameter_link.h"

namespace nord_driver::tools {

/// As a service would: from number and value to the answer.
inline ParameterAnswer writeValue(ParameterLink& link, const catalogue::ParameterAddress& address,
                                  const catalogue::ParameterWrite& write) {
  catalogue::ParameterAccess access = catalogue::accessTo(address, link.known());
  EXPECT_EQ("", access.error);
  EXPECT_EQ("", catalogue::setValue(access, write));
  return link.write(access);
}

}  // namespace nord_driver::tools
