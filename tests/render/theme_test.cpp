#include "render/theme.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "src2d/core/error.h"

namespace merge2d {
namespace {

using testing::HasSubstr;

class Themes : public testing::TestWithParam<const char*> {
 protected:
  const Theme& theme = themeByName(GetParam());

  /// What of a finish can be seen against the background: its fill or its boundary.
  double visibility(const Finish& finish) const {
    return std::max(contrast(finish.fill, theme.background),
                    contrast(finish.outline, theme.background));
  }
};

INSTANTIATE_TEST_SUITE_P(All, Themes, testing::Values("light", "dark", "print"),
                         [](const auto& theme) { return std::string(theme.param); });

TEST_P(Themes, TextHasAContrastOfAtLeastFourAndAHalf) {
  EXPECT_GE(contrast(theme.ink, theme.background), 4.5);
  EXPECT_GE(contrast(theme.ink_soft, theme.background), 4.5);
}

TEST_P(Themes, BodiesStandOutFromTheBackgroundByAtLeastThree) {
  for (std::size_t i = 0; i < theme.collections.size(); ++i) {
    EXPECT_GE(visibility(theme.collections[i]), 3.0) << "collection slot " << i;
  }
  EXPECT_GE(visibility(theme.free), 3.0);
  EXPECT_GE(visibility(theme.asleep), 3.0);
  EXPECT_GE(visibility(theme.fixed), 3.0);
}

TEST_P(Themes, EveryBodyHasALineThatStandsOutFromItsFillOrTheBackground) {
  for (std::size_t i = 0; i < theme.collections.size(); ++i) {
    const auto& [fill, outline] = theme.collections[i];
    EXPECT_GE(std::max(contrast(outline, fill), contrast(outline, theme.background)), 3.0)
        << "collection slot " << i;
  }
}

TEST_P(Themes, LinesAndMarksStandOutByAtLeastThree) {
  const std::vector<std::pair<const char*, Color>> lines = {
      {"merged contact", theme.merged_contact},
      {"active contact", theme.active_contact},
      {"broken contact", theme.broken_contact},
      {"normal force", theme.normal_force},
      {"friction force", theme.friction_force},
      {"internal force", theme.internal_force},
      {"velocity", theme.velocity},
      {"graph", theme.graph},
      {"box", theme.box},
      {"spring", theme.spring},
      {"magnet", theme.magnet}};
  for (const auto& [name, color] : lines) {
    EXPECT_GE(contrast(color, theme.background), 3.0) << name;
    EXPECT_GE(contrast(color, theme.rim), 3.0) << name << " against its rim";
  }
}

/// Each pair of `colors` differs clearly for every kind of vision.
void expectDistinct(const std::vector<std::pair<std::string, Color>>& colors, double least) {
  for (const Vision vision :
       {Vision::Normal, Vision::Protanopia, Vision::Deuteranopia, Vision::Tritanopia}) {
    for (std::size_t i = 0; i < colors.size(); ++i) {
      for (std::size_t j = i + 1; j < colors.size(); ++j) {
        EXPECT_GE(difference(colors[i].second, colors[j].second, vision), least)
            << colors[i].first << " and " << colors[j].first << ", vision "
            << static_cast<int>(vision);
      }
    }
  }
}

TEST_P(Themes, FillsAreToldApartWithEveryKindOfVision) {
  std::vector<std::pair<std::string, Color>> fills;
  for (std::size_t i = 0; i < theme.collections.size(); ++i) {
    fills.emplace_back("slot " + std::to_string(i), theme.collections[i].fill);
  }
  fills.emplace_back("free", theme.free.fill);
  fills.emplace_back("asleep", theme.asleep.fill);
  expectDistinct(fills, 10.0);
}

TEST_P(Themes, ForcesAreToldApartWithEveryKindOfVision) {
  expectDistinct({{"normal", theme.normal_force},
                  {"friction", theme.friction_force},
                  {"internal", theme.internal_force}},
                 15.0);
}

TEST_P(Themes, LinesOfChartsStandOutAndAreToldApart) {
  std::vector<std::pair<std::string, Color>> lines;
  for (std::size_t i = 0; i < theme.lines.size(); ++i) {
    EXPECT_GE(contrast(theme.lines[i], theme.background), 3.0) << i;
    lines.emplace_back("line " + std::to_string(i), theme.lines[i]);
  }
  expectDistinct(lines, 15.0);
}

TEST(Theme, NamesAreTakenAndMistypedOnesGetASuggestion) {
  EXPECT_EQ(themeByName("dark").name, "dark");
  try {
    themeByName("drak");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("unknown theme 'drak' (did you mean 'dark'?)"));
  }
}

}  // namespace
}  // namespace merge2d
