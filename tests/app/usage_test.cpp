/// What the program says to those who type something wrong, and what it returns to the shell.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

constexpr int kFine = 0, kWrongUsage = 2, kBadScene = 3, kFailed = 4;

class Usage : public ProgramTest {
 protected:
  /// Expects a complaint that contains `what`, on stderr alone.
  void expectError(const Words& arguments, int code, const std::string& what) {
    const Outcome outcome = run(arguments);
    const std::string line = testing::PrintToString(arguments);
    EXPECT_EQ(outcome.code, code) << line << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(StartsWith("error: "), HasSubstr(what))) << line;
    EXPECT_THAT(outcome.out, IsEmpty()) << line;
  }
};

TEST_F(Usage, ControlCharactersOfTheCommandLineAreShownEscaped) {
  expectError({"run", "books", "--mode", "\x1b[31m"}, kWrongUsage, "but is '\\u001b[31m'");
  expectError({"frob\nnicate"}, kWrongUsage, "unknown command 'frob\\nnicate'");
  expectError({"run", "a\x1b.toml"}, kBadScene, "there is no file a\\u001b.toml\n");
  expectError({"run", "books", "--steps", "1", "--csv", "/proc/no\x1b/x"}, kFailed,
              "no\\u001b: No such file");
}

TEST_F(Usage, AFileOfABareNameHidesNoBuiltInScene) {
  write("books", "mode,step,t\n");
  EXPECT_EQ(run({"run", "books", "--steps", "1"}).code, kFine);
  expectError({"run", "./books", "--steps", "1"}, kBadScene, "./books:1:");
  write("mine", kStack);
  EXPECT_EQ(run({"run", "mine"}).code, kFine) << "there is no built-in scene of that name";
}

TEST_F(Usage, AMissingCommandIsWrongUsage) {
  expectError({}, kWrongUsage, "a command is missing: list, validate, run, render");
}

TEST_F(Usage, AnUnknownCommandGetsASuggestion) {
  expectError({"rendr", "books"}, kWrongUsage, "unknown command 'rendr' (did you mean 'render'?)");
  expectError({"frobnicate"}, kWrongUsage, "unknown command 'frobnicate' (there are ");
  expectError({"frobnicate", "--help"}, kWrongUsage, "unknown command 'frobnicate'");
}

TEST_F(Usage, ASceneInTheCommandsPlaceIsRecognised) {
  expectError({"books"}, kWrongUsage, "try 'merge2d run books'");
  expectError({"my.toml"}, kWrongUsage, "try 'merge2d run my.toml'");
}

TEST_F(Usage, AnUnknownOptionGetsASuggestion) {
  expectError({"run", "books", "--jsn"}, kWrongUsage, "(did you mean '--json'?)");
  expectError({"render", "books", "--ovrlay", "contacts"}, kWrongUsage,
              "(did you mean '--overlay'?)");
  expectError({"render", "--ovrlay=contacts", "books"}, kWrongUsage, "'--ovrlay' of render");
  expectError({"--jsn"}, kWrongUsage, "unknown option '--jsn'");
  expectError({"list", "--jsn"}, kWrongUsage, "(did you mean '--json'?)");
}

TEST_F(Usage, AMistypedOptionIsBlamedRatherThanTheSceneItSwallowed) {
  expectError({"render", "--ovrlay", "books"}, kWrongUsage, "unknown option '--ovrlay'");
  expectError({"run", "--jsn"}, kWrongUsage, "unknown option '--jsn'");
}

TEST_F(Usage, AnOptionOfAnotherCommandIsNamedAsSuch) {
  expectError({"run", "books", "--fps", "30"}, kWrongUsage,
              "'--fps' is an option of render, not of run");
  expectError({"run", "books", "--ovrlay"}, kWrongUsage, "('--overlay' is one of render)");
}

TEST_F(Usage, AMissingSceneIsWrongUsage) {
  for (const char* command : {"run", "render", "validate"}) {
    expectError({command}, kWrongUsage, "SCENE is required");
  }
}

TEST_F(Usage, ASecondSceneIsUnexpected) {
  expectError({"run", "books", "pile"}, kWrongUsage, "unexpected argument 'pile'");
}

