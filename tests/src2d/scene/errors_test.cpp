/// What text scenes say when they are wrong: the place, what is wrong, and what to do.

#include <fmt/format.h>

#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A [[body]] with these lines from line 3 on, after a shape.
std::string body(std::string_view lines) {
  return fmt::format("[[body]]\ncircle = 1\n{}\n", lines);
}

TEST(Errors, AnUnknownKeyIsShownWithItsLineACaretAndASuggestion) {
  EXPECT_EQ(errorOf("format = 1\n[[body]]\nbox = [1, 1]\n  frction = 0.5 # µ\n"),
            "s.toml:4:3: unknown key 'frction' in [[body]] (did you mean 'friction'?)\n"
            "    4 |   frction = 0.5 # µ\n"
            "      |   ^");
}

TEST(Errors, UnknownKeysAndTablesAreErrors) {
  expectErrors({
      {"gravty = [0, 0]", "1:1: unknown key 'gravty' in the scene (did you mean 'gravity'?)"},
      {"[mergin]\nvelocity = 1",
       "1:2: unknown key 'mergin' in the scene (did you mean 'merging'?)"},
      {"[[joints]]\nkind = \"weld\"",
       "1:3: unknown key 'joints' in the scene (did you mean 'joint'?)"},
      {"[[bodies]]\ncircle = 1", "1:3: unknown key 'bodies' in the scene (did you mean 'body'?)"},
      {"[merging]\nvelocty = 1",
       "2:1: unknown key 'velocty' in [merging] (did you mean 'velocity'?)"},
      {body("script = { priod = 1 }"),
       "3:12: unknown key 'priod' in 'script' of [[body]] (did you "
       "mean 'period'?)"},
      {body("script = { phase = 1 }"),
       "3:12: unknown key 'phase' in 'script' of [[body]] (it may have 'axis', 'amplitude', "
       "'period', 'keyframes', 'velocity', 'spin')"},
      {"[camera]\nzoom = 2",
       "2:1: unknown key 'zoom' in [camera] (it may have 'follow', 'center', 'height', 'margin')"},
      {"[[body]]\nshapes = [{ bx = [1, 1] }]",
       "2:13: unknown key 'bx' in 'shapes[0]' of [[body]] (did you mean 'box'?)"},
  });
}

TEST(Errors, AKeyInTheWrongTableIsSentHome) {
  expectErrors({
      {"[camera]\nduration = 3",
       "2:1: unknown key 'duration' in [camera] (it belongs at the top, before the first [table])"},
      {"[merging]\niterations = 3",
       "2:1: unknown key 'iterations' in [merging] (it belongs in [solver])"},
      {"[solver]\nvelocity = 3",
       "2:1: unknown key 'velocity' in [solver] (it belongs in [merging] or [unmerging] or "
       "[sleeping])"},
  });
}

TEST(Errors, WordsOfOtherProgramsAreUnderstood) {
  expectErrors({
      {"[[body]]\nposition = [0, 1]",
       "2:1: unknown key 'position' in [[body]] (did you mean 'at'?)"},
      {"[[body]]\nRadius = 1", "2:1: unknown key 'Radius' in [[body]] (did you mean 'circle'?)"},
      {"[[body]]\nmotion = \"static\"\ncircle = 1",
       "2:10: 'motion' in [[body]] must be one of \"dynamic\", \"pinned\", \"scripted\", but "
       "is \"static\" (did you mean 'pinned'?)"},
  });
}

TEST(Errors, AKeyOfTheMaterialInAShapeBelongsInItsBody) {
  expectErrors({{"[[body]]\nshapes = [{ box = [1, 1], friction = 2 }]",
                 "2:27: unknown key 'friction' in 'shapes[0]' of [[body]] (it belongs in the "
                 "[[body]], or for all bodies in [material])"}});
}

TEST(Errors, TheFirstUnknownKeyOfATableIsReported) {
  EXPECT_EQ(firstLineOf("[[body]]\nzzz = 1\naaa = 2\n"),
            "s.toml:2:1: unknown key 'zzz' in [[body]]");
}

