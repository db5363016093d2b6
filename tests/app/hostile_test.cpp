/// Wrong scene files on the command line: one error that names the file, and nothing else.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "tests/app/program_testing.h"
#include "tests/src2d/scene/png_testing.h"

namespace merge2d {
namespace {

/// What a file holds, and what the program says about it behind the file's name.
struct Wrong {
  std::string bytes;
  std::string sentence;
};

std::string picture(std::uint32_t width, std::uint32_t height) {
  return encodePng(width, height, {}, [](auto...) { return std::string(24, '0') + "11111111"; });
}

/// A picture of one pixel whose header claims another size.
std::string pictureClaiming(std::uint32_t width, std::uint32_t height) {
  const std::string header = bigEndian(width) + bigEndian(height) + std::string("\x08\6\0\0\0", 5);
  const std::string whole = picture(1, 1);
  constexpr std::size_t kHeaderEnd = 33;
  return whole.substr(0, 8) + pngChunk("IHDR", header) + whole.substr(kHeaderEnd);
}

std::string ball(const std::string& lines) { return "[[body]]\ncircle = 1\n" + lines + "\n"; }

class HostileFile : public ProgramTest {
 protected:
  /// Each file in each command that is given; `more` follows the file's name.
  void expectRefusals(const std::map<std::string, Wrong>& files, const Words& commands,
                      const Words& more = {}) {
    for (const auto& [name, wrong] : files) {
      for (const std::string& command : commands) {
        write(name, wrong.bytes);
        Words arguments = {command, name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expectOneError(run(arguments), fmt::format("error: {}:{}", name, wrong.sentence), command);
        EXPECT_THAT(this->files(), ElementsAre(name)) << command << " leaves no other file";
        fs::remove(folder() / name);
      }
    }
  }

 private:
  static void expectOneError(const Outcome& outcome, const std::string& start,
                             const std::string& command) {
    EXPECT_EQ(outcome.code, 3) << command << ": " << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty()) << command;
    EXPECT_THAT(outcome.err, StartsWith(start)) << command;
    EXPECT_EQ(outcome.err.find("error:", 1), std::string::npos) << command << ": " << outcome.err;
    EXPECT_EQ(outcome.err.find("png_"), std::string::npos) << outcome.err;
  }
};

const std::map<std::string, Wrong>& pictures() {
  static const std::string whole = picture(8, 8);
  static const std::map<std::string, Wrong> files = {
      {"empty.png", {"", " the file is empty\n"}},
      {"words.png", {"Dear diary, nothing happened.\n", " not a PNG picture\n"}},
      {"photo.png", {"\xFF\xD8\xFF\xE0", " this is a JPEG picture, whatever its name: "}},
      {"huge.png",
       {pictureClaiming(60'000, 60'000),
        " a drawing has at most 4194304 pixels, this one has 60000 x 60000\n"}},
      {"endless.png",
       {pictureClaiming(0xffffffff, 0xffffffff),
        " a drawing has at most 4194304 pixels, this one has 4294967295 x 4294967295\n"}},
      {"flat.png", {pictureClaiming(0, 1), " not a whole PNG picture ("}},
      {"larger.png", {pictureClaiming(100, 100), " not a whole PNG picture ("}},
  };
  return files;
}

const std::map<std::string, Wrong>& texts() {
  static const std::map<std::string, Wrong> files = {
      {"cut.toml", {"step = 0.01\ntitle = \"Half a t", "2:9: the quote that ends this text"}},
      {"latin.toml", {ball("name = \"B\xe4r\""), "3:10: this is not valid UTF-8"}},
      {"binary.toml",
       {std::string("\x7F"
                    "ELF\2\1\xB5\0",
                    8),
        "1:7: this is not valid UTF-8"}},
      {"drawing.toml",
       {picture(2, 2), " this is a PNG picture: the name of a drawn scene must end in .png\n"}},
      {"drawing.jpg",
       {picture(2, 2), " this is a PNG picture: the name of a drawn scene must end in .png\n"}},
      {"photo.jpg",
       {"\xFF\xD8\xFF\xE0",
        " this is a JPEG picture: a drawn scene is a PNG picture, whose name ends in .png\n"}},
      {"zeros.toml", {std::string(1000, '\0'), "1:1: a line is key = value, or a [heading]\n"}},
      {"deep.toml", {"x = " + std::string(100'000, '['), "1:21: lists and tables nest deeper"}},
      {"tables.toml", {"x" + std::string(100'000, '.'), "1:18: lists and tables nest deeper"}},
      {"large.toml",
       {"step = 99999999999999999999999999\n", "1:8: 99999999999999999999999999 is too large\n"}},
      {"infinite.toml", {"duration = 1e999\n", "1:12: 1e999 is too large\n"}},
      {"sweeps.toml",
       {"[solver]\niterations = 1000000000\n",
        "2:14: 'iterations' in [solver] must be between 1 and 1000000, but is 1000000000\n"}},
      {"copies.toml",
       {ball("repeat = { count = [100000, 100000], spacing = [1, 1] }"),
        "3:10: 100000 x 100000 copies make 10000000000 bodies in all, but a scene has at most "
        "100000\n"}},
      {"type.toml",
       {ball("mass = \"heavy\""),
        "3:8: 'mass' in [[body]] must be a number, but is the text \"heavy\"\n"}},
  };
  return files;
}

TEST_F(HostileFile, PicturesAreRefused) { expectRefusals(pictures(), {"validate", "run"}); }

TEST_F(HostileFile, TextsAreRefused) { expectRefusals(texts(), {"validate", "run"}); }

TEST_F(HostileFile, APictureCutOffAnywhereIsRefused) {
  const std::string whole = picture(8, 8);
  std::map<std::string, Wrong> files;
  for (const std::size_t length : {std::size_t{1}, std::size_t{8}, std::size_t{20}, std::size_t{33},
                                   whole.size() / 2, whole.size() - 12, whole.size() - 1}) {
    files[fmt::format("cut{}.png", length)] = {whole.substr(0, length),
                                               " not a whole PNG picture (its end is missing)\n"};
  }
  expectRefusals(files, {"validate", "run"});
}

TEST_F(HostileFile, NothingThatWasAskedForIsWritten) {
  expectRefusals(pictures(), {"validate"}, {"--to", "out.toml"});
  expectRefusals(texts(), {"validate"}, {"--to", "out.toml"});
  expectRefusals(pictures(), {"run"}, {"--trace", "out.jsonl", "--csv", "out.csv"});
  expectRefusals(texts(), {"run"}, {"--trace", "out.jsonl", "--csv", "out.csv"});
  expectRefusals(pictures(), {"render"}, {"--output", "frames"});
  expectRefusals(texts(), {"render"}, {"--output", "frames"});
}

/// No file says nothing wrong by saying nothing: all keys have defaults.
TEST_F(HostileFile, AnEmptyTextIsASceneWithoutBodies) {
  write("empty.toml", "");
  const Outcome outcome = run({"validate", "empty.toml"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("bodies    0\n"),
                                 HasSubstr("warning: empty.toml: the scene has no bodies\n")));
}

}  // namespace
}  // namespace merge2d
