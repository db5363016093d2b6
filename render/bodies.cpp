/// Bodies: fill, boundary, hatching.

#include <algorithm>
#include <array>
#include <cmath>

#include "render/frame_parts.h"

namespace merge2d {
namespace {

/// The part of a convex outline inside of a box: Sutherland and Hodgman's clipping.
std::vector<Vec2> clipped(std::vector<Vec2> outline, const Aabb& box) {
  std::vector<Vec2> kept;
  for (const int axis : {0, 1}) {
    for (const double side : {-1.0, 1.0}) {
      const double limit = side < 0.0 ? -box.lower[axis] : box.upper[axis];
      const auto excess = [&](const Vec2& p) { return side * p[axis] - limit; };
      kept.clear();
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        const double da = excess(a), db = excess(b);
        if (da <= 0.0) kept.push_back(a);
        if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) {
          kept.push_back(a + da / (da - db) * (b - a));
        }
      }
      outline.swap(kept);
    }
  }
  return outline;
}

/// One body on its way to the canvas.
class BodyPainter {
 public:
  BodyPainter(Painter& painter, const FrameScene& scene) : painter_(painter), scene_(scene) {}

  void draw(const BodyState& body) {
    const Silhouette& look = scene_.looks.silhouettes[index(body.id)];
    if (!place(body, look)) return;
    const Finish finish = finishOf(scene_, body);
    const float line = scene_.outlineWidth();
    Paint paint{.fill = finish.fill, .outline = finish.outline, .line = line};
    if (isFixed(scene_, body)) {
      const bool scripted = scene_.info(body.id).motion == Motion::Scripted;
      paint.hatch = hatchOf(scene_, scene_.view(pose_.position), pose_.rotation, scripted);
    }
    if (body.magnet_on) {
      paint.outline = scene_.theme().magnet;
      paint.line = 2.0F * line;
    }
    if (look.boundary.empty()) {
      drawPiece(look.pieces.front(), 0.5F * paint.line, paint);
      drawSpoke(look.pieces.front(), paint);
    } else {
      drawUnion(look, paint);
    }
  }

  /// Its shape in one colour, `grow` pixels larger all around.
  void drawShadow(const BodyState& body, float grow, Color color) {
    const Silhouette& look = scene_.looks.silhouettes[index(body.id)];
    if (!place(body, look)) return;
    for (const Piece& piece : look.pieces) drawPiece(piece, grow, {.fill = color});
  }

 private:
  /// False when nothing of it can be seen.
  bool place(const BodyState& body, const Silhouette& look) {
    pose_ = body.pose();
    return scene_.view.visible(8.0).grown(look.radius).contains({pose_.position, pose_.position});
  }

  /// Fills that overlap a little, so that no seam shines through, and one boundary around them.
  void drawUnion(const Silhouette& look, Paint paint) {
    const float line = paint.line;
    paint.line = 0.0F;
    for (const Piece& piece : look.pieces) drawPiece(piece, std::min(0.5F, 0.5F * line), paint);
    for (const Segment& s : look.boundary) {
      painter_.line(scene_.view(pose_ * s.from), scene_.view(pose_ * s.to), line, paint.outline);
    }
  }

  /// The boundary line is centred on the edge of the body, which is why the piece grows.
  void drawPiece(const Piece& piece, float grow, const Paint& paint) {
    const View& view = scene_.view;
    const Pixel center = view(pose_ * piece.frame.position);
    const bool huge = view(piece.radius) > 4.0F * (view.panel.width + view.panel.height);
    if (piece.kind == Piece::Kind::Disc) {
      painter_.disc(center, view(piece.radius) + grow, paint);
    } else if (piece.kind == Piece::Kind::Box && !huge) {
      const Rotation turn = pose_.rotation * piece.frame.rotation;
      painter_.box(center, View::direction({turn.c, turn.s}),
                   {view(piece.half.x()), view(piece.half.y())}, grow, paint);
    } else {
      drawPolygon(piece, huge, grow, paint);
    }
  }

