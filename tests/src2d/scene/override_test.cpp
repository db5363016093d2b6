/// `--set key=value`.

#include <fmt/format.h>

#include "src2d/scene/names.h"
#include "src2d/scene/settings_list.h"
#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

constexpr std::string_view kScene = R"(
title = "From the file"
[merging]
velocity = 0.5
[[body]]
name = "a"
circle = 1
[[body]]
name = "dotted.name"
circle = 1
[[spring]]
body = "a"
to = [0, 1]
stiffness = 3
)";

Scene with(const Overrides& overrides) { return parseScene(kScene, "s.toml", overrides); }

TEST(Override, SetsWhatTheFileSaysOrLeavesOut) {
  const Scene scene = with({{"merging.velocity", "0.02"},
                            {"merging.cycles", "rigid"},
                            {"sleeping.steps", "7"},
                            {"unmerging.ordering", "false"},
                            {"gravity", "[0, -1.6]"},
                            {"duration", "3"}});
  EXPECT_EQ(scene.settings.merging.velocity, 0.02);
  EXPECT_EQ(scene.settings.merging.cycles, CycleCriterion::Rigid);
  EXPECT_EQ(scene.settings.sleeping.steps, 7);
  EXPECT_FALSE(scene.settings.unmerging.ordering);
  EXPECT_EQ(scene.gravity, Vec2(0, -1.6));
  EXPECT_EQ(scene.duration, 3);
}

TEST(Override, TheLastOneWins) { EXPECT_EQ(with({{"step", "0.1"}, {"step", "0.2"}}).step, 0.2); }

TEST(Override, ATextNeedsNoQuotes) {
  EXPECT_EQ(with({{"title", "Plain words"}}).title, "Plain words");
  EXPECT_EQ(with({{"title", "\"In quotes\""}}).title, "In quotes");
  EXPECT_EQ(with({{"solver.method", "\"pgs\""}}).settings.solver.method, SolverMethod::Pgs);
}

TEST(Override, ATitleIsAnyLine) {
  for (const char* title : {"a \"quote\"", "3", "true", "[list", "back\\slash", "Füße = 2"}) {
    EXPECT_EQ(with({{"title", title}}).title, title);
  }
  EXPECT_THROW(with({{"title", "two\nlines"}}), InputError);
}

TEST(Override, ReachesBodiesByNameAndByNumber) {
  const Scene scene = with({{"body.a.friction", "0.1"},
                            {"body.dotted.name.friction", "0.2"},
                            {"body[1].mass", "5"},
                            {"spring[0].stiffness", "9"}});
  EXPECT_EQ(scene.bodies[0].friction, 0.1);
  EXPECT_EQ(scene.bodies[1].friction, 0.2);
  EXPECT_EQ(scene.bodies[1].mass, 5);
  EXPECT_EQ(scene.springs[0].stiffness, 9);
}

TEST(Override, ReachesTablesInsideABody) {
  const Scene scene = parseScene(
      "[[body]]\nname = \"a\"\nmotion = \"scripted\"\ncircle = 1\n"
      "script = { axis = [1, 0], amplitude = 1, period = 2 }\n",
      "s.toml", {{"body.a.script.period", "8"}});
  EXPECT_EQ(std::get<Sinusoid>(scene.bodies[0].script.value()).period, 8);
  EXPECT_EQ(std::get<Sinusoid>(scene.bodies[0].script.value()).amplitude, 1);
}

TEST(Override, MistakesNameTheOptionAsTyped) {
  const auto error = [](const std::string& key, const std::string& value) {
    return errorOf(kScene, {{key, value}});
  };
  EXPECT_EQ(error("merging.velocty", "0.02"),
            "--set merging.velocty=0.02: unknown key 'velocty' in [merging] (did you mean "
            "'velocity'?)");
  EXPECT_EQ(error("mergin.velocity", "0.02"),
            "--set mergin.velocity=0.02: unknown key 'mergin' in the scene (did you mean "
            "'merging'?)");
  EXPECT_EQ(error("merging.velocity", "fast"),
            "--set merging.velocity=fast: 'velocity' in [merging] must be a number, but is the "
            "text \"fast\"");
  EXPECT_EQ(error("merging.velocity", "-1"),
            "--set merging.velocity=-1: 'velocity' in [merging] must be 0 or more, but is -1");
  EXPECT_EQ(error("gravity", "[0, 1"),
            "--set gravity=[0, 1: '[0, 1' is not a number, true or false, \"a text\" or [a, "
            "list]");
  EXPECT_EQ(error("body.b.mass", "1"), "--set body.b.mass=1: no body is called 'b'");
  EXPECT_EQ(error("body.1.mass", "2"),
            "--set body.1.mass=2: no body is called '1' (a number stands in brackets: "
            "body[1].mass)");
  EXPECT_EQ(error("spring.0.stiffness", "2"),
            "--set spring.0.stiffness=2: no spring is called '0' (a number stands in brackets: "
            "spring[0].stiffness)");
  EXPECT_EQ(errorOf("[[body]]\nname = \"brick\"\nbox = [1, 1]\nrepeat = { count = [2, 2], "
                    "spacing = [1, 1] }\n",
                    {{"body.brick[0,1].mass", "2"}}),
            "--set body.brick[0,1].mass=2: no body is called 'brick[0,1]' (it is a copy of "
            "'brick'; all have one description: body.brick.mass)");
  EXPECT_EQ(error("body.mass", "2"), "--set body.mass=2: write body[3].key or body.NAME.key");
  EXPECT_EQ(error("body[2].mass", "1"),
            "--set body[2].mass=1: there is no body[2]; the scene has "
            "2 of them, numbered from 0");
  EXPECT_EQ(error("body[x].mass", "1"), "--set body[x].mass=1: write body[3].key or body.NAME.key");
  EXPECT_EQ(error("body[0]", "1"), "--set body[0]=1: write body[3].key or body.NAME.key");
  EXPECT_EQ(error("force[0].from", "1"), "--set force[0].from=1: the scene has no [[force]]");
  EXPECT_EQ(error("a..b", "1"), "--set a..b=1: 'a..b' is not a key such as merging.velocity");
  EXPECT_EQ(error("", "1"), "--set =1: '' is not a key such as merging.velocity");
  EXPECT_EQ(error("step", ""),
            "--set step=: '' is not a number, true or false, \"a text\" or [a, list]");
  EXPECT_EQ(error("step", "1\nx = 2"), R"(--set step=1\nx = 2: a value is one line)");
}

/// Every setting of the list takes what it is written as, by `--set` as well as in a file.
TEST(Override, EverySettingCanBeSet) {
  Settings settings;
  forEachSetting(settings, [](const char* table, const char* key, auto& value, const Range& range) {
    using T = std::remove_reference_t<decltype(value)>;
    std::string text;
    if constexpr (std::is_enum_v<T>) {
      text = nameOf(value == T{1} ? T{0} : T{1});
    } else if constexpr (std::is_same_v<T, bool>) {
      text = value ? "false" : "true";
    } else {
      text = fmt::format("{}", value + 1 > range.upper ? range.lower : value + 1);
    }
    const std::string name = fmt::format("{}.{}", table, key);
    const Scene scene = parseScene("", "s.toml", {{name, text}});
    forEachSetting(scene.settings,
                   [&](std::string_view t, std::string_view k, const auto& found, const Range&) {
                     using F = std::remove_cvref_t<decltype(found)>;
                     if constexpr (std::is_same_v<F, T>) {
                       if (t == table && k == key) {
                         EXPECT_NE(found, value) << name;
                       }
                     }
                   });
  });
}

}  // namespace
}  // namespace merge2d
