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
#include <optional>
#include <utility>

#include "src2d/core/error.h"
#include "src2d/core/trig.h"
#include "src2d/scene/cover.h"
#include "src2d/scene/drawing_doubts.h"
#include "src2d/scene/file.h"
#include "src2d/scene/ink.h"
#include "src2d/scene/load.h"
#include "src2d/scene/range.h"

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
    checkSize();
    std::vector<Patch> patches = findPatches(image_);
    addGround(patches);
    if (patches.size() > SceneLimits::kBodies) {
      fail(patches[SceneLimits::kBodies].front(),
           "is one body too many: a scene has at most {}, this drawing has {}; is it a photograph, "
           "or full of specks? All that touches is one body",
           SceneLimits::kBodies, patches.size());
    }
    for (const Patch& patch : patches) addBody(patch);
    setCamera();
    warnOfMixtures();
    for (const std::string& doubt : doubtsAboutColours(image_)) warn(doubt);
  }

  /// `scene` is what became of the drawing, after all that --set changes.
  void warnOfFreeFall(Scene& scene) const {
    const auto stays = [](const BodyDesc& body) { return body.motion != Motion::Dynamic; };
    const bool held = !scene.springs.empty() || std::ranges::any_of(scene.bodies, stays);
    if (!first_ || held || scene.gravity == Vec2::Zero()) return;
    scene.warnings.push_back(fmt::format(
        "{}: nothing is pinned for good or held by a spring, so everything, such as the body at "
        "pixel ({}, {}), falls for ever: draw a floor all in blue, or two lone cyan pixels",
        file_, first_->x, first_->y));
  }

 private:
  Ink ink(const Cell& c) const { return inkOf(image_.at(c.x, c.y)); }
  /// World point of column `x` and row `y`; pixel centres are at half numbers.
  Vec2 point(double x, double y) const {
    return {neat(x * pixel_), neat((image_.height - y) * pixel_)};
  }
  Vec2 center(const Cell& c) const { return point(c.x + 0.5, c.y + 0.5); }
  void warn(const std::string& sentence) { scene_.warnings.push_back(file_ + ": " + sentence); }
  /// "drawing.png: pixel (3, 4) …"
  template <class... Args>
  [[noreturn]] void fail(const Cell& c, fmt::format_string<Args...> sentence,
                         Args&&... args) const {
    throw InputError(fmt::format("{}: pixel ({}, {}) {}", file_, c.x, c.y,
                                 fmt::format(sentence, std::forward<Args>(args)...)));
  }

  /// All later lengths are within the limits of a scene if this is.
  void checkSize() const {
    const double size = std::max(image_.width, image_.height) * pixel_;
    if (size <= SceneLimits::kCoordinate) return;
    throw InputError(
        fmt::format("{}: with drawing.pixel = {} this picture is {:.6g} m large, but a "
                    "scene has at most {:.6g} m",
                    file_, pixel_, size, SceneLimits::kCoordinate));
  }

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
    if (lone[0].x == lone[1].x) {
      fail(lone[0],
           "is cyan, and the other cyan one ({}, {}) is straight below it, so that no side of "
           "their line is the ground: move one of them sideways",
           lone[1].x, lone[1].y);
    }
    addHalfPlane(center(lone[0]), center(lone[1]));
  }

  /// The half-plane below the line, as a box much larger than the drawing.
  void addHalfPlane(Vec2 left, Vec2 right) {
    if (left.x() > right.x()) std::swap(left, right);
    const Vec2 along = (right - left).normalized();
    const double size = std::max(image_.width, image_.height) * pixel_;
    const double width =
        neat(std::clamp(20 * size, SceneLimits::kSmallest, SceneLimits::kCoordinate));
    const double depth = neat(0.1 * width);
    BodyDesc ground;
    ground.name = "ground";
    ground.motion = Motion::Pinned;
    ground.angle = arcTangent(along.y(), along.x());
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
    if (!first_) first_ = matter.front();
    BodyDesc body = shapedBody(matter);
    const bool pinned = count[Ink::Pinned] == static_cast<int>(matter.size());
    if (!pinned && count[Ink::Pinned] > 0) noteMixture(matter);
    const bool magnetic = count[Ink::Magnet] > 0;
    body.motion = pinned ? Motion::Pinned : Motion::Dynamic;
    if (!pinned) body.mass = massOf(mass * pixel_ * pixel_, matter.front());
    if (count[Ink::Held] > 0) body.pinned_until = scene_.settings.drawing.pinned_until;
    body.name = nameFor(pinned ? "pinned" : magnetic ? "magnet" : "body");
    add(body);
    addSprings(matter, count[Ink::Spring] + count[Ink::Magnet]);
    if (magnetic) scene_.magnets.push_back({scene_.bodies.size() - 1, {{}}});
  }

  /// Of the body at `first`, whose ink is worth `black` square metres of black.
  double massOf(double black, const Cell& first) const {
    const double mass = neat(black * scene_.settings.material.density);
    if (mass >= kPositive.lower && mass <= kPositive.upper) return mass;
    fail(first,
         "starts a body of {:.3g} kg: change material.density or drawing.pixel so that it is "
         "between 1e-9 and 1e12 kg",
         black * scene_.settings.material.density);
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
      fail(cells[0],
           "starts a body of {} rectangles, at most {} are allowed: fill its holes, or straighten "
           "its edges",
           body.shapes.size(), SceneLimits::kShapesPerBody);
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
      if (std::max(spring.stiffness, spring.damping) > SceneLimits::kNumber) {
        fail(c,
             "is a spring of {:.3g} N/m, at most 1e12 are allowed: set drawing.stiffness and "
             "drawing.damping",
             spring.stiffness);
      }
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

  // Warnings

  /// Remembers a body that is blue in part: `matter` are its pixels.
  void noteMixture(const std::vector<Cell>& matter) {
    const auto blue = [&](const Cell& c) { return ink(c) == Ink::Pinned; };
    if (mixtures_++ > 0) return;
    mixture_ = *std::ranges::find_if(matter, blue);
    beside_ = *std::ranges::find_if_not(matter, blue);
  }

  void warnOfMixtures() {
    if (mixtures_ == 0) return;
    const std::string more = mixtures_ == 1 ? "" : fmt::format(" ({} bodies are so)", mixtures_);
    const Image::Pixel& p = image_.at(beside_.x, beside_.y);
    warn(fmt::format(
        "pixel ({}, {}) is blue, but its body has other colours too, such as "
        "#{:02x}{:02x}{:02x} at ({}, {}), and is not pinned: a body is pinned where all "
        "of it is blue; draw the rest in blue, or leave a white gap to what touches it{}",
        mixture_.x, mixture_.y, p.r, p.g, p.b, beside_.x, beside_.y, more));
  }

  /// The camera sees the picture, not the whole ground.
  void setCamera() {
    constexpr double kAspect = 16.0 / 9.0;
    constexpr double kMargin = 1.05;
    const double height =
        kMargin * pixel_ * std::max<double>(image_.height, image_.width / kAspect);
    scene_.camera = Camera{point(0.5 * image_.width, 0.5 * image_.height),
                           std::min(neat(height), SceneLimits::kCoordinate)};
  }

  const Image& image_;
  std::string file_;
  Scene& scene_;
  double pixel_;
  std::map<std::string, int> numbers_;
  std::optional<Cell> first_;  ///< of the bodies' pixels
  Cell mixture_, beside_;      ///< the first pixels of a body that is blue in part: blue, and not
  int mixtures_ = 0;           ///< how many bodies are
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
  return parseDrawing(readFile(png), nameOfFile(png), overrides);
}

Scene parseDrawing(const std::string& bytes, const std::string& file, const Overrides& overrides) {
  const Image image = decodePng(bytes, file);
  Scene drawn = parseScene("", file, forPixels(overrides));
  drawn.warnings.clear();
  drawn.duration = 20.0;
  Drawing drawing(image, file, drawn);
  drawing.interpret();

  // By way of its text, so that --set reaches its bodies, and `validate --to` writes what runs.
  Scene scene = parseScene(toToml(drawn), file, overrides);
  scene.warnings.insert(scene.warnings.begin(), drawn.warnings.begin(), drawn.warnings.end());
  drawing.warnOfFreeFall(scene);
  return scene;
}

}  // namespace merge2d