TEST(Errors, WordsMustBeOfTheirList) {
  expectErrors({
      {"[merging]\nmetric = \"niave\"",
       "2:10: 'metric' in [merging] must be one of \"corners\", \"naive\", but is \"niave\" "
       "(did you mean 'naive'?)"},
      {"[merging]\ncycles = \"triangel\"",
       "2:10: 'cycles' in [merging] must be one of \"off\", \"triangle\", \"rigid\", but is "
       "\"triangel\" (did you mean 'triangle'?)"},
      {"[solver]\nmethod = \"gauss\"",
       "2:10: 'method' in [solver] must be one of \"nncg\", \"block\", \"pgs\", \"newton\", but is "
       "\"gauss\""},
      {body("motion = \"Pinned\""),
       "3:10: 'motion' in [[body]] must be one of \"dynamic\", \"pinned\", \"scripted\", but is "
       "\"Pinned\" (did you mean 'pinned'?)"},
  });
}

TEST(Errors, TypesMustBeRight) {
  expectErrors({
      {body("mass = \"3\""), "3:8: 'mass' in [[body]] must be a number, but is the text \"3\""},
      {body("name = 3"), "3:8: 'name' in [[body]] must be a text in quotes, but is 3"},
      {body("at = 3"), "3:6: 'at' in [[body]] must be [x, y], but is 3"},
      {body("at = [1, 2, 3]"), "3:6: 'at' in [[body]] must be [x, y], but is a list of 3"},
      {body("at = [1, \"2\"]"),
       "3:10: 'at[1]' in [[body]] must be a number, but is the text \"2\""},
      {"[[body]]\nbox = [1]", "2:7: 'box' in [[body]] must be [width, height], but is a list of 1"},
      {"[[body]]\nbox = 2", "2:7: 'box' in [[body]] must be [width, height], but is 2"},
      {body("script = 3"),
       "3:10: 'script' in [[body]] must be a table, such as { velocity = [1, 0] }, but is 3"},
      {"[solver]\niterations = 10.0",
       "2:14: 'iterations' in [solver] must be a whole number, but is 10.0"},
      {"[unmerging]\nordering = 1",
       "2:12: 'ordering' in [unmerging] must be true or false, but is 1"},
      {"gravity = true", "1:11: 'gravity' in the scene must be [x, y], but is true"},
      {"gravity = 2020-01-01",
       "1:11: 'gravity' in the scene must be [x, y], but is a date or time"},
      {"solver = 3", "1:10: [solver] must be one table, written [solver]"},
      {"[[solver]]\nerp = 1", "1:1: [solver] must be one table, written [solver]"},
      {"[body]\ncircle = 1", "1:1: each body must be a table of its own, written [[body]]"},
      {"body = [1]", "1:8: each body must be a table of its own, written [[body]]"},
      {"format = 2",
       "1:10: 'format' in the scene must be 1, the only format there is so far, but "
       "is 2"},
  });
}

TEST(Errors, NumbersMustBeWithinTheirLimits) {
  expectErrors({
      {"step = nan",
       "1:8: 'step' in the scene must be a finite number below 1e12 in size, but is "
       "nan"},
      {"gravity = [0, -inf]",
       "1:15: 'gravity[1]' in the scene must be a finite number below 1e12 "
       "in size, but is -inf"},
      {"duration = 1e300",
       "1:12: 'duration' in the scene must be a finite number below 1e12 in "
       "size, but is 1e+300"},
      {"step = 0", "1:8: 'step' in the scene must be between 1e-6 and 1 s, but is 0"},
      {"duration = -1", "1:12: 'duration' in the scene must be between 1e-6 and 1e6 s, but is -1"},
      {"seed = -1", "1:8: 'seed' in the scene must be between 0 and 9.2e18, but is -1"},
      {body("mass = 0"), "3:8: 'mass' in [[body]] must be positive (1e-12 to 1e12), but is 0"},
      {body("mass = 1e-13"),
       "3:8: 'mass' in [[body]] must be positive (1e-12 to 1e12), but is 1e-13"},
      {body("density = -1.5"),
       "3:11: 'density' in [[body]] must be positive (1e-12 to 1e12), but is -1.5"},
      {body("friction = -0.1"), "3:12: 'friction' in [[body]] must be 0 or more, but is -0.1"},
      {body("restitution = 1.1"),
       "3:15: 'restitution' in [[body]] must be between 0 and 1, but is 1.1"},
      {body("at = [2e6, 0]"),
       "3:7: 'at[0]' in [[body]] must be between -1e6 and 1e6 m, but is 2000000.0"},
      {"[[body]]\nbox = [1, 0]",
       "2:11: 'box[1]' in [[body]] must be a positive length (1e-4 to 1e6 m), but is 0"},
      {"[[body]]\ncircle = -1",
       "2:10: 'circle' in [[body]] must be a positive length (1e-4 to 1e6 m), but is -1"},
      {"[solver]\niterations = 0",
       "2:14: 'iterations' in [solver] must be between 1 and 1000000, but is 0"},
      {"[solver]\niterations = 1000000000",
       "2:14: 'iterations' in [solver] must be between 1 and 1000000, but is 1000000000"},
      {"[merging]\nsteps = 30001",
       "2:9: 'steps' in [merging] must be between 1 and 30000, but is 30001"},
      {"seed = 9223372036854775807",
       "1:8: 'seed' in the scene must be between 0 and 9.2e18, but is 9223372036854775807"},
      {"[material]\nfriction = -1", "2:12: 'friction' in [material] must be 0 or more, but is -1"},
  });
}

