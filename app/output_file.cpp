#include "app/output_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <iostream>
#include <system_error>

#include "app/usage_error.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

bool beginsWith(const fs::path& file, std::string_view start) {
  std::ifstream in(file, std::ios::binary);
  std::string begin(start.size(), '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return in && begin == start;
}

/// Where a link leads, so that the link stays one; also when there is nothing yet.
fs::path linkTarget(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code ignored;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, ignored); ++i) {
    path = path.parent_path() / fs::read_symlink(path, ignored);
  }
  return path;
}

[[noreturn]] void fail(const std::string& name, const std::string& why) {
  throw IoError(fmt::format("cannot write {}: {}", name, why));
}

std::string reason() { return std::generic_category().message(errno); }

}  // namespace

OutputFile::OutputFile(const std::string& path, const Replaces& replaces) : name_(path) {
  if (path == "-") {
    out_ = &std::cout;
    name_ = "to the standard output";
    return;
  }
  std::error_code ignored;
  path_ = linkTarget(path);
  const fs::file_status status = fs::status(path_, ignored);
  if (fs::is_directory(status)) fail(name_, "it is a folder");
  if (fs::is_regular_file(status) && !replaces.everything && !beginsWith(path_, replaces.ours)) {
    throw UsageError(
        fmt::format("{} exists and would be overwritten; say --force if it may be", name_));
  }
  const bool device = fs::exists(status) && !fs::is_regular_file(status);
  if (!device) temporary_ = path_.string() + ".part";
  errno = 0;
  file_.open(device ? path_ : temporary_, std::ios::binary | std::ios::trunc);
  if (!file_) {
    temporary_.clear();
    fail(name_, reason());
  }
}

OutputFile::~OutputFile() {
  if (temporary_.empty()) return;
  file_.close();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void OutputFile::check() const {
  if (!*out_) fail(name_, errno != 0 ? reason() : "writing failed");
}

void OutputFile::finish() {
  errno = 0;
  out_->flush();
  check();
  if (temporary_.empty()) return;
  file_.close();
  if (!file_) fail(name_, reason());
  std::error_code failed;
  fs::rename(temporary_, path_, failed);
  if (failed) fail(name_, failed.message());
  temporary_.clear();
}

void writeFile(const std::string& path, std::string_view text, const Replaces& replaces) {
  OutputFile file(path, replaces);
  file.stream() << text;
  file.finish();
}

void makeFolder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) fail(folder.string(), failed.message());
}

MadeFolder::MadeFolder(const fs::path& folder) {
  std::error_code ignored;
  for (fs::path up = folder; !up.empty() && !fs::exists(up, ignored); up = up.parent_path()) {
    made_.push_back(up);
  }
  makeFolder(folder);
}

MadeFolder::~MadeFolder() {
  std::error_code not_empty;
  for (const fs::path& folder : made_) fs::remove(folder, not_empty);
}

std::string shellQuoted(const std::string& path) {
  constexpr std::string_view kPlain = "/._-+,:@%=";
  const bool plain = std::ranges::all_of(path, [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           kPlain.find(c) != std::string_view::npos;
  });
  if (plain && !path.empty()) return path;
  std::string quoted = "'";
  for (const char c : path) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace merge2d
