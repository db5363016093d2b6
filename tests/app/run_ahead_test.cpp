/// The default view shows all bodies over the whole run, or goes along with one.

#include "app/run_ahead.h"

#include <fmt/format.h>

#include <regex>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

constexpr double kSide = 200.0;  ///< of the pictures [pixels]

/// A ball that falls past the edge of a table, 5 mm away, and goes on.
const std::string kTable =
    "duration = 1\n[[body]]\nmotion = \"pinned\"\nat = [2, -0.1]\nbox = [4, 0.2]\n"
    "[[body]]\nname = \"ball\"\nat = [-0.105, 2]\ncircle = 0.1\n";

struct Disc {
  double x = 0.0, y = 0.0, radius = 0.0;  ///< [pixels]
};

class RunAhead : public ProgramTest {
 protected:
  /// The SVG of each frame: at 0, 0.5 and 1 s.
  std::vector<std::string> frames(const std::string& toml, const Words& more = {}) {
    write("scene.toml", toml);
    Words command = {"render", "scene.toml", "--format", "svg",       "-r",   "200x200", "--fps",
                     "2",      "-o",         "shown",    "--overlay", "none", "--force"};
    command.insert(command.end(), more.begin(), more.end());
    EXPECT_EQ(run(command).code, 0);
    std::vector<std::string> all;
    for (int i = 0; i < 3; ++i) all.push_back(read(fmt::format("shown/frame_{:06}.svg", i)));
    return all;
  }

  /// The first disc that a picture draws: from its left end half round, and back.
  static Disc discIn(const std::string& svg) {
    std::smatch found;
    const std::regex disc(R"x("M(-?[\d.]+) (-?[\d.]+)A([\d.]+) [\d.]+ 0 1 1 )x");
    if (!std::regex_search(svg, found, disc)) return {};
    const double radius = std::stod(found[3].str());
    return {std::stod(found[1].str()) + radius, std::stod(found[2].str()), radius};
  }

  /// Where the outlines of a picture begin.
  static std::vector<std::pair<double, double>> beginnings(const std::string& svg) {
    std::vector<std::pair<double, double>> all;
    const std::regex outline(R"x(d="M(-?[\d.]+) (-?[\d.]+))x");
    for (std::sregex_iterator i(svg.begin(), svg.end(), outline), end; i != end; ++i) {
      all.emplace_back(std::stod((*i)[1].str()), std::stod((*i)[2].str()));
    }
    return all;
  }
};

TEST_F(RunAhead, AllBodiesAreInThePictureOverTheWholeRun) {
  for (const std::string mode : {"reference", "sleep", "merge", "merge+sleep"}) {
    for (const int rate : {60, 100, 240}) {
      SCOPED_TRACE(fmt::format("{}, h = 1/{}", mode, rate));
      const auto shown =
          frames(kTable, {"--mode", mode, "--set", fmt::format("step={}", 1.0 / rate)});
      for (const std::string& svg : shown) {
        const Disc ball = discIn(svg);
        EXPECT_GT(ball.radius, 1.0);
        EXPECT_GE(ball.y - ball.radius, 0.0);
        EXPECT_LE(ball.y + ball.radius, kSide);
        for (const auto& [x, y] : beginnings(svg)) {
          EXPECT_TRUE(x >= 0.0 && x <= kSide && y >= 0.0 && y <= kSide) << x << ", " << y;
        }
      }
      EXPECT_GT(discIn(shown[2]).y, discIn(shown[0]).y + 0.5 * kSide) << "it falls by 4.9 m";
    }
  }
}

// The way in the picture is rounded to a hundredth of a pixel.
TEST_F(RunAhead, ABodyThatIsFollowedStaysInTheMiddle) {
  for (const std::string& svg : frames(kTable + "[camera]\nfollow = \"ball\"\n")) {
    EXPECT_NEAR(discIn(svg).x, 0.5 * kSide, 0.02);
    EXPECT_NEAR(discIn(svg).y, 0.5 * kSide, 0.02);
  }
}

// The margin is a part of the height on either side: with a half the picture is twice as high.
TEST_F(RunAhead, AMarginIsLeftAroundThem) {
  const auto fall = [&](const char* margin) {
    const auto shown = frames(kTable + "[camera]\nmargin = " + margin + "\n");
    return discIn(shown[2]).y - discIn(shown[0]).y;
  };
  EXPECT_NEAR(fall("0") / fall("0.5"), 2.0, 0.001);
}

}  // namespace
}  // namespace merge2d