TEST_F(Usage, AnUnknownSceneIsABadSceneWithASuggestion) {
  for (const char* command : {"run", "render", "validate"}) {
    expectError({command, "towr-platform"}, kBadScene, "(did you mean 'tower-platform'?)");
  }
}

TEST_F(Usage, AMissingSceneFileIsABadScene) {
  expectError({"run", "nothing.toml"}, kBadScene, "there is no file nothing.toml");
}

TEST_F(Usage, AMistakeInASceneIsShownWithItsPlace) {
  write("bad.toml", "format = 1\n[[body]]\nbox = [1, 1]\nfrction = 1\n");
  expectError({"run", "bad.toml"}, kBadScene,
              "bad.toml:4:1: unknown key 'frction' in [[body]] (did you mean 'friction'?)");
  EXPECT_THAT(run({"validate", "bad.toml"}).err, HasSubstr("4 | frction = 1\n      | ^\n"));
}

TEST_F(Usage, WordsThatOnlyAFewAreAllowedForGetSuggestions) {
  expectError({"run", "books", "--mode", "slep"}, kWrongUsage, "(did you mean 'sleep'?)");
  expectError({"render", "books", "--theme", "drak"}, kWrongUsage, "(did you mean 'dark'?)");
  expectError({"render", "books", "--overlay", "contcts"}, kWrongUsage,
              "(did you mean 'contacts'?)");
  expectError({"render", "books", "--format", "mp5"}, kWrongUsage, "(did you mean 'mp4'?)");
  expectError({"render", "books", "-q", "x"}, kWrongUsage, "--quality must be l (854x480");
}

TEST_F(Usage, NumbersAreChecked) {
  expectError({"run", "books", "--steps", "many"}, kWrongUsage, "--steps must be a whole number");
  expectError({"run", "books", "--steps", "-1"}, kWrongUsage, "but is '-1'");
  expectError({"run", "books", "--steps", "1.5"}, kWrongUsage, "but is '1.5'");
  expectError({"run", "books", "--steps", "99999999999999999999"}, kWrongUsage, "--steps must");
  expectError({"run", "books", "--seconds", "nan"}, kWrongUsage, "--seconds must be a number");
  expectError({"run", "books", "--seconds", "1s"}, kWrongUsage, "but is '1s'");
  expectError({"run", "books", "--seed", "-1"}, kWrongUsage, "--seed must");
  expectError({"render", "books", "--fps", "0"}, kWrongUsage, "--fps must");
  expectError({"render", "books", "-r", "1280"}, kWrongUsage, "WIDTHxHEIGHT");
  expectError({"render", "books", "-r", "99999x10"}, kWrongUsage, "the width in --resolution");
  expectError({"render", "books", "-n", "5,3"}, kWrongUsage, "comes after the last one");
  expectError({"render", "books", "-n", "a,b"}, kWrongUsage, "--frames FROM,TO");
}

TEST_F(Usage, AnOptionWithoutItsValueSaysSo) {
  expectError({"run", "books", "--steps"}, kWrongUsage, "--steps needs a value");
  expectError({"explain", "books", "--at", "6", "--pair", "cookbook"}, kWrongUsage,
              "--pair needs the names of two bodies");
  expectError({"run", "books", "--trace", "--json"}, kWrongUsage,
              "--trace needs the name of a file or folder, but got '--json'");
}

TEST_F(Usage, OptionsThatContradictEachOtherAreRefused) {
  expectError({"run", "books", "--steps", "1", "--seconds", "1"}, kWrongUsage, "--seconds");
  expectError({"run", "books", "--quiet", "--verbose"}, kWrongUsage, "exclude each other");
  expectError({"run", "books", "--decisions"}, kWrongUsage, "name it with --trace");
  expectError({"run", "books", "--trace", "a", "--csv", "a"}, kWrongUsage, "two different files");
  expectError({"run", "books", "--trace", "-", "--json"}, kWrongUsage, "standard output");
  expectError({"render", "books", "-s", "-n", "1,2"}, kWrongUsage, "different frames");
  expectError({"render", "books", "-s", "--format", "gif"}, kWrongUsage, "one picture");
  expectError({"render", "books", "-t", "--format", "mp4"}, kWrongUsage, "--format apng can");
}