TEST(Errors, ABodyNeedsExactlyOneShape) {
  expectErrors({
      {"[[body]]\nname = \"x\"", "1:1: [[body]] needs a shape: box, circle, polygon or shapes"},
      {"[[body]]\nshapes = []", "1:1: [[body]] needs a shape: box, circle, polygon or shapes"},
      {"[[body]]\nbox = [1, 1]\ncircle = 1",
       "3:10: [[body]] has both 'box' and 'circle'; for several shapes write shapes = [{ … }, { … "
       "}]"},
      {"[[body]]\nbox = [1, 1]\nshapes = [{ circle = 1 }]",
       "3:10: 'shapes' stands alone, without box, circle or polygon"},
      {"[[body]]\nshapes = [{ at = [1, 1] }]", "2:11: a shape needs box, circle or polygon"},
      {"[[body]]\nshapes = [3]", "2:11: 'shapes[0]' in [[body]] must be a table { … }, but is 3"},
  });
}

TEST(Errors, APolygonMustBeSimple) {
  EXPECT_THAT(firstLineOf("[[body]]\npolygon = [[0, 0], [1, 1], [1, 0], [0, 1]]"),
              StartsWith("s.toml:2:11: "));
  EXPECT_THAT(firstLineOf("[[body]]\npolygon = [[0, 0], [1, 1]]"), StartsWith("s.toml:2:11: "));
  std::string corners;
  for (int i = 0; i < 1001; ++i) corners += fmt::format("[{}, {}],", i, i * i);
  EXPECT_EQ(firstLineOf("[[body]]\npolygon = [" + corners + "]"),
            "s.toml:2:11: a polygon has at most 1000 corners, this one has 1001");
}

TEST(Errors, MotionMustFitTheOtherKeys) {
  expectErrors({
      {body("motion = \"scripted\""),
       "3:10: a scripted body needs a script, such as script = { velocity = [1, 0] }"},
      {body("script = { spin = 1 }"), "3:10: a script needs motion = \"scripted\""},
      {body("motion = \"pinned\"\nvelocity = [1, 0]"), "4:12: a pinned body does not move"},
      {body("motion = \"pinned\"\nspin = 1"), "4:8: a pinned body does not move"},
      {body("motion = \"scripted\"\nscript = { spin = 1 }\nvelocity = [1, 0]"),
       "5:12: a scripted body moves by its script only"},
      {body("motion = \"pinned\"\npinned_until = 1"),
       "4:16: only a dynamic body can be pinned for a while"},
  });
}

