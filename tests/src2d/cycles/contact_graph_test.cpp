#include "src2d/cycles/contact_graph.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src2d/core/error.h"

namespace merge2d {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ContactGraph parse(const std::string& text) { return parseContactGraph(text, "graph.txt"); }

/// The first line of the message, or what was read after all.
std::string errorOf(const std::string& text) {
  try {
    return std::to_string(parse(text).pairs.size()) + " pairs were read";
  } catch (const InputError& error) {
    return std::string(error.what()).substr(0, std::string(error.what()).find('\n'));
  }
}

TEST(ContactGraphText, HasBodiesPairsAndPoints) {
  const ContactGraph graph = parse("# a stack\npinned ground\nground A 2 0,0 1,-0.5\nA B 1\n");
  EXPECT_THAT(graph.bodies, ElementsAre("ground", "A", "B"));
  EXPECT_THAT(graph.pinned, ElementsAre(1, 0, 0));
  ASSERT_EQ(graph.pairs.size(), 2u);
  EXPECT_EQ(graph.pairs[0].contacts, 2);
  EXPECT_THAT(graph.pairs[0].points, ElementsAre(Vec2(0, 0), Vec2(1, -0.5)));
  EXPECT_EQ(graph.pairs[1].contacts, 1);
  EXPECT_THAT(graph.pairs[1].points, IsEmpty());
  EXPECT_THAT(graph.warnings, IsEmpty());
}

TEST(ContactGraphText, MayBeEmpty) {
  EXPECT_THAT(parse("").bodies, IsEmpty());
  EXPECT_THAT(parse("\n  \n# nothing\n\t# here\r\n").bodies, IsEmpty());
  EXPECT_THAT(parse("\xEF\xBB\xBF").bodies, IsEmpty());
}

TEST(ContactGraphText, ComesFromAnySystem) {
  for (const std::string text :
       {"pinned A\r\nA B 2\r\nB C 1 1,2\r\n", "\xEF\xBB\xBFpinned A\nA B 2\nB C 1 1,2",
        "\tpinned\t A  # the ground\n  A B\t2# firm\n\n B C 1  1,2 # here\n"}) {
    const ContactGraph graph = parse(text);
    EXPECT_THAT(graph.bodies, ElementsAre("A", "B", "C")) << text;
    EXPECT_THAT(graph.pinned, ElementsAre(1, 0, 0)) << text;
    ASSERT_EQ(graph.pairs.size(), 2u) << text;
    EXPECT_EQ(graph.pairs[0].contacts, 2) << text;
    EXPECT_THAT(graph.pairs[1].points, ElementsAre(Vec2(1, 2))) << text;
  }
}

TEST(ContactGraphText, TakesAnyWordAsAName) {
  EXPECT_THAT(parse("1 2 1\nbrick[0,1] Körper 2\nA pinned 1\n").bodies,
              ElementsAre("1", "2", "brick[0,1]", "Körper", "A", "pinned"));
}

TEST(ContactGraphText, MayPinAnywhereAndMoreThanOnce) {
  EXPECT_THAT(parse("A B 1\npinned B C\npinned B\nB C 0\n").pinned, ElementsAre(0, 1, 1));
}

TEST(ContactGraphText, AMistakeIsShownAtItsPlace) {
  EXPECT_EQ(errorOf("pinned A\n# x\nA B x\n"),
            "graph.txt:3:5: expected a count of contacts, got 'x'");
  try {
    parse("Körper B x\n");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "graph.txt:1:10: expected a count of contacts, got 'x'\n"
                 "    1 | Körper B x\n"
                 "      |          ^");
  }
}

TEST(ContactGraphText, ACountIsAWholeNumber) {
  for (const std::string count : {"-1", "1.5", "+1", "1e3", "two", "0x1", "1,1", "nan"}) {
    EXPECT_EQ(errorOf("A B " + count),
              "graph.txt:1:5: expected a count of contacts, got '" + count + "'");
  }
  EXPECT_EQ(errorOf("A B 1000001"),
            "graph.txt:1:5: expected a count of contacts of at most 1000000, got '1000001'");
  EXPECT_EQ(errorOf("A B 99999999999999999999"),
            "graph.txt:1:5: expected a count of contacts of at most 1000000, got "
            "'99999999999999999999'");
  EXPECT_EQ(errorOf("A B 0\nB C 1000000\nC D 007"), "3 pairs were read");
}

TEST(ContactGraphText, ALineHasTwoBodiesAndACount) {
  EXPECT_EQ(errorOf("A"), "graph.txt:1:2: expected a second body, got the end of the line");
  EXPECT_EQ(errorOf("A B  # and?\n"),
            "graph.txt:1:4: expected a count of contacts, got the end of the line");
  EXPECT_EQ(errorOf("pinned  \nA B 1"), "graph.txt:1:7: expected the names of pinned bodies");
}

