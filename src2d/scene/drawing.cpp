/// Drawn scenes: pixel art in which every 8-connected patch of ink is a body. One pixel is one unit
/// of length, y points down in the picture and up in the world, whose origin is the picture's lower
/// left corner.
///
/// A body's mass is the sum over its pixels, dark ones weighing more; its shapes have one density,
/// so that centre of mass and moment of inertia are those of its outline.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "src2d/core/error.h"
#include "src2d/scene/cover.h"
#include "src2d/scene/file.h"
#include "src2d/scene/ink.h"
#include "src2d/scene/load.h"

namespace merge2d {
namespace {

struct Cell {
  int x = 0;
  int y = 0;
};

/// One 8-connected patch, in the order in which its pixels were found.
using Patch = std::vector<Cell>;

/// Decimal fractions without the noise that arithmetic leaves in them.
double neat(double length) { return std::round(length * 1e9) / 1e9; }

/// Patches in the order of their topmost, then leftmost pixel.
std::vector<Patch> findPatches(const Image& image) {
  Mask open(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) open.set(x, y, inkOf(image.at(x, y)) != Ink::Empty);
  }
  std::vector<Patch> patches;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!open.filled(x, y)) continue;
      Patch patch{{x, y}};
      open.set(x, y, false);
      for (std::size_t next = 0; next < patch.size(); ++next) {
        const Cell cell = patch[next];
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            if (!open.filled(cell.x + dx, cell.y + dy)) continue;
            open.set(cell.x + dx, cell.y + dy, false);
            patch.push_back({cell.x + dx, cell.y + dy});
          }
        }
      }
      patches.push_back(std::move(patch));
    }
  }
  return patches;
}

/// Turns patches into the bodies of a scene.
class Drawing {
 public:
  Drawing(const Image& image, std::string file, Scene& scene)
      : image_(image),
        file_(std::move(file)),
        scene_(scene),
        pixel_(scene.settings.drawing.pixel) {}

  void interpret() {
    std::vector<Patch> patches = findPatches(image_);
    addGround(patches);
    if (patches.size() > SceneLimits::kBodies) {
      throw InputError(fmt::format("{}: a scene has at most {} bodies, this drawing has {}", file_,
                                   SceneLimits::kBodies, patches.size()));
    }
    for (const Patch& patch : patches) addBody(patch);
    setCamera();
    warnOfDoubts();
  }

 private:
  Ink ink(const Cell& c) const { return inkOf(image_.at(c.x, c.y)); }
  /// World point of column `x` and row `y`; pixel centres are at half numbers.
  Vec2 point(double x, double y) const {
    return {neat(x * pixel_), neat((image_.height - y) * pixel_)};
  }
  Vec2 center(const Cell& c) const { return point(c.x + 0.5, c.y + 0.5); }
  void warn(const std::string& sentence) { scene_.warnings.push_back(file_ + ": " + sentence); }

  // The ground

  /// Takes the two lone cyan pixels away from the patches.
  void addGround(std::vector<Patch>& patches) {
    std::vector<Cell> horizon;
    std::vector<Cell> lone;
    for (const Patch& patch : patches) {
      for (const Cell& c : patch) {
        if (ink(c) != Ink::Horizon) continue;
        horizon.push_back(c);
        if (patch.size() == 1) lone.push_back(c);
      }
    }
    if (horizon.empty()) return;
    if (horizon.size() != 2 || lone.size() != 2) {
      return warn(
          fmt::format("pixel ({}, {}) is cyan, but the ground needs exactly two lone cyan "
                      "pixels: cyan counts as plain matter",
                      horizon[0].x, horizon[0].y));
    }
    std::erase_if(patches, [&](const Patch& p) { return ink(p.front()) == Ink::Horizon; });
    addHalfPlane(center(lone[0]), center(lone[1]));
  }

