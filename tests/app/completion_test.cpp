#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

class Completion : public ProgramTest {
 protected:
  /// The completions of bash for these words, of which the last is being typed.
  Words offered(const Words& words) {
    write("completion.bash", run({"completion", "bash"}).out);
    std::string script = ". ./completion.bash; COMP_WORDS=(";
    for (const std::string& word : words) script += "'" + word + "' ";
    script += "); COMP_CWORD=" + std::to_string(words.size() - 1) +
              "; _merge2d; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const std::string program = buildDir().string();
    const std::string command = "cd '" + folder().string() + "' && PATH='" + program +
                                "':\"$PATH\" bash -c \"$SCRIPT\" > offered";
    setenv("SCRIPT", script.c_str(), 1);
    EXPECT_EQ(std::system(command.c_str()), 0);
    unsetenv("SCRIPT");
    return linesOf(read("offered"));
  }
};

TEST_F(Completion, OffersCommandsOptionsValuesAndScenes) {
  EXPECT_THAT(offered({"merge2d", "st"}), ElementsAre("study", "step"));
  EXPECT_THAT(offered({"merge2d", "run", "--mo"}), ElementsAre("--mode"));
  EXPECT_THAT(offered({"merge2d", "run", "--mode", "merge"}), ElementsAre("merge", "merge+sleep"));
  EXPECT_THAT(offered({"merge2d", "render", "tower-pl"}), Contains("tower-platform"));
  EXPECT_THAT(offered({"merge2d", "completion", "f"}), ElementsAre("fish"));
}

TEST_F(Completion, OffersArgumentsBehindASwitch) {
  EXPECT_THAT(offered({"merge2d", "run", "--json", "tower-pl"}), Contains("tower-platform"));
  EXPECT_THAT(offered({"merge2d", "render", "-s", "tower-pl"}), Contains("tower-platform"));
}

TEST_F(Completion, OffersTheValuesThatTheCommandTakes) {
  EXPECT_THAT(offered({"merge2d", "compare", "--format", ""}), ElementsAre("png", "svg"));
  EXPECT_THAT(offered({"merge2d", "render", "--format", ""}), Contains("mp4"));
  EXPECT_THAT(offered({"merge2d", "render", "--overlay", "for"}), ElementsAre("forces"));
  EXPECT_THAT(offered({"merge2d", "lesson", "--language", ""}), ElementsAre("en", "de", "fr"));
  EXPECT_THAT(offered({"merge2d", "run", "--set", "merging.vel"}),
              ElementsAre("merging.velocity="));
  EXPECT_THAT(offered({"merge2d", "help", "st"}), ElementsAre("study", "step"));
}

/// Bash takes the "=" for a word.
TEST_F(Completion, OffersValuesBehindAnEqualsSign) {
  EXPECT_THAT(offered({"merge2d", "run", "--mode", "="}), Contains("reference"));
  EXPECT_THAT(offered({"merge2d", "run", "--mode", "=", "ref"}), ElementsAre("reference"));
  EXPECT_THAT(offered({"merge2d", "run", "--set", "merging.velocity", "="}), ElementsAre(""));
}

TEST_F(Completion, OffersFilesAloneWhereNoSceneIsMeant) {
  write("grid.toml", "");
  EXPECT_THAT(offered({"merge2d", "study", ""}),
              AllOf(Contains("grid.toml"), Not(Contains("tower-platform"))));
  EXPECT_THAT(offered({"merge2d", "cycles", "gr"}), ElementsAre("grid.toml"));
  EXPECT_THAT(offered({"merge2d", "list", ""}), ElementsAre(""));
}

TEST_F(Completion, OffersFilesWhereTheyAreMeant) {
  write("my-scene.toml", kStack);
  fs::create_directories(folder() / "my-folder");
  EXPECT_THAT(offered({"merge2d", "run", "my-"}), Contains("my-scene.toml"));
  EXPECT_THAT(offered({"merge2d", "render", "pile", "-o", "my-"}), ElementsAre("my-folder"));
}

TEST_F(Completion, EveryShellKnowsEveryCommand) {
  const std::string help = run({"--help"}).out;
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const std::string script = run({"completion", shell}).out;
    for (const char* command : {"list", "validate", "run", "render", "compare", "study", "lesson",
                                "cycles", "step", "explain", "doctor", "completion"}) {
      EXPECT_THAT(help, HasSubstr(std::string("\n  ") + command + " "));
      EXPECT_THAT(script, HasSubstr(command)) << shell;
    }
    EXPECT_THAT(script, HasSubstr("reference-error")) << shell;
  }
}

TEST_F(Completion, AnUnknownShellIsAnsweredWithTheNearest) {
  const Outcome outcome = run({"completion", "fishy"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'fish'?"));
  EXPECT_EQ(run({"completion"}).code, 2);
}

}  // namespace
}  // namespace merge2d