TEST(Errors, ScriptsAreChecked) {
  const auto script = [](std::string_view value) {
    return body(fmt::format("motion = \"scripted\"\nscript = {}", value));
  };
  expectErrors({
      {script("{ axis = [1, 0], period = 1 }"),
       "4:10: a script with 'axis' needs 'amplitude' too: a script has 'axis', 'amplitude' and "
       "'period', or 'keyframes', or "
       "'velocity' and 'spin'"},
      {script("{ amplitude = 1, axis = [1, 0] }"),
       "4:10: a script with 'axis' needs 'period' too: a script has 'axis', 'amplitude' and "
       "'period', or 'keyframes', or "
       "'velocity' and 'spin'"},
      {script("{ }"),
       "4:10: the script is empty: a script has 'axis', 'amplitude' and 'period', or 'keyframes', "
       "or "
       "'velocity' and 'spin'"},
      {script("{ axis = [0, 0], amplitude = 1, period = 1 }"),
       "4:19: 'axis' must not be [0, 0]: it tells in which direction the body moves"},
      {script("{ axis = [1, 0], amplitude = 1, period = 0 }"),
       "4:51: 'period' in 'script' of [[body]] must be positive (1e-12 to 1e12), but is 0"},
      {script("{ velocity = [1, 0], period = 2 }"),
       "4:23: 'period' and 'velocity' belong to different kinds of script: a script has 'axis', "
       "'amplitude' and 'period', or 'keyframes', or "
       "'velocity' and 'spin'"},
      {script("{ spin = 1, keyframes = [[0, 0, 0, 0]] }"),
       "4:19: 'keyframes' and 'spin' belong to different kinds of script: a script has 'axis', "
       "'amplitude' and 'period', or 'keyframes', or "
       "'velocity' and 'spin'"},
      {script("{ keyframes = [] }"), "4:24: a script needs at least one key frame"},
      {script("{ keyframes = [[0, 0, 0, 0], [0, 1, 1, 0]] }"),
       "4:39: the times of key frames must increase, but 0 follows 0"},
      {script("{ keyframes = [[0, 0, 0]] }"),
       "4:25: 'keyframes[0]' in 'script' of [[body]] must be [t, x, y, degrees], but is a list of "
       "3"},
      {script("{ keyframes = [[-1, 0, 0, 0]] }"),
       "4:25: key frames start at time 0 or later, but this one is at -1 s"},
      {script("{ keyframes = [[0, 2e6, 0, 0]] }"),
       "4:25: a key frame stands further than 1e6 m from the origin"},
      {script("{ keyframes = [[0, 0, 0, 0]] }\nat = [0, 1]"),
       "5:6: the key frames say where the body is, not 'at'"},
      {script("{ keyframes = [[0, 0, 0, 0]] }\nangle = 1"),
       "5:9: the key frames say the angle, not 'angle'"},
      {script("{ keyframes = [[0, 0, 0, 0]] }\nrepeat = { count = [1, 2], spacing = [1, 1] }"),
       "5:10: key frames are places in the world, so all copies would be in one"},
  });
}

TEST(Errors, NamesAreUniqueAndPlain) {
  expectErrors({
      {"[[body]]\nname = \"a\"\ncircle = 1\n[[body]]\nname = \"a\"\ncircle = 1",
       "5:8: two bodies are called 'a': the first is in line 2"},
      {"[[body]]\nname = \"a\"\ncircle = 1\nrepeat = { count = [1, 2], spacing = [1, 3] }\n"
       "[[body]]\nname = \"a[0,1]\"\ncircle = 1",
       "6:8: two bodies are called 'a[0,1]': the first is in line 2"},
      {"[[body]]\ncircle = 1\n[[body]]\nname = \"body1\"\ncircle = 1",
       "4:8: two bodies are called 'body1': the first is in line 1"},
      {"[[body]]\nname = \"body2\"\ncircle = 1\n[[body]]\ncircle = 1",
       "4:1: a body without a name is called 'body2' here, but so is the one in line 2: name it"},
      {body("name = \"\""), "3:8: a name must not be empty"},
      {body("name = \"a\\nb\""), "3:8: a name is one line without control characters"},
      {body("name = \"a\\u009Bb\""), "3:8: a name is one line without control characters"},
      {body("name = \"" + std::string(101, 'x') + "\""), "3:8: a name has at most 100 characters"},
  });
}