  /// Huge polygons are cut first: single precision would move their edges.
  void drawPolygon(const Piece& piece, bool huge, float grow, const Paint& paint) {
    std::vector<Vec2> world;
    for (const Vec2& v : piece.vertices) world.push_back(pose_ * v);
    if (huge) world = clipped(std::move(world), scene_.view.visible(32.0));
    if (world.size() < 3) return;
    std::vector<Pixel> pixels;
    for (const Vec2& v : world) pixels.push_back(scene_.view(v));
    painter_.polygon(pixels, grow, paint);
  }

  /// A radius on discs shows how they turn.
  void drawSpoke(const Piece& piece, const Paint& paint) {
    if (piece.kind != Piece::Kind::Disc || scene_.view(piece.radius) < 4.0F) return;
    const Vec2 center = pose_ * piece.frame.position;
    const Vec2 rim = center + pose_.rotation * Vec2(piece.radius, 0.0);
    painter_.line(scene_.view(center), scene_.view(rim), paint.line, paint.outline);
  }

  Painter& painter_;
  const FrameScene& scene_;
  Pose pose_;
};

}  // namespace

Font FrameScene::font(float design, Weight weight, int least) const {
  return {std::max(least, static_cast<int>(std::lround(px(design)))), weight};
}

const BodyState* FrameScene::body(BodyId id) const {
  const auto found = std::ranges::lower_bound(snapshot.bodies, id, {}, &BodyState::id);
  return found != snapshot.bodies.end() && found->id == id ? &*found : nullptr;
}

float FrameScene::outlineWidth() const { return std::clamp(0.08F * bodySize(), 0.6F, px(1.6F)); }

bool isFixed(const FrameScene& scene, const BodyState& body) {
  return body.pinned || scene.info(body.id).motion != Motion::Dynamic;
}

Finish finishOf(const FrameScene& scene, const BodyState& body) {
  const Theme& theme = scene.theme();
  if (isFixed(scene, body)) return theme.fixed;
  if (body.collection == kNoCollection) return body.asleep ? theme.asleep : theme.free;
  // A sleeping collection fades, but its boundary still says which one it is.
  if (body.asleep) return {theme.asleep.fill, standingOut(scene, body.collection)};
  return scene.collection(body.collection);
}

Color standingOut(const FrameScene& scene, CollectionId id) {
  const auto& [fill, outline] = scene.collection(id);
  const Color background = scene.theme().background;
  return contrast(fill, background) > contrast(outline, background) ? fill : outline;
}

Hatch hatchOf(const FrameScene& scene, Pixel origin, const Rotation& turn, bool scripted) {
  const float period = scene.px(9.0F);
  const Vec2 across = turn * Vec2(1.0, scripted ? 1.0 : -1.0).normalized();
  const Pixel stripes = View::direction(across) * (1.0F / period);
  const double phase =
      -(double{origin.x} * double{stripes.x} + double{origin.y} * double{stripes.y});
  return {.color = scene.theme().hatch,
          .stripes = stripes,
          .phase = static_cast<float>(std::remainder(phase, 1.0)),
          .width = scene.px(1.3F)};
}

void drawBodies(Painter& painter, const FrameScene& scene) {
  BodyPainter body_painter(painter, scene);
  for (const BodyState& body : scene.snapshot.bodies) body_painter.draw(body);
}

void drawTogether(Painter& painter, const FrameScene& scene, const CollectionView& collection) {
  BodyPainter body_painter(painter, scene);
  const float width = 0.5F * scene.outlineWidth() + scene.px(1.2F);
  for (const BodyId id : collection.bodies) {
    if (const BodyState* body = scene.body(id)) {
      body_painter.drawShadow(*body, width, scene.theme().ink);
    }
  }
  for (const BodyId id : collection.bodies) {
    if (const BodyState* body = scene.body(id)) body_painter.draw(*body);
  }
}

}  // namespace merge2d
