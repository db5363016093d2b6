#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

class Render : public ProgramTest {
 protected:
  Render() { write("stack.toml", kStack); }

  /// Renders the stack in small: 6 frames, at 0, 0.1, … 0.5 s.
  Outcome render(const Words& more = {}) const {
    Words arguments = {"render", "stack.toml", "-r", "64x48", "--fps", "10"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  /// Name and content of every file in a folder.
  std::map<std::string, std::string> contents(const std::string& name) const {
    std::map<std::string, std::string> all;
    for (const std::string& file : files(name)) all[file] = read(name + "/" + file);
    return all;
  }

  Json runFile(const std::string& name = "frames/stack") const {
    return Json::parse(read(name + "/run.json"));
  }
};

const Words kAll = {"captions.vtt",     "frame_000000.png", "frame_000001.png", "frame_000002.png",
                    "frame_000003.png", "frame_000004.png", "frame_000005.png", "run.json"};

TEST_F(Render, WritesNumberedFramesWithTheirStory) {
  const Outcome outcome = render();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(files("frames/stack"), kAll);
  EXPECT_THAT(read("frames/stack/frame_000000.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(read("frames/stack/captions.vtt"),
              AllOf(StartsWith("WEBVTT\n"), HasSubstr("Three boxes\n"), HasSubstr("merges")));
}

TEST_F(Render, EndsWithTheFolderAndTheFfmpegCommand) {
  EXPECT_THAT(linesOf(render().out),
              ElementsAre("frames/stack",
                          "ffmpeg -framerate 10 -i frames/stack/frame_%06d.png -c:v libx264 "
                          "-pix_fmt yuv420p -movflags +faststart frames/stack/stack.mp4"));
  EXPECT_THAT(render({"-o", "a b%"}).out, HasSubstr("-i 'a b%%/frame_%06d.png'"));
  EXPECT_THAT(render({"-t", "-o", "t"}).out, HasSubstr("yuva420p t/stack.webm"));
}

TEST_F(Render, TellsTheSpeedOnStderrOnly) {
  const Outcome outcome = render();
  EXPECT_THAT(outcome.err, AllOf(StartsWith("6 frames of 64x48 in "),
                                 HasSubstr(" frames per second"), Not(HasSubstr("\r"))));
  EXPECT_THAT(render({"--quiet"}).err, IsEmpty());
}

TEST_F(Render, DescribesTheRun) {
  render({"--theme", "dark", "--overlay", "contacts", "--seed", "5", "--mode", "merge"});
  const Json run = runFile();
  EXPECT_EQ(run["format"], "merge2d-run");
  EXPECT_THAT(run["program"].get<std::string>(), StartsWith("merge2d "));
  EXPECT_EQ(run["scene"], "stack");
  EXPECT_EQ(run["seed"], 5);
  EXPECT_EQ(run["mode"], "merge");
  EXPECT_EQ(run["parameters"]["unmerging"]["velocity"], 0.02);
  EXPECT_EQ(run["picture"]["theme"], "dark");
  EXPECT_THAT(run["picture"]["overlays"], Contains("contacts"));
  EXPECT_EQ(run["frames"]["last"], 5);
  EXPECT_EQ(run["complete"], true);
  EXPECT_THAT(run["description"].get<std::string>(), StartsWith("Three boxes."));
  ASSERT_FALSE(run["events"].empty());
  EXPECT_THAT(keysOf(run["events"][0]),
              ElementsAre("step", "t", "type", "a", "b", "collection", "reason"));
}

TEST_F(Render, GivesTheSameBytesAgain) {
  render({"-o", "a"});
  render({"-o", "b"});
  EXPECT_EQ(contents("a"), contents("b"));
}

TEST_F(Render, ResumesToTheSameBytes) {
  render();
  const auto whole = contents("frames/stack");
  fs::remove(folder() / "frames/stack/frame_000002.png");
  fs::remove(folder() / "frames/stack/captions.vtt");
  write("frames/stack/frame_000004.png", whole.at("frame_000004.png").substr(0, 100));
  const Outcome outcome = render({"--resume"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("were there already"));
  EXPECT_EQ(contents("frames/stack"), whole);
}

TEST_F(Render, ResumesAfterAnInterrupt) {
  const Words arguments = {"render", "pile", "-r", "320x240", "--seconds", "20", "-o", "pile"};
  const pid_t child = start(arguments);
  while (!fs::exists(folder() / "pile/frame_000005.png")) usleep(1000);
  kill(child, SIGTERM);
  const Outcome interrupted = wait(child);
  EXPECT_EQ(interrupted.signal, SIGTERM);
  EXPECT_THAT(interrupted.err, HasSubstr("--resume continues"));
  EXPECT_EQ(runFile("pile")["complete"], false);
  for (const std::string& file : files("pile")) EXPECT_THAT(file, Not(HasSubstr(".merge2d")));
  const std::string third = read("pile/frame_000003.png");
  const Outcome outcome = run({"render", "pile", "-r", "320x240", "--seconds", "20", "-o", "pile",
                               "--resume", "--json", "-n", "0,12"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_GE(outcome.json()["kept"], 6);
  EXPECT_EQ(read("pile/frame_000003.png"), third);
  EXPECT_EQ(runFile("pile")["complete"], true);
}

TEST_F(Render, ResumesNothingElse) {
  render();
  const auto before = contents("frames/stack");
  const Outcome theme = render({"--resume", "--theme", "dark"});
  EXPECT_EQ(theme.code, 2);
  EXPECT_THAT(theme.err, HasSubstr("picture/theme differs from what frames/stack/run.json says"));
  EXPECT_THAT(render({"--resume", "--set", "merging.steps=4"}).err,
              HasSubstr("parameters/merging/steps differs"));
  EXPECT_THAT(render({"--resume", "--set", "body.box.mass=4"}).err, HasSubstr("the scene differs"));
  EXPECT_EQ(contents("frames/stack"), before);
}

TEST_F(Render, ResumeStartsWhereThereIsNothing) {
  EXPECT_EQ(render({"--resume"}).code, 0);
  EXPECT_EQ(files("frames/stack"), kAll);
}

TEST_F(Render, AnEarlierRenderingIsReplacedWithoutRemains) {
  render();
  const Outcome outcome = render({"--seconds", "0.2"});
  EXPECT_THAT(outcome.err, HasSubstr("6 earlier frames in frames/stack are replaced"));
  EXPECT_THAT(files("frames/stack"),
              ElementsAre("captions.vtt", "frame_000000.png", "frame_000001.png",
                          "frame_000002.png", "run.json"));
}

TEST_F(Render, PutsNoFramesAmongForeignFilesWithoutForce) {
  fs::create_directory(folder() / "thesis");
  write("thesis/frame_000000.png", "mine");
  const Outcome refused = render({"-o", "thesis"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("such as frame_000000.png"), HasSubstr("--force")));
  EXPECT_EQ(read("thesis/frame_000000.png"), "mine");
  EXPECT_EQ(render({"-o", "thesis", "--force"}).code, 0);
  EXPECT_EQ(files("thesis"), kAll);
}

TEST_F(Render, AForeignRunFileIsNotOurs) {
  fs::create_directory(folder() / "other");
  write("other/run.json", R"({"format": "something else"})");
  EXPECT_EQ(render({"-o", "other"}).code, 2);
  write("other/run.json", "not even JSON");
  EXPECT_EQ(render({"-o", "other"}).code, 2);
}

TEST_F(Render, ALessonMayLieBesideTheFrames) {
  fs::create_directories(folder() / "frames/stack");
  write("frames/stack/lesson.html", "<html>");
  EXPECT_EQ(render().code, 0);
  EXPECT_EQ(read("frames/stack/lesson.html"), "<html>");
}

TEST_F(Render, FailsWhereItCannotWrite) {
  write("file", "");
  const Outcome outcome = render({"-o", "file"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("file is not a folder"));
  const Outcome nowhere = render({"-o", "/proc/frames"});
  EXPECT_EQ(nowhere.code, 4);
  EXPECT_THAT(nowhere.err, HasSubstr("cannot write /proc/frames: No such file"));
}

TEST_F(Render, DrawsARangeOfFramesWithTheSameBytes) {
  render({"-o", "whole"});
  EXPECT_EQ(render({"-o", "part", "-n", "2,3"}).code, 0);
  EXPECT_THAT(files("part"),
              ElementsAre("captions.vtt", "frame_000002.png", "frame_000003.png", "run.json"));
  EXPECT_EQ(read("part/frame_000003.png"), read("whole/frame_000003.png"));
  EXPECT_THAT(render({"-o", "part", "-n", "2,3"}).out, HasSubstr("-start_number 2 "));
  EXPECT_EQ(runFile("part")["frames"]["first"], 2);
}

TEST_F(Render, ARangeMayBeOpenAndEndsWithTheRun) {
  render({"-o", "open", "-n", "4"});
  EXPECT_THAT(files("open"), Contains("frame_000005.png"));
  EXPECT_EQ(render({"-o", "long", "-n", "5,900"}).code, 0);
  EXPECT_THAT(files("long"), Contains("frame_000005.png"));
  const Outcome beyond = render({"-n", "6,9"});
  EXPECT_EQ(beyond.code, 2);
  EXPECT_THAT(beyond.err, HasSubstr("there is no frame 6: the run has the frames 0 to 5"));
}

TEST_F(Render, DrawsTheLastFrameAlone) {
  render({"-o", "whole"});
  const Outcome outcome = render({"-o", "last", "-s"});
  EXPECT_EQ(outcome.out, "last/frame_000005.png\n");
  EXPECT_THAT(files("last"), ElementsAre("captions.vtt", "frame_000005.png", "run.json"));
  EXPECT_EQ(read("last/frame_000005.png"), read("whole/frame_000005.png"));
}

TEST_F(Render, PartOfAFilmLeavesTheRestOfItAlone) {
  render();
  const auto before = contents("frames/stack");
  EXPECT_EQ(render({"-s"}).code, 0);
  EXPECT_EQ(files("frames/stack"), kAll);
  const Outcome other = render({"-s", "--theme", "print"});
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("6 frames in frames/stack belong to another rendering"));
  EXPECT_EQ(contents("frames/stack")["frame_000001.png"], before.at("frame_000001.png"));
  EXPECT_EQ(render({"-s", "--theme", "print", "--force"}).code, 0);
}

TEST_F(Render, EveryRunShowsItsEnd) {
  render({"--steps", "1"});
  EXPECT_THAT(files("frames/stack"), Contains("frame_000001.png"));
  EXPECT_THAT(runFile()["description"].get<std::string>(), HasSubstr("Step 1,"));
  render({"--steps", "0", "-o", "start"});
  EXPECT_THAT(files("start"), ElementsAre("captions.vtt", "frame_000000.png", "run.json"));
}

TEST_F(Render, GivesAnObjectAsJson) {
  const Outcome outcome = render({"--json"});
  const Json result = outcome.json();
  EXPECT_EQ(result["folder"], "frames/stack");
  EXPECT_EQ(result["written"], 6);
  EXPECT_EQ(result["width"], 64);
  EXPECT_THAT(result["ffmpeg"].get<std::string>(), StartsWith("ffmpeg "));
}

TEST_F(Render, SizesAreEvenAndLettersStandForThem) {
  EXPECT_EQ(render({"-r", "63x47", "--json"}).json()["width"], 64);
  const auto size = [&](const Words& options) {
    Words arguments = {"render", "stack.toml", "-s", "--steps", "0", "--json", "--force"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Json result = run(arguments).json();
    return std::vector<int>{result["width"], result["height"], result["fps"]};
  };
  EXPECT_THAT(size({}), ElementsAre(1280, 720, 30));
  EXPECT_THAT(size({"-q", "l"}), ElementsAre(854, 480, 15));
  EXPECT_THAT(size({"-qh"}), ElementsAre(1920, 1080, 60));
  EXPECT_THAT(size({"--fps", "24", "-r", "100x50", "-q", "h"}), ElementsAre(100, 50, 24));
}

TEST_F(Render, MakesAnAnimatedPngByItself) {
  const Outcome outcome = render({"--format", "apng"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(linesOf(outcome.out)[0], "frames/stack/stack.apng");
  EXPECT_THAT(read("frames/stack/stack.apng"), HasSubstr("acTL"));
}

TEST_F(Render, PrintsTheFfmpegCommandWhereThereIsNone) {
  setEnvironment("PATH", "/nowhere");
  const Outcome outcome = render({"--format", "gif"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("ffmpeg is not installed"));
  EXPECT_THAT(linesOf(outcome.out).back(),
              AllOf(StartsWith("ffmpeg -framerate 10 -i frames/stack/frame_%06d.png -vf 'fps=25,"),
                    HasSubstr("stats_mode=diff[p];[b][p]paletteuse=dither=bayer:bayer_scale=5:"
                              "diff_mode=rectangle' frames/stack/stack.gif")));
}

/// A program that stands in for ffmpeg: writes its arguments to its last argument.
void installFfmpeg(const fs::path& folder, const std::string& script) {
  fs::create_directories(folder);
  std::ofstream(folder / "ffmpeg") << "#!/bin/sh\n" << script;
  fs::permissions(folder / "ffmpeg", fs::perms::owner_all);
}

TEST_F(Render, MakesAFilmWithFfmpeg) {
  installFfmpeg(folder() / "bin", "for last; do :; done\necho \"$@\" > \"$last\"\n");
  setEnvironment("PATH", (folder() / "bin").string());
  const Outcome outcome = render({"--format", "mp4"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(linesOf(outcome.out)[0], "frames/stack/stack.mp4");
  EXPECT_THAT(read("frames/stack/stack.mp4"),
              HasSubstr("-framerate 10 -i frames/stack/frame_%06d.png -c:v libx264"));
  for (const std::string& file : files()) EXPECT_THAT(file, Not(HasSubstr(".merge2d")));
}

TEST_F(Render, AFailureOfFfmpegLeavesTheFramesOnly) {
  installFfmpeg(folder() / "bin", "for last; do :; done\n: > \"$last\"\nexit 3\n");
  setEnvironment("PATH", (folder() / "bin").string());
  const Outcome outcome = render({"--format", "mp4"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("ffmpeg could not write frames/stack/stack.mp4"));
  EXPECT_EQ(files("frames/stack"), kAll);
}

TEST_F(Render, KeepsWhatItHasWhenTheSimulationFails) {
  write("wild.toml", kDiverging);
  const Outcome outcome =
      run({"render", "wild.toml", "-r", "64x48", "--fps", "10", "-o", "wild", "--quiet"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(files("wild"), Contains("frame_000010.png"));
  EXPECT_EQ(runFile("wild")["complete"], false);
  EXPECT_THAT(runFile("wild")["failure"].get<std::string>(), HasSubstr("'flea'"));
}

}  // namespace
}  // namespace merge2d
