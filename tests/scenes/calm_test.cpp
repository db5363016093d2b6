/// What rests, or moves steadily, is left alone: no weld forms or breaks.

#include "tests/scenes/scene_testing.h"

namespace merge2d {
namespace {

/// A time in which nothing is to happen [s].
struct CalmSpan {
  double from = 0.0, to = 0.0;
};

struct CalmCase {
  const char* scene;
  const char* body;             ///< one that is merged in all of the spans
  std::vector<CalmSpan> spans;  ///< each begins well after what came before has settled
};

void PrintTo(const CalmCase& c, std::ostream* out) { *out << c.scene; }

class Calm : public testing::TestWithParam<std::tuple<CalmCase, Mode>> {};
class LongCalm : public Calm {};

void expectCalm(const CalmCase& c, Mode mode) {
  SceneRun run(c.scene, mode);
  for (const CalmSpan& span : c.spans) {
    run.until(span.from);
    const std::size_t before = run.log().size();
    EXPECT_TRUE(run.merged(c.body)) << c.body << " at " << span.from << " s";
    run.until(span.to);
    EXPECT_TRUE(run.merged(c.body)) << c.body << " at " << span.to << " s";
    for (std::size_t i = before; i < run.log().size(); ++i) {
      const SceneRun::Logged& e = run.log()[i];
      if (e.type != EventType::Merge && e.type != EventType::Unmerge) continue;
      ADD_FAILURE() << e.a << (e.type == EventType::Merge ? " merges with " : " parts from ") << e.b
                    << " in step " << e.step;
    }
  }
}

TEST_P(Calm, NoWeldFormsOrBreaks) { expectCalm(std::get<0>(GetParam()), std::get<1>(GetParam())); }
TEST_P(LongCalm, NoWeldFormsOrBreaks) {
  expectCalm(std::get<0>(GetParam()), std::get<1>(GetParam()));
}

/// "spacestation_in_merge".
std::string nameOfCalm(const testing::TestParamInfo<Calm::ParamType>& info) {
  const auto& [scene, mode] = info.param;
  std::string out = std::string(scene.scene) + (sleeps(mode) ? "_in_merge_sleep" : "_in_merge");
  std::erase(out, '-');
  return out;
}

/// In both modes that merge.
auto calmCases(const std::vector<CalmCase>& cases) {
  return testing::Combine(testing::ValuesIn(cases), testing::Values(Mode::Merge, Mode::MergeSleep));
}

const std::vector<CalmCase> kCalmAtRest = {
    {"arch", "keystone", {{1.0, 8.0}}},
    {"books", "sequel", {{0.6, 0.99}, {5.8, 8.0}}},
    {"box-on-points", "box", {{0.3, 0.9}, {1.6, 6.0}}},
    {"dominoes", "domino[40,0]", {{0.3, 0.99}, {9.8, 12.0}}},
    {"ladder", "ladder", {{1.6, 6.0}}},
    {"planks", "jammed left", {{1.2, 6.0}}},
    {"seesaw", "beam", {{7.0, 12.0}}},
    {"three-discs", "left", {{7.0, 8.0}}},
    {"tower-impulse", "brick[1,0]", {{0.8, 1.49}, {8.0, 16.0}}},
    {"tower-lift", "brick[1,0]", {{0.9, 1.49}, {2.8, 6.0}}},
    {"tripod", "third leg", {{2.8, 8.0}}},
    {"truss-arch", "left-leg", {{0.4, 2.0}, {4.0, 8.0}}},
    {"unmerge-broken", "left[0,1]", {{0.4, 0.99}, {3.0, 5.0}}},
    {"unmerge-pivot", "box", {{0.4, 0.99}, {3.5, 5.0}}},
};
INSTANTIATE_TEST_SUITE_P(AtRest, Calm, calmCases(kCalmAtRest), nameOfCalm);

/// They ride, slide, turn, tilt or swing.
const std::vector<CalmCase> kCalmSteady = {
    {"books", "sequel", {{1.4, 5.0}}},
    {"seesaw", "beam", {{0.4, 5.5}}},
    {"ferry", "car", {{0.5, 600.0}}},
    {"slope", "block", {{0.4, 30.4}}},
    {"spinner", "disc-1", {{7.0, 10.0}}},
    {"swing", "box-1", {{0.6, 30.0}}},
    {"tower-platform", "brick[5,26]", {{1.1, 5.9}}},
    {"wagon", "book[0,0]", {{0.8, 2.9}, {6.1, 10.0}}},
};
INSTANTIATE_TEST_SUITE_P(Steady, Calm, calmCases(kCalmSteady), nameOfCalm);

const std::vector<CalmCase> kCalmInBetween = {
    {"dominoes-platforms", "first[0,0]", {{0.3, 0.99}, {16.0, 20.0}}},
    {"pile", "plank[0]", {{16.5, 20.0}}},
    {"ship-crane",
     "ship",
     {{0.8, 6.9},  // between what the crane does
      {8.5, 17.9},
      {19.1, 27.4},
      {29.0, 38.4},
      {39.6, 47.9},
      {49.7, 58.9},
      {60.1, 68.7},
      {70.4, 79.4},
      {80.6, 88.0}}},
    {"tower-impulse-heavy", "light[1,0]", {{0.8, 1.49}, {4.0, 6.0}}},
};
INSTANTIATE_TEST_SUITE_P(InBetween, Calm, calmCases(kCalmInBetween), nameOfCalm);

const std::vector<CalmCase> kCalmForLong = {{"space-station", "sofa", {{0.5, 250.0}}}};
INSTANTIATE_TEST_SUITE_P(Long, LongCalm, calmCases(kCalmForLong), nameOfCalm);

}  // namespace
}  // namespace merge2d
