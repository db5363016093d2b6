/// What refers to bodies, and says which body was meant when there is none of that name.

#include <fmt/format.h>

#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

/// Bodies "d" (dynamic), "p" (pinned) and "s" (scripted), and these lines from line 13 on.
std::string withBodies(std::string_view lines) {
  return fmt::format(R"([[body]]
name = "d"
circle = 1
[[body]]
name = "p"
motion = "pinned"
circle = 1
[[body]]
name = "s"
motion = "scripted"
script = {{ spin = 1 }}
circle = 1
{})",
                     lines);
}

TEST(References, MustExistAndMakeSense) {
  expectErrors({
      {withBodies("[[spring]]\nbody = \"dd\"\nto = [0, 0]\nstiffness = 1"),
       "14:8: no body is called 'dd' (did you mean 'd'?)"},
      {withBodies("[[spring]]\nbody = \"d\"\nto_body = \"q\"\nstiffness = 1"),
       "15:11: no body is called 'q': there are 'd', 'p', 's'"},
      {withBodies("[[spring]]\nbdy = \"d\""),
       "14:1: unknown key 'bdy' in [[spring]] (did you mean 'body'?)"},
      {withBodies("[[spring]]\nto = [0, 0]"), "13:1: [[spring]] needs the key 'body'"},
      {withBodies("[[spring]]\nbody = \"d\"\nto = [0, 0]"),
       "13:1: [[spring]] needs the key 'stiffness'"},
      {withBodies("[[spring]]\nbody = \"d\"\nstiffness = 1"),
       "13:1: [[spring]] needs one other end: 'to' (a point) or 'to_body' and 'to_anchor'"},
      {withBodies("[[spring]]\nbody = \"d\"\nto = [0, 0]\nto_anchor = [0, 0]\nstiffness = 1"),
       "16:13: 'to_anchor' is a point of 'to_body', which is missing"},
      {withBodies("[[spring]]\nbody = \"d\"\nto_body = \"d\"\nstiffness = 1"),
       "15:11: both ends of the spring are on the same body"},
      {withBodies("[[spring]]\nbody = \"p\"\nto = [0, 0]\nstiffness = 1"),
       "14:8: a spring has no effect on 'p', which is pinned"},
      {withBodies("[[spring]]\nbody = \"s\"\nto = [0, 0]\nstiffness = 1"),
       "14:8: a spring has no effect on 's', which is scripted"},
      {withBodies("[[impulse]]\nbody = \"s\"\nat = [0, 0]\nimpulse = [1, 0]"),
       "14:8: an impulse has no effect on 's', which is scripted"},
      {withBodies("[[impulse]]\nbody = \"d\"\nat = [0, 0]"),
       "13:1: [[impulse]] needs the key 'impulse'"},
      {withBodies("[[force]]\nbody = \"p\"\nforce = [1, 0]"),
       "14:8: a force has no effect on 'p', which is pinned"},
      {withBodies("[[force]]\nbody = \"d\"\nforce = [1, 0]\nfrom = 2\nuntil = 2"),
       "17:9: a force must end after it begins, but it begins at 2 s and ends at 2 s"},
      {withBodies("[[magnet]]\nbody = \"d\"\non = [[0, 2], [1, 3]]"),
       "15:15: the intervals of a magnet must follow one another, but this one begins at 1 s, and "
       "the one before ends at 2 s"},
      {withBodies("[[magnet]]\nbody = \"d\"\non = [[3, 1]]"),
       "15:7: an interval must end after it begins, but it begins at 3 s and ends at 1 s"},
      {withBodies("[[magnet]]\nbody = \"d\"\non = [[-3, 1]]"),
       "15:7: time begins at 0, but this interval at -3 s"},
      {withBodies("[[magnet]]\nbody = \"d\"\non = []"),
       "15:6: this magnet is never on: write on = [[from, until]], or leave 'on' out for always"},
      {withBodies("[[magnet]]\nbody = \"d\"\n[[magnet]]\nbody = \"p\"\n[[magnet]]\nbody = \"d\""),
       "18:8: 'd' is a magnet already, by line 14: write all its times there, on = [[0, 2], [4, "
       "6]]"},
      {withBodies("[[magnet]]\nbody = \"d\"\non = [0, 2]"),
       "15:7: 'on[0]' in [[magnet]] must be a pair, as in on = [[0, 2], [4, 6]], but is 0"},
      {withBodies("[[spring]]\nbody = \"d\"\nto = [0, 0]\nto_body = \"p\"\nstiffness = 1"),
       "15:6: a spring ends at a point ('to') or at a body ('to_body'), not at both; 'to_anchor' "
       "is "
       "the point of that body"},
  });
}

