/// The messages of errors: the reason, in words of ours.

#include <cmath>

#include "tests/faults/fault_testing.h"

namespace merge2d {
namespace {

class Messages : public FaultTest {
 protected:
  /// Without root's rights, which know no locked doors.
  void asNobody() {
    beforeStart([] {
      if (getuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) _exit(126);
    });
  }
};

/// No library's own words.
auto plain() {
  return AllOf(Not(HasSubstr("filesystem error")), Not(HasSubstr("basic_filebuf")),
               Not(HasSubstr("json.exception")), Not(HasSubstr("std::")),
               Not(HasSubstr("terminate")));
}

TEST_F(Messages, APlaceThatMayNotBeEnteredIsToldAsSuch) {
  fs::permissions(folder().parent_path(), fs::perms::all);
  fs::permissions(folder(), fs::perms::all);
  fs::create_directories(folder() / "locked");
  write("locked/scene.toml", kStack);
  fs::permissions(folder() / "locked", fs::perms::none);
  write("closed.toml", kStack);
  fs::permissions(folder() / "closed.toml", fs::perms::none);
  asNobody();
  for (const Words& arguments : {Words{"run", "locked/scene.toml"},
                                 {"run", "closed.toml"},
                                 {"validate", "closed.toml"},
                                 {"run", "stack.toml", "--csv", "locked/run.csv"},
                                 {"run", "stack.toml", "--resume", "locked/s.state"},
                                 {"render", "stack.toml", "-o", "locked/frames", "-r", "64x48"},
                                 {"lesson", "locked/scene.toml"},
                                 {"lesson", "stack.toml", "-o", "locked/page.html"},
                                 {"cycles", "locked/graph.txt"},
                                 {"compare", "locked/scene.toml"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, kFailed) << arguments[0] << " " << arguments[1] << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("Permission denied"), plain()))
        << arguments[0] << " " << arguments[1];
  }
  fs::permissions(folder() / "locked", fs::perms::all);
}

TEST_F(Messages, AFullDiskIsToldAsSuch) {
  for (const Words& arguments : {Words{"run", "stack.toml", "--csv", "/dev/full"},
                                 {"run", "stack.toml", "--trace", "/dev/full"},
                                 {"run", "stack.toml", "--snapshot", "/dev/full"},
                                 {"validate", "stack.toml", "--to", "/dev/full"},
                                 {"lesson", "stack.toml", "-o", "/dev/full"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, kFailed) << arguments[0];
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("No space left on device"), plain())) << arguments[0];
  }
}

TEST_F(Messages, AFolderIsNoFile) {
  fs::create_directories(folder() / "folder");
  for (const Words& arguments : {Words{"run", "folder"},
                                 {"render", "folder"},
                                 {"cycles", "folder"},
                                 {"run", "stack.toml", "--resume", "folder"},
                                 {"run", "stack.toml", "--csv", "folder"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_TRUE(outcome.code == kBadScene || outcome.code == kFailed) << arguments[0];
    EXPECT_THAT(outcome.err, plain());
    EXPECT_THAT(outcome.err, ContainsRegex("folder|directory"));
  }
}

TEST_F(Messages, WrongUsageIsTheSameEverywhere) {
  for (const char* command : {"run", "render", "compare", "lesson", "step", "explain"}) {
    for (const Words& wrong : {Words{"--steps", "many"},
                               {"--steps", "-1"},
                               {"--seconds", "nan"},
                               {"--mode", "fast"},
                               {"--set", "nothing"},
                               {"--nosuch"},
                               {"--steps", "1", "--seconds", "1"}}) {
      Words arguments = {command, "stack.toml"};
      arguments.insert(arguments.end(), wrong.begin(), wrong.end());
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.code, kWrongUsage) << command << " " << wrong[0] << " " << outcome.err;
    }
  }
}

TEST_F(Messages, AFailedExpectationShowsItsPlaceOnLinesOfItsOwn) {
  fs::create_directories(folder() / "mine");
  write("mine/lesson.toml", R"(format = 1
title = "Mine"
summary = "An expectation fails"
minutes = 1
scene = "books"
[[trace]]
label = "merged"
mode = "merge"
[[part]]
section = "One"
at = "start"
[[expect]]
measure = "simulated"
at = "step 2"
between = [1000, 2000]
)");
  write("mine/text.md", "A text.\n\n## One\nMore text.\n");
  const Outcome outcome = run({"lesson", "mine"});
  EXPECT_EQ(outcome.code, kFine) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("warning: mine/lesson.toml:13:"));
  EXPECT_THAT(outcome.err, HasSubstr("\n   13 | measure = \"simulated\"\n"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("\\n")));
}