  /// What lies below the line, as a box much larger than the drawing.
  void addHalfPlane(Vec2 left, Vec2 right) {
    if (left.x() > right.x()) std::swap(left, right);
    if (left.x() == right.x()) {
      throw InputError(
          fmt::format("{}: the two cyan pixels are above one another, so neither side "
                      "of their line is below it",
                      file_));
    }
    const Vec2 along = (right - left).normalized();
    const double size = std::max(image_.width, image_.height) * pixel_;
    const double width =
        neat(std::clamp(20 * size, SceneLimits::kSmallest, SceneLimits::kCoordinate));
    const double depth = neat(0.1 * width);
    BodyDesc ground;
    ground.name = "ground";
    ground.motion = Motion::Pinned;
    ground.angle = std::atan2(along.y(), along.x());
    ground.at = 0.5 * (left + right) - 0.5 * depth * perpendicular(along);
    ground.shapes = {makeBox(width, depth)};
    add(ground);
  }

  // Bodies

  void addBody(const Patch& patch) {
    double mass = 0;
    std::vector<Cell> matter;
    std::map<Ink, int> count;
    for (const Cell& c : patch) {
      ++count[ink(c)];
      if (ink(c) == Ink::Joiner) continue;
      matter.push_back(c);
      mass += std::max(darkness(image_.at(c.x, c.y)), 0.01);
    }
    if (matter.empty()) {
      return warn(fmt::format("the yellow patch at pixel ({}, {}) joins nothing and is left out",
                              patch[0].x, patch[0].y));
    }
    BodyDesc body = shapedBody(matter);
    const bool pinned = count[Ink::Pinned] == static_cast<int>(matter.size());
    const bool magnetic = count[Ink::Magnet] > 0;
    body.motion = pinned ? Motion::Pinned : Motion::Dynamic;
    if (!pinned) body.mass = neat(mass * pixel_ * pixel_ * scene_.settings.material.density);
    if (count[Ink::Held] > 0) body.pinned_until = scene_.settings.drawing.pinned_until;
    body.name = nameFor(pinned ? "pinned" : magnetic ? "magnet" : "body");
    add(body);
    addSprings(matter, count[Ink::Spring] + count[Ink::Magnet]);
    if (magnetic) scene_.magnets.push_back({scene_.bodies.size() - 1, {{}}});
  }

  void add(BodyDesc body) {
    body.friction = scene_.settings.material.friction;
    body.restitution = scene_.settings.material.restitution;
    body.density = scene_.settings.material.density;
    scene_.bodies.push_back(std::move(body));
  }

  std::string nameFor(const std::string& role) {
    return fmt::format("{}{}", role, ++numbers_[role]);
  }

  /// The body whose frame is in the middle of its pixels, covered by rectangles.
  BodyDesc shapedBody(const std::vector<Cell>& cells) const {
    int x0 = image_.width, x1 = 0, y0 = image_.height, y1 = 0;
    for (const Cell& c : cells) {
      x0 = std::min(x0, c.x);
      x1 = std::max(x1, c.x + 1);
      y0 = std::min(y0, c.y);
      y1 = std::max(y1, c.y + 1);
    }
    Mask mask(x1 - x0, y1 - y0);
    for (const Cell& c : cells) mask.set(c.x - x0, c.y - y0, true);

    BodyDesc body;
    body.at = point(0.5 * (x0 + x1), 0.5 * (y0 + y1));
    for (const PixelRect& r : coverByRectangles(mask)) body.shapes.push_back(placed(r, mask));
    if (body.shapes.size() > SceneLimits::kShapesPerBody) {
      throw InputError(fmt::format(
          "{}: the body at pixel ({}, {}) needs {} rectangles, at most {} "
          "are allowed",
          file_, cells[0].x, cells[0].y, body.shapes.size(), SceneLimits::kShapesPerBody));
    }
    return body;
  }

  /// A rectangle of a mask in the frame of the mask's middle.
  ConvexShape placed(const PixelRect& r, const Mask& mask) const {
    const Vec2 middle(neat((r.x + 0.5 * r.width - 0.5 * mask.width()) * pixel_),
                      neat((0.5 * mask.height() - r.y - 0.5 * r.height) * pixel_));
    return makeBox(neat(r.width * pixel_), neat(r.height * pixel_), Pose::at(middle, 0));
  }

