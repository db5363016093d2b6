#include "render/frame.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "render/camera.h"
#include "render/compare.h"
#include "render/png.h"
#include "tests/render/samples.h"
#include "tests/support/build_dir.h"

namespace merge2d {
namespace {

using samples::Sample;
using samples::styleOf;

Picture drawn(const Sample& sample, const FrameStyle& style) {
  return FrameDrawer(sample.bodies, style).draw(sample.snapshot);
}

/// Compares with frames/reference/NAME.png; MERGE2D_UPDATE_REFERENCES=1 writes it instead.
void expectLikeReference(const Picture& picture, const std::string& name) {
  const std::filesystem::path source = MERGE2D_SOURCE_DIR, build = buildDir();
  const std::filesystem::path reference = source / "frames" / "reference" / (name + ".png");
  if (std::getenv("MERGE2D_UPDATE_REFERENCES") != nullptr) {
    bool alpha = false;
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
      alpha = alpha || picture.rgba[i] != 255;
    savePng(reference, picture, {.alpha = alpha});
  }
  EXPECT_EQ(compareWithReference(picture, reference, build / "test-pictures"), "");
}

TEST(FrameReference, MixedShapes) {
  const Sample s = samples::mixture();
  expectLikeReference(drawn(s, styleOf(s, "Mixed shapes", 320, 180)), "mixed_light");
}

TEST(FrameReference, ATowerInTheDark) {
  const Sample s = samples::tower(8, 12, 3);
  expectLikeReference(drawn(s, styleOf(s, "A tower", 320, 180, Overlays::standard(), darkTheme())),
                      "tower_dark");
}

TEST(FrameReference, ContactsForcesAndWeldsInPrint) {
  const Sample s = samples::tower(3, 3, 2);
  const Overlays overlays = parseOverlays("contacts,forces,welds,boxes,-legend");
  expectLikeReference(drawn(s, styleOf(s, "A wall", 320, 240, overlays, printTheme())),
                      "overlays_print");
}

TEST(Frame, TheLegendTellsOfGraphWeldsAndBoxes) {
  const Sample s = samples::tower(3, 3, 2);
  const auto legend = [&](const std::string& overlays) {
    const Picture p = drawn(s, styleOf(s, "A wall", 960, 540, parseOverlays(overlays)));
    const auto rows = static_cast<std::ptrdiff_t>(p.height - 30) * p.width * 4;
    return std::vector<std::uint8_t>(p.rgba.begin() + rows, p.rgba.end());
  };
  for (const char* overlay : {"graph", "welds", "boxes"}) {
    EXPECT_NE(legend("legend"), legend(std::string("legend,") + overlay)) << overlay;
    EXPECT_EQ(legend("-legend"), legend(std::string("-legend,") + overlay)) << overlay;
  }
}

TEST(FrameReference, AllOverlaysOnATransparentBackground) {
  const Sample s = samples::mixture();
  FrameStyle style = styleOf(s, "Everything", 480, 270, parseOverlays("all"));
  style.transparent = true;
  expectLikeReference(drawn(s, style), "mixed_transparent");
}

/// Bare bodies, 10 px to the metre, the origin in the middle of 200 × 100 pixels.
FrameStyle bare() {
  FrameStyle style;
  style.width = 200;
  style.height = 100;
  style.overlays = {};
  style.camera = {{0.0, 0.0}, 10.0};
  return style;
}

TEST(Frame, ABodyIsDrawnWhereItIsWithYUp) {
  Sample s;
  s.box({5.0, 3.0}, 2.0, 2.0);
  const Picture picture = drawn(s, bare());
  EXPECT_EQ(picture.at(150, 20), lightTheme().free.fill);
  EXPECT_EQ(picture.at(150, 80), lightTheme().background);
}

TEST(Frame, LaterBodiesLieOverEarlierOnes) {
  Sample s;
  s.box({0.0, 0.0}, 4.0, 4.0);
  s.box({0.0, 0.0}, 2.0, 2.0);
  s.collect(1, {samples::id(1)});
  EXPECT_EQ(drawn(s, bare()).at(100, 50), lightTheme().collections[0].fill);
  std::swap(s.snapshot.bodies[0].x, s.snapshot.bodies[1].x);
  EXPECT_EQ(drawn(s, bare()).at(115, 50), lightTheme().free.fill);
}

TEST(Frame, ColoursSayWhatABodyIs) {
  Sample s;
  s.box({-8.0, 0.0}, 2.0, 2.0);
  s.box({-4.0, 0.0}, 2.0, 2.0).asleep = true;
  s.box({0.0, 0.0}, 2.0, 2.0);
  s.box({4.0, 0.0}, 2.0, 2.0);
  s.collect(1, {samples::id(2)});
  s.collect(2, {samples::id(3)}, true);
  const Theme& theme = lightTheme();
  const Picture picture = drawn(s, bare());
  EXPECT_EQ(picture.at(20, 50), theme.free.fill);
  EXPECT_EQ(picture.at(60, 50), theme.asleep.fill);
  EXPECT_EQ(picture.at(100, 50), theme.collections[0].fill);
  EXPECT_EQ(picture.at(140, 50), theme.asleep.fill);
}

TEST(Frame, FixedBodiesAreHatchedAndNeverHaveTheColourOfACollection) {
  for (const Motion motion : {Motion::Pinned, Motion::Scripted}) {
    Sample s;
    s.box({0.0, 0.0}, 10.0, 8.0, 0.0, motion);
    s.collect(1, {samples::id(0)});
    const Picture picture = drawn(s, bare());
    int plain = 0, striped = 0;
    for (int x = 60; x < 140; ++x) {
      const Color c = picture.at(x, 50);
      plain += c == lightTheme().fixed.fill ? 1 : 0;
      striped += difference(c, lightTheme().hatch) < 5.0 ? 1 : 0;
      EXPECT_GT(difference(c, lightTheme().collections[0].fill), 20.0);
    }
    EXPECT_GT(plain, 30);
    EXPECT_GT(striped, 2);
  }
}

TEST(Frame, ADynamicBodyThatIsPinnedForNowIsHatched) {
  Sample s;
  s.box({0.0, 0.0}, 10.0, 8.0).pinned = true;
  EXPECT_NE(drawn(s, bare()).at(100, 50), lightTheme().free.fill);
}

TEST(Frame, NoSeamShinesThroughBetweenThePiecesOfABody) {
  Sample s;
  s.add(
      {makeBox(3.0, 4.0, Pose::at({-1.5, 0.0}, 0.0)), makeBox(3.0, 4.0, Pose::at({1.5, 0.0}, 0.0))},
      {0.13, 0.0}, 0.3);
  const Picture picture = drawn(s, bare());
  for (int y = 40; y < 60; ++y) {
    for (int x = 85; x < 115; ++x) {
      EXPECT_LT(difference(picture.at(x, y), lightTheme().free.fill), 3.0) << x << ", " << y;
    }
  }
}

TEST(Frame, AHugeGroundHasItsEdgeWhereItBelongs) {
  Sample s;
  s.box({300.0, -5000.0}, 400000.0, 10000.0, 0.0, Motion::Pinned);
  const Picture picture = drawn(s, bare());
  EXPECT_EQ(picture.at(100, 48), lightTheme().background);
  EXPECT_NE(picture.at(100, 50), lightTheme().background);
  EXPECT_NE(picture.at(100, 90), lightTheme().background);
}

TEST(Frame, ATransparentFrameHasNoBackground) {
  Sample s;
  s.box({0.0, 0.0}, 4.0, 4.0);
  FrameStyle style = bare();
  style.transparent = true;
  const Picture picture = drawn(s, style);
  EXPECT_EQ(picture.at(2, 2).a, 0);
  EXPECT_EQ(picture.at(100, 50), lightTheme().free.fill);
}

TEST(Frame, TheScaleBarIsAsLongAsItSays) {
  Sample s;
  s.box({0.0, 0.0}, 1.0, 1.0);
  FrameStyle style = bare();
  style.width = 640;
  style.height = 360;
  style.overlays.add(Overlay::Scale);
  style.camera.height = 10.0;
  const Picture picture = drawn(s, style);
  const Layout layout = layoutOf(style.width, style.height, style.overlays);
  const double scale = double{layout.panel.height} / 10.0;
  const double expected = scale * roundLength(0.12 * double{layout.panel.width} / scale);
  const int y = static_cast<int>(layout.footer.y + 0.5F * layout.footer.height);
  int longest = 0, run = 0;
  for (int x = 0; x < picture.width; ++x) {
    run = picture.at(x, y) == lightTheme().ink ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  EXPECT_NEAR(longest, expected, 2.0);
}

TEST(Frame, EachOverlayChangesThePicture) {
  Sample s = samples::mixture();
  FrameStyle style = styleOf(s, "Overlays", 640, 360);
  for (const OverlayEntry& entry : kOverlayTable) {
    style.overlays = {};
    const Picture without = drawn(s, style);
    style.overlays.add(entry.overlay);
    EXPECT_NE(drawn(s, style).rgba, without.rgba) << entry.name;
  }
}

TEST(Frame, ADrawingIsTheSameEachTime) {
  const Sample s = samples::mixture();
  const FrameStyle style = styleOf(s, "Twice", 320, 180, parseOverlays("all"));
  FrameDrawer drawer(s.bodies, style);
  const Picture first = drawer.draw(s.snapshot);
  EXPECT_EQ(drawer.draw(s.snapshot).rgba, first.rgba);
  EXPECT_EQ(drawn(s, style).rgba, first.rgba);
  Canvas canvas(style.width, style.height);
  EXPECT_EQ(drawFrame(canvas, s.snapshot, s.bodies, style).rgba, first.rgba);
}

TEST(Frame, DrawsPicturesOfAnySize) {
  const Sample s = samples::mixture();
  for (const auto& [width, height] : {std::pair{2, 2}, {33, 17}, {100, 700}, {1900, 60}}) {
    const Picture picture = drawn(s, styleOf(s, "Any size", width, height, parseOverlays("all")));
    EXPECT_EQ(picture.width, width);
    EXPECT_EQ(picture.height, height);
  }
}

TEST(Describe, SaysInWordsWhatThePictureShows) {
  const Sample s = samples::mixture();
  FrameStyle style = styleOf(s, "Mixed shapes", 320, 180);
  style.mode = Mode::Reference;
  const std::string text = describe(s.snapshot, style);
  EXPECT_EQ(text.substr(0, 38), "Mixed shapes. Step 123, t = 1.23 s, re");
  EXPECT_NE(text.find("10 bodies"), std::string::npos);
  EXPECT_EQ(text.find("collections"), std::string::npos) << "nothing merges in this mode";
}

/// The places of all letters of a drawing, by layer.
TEST(Frame, LettersOfOneLayerNeverOverlap) {
  const Sample s = samples::mixture();
  for (const int width : {320, 640, 1280, 1920}) {
    FrameStyle style = styleOf(s, "A rather long title of a scene with mixed shapes", width,
                               width * 9 / 16, parseOverlays("labels,names"));
    Text text;
    const CollectionSlots slots = CollectionColors().update(s.snapshot);
    const Drawing drawing =
        composeFrame(text, s.snapshot, s.bodies, BodyLooks(s.bodies), style, slots);
    for (const Layer& layer : drawing.layers) {
      for (std::size_t i = 0; i < layer.glyphs.size(); ++i) {
        for (std::size_t j = i + 2; j < layer.glyphs.size(); ++j) {
          const GlyphInstance &a = layer.glyphs[i], &b = layer.glyphs[j];
          const bool apart = a.x + a.width <= b.x || b.x + b.width <= a.x ||
                             a.y + a.height <= b.y || b.y + b.height <= a.y;
          EXPECT_TRUE(apart) << "at " << a.x << ", " << a.y << " in width " << width;
        }
      }
    }
  }
}

}  // namespace
}  // namespace merge2d
