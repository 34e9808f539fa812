// Who has a device: told by the kernel, without touching the device.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include "tools/lock_owner.h"

namespace nord_driver::tools {
namespace {

TEST(LockOwner, IsTheProcessThatHoldsTheLock) {
  const std::string path = ::testing::TempDir() + "lock_owner_" + std::to_string(::getpid());
  EXPECT_FALSE(lockOwner(path)) << "no such file";
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_GE(file, 0);
  EXPECT_FALSE(lockOwner(path)) << "open, but not locked";
  ASSERT_EQ(0, ::flock(file, LOCK_EX | LOCK_NB));
  const auto owner = lockOwner(path);
  ASSERT_TRUE(owner);
  EXPECT_EQ(::getpid(), owner->process);
  EXPECT_EQ("test_tools", owner->name);
  ::close(file);
  EXPECT_FALSE(lockOwner(path));
  ::unlink(path.c_str());
}

}  // namespace
}  // namespace nord_driver::tools
