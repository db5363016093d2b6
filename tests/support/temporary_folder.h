#pragma once
/// A folder that is gone after the test.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace merge2d {

/// A path for the running test alone: also the tests of another checkout may run at this time.
inline std::filesystem::path pathOfThisTest() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  return std::filesystem::path(testing::TempDir()) /
         (std::string("merge2d_") + std::to_string(getpid()) + "_" + test->test_suite_name() + "_" +
          test->name());
}

class TemporaryFolder {
 public:
  TemporaryFolder() : path_(pathOfThisTest()) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// How many files are in it.
  std::size_t count() const {
    const std::filesystem::directory_iterator begin(path_);
    return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace merge2d
