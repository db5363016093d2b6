#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

constexpr const char* kSvg = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- merge2d -->\n<svg ";

class VectorGraphics : public ProgramTest {
 protected:
  VectorGraphics() { write("stack.toml", kStack); }
};

TEST_F(VectorGraphics, FramesAreTheShapesOfPictures) {
  const Outcome outcome = run({"render", "stack.toml", "--format", "svg", "-o", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "out\n") << "ffmpeg makes no film of them";
  const std::string frame = read("out/frame_000000.svg");
  EXPECT_THAT(frame, AllOf(StartsWith(kSvg), HasSubstr(">Three boxes</text>"),
                           HasSubstr("<desc>Three boxes. Step 0")));
  EXPECT_THAT(files("out"), Not(Contains(HasSubstr(".png"))));
  EXPECT_THAT(read("out/run.json"), AllOf(HasSubstr("\"pattern\": \"frame_%06d.svg\""),
                                          HasSubstr("\"frame_000015.svg\": ")));
}

TEST_F(VectorGraphics, FramesNeedNoOpenGl) {
  setEnvironment("GALLIUM_DRIVER", "none-of-these");
  EXPECT_EQ(run({"render", "stack.toml", "--format", "svg", "-s", "-o", "out"}).code, 0);
}

TEST_F(VectorGraphics, FramesReplaceThoseOfTheOtherFormat) {
  run({"render", "stack.toml", "-r", "160x120", "-o", "out", "--seconds", "0.2"});
  EXPECT_EQ(run({"render", "stack.toml", "--format", "svg", "-o", "out", "--seconds", "0.2"}).code,
            0);
  EXPECT_THAT(files("out"), Not(Contains(HasSubstr(".png"))));
  const Outcome resumed =
      run({"render", "stack.toml", "--format", "svg", "-o", "out", "--seconds", "0.2", "--resume"});
  EXPECT_THAT(resumed.err, HasSubstr("were there already"));
}

TEST_F(VectorGraphics, ThoseOfAPartAreThoseOfTheWhole) {
  run({"render", "stack.toml", "--format", "svg", "-o", "whole"});
  run({"render", "stack.toml", "--format", "svg", "-o", "part", "-n", "5,6"});
  EXPECT_EQ(read("part/frame_000006.svg"), read("whole/frame_000006.svg"));
}

TEST_F(VectorGraphics, ChartsAndGraphsToo) {
  EXPECT_EQ(run({"compare", "stack.toml", "--format", "svg", "-o", "charts"}).code, 0);
  for (const char* chart : {"time", "counts", "distance"}) {
    EXPECT_THAT(read("charts/" + std::string(chart) + ".svg"), StartsWith(kSvg));
  }
  write("graph.txt", "A B 1\nB C 1\nC A 1\n");
  EXPECT_EQ(run({"cycles", "graph.txt", "--render", "graph.svg"}).code, 0);
  EXPECT_THAT(read("graph.svg"), StartsWith(kSvg));
  EXPECT_EQ(run({"cycles", "graph.txt", "--render", "graph.svg"}).code, 0) << "it is ours";
  write("logo.svg", "<svg/>");
  EXPECT_EQ(run({"cycles", "graph.txt", "--render", "logo.svg"}).code, 2);
  EXPECT_EQ(read("logo.svg"), "<svg/>");
}

TEST_F(VectorGraphics, StagesAreTheShapesOfPicturesAndNeedNoOpenGl) {
  setEnvironment("GALLIUM_DRIVER", "none-of-these");
  const Words arguments = {"render", "stack.toml",      "--stages", "--at",
                           "5",      "--format",        "svg",      "-o",
                           "out",    "--contact-sheet", "4x3"};
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(files("out/stages"), SizeIs(13));
  EXPECT_THAT(read("out/stages/step_000005_11_Merge.svg"),
              AllOf(StartsWith(kSvg), HasSubstr("Step 5, stage 11: Merge</text>"),
                    HasSubstr("<desc>Three boxes. Step 5, stage 11 of 11")));
  const std::string sheet = read("out/stages/step_000005.svg");
  EXPECT_THAT(sheet, AllOf(StartsWith(kSvg), HasSubstr("stage 1: ContactDetection</text>"),
                           HasSubstr("stage 11: Merge</text>")));
  EXPECT_EQ(run(arguments).code, 0) << "they are ours";
  write("out/stages/step_000005.svg", "<svg/>");
  EXPECT_EQ(run(arguments).code, 2);
  EXPECT_EQ(read("out/stages/step_000005.svg"), "<svg/>");
}

TEST_F(VectorGraphics, AContactSheetHoldsItsFramesWithIdsOfTheirOwn) {
  const Outcome outcome = run({"render", "stack.toml", "--format", "svg", "-o", "out", "--fps",
                               "20", "--contact-sheet", "3x2"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string sheet = read("out/contact_sheet.svg");
  EXPECT_THAT(sheet, StartsWith(kSvg));
  std::set<std::string> ids;
  const std::regex id("<[^>]* id=\"([^\"]*)\"");
  for (std::sregex_iterator at(sheet.begin(), sheet.end(), id), end; at != end; ++at) {
    EXPECT_TRUE(ids.insert((*at)[1]).second) << (*at)[1];
  }
  EXPECT_FALSE(ids.empty());
  const std::regex use("url\\(#([^)]*)\\)");
  for (std::sregex_iterator at(sheet.begin(), sheet.end(), use), end; at != end; ++at) {
    EXPECT_TRUE(ids.contains((*at)[1])) << (*at)[1];
  }
}

TEST_F(VectorGraphics, AWalkDrawsWhatItsFileIsCalled) {
  sendInput("picture start.svg\njump 5 Merge\npicture merge.svg\n");
  EXPECT_EQ(run({"step", "stack.toml"}).code, 0);
  EXPECT_THAT(read("start.svg"), AllOf(StartsWith(kSvg), HasSubstr("Step 0")));
  EXPECT_THAT(read("merge.svg"), AllOf(StartsWith(kSvg), HasSubstr("Step 5, stage 11")));
}

}  // namespace
}  // namespace merge2d
