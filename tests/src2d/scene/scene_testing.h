#pragma once
/// What the tests of scene loading share.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "src2d/core/error.h"
#include "src2d/scene/load.h"

namespace merge2d {

/// The whole message of the InputError that loading `toml` as "s.toml" throws.
inline std::string errorOf(std::string_view toml, const Overrides& overrides = {}) {
  try {
    parseScene(toml, "s.toml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// Its first line.
inline std::string firstLineOf(std::string_view toml, const Overrides& overrides = {}) {
  const std::string whole = errorOf(toml, overrides);
  return whole.substr(0, whole.find('\n'));
}

/// A text, and what is wrong with it.
struct Case {
  std::string_view toml;
  std::string_view message;
};

/// Each text as the only content of a scene, and the first line of its error.
inline void expectErrors(std::initializer_list<Case> cases) {
  for (const Case& c : cases) {
    EXPECT_EQ(firstLineOf(c.toml), fmt::format("s.toml:{}", c.message)) << "in\n" << c.toml;
  }
}

/// A file in a temporary folder of this process, which goes with it.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, std::string_view bytes)
      : path_(std::filesystem::path(testing::TempDir()) /
              ("merge2d_scene_" + std::to_string(::getpid())) / name) {
    std::filesystem::create_directories(path_.parent_path());
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() {
    std::error_code still_used;
    std::filesystem::remove(path_);
    std::filesystem::remove(path_.parent_path(), still_used);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace merge2d