TEST(References, ASpringMayHoldAPinnedBodyAndADynamicOne) {
  EXPECT_EQ(errorOf(withBodies("[[spring]]\nbody = \"p\"\nto_body = \"d\"\nstiffness = 1")),
            "no error");
}

TEST(References, ACopyMustBeNamed) {
  EXPECT_EQ(firstLineOf("[[body]]\nname = \"b\"\ncircle = 1\n"
                        "repeat = { count = [2, 2], spacing = [3, 3] }\n"
                        "[[magnet]]\nbody = \"b\"\n"),
            "s.toml:6:8: 'b' is repeated: say which copy, such as 'b[0,0]'");
}

TEST(References, TellWhichBodyMayBeMeantOrWhichThereAre) {
  const auto magnet = [](std::string_view name, std::string_view more = "") {
    return firstLineOf(fmt::format("[[magnet]]\nbody = \"{}\"\n{}", name, more));
  };
  const std::string wall =
      "[[body]]\nname = \"brick\"\ncircle = 1\nrepeat = { count = [3, 2], spacing = [3, 3] }\n";
  const std::string crane = wall + "[[body]]\nname = \"crane hook\"\ncircle = 1\n";
  EXPECT_EQ(magnet("x"), "s.toml:2:8: no body is called 'x': the scene has no [[body]]");
  EXPECT_EQ(magnet("x", "[[body]]\nname = \"a\"\ncircle = 1"),
            "s.toml:2:8: no body is called 'x': there is only 'a'");
  EXPECT_EQ(magnet("x", crane),
            "s.toml:2:8: no body is called 'x': there are 'brick[0,0]' to 'brick[2,1]', 'crane "
            "hook'");
  EXPECT_EQ(magnet("brick[9,9]", crane),
            "s.toml:2:8: no body is called 'brick[9,9]': the copies of 'brick' are 'brick[0,0]' to "
            "'brick[2,1]'");
  EXPECT_EQ(magnet("brik", crane),
            "s.toml:2:8: no body is called 'brik' (did you mean 'brick[0,0]'?)");
  EXPECT_EQ(magnet("Crane", crane),
            "s.toml:2:8: no body is called 'Crane' (did you mean 'crane hook'?)");
  std::string many;
  for (int i = 0; i < 9; ++i) many += "[[body]]\ncircle = 1\n";
  EXPECT_EQ(magnet("x", many), "s.toml:2:8: no body is called 'x'") << "the list would be long";
}

TEST(References, AnEmittedBodyCannotBeReferredTo) {
  const std::string rain = "[[emitter]]\nname = \"rain\"\ncircle = 1\nevery = 1\ncount = 3\n";
  for (const char* name : {"rain[0]", "rain"}) {
    EXPECT_EQ(
        firstLineOf(fmt::format("{}[[joint]]\nkind = \"weld\"\nbodies = [\"{}\"]", rain, name)),
        fmt::format("s.toml:8:11: '{}' is emitted while the scene runs: joints, springs, "
                    "impulses, forces and magnets need a [[body]]",
                    name));
  }
}

}  // namespace
}  // namespace merge2d
