// Who has a device: told by the kernel, without touching the device.
#include <errno.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include "link/serial/lock_owner.h"

namespace nord_driver::link {
namespace {

TEST(LockOwner, IsTheProcessThatHoldsTheLock) {
  const std::string path = ::testing::TempDir() + "lock_owner_" + std::to_string(::getpid());
  EXPECT_FALSE(lockOwner(path.c_str())) << "no such file";
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_GE(file, 0);
  EXPECT_FALSE(lockOwner(path.c_str())) << "open, but not locked";
  ASSERT_EQ(0, ::flock(file, LOCK_EX | LOCK_NB));
  const auto owner = lockOwner(path.c_str());
  ASSERT_TRUE(owner);
  EXPECT_EQ(::getpid(), owner->process);
  EXPECT_STREQ(program_invocation_short_name, owner->name.c_str());
  EXPECT_EQ(std::string{program_invocation_short_name} + " (process " + std::to_string(::getpid()) + ")",
            toText(*owner).str());
  ::close(file);
  EXPECT_FALSE(lockOwner(path.c_str()));
  ::unlink(path.c_str());
}

TEST(LockOwner, WhoseProgramIsNotKnownIsTold) {
  EXPECT_EQ("", programOf(0).str());
  LockOwner owner;
  owner.process = 42;
  EXPECT_STREQ("a program (process 42)", toText(owner).c_str());
}

}  // namespace
}  // namespace nord_driver::link
