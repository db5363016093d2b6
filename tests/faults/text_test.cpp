/// Text that others wrote: no terminal obeys it, wherever it is shown.

#include "tests/faults/fault_testing.h"

namespace merge2d {
namespace {

/// ESC [31m, a C1 control, a NUL, a change of writing direction, and an empty line.
constexpr const char* kHostileToml = R"(a\u001b[31mb\u009b2J\u0000\u202Ec\u2066d\n\n9 --> 10)";

bool isHarmless(const std::string& text) {
  if (text.find('\0') != std::string::npos) return false;
  for (const char* bad : {"\x1b", "\xC2\x9B", "\xE2\x80\xAE", "\xE2\x81\xA6", "\r"}) {
    if (text.find(bad) != std::string::npos) return false;
  }
  return true;
}

class HostileText : public FaultTest {};

std::vector<Words> everyCommandOn(const std::string& scene) {
  return {{"validate", scene, "--to", "copy.toml", "--force"},
          {"validate", scene, "--json"},
          {"run", scene, "--verbose", "--trace", "t.jsonl", "--force"},
          {"run", scene, "--json"},
          {"render", scene, "-r", "64x48", "--fps", "10", "-o", "out", "--force"},
          {"compare", scene, "--no-charts"},
          {"compare", scene, "--no-charts", "--json"},
          {"explain", scene, "--at", "40"},
          {"lesson", scene, "-o", "page.html", "--force"},
          {"step", scene}};
}

TEST_F(HostileText, ATitleIsOneLineOfPrintableText) {
  std::string text = kStack;
  text.replace(text.find("Three boxes"), 11, kHostileToml);
  write("titled.toml", text);
  for (const Words& arguments : everyCommandOn("titled.toml")) {
    fs::remove(folder() / "titled.toml");
    write("titled.toml", text);
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, kFine) << arguments[0] << outcome.err;
    EXPECT_TRUE(isHarmless(outcome.out + outcome.err)) << arguments[0];
  }
  EXPECT_TRUE(isHarmless(read("copy.toml") + read("t.jsonl") + read("page.html")));
  EXPECT_THAT(run({"validate", "titled.toml"}).out, HasSubstr("a\\u001b[31mb"));
}

/// The title is text in the page, and the same in that of a copy of the scene: controls are escaped
/// once.
TEST_F(HostileText, APageHasTheTitleInItsHeading) {
  std::string text = kStack;
  text.replace(text.find("Three boxes"), 11, kHostileToml);
  write("titled.toml", text);
  ASSERT_EQ(run({"lesson", "titled.toml", "-o", "page.html"}).code, kFine);
  const std::string shown = R"(a\u001b[31mb\u009b2J\u0000\u202ec\u2066d 9 --&gt; 10)";
  EXPECT_THAT(read("page.html"), HasSubstr("<title>" + shown + "</title>"));
  ASSERT_EQ(run({"validate", "titled.toml", "--to", "copy.toml"}).code, kFine);
  ASSERT_EQ(run({"lesson", "copy.toml", "-o", "copy.html"}).code, kFine);
  EXPECT_THAT(read("copy.html"), HasSubstr("<title>" + shown + "</title>"));
}

/// A folder of scenes of the user is listed as well.
TEST_F(HostileText, AListedTitleIsOneLineOfPrintableText) {
  std::string text = kStack;
  text.replace(text.find("Three boxes"), 11, kHostileToml);
  fs::create_directory(folder() / "scenes");
  write("scenes/titled.toml", text);
  setEnvironment("MERGE2D_SCENES", (folder() / "scenes").string());
  for (const Words& arguments : {Words{"list"}, {"list", "--json"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, kFine) << outcome.err;
    EXPECT_TRUE(isHarmless(outcome.out)) << outcome.out;
    EXPECT_THAT(outcome.out, HasSubstr("9 --> 10"));
  }
}

TEST_F(HostileText, ANameOfAFileIsShownEscaped) {
  const std::string name = "s\x1b[31m\xC2\x9B\xE2\x80\xAEx.toml";
  write(name, kStack);
  for (const Words& arguments : everyCommandOn(name)) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, kFine) << arguments[0] << outcome.err;
    EXPECT_TRUE(isHarmless(outcome.out + outcome.err)) << arguments[0];
  }
  EXPECT_TRUE(isHarmless(read("t.jsonl") + read("page.html")));
}

