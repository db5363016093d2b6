/// Whatever bytes a scene file has, loading gives a scene or an InputError.

#include <fmt/format.h>

#include <random>

#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

constexpr std::string_view kSeedScene = R"(format = 1
title = "µ \" \\"
gravity = [0, -9.81]
[camera]
center = [0, 5]
height = 12.0
[merging]
cycles = "rigid"
[[body]]
name = "a"
motion = "scripted"
shapes = [{ box = [1, 2], at = [0, 1], angle = 30 }, { polygon = [[0, 0], [1, 0], [0, 1]] }]
script = { keyframes = [[0, 0, 0, 0], [1, 2, 3, 4]] }
[[body]]
name = 'b'
circle = 1e-1
repeat = { count = [2, 2], spacing = [1, 1], stagger = 0.5 }
[[spring]]
body = "b[0,0]"
to_body = "a"
stiffness = 1_000
[[magnet]]
body = "a"
on = [[0, 1]] # end
[[emitter]]
every = 1
until = 3
circle = 1
)";

/// Loads, and lets only the agreed errors out.
void load(std::string_view text) {
  try {
    toToml(parseScene(text, "s.toml"));
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with("s.toml")) << error.what();
  }
}

TEST(Hostile, ThePlainSceneLoads) { EXPECT_EQ(errorOf(kSeedScene), "no error"); }

TEST(Hostile, ASceneCutOffAnywhereNeverCrashes) {
  for (std::size_t length = 0; length < kSeedScene.size(); ++length) {
    load(kSeedScene.substr(0, length));
  }
}

TEST(Hostile, ASceneWithOneWrongByteNeverCrashes) {
  for (std::size_t i = 0; i < kSeedScene.size(); ++i) {
    for (const char c : std::string_view("\0\xff\"'[]{}=,.#\n 9e-", 17)) {
      std::string text(kSeedScene);
      text[i] = c;
      load(text);
    }
  }
}

TEST(Hostile, ASceneWithAPieceMissingOrTwiceNeverCrashes) {
  std::mt19937_64 engine{3};
  for (int i = 0; i < 2000; ++i) {
    const std::size_t from = engine() % kSeedScene.size();
    const std::size_t length = engine() % 40;
    std::string text(kSeedScene);
    if (i % 2 == 0) text.erase(from, length);
    if (i % 2 == 1) text.insert(engine() % text.size(), kSeedScene.substr(from, length));
    load(text);
  }
}

TEST(Hostile, RandomBytesNeverCrash) {
  std::mt19937_64 engine{5};
  for (int i = 0; i < 2000; ++i) {
    std::string text(engine() % 200, ' ');
    for (char& c : text) c = static_cast<char>(engine() % 256);
    load(text);
  }
}

TEST(Hostile, RandomTokensNeverCrash) {
  constexpr std::array<std::string_view, 24> kTokens{
      "[", "]",    "[[",     "]]",   "{",      "}",      "=",   ",",   "\n", ".",    "\"", "'",
      "#", "body", "solver", "name", "circle", "\"\"\"", "'''", "1e9", "-1", "true", " ",  "\\"};
  std::mt19937_64 engine{9};
  for (int i = 0; i < 5000; ++i) {
    std::string text;
    for (std::uint64_t k = engine() % 30; k > 0; --k) text += kTokens[engine() % kTokens.size()];
    load(text);
  }
}

TEST(Hostile, DeepNestingIsAnError) {
  for (const std::string_view opening : {"[", "{a=", "[{a=", "a.", "[[", "{a.a="}) {
    for (const std::string_view start : {"x = ", "", "[", "[["}) {
      std::string text(start);
      for (int i = 0; i < 200'000; ++i) text += opening;
      load(text);
      load(text + "1");
    }
  }
}

TEST(Hostile, HugeNumbersOfCopiesAreAnErrorAtOnce) {
  for (const std::string_view count : {"[100000, 100000]", "[2147483647, 2]", "[100001, 1]",
                                       "[9223372036854775807, 9223372036854775807]", "[-1, -1]"}) {
    EXPECT_NE(errorOf(fmt::format(
                  "[[body]]\ncircle = 1\nrepeat = {{ count = {}, spacing = [0, 0] }}", count)),
              "no error");
  }
}

TEST(Hostile, ALargeSceneLoadsInReasonableTime) {
  std::string text;
  for (int i = 0; i < 20'000; ++i) {
    text += fmt::format("[[body]]\nname = \"b{}\"\ncircle = 1\nat = [{}, 0]\n", i, 2 * i);
  }
  EXPECT_EQ(parseScene(text, "s.toml").bodies.size(), 20'000u);
}

TEST(Hostile, ATooLargeFileIsRefused) {
  const TemporaryFile file("large.toml", "");
  std::filesystem::resize_file(file.path(), (64u << 20u) + 1);
  try {
    loadScene(file.path().string());
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("a scene file has at most 64 MB"));
  }
}

TEST(Hostile, OverridesOfAnyBytesNeverCrash) {
  std::mt19937_64 engine{11};
  constexpr std::string_view kAlphabet = "abody[].0123=\"'{}, \n\\-e";
  const auto word = [&] {
    std::string text;
    for (std::uint64_t k = engine() % 14; k > 0; --k)
      text += kAlphabet[engine() % kAlphabet.size()];
    return text;
  };
  for (int i = 0; i < 5000; ++i) {
    try {
      parseScene(kSeedScene, "s.toml", {{i % 2 == 0 ? "body" + word() : word(), word()}});
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace merge2d