TEST_F(Messages, APictureOfAGraphIsAPngOrAnSvg) {
  write("graph.txt", "A B 1\n");
  const Outcome outcome = run({"cycles", "graph.txt", "--render", "g.jpg"});
  EXPECT_EQ(outcome.code, kWrongUsage);
  EXPECT_THAT(outcome.err, HasSubstr("PNG"));
  EXPECT_FALSE(exists("g.jpg"));
}

TEST_F(Messages, TextInAnotherEncodingIsNamed) {
  const auto utf16 = [](const std::string& text) {
    std::string bytes;
    for (const char c : text) bytes += {c, '\0'};
    return bytes;
  };
  write("wide.toml", utf16(kStack));
  EXPECT_THAT(run({"run", "wide.toml"}).err, HasSubstr("wide.toml:1:1: this text is UTF-16"));
  write("marked.toml", "\xFF\xFE" + utf16(kStack));
  EXPECT_THAT(run({"run", "marked.toml"}).err, HasSubstr("marked.toml:1:1: this text is UTF-16"));
  std::string old = kStack;
  std::ranges::replace(old, '\n', '\r');
  write("old.toml", old);
  EXPECT_THAT(run({"run", "old.toml"}).err, HasSubstr("lines of this text end with CR alone"));
}

TEST_F(Messages, ASeedThatChangesNothingIsWarnedOf) {
  EXPECT_THAT(run({"run", "stack.toml", "--seed", "7"}).err,
              HasSubstr("warning: the seed changes nothing: stack has no [[emitter]]"));
  EXPECT_EQ(run({"run", "stack.toml"}).err, "");
  write("rain.toml", std::string(kStack) +
                         "[[emitter]]\ncircle = 0.1\nat = [0, 9]\nevery = 0.1\ncount = 2\nspread = "
                         "[1, 0]\n");
  EXPECT_EQ(run({"run", "rain.toml", "--seed", "7"}).err, "");
}

TEST_F(Messages, DoctorDoesNotBlameOpenGlForAMissingFont) {
  const Outcome outcome = run({"doctor", "--json"});
  ASSERT_EQ(outcome.code, kFine) << outcome.err;
  for (const auto& check : outcome.json()["checks"]) {
    if (check["name"] != "OpenGL") continue;
    EXPECT_THAT(check.dump(), Not(HasSubstr("font")));
  }
}

TEST_F(Messages, ZeroWithASignAndLargePolygonsAreWrittenAsTheyAre) {
  std::string polygon;
  for (int i = 0; i < 400; ++i) {
    const double angle = 6.283185307179586 * i / 400;
    polygon += "[" + std::to_string(30 * std::cos(angle)) + ", " +
               std::to_string(30 * std::sin(angle)) + "], ";
  }
  write("odd.toml",
        "[[body]]\nname = \"zero\"\nbox = [1, 1]\nat = [-0.0, 50]\nvelocity = [0, -0.0]\n"
        "[[body]]\nname = \"round\"\npolygon = [" +
            polygon +
            "]\n"
            "[[body]]\nname = \"far\"\nat = [0, -1e5]\n"
            "shapes = [{ polygon = [[0, 0], [9e5, 0], [0, 9e5]], at = [9e5, 0], angle = 17 }]\n");
  ASSERT_EQ(run({"validate", "odd.toml", "--to", "once.toml"}).code, kFine);
  ASSERT_EQ(run({"validate", "once.toml", "--to", "twice.toml"}).code, kFine);
  const auto body = [](const std::string& text) { return text.substr(text.find("[[body]]")); };
  EXPECT_EQ(body(read("once.toml")), body(read("twice.toml")));
  EXPECT_THAT(read("once.toml"), HasSubstr("at = [-0.0, 50]"));
}

}  // namespace
}  // namespace merge2d