TEST_F(HostileText, ANameThatIsNoUtf8IsReplaced) {
  write("bad\xff.toml", kStack);
  for (const Words& arguments : everyCommandOn("bad\xff.toml")) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, kFine) << arguments[0] << outcome.err;
    EXPECT_THAT(outcome.out + outcome.err, Not(HasSubstr("json.exception")));
  }
  EXPECT_EQ(run({"run", "bad\xff.toml", "--json"}).json()["scene"], "bad\xEF\xBF\xBD");
}

TEST_F(HostileText, NamesOfBodiesAreRefused) {
  for (const char* name : {"a\\u001b[31m", "a\\u009bb", "a\\u202Eb", "a\\u2066b", "a\\u2028b"}) {
    write("named.toml", std::string("[[body]]\nname = \"") + name + "\"\nbox = [1, 1]\n");
    const Outcome outcome = run({"validate", "named.toml"});
    EXPECT_EQ(outcome.code, kBadScene) << name;
    EXPECT_THAT(outcome.err, HasSubstr("a name is one line without control characters"));
    EXPECT_TRUE(isHarmless(outcome.err)) << name;
  }
}

TEST_F(HostileText, NamesInGraphsAreRefused) {
  for (const char* name : {"A\x1b[31m", "A\xC2\x9B", "A\xE2\x80\xAE"}) {
    write("graph.txt", std::string(name) + " B 1\n");
    const Outcome outcome = run({"cycles", "graph.txt"});
    EXPECT_EQ(outcome.code, kBadScene) << outcome.out;
    EXPECT_TRUE(isHarmless(outcome.err));
  }
}

TEST_F(HostileText, ArgumentsAreShownEscaped) {
  for (const Words& arguments : {Words{"run", "no\x1b[31m\xE2\x80\xAE"},
                                 {"\x1b[31m"},
                                 {"run", "stack.toml", "--\x1b[31m"},
                                 {"run", "stack.toml", "--set", "\x1b[31m=1"},
                                 {"run", "stack.toml", "--mode", "\xC2\x9B"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_GE(outcome.code, kWrongUsage);
    EXPECT_TRUE(isHarmless(outcome.err)) << outcome.err;
  }
}

TEST_F(HostileText, ALessonShowsItsTextWithoutControls) {
  fs::create_directories(folder() / "mine");
  const std::string head = R"(format = 1
title = "a\u001b[31mb\u202Ec"
minutes = 1
scene = "stack.toml"
[[part]]
section = "One"
at = "start"
)";
  fs::copy_file(folder() / "stack.toml", folder() / "mine/stack.toml");
  write("mine/lesson.toml", "summary = \"Fine\"\n" + head);
  write("mine/text.md", "A \x1b[31mtext\xE2\x80\xAE.\n\n## One\nMore \xC2\x9B text.\n");
  const Outcome outcome = run({"lesson", "mine", "-o", "page.html"});
  EXPECT_EQ(outcome.code, kFine) << outcome.err;
  EXPECT_TRUE(isHarmless(outcome.out + outcome.err + read("page.html")));
  write("mine/lesson.toml", "summary = \"Not \\u202E fine\"\n" + head);
  const Outcome refused = run({"lesson", "mine", "-o", "page.html"});
  EXPECT_EQ(refused.code, kBadScene);
  EXPECT_THAT(refused.err, HasSubstr("mine/lesson.toml:1:11: a text has no control characters"));
}

TEST_F(HostileText, AnEmptyLineEndsNoCaption) {
  std::string text = kStack;
  text.replace(text.find("Three boxes"), 11, "one\\n\\n00:00:05.000 --> 00:00:06.000\\ntwo");
  write("titled.toml", text);
  ASSERT_EQ(run({"render", "titled.toml", "-r", "64x48", "--fps", "10", "-o", "out"}).code, kFine);
  const std::string captions = read("out/captions.vtt");
  EXPECT_THAT(captions, Not(HasSubstr("\n00:00:05.000 --> 00:00:06.000")));
  EXPECT_THAT(captions, HasSubstr("one 00:00:05.000 --&gt; 00:00:06.000 two"));
}

}  // namespace
}  // namespace merge2d
