/// What is said of texts that are no TOML.

#include <fmt/format.h>

#include "tests/src2d/scene/scene_testing.h"

namespace merge2d {
namespace {

TEST(Errors, LongLinesAreCutAndControlCharactersHidden) {
  const std::string text = "x = \"" + std::string(300, 'a') + "\x1b[31m\"\n";
  const std::string message = errorOf(text);
  EXPECT_EQ(message.find('\x1b'), std::string::npos);
  EXPECT_LT(message.size(), 300u);
}

TEST(Errors, NestingIsLimited) {
  EXPECT_EQ(firstLineOf("x = " + std::string(17, '[')),
            "s.toml:1:21: lists and tables nest deeper than 16 levels");
  EXPECT_EQ(firstLineOf("a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s = 1"),
            "s.toml:1:34: lists and tables nest deeper than 16 levels");
}

TEST(Errors, SyntaxErrorsSayWhatToDo) {
  expectErrors({
      {"title = tower", "1:9: a text needs quotes: \"tower\""},
      {"title = \"tower\nstep = 1", "1:9: the quote that ends this text is missing"},
      {"gravity = [0 1]", "1:14: a comma is missing here, or the ] before it"},
      {"gravity = [0, 1\nstep = 1",
       "2:1: the list that begins in line 1 misses a comma or its ] before here"},
      {"[body\nx = 1", "1:6: this heading should read [body]"},
      {"[[body]\nx = 1", "1:8: this heading should read [[body]]"},
      {"step 3", "1:6: '=' and a value are missing here"},
      {"step: 3", "1:5: write '=' instead of ':'"},
      {"step =", "1:7: the value after '=' is missing"},
      {"step = \nseed = 1", "1:8: the value after '=' is missing"},
      {"step = 1\nstep = 2", "2:1: 'step' is given twice"},
      {"[merging]\n[merging]", "2:1: there are two tables [merging]"},
      {"[[body]]\n[body]", "2:1: 'body' is a list of tables elsewhere: write [[body]] each time"},
      {"step = 0,01", "1:9: one value only: decimals have a point, lists stand in [ ]"},
      {"step = .5", "1:8: a number has digits on both sides of its point: 0.5, 1.0"},
      {"step = 1e999", "1:8: 1e999 is too large"},
      {"step = 10ms", "1:8: '10ms' is not a number (numbers have no units)"},
      {"step = 10 ms", "1:11: only a # comment may follow the value (numbers have no units)"},
      {"step = 1 seed = 2", "1:10: each key stands in a line of its own"},
      {"x = True", "1:5: write true, in small letters"},
      {"x = yes", "1:5: write true or false"},
      {"x = (1, 2)", "1:5: a list stands in square brackets: [1, 2]"},
      {"x = { a = 1 b = 2 }", "1:13: a comma is missing here, or the } before it"},
      {"x = { a = 1,\nb = 2 }", "1:13: a table in { } stands on one line: close it with }"},
      {"x = [1, 2]]", "1:11: this ] closes nothing"},
      {"x = \"a\\q\"", "1:8: write \\\\ for a backslash, or put the text in '…'"},
      {"step = 1\nx = { a = }", "2:11: the value after '=' is missing"},
      {"step = 1\n[+x]\nseed = 1", "2:1: a line is key = value, or a [heading]"},
      {"x = “abc”", "1:5: use plain quotes: \"…\""},
      {"x = 45°", "1:5: '45°' is not a number (numbers have no units)"},
      {"x = 90*2", "1:5: '90*2' is not a number (nothing is computed here)"},
      {"x = pi", "1:5: 'pi' is not a number (nothing is computed here)"},
      {"x = pi*2", "1:5: 'pi*2' is not a number (nothing is computed here)"},
      {"grün = 3", "1:3: letters beyond a-z stand in \"quotes\" or after a #"},
      {"= 3", "1:1: a line is key = value, or a [heading]"},
  });
}

TEST(Errors, WhatIsNotUtf8IsShownWhereItIs) {
  constexpr std::string_view kSentence =
      "this is not valid UTF-8 (is it text, and saved as UTF-8?)";
  const auto expectAt = [&](std::string_view place, std::string_view toml) {
    EXPECT_EQ(firstLineOf(toml), fmt::format("s.toml:{}: {}", place, kSentence)) << toml;
  };
  expectAt("1:6", "x = \"\xff\"");
  expectAt("3:10", "[[body]]\ncircle = 1\nname = \"b\xe4r\"\n");
  expectAt("1:12", "title = \"µ€\xc3\"");
  expectAt("1:6", "\xEF\xBB\xBFx = \"\xed\xa0\x80\"");
  expectAt("2:3", "step = 0.1\n# \x80\n");
  expectAt("1:1", "\x89PNG\r\n\x1a\n");
  expectAt("1:1", "\xff\xfe\xff");
}

TEST(Errors, OtherEncodingsAndLineEndsAreNamed) {
  constexpr std::string_view kUtf16 = "s.toml:1:1: this text is UTF-16: save it as UTF-8";
  EXPECT_EQ(firstLineOf(std::string_view("\xff\xfe[\0", 4)), kUtf16);
  EXPECT_EQ(firstLineOf(std::string_view("[\0[\0b\0", 6)), kUtf16) << "without a mark";
  EXPECT_EQ(firstLineOf(std::string_view("\0[\0[\0b", 6)), kUtf16) << "the other way round";
  EXPECT_EQ(firstLineOf("step = 0.1\rseed = 2\r"),
            "s.toml:1:1: the lines of this text end with CR alone: save it with LF or CR LF");
  EXPECT_EQ(errorOf("step = 0.1\r\nseed = 2\r\n"), "no error");
}

}  // namespace
}  // namespace merge2d
