/// Collections have one name in pictures, words and files: C1 is the first of a run.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

class CollectionNames : public ProgramTest {
 protected:
  CollectionNames() { write("stack.toml", kStack); }

  /// The first merge of the run: its step and its line of the trace.
  std::pair<std::int64_t, nlohmann::json> firstMerge() {
    const Outcome trace = run({"run", "stack.toml", "--trace", "-", "--quiet"});
    const Words lines = linesOf(trace.out);
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const auto step = nlohmann::json::parse(lines[i]);
      for (const auto& event : step["events"]) {
        if (event["type"] == "merge") return {step["step"], step};
      }
    }
    return {0, {}};
  }
};

TEST_F(CollectionNames, TheFirstOneIsC1InPicturesWordsAndFiles) {
  const auto [step, line] = firstMerge();
  ASSERT_GT(step, 0);
  EXPECT_EQ(line["collections"][0]["id"], 1);
  EXPECT_EQ(line["events"][0]["collection"], 1);
  const std::string at = std::to_string(step);
  EXPECT_THAT(run({"explain", "stack.toml", "--at", at}).out, HasSubstr(" into C1"));
  sendInput("event merge\nevents\n");
  EXPECT_THAT(run({"step", "stack.toml"}).out, HasSubstr(" merge into C1"));
  sendInput("");
  const Words still = {"render", "stack.toml", "--format", "svg",     "-s", "--overlay",
                       "labels", "-o",         "out",      "--steps", at};
  EXPECT_EQ(run(still).code, 0);
  const Words names = files("out");
  const auto frame =
      std::ranges::find_if(names, [](const std::string& name) { return name.ends_with(".svg"); });
  ASSERT_NE(frame, names.end());
  EXPECT_THAT(read("out/" + *frame), HasSubstr(">C1</text>"));
  run({"render", "stack.toml", "--stages", "--at", at, "--format", "svg", "-o", "out"});
  EXPECT_THAT(read(fmt::format("out/stages/step_{:06}_11_Merge.svg", step)), HasSubstr(">C1: "));
}

}  // namespace
}  // namespace merge2d