TEST_F(Usage, OptionsWithoutAnEffectAreRefused) {
  expectError({"lesson", "one-step", "--mode", "reference"}, kWrongUsage,
              "a lesson says itself how its scene is run; --mode, --set");
  expectError({"run", "books", "--reference-folder", "ends"}, kWrongUsage, "--reference-error");
  expectError({"render", "books", "--stages", "--at", "99999"}, kWrongUsage,
              "--at 99999: the run of 'books' ends at step 800");
}

TEST_F(Usage, SetNeedsAKeyAndAValue) {
  expectError({"run", "books", "--set", "merging.velocity"}, kWrongUsage, "--set needs key=value");
  expectError({"run", "books", "--set", "=1"}, kWrongUsage, "--set needs key=value");
  expectError({"run", "books", "--set", "merging.velocty=1"}, kBadScene,
              "(did you mean 'velocity'?)");
}

TEST_F(Usage, HelpAndVersionAreDataAndFine) {
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.code, kFine);
  EXPECT_THAT(version.out, StartsWith("merge2d "));
  EXPECT_THAT(run({"--help"}).out, HasSubstr("Exit codes"));
  for (const char* command : {"list", "validate", "run", "render", "doctor"}) {
    const Outcome help = run({command, "--help"});
    EXPECT_EQ(help.code, kFine);
    EXPECT_THAT(help.out, HasSubstr("Examples:\n  merge2d " + std::string(command)));
    EXPECT_THAT(help.err, IsEmpty());
    EXPECT_EQ(run({"help", command}).out, help.out);
  }
}

TEST_F(Usage, NoLineOfHelpIsLongerThanAHundredColumns) {
  for (const char* command : {"list", "validate", "run", "render", "doctor"}) {
    for (const std::string& line : linesOf(run({command, "--help"}).out)) {
      EXPECT_LE(line.size(), 100U) << line;
    }
  }
}

TEST_F(Usage, OptionsMayStandAnywhere) {
  write("stack.toml", kStack);
  const std::string expected =
      run({"run", "stack.toml", "--steps", "3", "--no-timings", "--json"}).out;
  EXPECT_THAT(expected, StartsWith("{"));
  EXPECT_EQ(run({"run", "--steps", "3", "--no-timings", "--json", "stack.toml"}).out, expected);
  EXPECT_EQ(run({"run", "--json", "stack.toml", "--steps=3", "--no-timings"}).out, expected);
  EXPECT_EQ(run({"--steps", "3", "--json", "run", "--no-timings", "stack.toml"}).out, expected);
}

TEST_F(Usage, OfARepeatedOptionTheLastOneCounts) {
  write("stack.toml", kStack);
  EXPECT_EQ(run({"run", "stack.toml", "--steps", "3", "--steps", "4", "--json"}).json()["steps"],
            4);
}

TEST_F(Usage, AFullStandardOutputIsAnOutputFailure) {
  sendOutputTo("/dev/full");
  const Outcome outcome = run({"list"});
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("cannot write to the standard output"));
}

TEST_F(Usage, ErrorsHaveNoColourWhereStderrIsNoTerminal) {
  EXPECT_THAT(run({"frobnicate"}).err, Not(HasSubstr("\033")));
}

#ifndef MERGE2D_SANITIZED  // whose reports name sources
/// Debuggers need its folders: without the sections for them.
TEST_F(Usage, TheProgramNamesNoFolderOfItsBuild) {
  const std::string stripped = (*this / "stripped").string();
  const std::string command =
      fmt::format("strip --strip-debug -o {} {}", stripped, (buildDir() / "merge2d").string());
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string program = contentOf(stripped);
  const std::string build = buildDir().string(), sources = buildDir().parent_path().string();
  for (const std::string& folder : {build + "/", sources + "/src2d", sources + "/render"}) {
    EXPECT_EQ(program.find(folder), std::string::npos) << folder;
  }
}
#endif

}  // namespace
}  // namespace merge2d
