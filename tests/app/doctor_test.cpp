#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

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
  EXPECT_THAT(outcome.err, HasSubstr("1 of 9 checks failed"));
}

TEST_F(Doctor, TellsWhereOpenGlComesFrom) {
  const Json report = run({"doctor", "--json", "--context", "egl"}).json();
  EXPECT_THAT(check(report, "OpenGL")["detail"].get<std::string>(), StartsWith("EGL, "));
  EXPECT_TRUE(check(report, "EGL")["ok"]);
  EXPECT_FALSE(check(report, "EGL")["needed"]);
}

TEST_F(Doctor, NamesADriverThatMesaDoesNotHave) {
  setEnvironment("GALLIUM_DRIVER", "foo");
  for (const Words& words : {Words{"doctor"}, {"render", "books", "-s"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.out + outcome.err, HasSubstr("GALLIUM_DRIVER is 'foo'"));
  }
}

/// A machine whose OpenGL libraries cannot be loaded.
class WithoutOpenGl : public Doctor {
 protected:
  WithoutOpenGl() { setEnvironment("LD_LIBRARY_PATH", folder().string()); }
  void spoil(const Words& libraries) const {
    for (const std::string& library : libraries) write(library, "no library\n");
  }
  const Words osmesa_{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  const Words egl_{"libEGL.so.1", "libEGL.so"};
};

TEST_F(WithoutOpenGl, EglDrawsWhereOsmesaIsMissing) {
  spoil(osmesa_);
  const Json report = run({"doctor", "--json"}).json();
  EXPECT_FALSE(check(report, "OSMesa")["ok"]);
  EXPECT_THAT(check(report, "OpenGL")["detail"].get<std::string>(), StartsWith("EGL, "));
  EXPECT_EQ(run({"render", "books", "-s", "-r", "160x90"}).code, 0);
}

TEST_F(WithoutOpenGl, RenderingSaysWhatIsMissing) {
  spoil(osmesa_);
  spoil(egl_);
  const Outcome outcome = run({"render", "books", "-s"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, ContainsRegex("cannot load [^ ]*libOSMesa.so.8"));
  EXPECT_THAT(outcome.err, ContainsRegex("cannot load [^ ]*libEGL.so.1"));
  EXPECT_THAT(outcome.err, HasSubstr("install libosmesa6"));
}

TEST_F(WithoutOpenGl, ProgramsThatDoNotDrawNeedNone) {
  spoil(osmesa_);
  spoil(egl_);
  sendInput("event merge\nquit\n");
  for (const Words& words : {Words{"list"},
                             {"run", "books", "--steps", "3"},
                             {"explain", "books", "--at", "3"},
                             {"step", "books"},
                             {"compare", "books", "--steps", "3", "--no-charts"}}) {
    EXPECT_EQ(run(words).code, 0) << words[0];
  }
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
