#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "render/camera.h"
#include "render/frame.h"
#include "render/label_painter.h"
#include "tests/render/samples.h"

namespace merge2d {
namespace {

using samples::Sample;

/// Two bricks of 1 m × 0.5 m, one on the other, for each of 20 collections in five rows of four;
/// a metre and a fifth from centre to centre. The origin is in the middle.
Sample pairs() {
  Sample s;
  for (int i = 0; i < 20; ++i) {
    const Vec2 at(1.2 * (i % 4 - 1.5), 1.2 * (i / 4 - 2));
    s.box(at + Vec2(0.0, 0.25), 1.0, 0.5);
    s.box(at - Vec2(0.0, 0.25), 1.0, 0.5);
    const auto first = static_cast<std::size_t>(2 * i);
    s.collect(301 + i, {samples::id(first), samples::id(first + 1)});
  }
  return s;
}

FrameStyle style(double height, const Overlays& overlays = Overlays::standard(), int width = 1280) {
  FrameStyle out;
  out.width = width;
  out.height = width * 9 / 16;
  out.overlays = overlays;
  out.camera = {{0.0, 0.0}, height};
  return out;
}

/// The labels of a sample, and all that they refer to.
class Labelled {
 public:
  Labelled(Sample sample, FrameStyle style)
      : sample_(std::move(sample)),
        style_(std::move(style)),
        looks_(sample_.bodies),
        slots_(CollectionColors().update(sample_.snapshot)),
        layout_(layoutOf(style_.width, style_.height, style_.overlays)),
        scene_{sample_.snapshot,
               sample_.bodies,
               looks_,
               style_,
               slots_,
               layout_,
               View(style_.camera, layout_.panel)},
        labels_(text_, scene_) {}

  const FrameScene& scene() const { return scene_; }
  const std::vector<LabelPainter::Label>& labels() const { return labels_.plates.labels(); }
  const std::vector<const CollectionView*>& without() const { return labels_.without; }
  std::size_t collections() const { return sample_.snapshot.collections.size(); }
  const LabelPainter::Label& of(const std::string& text) const {
    return *std::ranges::find(labels(), text, &LabelPainter::Label::text);
  }

 private:
  Sample sample_;
  FrameStyle style_;
  BodyLooks looks_;
  CollectionSlots slots_;
  Layout layout_;
  Text text_;
  FrameScene scene_;
  FrameLabels labels_;
};

constexpr double kHeights[] = {8.0, 25.0, 50.0, 100.0, 1000.0};  // of the view [m]

TEST(Labels, EachCollectionWithRoomHasOne) {
  for (const double height : {8.0, 15.0, 25.0}) {
    const Labelled frame(pairs(), style(height));
    std::set<std::string> texts;
    for (const LabelPainter::Label& label : frame.labels()) texts.insert(label.text);
    EXPECT_EQ(texts.size(), 20U) << height;
    EXPECT_TRUE(frame.without().empty()) << height;
  }
}

TEST(Labels, EachCollectionHasEitherOneOrALineAroundIt) {
  for (const double height : kHeights) {
    const Labelled frame(pairs(), style(height));
    EXPECT_EQ(frame.labels().size() + frame.without().size(), frame.collections()) << height;
  }
}

TEST(Labels, NoTwoOverlap) {
  for (const double height : kHeights) {
    const Labelled frame(pairs(), style(height, parseOverlays("names")));
    const auto& labels = frame.labels();
    for (std::size_t i = 0; i < labels.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(labels[i].plate.overlaps(labels[j].plate))
            << labels[i].text << " and " << labels[j].text << " at " << height << " m";
      }
    }
  }
}

TEST(Labels, NoneIsTooSmallToRead) {
  for (const int width : {320, 640, 1280, 1920}) {
    for (const double height : kHeights) {
      const Labelled frame(pairs(), style(height, Overlays::standard(), width));
      for (const LabelPainter::Label& label : frame.labels()) EXPECT_GE(label.print.font.size, 9);
    }
  }
}

TEST(Labels, EachLiesOnItsCollection) {
  const Labelled frame(pairs(), style(25.0));
  for (const CollectionView& c : frame.scene().snapshot.collections) {
    const PixelBox plate = frame.of("C" + std::to_string(value(c.id))).plate;
    const Pixel middle{plate.x + 0.5F * plate.width, plate.y + 0.5F * plate.height};
    const Pixel off = middle - frame.scene().view(c.x);
    EXPECT_LE(std::abs(off.x), frame.scene().view(0.5)) << value(c.id);
    EXPECT_LE(std::abs(off.y), frame.scene().view(0.5)) << value(c.id);
  }
}

TEST(Labels, LargerCollectionsHaveLargerPrint) {
  Sample s = pairs();
  s.box({8.0, 0.0}, 6.0, 3.0);
  s.collect(400, {samples::id(40)});
  const Labelled frame(std::move(s), style(25.0));
  EXPECT_GT(frame.of("C400").print.font.size, frame.of("C301").print.font.size);
}

TEST(Labels, FewCollectionsHaveLargeOnesHoweverSmallTheyAre) {
  Sample s;
  s.box({0.0, 0.0}, 0.1, 0.1);
  s.collect(1, {samples::id(0)});
  const Labelled frame(std::move(s), style(25.0));
  ASSERT_EQ(frame.labels().size(), 1U);
  EXPECT_EQ(frame.labels()[0].print.font.size, 13);
}

/// How far from ink the line beside a body is, to its left (-1) or its right (1).
double fromInk(const Picture& picture, const FrameScene& scene, const BodyState& body, int side) {
  const Pixel edge = scene.view(body.x + Vec2(0.5 * side, 0.0));
  double least = 1e300;
  for (const int aside : {0, side}) {
    const int x = static_cast<int>(std::floor(edge.x)) + aside;
    const Color color = picture.at(x, static_cast<int>(edge.y));
    least = std::min(least, difference(color, scene.theme().ink));
  }
  return least;
}

TEST(Labels, ACollectionWithoutRoomHasALineAroundAllOfIt) {
  for (const Theme* theme : {&lightTheme(), &darkTheme(), &printTheme()}) {
    FrameStyle look = style(40.0);
    look.theme = *theme;
    const Sample s = pairs();
    const Labelled frame(s, look);
    ASSERT_EQ(frame.without().size(), 20U);
    const Picture with = FrameDrawer(s.bodies, look).draw(s.snapshot);
    look.overlays.remove(Overlay::Labels);
    const Picture bare = FrameDrawer(s.bodies, look).draw(s.snapshot);
    for (const BodyState& body : s.snapshot.bodies) {
      for (const int side : {-1, 1}) {
        const double line = fromInk(with, frame.scene(), body, side);
        EXPECT_LT(line, 25.0) << theme->name << ", body " << index(body.id);
        EXPECT_LT(line, fromInk(bare, frame.scene(), body, side)) << theme->name;
      }
    }
  }
}

TEST(Labels, WithoutThemThereIsNoLineEither) {
  const Labelled frame(pairs(), style(40.0, parseOverlays("-labels")));
  EXPECT_TRUE(frame.labels().empty());
  EXPECT_TRUE(frame.without().empty());
}

}  // namespace
}  // namespace merge2d