  // Springs

  /// From each red and magenta pixel of the last body to where it is now.
  void addSprings(const std::vector<Cell>& cells, int count) {
    if (count == 0) return;
    const BodyDesc& body = scene_.bodies.back();
    SpringDesc spring = usualSpring(*body.mass / count);
    spring.body = scene_.bodies.size() - 1;
    for (const Cell& c : cells) {
      if (ink(c) != Ink::Spring && ink(c) != Ink::Magnet) continue;
      spring.to = center(c);
      spring.anchor = (spring.to - body.at).unaryExpr(&neat);
      scene_.springs.push_back(spring);
    }
  }

  /// One that gives way by a pixel under the weight of `mass` and whose swinging dies out slowly,
  /// unless the settings say otherwise.
  SpringDesc usualSpring(double mass) const {
    constexpr double kDampingRatio = 0.15;
    const DrawingSettings& settings = scene_.settings.drawing;
    const double gravity = scene_.gravity.norm() > 0 ? scene_.gravity.norm() : 9.81;
    SpringDesc spring;
    spring.stiffness = settings.stiffness > 0 ? settings.stiffness : neat(mass * gravity / pixel_);
    spring.damping = settings.damping > 0
                         ? settings.damping
                         : neat(2 * kDampingRatio * std::sqrt(spring.stiffness * mass));
    return spring;
  }

  // What the user should know

  void warnOfDoubts() {
    struct Doubt {
      Cell first;
      int count = 0;
    };
    std::map<std::pair<Ink, Ink>, Doubt> doubts;
    for (int y = 0; y < image_.height; ++y) {
      for (int x = 0; x < image_.width; ++x) {
        const auto other = doubtfulInk(image_.at(x, y));
        if (!other) continue;
        Doubt& doubt = doubts[{ink({x, y}), *other}];
        if (doubt.count++ == 0) doubt.first = {x, y};
      }
    }
    for (const auto& [inks, doubt] : doubts) {
      const Image::Pixel& p = image_.at(doubt.first.x, doubt.first.y);
      const std::string more =
          doubt.count == 1 ? "" : fmt::format(" ({} such pixels)", doubt.count);
      warn(
          fmt::format("pixel ({}, {}) of colour #{:02x}{:02x}{:02x} is taken as {}, but is nearly "
                      "{}{}",
                      doubt.first.x, doubt.first.y, p.r, p.g, p.b, describe(inks.first),
                      describe(inks.second), more));
    }
  }

  /// The camera sees the picture, not the whole ground.
  void setCamera() {
    constexpr double kAspect = 16.0 / 9.0;
    constexpr double kMargin = 1.05;
    const double height =
        kMargin * pixel_ * std::max<double>(image_.height, image_.width / kAspect);
    scene_.camera = Camera{point(0.5 * image_.width, 0.5 * image_.height), neat(height)};
  }

  const Image& image_;
  std::string file_;
  Scene& scene_;
  double pixel_;
  std::map<std::string, int> numbers_;
};

/// The overrides that say what a pixel means.
Overrides forPixels(const Overrides& overrides) {
  Overrides result;
  for (const auto& [key, value] : overrides) {
    const bool meant =
        key.starts_with("drawing.") || key.starts_with("material.") || key == "gravity";
    if (meant) result.emplace_back(key, value);
  }
  return result;
}

}  // namespace

Scene loadDrawing(const std::filesystem::path& png, const Overrides& overrides) {
  const std::string file = png.string();
  const Image image = decodePng(readFile(png), file);
  Scene drawn = parseScene("", file, forPixels(overrides));
  drawn.warnings.clear();
  drawn.duration = 20.0;
  Drawing(image, file, drawn).interpret();

  // By way of its text, so that --set reaches its bodies, and `validate --to` writes what runs.
  Scene scene = parseScene(toToml(drawn), file, overrides);
  scene.warnings.insert(scene.warnings.begin(), drawn.warnings.begin(), drawn.warnings.end());
  return scene;
}

}  // namespace merge2d