TEST(Errors, ControlCharactersOfTextsAreShownEscaped) {
  EXPECT_EQ(errorOf("[[body]]\nname = \"a\"\nbox = \"x\\u0000y\"\n"),
            "s.toml:3:7: 'box' in [[body]] must be [width, height], but is the text "
            "\"x\\u0000y\"\n"
            "    3 | box = \"x\\u0000y\"\n"
            "      |       ^");
  expectErrors({
      {R"(step = "\u001b[31m\u009b\u007f")", R"(1:8: 'step' in the scene must be a number, but is )"
                                             R"(the text "\u001b[31m\u009b\u007f")"},
      {R"(step = "two\nlines\tand\r\b\f")", R"(1:8: 'step' in the scene must be a number, but )"
                                            R"(is the text "two\nlines\tand\r\b\f")"},
      {R"("frc\ntion" = 1)", R"(1:1: unknown key 'frc\ntion' in the scene)"},
      {R"(step = "ööööööööööööööööööööö")",
       "1:8: 'step' in the scene must be a number, but is the "
       "text \"öööööööööööööööööööö\""},
  });
}

TEST(Errors, ControlCharactersOfFileNamesAreShownEscaped) {
  try {
    loadScene("two\nlines\x1b[31m\xff.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "there is no file two\\nlines\\u001b[31m\xEF\xBF\xBD.toml");
  }
}

TEST(Errors, RepeatIsChecked) {
  expectErrors({
      {body("repeat = { count = [2, 2] }"), "3:10: 'repeat' of [[body]] needs the key 'spacing'"},
      {body("repeat = { count = 3, spacing = [1, 1] }"),
       "3:20: 'count' in 'repeat' of [[body]] must be [columns, rows], but is 3"},
      {body("repeat = { count = [0, 2], spacing = [1, 1] }"),
       "3:21: 'count[0]' in 'repeat' of [[body]] must be between 1 and 100000, but is 0"},
      {body("repeat = { count = [1000, 1000], spacing = [1, 1] }"),
       "3:10: 1000 x 1000 copies make 1000000 bodies in all, but a scene has at most 100000"},
      {body("repeat = { count = [100000, 100000], spacing = [1, 1] }"),
       "3:10: 100000 x 100000 copies make 10000000000 bodies in all, but a scene has at most "
       "100000"},
      {body("[[body]]\ncircle = 1\nrepeat = { count = [1000, 100], spacing = [1, 1] }"),
       "5:10: 1000 x 100 copies make 100001 bodies in all, but a scene has at most 100000"},
      {body("repeat = { count = [9223372036854775807, 1], spacing = [1, 1] }"),
       "3:21: 'count[0]' in 'repeat' of [[body]] must be between 1 and 100000, but is "
       "9223372036854775807"},
      {body("repeat = { count = [1, 1000], spacing = [1, 10000] }"),
       "3:10: 'body1[0,101]' stands further than 1e6 m from the origin"},
  });
}

TEST(Errors, AnEmitterNeedsAnEndAndARoom) {
  const auto emitter = [](std::string_view lines) {
    return fmt::format("[[emitter]]\nname = \"e\"\nevery = 1\ncircle = 1\n{}\n", lines);
  };
  expectErrors({
      {emitter(""), "1:1: an emitter needs an end: 'count' or 'until'"},
      {emitter("start = 3\nuntil = 2"),
       "6:9: the emitter ends before it starts: 'until' must exceed 'start'"},
      {emitter("count = 0"), "5:9: 'count' in [[emitter]] must be between 1 and 100000, but is 0"},
      {emitter("until = 1e9"),
       "5:9: one body every 1 s until 1000000000 s makes more than the 100000 that a scene may "
       "have"},
      {emitter("count = 99999\n[[body]]\ncircle = 1\n[[body]]\ncircle = 1"),
       "5:9: a scene has at most 100000 bodies, but with the emitted ones this makes 100001"},
      {emitter("count = 3\nmotion = \"pinned\""), "6:10: an emitter's bodies are dynamic"},
      {emitter("count = 3\nspread = [-1, 0]"),
       "6:11: 'spread[0]' in [[emitter]] must be between 0 and 1e6 m, but is -1"},
      {emitter("count = 3\nspread = [0, 2e6]"),
       "6:14: 'spread[1]' in [[emitter]] must be between 0 and 1e6 m, but is 2000000.0"},
      {emitter("count = 3\nrepeat = {}"), "6:1: unknown key 'repeat' in [[emitter]]"},
      {"[[emitter]]\ncount = 3\ncircle = 1", "1:1: [[emitter]] needs the key 'every'"},
      {emitter("count = 3\n[[body]]\nname = \"e[1]\"\ncircle = 1"),
       "2:8: the emitter's bodies 'e[0]', … clash with 'e[1]'"},
  });
}

}  // namespace
}  // namespace merge2d
