#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Doctor : public ProgramTest {
 protected:
  static Json check(const Json& report, const std::string& name) {
    for (const Json& one : report["checks"]) {
      if (one["name"] == name) return one;
    }
    ADD_FAILURE() << "nothing is said about " << name;
    return {};
  }
};

TEST_F(Doctor, IsContentHere) {
  const Outcome outcome = run({"doctor"});
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  for (const char* what : {"OpenGL", "font", "scenes", "folder", "ffmpeg"}) {
    EXPECT_THAT(outcome.out, HasSubstr("\n" + std::string(what)));
  }
}

TEST_F(Doctor, ReportsAsJson) {
  const Json report = run({"doctor", "--json"}).json();
  EXPECT_THAT(keysOf(report), ElementsAre("version", "checks"));
  EXPECT_TRUE(check(report, "OpenGL")["ok"]);
  EXPECT_THAT(check(report, "OpenGL")["detail"].get<std::string>(), HasSubstr("Mesa"));
}

TEST_F(Doctor, FailsWithoutWhatIsNeeded) {
  setEnvironment("MERGE2D_SCENES", "/nowhere");
  const Outcome outcome = run({"doctor", "--json"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_FALSE(check(outcome.json(), "scenes")["ok"]);
  EXPECT_THAT(outcome.err, HasSubstr("1 of 7 checks failed"));
}

TEST_F(Doctor, MissingFontsAreNoMatterOfOpenGl) {
  fs::create_directory(folder() / "fonts");
  write("fonts/DejaVuSans.ttf", "no font");
  setEnvironment("MERGE2D_FONTS", (folder() / "fonts").string());
  const Outcome outcome = run({"doctor", "--json"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(check(outcome.json(), "OpenGL")["ok"]);
  EXPECT_FALSE(check(outcome.json(), "font")["ok"]);
  EXPECT_THAT(check(outcome.json(), "font")["detail"].get<std::string>(), HasSubstr("not a font"));
}

TEST_F(Doctor, DoesWithoutFfmpeg) {
  setEnvironment("PATH", "/nowhere");
  const Outcome outcome = run({"doctor"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("apt-get install ffmpeg"));
}

}  // namespace
}  // namespace merge2d
