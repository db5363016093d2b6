#include "app/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <map>
#include <system_error>

#include "app/console.h"
#include "app/interrupt.h"
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

std::string reason(int error) { return std::generic_category().message(error); }

/// The identity of a file, which two names that lead to it share. Empty for a file that takes all
/// that comes: a terminal, /dev/null.
std::string identity(const std::string& path) {
  struct stat file {};
  const bool there =
      path == "-" ? fstat(STDOUT_FILENO, &file) == 0 : stat(path.c_str(), &file) == 0;
  if (!there) return fs::weakly_canonical(linkTarget(fs::absolute(path))).string();
  if (S_ISCHR(file.st_mode) && path != "-") return {};
  return fmt::format("{}:{}", file.st_dev, file.st_ino);
}

}  // namespace

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type character) {
  if (sync() != 0) return traits_type::eof();
  if (traits_type::eq_int_type(character, traits_type::eof())) return 0;
  return sputc(traits_type::to_char_type(character));
}

int DescriptorBuffer::sync() {
  const auto* begin = reinterpret_cast<const std::uint8_t*>(pbase());
  const bool written = error_ == 0 && writeAll(descriptor_, {begin, begin + (pptr() - pbase())});
  if (!written && error_ == 0) error_ = errno;
  empty();
  return written ? 0 : -1;
}

OutputFile::OutputFile(const std::string& path, const Replaces& replaces) : name_(path) {
  if (isStandardOutput()) {
    flushOutput();  // what was printed before comes before
    buffer_.setDescriptor(STDOUT_FILENO);
    return;
  }
  std::error_code ignored;
  const fs::path target = linkTarget(path);
  const fs::file_status status = fs::symlink_status(target, ignored);
  if (fs::is_symlink(status)) fail(name_, "its links lead nowhere");
  if (fs::is_directory(status) || !target.has_filename()) fail(name_, "it is a folder");
  if (fs::is_regular_file(status) && !replaces.everything && !beginsWith(target, replaces.ours)) {
    throw UsageError(
        fmt::format("{} exists and would be overwritten; say --force if it may be", name_));
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    openDevice(target);
    return;
  }
  if (target.has_parent_path()) made_.emplace(target.parent_path());
  file_.emplace(target, NewFileOptions{.name = name_});
  buffer_.setDescriptor(file_->descriptor());
}

void OutputFile::openDevice(const fs::path& device) {
  do {  // a pipe waits for its reader, and a signal may come meanwhile
    stopIfInterrupted();
    device_ = open(device.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  } while (device_ < 0 && errno == EINTR);
  if (device_ < 0) fail(name_, reason(errno));
  buffer_.setDescriptor(device_);
}

OutputFile::~OutputFile() {
  if (device_ >= 0) close(device_);
}

void OutputFile::check() const {
  if (out_) return;
  errno = buffer_.error();
  if (errno == EINTR) stopIfInterrupted();
  if (isStandardOutput()) failOutput();
  fail(name_, reason(buffer_.error()));
}

void OutputFile::finish() {
  out_.flush();
  check();
  if (file_) file_->finish();
}

void writeFile(const std::string& path, std::string_view text, const Replaces& replaces) {
  OutputFile file(path, replaces);
  file.stream() << text;
  file.finish();
}

void requireDistinct(const std::vector<NamedOutput>& outputs) {
  std::map<std::string, std::string> options;  // by what they name
  for (const NamedOutput& output : outputs) {
    const std::string file = output.path.empty() ? std::string() : identity(output.path);
    if (file.empty()) continue;
    const auto [first, is_new] = options.emplace(file, output.option);
    if (is_new) continue;
    throw UsageError(fmt::format("{} and {} both name {}, but need two different files",
                                 first->second, output.option, output.path));
  }
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