TEST(ContactGraphText, AMistypedPinnedIsRecognised) {
  EXPECT_EQ(errorOf("pined A\n"),
            "graph.txt:1:8: expected a count of contacts, got the end of the line "
            "(did you mean 'pinned'?)");
  EXPECT_EQ(errorOf("Pinned A B\n"),
            "graph.txt:1:10: expected a count of contacts, got 'B' (did you mean 'pinned'?)");
}

TEST(ContactGraphText, ABodyDoesNotTouchItself) {
  EXPECT_EQ(errorOf("A B 1\nA A 1"), "graph.txt:2:3: expected two different bodies, got 'A' twice");
}

TEST(ContactGraphText, APairHasOneLine) {
  EXPECT_EQ(errorOf("A B 1\n\nA B 1\n"),
            "graph.txt:3:1: 'A' and 'B' already have line 1; give all their contacts there");
  EXPECT_EQ(errorOf("A B 1\nB A 1\n"),
            "graph.txt:2:1: 'B' and 'A' already have line 1; give all their contacts there");
}

TEST(ContactGraphText, PointsAreAllThereOrNone) {
  EXPECT_EQ(errorOf("A B 2 0,0"), "graph.txt:1:10: expected 2 points for 2 contacts, got 1");
  EXPECT_EQ(errorOf("A B 1 0,0 1,1  2,2"), "graph.txt:1:11: expected 1 point for 1 contact, got 3");
  EXPECT_EQ(errorOf("A B 0 0,0"), "graph.txt:1:7: expected 0 points for 0 contacts, got 1");
}

TEST(ContactGraphText, APointIsTwoFiniteNumbers) {
  for (const std::string point : {"1", "x,1", "1,x", "1,2,3", "1;2", "(1,2)"}) {
    EXPECT_EQ(errorOf("A B 1 " + point),
              "graph.txt:1:7: expected a point x,y, got '" + point + "'");
  }
  EXPECT_EQ(errorOf("A B 1 1, 2"),
            "graph.txt:1:7: expected a point x,y, got '1,' (no spaces around the comma)");
  for (const std::string point : {"nan,0", "0,inf", "-inf,1", "1e13,0", "0,NAN"}) {
    EXPECT_EQ(errorOf("A B 1 " + point),
              "graph.txt:1:7: expected finite coordinates of at most 1e+12, got '" + point + "'");
  }
  EXPECT_THAT(errorOf("A B 1 1e999,0"), HasSubstr("expected a point"));
  EXPECT_THAT(parse("A B 1 -1.5e-3,.5").pairs[0].points, ElementsAre(Vec2(-1.5e-3, 0.5)));
}

TEST(ContactGraphText, IsText) {
  EXPECT_EQ(errorOf(std::string("A B 1\nA\0C 1", 11)),
            "graph.txt:2:2: expected text, got the control character 0x00");
  EXPECT_EQ(errorOf("\x89PNG\r\n\x1a\n"),
            "graph.txt:1:1: expected text in UTF-8, got the byte 0x89");
}

TEST(ContactGraphText, IsUtf8) {
  EXPECT_EQ(parse("K\u00e4fer \u7bb1 1\n").bodies[0], "K\u00e4fer");
  const auto refused = [](int byte) {
    return fmt::format("graph.txt:2:3: expected text in UTF-8, got the byte 0x{:02x}", byte);
  };
  EXPECT_EQ(errorOf("A B 1\n\u00e4b\xff C 1\n"), refused(0xff));
  EXPECT_EQ(errorOf("A B 1\nab\x80 C 1\n"), refused(0x80)) << "the second byte of none";
  EXPECT_EQ(errorOf("A B 1\nab\xe4 C 1\n"), refused(0xe4)) << "a character is cut short";
  EXPECT_EQ(errorOf("A B 1\nab\xc0\xaf C 1\n"), refused(0xc0)) << "a slash in two bytes";
  EXPECT_EQ(errorOf("A B 1\nab\xed\xa0\x80 C 1\n"), refused(0xed)) << "half a pair";
  EXPECT_EQ(errorOf("A B 1 # \xff in a comment is nobody's name\n"), "1 pairs were read");
}

TEST(ContactGraphText, WarnsOfAPinnedBodyThatTouchesNothing) {
  EXPECT_THAT(parse("pinned gruond\nground A 2\n").warnings,
              ElementsAre("graph.txt:1:8: the pinned body 'gruond' touches nothing "
                          "(did you mean 'ground'?)"));
  EXPECT_THAT(parse("pinned P P\n").warnings,
              ElementsAre("graph.txt:1:8: the pinned body 'P' touches nothing"));
}

}  // namespace
}  // namespace merge2d
